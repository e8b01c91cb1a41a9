//! Contact at the quadrature points: the points that a body presses get springs for the step, one along the surface's normal and
//! one along the surface, from each of a few surfaces, so that contact is part of a strand's own minimisation and packs take it side by side.
//!
//! Symbols: g is the gap of a point's surface from the body's, n the normal there, S the stiffness that a point has from its inertia
//! in the step and from bending, k = 100 S. The potential gains ½ k g² where g < 0, by the tangent plane of the last iterate, and ½ c |slip|²
//! for friction, with the lagged coefficient c = μN / max(|slip|, μN/c₁) of regularised Coulomb friction (Kačanov's iteration) and c₁ =
//! 100 k, at which a point sticks. N is the force at the last iterate. Surfaces are asked for in every iteration; Newton's
//! method on such a potential is semismooth (Hintermüller, Ito and Kunisch 2002).

use super::probes::{Line, Point, Start};
use super::springs::{PointContacts, Spring};
use super::surfaces::{DepthAtPoints, PointContact, PointContactOptions, SURFACES_AT_POINT, SurfaceAtPoint, Surfaces};
use super::touches::{Side, Slot, Touch};
use crate::math::frame::Frame;
use crate::math::lane::{Lane, MAX_LANES, Precision};
use crate::math::quadrature::Rule;
use crate::math::vector::Vec3;
use crate::step::newton::iterate::Iterate;
use crate::step::newton::line_search::lanes;
use crate::step::pack::loaded::{self, Units};
use crate::step::pack::members::Pack;

/// How far a strand with contacts may be from convergence, rad: surfaces that give way deserve no more.
pub(in crate::step) const CONTACT_TOLERANCE: f64 = 2e-3;

/// k/S: surfaces sink into each other by a hundredth of the way that the force would take the point in the step. Much stiffer springs
/// take more iterations, since points go along arcs and surfaces are planes.
const STIFFNESS: f64 = 100.0;

/// c₁/k. A point that sticks creeps by its force over c₁ in a step.
const STICKING: f64 = 100.0;

/// The contacts of a strand have settled when their forces differ from the law by no more than what takes a point this far in the step, m.
const SETTLED: f64 = 5e-3;

/// The strands of a pack that bodies may touch, while their step is minimised.
pub struct Touching<'a> {
    /// The strands.
    pub members: &'a dyn Pack,
    /// How contact is answered.
    pub options: PointContactOptions,
    /// Their quadrature rule.
    pub rule: &'a Rule,
    /// Their units.
    pub units: &'a [Units; MAX_LANES],
    /// The poses of their roots at the end of the step.
    pub roots: &'a [Frame; MAX_LANES],
}

/// Where the points of a lane are.
struct Places {
    unit: f64,
    end: Vec3<f64>,
}

impl Places {
    #[inline(always)]
    fn of(touching: &Touching, lane: usize) -> Self {
        Self { unit: touching.units[lane].length, end: touching.roots[lane].origin.into() }
    }

    /// A point now, m, world.
    #[inline(always)]
    fn now<T: Lane>(&self, it: &Iterate<T>, p: usize, lane: usize) -> Vec3<f64> {
        let lane_of = |vector: &Vec3<T>| loaded::lane_of(vector, lane, self.unit);
        let mut now = lane_of(&it.kinematics.points[p].position);
        if T::PRECISION == Precision::F32 {
            now += lane_of(&it.point_compensation[p]);
        }
        self.end + now
    }
}

