//! Samples many strands at uniform arclengths: in packs side by side, on all of the solver's workers.

use std::marker::PhantomData;
use std::ops::Range;

use nalgebra::Vector3;

use super::sampling::Sampler;
use crate::error::{Error, Result};
use crate::math::lane::Kernel;
#[cfg(target_arch = "x86_64")]
use crate::math::lane::Lane;
#[cfg(target_arch = "x86_64")]
use crate::math::lanes::InstructionSet;
#[cfg(target_arch = "x86_64")]
use crate::math::lanes::{F64x4, F64x8};
use crate::math::prefetch::prefetch;
use crate::math::quadrature::{Rule, Rules};
use crate::rod::uniform_points::{Lanes, Real, WIDTH, Walk};
use crate::solver::Solver;
use crate::solver::id::StrandId;
use crate::solver::strands::strand::Strand;

/// Most points per strand in one tile.
const TILE: usize = 16;

/// The largest number of nodes of a rule whose velocities go side by side.
const MAX_NODES: usize = 16;

/// How many strands ahead to prefetch.
const AHEAD: usize = 16;

/// Approximate number of points per task: enough to be worth handing out.
const POINTS_PER_TASK: usize = 1024;

/// Most of them at a time.
const PARTS_A_TASK: usize = 8;

/// What to sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// Points per strand, uniform in arclength, root and tip included; at least 2.
    pub points_per_strand: usize,
    /// Subtracted from positions in f64, before they are narrowed, m.
    pub origin: Vector3<f64>,
    /// Whether to compute positions.
    pub positions: bool,
    /// Whether to compute frames.
    pub rotations: bool,
    /// Whether to compute velocities.
    pub velocities: bool,
}

/// A few points of a few strands.
#[derive(Debug)]
pub struct Tile<'a, T> {
    /// Indices of the strands in the call; at most [`WIDTH`].
    pub strands: &'a [u32],
    /// The first point, counted from the root.
    pub first: usize,
    /// The number of points.
    pub count: usize,
    /// Positions relative to the origin, m: `[point][axis][strand]`; empty if not requested, like those below.
    pub positions: &'a [[Lanes<T>; 3]],
    /// Quaternions x, y, z, w of the material frames, `[point][number][strand]`.
    pub rotations: &'a [[Lanes<T>; 4]],
    /// Velocities of the material points, m/s, `[point][axis][strand]`.
    pub velocities: &'a [[Lanes<T>; 3]],
}

/// Receives samples. Tiles come in any order and from any of the solver's threads, each point of each strand once.
///
/// ```
/// use std::sync::Mutex;
///
/// use superhelix::nalgebra::Vector3;
/// use superhelix::reading::{SampleSink, Tile, Wanted};
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// const POINTS: usize = 9;
///
/// /// Points of all strands, one strand after the other.
/// struct Points(Mutex<Vec<[f32; 3]>>);
///
/// impl SampleSink<f32> for Points {
///     fn take(&self, tile: &Tile<f32>) {
///         let mut points = self.0.lock().unwrap();
///         for (lane, strand) in tile.strands.iter().enumerate() {
///             for k in 0..tile.count {
///                 let axes = &tile.positions[k];
///                 points[*strand as usize * POINTS + tile.first + k] = [axes[0][lane], axes[1][lane], axes[2][lane]];
///             }
///         }
///     }
/// }
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&vec![StrandDef::straight(0.2, 5); 20])?;
/// let wanted = Wanted { points_per_strand: POINTS, origin: Vector3::zeros(), positions: true, rotations: false, velocities: false };
/// let points = Points(Mutex::new(vec![[0.0; 3]; ids.len() * POINTS]));
/// solver.sample_tiles(&ids, &wanted, &points)?;
/// assert!((points.0.lock().unwrap()[POINTS - 1][0] - 0.2).abs() < 1e-6);
/// # Ok::<(), superhelix::Error>(())
/// ```
pub trait SampleSink<T>: Sync {
    /// Receives a tile.
    fn take(&self, tile: &Tile<T>);
}

impl Solver {
    /// Samples strands uniformly in arclength, in f32 or f64; `sink` receives every point of every strand once.
    ///
    /// Strands of equal elements are evaluated side by side (`rod::uniform_points`), others one by one. In f32 a position differs
    /// from that in f64 by at most 10⁻⁶ of the strand's length, plus the rounding of the output; frames and velocities by 10⁻⁶ of
    /// one and of the largest velocity. A strand's samples do not depend on the other strands or on threads.
    ///
    /// Runs on the solver's workers, a host's task system too, if there is enough to do for more than one. Several threads may sample at once:
    /// a host's task system is then called from each.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for fewer than two points; [`Error::InvalidId`] naming `ids[i]`. The sink has then received
    /// nothing.
    pub fn sample_tiles<T: Real>(&self, ids: &[StrandId], wanted: &Wanted, sink: &impl SampleSink<T>) -> Result<()> {
        self.timed_sampling(|| self.sample_tiles_now(ids, wanted, sink))
    }

