//! The strands of a point cloud: which points make up each strand, where the file does not say.
//!
//! Reconstructions of hair write the points of all strands in one list, every strand with as many points, and leave out how many.
//! It shows: each strand has a colour of its own, or the way from a tip to the next root is much longer than the edges of strands.

/// How the points of a file were told apart into strands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum StrandsBy {
    /// The file says so.
    File,
    /// The caller said how many points a strand has.
    Caller,
    /// Points of a strand have one colour.
    Colours,
    /// Every so many points there is a jump.
    Jumps,
    /// Lines of two points were joined where one begins at the end of the one before.
    JoinedLines,
}

impl StrandsBy {
    /// A short name: "file", "caller", "colours", "jumps", "joined lines".
    pub fn name(self) -> &'static str {
        match self {
            StrandsBy::File => "file",
            StrandsBy::Caller => "caller",
            StrandsBy::Colours => "colours",
            StrandsBy::Jumps => "jumps",
            StrandsBy::JoinedLines => "joined lines",
        }
    }
}

/// Most points of a strand that are looked for.
const MOST_POINTS: usize = 4096;
/// A jump is so many times as long as the median edge.
const JUMP: f64 = 5.0;
/// So many of the places between strands must be jumps.
const JUMPS: f64 = 0.75;

/// The number of points of every strand by the colours of the points: the colour changes between strands and only there. Strands
/// that happen to have the colour of the next do no harm. `None` if colours do not tell.
pub(super) fn by_colours(colours: &[[u8; 3]]) -> Option<usize> {
    let (mut common, mut shortest, mut run, mut runs) = (0, usize::MAX, 0, 0);
    for (index, colour) in colours.iter().enumerate() {
        run += 1;
        if colours.get(index + 1) != Some(colour) {
            common = greatest_common_divisor(common, run);
            shortest = shortest.min(run);
            run = 0;
            runs += 1;
        }
    }
    (runs > 1 && common >= 2 && common == shortest).then_some(common)
}

/// The number of points of every strand by the jumps from each tip to the next root. `None` if there are none, or not regularly.
pub(super) fn by_jumps(points: &[[f32; 3]]) -> Option<usize> {
    let edge = |pair: &[[f32; 3]]| (0..3).map(|axis| f64::from(pair[1][axis] - pair[0][axis]).powi(2)).sum::<f64>().sqrt();
    let edges: Vec<f64> = points.windows(2).map(edge).collect();
    let mut finite: Vec<f64> = edges.iter().copied().filter(|edge| edge.is_finite()).collect();
    if finite.is_empty() {
        return None;
    }
    let middle = finite.len() / 2;
    let jump = JUMP * *finite.select_nth_unstable_by(middle, f64::total_cmp).1;
    // Multiples of the right number have jumps at all their places as well: the least is right.
    (2..=MOST_POINTS.min(points.len() / 2)).filter(|count| points.len().is_multiple_of(*count)).find(|count| {
        let between = edges.iter().skip(count - 1).step_by(*count).filter(|edge| edge.is_finite());
        let (jumps, all) = between.fold((0_usize, 0_usize), |(jumps, all), edge| (jumps + usize::from(*edge > jump), all + 1));
        all > 0 && jump > 0.0 && jumps as f64 >= JUMPS * all as f64
    })
}

fn greatest_common_divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_tell_strands_apart_even_where_neighbours_are_alike() {
        let colours: Vec<[u8; 3]> = [1_u8, 2, 2, 3].iter().flat_map(|colour| [[*colour, 0, 0]; 5]).collect();
        assert_eq!(by_colours(&colours), Some(5));
        assert_eq!(by_colours(&[[1, 1, 1]; 20]), None);
        let each: Vec<[u8; 3]> = (0..20).map(|k| [k, 0, 0]).collect();
        assert_eq!(by_colours(&each), None);
    }

    #[test]
    fn jumps_tell_strands_apart_but_for_a_few() {
        // 40 strands of 12 points, 5 cm long, their roots 2 mm apart; three are without length.
        let strand =
            |s: usize| (0..12).map(move |k| [0.002 * s as f32, 0.0, if s.is_multiple_of(13) { 0.0 } else { -0.0045 * k as f32 }]);
        let mut points: Vec<[f32; 3]> = (0..40).flat_map(strand).collect();
        assert_eq!(by_jumps(&points), Some(12));
        points[20] = [f32::NAN; 3];
        assert_eq!(by_jumps(&points), Some(12));
        assert_eq!(by_jumps(&points[..12]), None);
        let line: Vec<[f32; 3]> = (0..100).map(|k| [0.01 * k as f32, 0.0, 0.0]).collect();
        assert_eq!(by_jumps(&line), None);
        assert_eq!(by_jumps(&[[0.0; 3]; 10]), None);
    }
}
