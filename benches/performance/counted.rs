//! The number of arithmetic operations of an iteration: the engine's own kernels with a number type that counts.

use std::cell::Cell;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use nalgebra::Vector3;
use superhelix::internals::chain::displacement;
use superhelix::internals::chain::elimination::Elimination;
use superhelix::internals::chain::system::{ChainSystem, LinearSolve};
use superhelix::internals::math::lane::{Kernel, Lane};
use superhelix::internals::math::quadrature::Rules;
use superhelix::internals::math::vector::Mat3;
use superhelix::internals::rod::kinematics::Kinematics;
use superhelix::internals::rod::strand::StrandModel;
use superhelix::internals::step::pack::members::One;
use superhelix::internals::step::pack::whole::Take;
use superhelix::internals::step::state::StrandState;
use superhelix::internals::step::workspace::Workspace;
use superhelix::internals::step::{Setting, Surroundings};
use superhelix::{Frame, Precision};

use crate::crowd;
use crate::scene::{GRAVITY, STEP, Stage};

thread_local! {
    static OPERATIONS: Cell<u64> = const { Cell::new(0) };
}

/// A number that counts additions, subtractions, multiplications, divisions and square roots, each as one. `NARROW`: the
/// operations of f32, whose series need fewer terms; the arithmetic itself is that of f64 either way.
#[derive(Debug, Clone, Copy)]
struct Counted<const NARROW: bool>(f64);

fn count<const NARROW: bool>(value: f64) -> Counted<NARROW> {
    OPERATIONS.set(OPERATIONS.get() + 1);
    Counted(value)
}

