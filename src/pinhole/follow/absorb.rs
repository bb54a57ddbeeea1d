//! Light that glass absorbs along the segments of paths: along each ray, and along each shadow ray.

use super::interface::{Interface, InterfaceView};
use super::{Media, Scattered};
use crate::each::Each;
use crate::extract::{GlassTable, MaterialTable, NO_ROW, absorption_evidence, followed_evidence};
use crate::intersect::{Hits, NO_SHAPE, Surface, Surfaces};
use crate::plan::{Column, Shared, Stage, TileSystems, VectorRowsMut};
use crate::rays::Paths;
use crate::shade::{ShadowHits, ShadowRays, light_distance, shadow_evidence};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// The transmittance of a glass along a way of this length, colour by colour.
#[inline(always)]
fn transmittances(glass: &GlassTable, row: u32, length: f64) -> [f64; 3] {
    glass.absorption[row as usize].each(|absorption| transmittance(absorption, length))
}

/// How far a ray that starts off a surface has come from it: its origin lies there by the error bound of the hit, along the
/// normal.
///
/// In thin glass that is not little: at a distance of 10 from the eye it is 3e-6.
#[inline(always)]
fn passed_at_start(surface: &Surface, origin: DVec3, direction: DVec3) -> f64 {
    let normal = surface.normal.as_dvec3();
    let (off, cosine) = ((origin - surface.position.as_dvec3()).dot(normal), direction.dot(normal));
    // Away from the surface both have one sign.
    if off * cosine > 0.0 { off / cosine } else { 0.0 }
}

/// Multiplies the throughput of each scattered ray by the transmittance of the glass between the surface and its origin.
pub fn absorb_at_start(glass: Res<Shared<GlassTable>>, mut tiles: Query<(&Surfaces, &Media, &mut Scattered)>) {
    for (surfaces, media, mut rays) in &mut tiles {
        for ray in 0..rays.rows() {
            let there = media.get(ray).top();
            if there == NO_ROW {
                continue;
            }
            let surface = surfaces.get(rays.row[ray] as usize);
            let passed = passed_at_start(&surface, rays.origin_of(ray), rays.direction_of(ray));
            rays.throughput.scale(ray, transmittances(&glass, there, passed));
        }
    }
}

/// Multiplies each path's throughput by the transmittance of the glass along its ray, which is 0 for an infinite ray.
pub fn absorb_in_glass(glass: Res<Shared<GlassTable>>, mut tiles: Query<(&Hits, &Media, &mut Paths)>) {
    for (hits, media, mut paths) in &mut tiles {
        let paths = &mut *paths;
        for row in 0..hits.rows() {
            let there = media.get(row).top();
            if there == NO_ROW {
                continue;
            }
            paths.throughput.scale(row, transmittances(&glass, there, hits.t[row]));
        }
    }
}

// ANCHOR: absorb_shadow_rays
/// Multiplies the light of each unblocked shadow ray by the transmittance of the glass that it runs through: nothing is
/// between its ends, so that is the medium in front of the surface, or beyond it where the light is behind.
///
/// A light that casts no shadow shines as if nothing were there, glass as little as anything else.
pub fn absorb_shadow_rays(
    (glass, materials): (Res<Shared<GlassTable>>, Res<Shared<MaterialTable>>),
    mut tiles: Query<(&Surfaces, InterfaceView, Option<&ShadowHits>, &mut ShadowRays)>,
) {
    for (surfaces, interface, hits, mut rays) in &mut tiles {
        let interface = Interface::new(interface, Some(&glass));
        for ray in 0..rays.rows() {
            if hits.is_some_and(|hits| hits.shape[ray] != NO_SHAPE) || rays.t_max[ray] == 0.0 {
                continue;
            }
            let row = rays.row[ray] as usize;
            let surface = surfaces.get(row);
            let [near, far] = interface.media(materials.interior[surface.material as usize], row);
            let is_behind = rays.direction_of(ray).dot(surface.normal.as_dvec3()) < 0.0;
            let there = if is_behind { far } else { near };
            if there != NO_ROW {
                let passed = passed_at_start(&surface, rays.origin_of(ray), rays.direction_of(ray));
                let length = passed + light_distance(rays.t_max[ray]);
                rays.weight_by(ray, transmittances(&glass, there, length));
            }
        }
    }
}
// ANCHOR_END: absorb_shadow_rays

