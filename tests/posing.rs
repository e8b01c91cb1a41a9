//! Strands posed by hand, as shapes: drags against geometry, cuts and mirrors to rounding. Living strands are in `posing_living.rs`.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::contact::body::BodyAt;
use superhelix::contact::shape::Shape;
use superhelix::error::Error;
use superhelix::groom::pose::{
    Brush, DragTarget, ElementChange, Growth, Plane, PoseOptions, PoseScratch, StrandShape, Surroundings,
};
use superhelix::math::frame::Frame;
use superhelix::rod::freedoms::Freedoms;

/// Random numbers in [−1, 1).
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::new(self.next(), self.next(), self.next())
    }

    /// A curl of unequal elements whose root is anywhere.
    fn strand(&mut self, elements: usize, turn: f64) -> StrandShape {
        let element_lengths: Vec<f64> = (0..elements).map(|_| 0.25 / elements as f64 * (1.0 + 0.4 * self.next())).collect();
        let common = self.vector();
        let curvatures =
            element_lengths.iter().map(|length| (0.7 * common + 0.3 * self.vector()) * (turn / length)).map(Into::into).collect();
        let rotation = UnitQuaternion::from_euler_angles(3.0 * self.next(), 1.5 * self.next(), 3.0 * self.next());
        StrandShape { root: Frame { origin: 0.3 * self.vector(), rotation }, element_lengths, curvatures }
    }
}

fn straight(length: f64, elements: usize) -> StrandShape {
    StrandShape {
        root: Frame::default(),
        element_lengths: vec![length / elements as f64; elements],
        curvatures: vec![[0.0; 3]; elements],
    }
}

fn drag(
    shape: &mut StrandShape,
    arclength: f64,
    position: Vector3<f64>,
    options: &PoseOptions,
) -> superhelix::groom::pose::Dragged {
    let target = DragTarget { arclength, position };
    shape.drag(&target, options, &Surroundings::default(), &mut PoseScratch::default()).unwrap()
}

/// Targets that are reachable, for they are where another shape of the same strand has the point.
#[test]
fn reachable_targets_are_reached() {
    let mut noise = Noise(1);
    let (mut worst, mut iterations, mut count) = (0.0_f64, 0, 0);
    for elements in [2, 3, 5, 10, 20] {
        for turn in [0.0, 0.1, 0.5] {
            for share in [1.0, 0.7] {
                for _ in 0..6 {
                    let mut shape = noise.strand(elements, turn);
                    let mut other = shape.clone();
                    for (row, length) in other.curvatures.iter_mut().zip(&shape.element_lengths) {
                        for value in row {
                            *value += 0.5 / length * noise.next();
                        }
                    }
                    let arclength = share * shape.length();
                    let target = other.frame_at(arclength).origin;
                    let (before, length) = (shape.clone(), shape.length());
                    let found = drag(&mut shape, arclength, target, &PoseOptions::default());
                    let off = (shape.frame_at(arclength).origin - target).norm();
                    println!(
                        "{elements} {turn} {share}: {off:.1e} {} from {:.2}",
                        found.iterations,
                        (before.frame_at(arclength).origin - target).norm() / length
                    );
                    assert!((off - found.distance).abs() < 1e-12);
                    worst = worst.max(off);
                    iterations += found.iterations;
                    count += 1;
                    assert_eq!((shape.root, &shape.element_lengths), (before.root, &before.element_lengths));
                }
            }
        }
    }
    println!("worst {worst:.1e} m, {} iterations a drag", iterations / count);
    assert!(worst < 1e-6, "{worst:e}");
}
