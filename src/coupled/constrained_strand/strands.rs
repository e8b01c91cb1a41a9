//! Constrained strands by their numbers, or one alone.

use std::ops::Index;

use super::ConstrainedStrand;

/// Constrained strands by their indices.
pub trait Strands: Index<usize, Output = ConstrainedStrand> {}

impl<S: Index<usize, Output = ConstrainedStrand> + ?Sized> Strands for S {}

/// The strand of an island that has no other, by whatever index.
#[derive(Debug)]
pub struct Solitary<'a>(pub &'a ConstrainedStrand);

impl Index<usize> for Solitary<'_> {
    type Output = ConstrainedStrand;
    #[inline(always)]
    fn index(&self, _: usize) -> &ConstrainedStrand {
        self.0
    }
}