impl Touching<'_> {
    /// Begins a step: nothing presses yet.
    pub fn begin<T: Lane>(&self, it: &mut Iterate<T>) {
        let Iterate { contacts, system, point_target, point_base, .. } = it;
        contacts.begin(system, point_target, self.members.count());
        contacts.starts.clear();
        for lane in 0..self.members.count() {
            let (unit, origin) = (self.units[lane].length, Vec3::from(self.members.state(lane).root.origin));
            let start = |(base, arclength)| Start { arclength, at: origin + loaded::lane_of(base, lane, unit) };
            contacts.starts.extend(point_base.iter().zip(self.arclengths(lane)).map(start));
        }
    }

    /// Asks of `running` lanes which of their points press at the accepted iterate, and sets their springs. Returns the lanes whose
    /// contacts are others than their last iteration had, by more than the tolerance.
    pub fn look<T: Lane>(&self, it: &mut Iterate<T>, running: u32, is_first: bool) -> u32 {
        let mut changed = 0;
        let mut has_set = false;
        for lane in lanes(running) {
            let mut uncovered = 0.0_f64;
            self.members.with_surfaces(lane, &mut |surfaces| {
                uncovered = self.look_at(it, lane, surfaces, is_first, &mut has_set);
            });
            changed |= u32::from(uncovered > SETTLED) << lane;
        }
        if has_set {
            it.contacts.add_friction(&mut it.system, &it.point_base, &mut it.point_target);
        }
        changed
    }

    /// The springs of a lane. Returns how far the potential that they make is from the law, as the largest distance over which a
    /// point's inertia yields to the difference, m.
    fn look_at<T: Lane>(
        &self,
        it: &mut Iterate<T>,
        lane: usize,
        surfaces: &dyn Surfaces,
        is_first: bool,
        has_set: &mut bool,
    ) -> f64 {
        let mut uncovered = 0.0_f64;
        let places = self.with_line(it, lane, |line| {
            line.ask(surfaces, is_first, self.options.separation);
        });
        let points = it.contacts.points.len();
        for p in 0..points {
            let known = it.contacts.known[lane * points + p];
            for slot in 0..SURFACES_AT_POINT {
                let Some(Slot { is, was, .. }) = it.contacts.near.touches.slots(known.touches).nth(slot).copied() else { break };
                if was.is_some() || is.is_some() {
                    let spring = Spring { lane, p, slot };
                    let was = was.map(|touch| touch.presses);
                    uncovered = uncovered.max(self.set_spring(it, &places, spring, was, is.as_ref(), is_first));
                    *has_set = true;
                }
            }
        }
        uncovered
    }

    /// Calls `work` with the points of a lane.
    fn with_line<T: Lane>(&self, it: &mut Iterate<T>, lane: usize, work: impl FnOnce(&mut Line)) -> Places {
        let places = Places::of(self, lane);
        let mut points = std::mem::take(&mut it.contacts.points);
        points.clear();
        points.extend((0..it.point_base.len()).map(|p| Point::new(places.now(it, p, lane))));
        let PointContacts { known, near, starts, candidates, halfway, .. } = &mut it.contacts;
        let own = lane * points.len()..(lane + 1) * points.len();
        let model = self.members.model(lane);
        halfway.prepare(self.rule, &model.lengths);
        work(&mut Line {
            points: &mut points,
            starts: &starts[own.clone()],
            known: &mut known[own],
            near,
            candidates,
            halfway,
            length: model.length(),
        });
        it.contacts.points = points;
        places
    }

    /// Arclengths of a strand's points from the root, m.
    fn arclengths(&self, lane: usize) -> impl Iterator<Item = f64> {
        let mut from = 0.0;
        let lengths = &self.members.model(lane).lengths;
        lengths.iter().flat_map(move |length| {
            let start = from;
            from += length;
            self.rule.nodes.iter().map(move |node| start + node * length)
        })
    }

    /// The gap of a point above where its spring rests, by its plane, m.
    fn planar_gap<T: Lane>(&self, it: &Iterate<T>, places: &Places, spring: Spring, now: Vec3<f64>) -> f64 {
        let index = spring.index(it.point_base.len());
        let normal = loaded::lane_of(&it.system.normals[index], spring.lane, 1.0);
        normal.dot(now - places.end) - it.contacts.offsets[index].lane(spring.lane) * places.unit
    }

    /// Sets the springs of a point and a surface, or takes them away: whether the surface, if it was known in the iteration before, pressed
    /// then, and what it is now. Returns the distance over which the point's inertia yields to the difference of their forces at the present
    /// iterate, m.
    fn set_spring<T: Lane>(
        &self,
        it: &mut Iterate<T>,
        places: &Places,
        spring: Spring,
        was: Option<bool>,
        is: Option<&Touch>,
        is_first: bool,
    ) -> f64 {
        let Spring { lane, p, .. } = spring;
        let now = it.contacts.points[p].now;
        let index = spring.index(it.contacts.points.len());
        it.contacts.make_room(&mut it.system, index);
        let start = it.contacts.starts[lane * it.contacts.points.len() + p].at;
        let unit = self.units[lane].force() / places.unit;
        let resists = self.resists(it.contacts.free_stiffness[p].lane(lane) * unit, p, lane);
        // Forces before, along the normal and along the surface.
        let had_friction = it.contacts.friction[index].lane(lane) * unit;
        let had = if was.is_some() { (-self.planar_gap(it, places, spring, now)).max(0.0) } else { 0.0 };
        let Some(Touch { side: Side { surface, .. }, rest, held, presses }) = is else {
            for list in [&mut it.system.normal_stiffness, &mut it.contacts.planes, &mut it.contacts.friction] {
                list[index].set_lane(lane, 0.0);
            }
            return had * STIFFNESS;
        };
        let (normal, stiffness) = (surface.normal, STIFFNESS * resists);
        let depth = (rest - surface.gap).max(0.0);
        // A point that has just come has no force yet that tells of friction, but what it had when the step began.
        let bears = if was == Some(true) && !is_first { depth } else { *held };
        let bears = bears.min(self.options.holding_depth);
        let slip = tangential((now - start) - surface.carried, normal);
        let distance = slip.norm_squared().sqrt();
        let most = self.coefficient(surface, slip, distance, self.tangent(it, p, lane)) * stiffness * bears;
        let friction = if most <= 0.0 {
            0.0
        } else if most >= STICKING * stiffness * distance {
            STICKING * stiffness
        } else {
            most / distance
        };
        let rests_at = normal.dot(now - places.end) - (surface.gap - rest);
        let anchor = (start + surface.carried) - places.end;
        let anchor = anchor + normal.scale(rests_at - normal.dot(anchor));
        for axis in 0..3 {
            it.system.normals[index].0[axis].set_lane(lane, normal.0[axis]);
            it.contacts.anchors[index].0[axis].set_lane(lane, anchor.0[axis] / places.unit);
        }
        it.contacts.offsets[index].set_lane(lane, rests_at / places.unit);
        it.contacts.planes[index].set_lane(lane, stiffness / unit);
        it.contacts.friction[index].set_lane(lane, friction / unit);
        let meets = if *presses { stiffness } else { 0.0 };
        it.system.normal_stiffness[index].set_lane(lane, (meets - friction) / unit);
        (depth - had).abs() * STIFFNESS + (had_friction - friction).abs() * distance / resists
    }

    /// What resists a force on a point that has this `inertia` alone: that of the length over which the strand bends with it in the step,
    /// (EI/(ρS/h²))^¼, N/m.
    fn resists(&self, inertia: f64, p: usize, lane: usize) -> f64 {
        let (model, nodes) = (self.members.model(lane), self.rule.len());
        let own = self.rule.weights[p % nodes] * model.lengths[p / nodes];
        let bends = (model.stiffness[1].max(model.stiffness[2]) * own / inertia).sqrt().sqrt();
        inertia * (1.0 + bends / own)
    }

    /// The coefficient of friction for a slip.
    fn coefficient(&self, surface: &SurfaceAtPoint, slip: Vec3<f64>, distance: f64, tangent: Vec3<f64>) -> f64 {
        let along = if distance > 0.0 { slip.dot(tangent) / distance } else { 0.0 };
        0.5 * (surface.along + surface.against) + 0.5 * (surface.against - surface.along) * along
    }

    /// The strand's direction about a point, unit.
    fn tangent<T: Lane>(&self, it: &Iterate<T>, p: usize, lane: usize) -> Vec3<f64> {
        let points = &it.kinematics.points;
        let (from, to) = if p + 1 < points.len() { (p, p + 1) } else { (p - 1, p) };
        let chord = loaded::lane_of(&(points[to].position - points[from].position), lane, 1.0);
        let length = chord.norm_squared().sqrt();
        if length > 0.0 { chord.scale(1.0 / length) } else { Vec3::zero() }
    }

    /// Lanes with contacts.
    pub fn with_contacts<T: Lane>(&self, it: &Iterate<T>, running: u32) -> u32 {
        let of_lane = |lane: usize| &it.contacts.known[lane * it.point_base.len()..][..it.point_base.len()];
        lanes(running)
            .filter(|lane| of_lane(*lane).iter().any(|known| it.contacts.near.of(known).any(|touch| touch.presses)))
            .fold(0, |set, lane| set | 1 << lane)
    }

    /// Measures the overlaps at the end of a step.
    pub fn measure<T: Lane>(&self, it: &mut Iterate<T>, active: u32) {
        for lane in lanes(active) {
            let (mut smallest, mut at_root) = (f64::INFINITY, f64::INFINITY);
            self.members.with_surfaces(lane, &mut |surfaces| {
                self.with_line(it, lane, |line| smallest = line.measure(surfaces));
                at_root = surfaces.nearest(0.0, self.roots[lane].origin.into()).map_or(f64::INFINITY, |found| found.nearest.gap);
            });
            it.contacts.depth[lane] = DepthAtPoints { deepest: -smallest.min(at_root), root: -at_root };
        }
    }

    /// Contacts that press inelastically leave no velocity away from their surfaces, and none of the formula's memory of what was
    /// before: where a point presses, its velocity is that of the way it went.
    pub fn correct_velocities<T: Lane>(&self, it: &Iterate<T>, h: f64, active: u32, velocities: &mut [Vec3<T>]) {
        for lane in lanes(active) {
            let (places, per_step) = (Places::of(self, lane), 1.0 / h);
            for (p, velocity) in velocities.iter_mut().enumerate() {
                let place = lane * it.point_base.len() + p;
                let pressing = || it.contacts.near.of(&it.contacts.known[place]).filter(|touch| touch.presses);
                if pressing().next().is_none() {
                    continue;
                }
                let (start, now) = (it.contacts.starts[place].at, places.now(it, p, lane));
                let mut moved = (now - start).scale(per_step);
                for touch in pressing() {
                    let SurfaceAtPoint { normal, carried, .. } = touch.side.surface;
                    moved -= normal.scale(normal.dot(moved - carried.scale(per_step)).max(0.0));
                }
                loaded::put(&mut velocity.0, lane, &moved.0, 1.0 / self.units[lane].speed());
            }
        }
    }

    /// Calls `take` with the contacts of a lane that press, from root to tip.
    pub fn for_each_contact<T: Lane>(&self, it: &Iterate<T>, lane: usize, mut take: impl FnMut(PointContact)) {
        let places = Places::of(self, lane);
        for p in 0..it.point_base.len() {
            let place = lane * it.point_base.len() + p;
            let known = &it.contacts.known[place];
            if known.touches.is_none() {
                continue;
            }
            let (Start { arclength, at: start }, now) = (it.contacts.starts[place], places.now(it, p, lane));
            for (slot, near) in it.contacts.near.touches.slots(known.touches).enumerate() {
                let Some(Touch { side: Side { surface, .. }, .. }) = near.is else { continue };
                let spring = Spring { lane, p, slot };
                let (index, overlap) = (spring.index(it.point_base.len()), -self.planar_gap(it, &places, spring, now));
                if overlap <= 0.0 {
                    continue;
                }
                let unit = self.units[lane].force() / places.unit;
                let friction = it.contacts.friction[index].lane(lane) * unit;
                let stiffness = it.contacts.planes[index].lane(lane) * unit;
                let anchor = places.end + loaded::lane_of(&it.contacts.anchors[index], lane, places.unit);
                let force = surface.normal.scale(stiffness * overlap) + tangential(anchor - now, surface.normal).scale(friction);
                let slip = tangential((now - start) - surface.carried, surface.normal);
                take(PointContact { arclength, position: now, surface, force, slip });
            }
        }
    }
}

/// The part of a vector across a unit normal.
fn tangential(vector: Vec3<f64>, normal: Vec3<f64>) -> Vec3<f64> {
    vector - normal.scale(normal.dot(vector))
}
