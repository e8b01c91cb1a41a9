//! Hair types: the published numbers, helices that have the measured radius and step, variation that is seeded and small, and sliders
//! that are monotone in what they set and in what the hair then does.

use std::f64::consts::PI;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::EquilibriumOptions;
use superhelix::hair::{
    CurlFormula, HairParameters, HairType, MeasuredHair, Sliders, Variation, curled_shape, youngs_modulus_from_bending,
};
use superhelix::{BodyDef, Error, Frame, Shape, Solver, SolverOptions, StrandDef};

#[test]
fn types_are_the_published_tables() {
    // Bertails et al. 2006, appendix B: µm, 1, cm, cm, GPa.
    let appendix = [
        (HairType::Asian, 50.0, 1.0, 0.0, 0.0, 1.0),
        (HairType::Caucasian1, 35.0, 1.1, 1.0, 0.5, 2.0),
        (HairType::Caucasian2, 50.0, 1.1, 0.6, 0.5, 1.5),
        (HairType::African, 50.0, 1.2, 0.1, 1.0, 0.5),
    ];
    for (kind, radius, ellipticity, helix_radius, helix_step, modulus) in appendix {
        let hair = kind.measured();
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs();
        assert!(near(hair.mean_radius, radius * 1e-6) && near(hair.ellipticity, ellipticity));
        assert!(near(hair.helix_radius, helix_radius * 1e-2) && near(hair.helix_step, helix_step * 1e-2));
        assert!(near(hair.youngs_modulus, modulus * 1e9) && near(hair.poisson_ratio, 0.48) && near(hair.density, 1300.0));
        let [a1, a2] = hair.semi_axes();
        assert!(near((a1 * a2).sqrt(), hair.mean_radius) && near(a1 / a2, ellipticity));
    }
    // Bonanni and Kmoch 2008, table 1: major diameter (µm), ellipticity, bending stiffness (1e-9 N m²).
    let table = [
        (HairType::H1, 93.1, 1.36, 7.59),
        (HairType::H2, 96.1, 1.33, 9.25),
        (HairType::Ga1, 89.5, 1.45, 5.23),
        (HairType::Gc3, 89.3, 1.42, 5.66),
    ];
    for (kind, diameter, ellipticity, stiffness) in table {
        let material = kind.measured().material();
        assert!((2e6 * material.radius[0] / diameter - 1.0).abs() < 1e-12);
        assert!((material.radius[0] / material.radius[1] / ellipticity - 1.0).abs() < 1e-12);
        // The strand has the table's stiffness: about n1, its soft axis.
        let [_, first, second] = material.stiffness();
        assert!((first / (stiffness * 1e-9) - 1.0).abs() < 1e-12 && first < second);
        // What speaks for reading the table's "Nm" as N m²: all four hairs have the same modulus, that of wet or stretched keratin's order.
        assert!((5.0e9..5.3e9).contains(&material.youngs_modulus), "{}", material.youngs_modulus);
    }
    for kind in HairType::ALL {
        assert_eq!(HairType::from_name(kind.name()), Ok(kind));
        kind.measured().check("hair").unwrap();
    }
    assert!(matches!(HairType::from_name("blond"), Err(Error::InvalidArgument { argument, .. }) if argument == "name"));
    assert_eq!(MeasuredHair::default(), HairType::Caucasian1.measured());
}

#[test]
fn stiffnesses_are_those_of_an_elliptic_section() {
    // Integrals over the ellipse, by a sum over its strips: EI1 = E ∫ y² dA about the longer axis.
    let hair = HairType::African.measured();
    let [a1, a2] = hair.semi_axes();
    let strips = 200_000;
    let (mut first, mut second) = (0.0, 0.0);
    for strip in 0..strips {
        let y = a2 * ((strip as f64 + 0.5) / strips as f64 * 2.0 - 1.0);
        let (half, height) = (a1 * (1.0 - (y / a2).powi(2)).sqrt(), 2.0 * a2 / strips as f64);
        first += y * y * 2.0 * half * height;
        second += 2.0 * half.powi(3) / 3.0 * height;
    }
    let [_, ei1, ei2] = hair.material().stiffness();
    // The sum errs by strips^-1.5 where the ellipse begins and ends.
    assert!((hair.youngs_modulus * first / ei1 - 1.0).abs() < 1e-6);
    assert!((hair.youngs_modulus * second / ei2 - 1.0).abs() < 1e-6);
    assert!((youngs_modulus_from_bending(ei1, [a1, a2]) / hair.youngs_modulus - 1.0).abs() < 1e-12);
}

