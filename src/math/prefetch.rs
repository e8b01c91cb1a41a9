//! Memory prefetch: strands are scattered in memory, and waiting for each in turn takes longer than the work on it.

/// Bytes of a cache line.
#[cfg(target_arch = "x86_64")]
const LINE: usize = 64;

/// Prefetches a value's memory. Affects speed only.
#[inline(always)]
#[cfg_attr(target_arch = "x86_64", allow(unsafe_code))]
pub(crate) fn prefetch<T: ?Sized>(value: &T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let begin: *const i8 = std::ptr::from_ref(value).cast();
        let bytes = size_of_val(value);
        let mut offset = 0;
        while offset < bytes {
            // SAFETY: a hint, which faults at no address.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(begin.wrapping_add(offset)) };
            offset += LINE;
        }
        if bytes > 0 {
            // SAFETY: the same. The last byte may lie in one more line.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(begin.wrapping_add(bytes - 1)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = value;
}
