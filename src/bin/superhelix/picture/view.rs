//! The two views of a sheet: which axes run right, up and towards the viewer.

/// Which axis of the world points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Up {
    /// y up, as most grooms and all motion capture have it.
    Y,
    /// z up.
    Z,
}

impl Up {
    /// Index of the axis that points up.
    pub fn axis(self) -> usize {
        match self {
            Up::Y => 1,
            Up::Z => 2,
        }
    }

    /// Gravity, m/s².
    pub fn gravity(self) -> nalgebra::Vector3<f64> {
        let mut gravity = nalgebra::Vector3::zeros();
        gravity[self.axis()] = -9.81;
        gravity
    }
}

/// A way to look at the strands, without perspective.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Label.
    pub name: &'static str,
    axes: [(usize, f32); 3],
}

impl View {
    /// From the front: a y-up head looks along +z, a z-up head along -y.
    pub fn front(up: Up) -> Self {
        let axes = match up {
            Up::Y => [(0, 1.0), (1, 1.0), (2, 1.0)],
            Up::Z => [(0, 1.0), (2, 1.0), (1, -1.0)],
        };
        Self { name: "Front", axes }
    }

    /// From the side: the face looks to the left.
    pub fn side(up: Up) -> Self {
        let axes = match up {
            Up::Y => [(2, -1.0), (1, 1.0), (0, 1.0)],
            Up::Z => [(1, 1.0), (2, 1.0), (0, 1.0)],
        };
        Self { name: "Side", axes }
    }

    /// A point (or direction) as right, up, towards the viewer.
    pub fn look(&self, point: [f32; 3]) -> [f32; 3] {
        self.axes.map(|(axis, sign)| sign * point[axis])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_are_right_handed_and_turn_with_the_up_axis() {
        for up in [Up::Y, Up::Z] {
            for view in [View::front(up), View::side(up)] {
                let rows: Vec<_> = (0..3)
                    .map(|axis| {
                        let mut unit = [0.0; 3];
                        unit[axis] = 1.0;
                        nalgebra::Vector3::from(view.look(unit))
                    })
                    .collect();
                assert_eq!(nalgebra::Matrix3::from_columns(&rows).determinant(), 1.0, "{view:?} mirrors");
                let mut up_vector = [0.0; 3];
                up_vector[up.axis()] = 1.0;
                assert_eq!(view.look(up_vector), [0.0, 1.0, 0.0]);
            }
        }
        // The same thing in the two conventions: (x, y, z) with y up is (x, -z, y) with z up.
        let (x, y, z) = (1.0, 2.0, 3.0);
        assert_eq!(View::front(Up::Y).look([x, y, z]), View::front(Up::Z).look([x, -z, y]));
        assert_eq!(View::side(Up::Y).look([x, y, z]), View::side(Up::Z).look([x, -z, y]));
    }
}
