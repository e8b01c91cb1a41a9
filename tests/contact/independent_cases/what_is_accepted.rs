//! Signorini's and Coulomb's laws, checked from outside: for every contact that a step reports, whatever the solver's own verdict.

use std::f64::consts::PI;

use nalgebra::Vector3;
use superhelix::{Contact, ContactPartner, StrandContact};

use super::{Head, across, tangent, turned_about_z, weight, with_hair};

/// How fast what slides goes at least, m/s, and what sticks at most.
const SLIDES: f64 = 1e-3;
const STICKS: f64 = 1e-5;

/// The largest misses over a run. Forces in units of a strand's weight.
#[derive(Debug, Default, Clone, Copy)]
struct Worst {
    /// Normal force below zero.
    pulls: f64,
    /// Normal force where the surfaces are apart by more than the tolerance of contacts.
    at_distance: f64,
    /// How deep a contact is, m.
    deep: f64,
    /// How far the tangential force is beyond the cone, less 1e-3 of its size.
    beyond: f64,
    /// Deviation of a sliding contact's tangential force from μN against the motion, minus 1 % of that.
    off: f64,
    /// That residual relative to μN, for contacts with more than a hundredth of a strand's weight.
    off_share: f64,
    /// How fast what sticks goes, m/s: contacts within 0.98 of the cone with more than 1e-4 of a strand's weight.
    creep: f64,
    contacts: u32,
    slide: u32,
    stick: u32,
}

/// The law's mean and lean for a contact: the coefficient for sliding along d is mean + lean·d (d·tangent = 1: towards the strand's tip, against the
/// scales).
fn coefficient(head: &Head, contact: &Contact) -> (f64, Vector3<f64>) {
    let of = StrandContact::default();
    let lean = |friction: superhelix::Friction, along: Vector3<f64>| {
        (0.5 * (friction.along + friction.against), along * (0.5 * (friction.against - friction.along)))
    };
    let first = tangent(&head.solver, contact.strand, contact.arclength);
    match contact.partner {
        ContactPartner::Body { .. } => lean(of.friction, first),
        ContactPartner::Strand { strand, arclength } => {
            let (mean, one) = lean(of.hair_friction, first);
            let (_, other) = lean(of.hair_friction, tangent(&head.solver, strand, arclength));
            (mean, 0.5 * (one - other))
        }
    }
}

impl Worst {
    fn take(&mut self, head: &Head, contact: &Contact, weight: f64, h: f64) {
        let n = contact.normal;
        let (normal, rubs) = (contact.force.dot(&n), across(&contact.force, &n));
        let speed = across(&contact.slip, &n) / h;
        let (mean, lean) = coefficient(head, contact);
        let along = |d: Vector3<f64>| mean + lean.dot(&d);
        self.contacts += 1;
        self.pulls = self.pulls.max(-normal / weight);
        self.deep = self.deep.max(-contact.gap);
        if contact.gap > 1e-5 {
            self.at_distance = self.at_distance.max(normal / weight);
        }
        let size = rubs.norm();
        let allowed = if size > 0.0 { along(-rubs / size) * normal } else { mean * normal };
        self.beyond = self.beyond.max((size - allowed * 1.001) / weight);
        if speed.norm() > SLIDES {
            self.slide += 1;
            let d = speed.normalize();
            let full = along(d) * normal;
            let miss = (rubs + d * full).norm();
            self.off = self.off.max((miss - 0.01 * full) / weight);
            if normal > 0.01 * weight {
                self.off_share = self.off_share.max(miss / full);
            }
        } else if size < 0.98 * allowed && normal > 1e-4 * weight {
            self.stick += 1;
            self.creep = self.creep.max(speed.norm());
        }
    }
}

/// Twelve wisps on a ball that turns to and fro by `most` rad, `often` times a second: for the islands' steps that are reported as solved, and for all.
fn run(h: f64, most: f64, often: f64) -> (Worst, u32) {
    let contact = StrandContact { radius: 1e-4, wisp_radius: 1e-3, exempt_length: 0.005, ..StrandContact::default() };
    let mut head = Head::new(with_hair(), 12, &contact);
    let weight = weight(&head.defs[0]);
    let (mut worst, mut all, mut told) = (Worst::default(), Worst::default(), 0);
    for step in 1..=(0.8 / h).round() as u32 {
        head.send(&turned_about_z(most * (2.0 * PI * often * f64::from(step) * h).sin()), h);
        let report = head.solver.step(h, 1).unwrap();
        told += u32::from(report.unconverged > 0);
        // Initial overlaps take two tenths of a second to separate. (In a subdivided step, a slip is that of the last substep: it
        // is faster than the checked ones.)
        if f64::from(step) * h < 0.2 {
            continue;
        }
        for contact in head.solver.contacts() {
            all.take(&head, contact, weight, h);
            if report.unconverged == 0 {
                worst.take(&head, contact, weight, h);
            }
        }
    }
    println!("h 1/{:.0}, {most} rad at {often} Hz, {told} steps reported as unconverged; reported as solved: {worst:?}", 1.0 / h);
    println!("    all: {all:?}");
    (worst, told)
}

/// The same tolerances at all steps and speeds. 1e-4 of a strand's weight is 5e-4 of what the least of these contacts bear that matter; a hundredth of
/// a millimetre a second is no motion.
fn laws_hold(most: f64, often: f64) {
    let mut failed = Vec::new();
    for h in [1.0 / 60.0, 1.0 / 240.0] {
        let (worst, told) = run(h, most, often);
        let holds = worst.pulls <= 1e-4
            && worst.at_distance <= 1e-4
            && worst.deep <= 1.0e-5
            && worst.beyond <= 1e-4
            && worst.off <= 1e-4
            && worst.creep <= STICKS;
        if !holds || worst.contacts == 0 {
            failed.push((h, told, worst));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn laws_hold_on_a_head_that_turns_slowly() {
    laws_hold(0.1, 0.5);
}

#[test]
fn laws_hold_on_a_head_that_turns_fast() {
    laws_hold(0.5, 2.0);
}
