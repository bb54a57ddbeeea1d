//! Reconstruction filters: what a filter is, the filters there are, and how they are sampled.
//!
//! Reads: a filter as the scene describes it; uniform numbers in [0, 1).
//! Gives: offsets from a pixel's centre along one axis, in pixels, distributed as the filter's magnitude, and its sign.
//!
//! [`Kernel`] is all that the rest of the renderer asks of a filter; `with_filter` lists those that implement it, one
//! line each.
//! A further filter is a file of this folder, its lines here, and its variant of [`Filter`](crate::scene::Filter).

/// Evaluates an expression with `$kernel` as the filter's own type, so that no loop in it depends on which one it is.
///
/// The registered filters, one line each.
#[doc(hidden)]
#[macro_export]
macro_rules! with_filter {
    ($filter:expr, $kernel:ident => $result:expr) => {
        $crate::with_filter!($filter, $kernel => $result,
            Box { radius } as BoxKernel,
            Tent { radius } as TentKernel,
            Gaussian { radius, sigma } as GaussianKernel,
            Mitchell { radius, b, c } as MitchellKernel,
            BlackmanHarris { radius } as BlackmanHarrisKernel,
        )
    };
    (
        $filter:expr, $kernel:ident => $result:expr,
        $($variant:ident { $($field:ident),+ } as $type:ident,)+
    ) => {
        match $filter {
            $($crate::scene::Filter::$variant { $($field),+ } => {
                let $kernel = $crate::filters::$type { $($field),+ };
                $result
            })+
        }
    };
}
pub use crate::with_filter;

mod blackman_harris;
mod cells;
mod constant;
mod gaussian;
mod kernel;
mod mitchell;
mod registry;
mod tent;

pub use blackman_harris::BlackmanHarrisKernel;
pub use cells::{FilterCells, Span, table_offset};
pub use constant::{BoxKernel, box_offset};
pub use gaussian::GaussianKernel;
pub use kernel::Kernel;
pub use mitchell::MitchellKernel;
pub use registry::{
    cells_of, check_filter, filter_area, filter_factor, filter_value, radius_of, sign_change, value_over_factor,
};
pub use tent::{TentKernel, tent_offset};
