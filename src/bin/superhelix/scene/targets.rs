//! `targets`: curves to which strands are drawn, over time or as the strands start.

use std::path::Path;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::TargetDef;
use superhelix::io::Curves;
use superhelix::{Frame, Solver, StrandId};

use crate::groom::unit;
use crate::scene::SceneStrand;
use crate::scene::colliders::{file_complaint, path_of};
use crate::scene::pose::{Moves, read_pose, read_times};
use crate::scene::strands::named;
use crate::shell::json::{Complaint, Entries, Node};

/// Points of a curve that is a strand's own shape, per element and in all.
const POINTS_PER_ELEMENT: usize = 4;
const MOST_POINTS: usize = 257;

/// What some strands are drawn to.
#[derive(Debug)]
pub struct SceneTarget {
    strands: Vec<usize>,
    shape: Shape,
    weights: Vec<[f64; 2]>,
    time_constant: f64,
}

#[derive(Debug)]
enum Shape {
    /// As the strands start, rigidly with their roots.
    Start,
    /// Curves over time: straight and even between samples, held before the first and after the last.
    Sampled { times: Vec<f64>, samples: Vec<Vec<Vec<Vector3<f64>>>> },
}

/// Reads the list. `directory` is where the files are.
pub fn read(list: &Node, strands: &[SceneStrand], directory: &Path) -> Result<Vec<SceneTarget>, Complaint> {
    let mut targets: Vec<SceneTarget> = Vec::new();
    for node in list.list()? {
        let target = read_one(&node, strands, directory)?;
        let drawn = |strand| targets.iter().any(|other| other.strands.binary_search(strand).is_ok());
        if target.strands.iter().any(drawn) {
            return Err(node.complain("strands that no target before it draws"));
        }
        targets.push(target);
    }
    Ok(targets)
}

fn read_one(node: &Node, strands: &[SceneStrand], directory: &Path) -> Result<SceneTarget, Complaint> {
    let keys = ["strands", "weights", "time_constant", "times", "files", "points", "metres_per_unit", "every", "pose"];
    let entries = node.object(&keys)?;
    let drawn = match entries.get_unless_null("strands") {
        None => (0..strands.len()).collect(),
        Some(items) => named::of_items(items, strands)?,
    };
    let usual = TargetDef::default();
    let weights = entries.or("weights", usual.weights.to_vec(), |node| node.list()?.iter().map(Node::numbers).collect())?;
    let time_constant = entries.or("time_constant", usual.time_constant, Node::number)?;
    let shape = match entries.get("times") {
        None => {
            for key in ["files", "points", "metres_per_unit", "every", "pose"] {
                if let Some(node) = entries.get(key) {
                    return Err(node.complain("no such key without times: strands are drawn to the shape in which they start"));
                }
            }
            Shape::Start
        }
        Some(times) => read_samples(times, &entries, drawn.len(), directory)?,
    };
    let any = [Vector3::zeros(), Vector3::x()];
    let checked = TargetDef { points: &any, weights: &weights, time_constant, ..usual };
    checked.check(&node.key).map_err(|error| match error {
        superhelix::Error::InvalidArgument { argument, value, expected } => Complaint::value(argument, value, expected),
        other => Complaint::new(&node.key, other.to_string()),
    })?;
    Ok(SceneTarget { strands: drawn, shape, weights, time_constant })
}

