//! The choice of lanes for a pack of strands: by precision, by the machine's instructions, and by the number of strands.

use super::members::Pack;
use super::whole::{End, Take};
use crate::math::lane::{Lane, MAX_LANES, Precision};
use crate::math::lanes::InstructionSet;
use crate::step::scratch::{Bench, StepScratch};
use crate::step::state::RuleScratch;
use crate::step::{Setting, StrandOutcome, keep, subdivision};

/// The best number of strands per pack.
pub fn width(precision: Precision, set: InstructionSet) -> usize {
    let f64_lanes = match set {
        InstructionSet::Scalar => return 1,
        InstructionSet::Baseline => 2,
        InstructionSet::Avx2 => 4,
        InstructionSet::Avx512 => 8,
    };
    match precision {
        Precision::F64 => f64_lanes,
        Precision::F32 => 2 * f64_lanes,
    }
}

/// Takes strands with one [pack key](super::members::PackKey), at least two and at most [`width`], through a step of `h` seconds in
/// one piece, side by side; none may start with substeps. Each strand gets the same bits as from [`crate::step::take`]. An acceptable
/// end, or that of a strand that may not be subdivided, becomes its state if the pack lets it ([`Pack::may_keep`]); the other strands stay
/// unchanged for [`crate::step::finish`].
pub fn take(
    members: &mut dyn Pack,
    setting: &Setting,
    h: f64,
    set: InstructionSet,
    scratch: &mut StepScratch,
) -> [StrandOutcome; MAX_LANES] {
    let rule = &mut scratch.rule;
    #[cfg(target_arch = "x86_64")]
    let count = members.count();
    // Registers of one width only.
    #[cfg(any(target_arch = "aarch64", target_arch = "wasm32"))]
    let _ = set;
    // The narrowest registers that hold all strands: a wide instruction costs more than a narrow one.
    #[cfg(target_arch = "x86_64")]
    match (setting.options.precision, set) {
        (Precision::F64, InstructionSet::Avx512) if count > 4 => in_lanes(members, setting, h, &mut scratch.f64x8, rule),
        (Precision::F64, InstructionSet::Avx512 | InstructionSet::Avx2) if count > 2 => {
            in_lanes(members, setting, h, &mut scratch.f64x4, rule)
        }
        (Precision::F64, _) => in_lanes(members, setting, h, &mut scratch.f64x2, rule),
        (Precision::F32, InstructionSet::Avx512) if count > 8 => in_lanes(members, setting, h, &mut scratch.f32x16, rule),
        (Precision::F32, InstructionSet::Avx512 | InstructionSet::Avx2) if count > 4 => {
            in_lanes(members, setting, h, &mut scratch.f32x8, rule)
        }
        (Precision::F32, _) => in_lanes(members, setting, h, &mut scratch.f32x4, rule),
    }
    #[cfg(any(target_arch = "aarch64", target_arch = "wasm32"))]
    match setting.options.precision {
        Precision::F64 => in_lanes(members, setting, h, &mut scratch.f64x2, rule),
        Precision::F32 => in_lanes(members, setting, h, &mut scratch.f32x4, rule),
    }
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32")))]
    {
        let _ = (members, setting, h, set, rule);
        unreachable!("no packs on this kind of machine")
    }
}

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
fn in_lanes<T: Lane>(
    members: &mut dyn Pack,
    setting: &Setting,
    h: f64,
    bench: &mut Option<Box<Bench<T>>>,
    rule: &mut RuleScratch,
) -> [StrandOutcome; MAX_LANES] {
    let Bench { workspace, elimination } = &mut **bench.get_or_insert_default();
    let outcomes = T::call(Take { members, setting, h, workspace, solver: elimination });
    for lane in 0..members.count() {
        let is_kept = subdivision::is_kept(setting.options, members.point_contact().is_some(), &outcomes[lane]);
        if is_kept && members.may_keep(lane, &End { workspace, lane }) {
            keep(members, lane, setting, h, workspace, rule);
        }
    }
    outcomes
}