    fn sample_tiles_now<T: Real>(&self, ids: &[StrandId], wanted: &Wanted, sink: &impl SampleSink<T>) -> Result<()> {
        if wanted.points_per_strand < 2 {
            return Err(Error::invalid("points_per_strand", wanted.points_per_strand, "2 or more: root and tip"));
        }
        let mut strands = Vec::with_capacity(ids.len());
        let indices = self.indices(ids)?;
        for (place, index) in indices.iter().enumerate() {
            if let Some(later) = indices.get(place + AHEAD) {
                prefetch(&self.strands[*later].model);
            }
            let strand = &self.strands[*index];
            strands.push(Asked { strand, place: place as u32, elements: strand.model.element_count() as u32 });
        }
        // Strands that go side by side are sorted together; otherwise in the order of the call.
        if strands.windows(2).any(|pair| pair[0].elements != pair[1].elements) {
            strands.sort_by_key(|asked| asked.elements);
        }
        let each = (POINTS_PER_TASK / wanted.points_per_strand / WIDTH).max(1) * WIDTH;
        let mut parts: Vec<&[Asked]> = strands.chunks(each).collect();
        let set = self.instruction_set();
        let sample = |part: &[Asked]| {
            let part = SampleTask { strands: part, wanted, rules: &self.rules, sink, number: PhantomData::<T> };
            match set {
                #[cfg(target_arch = "x86_64")]
                InstructionSet::Avx512 => F64x8::call(part),
                #[cfg(target_arch = "x86_64")]
                InstructionSet::Avx2 => F64x4::call(part),
                _ => part.run(),
            }
        };
        match &mut parts[..] {
            // Handing out one would cost a host more than doing it.
            [part] => sample(part),
            parts => self.workers.for_each_task(parts, 1, PARTS_A_TASK, |parts, _| parts.iter().for_each(|part| sample(part))),
        }
        Ok(())
    }
}

/// A strand and its index in the call.
#[derive(Clone, Copy)]
struct Asked<'a> {
    strand: &'a Strand,
    place: u32,
    elements: u32,
}

/// Scratch memory for a tile.
struct Room<T> {
    positions: [[Lanes<T>; 3]; TILE],
    rotations: [[Lanes<T>; 4]; TILE],
    velocities: [[Lanes<T>; 3]; TILE],
    /// Velocities at the nodes of an element.
    values: [[Lanes<f64>; 3]; MAX_NODES],
}

impl<T: Real> Room<T> {
    fn new() -> Self {
        let none = [T::default(); WIDTH];
        Self {
            positions: [[none; 3]; TILE],
            rotations: [[none; 4]; TILE],
            velocities: [[none; 3]; TILE],
            values: [[[0.0; WIDTH]; 3]; MAX_NODES],
        }
    }

    /// Emits the first `count` points, of which the first is the strands' point `first`.
    fn hand_out(&self, strands: &[u32], first: usize, count: usize, wanted: &Wanted, sink: &impl SampleSink<T>) {
        sink.take(&Tile {
            strands,
            first,
            count,
            positions: if wanted.positions { &self.positions[..count] } else { &[] },
            rotations: if wanted.rotations { &self.rotations[..count] } else { &[] },
            velocities: if wanted.velocities { &self.velocities[..count] } else { &[] },
        });
    }
}

/// Some of the strands of a call, in numbers T.
struct SampleTask<'a, T, S> {
    strands: &'a [Asked<'a>],
    wanted: &'a Wanted,
    rules: &'a Rules,
    sink: &'a S,
    number: PhantomData<T>,
}

