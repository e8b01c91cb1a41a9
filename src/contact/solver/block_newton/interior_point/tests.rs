//! Contacts that friction jams, and what is known in closed form.

use super::*;
use crate::contact::constraint::law::coefficient::Coefficient;

/// Two contacts half a millimetre apart with nearly opposite normals, and a third, of AMD's ponytail on a walking head: normal, lean of
/// the coefficient (of mean 0.25), displacement without forces, m.
#[rustfmt::skip]
const CONTACTS: [[[f64; 3]; 3]; 3] = [
    [[-9.974040050418e-1, -6.732659129002e-2, -2.554174684422e-2], [1.208134085500e-4, -1.068692493349e-3, -1.983786954311e-3], [5.150103160142e-5, 4.694001837752e-6, -1.423823944229e-5]],
    [[-9.591631332703e-1, -8.189816129492e-2, -2.707374649944e-1], [3.023126135612e-3, 8.174435388562e-5, 1.027449140701e-3], [-3.343628344588e-4, 4.701621571884e-5, 3.916519906292e-5]],
    [[8.838886108529e-1, -1.278347380543e-2, 4.675227335670e-1], [2.975721639851e-3, 1.259621305730e-4, 1.329582618625e-3], [-3.309918846754e-4, 7.704080946481e-5, -3.589501770877e-5]],
];
/// Displacement per force, m/N, column after column.
#[rustfmt::skip]
const COUPLING: [f64; 81] = [
    1.667864613485, 8.156871339410e-2, 8.194734809812e-2, -5.442874781642e-2, -4.577162983493e-2, 5.342452307332e-3, -5.805430497384e-2, -4.463210219184e-2, 1.003386617414e-2,
    8.156871339410e-2, 7.065400377545e-1, 4.502210089117e-1, -2.242114566708e-2, 2.835223599529e-1, -6.425845630499e-2, -2.151556163023e-2, 2.832456805774e-1, -6.538205385132e-2,
    8.194734809812e-2, 4.502210089117e-1, 3.934166591469e-1, -1.502532606114e-2, 1.841759411207e-1, -4.627656067585e-2, -1.439868030703e-2, 1.838806086042e-1, -4.768369607592e-2,
    -5.442874781642e-2, -2.242114566708e-2, -1.502532606114e-2, 2.330565144933, 1.134822979567e-1, -6.225339880851e-3, 2.364849127286, 1.102465054216e-1, -4.458557139529e-3,
    -4.577162983493e-2, 2.835223599529e-1, 1.841759411207e-1, 1.134822979567e-1, 5.831597762571e-1, 2.414887907741e-1, 1.121667490216e-1, 5.842066021038e-1, 2.470789912745e-1,
    5.342452307332e-3, -6.425845630499e-2, -4.627656067585e-2, -6.225339880851e-3, 2.414887907741e-1, 2.366086185125, -7.967509607742e-3, 2.469611135060e-1, 2.399806930423,
    -5.805430497384e-2, -2.151556163023e-2, -1.439868030703e-2, 2.364849127286, 1.121667490216e-1, -7.967509607742e-3, 2.404119260489, 1.086208801648e-1, -6.072686536901e-3,
    -4.463210219184e-2, 2.832456805774e-1, 1.838806086042e-1, 1.102465054216e-1, 5.842066021038e-1, 2.469611135060e-1, 1.086208801648e-1, 5.854637493509e-1, 2.535265636237e-1,
    1.003386617414e-2, -6.538205385132e-2, -4.768369607592e-2, -4.458557139529e-3, 2.470789912745e-1, 2.399806930423, -6.072686536901e-3, 2.535265636237e-1, 2.439106858267,
];

#[test]
fn contacts_that_friction_jams_are_solved() {
    let laws: Vec<Contact> = CONTACTS
        .iter()
        .map(|[normal, lean, _]| Contact {
            normal: Three::from(*normal).normalize(),
            response: Response::Hard,
            friction: Friction::Coulomb(Coefficient { mean: 0.25, lean: Three::from(*lean) }),
        })
        .collect();
    let unconstrained: Vec<Three> = CONTACTS.iter().map(|[.., displacement]| Three::from(*displacement)).collect();
    let step = 1.0 / 60.0;
    let jammed = Jammed { laws: &laws, unconstrained: &unconstrained, coupling: &COUPLING, step };
    let report = Report { force: 6.072081297971e-3, length: 0.01 * step, ..Report::default() };
    let mut solver = InteriorPoint::default();
    let left = solver.solve(jammed, &report, 1e-8, u64::MAX, &Meter::unlimited());
    assert!(left <= 1e-8, "{left:e}");
    // The laws hold for the forces, by the plain matrix; where Newton's iteration stalls they are 160 µN.
    for (i, law) in laws.iter().enumerate() {
        let mut u = unconstrained[i];
        for (j, force) in solver.forces.iter().enumerate() {
            u += Matrix3::from_fn(|r, c| COUPLING[(3 * j + c) * 9 + 3 * i + r]) * force;
        }
        assert!((u - solver.moved[i]).norm() < 1e-12, "{i}");
        let law_residual = report.law_residual(&Law::Contact(*law), u, solver.forces[i], step);
        assert!(law_residual < 2e-8, "{i}: {law_residual:e}");
    }
    let largest = solver.forces.iter().map(|force| force.norm()).fold(0.0, f64::max);
    assert!((1e-3..1e-2).contains(&largest), "{largest:e}");
}

#[test]
fn a_spring_without_friction_has_its_force() {
    let response = Response::Penalty { stiffness: 20.0, damping: 0.0, depth_at_start: 0.0 };
    let law = Contact { normal: Three::z(), response, friction: Friction::None };
    let mut coupling = [0.0; 9];
    (0..3).for_each(|k| coupling[4 * k] = 0.05);
    let unconstrained = [Three::new(1e-3, 0.0, -2e-3)];
    let jammed = Jammed { laws: &[law], unconstrained: &unconstrained, coupling: &coupling, step: 0.01 };
    let report = Report { force: 1e-2, length: 1e-3, ..Report::default() };
    let mut solver = InteriorPoint::default();
    let left = solver.solve(jammed, &report, 1e-9, u64::MAX, &Meter::unlimited());
    // Two springs of 20 N/m, one behind the other, pressed by 2 mm.
    assert!(left <= 1e-9 && (solver.forces[0] - Three::z() * 0.02).norm() < 1e-9, "{left:e} {:?}", solver.forces);
    // Work that suffices for one iteration gives the best so far.
    let short = solver.solve(jammed, &report, 1e-9, 1, &Meter::unlimited());
    assert!(short > 1e-9 && solver.work < 10_000, "{short:e}");
}
