//! Where strands cross a blade or the surface swept by a tooth, and which parts of them are in a box.

use nalgebra::Vector3;

use crate::contact::contact_point::StrandCurve;
use crate::error::Result;
use crate::math::frame::Frame;
use crate::rod::kinematics::{ElementState, element_states};
use crate::rod::strand::place_on;
use crate::solver::Solver;
use crate::solver::id::StrandId;
use crate::solver::reading::sampling::material_rotation;
use crate::solver::strands::strand::Strand;
use crate::step::state::rotation_matrix;

/// A strand is divided into chords that turn by at most this, rad, and are at most this long, m.
const TURN: f64 = 0.1;
const CHORD: f64 = 1e-3;
/// Bisections of a chord: from 1 mm to a picometre.
const HALVINGS: usize = 30;

/// A strand's current curve, world.
pub(super) struct Curve {
    origin: Vector3<f64>,
    elements: Vec<ElementState<f64>>,
}

/// A place on it: the element, and the arclengths on the element and from the root, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct CurvePlace {
    pub element: usize,
    pub s: f64,
    pub along: f64,
}

impl Curve {
    pub fn of(strand: &Strand) -> Self {
        let mut elements = Vec::new();
        let state = &strand.state;
        element_states(rotation_matrix(&state.root), strand.model.lengths.iter().copied(), &state.curvatures, &mut elements);
        Self { origin: state.root.origin, elements }
    }

    pub fn position(&self, place: CurvePlace) -> Vector3<f64> {
        StrandCurve { origin: self.origin, elements: &self.elements }.position(place.element, place.s)
    }

    /// The material frame there, world.
    pub fn frame(&self, place: CurvePlace) -> Frame {
        let element = &self.elements[place.element];
        Frame { origin: self.position(place), rotation: material_rotation(element, &element.point(place.s)) }
    }

    /// Its chords from root to tip, by their ends.
    fn chords(&self) -> impl Iterator<Item = [CurvePlace; 2]> {
        let mut along = 0.0;
        self.elements.iter().enumerate().flat_map(move |(element, state)| {
            let start = along;
            along += state.length;
            let turned = state.kappa_squared.sqrt() * state.length;
            let count = (turned / TURN).max(state.length / CHORD).ceil().max(1.0);
            let place = move |k: f64| {
                let s = if k == count { state.length } else { state.length * k / count };
                CurvePlace { element, s, along: start + s }
            };
            (0..count as usize).map(move |k| [place(k as f64), place(k as f64 + 1.0)])
        })
    }

    /// The place between two places of one element at which `side` changes sign.
    fn between(&self, [mut from, mut to]: [CurvePlace; 2], side: impl Fn(&Vector3<f64>) -> f64) -> CurvePlace {
        let sign = side(&self.position(from)) > 0.0;
        for _ in 0..HALVINGS {
            let middle = CurvePlace { s: 0.5 * (from.s + to.s), along: 0.5 * (from.along + to.along), ..from };
            if (side(&self.position(middle)) > 0.0) == sign { from = middle } else { to = middle }
        }
        to
    }