fn read_samples(times_node: &Node, entries: &Entries, strands: usize, directory: &Path) -> Result<Shape, Complaint> {
    let times = read_times(times_node)?;
    if let (Some(_), Some(points)) = (entries.get("files"), entries.get("points")) {
        return Err(points.complain("no such key beside files"));
    }
    let list = entries.get("points").map_or_else(|| entries.require("files"), Ok)?;
    let items = list.list()?;
    if times.is_empty() || items.len() != times.len() {
        let expected = format!("as many as times has ({}), at least one", times.len());
        return Err(Complaint::value(&list.key, format!("a list of {}", items.len()), expected));
    }
    let flag = entries.get("metres_per_unit").map(Node::positive).transpose()?;
    let every = entries.or("every", 1, |node| node.whole(1..=u64::from(u32::MAX)))? as usize;
    let pose = entries.or("pose", Frame::default(), read_pose)?;
    let mut samples: Vec<Vec<Vec<Vector3<f64>>>> = Vec::with_capacity(items.len());
    for item in &items {
        let mut curves: Vec<Vec<Vector3<f64>>> = if item.value.is_string() {
            let file = Curves::read(path_of(item, directory)?).map_err(|error| file_complaint(item, &error))?;
            let missing = || Complaint::new(entries.path("metres_per_unit"), "is missing, and the file does not say its unit");
            let scale = unit::stated(flag, &file).ok_or_else(missing)?;
            unit::drawn(&file, every, scale).into_iter().map(|curve| curve.points).collect()
        } else {
            let curve =
                |node: &Node| node.list()?.iter().map(|point| point.numbers().map(|at: [f64; 3]| Vector3::from(at))).collect();
            item.list()?.iter().map(curve).collect::<Result<_, _>>()?
        };
        curves.iter_mut().flatten().for_each(|point| *point = pose.origin + pose.rotation * *point);
        if curves.len() != strands {
            let expected = format!("{strands}, one for each strand");
            return Err(Complaint::value(&item.key, format!("of {} curves", curves.len()), expected));
        }
        for (number, curve) in curves.iter().enumerate() {
            let points = samples.first().map_or(curve.len(), |first| first[number].len());
            let length: f64 = curve.windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum();
            if curve.len() < 2 || curve.len() != points || !(length > 0.0 && length.is_finite()) {
                let expected = "2 points or more, the same number at all times, not all at one place";
                return Err(Complaint::value(&item.key, format!("a curve {number} of {} points", curve.len()), expected));
            }
        }
        samples.push(curves);
    }
    Ok(Shape::Sampled { times, samples })
}

/// The curves at a time.
fn between(times: &[f64], samples: &[Vec<Vec<Vector3<f64>>>], time: f64) -> Vec<Vec<Vector3<f64>>> {
    let next = times.partition_point(|sample| *sample <= time);
    let (Some(before), Some(after)) = (next.checked_sub(1), times.get(next)) else {
        return samples[next.min(samples.len() - 1)].clone();
    };
    let share = (time - times[before]) / (after - times[before]);
    let mix = |(from, to): (&Vector3<f64>, &Vector3<f64>)| from + (to - from) * share;
    let curve = |(from, to): (&Vec<Vector3<f64>>, &Vec<Vector3<f64>>)| from.iter().zip(to).map(mix).collect();
    samples[before].iter().zip(&samples[next]).map(curve).collect()
}

/// The direction in which a curve leaves its root.
fn direction(curve: &[Vector3<f64>]) -> Vector3<f64> {
    curve.iter().map(|point| point - curve[0]).find(|edge| edge.norm() > 0.0).unwrap_or_else(Vector3::x)
}

impl SceneTarget {
    /// The strands that it draws.
    pub fn strands(&self) -> &[usize] {
        &self.strands
    }

    /// Puts roots that have no motion of their own where the curves are at the start.
    pub fn place(&self, strands: &mut [SceneStrand]) {
        let Shape::Sampled { times, samples } = &self.shape else { return };
        let curves = between(times, samples, 0.0);
        for (k, strand) in self.strands.iter().enumerate() {
            let strand = &mut strands[*strand];
            if strand.motion.is_some() {
                continue;
            }
            strand.definition.root = follow(&strand.definition.root, &samples[0][k], &curves[k]);
        }
    }
}

/// Where the root of a strand is whose curve goes from one to another: it moves and turns with the curve's beginning.
fn follow(root: &Frame, from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Frame {
    let turn = UnitQuaternion::rotation_between(&direction(from), &direction(to)).unwrap_or_default();
    Frame { origin: to[0] + turn * (root.origin - from[0]), rotation: turn * root.rotation }
}

/// A target of a scene whose strands are in a solver.
pub struct DrawnStrands<'a> {
    target: &'a SceneTarget,
    /// Strands whose roots follow their curves, by their places among the target's, and the roots when the curves are at their first sample.
    roots: Vec<(usize, Frame)>,
    /// The strands' curves in the axes of their roots, where they are drawn to the shape in which they start.
    local: Vec<Vec<Vector3<f64>>>,
}

