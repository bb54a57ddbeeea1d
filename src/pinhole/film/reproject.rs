//! What earlier frames have gathered, as it is seen from where the camera is now: reprojection.

use super::Film;
use super::denoise::{Guides, PIXELS, bands, means, of_length, smoothed_in_levels};
use crate::each::Each;
use crate::rasterise::Projection;
use glam::{DVec2, DVec3, Vec3};
use multiversion::multiversion;
use rayon::prelude::*;

/// The most samples that a pixel takes over: more would show for longer what is no longer so.
const MAX: f32 = 16.0;
/// The least cosine between the normals of a point now and before.
const ALIKE: f32 = 0.9;
/// The largest sine of the angle between the tangent plane and the offset from a point now to one before.
const OFF_PLANE: f32 = 0.1;
/// The smallest part of the four pixels around a point that must be of its surface.
const MIN_PART: f32 = 0.25;

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
        Self::in_place_of(None, film)
    }

    /// The same, in the memory of a history that is no longer needed.
    pub fn in_place_of(spare: Option<Self>, film: &Film) -> Option<Self> {
        let (guides, radiance, mut samples) = match spare {
            Some(Self { guides, radiance, samples }) => (Some(guides), radiance, samples),
            None => Default::default(),
        };
        let guides = Guides::in_place_of(guides, film)?;
        let mut radiance = means(radiance, film);
        guides.scale(&mut radiance, |own, albedo| own / albedo);
        samples.resize(radiance[0].len(), 0.0);
        let (tiles, pixels) = film.bands();
        samples.par_chunks_mut(pixels).zip(tiles).for_each(|(samples, tiles)| {
            for own in tiles.map(|number| &film.tiles[number]) {
                let lines = own.count.chunks_exact(own.tile.width.max(1) as usize);
                for (counts, line) in lines.zip(samples.chunks_mut(guides.width)) {
                    let into = line[own.tile.x as usize..].iter_mut();
                    into.zip(counts).for_each(|(samples, &count)| *samples = count as f32);
                }
            }
        });
        Some(Self { guides, radiance, samples })
    }

    /// The mean number of samples of a pixel.
    pub fn mean_samples(&self) -> f64 {
        self.samples.iter().map(|&samples| f64::from(samples)).sum::<f64>() / self.samples.len().max(1) as f64
    }

    /// Adds what an earlier frame knows of the same surfaces; that frame was projected like this, from this eye.
    ///
    /// It is right where radiance depends on the place alone. Where it depends on the direction, as on what is shiny, or
    /// has changed meanwhile, the mean is biased until the earlier samples are outnumbered.
    pub fn with_earlier(mut self, earlier: &Self, projection: &Projection, eye: DVec3) -> Self {
        let Self { guides, radiance, samples } = &mut self;
        let pixels = bands(radiance, PIXELS).zip(samples.par_chunks_mut(PIXELS)).enumerate();
        pixels.for_each(|(number, (radiance, samples))| {
            mix(radiance, samples, (guides, number * PIXELS), earlier, (projection, eye));
        });
        self
    }

    /// The radiance, smoothed in so many levels.
    pub fn denoised(&self, levels: u32) -> [Vec<f32>; 3] {
        smoothed_in_levels(&self.radiance, &self.guides, levels)
    }
}

/// Mixes into some pixels, whose guides begin at `first`, what an earlier frame from an eye knows of them.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn mix(
    [red, green, blue]: [&mut [f32]; 3],
    samples: &mut [f32],
    (guides, first): (&Guides, usize),
    earlier: &History,
    (projection, eye): (&Projection, DVec3),
) {
    let earlier = Pixels::of(&earlier.guides, &earlier.radiance, &earlier.samples);
    for (at, own_samples) in samples.iter_mut().enumerate() {
        let Some(surface) = guides.surface(first + at) else { continue };
        let clip = projection.clip(surface.place - eye);
        let known = (clip.depth > 0.0).then(|| earlier.at(projection.raster(clip), &surface)).flatten();
        let Some(Known { radiance: [r, g, b], samples }) = known else { continue };
        let all = *own_samples + samples;
        let mixed = |own: f32, earlier: f32| (own * *own_samples + earlier * samples) / all;
        (red[at], green[at], blue[at]) = (mixed(red[at], r), mixed(green[at], g), mixed(blue[at], b));
        *own_samples = all;
    }
}