    /// The crossing nearest to the root with a quad whose corners are in order (two triangles if it is not flat), beyond
    /// arclength `beyond`.
    pub fn first_crossing(&self, corners: &[Vector3<f64>; 4], beyond: f64) -> Option<CurvePlace> {
        let length: f64 = self.elements.iter().map(|element| element.length).sum();
        let middle = corners.iter().sum::<Vector3<f64>>() / 4.0;
        let radius = corners.iter().map(|corner| (corner - middle).norm()).fold(0.0, f64::max);
        if (middle - self.origin).norm() > length + radius {
            return None;
        }
        let triangles = [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]];
        self.chords().filter(|[_, to]| to.along > beyond).find_map(|chord| {
            let ends = chord.map(|place| self.position(place));
            let hits = triangles.iter().filter_map(|triangle| {
                let normal = (triangle[1] - triangle[0]).cross(&(triangle[2] - triangle[0]));
                let side = |point: &Vector3<f64>| normal.dot(&(point - triangle[0]));
                if (side(&ends[0]) > 0.0) == (side(&ends[1]) > 0.0) {
                    return None;
                }
                let place = self.between(chord, side);
                let point = self.position(place);
                let inside = (0..3).all(|k| {
                    let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                    (b - a).cross(&(point - a)).dot(&normal) >= -1e-9 * normal.norm_squared()
                });
                (inside && place.along > beyond).then_some(place)
            });
            hits.min_by(|a, b| a.along.total_cmp(&b.along))
        })
    }

    /// The stretches in a box: `half_edges` about the frame's origin, along its axes.
    pub fn stretches_in(&self, frame: &Frame, half_edges: &Vector3<f64>) -> Vec<[CurvePlace; 2]> {
        let length: f64 = self.elements.iter().map(|element| element.length).sum();
        if (frame.origin - self.origin).norm() > length + half_edges.norm() {
            return Vec::new();
        }
        // Above zero outside.
        let side = |point: &Vector3<f64>| {
            let local = frame.rotation.inverse_transform_vector(&(point - frame.origin));
            (local.abs() - half_edges).max()
        };
        let mut out: Vec<[CurvePlace; 2]> = Vec::new();
        let mut open: Option<CurvePlace> = None;
        let mut last = None;
        for chord in self.chords() {
            let [from, to] = chord.map(|place| side(&self.position(place)) <= 0.0);
            if from && open.is_none() {
                open = Some(chord[0]);
            }
            match (from, to) {
                (false, true) => open = Some(self.between(chord, side)),
                (true, false) => out.extend(open.take().map(|open| [open, self.between(chord, side)])),
                _ => {}
            }
            last = Some(chord[1]);
        }
        out.extend(open.zip(last).map(|(open, last)| [open, last]));
        out
    }

    /// Points on it at most a chord apart, including root and tip.
    pub fn points(&self) -> impl Iterator<Item = Vector3<f64>> {
        [self.origin].into_iter().chain(self.chords().map(|[_, to]| self.position(to)))
    }

    /// The place at an arclength.
    pub fn place(&self, along: f64) -> CurvePlace {
        let (element, s) = place_on(self.elements.iter().map(|element| element.length), along);
        CurvePlace { element, s, along }
    }

    /// Its distance to the segment from `a` to `b`, by points at most a chord apart.
    pub fn distance_to_segment(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
        let segment = b - a;
        self.points().fold(f64::INFINITY, |least, point| {
            let t = ((point - a).dot(&segment) / segment.norm_squared()).clamp(0.0, 1.0);
            least.min((point - a - segment * t).norm())
        })
    }
}

/// The crossing of a strand with one of several quads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crossing {
    pub quad: usize,
    /// Arclength from the root, m.
    pub arclength: f64,
    /// World.
    pub position: Vector3<f64>,
}

impl Solver {
    /// Each strand's crossing with one of the quads, nearest to its root and beyond arclength `beyond`.
    pub(crate) fn first_crossings(
        &self,
        ids: &[StrandId],
        quads: &[[Vector3<f64>; 4]],
        beyond: f64,
    ) -> Result<Vec<Option<Crossing>>> {
        let crossing = |index: usize| {
            let strand = &self.strands[index];
            let (root, length) = (strand.state.root.origin, strand.model.length());
            let in_reach = |quad: &[Vector3<f64>; 4]| {
                let size = (quad[2] - quad[0]).norm().max((quad[3] - quad[1]).norm());
                quad.iter().any(|corner| (corner - root).norm() <= length + size)
            };
            if !quads.iter().any(in_reach) {
                return None;
            }
            let curve = Curve::of(strand);
            let hits = quads.iter().enumerate().filter(|(_, quad)| in_reach(quad));
            let hits = hits.filter_map(|(quad, corners)| Some((quad, curve.first_crossing(corners, beyond)?)));
            let (quad, place) = hits.min_by(|a, b| a.1.along.total_cmp(&b.1.along))?;
            Some(Crossing { quad, arclength: place.along, position: curve.position(place) })
        };
        Ok(self.indices(ids)?.into_iter().map(crossing).collect())
    }

    /// Distance of each strand from the nearest of the segments, m; infinity for a nonexistent strand.
    pub(crate) fn distances_to_segments(&self, ids: &[StrandId], segments: &[[Vector3<f64>; 2]]) -> Vec<f64> {
        let distance = |id: &StrandId| {
            let Some(index) = self.slots.index(*id) else { return f64::INFINITY };
            let curve = Curve::of(&self.strands[index]);
            segments.iter().map(|[a, b]| curve.distance_to_segment(a, b)).fold(f64::INFINITY, f64::min)
        };
        ids.iter().map(distance).collect()
    }
}
