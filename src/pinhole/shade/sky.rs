//! The radiance of what is seen where no shape is, and its light.

use super::light::{ShadowRay, cosine_of};
use super::lookup::between;
use super::radiance::{LightSamplingView, LightSamplingViewItem};
use super::receivers::{LightRay, LightRows, append_sampled};
use super::{Radiance, ShadowRays, irradiance_from_area};
use crate::each::Each;
use crate::extract::{
    BackgroundTable, EnvironmentLightTable, EnvironmentTable, GradientTable, SamplingTable, Texels,
    environment_light_evidence, followed_evidence, light_sampling_evidence, material_evidence, unless_occlusion,
};
use crate::intersect::{Hits, NO_SHAPE, Surface};
use crate::plan::{Column, Evidence, Shared, Stage, StageKind, TileSystems, VectorRowsMut};
use crate::rays::{DrawsView, Paths, WorldRays};
use crate::sample::{Draw, Purpose, with_sampler};
use crate::scene::{Background, Environment, Gradient, Rgb};
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Adds the background's radiance to the rows that hit nothing; to all rows where the scene has no shapes.
pub fn add_background(background: Res<Shared<BackgroundTable>>, mut tiles: Query<(Option<&Hits>, &mut Radiance)>) {
    for (hits, mut radiance) in &mut tiles {
        let rows = radiance.rows();
        let mut radiance = radiance.slices_mut(rows);
        for row in 0..rows {
            if hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE) {
                radiance.add(row, background.radiance);
            }
        }
    }
}

/// The stage that runs [`add_background`].
pub fn background_stage() -> Stage {
    Stage::new("Add the background", TileSystems::Background, add_background).when(|scene| {
        let found = Evidence::among::<With<Background>>(scene, "coloured background", |entity| {
            entity.get::<Background>().is_some_and(|background| background.colour != Rgb::BLACK)
        });
        unless_occlusion(scene, found)
    })
}

// ANCHOR: gradient_radiance
/// (1 − t) bottom + t top with t = (y + 1) / 2, where y is that of a unit direction.
#[inline(always)]
pub fn gradient_radiance(bottom: [f64; 3], top: [f64; 3], y: f64) -> [f64; 3] {
    let t = (0.5 * (y + 1.0)).clamp(0.0, 1.0);
    [0, 1, 2].each(|part| (1.0 - t) * bottom[part] + t * top[part])
}
// ANCHOR_END: gradient_radiance

/// Adds the gradient's radiance to the rows that hit nothing; to all rows where the scene has no shapes.
pub fn add_gradient(
    gradient: Res<Shared<GradientTable>>,
    mut tiles: Query<(&WorldRays, Option<&Hits>, &mut Radiance)>,
) {
    for (rays, hits, mut radiance) in &mut tiles {
        for row in 0..rays.rows() {
            if hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE) {
                let found = gradient_radiance(gradient.bottom, gradient.top, rays.direction_of(row).y);
                radiance.rgb.add(row, found.each(|part| part as f32));
            }
        }
    }
}

/// The stage that runs [`add_gradient`].
pub fn gradient_stage() -> Stage {
    Stage::new("Add the gradient", TileSystems::Background, add_gradient).when(|scene| {
        let found = Evidence::among::<With<Gradient>>(scene, "coloured gradient", |entity| {
            entity.get::<Gradient>().is_some_and(|own| own.bottom != Rgb::BLACK || own.top != Rgb::BLACK)
        });
        unless_occlusion(scene, found)
    })
}

// ANCHOR: equirectangular
/// The position of a direction in an equirectangular image: (0, 0) is the upper left corner, (1, 1) the lower right.
///
/// −z is in the middle, +x to the right of it, and +y along the upper edge. The direction need not be normalised, and
/// no precision is lost near the poles, where an arc cosine of y would lose half of its digits.
#[inline(always)]
pub fn equirectangular(direction: DVec3) -> DVec2 {
    let longitude = libm::atan2(direction.x, -direction.z);
    let from_top = libm::atan2(libm::hypot(direction.x, direction.z), direction.y);
    DVec2::new(0.5 + longitude / (2.0 * PI), from_top / PI)
}
// ANCHOR_END: equirectangular

/// The unit direction at a position of an equirectangular image; the inverse of [`equirectangular`].
pub fn direction_of(at: DVec2) -> DVec3 {
    let (sine, cosine) = libm::sincos((at.x - 0.5) * (2.0 * PI));
    let (across, up) = libm::sincos(at.y * PI);
    DVec3::new(across * sine, up, -across * cosine)
}

/// The solid angle of each texel of a row, in steradians; those of all texels add up to 4π.
pub fn texel_solid_angle(image: &Texels, row: usize) -> f64 {
    let cosine = |edge: usize| libm::cos(edge as f64 / image.height as f64 * PI);
    2.0 * PI / image.width as f64 * (cosine(row) - cosine(row + 1))
}

