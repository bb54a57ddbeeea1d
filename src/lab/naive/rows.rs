//! One piece of work written several ways: rays from points of a lens to a ball, row by row, in columns, fused, by lists.
//!
//! Reads: two numbers of the lens and the point in focus of each row. Gives: the distance to the ball, in camera space.
//! It is what three of the renderer's stages do, on two pages of code, so that nothing but the arrangement differs.

use pinhole::sample::circle_point;
use std::f64::consts::TAU;

/// The distance of the ball's centre, straight ahead, from the lens, and the ball's radius.
const BALL: [f64; 2] = [5.0, 1.0];
/// The lens's radius.
const LENS: f64 = 0.1;
/// The rows of a block.
pub const BLOCK: usize = 16;

/// What is known of one ray: two random numbers, and where the plane of focus is crossed, at distance 1.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Of the area of the lens, and of a turn.
    pub u: [f64; 2],
    /// The point in focus.
    pub focus: [f64; 2],
}

// ANCHOR: row_by_row
/// The distance to the ball along a ray, or infinity; `circle` gives the point of the circle at a fraction of a turn.
#[inline(always)]
pub fn ray([u, v]: [f64; 2], [x, y]: [f64; 2], circle: impl Fn(f64) -> [f64; 2]) -> f64 {
    let (radius, [cosine, sine]) = (LENS * u.sqrt(), circle(v));
    let [x0, y0] = [radius * cosine, radius * sine];
    let (dx, dy) = (x - x0, y - y0);
    let length = (dx * dx + dy * dy + 1.0).sqrt();
    let along = (BALL[0] - x0 * dx - y0 * dy) / length;
    let square = BALL[1] * BALL[1] - (x0 * x0 + y0 * y0 + BALL[0] * BALL[0] - along * along);
    if square < 0.0 {
        return f64::INFINITY;
    }
    along - square.sqrt()
}

/// All of one row, and then the next.
#[inline(always)]
pub fn row_by_row(samples: &[Sample], circle: impl Fn(f64) -> [f64; 2], t: &mut [f64]) {
    for (sample, t) in samples.iter().zip(t) {
        *t = ray(sample.u, sample.focus, &circle);
    }
}

/// The point of the circle from a library's sine and cosine.
#[inline(always)]
pub fn circle_by_library(turn: f64) -> [f64; 2] {
    let (sine, cosine) = libm::sincos(TAU * turn);
    [cosine, sine]
}
// ANCHOR_END: row_by_row

/// The same rows, number by number, and what two of the three steps leave for the next.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    /// What is given: two random numbers, and the point in focus.
    pub given: [Vec<f64>; 4],
    /// Points of the lens.
    pub lens: [Vec<f64>; 2],
    /// Directions, not of length 1, and their length.
    pub direction: [Vec<f64>; 3],
    /// The distance to the ball, or infinity.
    pub t: Vec<f64>,
}

impl Columns {
    /// The columns of these samples.
    pub fn of(samples: &[Sample]) -> Self {
        let column = |of: fn(&Sample) -> f64| samples.iter().map(of).collect();
        let room = || vec![0.0; samples.len()];
        Self {
            given: [
                column(|one| one.u[0]),
                column(|one| one.u[1]),
                column(|one| one.focus[0]),
                column(|one| one.focus[1]),
            ],
            lens: [room(), room()],
            direction: [room(), room(), room()],
            t: room(),
        }
    }
}

// ANCHOR: lens_points
/// Points of the lens.
#[inline(always)]
pub fn lens_points([u, v]: [&[f64]; 2], [x, y]: [&mut [f64]; 2]) {
    let rows = u.len();
    let (v, x, y) = (&v[..rows], &mut x[..rows], &mut y[..rows]);
    for row in 0..rows {
        let (radius, [cosine, sine]) = (LENS * u[row].sqrt(), circle_point(v[row]));
        (x[row], y[row]) = (radius * cosine, radius * sine);
    }
}
// ANCHOR_END: lens_points

// ANCHOR: in_columns
/// Directions from there to the points in focus, and their lengths.
#[inline(always)]
pub fn directions([x0, y0]: [&[f64]; 2], [x, y]: [&[f64]; 2], [dx, dy, length]: [&mut [f64]; 3]) {
    let rows = x.len();
    let (x0, y0, y) = (&x0[..rows], &y0[..rows], &y[..rows]);
    let (dx, dy, length) = (&mut dx[..rows], &mut dy[..rows], &mut length[..rows]);
    for row in 0..rows {
        (dx[row], dy[row]) = (x[row] - x0[row], y[row] - y0[row]);
        length[row] = (dx[row] * dx[row] + dy[row] * dy[row] + 1.0).sqrt();
    }
}

