//! How many touches a strand may have. A strand's model grows with the square of them, in memory too: hair that was left in a heap of itself would
//! have thousands. What is deepest is kept.

use crate::contact::held_strand::HeldStrand;
use crate::contact::joint::Joint;

/// The most touches an element of a strand has, on average.
const MOST: usize = 12;
/// The fewest that it is thinned out to where time is short.
const FEWEST: usize = 2;
/// So many iterations there is to be work for.
const ITERATIONS: u64 = 6;

/// Takes touches out where strands have too many of them, those first that are least deep; their strands are told as overlooked. `left`: the work that there is.
pub(super) fn thin_out(joints: &mut Vec<Joint>, strands: &mut [HeldStrand], left: u64) {
    strands.iter_mut().for_each(|held| held.touches_there = 0);
    for end in joints.iter().flat_map(Joint::ends) {
        strands[end.held as usize].touches_there += 1;
    }
    let room = |held: &HeldStrand, most: usize| most * held.elements();
    let work = |most: usize| -> u64 {
        strands.iter().map(|held| 2 * held.half_work_with(held.touches_there.min(room(held, most)))).sum()
    };
    let mut most = MOST;
    while most > FEWEST && work(most) > left / ITERATIONS {
        most -= 1;
    }
    if strands.iter().all(|held| held.touches_there <= room(held, most)) {
        return;
    }
    // Constraints first.
    let mut order: Vec<u32> = (0..joints.len() as u32).collect();
    let key = |index: &u32| (joints[*index as usize].is_touch(), joints[*index as usize].gap);
    order.sort_by(|a, b| {
        let (a, b) = ((key(a), a), (key(b), b));
        a.0.0.cmp(&b.0.0).then(a.0.1.total_cmp(&b.0.1)).then(a.1.cmp(b.1))
    });
    strands.iter_mut().for_each(|held| held.touches_there = 0);
    let mut stays = vec![false; joints.len()];
    for index in order {
        let joint = &joints[index as usize];
        let has_room = |held: &HeldStrand| held.touches_there < room(held, most);
        if !joint.is_touch() || joint.ends().all(|end| has_room(&strands[end.held as usize])) {
            joint.ends().for_each(|end| strands[end.held as usize].touches_there += 1);
            stays[index as usize] = true;
        } else {
            joint.ends().for_each(|end| strands[end.held as usize].overlooked = true);
        }
    }
    let mut index = 0;
    joints.retain(|_| {
        index += 1;
        stays[index - 1]
    });
}
