//! States of an island: where its iteration is, whether it iterates with others, what its bilateral constraints hold.

/// Where an island's iteration is. One that is large and has contacts is solved roughly first, until these are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Phase {
    /// It iterates to the rough tolerance.
    Rough,
    /// It has ended at the rough tolerance: [`Island::refine`](super::Island::refine) goes on.
    RoughEnded,
    /// It iterates to the full tolerance.
    #[default]
    Full,
    /// It has ended.
    Ended,
    /// It has ended, and its strands take the substep in substeps: their present end is dropped.
    Subdivided,
}

impl Phase {
    /// Whether its tolerance is the rough one.
    pub fn is_rough(self) -> bool {
        matches!(self, Self::Rough | Self::RoughEnded)
    }

    /// Whether it has ended.
    pub fn has_ended(self) -> bool {
        matches!(self, Self::RoughEnded | Self::Ended | Self::Subdivided)
    }

    /// The same tolerance, ended.
    pub(super) fn ended(self) -> Self {
        if self.is_rough() { Self::RoughEnded } else { Self::Ended }
    }

    /// The same tolerance, not ended.
    pub(super) fn resumed(self) -> Self {
        if self.is_rough() { Self::Rough } else { Self::Full }
    }
}

/// When an island iterates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Turn {
    /// Iteration by iteration with all others.
    #[default]
    WithOthers,
    /// Apart from the others: its strand is the only one.
    Alone {
        /// Newton iterations until the next search for contacts, at most.
        iterations_left: u32,
    },
}

impl Turn {
    /// Whether it iterates apart from the others.
    pub fn is_alone(self) -> bool {
        matches!(self, Self::Alone { .. })
    }

    /// Whether it iterates apart from the others, and has iterations left.
    pub fn has_iterations_left(self) -> bool {
        matches!(self, Self::Alone { iterations_left: 1.. })
    }

    /// Takes one of its iterations.
    pub(crate) fn take(&mut self) {
        if let Self::Alone { iterations_left } = self {
            *iterations_left -= 1;
        }
    }
}

/// What an island's bilateral constraints hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Bilateral {
    /// Nothing: there are none.
    #[default]
    None,
    /// Strands, to each other, to rings or by a compliance.
    Strands,
    /// Some strand, to the world, rigidly.
    ToWorld,
}
