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
        let columns = || [(); 3].map(|()| vec![0.0; width * height]);
        let mut guides = Self { width, normal: columns(), position: columns(), origin: [0.0; 3], albedo: columns() };
        let mut origin = None;
        for (tile, layers) in film.tiles.iter().zip(&film.layers) {
            for row in 0..tile.tile.rows() {
                let [x, y] = tile.tile.pixel_of(row);
                let at = y as usize * width + x as usize;
                let mean = |kind| [0, 1, 2].map(|channel| layers.mean(kind, channel, row));
                if layers.hits[row] == 0 {
                    guides.albedo.iter_mut().for_each(|albedo| albedo[at] = 1.0);
                    continue;
                }
                let (position, normal) = (mean(LayerKind::Position), mean(LayerKind::ShadingNormal));
                let origin = *origin.get_or_insert(position);
                let length = normal.iter().map(|part| part * part).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
                for (channel, albedo) in mean(LayerKind::Albedo).into_iter().enumerate() {
                    guides.position[channel][at] = (position[channel] - origin[channel]) as f32;
                    guides.normal[channel][at] = (normal[channel] / length) as f32;
                    guides.albedo[channel][at] = (albedo as f32).max(LEAST_ALBEDO);
                }
            }
        }
        guides.origin = origin.unwrap_or_default();
        Some(guides)
    }

    /// Multiplies or divides radiance by the albedo.
    pub(super) fn scale(&self, radiance: &mut [Vec<f32>; 3], by: fn(f32, f32) -> f32) {
        for (own, albedo) in radiance.iter_mut().zip(&self.albedo) {
            own.iter_mut().zip(albedo).for_each(|(own, &albedo)| *own = by(*own, albedo));
        }
    }
}

/// Smooths a film's mean radiance; none if the film lacks one of the layers that guide the filter.
pub fn denoise(film: &Film, levels: u32) -> Option<[Vec<f32>; 3]> {
    Some(denoise_radiance(means(film), &Guides::of(film)?, levels))
}

/// The mean radiance of all pixels, line by line from the top.
pub(super) fn means(film: &Film) -> [Vec<f32>; 3] {
    let mut radiance = [(); 3].map(|()| vec![0.0; film.width as usize * film.height as usize]);
    for (at, [x, y]) in (0..film.height).flat_map(|y| (0..film.width).map(move |x| [x, y])).enumerate() {
        for (part, own) in film.mean(x, y).into_iter().zip(&mut radiance) {
            own[at] = part;
        }
    }
    radiance
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
