//! The trajectories to compare with. The root follows its continuous motion, not frames.
//!
//! Second order at [`RATE`] and twice that, extrapolated, follows the same equations as the reference integrator. [`Truth::of`]
//! uses this, since dense matrices of 64 elements are out of reach where hair whips about. [`radau`] is the integrator itself.

use nalgebra::Vector3;
use superhelix::editing::EquilibriumOptions;
use superhelix::internals::math::quadrature::Rules;
use superhelix::internals::rod::kinematics::Kinematics;
use superhelix::internals::rod::strand::StrandModel;
use superhelix::internals::step;
use superhelix::internals::step::pack::members::One;
use superhelix::internals::step::scratch::StepScratch;
use superhelix::internals::step::state::{StrandState, rotation_matrix};
use superhelix::internals::step::{Setting, Surroundings};
use superhelix::{Freedoms, Integrator, Solver, SolverOptions, StepOptions, StrandDef};

use super::hair::Hair;
use super::path::{Distance, FRAMES, POINTS, Path, Shape};
use super::scene::{DURATION, GRAVITY, Scene};
use super::walk::Walk;

/// Steps per second of the coarser of two runs.
pub const RATE: u32 = 1920;
/// Tolerance of its integrals along an element.
const QUADRATURE: f64 = 1e-10;
/// When two trajectories of one motion are this far apart, in lengths, the motion has lost its initial state.
const PARTED: f64 = 0.02;

/// Elements of the trajectories for comparison; half as many again show their accuracy.
pub fn elements(hair: Hair) -> usize {
    match hair {
        Hair::Straight | Hair::Wavy => 64,
        // Coils need more.
        Hair::Curly | Hair::Fuzzy => 128,
    }
}

/// The strand at the start: at rest under gravity, its root where the scene begins.
pub fn strand(scene: Scene, hair: Hair, walk: &Walk, elements: usize, freedoms: Freedoms) -> StrandDef {
    let mut def = hair.strand(scene.length(hair.length()), elements, freedoms);
    def.root = scene.root(walk, 0.0);
    let mut solver =
        Solver::new(SolverOptions { gravity: Vector3::from(GRAVITY), ..SolverOptions::default() }).expect("a solver");
    let ids = solver.add_strands(std::slice::from_ref(&def)).expect("a strand");
    let options = EquilibriumOptions { tolerance: 1e-8, max_steps: 3000, check_stability: false };
    let found = solver.settle(&ids, &options).expect("an equilibrium");
    assert!(found[0].converged, "{} {} {elements}: no equilibrium, {found:?}", scene.name(), hair.name());
    def.initial = Some(solver.curvatures(ids[0]).expect("curvatures").to_vec());
    (def.root_velocity, def.root_angular_velocity) = scene.root_velocity(walk);
    def
}

/// The path of a strand of `elements` elements, a multiple of eight, in `rate` calls per second, a multiple of 24.
fn follow(scene: Scene, hair: Hair, walk: &Walk, elements: usize, options: &StepOptions, rate: u32) -> Path {
    let rules = Rules::new(options.quadrature_tolerance);
    let def = strand(scene, hair, walk, elements, Freedoms::ALL);
    let model = StrandModel::new(def.element_lengths.clone(), def.natural.clone(), def.material, def.freedoms);
    let initial = def.initial.clone().expect("settled");
    let rates = vec![[0.0; 3]; elements];
    let mut state = StrandState::new(&model, &rules, initial, rates, def.root, def.root_velocity, def.root_angular_velocity);
    let mut scratch = StepScratch::default();
    let mut kinematics = Kinematics::default();
    let mut path = Path::default();
    let h = 1.0 / f64::from(rate);
    for call in 0..(DURATION * f64::from(rate)).round() as u32 {
        let from = h * f64::from(call);
        let root_at = |elapsed: f64| scene.root(walk, from + elapsed);
        let surroundings = Surroundings { gravity: Vector3::from(GRAVITY).into(), wind: scene.wind(from).into() };
        let setting = Setting { surroundings: &surroundings, options, rules: &rules };
        let outcome = step::take(
            &setting,
            &mut One { model: &model, state: &mut state, root_at: &root_at, target: None, touches: None },
            h,
            &mut scratch,
        );
        assert!(outcome.converged && !outcome.quarantined, "{} {} at {from} s: {outcome:?}", scene.name(), hair.name());
        if (call + 1) % (rate / FRAMES) == 0 {
            let rule = rules.rule(state.rule);
            kinematics.update(&rotation_matrix(&state.root), &model.lengths, &state.curvatures, rule);
            path.frames.push(Some(std::array::from_fn(|point| {
                let last = (point + 1) * elements / POINTS - 1;
                Vector3::from(kinematics.elements[last].origin_right()) + state.root.origin
            })));
        }
    }
    path
}

