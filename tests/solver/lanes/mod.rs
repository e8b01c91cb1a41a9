//! Lanes: the numbers are the same to the bit for any number of threads and any number of strands side by side.

mod golden;
mod scene;

use std::sync::Arc;

use golden::{GOLDEN, golden_options, options};
use nalgebra::Vector3;
use scene::{STEP, bits, course, strand, swayed, thrown};
use superhelix::{
    Frame, Freedoms, InstructionSet, Integrator, ParallelFor, Precision, Solver, SolverOptions, StrandDef, StrandStatus, Workers,
};

/// All that this machine has.
fn instruction_sets() -> Vec<InstructionSet> {
    let all = [InstructionSet::Scalar, InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512];
    all.into_iter().filter(|set| *set <= InstructionSet::detected()).collect()
}

/// A host's task system that hands out uneven ranges, last first, on threads of its own.
struct Host;

impl ParallelFor for Host {
    fn run(&self, count: u32, _min_range: u32, task: &(dyn Fn(u32, u32, u32) + Sync)) {
        std::thread::scope(|scope| {
            let (mut end, mut worker) = (count, 0);
            while end > 0 {
                let begin = end.saturating_sub(1 + worker % 3);
                let range = (begin, end);
                scope.spawn(move || task(range.0, range.1, worker % 4));
                (end, worker) = (begin, worker + 1);
            }
        });
    }
}

#[test]
fn all_instruction_sets_and_workers_give_the_same_bits_and_reports() {
    let mut found = Vec::new();
    for (integrator, precision, golden) in GOLDEN {
        let run = |set, workers| course(SolverOptions { workers, ..golden_options(integrator, precision, set) });
        let (reports, hash) = run(InstructionSet::Scalar, Workers::Serial);
        // The scene has what it is for.
        let count = |of: fn(&superhelix::StepReport) -> u32| reports.iter().map(of).sum::<u32>();
        assert!(count(|report| report.quarantined) >= 7, "{reports:?}");
        if integrator != Integrator::LinearlyImplicit {
            assert!(count(|report| report.subdivided) >= 8 && count(|report| report.unconverged) >= 2, "{reports:?}");
        }
        for set in instruction_sets() {
            for workers in [Workers::Serial, Workers::Pool(2), Workers::Pool(3), Workers::Pool(8), Workers::Host(Arc::new(Host))]
            {
                let name = format!("{integrator:?} {precision:?} {set:?} {workers:?}");
                let (others, other) = run(set, workers);
                assert_eq!(others, reports, "{name}");
                assert_eq!(other, hash, "{name}");
            }
        }
        found.push((integrator, precision, hash, golden));
    }
    for (integrator, precision, hash, _) in &found {
        println!("(Integrator::{integrator:?}, Precision::{precision:?}, 0x{hash:016x}),");
    }
    for (integrator, precision, hash, golden) in found {
        assert_eq!(hash, golden, "{integrator:?} {precision:?}");
    }
}

/// Strands of one kind, of which one is shaken and one is thrown off: five elements, curly.
fn alike(k: u64) -> StrandDef {
    let mut def = StrandDef::straight(0.1 + 0.004 * k as f64, 5);
    def.natural = vec![[1.0, 3.0 + k as f64, 0.5]; 5];
    def.material.air_drag = 1e-6 * (k + 1) as f64;
    def.root = swayed(3 * k + 1, 0);
    def.user_data = k;
    def
}

/// Where their roots go: number 2's is shaken, number 5's thrown, the others' sway.
fn alike_root(k: u64, step: u32) -> Frame {
    match k {
        2 => swayed(3, step),
        5 if step == 2 => thrown(),
        _ => swayed(3 * k + 1, step),
    }
}

/// Steps strands together; what becomes of each.
fn together(options: SolverOptions, defs: &[StrandDef], steps: u32) -> Vec<Vec<u64>> {
    let mut solver = Solver::new(options).unwrap();
    let ids = solver.add_strands(defs).unwrap();
    let mut all = vec![Vec::new(); ids.len()];
    for step in 1..=steps {
        let frames: Vec<_> = defs.iter().map(|def| alike_root(def.user_data, step)).collect();
        solver.set_root_frames(&ids, &frames, STEP).unwrap();
        solver.step(STEP, 1).unwrap();
        for (all, id) in all.iter_mut().zip(&ids) {
            all.extend(bits(&solver, *id));
        }
    }
    all
}

#[test]
fn packs_of_every_size_give_each_strand_what_it_gets_alone() {
    let defs: Vec<_> = (0..17).map(alike).collect();
    for precision in [Precision::F64, Precision::F32] {
        let alone: Vec<_> = defs
            .iter()
            .map(|def| together(options(precision, InstructionSet::Scalar), std::slice::from_ref(def), 4).remove(0))
            .collect();
        for set in instruction_sets() {
            for size in 1..=17 {
                assert!(
                    together(options(precision, set), &defs[..size], 4) == alone[..size],
                    "{precision:?} {set:?}, {size} strands"
                );
            }
        }
    }
}