/// Distances to the ball. What misses it is computed like all others, and thrown away.
#[inline(always)]
pub fn distances([x0, y0]: [&[f64]; 2], [dx, dy, length]: [&[f64]; 3], t: &mut [f64]) {
    let rows = t.len();
    let (x0, y0, dx, dy, length) = (&x0[..rows], &y0[..rows], &dx[..rows], &dy[..rows], &length[..rows]);
    for row in 0..rows {
        let along = (BALL[0] - x0[row] * dx[row] - y0[row] * dy[row]) / length[row];
        let square = BALL[1] * BALL[1] - (x0[row] * x0[row] + y0[row] * y0[row] + BALL[0] * BALL[0] - along * along);
        let near = along - square.sqrt();
        t[row] = if square < 0.0 { f64::INFINITY } else { near };
    }
}

/// All rows of one step, and then the next step.
#[inline(always)]
pub fn in_columns(columns: &mut Columns) {
    let [u, v, x, y] = columns.given.each_ref().map(Vec::as_slice);
    lens_points([u, v], columns.lens.each_mut().map(Vec::as_mut_slice));
    let lens = columns.lens.each_ref().map(Vec::as_slice);
    directions(lens, [x, y], columns.direction.each_mut().map(Vec::as_mut_slice));
    distances(lens, columns.direction.each_ref().map(Vec::as_slice), &mut columns.t);
}
// ANCHOR_END: in_columns

// ANCHOR: fused
/// All steps of sixteen rows, and then the next sixteen: what lies between the steps stays in registers.
#[inline(always)]
pub fn fused([u, v, x, y]: [&[f64]; 4], t: &mut [f64]) {
    let (numbers, places) = (u.chunks(BLOCK).zip(v.chunks(BLOCK)), x.chunks(BLOCK).zip(y.chunks(BLOCK)));
    for (((u, v), (x, y)), t) in numbers.zip(places).zip(t.chunks_mut(BLOCK)) {
        let (mut lens, mut direction) = ([[0.0; BLOCK]; 2], [[0.0; BLOCK]; 3]);
        lens_points([u, v], lens.each_mut().map(|column| &mut column[..]));
        let lens = lens.each_ref().map(|column| &column[..]);
        directions(lens, [x, y], direction.each_mut().map(|column| &mut column[..]));
        distances(lens, direction.each_ref().map(|column| &column[..]), t);
    }
}
// ANCHOR_END: fused

/// Rows of two kinds as they come: those of kind 1 ask the library.
#[inline(always)]
pub fn as_they_come(samples: &[Sample], kinds: &[u32], t: &mut [f64]) {
    for ((sample, kind), t) in samples.iter().zip(kinds).zip(t) {
        *t = ray(sample.u, sample.focus, |turn| if *kind == 0 { circle_point(turn) } else { circle_by_library(turn) });
    }
}

// ANCHOR: list_rows
/// The rows of a kind, listed without a branch; says how many there are.
#[inline(always)]
pub fn list_rows(kinds: &[u32], kind: u32, list: &mut [u32]) -> usize {
    let mut count = 0;
    for (row, of) in kinds.iter().enumerate() {
        list[count] = row as u32;
        count += usize::from(*of == kind);
    }
    count
}
// ANCHOR_END: list_rows

// ANCHOR: listed
/// Rows of two kinds, first those of the one, sixteen at a time, and then those of the other.
#[inline(always)]
pub fn listed(given: [&[f64]; 4], kinds: &[u32], list: &mut [u32], t: &mut [f64]) {
    let count = list_rows(kinds, 0, list);
    for rows in list[..count].chunks(BLOCK) {
        let (mut block, mut found) = ([[0.0; BLOCK]; 4], [0.0; BLOCK]);
        for (lane, &row) in rows.iter().enumerate() {
            (0..4).for_each(|part| block[part][lane] = given[part][row as usize]);
        }
        fused(block.each_ref().map(|column| &column[..]), &mut found);
        for (&row, found) in rows.iter().zip(found) {
            t[row as usize] = found;
        }
    }
    let count = list_rows(kinds, 1, list);
    for &row in &list[..count] {
        let [u, v, x, y] = given.map(|column| column[row as usize]);
        t[row as usize] = ray([u, v], [x, y], circle_by_library);
    }
}
// ANCHOR_END: listed

// ANCHOR: circle_in_f32
/// The point of the unit circle in f32: the same quarter, and half the terms.
#[inline(always)]
pub fn circle_in_f32(turn: f32) -> [f32; 2] {
    const NO_PLACES: f32 = 1.5 * (1_u32 << 23) as f32;
    let shifted = 4.0 * turn + NO_PLACES;
    let quarter = shifted.to_bits();
    let x = (turn - 0.25 * (shifted - NO_PLACES)) * std::f32::consts::TAU;
    let y = -x * x;
    let sine = x + x * y * (1.0 / 6.0 + y * (1.0 / 120.0 + y * (1.0 / 5040.0 + y * (1.0 / 362_880.0))));
    let cosine = 1.0 + y * (1.0 / 2.0 + y * (1.0 / 24.0 + y * (1.0 / 720.0 + y * (1.0 / 40320.0))));
    let (across, up) = if quarter & 1 != 0 { (sine, cosine) } else { (cosine, sine) };
    let across = if (quarter ^ (quarter >> 1)) & 1 != 0 { -across } else { across };
    [across, if quarter & 2 != 0 { -up } else { up }]
}
// ANCHOR_END: circle_in_f32

