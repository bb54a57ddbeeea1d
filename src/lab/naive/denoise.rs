//! The à-trous filter and reprojection in plain code, a pixel at a time.

use glam::{DVec2, DVec3};
use pinhole::film::Guides;
use rayon::prelude::*;

/// The levels that a picture of one sample a pixel is shown with.
pub const LEVELS: u32 = 3;

/// What one pixel shows: its light, and the surface that its camera rays hit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// Radiance over albedo.
    pub light: DVec3,
    /// The surface's unit normal; 0 where nothing was hit.
    pub normal: DVec3,
    /// The point of the surface.
    pub position: DVec3,
}

/// An image of what its pixels show, line by line from the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Image {
    /// Pixels from left to right.
    pub width: usize,
    /// The pixels.
    pub pixels: Vec<Seen>,
}

impl Image {
    /// The pixel at this place; none outside of the image.
    pub fn get(&self, [x, y]: [i64; 2]) -> Option<&Seen> {
        let inside = (0..self.width as i64).contains(&x) && y >= 0;
        self.pixels.get((y * self.width as i64 + x) as usize).filter(|_| inside)
    }
}

/// The cubic B-spline: what each of five pixels in a row counts.
const SPLINE: [f64; 5] = [1.0 / 16.0, 1.0 / 4.0, 3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0];

// ANCHOR: plain_smoothed
/// A pixel's light after one level of the filter: the weighted mean of 5 × 5 pixels, `step` apart.
///
/// `weight` says how much a neighbour counts: 1 on the same surface, less the more it differs.
pub fn smoothed(image: &Image, [x, y]: [i64; 2], step: i64, weight: impl Fn(&Seen, &Seen) -> f64) -> DVec3 {
    let Some(own) = image.get([x, y]) else { return DVec3::ZERO };
    let (mut sum, mut whole) = (DVec3::ZERO, 0.0);
    for (right, down) in (-2..=2).flat_map(|right| (-2..=2).map(move |down| (right, down))) {
        let Some(other) = image.get([x + step * right, y + step * down]) else { continue };
        let alike = if right == 0 && down == 0 { 1.0 } else { weight(own, other) };
        let counts = SPLINE[(right + 2) as usize] * SPLINE[(down + 2) as usize] * alike;
        sum += counts * other.light;
        whole += counts;
    }
    sum / whole
}
// ANCHOR_END: plain_smoothed

// ANCHOR: plain_reprojection
/// Whether two pixels, of this frame and of an earlier one, show the same surface.
pub fn is_same_surface(now: &Seen, before: &Seen) -> bool {
    let offset = before.position - now.position;
    now.normal.dot(before.normal) >= 0.9 && now.normal.dot(offset).abs() <= 0.1 * offset.length()
}

/// What an earlier frame knows of the surface that a pixel shows; `raster` is where that frame had the pixel's point.
pub fn taken_over(now: &Seen, before: &Image, raster: DVec2) -> Option<DVec3> {
    let corner = (raster - 0.5).floor();
    let part = raster - 0.5 - corner;
    let (mut sum, mut whole) = (DVec3::ZERO, 0.0);
    for offset in [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE] {
        let place = corner + offset;
        let Some(pixel) = before.get([place.x as i64, place.y as i64]) else { continue };
        if is_same_surface(now, pixel) {
            let near = 1.0 - (part - offset).abs();
            sum += near.x * near.y * pixel.light;
            whole += near.x * near.y;
        }
    }
    (whole >= 0.25).then(|| sum / whole)
}
// ANCHOR_END: plain_reprojection

/// How much a neighbour counts for the filter, as the renderer has it.
///
/// It falls with the angle between the normals and with the angle between the offset and the tangent plane.
pub fn edge_weight(normal: DVec3, other: DVec3, offset: DVec3) -> f64 {
    let mut alike = normal.dot(other).max(0.0);
    // Its 32nd power.
    for _ in 0..5 {
        alike *= alike;
    }
    let off = normal.dot(offset);
    let near = 0.01 * offset.length_squared();
    if off == 0.0 { alike } else { alike * near / (near + off * off) }
}

/// An image of radiance and what guides the filter.
pub fn image_of(radiance: &[Vec<f32>; 3], guides: &Guides) -> Image {
    let vector = |columns: &[Vec<f32>; 3], at: usize| DVec3::from([0, 1, 2].map(|part| f64::from(columns[part][at])));
    let seen = |at: usize| Seen {
        light: vector(radiance, at) / vector(&guides.albedo, at),
        normal: vector(&guides.normal, at),
        position: DVec3::from(guides.origin) + vector(&guides.position, at),
    };
    Image { width: guides.width, pixels: (0..radiance[0].len()).map(seen).collect() }
}