// ANCHOR: around
/// The colour at a position of an equirectangular image, interpolated bilinearly from four texels.
///
/// The image continues from its left edge to its right one; over a pole it continues in the same row, half a turn
/// further.
pub fn around(image: &Texels, at: DVec2) -> [f64; 3] {
    let (width, height) = (image.width as f64, image.height as f64);
    let (x, y) = (at.x * width - 0.5, at.y * height - 0.5);
    let row = |y: f64| {
        let over = y < 0.0 || y >= height;
        let x = if over { x + 0.5 * width } else { x };
        let texels = y.clamp(0.0, height - 1.0) as usize * image.width;
        let texel = |x: f64| image.rgb[texels + x.rem_euclid(width) as usize % image.width].each(f64::from);
        between(texel(x.floor()), texel(x.floor() + 1.0), x - x.floor())
    };
    between(row(y.floor()), row(y.floor() + 1.0), y - y.floor())
}
// ANCHOR_END: around

/// The environment's radiance from a direction, with its rotation.
#[inline(always)]
pub fn environment_radiance(environment: &EnvironmentTable, direction: DVec3) -> [f64; 3] {
    let [sine, cosine] = environment.turn;
    let DVec3 { x, y, z } = direction;
    // The inverse of the environment's rotation.
    let there = DVec3::new(x * cosine - z * sine, y, x * sine + z * cosine);
    around(&environment.image, equirectangular(there))
}

/// Adds the environment's radiance to the rows that hit nothing; to all rows where the scene has no shapes.
pub fn add_environment(
    environment: Res<Shared<EnvironmentTable>>,
    mut tiles: Query<(&WorldRays, Option<&Hits>, &mut Radiance)>,
) {
    for (rays, hits, mut radiance) in &mut tiles {
        for row in 0..rays.rows() {
            if hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE) {
                let found = environment_radiance(&environment, rays.direction_of(row));
                radiance.rgb.add(row, found.each(|part| part as f32));
            }
        }
    }
}

/// The stage that runs [`add_environment`].
pub fn environment_stage() -> Stage {
    Stage::new("Add the environment", TileSystems::Background, add_environment).kind(StageKind::Alternative).when(
        |scene| {
            let found = Evidence::among::<With<Environment>>(scene, "environment", |entity| {
                entity.get::<Environment>().is_some_and(|environment| environment.scale != 0.0)
            });
            let sampled = environment_light_evidence(scene)
                .and(|| light_sampling_evidence(scene))
                .and(|| followed_evidence(scene));
            if found.needed && sampled.needed {
                let reason = "added with its MIS weight".into();
                return Evidence { needed: false, reason, count: 0 };
            }
            unless_occlusion(scene, found)
        },
    )
}

// ANCHOR: environment_direction
/// A direction sampled in proportion to the environment's light, and its pdf, in 1/sr.
///
/// A texel is chosen by its light; within it, longitude and the cosine of the polar angle are uniform, which is uniform
/// in solid angle.
#[inline(always)]
pub fn environment_direction(light: &EnvironmentLightTable, turn: [f64; 2], u: [f64; 2]) -> (DVec3, f64) {
    let ([row, column], [down, across]) = light.chosen(u);
    let versine = light.versine[row] + down * (light.versine[row + 1] - light.versine[row]);
    let longitude = ((column as f64 + 0.5 + across) / light.columns as f64 - 0.5) * TAU;
    let level = (versine * (2.0 - versine)).max(0.0).sqrt();
    let there = DVec3::new(level * libm::sin(longitude), 1.0 - versine, -level * libm::cos(longitude));
    let [sine, cosine] = turn;
    let direction = DVec3::new(there.x * cosine + there.z * sine, there.y, there.z * cosine - there.x * sine);
    (direction, light.pdf([row, column]))
}
// ANCHOR_END: environment_direction

/// The pdf with which [`environment_direction`] samples a direction, in 1/sr.
#[inline(always)]
pub fn environment_pdf(light: &EnvironmentLightTable, turn: [f64; 2], direction: DVec3) -> f64 {
    let [sine, cosine] = turn;
    let DVec3 { x, y, z } = direction;
    let at = equirectangular(DVec3::new(x * cosine - z * sine, y, x * sine + z * cosine));
    let (width, height) = (light.columns as f64, (light.rows - 1) as f64);
    let column = (at.x * width - 0.5).rem_euclid(width) as usize % light.columns;
    let row = ((at.y * height + 0.5) as usize).min(light.rows - 1);
    light.pdf([row, column])
}

/// A 32-bit fraction as a number with all of its bits, since a bright texel may be very narrow.
#[inline(always)]
fn whole_unit(bits: u32) -> f64 {
    f64::from(bits) * (1.0 / 4_294_967_296.0)
}

