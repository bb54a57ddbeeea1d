use super::{SurfaceColours, TexturePoint, TexturePoints};
use crate::extract::{CheckerTable, NO_TEXTURE, StripesTable, TwoColours, texture_of_kind};
use crate::intersect::{MaterialRows, Surfaces};
use crate::plan::{Shared, Stage, TileSystems};
use crate::scene::{Checker, Stripes};
use bevy_ecs::prelude::*;

// ANCHOR: wave
/// 1 where x lies in an even cell, −1 in an odd one.
#[inline(always)]
pub fn wave(x: f64) -> f64 {
    if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 }
}
// ANCHOR_END: wave

// ANCHOR: wave_mean
/// The area under `wave` from 0 to x: it rises to 1 over every even cell and falls back to 0 over every odd one.
#[inline(always)]
fn wave_area(x: f64) -> f64 {
    1.0 - (x.rem_euclid(2.0) - 1.0).abs()
}

/// The mean of `wave` over a range of this width about x.
///
/// Within a cell it is the wave itself, also where the width is 0; over a range without end it is 0.
#[inline(always)]
pub fn wave_mean(x: f64, width: f64) -> f64 {
    let (low, high) = (x - 0.5 * width, x + 0.5 * width);
    if !(high - low < f64::INFINITY) {
        0.0
    } else if low.floor() == high.floor() {
        wave(x)
    } else {
        ((wave_area(high) - wave_area(low)) / width).clamp(-1.0, 1.0)
    }
}
// ANCHOR_END: wave_mean

// ANCHOR: box_width
/// The width of the range whose numbers spread as much as those in a pixel do, where they change by `right` and `down`
/// from one pixel to the next.
///
/// Numbers spread evenly over a range of width w have the variance w² / 12; those of a pixel are the sum of two such.
#[inline(always)]
pub fn box_width(right: f64, down: f64) -> f64 {
    (right * right + down * down).sqrt()
}
// ANCHOR_END: box_width

// ANCHOR: checker_share
/// The share of the first colour in what a pixel covers of a checker.
///
/// The colour is the first where an even number of the three coordinates lie in odd cells, so it is a product of three
/// waves; and the mean of a product over a box is the product of the means.
pub fn checker_share(at: &TexturePoint) -> f64 {
    let [right, down] = at.steps;
    let mean = |axis: usize| wave_mean(at.point[axis], box_width(right[axis], down[axis]));
    0.5 + 0.5 * mean(0) * mean(1) * mean(2)
}
// ANCHOR_END: checker_share

/// The share of the first colour in what a pixel covers of stripes across x.
pub fn stripes_share(at: &TexturePoint) -> f64 {
    let [right, down] = at.steps;
    0.5 + 0.5 * wave_mean(at.point.x, box_width(right.x, down.x))
}

/// Colours the rows of checkered materials.
pub fn colour_checkers(
    checkers: Res<Shared<CheckerTable>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &TexturePoints, &mut SurfaceColours)>,
) {
    for (surfaces, list, points, mut colours) in &mut tiles {
        colour_rows(&checkers.0, surfaces, &list.row, points, &mut colours, checker_share);
    }
}

/// Colours the rows of striped materials.
pub fn colour_stripes(
    stripes: Res<Shared<StripesTable>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &TexturePoints, &mut SurfaceColours)>,
) {
    for (surfaces, list, points, mut colours) in &mut tiles {
        colour_rows(&stripes.0, surfaces, &list.row, points, &mut colours, stripes_share);
    }
}

#[inline(always)]
fn colour_rows(
    table: &TwoColours,
    surfaces: &Surfaces,
    rows: &[u32],
    points: &TexturePoints,
    colours: &mut SurfaceColours,
    share_of: impl Fn(&TexturePoint) -> f64,
) {
    for &row in rows {
        let row = row as usize;
        let texture = table.of_material[surfaces.material[row] as usize];
        if texture == NO_TEXTURE {
            continue;
        }
        let texture = texture as usize;
        let at = points.get(row);
        let share = share_of(&if table.filter[texture] { at } else { at.alone() });
        let (first, second) = (table.first[texture], table.second[texture]);
        colours.set(row, [0, 1, 2].map(|part| share * first[part] + (1.0 - share) * second[part]));
    }
}

/// The stage on offer for checkers.
pub fn checker_stage() -> Stage {
    Stage::new("Colour checkers", TileSystems::Texture, colour_checkers)
        .reads::<Surfaces>()
        .reads::<MaterialRows>()
        .reads::<TexturePoints>()
        .reads::<SurfaceColours>()
        .writes::<SurfaceColours>()
        .table::<CheckerTable>()
        .when(|scene| texture_of_kind::<Checker>(scene, "checkered material", |_| true))
}

/// The stage on offer for stripes.
pub fn stripes_stage() -> Stage {
    Stage::new("Colour stripes", TileSystems::Texture, colour_stripes)
        .reads::<Surfaces>()
        .reads::<MaterialRows>()
        .reads::<TexturePoints>()
        .reads::<SurfaceColours>()
        .writes::<SurfaceColours>()
        .table::<StripesTable>()
        .when(|scene| texture_of_kind::<Stripes>(scene, "striped material", |_| true))
}
