//! Shafts that spin about their own axis, against linear theory, and a curl shaken up and down (Bertails et al. 2006, figure 7).

use crate::rods::judge::{record, recording};
use crate::rods::modes::{Mode, matrices, modes};
use crate::rods::*;
use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::EquilibriumOptions;
use superhelix::internals::step::equilibrium::of_strand;
use superhelix::{Frame, Integrator, Solver, SolverOptions, StrandDef};

/// The evolution of a spinning shaft's small deflection: the growth rate, 1/s, and the whirl rate, rad/s.
struct Whirl {
    growth: f64,
    round: f64,
}

/// Theory: the deflection z = x + iy of a mode obeys z̈ + c ż + d (ż − iΩz) + ω²z = 0; c is air drag, felt in the room, d internal
/// friction, felt in the shaft's own axes, which turn at Ω. The faster growing root of s² + (c + d) s + ω² − iΩd = 0. For c = 0 it
/// grows above Ω = ω: the first critical speed is the first natural frequency; in general above ω(1 + c/d).
fn theory(mode: &Mode, outer: f64, inner: f64, spin: f64) -> Whirl {
    // s = −b + √(b² − ω² + iΩd), b = (c + d)/2.
    let b = 0.5 * (outer + inner);
    let (real, imaginary) = (b * b - mode.omega.powi(2), spin * inner);
    let size = (real.hypot(imaginary)).sqrt();
    let half = 0.5 * imaginary.atan2(real);
    Whirl { growth: -b + size * half.cos(), round: size * half.sin() }
}

/// The engine: a shaft spun at `spin`, plucked by its first mode, followed by the reference integrator over `turns` of the mode.
fn measured(def: &StrandDef, gravity: Vector3<f64>, mode: &Mode, spin: f64, turns: f64) -> Whirl {
    let mut def = def.clone();
    let amplitude = 1e-5 / mode.shape.amax() / LENGTH;
    def.initial = Some((0..def.element_lengths.len()).map(|element| [0.0, amplitude * mode.shape[element], 0.0]).collect());
    def.root_angular_velocity = def.root.rotation * Vector3::x() * spin;
    let mut options = SolverOptions { gravity, ..SolverOptions::default() };
    (options.step.integrator, options.step.reference_tolerance) = (Integrator::Reference, 1e-10);
    let mut solver = Solver::new(options).unwrap();
    let id = solver.add_strands(std::slice::from_ref(&def)).unwrap()[0];
    // A frame in at most an eighth of a turn of the root: it is followed by cubics that meet a steady turn exactly.
    let period = std::f64::consts::TAU / mode.omega;
    let dt = (period / 16.0).min(0.7 / spin);
    let calls = (turns * period / dt).ceil() as u32;
    let mut path: Vec<(f64, f64, f64)> = Vec::new();
    let mut before = 0.0;
    let mut angle = 0.0;
    for call in 1..=calls {
        let t = dt * f64::from(call);
        let rotation = def.root.rotation * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), spin * t);
        solver.set_root_frames(&[id], &[Frame { rotation, ..def.root }], dt).unwrap();
        let report = solver.step(dt, 1).unwrap();
        assert_eq!((report.unconverged, report.quarantined), (0, 0));
        let mut tip = Vector3::zeros();
        solver.sample_at(id, &[LENGTH], |_, sample| tip = sample.position).unwrap();
        let now = tip.y.atan2(tip.x);
        angle += (now - before + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        before = now;
        path.push((t, tip.xy().norm().ln(), angle));
    }
    // Plucked at rest the deflection is both roots of a circle, forwards and backwards; the forward one is left in the second half.
    let rest = &path[path.len() / 2..];
    let slope = |pick: fn(&(f64, f64, f64)) -> f64| {
        let n = rest.len() as f64;
        let (t0, y0) = (rest.iter().map(|p| p.0).sum::<f64>() / n, rest.iter().map(pick).sum::<f64>() / n);
        rest.iter().map(|p| (p.0 - t0) * (pick(p) - y0)).sum::<f64>() / rest.iter().map(|p| (p.0 - t0).powi(2)).sum::<f64>()
    };
    // Seen from above a hanging shaft that spins about its tangent goes round the other way.
    let up = (def.root.rotation * Vector3::x()).z;
    Whirl { growth: slope(|p| p.1), round: up * slope(|p| p.2) }
}

/// Whirling: growth below, at and above the critical speed, without gravity, standing and hanging, without and with air.
#[test]
fn whirling_shafts() {
    for (name, gamma, up) in [("weightless", 0.0, 1.0), ("standing, Γ = 4", 4.0, 1.0), ("hanging, Γ = 10", 10.0, -1.0)] {
        let count = 3;
        let gravity = if gamma == 0.0 { Vector3::zeros() } else { GRAVITY };
        let mut def = strand(
            count,
            material(if gamma == 0.0 { 5.0 } else { gamma }, 1.0, 0.48),
            clamp(Vector3::z() * up, Vector3::x()),
            [0.0; 3],
        );
        // Friction enough that backward whirl dies away within the run.
        let still = vec![[0.0; 3]; count];
        let matrices = matrices(&def, &still, gravity, &[1]);
        let mode = &modes(&matrices)[0];
        let inertia = mode.shape.dot(&(&matrices.mass * &mode.shape));
        let bent = mode.shape.dot(&(&matrices.elastic * &mode.shape));
        def.material.internal_friction = 0.3 / mode.omega * def.material.stiffness()[1];
        for air in [0.0, 0.02] {
            def.material.air_drag = air * mode.omega * def.material.linear_density();
            let outer = def.material.air_drag / def.material.linear_density();
            let inner = def.material.internal_friction / def.material.stiffness()[1] * bent / inertia;
            let critical = mode.omega * (1.0 + outer / inner);
            for share in [0.7, 1.0, 1.3] {
                let spin = share * critical;
                let exact = theory(mode, outer, inner, spin);
                let found = measured(&def, gravity, mode, spin, 6.0);
                println!(
                    "| {name}, ν {air} | {share} of critical | growth {:.5} of ω, theory {:.5} | round {:.5}, {:.5} |",
                    found.growth / mode.omega,
                    exact.growth / mode.omega,
                    found.round / mode.omega,
                    exact.round / mode.omega
                );
                record(
                    "whirl",
                    "case,spin_by_critical,growth_by_omega,theory,round_by_omega,theory_round",
                    format!(
                        "\"{name}, ν/(ρSω) = {air}\",{share},{:.5},{:.5},{:.5},{:.5}",
                        found.growth / mode.omega,
                        exact.growth / mode.omega,
                        found.round / mode.omega,
                        exact.round / mode.omega
                    ),
                );
                assert!((found.growth - exact.growth).abs() < 3e-3 * mode.omega, "{name} {share}");
                assert!((found.round - exact.round).abs() < 3e-3 * mode.omega, "{name} {share}");
            }
        }
    }
}

