//! Friction at low speed: Coulomb's force does not depend on the speed, however small a step's displacement is.

use nalgebra::Vector3;
use superhelix::{ContactOptions, Friction, Shape, StrandContact, StrandDef};

use super::{across, at, body, floor, hanging, solver};

const MU: f64 = 0.3;
/// Internal friction time, s: a moving spring pulls as if it had moved for this much longer.
const VISCOSITY: f64 = 0.02;
/// m/s.
const SPEEDS: [f64; 6] = [1e-5, 1e-4, 5e-4, 1e-3, 2e-3, 1e-2];

fn rubbing() -> StrandContact {
    StrandContact { friction: Friction::uniform(MU), ..StrandContact::default() }
}

/// The distance over which μN may do work in a step, m: a residual of 1e-4 leaves a micrometre per second, which is this in 1/60
/// s.
const WORKS: f64 = 1.7e-8;
/// A contact that slips less than this in a step, m, may stick.
const SLIPS: f64 = 2e-8;
/// A belt that starts or turns at once shakes a short strand for this long, s.
const SHAKES: f64 = 0.15;

/// The result of a run on a belt.
#[derive(Debug, Default)]
struct Run {
    /// The largest residual of the force that statics and Coulomb's law give, in units of μN.
    miss: f64,
    /// The same while the belt moves back, after it has moved back far enough.
    miss_back: f64,
    /// Work of friction on belt and strand, per contact and step, J: the most.
    work: f64,
    /// The distance over which μN does that work, m, minus a thousandth of the belt's displacement in a step.
    work_way: f64,
    unconverged: u32,
}

/// A short strand whose root is clamped 50 µm above a belt, so that only its tip lies on it. Sideways it is a spring of k =
/// 3EI/L³, and the belt pulls it by k times its displacement up to μN; once the belt has turned and moved back twice as far, by
/// μN in the other direction.
fn a_short_strand_on_a_belt(speed: f64, h: f64, boxed: bool) -> Run {
    let mut solver = solver(ContactOptions::default());
    let mut def = StrandDef::straight(0.02, 6);
    (def.material.viscosity, def.material.air_drag) = (VISCOSITY, 1e-4);
    let radius = def.material.radius[0];
    let bending = def.material.youngs_modulus * std::f64::consts::PI / 4.0 * radius.powi(4);
    let spring = 3.0 * bending / def.length().powi(3);
    def.root = at(Vector3::new(0.0, 0.0, radius + 5e-5));
    let id = solver.add_strands(&[def]).unwrap()[0];
    let (belt, height) =
        if boxed { (body(Shape::new_box(Vector3::new(1.0, 1.0, 0.01)).unwrap()), -0.01) } else { (floor(), 0.0) };
    let belt = solver.add_bodies(vec![belt]).unwrap()[0];
    let start = at(Vector3::new(0.0, 0.0, height));
    solver.teleport_bodies(&[belt], &[start]).unwrap();
    solver.set_contact(&[id], Some(&rubbing())).unwrap();
    let mut run = Run::default();
    for _ in 0..(0.5 / h) as u32 {
        solver.step(h, 1).unwrap();
    }
    let normal = -solver.body_wrench(belt).unwrap().force.z;
    // Belts that stick take the tip along this far; four times it and then back eight times.
    let slides_at = MU * normal / spring;
    let steps = ((4.0 * slides_at / (speed * h)) as u32).clamp((2.0 * SHAKES / h) as u32, 4000);
    let mut way = 0.0;
    for step in 0..3 * steps {
        let forth = step < steps;
        way += if forth { speed * h } else { -speed * h };
        let pose = at(start.origin + Vector3::y() * way);
        solver.set_body_frames(&[belt], &[pose], h).unwrap();
        run.unconverged += solver.step(h, 1).unwrap().contact.unconverged;
        let wrench = solver.body_wrench(belt).unwrap().force;
        // On the strand, along the belt's direction.
        let (force, most) = (-wrench.y, -MU * wrench.z);
        for contact in solver.contacts() {
            let work = contact.force.dot(&across(&contact.slip, &contact.normal));
            run.work = run.work.max(work);
            run.work_way = run.work_way.max(work / most - 1e-3 * speed * h);
        }
        let gone = speed * h * f64::from(step + 1);
        if forth {
            // While it sticks the spring is known to 2 %; where it begins to slide both are looked for.
            let expected = (spring * (gone + VISCOSITY * speed)).min(most);
            let around = (gone - slides_at).abs() < 0.3 * slides_at;
            if !around && f64::from(step) * h > SHAKES {
                run.miss = run.miss.max((force - expected).abs() / most);
            }
        } else if gone - speed * h * f64::from(steps) > 3.0 * slides_at && f64::from(step - steps) * h > SHAKES {
            run.miss_back = run.miss_back.max((force + most).abs() / most);
        }
    }
    run
}

