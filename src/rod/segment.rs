//! Kinematics of one helical segment in the frame of its left end, and its first and second variations (`docs/theory/mathematics.md`;
//! Bertails et al. 2006, appendix A, without the singular case).
//!
//! Symbols: κ = (κ0, κ1, κ2) twist and curvatures; s arclength from the left end; θ = sκ; z = θ·θ; e0 the tangent at the left end;
//! cₖ Stumpff's functions at z (A = c1, B = c2, C = c3; b, c, b′, c′ as in `math::entire`). Then
//!
//! ```text
//! frame     exp[θ]× = (1 − Bz) I + A[θ]× + Bθθᵀ,
//! its mean  V(θ)    = (1 − Cz) I + B[θ]× + Cθθᵀ, so that Ψ = sV is the rotation of the frame per δκ,
//! chord     V e0, so that r = s V e0, and J = s² ∂(V e0)/∂θ its variation.
//! ```

use crate::math::functions::entire::Stumpff;
use crate::math::lane::Lane;
use crate::math::vector::{Mat3, Vec3, matrix};

/// `factor_i I + factor_x [θ]× + factor_d θθᵀ`.
#[inline(always)]
fn rotation_like<T: Lane>(theta: Vec3<T>, factor_i: T, factor_x: T, factor_d: T) -> Mat3<T> {
    let [x, y, z] = theta.0;
    let (xd, yd, zd) = (x * factor_d, y * factor_d, z * factor_d);
    let (xx, yx, zx) = (x * factor_x, y * factor_x, z * factor_x);
    let (xy, xz, yz) = (xd * y, xd * z, yd * z);
    Mat3([[factor_i + xd * x, xy - zx, xz + yx], [xy + zx, factor_i + yd * y, yz - xx], [xz - yx, yz + xx, factor_i + zd * z]])
}

/// The frame at θ relative to the left end: `exp[θ]×`.
#[inline(always)]
pub fn frame<T: Lane>(theta: Vec3<T>, z: T, c: &Stumpff<T>) -> Mat3<T> {
    rotation_like(theta, T::one() - c.c2 * z, c.c1, c.c2)
}

/// `V(θ) = ∫₀¹ exp(t[θ]×) dt`.
#[inline(always)]
pub fn mean_frame<T: Lane>(theta: Vec3<T>, z: T, c: &Stumpff<T>) -> Mat3<T> {
    rotation_like(theta, T::one() - c.c3 * z, c.c2, c.c3)
}

/// V(θ) e0: the chord from the left end over the arclength.
#[inline(always)]
pub fn chord<T: Lane>(theta: Vec3<T>, z: T, c: &Stumpff<T>) -> Vec3<T> {
    let [t0, t1, t2] = theta.0;
    // θ × e0 = (0, θ2, −θ1).
    Vec3([T::one() + c.c3 * (t0 * t0 - z), c.c2 * t2 + c.c3 * t1 * t0, c.c3 * t2 * t0 - c.c2 * t1])
}

/// ∂(V e0)/∂θ.
#[inline(always)]
pub fn chord_gradient<T: Lane>(theta: Vec3<T>, z: T, c: &Stumpff<T>) -> Mat3<T> {
    let [t0, t1, t2] = theta.0;
    let (b, cc) = (c.b(), c.c());
    // u = b (θ×e0) + c (θθ0 − e0 z), which multiplies θᵀ.
    let u = [cc * (t0 * t0 - z), b * t2 + cc * t1 * t0, cc * t2 * t0 - b * t1];
    let (big_b, big_c) = (c.c2, c.c3);
    let two = T::splat(2.0);
    Mat3([
        [u[0] * t0, u[0] * t1 - two * big_c * t1, u[0] * t2 - two * big_c * t2],
        [u[1] * t0 + big_c * t1, u[1] * t1 + big_c * t0, u[1] * t2 + big_b],
        [u[2] * t0 + big_c * t2, u[2] * t1 - big_b, u[2] * t2 + big_c * t0],
    ])
}

/// A quadratic form in δκ that a segment's second variations make:
/// kk κκᵀ + unit I + sym(κ with_kappaᵀ) + sym(e0 with_tangentᵀ), sym(A) = ½ (A + Aᵀ).
#[derive(Debug, Clone, Copy)]
pub struct CurvatureForm<T> {
    kk: T,
    unit: T,
    with_kappa: Vec3<T>,
    with_tangent: Vec3<T>,
}

impl<T: Lane> CurvatureForm<T> {
    /// The zero form.
    #[inline(always)]
    pub fn zero() -> Self {
        Self { kk: T::zero(), unit: T::zero(), with_kappa: Vec3::zero(), with_tangent: Vec3::zero() }
    }

