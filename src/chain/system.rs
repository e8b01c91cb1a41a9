//! The quadratic model of one strand that the linear solves share: springs and forces at the quadrature points and at the
//! curvatures.

use crate::math::lane::Lane;
use crate::math::vector::Vec3;
use crate::rod::kinematics::Kinematics;

/// A spring at every quadrature point and at every curvature. The linear solves read stiffness and force; Newton's iteration
/// derives the forces from the targets and the present state.
#[derive(Debug, Clone)]
pub struct ChainSystem<T> {
    /// Stiffness of each quadrature point, weight included, N/m.
    pub point_stiffness: Vec<T>,
    /// Force on each quadrature point in world axes, weight included, N.
    pub point_force: Vec<Vec3<T>>,
    /// Forces whose geometric terms enter the exact Hessian, world axes, N; empty for those of `point_force`.
    pub point_tension: Vec<Vec3<T>>,
    /// Unit normals of springs that act on the points in one direction only, world axes: one of each point, or several rounds of that
    /// ([`springs_of`]); empty where there are none.
    pub normals: Vec<Vec3<T>>,
    /// Stiffness of each of these springs, N/m; zero for none. Below zero it takes away from what `point_stiffness` has along the normal.
    pub normal_stiffness: Vec<T>,
    /// Stiffness of each curvature of each element, length included, N·m³.
    pub curvature_stiffness: Vec<[T; 3]>,
    /// Generalised force on each curvature of each element, length included, N·m².
    pub curvature_force: Vec<[T; 3]>,
    /// Stiffness of springs against the rotation of every element's right end, N·m/rad: Levenberg's damping in rotations.
    pub rotation_stiffness: T,
    /// Whether to add the exact Hessian's geometric terms of `point_force`.
    pub exact: bool,
}

impl<T: Lane> Default for ChainSystem<T> {
    fn default() -> Self {
        Self {
            point_stiffness: Vec::new(),
            point_force: Vec::new(),
            point_tension: Vec::new(),
            normals: Vec::new(),
            normal_stiffness: Vec::new(),
            curvature_stiffness: Vec::new(),
            curvature_force: Vec::new(),
            rotation_stiffness: T::zero(),
            exact: true,
        }
    }
}

/// What a solve returns beside the change of the curvatures.
#[derive(Debug, Clone, Copy)]
pub struct Direction<T> {
    /// Force·direction: minus the slope of the potential along the direction.
    pub descent: T,
    /// Largest rotation of an element's right end for the whole direction, rad, squared.
    pub rotation_squared: T,
    /// Sum of the squared rotations of all elements' right ends, rad².
    pub rotation_sum: T,
    /// How many pivots were not positive definite and had to be repaired (dense solves: eigenvalues).
    pub repaired: T,
    /// Condition number of the matrix (dense singular values only; otherwise 0).
    pub condition: f64,
}

/// A solver of the chain's linear system.
pub trait LinearSolve<T> {
    /// Whether it reports pivots that are not positive, so that damping can respond.
    const DAMPED: bool;
    /// Limit on an element's turn in one iteration, rad: the quadratic model means nothing beyond it.
    const ROTATION_LIMIT: f64;

    /// The change of the curvatures `axes` (ascending) of every element; 0 for the others.
    fn solve(
        &mut self,
        kinematics: &Kinematics<T>,
        system: &ChainSystem<T>,
        axes: &[usize],
        change: &mut Vec<[T; 3]>,
    ) -> Direction<T>;
}

impl<T: Lane> ChainSystem<T> {
    /// The force whose geometric terms point `p` adds to the exact Hessian.
    #[inline(always)]
    pub fn tension(&self, p: usize) -> Vec3<T> {
        if self.point_tension.is_empty() { self.point_force[p] } else { self.point_tension[p] }
    }

    /// Resizes everything for a strand.
    #[inline(always)]
    pub fn resize(&mut self, elements: usize, points: usize) {
        self.point_stiffness.resize(points, T::zero());
        self.point_force.resize(points, Vec3::zero());
        self.point_tension.clear();
        self.normals.clear();
        self.normal_stiffness.clear();
        self.curvature_stiffness.resize(elements, [T::zero(); 3]);
        self.curvature_force.resize(elements, [T::zero(); 3]);
    }
}

/// Where the normal springs of point `p` are in lists that hold `count` of them, one round of the `points` points after another.
#[inline(always)]
pub fn springs_of(p: usize, points: usize, count: usize) -> SpringsOf {
    SpringsOf { next: p, points, count }
}

/// See [`springs_of`].
#[derive(Debug)]
pub struct SpringsOf {
    next: usize,
    points: usize,
    count: usize,
}

impl Iterator for SpringsOf {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let spring = self.next;
        self.next += self.points;
        (spring < self.count).then_some(spring)
    }
}
