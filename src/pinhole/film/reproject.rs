//! What earlier frames have gathered, as it is seen from where the camera is now: reprojection.

use super::Film;
use super::denoise::{Guides, PIXELS, means, smoothed_in_levels};
use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

/// The most samples that a pixel takes over: more would show for longer what is no longer so.
const MOST: f32 = 16.0;
/// The least cosine between the normals of a point now and before.
const ALIKE: f32 = 0.9;
/// The largest sine of the angle between the tangent plane and the offset from a point now to one before.
const OFF_PLANE: f32 = 0.1;
/// The smallest part of the four pixels around a point that must be of its surface.
const LEAST_PART: f64 = 0.25;

/// The radiance of a frame, of which each pixel may have samples of earlier frames.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    guides: Guides,
    /// The mean over the albedo, so that textures stay sharp.
    radiance: [Vec<f32>; 3],
    /// How many samples each pixel has, those that it took over among them.
    pub samples: Vec<f32>,
}

impl History {
    /// What a film has by itself; none if it lacks one of the layers that guide the denoiser.
    pub fn of(film: &Film) -> Option<Self> {
        let guides = Guides::of(film)?;
        let mut radiance = means(film);
        guides.scale(&mut radiance, |own, albedo| own / albedo);
        let mut samples = vec![0.0; radiance[0].len()];
        for tile in &film.tiles {
            for (row, &count) in tile.count.iter().enumerate() {
                let [x, y] = tile.tile.pixel_of(row);
                samples[(y * film.width + x) as usize] = count as f32;
            }
        }
        Some(Self { guides, radiance, samples })
    }

    /// The mean number of samples of a pixel.
    pub fn mean_samples(&self) -> f64 {
        self.samples.iter().map(|&samples| f64::from(samples)).sum::<f64>() / self.samples.len().max(1) as f64
    }

    /// Adds what an earlier frame knows of the same surfaces; `raster_of` says where that frame had a point of world space.
    ///
    /// It is right where radiance depends on the place alone. Where it depends on the direction, as on what is shiny, or
    /// has changed meanwhile, the mean is biased until the earlier samples are outnumbered.
    pub fn with_earlier(mut self, earlier: &Self, raster_of: impl Fn(DVec3) -> Option<DVec2> + Sync) -> Self {
        let found: Vec<Option<([f32; 3], f32)>> = (0..self.samples.len())
            .into_par_iter()
            .with_min_len(1024)
            .map(|at| earlier.at(raster_of(self.guides.place(at)?)?, &self.guides, at))
            .collect();
        let [red, green, blue] = &mut self.radiance;
        let pixels = (red, green, blue, &mut self.samples, found).into_par_iter().with_min_len(PIXELS);
        pixels.for_each(|(red, green, blue, own_samples, found)| {
            let Some(([r, g, b], samples)) = found else { return };
            let all = *own_samples + samples;
            let mixed = |own: f32, earlier: f32| (own * *own_samples + earlier * samples) / all;
            (*red, *green, *blue) = (mixed(*red, r), mixed(*green, g), mixed(*blue, b));
            *own_samples = all;
        });
        self
    }

    /// The radiance over albedo at a raster point, and how many samples that is worth: of the four pixels around it,
    /// those that show the same surface.
    fn at(&self, raster: DVec2, guides: &Guides, of: usize) -> Option<([f32; 3], f32)> {
        let (width, height) = (self.guides.width as f64, (self.samples.len() / self.guides.width.max(1)) as f64);
        let corner = (raster - 0.5).floor();
        let part = raster - 0.5 - corner;
        let (mut sum, mut samples, mut whole) = ([0.0_f64; 3], 0.0, 0.0);
        for (right, down) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let pixel = corner + DVec2::new(right, down);
            if !(pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < width && pixel.y < height) {
                continue;
            }
            let other = (pixel.y * width + pixel.x) as usize;
            if !(self.samples[other] > 0.0 && self.guides.is_same_surface(other, guides, of)) {
                continue;
            }
            let weight = (1.0 - (right - part.x).abs()) * (1.0 - (down - part.y).abs());
            for (sum, radiance) in sum.iter_mut().zip(&self.radiance) {
                *sum += weight * f64::from(radiance[other]);
            }
            samples += weight * f64::from(self.samples[other]);
            whole += weight;
        }
        let known = whole >= LEAST_PART;
        known.then(|| (sum.map(|sum| (sum / whole) as f32), MOST.min((samples / whole) as f32)))
    }

    /// The radiance, smoothed in so many levels.
    pub fn denoised(&self, levels: u32) -> [Vec<f32>; 3] {
        smoothed_in_levels(self.radiance.clone(), &self.guides, levels)
    }
}

impl Guides {
    /// The point of world space that a pixel shows; none where nothing was hit.
    fn place(&self, at: usize) -> Option<DVec3> {
        let normal = self.vector(&self.normal, at);
        (normal != Vec3::ZERO).then(|| DVec3::from(self.origin) + self.vector(&self.position, at).as_dvec3())
    }

    fn vector(&self, columns: &[Vec<f32>; 3], at: usize) -> Vec3 {
        Vec3::new(columns[0][at], columns[1][at], columns[2][at])
    }

    /// Whether a pixel shows the surface that a pixel of another frame does.
    fn is_same_surface(&self, own: usize, other: &Self, at: usize) -> bool {
        let (Some(here), Some(there)) = (self.place(own), other.place(at)) else { return false };
        let normal = other.vector(&other.normal, at);
        let offset = (here - there).as_vec3();
        // What rounding to f32 does to two positions.
        let rounding = self.vector(&self.position, own).length() * (4.0 * f32::EPSILON);
        self.vector(&self.normal, own).dot(normal) >= ALIKE
            && normal.dot(offset).abs() <= OFF_PLANE * offset.length() + rounding
    }
}
