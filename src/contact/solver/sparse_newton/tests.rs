//! Stacks of strands and random problems, against elimination with all numbers in one matrix.

use std::sync::Arc;

use super::*;
use crate::contact::constraint::law::Law;
use crate::contact::solver::dense;
use crate::contact::solver::gauss_seidel::tests::{Backwards, POINTS, cantilevers, touch};
use crate::contact::solver::gauss_seidel::{GaussSeidel, Scales, Settings};
use crate::contact::solver::system::Row;
use crate::math::random::{Seeded, unit_numbers};
use crate::workers::Workers;

/// Strands that lie on each other, each at three places, the lowest on the ground; a load presses and pulls them all.
fn stack(height: u32, load: f64) -> ContactSpace {
    let mut space = cantilevers(height);
    for strand in 0..height {
        for point in [1, 2, 4] {
            let below = (strand > 0).then(|| (strand - 1, point));
            // What the load does to the uppermost, its neighbour does not feel without contacts.
            let part = if strand + 1 == height { load } else { 0.01 };
            let unconstrained = Vector3::new(0.02 * part * f64::from(point), 0.0, -part);
            touch(&mut space, (strand, point), below, Vector3::z(), unconstrained);
        }
    }
    space
}

/// Strands that touch others at random, some themselves, some the ground.
fn random(seed: u64) -> ContactSpace {
    let mut unit = unit_numbers(seed, 0);
    let count = 30;
    let mut space = cantilevers(count);
    for _ in 0..150 {
        let mut pick = |most: u32| (unit() * f64::from(most)) as u32;
        let (strand, point, kind, reach, other) = (pick(count), pick(POINTS), pick(10), pick(3), pick(POINTS));
        let second = match kind {
            0 => None,
            1 if other != point => Some((strand, other)),
            _ => Some(((strand + 1 + reach) % count, other)),
        };
        let normal = Vector3::new(unit() - 0.5, unit() - 0.5, unit() + 0.1).normalize();
        let unconstrained = Vector3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5);
        touch(&mut space, (strand, point), second, normal, unconstrained);
    }
    space
}

/// Strands that touch others at random, some twice at one place, by normals that differ a little: these pairs of contacts hardly differ
/// in what they move. Loads differ by up to half of `change`, a fraction, from those without.
fn twice_at_a_place(seed: u64, change: f64) -> ContactSpace {
    let mut unit = unit_numbers(seed, 9);
    let count = 60;
    let mut space = cantilevers(count);
    for _ in 0..220 {
        let mut pick = |most: u32| (unit() * f64::from(most)) as u32;
        let (strand, point, kind, reach, other) = (pick(count), pick(POINTS), pick(10), pick(3), pick(POINTS));
        let second = (kind > 0).then_some(((strand + 1 + reach) % count, other));
        let normal = Vector3::new(unit() - 0.5, unit() - 0.5, unit() + 0.1).normalize();
        let unconstrained = Vector3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5) * (1.0 + change * (unit() - 0.5));
        touch(&mut space, (strand, point), second, normal, unconstrained);
        if unit() < 0.3 {
            let turned = (normal + Vector3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5) * 0.3).normalize();
            touch(&mut space, (strand, point), second, turned, unconstrained * (0.9 + 0.2 * unit()));
        }
    }
    space
}

/// All laws, linearised where the forces bring the strands.
fn linearised(space: &ContactSpace, system: &System, forces: &[Vector3<f64>]) -> Vec<Linear> {
    let law = |(row, force): (&Row, &Vector3<f64>)| {
        space.constraints()[row.constraint].law.linearise(&system.relative(row), force, &row.response, space.step())
    };
    system.rows.iter().zip(forces).map(law).collect()
}

