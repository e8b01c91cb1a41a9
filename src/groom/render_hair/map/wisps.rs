//! Wisps: divides the strands of each first guide among well-separated middles.

use super::strand::RenderStrand;

/// Rounds in which middles move to the centroids of their strands (Lloyd 1982), and strands to the nearest middles.
const ROUNDS: usize = 4;

fn squared(a: [f32; 2], b: [f32; 2]) -> f64 {
    let (x, y) = (f64::from(a[0]) - f64::from(b[0]), f64::from(a[1]) - f64::from(b[1]));
    x * x + y * y
}

/// The middle nearest to a position, and its index.
pub(super) fn nearest(place: [f32; 2], middles: &[[f32; 2]]) -> usize {
    let far = (0, f64::INFINITY);
    let nearer = |best: (usize, f64), (at, away): (usize, f64)| if away < best.1 { (at, away) } else { best };
    middles.iter().map(|middle| squared(place, *middle)).enumerate().fold(far, nearer).0
}

/// Assigns every strand to a wisp. The first middle is the guide itself, and each further one the strand farthest from all
/// middles so far (Gonzalez 1985); a strand belongs to the nearest middle. Then middles move to the centroids of their strands.
/// `offset` starts as the strands' roots relative to their guide's, and ends relative to the middle.
pub(super) fn share_out(strands: &mut [RenderStrand], guides: usize, wisps_per_guide: usize) {
    let mut members: Vec<u32> = (0..strands.len() as u32).collect();
    members.sort_by_key(|index| strands[*index as usize].guides[0]);
    let mut wisps: Vec<u32> = Vec::new();
    let mut begin = 0;
    for guide in 0..guides as u32 {
        let end = begin + members[begin..].partition_point(|index| strands[*index as usize].guides[0] == guide);
        let cell = &members[begin..end];
        begin = end;
        let places: Vec<[f32; 2]> = cell.iter().map(|index| strands[*index as usize].offset).collect();
        let mut middles = vec![[0.0; 2]];
        let mut distances: Vec<f64> = places.iter().map(|place| squared(*place, [0.0; 2])).collect();
        while middles.len() < wisps_per_guide {
            let farthest =
                distances.iter().enumerate().fold((0, 0.0), |best, (at, away)| if *away > best.1 { (at, *away) } else { best });
            if farthest.1 <= 0.0 {
                break;
            }
            let middle = places[farthest.0];
            middles.push(middle);
            distances.iter_mut().zip(&places).for_each(|(away, place)| *away = away.min(squared(*place, middle)));
        }
        for round in 0..=ROUNDS {
            wisps.clear();
            wisps.extend(places.iter().map(|place| nearest(*place, &middles) as u32));
            let mut sums = vec![([0.0_f64; 2], 0.0_f64); middles.len()];
            for (wisp, place) in wisps.iter().zip(&places) {
                let (sum, count) = &mut sums[*wisp as usize];
                (0..2).for_each(|axis| sum[axis] += f64::from(place[axis]));
                *count += 1.0;
            }
            for (middle, (sum, count)) in middles.iter_mut().zip(&sums) {
                if *count > 0.0 {
                    *middle = sum.map(|value| (value / count) as f32);
                }
            }
            // With one middle there is nothing to assign.
            if round == 0 && middles.len() == 1 {
                break;
            }
        }
        for ((index, wisp), place) in cell.iter().zip(&wisps).zip(&places) {
            let (strand, middle) = (&mut strands[*index as usize], middles[*wisp as usize]);
            strand.wisp = *wisp;
            strand.middle = middle;
            strand.offset = [place[0] - middle[0], place[1] - middle[1]];
        }
    }
}
