//! A hint to the processor, for arrays that are read out of order.

#![allow(unsafe_code)]

/// Bytes of an array above which its entries are asked for in advance: as many as a cache near the processor has.
pub(crate) const FAR: usize = 1 << 20;

/// How many entries in advance to ask.
pub(crate) const AHEAD: usize = 24;

/// Asks for an entry that is going to be used soon; any index will do.
#[inline(always)]
pub(crate) fn prefetch<T>(array: &[T], at: usize) {
    prefetch_at(array.as_ptr().wrapping_add(at));
}

/// Asks for what is at an address; any will do.
#[inline(always)]
pub(crate) fn prefetch_at<T>(address: *const T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a prefetch is a hint: it reads nothing that can be seen, and no address is wrong.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(address.cast()) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = address;
}
