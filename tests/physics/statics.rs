//! Static equilibria against independent solutions of the continuous rod: error against the number of elements N, and its order.
//! Elements of constant curvature are midpoint values of a smooth curvature, so that errors fall as 1/N². `--nocapture` prints the
//! tables of `docs/theory/validation_physics.md`.

use crate::rods::judge::{judge, record, recording};
use crate::rods::modes::{matrices, modes};
use crate::rods::*;
use nalgebra::{DMatrix, UnitQuaternion, Vector3};
use serde_json::Value;
use superhelix::editing::{Equilibrium, EquilibriumOptions};
use superhelix::internals::chain::dense;
use superhelix::internals::chain::system::ChainSystem;
use superhelix::internals::math::quadrature::Rules;
use superhelix::internals::rod::kinematics::Kinematics;
use superhelix::internals::step::equilibrium::{of_strand, smallest_eigenvalue};
use superhelix::internals::step::state::rotation_matrix;
use superhelix::{Freedoms, Material, Solver, SolverOptions, StepOptions, StrandDef};

/// The tip at rest, in L, and how it was found. Answers that are exact for N elements are met to 1e-9: integrals are better than that.
fn settled(def: &StrandDef) -> (Vector3<f64>, Equilibrium) {
    let step = StepOptions { quadrature_tolerance: 1e-12, ..StepOptions::default() };
    let mut solver = Solver::new(SolverOptions { step, ..SolverOptions::default() }).unwrap();
    let id = solver.add_strands(std::slice::from_ref(def)).unwrap()[0];
    let found = solver.settle(&[id], &EquilibriumOptions::default()).unwrap()[0];
    assert!(found.converged, "{found:?}");
    let mut tip = Vector3::zeros();
    solver.sample_at(id, &[LENGTH], |_, sample| tip = sample.position / LENGTH).unwrap();
    (tip, found)
}

/// The tip of a strand in the shape `curvatures`, from its root, m.
fn tip_of(def: &StrandDef, curvatures: &[[f64; 3]]) -> Vector3<f64> {
    let mut kinematics = Kinematics::default();
    kinematics.update(&rotation_matrix(&def.root), &def.element_lengths, curvatures, Rules::default().rule(0));
    Vector3::from(kinematics.elements.last().unwrap().origin_right())
}

/// For the figures: the rest that is found, sampled, and the reference's points.
fn record_shape(name: &str, def: &StrandDef, reference: &[Vector3<f64>]) {
    if !recording() {
        return;
    }
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let id = solver.add_strands(std::slice::from_ref(def)).unwrap()[0];
    solver.settle(&[id], &EquilibriumOptions::default()).unwrap();
    let header = "shape,kind,index,x,y,z";
    let row = |kind: &str, index: usize, p: Vector3<f64>| format!("{name},{kind},{index:03},{:.5},{:.5},{:.5}", p.x, p.y, p.z);
    solver
        .sample_strands(&[id], 61, |_, point, sample| record("shapes", header, row("engine", point, sample.position / LENGTH)))
        .unwrap();
    for (index, point) in reference.iter().enumerate() {
        record("shapes", header, row("reference", index, *point));
    }
}

/// Distance of two tips, the second or its mirror image in the plane y = 0.
fn apart(tip: Vector3<f64>, reference: Vector3<f64>, mirror: bool) -> f64 {
    let direct = (tip - reference).norm();
    if mirror { direct.min((tip - Vector3::new(reference.x, -reference.y, reference.z)).norm()) } else { direct }
}

const COUNTS: [usize; 4] = [5, 10, 20, 40];

