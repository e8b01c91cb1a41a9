//! 3-vectors and 3×3 matrices over lanes, for the kernels. The public interface uses nalgebra.

use std::ops::{Add, AddAssign, Neg, Sub, SubAssign};

use nalgebra::{Matrix3, Vector3};

use super::lane::Lane;

/// A vector from a function of the row. Written out: a closure passed to the standard library would not be compiled for the
/// vector instructions of its surroundings.
macro_rules! vector {
    (|$i:ident| $value:expr) => {
        $crate::math::vector::vector!(@ |$i| $value; 0, 1, 2)
    };
    (@ |$i:ident| $value:expr; $($row:literal),*) => {
        $crate::math::vector::Vec3([$({
            let $i: usize = $row;
            $value
        }),*])
    };
}

/// A matrix from a function of row and column, written out as well.
macro_rules! matrix {
    (|$i:ident, $j:ident| $value:expr) => {
        $crate::math::vector::Mat3([
            $crate::math::vector::matrix!(@ |$i, $j| $value; 0),
            $crate::math::vector::matrix!(@ |$i, $j| $value; 1),
            $crate::math::vector::matrix!(@ |$i, $j| $value; 2),
        ])
    };
    (@ |$i:ident, $j:ident| $value:expr; $row:literal) => {{
        let $i: usize = $row;
        $crate::math::vector::vector!(|$j| $value).0
    }};
}
pub(crate) use {matrix, vector};

/// A 3-vector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vec3<T>(pub [T; 3]);

/// A 3×3 matrix, `0[row][column]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mat3<T>(pub [[T; 3]; 3]);

impl<T: Lane> Vec3<T> {
    /// From its three numbers.
    #[inline(always)]
    pub fn new(x: T, y: T, z: T) -> Self {
        Self([x, y, z])
    }
    /// The zero vector.
    #[inline(always)]
    pub fn zero() -> Self {
        Self([T::zero(); 3])
    }
    /// The same vector in all lanes.
    #[inline(always)]
    pub fn splat(vector: Vec3<f64>) -> Self {
        Self([T::splat(vector.0[0]), T::splat(vector.0[1]), T::splat(vector.0[2])])
    }
    /// One lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Vec3<f64> {
        Vec3([self.0[0].lane(lane), self.0[1].lane(lane), self.0[2].lane(lane)])
    }
    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> T {
        self.0[0] * other.0[0] + self.0[1] * other.0[1] + self.0[2] * other.0[2]
    }
    /// Cross product.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        let (a, b) = (self.0, other.0);
        Self([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
    }
    /// Product with a number.
    #[inline(always)]
    pub fn scale(self, factor: T) -> Self {
        Self([self.0[0] * factor, self.0[1] * factor, self.0[2] * factor])
    }
    /// Squared length.
    #[inline(always)]
    pub fn norm_squared(self) -> T {
        self.dot(self)
    }
}

impl<T: Lane> Add for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self([self.0[0] + other.0[0], self.0[1] + other.0[1], self.0[2] + other.0[2]])
    }
}

impl<T: Lane> Sub for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self([self.0[0] - other.0[0], self.0[1] - other.0[1], self.0[2] - other.0[2]])
    }
}

impl<T: Lane> Neg for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self([-self.0[0], -self.0[1], -self.0[2]])
    }
}

impl<T: Lane> AddAssign for Vec3<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Lane> SubAssign for Vec3<T> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<T: Lane> Mat3<T> {
    /// The zero matrix.
    #[inline(always)]
    pub fn zero() -> Self {
        Self([[T::zero(); 3]; 3])
    }
    /// The unit matrix.
    #[inline(always)]
    pub fn identity() -> Self {
        let mut out = Self::zero();
        for i in 0..3 {
            out.0[i][i] = T::one();
        }
        out
    }
    /// `[a]×`, the matrix of the cross product from the left.
    #[inline(always)]
    pub fn cross(a: Vec3<T>) -> Self {
        let [x, y, z] = a.0;
        let o = T::zero();
        Self([[o, -z, y], [z, o, -x], [-y, x, o]])
    }
    /// Product with a vector.
    #[inline(always)]
    pub fn apply(&self, v: Vec3<T>) -> Vec3<T> {
        let m = &self.0;
        vector!(|i| m[i][0] * v.0[0] + m[i][1] * v.0[1] + m[i][2] * v.0[2])
    }
    /// Product of the transpose with a vector.
    #[inline(always)]
    pub fn apply_transposed(&self, v: Vec3<T>) -> Vec3<T> {
        let m = &self.0;
        vector!(|i| m[0][i] * v.0[0] + m[1][i] * v.0[1] + m[2][i] * v.0[2])
    }
    /// Matrix product.
    #[inline(always)]
    pub fn mul(&self, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        matrix!(|i, j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j])
    }
    /// Product of the transpose with another matrix.
    #[inline(always)]
    pub fn transposed_mul(&self, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        matrix!(|i, j| a[0][i] * b[0][j] + a[1][i] * b[1][j] + a[2][i] * b[2][j])
    }
    /// Product with the transpose of another matrix.
    #[inline(always)]
    pub fn mul_transposed(&self, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        matrix!(|i, j| a[i][0] * b[j][0] + a[i][1] * b[j][1] + a[i][2] * b[j][2])
    }
    /// Transpose.
    #[inline(always)]
    pub fn transpose(&self) -> Self {
        matrix!(|i, j| self.0[j][i])
    }
    /// Sum.
    #[inline(always)]
    pub fn add(&self, other: &Self) -> Self {
        matrix!(|i, j| self.0[i][j] + other.0[i][j])
    }
    /// Difference.
    #[inline(always)]
    pub fn sub(&self, other: &Self) -> Self {
        matrix!(|i, j| self.0[i][j] - other.0[i][j])
    }
    /// Product with a number.
    #[inline(always)]
    pub fn scale(&self, factor: T) -> Self {
        matrix!(|i, j| self.0[i][j] * factor)
    }
    /// `[a]×` times this matrix.
    #[inline(always)]
    pub fn crossed_from_left(&self, a: Vec3<T>) -> Self {
        let ([x, y, z], m) = (a.0, &self.0);
        let mut out = Self::zero();
        for j in 0..3 {
            out.0[0][j] = y * m[2][j] - z * m[1][j];
            out.0[1][j] = z * m[0][j] - x * m[2][j];
            out.0[2][j] = x * m[1][j] - y * m[0][j];
        }
        out
    }
    /// A column.
    #[inline(always)]
    pub fn column(&self, j: usize) -> Vec3<T> {
        Vec3([self.0[0][j], self.0[1][j], self.0[2][j]])
    }
}

impl From<Vector3<f64>> for Vec3<f64> {
    fn from(v: Vector3<f64>) -> Self {
        Self([v.x, v.y, v.z])
    }
}

impl From<Vec3<f64>> for Vector3<f64> {
    fn from(v: Vec3<f64>) -> Self {
        Vector3::from(v.0)
    }
}

impl From<Matrix3<f64>> for Mat3<f64> {
    fn from(m: Matrix3<f64>) -> Self {
        matrix!(|i, j| m[(i, j)])
    }
}

impl From<Mat3<f64>> for Matrix3<f64> {
    fn from(m: Mat3<f64>) -> Self {
        Matrix3::from_fn(|i, j| m.0[i][j])
    }
}
