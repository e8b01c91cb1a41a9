//! The solver as a host meets it: identifiers, errors that change nothing, snapshots, workers.

use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::{Error, Frame, Freedoms, ParallelFor, Solver, SolverOptions, StrandDef, StrandId, Workers};

fn strand(k: usize) -> StrandDef {
    let count = 1 + k % 7;
    let mut def = StrandDef::straight(0.05 + 0.01 * (k % 11) as f64, count);
    def.natural = vec![[k as f64, 10.0 + 7.0 * (k % 5) as f64, (k % 3) as f64]; count];
    def.material.air_drag = if k.is_multiple_of(2) { 0.0 } else { 1e-5 };
    def.user_data = k as u64;
    def
}

fn solver(workers: Workers, strands: usize) -> (Solver, Vec<StrandId>) {
    let mut solver = Solver::new(SolverOptions { workers, ..SolverOptions::default() }).unwrap();
    let defs: Vec<StrandDef> = (0..strands).map(strand).collect();
    let ids = solver.add_strands(&defs).unwrap();
    (solver, ids)
}

fn run(solver: &mut Solver, ids: &[StrandId], steps: usize) {
    for step in 0..steps {
        let shift = Frame { origin: Vector3::new(0.0, 0.01 * step as f64, 0.0), ..Frame::default() };
        solver.set_root_frames(ids, &vec![shift; ids.len()], 1.0 / 60.0).unwrap();
        solver.step(1.0 / 60.0, 2).unwrap();
    }
}

/// A host's task system that hands out uneven ranges from behind, on threads of its own, and may leave some out.
struct Host {
    threads: u32,
    forget: bool,
}

impl ParallelFor for Host {
    fn run(&self, count: u32, _min_range: u32, task: &(dyn Fn(u32, u32, u32) + Sync)) {
        std::thread::scope(|scope| {
            let mut end = count;
            let mut worker = 0;
            while end > 0 {
                let size = (1 + worker % 3).min(end);
                let begin = end - size;
                let w = worker % self.threads;
                if !(self.forget && worker % 4 == 1) {
                    scope.spawn(move || task(begin, end, w));
                }
                end = begin;
                worker += 1;
            }
        });
    }
}

#[test]
fn any_number_of_workers_gives_the_same_bits() {
    let (mut serial, ids) = solver(Workers::Serial, 100);
    run(&mut serial, &ids, 10);
    let expected = serial.state_hash();
    for workers in [
        Workers::Pool(2),
        Workers::Pool(3),
        Workers::Pool(8),
        Workers::Host(Arc::new(Host { threads: 4, forget: false })),
        Workers::Host(Arc::new(Host { threads: 4, forget: true })),
    ] {
        let name = format!("{workers:?}");
        let (mut other, ids) = solver(workers, 100);
        run(&mut other, &ids, 10);
        assert_eq!(other.state_hash(), expected, "{name}");
    }
    // The same scene on any machine: own transcendental functions, no fused multiply-add, fixed order of sums. A change here is a
    // change of numerical results: say so in CHANGELOG.md.
    assert_eq!(expected, GOLDEN, "0x{expected:016x}");
}

const GOLDEN: u64 = 0xaf64_7ef1_8023_8ba0;

#[test]
fn removed_strands_stay_removed_and_the_others_keep_their_identifiers() {
    let (mut solver, ids) = solver(Workers::Serial, 10);
    solver.remove_strands(&[ids[3], ids[7]]).unwrap();
    assert_eq!(solver.strand_count(), 8);
    for (k, id) in ids.iter().enumerate() {
        assert_eq!(solver.has_strand(*id), k != 3 && k != 7);
        match solver.user_data(*id) {
            Ok(data) => assert_eq!(data, k as u64),
            Err(error) => assert_eq!(error, Error::InvalidId { argument: "id".into(), bits: id.bits() }),
        }
    }
    let fresh = solver.add_strands(&[strand(42)]).unwrap()[0];
    assert!(fresh != ids[3] && fresh != ids[7] && solver.user_data(fresh) == Ok(42));
    let order: Vec<u64> = solver.strand_ids().into_iter().map(|id| solver.user_data(id).unwrap()).collect();
    assert_eq!(order, [0, 1, 2, 4, 5, 6, 8, 9, 42]);
    let hash = solver.state_hash();
    assert!(matches!(solver.remove_strands(&[ids[0], ids[3]]), Err(Error::InvalidId { .. })));
    assert!(matches!(solver.remove_strands(&[ids[0], ids[0]]), Err(Error::InvalidArgument { .. })));
    assert_eq!((solver.state_hash(), solver.strand_count()), (hash, 9));
}

#[test]
fn another_solver_s_identifiers_are_refused() {
    let (mut first, a) = solver(Workers::Serial, 3);
    let (second, b) = solver(Workers::Serial, 3);
    // Equal marks happen by chance once in 65,536 pairs of solvers; these two live at the same time, at different places.
    assert_ne!(a, b);
    assert!(second.curvatures(a[0]).is_err() && first.reset_strands(&b).is_err());
}