/// A strand of such hair without weight, and samples along it.
fn free_strand(hair: &HairParameters, length: f64, elements: usize) -> Vec<Vector3<f64>> {
    let mut solver = Solver::new(SolverOptions { gravity: Vector3::zeros(), ..SolverOptions::default() }).unwrap();
    let ids = solver.add_strands(&[strand(hair, 0, length, elements, Frame::default())]).unwrap();
    samples(&solver, &ids, 400)
}

fn samples(solver: &Solver, ids: &[superhelix::StrandId], count: usize) -> Vec<Vector3<f64>> {
    let mut points = vec![Vector3::zeros(); ids.len() * count];
    solver.sample_strands(ids, count, |strand, point, sample| points[strand * count + point] = sample.position).unwrap();
    points
}

fn strand(hair: &HairParameters, number: u64, length: f64, elements: usize, root: Frame) -> StrandDef {
    let lengths = vec![length / elements as f64; elements];
    let varied = hair.strand(number, &lengths).unwrap();
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), varied.root_turn);
    StrandDef {
        element_lengths: lengths,
        material: varied.material,
        natural: varied.natural,
        root: Frame { rotation: root.rotation * turn, ..root },
        ..StrandDef::straight(1.0, 1)
    }
}

#[test]
fn the_natural_shape_is_the_helix_that_was_measured() {
    for kind in [HairType::Caucasian1, HairType::Caucasian2, HairType::African] {
        let measured = kind.measured();
        let hair = measured.parameters(CurlFormula::Exact).unwrap();
        let points = free_strand(&hair, 0.2, 10);
        // A helix turns about its Darboux vector, which in the root's frame is the natural curvature: distance from that axis, and how far
        // along it a turn goes.
        let omega = Vector3::new(hair.natural[0], hair.natural[1], hair.natural[2]);
        let axis = omega.normalize();
        let across = |point: &Vector3<f64>| point - axis * point.dot(&axis);
        let center = Vector3::x().cross(&axis).cross(&axis).normalize();
        let center = [1.0, -1.0]
            .map(|sign| across(&Vector3::zeros()) + axis.cross(&Vector3::x()).normalize() * (sign * measured.helix_radius))
            .into_iter()
            .chain([center * measured.helix_radius])
            .min_by(|a, b| {
                let spread = |c: &Vector3<f64>| {
                    points.iter().map(|p| ((across(p) - c).norm() - measured.helix_radius).abs()).fold(0.0, f64::max)
                };
                spread(a).total_cmp(&spread(b))
            })
            .unwrap();
        for point in &points {
            assert!(((across(point) - center).norm() / measured.helix_radius - 1.0).abs() < 1e-9, "{kind:?}");
        }
        let turns = 0.2 * omega.norm() / (2.0 * PI);
        let along = points.last().unwrap().dot(&axis);
        assert!((along / turns / measured.helix_step - 1.0).abs() < 1e-9, "{kind:?}: {along} {turns}");
        // The paper's formula is the same to first order in the square of pitch over radius, and for African hair it is not close.
        let paper = measured.natural(CurlFormula::Paper);
        let square = (measured.helix_step / (2.0 * PI * measured.helix_radius)).powi(2);
        for axis in 0..2 {
            assert!((paper[axis] / hair.natural[axis] - (1.0 + square)).abs() < 1e-12);
        }
        assert!((kind == HairType::African) == (square > 1.0));
    }
    assert_eq!(HairType::Asian.measured().natural(CurlFormula::Exact), [0.0; 3]);
}

