use super::camera_entity::camera_of;
use super::check::{kind_and_name, number};
use crate::plan::{Census, Table};
use crate::scene::{Filter, Sampling, SceneError};
use bevy_ecs::prelude::*;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Cells for each lobe of a filter's table.
///
/// With this many, the area under |f| up to a sampled position is accurate to 1e-6 of the whole, as a test measures.
const CELLS: usize = 192;

/// The reconstruction filter, by which samples are distributed about a pixel's centre.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilterTable {
    /// The filter as the author wrote it.
    pub filter: Filter,
    /// Its table, where its sampling has no closed form; otherwise empty.
    pub cells: FilterCells,
}

/// The area under |f| from the pixel's centre to one side, divided into cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilterCells {
    /// For equal steps of the area, the first cell that ends beyond the step.
    pub first: Vec<u16>,
    /// The cells, from the centre outwards.
    pub cells: Vec<Span>,
}

/// A cell of a filter's table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The area before it, as a fraction of the whole.
    pub start: f64,
    /// The area at its end; that of the last cell is beyond the whole.
    pub end: f64,
    /// The reciprocal of its own area.
    pub per_area: f64,
    /// Where it begins, in pixels from the centre.
    pub x: f64,
    /// Its width, in pixels.
    pub width: f64,
    /// |f| at its beginning, as a fraction of the sum of |f| at both ends: 1/2 where |f| is constant.
    pub slope: f64,
    /// Whether f is negative in it.
    pub negative: bool,
}

impl Table for FilterTable {
    const NAME: &'static str = "filter";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let camera = camera_of(scene)?;
        let Some(&Sampling { filter, .. }) = scene.get::<Sampling>(camera) else { return Ok(Self::default()) };
        check(&kind_and_name(scene, "camera", camera), filter)?;
        Ok(Self { filter, cells: FilterCells::of(filter) })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&self.cells.first[..]) + size_of_val(&self.cells.cells[..])
    }
}

fn check(who: &str, filter: Filter) -> Result<(), SceneError> {
    let within = |field: &'static str, value: f64, least: f64, most: f64, what: &str| {
        let accepted = format!("it must be {what} from {} to {}", number(least), number(most));
        let refused = || SceneError::new(who, field, number(value), accepted);
        if (least..=most).contains(&value) { Ok(()) } else { Err(refused()) }
    };
    within("filter radius", radius_of(filter), 1.0 / 64.0, 64.0, "a number of pixels")?;
    match filter {
        Filter::Gaussian { radius, sigma } => {
            within("filter sigma", sigma, radius / 8.0, radius * 8.0, "a number of pixels that fits the radius,")
        }
        Filter::Mitchell { b, c, .. } => {
            within("filter b", b, 0.0, 1.0, "a number")?;
            within("filter c", c, 0.0, 1.0, "a number")
        }
        Filter::Box { .. } | Filter::Tent { .. } | Filter::BlackmanHarris { .. } => Ok(()),
    }
}

/// The radius of a filter, in pixels.
pub fn radius_of(filter: Filter) -> f64 {
    match filter {
        Filter::Box { radius }
        | Filter::Tent { radius }
        | Filter::Gaussian { radius, .. }
        | Filter::Mitchell { radius, .. }
        | Filter::BlackmanHarris { radius } => radius,
    }
}

/// The value of a filter at a distance of x ≥ 0 pixels from the centre along one axis; it is not normalised.
pub fn filter_value(filter: Filter, x: f64) -> f64 {
    if x >= radius_of(filter) {
        return 0.0;
    }
    match filter {
        Filter::Box { .. } => 1.0,
        Filter::Tent { radius } => 1.0 - x / radius,
        Filter::Gaussian { radius, sigma } => {
            let bell = |x: f64| -x * x / (2.0 * sigma * sigma);
            libm::exp(bell(radius)) * libm::expm1(bell(x) - bell(radius))
        }
        Filter::Mitchell { radius, b, c } => {
            let [near, far] = mitchell(b, c);
            let t = 2.0 * x / radius;
            let [a0, a1, a2, a3] = if t < 1.0 { near } else { far };
            a0 + t * (a1 + t * (a2 + t * a3))
        }
        Filter::BlackmanHarris { radius } => {
            let wave = |k: f64| libm::cos(k * PI * x / radius);
            HARRIS[0] + HARRIS[1] * wave(1.0) + HARRIS[2] * wave(2.0) + HARRIS[3] * wave(3.0)
        }
    }
}

