//! Points of several strands side by side: how a whole groom is read at once.
//!
//! The strands have equal numbers of elements, and points are asked for at the same places of them. Every function is a loop over
//! strands without a branch, which compilers vectorise. A strand's numbers do not depend on its neighbours.
//!
//! Along the strand everything is f64: frames of the elements' ends as quaternions, ends as vectors from the root. Within an
//! element the point is [`Real`]: in f32 it is off by some 1e-7 of the strand's length, for any number of elements. With θ = xℓκ,
//! y = |θ|/2:
//!
//! ```text
//! frame     quaternion (θ/2 · sin y / y, cos y),
//! chord     V e0 = e0 + c2 (θ × e0) + c3 (θ θ0 − e0 θ·θ), c1 = sin y cos y / y, c2 = ½ (sin y / y)², c3 = (1 − c1)/(4 y²),
//! ```
//!
//! as in `rod::segment`. As y vanishes it is bounded below by a value whose square is less than rounding; c3's error there is
//! multiplied by θ².

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::math::functions::trigonometry::sine_cosine;
use crate::math::lane::Lane;

/// How many strands go side by side.
pub const WIDTH: usize = 16;

/// One number per strand.
pub type Lanes<T> = [T; WIDTH];

/// The number type within an element: f32 or f64.
pub trait Real:
    Copy
    + Default
    + Send
    + Sync
    + Into<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Half angle below which a helix is straight to rounding.
    const SMALLEST: f64;
    /// The nearest number.
    fn near(value: f64) -> Self;
    /// Sines and cosines of angles that are not negative.
    fn sines_cosines(angles: &Lanes<f64>) -> (Lanes<Self>, Lanes<Self>);
}

impl Real for f64 {
    const SMALLEST: f64 = 1e-9;

    #[inline(always)]
    fn near(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn sines_cosines(angles: &Lanes<f64>) -> (Lanes<f64>, Lanes<f64>) {
        let (mut sines, mut cosines) = ([0.0; WIDTH], [0.0; WIDTH]);
        for lane in 0..WIDTH {
            (sines[lane], cosines[lane]) = sine_cosine(angles[lane]);
        }
        (sines, cosines)
    }
}

impl Real for f32 {
    const SMALLEST: f64 = 1e-4;

    #[inline(always)]
    fn near(value: f64) -> Self {
        value as f32
    }

    /// The angle is reduced to its quadrant in f64, so that an element of many turns loses nothing; the polynomials (cephes' sinf
    /// and cosf) are good to an ulp.
    #[inline(always)]
    fn sines_cosines(angles: &Lanes<f64>) -> (Lanes<f32>, Lanes<f32>) {
        let (mut rests, mut quarters) = ([0.0_f32; WIDTH], [0.0_f32; WIDTH]);
        for lane in 0..WIDTH {
            let quadrant = Lane::round(angles[lane] * std::f64::consts::FRAC_2_PI);
            rests[lane] = (angles[lane] - quadrant * std::f64::consts::FRAC_PI_2) as f32;
            // The quadrant modulo 4: its quarters are 0, ¼, ½ and ¾ above a whole number.
            quarters[lane] = (quadrant - 4.0 * Lane::round(quadrant * 0.25 - 0.375)) as f32;
        }
        let (mut sines, mut cosines) = ([0.0; WIDTH], [0.0; WIDTH]);
        for lane in 0..WIDTH {
            let (r, quarter) = (rests[lane], quarters[lane]);
            let z = r * r;
            let sine = r + r * z * (-1.666_665_5e-1 + z * (8.332_161e-3 - z * 1.951_529_6e-4));
            let cosine = (1.0 - 0.5 * z) + z * z * (4.166_664_6e-2 + z * (-1.388_731_6e-3 + z * 2.443_315_7e-5));
            let odd = quarter == 1.0 || quarter == 3.0;
            let (s, c) = if odd { (cosine, sine) } else { (sine, cosine) };
            sines[lane] = if quarter > 1.5 { -s } else { s };
            cosines[lane] = if (quarter - 1.5).abs() < 1.0 { -c } else { c };
        }
        (sines, cosines)
    }
}

/// The strands' current elements, and their left ends.
#[derive(Debug, Clone)]
pub struct Walk {
    /// From the root, world axes.
    origin: [Lanes<f64>; 3],
    /// Quaternion x, y, z, w of the left end's frame.
    rotation: [Lanes<f64>; 4],
    /// ℓ.
    length: Lanes<f64>,
    /// κℓ.
    turn: [Lanes<f64>; 3],
    /// Ωℓ/2.
    half_angle: Lanes<f64>,
}

/// An element, prepared for its points.
#[derive(Debug, Clone, Copy)]
pub struct Element<T> {
    origin: [Lanes<T>; 3],
    rotation: [Lanes<T>; 4],
    /// The frame as a matrix, `[row][column]`.
    frame: [[Lanes<T>; 3]; 3],
    length: Lanes<T>,
    turn: [Lanes<T>; 3],
    half_angle: Lanes<f64>,
}

/// A point in an element: its position from the left end, world axes, and the rotation from there, in the element's axes.
struct Local<T> {
    offset: [Lanes<T>; 3],
    rotation: [Lanes<T>; 4],
}

impl Walk {
    /// Starts at the roots: quaternions x, y, z, w of their frames, and the lengths of the strands' elements.
    #[inline(always)]
    pub fn new(rotation: [Lanes<f64>; 4], length: Lanes<f64>) -> Self {
        let zero = [0.0; WIDTH];
        Self { origin: [zero; 3], rotation, length, turn: [zero; 3], half_angle: zero }
    }

