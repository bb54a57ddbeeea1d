//! A picture of few samples, smoothed along its surfaces: the edge-avoiding à-trous wavelet filter.

use super::{Film, FilmLayers};
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
const LEAST_ALBEDO: f32 = 1.0 / 256.0;

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
        let has = |layers: &FilmLayers| GUIDES.iter().all(|kind| layers.kinds.contains(kind));
        if film.layers.is_empty() || !film.layers.iter().all(has) {
            return None;
        }
        let (width, height) = (film.width as usize, film.height as usize);
        let origin = film.layers.iter().find_map(first_position).unwrap_or_default();
        let mut pixels = vec![[0.0; 9]; width * height];
        let bands = pixels.par_chunks_mut((width * film.tile_side as usize).max(1));
        let across = film.width.div_ceil(film.tile_side.max(1)) as usize;
        bands.enumerate().for_each(|(band, pixels)| {
            for number in band * across..(band + 1) * across {
                let (tile, guides) = (film.tiles[number].tile, TileGuides::of(&film.layers[number]));
                for row in 0..tile.rows() {
                    let [x, y] = tile.pixel_of(row);
                    pixels[(y - tile.y) as usize * width + x as usize] = guides.of_row(row, origin);
                }
            }
        });
        let column = |part: usize| pixels.par_iter().map(|pixel| pixel[part]).collect();
        let columns = |first: usize| [first, first + 1, first + 2].map(column);
        Some(Self { width, position: columns(0), normal: columns(3), albedo: columns(6), origin })
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
    position: &'f [Vec<f64>],
    normal: &'f [Vec<f64>],
    albedo: &'f [Vec<f64>],
}

impl<'f> TileGuides<'f> {
    fn of(layers: &'f FilmLayers) -> Self {
        let [position, normal, albedo] = GUIDES.map(|kind| layers.sums_of(kind));
        Self { layers, position, normal, albedo }
    }

