//! Packs of constrained strands, in registers of any width.

use super::pack::ConstrainedPack;
use super::step::{ConstrainedStep, Lanes};
#[allow(unused_imports, reason = "which types there are depends on the machine")]
use crate::math::lanes;
use crate::math::lanes::InstructionSet;
use crate::step::Setting;
use crate::step::pack::members::Pack;
use crate::step::state::RuleScratch;

/// Memory for a pack of any width, kept between steps.
#[derive(Debug, Default)]
pub struct AnyPack {
    width: Width,
    one: Option<Box<ConstrainedPack<f64>>>,
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
    two: Option<Box<ConstrainedPack<lanes::F64x2>>>,
    #[cfg(target_arch = "x86_64")]
    four: Option<Box<ConstrainedPack<lanes::F64x4>>>,
    #[cfg(target_arch = "x86_64")]
    eight: Option<Box<ConstrainedPack<lanes::F64x8>>>,
}

/// How many lanes are in use.
#[derive(Debug, Clone, Copy, Default)]
enum Width {
    #[default]
    One,
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
    Two,
    #[cfg(target_arch = "x86_64")]
    Four,
    #[cfg(target_arch = "x86_64")]
    Eight,
}

impl Width {
    /// The narrowest registers for this number of strands: a wide instruction costs more than a narrow one.
    fn of(strands: usize, set: InstructionSet) -> Self {
        #[cfg(target_arch = "x86_64")]
        match set {
            InstructionSet::Avx512 if strands > 4 => return Self::Eight,
            InstructionSet::Avx512 | InstructionSet::Avx2 if strands > 2 => return Self::Four,
            _ => {}
        }
        #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
        if strands > 1 && set != InstructionSet::Scalar {
            return Self::Two;
        }
        let _ = (strands, set);
        Self::One
    }
}

/// Calls a method of the pack in use.
macro_rules! with_pack {
    ($any:expr, $pack:ident => $action:expr) => {
        match $any.width {
            Width::One => {
                let $pack = $any.one.get_or_insert_default();
                $action
            }
            #[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_arch = "wasm32"))]
            Width::Two => {
                let $pack = $any.two.get_or_insert_default();
                $action
            }
            #[cfg(target_arch = "x86_64")]
            Width::Four => {
                let $pack = $any.four.get_or_insert_default();
                $action
            }
            #[cfg(target_arch = "x86_64")]
            Width::Eight => {
                let $pack = $any.eight.get_or_insert_default();
                $action
            }
        }
    };
}

impl AnyPack {
    /// See [`ConstrainedPack::begin`]; in the registers of `set` that hold the strands.
    pub fn begin(
        &mut self,
        members: &dyn Pack,
        setting: &Setting,
        h: f64,
        first_order: bool,
        set: InstructionSet,
        strands: Lanes,
    ) {
        self.width = Width::of(members.count(), set);
        with_pack!(self, pack => pack.begin(members, setting, h, first_order, strands));
    }

    /// See [`ConstrainedPack::linearise`].
    pub fn linearise(&mut self, strands: Lanes) {
        with_pack!(self, pack => pack.linearise(strands));
    }

    /// See [`ConstrainedPack::advance`].
    pub fn advance(&mut self, setting: &Setting, strands: Lanes) {
        with_pack!(self, pack => pack.advance(setting, strands));
    }

    /// See [`ConstrainedPack::bend`].
    pub fn bend(&mut self, lane: usize, curvature: [f64; 2], setting: &Setting, constrained: &mut ConstrainedStep) {
        with_pack!(self, pack => pack.bend(lane, curvature, setting, constrained));
    }

    /// See [`ConstrainedPack::finish`].
    pub fn finish(&mut self, members: &dyn Pack, setting: &Setting, h: f64, strands: Lanes) {
        with_pack!(self, pack => pack.finish(members, setting, h, strands));
    }

    /// See [`ConstrainedPack::end`].
    #[allow(clippy::too_many_arguments, reason = "a strand, and what its step is of")]
    pub fn end(
        &mut self,
        lane: usize,
        member: &mut dyn Pack,
        setting: &Setting,
        h: f64,
        max_elastic: f64,
        scratch: &mut RuleScratch,
        constrained: &mut ConstrainedStep,
    ) {
        with_pack!(self, pack => pack.end(lane, member, setting, h, max_elastic, scratch, constrained));
    }
}
