//! Strands of a reconstruction made usable: what cannot be used dropped, roots on the scalp, strands out of the head.

use std::path::Path;

use nalgebra::Vector3;
use serde::Serialize;
use superhelix::hair::{
    BroughtOut, DrawnCurve, LeftOut, Rooted, Unusable, bring_out, remove_duplicates, root_on, turn_around, usable_curves,
};
use superhelix::io::RawStrands;
use superhelix::shapes::Mesh;

use super::arguments::PrepareArguments;
use super::head::{Body, Head};
use crate::groom::statistics::Spread;
use crate::shell::failure::Failure;

/// A strand that is dropped.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Dropped {
    /// Its index in the file.
    pub strand: usize,
    /// Why, in one word: see [`REASONS`].
    pub reason: &'static str,
    /// Why, with the numbers.
    pub because: String,
}

/// Why strands are dropped, and what that is called for people.
pub const REASONS: [(&str, &str); 8] = [
    ("not_finite", "numbers that are not finite"),
    ("too_few_points", "fewer than two points"),
    ("too_short", "too short"),
    ("duplicate", "another strand again"),
    ("near_duplicate", "nearly another strand"),
    ("off_scalp", "a root too far from the scalp"),
    ("inside_head", "mostly inside the head"),
    ("not_fitted", "no strand that can be simulated"),
];

/// What was done to roots.
#[derive(Debug, Serialize)]
pub struct RootsReport {
    /// Strands whose roots were moved by more than a micrometre.
    pub moved: usize,
    /// Root mean square of how far, over all strands, m.
    pub rms: f64,
    /// How far at most, m.
    pub max: f64,
}

/// What was done about strands inside the head.
#[derive(Debug, Serialize)]
pub struct InsideReport {
    /// Strands with points inside the head.
    pub strands: usize,
    /// The deepest of the points, m.
    pub deepest: f64,
    /// Root mean square, over these strands, of how far a point of it was moved at most, m.
    pub rms: f64,
    /// How far a point was moved at most, m.
    pub max: f64,
    /// Strands that no way out was found for: they stay as they are, and none becomes a guide.
    pub left: Vec<usize>,
}

/// What was done to the strands of the file.
#[derive(Debug, Default, Serialize)]
pub struct StrandsReport {
    /// Strands that are dropped, in the order of the file.
    pub dropped: Vec<Dropped>,
    /// Strands that began at the tip, and were turned.
    pub turned: Vec<usize>,
    /// Roots put on the scalp.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roots: Option<RootsReport>,
    /// Strands taken out of the head.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inside: Option<InsideReport>,
    /// Strands that are left.
    pub kept: usize,
    /// Their lengths, m.
    pub length: Option<Spread>,
}

/// Strands that can be used.
pub struct Prepared {
    /// Of the file, m.
    pub curves: Vec<DrawnCurve>,
    /// Whether a strand is clear of the head, and so may be a guide.
    pub clear: Vec<bool>,
    /// What was done.
    pub report: StrandsReport,
}

impl StrandsReport {
    fn drop_all(&mut self, left_out: LeftOut) {
        self.dropped.extend(left_out.into_iter().map(|(strand, why)| {
            let (reason, because) = in_words(why);
            Dropped { strand, reason, because }
        }));
    }
}

fn in_words(why: Unusable) -> (&'static str, String) {
    match why {
        Unusable::NotFinite { points } => ("not_finite", format!("{points} points are not finite")),
        Unusable::TooFewPoints { points } => ("too_few_points", format!("it has {points} points")),
        Unusable::TooShort { length } => ("too_short", format!("it is {length:.2e} m long")),
        Unusable::Duplicate { of } => ("duplicate", format!("it is strand {of} again")),
        Unusable::NearDuplicate { of, distance } => ("near_duplicate", format!("it is within {distance:.2e} m of strand {of}")),
        _ => ("not_fitted", "it cannot be used".to_owned()),
    }
}

/// Makes the strands of a file usable.
pub fn prepare(arguments: &PrepareArguments, raw: &RawStrands, scale: f64, head: &Head) -> Result<Prepared, Failure> {
    let mut report = StrandsReport::default();
    let (mut curves, left_out) = usable_curves(raw.strands(), scale, arguments.least_length)?;
    report.drop_all(left_out);
    if head.scalp.as_ref().is_some_and(|scalp| begins_at_tips(&curves, scalp, arguments.reach)) {
        curves.iter_mut().for_each(|curve| curve.points.reverse());
        report.turned.extend(curves.iter().map(|curve| curve.index));
    }
    // What is turned a second time began at the root.
    for strand in turn_around(&mut curves, head.scalp.as_ref()) {
        match report.turned.iter().position(|turned| *turned == strand) {
            Some(place) => drop(report.turned.remove(place)),
            None => report.turned.push(strand),
        }
    }
    report.turned.sort_unstable();
    report.drop_all(remove_duplicates(&mut curves, arguments.near)?);
    if let Some(scalp) = &head.scalp {
        put_on(&mut curves, scalp, arguments, &mut report)?;
    }
    let mut clear = vec![true; curves.len()];
    if let Some(body) = &head.body {
        take_out(&mut curves, &mut clear, body, arguments, &mut report)?;
    }
    report.dropped.sort_by_key(|dropped| dropped.strand);
    report.kept = curves.len();
    report.length = Spread::of(curves.iter().map(length).collect());
    if curves.is_empty() {
        let why = report.dropped.first().map_or_else(|| "it has none".to_owned(), |dropped| dropped.because.clone());
        return Err(Failure::file(&arguments.strands, format!("no strand can be used: {why}")));
    }
    Ok(Prepared { curves, clear, report })
}