/// How a shaken curl leaves its plane.
struct Shaken {
    /// The largest excursion from the plane, in L.
    furthest: f64,
    /// When it first was a twentieth of L, s.
    left_at: Option<f64>,
    /// The tip, from the root, in L, sixty times a second.
    path: Vec<Vector3<f64>>,
}

/// Shakes the root up and down at 5 Hz, its acceleration reaching `strength` g; a curl of one turn, Γ = 9, that rests in its plane.
fn shaken(count: usize, integrator: Integrator, strength: f64, seconds: f64) -> Shaken {
    let angular = std::f64::consts::TAU * 5.0;
    let amplitude = strength * 9.81 / (angular * angular);
    let mut def = strand(count, material(9.0, 1.0, 0.48), down(), [0.0, std::f64::consts::TAU, 0.0]);
    (def.material.viscosity, def.material.air_drag) = (5e-3, 5e-6);
    let (mut initial, rest) = of_strand(&def, GRAVITY, &EquilibriumOptions::default()).unwrap();
    assert!(rest.converged && rest.smallest_eigenvalue.unwrap() > 0.0);
    // A ten-thousandth of a radian out of the plane.
    initial.iter_mut().for_each(|row| row[2] += 1e-4 / LENGTH);
    def.initial = Some(initial);
    let mut options = SolverOptions::default();
    (options.step.integrator, options.step.reference_tolerance) = (integrator, 1e-6);
    let mut solver = Solver::new(options).unwrap();
    let id = solver.add_strands(std::slice::from_ref(&def)).unwrap()[0];
    let substeps = if integrator == Integrator::Reference { 1 } else { 16 };
    let mut shaken = Shaken { furthest: 0.0, left_at: None, path: Vec::new() };
    for call in 1..=(seconds * 60.0) as u32 {
        let t = f64::from(call) / 60.0;
        let origin = Vector3::new(0.0, 0.0, amplitude * (1.0 - (angular * t).cos()));
        solver.set_root_frames(&[id], &[Frame { origin, ..def.root }], 1.0 / 60.0).unwrap();
        let report = solver.step(1.0 / 60.0, substeps).unwrap();
        assert_eq!((report.unconverged, report.quarantined), (0, 0));
        let mut out = 0.0_f64;
        solver.sample_strands(&[id], 21, |_, _, sample| out = out.max(sample.position.y.abs() / LENGTH)).unwrap();
        shaken.furthest = shaken.furthest.max(out);
        if out > 0.05 && shaken.left_at.is_none() {
            shaken.left_at = Some(t);
        }
        solver.sample_at(id, &[LENGTH], |_, sample| shaken.path.push((sample.position - origin) / LENGTH)).unwrap();
    }
    shaken
}

/// Bertails et al. 2006, figure 7, left. Shaken gently a curl moves in its plane; shaken hard its weight, Γ (1 + a/g), passes the bend–twist
/// transition (12.3 for a standing load, `bend_twist_transition`) for long enough, and it twists out.
#[test]
fn a_curl_shaken_up_and_down() {
    // For the figure more of them.
    let strengths = if recording() { &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.2, 1.6][..] } else { &[0.2, 0.8] };
    for strength in strengths.iter().copied() {
        let curl = shaken(12, Integrator::SecondOrder, strength, 3.0);
        println!("| {strength} g: Γ up to {:.1} | {:.1e} L | {:?} s |", 9.0 * (1.0 + strength), curl.furthest, curl.left_at);
        record(
            "shaken",
            "acceleration_g,out_of_plane,left_at_s",
            format!("{strength},{:.4e},{}", curl.furthest, curl.left_at.map_or(String::new(), |t| format!("{t:.3}"))),
        );
        if strength <= 0.2 {
            // No further than it was put.
            assert!(curl.furthest < 1e-4);
        }
        if strength >= 0.8 {
            assert!(curl.furthest > 0.2);
        }
    }
    // The reference integrator sees it leave at the same time, and along the same path until then.
    let (mine, reference) = (shaken(5, Integrator::SecondOrder, 1.6, 1.3), shaken(5, Integrator::Reference, 1.6, 1.3));
    println!("N = 5, 1.6 g: leaves at {:?} s, by the reference at {:?} s", mine.left_at, reference.left_at);
    let left = mine.left_at.unwrap();
    assert!((left - reference.left_at.unwrap()).abs() < 2.5 / 60.0);
    let calls = (left * 60.0) as usize - 12;
    let apart = mine.path[..calls].iter().zip(&reference.path).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    println!("until then within {apart:.1e} L of it");
    assert!(apart < 1e-2, "{apart}");
}