    /// Position, normal and albedo of a row.
    fn of_row(&self, row: usize, origin: [f64; 3]) -> [f32; 9] {
        if self.layers.hits[row] == 0 {
            return [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
        }
        let hits = f64::from(self.layers.hits[row]);
        let mean = |sums: &[Vec<f64>]| [sums[0][row] / hits, sums[1][row] / hits, sums[2][row] / hits];
        let ([x, y, z], [nx, ny, nz], albedo) = (mean(self.position), mean(self.normal), mean(self.albedo));
        let length = (nx * nx + ny * ny + nz * nz).sqrt().max(f64::MIN_POSITIVE);
        let [r, g, b] = albedo.map(|part| (part as f32).max(LEAST_ALBEDO));
        let (px, py, pz) = ((x - origin[0]) as f32, (y - origin[1]) as f32, (z - origin[2]) as f32);
        [px, py, pz, (nx / length) as f32, (ny / length) as f32, (nz / length) as f32, r, g, b]
    }
}

/// The first position in a tile at which anything was hit.
fn first_position(layers: &FilmLayers) -> Option<[f64; 3]> {
    let row = layers.hits.iter().position(|&hits| hits > 0)?;
    Some([0, 1, 2].map(|channel| layers.mean(LayerKind::Position, channel, row)))
}

/// Smooths a film's mean radiance; none if the film lacks one of the layers that guide the filter.
pub fn denoise(film: &Film, levels: u32) -> Option<[Vec<f32>; 3]> {
    Some(denoise_radiance(means(film), &Guides::of(film)?, levels))
}

/// The mean radiance of all pixels, line by line from the top.
pub(super) fn means(film: &Film) -> [Vec<f32>; 3] {
    let at = |at: u32| film.mean(at % film.width, at / film.width);
    let pixels: Vec<[f32; 3]> = (0..film.width * film.height).into_par_iter().with_min_len(PIXELS).map(at).collect();
    [0, 1, 2].map(|channel| pixels.par_iter().map(|pixel| pixel[channel]).collect())
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
    smoothed_in_levels(radiance, guides, levels)
}

/// The same of radiance that has been divided by the albedo.
pub(super) fn smoothed_in_levels(mut radiance: [Vec<f32>; 3], guides: &Guides, levels: u32) -> [Vec<f32>; 3] {
    for level in 0..levels {
        radiance = smoothed(&radiance, guides, 1 << level);
    }
    guides.scale(&mut radiance, |own, albedo| own * albedo);
    radiance
}

/// One level of the filter.
fn smoothed(radiance: &[Vec<f32>; 3], guides: &Guides, step: usize) -> [Vec<f32>; 3] {
    let mut out = [(); 3].map(|()| vec![0.0; radiance[0].len()]);
    let [red, green, blue] = &mut out;
    let width = guides.width.max(1);
    let rows = red.par_chunks_mut(width).zip(green.par_chunks_mut(width)).zip(blue.par_chunks_mut(width));
    rows.enumerate().for_each_init(
        || vec![0.0; width],
        |weights, (y, ((red, green), blue))| {
            smooth_row(radiance, guides, (y, step), weights, [red, green, blue]);
        },
    );
    out
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn smooth_row(
    radiance: &[Vec<f32>; 3],
    guides: &Guides,
    (y, step): (usize, usize),
    weights: &mut [f32],
    [red, green, blue]: [&mut [f32]; 3],
) {
    let (width, height) = (guides.width, radiance[0].len() / guides.width);
    weights.fill(0.0);
    for down in -2_isize..=2 {
        let Some(line) = y.checked_add_signed(down * step as isize).filter(|&line| line < height) else { continue };
        for right in -2_isize..=2 {
            let offset = right * step as isize;
            let (first, last) = (0.max(-offset) as usize, (width as isize - offset.max(0)).max(0) as usize);
            if first >= last {
                continue;
            }
            let own = y * width + first..y * width + last;
            let start = (line * width + first).saturating_add_signed(offset);
            let other = start..start + own.len();
            let kernel = SPLINE[down.unsigned_abs()] * SPLINE[right.unsigned_abs()];
            let [nx, ny, nz] = guides.normal.each_ref().map(|part| &part[own.clone()]);
            let [mx, my, mz] = guides.normal.each_ref().map(|part| &part[other.clone()]);
            let [px, py, pz] = guides.position.each_ref().map(|part| &part[own.clone()]);
            let [qx, qy, qz] = guides.position.each_ref().map(|part| &part[other.clone()]);
            let [r, g, b] = radiance.each_ref().map(|part| &part[other.clone()]);
            let (weights, red) = (&mut weights[first..last], &mut red[first..last]);
            let (green, blue) = (&mut green[first..last], &mut blue[first..last]);
            let is_own = down == 0 && right == 0;
            for at in 0..weights.len() {
                let cosine = nx[at] * mx[at] + ny[at] * my[at] + nz[at] * mz[at];
                let (dx, dy, dz) = (qx[at] - px[at], qy[at] - py[at], qz[at] - pz[at]);
                let off = nx[at] * dx + ny[at] * dy + nz[at] * dz;
                let near = OFF_PLANE * OFF_PLANE * (dx * dx + dy * dy + dz * dz) + f32::MIN_POSITIVE;
                // The cosine's 32nd power.
                let alike = if cosine > 0.0 { cosine } else { 0.0 };
                let alike = alike * alike * alike * alike;
                let alike = alike * alike * alike * alike;
                let alike = alike * alike;
                let weight = kernel * if is_own { 1.0 } else { alike * near / (near + off * off) };
                weights[at] += weight;
                red[at] += weight * r[at];
                green[at] += weight * g[at];
                blue[at] += weight * b[at];
            }
        }
    }
    for at in 0..width {
        red[at] /= weights[at];
        green[at] /= weights[at];
        blue[at] /= weights[at];
    }
}
