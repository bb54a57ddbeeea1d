use super::cells::{FilterCells, table_offset};
use crate::scene::{SceneError, number};
use std::fmt::Debug;

/// All that the renderer asks of a reconstruction filter along one axis, where it is symmetric and not normalised.
///
/// The types that implement it are listed at the head of this folder.
pub trait Kernel: Copy + Debug {
    /// Whether [`Self::offset`] inverts its CDF without a table.
    const HAS_CLOSED_FORM: bool = false;

    /// Where it ends, in pixels from the centre.
    fn radius(self) -> f64;

    /// Checks its parameters but the radius; `who` is the entity in messages.
    ///
    /// Errors: a number that is not accepted.
    fn check(self, _who: &str) -> Result<(), SceneError> {
        Ok(())
    }

    /// Its value at a distance of x pixels from the centre, for x from 0 up to the radius.
    fn value(self, x: f64) -> f64;

    /// A factor of all its values that costs something and does not depend on where they are.
    fn factor(self) -> f64 {
        1.0
    }

    /// Its value over that factor.
    #[inline(always)]
    fn value_over_factor(self, x: f64) -> f64 {
        self.value(x)
    }

    /// The signed area under it from the centre to x, for x from 0 to the radius.
    fn area(self, x: f64) -> f64;

    /// Where it changes sign from positive to negative, or its radius.
    fn sign_change(self) -> f64 {
        self.radius()
    }

    /// Samples its magnitude: maps u in [0, 1) to an offset from the centre, in pixels, and whether it is negative there.
    #[inline(always)]
    fn offset(self, u: f64, cells: &FilterCells) -> (f64, bool) {
        table_offset(u, cells)
    }
}

/// Checks a parameter of a filter against a range; `what` is its noun in messages.
pub(super) fn within(
    who: &str,
    field: &'static str,
    value: f64,
    [min, max]: [f64; 2],
    what: &str,
) -> Result<(), SceneError> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    let accepted = format!("it must be {what} from {} to {}", number(min), number(max));
    Err(SceneError::new(who, field, number(value), accepted))
}