#[test]
fn the_equations_are_solved_as_one_matrix_is_and_with_the_same_bits_for_any_number_of_threads() {
    for seed in 0..10 {
        let space = random(seed);
        let mut system = System::default();
        system.prepare(&space);
        let m = system.rows.len();
        let numbers = Seeded::new(seed, 1);
        let mut forces = Vec::new();
        for (index, constraint) in space.constraints().iter().enumerate() {
            let Law::Contact(contact) = constraint.law else { unreachable!() };
            let side = Vector3::from_fn(|i, _| numbers.unit((3 * index + i) as u64) - 0.5);
            forces.push(if index % 7 == 0 { Vector3::zeros() } else { (contact.normal + side * 0.5) * 0.01 });
            let force = forces[index];
            system.push(&space, index, &force);
        }
        let linear = linearised(&space, &system, &forces);
        let damping = 1e-6;
        let mut matrix = vec![0.0; 9 * m * m];
        let mut expected: Vec<f64> =
            linear.iter().flat_map(|linear| (-linear.residual).iter().copied().collect::<Vec<_>>()).collect();
        for i in 0..m {
            for j in 0..m {
                let mut response = system.coupling(&space, &system.rows[i], &system.rows[j]);
                if i == j {
                    response += nalgebra::Matrix3::identity() * (damping * system.rows[i].response.trace());
                }
                let mut entry = linear[i].by_displacement * response;
                if i == j {
                    entry += linear[i].by_force;
                }
                for r in 0..3 {
                    for c in 0..3 {
                        matrix[(3 * i + r) * 3 * m + 3 * j + c] = entry[(r, c)];
                    }
                }
            }
        }
        assert!(dense::solve(&mut matrix, &mut expected, &Meter::unlimited()));
        let scale = expected.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        let mut first: Option<Vec<Vector3<f64>>> = None;
        for setting in [Workers::Pool(1), Workers::Pool(2), Workers::Pool(3), Workers::Host(Arc::new(Backwards))] {
            let workers = WorkerSet::<()>::new(&setting).unwrap();
            let (mut equations, mut changes) = (Multifrontal::default(), Vec::new());
            // Twice, for memory that is used again.
            for _ in 0..2 {
                let work = equations.prepare(&system, &linear, u64::MAX).unwrap();
                assert_eq!(equations.prepare(&system, &linear, work - 1), None);
                assert_eq!(equations.prepare(&system, &linear, work), Some(work));
                let problem = Linearised { space: &space, system: &system, linear: &linear, damping };
                assert!(equations.solve(problem, &mut changes, &workers, &Meter::unlimited()));
                for (change, expected) in changes.iter().zip(expected.as_chunks::<3>().0) {
                    // (Both lose some six digits to the nearly singular directions that the damping holds.)
                    assert!((change - Vector3::from(*expected)).norm() < 1e-7 * scale, "{seed}: {change} {expected:?}");
                }
                assert_eq!(first.get_or_insert_with(|| changes.clone()), &changes, "{seed}");
            }
        }
    }
}

#[test]
fn a_tall_stack_is_solved_from_near_its_solution_where_sweeps_would_take_thousands() {
    let settings = Settings { tolerance: 1e-8, ..Settings::default() };
    let (before, after) = (stack(60, 1.0), stack(60, 1.05));
    let mut forces = vec![Vector3::zeros(); before.constraints().len()];
    let mut solver = GaussSeidel::default();
    let report = solver.solve(&before, &Settings { max_sweeps: 100_000, ..settings }, &mut forces);
    assert!(report.residual <= settings.tolerance, "{report:?}");
    let report = solver.solve(&after, &settings, &mut forces);
    assert!(report.residual <= settings.tolerance, "{report:?}");
    assert!(report.sweeps <= 30, "{report:?}");
    // The load of the uppermost arrives at the ground.
    let on_the_ground: f64 = forces[..3].iter().map(|force| force.z).sum();
    let on_top: f64 = forces[forces.len() - 3..].iter().map(|force| force.z).sum();
    assert!(on_the_ground > 0.1 * on_top && on_top > 0.0, "{on_the_ground} {on_top}");
}

#[test]
fn what_holds_up_all_contacts_at_once_is_solved_by_itself() {
    let settings = Settings { scales: Scales::Fixed { force: 1e-3, length: 1e-3 }, ..Settings::default() };
    for seed in [4, 51] {
        let space = twice_at_a_place(seed, 0.0);
        let mut forces = vec![Vector3::zeros(); space.constraints().len()];
        let settings = Settings { tolerance: 1e-3, ..settings };
        let report = GaussSeidel::default().solve(&space, &settings, &mut forces);
        assert!(report.residual <= settings.tolerance, "{seed}: {report:?}");
        for change in [1e-3, 1e-2] {
            let settings = Settings { tolerance: 1e-6, ..settings };
            let report = GaussSeidel::default().solve(&twice_at_a_place(seed, change), &settings, &mut forces.clone());
            assert!(report.residual <= settings.tolerance, "{seed}, {change}: {report:?}");
        }
    }
}