/// Samples the environment for one surface: a shadow ray without end, and its pdf.
#[inline(always)]
fn sample_environment_at(
    environment: &EnvironmentTable,
    light: &EnvironmentLightTable,
    surface: &Surface,
    normal: DVec3,
    u: [f64; 2],
) -> LightRay {
    let (direction, pdf) = environment_direction(light, environment.turn, u);
    let origin = offset_origin(surface.position, surface.normal, surface.bound);
    let radiance = environment_radiance(environment, direction);
    let direction = direction.as_vec3();
    let cosine = if pdf > 0.0 { cosine_of(surface, normal, direction) } else { 0.0 };
    let irradiance = irradiance_from_area(radiance, cosine, pdf);
    let ray = ShadowRay { origin, direction, distance: f64::INFINITY, cosine };
    LightRay { ray, t_max: f32::INFINITY, irradiance, pdf }
}

/// Appends, for each row, a shadow ray to a bright part of the environment.
pub fn sample_environment(
    environment: Res<Shared<EnvironmentTable>>,
    light: Res<Shared<EnvironmentLightTable>>,
    sampling: Res<Shared<SamplingTable>>,
    mut tiles: Query<(LightSamplingView, DrawsView, Option<&Paths>)>,
) {
    for (LightSamplingViewItem { surfaces, shading, list, far, mut rays, mut pdfs }, draws, paths) in &mut tiles {
        let receivers = LightRows::new(surfaces, shading, list, far);
        let (draws, to) = (draws.draws(&sampling, paths), (&mut *rays, pdfs.as_deref_mut()));
        with_sampler!(sampling.sampler, D => {
            let drawn = D::of(draws.sample(), Purpose::EnvironmentPoint);
            append_sampled(&receivers, to, |row, surface, normal| {
                let u = drawn.two(draws.key(row)).each(whole_unit);
                sample_environment_at(&environment, &light, surface, normal, u)
            });
        });
    }
}

/// The stage that runs [`sample_environment`]: light sampling, the alternative to BSDF sampling alone.
pub fn environment_light_stage() -> Stage {
    Stage::new("Sample the environment", TileSystems::SampleLights, sample_environment)
        .kind(StageKind::Alternative)
        .appends::<ShadowRays>()
        .when(|scene| {
            environment_light_evidence(scene).and(|| light_sampling_evidence(scene)).and(|| material_evidence(scene))
        })
}

#[cfg(test)]
mod gradient_tests {
    use super::*;

    #[test]
    fn it_is_its_colours_at_the_poles_and_their_mean_at_the_horizon() {
        let (bottom, top) = ([1.0, 0.25, 0.1], [0.5, 0.75, 0.3]);
        assert_eq!(gradient_radiance(bottom, top, -1.0), bottom);
        assert_eq!(gradient_radiance(bottom, top, 1.0), top);
        assert_eq!(gradient_radiance(bottom, top, 0.0), [0.75, 0.5, 0.2]);
        // A direction that rounding made longer than 1 stays within the range.
        assert_eq!(gradient_radiance(bottom, top, 1.0 + 1e-7), top);
    }
}

#[cfg(test)]
mod environment_tests {
    use super::*;

    /// A smooth radiance as a function of direction.
    fn smooth(direction: DVec3) -> [f64; 3] {
        [0.5 + 0.4 * direction.x, 1.0 + 0.5 * direction.y * direction.z, 2.0 + direction.z]
    }

    fn image(width: usize, height: usize, of: impl Fn(DVec3) -> [f64; 3]) -> Texels {
        let at = |at: usize| DVec2::new((at % width) as f64 + 0.5, (at / width) as f64 + 0.5);
        let size = DVec2::new(width as f64, height as f64);
        let rgb = (0..width * height).map(|number| of(direction_of(at(number) / size)).map(|part| part as f32));
        Texels { width, height, rgb: rgb.collect() }
    }

    fn directions() -> impl Iterator<Item = DVec3> {
        (0..40).flat_map(|i| (0..81).map(move |j| direction_of(DVec2::new(f64::from(j) / 80.0, f64::from(i) / 39.0))))
    }

    #[test]
    fn directions_have_their_positions() {
        let close = |direction: DVec3, x: f64, y: f64| {
            let at = equirectangular(direction);
            assert!((at - DVec2::new(x, y)).length() < 1e-15, "{direction}: {at}");
        };
        close(DVec3::NEG_Z, 0.5, 0.5);
        close(DVec3::X * 7.0, 0.75, 0.5);
        close(DVec3::NEG_X, 0.25, 0.5);
        close(DVec3::new(1e-300, 0.0, 1.0), 1.0, 0.5);
        close(DVec3::new(-1e-300, 0.0, 1.0), 0.0, 0.5);
        close(DVec3::new(0.0, 1.0, -1.0), 0.5, 0.25);
        assert!(equirectangular(DVec3::Y).y == 0.0 && equirectangular(DVec3::NEG_Y).y == 1.0);
        // For all of these, an arc cosine gives 0 or 6.7e-8.
        for small in [1e-8, 1e-12, 1e-200] {
            let y = equirectangular(DVec3::new(0.0, 1.0, -small)).y * PI;
            assert!((y / small - 1.0).abs() < 1e-15, "{y} for {small}");
        }
        for direction in directions() {
            let back = direction_of(equirectangular(direction));
            assert!((back - direction).length() < 1e-14, "{direction}: {back}");
        }
    }

