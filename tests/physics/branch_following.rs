//! Branches of static equilibria (`analysis::branch`) against theory: Greenhill's self-buckling, the transition of a hanging curl from bending
//! to twisting, a turning clamp, a fold. Errors of the elements fall as 1/N² (`docs/theory/validation_physics.md`), so that two numbers of
//! elements extrapolate to the continuous rod.

use crate::rods::*;
use nalgebra::{UnitQuaternion, Vector3};
use superhelix::editing::EquilibriumOptions;
use superhelix::experiments::{BranchEnd, BranchOptions, BranchPoint, CriticalKind, Load, follow, switch};
use superhelix::internals::step::equilibrium::{of_strand, smallest_eigenvalue};
use superhelix::{Freedoms, StrandDef};

/// The load Γ for a strand whose material has Γ = 1 under [`GRAVITY`].
fn weight(rotation: UnitQuaternion<f64>) -> impl Fn(f64) -> Load {
    move |gamma| Load { gravity: GRAVITY * gamma, rotation }
}

/// Distance of a point's tip from a reference in L, mirror images and turns about the vertical allowed.
fn off(point: &BranchPoint, reference: Vector3<f64>) -> f64 {
    let tip = point.tip / LENGTH;
    (tip.xy().norm() - reference.xy().norm()).hypot(tip.z - reference.z)
}

fn upright(count: usize) -> StrandDef {
    strand(count, material(1.0, 1.0, 0.48), clamp(Vector3::z(), Vector3::x()), [0.0; 3])
}

/// Every point of a branch is an equilibrium, and its eigenvalue is that of the Hessian.
fn check_points(def: &StrandDef, load: &dyn Fn(f64) -> Load, points: &[BranchPoint]) {
    for point in points.iter().step_by(5) {
        let mut there = def.clone();
        let now = load(point.parameter);
        there.root.rotation = now.rotation;
        let eigenvalue = smallest_eigenvalue(&there, &point.curvatures, now.gravity).unwrap();
        assert!((eigenvalue - point.smallest_eigenvalue).abs() < 1e-8, "{eigenvalue} {}", point.smallest_eigenvalue);
        // The search started there has nothing to do: its first step of the potential's descent stays.
        there.initial = Some(point.curvatures.clone());
        let options = EquilibriumOptions { tolerance: 1e-8, max_steps: 1, check_stability: false };
        let (rows, found) = of_strand(&there, now.gravity, &options).unwrap();
        assert!(found.converged, "{}: {found:?}", point.parameter);
        let moved: f64 = rows.iter().flatten().zip(point.curvatures.iter().flatten()).map(|(a, b)| (a - b).abs()).sum();
        assert!(moved * LENGTH < 1e-4, "{moved}");
    }
}

#[test]
fn greenhill() {
    let reference = reference();
    let critical = number(&reference["greenhill"]["critical"][0]);
    let load = weight(clamp(Vector3::z(), Vector3::x()));
    let mut found = Vec::new();
    for count in [10, 20] {
        let def = upright(count);
        let branch = follow(&def, &load, 1.0, 12.0, &BranchOptions::default()).unwrap();
        assert_eq!(branch.end, BranchEnd::Reached);
        let last = branch.points.last().unwrap();
        assert!(last.parameter == 12.0 && (last.tip / LENGTH - Vector3::z()).norm() < 1e-9, "it stays upright, unstable");
        assert!(last.smallest_eigenvalue < -0.1);
        assert_eq!(branch.criticals.len(), 1);
        let buckling = &branch.criticals[0];
        assert!(buckling.kind == CriticalKind::Bifurcation && buckling.loses_stability);
        // Upright the eigenvalue is linear in Γ: one value determines its zero.
        let half = smallest_eigenvalue(&def, &vec![[0.0; 3]; count], GRAVITY * 4.0).unwrap();
        assert!((buckling.parameter * (1.0 - half) / 4.0 - 1.0).abs() < 1e-8, "{}", buckling.parameter);
        assert!(buckling.eigenvalue.abs() < 1e-9, "{}", buckling.eigenvalue);
        found.push(buckling.parameter);

        let stop = BranchOptions { follow_unstable: false, ..BranchOptions::default() };
        let stopped = follow(&def, &load, 1.0, 12.0, &stop).unwrap();
        assert!(stopped.end == BranchEnd::Unstable && stopped.points.last().unwrap().parameter < critical * 1.01);

        // The buckled branch, to either side, is the continuous rod's, and stable (neutral: it may turn about the vertical).
        for side in [1.0, -1.0] {
            let buckled = switch(&def, &load, buckling, side, (1.0, 12.0), &BranchOptions::default()).unwrap();
            assert!(buckled.end == BranchEnd::Reached && buckled.criticals.is_empty(), "{:?}", buckled.criticals);
            assert!(buckled.points.iter().all(|point| point.smallest_eigenvalue > -1e-9));
            let row = rows(&reference["greenhill"]["postbuckled_planar"]).iter().find(|row| number(&row["Gamma"]) == 12.0);
            let row = row.unwrap();
            let exact = Vector3::new(number(&row["x_tip"]), 0.0, number(&row["z_tip"]));
            let error = off(buckled.points.last().unwrap(), exact);
            assert!(error < 0.6 / (count * count) as f64, "{error}");
            check_points(&def, &load, &buckled.points);
        }
    }
    println!("Greenhill: {found:?}, extrapolated {}", (4.0 * found[1] - found[0]) / 3.0);
    // 7.5e-4 at N = 20; the error after extrapolation is of fourth order.
    assert!(((4.0 * found[1] - found[0]) / 3.0 / critical - 1.0).abs() < 1e-5);
}