    /// Enters elements of curvatures κ.
    #[inline(always)]
    pub fn enter(&mut self, curvatures: &[Lanes<f64>; 3]) {
        let [k0, k1, k2] = curvatures;
        for lane in 0..WIDTH {
            let length = self.length[lane];
            let (t0, t1, t2) = (k0[lane] * length, k1[lane] * length, k2[lane] * length);
            (self.turn[0][lane], self.turn[1][lane], self.turn[2][lane]) = (t0, t1, t2);
            self.half_angle[lane] = 0.5 * (t0 * t0 + t1 * t1 + t2 * t2).sqrt();
        }
    }

    /// The current element.
    #[inline(always)]
    pub fn element<T: Real>(&self) -> Element<T> {
        let none = [T::default(); WIDTH];
        let mut frame = [[none; 3]; 3];
        for lane in 0..WIDTH {
            let (x, y, z, w) = (self.rotation[0][lane], self.rotation[1][lane], self.rotation[2][lane], self.rotation[3][lane]);
            let (x2, y2, z2) = (x + x, y + y, z + z);
            let (xx, yy, zz, xy, xz, yz) = (x * x2, y * y2, z * z2, x * y2, x * z2, y * z2);
            let (wx, wy, wz) = (w * x2, w * y2, w * z2);
            frame[0][0][lane] = T::near(1.0 - (yy + zz));
            frame[0][1][lane] = T::near(xy - wz);
            frame[0][2][lane] = T::near(xz + wy);
            frame[1][0][lane] = T::near(xy + wz);
            frame[1][1][lane] = T::near(1.0 - (xx + zz));
            frame[1][2][lane] = T::near(yz - wx);
            frame[2][0][lane] = T::near(xz - wy);
            frame[2][1][lane] = T::near(yz + wx);
            frame[2][2][lane] = T::near(1.0 - (xx + yy));
        }
        let [x, y, z] = &self.origin;
        let [qx, qy, qz, qw] = &self.rotation;
        let [t0, t1, t2] = &self.turn;
        Element {
            origin: [narrow(x), narrow(y), narrow(z)],
            rotation: [narrow(qx), narrow(qy), narrow(qz), narrow(qw)],
            frame,
            length: narrow(&self.length),
            turn: [narrow(t0), narrow(t1), narrow(t2)],
            half_angle: self.half_angle,
        }
    }

    /// Moves to the right ends of the current elements.
    #[inline(always)]
    pub fn leave(&mut self) {
        let element = self.element::<f64>();
        let Local { offset, rotation } = element.local(1.0);
        self.rotation = product(&self.rotation, &rotation);
        for axis in 0..3 {
            for lane in 0..WIDTH {
                self.origin[axis][lane] += offset[axis][lane];
            }
        }
    }
}

impl<T: Real> Element<T> {
    /// The points at `x` of the elements' lengths: `base` plus the offset from the root, rounded once.
    #[inline(always)]
    pub fn position(&self, x: f64, base: &[Lanes<f64>; 3]) -> [Lanes<T>; 3] {
        let Local { offset, .. } = self.local(x);
        self.place(&offset, base)
    }

    /// The same, and the quaternions of the frames there.
    #[inline(always)]
    pub fn pose(&self, x: f64, base: &[Lanes<f64>; 3]) -> ([Lanes<T>; 3], [Lanes<T>; 4]) {
        let Local { offset, rotation } = self.local(x);
        (self.place(&offset, base), product(&self.rotation, &rotation))
    }