impl<'a> DrawnStrands<'a> {
    /// The solver holds the strands of the scene, `ids`, as they start.
    pub fn new(target: &'a SceneTarget, strands: &[SceneStrand], ids: &[StrandId], solver: &Solver) -> superhelix::Result<Self> {
        let (mut roots, mut local) = (Vec::new(), Vec::new());
        match &target.shape {
            Shape::Start => {
                for id in target.strands.iter().map(|strand| &ids[*strand]) {
                    let inverse = solver.root_frame(*id)?.inverse();
                    let count = (POINTS_PER_ELEMENT * solver.curvatures(*id)?.len() + 1).min(MOST_POINTS);
                    let mut curve = Vec::with_capacity(count);
                    solver.sample_strands(&[*id], count, |_, _, sample| {
                        curve.push(inverse.origin + inverse.rotation * sample.position);
                    })?;
                    local.push(curve);
                }
            }
            Shape::Sampled { times, samples } => {
                let curves = between(times, samples, 0.0);
                let free = target.strands.iter().map(|strand| &strands[*strand]).enumerate();
                for (k, strand) in free.filter(|(_, strand)| strand.motion.is_none()) {
                    roots.push((k, follow(&strand.definition.root, &curves[k], &samples[0][k])));
                }
            }
        }
        Ok(Self { target, roots, local })
    }

    /// Puts the targets of the scene's strands, `ids`, where they are at the start.
    pub fn begin(&self, solver: &mut Solver, strands: &[SceneStrand], ids: &[StrandId]) -> superhelix::Result<()> {
        let curves = self.curves(0.0, solver, strands, ids)?;
        self.set(solver, ids, &curves, 0.0)
    }

    /// Sends them, and the roots that follow them, to where they are at a time, `over_seconds` from now.
    pub fn send(
        &self,
        solver: &mut Solver,
        strands: &[SceneStrand],
        ids: &[StrandId],
        time: f64,
        over_seconds: f64,
    ) -> superhelix::Result<()> {
        let curves = self.curves(time, solver, strands, ids)?;
        if let Shape::Sampled { samples, .. } = &self.target.shape {
            let own = |k: usize| ids[self.target.strands[k]];
            let moved = |(k, root): &(usize, Frame)| (own(*k), follow(root, &samples[0][*k], &curves[*k]));
            let (ids, frames): (Vec<StrandId>, Vec<Frame>) = self.roots.iter().map(moved).unzip();
            solver.set_root_frames(&ids, &frames, over_seconds)?;
        }
        self.set(solver, ids, &curves, over_seconds)
    }

    fn curves(
        &self,
        time: f64,
        solver: &Solver,
        strands: &[SceneStrand],
        ids: &[StrandId],
    ) -> superhelix::Result<Vec<Vec<Vector3<f64>>>> {
        if let Shape::Sampled { times, samples } = &self.target.shape {
            return Ok(between(times, samples, time));
        }
        let mut curves = Vec::with_capacity(self.local.len());
        for (index, local) in self.target.strands.iter().zip(&self.local) {
            let root = match &strands[*index].motion {
                Some(motion) => motion.at(time),
                None => solver.root_frame(ids[*index])?,
            };
            curves.push(local.iter().map(|point| root.origin + root.rotation * point).collect());
        }
        Ok(curves)
    }

    fn set(
        &self,
        solver: &mut Solver,
        ids: &[StrandId],
        curves: &[Vec<Vector3<f64>>],
        over_seconds: f64,
    ) -> superhelix::Result<()> {
        let SceneTarget { strands, weights, time_constant, .. } = self.target;
        let def = |points| TargetDef { points, weights, time_constant: *time_constant, ..TargetDef::default() };
        let defs: Vec<TargetDef> = curves.iter().map(|curve| def(curve)).collect();
        let drawn: Vec<StrandId> = strands.iter().map(|strand| ids[*strand]).collect();
        solver.set_targets(&drawn, &defs, over_seconds)
    }
}
