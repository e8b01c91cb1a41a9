//! Identifiers that can be checked: a slot and the generation of what sits in it.

/// Names a strand of one solver. Zero bits is the null identifier; a removed strand's identifier never names another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct StrandId(u64);

impl StrandId {
    /// From the bits as the C ABI has them.
    pub fn from_bits(bits: u64) -> Self {
        Self(bits)
    }

    /// The bits as the C ABI has them.
    pub fn bits(self) -> u64 {
        self.0
    }
}