#[test]
fn cantilevers() {
    let reference = reference();
    for (key, angle) in [("horizontal", 0.0_f64), ("up45", 45.0), ("down60", -60.0)] {
        let (sine, cosine) = angle.to_radians().sin_cos();
        for row in rows(&reference["cantilever"][key]) {
            let gamma = number(&row["Gamma"]);
            let exact = Vector3::new(number(&row["x_tip"]), 0.0, number(&row["z_tip"]));
            // A long limp strand bends within L/√Γ of its clamp: it takes elements shorter than that to be in the regime of 1/N².
            let counts = if gamma < 500.0 { [10, 20, 40] } else { [40, 80, 160] };
            let errors = counts.map(|count| {
                let root = clamp(Vector3::new(cosine, 0.0, sine), Vector3::y());
                let (tip, found) = settled(&strand(count, material(gamma, 1.0, 0.48), root, [0.0; 3]));
                assert!(found.smallest_eigenvalue.unwrap() > 0.0);
                (tip - exact).norm()
            });
            if angle == 0.0 {
                let def = strand(counts[2], material(gamma, 1.0, 0.48), clamp(Vector3::x(), Vector3::y()), [0.0; 3]);
                record_shape(&format!("cantilever {gamma}"), &def, &[exact]);
            }
            judge("cantilever", &format!("cantilever {angle}°, Γ = {gamma}, N = {counts:?}"), &counts, &errors, 2e-3);
        }
    }
}

#[test]
fn elliptic_cantilevers() {
    for row in rows(&reference()["cantilever"]["elliptic"]) {
        let (aspect, gamma, roll) = (number(&row["a1_over_a2"]), number(&row["Gamma1"]), number(&row["roll_deg"]));
        let (sine, cosine) = roll.to_radians().sin_cos();
        let root = clamp(Vector3::x(), Vector3::new(0.0, cosine, sine));
        let errors = COUNTS.map(|count| {
            let (tip, _) = settled(&strand(count, material(gamma, aspect, number(&row["poisson"])), root, [0.0; 3]));
            apart(tip, triple(&row["tip"]), roll == 90.0)
        });
        judge("ellipse", &format!("ellipse {aspect}, roll {roll}°, Γ = {gamma}"), &COUNTS, &errors, 1.5e-3);
    }
}

#[test]
fn planar_hanging_curves() {
    for row in rows(&reference()["planar_hanging"]) {
        let (phi, gamma) = (number(&row["phi"]), number(&row["Gamma"]));
        let exact = Vector3::new(number(&row["x_tip"]), 0.0, number(&row["z_tip"]));
        let counts = [20, 40, 80];
        let errors =
            counts.map(|count| (settled(&strand(count, material(gamma, 1.0, 0.48), down(), [0.0, phi, 0.0])).0 - exact).norm());
        judge("planar", &format!("planar φ = {:.1}π, Γ = {gamma}", phi / std::f64::consts::PI), &counts, &errors, 2e-3);
    }
}

#[test]
fn curls_hanging_in_space() {
    for row in rows(&reference()["hanging_curly"]) {
        let (phi, gamma) = (number(&row["phi"]), number(&row["Gamma"]));
        let counts = [20, 40, 80];
        let errors = counts.map(|count| {
            let def = strand(count, material(gamma, 1.0, number(&row["poisson"])), down(), [0.0, phi, 0.0]);
            let (tip, found) = settled(&def);
            assert!(found.smallest_eigenvalue.unwrap() > 0.0, "{found:?}");
            apart(tip, triple(&row["tip"]), true)
        });
        let def = strand(80, material(gamma, 1.0, number(&row["poisson"])), down(), [0.0, phi, 0.0]);
        let line: Vec<Vector3<f64>> = rows(&row["centerline"]).iter().map(triple).collect();
        record_shape(&format!("curl {:.0} {gamma}", phi / std::f64::consts::PI), &def, &line);
        judge("curl", &format!("curl φ = {:.0}π, Γ = {gamma}", phi / std::f64::consts::PI), &counts, &errors, 1e-2);
    }
}

