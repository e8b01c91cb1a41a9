//! Strokes of hands that grip loosely and stiffly, with simulations that are late, at rates of 100 to 1000 Hz: none gets more energy than it gave and the
//! allowance. `SUPERHELIX_STROKES` says how many of the cheap ones there are (`make soak`: a million),
//! `SUPERHELIX_HAIR_STROKES` how many go through hair (500).

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::haptic::{HapticOptions, haptic};
use superhelix::internals::haptics::passivity::Passivity;
use superhelix::{Frame, Wrench};

use super::scene::{Numbers, combed_hair, stroke};

/// An account separate from the engine's: work of a force over the hand's motion while it was applied.
#[derive(Default)]
struct Book {
    got: f64,
    given: f64,
    excess: f64,
}

impl Book {
    fn enter(&mut self, work: f64) {
        if work > 0.0 {
            self.got += work;
        } else {
            self.given -= work;
        }
        self.excess = self.excess.max(self.got - self.given);
    }
}

fn way(numbers: &mut Numbers, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| numbers.between(-size, size))
}

/// A hand of some mass and grip is drawn about by a random course, against a wall of springs that receives its pose late and pushes back harder: what
/// a bad simulation would do. `limit` is the tested account, or none. Returns the largest excess of energy to the hand.
fn stroke_against_late_wall(seed: u64, options: &HapticOptions, is_limited: bool) -> f64 {
    let mut numbers = Numbers(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let rate = numbers.between(100.0, 1000.0);
    let dt = 1.0 / rate;
    let late = (numbers.between(0.0, 15e-3) / dt) as usize;
    // From a loose hand to one as stiff as a wall.
    let grip = 10.0 * 200_f64.powf(numbers.next());
    let (mass, wall) = (numbers.between(0.05, 0.3), numbers.between(20.0, 2000.0));
    let damping = 2.0 * (grip * mass).sqrt() * numbers.between(0.05, 1.0);
    let course: Vec<(Vector3<f64>, f64)> = (0..3).map(|_| (way(&mut numbers, 0.02), numbers.between(2.0, 40.0))).collect();
    let mut account = Passivity::new(options);
    let (mut at, mut velocity) = (Vector3::zeros(), Vector3::zeros());
    let (mut out, mut book) = (Wrench::default(), Book::default());
    let mut seen = vec![Vector3::zeros(); late + 1];
    for tick in 0..(0.3 * rate) as usize {
        let t = tick as f64 * dt;
        let wish: Vector3<f64> = course.iter().map(|(size, speed)| size * (speed * t).sin()).sum();
        // The device: the force of the update before was out while the hand went on, in ten parts.
        let before = at;
        for _ in 0..10 {
            let pull = (wish - at) * grip - velocity * damping + out.force;
            let most = options.max_acceleration * mass;
            let pull = if pull.norm() > most { pull * (most / pull.norm()) } else { pull };
            velocity += pull * (0.1 * dt / mass);
            at += velocity * (0.1 * dt);
        }
        book.enter(out.force.dot(&(at - before)));
        account.observe(&out, at - before, Vector3::zeros());
        seen[tick % (late + 1)] = at;
        let then: Vector3<f64> = seen[(tick + 1) % (late + 1)];
        let force = Vector3::new(0.0, 0.0, (-then.z).max(0.0) * wall) - Vector3::new(then.x, then.y, 0.0) * (0.3 * wall);
        let size = force.norm();
        let force = if size > options.max_force { force * (options.max_force / size) } else { force };
        out = Wrench { force, torque: Vector3::zeros() };
        if is_limited {
            account.limit(&mut out, [velocity, Vector3::zeros()], dt);
        }
    }
    assert!((account.worst - book.excess).abs() <= 1e-12 + 1e-9 * book.excess, "{} {}", account.worst, book.excess);
    book.excess
}

#[test]
fn no_hand_gets_more_energy_than_it_gave_plus_the_allowance() {
    let strokes: u64 = std::env::var("SUPERHELIX_STROKES").map_or(5000, |text| text.parse().unwrap());
    let options = HapticOptions::default();
    let (mut most, mut most_without, mut over_without) = (0.0_f64, 0.0_f64, 0);
    for seed in 0..strokes {
        let excess = stroke_against_late_wall(seed, &options, true);
        assert!(excess <= options.energy_allowance * (1.0 + 1e-9), "stroke {seed}: {excess:e} J");
        most = most.max(excess);
        if seed < 500 {
            let without = stroke_against_late_wall(seed, &options, false);
            most_without = most_without.max(without);
            over_without += u32::from(without > options.energy_allowance);
        }
    }
    println!(
        "{strokes} strokes: {most:.1e} J at most; of 500 without the limit {over_without} had more, up to {most_without:.1e} J"
    );
    // The wall is one that does give energy.
    assert!(over_without > 100);
}

#[test]
fn strokes_through_hair_are_passive_and_the_state_keeps_the_book() {
    let mut most = 0.0_f64;
    let strokes: u64 = std::env::var("SUPERHELIX_HAIR_STROKES").map_or(12, |text| text.parse().unwrap());
    for seed in 0..strokes {
        let mut numbers = Numbers(0x1234_5678 + 977 * seed);
        let rate = numbers.between(100.0, 1000.0);
        let (dt, late, step) = (1.0 / rate, numbers.between(0.0, 15e-3), 1.0 / numbers.between(60.0, 240.0));
        // An allowance as small as the hair's forces are.
        let options = HapticOptions { energy_allowance: 1e-8, ..HapticOptions::default() };
        let (mut solver, teeth) = combed_hair(20, numbers.between(0.0, 40.0));
        let (mut tool, mut device) = haptic(&solver, &teeth, &options).unwrap();
        let (sway, turn, pace) = (way(&mut numbers, 0.004), way(&mut numbers, 0.3), numbers.between(0.5, 2.0));
        let course = |t: f64| {
            let swing = (9.0 * t).sin();
            let base = stroke(pace * t);
            Frame { origin: base.origin + sway * swing, rotation: UnitQuaternion::from_scaled_axis(turn * swing) }
        };
        let mut book = Book::default();
        let (mut out, mut last) = (Wrench::default(), course(0.0));
        let (mut next, mut done_at) = (0.0, None);
        let mut state = Default::default();
        for tick in 0..(0.8 / dt) as usize {
            let t = tick as f64 * dt;
            let now = course(t);
            let (moved, turned) = (now.origin - last.origin, (now.rotation * last.rotation.inverse()).scaled_axis());
            book.enter(out.force.dot(&moved) + out.torque.dot(&turned));
            (out, state) = device.update(&now, moved / dt, turned / dt, dt).unwrap();
            last = now;
            if done_at.is_some_and(|done| t >= done) {
                tool.after_step(&mut solver).unwrap();
                done_at = None;
            }
            if t >= next && done_at.is_none() {
                tool.before_step(&mut solver, step).unwrap();
                solver.step(step, 1).unwrap();
                (next, done_at) = (next + step, Some(t + late));
            }
        }
        let apart = (state.energy_got - book.got).abs() + (state.energy_given - book.given).abs();
        assert!(apart <= 1e-9 * (book.got + book.given), "{apart:e}");
        assert!(book.given > 0.0 && book.excess <= options.energy_allowance * (1.0 + 1e-9), "{}: {:e}", seed, book.excess);
        most = most.max(book.excess);
    }
    println!("{strokes} strokes through hair: {most:.1e} J at most");
}

#[test]
fn passive_forces_are_unchanged() {
    let account = Passivity::new(&HapticOptions::default());
    let mut wrench = Wrench { force: Vector3::new(-3.0, 0.5, 0.0), torque: Vector3::zeros() };
    let before = wrench;
    assert!(!account.limit(&mut wrench, [Vector3::x() * 0.2, Vector3::zeros()], 1e-3));
    assert_eq!(wrench, before);
    // And of the force that drives the hand, the part across its motion stays longest.
    let mut driving = Wrench { force: Vector3::new(3.0, 0.5, 0.0), torque: Vector3::zeros() };
    assert!(account.limit(&mut driving, [Vector3::x() * 2.0, Vector3::zeros()], 1e-3));
    assert!((driving.force.y - 0.5).abs() < 1e-12 && driving.force.x < 0.5 && driving.force.x > 0.0, "{driving:?}");
}