macro_rules! operator {
    ($trait:ident, $function:ident) => {
        impl<const NARROW: bool> $trait for Counted<NARROW> {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                count(self.0.$function(other.0))
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<const NARROW: bool> Neg for Counted<NARROW> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}
impl<const NARROW: bool> AddAssign for Counted<NARROW> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
impl<const NARROW: bool> SubAssign for Counted<NARROW> {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<const NARROW: bool> Lane for Counted<NARROW> {
    type Mask = bool;
    const LANES: usize = 1;
    const PRECISION: Precision = if NARROW { Precision::F32 } else { Precision::F64 };

    fn splat(value: f64) -> Self {
        Self(value)
    }
    fn sqrt(self) -> Self {
        count(self.0.sqrt())
    }
    fn less(self, other: Self) -> bool {
        self.0 < other.0
    }
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    fn bits(mask: bool) -> u32 {
        u32::from(mask)
    }
    fn both(a: bool, b: bool) -> bool {
        a && b
    }
    fn splat_mask(value: bool) -> bool {
        value
    }
    fn lane(&self, _index: usize) -> f64 {
        self.0
    }
    fn set_lane(&mut self, _index: usize, value: f64) {
        self.0 = value;
    }
    fn call<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }
}

/// Operations and iterations of one step of the setting's first strand, whose root has begun to move.
pub fn step(setting: &crowd::Setting) -> (f64, f64) {
    match setting.options.step.precision {
        Precision::F64 => step_in::<Counted<false>>(setting),
        Precision::F32 => step_in::<Counted<true>>(setting),
    }
}

fn step_in<T: Lane>(setting: &crowd::Setting) -> (f64, f64) {
    let stage = Stage::new(setting.scene, setting.strands);
    let def = stage.strands(&setting.hair).swap_remove(0);
    let rules = Rules::default();
    let model = StrandModel::new(def.element_lengths.clone(), def.natural.clone(), def.material, def.freedoms);
    let curvatures = def.initial.clone().unwrap_or_else(|| def.natural.clone());
    let rates = vec![[0.0; 3]; curvatures.len()];
    let mut state = StrandState::new(&model, &rules, curvatures, rates, def.root, def.root_velocity, def.root_angular_velocity);
    // A history at rest, so that the second-order integrator takes its usual path.
    state.history.curvatures.clone_from(&state.curvatures);
    state.history.velocities.clone_from(&state.velocities);
    (state.history.root, state.history.step) = (state.root, STEP);
    let surroundings = Surroundings { gravity: GRAVITY.into(), wind: Vector3::zeros().into() };
    let options = setting.options.step;
    let inner = Setting { surroundings: &surroundings, options: &options, rules: &rules };
    let end = stage.roots(STEP)[0];
    let start = def.root;
    let root_at = move |elapsed: f64| Frame {
        origin: start.origin + (end.origin - start.origin) * (elapsed / STEP),
        rotation: start.rotation.slerp(&end.rotation, elapsed / STEP),
    };
    let one = One { model: &model, state: &mut state, root_at: &root_at, target: None, touches: None };
    let mut workspace = Workspace::<T>::default();
    let mut elimination = Elimination::<T>::default();
    OPERATIONS.set(0);
    let outcome = Take { members: &one, setting: &inner, h: STEP, workspace: &mut workspace, solver: &mut elimination }.run()[0];
    (OPERATIONS.get() as f64, f64::from(outcome.iterations))
}

/// Operations per element of the parts of an iteration.
pub fn parts(setting: &crowd::Setting) -> Vec<(&'static str, f64)> {
    match setting.options.step.precision {
        Precision::F64 => parts_in::<Counted<false>>(setting),
        Precision::F32 => parts_in::<Counted<true>>(setting),
    }
}

fn parts_in<T: Lane>(setting: &crowd::Setting) -> Vec<(&'static str, f64)> {
    let def = Stage::new(setting.scene, 1).strands(&setting.hair).swap_remove(0);
    let curvatures = def.initial.clone().unwrap_or_else(|| def.natural.clone());
    let rules = Rules::default();
    let model = StrandModel::new(def.element_lengths.clone(), def.natural.clone(), def.material, def.freedoms);
    let rule = rules.rule(rules.next_for_angle(0, model.largest_angle(&curvatures)));
    let rows: Vec<_> = curvatures.iter().map(|row| row.map(T::splat)).collect();
    let lengths: Vec<_> = def.element_lengths.iter().map(|length| T::splat(*length)).collect();
    let root = Mat3(std::array::from_fn(|i| std::array::from_fn(|j| T::splat(f64::from(u8::from(i == j))))));
    let elements = rows.len() as f64;
    let counted = |work: &mut dyn FnMut()| {
        OPERATIONS.set(0);
        work();
        OPERATIONS.get() as f64 / elements
    };
    let mut kinematics = Kinematics::<T>::default();
    let place = counted(&mut || kinematics.update(&root, &lengths, &rows, rule));
    let mut system = ChainSystem::default();
    system.resize(rows.len(), kinematics.points.len());
    system.point_stiffness.fill(T::one());
    system.curvature_stiffness.fill([T::one(); 3]);
    let (mut elimination, mut change) = (Elimination::default(), Vec::new());
    let axes = setting.hair.freedoms.axes();
    let axes = &axes[..setting.hair.freedoms.count()];
    let mut solve = |exact: bool| {
        system.exact = exact;
        counted(&mut || {
            elimination.solve(&kinematics, &system, axes, &mut change);
        })
    };
    let (gauss_newton, exact) = (solve(false), solve(true));
    let motion =
        counted(&mut || displacement::for_each_point(&kinematics, &change, |_, moved| assert!(moved.0[0].lane(0).is_finite())));
    vec![
        ("positions of all points (kinematics)", place),
        ("elimination, Gauss-Newton", gauss_newton),
        ("elimination, exact Hessian: more", exact - gauss_newton),
        ("motion of all points, for the tension", motion),
    ]
}

/// Operations per element of one more iteration.
pub fn iteration(setting: &crowd::Setting) -> f64 {
    let (few, many) = (step(&setting.clone().iterations(3)), step(&setting.clone().iterations(7)));
    (many.0 - few.0) / (many.1 - few.1) / setting.hair.elements as f64
}