impl<T: Real, S: SampleSink<T>> Kernel for SampleTask<'_, T, S> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { strands, wanted, rules, sink, .. } = self;
        let mut room = Room::new();
        let mut places = Places::default();
        let mut done = 0;
        for run in strands.chunk_by(|a, b| a.elements == b.elements) {
            places.lay(run[0].elements as usize, wanted.points_per_strand);
            for pack in run.chunks(WIDTH) {
                done += pack.len();
                foresee(&strands[done..], wanted);
                let equal = |asked: &Asked| asked.strand.model.equal_length().is_some();
                if pack.iter().all(equal) {
                    side_by_side(pack, wanted, &mut places, rules, &mut room, sink);
                    continue;
                }
                for asked in pack {
                    if equal(asked) {
                        side_by_side(std::slice::from_ref(asked), wanted, &mut places, rules, &mut room, sink);
                    } else {
                        one_by_one(asked, wanted, rules, &mut room, sink);
                    }
                }
            }
        }
    }
}

/// Prefetches coming strands: the heads of those in the second next pack, and the data of those in the next.
#[inline(always)]
fn foresee(next: &[Asked], wanted: &Wanted) {
    for asked in next.iter().skip(WIDTH).take(WIDTH) {
        prefetch(&asked.strand.model);
        prefetch(&asked.strand.state.root);
        prefetch(&asked.strand.state.curvatures);
    }
    for asked in next.iter().take(WIDTH) {
        let state = &asked.strand.state;
        prefetch(&*state.curvatures);
        if wanted.velocities {
            prefetch(&*state.velocities);
        }
    }
}

/// The sampled points on strands of equal elements.
#[derive(Default)]
struct Places {
    elements: usize,
    /// Points by element; `of[e]` are those of element e.
    of: Vec<Range<usize>>,
    /// Relative position on the element, per point.
    fractions: Vec<f64>,
    /// Interpolation coefficients from a rule's nodes to the points: a list per rule, empty until first used.
    coefficients: Vec<Vec<f64>>,
}

impl Places {
    fn lay(&mut self, elements: usize, points: usize) {
        if self.elements == elements {
            return;
        }
        self.elements = elements;
        self.of.clear();
        self.fractions.clear();
        self.coefficients.iter_mut().for_each(Vec::clear);
        let last = points - 1;
        let mut point = 0;
        for element in 0..elements {
            let first = point;
            // A point on a border belongs to the element before it. Products of counts make this exact.
            while point <= last && point * elements <= (element + 1) * last {
                self.fractions.push((point * elements - element * last) as f64 / last as f64);
                point += 1;
            }
            self.of.push(first..point);
        }
    }

    /// The coefficients of one rule, a row per point.
    fn coefficients(&mut self, index: usize, rule: &Rule) -> &[f64] {
        if self.coefficients.len() <= index {
            self.coefficients.resize(index + 1, Vec::new());
        }
        let list = &mut self.coefficients[index];
        if list.is_empty() {
            for fraction in &self.fractions {
                rule.for_each_coefficient(*fraction, |_, coefficient| list.push(coefficient));
            }
        }
        list
    }
}

