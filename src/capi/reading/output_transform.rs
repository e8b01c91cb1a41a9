//! Output transforms from the engine's space to the host's: other units, other axes, mirrored.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use crate::error::{Error, Result, check_finite};

/// How far axes may be from orthogonal and of equal lengths, relative: wide enough for a matrix that was
/// stored as floats.
const TOLERANCE: f64 = 1e-5;

/// A rotation, possibly after a reflection, with one scale, and a translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OutputTransform {
    linear: Matrix3<f64>,
    translation: Vector3<f64>,
    scale: f64,
    /// The rotation; if it mirrors, the one after a reflection along z.
    rotation: UnitQuaternion<f64>,
    mirrors: bool,
}

impl OutputTransform {
    /// From the images of the world's axes and origin. `None` for the identity.
    pub(crate) fn new(argument: &str, axes: [[f64; 3]; 3], translation: [f64; 3]) -> Result<Option<Self>> {
        const NAMES: [&str; 3] = ["x_axis", "y_axis", "z_axis"];
        for (axis, name) in axes.iter().zip(NAMES) {
            for k in 0..3 {
                check_finite(|| format!("{argument}.{name}[{k}]"), axis[k])?;
            }
        }
        for k in 0..3 {
            check_finite(|| format!("{argument}.translation[{k}]"), translation[k])?;
        }
        let (axes, translation) = (axes.map(Vector3::from), Vector3::from(translation));
        let scale = axes[0].norm();
        if !(scale.is_normal() && (1e-100..=1e100).contains(&scale)) {
            return Err(Error::invalid(
                format!("{argument}.x_axis"),
                format!("{:?}", axes[0].as_slice()),
                "a length of 1e-100 to 1e100",
            ));
        }
        for (k, name) in NAMES.into_iter().enumerate().skip(1) {
            let shown = || format!("{:?}", axes[k].as_slice());
            if (axes[k].norm() / scale - 1.0).abs() > TOLERANCE {
                return Err(Error::invalid(format!("{argument}.{name}"), shown(), format!("the length of x_axis, {scale}")));
            }
            if axes[..k].iter().any(|other| (axes[k] / scale).dot(&(other / scale)).abs() > TOLERANCE) {
                return Err(Error::invalid(format!("{argument}.{name}"), shown(), "an axis at right angles to those before"));
            }
        }
        let linear = Matrix3::from_columns(&axes);
        if linear == Matrix3::identity() && translation == Vector3::zeros() {
            return Ok(None);
        }
        let mirrors = (linear / scale).determinant() < 0.0;
        let mut proper = linear / scale;
        if mirrors {
            proper.column_mut(2).neg_mut();
        }
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(proper));
        Ok(Some(Self { linear, translation, scale, rotation, mirrors }))
    }

    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    #[inline(always)]
    pub(crate) fn point(&self, point: [f64; 3]) -> [f64; 3] {
        (self.linear * Vector3::from(point) + self.translation).into()
    }

    #[inline(always)]
    pub(crate) fn vector(&self, vector: [f64; 3]) -> [f64; 3] {
        (self.linear * Vector3::from(vector)).into()
    }

    /// A rotation x, y, z, w. Mirrored, it is that of the first two axes, and the third is reversed: quaternions
    /// are rotations.
    #[inline(always)]
    pub(crate) fn quaternion(&self, [x, y, z, w]: [f64; 4]) -> [f64; 4] {
        let own = if self.mirrors { Quaternion::new(w, -x, -y, z) } else { Quaternion::new(w, x, y, z) };
        let turned = self.rotation.into_inner() * own;
        [turned.i, turned.j, turned.k, turned.w]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axes(rotation: UnitQuaternion<f64>, scale: f64, mirrored: bool) -> [[f64; 3]; 3] {
        let turned = |axis: Vector3<f64>| (rotation * axis * scale).into();
        [turned(Vector3::x()), turned(Vector3::y()), turned(if mirrored { -Vector3::z() } else { Vector3::z() })]
    }

    /// Frames against their axes, mapped one by one.
    #[test]
    fn frames_keep_tangent_and_first_normal() {
        let frame = UnitQuaternion::from_euler_angles(0.3, -1.1, 2.0);
        for mirrored in [false, true] {
            let turn = UnitQuaternion::from_euler_angles(-0.7, 0.4, 1.5);
            let transform =
                OutputTransform::new("def", axes(turn, 100.0, mirrored), [1.0, 2.0, 3.0]).expect("legal").expect("one");
            assert!((transform.scale() - 100.0).abs() < 1e-12);
            let [i, j, k, w] = transform.quaternion([frame.i, frame.j, frame.k, frame.w]);
            let mapped = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
            let side = if mirrored { -1.0 } else { 1.0 };
            for (axis, sign) in [(Vector3::x(), 1.0), (Vector3::y(), 1.0), (Vector3::z(), side)] {
                let expected = Vector3::from(transform.vector((frame * axis).into())) / 100.0;
                assert!((mapped * axis * sign - expected).norm() < 1e-12, "{axis} {mirrored}");
            }
        }
    }

    #[test]
    fn matrices_other_than_rotations_and_mirrors_are_refused_by_name() {
        let one = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!(OutputTransform::new("def", one, [0.0; 3]), Ok(None));
        let refused = |axes: [[f64; 3]; 3], name: &str| {
            let error = OutputTransform::new("def", axes, [0.0; 3]).expect_err(name);
            assert!(error.to_string().contains(name), "{error}");
        };
        refused([[0.0; 3], one[1], one[2]], "def.x_axis");
        refused([one[0], [0.0, 2.0, 0.0], one[2]], "def.y_axis");
        refused([one[0], one[1], [0.0, 0.6, 0.8]], "def.z_axis");
        refused([one[0], one[1], [0.0, f64::NAN, 1.0]], "def.z_axis[1]");
        assert!(OutputTransform::new("def", one, [0.0, f64::INFINITY, 0.0]).is_err());
        // A matrix that went through floats.
        let turn = UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3);
        let single = axes(turn, 0.01, true).map(|axis| axis.map(|x| f64::from(x as f32)));
        assert!(OutputTransform::new("def", single, [0.0; 3]).is_ok());
    }
}