#[test]
fn bad_hair_is_refused_by_name() {
    let good = HairType::African.measured();
    for (hair, said) in [
        (MeasuredHair { mean_radius: 0.0, ..good }, "hair.mean_radius"),
        (MeasuredHair { ellipticity: 0.9, ..good }, "hair.ellipticity"),
        (MeasuredHair { ellipticity: f64::NAN, ..good }, "hair.ellipticity"),
        (MeasuredHair { helix_radius: -1.0, ..good }, "hair.helix_radius"),
        (MeasuredHair { helix_radius: 1e-200, ..good }, "hair.helix_radius"),
        (MeasuredHair { helix_radius: 0.0, ..good }, "hair.helix_step"),
        (MeasuredHair { helix_step: f64::INFINITY, ..good }, "hair.helix_step"),
        (MeasuredHair { youngs_modulus: -1.0, ..good }, "hair.youngs_modulus"),
        (MeasuredHair { poisson_ratio: 0.6, ..good }, "hair.poisson_ratio"),
        (MeasuredHair { friction: -0.1, ..good }, "hair.friction"),
    ] {
        let result = hair.parameters(CurlFormula::Exact);
        assert!(matches!(&result, Err(Error::InvalidArgument { argument, .. }) if argument == said), "{said}: {result:?}");
    }
    let hair = good.parameters(CurlFormula::Exact).unwrap();
    for (variation, said) in [
        (Variation { between: 0.3, ..Variation::none() }, "hair.between"),
        (Variation { along: f64::NAN, ..Variation::none() }, "hair.along"),
        (Variation { thickness: -0.1, ..Variation::none() }, "hair.thickness"),
        (Variation { frizz: -1.0, ..Variation::none() }, "hair.frizz"),
        (Variation { period: 0.0, ..Variation::none() }, "hair.period"),
        (Variation { root_turn: 4.0, ..Variation::none() }, "hair.root_turn"),
    ] {
        let result = HairParameters { variation, ..hair }.strand(0, &[0.1]);
        assert!(matches!(&result, Err(Error::InvalidArgument { argument, .. }) if argument == said), "{said}: {result:?}");
    }
    assert!(
        matches!(hair.strand(0, &[0.1, 0.0]), Err(Error::InvalidArgument { argument, .. }) if argument == "element_lengths[1]")
    );
    for slider in 0..5 {
        for value in [1.01, -1.01, f64::NAN] {
            let result = hair.with_sliders(&sliders(slider, value));
            assert!(
                matches!(&result, Err(Error::InvalidArgument { argument, .. }) if argument == &format!("sliders.{}", NAMES[slider]))
            );
        }
    }
}

