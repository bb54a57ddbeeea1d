//! The elements of short arrays, one by one, and of a few lanes; and those of a whole slice at once.

/// What `[T; N]::map` does, for the short arrays that stages have by the thousand: coordinates, axes, corners, lanes.
/// The standard one goes through an iterator that frees what is left when the function panics: 220 lines of intermediate
/// code for each place that asks, a twentieth of the renderer's, and not inlined from one of the parts into which the
/// compiler divides a package into another.
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

/// The first elements of a slice, as many as there are lanes, each with its lane.
#[inline(always)]
pub(crate) fn by_lane<const N: usize, T: Copy>(of: &[T]) -> impl Iterator<Item = (usize, T)> {
    of[..of.len().min(N)].iter().enumerate().map(|(lane, &one)| (lane, one))
}

/// Sets all elements of a slice; `[T]::fill` is not inlined from one part of a package into another.
#[inline(always)]
pub(crate) fn set_all<T: Copy>(all: &mut [T], to: T) {
    for one in all {
        *one = to;
    }
}
