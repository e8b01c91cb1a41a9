//! The explicit formula of Bonanni and Kmoch (2008) against itself, written out, and against the exact law.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::haptic::{ForceLaw, HapticOptions, Mode, haptic};
use superhelix::internals::haptics::explicit_law::Resistance;
use superhelix::{ContactModel, ContactOptions, ContactPartner, Frame};

use super::scene::{Numbers, Rate, Simulation, TICK, combed_hair, handed_over, motion, stroke};

fn explicit() -> HapticOptions {
    HapticOptions { force_law: ForceLaw::Explicit, ..HapticOptions::default() }
}

#[test]
fn a_resistance_is_the_sum_of_the_formula_over_contacts() {
    let mut numbers = Numbers(7);
    let mut vector = |size: f64| Vector3::from_fn(|_, _| numbers.between(-size, size));
    let (velocity, spin) = (vector(0.2), vector(2.0));
    let mut resistance = Resistance::default();
    let (mut force, mut torque) = (Vector3::zeros(), Vector3::zeros());
    for k in 0..20 {
        let (tangent, arm) = (vector(1.0).normalize(), vector(0.05));
        let (beta, f) = (1e-5 * f64::from(k + 1), 3e-6 * f64::from(k));
        resistance.add(&tangent, &arm, beta, f);
        // F = β ṫ⊥ + f ṫ∥, with the velocity of the tool's point.
        let at_contact: Vector3<f64> = velocity + spin.cross(&arm);
        let along = tangent * tangent.dot(&at_contact);
        let on_strand = (at_contact - along) * beta + along * f;
        force -= on_strand;
        torque -= arm.cross(&on_strand);
    }
    let wrench = resistance.wrench(&velocity, &spin);
    assert!((wrench.force - force).norm() <= 1e-14 * force.norm(), "{wrench:?} {force}");
    assert!((wrench.torque - torque).norm() <= 1e-13 * torque.norm(), "{wrench:?} {torque}");
    // It takes power from the hand whatever this does.
    assert!(wrench.force.dot(&velocity) + wrench.torque.dot(&spin) < 0.0);
}

#[test]
fn what_the_hand_feels_is_the_formula_at_the_solvers_contacts() {
    for mode in [Mode::HandOver, Mode::Direct] {
        let options = HapticOptions { mode, explicit_time: 0.2, explicit_friction: 3.0, ..explicit() };
        let (mut simulation, mut device) = Simulation::new(combed_hair(40, 15.0), Rate::new(120.0, 0.0), &options);
        let mut felt = 0;
        for tick in 0..900 {
            let t = f64::from(tick) * TICK;
            let (pose, velocity, spin) = motion(stroke, t);
            let (_, state) = device.update(&pose, velocity, spin, TICK).unwrap();
            let solver = &simulation.solver;
            let teeth = simulation.tool.bodies();
            let mut force = Vector3::<f64>::zeros();
            let mut pressing = 0;
            for contact in solver.contacts() {
                if !matches!(contact.partner, ContactPartner::Body { body, .. } if teeth.contains(&body)) {
                    continue;
                }
                // 15 cm of hair: the formula's coefficients from its material.
                let material = solver.material(contact.strand).unwrap();
                let (stiffness, length) = (material.stiffness()[1].min(material.stiffness()[2]), 0.15_f64);
                let beta = 0.2 * 3.0 * stiffness / length.powi(3);
                let f = 3.0 * 3.0 * (material.internal_friction + material.viscosity * stiffness) / length.powi(3);
                let mut points = [Vector3::zeros(); 3];
                let along = [-1e-5, 0.0, 1e-5].map(|off| (contact.arclength + off).clamp(0.0, length));
                solver.sample_at(contact.strand, &along, |k, sample| points[k] = sample.position).unwrap();
                let tangent = (points[2] - points[0]).normalize();
                let along = tangent * tangent.dot(&velocity);
                force -= (velocity - along) * beta + along * f;
                pressing += 1;
            }
            // (Half a step after a hand-over the force is still changing from the previous one.)
            let is_blended = mode == Mode::HandOver && state.model_age < 5.5e-3;
            if pressing > 3 && !is_blended && velocity.norm() > 0.05 {
                let apart = (state.contact.force - force).norm() / force.norm();
                assert!(apart < 1e-3, "{mode:?} {t}: {apart} {} {force}", state.contact.force);
                assert_eq!(state.pressing, pressing, "{t}");
                felt += 1;
            }
            simulation.until(t);
        }
        assert!(felt > 100, "{felt}");
    }
}

