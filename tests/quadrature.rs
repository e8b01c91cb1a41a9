//! Quadrature to a tolerance: the table of rules against dense quadrature, and what a step makes of the rules.

#[path = "../examples/quadrature/angles.rs"]
#[allow(dead_code)]
mod angles;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::math::frame::Frame;
use superhelix::math::quadrature::{LOOSEST, Rule, Rules, TIGHTEST};
use superhelix::solver::Solver;
use superhelix::solver::definition::{SolverOptions, StrandDef};
use superhelix::step::options::StepOptions;

/// Turns of an element from nothing to beyond what the largest rule is for.
fn turns() -> impl Iterator<Item = f64> {
    (0..70).map(|k| 1e-2 * 1.17_f64.powi(k)).take_while(|turn| *turn < 200.0)
}

#[test]
fn every_rule_keeps_its_tolerance() {
    let known = Rules::default();
    let rules: Vec<Rule> = (0..known.count()).map(|index| known.rule(index).clone()).collect();
    for turn in turns() {
        let errors = angles::errors(&rules, turn);
        for exponent in 4..=24 {
            let tolerance = 10.0_f64.powf(-0.5 * f64::from(exponent));
            let rules = Rules::new(tolerance.clamp(TIGHTEST, LOOSEST));
            let chosen = rules.for_angle(turn);
            // Between the table's columns the logarithms are interpolated: measured, up to a half beyond.
            let room = if exponent % 2 == 0 { 1.02 } else { 1.5 };
            assert!(errors[chosen] <= room * tolerance, "{turn} rad to {tolerance:e}: {:e}", errors[chosen]);
            // And no rule is larger than it need be: the next smaller one fails a tolerance ten times as tight.
            if chosen > 0 && turn > 0.2 {
                assert!(errors[chosen - 1] > 0.1 * tolerance, "{turn} rad to {tolerance:e}: {:e}", errors[chosen - 1]);
            }
        }
    }
}

#[test]
fn the_table_is_the_measured_one() {
    let known = Rules::default();
    let csv = include_str!("../docs/figures/quadrature_angles.csv");
    let mut rows = 0;
    for line in csv.lines().skip(1) {
        let fields: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
        let [points, tolerance, turn] = fields[..] else { panic!("{line}") };
        let index = (0..known.count()).find(|index| known.rule(*index).len() as f64 == points).unwrap();
        let rules = Rules::new(tolerance);
        // Four digits of it, rounded down.
        if turn > 0.0 {
            assert!(
                rules.for_angle(0.999 * turn) <= index && rules.for_angle(turn * 1.000_01) == (index + 1).min(known.count() - 1),
                "{line}"
            );
        } else {
            assert!(rules.for_angle(0.0) > index, "{line}");
        }
        rows += 1;
    }
    assert_eq!(rows, 11 * known.count());
}
