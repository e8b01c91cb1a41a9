//! Contacts between two strands, from pairs of their pieces, exact on the helices.
//!
//! Every local minimum of the distance is a contact. Where the strands lie along each other a minimum may be anywhere, so that
//! the ends of each overlap are contacts as well: two of them keep the strands from rocking about one.

use nalgebra::{Matrix3, Vector3};

use super::helix_distance::{Arc, PointPair, closest, direction};
use super::segment_distance::closest_of_segments;
use crate::contact::broad_phase::pieces::{Piece, Wisp};
use crate::contact::ccd::sides::keep_sides;
use crate::contact::contact_point::{ContactPoint, Partner, StrandPath, StrandPoint};

/// Contacts closer to each other along both strands than this fraction of the sum of the radii are one.
const MERGED: f64 = 0.25;
/// Centrelines that come closer than this fraction of the sum of the radii (of what permitted overlaps leave of it) while their normal turns
/// round have crossed; centrelines that were closer when the step began were inside each other, and have no side to keep.
const CROSSED: f64 = 0.5;
/// Of the sum of the radii at least this fraction counts for that, even where permitted overlaps leave less: strands that may lie in each
/// other have no sides.
const LEAST_KEPT: f64 = 0.2;

/// Strands lie along each other where the square of the sine between their tangents is less: within a quarter of a radian.
const ALONG: f64 = 0.0625;
/// The same between chords of pieces that have such tangents somewhere: half a piece's bend more to either side, sin² 0.75.
const MAX_CHORDS: f64 = 0.47;

/// A piece and the positions of its ends at the start of the step and now, world, m. The start is carried along by the common
/// motion of all strands, which therefore does not count as motion.
#[derive(Debug, Clone, Copy)]
pub struct MovingPiece<'a> {
    /// The piece.
    pub piece: &'a Piece,
    /// Both ends at the step's start.
    pub start: [Vector3<f64>; 2],
    /// Both ends at the present iterate.
    pub now: [Vector3<f64>; 2],
    /// The larger distance from its chord, then or now, m.
    pub sagitta: f64,
}

impl MovingPiece<'_> {
    fn moved(&self) -> [Vector3<f64>; 2] {
        [self.now[0] - self.start[0], self.now[1] - self.start[1]]
    }

    fn at(&self, t: f64) -> [Vector3<f64>; 2] {
        [0, 1].map(|end| self.start[end].lerp(&self.now[end], t))
    }

    fn along(&self, s: f64) -> f64 {
        self.piece.along + (s - self.piece.s[0])
    }
}

/// The largest motion of points of one piece relative to those of another between the start of the step and now, m.
pub(in crate::contact) fn relative_motion(a: [Vector3<f64>; 2], b: [Vector3<f64>; 2]) -> f64 {
    let of = |i: usize, j: usize| (a[i] - b[j]).norm_squared();
    of(0, 0).max(of(0, 1)).max(of(1, 0)).max(of(1, 1)).sqrt()
}

/// A contact and what its neighbours need to know of it.
#[derive(Debug, Clone, Copy)]
struct Found {
    points: [StrandPoint; 2],
    /// Unit, from the second point to the first.
    normal: Vector3<f64>,
    gap: f64,
    /// The distance that the centrelines keep here, m.
    radii: f64,
    along: [f64; 2],
    /// The strands crossed here, and the contact keeps the initial side.
    crossed: bool,
}

impl Found {
    fn contact(&self) -> ContactPoint {
        let [point, partner] = self.points;
        let partner = Partner::Strand(partner);
        ContactPoint { point, partner, normal: self.normal, gap: self.gap, carried: Vector3::zeros() }
    }
}

/// What chords say of two pieces, or parts of them; it is never too little.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Encounter {
    /// They may touch.
    touch: bool,
    /// They may have gone through each other.
    crossing: bool,
}

impl Encounter {
    /// What it comes to if one of these is possible.
    pub fn of_any(all: impl Iterator<Item = Encounter>) -> Self {
        let mut any = Self::default();
        for one in all {
            any = Self { touch: any.touch || one.touch, crossing: any.crossing || one.crossing };
            if any.touch && any.crossing {
                break;
            }
        }
        any
    }

    /// Whether there may be any contact.
    pub fn is_possible(self) -> bool {
        self.touch || self.crossing
    }
}

/// Memory of one thread's search for contacts.
#[derive(Debug, Default)]
pub struct PairScratch {
    found: Vec<Found>,
}

