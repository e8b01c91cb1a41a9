//! States of a strand while its step is solved: what its pack has to do, by which formula, whether it rests, what it may touch, where
//! it ends.

/// What a strand's pack has to do in the first half of an iteration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FirstHalf {
    /// Nothing: the strand rests, or its island has ended.
    None,
    /// It was done ahead of time. It is repeated if another strand of the pack has it to do: a pack is eliminated as a whole.
    Done,
    /// It has to be done.
    ToDo,
}

/// The first half of a strand's first iteration, which predicts whether something presses it. Until that iteration its constraints
/// stay as they were for this: a ring's point, looked for once more from where it is, differs in its last bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LookAhead {
    /// It was not done, or the strand's step has begun again since.
    #[default]
    None,
    /// It was done.
    Done,
    /// It was done, but is repeated: a strand of its pack that iterates at another time would overwrite it.
    ToRepeat,
}

/// The integration formula of a constrained strand's step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Formula {
    /// That of the setting.
    #[default]
    AsSet,
    /// Its step is to begin again, by implicit Euler: until then the strand stays where it is.
    ToBeginAgain,
    /// Implicit Euler, whatever the setting.
    ImplicitEuler,
}

impl Formula {
    /// Whether a step that begins with it is one of first order, by implicit Euler.
    pub fn is_first_order(self) -> bool {
        self != Self::AsSet
    }
}

/// Whether a strand is at equilibrium under its constraints' forces, and stays where it is while others of its island go on. It is
/// woken at most twice: two neighbours could wake each other in turn for ever.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Rest {
    /// It moves, and has not rested since its island was formed.
    #[default]
    Active,
    /// It rests.
    Resting,
    /// It moves: changed forces have woken it.
    Woken,
    /// It rests again.
    RestingAgain,
    /// It moves and rests no more.
    Awake,
    /// It stays where it is, whatever the forces, while strands among which it is are brought out of bodies.
    Held,
}

impl Rest {
    /// Whether it rests.
    pub fn is_resting(self) -> bool {
        matches!(self, Self::Resting | Self::RestingAgain | Self::Held)
    }

    /// Whether it moves, and may come to rest.
    pub(super) fn may_rest(self) -> bool {
        matches!(self, Self::Active | Self::Woken)
    }

    /// It comes to rest.
    pub(crate) fn settle(&mut self) {
        *self = match self {
            Self::Active | Self::Resting => Self::Resting,
            Self::Woken | Self::RestingAgain | Self::Awake => Self::RestingAgain,
            Self::Held => Self::Held,
        };
    }

    /// Changed forces wake it.
    pub(super) fn wake(&mut self) {
        *self = match self {
            Self::Active => Self::Active,
            Self::Resting | Self::Woken => Self::Woken,
            Self::RestingAgain | Self::Awake => Self::Awake,
            Self::Held => Self::Held,
        };
    }

    /// It moves for another reason than changed forces.
    pub(crate) fn stir(&mut self) {
        *self = match self {
            Self::Active | Self::Resting => Self::Active,
            Self::Woken | Self::RestingAgain => Self::Woken,
            Self::Awake => Self::Awake,
            Self::Held => Self::Held,
        };
    }

    /// Its island is formed again: it may be woken as often as at first.
    pub(crate) fn forget_wakes(&mut self) {
        *self = if self.is_resting() { Self::Resting } else { Self::Active };
    }
}

/// What a strand may touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Meets {
    /// It takes no part in contact.
    #[default]
    Nothing,
    /// Bodies only: while bodies still follow it, other strands would hold it back.
    Bodies,
    /// Bodies, and other strands.
    All,
}

/// Where a strand ends its step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StrandEnd {
    /// As it was when the step began: no iteration was done for it.
    #[default]
    AsBegun,
    /// Where its iteration has come to.
    Iterated,
    /// It moves with its root instead.
    WithRoot,
}

#[cfg(test)]
mod tests {
    use super::Rest;

    #[test]
    fn a_strand_is_woken_twice_at_most() {
        let mut rest = Rest::Active;
        for wakes in 0..2 {
            assert!(rest.may_rest() && !rest.is_resting(), "{wakes}: {rest:?}");
            rest.settle();
            assert!(rest.is_resting(), "{wakes}: {rest:?}");
            rest.wake();
        }
        assert!(!rest.may_rest() && !rest.is_resting(), "{rest:?}");
        // Its island is formed again.
        rest.forget_wakes();
        assert_eq!(rest, Rest::Active);
    }

    #[test]
    fn a_strand_that_moves_for_another_reason_may_be_woken_as_often_as_before() {
        let mut rest = Rest::Resting;
        rest.stir();
        assert_eq!(rest, Rest::Active);
        rest = Rest::RestingAgain;
        rest.stir();
        assert_eq!(rest, Rest::Woken);
        assert!(rest.may_rest());
    }

    #[test]
    fn a_held_strand_stays_whatever_happens() {
        let mut rest = Rest::Held;
        rest.wake();
        rest.stir();
        rest.settle();
        assert_eq!(rest, Rest::Held);
        assert!(rest.is_resting() && !rest.may_rest());
    }
}
