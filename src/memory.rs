//! Fallible allocation: memory that grows with a host's numbers is reserved in advance, so that its lack is an error and not an
//! abort.

use crate::error::{Error, Result};

/// The most that an allocator adds to a block, approximately: glibc adds 8 to 24 bytes.
pub(crate) const BLOCK: usize = 32;

/// Capacity for exactly `count` more items.
pub(crate) fn reserve<T>(list: &mut Vec<T>, count: usize) -> Result<()> {
    list.try_reserve_exact(count).map_err(|_| Error::OutOfMemory { bytes: count.saturating_mul(size_of::<T>()) })
}

/// Capacity for `count` more items and, for a list that grows often, more than that.
pub(crate) fn grow<T>(list: &mut Vec<T>, count: usize) -> Result<()> {
    list.try_reserve(count).map_err(|_| Error::OutOfMemory { bytes: count.saturating_mul(size_of::<T>()) })
}

/// An empty list with exactly this capacity.
pub(crate) fn list<T>(capacity: usize) -> Result<Vec<T>> {
    let mut list = Vec::new();
    reserve(&mut list, capacity)?;
    Ok(list)
}

/// A list of the items of an iterator of known length.
pub(crate) fn collected<T>(items: impl ExactSizeIterator<Item = T>) -> Result<Vec<T>> {
    let mut all = list(items.len())?;
    all.extend(items);
    Ok(all)
}

/// A copy.
pub(crate) fn copied<T: Copy>(items: &[T]) -> Result<Vec<T>> {
    collected(items.iter().copied())
}

/// A list of `count` equal items.
pub(crate) fn repeated<T: Clone>(item: T, count: usize) -> Result<Vec<T>> {
    let mut all = list(count)?;
    all.resize(count, item);
    Ok(all)
}

/// An empty list that reuses another list's memory; their items must have the same layout. So a list of borrows can outlive them.
pub(crate) fn recycled<A, B>(mut list: Vec<A>) -> Vec<B> {
    list.clear();
    list.into_iter().map(|_| unreachable!("the list is empty")).collect()
}

/// Checks for that much memory, in blocks of any size: allocates all of it at once and frees it. Allocations of up to that sum by
/// the same thread then succeed, unless others take the memory meanwhile.
pub(crate) fn check_room(bytes: usize) -> Result<()> {
    list::<u8>(bytes).map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recycled_list_keeps_its_memory() {
        let text = String::from("borrowed");
        let list: Vec<&str> = vec![&text; 100];
        let (at, capacity) = (list.as_ptr().cast::<u8>(), list.capacity());
        let empty: Vec<&'static str> = recycled(list);
        assert!(empty.is_empty() && empty.as_ptr().cast() == at && empty.capacity() == capacity);
    }

    #[test]
    fn an_impossible_amount_of_memory_is_an_error() {
        assert_eq!(list::<u64>(usize::MAX / 8), Err(Error::OutOfMemory { bytes: usize::MAX / 8 * 8 }));
        assert!(check_room(isize::MAX as usize).is_err());
        assert_eq!(copied(&[1, 2, 3]), Ok(vec![1, 2, 3]));
        assert_eq!(repeated(7, 2), Ok(vec![7, 7]));
        assert_eq!(list::<u8>(10).expect("room").capacity(), 10);
    }
}
