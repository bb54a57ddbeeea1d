//! Mistakes between surfaces and the picture.

use bevy_ecs::prelude::*;
use glam::Vec3;
use pinhole::extract::{
    BackgroundTable, DirectionalLightTable, EmissiveTable, MaterialTable, PlaneTable, SpotLightTable,
};
use pinhole::film::{Curve, FilmTile, byte_from_linear, srgb_from_linear};
use pinhole::intersect::{EmissiveRows, Surfaces};
use pinhole::lights::irradiance_from_point;
use pinhole::material::lambertian;
use pinhole::plan::{Column, Shared, VectorRowsMut};
use pinhole::shade::{Radiance, ShadowHits, ShadowRays};

/// Radiance that does not start at 0.
pub fn not_dark(mut tiles: Query<&mut Radiance>) {
    for mut radiance in &mut tiles {
        let radiance = &mut *radiance;
        radiance.rgb.iter_mut().flatten().for_each(|part| *part = 0.05);
    }
}

/// The background behind everything, and before it too.
pub fn background_everywhere(background: Res<Shared<BackgroundTable>>, mut tiles: Query<&mut Radiance>) {
    for mut radiance in &mut tiles {
        (0..radiance.rows()).for_each(|row| radiance.rgb.add(row, background.radiance));
    }
}

/// A row of shadow rays is there before any light has been sampled.
pub fn light_left_over(mut tiles: Query<&mut ShadowRays>) {
    for mut rays in &mut tiles {
        rays.clear();
        let (_, _, mut direction, ..) = rays.slices_mut(1);
        direction.put(0, Vec3::Y);
    }
}

/// Parallel light that falls obliquely counts in full: what each ray brings is as much as the strongest brings.
pub fn sun_without_cosine(suns: Res<Shared<DirectionalLightTable>>, mut tiles: Query<&mut ShadowRays>) {
    for mut rays in &mut tiles {
        let rays = &mut *rays;
        for ray in 0..rays.rows() {
            if rays.t_max[ray] == f32::INFINITY {
                rays.irradiance.put(ray, suns.row[0].irradiance.map(|part| part as f32));
            }
        }
    }
}

/// A light with an area as bright from afar as from a distance of 1: the square of the distance left out of the pdf.
pub fn no_distance(mut tiles: Query<&mut ShadowRays>) {
    for mut rays in &mut tiles {
        let rays = &mut *rays;
        for ray in 0..rays.rows() {
            let squared = rays.t_max[ray] * rays.t_max[ray];
            rays.irradiance.scale(ray, [squared; 3]);
        }
    }
}

/// A spot's edge is as sharp as its inner cone: what has faded shines in full.
pub fn spot_without_fading(spots: Res<Shared<SpotLightTable>>, mut tiles: Query<(&Surfaces, &mut ShadowRays)>) {
    for (surfaces, mut rays) in &mut tiles {
        for ray in 0..rays.rows() {
            let origin = rays.origin_of(ray);
            let offset = spots.row[0].position - origin;
            let direction = rays.direction_of(ray);
            if offset.normalize().dot(direction) < 1.0 - 1e-9 || rays.t_max[ray] == f32::INFINITY {
                continue;
            }
            let cosine = surfaces.get(rays.row[ray] as usize).normal.as_dvec3().dot(direction);
            let whole = irradiance_from_point(spots.row[0].intensity, cosine, offset.length_squared());
            rays.irradiance.put(ray, whole.map(|part| part as f32));
        }
    }
}

/// No highlight of Phong's kind.
pub fn phong_forgotten() {}

/// No highlight of Blinn's kind.
pub fn blinn_phong_forgotten() {}

/// What a surface emits counts twice.
pub fn emitted_twice(emissive: Res<Shared<EmissiveTable>>, mut tiles: Query<(&EmissiveRows, &mut Radiance)>) {
    for (list, mut radiance) in &mut tiles {
        for (&row, &of) in list.row.iter().zip(&list.emissive) {
            radiance.rgb.add(row as usize, emissive.radiance[of as usize].map(|part| 2.0 * part));
        }
    }
}

/// Light that falls obliquely counts in full.
pub fn no_cosine(mut tiles: Query<(&Surfaces, &mut ShadowRays)>) {
    for (surfaces, mut rays) in &mut tiles {
        for ray in 0..rays.rows() {
            let normal = surfaces.get(rays.row[ray] as usize).normal;
            let cosine = normal.dot(rays.direction(ray));
            let carried = rays.irradiance(ray);
            rays.irradiance.put(ray, carried.map(|part| part / cosine));
        }
    }
}

/// What stands behind a light blocks it too.
pub fn endless_t_max(mut tiles: Query<&mut ShadowHits>) {
    for mut hits in &mut tiles {
        hits.t.fill(f64::INFINITY);
    }
}

/// No sphere is ever in the way.
pub fn spheres_ignored() {}

/// No ellipsoid is looked for.
pub fn ellipsoids_ignored() {}

/// No disk is looked for.
pub fn disks_ignored() {}

/// No rectangle is looked for.
pub fn rectangles_ignored() {}

/// No cuboid is looked for.
pub fn cuboids_ignored() {}

/// A plane behind the ray counts as before it.
pub fn behind_counts(planes: Res<Shared<PlaneTable>>, mut tiles: Query<(&ShadowRays, &mut ShadowHits)>) {
    for (rays, mut hits) in &mut tiles {
        for ray in 0..rays.rows() {
            let origin = rays.origin_of(ray);
            let direction = rays.direction_of(ray);
            for (plane, row) in planes.row.iter().enumerate() {
                let t = ((row.offset - row.normal.dot(origin)) / row.normal.dot(direction)).abs();
                if t < hits.t[ray] {
                    (hits.t[ray], hits.shape[ray]) = (t, planes.shape[plane]);
                }
            }
        }
    }
}

/// Light arrives whatever stands in between.
pub fn shadow_forgotten(
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Surfaces, &ShadowRays, &mut Radiance)>,
) {
    for (surfaces, rays, mut radiance) in &mut tiles {
        for ray in 0..rays.rows() {
            let path = rays.row[ray] as usize;
            let colour = materials.parameters[surfaces.material[path] as usize].colour;
            let (brdf, irradiance) = (lambertian(colour), rays.irradiance(ray));
            let found = [0, 1, 2].map(|part| brdf[part] * f64::from(irradiance[part]));
            radiance.rgb.add(path, found.map(|part| part as f32));
        }
    }
}

/// Blue, green, red for red, green, blue.
pub fn blue_first(mut tiles: Query<&mut Radiance>) {
    for mut radiance in &mut tiles {
        radiance.rgb.swap(0, 2);
    }
}

/// A view's x painted green and its y red.
pub fn green_first(mut tiles: Query<&mut Radiance>) {
    for mut radiance in &mut tiles {
        radiance.rgb.swap(0, 1);
    }
}

/// A sample added twice and counted once.
pub fn added_twice(mut tiles: Query<&mut FilmTile>) {
    for mut film in &mut tiles {
        let film = &mut *film;
        film.sum.iter_mut().flatten().for_each(|sum| *sum *= 2.0);
    }
}

/// The curve taken of what has been through it already.
pub fn gamma_twice(linear: f32, curve: Curve) -> u8 {
    let once = if linear > 0.0 { srgb_from_linear(f64::from(linear)) as f32 } else { linear };
    byte_from_linear(once, curve)
}
