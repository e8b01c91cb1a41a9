use nalgebra::Vector3;
use superhelix::tools::{RingComb, RingCombOptions, Tool};
use superhelix::{ConstraintStatus, Error, Frame};

use crate::scene::{STEP, apart, points, row};

const WAVY: [[f64; 3]; 10] = [[3.0, 25.0, 5.0]; 10];
const COMB: Tool = Tool::Comb { teeth: 9, spacing: 3e-3, length: 0.06, radius: 0.5e-3 };

/// Teeth point along +y here; the comb is `x` aside and `z` high.
fn pose(x: f64, z: f64) -> Frame {
    let rotation = superhelix::internals::math::rotation::from_rotation_vector(Vector3::x() * -0.5 * std::f64::consts::PI);
    Frame { origin: Vector3::new(x, -0.03, z), rotation }
}

/// The comb comes from the side, catches what it meets, is drawn down, and each strand slides through its ring to the tip. The work of the hand is
/// against it over the whole motion.
#[test]
fn strands_are_caught_combed_and_left() {
    let (mut solver, ids) = row(6, 0.12, &WAVY);
    let rest: Vec<_> = ids.iter().map(|id| points(&solver, *id, 30)).collect();
    let mut comb = RingComb::new(&COMB, &pose(-0.04, -0.03), &RingCombOptions::default()).unwrap();
    let (mut caught, mut combed, mut let_go, mut upward) = (0, 0, 0, 0.0);
    for step in 1..=300 {
        let t = f64::from(step) / 300.0;
        let to = if t < 0.3 { pose(-0.04 + 0.04 * t / 0.3, -0.03) } else { pose(0.0, -0.03 - 0.12 * (t - 0.3) / 0.7) };
        comb.before_step(&mut solver, &ids, &to, STEP).unwrap();
        let report = solver.step(STEP, 1).unwrap();
        assert_eq!(report.quarantined, 0);
        for (_, constraint) in comb.held() {
            let state = solver.constraint_state(constraint).unwrap();
            assert!(state.status == ConstraintStatus::Released || state.error < 1e-6, "{state:?}");
        }
        let told = comb.after_step(&mut solver).unwrap();
        caught += told.caught;
        combed += told.combed;
        let_go += told.let_go;
        if t > 0.35 && told.held > 0 {
            upward += told.wrench.force.z;
        }
    }
    assert!(caught >= 3 && combed == caught && let_go == 0, "{caught} {combed} {let_go}");
    assert!(upward > 0.0 && comb.held().count() == 0 && solver.constraint_ids().is_empty());
    for _ in 0..1200 {
        solver.step(STEP, 1).unwrap();
    }
    for (id, rest) in ids.iter().zip(&rest) {
        assert!(apart(&points(&solver, *id, 30), rest) < 0.01 * 0.12);
    }
}

/// Two combs hold the same strands at once, and one lets go where it draws too hard.
#[test]
fn two_combs_and_a_force_that_is_too_much() {
    let (mut solver, ids) = row(4, 0.12, &WAVY);
    let mut upper = RingComb::new(&COMB, &pose(-0.04, -0.03), &RingCombOptions::default()).unwrap();
    let mut lower = RingComb::new(&COMB, &pose(0.04, -0.07), &RingCombOptions::default()).unwrap();
    let mut both = 0;
    for step in 1..=120 {
        let t = f64::from(step) / 120.0;
        upper.before_step(&mut solver, &ids, &pose(-0.04 + 0.04 * t, -0.03), STEP).unwrap();
        lower.before_step(&mut solver, &ids, &pose(0.04 - 0.04 * t, -0.07), STEP).unwrap();
        solver.step(STEP, 1).unwrap();
        let held: Vec<_> = lower.held().map(|(strand, _)| strand).collect();
        both = both.max(upper.held().filter(|(strand, _)| held.contains(strand)).count());
        upper.after_step(&mut solver).unwrap();
        lower.after_step(&mut solver).unwrap();
    }
    assert!(both >= 1, "{both}");
    upper.release(&mut solver).unwrap();
    lower.release(&mut solver).unwrap();
    assert!(solver.constraint_ids().is_empty());

    let weak = RingCombOptions { max_force: 1e-6, ..RingCombOptions::default() };
    let (mut solver, ids) = row(4, 0.12, &WAVY);
    let mut comb = RingComb::new(&COMB, &pose(-0.04, -0.05), &weak).unwrap();
    let (mut caught, mut let_go) = (0, 0);
    for step in 1..=120 {
        comb.before_step(&mut solver, &ids, &pose(-0.04 + 0.08 * f64::from(step) / 120.0, -0.05), STEP).unwrap();
        solver.step(STEP, 1).unwrap();
        let told = comb.after_step(&mut solver).unwrap();
        caught += told.caught;
        let_go += told.let_go;
    }
    assert!(let_go >= 1 && caught >= let_go, "{caught} {let_go}");
}

/// A strand that is listed twice is on one tooth all the same.
#[test]
fn a_strand_that_is_listed_twice_is_caught_once() {
    let (mut solver, ids) = row(4, 0.12, &WAVY);
    let twice = [ids.clone(), ids.clone()].concat();
    let mut comb = RingComb::new(&COMB, &pose(-0.04, -0.03), &RingCombOptions::default()).unwrap();
    let mut caught = 0;
    for step in 1..=60 {
        comb.before_step(&mut solver, &twice, &pose(-0.04 + 0.04 * f64::from(step) / 60.0, -0.03), STEP).unwrap();
        let mut held: Vec<_> = comb.held().map(|(strand, _)| strand).collect();
        let count = held.len();
        held.sort_unstable();
        held.dedup();
        assert_eq!((held.len(), solver.constraint_ids().len()), (count, count));
        solver.step(STEP, 1).unwrap();
        caught += comb.after_step(&mut solver).unwrap().caught;
    }
    assert!(caught >= 1 && caught as usize <= ids.len(), "{caught}");
}

#[test]
fn bad_input_is_named_and_a_removed_strand_forgotten() {
    let options = RingCombOptions { max_force: 0.0, ..RingCombOptions::default() };
    assert!(matches!(
        RingComb::new(&COMB, &Frame::default(), &options),
        Err(Error::InvalidArgument { argument, .. }) if argument == "options.max_force"
    ));
    assert!(matches!(
        RingComb::new(&Tool::PLATES, &Frame::default(), &RingCombOptions::default()),
        Err(Error::Unsupported { argument, .. }) if argument == "tool"
    ));
    let (mut solver, ids) = row(2, 0.12, &WAVY);
    let mut comb = RingComb::new(&COMB, &pose(-0.04, -0.03), &RingCombOptions::default()).unwrap();
    for step in 1..=60 {
        comb.before_step(&mut solver, &ids, &pose(-0.04 + 0.04 * f64::from(step) / 60.0, -0.03), STEP).unwrap();
        solver.step(STEP, 1).unwrap();
        comb.after_step(&mut solver).unwrap();
    }
    let held = comb.held().count();
    assert!(held >= 1);
    let gone = comb.held().next().unwrap().0;
    solver.remove_strands(&[gone]).unwrap();
    let left: Vec<_> = ids.into_iter().filter(|id| *id != gone).collect();
    comb.before_step(&mut solver, &left, &pose(0.001, -0.03), STEP).unwrap();
    assert!(comb.held().count() < held || left.is_empty());
}