#[test]
fn variation_is_seeded_small_and_does_not_depend_on_the_elements() {
    let variation = Variation { seed: 5, ..Variation::natural() };
    let hair = HairParameters { variation, ..HairType::Caucasian2.measured().parameters(CurlFormula::Exact).unwrap() };
    let lengths = [0.005; 40];
    assert_eq!(hair.strand(7, &lengths).unwrap(), hair.strand(7, &lengths).unwrap());
    assert_ne!(hair.strand(7, &lengths).unwrap(), hair.strand(8, &lengths).unwrap());
    let other = HairParameters { variation: Variation { seed: 6, ..variation }, ..hair };
    assert_ne!(hair.strand(7, &lengths).unwrap(), other.strand(7, &lengths).unwrap());
    // An element of three that has the same middle has the same curvatures.
    let fine = hair.strand(7, &[0.005 / 3.0; 120]).unwrap();
    let coarse = hair.strand(7, &lengths).unwrap();
    for (element, row) in coarse.natural.iter().enumerate() {
        for axis in 0..3 {
            assert!((row[axis] - fine.natural[3 * element + 1][axis]).abs() < 1e-9 * (1.0 + row[axis].abs()));
        }
    }
    // None: all strands are the measured one.
    let none = HairParameters { variation: Variation::none(), ..hair }.strand(7, &lengths).unwrap();
    assert!(none.natural.iter().all(|row| *row == hair.natural) && none.material == hair.material && none.root_turn == 0.0);

    // Mean and standard deviation over 4000 strands are what the variation says, one at a time: to four standard errors.
    let count = 4000;
    let spread = |variation: Variation, of: &dyn Fn(&superhelix::hair::VariedStrand) -> f64| {
        let hair = HairParameters { variation, ..hair };
        let values: Vec<f64> = (0..count).map(|strand| of(&hair.strand(strand, &[0.013; 3]).unwrap())).collect();
        let mean = values.iter().sum::<f64>() / count as f64;
        (mean, (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count as f64).sqrt(), values)
    };
    let none = Variation { seed: 9, ..Variation::none() };
    let curvature = hair.natural[1];
    let error = 4.0 / (count as f64).sqrt();
    for (variation, sigma) in
        [(Variation { between: 0.1, ..none }, 0.1 * curvature), (Variation { along: 0.2, ..none }, 0.2 * curvature)]
    {
        let (mean, deviation, values) = spread(variation, &|strand| strand.natural[1][1]);
        assert!((mean - curvature).abs() < error * sigma && (deviation / sigma - 1.0).abs() < error, "{mean} {deviation}");
        assert!(values.iter().all(|value| (value - curvature).abs() < 3.47 * sigma));
    }
    let (mean, deviation, _) = spread(Variation { frizz: 30.0, ..none }, &|strand| strand.natural[2][2]);
    assert!(mean.abs() < error * 30.0 && (deviation / 30.0 - 1.0).abs() < error, "{mean} {deviation}");
    let (mean, deviation, _) =
        spread(Variation { thickness: 0.1, ..none }, &|strand| strand.material.radius[0] / hair.material.radius[0]);
    assert!((mean - 1.0).abs() < error * 0.1 && (deviation / 0.1 - 1.0).abs() < error, "{mean} {deviation}");
    let (mean, _, values) = spread(Variation { root_turn: 0.5, ..none }, &|strand| strand.root_turn);
    assert!(mean.abs() < 0.02 && values.iter().all(|turn| turn.abs() <= 0.5) && values.iter().any(|turn| turn.abs() > 0.3));
    // Two places a period apart have nothing to do with each other; two in one place have.
    let (_, _, far) = spread(Variation { frizz: 1.0, period: 0.01, ..none }, &|s| s.natural[0][2] * s.natural[2][2]);
    let (_, _, near) = spread(Variation { frizz: 1.0, period: 0.5, ..none }, &|s| s.natural[0][2] * s.natural[2][2]);
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    assert!(mean(&far).abs() < error && mean(&near) > 0.9, "{} {}", mean(&far), mean(&near));
}

const NAMES: [&str; 5] = ["curliness", "stiffness", "discipline", "weight", "combing_ease"];

fn sliders(which: usize, value: f64) -> Sliders {
    let at = |slider: usize| if slider == which { value } else { 0.0 };
    Sliders { curliness: at(0), stiffness: at(1), discipline: at(2), weight: at(3), combing_ease: at(4) }
}

const POSITIONS: [f64; 9] = [-1.0, -0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0];

#[track_caller]
fn assert_rising(what: &str, values: &[f64], strictly: bool) {
    let wrong = values.windows(2).any(|pair| if strictly { pair[1] <= pair[0] } else { pair[1] < pair[0] });
    assert!(!wrong, "{what}: {values:?}");
}

#[test]
fn sliders_are_monotone_in_every_parameter_and_do_nothing_in_the_middle() {
    for kind in HairType::ALL {
        let hair = HairParameters { variation: Variation::natural(), ..kind.measured().parameters(CurlFormula::Exact).unwrap() };
        assert_eq!(hair.with_sliders(&Sliders::default()).unwrap(), hair);
        let sweep = |slider: usize, of: &dyn Fn(&HairParameters) -> f64| -> Vec<f64> {
            POSITIONS.iter().map(|x| of(&hair.with_sliders(&sliders(slider, *x)).unwrap())).collect()
        };
        let straight = hair.natural == [0.0; 3];
        let curl = sweep(0, &|hair| hair.natural[1]);
        assert_rising("curvature", &curl[if straight { 4 } else { 0 }..], true);
        assert!(curl[0] == 0.0 && curl[8] >= 400.0, "{kind:?}: {curl:?}");
        assert_rising("twist", &sweep(0, &|hair| hair.natural[0]), false);
        let modulus = sweep(1, &|hair| hair.material.youngs_modulus);
        assert_rising("modulus", &modulus, true);
        assert!((modulus[8] / modulus[4] - 8.0).abs() < 1e-12 && (modulus[4] / modulus[0] - 8.0).abs() < 1e-12);
        for (name, values) in [
            ("frizz", sweep(2, &|hair| -hair.variation.frizz)),
            ("along", sweep(2, &|hair| -hair.variation.along)),
            ("between", sweep(2, &|hair| -hair.variation.between)),
        ] {
            // Variation ends at its greatest.
            assert_rising(name, &values, name == "frizz");
            assert!(values[8] == 0.0 && values[0] < values[4], "{name}: {values:?}");
        }
        let drag = sweep(2, &|hair| -hair.material.air_drag);
        assert_rising("drag", &drag, false);
        assert!((drag[0] + 5e-5).abs() < 1e-18 && (drag[8] + 5e-6).abs() < 1e-18);
        let density = sweep(3, &|hair| hair.material.density);
        assert_rising("density", &density, true);
        assert!((density[8] / 2600.0 - 1.0).abs() < 1e-12 && (density[0] / 650.0 - 1.0).abs() < 1e-12);
        assert_rising("internal friction", &sweep(4, &|hair| -hair.material.internal_friction), true);
        assert_rising("friction", &sweep(4, &|hair| -hair.contact().hair_friction.against), true);
        assert_rising("friction", &sweep(4, &|hair| -hair.contact().friction.along), true);
        // A slider moves what is its own and nothing else.
        let moved = hair.with_sliders(&sliders(1, 0.7)).unwrap();
        assert_eq!(HairParameters { material: hair.material, ..moved }, hair);
    }
}

