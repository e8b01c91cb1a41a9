//! Views: which axes run right, up and towards the viewer.

use nalgebra::{Matrix3, Vector3};

use crate::shell::failure::Failure;
use crate::shell::up::Up;

/// The axis that a face looks along. Files do not say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Face {
    /// Along x.
    #[value(name = "+x")]
    PlusX,
    /// Against x.
    #[value(name = "-x")]
    MinusX,
    /// Along y.
    #[value(name = "+y")]
    PlusY,
    /// Against y.
    #[value(name = "-y")]
    MinusY,
    /// Along z.
    #[value(name = "+z")]
    PlusZ,
    /// Against z.
    #[value(name = "-z")]
    MinusZ,
}

impl Face {
    /// Along an axis (0 to 2), or against it.
    pub fn along(axis: usize, ahead: bool) -> Self {
        match (axis, ahead) {
            (0, true) => Face::PlusX,
            (0, false) => Face::MinusX,
            (1, true) => Face::PlusY,
            (1, false) => Face::MinusY,
            (_, true) => Face::PlusZ,
            (_, false) => Face::MinusZ,
        }
    }

    fn vector(self) -> Vector3<f32> {
        match self {
            Face::PlusX => Vector3::x(),
            Face::MinusX => -Vector3::x(),
            Face::PlusY => Vector3::y(),
            Face::MinusY => -Vector3::y(),
            Face::PlusZ => Vector3::z(),
            Face::MinusZ => -Vector3::z(),
        }
    }
}

/// Where the viewer stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Stand {
    /// Before the face.
    Front,
    /// Beside it: the face then looks to the left.
    Side,
    /// Between the two: the face looks past the viewer's left.
    ThreeQuarter,
    /// Behind the head.
    Back,
}

impl Stand {
    /// How far the viewer went round the head from the front, rad, and the label.
    fn turn(self) -> (f32, &'static str) {
        match self {
            Stand::Front => (0.0, "Front"),
            Stand::Side => (std::f32::consts::FRAC_PI_2, "Side"),
            Stand::ThreeQuarter => (0.65, "Three-quarter"),
            Stand::Back => (std::f32::consts::PI, "Back"),
        }
    }
}

/// A way to look at the strands, without perspective.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Label.
    pub name: &'static str,
    /// Right, up and towards the viewer, as rows.
    axes: Matrix3<f32>,
}

impl View {
    /// From where the viewer stands. Without a `face` it looks along +z where y is up and along -y where z is up: the same head in the two
    /// conventions.
    ///
    /// # Errors
    /// When the face looks up or down.
    pub fn new(stand: Stand, up: Up, face: Option<Face>) -> Result<Self, Failure> {
        let face = face.unwrap_or(match up {
            Up::Y => Face::PlusZ,
            Up::Z => Face::MinusY,
        });
        let mut vertical = Vector3::zeros();
        vertical[up.axis()] = 1.0;
        let ahead = face.vector();
        let beside = vertical.cross(&ahead);
        if beside == Vector3::zeros() {
            return Err(Failure::Other(format!("--face is the axis that --up says is {up:?}; expected a level one")));
        }
        let (turn, name) = stand.turn();
        // Quarter turns are exact.
        let exact = |value: f32| if value.abs() < 1e-6 { 0.0 } else { value };
        let (sin, cos) = (exact(turn.sin()), exact(turn.cos()));
        let (right, towards) = (beside * cos - ahead * sin, ahead * cos + beside * sin);
        Ok(Self { name, axes: Matrix3::from_columns(&[right, vertical, towards]).transpose() })
    }

    /// A point (or direction) as right, up, towards the viewer.
    pub fn look(&self, point: [f32; 3]) -> [f32; 3] {
        (self.axes * Vector3::from(point)).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_are_right_handed_and_turn_with_the_up_axis() {
        let pair = |up, face| [Stand::Front, Stand::Side].map(|stand| View::new(stand, up, face).unwrap());
        for (up, face) in [(Up::Y, None), (Up::Z, None), (Up::Y, Some(Face::MinusZ)), (Up::Z, Some(Face::PlusX))] {
            for stand in [Stand::Front, Stand::Side, Stand::ThreeQuarter, Stand::Back] {
                let view = View::new(stand, up, face).unwrap();
                assert!((view.axes.determinant() - 1.0).abs() < 1e-6, "{view:?} mirrors");
                let mut vertical = [0.0; 3];
                vertical[up.axis()] = 1.0;
                assert_eq!(view.look(vertical), [0.0, 1.0, 0.0]);
            }
        }
        // The same thing in the two conventions: (x, y, z) with y up is (x, -z, y) with z up.
        let (y_up, z_up) = (pair(Up::Y, None), pair(Up::Z, None));
        for (one, other) in y_up.iter().zip(&z_up) {
            assert_eq!(one.look([1.0, 2.0, 3.0]), other.look([1.0, -3.0, 2.0]));
        }
        assert_eq!(y_up[0].look([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
        assert_eq!(y_up[1].look([1.0, 2.0, 3.0]), [-3.0, 2.0, 1.0]);
        assert_eq!(View::new(Stand::Back, Up::Y, None).unwrap().look([1.0, 2.0, 3.0]), [-1.0, 2.0, -3.0]);
        // From between front and side the nose (ahead) is seen to the left of the middle, and towards the viewer.
        let [right, _, towards] = View::new(Stand::ThreeQuarter, Up::Y, None).unwrap().look([0.0, 0.0, 1.0]);
        assert!(right < -0.3 && towards > 0.3);
        assert!(View::new(Stand::Front, Up::Y, Some(Face::MinusY)).is_err());
    }
}