/// Strands with equal elements, and equal numbers of them.
#[inline(always)]
fn side_by_side<T: Real>(
    pack: &[Asked],
    wanted: &Wanted,
    places: &mut Places,
    rules: &Rules,
    room: &mut Room<T>,
    sink: &impl SampleSink<T>,
) {
    // Lanes without a strand repeat the first.
    let asked = |lane: usize| pack.get(lane).unwrap_or(&pack[0]);
    let strand = |lane: usize| asked(lane).strand;
    let (mut calls, mut rotation) = ([0; WIDTH], [[0.0; WIDTH]; 4]);
    let (mut length, mut base) = ([0.0; WIDTH], [[0.0; WIDTH]; 3]);
    for lane in 0..WIDTH {
        let Strand { model, state, .. } = strand(lane);
        calls[lane] = asked(lane).place;
        length[lane] = model.equal_length().unwrap_or_default();
        let q = state.root.rotation.quaternion();
        [rotation[0][lane], rotation[1][lane], rotation[2][lane], rotation[3][lane]] = [q.i, q.j, q.k, q.w];
        (0..3).for_each(|axis| base[axis][lane] = state.root.origin[axis] - wanted.origin[axis]);
        if wanted.velocities {
            places.coefficients(state.rule, rules.rule(state.rule));
        }
    }
    let calls = &calls[..pack.len()];
    let mut walk = Walk::new(rotation, length);
    let (mut first, mut count) = (0, 0);
    let walks = wanted.positions || wanted.rotations;
    // Velocities go side by side if all strands have the same nodes, and few enough of them.
    let rule = pack[0].strand.state.rule;
    let alike = || pack.iter().all(|asked| asked.strand.state.rule == rule) && rules.rule(rule).len() <= MAX_NODES;
    let common_rule = (wanted.velocities && alike()).then_some(rule);
    for element in 0..places.elements {
        if walks {
            let mut curvatures = [[0.0; WIDTH]; 3];
            for lane in 0..WIDTH {
                let row = &strand(lane).state.curvatures[element];
                (0..3).for_each(|axis| curvatures[axis][lane] = row[axis]);
            }
            walk.enter(&curvatures);
        }
        let points = places.of[element].clone();
        if let Some(rule) = common_rule
            && !points.is_empty()
        {
            let nodes = rules.rule(rule).len();
            for lane in 0..WIDTH {
                let rows = &strand(lane).state.velocities[element * nodes..(element + 1) * nodes];
                for (value, row) in room.values.iter_mut().zip(rows) {
                    (0..3).for_each(|axis| value[axis][lane] = row.0[axis]);
                }
            }
        }
        let state = (walks && !points.is_empty()).then(|| walk.element::<T>());
        for point in points {
            let fraction = places.fractions[point];
            if let Some(state) = &state {
                match (wanted.positions, wanted.rotations) {
                    (true, true) => (room.positions[count], room.rotations[count]) = state.pose(fraction, &base),
                    (true, false) => room.positions[count] = state.position(fraction, &base),
                    _ => room.rotations[count] = state.rotation(fraction),
                }
            }
            if wanted.velocities {
                if let Some(rule) = common_rule {
                    let nodes = rules.rule(rule).len();
                    let coefficients = &places.coefficients[rule][point * nodes..(point + 1) * nodes];
                    room.velocities[count] = combined(coefficients, &room.values);
                } else {
                    for (lane, asked) in pack.iter().enumerate() {
                        let velocity = velocity(asked.strand, element, point, places, rules);
                        (0..3).for_each(|axis| room.velocities[count][axis][lane] = T::near(velocity[axis]));
                    }
                }
            }
            count += 1;
            if count == TILE {
                room.hand_out(calls, first, count, wanted, sink);
                (first, count) = (first + count, 0);
            }
        }
        if walks && element + 1 < places.elements {
            walk.leave();
        }
    }
    if count > 0 {
        room.hand_out(calls, first, count, wanted, sink);
    }
}

/// Linear combination of values at nodes.
#[inline(always)]
fn combined<T: Real>(coefficients: &[f64], values: &[[Lanes<f64>; 3]]) -> [Lanes<T>; 3] {
    let mut out = [[T::default(); WIDTH]; 3];
    for axis in 0..3 {
        let mut sum = [0.0; WIDTH];
        for (coefficient, value) in coefficients.iter().zip(values) {
            for lane in 0..WIDTH {
                sum[lane] += coefficient * value[axis][lane];
            }
        }
        for lane in 0..WIDTH {
            out[axis][lane] = T::near(sum[lane]);
        }
    }
    out
}

/// The velocity at a point of an element: a polynomial through the values at the nodes.
#[inline(always)]
fn velocity(strand: &Strand, element: usize, point: usize, places: &Places, rules: &Rules) -> [f64; 3] {
    let nodes = rules.rule(strand.state.rule).len();
    let coefficients = &places.coefficients[strand.state.rule][point * nodes..(point + 1) * nodes];
    let values = &strand.state.velocities[element * nodes..(element + 1) * nodes];
    let mut sum = [0.0; 3];
    for (coefficient, value) in coefficients.iter().zip(values) {
        (0..3).for_each(|axis| sum[axis] += coefficient * value.0[axis]);
    }
    sum
}

/// A strand of unequal elements: in f64, rounded at the end.
fn one_by_one<T: Real>(asked: &Asked, wanted: &Wanted, rules: &Rules, room: &mut Room<T>, sink: &impl SampleSink<T>) {
    let mut sampler = Sampler::new(asked.strand, rules);
    let (length, last) = (asked.strand.model.length(), wanted.points_per_strand - 1);
    let mut first = 0;
    while first <= last {
        let count = TILE.min(last + 1 - first);
        for point in 0..count {
            let place = sampler.go(length * ((first + point) as f64 / last as f64));
            if wanted.positions {
                let position = place.position() - wanted.origin;
                (0..3).for_each(|axis| room.positions[point][axis][0] = T::near(position[axis]));
            }
            if wanted.rotations {
                let rotation = place.rotation();
                (0..4).for_each(|number| room.rotations[point][number][0] = T::near(rotation.coords[number]));
            }
            if wanted.velocities {
                let velocity = place.velocity();
                (0..3).for_each(|axis| room.velocities[point][axis][0] = T::near(velocity[axis]));
            }
        }
        room.hand_out(&[asked.place], first, count, wanted, sink);
        first += count;
    }
}