#[test]
fn it_resists_every_motion_and_vanishes_at_rest() {
    let felt = handed_over(combed_hair(40, 15.0), stroke, 1.4, Rate::new(120.0, 4e-3), &explicit());
    let last = felt.last().unwrap().1;
    // At a turn of the hand, while a hand-over goes from one force to the next, some of it drives.
    assert!(last.energy_got <= 0.02 * last.energy_given && last.energy_given > 0.0, "{last:?}");
    // The hand stands still within the hair.
    let still = |t: f64| stroke(t.min(0.7));
    let felt = handed_over(combed_hair(40, 15.0), still, 1.0, Rate::new(120.0, 4e-3), &explicit());
    let (wrench, state) = felt.last().unwrap();
    assert!(state.pressing > 0 && wrench.force.norm() == 0.0, "{wrench:?} {state:?}");
    // By the exact law hair that is bent goes on to press.
    let felt = handed_over(combed_hair(40, 15.0), still, 1.0, Rate::new(120.0, 4e-3), &HapticOptions::default());
    assert!(felt.last().unwrap().0.force.norm() > 1e-6);
}

#[test]
fn it_has_the_sign_and_the_position_of_the_exact_law_but_not_its_size() {
    let mean = |options: &HapticOptions| {
        let felt = handed_over(combed_hair(40, 15.0), stroke, 1.2, Rate::new(120.0, 4e-3), options);
        let drag = felt.iter().skip(400).map(|felt| felt.0.force.z).sum::<f64>() / (felt.len() - 400) as f64;
        let felt_at = |force: f64| felt.iter().position(|felt| felt.0.force.norm() > force).map(|tick| tick as f64 * TICK);
        (drag, felt_at(1e-8))
    };
    let (exact, from) = mean(&HapticOptions::default());
    let (cheap, cheap_from) = mean(&explicit());
    println!("exact {exact:e} N from {from:?}, explicit {cheap:e} from {cheap_from:?}");
    assert!(exact > 0.0 && cheap > 0.0);
    // Felt only once a step has seen the contact: up to two steps later.
    assert!((cheap_from.unwrap() - from.unwrap()).abs() < 0.03);
}

#[test]
fn it_needs_no_hard_contact() {
    let (mut solver, teeth) = combed_hair(10, 15.0);
    let soft = ContactOptions { model: ContactModel::Penalty, ..ContactOptions::default() };
    solver.set_contact_options(&soft).unwrap();
    let (mut simulation, mut device) = Simulation::new((solver, teeth), Rate::new(240.0, 0.0), &explicit());
    let mut most = 0.0_f64;
    for tick in 0..800 {
        let t = f64::from(tick) * TICK;
        let (pose, velocity, spin) = motion(stroke, t);
        most = most.max(device.update(&pose, velocity, spin, TICK).unwrap().0.force.norm());
        simulation.until(t);
    }
    assert!(most > 0.0, "{most:e}");
}

#[test]
fn a_tool_that_turns_is_resisted_about_its_handle() {
    let (mut solver, teeth) = combed_hair(40, 15.0);
    let (mut tool, mut device) = haptic(&solver, &teeth, &explicit()).unwrap();
    let within = stroke(0.7);
    device.update(&within, Vector3::zeros(), Vector3::zeros(), TICK).unwrap();
    for _ in 0..20 {
        tool.before_step(&mut solver, 1.0 / 120.0).unwrap();
        solver.step(1.0 / 120.0, 1).unwrap();
        tool.after_step(&mut solver).unwrap();
    }
    let spin = Vector3::new(0.0, 0.0, 1.5);
    let turned = Frame { rotation: UnitQuaternion::from_scaled_axis(spin * TICK), ..within };
    let (_, state) = device.update(&turned, Vector3::zeros(), spin, TICK).unwrap();
    assert!(state.pressing > 0 && state.contact.torque.dot(&spin) < 0.0, "{state:?}");
}
