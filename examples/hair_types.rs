//! Types of hair before and after settling: the natural shapes of a lock of each, and its rest under gravity; and the effect of
//! the sliders on hair at rest.
//!
//! `cargo run --profile demo --example hair_types -- docs/figures` writes docs/figures/hair_types.csv and hair_sliders.csv, the tables of
//! docs/theory/hair_types.md.

use std::fmt::Write as _;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::EquilibriumOptions;
use superhelix::hair::{CurlFormula, HairParameters, HairType, Sliders, Variation};
use superhelix::{Frame, Solver, SolverOptions, StrandDef};

/// Length of the locks, m, and sampled points per strand.
const LENGTH: f64 = 0.15;
const POINTS: usize = 120;

/// The points of the strands of a lock.
type Lock = Vec<Vec<Vector3<f64>>>;

/// Strands of a type with their roots on a small disc, leaving along `direction`: the points of each before and after settling,
/// and how many did not converge.
fn lock(hair: &HairParameters, strands: u32, length: f64, direction: Vector3<f64>) -> (Lock, Lock, usize) {
    // Four elements per turn, at least 24.
    let curvature = hair.natural.iter().map(|value| value * value).sum::<f64>().sqrt();
    let elements = ((4.0 * length * curvature / std::f64::consts::TAU).ceil() as usize).max(24);
    let frame = UnitQuaternion::rotation_between(&Vector3::x(), &direction).expect("a direction that is not straight back");
    let definitions: Vec<StrandDef> = (0..strands)
        .map(|index| {
            let lengths = vec![length / elements as f64; elements];
            let varied = hair.strand(u64::from(index), &lengths).expect("parameters in range");
            let (radius, angle) = (0.6e-3 * f64::from(index).sqrt(), 2.399_963_229_728_653 * f64::from(index));
            let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), varied.root_turn);
            StrandDef {
                element_lengths: lengths,
                material: varied.material,
                natural: varied.natural,
                root: Frame {
                    origin: frame * Vector3::new(0.0, radius * angle.cos(), radius * angle.sin()),
                    rotation: frame * turn,
                },
                ..StrandDef::straight(1.0, 1)
            }
        })
        .collect();
    let mut solver = Solver::new(SolverOptions::default()).expect("a solver");
    let ids = solver.add_strands(&definitions).expect("strands");
    let sample = |solver: &Solver| {
        let mut points = vec![vec![Vector3::zeros(); POINTS]; ids.len()];
        solver.sample_strands(&ids, POINTS, |strand, point, sample| points[strand][point] = sample.position).expect("samples");
        points
    };
    let before = sample(&solver);
    let found = solver.settle(&ids, &EquilibriumOptions::default()).expect("a search");
    (before, sample(&solver), found.iter().filter(|strand| !strand.converged).count())
}

/// The mean distance from root to tip, in lengths.
fn span(strands: &[Vec<Vector3<f64>>], length: f64) -> f64 {
    strands.iter().map(|points| (points[POINTS - 1] - points[0]).norm()).sum::<f64>() / (strands.len() as f64 * length)
}

/// The root mean square distance of the tips from their centroid, relative to the roots, m.
fn spread(strands: &[Vec<Vector3<f64>>]) -> f64 {
    let tips: Vec<Vector3<f64>> = strands.iter().map(|points| points[POINTS - 1] - points[0]).collect();
    let middle = tips.iter().sum::<Vector3<f64>>() / tips.len() as f64;
    (tips.iter().map(|tip| (tip - middle).norm_squared()).sum::<f64>() / tips.len() as f64).sqrt()
}

fn main() {
    let figures = std::env::args().nth(1).expect("a directory");
    let mut table = String::from(
        "type,a1_um,a2_um,modulus_gpa,ei0,ei1,ei2,twist,curvature,paper_twist,paper_curvature,span_natural,span_rest,droop,unsettled\n",
    );
    for kind in HairType::ALL {
        let measured = kind.measured();
        let alike = measured.parameters(CurlFormula::Exact).expect("a published type");
        let hair = HairParameters { variation: Variation::natural(), ..alike };
        let (before, after, unsettled) = lock(&hair, 16, LENGTH, -Vector3::z());
        // 5 cm of one strand without variation that leaves its root horizontally.
        let (_, level, lost) = lock(&alike, 1, 0.05, Vector3::x());
        let droop = -(level[0][POINTS - 1] - level[0][0]).z / 0.05;
        let [a1, a2] = measured.semi_axes();
        let [ei0, ei1, ei2] = alike.material.stiffness();
        let paper = measured.natural(CurlFormula::Paper);
        let _ = writeln!(
            table,
            "{},{:.2},{:.2},{:.3},{ei0:.3e},{ei1:.3e},{ei2:.3e},{:.1},{:.1},{:.1},{:.1},{:.3},{:.3},{droop:.3},{}",
            kind.name(),
            1e6 * a1,
            1e6 * a2,
            1e-9 * measured.youngs_modulus,
            alike.natural[0],
            alike.natural[1],
            paper[0],
            paper[1],
            span(&before, LENGTH),
            span(&after, LENGTH),
            unsettled + lost
        );
    }
    std::fs::write(format!("{figures}/hair_types.csv"), table).expect("the table is written");

    let mut table = String::from("slider,type,measure,minus_1,minus_half,zero,half,one\n");
    let mut sweep = |slider: &str, kind: HairType, measure: &str, of: &dyn Fn(&HairParameters) -> f64| {
        let hair =
            HairParameters { variation: Variation::natural(), ..kind.measured().parameters(CurlFormula::Exact).expect("a type") };
        let _ = write!(table, "{slider},{},{measure}", kind.name());
        for x in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            let mut sliders = Sliders::default();
            match slider {
                "curliness" => sliders.curliness = x,
                "stiffness" => sliders.stiffness = x,
                "discipline" => sliders.discipline = x,
                _ => sliders.weight = x,
            }
            let _ = write!(table, ",{:.4}", of(&hair.with_sliders(&sliders).expect("sliders in range")));
        }
        table.push('\n');
    };
    let hanging = |hair: &HairParameters| span(&lock(hair, 16, LENGTH, -Vector3::z()).1, LENGTH);
    let drooping = |hair: &HairParameters| {
        let tips = lock(hair, 16, 0.05, Vector3::x()).1;
        -tips.iter().map(|points| (points[POINTS - 1] - points[0]).z).sum::<f64>() / (16.0 * 0.05)
    };
    let apart = |hair: &HairParameters| 1e3 * spread(&lock(hair, 16, LENGTH, -Vector3::z()).1);
    for kind in [HairType::Asian, HairType::Caucasian1, HairType::Caucasian2] {
        sweep("curliness", kind, "span of 15 cm at rest (lengths)", &hanging);
    }
    for kind in [HairType::Asian, HairType::Ga1] {
        sweep("stiffness", kind, "droop of 5 cm (lengths)", &drooping);
        sweep("weight", kind, "droop of 5 cm (lengths)", &drooping);
    }
    for kind in [HairType::Asian, HairType::Caucasian2] {
        sweep("discipline", kind, "spread of tips of 15 cm (mm)", &apart);
    }
    std::fs::write(format!("{figures}/hair_sliders.csv"), table).expect("the table is written");
}
