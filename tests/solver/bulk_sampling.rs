//! Strands sampled in bulk, side by side and in f32, against a pass along each of them in f64; and the same bits for any number of threads.

use std::sync::Mutex;

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::reading::{Real, SampleSink, Tile, Wanted};
use superhelix::{Frame, InstructionSet, Material, Sample, Solver, SolverOptions, StrandDef, StrandId, Workers};

/// Position, quaternion x, y, z, w, velocity.
type Numbers = [f64; 10];

/// The samples of every point; a point that comes twice is an error.
struct Collected {
    points: usize,
    numbers: Mutex<Vec<Option<Numbers>>>,
}

impl<T: Real> SampleSink<T> for Collected {
    fn take(&self, tile: &Tile<T>) {
        let mut numbers = self.numbers.lock().unwrap();
        for (lane, strand) in tile.strands.iter().enumerate() {
            for point in 0..tile.count {
                let mut here = [0.0; 10];
                (0..3).for_each(|axis| here[axis] = tile.positions[point][axis][lane].into());
                (0..4).for_each(|number| here[3 + number] = tile.rotations[point][number][lane].into());
                (0..3).for_each(|axis| here[7 + axis] = tile.velocities[point][axis][lane].into());
                let place = &mut numbers[*strand as usize * self.points + tile.first + point];
                assert!(place.replace(here).is_none(), "strand {strand}, point {point} twice");
            }
        }
    }
}

fn bulk<T: Real>(solver: &Solver, ids: &[StrandId], points: usize, origin: Vector3<f64>) -> Vec<Numbers> {
    let wanted = Wanted { points_per_strand: points, origin, positions: true, rotations: true, velocities: true };
    let sink = Collected { points, numbers: Mutex::new(vec![None; ids.len() * points]) };
    solver.sample_tiles::<T>(ids, &wanted, &sink).unwrap();
    sink.numbers.into_inner().unwrap().into_iter().map(|here| here.expect("every point comes")).collect()
}

/// Strands of many kinds mixed: equal elements and not, one to forty, straight and curled up to thirty radians an element; swinging.
fn head(workers: Workers, instruction_set: Option<InstructionSet>) -> (Solver, Vec<StrandId>) {
    let mut solver = Solver::new(SolverOptions { workers, instruction_set, ..SolverOptions::default() }).unwrap();
    let defs: Vec<StrandDef> = (0..200)
        .map(|k| {
            let count = [5, 5, 5, 1, 3, 40, 5, 10][k % 8];
            let mut def = StrandDef::straight(0.05 + 0.001 * k as f64, count);
            if k % 11 == 3 {
                def.element_lengths.iter_mut().enumerate().for_each(|(e, length)| *length *= 1.0 + 0.1 * (e % 3) as f64);
            }
            let bend = if k == 50 { 30.0 / def.element_lengths[0] } else { 2.0 * (k % 7) as f64 };
            def.natural = vec![[0.3 * bend, bend, 0.1]; count];
            def.material = Material { viscosity: 5e-3, air_drag: 5e-6, ..Material::default() };
            def.root = Frame {
                origin: Vector3::new(0.001 * k as f64, 0.1, 1.7),
                rotation: UnitQuaternion::from_euler_angles(0.1 * k as f64, 0.7, 0.02 * k as f64),
            };
            def
        })
        .collect();
    let ids = solver.add_strands(&defs).unwrap();
    solver.step(0.01, 4).unwrap();
    (solver, ids)
}

fn exact(solver: &Solver, ids: &[StrandId], points: usize) -> Vec<Sample> {
    let mut samples = Vec::new();
    solver.sample_strands(ids, points, |_, _, sample| samples.push(*sample)).unwrap();
    samples
}

