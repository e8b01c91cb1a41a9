//! Contact with friction: its exact solve for one contact.
//!
//! In the frame of the normal and the two tangents along which W's tangential part is diagonal, sliding with friction opposite to it is
//! u_T = −α λ_T for some α ≥ 0, so λ_T = −(W_TT + α)⁻¹ (b_T + W_TN λ_N), and λ_N follows from the normal response. α = 0 is sticking, α = ∞
//! no friction. Coulomb's law is one equation for α, |λ_T| = μ λ_N, which has a root wherever the cone does not hold the sticking force:
//! |λ_T| − μ λ_N is positive at α = 0 and negative at α = ∞. (Isotropic and hard it is the quartic of Daviet et al. 2011, solved here by a
//! bracketed search, which needs neither isotropy nor a linear response.)

use std::fmt::Display;

use nalgebra::{Matrix3, Vector3};

use super::coefficient::Coefficient;
use super::response::{Depth, Response};
use super::secular;
use super::{across, check_unit, diagonalising};
use crate::error::Result;

/// Friction of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Friction {
    /// Nothing.
    None,
    /// Coulomb: no sliding with |λ_T| ≤ μ λ_N, or sliding with |λ_T| = μ λ_N opposite to it. Where μ depends on the direction,
    /// a contact at rest bears what it would bear if it slid the way it is pulled.
    Coulomb(Coefficient),
    /// Proportional to the sliding velocity, λ_T = −c u_T/h (Bertails et al. 2006), whatever the normal force. Whoever gives
    /// the law decides which contacts have it: those under pressure when the problem is made, with [`Friction::None`] for the
    /// others.
    Viscous(Coefficient),
}

/// Two surfaces that may part but not pass through each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Unit normal, world axes, from the partner to the first strand. The component of `u` along it is the gap at the step's
    /// end.
    pub normal: Vector3<f64>,
    /// Normal response.
    pub response: Response,
    /// Friction.
    pub friction: Friction,
}

impl Contact {
    /// See [`super::Law::check`].
    pub(super) fn check(&self, argument: impl Display) -> Result<()> {
        check_unit(|| format!("{argument}.normal"), &self.normal)?;
        self.response.check(format_args!("{argument}.response"))?;
        match &self.friction {
            Friction::None => Ok(()),
            Friction::Coulomb(coefficient) | Friction::Viscous(coefficient) => {
                coefficient.check(format_args!("{argument}.friction"))
            }
        }
    }

    /// Two unit tangents, across each other.
    pub(in crate::contact) fn tangents(&self) -> [Vector3<f64>; 2] {
        across(&self.normal)
    }

    /// What a linear response adds to the gap: m per N of normal force, and m without force.
    pub(in crate::contact) fn compliance_and_shift(&self, step: f64) -> (f64, f64) {
        let depth = self.response.depth(step);
        (depth.compliance(), depth.shift)
    }

    /// The gap at the displacement `u`, m, where the surfaces yield to `force` as its response says: below zero only for what is
    /// deeper.
    pub fn gap(&self, u: &Vector3<f64>, force: &Vector3<f64>, step: f64) -> f64 {
        u.dot(&self.normal) + self.response.depth(step).at(force.dot(&self.normal).max(0.0))
    }

    /// See [`super::Law::residual`].
    pub(super) fn residual(&self, u: Vector3<f64>, lambda: Vector3<f64>, step: f64, length: f64, force: f64) -> f64 {
        let (u_n, lambda_n) = (u.dot(&self.normal), lambda.dot(&self.normal));
        let depth = self.response.depth(step);
        let gap = self.gap(&u, &lambda, step);
        // By the force or by the depth, whichever is nearer: the depth of a soft spring cannot be had from a force of a
        // rounding, nor the force of a hard one from a depth.
        let by_force = (lambda_n - depth.pressed(-u_n)).abs() / force;
        let normal = (lambda_n / force).min(gap / length).abs().min(by_force);
        let u_t = u - self.normal * u_n;
        let lambda_t = lambda - self.normal * lambda_n;
        let tangential = match self.friction {
            Friction::None => lambda_t.norm() / force,
            Friction::Coulomb(mu) => {
                let trial = lambda_t / force - u_t / length;
                let size = trial.norm();
                let allowed = if size > 0.0 { mu.at(&(-trial / size)) * lambda_n.max(0.0) / force } else { 0.0 };
                if size <= allowed { u_t.norm() / length } else { (lambda_t / force - trial * (allowed / size)).norm() }
            }
            Friction::Viscous(c) => {
                let speed = u_t.norm();
                let full = if speed > 0.0 { c.at(&(u_t / speed)) / step } else { 0.0 };
                (lambda_t + u_t * full).norm() / (force + full * length)
            }
        };
        normal.max(tangential)
    }
}