#[test]
fn rods_without_symmetry() {
    for row in rows(&reference()["generic_3d"]) {
        let stiffness = triple(&row["K_over_EI1"]);
        let aspect = stiffness.z.sqrt();
        let poisson = (2.0 * stiffness.z / (stiffness.x * (1.0 + stiffness.z)) - 1.0).min(0.5);
        let errors = COUNTS.map(|count| {
            let def = strand(
                count,
                material(number(&row["Gamma1"]), aspect, poisson),
                clamp_from(&row["R0"]),
                triple(&row["un_L"]).into(),
            );
            apart(settled(&def).0, triple(&row["tip"]), false)
        });
        judge("generic", row["name"].as_str().unwrap(), &COUNTS, &errors, 3e-3);
    }
}

/// The smallest eigenvalue, all freedoms allowed, of the state in which only `plane` may bend; `shape` leads along the branch.
fn planar_eigenvalue(mut def: StrandDef, plane: Freedoms, shape: &mut Option<Vec<[f64; 3]>>) -> f64 {
    def.freedoms = plane;
    def.initial = shape.take();
    let options = EquilibriumOptions { check_stability: false, ..EquilibriumOptions::default() };
    let (curvatures, found) = of_strand(&def, GRAVITY, &options).unwrap();
    assert!(found.converged, "{found:?}");
    def.freedoms = Freedoms::ALL;
    let eigenvalue = smallest_eigenvalue(&def, &curvatures, GRAVITY).unwrap();
    *shape = Some(curvatures);
    eigenvalue
}