/// Every pixel after so many levels; level i mixes pixels 2ⁱ apart.
pub fn denoised(mut image: Image, levels: u32, weight: impl Fn(&Seen, &Seen) -> f64 + Sync) -> Image {
    for level in 0..levels {
        let place = |at: usize| [at % image.width, at / image.width].map(|part| part as i64);
        let light = |at: usize| smoothed(&image, place(at), 1 << level, &weight);
        let lights: Vec<DVec3> = (0..image.pixels.len()).into_par_iter().with_min_len(256).map(light).collect();
        image.pixels.iter_mut().zip(lights).for_each(|(pixel, light)| pixel.light = light);
    }
    image
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use crate::naive::projection::raster_from_world;
    use bevy_ecs::prelude::*;
    use pinhole::extract::eye;
    use pinhole::film::{Film, GUIDES, History, denoise, denoise_radiance};
    use pinhole::plan::Census;
    use pinhole::rasterise::Projection;
    use pinhole::render::{Execution, render};
    use pinhole::scene::*;
    use pinhole::{Chapter, stages};

    /// Guides and radiance whose surfaces change at random every few pixels, some without any.
    fn drawn(width: usize, height: usize, seed: u64) -> (Guides, [Vec<f32>; 3]) {
        let columns = || [(); 3].map(|()| vec![0.0_f32; width * height]);
        let mut guides = Guides { width, normal: columns(), position: columns(), origin: [0.0; 3], albedo: columns() };
        let mut radiance = columns();
        for at in 0..width * height {
            let mut surface = Draws::new(seed, (at % width / 7 + at / width / 5 * 100) as u64);
            let mut pixel = Draws::new(seed + 1, at as u64);
            let is_hit = surface.unit() > 0.2;
            let normal = surface.unit_vector();
            let along = DVec3::from([(); 3].map(|()| pixel.between(-1.0, 1.0)));
            // Nearly in one plane.
            let position = along - normal * normal.dot(along) * 0.95;
            for part in 0..3 {
                if is_hit {
                    guides.normal[part][at] = normal[part] as f32;
                    guides.position[part][at] = position[part] as f32;
                }
                guides.albedo[part][at] = if is_hit { pixel.between(0.1, 0.9) as f32 } else { 1.0 };
                radiance[part][at] = pixel.between(0.0, 3.0) as f32;
            }
        }
        (guides, radiance)
    }

    #[test]
    fn plain_code_makes_what_the_renderer_makes() {
        let mut changed = 0;
        for seed in 0..6 {
            let (guides, radiance) = drawn(41, 27, 3500 + 2 * seed);
            for levels in 0..=4 {
                let weight =
                    |own: &Seen, other: &Seen| edge_weight(own.normal, other.normal, other.position - own.position);
                let plain = denoised(image_of(&radiance, &guides), levels, weight);
                let own = denoise_radiance(radiance.clone(), &guides, levels);
                for (at, pixel) in plain.pixels.iter().enumerate() {
                    for part in 0..3 {
                        let light = pixel.light[part] * f64::from(guides.albedo[part][at]);
                        let renderer = f64::from(own[part][at]);
                        assert!(
                            (light - renderer).abs() <= 3e-4 * renderer,
                            "{seed} {levels} {at}: {light} {renderer}"
                        );
                        changed += usize::from(levels > 0 && (own[part][at] - radiance[part][at]).abs() > 0.01);
                    }
                }
            }
        }
        assert!(changed > 50_000, "{changed}");
    }

    #[test]
    fn a_neighbour_counts_half_at_a_tenth_of_its_distance_off_the_plane() {
        let weight = |offset| edge_weight(DVec3::Z, DVec3::Z, offset);
        let sine = 0.1_f64;
        let offset = DVec3::new((1.0 - sine * sine).sqrt(), 0.0, sine);
        assert!((weight(offset) - 0.5).abs() < 1e-12 && (weight(1e6 * offset) - 0.5).abs() < 1e-12);
        assert_eq!((weight(DVec3::X), weight(DVec3::ZERO)), (1.0, 1.0));
        assert_eq!(edge_weight(DVec3::Z, DVec3::NEG_Z, DVec3::X), 0.0);
    }

    /// A wall across the view, seen by two cameras; a post hides a part of it from the first.
    #[test]
    fn what_an_earlier_frame_shows_is_found_and_what_it_does_not_is_not() {
        let (size, axes) = (DVec2::new(40.0, 20.0), [DVec3::X, DVec3::Y, DVec3::Z]);
        let raster = |point, eye| raster_from_world(point, eye, axes, 0.5, size);
        let light = |point: DVec3| DVec3::new(2.0 + point.x, 1.0, 2.0 - point.y);
        let frame = |eye: DVec3| {
            let pixel = |at: usize| {
                let ndc = (DVec2::new((at % 40) as f64, (at / 40) as f64) + 0.5) / size;
                let toward = DVec3::new(2.0 * ndc.x - 1.0, 0.5 - ndc.y, -1.0);
                let [wall, post] = [4.0, 2.0].map(|depth| eye + depth * toward);
                let position = if (post.x - 0.3).abs() < 0.1 { post } else { wall };
                Seen { light: light(position), normal: DVec3::Z, position }
            };
            Image { width: 40, pixels: (0..800).map(pixel).collect() }
        };
        let eyes = [DVec3::new(0.0, 1.0, 4.0), DVec3::new(0.2, 1.0, 4.0)];
        let [before, now] = eyes.map(frame);
        let (mut known, mut new) = (0, 0);
        for pixel in &now.pixels {
            let at = raster(pixel.position, eyes[0]);
            // The segment to the first eye passes the post's plane halfway.
            let is_hidden = pixel.position.z < 1.0 && (0.5 * pixel.position.x - 0.3).abs() < 0.05;
            match taken_over(pixel, &before, at) {
                // Radiance is linear: from four pixels it is exact, from fewer off by less than a pixel.
                Some(light) => {
                    assert!((light - pixel.light).abs().max_element() < 0.2, "{pixel:?} {light}");
                    assert!(!is_hidden, "{pixel:?}");
                    known += 1;
                }
                None => new += 1,
            }
        }
        assert!(known > 650 && new > 20, "{known} {new}");
    }

    /// A box on the ground, each pixel one ray, seen from so far to the side.
    fn rendered(aside: f64) -> (World, Film) {
        let mut world = World::new();
        let look =
            LookAt { eye: DVec3::new(aside, 1.5, 4.0), target: DVec3::new(aside, 0.5, 0.0), ..LookAt::default() };
        let resolution = Resolution { width: 64, height: 36 };
        let layers = Layers { kinds: GUIDES.to_vec() };
        world.spawn((PerspectiveCamera::default(), look, resolution, layers, Integrator::RayCasting));
        world.spawn((Cuboid::default(), Placement::at(0.0, 0.5, 0.0), Matte::default()));
        world.spawn((Plane::default(), Matte::default(), Checker { size: 0.7, ..Checker::default() }));
        let light = PointLight { intensity: Rgb::grey(30.0), ..PointLight::default() };
        world.spawn((light, Placement::at(1.0, 4.0, 3.0)));
        let chapter = Chapter::new("box", "a box", |_| ()).offer(stages::all());
        let film = render(&world, &chapter.stages(), &Execution::default(), &()).expect("renders").film;
        (world, film)
    }

    #[test]
    fn plain_code_takes_over_what_the_renderer_takes_over() {
        let [(earlier, before), (_, now)] = [rendered(0.0), rendered(0.15)];
        let census = Census::of(&earlier);
        let (projection, eye) = (*census.table::<Projection>().expect("it projects"), eye(&census).expect("a camera"));
        let raster_of = |point: DVec3| projection.raster(projection.clip(point - eye));
        let image = |film: &Film| image_of(&denoise(film, 0).expect("layers"), &Guides::of(film).expect("layers"));
        let [own, known] = [&now, &before].map(image);
        let [single, earlier] = [&now, &before].map(|film| History::of(film).expect("layers"));
        let joined = single.with_earlier(&earlier, &projection, eye);
        let together = image_of(&joined.denoised(0), &Guides::of(&now).expect("layers"));
        let (mut taken, mut apart) = (0, 0);
        for (at, pixel) in own.pixels.iter().enumerate().filter(|(_, pixel)| pixel.normal != DVec3::ZERO) {
            match (taken_over(pixel, &known, raster_of(pixel.position)), joined.samples[at] > 1.0) {
                (Some(light), true) => {
                    let mean = 0.5 * (pixel.light + light);
                    assert!((together.pixels[at].light - mean).length() <= 1e-4 * mean.length(), "pixel {at}");
                    taken += 1;
                }
                (None, false) => {}
                // Close to a threshold, f32 and f64 may differ.
                _ => apart += 1,
            }
        }
        assert!(taken > 1200 && apart < 10, "{taken} {apart}");
    }
}
