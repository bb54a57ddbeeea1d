//! What is made from the list of filters: which one a scene names is looked up here and nowhere else.

use super::cells::{FilterCells, Span};
use super::kernel::{Kernel, within};
use crate::each::Each;
use crate::scene::{Filter, SceneError};

/// Cells for each lobe of a filter's table.
///
/// With this many, the area under |f| up to a sampled position is accurate to 1e-6 of the whole, as a test measures.
const CELLS: usize = 192;

/// Checks a filter's parameters; `who` is the entity in messages.
///
/// Errors: a number that is not accepted.
pub fn check_filter(who: &str, filter: Filter) -> Result<(), SceneError> {
    within(who, "filter radius", radius_of(filter), [1.0 / 64.0, 64.0], "a number of pixels")?;
    with_filter!(filter, kernel => kernel.check(who))
}

/// The radius of a filter, in pixels.
pub fn radius_of(filter: Filter) -> f64 {
    with_filter!(filter, kernel => kernel.radius())
}

/// The value of a filter at a distance of x ≥ 0 pixels from the centre along one axis; it is not normalised.
pub fn filter_value(filter: Filter, x: f64) -> f64 {
    with_filter!(filter, kernel => if x >= kernel.radius() { 0.0 } else { kernel.value(x) })
}

/// The factor of all values of a filter that does not depend on where they are.
pub fn filter_factor(filter: Filter) -> f64 {
    with_filter!(filter, kernel => kernel.factor())
}

/// The value of a filter over its factor.
#[inline(always)]
pub fn value_over_factor(filter: Filter, x: f64) -> f64 {
    with_filter!(filter, kernel => if x >= kernel.radius() { 0.0 } else { kernel.value_over_factor(x) })
}

/// The signed area under a filter from the centre to x ≥ 0.
pub fn filter_area(filter: Filter, x: f64) -> f64 {
    with_filter!(filter, kernel => kernel.area(x.min(kernel.radius())))
}

/// Where a filter changes sign from positive to negative, or its radius.
pub fn sign_change(filter: Filter) -> f64 {
    with_filter!(filter, kernel => kernel.sign_change())
}

/// The table of a filter; empty where none is needed.
pub fn cells_of(filter: Filter) -> FilterCells {
    with_filter!(filter, kernel => tabulated(kernel))
}

fn tabulated<K: Kernel>(kernel: K) -> FilterCells {
    if K::HAS_CLOSED_FORM {
        return FilterCells::default();
    }
    let (turn, radius) = (kernel.sign_change(), kernel.radius());
    let value = |x: f64| if x >= radius { 0.0 } else { kernel.value(x) };
    let positive = kernel.area(turn);
    let whole = positive + (kernel.area(radius) - positive).abs();
    let mut cells = Vec::new();
    for (from, to, negative) in [(0.0, turn, false), (turn, radius, true)] {
        let width = (to - from) / CELLS as f64;
        let before = if negative { positive } else { 0.0 };
        let area = |x: f64| (before + (kernel.area(x) - before).abs()) / whole;
        for cell in (0..CELLS).filter(|_| width > 0.0) {
            let x = from + cell as f64 * width;
            let ends = [x, from + (cell + 1) as f64 * width];
            let [start, end] = ends.each(area);
            let [first, last] = ends.each(|x| value(x).abs());
            let slope = first / (first + last);
            cells.push(Span { start, end, per_area: 1.0 / (end - start), x, width, slope, negative });
        }
    }
    if let Some(last) = cells.last_mut() {
        last.end = 2.0;
    }
    // So many that a step seldom has the end of a cell in it, and a power of two, so that no product is rounded.
    let steps = (16 * cells.len()).next_power_of_two();
    let first = |step: usize| cells.partition_point(|cell| cell.end <= step as f64 / steps as f64) as u16;
    FilterCells { first: (0..=steps).map(first).collect(), cells }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every area against a sum of a hundred thousand thin strips.
    #[test]
    fn areas_are_those_under_the_filters() {
        let odd = [
            Filter::Gaussian { radius: 3.0, sigma: 0.4 },
            Filter::Mitchell { radius: 2.0, b: 0.0, c: 0.5 },
            Filter::Mitchell { radius: 1.0, b: 1.0, c: 0.0 },
        ];
        for filter in Filter::ALL.map(|(_, filter)| filter).into_iter().chain(odd) {
            const STRIPS: usize = 100_000;
            let radius = radius_of(filter);
            let width = radius / STRIPS as f64;
            let (mut sum, mut worst) = (0.0, 0.0_f64);
            for strip in 0..STRIPS {
                sum += filter_value(filter, (strip as f64 + 0.5) * width) * width;
                worst = worst.max((filter_area(filter, (strip + 1) as f64 * width) - sum).abs());
            }
            assert!(worst < 1e-9 * radius, "{filter:?}: area off by {worst:e}");
        }
        assert!((2.0 * filter_area(Filter::MITCHELL, 2.0) - 1.0).abs() < 1e-15, "Mitchell's filter is normalised");
    }

    /// The sign of a filter changes where it should, and only there.
    #[test]
    fn filters_change_sign_where_they_should() {
        for (b, c) in [(1.0 / 3.0, 1.0 / 3.0), (0.0, 0.5), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.1)] {
            let filter = Filter::Mitchell { radius: 2.0, b, c };
            let turn = sign_change(filter);
            for step in 1..2000 {
                let x = f64::from(step) / 1000.0;
                let value = filter_value(filter, x);
                let right = if x < turn { value >= -1e-12 } else { value <= 1e-12 };
                assert!(right, "B = {b}, C = {c}: f({x}) = {value:e}, but the sign changes at {turn}");
            }
            assert_eq!(filter.is_signed(), c > 0.0);
        }
    }
}