/// The stage that absorbs along rays.
pub fn absorb_stage() -> Stage {
    Stage::new("Absorb light in glass", TileSystems::Absorb, absorb_in_glass)
        .when(|scene| absorption_evidence(scene).and(|| followed_evidence(scene)))
}

/// The stage that absorbs between surfaces and the rays that start off them.
pub fn absorb_at_start_stage() -> Stage {
    Stage::new("Absorb light at the start of rays", TileSystems::Step, absorb_at_start)
        .when(|scene| absorption_evidence(scene).and(|| followed_evidence(scene)))
}

/// The stage that absorbs along shadow rays.
pub fn absorb_shadow_stage() -> Stage {
    Stage::new("Absorb light along shadow rays", TileSystems::AbsorbShadowRays, absorb_shadow_rays).when(|scene| {
        let absorbs = absorption_evidence(scene).and(|| followed_evidence(scene));
        absorbs.and(|| shadow_evidence(scene))
    })
}

// ANCHOR: transmittance
/// The transmittance of a path of this length: e^(−σt), with σ the absorption coefficient per scene unit (Beer's law).
#[inline(always)]
pub fn transmittance(absorption: f64, length: f64) -> f64 {
    // An infinite path through clear glass would give 0 · ∞.
    if absorption > 0.0 { libm::exp(-absorption * length) } else { 1.0 }
}

/// The fraction of light absorbed along a path of this length: 1 − e^(−σt), to full precision where it is small.
#[inline(always)]
pub fn absorbed(absorption: f64, length: f64) -> f64 {
    if absorption > 0.0 { -libm::expm1(-absorption * length) } else { 0.0 }
}
// ANCHOR_END: transmittance

#[cfg(test)]
mod beer_tests {
    use super::*;

    #[test]
    fn absorbed_and_transmitted_add_up_to_one() {
        let mut worst = 0.0_f64;
        for step in 0..=4000 {
            let thickness = libm::exp10(f64::from(step) / 100.0 - 30.0);
            for absorption in [1e-3, 1.0, 40.0] {
                let (left, absorbed) = (transmittance(absorption, thickness), absorbed(absorption, thickness));
                assert!((0.0..=1.0).contains(&left) && (0.0..=1.0).contains(&absorbed));
                worst = worst.max((left + absorbed - 1.0).abs());
                let depth = absorption * thickness;
                if depth < 1e-4 {
                    // The Taylor series, whose next term is below 1e-14 of its value.
                    let series = depth * (1.0 - 0.5 * depth * (1.0 - depth / 3.0 * (1.0 - 0.25 * depth)));
                    assert!((absorbed / series - 1.0).abs() < 1e-15, "{depth}");
                }
            }
        }
        assert!(worst <= f64::EPSILON, "{worst}");
        eprintln!("absorption: 12003 optical depths from 1e-33 to 4e11, sum off by at most {worst:.1e}");
    }

    #[test]
    fn transmittances_multiply() {
        for (first, second) in [(0.1, 0.7), (1e-9, 3.0), (20.0, 30.0)] {
            let parts = transmittance(1.7, first) * transmittance(1.7, second);
            assert!((parts / transmittance(1.7, first + second) - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn infinite_paths() {
        assert_eq!([transmittance(0.0, f64::INFINITY), transmittance(1e-9, f64::INFINITY)], [1.0, 0.0]);
        assert_eq!([absorbed(0.0, f64::INFINITY), absorbed(1e-9, f64::INFINITY)], [0.0, 1.0]);
    }
}