/// The four coefficients of the window (Blackman–Harris, minimum 4-term; Harris 1978).
const HARRIS: [f64; 4] = [0.35875, 0.48829, 0.14128, 0.01168];

/// The coefficients of Mitchell and Netravali's two cubics, constant term first: for x up to 1, and from 1 to 2.
fn mitchell(b: f64, c: f64) -> [[f64; 4]; 2] {
    let near = [6.0 - 2.0 * b, 0.0, -18.0 + 12.0 * b + 6.0 * c, 12.0 - 9.0 * b - 6.0 * c];
    let far = [8.0 * b + 24.0 * c, -12.0 * b - 48.0 * c, 6.0 * b + 30.0 * c, -b - 6.0 * c];
    [near, far].map(|cubic| cubic.map(|part| part / 6.0))
}

/// The signed area under a filter from the centre to x ≥ 0.
pub fn filter_area(filter: Filter, x: f64) -> f64 {
    let x = x.min(radius_of(filter));
    match filter {
        Filter::Box { .. } => x,
        Filter::Tent { radius } => x * (1.0 - x / (2.0 * radius)),
        Filter::Gaussian { radius, sigma } => {
            let edge = libm::exp(-radius * radius / (2.0 * sigma * sigma));
            sigma * (PI / 2.0).sqrt() * libm::erf(x / sigma * FRAC_1_SQRT_2) - x * edge
        }
        Filter::Mitchell { radius, b, c } => {
            let [near, far] = mitchell(b, c);
            let up_to = |[a0, a1, a2, a3]: [f64; 4], t: f64| t * (a0 + t * (a1 / 2.0 + t * (a2 / 3.0 + t * a3 / 4.0)));
            let t = 2.0 * x / radius;
            let area = if t < 1.0 { up_to(near, t) } else { up_to(near, 1.0) + up_to(far, t) - up_to(far, 1.0) };
            area * radius / 2.0
        }
        Filter::BlackmanHarris { radius } => {
            let wave = |k: f64| radius / (k * PI) * libm::sin(k * PI * x / radius);
            HARRIS[0] * x + HARRIS[1] * wave(1.0) + HARRIS[2] * wave(2.0) + HARRIS[3] * wave(3.0)
        }
    }
}

/// Where a filter changes sign from positive to negative, or its radius.
///
/// The outer cubic is (2 − t)² (b(2 − t) − 6c(t − 1)) / 6.
pub fn sign_change(filter: Filter) -> f64 {
    match filter {
        Filter::Mitchell { radius, b, c } if c > 0.0 => radius / 2.0 * (2.0 * b + 6.0 * c) / (b + 6.0 * c),
        _ => radius_of(filter),
    }
}

impl FilterCells {
    /// The table of a filter; empty where none is needed.
    pub fn of(filter: Filter) -> Self {
        if matches!(filter, Filter::Box { .. } | Filter::Tent { .. }) {
            return Self::default();
        }
        let (turn, radius) = (sign_change(filter), radius_of(filter));
        let positive = filter_area(filter, turn);
        let whole = positive + (filter_area(filter, radius) - positive).abs();
        let mut cells = Vec::new();
        for (from, to, negative) in [(0.0, turn, false), (turn, radius, true)] {
            let width = (to - from) / CELLS as f64;
            let before = if negative { positive } else { 0.0 };
            let area = |x: f64| (before + (filter_area(filter, x) - before).abs()) / whole;
            for cell in (0..CELLS).filter(|_| width > 0.0) {
                let x = from + cell as f64 * width;
                let ends = [x, from + (cell + 1) as f64 * width];
                let [start, end] = ends.map(area);
                let [first, last] = ends.map(|x| filter_value(filter, x).abs());
                let slope = first / (first + last);
                cells.push(Span { start, end, per_area: 1.0 / (end - start), x, width, slope, negative });
            }
        }
        if let Some(last) = cells.last_mut() {
            last.end = 2.0;
        }
        let steps = cells.len();
        let first = |step: usize| cells.partition_point(|cell| cell.end <= step as f64 / steps as f64) as u16;
        Self { first: (0..=steps).map(first).collect(), cells }
    }
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