#[test]
fn bend_twist_transition() {
    let reference = reference();
    let row = rows(&reference["bend_twist"]["0.48"]).iter().find(|row| number(&row["phi_over_pi"]) == 2.0).unwrap().clone();
    let (low, high) = (number(&row["low"]), number(&row["high"]));
    let load = weight(down());
    let mut found = Vec::new();
    for count in [16, 32] {
        let def = strand(count, material(1.0, 1.0, 0.48), down(), [0.0, number(&row["phi"]), 0.0]);
        let planar = follow(&def, &load, 1.0, 1.2 * high, &BranchOptions::default()).unwrap();
        assert_eq!(planar.end, BranchEnd::Reached);
        let in_plane = |point: &BranchPoint| point.curvatures.iter().all(|row| row[0].abs().max(row[2].abs()) * LENGTH < 1e-6);
        assert!(planar.points.iter().all(in_plane), "the planar state is followed through where it is unstable");
        assert_eq!(planar.criticals.len(), 2, "{:?}", planar.criticals.iter().map(|c| c.parameter).collect::<Vec<_>>());
        assert!(planar.criticals[0].loses_stability && !planar.criticals[1].loses_stability);
        assert!(planar.criticals.iter().all(|critical| critical.kind == CriticalKind::Bifurcation));
        found.push([planar.criticals[0].parameter, planar.criticals[1].parameter]);
        check_points(&def, &load, &planar.points);

        // Between the borders the stable state is in space; it leaves the planar one at the lower and comes back to it at the higher.
        let space = switch(&def, &load, &planar.criticals[0], 1.0, (low, 16.0), &BranchOptions::default()).unwrap();
        assert_eq!(space.end, BranchEnd::Reached);
        assert!(space.points.iter().all(|point| point.smallest_eigenvalue > 0.0));
        let curl = rows(&reference["hanging_curly"])
            .iter()
            .find(|row| number(&row["Gamma"]) == 16.0 && (number(&row["phi"]) - std::f64::consts::TAU).abs() < 1e-6)
            .unwrap();
        let error = off(space.points.last().unwrap(), triple(&curl["tip"]));
        println!("curl at Γ = 16, N = {count}: {error:.2e} L");
        assert!(error < 1.2 / (count * count) as f64, "{error}");
    }
    for (border, exact) in [low, high].into_iter().enumerate() {
        let extrapolated = (4.0 * found[1][border] - found[0][border]) / 3.0;
        println!("bend–twist: {exact} found {} {} extrapolated {extrapolated}", found[0][border], found[1][border]);
        assert!((extrapolated / exact - 1.0).abs() < 2e-4, "{extrapolated} {exact}");
    }
}

