//! A scene with everything that lanes must handle, and its course.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::internals::math::rotation::from_rotation_vector;
use superhelix::{Frame, Freedoms, Material, Phases, Solver, SolverOptions, StepReport, StrandDef, StrandId};

/// Seconds of a step.
pub const STEP: f64 = 1.0 / 60.0;

/// A turn by our own sine: the standard library's differs from machine to machine.
pub fn turn(x: f64, y: f64, z: f64) -> UnitQuaternion<f64> {
    from_rotation_vector(Vector3::new(x, y, z))
}

/// A strand for a number: 1 to 40 elements (most of them of a few counts, so that packs fill), all sets of freedoms, with and without drag
/// and both frictions, straight to tightly coiled (up to 20 rad an element), soft and stiff.
pub fn strand(k: u64) -> StrandDef {
    let draw = |salt: u64, of: u64| ((k + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(salt as u32) >> 33) % of;
    let count = [1, 2, 3, 5, 5, 5, 5, 8, 8, 8, 13, 40][draw(7, 12) as usize];
    let length = 0.04 + 0.01 * draw(11, 25) as f64;
    let mut def = StrandDef::straight(length, count);
    let curl = [0.0, 0.0, 3.0, 40.0, 40.0, 20.0 * count as f64 / length][draw(13, 6) as usize];
    def.natural = vec![[0.3 * curl, 0.9 * curl, 0.1 * curl]; count];
    def.freedoms = Freedoms::from_bits("freedoms", [7, 7, 7, 7, 6, 4, 2, 1, 3][draw(17, 9) as usize]).unwrap();
    def.material = Material {
        youngs_modulus: [1e8, 1e9, 4e9][draw(19, 3) as usize],
        internal_friction: [0.0, 1e-10][draw(23, 2) as usize],
        viscosity: [0.0, 2e-3][draw(29, 2) as usize],
        air_drag: [0.0, 5e-6][draw(31, 2) as usize],
        ..Material::default()
    };
    def.root = swayed(k, 0);
    def.user_data = k;
    def
}

/// Where a strand's root is after some steps: each on a head of its own, every third of which is shaken.
pub fn swayed(k: u64, step: u32) -> Frame {
    let t = f64::from(step);
    // A triangle wave of 12 steps a period, without the standard library's sine.
    let wave = 1.0 - (((t / 6.0) % 2.0) - 1.0).abs();
    let reach = if k.is_multiple_of(3) { 0.9 } else { 0.05 };
    let head = turn(0.0, 0.0, reach * wave);
    Frame {
        origin: head * Vector3::new(0.09, 0.1 * reach * wave, 0.0),
        rotation: head * turn(0.0, 0.4 + 0.03 * (k % 40) as f64, 0.0),
    }
}

/// The frame of a root thrown so far that its strand's numbers overflow.
pub fn thrown() -> Frame {
    Frame { origin: Vector3::new(1e200, 0.0, 0.0), ..Frame::default() }
}

/// The parts of a report that do not depend on the clock.
pub fn said(report: &StepReport) -> StepReport {
    StepReport { seconds: 0.0, phases: Phases::default(), ..*report }
}

/// A strand's numbers, to the bit.
pub fn bits(solver: &Solver, id: StrandId) -> Vec<u64> {
    let wrench = solver.root_wrench(id).unwrap();
    let energies = solver.energies(id).unwrap();
    let rows = [solver.curvatures(id).unwrap(), solver.rates(id).unwrap()];
    let numbers = rows.into_iter().flatten().flatten().copied();
    let numbers = numbers.chain(wrench.force.iter().chain(wrench.torque.iter()).copied());
    let mut bits: Vec<u64> = numbers.chain([energies.kinetic, energies.elastic, energies.gravity]).map(f64::to_bits).collect();
    bits.push(u64::from(solver.iterations(id).unwrap()));
    bits.push(solver.status(id).unwrap() as u64);
    bits
}

/// The whole scene's course: strands are added, removed, changed and thrown between the steps. Gives what every step reported, and the
/// state's hash at the end.
pub fn course(options: SolverOptions) -> (Vec<StepReport>, u64) {
    let mut solver = Solver::new(options).unwrap();
    let defs: Vec<_> = (0..72).map(strand).collect();
    let mut ids = solver.add_strands(&defs).unwrap();
    let mut reports = Vec::new();
    for step in 1..=8 {
        let numbers: Vec<u64> = ids.iter().map(|id| solver.user_data(*id).unwrap()).collect();
        let mut frames: Vec<_> = numbers.iter().map(|k| swayed(*k, step)).collect();
        match step {
            3 => {
                for (k, frame) in numbers.iter().zip(&mut frames) {
                    if k % 10 == 4 {
                        *frame = thrown();
                    }
                }
            }
            4 => {
                solver.remove_strands(&[ids[8], ids[1], ids[40]]).unwrap();
                ids.retain(|id| solver.has_strand(*id));
                ids.extend(solver.add_strands(&[strand(100), strand(101), strand(102), strand(103)]).unwrap());
                let numbers: Vec<u64> = ids.iter().map(|id| solver.user_data(*id).unwrap()).collect();
                frames = numbers.iter().map(|k| swayed(*k, step)).collect();
            }
            5 => {
                let rows = vec![[2.0, 9.0, 0.0]; solver.natural_curvatures(ids[6]).unwrap().len()];
                solver.set_natural_curvatures(ids[6], &rows).unwrap();
                solver.reset_strands(&ids[10..13]).unwrap();
                solver.set_element_count(&ids[20..22], 6).unwrap();
            }
            6 => solver.teleport_roots(&ids[2..4], &[Frame::default(), Frame::default()]).unwrap(),
            _ => {}
        }
        solver.set_root_frames(&ids, &frames, STEP).unwrap();
        reports.push(said(&solver.step(STEP, 1 + step % 2).unwrap()));
    }
    (reports, solver.state_hash())
}
