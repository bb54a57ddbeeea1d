use crate::extract::{FilterCells, Span};

// ANCHOR: box_offset
/// How far beside the pixel's centre a box of that radius puts a sample: a step of u is a step of the place.
#[inline(always)]
pub fn box_offset(u: f64, radius: f64) -> f64 {
    (2.0 * u - 1.0) * radius
}
// ANCHOR_END: box_offset

// ANCHOR: tent_offset
/// The same for a tent, whose area up to a place is a parabola on each side.
#[inline(always)]
pub fn tent_offset(u: f64, radius: f64) -> f64 {
    let side = 2.0 * u - 1.0;
    (radius * (1.0 - (1.0 - side.abs()).sqrt())).copysign(side)
}
// ANCHOR_END: tent_offset

// ANCHOR: table_offset
/// The same by a table of the area under |f| to one side of the centre, and whether f is negative there.
///
/// Within a cell of the table |f| is taken for a straight line: its area up to a place is a parabola, solved for the place
/// without cancellation.
#[inline(always)]
pub fn table_offset(u: f64, cells: &FilterCells) -> (f64, bool) {
    let side = 2.0 * u - 1.0;
    let area = side.abs();
    let mut at = usize::from(cells.first[(area * cells.cells.len() as f64) as usize]);
    while cells.cells[at].end <= area {
        at += 1;
    }
    let Span { start, share, x, width, slope, negative, .. } = cells.cells[at];
    let part = (area - start) * share;
    let along = part / (slope + (slope * slope + (1.0 - 2.0 * slope) * part).sqrt() + f64::MIN_POSITIVE);
    ((x + along * width).copysign(side), negative)
}
// ANCHOR_END: table_offset