/// Two strands that may be in contact.
#[derive(Debug, Clone, Copy)]
pub struct TwoStrands<'a> {
    /// The first, whose contacts are found.
    pub a: &'a StrandPath<'a>,
    /// Its partner.
    pub b: &'a StrandPath<'a>,
    /// The first's wisp.
    pub wisp_a: &'a Wisp,
    /// The partner's.
    pub wisp_b: &'a Wisp,
    /// Gaps up to this are contacts, m; below zero: only what is as deep.
    pub within: f64,
    /// The rotation of the common motion of all strands since the start of the step.
    pub turned: Matrix3<f64>,
    /// Places less far along both than this do not touch, m, see [`Wisp::held_length`].
    pub held: f64,
}

impl TwoStrands<'_> {
    /// The sum of the radii, m.
    fn radii(&self) -> f64 {
        self.wisp_a.radius + self.wisp_b.radius
    }

    /// What permitted overlaps leave of it at these arclengths from the roots (m), m.
    fn radii_at(&self, along: [f64; 2]) -> f64 {
        let left = |path: &StrandPath, along: f64| path.permitted_overlap.map_or(1.0, |overlap| overlap.wisp_fraction(along));
        self.wisp_a.radius * left(self.a, along[0]) + self.wisp_b.radius * left(self.b, along[1])
    }

    /// Appends the contacts of the strands to `out`, by arclength of the first (and then of the partner). `candidates` are the
    /// pairs of pieces that may be in contact, and how, in any order that does not change from call to call.
    pub fn contacts<'p>(
        &self,
        candidates: impl Iterator<Item = (MovingPiece<'p>, MovingPiece<'p>, Encounter)>,
        scratch: &mut PairScratch,
        out: &mut Vec<ContactPoint>,
    ) {
        scratch.found.clear();
        for (a, b, may) in candidates {
            self.of_pieces(&a, &b, may, &mut scratch.found);
        }
        self.keep_sides_beside(&mut scratch.found);
        let order = |x: &Found, y: &Found| x.along[0].total_cmp(&y.along[0]).then(x.along[1].total_cmp(&y.along[1]));
        scratch.found.sort_unstable_by(order);
        merge(&mut scratch.found, MERGED * self.radii());
        out.extend(scratch.found.iter().map(Found::contact));
    }

    /// What pieces, or the parts of pieces that chords span, may do.
    pub fn may_meet(&self, a: &MovingPiece, b: &MovingPiece) -> Encounter {
        let chords = closest_of_segments([&a.now[0], &a.now[1]], [&b.now[0], &b.now[1]]);
        let least = chords.distance - a.sagitta - b.sagitta;
        let touch = least <= self.radii() + self.within;
        let inside = CROSSED * self.radii();
        let crossing = least <= relative_motion(a.moved(), b.moved()) + inside
            && !keep_sides(a, b, offsets(a, b, [chords.t, chords.u]), inside);
        Encounter { touch, crossing }
    }

    fn of_pieces(&self, a: &MovingPiece, b: &MovingPiece, may: Encounter, found: &mut Vec<Found>) {
        let radii = self.radii();
        let sagittas = a.sagitta + b.sagitta;
        let chords = closest_of_segments([&a.now[0], &a.now[1]], [&b.now[0], &b.now[1]]);
        let motion = relative_motion(a.moved(), b.moved());
        let inside = CROSSED * radii;
        let arc_a = Arc { curve: self.a.now, element: a.piece.element as usize, s: a.piece.s };
        let arc_b = Arc { curve: self.b.now, element: b.piece.element as usize, s: b.piece.s };
        let mut near = closest(&arc_a, &arc_b, along_pieces([chords.t, chords.u], a, b), [false; 2]);
        // Where the chords cross at more than this no tangents of theirs lie along each other.
        let (line_a, line_b) = (a.now[1] - a.now[0], b.now[1] - b.now[0]);
        let may_lie_along = line_a.cross(&line_b).norm_squared() <= MAX_CHORDS * line_a.norm_squared() * line_b.norm_squared();
        // Arcs along each other may be bowed towards each other: a second nearest place, where the chords do not show it.
        let mut second = None;
        if may_lie_along && let Some(start) = middle_of_overlap(a, b, (radii + self.within).max(motion + inside) + sagittas) {
            let other = closest(&arc_a, &arc_b, along_pieces(start, a, b), [false; 2]);
            second = Some(other);
            if other.apart.norm_squared() < near.apart.norm_squared() {
                second = Some(std::mem::replace(&mut near, other));
            }
        }
        let side = if may.crossing { self.side_kept(a, b, &near, motion) } else { None };
        let close = |pair: &PointPair| pair.apart.norm() - radii <= self.within;
        if !close(&near) && side.is_none() {
            return;
        }
        // Where the distance is constant the middle is no contact of its own: the ends suffice.
        for pair in [Some(near), second.filter(|pair| !pair.is_flat())].into_iter().flatten() {
            if side.is_some() || (close(&pair) && !goes_on(&pair, 0, a) && !goes_on(&pair, 1, b)) {
                self.add(a, b, &pair, side, found);
            }
        }
        for held in [0, 1] {
            for end in [0, 1] {
                let (this, that) = ([a, b][held], [a, b][1 - held]);
                let continued = this.piece.continued[end];
                // A piece's second end is the next piece's first one, which is searched by itself. A strand's end may be
                // nearest in its own right, beside another nearest place of the same pieces.
                if continued && (end == 1 || !may_lie_along) {
                    continue;
                }
                // Begun opposite, by the chords; what is too far by them is too far.
                let (tip, line) = (this.now[end] - that.now[0], that.now[1] - that.now[0]);
                let t = (tip.dot(&line) / line.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
                let farthest = radii + self.within + that.sagitta;
                if (tip - line * t).norm_squared() > farthest * farthest {
                    continue;
                }
                let mut from = near.s;
                from[held] = this.piece.s[end];
                from[1 - held] = that.piece.s[0] + t * (that.piece.s[1] - that.piece.s[0]);
                let opposite = closest(&arc_a, &arc_b, from, [held == 0, held == 1]);
                // An end of the overlap only if it is opposite the other piece.
                let foot = opposite.slope[1 - held].abs() <= 1e-6 * opposite.apart.norm().max(1e-3 * radii);
                let [p, q] = &opposite.points;
                let beside = p.tangent.cross(&q.tangent).norm_squared() < ALONG;
                let outwards = if end == 0 { opposite.slope[held] >= 0.0 } else { opposite.slope[held] <= 0.0 };
                let nearest = beside || (!continued && outwards);
                if nearest && foot && opposite.apart.norm() - radii <= self.within {
                    self.add(a, b, &opposite, side, found);
                }
            }
        }
    }

    /// The initial normal, if the centrelines have crossed since: the normal turned round, and they came closer than half the
    /// sum of the radii.
    fn side_kept(&self, a: &MovingPiece, b: &MovingPiece, near: &PointPair, motion: f64) -> Option<Vector3<f64>> {
        let kept = self.radii_at([a.along(near.s[0]), b.along(near.s[1])]).max(LEAST_KEPT * self.radii());
        let inside = CROSSED * kept;
        if near.apart.norm() > motion + inside {
            return None;
        }
        let arc_a = Arc { curve: self.a.start, element: a.piece.element as usize, s: a.piece.s };
        let arc_b = Arc { curve: self.b.start, element: b.piece.element as usize, s: b.piece.s };
        let chords = closest_of_segments([&a.start[0], &a.start[1]], [&b.start[0], &b.start[1]]);
        let before = closest(&arc_a, &arc_b, along_pieces([chords.t, chords.u], a, b), [false; 2]);
        let (distance, apart) = (before.apart.norm(), self.turned * before.apart);
        if distance < inside || distance > motion + inside || apart.dot(&near.apart) > 0.0 {
            return None;
        }
        // Whether the chords come near each other on the way; no time in which they could is skipped.
        let least = inside.min(0.5 * distance) + a.sagitta + b.sagitta;
        let mut t = 0.0;
        while t <= 1.0 {
            let (at_a, at_b) = (a.at(t), b.at(t));
            let gap = closest_of_segments([&at_a[0], &at_a[1]], [&at_b[0], &at_b[1]]).distance;
            if gap <= least {
                return Some(apart / distance);
            }
            t += ((gap - 0.5 * least) / motion).max(1e-3);
        }
        None
    }

    fn add(&self, a: &MovingPiece, b: &MovingPiece, near: &PointPair, side: Option<Vector3<f64>>, found: &mut Vec<Found>) {
        let along = [a.along(near.s[0]), b.along(near.s[1])];
        if self.a.index == self.b.index {
            // A rod of this radius cannot bend onto itself within half a turn.
            let half_turn = std::f64::consts::FRAC_PI_2 * self.radii();
            if (along[0] - along[1]).abs() < half_turn {
                return;
            }
        } else if along[0].max(along[1]) < self.held {
            return;
        }
        let now = direction(near);
        let points = [
            StrandPoint { strand: self.a.index, element: a.piece.element, s: near.s[0] },
            StrandPoint { strand: self.b.index, element: b.piece.element, s: near.s[1] },
        ];
        let side = side.filter(|side| !self.were_elsewhere(&points, side, &now));
        let normal = match side {
            Some(side) if side.dot(&now) <= 0.0 => side,
            _ => now,
        };
        let radii = self.radii_at(along);
        let gap = normal.dot(&near.apart) - radii;
        let crossed = side.is_some();
        if crossed || gap <= self.within {
            found.push(Found { points, normal, gap, radii, along, crossed });
        }
    }

    /// Whether two points were where they are `now` when the step began, and not on `side`: they have not crossed. (Strands
    /// wound round each other are on all sides of each other within a centimetre, and may have crossed beside.)
    fn were_elsewhere(&self, points: &[StrandPoint; 2], side: &Vector3<f64>, now: &Vector3<f64>) -> bool {
        let at = |path: &StrandPath, point: &StrandPoint| path.start.position(point.element as usize, point.s);
        let before = self.turned * (at(self.a, &points[0]) - at(self.b, &points[1]));
        before.dot(now) > 0.0 && before.dot(side) < 0.0
    }

    /// Contacts beside a crossing lie on the same side as it: their pieces may have come near after it.
    fn keep_sides_beside(&self, found: &mut [Found]) {
        for index in 0..found.len() {
            let Found { points, normal: now, gap, radii, along, crossed } = found[index];
            if crossed {
                continue;
            }
            let beside = found.iter().filter(|other| other.crossed).find(|other| {
                let off = |k: usize| (other.along[k] - along[k]).abs();
                off(0).max(off(1)) <= 2.0 * radii + (gap + radii).abs() && other.normal.dot(&now) < 0.0
            });
            let side = beside.map(|other| other.normal).filter(|side| !self.were_elsewhere(&points, side, &now));
            if let Some(side) = side {
                (found[index].normal, found[index].gap) = (side, (gap + radii) * now.dot(&side) - radii);
            }
        }
    }
}