#[test]
fn a_snapshot_goes_on_bit_for_bit_in_this_solver_and_in_another() {
    let (mut solver, ids) = solver(Workers::Serial, 20);
    run(&mut solver, &ids, 5);
    // In the middle of a root's motion.
    solver.set_root_frames(&ids, &vec![Frame { origin: Vector3::new(0.1, 0.0, 0.0), ..Frame::default() }; 20], 0.1).unwrap();
    solver.step(0.03, 2).unwrap();
    solver.remove_strands(&[ids[4]]).unwrap();
    let image = solver.snapshot();
    let hash = solver.state_hash();
    solver.step(0.05, 3).unwrap();
    let after = solver.state_hash();
    assert_ne!(hash, after);
    solver.restore(&image).unwrap();
    assert_eq!(solver.state_hash(), hash);
    solver.step(0.05, 3).unwrap();
    assert_eq!(solver.state_hash(), after);

    let mut other = Solver::new(SolverOptions { workers: Workers::Pool(2), ..SolverOptions::default() }).unwrap();
    other.restore(&image).unwrap();
    assert_eq!(other.snapshot(), image);
    other.step(0.05, 3).unwrap();
    assert_eq!(other.state_hash(), after);
    assert!(other.has_strand(ids[0]) && !other.has_strand(ids[4]));
}

#[test]
fn damaged_snapshots_are_refused_and_change_nothing() {
    let (mut solver, ids) = solver(Workers::Serial, 3);
    run(&mut solver, &ids, 2);
    let image = solver.snapshot();
    let hash = solver.state_hash();
    for length in [0, 5, 19, 27, 28, image.len() / 2, image.len() - 1] {
        assert!(matches!(solver.restore(&image[..length]), Err(Error::Snapshot { .. })), "{length}");
    }
    for at in (0..image.len()).step_by(7) {
        let mut bad = image.clone();
        bad[at] ^= 0x41;
        assert!(matches!(solver.restore(&bad), Err(Error::Snapshot { .. })), "byte {at}");
    }
    // A body that lies behind a right checksum: lengths are checked before memory is taken.
    for at in (20..image.len() - 8).step_by(4) {
        let mut bad = image.clone();
        bad[at..at + 4].copy_from_slice(&0xffff_ff7f_u32.to_le_bytes());
        let end = bad.len() - 8;
        let sum = bad[20..end].iter().fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(*b)).wrapping_mul(0x100_0000_01b3));
        bad[end..].copy_from_slice(&sum.to_le_bytes());
        let mut victim = Solver::new(SolverOptions::default()).unwrap();
        // Some of these are merely other numbers; none may panic or hang, and a step afterwards must be safe.
        if victim.restore(&bad).is_ok() {
            let _ = victim.step(1e-3, 1);
        }
    }
    assert_eq!(solver.state_hash(), hash);
}

#[test]
fn bad_calls_name_the_argument_and_change_nothing() {
    let (mut solver, ids) = solver(Workers::Serial, 4);
    run(&mut solver, &ids, 2);
    let hash = solver.state_hash();
    let stale = StrandId::from_bits(12345);
    let nan = f64::NAN;
    let mut bad_defs = Vec::new();
    let mut spoil = |f: &dyn Fn(&mut StrandDef)| {
        let mut def = strand(3);
        f(&mut def);
        bad_defs.push(def);
    };
    spoil(&|d| d.element_lengths.clear());
    spoil(&|d| d.element_lengths[1] = -1.0);
    spoil(&|d| d.element_lengths[1] = nan);
    spoil(&|d| d.natural[0][2] = f64::INFINITY);
    spoil(&|d| d.natural.truncate(1));
    spoil(&|d| d.material.radius[1] = 0.0);
    spoil(&|d| d.material.density = -1300.0);
    spoil(&|d| d.material.radius = [1e100; 2]);
    spoil(&|d| d.material.poisson_ratio = 0.51);
    spoil(&|d| d.material.internal_friction = -1e-9);
    spoil(&|d| d.material.viscosity = nan);
    spoil(&|d| d.material.air_drag = -1.0);
    spoil(&|d| d.initial = Some(vec![[0.0; 3]; 99]));
    spoil(&|d| d.initial_rates = Some(vec![[nan; 3]; 4]));
    spoil(&|d| d.root_velocity.y = nan);
    for def in &bad_defs {
        let error = solver.add_strands(&[strand(1), def.clone()]).unwrap_err();
        assert!(error.to_string().starts_with("strands[1]"), "{error}");
    }
    let frame = Frame::default();
    let failures = [
        solver.step(nan, 1).err(),
        solver.step(0.0, 1).err(),
        solver.step(-1.0, 1).err(),
        solver.step(f64::INFINITY, 1).err(),
        solver.step(0.1, 0).err(),
        solver.step(f64::MIN_POSITIVE, u32::MAX).err(),
        solver.set_gravity(Vector3::new(0.0, nan, 0.0)).err(),
        solver.set_wind(Vector3::new(f64::INFINITY, 0.0, 0.0)).err(),
        solver.set_root_frames(&ids, &[frame], 0.1).err(),
        solver.set_root_frames(&[stale], &[frame], 0.1).err(),
        solver.set_root_frames(&ids[..1], &[frame], -0.1).err(),
        solver.teleport_roots(&[ids[0], stale], &[frame, frame]).err(),
        solver.set_natural_curvatures(ids[0], &[]).err(),
        solver.set_natural_curvatures(stale, &[[0.0; 3]]).err(),
        solver.set_curvatures(ids[0], &[[nan; 3]], None).err(),
        solver.set_curvatures(ids[0], &[[0.0; 3]], Some(&[[nan; 3]])).err(),
        solver.reset_strands(&[ids[1], stale]).err(),
        solver.sample_strands(&ids, 1, |_, _, _| ()).err(),
        solver.sample_at(ids[0], &[-1e-9], |_, _| ()).err(),
        solver.sample_at(ids[0], &[1.0], |_, _| ()).err(),
        solver.sample_at(ids[0], &[nan], |_, _| ()).err(),
        solver.status(stale).err(),
        solver.energies(stale).err(),
        solver.root_wrench(stale).err(),
    ];
    for (k, failure) in failures.iter().enumerate() {
        assert!(failure.is_some(), "call {k} was accepted");
    }
    assert_eq!(solver.state_hash(), hash);
    for workers in [Workers::Pool(1), Workers::Pool(100_000)] {
        assert!(Solver::new(SolverOptions { workers, ..SolverOptions::default() }).is_err());
    }
}

