//! The cost of detecting contacts between hairs: a real groom fitted with ten elements per strand, 1,000 strands and copies of it
//! side by side, with radii that give few or many contacts. Prints a table. `cargo run --profile demo --example hair_pairs`.

use std::path::Path;
use std::time::Instant;

use nalgebra::{Matrix3, Rotation3, Vector3};
use superhelix::hair::{FitOptions, fit_polyline};
use superhelix::internals::contact::broad_phase::hair_pairs::{HairPairs, HeldRoots, PairOptions};
use superhelix::internals::contact::broad_phase::pieces::Wisp;
use superhelix::internals::contact::contact_point::{StrandCurve, StrandPath};
use superhelix::internals::contact::narrow_phase::strand_contacts::PairScratch;
use superhelix::internals::math::quadrature::Rule;
use superhelix::internals::math::vector::Mat3;
use superhelix::internals::rod::kinematics::Kinematics;
use superhelix::io::Curves;

/// A fitted strand.
struct Strand {
    origin: Vector3<f64>,
    root: Matrix3<f64>,
    lengths: Vec<f64>,
    curvatures: Vec<[f64; 3]>,
}

fn groom() -> Vec<Strand> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/grooms/fibermesh_1k.tfx");
    let curves = Curves::read(path).expect("the groom is part of the repository");
    let fitted = curves.strands().map(|strand| {
        let points: Vec<Vector3<f64>> =
            strand.iter().map(|p| Vector3::new(p[0].into(), p[1].into(), p[2].into()) * 0.0012).collect();
        let fit = fit_polyline(&points, &FitOptions::elements(10)).expect("a strand of the groom");
        Strand {
            origin: fit.root.origin,
            root: fit.root.rotation.to_rotation_matrix().into_inner(),
            lengths: fit.element_lengths,
            curvatures: fit.curvatures,
        }
    });
    fitted.collect()
}

/// The strands bent by an additional `bent` rad/m, varying from strand to strand, and turned with the head by `turned` rad.
fn posed(strands: &[Strand], bent: f64, turned: f64) -> Vec<Kinematics<f64>> {
    let rule = Rule::gauss_legendre(1);
    let head = Rotation3::from_axis_angle(&Vector3::y_axis(), turned);
    let pose = |(index, strand): (usize, &Strand)| {
        let mut kinematics = Kinematics::default();
        let bend = bent * (0.1 * index as f64).sin();
        let rows: Vec<[f64; 3]> = strand.curvatures.iter().map(|[k0, k1, k2]| [*k0, k1 + bend, k2 - bend]).collect();
        kinematics.update(&Mat3::from(head.into_inner() * strand.root), &strand.lengths, &rows, &rule);
        kinematics
    };
    strands.iter().enumerate().map(pose).collect()
}

fn main() {
    let groom = groom();
    println!(
        "| strands | radius, mm | margin, mm | pieces | candidates | groups | touches | search, ms | look again, ms | touches, ms |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for copies in [1, 3, 10] {
        let strands: Vec<Strand> = (0..copies)
            .flat_map(|copy| {
                groom.iter().map(move |strand| Strand {
                    origin: strand.origin + Vector3::new(0.5 * f64::from(copy), 0.0, 0.0),
                    root: strand.root,
                    lengths: strand.lengths.clone(),
                    curvatures: strand.curvatures.clone(),
                })
            })
            .collect();
        let (then, now) = (posed(&strands, 0.0, 0.0), posed(&strands, 0.02, 0.0));
        let paths: Vec<StrandPath> = (0..strands.len())
            .map(|index| StrandPath {
                index: index as u32,
                start: StrandCurve { origin: strands[index].origin, elements: &then[index].elements },
                now: StrandCurve { origin: strands[index].origin, elements: &now[index].elements },
                permitted_overlap: None,
            })
            .collect();
        for (radius, margin) in [(0.5e-3, 1e-3), (1e-3, 0.5e-3), (1e-3, 1e-3), (1e-3, 2e-3), (2e-3, 1e-3)] {
            let wisps = vec![Wisp { radius, exempt: 0.01, ..Wisp::default() }; strands.len()];
            let mut pairs = HairPairs::default();
            let (mut search, mut again, mut narrow, mut count) = (f64::INFINITY, f64::INFINITY, f64::INFINITY, 0);
            let (mut scratch, mut contacts) = (PairScratch::default(), Vec::new());
            for _ in 0..5 {
                pairs
                    .set(&wisps, &PairOptions { activation: 0.2e-3, margin, held_roots: HeldRoots::Ignored })
                    .expect("the options are in range");
                pairs.begin_step();
                let clock = Instant::now();
                assert!(pairs.update(&paths).expect("as many paths as wisps"));
                search = search.min(clock.elapsed().as_secs_f64());
                let clock = Instant::now();
                assert!(!pairs.update(&paths).expect("as many paths as wisps"));
                again = again.min(clock.elapsed().as_secs_f64());
                let clock = Instant::now();
                contacts.clear();
                for group in pairs.groups() {
                    pairs.contacts(group, &paths, f64::INFINITY, &mut scratch, &mut contacts);
                }
                narrow = narrow.min(clock.elapsed().as_secs_f64());
                count = contacts.len();
            }
            let counts = pairs.counts();
            println!(
                "| {} | {} | {} | {} | {} | {} | {count} | {:.2} | {:.2} | {:.2} |",
                strands.len(),
                1e3 * radius,
                1e3 * margin,
                counts.pieces,
                counts.candidates,
                counts.groups,
                1e3 * search,
                1e3 * again,
                1e3 * narrow
            );
        }
    }
}
