//! Where the iteration of an island is.

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
}

impl Phase {
    /// Whether its tolerance is the rough one.
    pub fn is_rough(self) -> bool {
        matches!(self, Self::Rough | Self::RoughEnded)
    }

    /// Whether it has ended.
    pub fn has_ended(self) -> bool {
        matches!(self, Self::RoughEnded | Self::Ended)
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