#[test]
fn samples_cover_the_strand_and_agree_with_each_other() {
    let (mut solver, ids) = solver(Workers::Serial, 6);
    run(&mut solver, &ids, 4);
    let id = ids[5];
    let length: f64 = solver.element_lengths(id).unwrap().iter().sum();
    let mut uniform = Vec::new();
    solver.sample_strands(&[id], 9, |_, _, sample| uniform.push(*sample)).unwrap();
    let arclengths: Vec<f64> = (0..9).rev().map(|k| length * f64::from(k) / 8.0).collect();
    let mut given = Vec::new();
    solver.sample_at(id, &arclengths, |_, sample| given.push(*sample)).unwrap();
    given.reverse();
    for (a, b) in uniform.iter().zip(&given) {
        assert!((a.position - b.position).norm() < 1e-15 && (a.velocity - b.velocity).norm() < 1e-12);
        assert!(a.rotation.angle_to(&b.rotation) < 1e-7);
    }
    assert_eq!(uniform[0].position, solver.root_frame(id).unwrap().origin);
    // The tangent is n0, and the velocity is the point's displacement over a short step.
    let small = 1e-7;
    for sample in &uniform[1..8] {
        let mut near = Vec::new();
        solver.sample_at(id, &[sample.arclength - small, sample.arclength + small], |_, s| near.push(s.position)).unwrap();
        let tangent = (near[1] - near[0]) / (2.0 * small);
        assert!((tangent - sample.rotation * Vector3::x()).norm() < 1e-6);
    }
    let before: Vec<_> = uniform.iter().map(|s| s.position).collect();
    solver.step(1e-6, 1).unwrap();
    let mut after = Vec::new();
    solver.sample_strands(&[id], 9, |_, _, s| after.push((s.position, s.velocity))).unwrap();
    for ((position, velocity), from) in after.iter().zip(&before).skip(1) {
        let moved = (position - from) / 1e-6;
        // The mean velocity of the motion against the one at its end: apart by the acceleration (hundreds of m/s²) times 1e-6 s.
        assert!((moved - velocity).norm() < 1e-3 * (1.0 + velocity.norm()), "{moved} {velocity}");
    }
}

#[test]
fn memory_is_counted() {
    let (small, _) = solver(Workers::Serial, 1);
    let mut large = Solver::new(SolverOptions::default()).unwrap();
    let mut def = StrandDef::straight(0.1, 5);
    def.natural = vec![[0.0, 10.0, 0.0]; 5];
    large.add_strands(&vec![def; 1000]).unwrap();
    let each = (large.memory_usage() - small.memory_usage()) as f64 / 1000.0;
    println!("{each} bytes a strand of five elements");
    assert!((1000.0..4000.0).contains(&each), "{each}");
}

/// A solver accepts its own output: two-step differences must leave a frozen curvature no rate of rounding, which would be refused.
#[test]
fn shapes_and_rates_go_out_and_in_again() {
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let mut def = strand(1);
    def.freedoms = Freedoms::BEND1;
    def.natural.iter_mut().for_each(|row| *row = [7.3, 11.1, -3.7]);
    def.initial = None;
    let id = solver.add_strands(&[def]).unwrap()[0];
    for step in 0..20 {
        solver.step(1e-4 * f64::from(1 + step), 1).unwrap();
        let rates = solver.rates(id).unwrap().to_vec();
        assert!(rates.iter().all(|row| row[0] == 0.0 && row[2] == 0.0 && row[1] != 0.0), "{rates:?}");
        let shape = solver.curvatures(id).unwrap().to_vec();
        let mut other = Solver::new(SolverOptions::default()).unwrap();
        other.restore(&solver.snapshot()).unwrap();
        other.set_curvatures(id, &shape, Some(&rates)).unwrap();
    }
}
