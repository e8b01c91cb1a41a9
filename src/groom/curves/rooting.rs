//! Puts the roots of curves on a scalp: the first stretch of a curve bends after its root, the remainder stays where it is.

use nalgebra::Vector3;

use super::usable::length_of;
use crate::contact::shape::Mesh;
use crate::error::{Result, check_positive};

/// The stretch that bends is so many times as long as the root moves, and no shorter than this, m.
const BENT: f64 = 8.0;
const LEAST_BENT: f64 = 0.02;
/// A curve that is shorter than this many times the root's way moves as a whole.
const WHOLE: f64 = 4.0;

/// What became of a root.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rooted {
    /// It was moved so far, m.
    Moved(f64),
    /// It is farther from the scalp than permitted, so far, m, and stays where it is; infinite: farther than a tenth of a metre beyond that.
    TooFar(f64),
}

/// How much farther than permitted roots are looked for, m: to say how far they are.
const FARTHER: f64 = 0.1;

/// Moves the root of a curve (m, root first, in the mesh's axes) to the nearest place of a scalp, if that is no farther than `reach`
/// (m). The displacement fades to nothing along eight times its length, 2 cm at least; a curve shorter than four times the
/// displacement moves as a whole. Lengths of edges in that stretch change by up to a quarter.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a reach that is not above zero.
pub fn root_on(points: &mut [Vector3<f64>], scalp: &Mesh, reach: f64) -> Result<Rooted> {
    check_positive(|| "reach".into(), reach)?;
    let Some(root) = points.first().copied() else { return Ok(Rooted::TooFar(f64::INFINITY)) };
    let Some(surface) = scalp.closest(root, reach + FARTHER) else { return Ok(Rooted::TooFar(f64::INFINITY)) };
    let way = surface.point - root;
    let far = way.norm();
    if far > reach {
        return Ok(Rooted::TooFar(far));
    }
    let length = length_of(points);
    if length < WHOLE * far {
        points.iter_mut().for_each(|point| *point += way);
        return Ok(Rooted::Moved(far));
    }
    let bent = (BENT * far).max(LEAST_BENT).min(length);
    let (mut along, mut before) = (0.0, root);
    for point in points.iter_mut() {
        along += (*point - before).norm();
        before = *point;
        if along >= bent {
            break;
        }
        *point += way * (1.0 - along / bent).powi(2);
    }
    points[0] = surface.point;
    Ok(Rooted::Moved(far))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::shape::Sides;

    #[test]
    fn roots_come_to_the_scalp_and_tips_stay() {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| Vector3::new(x, y, 0.0));
        let scalp = Mesh::new(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]], Sides::Both).expect("a mesh");
        let drawn: Vec<Vector3<f64>> =
            (0..50).map(|k| Vector3::new(0.0, 0.001 * f64::from(k), 0.005 + 0.002 * f64::from(k))).collect();
        for side in [1.0, -1.0] {
            let mut points: Vec<_> = drawn.iter().map(|p| Vector3::new(p.x, p.y, side * p.z)).collect();
            let before = points.clone();
            let Rooted::Moved(moved) = root_on(&mut points, &scalp, 0.01).expect("a reach") else { panic!() };
            assert!((moved - 0.005).abs() < 1e-12 && points[0].z.abs() < 1e-12);
            assert_eq!(points[49], before[49]);
            let edges = |points: &[Vector3<f64>]| -> Vec<f64> { points.windows(2).map(|e| (e[1] - e[0]).norm()).collect() };
            for (now, then) in edges(&points).iter().zip(edges(&before)) {
                assert!((now / then - 1.0).abs() < 0.26, "{now} {then}");
            }
        }
        let mut points = drawn.clone();
        assert_eq!(root_on(&mut points, &scalp, 0.004).expect("a reach"), Rooted::TooFar(0.005));
        assert_eq!(points, drawn);
        // Shorter than it moves: as a whole.
        let mut points = drawn[..3].to_vec();
        root_on(&mut points, &scalp, 0.01).expect("a reach");
        assert!((points[2] - points[0] - (drawn[2] - drawn[0])).norm() < 1e-15);
        assert!(root_on(&mut points, &scalp, 0.0).is_err());
    }
}
