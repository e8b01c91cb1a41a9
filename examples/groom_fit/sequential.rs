//! Fits element by element from the root: each is the helix closest to its stretch of the curve, starting at the end and with the
//! frame of the one before.

use nalgebra::{UnitQuaternion, Vector3};
use superhelix::hair::{ElementLengths, FitCurve, FitOptions, FitRoot, FitScratch, fit_curve};

use crate::methods::Errors;

/// A helix's frame and end after `length`, from a frame and an origin.
pub fn along(
    rotation: UnitQuaternion<f64>,
    origin: Vector3<f64>,
    kappa: Vector3<f64>,
    length: f64,
) -> (UnitQuaternion<f64>, Vector3<f64>) {
    // r = r0 + R ∫ exp(s[κ]×) e0 ds, in closed form about the axis of κ.
    let omega = kappa.norm();
    let chord = if omega * length < 1e-9 {
        Vector3::x() * length
    } else {
        let axis = kappa / omega;
        let e0 = Vector3::x();
        let along = axis * axis.dot(&e0);
        let (across, turned) = (e0 - along, axis.cross(&e0));
        let (sine, cosine) = (omega * length).sin_cos();
        along * length + across * (sine / omega) + turned * ((1.0 - cosine) / omega)
    };
    (rotation * UnitQuaternion::from_scaled_axis(kappa * length), origin + rotation * chord)
}

/// Points of a polyline between two arclengths, ends included, and the arclengths.
pub fn stretch(points: &[Vector3<f64>], arclengths: &[f64], from: f64, to: f64) -> (Vec<Vector3<f64>>, Vec<f64>) {
    let place = |s: f64| {
        let next = arclengths.partition_point(|own| *own < s).clamp(1, points.len() - 1);
        let share = (s - arclengths[next - 1]) / (arclengths[next] - arclengths[next - 1]).max(f64::MIN_POSITIVE);
        points[next - 1] + (points[next] - points[next - 1]) * share.clamp(0.0, 1.0)
    };
    let (mut kept, mut at) = (vec![place(from)], vec![from]);
    for (point, s) in points.iter().zip(arclengths) {
        if *s > from + 1e-9 && *s < to - 1e-9 {
            kept.push(*point);
            at.push(*s);
        }
    }
    kept.push(place(to));
    at.push(to);
    (kept, at)
}

/// Arclengths of a polyline's points.
pub fn arclengths(points: &[Vector3<f64>]) -> Vec<f64> {
    let mut all = vec![0.0];
    for pair in points.windows(2) {
        all.push(all[all.len() - 1] + (pair[1] - pair[0]).norm());
    }
    all
}

/// Fits, and measures at the points.
pub fn fit(points: &[Vector3<f64>], elements: usize) -> Option<Errors> {
    let all = arclengths(points);
    let length = all[all.len() - 1] / elements as f64;
    let options = FitOptions { lengths: ElementLengths::Equal, ..FitOptions::elements(1) };
    let mut scratch = FitScratch::default();
    let mut frame: Option<(UnitQuaternion<f64>, Vector3<f64>)> = None;
    let mut distances = Vec::with_capacity(points.len());
    let mut next = 0;
    for element in 0..elements {
        let (from, to) = (length * element as f64, length * (element + 1) as f64);
        let (mut part, at) = stretch(points, &all, from, to);
        let own: Vec<f64> = at.iter().map(|s| s - from).collect();
        let mut root = FitRoot::Curve;
        if let Some((rotation, origin)) = frame {
            // From the end of the last one, with its frame.
            part[0] = origin;
            root = FitRoot::Frame(rotation);
        }
        let curve = FitCurve { arclengths: Some(&own), root, ..FitCurve::polyline(&part) };
        let fit = fit_curve(&curve, &options, &mut scratch).ok()?;
        let (rotation, origin, kappa) = (fit.root.rotation, fit.root.origin, Vector3::from(fit.curvatures[0]));
        while next < points.len() && (all[next] <= to || element + 1 == elements) {
            distances.push((along(rotation, origin, kappa, all[next] - from).1 - points[next]).norm());
            next += 1;
        }
        frame = Some(along(rotation, origin, kappa, length));
    }
    Some(Errors::of(&distances))
}