    #[test]
    fn a_known_function_is_reproduced_within_the_error_of_interpolation() {
        let mut worsts = Vec::new();
        for (width, height) in [(64, 32), (128, 64), (256, 128), (101, 51)] {
            let image = image(width, height, smooth);
            let mut worst = 0.0_f64;
            for direction in directions() {
                let found = around(&image, equirectangular(direction));
                for (found, truth) in found.into_iter().zip(smooth(direction)) {
                    worst = worst.max((found - truth).abs());
                }
            }
            // Bilinear interpolation is off by h²/8 of each second derivative, which here are at most 1.5 in either
            // angle.
            let step = PI / height as f64;
            assert!(worst < 2.0 * 1.5 * step * step / 8.0 * 4.0, "{width} × {height}: {worst}");
            worsts.push(worst);
        }
        eprintln!("environments: worst errors {worsts:.5?} at 64, 128, 256 and 101 texels across");
        assert!(worsts[0] / worsts[1] > 3.5 && worsts[1] / worsts[2] > 3.5, "the error falls with the square");
    }

    #[test]
    fn poles_and_seam_are_continuous() {
        for (width, height) in [(1, 1), (1, 2), (2, 1), (3, 5), (64, 32)] {
            let image = image(width, height, smooth);
            for y in [1.0, -1.0] {
                for (x, z) in [(0.0, 0.0), (-0.0, -0.0), (1e-300, 0.0), (0.0, -1e-30), (-1e-9, 1e-9)] {
                    let found = around(&image, equirectangular(DVec3::new(x, y, z)));
                    assert!(found.iter().all(|part| part.is_finite()), "{width} × {height} at {x} {y} {z}");
                }
            }
            for y in [-0.9, 0.0, 0.7] {
                let side = |x: f64| around(&image, equirectangular(DVec3::new(x, y, 1.0)));
                for (left, right) in side(-1e-12).into_iter().zip(side(1e-12)) {
                    assert!((left - right).abs() < 1e-9, "{width} × {height}: the seam shows");
                }
            }
        }
        // Over the pole, the colour is the same from either side.
        let image = image(64, 32, smooth);
        let near = |x: f64| around(&image, equirectangular(DVec3::new(x, 1.0, 0.0)));
        for (one, other) in near(1e-9).into_iter().zip(near(-1e-9)) {
            assert!((one - other).abs() < 1e-6, "{one} {other}");
        }
    }

    #[test]
    fn a_constant_sphere_integrates_to_4_pi() {
        for (width, height) in [(1, 1), (7, 3), (64, 32), (512, 256)] {
            let image = image(width, height, |_| [2.0, 0.5, 1.0]);
            let mut power = [0.0; 3];
            for row in 0..height {
                let angle = texel_solid_angle(&image, row);
                for texel in &image.rgb[row * width..(row + 1) * width] {
                    (0..3).for_each(|part| power[part] += f64::from(texel[part]) * angle);
                }
            }
            for (power, radiance) in power.into_iter().zip([2.0, 0.5, 1.0]) {
                assert!((power / (4.0 * PI * radiance) - 1.0).abs() < 1e-11, "{width} × {height}: {power}");
            }
            for direction in directions() {
                assert_eq!(around(&image, equirectangular(direction)), [2.0, 0.5, 1.0]);
            }
        }
    }

    #[test]
    fn rotation_is_right_handed() {
        let image = image(64, 32, smooth);
        let (sine, cosine) = libm::sincos(PI / 2.0);
        let straight = EnvironmentTable { image: image.clone().into(), turn: [0.0, 1.0], remarks: Vec::new() };
        let turned = EnvironmentTable { image: image.into(), turn: [sine, cosine], remarks: Vec::new() };
        for (there, here) in [(DVec3::NEG_Z, DVec3::NEG_X), (DVec3::NEG_X, DVec3::Z), (DVec3::X, DVec3::NEG_Z)] {
            let (expected, found) = (environment_radiance(&straight, there), environment_radiance(&turned, here));
            for (expected, found) in expected.into_iter().zip(found) {
                assert!((expected - found).abs() < 1e-12, "the radiance at {there} is rotated to {here}");
            }
        }
    }
}