/// Friction in the contact's own frame.
#[derive(Debug, Clone, Copy)]
enum Local {
    None,
    /// Mean and lean of the coefficient.
    Coulomb(f64, [f64; 2]),
    /// The same over the step's seconds, N/m.
    Viscous(f64, [f64; 2]),
}

/// A contact's law with its W.
#[derive(Debug, Clone, Copy)]
pub struct ContactSolve {
    /// Normal and tangents, world axes, as rows.
    frame: Matrix3<f64>,
    depth: Depth,
    friction: Local,
    /// W: normal, tangents, and the coupling of each tangent with the normal, m/N.
    normal: f64,
    tangent: [f64; 2],
    coupling: [f64; 2],
    /// An α that counts as zero: it moves a sticking contact by a rounding error of W λ.
    least: f64,
    /// Where the last search ended.
    guess: f64,
}

/// The forces for some α (or viscosity).
struct Forces {
    normal: f64,
    tangent: [f64; 2],
    /// Slope of the normal equation.
    slope: f64,
}

impl ContactSolve {
    pub(super) fn new(contact: &Contact, response: &Matrix3<f64>, step: f64) -> Self {
        let n = contact.normal;
        let [s, t] = across(&n);
        let (ws, wt) = (response * s, response * t);
        // W's tangential part, and the tangents in which it is diagonal.
        let (ss, st, tt) = (s.dot(&ws), 0.5 * (t.dot(&ws) + s.dot(&wt)), t.dot(&wt));
        let (cos, sin) = diagonalising(ss, st, tt);
        let tangents = [s * cos + t * sin, t * cos - s * sin];
        let wn = response * n;
        let scale = response.trace().max(0.0);
        let least = (4.0 * f64::EPSILON * scale).max(f64::MIN_POSITIVE);
        let local = |c: &Coefficient, over: f64| (c.mean / over, tangents.map(|t| c.lean.dot(&t) / over));
        let friction = match &contact.friction {
            Friction::Coulomb(c) if c.mean > 0.0 => {
                let (mean, lean) = local(c, 1.0);
                Local::Coulomb(mean, lean)
            }
            Friction::Viscous(c) if c.mean > 0.0 => {
                let (mean, lean) = local(c, step);
                Local::Viscous(mean, lean)
            }
            _ => Local::None,
        };
        Self {
            frame: Matrix3::from_rows(&[n.transpose(), tangents[0].transpose(), tangents[1].transpose()]),
            depth: contact.response.depth(step),
            friction,
            normal: n.dot(&wn).max(0.0) + least,
            tangent: tangents.map(|t| t.dot(&(response * t)).max(0.0)),
            coupling: tangents.map(|t| t.dot(&wn)),
            least,
            guess: 0.5 * scale,
        }
    }

    /// See [`super::LawSolve::solve`]; `last`: see [`secular`].
    #[inline(always)]
    pub(super) fn solve(&mut self, unconstrained: Vector3<f64>, last: f64) -> Vector3<f64> {
        if self.least == f64::MIN_POSITIVE {
            // Nothing moves here, whatever the force.
            return Vector3::zeros();
        }
        let b = self.frame * unconstrained;
        let b = [b.x + self.depth.shift, b.y, b.z];
        let local = match self.friction {
            Local::None => {
                let (force, _) = self.depth.force(self.normal, -b[0]);
                Vector3::new(force.max(0.0), 0.0, 0.0)
            }
            Local::Coulomb(..) if b[0] >= 0.0 => Vector3::zeros(),
            Local::Coulomb(mean, lean) => self.coulomb(&b, mean, lean, last),
            Local::Viscous(mean, lean) => self.viscous(&b, mean, lean),
        };
        self.frame.tr_mul(&local)
    }

    /// The forces where the tangential mobilities are `v` = (W_TT + α)⁻¹.
    #[inline(always)]
    fn forces(&self, b: &[f64; 3], v: [f64; 2]) -> Forces {
        let a = &self.coupling;
        let (av0, av1) = (a[0] * v[0], a[1] * v[1]);
        let drive = -b[0] + (av0 * b[1] + av1 * b[2]);
        let stiff = (self.normal - (av0 * a[0] + av1 * a[1])).max(self.least);
        let (normal, slope) = self.depth.force(stiff, drive);
        Forces { normal, tangent: [-(b[1] + a[0] * normal) * v[0], -(b[2] + a[1] * normal) * v[1]], slope }
    }

