//! The minimum of a distance along a curve between a point where it falls and one where it rises.

/// A value and slope somewhere along a curve, and what was found there.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Sample<T> {
    pub s: f64,
    pub value: f64,
    pub slope: f64,
    pub found: T,
}

/// The lowest sample between `a`, where the value falls, and `b`, where it rises.
pub(in crate::contact) fn lowest<T: Copy>(
    a: Sample<T>,
    b: Sample<T>,
    tolerance: f64,
    ask: impl FnMut(f64) -> Option<Sample<T>>,
) -> Sample<T> {
    bracketed(a, b, tolerance, ask).0
}

/// The same, and the last two of these, which it lies between.
///
/// By turns at the zero of the slopes' secant, which is the minimum of a parabola, and where the tangents meet, which is that of a kink
/// (an edge of a mesh); ends when the tangents, which lie below a convex function, leave less than `tolerance` below the lowest sample.
pub(in crate::contact) fn bracketed<T: Copy>(
    mut a: Sample<T>,
    mut b: Sample<T>,
    tolerance: f64,
    mut ask: impl FnMut(f64) -> Option<Sample<T>>,
) -> (Sample<T>, [Sample<T>; 2]) {
    let mut best = if a.value <= b.value { a } else { b };
    let mut width = b.s - a.s;
    for turn in 0..48 {
        let (span, rise) = (b.s - a.s, b.slope - a.slope);
        let cut = (a.value - b.value + b.slope * span) / rise;
        // Tangents of a convex function meet between the ends; otherwise only the slopes are of use.
        let convex = cut >= 0.0 && cut <= span;
        let below = if convex { best.value - (a.value + a.slope * cut) } else { span * b.slope.max(-a.slope) };
        if rise <= 0.0 || turn > 0 && below <= tolerance {
            break;
        }
        let place = match turn % 3 {
            _ if !convex => 0.5 * span,
            0 => -a.slope / rise * span,
            1 => cut,
            // Neither may have helped.
            _ if span > 0.5 * width => 0.5 * span,
            _ => cut,
        };
        if turn % 3 == 2 {
            width = span;
        }
        // One sample well inside first: between the ends of an arc the function need not be convex.
        let rim = if turn == 0 { 0.1 } else { 0.01 };
        let s = a.s + place.clamp(rim * span, (1.0 - rim) * span);
        if s <= a.s || s >= b.s {
            break;
        }
        let Some(sample) = ask(s) else { break };
        if sample.value < best.value {
            best = sample;
        }
        if sample.slope < 0.0 { a = sample } else { b = sample }
    }
    (best, [a, b])
}

/// The minimum to which the value falls from a sample towards another place, and the last two samples, which it lies between. `beyond`: the sample
/// there; none where nothing is near. None where it falls all the way: then the minimum lies beyond.
pub(in crate::contact) fn fallen<T: Copy>(
    from: Sample<T>,
    mut end: f64,
    mut beyond: Option<Sample<T>>,
    tolerance: f64,
    mut ask: impl FnMut(f64) -> Option<Sample<T>>,
) -> Option<(Sample<T>, [Sample<T>; 2])> {
    /// How often it is halved at least.
    const HALVED: usize = 2;
    let forwards = end > from.s;
    let falls = |sample: &Sample<T>| if forwards { sample.slope < 0.0 } else { sample.slope > 0.0 };
    let mut here = from;
    // What is higher again, or rises, at the end has a minimum on the way. The nearest is sought: between ends each of which lies above the other's
    // tangent the value may be convex, before that it is not. (Ends that are far apart may look so over a narrow fall.)
    for turn in 0..24 {
        if let Some(there) = beyond {
            let span = there.s - here.s;
            let is_above = |a: &Sample<T>, b: &Sample<T>, span: f64| b.value >= a.value + a.slope * span;
            if falls(&there) {
                if there.value <= here.value {
                    return None;
                }
            } else if turn >= HALVED && is_above(&here, &there, span) && is_above(&there, &here, -span) {
                let [left, right] = if forwards { [here, there] } else { [there, here] };
                return Some(bracketed(left, right, tolerance, ask));
            }
        }
        let s = 0.5 * (here.s + end);
        match ask(s) {
            Some(middle) if falls(&middle) && middle.value < here.value => here = middle,
            middle => (end, beyond) = (s, middle),
        }
    }
    None
}
