//! Contacts that begin and end: a ball that strands meet and leave causes both events, once each, despite sliding in between; events without room are
//! counted; and what a step spends its time on.

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::reading::{Change, ContactEvent, MAX_EVENTS};
use superhelix::{
    BodyDef, BodyId, ContactPartner, Frame, Shape, Solver, SolverOptions, StrandContact, StrandDef, StrandId, Workers,
};

const ELEMENTS: usize = 6;
const LENGTH: f64 = 0.12;

/// Strands side by side that hang down, and a ball beside them that is sent through them and back.
fn scene(workers: Workers) -> (Solver, Vec<StrandId>, BodyId) {
    let mut solver = Solver::new(SolverOptions { workers, ..SolverOptions::default() }).unwrap();
    let down = nalgebra::UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::FRAC_PI_2);
    let defs: Vec<StrandDef> = (0..5)
        .map(|k| {
            let mut def = StrandDef::straight(LENGTH, ELEMENTS);
            def.root = Frame { origin: Vector3::new(0.0, 0.01 * f64::from(k), 0.0), rotation: down };
            def.material.internal_friction = 1e-9;
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    solver.set_contact(&ids, Some(&StrandContact::default())).unwrap();
    let mut ball = BodyDef::new(Arc::new(Shape::new_sphere(0.03).unwrap()));
    ball.pose.origin = Vector3::new(0.06, 0.02, -0.08);
    let ball = solver.add_bodies(vec![ball]).unwrap()[0];
    (solver, ids, ball)
}

fn send(solver: &mut Solver, ball: BodyId, x: f64) {
    let frame = Frame { origin: Vector3::new(x, 0.02, -0.08), ..Frame::default() };
    solver.set_body_frames(&[ball], &[frame], 0.25).unwrap();
}

fn drained(solver: &mut Solver) -> Vec<ContactEvent> {
    let mut events = Vec::new();
    assert_eq!(solver.drain_contact_events(usize::MAX, |event| events.push(event)), 0);
    events
}

/// The pairs in contact by the solver's own list of contacts.
fn touching(solver: &Solver) -> BTreeSet<(u64, u64)> {
    let of = |partner: ContactPartner| match partner {
        ContactPartner::Body { body, .. } => body.bits(),
        ContactPartner::Strand { strand, .. } => strand.bits(),
    };
    solver.contacts().iter().map(|contact| (contact.strand.bits(), of(contact.partner))).collect()
}

/// Against the list of contacts after every step: pairs that are new have begun, and missing ones have ended.
#[test]
fn events_are_the_differences_of_the_lists_of_contacts() {
    let (mut solver, ids, ball) = scene(Workers::Serial);
    solver.keep_contact_events(1000).unwrap();
    let (mut before, mut begun, mut ended) = (BTreeSet::new(), 0, 0);
    for step in 0..60 {
        match step {
            0 => send(&mut solver, ball, 0.0),
            20 => send(&mut solver, ball, 0.09),
            _ => {}
        }
        solver.step(1.0 / 60.0, 2).unwrap();
        let now = touching(&solver);
        let events = drained(&mut solver);
        for event in &events {
            let contact = &event.contact;
            let ContactPartner::Body { body, .. } = contact.partner else { panic!("{event:?}") };
            let pair = (contact.strand.bits(), body.bits());
            assert_eq!(body, ball);
            match event.change {
                Change::Begin => assert!(now.contains(&pair) && !before.contains(&pair), "step {step}: {event:?}"),
                Change::End => assert!(!now.contains(&pair) && before.contains(&pair), "step {step}: {event:?}"),
            }
            // On the element that has its arclength, pressed away from the ball.
            let element = (contact.arclength / (LENGTH / ELEMENTS as f64)) as u32;
            assert_eq!(event.element, element.min(ELEMENTS as u32 - 1));
            assert!(contact.force.dot(&contact.normal) > 0.0 && (contact.normal.norm() - 1.0).abs() < 1e-9, "{event:?}");
            begun += usize::from(event.change == Change::Begin);
            ended += usize::from(event.change == Change::End);
        }
        assert_eq!(events.len(), before.symmetric_difference(&now).count(), "step {step}");
        before = now;
    }
    assert!(begun >= ids.len() && begun == ended, "{begun} {ended}: the ball went through all of them and away");
}

#[test]
fn events_do_not_depend_on_threads_and_cost_no_result() {
    let run = |workers: Workers, capacity: usize| {
        let (mut solver, _, ball) = scene(workers);
        solver.keep_contact_events(capacity).unwrap();
        send(&mut solver, ball, 0.0);
        for _ in 0..20 {
            solver.step(1.0 / 60.0, 1).unwrap();
        }
        let hash = solver.state_hash();
        // (Identifiers are each solver's own.)
        let place = |event: ContactEvent| (event.change, event.element, event.contact.arclength, event.contact.force);
        (drained(&mut solver).into_iter().map(place).collect::<Vec<_>>(), hash)
    };
    let (events, hash) = run(Workers::Serial, 1000);
    assert!(!events.is_empty());
    assert_eq!(run(Workers::Pool(3), 1000), (events, hash));
    assert_eq!(run(Workers::Serial, 0), (Vec::new(), hash));
}

#[test]
fn events_without_room_are_counted_and_the_oldest_come_first() {
    let all = {
        let (mut solver, _, ball) = scene(Workers::Serial);
        solver.keep_contact_events(1000).unwrap();
        send(&mut solver, ball, 0.0);
        (0..20).for_each(|_| assert!(solver.step(1.0 / 60.0, 1).is_ok()));
        drained(&mut solver)
    };
    assert!(all.len() >= 4, "{all:?}");
    let (mut solver, _, ball) = scene(Workers::Serial);
    solver.keep_contact_events(3).unwrap();
    send(&mut solver, ball, 0.0);
    (0..20).for_each(|_| assert!(solver.step(1.0 / 60.0, 1).is_ok()));
    assert_eq!(solver.waiting_contact_events(), (3, all.len() as u64 - 3));
    let mut some = Vec::new();
    assert_eq!(solver.drain_contact_events(2, |event| some.push(event)), all.len() as u64 - 3);
    assert_eq!(solver.drain_contact_events(2, |event| some.push(event)), 0, "counted once");
    // (Identifiers are each solver's own.)
    let place = |event: &ContactEvent| (event.change, event.element, event.contact.arclength, event.contact.force);
    assert_eq!(some.iter().map(place).collect::<Vec<_>>(), all[..3].iter().map(place).collect::<Vec<_>>());
    assert!(solver.keep_contact_events(MAX_EVENTS + 1).is_err());
    // Removal causes no end event; contacts restored by a snapshot begin again.
    let image = solver.snapshot();
    solver.remove_bodies(&[ball]).unwrap();
    solver.step(1.0 / 60.0, 1).unwrap();
    assert_eq!(solver.waiting_contact_events(), (0, 0));
    solver.restore(&image).unwrap();
    solver.step(1.0 / 60.0, 1).unwrap();
    let (waiting, lost) = solver.waiting_contact_events();
    assert_eq!(waiting + lost as usize, touching(&solver).len());
}

/// The phases are parts of the whole, and those that a scene does not have take no time.
#[test]
fn a_report_has_the_times_of_a_steps_phases() {
    let (mut solver, _, ball) = scene(Workers::Serial);
    send(&mut solver, ball, 0.0);
    let (mut sums, mut seconds) = ([0.0; 3], 0.0);
    for _ in 0..20 {
        let report = solver.step(1.0 / 60.0, 2).unwrap();
        let phases = [report.phases.search, report.phases.strands, report.phases.contact];
        assert!(phases.iter().all(|phase| *phase >= 0.0) && phases.iter().sum::<f64>() <= report.seconds, "{report:?}");
        (0..3).for_each(|k| sums[k] += phases[k]);
        seconds += report.seconds;
    }
    println!("search, strands, contact: {sums:?} of {seconds} s");
    assert!(sums.iter().all(|sum| *sum > 0.0) && sums.iter().sum::<f64>() > 0.5 * seconds, "{sums:?} {seconds}");
    let mut free = Solver::new(SolverOptions::default()).unwrap();
    free.add_strands(&vec![StrandDef::straight(0.1, 8); 50]).unwrap();
    let phases = free.step(1.0 / 60.0, 4).unwrap().phases;
    assert!(phases.search == 0.0 && phases.contact == 0.0 && phases.strands > 0.0, "{phases:?}");
}