/// Cosine and sine of an angle by this many terms of each series.
#[must_use]
pub fn series(x: f64, terms: u32) -> [f64; 2] {
    let (mut sums, mut term) = ([0.0, 0.0], 1.0);
    for power in 0..2 * terms {
        sums[power as usize % 2] += if power % 4 < 2 { term } else { -term };
        term *= x / f64::from(power + 1);
    }
    sums
}

/// The point of the circle by this many terms, from the nearest quarter of a turn.
#[must_use]
pub fn circle_by_terms(turn: f64, terms: u32) -> [f64; 2] {
    let quarter = libm::round(4.0 * turn);
    turned_by_quarters(quarter as u32, series((turn - 0.25 * quarter) * TAU, terms))
}

/// A point turned on by so many quarters of a turn.
#[must_use]
pub fn turned_by_quarters(quarters: u32, [x, y]: [f64; 2]) -> [f64; 2] {
    match quarters & 3 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    fn samples(rows: usize) -> Vec<Sample> {
        let mut draws = Draws::new(3701, 0);
        let mut one = || Sample {
            u: [draws.unit(), draws.unit()],
            focus: [draws.between(-0.25, 0.25), draws.between(-0.25, 0.25)],
        };
        (0..rows).map(|_| one()).collect()
    }

    /// Of any number of rows, those of no whole block too.
    #[test]
    fn every_way_gives_the_same_bits() {
        let (mut rows, mut hits) = (0, 0);
        for count in [0, 1, 15, 16, 17, 1000, 4096] {
            let (samples, kinds) = (samples(count), (0..count as u32).map(|row| u32::from(row * row % 7 == 1)));
            let (kinds, mut columns): (Vec<u32>, _) = (kinds.collect(), Columns::of(&samples));
            let [mut by_row, mut in_blocks, mut mixed, mut by_lists] = [(); 4].map(|()| vec![0.0; count]);
            row_by_row(&samples, circle_point, &mut by_row);
            in_columns(&mut columns);
            let given = columns.given.each_ref().map(Vec::as_slice);
            fused(given, &mut in_blocks);
            as_they_come(&samples, &kinds, &mut mixed);
            listed(given, &kinds, &mut vec![0; count], &mut by_lists);
            let bits = |t: &[f64]| t.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&by_row), bits(&columns.t), "{count} rows in columns");
            assert_eq!(bits(&by_row), bits(&in_blocks), "{count} rows in blocks");
            assert_eq!(bits(&mixed), bits(&by_lists), "{count} rows of two kinds");
            (rows, hits) = (rows + count, hits + by_row.iter().filter(|t| **t < f64::INFINITY).count());
        }
        eprintln!("rows: {rows} rows, {hits} hits, 0 differ");
        assert!(hits > rows / 4 && hits < rows);
    }

    #[test]
    fn the_ball_is_where_a_quadratic_finds_it() {
        let (samples, mut worst) = (samples(20_000), 0.0_f64);
        let mut t = vec![0.0; samples.len()];
        row_by_row(&samples, circle_by_library, &mut t);
        for (sample, t) in samples.iter().zip(t).filter(|(_, t)| *t < f64::INFINITY) {
            let [cosine, sine] = circle_by_library(sample.u[1]);
            let origin = [LENS * sample.u[0].sqrt() * cosine, LENS * sample.u[0].sqrt() * sine, 0.0];
            let to = [sample.focus[0] - origin[0], sample.focus[1] - origin[1], 1.0];
            let length = to.iter().map(|part| part * part).sum::<f64>().sqrt();
            let at = [0, 1, 2].map(|axis| origin[axis] + t * to[axis] / length);
            let apart = (at[0] * at[0] + at[1] * at[1] + (at[2] - BALL[0]) * (at[2] - BALL[0])).sqrt();
            worst = worst.max((apart - BALL[1]).abs());
        }
        assert!(worst < 1e-12, "{worst}");
    }

    #[test]
    fn half_the_terms_are_enough_for_f32() {
        let (mut worst, mut terms) = (0.0_f64, 0.0_f64);
        for step in 0..1_u32 << 16 {
            let turn = step as f32 / 65_536.0;
            let [right, half, few] =
                [circle_point(turn.into()), circle_in_f32(turn).map(f64::from), circle_by_terms(turn.into(), 8)];
            for part in 0..2 {
                worst = worst.max((half[part] - right[part]).abs());
                terms = terms.max((few[part] - right[part]).abs());
            }
        }
        eprintln!(
            "circle in f32: 65536 points, worst {:.2} · 2⁻²⁴; by 8 terms in f64, {terms:.1e}",
            worst * 16_777_216.0
        );
        assert!(worst * 16_777_216.0 < 3.0 && terms < 2e-15, "{worst} {terms}");
    }
}