/// Farthest from the walk along each strand: positions in the strands' lengths, frames in radians, velocities in the largest of them.
fn errors<T: Real>(points: usize, rounding: f64) -> [f64; 3] {
    let (solver, ids) = head(Workers::Serial, None);
    let origin = Vector3::new(0.1, 0.0, 1.7);
    let samples = exact(&solver, &ids, points);
    let fastest = samples.iter().map(|sample| sample.velocity.norm()).fold(0.0, f64::max);
    assert!(fastest > 0.01);
    let mut worst = [0.0_f64; 3];
    for (item, (here, sample)) in bulk::<T>(&solver, &ids, points, origin).iter().zip(&samples).enumerate() {
        let lengths = solver.element_lengths(ids[item / points]).unwrap();
        let (length, point) = (lengths.iter().sum::<f64>(), item % points);
        // On a border of two elements rounding says which of them the walk reads the velocity from, a polynomial in each: these differ.
        let on_border = point > 0 && point < points - 1 && (point * lengths.len()).is_multiple_of(points - 1);
        let expected = sample.position - origin;
        for axis in 0..3 {
            // Output is rounded to the number type: half a unit in the last place is not the sampling's.
            let off = (here[axis] - expected[axis]).abs() - rounding * expected[axis].abs();
            worst[0] = worst[0].max(off / length);
            let off = (here[7 + axis] - sample.velocity[axis]).abs() / fastest;
            if !on_border {
                worst[2] = worst[2].max(off);
            }
        }
        let rotation = nalgebra::Quaternion::new(here[6], here[3], here[4], here[5]);
        assert!((rotation.norm() - 1.0).abs() < 1e-6);
        let between = (rotation.conjugate() * sample.rotation.quaternion()).imag().norm();
        worst[1] = worst[1].max(2.0 * between);
    }
    worst
}

#[test]
fn bulk_samples_are_those_of_each_strand() {
    for points in [2, 3, 16, 17, 50] {
        let single = errors::<f32>(points, f64::from(f32::EPSILON) / 2.0);
        let double = errors::<f64>(points, f64::EPSILON / 2.0);
        println!("{points} points: f32 {single:?} (lengths, rad, largest velocity), f64 {double:?}");
        // The promise is 1e-6; f64: rounding of 40 elements' products, and of places on the strand.
        assert!(single.iter().all(|error| *error < 1e-6), "{points}: {single:?}");
        assert!(double.iter().all(|error| *error < 1e-12), "{points}: {double:?}");
    }
}

#[test]
fn samples_do_not_depend_on_threads_instructions_or_neighbours() {
    let (solver, ids) = head(Workers::Serial, Some(InstructionSet::Scalar));
    let expected = bulk::<f32>(&solver, &ids, 7, Vector3::zeros());
    let same = |numbers: &[Numbers], expected: &[Numbers]| {
        numbers.iter().flatten().zip(expected.iter().flatten()).all(|(a, b)| a.to_bits() == b.to_bits())
    };
    for (k, id) in ids.iter().enumerate() {
        assert!(same(&bulk::<f32>(&solver, &[*id], 7, Vector3::zeros()), &expected[7 * k..7 * (k + 1)]), "strand {k} alone");
    }
    let sets = [InstructionSet::Scalar, InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512];
    for set in sets.into_iter().filter(|set| *set <= InstructionSet::detected()) {
        for threads in [1, 2, 3, 8] {
            let workers = if threads == 1 { Workers::Serial } else { Workers::Pool(threads) };
            let (solver, ids) = head(workers, Some(set));
            // The strands many times over: enough for every thread to get some.
            let many: Vec<StrandId> = ids.iter().cycle().take(20 * ids.len()).copied().collect();
            let numbers = bulk::<f32>(&solver, &many, 7, Vector3::zeros());
            for again in numbers.chunks(expected.len()) {
                assert!(same(again, &expected), "{set:?}, {threads} threads");
            }
        }
    }
}

#[test]
fn errors_are_reported_before_anything_is_sampled() {
    let (mut solver, ids) = head(Workers::Serial, None);
    solver.remove_strands(&ids[3..4]).unwrap();
    let wanted = Wanted { points_per_strand: 4, origin: Vector3::zeros(), positions: true, rotations: false, velocities: false };
    struct Nothing;
    impl SampleSink<f32> for Nothing {
        fn take(&self, _: &Tile<f32>) {
            panic!("a tile");
        }
    }
    let error = solver.sample_tiles(&ids[..5], &wanted, &Nothing).unwrap_err().to_string();
    assert!(error.contains("ids[3]"), "{error}");
    let error = solver.sample_tiles(&[], &Wanted { points_per_strand: 1, ..wanted }, &Nothing).unwrap_err().to_string();
    assert!(error.contains("points_per_strand"), "{error}");
    solver.sample_tiles(&[], &wanted, &Nothing).unwrap();
}
