//! The elements of short arrays, one by one, and of a few lanes; and those of a whole column at once.
//!
//! What the standard library has for it is not inlined from one of the parts into which the compiler divides a package into
//! another: in a kernel each call of it would be one, of a function compiled for the oldest processors.

use std::ops::Range;

/// What `[T; N]::map` does, for the short arrays that stages have by the thousand: coordinates, axes, corners, lanes.
/// The standard one goes through an iterator that frees what is left when the function panics: 220 lines of intermediate
/// code for each place that asks, a twentieth of the renderer's.
pub(crate) trait Each: Sized {
    /// What the array is made of.
    type Element;
    /// An array of the same length, of something else.
    type Of<U>;

    /// The array of what `of` makes of each element, first to last.
    fn each<U>(self, of: impl FnMut(Self::Element) -> U) -> Self::Of<U>;
}

macro_rules! each_of {
    ($length:literal: $($element:ident)+) => {
        impl<T> Each for [T; $length] {
            type Element = T;
            type Of<U> = [U; $length];

            #[inline(always)]
            fn each<U>(self, mut of: impl FnMut(T) -> U) -> [U; $length] {
                let [$($element),+] = self;
                [$(of($element)),+]
            }
        }
    };
}

each_of!(2: a b);
each_of!(3: a b c);
each_of!(4: a b c d);
each_of!(8: a b c d e f g h);

/// A number for each of a few lanes, which is one instruction for all of them where there is one.
#[inline(always)]
pub(crate) fn lanes<T: Copy + Default, const N: usize>(of: impl Fn(usize) -> T) -> [T; N] {
    let mut all = [T::default(); N];
    for lane in 0..N {
        all[lane] = of(lane);
    }
    all
}

/// The first elements of a slice, as many as there are lanes; what is given beyond the last one.
///
/// Of a whole block the number is known when this is compiled, so that it is a few instructions and not a loop. It is a
/// value of its own, since lanes that are filled with something else before are copied from a constant, by a call.
#[inline(always)]
pub(crate) fn lanes_of<T: Copy, U: Copy + From<T>, const N: usize>(from: &[T], beyond: U) -> [U; N] {
    let mut all = [beyond; N];
    if let Some(from) = from.first_chunk::<N>() {
        for lane in 0..N {
            all[lane] = from[lane].into();
        }
    } else {
        for (lane, from) in by_lane::<N, _>(from) {
            all[lane] = from.into();
        }
    }
    all
}

/// The same for the components of three axes.
#[inline(always)]
pub(crate) fn vectors_of<T: Copy, U: Copy + From<T>, const N: usize>([x, y, z]: [&[T]; 3], beyond: U) -> [[U; N]; 3] {
    [lanes_of(x, beyond), lanes_of(y, beyond), lanes_of(z, beyond)]
}

/// Some rows of the components of three axes.
#[inline(always)]
pub(crate) fn rows_of<T>([x, y, z]: [&[T]; 3], rows: Range<usize>) -> [&[T]; 3] {
    [&x[rows.clone()], &y[rows.clone()], &z[rows]]
}

/// Writes the first lanes, as many as there are elements.
#[inline(always)]
pub(crate) fn put_lanes<T: Copy, const N: usize>(to: &mut [T], from: &[T; N]) {
    if let Some(to) = to.first_chunk_mut::<N>() {
        *to = *from;
    } else {
        let count = to.len();
        to.copy_from_slice(&from[..count]);
    }
}

/// The elements at so many places of a slice; beyond its end the last one, so that no branch leaves the loop: one
/// instruction for several of them where there is one.
#[inline(always)]
pub(crate) fn gathered<T: Copy + Default, const N: usize>(of: &[T], places: &[u32; N]) -> [T; N] {
    let mut all = [T::default(); N];
    if let Some(last) = of.len().checked_sub(1) {
        // Written out, since the compiler makes sixteen loads of a closure's.
        for lane in 0..N {
            all[lane] = of[last.min(places[lane] as usize)];
        }
    }
    all
}

/// The first elements of a slice, as many as there are lanes, each with its lane.
#[inline(always)]
pub(crate) fn by_lane<const N: usize, T: Copy>(of: &[T]) -> impl Iterator<Item = (usize, T)> {
    of[..of.len().min(N)].iter().enumerate().map(|(lane, &one)| (lane, one))
}

/// Sets all elements of a slice, which is what `[T]::fill` does.
#[inline(always)]
pub(crate) fn set_all<T: Copy>(all: &mut [T], to: T) {
    for one in all {
        *one = to;
    }
}

/// Makes a column as long as there are rows, where all new ones are the same, by one instruction for many; `Vec::resize`
/// is one function for whatever may be new, and writes it one by one.
#[inline(always)]
pub(crate) fn set_length<T>(column: &mut Vec<T>, rows: usize, new: impl Fn() -> T) {
    column.resize_with(rows, new);
}

/// Lists the rows that count: every one is written, and the next overwrites it unless it counts (stream compaction), so
/// that no branch depends on what a row is. Closures that say which had best own what they read: what is lent to them is
/// looked up for each row.
#[inline(always)]
pub(crate) fn list_those(rows: impl ExactSizeIterator<Item = (u32, bool)>, list: &mut Vec<u32>) {
    set_length(list, rows.len(), || 0);
    let (own, mut length) = (&mut list[..], 0);
    for (row, counts) in rows {
        own[length] = row;
        length += usize::from(counts);
    }
    list.truncate(length);
}

/// Whether all of three numbers are this one; the equality of arrays is a loop.
#[inline(always)]
pub(crate) fn all_are([a, b, c]: [f64; 3], one: f64) -> bool {
    (a == one) & (b == one) & (c == one)
}
