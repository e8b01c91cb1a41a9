//! Loads at material points: forces between the quadrature points, or at the end of a rigid lever, from contacts and constraints.
//!
//! A lever turns with the material frame at its point, so forces on two or three levers hold a direction or a frame.
//!
//! Symbols: s is the arclength on the element; x the loaded point, its lever l included, in the axes of the element's left end; J
//! its variation by δκ, J = J_s + (Ψ_s ·)×l.

use crate::math::functions::entire::Stumpff;
use crate::math::lane::Lane;
use crate::math::vector::{Mat3, Vec3};
use crate::rod::kinematics::ElementState;
use crate::rod::segment;

/// A material point that is not a quadrature point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaterialPoint {
    /// Which element.
    pub element: usize,
    /// Arclength from its left end, m.
    pub s: f64,
    /// The lever, in the axes of the material frame there, m; zero for none.
    pub lever: [f64; 3],
}

impl MaterialPoint {
    /// A point on the strand itself.
    pub fn on(element: usize, s: f64) -> Self {
        Self { element, s, lever: [0.0; 3] }
    }

    fn has_lever(&self) -> bool {
        self.lever != [0.0; 3]
    }
}

/// A loaded material point in the strand's present shape, in the axes of its element's left end, and the force that its tension
/// comes from.
#[derive(Debug, Clone, Copy)]
pub struct Load<T> {
    /// Which element.
    pub element: usize,
    /// Arclength from its left end.
    pub s: T,
    /// Stumpff's functions there.
    pub c: Stumpff<T>,
    /// x.
    pub local: Vec3<T>,
    /// J, all three columns.
    pub jacobian: Mat3<T>,
    /// l; meaningless where `turning` is `None`.
    pub lever: Vec3<T>,
    /// Ψ_s where there is a lever.
    pub turning: Option<Mat3<T>>,
    /// The force whose geometric terms enter the exact Hessian.
    pub tension: Vec3<T>,
    /// Stiffness K of a spring on the loaded point, symmetric: adds ½ δrᵀ K δr to the quadratic model. `None`: no spring.
    pub stiffness: Option<Mat3<T>>,
}

impl Load<f64> {
    /// The load of a material point in the shape of `elements`; `tension` in world axes.
    pub fn at(elements: &[ElementState<f64>], material_point: &MaterialPoint, tension: Vec3<f64>) -> Self {
        let element = &elements[material_point.element];
        let point = element.point(material_point.s);
        let (theta, z) = (element.kappa.scale(material_point.s), element.kappa_squared * (material_point.s * material_point.s));
        let mut jacobian = segment::chord_gradient(theta, z, &point.c).scale(material_point.s * material_point.s);
        let (mut lever, mut turning) = (Vec3::zero(), None);
        if material_point.has_lever() {
            lever = segment::frame(theta, z, &point.c).apply(Vec3(material_point.lever));
            let psi = segment::mean_frame(theta, z, &point.c).scale(material_point.s);
            // (Ψ δ)×l = −[l]× Ψ δ.
            jacobian = jacobian.sub(&psi.crossed_from_left(lever));
            turning = Some(psi);
        }
        Self {
            element: material_point.element,
            s: material_point.s,
            c: point.c,
            local: point.local + lever,
            jacobian,
            lever,
            turning,
            tension: element.frame_left.apply_transposed(tension),
            stiffness: None,
        }
    }

    /// Adds a spring of this stiffness (symmetric, world axes, N/m).
    pub fn with_stiffness(self, elements: &[ElementState<f64>], stiffness: &Mat3<f64>) -> Self {
        let turn = &elements[self.element].frame_left;
        Self { stiffness: Some(turn.transposed_mul(stiffness).mul(turn)), ..self }
    }

    /// Position of the loaded point relative to the root's origin, world axes.
    pub fn position(&self, elements: &[ElementState<f64>]) -> Vec3<f64> {
        let element = &elements[self.element];
        element.origin_left + element.frame_left.apply(self.local)
    }
}

impl<T: Lane> Load<T> {
    /// A load without effect: for a lane whose strand has no load where other lanes do.
    pub fn none(element: usize) -> Self {
        let c =
            Stumpff { c1: T::zero(), c2: T::zero(), c3: T::zero(), c4: T::zero(), c5: T::zero(), c6: T::zero(), c7: T::zero() };
        Self {
            element,
            s: T::zero(),
            c,
            local: Vec3::zero(),
            jacobian: Mat3::zero(),
            lever: Vec3::zero(),
            turning: None,
            tension: Vec3::zero(),
            stiffness: None,
        }
    }

    /// Turns the load into one without effect on `element`.
    #[inline(always)]
    pub fn clear(&mut self, element: usize) {
        self.element = element;
        self.s = T::zero();
        for part in
            [&mut self.c.c1, &mut self.c.c2, &mut self.c.c3, &mut self.c.c4, &mut self.c.c5, &mut self.c.c6, &mut self.c.c7]
        {
            *part = T::zero();
        }
        (self.local, self.lever, self.tension) = (Vec3::zero(), Vec3::zero(), Vec3::zero());
        self.jacobian = Mat3::zero();
        (self.turning, self.stiffness) = (None, None);
    }

    /// Writes one strand's load into its lane.
    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, from: &Load<f64>) {
        let put = |to: &mut T, from: f64| to.set_lane(lane, from);
        let put_vector = |to: &mut Vec3<T>, from: &Vec3<f64>| (0..3).for_each(|i| to.0[i].set_lane(lane, from.0[i]));
        let put_matrix = |to: &mut Mat3<T>, from: &Mat3<f64>| {
            (0..3).for_each(|i| (0..3).for_each(|j| to.0[i][j].set_lane(lane, from.0[i][j])));
        };
        put(&mut self.s, from.s);
        put(&mut self.c.c1, from.c.c1);
        put(&mut self.c.c2, from.c.c2);
        put(&mut self.c.c3, from.c.c3);
        put(&mut self.c.c4, from.c.c4);
        put(&mut self.c.c5, from.c.c5);
        put(&mut self.c.c6, from.c.c6);
        put(&mut self.c.c7, from.c.c7);
        put_vector(&mut self.local, &from.local);
        put_vector(&mut self.lever, &from.lever);
        put_vector(&mut self.tension, &from.tension);
        put_matrix(&mut self.jacobian, &from.jacobian);
        if let Some(turning) = &from.turning {
            put_matrix(self.turning.get_or_insert_with(Mat3::zero), turning);
        }
        if let Some(stiffness) = &from.stiffness {
            put_matrix(self.stiffness.get_or_insert_with(Mat3::zero), stiffness);
        }
    }

    /// δr for a rotation and a displacement of the element's left end and a change of its curvatures, in the element's axes.
    #[inline(always)]
    pub fn moved(&self, psi: Vec3<T>, rho: Vec3<T>, delta: Vec3<T>) -> Vec3<T> {
        rho + psi.cross(self.local) + self.jacobian.apply(delta)
    }
}
