//! Passivity observer and controller (Hannaford and Ryu 2002): bounds the energy that the device gives to the hand.
//!
//! It sums the device's work on the hand exactly, output force times motion, and permits no force that could give the hand more
//! than it gave plus an allowance.
//!
//! The observer alone is late by one update, since a force works over the motion that follows it. So the output is bounded in
//! advance: over the next update the hand moves by v·dt and, however it accelerates, no farther from there than 1.5·a·dt² (the
//! reported velocity may be an update old). Of a force that could do too much work over that, first the part that drives the hand
//! is removed, as a damper would, and then all of it is scaled down.

use nalgebra::Vector3;

use super::options::HapticOptions;
use crate::solver::report::Wrench;

/// The energy account.
#[derive(Debug, Clone, Copy)]
pub struct Passivity {
    allowance: f64,
    most_credit: f64,
    /// m/s², rad/s².
    accelerations: [f64; 2],
    /// The hand's output minus its input, limited to the largest credit, J.
    balance: f64,
    /// Energy from the hand so far, J.
    pub given: f64,
    /// Energy to the hand so far, J.
    pub got: f64,
    /// The largest excess so far of energy to the hand over energy from it, J.
    pub worst: f64,
}

impl Passivity {
    /// An empty account.
    pub fn new(options: &HapticOptions) -> Self {
        Self {
            allowance: options.energy_allowance,
            most_credit: options.max_energy_credit,
            accelerations: [options.max_acceleration, options.max_angular_acceleration],
            balance: 0.0,
            given: 0.0,
            got: 0.0,
            worst: 0.0,
        }
    }

    /// Counts the work of the output wrench while the hand moved (m) and turned (rad).
    pub fn observe(&mut self, wrench: &Wrench, moved: Vector3<f64>, turned: Vector3<f64>) {
        let work = wrench.force.dot(&moved) + wrench.torque.dot(&turned);
        if work > 0.0 {
            self.got += work;
        } else {
            self.given -= work;
        }
        self.balance = (self.balance - work).min(self.most_credit);
        self.worst = self.worst.max(self.got - self.given);
    }

    /// The most work of a wrench on the hand over the next `dt` seconds, J.
    fn max_work(&self, wrench: &Wrench, [velocity, spin]: [Vector3<f64>; 2], dt: f64) -> f64 {
        let off = self.accelerations.map(|acceleration| 1.5 * acceleration * dt * dt);
        (wrench.force.dot(&velocity) + wrench.torque.dot(&spin)) * dt
            + wrench.force.norm() * off[0]
            + wrench.torque.norm() * off[1]
    }

    /// Removes from a wrench what could give the hand too much. True if it did.
    pub fn limit(&self, wrench: &mut Wrench, velocities: [Vector3<f64>; 2], dt: f64) -> bool {
        let budget = self.balance + self.allowance;
        let most = self.max_work(wrench, velocities, dt);
        if most <= budget {
            return false;
        }
        if budget <= 0.0 {
            *wrench = Wrench::default();
            return true;
        }
        let [force, torque] =
            [(wrench.force, velocities[0]), (wrench.torque, velocities[1])].map(|(acts, velocity)| without_drive(acts, velocity));
        let yielding = Wrench { force, torque };
        let least = self.max_work(&yielding, velocities, dt);
        if least >= budget {
            // (Linear in the wrench.)
            let part = budget / least;
            *wrench = Wrench { force: force * part, torque: torque * part };
        } else {
            // Convex between the two: no more than on the straight line.
            let part = (budget - least) / (most - least);
            wrench.force = force + (wrench.force - force) * part;
            wrench.torque = torque + (wrench.torque - torque) * part;
        }
        true
    }
}

/// A force without the part that drives a velocity.
fn without_drive(force: Vector3<f64>, velocity: Vector3<f64>) -> Vector3<f64> {
    let (power, square) = (force.dot(&velocity), velocity.norm_squared());
    if power > 0.0 { force - velocity * (power / square) } else { force }
}
