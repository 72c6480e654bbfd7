//! A hint to the processor, for arrays that are read out of order.

pub(crate) use crate::simd::prefetch_at;

/// Bytes of an array above which its entries are asked for in advance: as many as a cache near the processor has.
pub(crate) const CACHE_BYTES: usize = 1 << 20;

/// How many entries in advance to ask.
pub(crate) const AHEAD: usize = 24;

/// Asks for an entry that is going to be used soon; any index will do.
#[inline(always)]
pub(crate) fn prefetch<T>(array: &[T], at: usize) {
    prefetch_at(array.as_ptr().wrapping_add(at));
}