    /// The quaternions x, y, z, w of the frames at `x` of the elements' lengths.
    #[inline(always)]
    pub fn rotation(&self, x: f64) -> [Lanes<T>; 4] {
        product(&self.rotation, &self.local(x).rotation)
    }

    #[inline(always)]
    fn place(&self, offset: &[Lanes<T>; 3], base: &[Lanes<f64>; 3]) -> [Lanes<T>; 3] {
        let mut out = [[T::default(); WIDTH]; 3];
        for axis in 0..3 {
            for lane in 0..WIDTH {
                out[axis][lane] = T::near(base[axis][lane] + (self.origin[axis][lane] + offset[axis][lane]).into());
            }
        }
        out
    }

    #[inline(always)]
    fn local(&self, x: f64) -> Local<T> {
        let mut halves = [0.0; WIDTH];
        let mut narrow_halves = [T::default(); WIDTH];
        for lane in 0..WIDTH {
            let half = x * self.half_angle[lane];
            halves[lane] = if half > T::SMALLEST { half } else { T::SMALLEST };
            narrow_halves[lane] = T::near(halves[lane]);
        }
        let (sines, cosines) = T::sines_cosines(&halves);
        let (one, half, quarter, fraction) = (T::near(1.0), T::near(0.5), T::near(0.25), T::near(x));
        let none = [T::default(); WIDTH];
        let (mut offset, mut rotation) = ([none; 3], [none; 4]);
        for lane in 0..WIDTH {
            let inverse = one / narrow_halves[lane];
            let ratio = sines[lane] * inverse;
            let c1 = ratio * cosines[lane];
            let c2 = half * ratio * ratio;
            let c3 = (one - c1) * (quarter * inverse * inverse);
            let (t0, t1, t2) = (fraction * self.turn[0][lane], fraction * self.turn[1][lane], fraction * self.turn[2][lane]);
            let s = fraction * self.length[lane];
            let along = s * (one - c3 * (t1 * t1 + t2 * t2));
            let beside = s * (c2 * t2 + c3 * t1 * t0);
            let above = s * (c3 * t2 * t0 - c2 * t1);
            for row in 0..3 {
                let [a, b, c] = &self.frame[row];
                offset[row][lane] = a[lane] * along + b[lane] * beside + c[lane] * above;
            }
            let scale = half * ratio;
            rotation[0][lane] = scale * t0;
            rotation[1][lane] = scale * t1;
            rotation[2][lane] = scale * t2;
            rotation[3][lane] = cosines[lane];
        }
        Local { offset, rotation }
    }
}

#[inline(always)]
fn narrow<T: Real>(wide: &Lanes<f64>) -> Lanes<T> {
    let mut out = [T::default(); WIDTH];
    for lane in 0..WIDTH {
        out[lane] = T::near(wide[lane]);
    }
    out
}

/// Quaternion products.
#[inline(always)]
fn product<T: Real>(a: &[Lanes<T>; 4], b: &[Lanes<T>; 4]) -> [Lanes<T>; 4] {
    let mut out = [[T::default(); WIDTH]; 4];
    for lane in 0..WIDTH {
        let [ax, ay, az, aw] = [a[0][lane], a[1][lane], a[2][lane], a[3][lane]];
        let [bx, by, bz, bw] = [b[0][lane], b[1][lane], b[2][lane], b[3][lane]];
        out[0][lane] = aw * bx + ax * bw + ay * bz - az * by;
        out[1][lane] = aw * by + ay * bw + az * bx - ax * bz;
        out[2][lane] = aw * bz + az * bw + ax * by - ay * bx;
        out[3][lane] = aw * bw - ax * bx - ay * by - az * bz;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vector::{Mat3, Vec3};
    use crate::rod::kinematics::{ElementState, element_state};
    use crate::rod::segment;

    /// Random numbers in [−1, 1).
    fn noise(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// The largest errors of points and frames against the kernels of one strand, relative to the strand's length and to one, for
    /// strands whose elements turn by up to `angle`.
    fn errors<T: Real>(elements: usize, angle: f64) -> (f64, f64) {
        let mut seed = 7 + elements as u64;
        let mut length = [0.0; WIDTH];
        length.iter_mut().for_each(|length| *length = (0.2 + 0.1 * noise(&mut seed)) / elements as f64);
        let roots: Vec<nalgebra::UnitQuaternion<f64>> = (0..WIDTH)
            .map(|_| nalgebra::UnitQuaternion::from_euler_angles(noise(&mut seed), noise(&mut seed), noise(&mut seed)))
            .collect();
        let mut rotation = [[0.0; WIDTH]; 4];
        let mut exact: Vec<(Mat3<f64>, Vec3<f64>)> = Vec::new();
        for (lane, root) in roots.iter().enumerate() {
            let q = root.quaternion();
            [rotation[0][lane], rotation[1][lane], rotation[2][lane], rotation[3][lane]] = [q.i, q.j, q.k, q.w];
            exact.push((Mat3::from(root.to_rotation_matrix().into_inner()), Vec3::zero()));
        }
        let mut walk = Walk::new(rotation, length);
        let (mut farthest, mut most_turned) = (0.0_f64, 0.0_f64);
        for _ in 0..elements {
            let mut curvatures = [[0.0; WIDTH]; 3];
            for lane in 0..WIDTH {
                // Every fourth strand is straight or nearly so.
                let size = [1.0, 1.0, 1e-7, 0.0][lane % 4] * angle / length[lane] / 3.0_f64.sqrt();
                (0..3).for_each(|axis| curvatures[axis][lane] = size * noise(&mut seed));
            }
            walk.enter(&curvatures);
            let element = walk.element::<T>();
            for x in [0.0, 0.1, 0.37, 0.99, 1.0] {
                let (positions, quaternions) = element.pose(x, &[[0.0; WIDTH]; 3]);
                for lane in 0..WIDTH {
                    let whole = length[lane] * elements as f64;
                    let state: ElementState<f64> = element_state(
                        Vec3([0, 1, 2].map(|axis| curvatures[axis][lane])),
                        length[lane],
                        exact[lane].0,
                        exact[lane].1,
                    );
                    let point = state.point(x * length[lane]);
                    let theta = state.kappa.scale(point.s);
                    let frame = state.frame_left.mul(&segment::frame(theta, theta.norm_squared(), &point.c));
                    let q = [0, 1, 2, 3].map(|k| quaternions[k][lane].into());
                    let turned = nalgebra::UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(q[3], q[0], q[1], q[2]));
                    let turned = Mat3::from(turned.to_rotation_matrix().into_inner());
                    for axis in 0..3 {
                        let off: f64 = positions[axis][lane].into() - point.position.0[axis];
                        farthest = farthest.max(off.abs() / whole);
                        for column in 0..3 {
                            most_turned = most_turned.max((turned.0[axis][column] - frame.0[axis][column]).abs());
                        }
                    }
                }
            }
            for lane in 0..WIDTH {
                let curvature = Vec3([0, 1, 2].map(|axis| curvatures[axis][lane]));
                let state = element_state(curvature, length[lane], exact[lane].0, exact[lane].1);
                exact[lane] = (state.frame_right(), state.origin_right());
            }
            walk.leave();
        }
        (farthest, most_turned)
    }

    #[test]
    fn points_are_where_the_kernels_of_one_strand_have_them() {
        for (elements, angle) in [(1, 1.0), (5, 1.5), (50, 1.5), (500, 1.0), (5, 30.0), (3, 3000.0)] {
            let (position, frame) = errors::<f32>(elements, angle);
            println!("{elements} elements of {angle} rad: f32 {position:.1e} L, frames {frame:.1e}");
            assert!(position < 3e-7 && frame < 1e-6, "{elements} {angle}: {position:e} {frame:e}");
            let (position, frame) = errors::<f64>(elements, angle);
            println!("    f64 {position:.1e} L, frames {frame:.1e}");
            let rounding = 1e-15 * (10.0 + elements as f64 * angle);
            assert!(position < rounding && frame < rounding, "{elements} {angle}: {position:e} {frame:e}");
        }
    }

    #[test]
    fn sines_of_single_numbers_are_good_to_their_last_digits() {
        let mut worst = 0.0_f64;
        for start in 0..50_000 {
            let angles: Lanes<f64> = std::array::from_fn(|lane| 1e-3 * f64::from(start) + 0.37 * lane as f64);
            let (sines, cosines) = f32::sines_cosines(&angles);
            for lane in 0..WIDTH {
                let off = (f64::from(sines[lane]) - angles[lane].sin()).abs();
                worst = worst.max(off).max((f64::from(cosines[lane]) - angles[lane].cos()).abs());
            }
        }
        assert!(worst < 1e-7, "{worst:e}");
    }
}