/// By the reference integrator, to `tolerance` of the length per second.
pub fn radau(scene: Scene, hair: Hair, walk: &Walk, elements: usize, tolerance: f64) -> Path {
    let options = StepOptions {
        integrator: Integrator::Reference,
        reference_tolerance: tolerance,
        quadrature_tolerance: QUADRATURE,
        ..StepOptions::default()
    };
    follow(scene, hair, walk, elements, &options, FRAMES)
}

/// Numbers of elements for the reference integrator: as many as the trajectories have if that takes minutes.
pub fn checked_elements(scene: Scene, hair: Hair) -> Vec<usize> {
    let cheap = matches!(scene, Scene::CalmSway | Scene::StiffBristle)
        || hair == Hair::Fuzzy
        || (hair == Hair::Wavy && matches!(scene, Scene::Walk | Scene::CurlyBounce));
    if cheap { vec![8, 64] } else { vec![8] }
}

/// By second order at `rate` and at twice as many steps per second, extrapolated; and the distance of the two in lengths.
pub fn extrapolated(scene: Scene, hair: Hair, walk: &Walk, elements: usize, rate: u32) -> (Path, Distance) {
    let options =
        StepOptions { tolerance: 1e-8, max_iterations: 200, quadrature_tolerance: QUADRATURE, ..StepOptions::default() };
    let coarse = follow(scene, hair, walk, elements, &options, rate);
    let fine = follow(scene, hair, walk, elements, &options, 2 * rate);
    let apart = coarse.distance(&fine, fine.frames.len(), scene.length(hair.length()));
    let frames = coarse.frames.iter().zip(&fine.frames);
    let extrapolate = |(coarse, fine): (&Option<Shape>, &Option<Shape>)| {
        let (coarse, fine) = ((*coarse)?, (*fine)?);
        Some(std::array::from_fn(|point| fine[point] + (fine[point] - coarse[point]) / 3.0))
    };
    (Path { frames: frames.map(extrapolate).collect() }, apart)
}

/// The trajectory to compare settings with.
pub struct Truth {
    /// The path.
    pub path: Path,
    /// Frames over which it can be trusted: until the run with more elements separates from it.
    pub frames: usize,
    /// Its distance from the run with more elements over these frames.
    pub uncertainty: Distance,
    /// The distance of its two runs over all frames, before extrapolation.
    pub steps: Distance,
}

impl Truth {
    /// Of one scene and hair.
    pub fn of(scene: Scene, hair: Hair, walk: &Walk) -> Self {
        let count = elements(hair);
        let (path, steps) = extrapolated(scene, hair, walk, count, RATE);
        let (more, _) = extrapolated(scene, hair, walk, count + count / 2, RATE);
        let length = scene.length(hair.length());
        let tip = |shape: &Option<Shape>| shape.expect("every frame")[POINTS - 1];
        let parted = path.frames.iter().zip(&more.frames).position(|(one, two)| (tip(one) - tip(two)).norm() > PARTED * length);
        let frames = parted.unwrap_or(path.frames.len());
        let uncertainty = path.distance(&more, frames.max(1), length);
        Self { path, frames, uncertainty, steps }
    }
}