    #[inline(always)]
    fn coulomb(&mut self, b: &[f64; 3], mean: f64, lean: [f64; 2], last: f64) -> Vector3<f64> {
        let mobility = |alpha: f64| [1.0 / (self.tangent[0] + alpha), 1.0 / (self.tangent[1] + alpha)];
        let stick = self.forces(b, mobility(self.least));
        if stick.normal >= 0.0 {
            let [x, y] = stick.tangent;
            let size = (x * x + y * y).sqrt();
            if size * size <= (mean * size - (lean[0] * x + lean[1] * y)) * stick.normal || size == 0.0 {
                return Vector3::new(stick.normal, x, y);
            }
        }
        // μ λ_N/|λ_T| − 1 is nearly linear in α, as secular equations are in this form; its negative falls.
        let alpha = secular::root(self.least, self.guess, last, |alpha| {
            let v = mobility(alpha);
            let f = self.forces(b, v);
            let [x, y] = f.tangent;
            let square = x * x + y * y;
            let size = square.sqrt();
            if size == 0.0 {
                return (f64::NEG_INFINITY, 1.0);
            }
            let along = lean[0] * x + lean[1] * y;
            let per_force = mean / size - along / square;
            let normal_slope = (self.coupling[0] * v[0] * x + self.coupling[1] * v[1] * y) / f.slope;
            let x_slope = -v[0] * (self.coupling[0] * normal_slope + x);
            let y_slope = -v[1] * (self.coupling[1] * normal_slope + y);
            let size_slope = (x * x_slope + y * y_slope) / size;
            let per_force_slope = -mean * size_slope / square - (lean[0] * x_slope + lean[1] * y_slope) / square
                + 2.0 * along * size_slope / (square * size);
            (1.0 - f.normal * per_force, -(normal_slope * per_force + f.normal * per_force_slope))
        });
        self.guess = alpha;
        let f = self.forces(b, mobility(alpha));
        let normal = f.normal.max(0.0);
        // The size is from the law, so that it holds to rounding; the root only gives the direction.
        let [mut x, mut y] = f.tangent;
        let mut size = (x * x + y * y).sqrt();
        if size == 0.0 {
            // α beyond all numbers, μ next to nothing: opposite to the sliding.
            (x, y) = (-(b[1] + self.coupling[0] * normal), -(b[2] + self.coupling[1] * normal));
            size = (x * x + y * y).sqrt();
            if size == 0.0 {
                return Vector3::new(normal, 0.0, 0.0);
            }
        }
        let (x, y) = (x / size, y / size);
        let held = (mean - (lean[0] * x + lean[1] * y)).max(0.0) * normal;
        Vector3::new(normal, held * x, held * y)
    }

    #[inline(always)]
    fn viscous(&mut self, b: &[f64; 3], mean: f64, lean: [f64; 2]) -> Vector3<f64> {
        let mobility = |c: f64| [c / (1.0 + c * self.tangent[0]), c / (1.0 + c * self.tangent[1])];
        let largest = mean + (lean[0] * lean[0] + lean[1] * lean[1]).sqrt();
        let forces = |c: f64, pressed: bool| {
            let v = mobility(c);
            if pressed { self.forces(b, v) } else { Forces { normal: 0.0, tangent: [-b[1] * v[0], -b[2] * v[1]], slope: 0.0 } }
        };
        // The coefficient in the direction in which the contact slides under coefficient c.
        let asked = |c: f64, pressed: bool| {
            let normal = forces(c, pressed).normal;
            let x = (b[1] + self.coupling[0] * normal) / (1.0 + c * self.tangent[0]);
            let y = (b[2] + self.coupling[1] * normal) / (1.0 + c * self.tangent[1]);
            let size = (x * x + y * y).sqrt();
            if size > 0.0 { (mean + (lean[0] * x + lean[1] * y) / size).max(0.0) } else { mean }
        };
        let solve = |pressed: bool| {
            let c = if lean == [0.0; 2] { mean } else { crossing(0.0, largest, |c| c - asked(c, pressed)) };
            forces(c, pressed)
        };
        let f = solve(true);
        let f = if f.normal >= 0.0 { f } else { solve(false) };
        Vector3::new(f.normal, f.tangent[0], f.tangent[1])
    }
}

/// Where a function that is not above zero at `low` and not below zero at `high` crosses zero, to rounding: the Illinois method.
fn crossing(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut at_low, mut at_high) = (f(low), f(high));
    if at_low >= 0.0 {
        return low;
    }
    if at_high <= 0.0 {
        return high;
    }
    let mut last = None;
    for round in 0..200 {
        let chord = (low * at_high - high * at_low) / (at_high - at_low);
        let middle = 0.5 * (low + high);
        let x = if round % 4 != 3 && chord > low && chord < high { chord } else { middle };
        if x <= low || x >= high || high - low <= 4.0 * f64::EPSILON * high {
            break;
        }
        let value = f(x);
        if value == 0.0 {
            return x;
        }
        let below = value < 0.0;
        if below {
            (low, at_low) = (x, value);
        } else {
            (high, at_high) = (x, value);
        }
        // The same end twice: the other one's weight is halved, so that it moves too.
        if last == Some(below) {
            if below {
                at_high *= 0.5;
            } else {
                at_low *= 0.5;
            }
        }
        last = Some(below);
    }
    0.5 * (low + high)
}
