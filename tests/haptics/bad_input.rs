//! Invalid input is refused by name, and nothing changes.

use nalgebra::Vector3;
use superhelix::haptic::{HapticOptions, Mode, haptic};
use superhelix::{BodyId, ContactModel, ContactOptions, Error, Frame};

use super::scene::{TICK, combed_hair, stroke};

/// Sets a field.
type Change = fn(&mut HapticOptions, f64);

/// The argument that an error names.
fn named<T>(result: Result<T, Error>) -> String {
    match result.err() {
        Some(
            Error::InvalidArgument { argument, .. } | Error::InvalidId { argument, .. } | Error::Unsupported { argument, .. },
        ) => argument,
        other => panic!("{other:?}"),
    }
}

#[test]
fn options_out_of_range_are_named() {
    let (solver, teeth) = combed_hair(1, 0.0);
    let changes: [(&str, Change, &[f64]); 17] = [
        ("stiffness", |o, x| o.stiffness = x, &[0.0, -1.0, f64::NAN, f64::INFINITY]),
        ("explicit_time", |o, x| o.explicit_time = x, &[-1.0, f64::NAN]),
        ("explicit_friction", |o, x| o.explicit_friction = x, &[-1.0, f64::INFINITY]),
        ("damping", |o, x| o.damping = x, &[-1.0, f64::NAN]),
        ("angular_stiffness", |o, x| o.angular_stiffness = x, &[0.0, f64::NAN]),
        ("angular_damping", |o, x| o.angular_damping = x, &[-1.0, f64::INFINITY]),
        ("max_force", |o, x| o.max_force = x, &[0.0, f64::NAN]),
        ("max_torque", |o, x| o.max_torque = x, &[0.0, -2.0]),
        ("max_force_rate", |o, x| o.max_force_rate = x, &[0.0]),
        ("max_torque_rate", |o, x| o.max_torque_rate = x, &[0.0]),
        ("energy_allowance", |o, x| o.energy_allowance = x, &[0.0, -1e-3]),
        ("max_energy_credit", |o, x| o.max_energy_credit = x, &[-1e-3, f64::NAN]),
        ("max_acceleration", |o, x| o.max_acceleration = x, &[-1.0]),
        ("max_angular_acceleration", |o, x| o.max_angular_acceleration = x, &[f64::NAN]),
        ("max_age", |o, x| o.max_age = x, &[0.0]),
        ("max_contacts", |o, x| o.max_contacts = x as u32, &[0.0, 4097.0]),
        ("max_sweeps", |o, x| o.max_sweeps = x as u32, &[0.0, 1001.0]),
    ];
    for (name, change, values) in changes {
        for value in values {
            let mut options = HapticOptions::default();
            change(&mut options, *value);
            assert_eq!(named(haptic(&solver, &teeth, &options)), format!("options.{name}"), "{value}");
        }
    }
}

#[test]
fn bodies_that_are_no_tool_are_named() {
    let (mut solver, teeth) = combed_hair(1, 0.0);
    let options = HapticOptions::default();
    assert_eq!(named(haptic(&solver, &[], &options)), "bodies (count)");
    assert_eq!(named(haptic(&solver, &[teeth[0], teeth[1], teeth[0]], &options)), "bodies[2]");
    assert_eq!(named(haptic(&solver, &[teeth[0], BodyId::from_bits(0)], &options)), "bodies[1]");
    let soft = ContactOptions { model: ContactModel::Penalty, ..ContactOptions::default() };
    solver.set_contact_options(&soft).unwrap();
    assert_eq!(named(haptic(&solver, &teeth, &options)), "options.mode");
    haptic(&solver, &teeth, &HapticOptions { mode: Mode::Direct, ..options }).unwrap();
}

#[test]
fn a_removed_body_stops_the_simulations_side_and_an_invalid_pose_the_devices() {
    let (mut solver, teeth) = combed_hair(2, 0.0);
    let (mut tool, mut device) = haptic(&solver, &teeth, &HapticOptions::default()).unwrap();
    let zero = Vector3::zeros();
    let nowhere = Frame { origin: Vector3::new(0.0, f64::NAN, 0.0), ..Frame::default() };
    assert_eq!(named(device.update(&nowhere, zero, zero, TICK)), "pose.origin[1]");
    assert_eq!(named(device.update(&stroke(0.0), Vector3::new(0.0, 0.0, f64::INFINITY), zero, TICK)), "velocity[2]");
    assert_eq!(named(device.update(&stroke(0.0), zero, Vector3::new(f64::NAN, 0.0, 0.0), TICK)), "velocity[3]");
    for dt in [0.0, -1.0, f64::NAN] {
        assert_eq!(named(device.update(&stroke(0.0), zero, zero, dt)), "dt");
    }
    assert_eq!(named(tool.before_step(&mut solver, 0.0)), "dt");
    device.update(&stroke(0.0), zero, zero, TICK).unwrap();
    tool.before_step(&mut solver, TICK).unwrap();
    solver.remove_bodies(&teeth[2..3]).unwrap();
    assert_eq!(named(tool.after_step(&mut solver)), "bodies[2]");
    assert_eq!(named(tool.before_step(&mut solver, TICK)), "bodies[2]");
}

#[test]
fn compliance_needs_valid_numbers() {
    let (solver, teeth) = combed_hair(2, 0.0);
    let mut out = Default::default();
    assert_eq!(named(solver.contact_compliance(&teeth, 0.0, 1e-3, &mut out)), "seconds");
    assert_eq!(named(solver.contact_compliance(&teeth, 1e-2, f64::NAN, &mut out)), "within");
    assert_eq!(named(solver.contact_compliance(&[teeth[0], BodyId::from_bits(3)], 1e-2, 1e-3, &mut out)), "bodies[1]");
}
