//! Invariants of a strand in any state, measured from outside.

use nalgebra::{Matrix3, Vector3};
use superhelix::internals::math::vector::{Mat3, Vec3};
use superhelix::internals::rod::kinematics::element_state;
use superhelix::{Solver, SolverOptions, StrandDef, StrandId};

use crate::draw::Case;

/// How whole a strand is: the worst of what was seen.
#[derive(Clone, Copy, Debug, Default)]
pub struct Whole {
    /// |chord of an element − that of a helix of its curvature and length|, in the element's length; and of sampled points, in L.
    pub stretch: f64,
    /// Largest entry of RᵀR − 1 of an element's frame, and | |q| − 1 | of a sample.
    pub skew: f64,
}

impl Whole {
    pub fn worsen(&mut self, other: &Whole) {
        // Written so that what is not a number is not lost.
        for (mine, theirs) in [(&mut self.stretch, other.stretch), (&mut self.skew, other.skew)] {
            *mine = if theirs <= *mine { *mine } else { theirs };
        }
    }
}

/// Chord of a helix of curvatures κ over the length ℓ: along its axis ℓ cos β, across it the chord of a circle; cos β = κ0/|κ|.
fn helix_chord(kappa: [f64; 3], length: f64) -> f64 {
    let total = (kappa[0].powi(2) + kappa[1].powi(2) + kappa[2].powi(2)).sqrt();
    let half = 0.5 * total * length;
    if half < 1e-8 {
        return length;
    }
    let (cosine, sine) = (kappa[0] / total, (kappa[1].powi(2) + kappa[2].powi(2)).sqrt() / total);
    length * (cosine.powi(2) + (sine * half.sin() / half).powi(2)).sqrt()
}

/// Measures a strand: elements by their kinematics, and points as a host samples them.
pub fn whole(solver: &Solver, id: StrandId) -> Whole {
    let lengths = solver.element_lengths(id).unwrap();
    let curvatures = solver.curvatures(id).unwrap();
    let root = solver.root_frame(id).unwrap();
    let mut worst = Whole::default();
    let mut frame = Mat3::from(root.rotation.to_rotation_matrix().into_inner());
    let (mut origin, mut arclength) = (Vec3::zero(), 0.0);
    let mut ends = vec![0.0];
    for (length, row) in lengths.iter().zip(curvatures) {
        let element = element_state(Vec3(*row), *length, frame, origin);
        let chord = element.frame_left.apply(element.end).norm_squared().sqrt();
        let matrix: Matrix3<f64> = element.frame_right().into();
        let skew = (matrix.transpose() * matrix - Matrix3::identity()).amax();
        worst.worsen(&Whole { stretch: (chord - helix_chord(*row, *length)).abs() / length, skew });
        (frame, origin) = (element.frame_right(), element.origin_right());
        arclength += length;
        ends.push(arclength);
    }
    let mut points: Vec<Vector3<f64>> = Vec::with_capacity(ends.len());
    solver
        .sample_at(id, &ends, |_, sample| {
            assert!(sample.velocity.iter().all(|v| v.is_finite()), "a velocity is not finite");
            worst.worsen(&Whole { stretch: 0.0, skew: (sample.rotation.as_ref().norm() - 1.0).abs() });
            points.push(sample.position - root.origin);
        })
        .unwrap();
    for (element, pair) in points.windows(2).enumerate() {
        let off = ((pair[1] - pair[0]).norm() - helix_chord(curvatures[element], lengths[element])).abs();
        // Far from the world's origin a sample has the digits that are left there.
        let rounding = 1e-15 * root.origin.norm();
        worst.worsen(&Whole { stretch: (off - rounding).max(0.0) / arclength, skew: 0.0 });
    }
    worst
}

/// Takes the strand's present shape and rates through one step of the case, and again with 300 iterations at 1e-10 rad: if the first
/// said that it had converged, how far its points are from the second's, in L.
pub fn honesty(solver: &Solver, id: StrandId, case: &Case) -> Option<f64> {
    let def = StrandDef {
        root: solver.root_frame(id).unwrap(),
        initial: Some(solver.curvatures(id).unwrap().to_vec()),
        initial_rates: Some(solver.rates(id).unwrap().to_vec()),
        ..case.def.clone()
    };
    let stepped = |max_iterations: u32, tolerance: f64| {
        let mut options =
            SolverOptions { gravity: solver.options().gravity, wind: solver.options().wind, ..SolverOptions::default() };
        options.step.integrator = case.integrator;
        (options.step.max_iterations, options.step.tolerance) = (max_iterations, tolerance);
        // In parts the step would be another one.
        options.step.max_subdivisions = 0;
        let mut twin = Solver::new(options).unwrap();
        let twin_id = twin.add_strands(std::slice::from_ref(&def)).unwrap()[0];
        let report = twin.step(case.h, 1).unwrap();
        let mut points = Vec::new();
        twin.sample_strands(&[twin_id], 9, |_, _, sample| points.push(sample.position)).unwrap();
        (report, points)
    };
    let (report, points) = stepped(case.max_iterations, case.tolerance);
    if report.unconverged > 0 || report.quarantined > 0 {
        return None;
    }
    assert!(report.max_residual <= case.tolerance, "converged at {} rad of {}", report.max_residual, case.tolerance);
    let (_, exact) = stepped(300, 1e-10);
    let furthest = points.iter().zip(&exact).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    Some(furthest / case.def.length())
}