/// Between two clamps that stand in the reference: the state at the end is the one that is found there directly.
#[test]
fn a_clamp_that_turns() {
    let count = 20;
    let turned = |degrees: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        clamp(Vector3::new(cosine, 0.0, sine), Vector3::y())
    };
    let load = |degrees: f64| Load { gravity: GRAVITY, rotation: turned(degrees) };
    let def = strand(count, material(50.0, 1.0, 0.48), turned(-60.0), [0.0; 3]);
    let branch = follow(&def, &load, -60.0, 45.0, &BranchOptions::default()).unwrap();
    assert!(branch.end == BranchEnd::Reached && branch.criticals.is_empty());
    for (key, point) in [("down60", &branch.points[0]), ("up45", branch.points.last().unwrap())] {
        let reference = reference();
        let row = rows(&reference["cantilever"][key]).iter().find(|row| number(&row["Gamma"]) == 50.0).unwrap().clone();
        let exact = Vector3::new(number(&row["x_tip"]), 0.0, number(&row["z_tip"]));
        // 5.6e-3 at N = 10 (docs/theory/validation_physics.md), a quarter of it at 20.
        assert!((point.tip / LENGTH - exact).norm() < 1.6e-3, "{key}: {}", point.tip / LENGTH);
    }
    check_points(&def, &load, &branch.points);
}

/// A strand bent over by its weight, in its plane, whose clamp is turned against its lean: it holds beyond the upright, then snaps.
#[test]
fn a_fold_where_a_strand_snaps_over() {
    let turned = |degrees: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        clamp(Vector3::new(cosine, 0.0, sine), Vector3::y())
    };
    let load = |degrees: f64| Load { gravity: GRAVITY, rotation: turned(degrees) };
    let mut def = strand(12, material(12.0, 1.0, 0.48), turned(60.0), [0.0; 3]);
    def.freedoms = Freedoms::BEND1;
    let branch = follow(&def, &load, 60.0, 150.0, &BranchOptions::default()).unwrap();
    // There is no such state at 150°: past the fold the curve goes back on itself in λ, unstable, through the upright one.
    let fold = &branch.criticals[0];
    println!("fold at {}°, {:?}, {} points", fold.parameter, branch.end, branch.points.len());
    assert!(fold.kind == CriticalKind::Fold && fold.loses_stability && fold.parameter > 90.5);
    let turned_back: Vec<_> = branch.points.windows(2).map(|pair| pair[1].parameter - pair[0].parameter).collect();
    assert!(turned_back.iter().any(|change| *change < 0.0));
    // By symmetry about 90° the curve unfolds again as far on the other side.
    let unfold = &branch.criticals[1];
    assert!(unfold.kind == CriticalKind::Fold && !unfold.loses_stability);
    assert!((fold.parameter + unfold.parameter - 180.0).abs() < 1e-4, "{} {}", fold.parameter, unfold.parameter);
    assert_eq!(branch.end, BranchEnd::Reached);
    // What settles just before the fold from the state before it stays on its side; just beyond it snaps over.
    let settled = |degrees: f64| {
        let mut there = def.clone();
        there.root.rotation = turned(degrees);
        there.initial = Some(fold.curvatures.clone());
        let (rows, found) = of_strand(&there, GRAVITY, &EquilibriumOptions { max_steps: 3000, ..Default::default() }).unwrap();
        assert!(found.converged);
        rows.iter().map(|row| row[1]).sum::<f64>()
    };
    assert!(settled(fold.parameter - 0.5) * settled(fold.parameter + 0.5) < 0.0);
}

#[test]
fn bad_input_is_named() {
    let load = weight(down());
    let def = upright(3);
    let options = BranchOptions::default();
    let text = |result: superhelix::Result<superhelix::experiments::Branch>| result.unwrap_err().to_string();
    assert!(text(follow(&def, &load, 1.0, 1.0, &options)).contains("to is 1"));
    assert!(text(follow(&def, &load, f64::NAN, 1.0, &options)).contains("from"));
    assert!(text(follow(&def, &|_| Load { gravity: GRAVITY * f64::NAN, ..load(1.0) }, 0.0, 1.0, &options)).contains("gravity"));
    for bad in [
        BranchOptions { tolerance: 0.0, ..options },
        BranchOptions { longest_step: f64::INFINITY, ..options },
        BranchOptions { max_points: 1, ..options },
    ] {
        assert!(text(follow(&def, &load, 0.0, 1.0, &bad)).contains("options."));
    }
    let mut empty = upright(3);
    empty.element_lengths[1] = -1.0;
    assert!(text(follow(&empty, &load, 0.0, 1.0, &options)).contains("strand.element_lengths[1]"));
}