/// A strand with a shape of its own: bends and twists that change along it.
fn own_shape() -> (Vec<f64>, Vec<[f64; 3]>) {
    let lengths = (0..12).map(|k| 0.01 + 0.001 * f64::from(k)).collect();
    let rows =
        (0..12).map(f64::from).map(|k| [3.0 * (0.7 * k).sin(), 20.0 + 30.0 * (0.4 * k).cos(), 15.0 * (0.9 * k).sin()]).collect();
    (lengths, rows)
}

/// The root mean square of a strand's curvature.
fn mean_curvature(lengths: &[f64], rows: &[[f64; 3]]) -> f64 {
    let square: f64 = lengths.iter().zip(rows).map(|(length, [_, k1, k2])| length * (k1 * k1 + k2 * k2)).sum();
    (square / lengths.iter().sum::<f64>()).sqrt()
}

#[test]
fn curliness_scales_a_shape_of_ones_own_as_it_does_a_type() {
    let (lengths, rows) = own_shape();
    let own = mean_curvature(&lengths, &rows);
    let straight = vec![[0.5, 0.0, 0.0]; 12];
    let tight: Vec<_> = rows.iter().map(|row| row.map(|value| 20.0 * value)).collect();
    for shape in [&rows, &tight] {
        let mean = mean_curvature(&lengths, shape);
        let moved: Vec<_> = POSITIONS.iter().map(|x| curled_shape(&lengths, shape, *x).unwrap()).collect();
        let curvatures: Vec<f64> = moved.iter().map(|rows| mean_curvature(&lengths, rows)).collect();
        assert_rising("mean curvature", &curvatures, true);
        assert!(curvatures[0] == 0.0 && moved[4] == *shape);
        // One factor for all rows, and the one that hair of a type with that curvature gets.
        let mut hair = HairType::Caucasian2.measured().parameters(CurlFormula::Exact).unwrap();
        hair.natural = [0.1 * mean, mean, 0.0];
        for (x, moved) in POSITIONS.iter().zip(&moved) {
            let factor = hair.with_sliders(&sliders(0, *x)).unwrap().natural[1] / mean;
            for (row, before) in moved.iter().zip(shape) {
                for axis in 0..3 {
                    assert!((row[axis] - factor * before[axis]).abs() <= 1e-12 * (1.0 + (factor * before[axis]).abs()));
                }
            }
        }
        assert!((curvatures[8] - (1.5 * mean).max(400.0)).abs() < 1e-9 * curvatures[8]);
    }
    assert!(own < 60.0 && mean_curvature(&lengths, &tight) > 400.0);
    // A straight strand curls like straight types, with its own twist.
    let asian = HairType::Asian.measured().parameters(CurlFormula::Exact).unwrap();
    for x in POSITIONS {
        let [twist, first, second] = asian.with_sliders(&sliders(0, x)).unwrap().natural;
        let own_twist = 0.5 * (1.0 + x.min(0.0));
        assert_eq!(curled_shape(&lengths, &straight, x).unwrap(), vec![[own_twist + twist, first, second]; 12]);
    }
    for (result, name) in [
        (curled_shape(&lengths, &rows, 1.5), "curliness"),
        (curled_shape(&lengths, &rows, f64::NAN), "curliness"),
        (curled_shape(&lengths[1..], &rows, 0.5), "natural (count)"),
        (curled_shape(&[0.0; 12], &rows, 0.5), "element_lengths[0]"),
        (curled_shape(&lengths, &[[f64::NAN; 3]; 12], 0.5), "natural[0][0]"),
    ] {
        let text = result.unwrap_err().to_string();
        assert!(text.contains(name), "{text}");
    }
}