#[test]
fn a_lane_that_has_converged_is_not_disturbed_by_slow_and_by_failing_ones() {
    for precision in [Precision::F64, Precision::F32] {
        let mut options = options(precision, InstructionSet::detected());
        options.step.max_subdivisions = 0;
        let mut solver = Solver::new(options.clone()).unwrap();
        let defs: Vec<_> = (0..8).map(alike).collect();
        let ids = solver.add_strands(&defs).unwrap();
        let mut slowest = 0;
        for step in 1..=6 {
            let frames: Vec<_> = (0..8).map(|k| alike_root(k, step)).collect();
            solver.set_root_frames(&ids, &frames, STEP).unwrap();
            solver.step(STEP, 1).unwrap();
            if step == 2 {
                assert_eq!(solver.status(ids[5]), Ok(StrandStatus::Quarantined));
            }
            let [slow, quick] = [2, 0].map(|k| solver.iterations(ids[k]).unwrap());
            slowest = slowest.max(slow.saturating_sub(quick));
        }
        // One of the pack goes on for several iterations after another has ended: that is what the test is about.
        assert!(slowest >= 3, "{precision:?}: {slowest}");
        let calm = |k: u64| k != 2 && k != 5;
        let without: Vec<_> = defs.iter().filter(|def| calm(def.user_data)).cloned().collect();
        let all: Vec<_> =
            together(options.clone(), &defs, 6).into_iter().zip(0..).filter_map(|(bits, k)| calm(k).then_some(bits)).collect();
        assert!(all == together(options, &without, 6), "{precision:?}");
    }
}

#[test]
fn neither_order_nor_the_fate_of_others_changes_a_result() {
    for precision in [Precision::F64, Precision::F32] {
        let run = |numbers: &[u64], gone: &[u64]| {
            let mut solver = Solver::new(options(precision, InstructionSet::detected())).unwrap();
            let defs: Vec<_> = numbers.iter().map(|k| strand(*k)).collect();
            let mut ids = solver.add_strands(&defs).unwrap();
            for step in 1..=4 {
                if step == 3 {
                    let removed: Vec<_> =
                        ids.iter().copied().filter(|id| gone.contains(&solver.user_data(*id).unwrap())).collect();
                    solver.remove_strands(&removed).unwrap();
                    ids.retain(|id| solver.has_strand(*id));
                }
                let frames: Vec<_> = ids.iter().map(|id| swayed(solver.user_data(*id).unwrap(), step)).collect();
                solver.set_root_frames(&ids, &frames, STEP).unwrap();
                solver.step(STEP, 1).unwrap();
            }
            let mut found: Vec<_> = ids.iter().map(|id| (solver.user_data(*id).unwrap(), bits(&solver, *id))).collect();
            found.sort();
            found
        };
        let numbers: Vec<u64> = (0..40).collect();
        let expected = run(&numbers, &[]);
        let backwards: Vec<u64> = numbers.iter().rev().copied().collect();
        // 7 and 40 have no common divisor: every number comes once.
        let shuffled: Vec<u64> = numbers.iter().map(|k| (7 * k + 3) % 40).collect();
        assert!(run(&backwards, &[]) == expected && run(&shuffled, &[]) == expected, "{precision:?}");
        let gone = [0, 5, 6, 17, 30];
        let left: Vec<_> = expected.into_iter().filter(|(k, _)| !gone.contains(k)).collect();
        assert!(run(&shuffled, &gone) == left, "{precision:?}");
    }
}

#[test]
fn an_instruction_set_that_the_machine_lacks_is_refused() {
    for set in [InstructionSet::Scalar, InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512] {
        let made = Solver::new(options(Precision::F64, set));
        assert_eq!(made.is_ok(), set <= InstructionSet::detected(), "{set:?}");
    }
}

/// Single precision has units of its own a strand: lengths, densities and steps far from 1 do not drown.
#[test]
fn single_precision_is_indifferent_to_the_units() {
    // The same strand a thousand times smaller, with gravity and stiffness such that every number of the motion scales: the same bits but
    // for the exponents, since 1024 is a power of two.
    let scale = 1024.0;
    let run = |scale: f64| {
        let mut options = options(Precision::F32, InstructionSet::detected());
        options.gravity = Vector3::new(0.0, 0.0, -8.0 / scale);
        let mut solver = Solver::new(options).unwrap();
        let mut def = StrandDef::straight(0.25 / scale, 6);
        def.natural = vec![[2.0 * scale, 8.0 * scale, 0.0]; 6];
        def.material.radius = [5e-5 / scale; 2];
        // EI ~ E a⁴ against ρ a² g L³: E scales as the product of gravity and length.
        def.material.youngs_modulus = 1e9 / (scale * scale);
        def.freedoms = Freedoms::ALL;
        let id = solver.add_strands(&[def]).unwrap()[0];
        for _ in 0..20 {
            let report = solver.step(STEP, 1).unwrap();
            assert_eq!((report.unconverged, report.quarantined), (0, 0));
        }
        let curvatures: Vec<_> = solver.curvatures(id).unwrap().iter().flatten().map(|k| k / scale).collect();
        (curvatures, solver.iterations(id).unwrap())
    };
    assert_eq!(run(1.0), run(scale));
}