    /// Adds −f·h, where h = δ²(s V e0) for δκ and f is a force (segment's axes) at arclength s.
    #[inline(always)]
    pub fn subtract_force(&mut self, force: Vec3<T>, kappa: Vec3<T>, s: T, kappa_squared: T, c: &Stumpff<T>) {
        let [f0, f1, f2] = force.0;
        let [k0, k1, k2] = kappa.0;
        let two = T::splat(2.0);
        let along = force.dot(kappa);
        // α̂ = f·(κ×e0), β̂ = f·(κκ0 − |κ|²e0).
        let alpha = f1 * k2 - f2 * k1;
        let beta = k0 * along - kappa_squared * f0;
        let (b, cc, b1, c1) = (c.b(), c.c(), c.b_prime(), c.c_prime());
        let s2 = s * s;
        let s3 = s2 * s;
        let s4 = s2 * s2;
        self.kk -= s3 * (b1 * s3 * alpha + c1 * s4 * beta - two * two * cc * s2 * f0);
        self.unit -= s3 * (b * s * alpha + cc * s2 * beta - two * c.c3 * f0);
        let (p, q) = (two * b * s4, two * cc * s4 * s);
        // e0 × f = (0, −f2, f1).
        self.with_kappa -= Vec3([q * (k0 * f0 + along), q * k0 * f1 - p * f2, q * k0 * f2 + p * f1]);
        self.with_tangent -= force.scale(two * c.c3 * s3);
    }

    /// Adds −m·∫a×a′ over the segment of length ℓ, where a = Ψδκ and m is a moment (segment's axes) about its right end.
    #[inline(always)]
    pub fn subtract_moment(&mut self, moment: Vec3<T>, kappa: Vec3<T>, length: T, kappa_squared: T, c: &Stumpff<T>) {
        let l2 = length * length;
        let l3 = l2 * length;
        let along = moment.dot(kappa);
        let (b, cc) = (c.b(), c.c());
        self.kk -= l2 * l3 * cc * along;
        self.unit -= l3 * c.c3 * along;
        self.with_kappa -= moment.cross(kappa).scale(l2 * l2 * b) - moment.scale(l3 * (cc * l2 * kappa_squared + c.c3));
    }

    /// The form's matrix.
    #[inline(always)]
    pub fn matrix(&self, kappa: Vec3<T>) -> Mat3<T> {
        let half = T::splat(0.5);
        let k = kappa.0;
        let w = Vec3([self.with_kappa.0[0] * half, self.with_kappa.0[1] * half, self.with_kappa.0[2] * half]).0;
        let t = self.with_tangent.scale(half).0;
        let mut out = matrix!(|i, j| self.kk * k[i] * k[j] + (k[i] * w[j] + w[i] * k[j]));
        for i in 0..3 {
            out.0[i][i] += self.unit;
            out.0[0][i] += t[i];
            out.0[i][0] += t[i];
        }
        out
    }
}

/// h(s) = δ²(s V e0) for δκ = v: the second variation of a point's position in the segment's axes.
#[inline(always)]
pub fn second_variation<T: Lane>(kappa: Vec3<T>, v: Vec3<T>, s: T, kappa_squared: T, c: &Stumpff<T>) -> Vec3<T> {
    let theta = kappa.scale(s);
    let z = s * s * kappa_squared;
    let t0 = theta.0[0];
    let along = theta.dot(v);
    let square = v.norm_squared();
    let tangent = Vec3([T::one(), T::zero(), T::zero()]);
    let turned = theta.cross(tangent);
    let bent = theta.scale(t0) - tangent.scale(z);
    let two = T::splat(2.0);
    let (b, cc) = (c.b(), c.c());
    let sum = turned.scale(c.b_prime() * along * along + b * square)
        + v.cross(tangent).scale(two * b * along)
        + bent.scale(c.c_prime() * along * along + cc * square)
        + (v.scale(t0) + theta.scale(v.0[0]) - tangent.scale(two * along)).scale(two * cc * along)
        + (v.scale(v.0[0]) - tangent.scale(square)).scale(two * c.c3);
    sum.scale(s * s * s)
}

/// ∫₀ˢ a×a′ du for δκ = v: the second variation of the frame's rotation in the segment's axes.
#[inline(always)]
pub fn second_rotation<T: Lane>(kappa: Vec3<T>, v: Vec3<T>, s: T, kappa_squared: T, c: &Stumpff<T>) -> Vec3<T> {
    let theta = kappa.scale(s);
    let along = theta.dot(v);
    let z = s * s * kappa_squared;
    let sum = theta.cross(v).scale(c.b() * along)
        + (theta.scale(along) - v.scale(z)).scale(c.c() * along)
        + (theta.scale(v.norm_squared()) - v.scale(along)).scale(c.c3);
    sum.scale(s * s)
}