#[test]
fn a_shape_of_ones_own_varies_as_that_of_a_type() {
    let (lengths, rows) = own_shape();
    let none = Variation { seed: 5, ..Variation::none() };
    assert_eq!(none.of_shape(3, &lengths, &rows).unwrap(), rows);
    // A shape that is a type's own varies to what that type's strand is.
    let hair = HairParameters {
        variation: Variation::natural(),
        ..HairType::Caucasian2.measured().parameters(CurlFormula::Exact).unwrap()
    };
    let varied = hair.variation.of_shape(7, &lengths, &[hair.natural; 12]).unwrap();
    assert_eq!(varied, hair.strand(7, &lengths).unwrap().natural);
    assert_ne!(hair.variation.of_shape(8, &lengths, &rows).unwrap(), hair.variation.of_shape(7, &lengths, &rows).unwrap());
    assert!(hair.variation.of_shape(7, &lengths, &rows[1..]).unwrap_err().to_string().contains("natural (count)"));
    let bad = Variation { along: 0.3, ..none };
    assert!(bad.of_shape(7, &lengths, &rows).unwrap_err().to_string().contains("variation.along"));
}

/// The places of the tips of strands at rest under gravity, their roots side by side at the origin and leaving along `direction`.
fn tips_at_rest(hair: &HairParameters, count: u64, direction: Vector3<f64>, length: f64, elements: usize) -> Vec<Vector3<f64>> {
    let rotation = UnitQuaternion::rotation_between(&Vector3::x(), &direction).unwrap();
    let definitions: Vec<StrandDef> =
        (0..count).map(|number| strand(hair, number, length, elements, Frame { origin: Vector3::zeros(), rotation })).collect();
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let ids = solver.add_strands(&definitions).unwrap();
    let found = solver.settle(&ids, &EquilibriumOptions::default()).unwrap();
    assert!(found.iter().all(|strand| strand.converged));
    samples(&solver, &ids, 2).chunks_exact(2).map(|ends| ends[1]).collect()
}

/// The effect of a slider on hair at rest, at five positions.
fn at_rest(kind: HairType, slider: usize, of: &dyn Fn(&HairParameters) -> f64) -> Vec<f64> {
    let hair = HairParameters { variation: Variation::none(), ..kind.measured().parameters(CurlFormula::Exact).unwrap() };
    [-1.0, -0.5, 0.0, 0.5, 1.0].map(|x| of(&hair.with_sliders(&sliders(slider, x)).unwrap())).to_vec()
}

#[test]
fn stiff_hair_stands_out_and_heavy_hair_droops() {
    // Drooping: how far the tip of 5 cm of hair that leaves its root level is below it, in lengths.
    for kind in [HairType::Asian, HairType::Ga1] {
        let droop = |hair: &HairParameters| -tips_at_rest(hair, 1, Vector3::x(), 0.05, 8)[0].z / 0.05;
        let stiff: Vec<f64> = at_rest(kind, 1, &droop).iter().map(|droop| -droop).collect();
        assert_rising("stiffness", &stiff, true);
        assert!(stiff[4] - stiff[0] > 0.1, "{kind:?}: {stiff:?}");
        let heavy = at_rest(kind, 3, &droop);
        assert_rising("weight", &heavy, true);
        assert!(heavy[4] - heavy[0] > 0.05, "{kind:?}: {heavy:?}");
    }
}

