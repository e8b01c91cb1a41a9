//! A groom of a thousand guides as default wisps, and a comb that goes down its side.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::editing::Stiffening;
use superhelix::hair::{FitCurve, FitOptions, FitScratch, fit_curve};
use superhelix::io::Curves;
use superhelix::{BodyDef, BodyId, Frame, Material, Shape, Solver, SolverOptions, StrandContact, StrandDef, Wisp, Workers};

const TEETH: usize = 7;

/// Every `every`-th guide of `fibermesh_1k.tfx`, and the comb beside it.
pub fn combed(every: usize, elements: usize, threads: usize) -> (Solver, Vec<BodyId>) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/grooms/fibermesh_1k.tfx");
    let curves = Curves::read(path).expect("a groom");
    let points: Vec<_> = curves.points().iter().map(|point| 0.0012 * Vector3::from(point.map(f64::from))).collect();
    let (mut defs, mut scratch, mut rest) = (Vec::new(), FitScratch::default(), &points[..]);
    let wisp = Wisp::default();
    let hair = Material { internal_friction: 1e-10, air_drag: 5e-6, ..Material::default() };
    let material = wisp.material(&hair).expect("a wisp");
    for (index, count) in curves.counts().iter().enumerate() {
        let (strand, others) = rest.split_at(*count as usize);
        rest = others;
        if index % every == 0 {
            let curve = FitCurve::polyline(strand);
            let fit = fit_curve(&curve, &FitOptions::elements(elements), &mut scratch).expect("a fit");
            defs.push(StrandDef {
                element_lengths: fit.element_lengths,
                material,
                root: fit.root,
                natural: fit.curvatures,
                ..StrandDef::straight(1.0, 1)
            });
        }
    }
    let workers = if threads > 1 { Workers::Pool(threads) } else { Workers::default() };
    let gravity = Vector3::new(0.0, -9.81, 0.0);
    let mut solver = Solver::new(SolverOptions { gravity, workers, ..SolverOptions::default() }).expect("a solver");
    let ids = solver.add_strands(&defs).expect("strands");
    solver.take_rest_shapes(&ids).expect("rest shapes");
    solver.stiffen(&ids, Stiffening::YoungsModulus, wisp.margin().expect("a hold")).expect("stable shapes");
    let contact = StrandContact { radius: material.radius[0], exempt_length: 2e-3, ..StrandContact::default() };
    solver.set_contact(&ids, Some(&contact)).expect("contact");
    let tooth = |k: usize| {
        let z = 6e-3 * (k as f64 - 0.5 * (TEETH - 1) as f64);
        let shape = Shape::new_capsule(Vector3::new(0.04, 0.0, z), Vector3::new(0.0, 0.0, z), 1e-3).expect("a tooth");
        BodyDef { pose: stroke(0.0), ..BodyDef::new(Arc::new(shape)) }
    };
    let teeth = solver.add_bodies((0..TEETH).map(tooth).collect()).expect("teeth");
    (solver, teeth)
}

fn smooth(part: f64) -> f64 {
    0.5 * (1.0 - (PI * part.clamp(0.0, 1.0)).cos())
}

/// In from the side within half a second, down by 15 cm in two, out, and back up: over and over, every four seconds.
pub fn stroke(t: f64) -> Frame {
    let t = t.rem_euclid(4.0);
    let within = smooth(t / 0.5) * (1.0 - smooth((t - 2.5) / 0.4));
    let down = smooth((t - 0.5) / 2.0) * (1.0 - smooth((t - 2.9) / 1.0));
    Frame { origin: Vector3::new(0.14 - 0.062 * within, 0.03 - 0.15 * down, 0.0), ..Frame::default() }
}