/// The offsets between two pieces' chords where they are nearest, at the start of the step and now, where that is at `now` (0
/// to 1 along each).
fn offsets(a: &MovingPiece, b: &MovingPiece, now: [f64; 2]) -> [Vector3<f64>; 2] {
    let before = closest_of_segments([&a.start[0], &a.start[1]], [&b.start[0], &b.start[1]]);
    let apart = |a: &[Vector3<f64>; 2], b: &[Vector3<f64>; 2], [t, u]: [f64; 2]| a[0].lerp(&a[1], t) - b[0].lerp(&b[1], u);
    [apart(&a.start, &b.start, [before.t, before.u]), apart(&a.now, &b.now, now)]
}

/// The middle of the common length of the chords, on each, if it is no further apart than `farthest`.
fn middle_of_overlap(a: &MovingPiece, b: &MovingPiece, farthest: f64) -> Option<[f64; 2]> {
    let (line_a, line_b) = (a.now[1] - a.now[0], b.now[1] - b.now[0]);
    let (long_a, long_b) = (line_a.norm_squared().max(f64::MIN_POSITIVE), line_b.norm_squared().max(f64::MIN_POSITIVE));
    let ends = b.now.map(|end| (end - a.now[0]).dot(&line_a) / long_a);
    let (from, to) = (ends[0].min(ends[1]).max(0.0), ends[0].max(ends[1]).min(1.0));
    let t = 0.5 * (from + to);
    let at = a.now[0] + line_a * t;
    let u = ((at - b.now[0]).dot(&line_b) / long_b).clamp(0.0, 1.0);
    let distance = (at - b.now[0] - line_b * u).norm();
    (from < to && distance <= farthest).then_some([t, u])
}

