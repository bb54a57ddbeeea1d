//! A picture of few samples, smoothed along its surfaces: the edge-avoiding à-trous wavelet filter.

use super::{Film, FilmLayers};
use crate::each::{Each, lanes};
use crate::scene::LayerKind;
use multiversion::multiversion;
use rayon::prelude::*;

/// The layers that the filter is guided by.
pub const GUIDES: [LayerKind; 3] = [LayerKind::Position, LayerKind::ShadingNormal, LayerKind::Albedo];

/// The cubic B-spline that each level is smoothed by, from the centre outward.
const SPLINE: [f32; 3] = [3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0];
/// The sine of the angle to the tangent plane at which a neighbour counts half.
const OFF_PLANE: f32 = 0.1;
/// Albedo below this is not divided by.
const MIN_ALBEDO: f32 = 1.0 / 256.0;

/// The fewest pixels that are worth a task of their own.
pub(super) const PIXELS: usize = 1 << 13;

/// What guides the filter: for each pixel, what its camera rays hit first.
#[derive(Clone, Debug, PartialEq)]
pub struct Guides {
    /// Pixels from left to right.
    pub width: usize,
    /// Unit normals; 0 where nothing was hit.
    pub normal: [Vec<f32>; 3],
    /// Positions, relative to the origin.
    pub position: [Vec<f32>; 3],
    /// The first of the positions, so that the others are small numbers, in world space.
    pub origin: [f64; 3],
    /// The albedo that radiance is divided by, so that textures stay sharp; 1 where nothing was hit.
    pub albedo: [Vec<f32>; 3],
}

impl Guides {
    /// The guides that a film holds; none if one of the [`GUIDES`] is not among its layers.
    pub fn of(film: &Film) -> Option<Self> {
        Self::in_place_of(None, film)
    }

    /// The same, in the memory of guides that are no longer needed.
    pub(super) fn in_place_of(spare: Option<Self>, film: &Film) -> Option<Self> {
        let has = |layers: &FilmLayers| GUIDES.iter().all(|kind| layers.kinds.contains(kind));
        if film.layers.is_empty() || !film.layers.iter().all(has) {
            return None;
        }
        let width = film.width as usize;
        let origin = film.layers.iter().find_map(first_position).unwrap_or_default();
        let spare = spare.map_or_else(Default::default, |own| [own.position, own.normal, own.albedo]);
        let [mut position, mut normal, mut albedo] = spare.each(|columns| in_place_of(columns, film));
        let (tiles, pixels) = film.bands();
        let [positions, normals, albedos] = [&mut position, &mut normal, &mut albedo].each(|own| bands(own, pixels));
        (tiles, positions, normals, albedos).into_par_iter().for_each(
            |(tiles, mut position, mut normal, mut albedo)| {
                for number in tiles {
                    let (tile, guides) = (film.tiles[number].tile, TileGuides::of(&film.layers[number]));
                    for line in 0..tile.height {
                        let (first, start) =
                            ((line * tile.width) as usize, line as usize * width + film.corner(number)[0] as usize);
                        for at in 0..tile.width as usize {
                            let of_row = guides.of_row(first + at, origin);
                            set(&mut position, start + at, of_row[0]);
                            set(&mut normal, start + at, of_row[1]);
                            set(&mut albedo, start + at, of_row[2]);
                        }
                    }
                }
            },
        );
        Some(Self { width, normal, position, origin, albedo })
    }

    /// Multiplies or divides radiance by the albedo.
    pub(super) fn scale(&self, radiance: &mut [Vec<f32>; 3], by: impl Fn(f32, f32) -> f32 + Sync) {
        for (own, albedo) in radiance.iter_mut().zip(&self.albedo) {
            let pairs = own.par_iter_mut().zip(albedo).with_min_len(PIXELS);
            pairs.for_each(|(own, &albedo)| *own = by(*own, albedo));
        }
    }
}

