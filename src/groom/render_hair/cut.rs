//! Strands cut short: as many points as before on the part that is left.

/// Points that one is taken from.
const TAPS: usize = 4;

/// Moves the points of rows (`stride` floats each, of which `points` count) down to the first `share` of the way from root to tip, along the
/// Catmull–Rom spline through them: the root stays to the bit. `room` is scratch memory.
#[inline(always)]
pub(super) fn shorten(share: f32, stride: usize, points: usize, rows: &mut [f32], room: &mut Vec<f32>) {
    // Each row's points, with one more before and behind them on the parabola (of two points: the line) through the ends.
    let size = points + 2;
    room.resize(size * (rows.len() / stride), 0.0);
    for (row, room) in rows.chunks_exact(stride).zip(room.chunks_exact_mut(size)) {
        let row = &row[..points];
        room[1..=points].copy_from_slice(row);
        let beyond = |a: f32, b: f32, c: Option<&f32>| c.map_or(2.0 * a - b, |c| 3.0 * (a - b) + c);
        room[0] = beyond(row[0], row[1], row.get(2));
        room[points + 1] = beyond(row[points - 1], row[points - 2], points.checked_sub(3).map(|k| &row[k]));
    }
    for k in 0..points {
        let place = share * k as f32;
        let before = (place as usize).min(points - 2);
        let weights = weights(place - before as f32);
        for (row, room) in rows.chunks_exact_mut(stride).zip(room.chunks_exact(size)) {
            row[k] = weights.iter().zip(&room[before..before + TAPS]).map(|(weight, tap)| weight * tap).sum();
        }
    }
}

/// The shares of four places in a row at u between the middle two (Catmull and Rom 1974).
#[inline(always)]
fn weights(u: f32) -> [f32; TAPS] {
    let (u2, u3) = (u * u, u * u * u);
    [u2 - 0.5 * (u + u3), 1.0 + 1.5 * u3 - 2.5 * u2, 0.5 * u + 2.0 * u2 - 1.5 * u3, 0.5 * (u3 - u2)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parabolas_are_cut_exactly_and_helices_nearly() {
        for points in [3, 16, 33] {
            let stride = usize::next_multiple_of(points, 8);
            let at = |k: usize, share: f32| share * k as f32 / (points - 1) as f32;
            let parabola = |s: f32| 0.3 + 0.7 * s - 0.9 * s * s;
            let mut rows: Vec<f32> = (0..stride).map(|k| if k < points { parabola(at(k, 1.0)) } else { 7.0 }).collect();
            shorten(0.63, stride, points, &mut rows, &mut Vec::new());
            for (k, value) in rows[..points].iter().enumerate() {
                assert!((value - parabola(at(k, 0.63))).abs() < 1e-6, "{k}: {value}");
            }
            assert!(rows[points..].iter().all(|value| *value == 7.0));
        }
        // A turn and a half in 32 edges: the spline's error is about the cube of an edge's angle (0.29) over 60, 4e-4; the chord's
        // the square over 8, 1e-2.
        let (points, stride) = (33, 40);
        let wave = |k: usize, share: f32| (1.5 * std::f32::consts::TAU * share * k as f32 / 32.0).cos();
        let mut rows: Vec<f32> = (0..stride).map(|k| wave(k, 1.0)).collect();
        shorten(0.8, stride, points, &mut rows, &mut Vec::new());
        let worst = (1..points - 1).map(|k| (rows[k] - wave(k, 0.8)).abs()).fold(0.0, f32::max);
        assert!(worst < 1e-3, "{worst}");
    }

    #[test]
    fn two_points_are_a_line_and_the_root_stays() {
        let mut rows = vec![0.1, 0.9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        shorten(0.25, 8, 2, &mut rows, &mut Vec::new());
        assert!(rows[0] == 0.1 && (rows[1] - 0.3).abs() < 1e-7, "{rows:?}");
    }
}