/// A strand that sticks to a belt bends as statics says, and slides at μN: 1 % of that. (The spring is that of a continuous rod: six elements have
/// it within 1 %, and so 2 % are allowed while it sticks.) Friction takes work away and gives none.
#[test]
fn a_belt_pulls_at_a_short_strand_however_slow_it_is() {
    let mut failed = Vec::new();
    for boxed in [false, true] {
        for h in [1.0 / 60.0, 1.0 / 240.0] {
            for speed in SPEEDS {
                let run = a_short_strand_on_a_belt(speed, h, boxed);
                println!("box {boxed}, h 1/{:.0}, {speed:e} m/s: {run:?}", 1.0 / h);
                if run.miss > 0.02 || run.miss_back > 0.01 || run.work_way > WORKS {
                    failed.push((boxed, h, speed, run));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{} of 24: {failed:?}", failed.len());
}

/// A strand of 20 cm hangs from 8 cm and lies on a belt with the rest. Each of its contacts goes along with the belt or rubs by μN against the way that
/// it slides, within 1 %; then the belt goes back.
fn a_hanging_strand_on_a_belt(speed: f64, h: f64) -> (Run, f64) {
    let mut solver = solver(ContactOptions::default());
    let mut def = StrandDef::straight(0.2, 8);
    (def.material.viscosity, def.material.air_drag, def.material.youngs_modulus) = (0.02, 1e-4, 1e8);
    // It is bent, so that it comes to lie on a side.
    def.natural = vec![[0.0, -1.0, 0.0]; 8];
    def.root = hanging(Vector3::new(0.0, 0.0, 0.08));
    def.root.rotation = nalgebra::UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.8);
    let weight = super::weight(&def);
    let id = solver.add_strands(&[def]).unwrap()[0];
    let belt = solver.add_bodies(vec![floor()]).unwrap()[0];
    solver.set_contact(&[id], Some(&rubbing())).unwrap();
    let mut run = Run::default();
    for _ in 0..(1.0 / h) as u32 {
        solver.step(h, 1).unwrap();
    }
    let mut way = 0.0;
    let mut least = f64::INFINITY;
    let steps = (2.0 / h) as u32;
    for step in 0..2 * steps {
        let sign = if step < steps { 1.0 } else { -1.0 };
        way += sign * speed * h;
        solver.set_body_frames(&[belt], &[at(Vector3::y() * way)], h).unwrap();
        run.unconverged += solver.step(h, 1).unwrap().contact.unconverged;
        let (mut rubs, mut normals) = (Vector3::zeros(), 0.0);
        for contact in solver.contacts() {
            let (normal, tangential) = (contact.force.dot(&contact.normal), across(&contact.force, &contact.normal));
            let slip = across(&contact.slip, &contact.normal);
            (rubs, normals) = (rubs + tangential, normals + normal);
            let work = tangential.dot(&slip);
            run.work = run.work.max(work);
            if normal > 0.0 {
                run.work_way = run.work_way.max(work / (MU * normal) - 1e-3 * speed * h);
            }
            if step % steps > steps / 4 && slip.norm() > 0.1 * speed * h + SLIPS && normal > 0.0 {
                let should = -slip.normalize() * MU * normal;
                // (Forces are right to a ten-thousandth of the strand's weight.)
                let miss = ((tangential - should).norm() - 1e-4 * weight).max(0.0) / (MU * normal);
                let of = if step < steps { &mut run.miss } else { &mut run.miss_back };
                *of = of.max(miss);
            }
        }
        // After half of its way forth friction draws the way that the belt goes. (Back, what sticks is still drawn forth at first.)
        if step > steps / 2 && step < steps && normals > 0.0 {
            least = least.min(rubs.y / (MU * normals));
        }
    }
    (run, least)
}

/// See above. A strand that was only taken along so far draws back by its stiffness and weight, never by nothing: at a millimetre that is half
/// a hundredth of μN at least.
#[test]
fn a_belt_pulls_at_a_strand_hanging_onto_it_however_slow_it_is() {
    let mut failed = Vec::new();
    for h in [1.0 / 60.0, 1.0 / 240.0] {
        for speed in SPEEDS {
            let (run, least) = a_hanging_strand_on_a_belt(speed, h);
            println!("h 1/{:.0}, {speed:e} m/s: least share drawn {least:.3e}, {run:?}", 1.0 / h);
            let draws = least > 0.005 || speed < 1e-3;
            if run.miss > 0.01 || run.miss_back > 0.05 || run.work_way > WORKS || !draws {
                failed.push((h, speed, least, run));
            }
        }
    }
    assert!(failed.is_empty(), "{} of 12: {failed:?}", failed.len());
}