#[test]
fn curly_hair_is_shorter_and_disciplined_hair_keeps_together() {
    // The span of 15 cm of hanging hair, in lengths.
    for kind in [HairType::Asian, HairType::Caucasian1, HairType::Caucasian2] {
        let span = |hair: &HairParameters| tips_at_rest(hair, 1, -Vector3::z(), 0.15, 24)[0].z / 0.15;
        let curly = at_rest(kind, 0, &span);
        // Straight hair stays straight below the middle.
        assert_rising("curliness", &curly[if kind == HairType::Asian { 2 } else { 0 }..], true);
        assert!(curly[4] - curly[0] > 0.05, "{kind:?}: {curly:?}");
    }
    // The root mean square distance of 24 tips from their middle.
    let spread = |hair: &HairParameters| {
        let hair = HairParameters { variation: Variation { root_turn: 0.0, ..hair.variation }, ..*hair };
        let tips = tips_at_rest(&hair, 24, -Vector3::z(), 0.1, 12);
        let middle = tips.iter().sum::<Vector3<f64>>() / tips.len() as f64;
        -(tips.iter().map(|tip| (tip - middle).norm_squared()).sum::<f64>() / tips.len() as f64).sqrt()
    };
    for kind in [HairType::Asian, HairType::Caucasian2] {
        let hair = HairParameters { variation: Variation::natural(), ..kind.measured().parameters(CurlFormula::Exact).unwrap() };
        let spreads = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|x| spread(&hair.with_sliders(&sliders(2, x)).unwrap()));
        assert_rising("discipline", &spreads, true);
        assert!(spreads[4].abs() < 1e-9 && spreads[0] < -1e-3, "{kind:?}: {spreads:?}");
    }
}

#[test]
fn hair_that_is_easy_to_comb_pulls_less_and_springs_back_faster() {
    // The force that it takes to draw hair along a table: friction times weight, for what lies on it.
    let pull = |hair: &HairParameters| {
        let mut solver = Solver::new(SolverOptions::default()).unwrap();
        let length = 0.06;
        let contact = hair.contact();
        let root = Frame { origin: Vector3::new(0.0, 0.0, contact.radius), ..Frame::default() };
        let ids = solver.add_strands(&[strand(hair, 0, length, 3, root)]).unwrap();
        solver.set_contact(&ids, Some(&contact)).unwrap();
        let table = Shape::new_half_space(Vector3::z()).unwrap();
        solver.add_bodies(vec![BodyDef::new(std::sync::Arc::new(table))]).unwrap();
        // Against x, so that the strand follows its root.
        let (h, speed) = (0.005, 0.02);
        for step in 1..=40 {
            let at = Frame { origin: root.origin - Vector3::x() * (speed * h * f64::from(step)), ..root };
            solver.set_root_frames(&ids, &[at], h).unwrap();
            solver.step(h, 1).unwrap();
        }
        solver.root_wrench(ids[0]).unwrap().force.x.abs() / (hair.material.linear_density() * length * 9.81)
    };
    let pulls = at_rest(HairType::Asian, 4, &|hair| -pull(hair));
    assert_rising("pull", &pulls, true);
    // Friction is three times as much and a third: that of the strand along itself, 0.2, for all the weight that lies on the table.
    assert!(pulls[0] < -0.3 && pulls[4] > -0.1, "{pulls:?}");

    // Bent hair that is let go: its largest speed. (The rest after some time would not do: where friction is so great that hair
    // only creeps back, more of it leaves more.)
    let fastest = |hair: &HairParameters| {
        let mut solver = Solver::new(SolverOptions { gravity: Vector3::zeros(), ..SolverOptions::default() }).unwrap();
        let mut definition = strand(hair, 0, 0.05, 3, Frame::default());
        definition.initial = Some(vec![[0.0, 10.0, 0.0]; 3]);
        let ids = solver.add_strands(&[definition]).unwrap();
        let kinetic = (0..100).map(|_| {
            solver.step(1e-3, 1).unwrap();
            solver.energies(ids[0]).unwrap().kinetic
        });
        kinetic.fold(0.0, f64::max)
    };
    let energies = at_rest(HairType::Asian, 4, &fastest);
    assert_rising("greatest kinetic energy", &energies, true);
    assert!(energies[4] > 1.5 * energies[0], "{energies:?}");
}