/// The radiance over albedo that an earlier frame has of a place, and how many samples that is worth.
struct Known {
    radiance: [f32; 3],
    samples: f32,
}

/// The surface that a pixel shows: a point of it in world space, and the normal there.
struct Seen {
    place: DVec3,
    normal: Vec3,
}

impl Guides {
    /// The surface that a pixel shows; none where nothing was hit.
    #[inline(always)]
    fn surface(&self, at: usize) -> Option<Seen> {
        let vector = |columns: &[Vec<f32>; 3]| Vec3::new(columns[0][at], columns[1][at], columns[2][at]);
        let normal = vector(&self.normal);
        let place = || DVec3::from(self.origin) + vector(&self.position).as_dvec3();
        (normal != Vec3::ZERO).then(|| Seen { place: place(), normal })
    }
}

/// The pixels of an earlier frame, in columns of the same length.
struct Pixels<'h> {
    size: [i64; 2],
    origin: DVec3,
    normal: [&'h [f32]; 3],
    position: [&'h [f32]; 3],
    radiance: [&'h [f32]; 3],
    samples: &'h [f32],
}

impl<'h> Pixels<'h> {
    #[inline(always)]
    fn of(guides: &'h Guides, radiance: &'h [Vec<f32>; 3], samples: &'h [f32]) -> Self {
        let [normal, position, radiance] =
            [&guides.normal, &guides.position, radiance].each(|columns| of_length(columns, samples.len()));
        let size = [guides.width as i64, (samples.len() / guides.width.max(1)) as i64];
        Self { size, origin: guides.origin.into(), normal, position, radiance, samples }
    }

    /// What is known at a raster point: of the four pixels around it, those that show the same surface.
    #[inline(always)]
    fn at(&self, raster: DVec2, surface: &Seen) -> Option<Known> {
        let [width, height] = self.size;
        let corner = (raster - 0.5).floor();
        let [x, y] = [corner.x as i64, corner.y as i64];
        if x < -1 || y < -1 || x >= width || y >= height {
            return None;
        }
        let [right, down] = (raster - 0.5 - corner).to_array();
        let offset = self.origin - surface.place;
        let mut sum = Known { radiance: [0.0; 3], samples: 0.0 };
        let mut whole = 0.0;
        let (columns, lines) = ([(x, 1.0 - right), (x + 1, right)], [(y, 1.0 - down), (y + 1, down)]);
        for ((column, across), (line, along)) in
            lines.into_iter().flat_map(|line| columns.each(|column| (column, line)))
        {
            // A pixel beyond the image is that of its edge, and has no weight.
            let is_inside = (column >= 0) & (line >= 0) & (column < width) & (line < height);
            let other = (line.clamp(0, height - 1) * width + column.clamp(0, width - 1)) as usize;
            let samples = self.samples[other];
            let counts = is_inside & (samples > 0.0) & self.is_of_surface(other, offset, surface.normal);
            // Rounded last, since a small weight is the difference of two numbers near 1.
            let weight = if counts { (across * along) as f32 } else { 0.0 };
            for (sum, radiance) in sum.radiance.iter_mut().zip(self.radiance) {
                *sum += if counts { weight * radiance[other] } else { 0.0 };
            }
            sum.samples += weight * samples;
            whole += weight;
        }
        let is_known = whole >= MIN_PART;
        is_known
            .then(|| Known { radiance: sum.radiance.each(|sum| sum / whole), samples: MAX.min(sum.samples / whole) })
    }

    /// Whether a pixel shows the surface that has this normal where `offset` leads to the origin of the positions.
    #[inline(always)]
    fn is_of_surface(&self, at: usize, offset: DVec3, normal: Vec3) -> bool {
        let vector = |columns: [&[f32]; 3]| Vec3::new(columns[0][at], columns[1][at], columns[2][at]);
        // Where nothing was hit, the normal is 0.
        let is_alike = vector(self.normal).dot(normal) >= ALIKE;
        let place = vector(self.position);
        let offset = (offset + place.as_dvec3()).as_vec3();
        // What rounding to f32 does to two positions.
        let rounding = place.abs().element_sum() * (4.0 * f32::EPSILON);
        let off = normal.dot(offset).abs() - rounding;
        is_alike & ((off <= 0.0) | (off * off <= OFF_PLANE * OFF_PLANE * offset.length_squared()))
    }
}
