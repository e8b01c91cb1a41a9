//! The samples of a raster that a triangle covers.

use std::ops::Range;

/// A raster: samples of a row, and the rows that are looked at.
#[derive(Debug, Clone)]
pub struct Raster {
    /// Samples of a row.
    pub width: usize,
    /// Rows, by their numbers in the whole raster.
    pub rows: Range<usize>,
}

/// Calls `found` with column, row and the corners' shares for every sample whose middle lies in the triangle (corners in samples, y down).
pub fn cover(corners: [[f32; 2]; 3], raster: &Raster, mut found: impl FnMut(usize, usize, [f32; 3])) {
    let [a, b, c] = corners;
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if area == 0.0 || !area.is_finite() {
        return;
    }
    let span = |axis: usize, from: usize, to: usize| {
        let (low, high) = (a[axis].min(b[axis]).min(c[axis]), a[axis].max(b[axis]).max(c[axis]));
        let clamped = |value: f32| value.clamp(from as f32, to as f32) as usize;
        clamped((low - 0.5).ceil())..clamped((high - 0.5).floor() + 1.0)
    };
    let columns = span(0, 0, raster.width);
    let share = |from: [f32; 2], to: [f32; 2], x: f32, y: f32| {
        ((to[0] - from[0]) * (y - from[1]) - (to[1] - from[1]) * (x - from[0])) / area
    };
    for row in span(1, raster.rows.start, raster.rows.end) {
        let y = row as f32 + 0.5;
        for column in columns.clone() {
            let x = column as f32 + 0.5;
            let shares = [share(b, c, x, y), share(c, a, x, y), share(a, b, x, y)];
            if shares.iter().all(|share| *share >= 0.0) {
                found(column, row, shares);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_of_either_winding_covers_its_area_and_no_other_row() {
        for corners in [[[2.0, 3.0], [80.0, 10.0], [30.0, 90.0]], [[2.0, 3.0], [30.0, 90.0], [80.0, 10.0]]] {
            let mut count = 0.0;
            cover(corners, &Raster { width: 100, rows: 0..100 }, |x, y, shares| {
                let at = |axis: usize| (0..3).map(|k| shares[k] * corners[k][axis]).sum::<f32>();
                assert!((at(0) - x as f32 - 0.5).abs() < 1e-3 && (at(1) - y as f32 - 0.5).abs() < 1e-3);
                count += 1.0;
            });
            let area = 0.5 * (78.0 * 87.0 - 7.0 * 28.0);
            assert!((count / area - 1.0f32).abs() < 0.02, "{count} {area}");
            cover(corners, &Raster { width: 100, rows: 40..50 }, |_, y, _| assert!((40..50).contains(&y)));
        }
    }
}