/// The layers of a tile that guide the filter.
struct TileGuides<'f> {
    layers: &'f FilmLayers,
    /// The sums of position, normal and albedo, and those over earlier blocks of samples, where there are any.
    sums: [&'f [Vec<f64>]; 3],
    earlier: Option<[&'f [Vec<f64>]; 3]>,
}

impl<'f> TileGuides<'f> {
    fn of(layers: &'f FilmLayers) -> Self {
        let sums = GUIDES.each(|kind| layers.sums_of(kind, &layers.sums));
        let earlier = (!layers.earlier.is_empty()).then(|| GUIDES.each(|kind| layers.sums_of(kind, &layers.earlier)));
        Self { layers, sums, earlier }
    }

    /// Position, normal and albedo of a row.
    #[inline(always)]
    fn of_row(&self, row: usize, origin: [f64; 3]) -> [[f32; 3]; 3] {
        if self.layers.hits[row] == 0 {
            return [[0.0; 3], [0.0; 3], [1.0; 3]];
        }
        let hits = f64::from(self.layers.hits[row]);
        let of_row = |sums: &[Vec<f64>]| [sums[0][row], sums[1][row], sums[2][row]];
        let mut sums = self.sums.each(of_row);
        if let Some(earlier) = self.earlier {
            let earlier = earlier.each(of_row);
            for (sum, before) in sums.iter_mut().flatten().zip(earlier.into_iter().flatten()) {
                *sum += before;
            }
        }
        let [[x, y, z], [nx, ny, nz], albedo] = sums.each(|sum| sum.each(|part| part / hits));
        let length = (nx * nx + ny * ny + nz * nz).sqrt().max(f64::MIN_POSITIVE);
        let place = [(x - origin[0]) as f32, (y - origin[1]) as f32, (z - origin[2]) as f32];
        let normal = [(nx / length) as f32, (ny / length) as f32, (nz / length) as f32];
        [place, normal, albedo.each(|part| (part as f32).max(MIN_ALBEDO))]
    }
}

/// The first position in a tile at which anything was hit.
fn first_position(layers: &FilmLayers) -> Option<[f64; 3]> {
    let row = layers.hits.iter().position(|&hits| hits > 0)?;
    Some([0, 1, 2].each(|channel| layers.mean(LayerKind::Position, channel, row)))
}

/// Smooths a film's mean radiance; none if the film lacks one of the layers that guide the filter.
pub fn denoise(film: &Film, levels: u32) -> Option<[Vec<f32>; 3]> {
    Some(denoise_radiance(means(Default::default(), film), &Guides::of(film)?, levels))
}

/// A film of the same size whose pixels have one sample each, of this radiance, row by row.
pub fn film_of_radiance(radiance: &[Vec<f32>; 3], of: &Film) -> Film {
    let mut film = Film::of_part(of.part(), of.tile_side);
    for tile in &mut film.tiles {
        for row in 0..tile.tile.rows() {
            let [x, y] = tile.tile.pixel_of(row);
            let at = (y - of.origin[1]) as usize * of.width as usize + (x - of.origin[0]) as usize;
            tile.add(row, radiance.each_ref().each(|part| part[at]));
        }
    }
    film
}

/// Columns with a number for each pixel of a film, in the memory of others.
pub(super) fn in_place_of(spare: [Vec<f32>; 3], film: &Film) -> [Vec<f32>; 3] {
    spare.each(|mut column| {
        column.resize(film.width as usize * film.height as usize, 0.0);
        column
    })
}

/// The mean radiance of all pixels, line by line from the top, in the memory of other columns.
pub(super) fn means(spare: [Vec<f32>; 3], film: &Film) -> [Vec<f32>; 3] {
    let mut means = in_place_of(spare, film);
    let (tiles, pixels) = film.bands();
    bands(&mut means, pixels).zip(tiles).for_each(|(mut means, tiles)| {
        tiles.for_each(|tile| film.for_each_mean(tile, |at, mean| set(&mut means, at, mean)));
    });
    means
}

/// The parts of three columns that are of so many pixels.
pub(super) fn bands(
    columns: &mut [Vec<f32>; 3],
    pixels: usize,
) -> impl IndexedParallelIterator<Item = [&mut [f32]; 3]> {
    let [x, y, z] = columns;
    let bands = (x.par_chunks_mut(pixels), y.par_chunks_mut(pixels), z.par_chunks_mut(pixels));
    bands.into_par_iter().map(|(x, y, z)| [x, y, z])
}

#[inline(always)]
fn set([x, y, z]: &mut [&mut [f32]; 3], at: usize, values: [f32; 3]) {
    (x[at], y[at], z[at]) = values.into();
}

/// Smooths radiance, row by row from the top, in as many levels; level i mixes pixels 2ⁱ apart, 5 × 5 of them.
///
/// Radiance is divided by the albedo before and multiplied by it afterwards.
/// A neighbour's weight falls with the angle between the normals and with its distance from the tangent plane; radiance
/// has no say in it, so that what the filter does to a mean is the mean of what it does, and its bias and its variance
/// can be told apart (Dammertz, Sewtz, Hanika and Lensch, *Edge-Avoiding À-Trous Wavelet Transform for fast Global
/// Illumination Filtering*, 2010, without their weight of colours).
/// A pixel whose neighbours all differ from it keeps its radiance.
pub fn denoise_radiance(mut radiance: [Vec<f32>; 3], guides: &Guides, levels: u32) -> [Vec<f32>; 3] {
    guides.scale(&mut radiance, |own, albedo| own / albedo);
    smoothed_in_levels(&radiance, guides, levels)
}

/// The same of radiance that has been divided by the albedo.
pub(super) fn smoothed_in_levels(radiance: &[Vec<f32>; 3], guides: &Guides, levels: u32) -> [Vec<f32>; 3] {
    let empty = || radiance.each_ref().each(|part| vec![0.0; part.len()]);
    let (mut smoothed, mut spare) = (None, None);
    for level in 0..levels {
        let mut into = spare.take().unwrap_or_else(empty);
        smooth(smoothed.as_ref().unwrap_or(radiance), guides, 1 << level, &mut into);
        spare = smoothed.replace(into);
    }
    let mut radiance = smoothed.unwrap_or_else(|| radiance.clone());
    guides.scale(&mut radiance, |own, albedo| own * albedo);
    radiance
}

/// One level of the filter.
fn smooth(radiance: &[Vec<f32>; 3], guides: &Guides, step: usize, [red, green, blue]: &mut [Vec<f32>; 3]) {
    let width = guides.width.max(1);
    let rows = red.par_chunks_mut(width).zip(green.par_chunks_mut(width)).zip(blue.par_chunks_mut(width));
    rows.enumerate().for_each(|(y, ((red, green), blue))| smooth_row(radiance, guides, (y, step), [red, green, blue]));
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn smooth_row(
    radiance: &[Vec<f32>; 3],
    guides: &Guides,
    (y, step): (usize, usize),
    [red, green, blue]: [&mut [f32]; 3],
) {
    let width = guides.width;
    let columns = [radiance, &guides.normal, &guides.position].each(|own| of_length(own, radiance[0].len()));
    let inner = 2 * step..width.saturating_sub(2 * step);
    let mut x = 0;
    while x < width {
        if inner.contains(&x) && x + AT_ONCE <= inner.end {
            let smoothed = smooth_pixels::<AT_ONCE>(&columns, width, [x, y], step);
            let of = x..x + AT_ONCE;
            red[of.clone()].copy_from_slice(&smoothed[0]);
            green[of.clone()].copy_from_slice(&smoothed[1]);
            blue[of].copy_from_slice(&smoothed[2]);
            x += AT_ONCE;
        } else {
            let [[r], [g], [b]] = smooth_pixels::<1>(&columns, width, [x, y], step);
            (red[x], green[x], blue[x]) = (r, g, b);
            x += 1;
        }
    }
}

/// How many pixels of a line are smoothed at once, away from its ends.
const AT_ONCE: usize = 8;

/// Columns that all have the same length, so that one check of an index holds for all of them.
#[inline(always)]
pub(super) fn of_length(columns: &[Vec<f32>; 3], length: usize) -> [&[f32]; 3] {
    columns.each_ref().each(|column| &column[..length])
}

/// Smooths some pixels of a line by radiance, normals and positions; several only where all of their neighbours are in
/// the image.
#[inline(always)]
fn smooth_pixels<const N: usize>(
    [radiance, normals, positions]: &[[&[f32]; 3]; 3],
    width: usize,
    [x, y]: [usize; 2],
    step: usize,
) -> [[f32; N]; 3] {
    let height = radiance[0].len() / width;
    let own = y * width + x;
    let ([nx, ny, nz], [px, py, pz]) = (normals.each(|of| some::<N>(of, own)), positions.each(|of| some::<N>(of, own)));
    let (mut whole, mut sums) = ([0.0; N], [[0.0; N]; 3]);
    for down in -2_isize..=2 {
        let Some(line) = y.checked_add_signed(down * step as isize).filter(|&line| line < height) else { continue };
        for right in -2_isize..=2 {
            let Some(column) = x.checked_add_signed(right * step as isize).filter(|&column| column < width) else {
                continue;
            };
            let other = line * width + column;
            let kernel = SPLINE[down.unsigned_abs()] * SPLINE[right.unsigned_abs()];
            let weight = if (down, right) == (0, 0) {
                [kernel; N]
            } else {
                let [mx, my, mz] = normals.each(|of| some::<N>(of, other));
                let [qx, qy, qz] = positions.each(|of| some::<N>(of, other));
                lanes(|at| {
                    let cosine = nx[at] * mx[at] + ny[at] * my[at] + nz[at] * mz[at];
                    let (dx, dy, dz) = (qx[at] - px[at], qy[at] - py[at], qz[at] - pz[at]);
                    let off = nx[at] * dx + ny[at] * dy + nz[at] * dz;
                    let near = OFF_PLANE * OFF_PLANE * (dx * dx + dy * dy + dz * dz) + f32::MIN_POSITIVE;
                    // The cosine's 32nd power.
                    let alike = if cosine > 0.0 { cosine } else { 0.0 };
                    let alike = (alike * alike) * (alike * alike);
                    let alike = (alike * alike) * (alike * alike);
                    let alike = alike * alike;
                    kernel * (alike * near / (near + off * off))
                })
            };
            whole = lanes(|at| whole[at] + weight[at]);
            for (sum, radiance) in sums.iter_mut().zip(radiance) {
                let light = some::<N>(radiance, other);
                *sum = lanes(|at| sum[at] + weight[at] * light[at]);
            }
        }
    }
    sums.each(|sum| lanes(|at| sum[at] / whole[at]))
}

/// A few numbers of a column.
#[inline(always)]
fn some<const N: usize>(column: &[f32], start: usize) -> [f32; N] {
    let some = &column[start..start + N];
    lanes(|at| some[at])
}
