//! Which of a strand's curvatures may change.

use crate::error::{Error, Result};

/// A set of freedoms. A curvature left out keeps its natural value and costs nothing in the solve.
///
/// ```
/// use superhelix::{Freedoms, StrandDef};
///
/// // Hair that bends and does not twist.
/// let freedoms = Freedoms::BEND1.union(Freedoms::BEND2);
/// assert_eq!(freedoms.count(), 2);
/// let strand = StrandDef { freedoms, ..StrandDef::straight(0.2, 5) };
/// strand.check("strand")?;
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Freedoms(u32);

impl Freedoms {
    /// Twist κ0.
    pub const TWIST: Freedoms = Freedoms(1);
    /// Curvature κ1 about n1.
    pub const BEND1: Freedoms = Freedoms(2);
    /// Curvature κ2 about n2.
    pub const BEND2: Freedoms = Freedoms(4);
    /// All three.
    pub const ALL: Freedoms = Freedoms(7);

    /// The set with these bits (1 twist, 2 bend1, 4 bend2).
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for an empty set or an unknown bit.
    pub fn from_bits(argument: &str, bits: u32) -> Result<Self> {
        if bits == 0 || bits > 7 {
            return Err(Error::invalid(argument, bits, "a non-empty set of twist (1), bend1 (2) and bend2 (4)"));
        }
        Ok(Self(bits))
    }

    /// The set's bits.
    pub fn bits(self) -> u32 {
        self.0
    }

    /// Both sets together.
    #[must_use]
    pub fn union(self, other: Freedoms) -> Freedoms {
        Freedoms(self.0 | other.0)
    }

    /// Whether curvature `axis` (0 twist, 1, 2) may change.
    pub fn contains(self, axis: usize) -> bool {
        self.0 & (1 << axis) != 0
    }

    /// How many there are, 1 to 3.
    pub fn count(self) -> usize {
        self.0.count_ones() as usize
    }

    /// The free axes in ascending order; the first [`Freedoms::count`] entries count.
    pub fn axes(self) -> [usize; 3] {
        let mut axes = [0; 3];
        let mut next = 0;
        for axis in 0..3 {
            if self.contains(axis) {
                axes[next] = axis;
                next += 1;
            }
        }
        axes
    }
}

impl Default for Freedoms {
    fn default() -> Self {
        Self::ALL
    }
}