fn length(curve: &DrawnCurve) -> f64 {
    curve.points.windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum()
}

/// Whether the curves as a whole end on the scalp and do not begin there.
fn begins_at_tips(curves: &[DrawnCurve], scalp: &Mesh, reach: f64) -> bool {
    let on = |point: &Vector3<f64>| scalp.closest(*point, reach).is_some();
    let count = |end: fn(&DrawnCurve) -> &Vector3<f64>| curves.iter().filter(|curve| on(end(curve))).count();
    let (first, last) = (count(|curve| &curve.points[0]), count(|curve| &curve.points[curve.points.len() - 1]));
    2 * last > curves.len() && 4 * first < last
}

/// Puts roots on the scalp, and drops strands that are not on it.
fn put_on(
    curves: &mut Vec<DrawnCurve>,
    scalp: &Mesh,
    arguments: &PrepareArguments,
    report: &mut StrandsReport,
) -> Result<(), Failure> {
    let (mut moved, mut squares, mut most, mut distances) = (0, 0.0, 0.0_f64, Vec::new());
    let before = curves.len();
    let mut rooted = Vec::with_capacity(before);
    for curve in curves.iter_mut() {
        let outcome = root_on(&mut curve.points, scalp, arguments.reach)?;
        let (Rooted::Moved(far) | Rooted::TooFar(far)) = outcome;
        distances.push(far);
        rooted.push(outcome);
    }
    let mut next = rooted.iter();
    curves.retain(|curve| match next.next() {
        Some(Rooted::TooFar(far)) => {
            let because = if far.is_finite() {
                format!("its root is {far:.2e} m from the scalp")
            } else {
                "its root is nowhere near the scalp".to_owned()
            };
            report.dropped.push(Dropped { strand: curve.index, reason: "off_scalp", because });
            false
        }
        Some(Rooted::Moved(far)) => {
            moved += usize::from(*far > 1e-6);
            squares += far * far;
            most = most.max(*far);
            true
        }
        None => true,
    });
    if 2 * curves.len() < before {
        distances.sort_by(f64::total_cmp);
        let median = distances[distances.len() / 2];
        let far = if median.is_finite() { format!("{median:.3} m") } else { "more than 0.1 m".to_owned() };
        let mesh: &Path = arguments.scalp.as_deref().or(arguments.head.as_deref()).unwrap_or(&arguments.strands);
        return Err(Failure::file(
            mesh,
            format!(
                "does not carry these strands: half of the roots are farther than {far} from it (--reach {}); is its unit (--head-scale), \
                 its place or its axis another?",
                arguments.reach
            ),
        ));
    }
    report.roots = Some(RootsReport { moved, rms: (squares / curves.len() as f64).sqrt(), max: most });
    Ok(())
}

/// The share of a curve's length that is deeper than that, m.
fn share_inside(curve: &DrawnCurve, body: &Body, depth: f64) -> f64 {
    let (mut inside, mut all) = (0.0, 0.0);
    let deep: Vec<bool> =
        curve.points.iter().map(|point| body.distance(*point).is_some_and(|distance| distance < -depth)).collect();
    for (edge, deep) in curve.points.windows(2).zip(deep.windows(2)) {
        let length = (edge[1] - edge[0]).norm();
        all += length;
        inside += 0.5 * length * f64::from(u8::from(deep[0]) + u8::from(deep[1]));
    }
    inside / all
}

/// Takes strands out of the head, and drops those that are mostly in it.
fn take_out(
    curves: &mut Vec<DrawnCurve>,
    clear: &mut Vec<bool>,
    body: &Body,
    arguments: &PrepareArguments,
    report: &mut StrandsReport,
) -> Result<(), Failure> {
    curves.retain(|curve| {
        let share = share_inside(curve, body, arguments.reach);
        if share > arguments.most_inside {
            let because = format!("{:.0} % of it is more than {:.1e} m deep in the head", 100.0 * share, arguments.reach);
            report.dropped.push(Dropped { strand: curve.index, reason: "inside_head", because });
        }
        share <= arguments.most_inside
    });
    let mut inside = InsideReport { strands: 0, deepest: 0.0, rms: 0.0, max: 0.0, left: Vec::new() };
    clear.clear();
    for curve in curves.iter_mut() {
        let BroughtOut { inside: points, deepest, moved, stuck } = bring_out(&mut curve.points, &body.shape, 0.0)?;
        clear.push(!stuck);
        if points > 0 {
            inside.strands += 1;
            inside.deepest = inside.deepest.max(deepest);
            inside.rms += moved * moved;
            inside.max = inside.max.max(moved);
        }
        if stuck {
            inside.left.push(curve.index);
        }
    }
    inside.rms = (inside.rms / inside.strands.max(1) as f64).sqrt();
    report.inside = Some(inside);
    Ok(())
}