/// The zero of a function that is positive at `a` and negative at `b` (regula falsi, Illinois).
fn zero(mut at: impl FnMut(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let (mut f_a, mut f_b) = (at(a), at(b));
    assert!(f_a > 0.0 && f_b < 0.0, "{f_a} at {a}, {f_b} at {b}");
    for _ in 0..30 {
        let c = (a * f_b - b * f_a) / (f_b - f_a);
        let f_c = at(c);
        if f_c * f_b < 0.0 {
            (a, f_a) = (b, f_b);
        } else {
            f_a *= 0.5;
        }
        (b, f_b) = (c, f_c);
        if (b - a).abs() < 1e-7 * b || f_c.abs() < 1e-10 {
            break;
        }
    }
    b
}

#[test]
fn bend_twist_transition() {
    for (poisson, table) in reference()["bend_twist"].as_object().unwrap() {
        let sigma: f64 = poisson.parse().unwrap();
        for row in rows(table) {
            let phi = number(&row["phi"]);
            let turns = number(&row["phi_over_pi"]);
            if turns > 4.0 {
                continue;
            }
            for (key, sign) in [("low", 1.0), ("high", -1.0)] {
                let exact = number(&row[key]);
                let counts = [20, 40, 80];
                let errors = counts.map(|count| {
                    let mut shape = None;
                    let at = |gamma: f64| {
                        let def = strand(count, material(gamma, 1.0, sigma), down(), [0.0, phi, 0.0]);
                        sign * planar_eigenvalue(def, Freedoms::BEND1, &mut shape)
                    };
                    let critical = zero(at, 0.93 * exact, 1.07 * exact);
                    let row = format!("{poisson},{turns},{key},{exact},{count},{critical:.6}");
                    record("bend_twist", "poisson,phi_over_pi,side,reference,elements,critical", row);
                    (critical / exact - 1.0).abs()
                });
                judge("bend-twist", &format!("bend–twist σ = {poisson}, φ = {turns}π, {key}"), &counts, &errors, 1e-2);
            }
        }
    }
}

/// Beyond the transition: where the rod that left its plane rests.
#[test]
fn past_the_bend_twist_transition() {
    for row in rows(&reference()["postbuckled"]) {
        let (phi, gamma, turns) = (number(&row["phi"]), number(&row["Gamma"]), number(&row["phi_over_pi"]));
        let poisson = number(&row["poisson"]);
        if turns > 4.0 || poisson != 0.5 {
            continue;
        }
        let counts = [20, 40, 80];
        let errors = counts.map(|count| {
            let def = strand(count, material(gamma, 1.0, poisson), down(), [0.0, phi, 0.0]);
            apart(settled(&def).0, triple(&row["tip"]), true)
        });
        judge("postbuckled", &format!("beyond the transition, φ = {turns}π, Γ = {gamma}"), &counts, &errors, 1e-2);
    }
}

/// A hair of a reference case, in `count` elements.
fn hair(row: &Value, count: usize) -> StrandDef {
    let mut def = StrandDef::straight(number(&row["L"]), count);
    def.material = Material {
        radius: [number(&row["a1"]), number(&row["a2"])],
        density: number(&row["rho"]),
        youngs_modulus: number(&row["E"]),
        poisson_ratio: number(&row["poisson"]),
        ..Material::default()
    };
    def.root.rotation = clamp_from(&row["R0"]);
    def.natural = vec![[number(&row["tau"]), number(&row["kappa1"]), 0.0]; count];
    def
}

/// Bertails et al. 2006, appendix B: measured hair, elliptic and naturally twisted, at rest; and the slowest vibrations about it.
#[test]
fn hair_of_the_papers_appendix() {
    for row in rows(&reference()["hairs"]) {
        if number(&row["kappa1"]) == 0.0 {
            continue;
        }
        let name =
            format!("{}, {} cm, {}", row["hair"].as_str().unwrap(), number(&row["L"]) * 100.0, row["clamp"].as_str().unwrap());
        let length = number(&row["L"]);
        let counts = [10, 20, 40];
        let mut frequencies = Vec::new();
        let errors = counts.map(|count| {
            let def = hair(row, count);
            let (curvatures, found) = of_strand(&def, GRAVITY, &EquilibriumOptions::default()).unwrap();
            assert!(found.converged, "{found:?}");
            let unit = (number(&row["m"]) * length.powi(4) / number(&row["EI1"])).sqrt();
            let omega = modes(&matrices(&def, &curvatures, GRAVITY, &[0, 1, 2]))[0].omega * unit;
            frequencies.push((omega / number(&row["omega_first4"][0]) - 1.0).abs());
            (tip_of(&def, &curvatures) / length - triple(&row["tip"])).norm()
        });
        judge("hair", &name, &counts, &errors, 1e-2);
        judge("hair frequency", &format!("first frequency of {name}"), &counts, &frequencies, 5e-2);
    }
}

/// The tip's initial response to gravity: d(tip)/dΓ at Γ = 0, relative to the reference's.
#[test]
fn linear_response() {
    let gamma = 1e-5;
    for row in rows(&reference()["linear_response"]) {
        let (phi, twist) = (number(&row["phi"]), number(&row["natural_twist"]));
        let exact = triple(&row["dtip_dGamma"]);
        let counts = if phi < 10.0 { [10, 20, 40] } else { [40, 80, 160] };
        let errors = counts.map(|count| {
            let def = strand(count, material(gamma, 1.0, 0.48), down(), [twist, phi, 0.0]);
            let options = EquilibriumOptions { tolerance: 1e-13, check_stability: false, ..EquilibriumOptions::default() };
            let (curvatures, _) = of_strand(&def, GRAVITY, &options).unwrap();
            let moved = (tip_of(&def, &curvatures) - tip_of(&def, &def.natural)) / (LENGTH * gamma);
            (moved - exact).norm() / exact.norm()
        });
        let kind = row["kind"].as_str().unwrap();
        judge(
            "linear response",
            &format!("{kind}, φ = {:.1}π, twist {twist:.2}/L", phi / std::f64::consts::PI),
            &counts,
            &errors,
            3e-2,
        );
    }
}

#[test]
fn lateral_buckling() {
    for row in rows(&reference()["lateral_buckling"]) {
        let (aspect, exact, poisson) = (number(&row["e"]), number(&row["critical"]), number(&row["poisson"]));
        let counts = [10, 20, 40];
        let errors = counts.map(|count| {
            let mut shape = None;
            let at = |gamma: f64| {
                // Gravity along −n1: the stiff plane carries it.
                let def = strand(count, material(gamma, aspect, poisson), clamp(Vector3::x(), Vector3::z()), [0.0; 3]);
                planar_eigenvalue(def, Freedoms::BEND2, &mut shape)
            };
            (zero(at, 0.9 * exact, 1.1 * exact) / exact - 1.0).abs()
        });
        judge("lateral", &format!("lateral buckling, ellipse {aspect}, σ = {poisson}"), &counts, &errors, 3e-3);
    }
}

fn upright(count: usize, gamma: f64) -> StrandDef {
    strand(count, material(gamma, 1.0, 0.48), clamp(Vector3::z(), Vector3::x()), [0.0; 3])
}

#[test]
fn greenhill_self_buckling() {
    let reference = reference();
    let critical = number(&reference["greenhill"]["critical"][0]);
    let gamma_at = |count: usize| {
        // Upright the Hessian is K − Γ G: λ is linear in Γ, and one value gives the zero.
        let straight = vec![[0.0; 3]; count];
        let half = smallest_eigenvalue(&upright(count, 4.0), &straight, GRAVITY).unwrap();
        let zero = 4.0 / (1.0 - half);
        assert!(smallest_eigenvalue(&upright(count, 0.999 * zero), &straight, GRAVITY).unwrap() > 0.0);
        assert!(smallest_eigenvalue(&upright(count, 1.001 * zero), &straight, GRAVITY).unwrap() < 0.0);
        zero
    };
    let counts = [5, 10, 20, 40, 80];
    let errors = counts.map(|count| gamma_at(count) / critical - 1.0);
    judge("greenhill", "Greenhill's critical Γ", &counts, &errors, 2e-4);
    // Below it the strand stays upright; above it leaves, exactly upright as it was, and falls where the continuous rod lies.
    assert!((settled(&upright(40, 0.99 * critical)).0 - Vector3::z()).norm() < 1e-9);
    for row in rows(&reference["greenhill"]["postbuckled_planar"]) {
        let gamma = number(&row["Gamma"]);
        let errors = COUNTS.map(|count| {
            let (tip, found) = settled(&upright(count, gamma));
            assert!(gamma < 8.0 || found.saddles > 0, "{found:?}");
            let line = format!("{gamma},{},{count},{:.6}", number(&row["x_tip"]), tip.xy().norm());
            record("buckling", "gamma,reference,elements,tip_aside", line);
            (tip.xy().norm() - number(&row["x_tip"])).hypot(tip.z - number(&row["z_tip"]))
        });
        if gamma > 8.0 {
            judge("greenhill", &format!("self-buckled, Γ = {gamma}"), &COUNTS, &errors, 4e-3);
        }
    }
}

#[test]
fn exact_answers_for_n_elements() {
    let reference = reference();
    for row in rows(&reference["discrete_N1"]["planar_static_horizontal"]) {
        let root = clamp(Vector3::x(), Vector3::y());
        let (tip, _) = settled(&strand(1, material(number(&row["Gamma"]), 1.0, 0.48), root, [0.0; 3]));
        let exact = Vector3::new(number(&row["x_tip"]), 0.0, number(&row["z_tip"]));
        assert!((tip - exact).norm() < 1e-9, "{tip} {exact}");
    }
    for row in rows(&reference["discrete_linear_N"]["rows"]) {
        let count = row["N"].as_u64().unwrap() as usize;
        let gamma = 1e-4;
        let def = strand(count, material(gamma, 1.0, 0.48), UnitQuaternion::identity(), [0.0; 3]);
        let share = -settled(&def).0.z / gamma / number(&row["tip_deflection_over_Gamma"]);
        assert!((share - 1.0).abs() < 1e-7, "N = {count}: {share}");
        for (mode, exact) in rows(&row["omega"]).iter().enumerate() {
            let share = frequencies(&def, gamma)[mode] / number(exact);
            assert!((share - 1.0).abs() < 1e-8, "N = {count}, mode {mode}: {share}");
        }
    }
}

/// Angular frequencies of the straight strand's bending about n1 in √(EI/(m L⁴)), ascending, from the dense K and M.
fn frequencies(def: &StrandDef, gamma: f64) -> Vec<f64> {
    let count = def.element_lengths.len();
    let rules = Rules::default();
    let rule = rules.rule(0);
    let mut kinematics = Kinematics::default();
    kinematics.update(&rotation_matrix(&def.root), &def.element_lengths, &def.natural, rule);
    let mut system = ChainSystem::default();
    system.resize(count, kinematics.points.len());
    let density = def.material.linear_density();
    for p in 0..kinematics.points.len() {
        system.point_stiffness[p] = density * rule.weights[p % rule.len()] * def.element_lengths[p / rule.len()];
    }
    let mass = dense::assemble(&kinematics, &system, &[1]).matrix;
    let element = def.material.stiffness()[1] * LENGTH / count as f64;
    let scaled = DMatrix::from_fn(count, count, |i, j| mass[(i, j)] / element);
    // T² = m L⁴/EI = Γ L/g.
    let unit = (gamma * LENGTH / -GRAVITY.z).sqrt();
    let mut omega: Vec<f64> = scaled.symmetric_eigenvalues().iter().map(|x| unit / x.sqrt()).collect();
    omega.sort_by(f64::total_cmp);
    omega
}

#[test]
fn natural_frequencies() {
    let reference = reference();
    let counts = [5, 10, 20, 40, 80];
    for (mode, exact) in rows(&reference["frequencies"]["cantilever"]).iter().enumerate() {
        let errors = counts.map(|count| {
            let def = strand(count, material(1.0, 1.0, 0.48), UnitQuaternion::identity(), [0.0; 3]);
            frequencies(&def, 1.0)[mode] / number(exact) - 1.0
        });
        judge("frequency", &format!("frequency {}", mode + 1), &counts, &errors, 2e-3);
    }
}

#[test]
fn settling_names_errors_and_changes_nothing() {
    let mut solver = Solver::new(SolverOptions::default()).unwrap();
    let ids = solver.add_strands(&[upright(5, 20.0), upright(5, 5.0)]).unwrap();
    let before = solver.state_hash();
    let bad = EquilibriumOptions { tolerance: f64::NAN, ..EquilibriumOptions::default() };
    assert!(solver.settle(&ids, &bad).unwrap_err().to_string().contains("options.tolerance"));
    let none = EquilibriumOptions { max_steps: 0, ..EquilibriumOptions::default() };
    assert!(solver.settle(&ids, &none).unwrap_err().to_string().contains("options.max_steps"));
    let gone = ids[1];
    solver.remove_strands(&[gone]).unwrap();
    let after = solver.state_hash();
    assert!(solver.settle(&[ids[0], gone], &EquilibriumOptions::default()).unwrap_err().to_string().contains("ids[1]"));
    assert_eq!(after, solver.state_hash());
    assert_ne!(before, after);
    // What has settled rests.
    let found = solver.settle(&ids[..1], &EquilibriumOptions::default()).unwrap()[0];
    assert!(found.converged && found.residual < 1e-9);
    let shape = solver.curvatures(ids[0]).unwrap().to_vec();
    for _ in 0..60 {
        solver.step(1.0 / 60.0, 1).unwrap();
    }
    for (a, b) in shape.iter().flatten().zip(solver.curvatures(ids[0]).unwrap().iter().flatten()) {
        assert!((a - b).abs() * LENGTH < 1e-6, "{a} {b}");
    }
}