fn along_pieces(t: [f64; 2], a: &MovingPiece, b: &MovingPiece) -> [f64; 2] {
    let of = |t: f64, s: [f64; 2]| s[0] + t * (s[1] - s[0]);
    [of(t[0], a.piece.s), of(t[1], b.piece.s)]
}

/// Whether the distance goes on falling beyond the end of a piece where its strand goes on: then the next piece has the
/// contact.
fn goes_on(near: &PointPair, which: usize, piece: &MovingPiece) -> bool {
    // Half a squared distance that falls by less than this is rounding: both pieces keep the point, and `merge` drops one of
    // the two.
    let slight = 1e-7 * near.apart.norm();
    let (s, slope) = (near.s[which], near.slope[which]);
    let [first, last] = piece.piece.s;
    (s <= first && slope > slight && piece.piece.continued[0]) || (s >= last && slope < -slight && piece.piece.continued[1])
}

/// Of contacts closer than `least` along both strands the one that crossed, or is deepest, stays. Sorted before and after.
fn merge(found: &mut Vec<Found>, least: f64) {
    let better = |x: &Found, y: &Found| (x.crossed && !y.crossed) || (x.crossed == y.crossed && x.gap < y.gap);
    let mut kept = 0;
    'each: for index in 0..found.len() {
        let this = found[index];
        for before in (0..kept).rev() {
            if this.along[0] - found[before].along[0] > least {
                break;
            }
            if (this.along[1] - found[before].along[1]).abs() <= least {
                if better(&this, &found[before]) {
                    // Removed and put at the end, where it belongs by arclength.
                    found.copy_within(before + 1..kept, before);
                    found[kept - 1] = this;
                }
                continue 'each;
            }
        }
        found[kept] = this;
        kept += 1;
    }
    found.truncate(kept);
}
