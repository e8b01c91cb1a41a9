//! Wisps: the strands that follow a guide first, shared among middles that lie far from each other.

use super::strand::RenderStrand;

/// Gives every strand its wisp. A guide's first wisp is about the guide; the middle of each further one is the strand farthest from all
/// middles so far (Gonzalez 1985), and a strand belongs to the middle nearest to it. `offset` has the strands' roots from their guide's.
pub(super) fn share_out(strands: &mut [RenderStrand], guides: usize, wisps_per_guide: usize) {
    let mut members: Vec<u32> = (0..strands.len() as u32).collect();
    members.sort_by_key(|index| strands[*index as usize].guides[0]);
    let mut distances = Vec::new();
    let mut begin = 0;
    for guide in 0..guides as u32 {
        let end = begin + members[begin..].partition_point(|index| strands[*index as usize].guides[0] == guide);
        let cell = &members[begin..end];
        begin = end;
        let squared = |a: [f32; 2], b: [f32; 2]| {
            let (x, y) = (f64::from(a[0]) - f64::from(b[0]), f64::from(a[1]) - f64::from(b[1]));
            x * x + y * y
        };
        let root = |index: u32| strands[index as usize].offset;
        distances.clear();
        distances.extend(cell.iter().map(|index| (squared(root(*index), [0.0; 2]), 0_u32, [0.0_f32; 2])));
        for wisp in 1..wisps_per_guide as u32 {
            let farthest = distances
                .iter()
                .enumerate()
                .fold((0, 0.0), |best, (at, entry)| if entry.0 > best.1 { (at, entry.0) } else { best });
            if farthest.1 <= 0.0 {
                break;
            }
            let middle = root(cell[farthest.0]);
            for (entry, index) in distances.iter_mut().zip(cell) {
                let away = squared(root(*index), middle);
                if away < entry.0 {
                    *entry = (away, wisp, middle);
                }
            }
        }
        for ((_, wisp, middle), index) in distances.iter().zip(cell) {
            let strand = &mut strands[*index as usize];
            strand.wisp = *wisp;
            strand.middle = *middle;
            strand.offset = [strand.offset[0] - middle[0], strand.offset[1] - middle[1]];
        }
    }
}
