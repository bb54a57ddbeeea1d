//! Photons: light paths that end where light from mirrors and glass first meets anything else, and their density.
//!
//! Reads: [`MaterialRows`] of light paths, and of camera paths at every bounce.
//! Writes: [`Photons`], which between the two passes become a [`PhotonMap`]; then [`Radiance`].
//! Space: render space.

use super::interface::{Interface, InterfaceView};
use super::{CausticPaths, LightPower};
use crate::each::Each;
use crate::extract::{GlassTable, IntegratorTable, MaterialTable, bsdf_evidence, photon_evidence};
use crate::intersect::{MaterialRows, ShadingNormals, Surfaces};
use crate::material::{Bsdf, Transport};
use crate::plan::{Census, Column, Shared, Stage, StageKind, Table, TileSystems, VectorRowsMut, column};
use crate::rays::{Depth, Paths, WorldRays};
use crate::scene::SceneError;
use crate::shade::{ParameterColumns, Radiance};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

column! {
    /// The photons of a batch of light paths, in the order of bounces and paths.
    pub struct Photons("photons", "world, from the eye", "scene units; linear Rec. 709", Film) {
        /// Where the light arrives.
        position: Vec3 as [x, y, z],
        /// Where it comes from; a unit vector.
        to_light: Vec3 as [tx, ty, tz],
        /// The power that the path carries, divided by the pdf of its start.
        power: [f64; 3] as [r, g, b],
        /// The segments of the path from the light to here.
        segments: u32,
    }
}

impl Photons {
    /// The power that is carried.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.power(row).each(|part| part as f32)
    }
}

/// Light paths where they meet what is not specular, and the photons that become of them.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct StoreView {
    depth: &'static Depth,
    rays: &'static WorldRays,
    paths: &'static Paths,
    surfaces: &'static Surfaces,
    power: &'static LightPower,
    list: &'static mut MaterialRows,
    photons: &'static mut Photons,
}

// ANCHOR: store_photons
/// Ends every light path that meets a surface that is not specular, and stores a photon there.
pub fn store_photons(mut tiles: Query<StoreView>) {
    for StoreViewItem { depth, rays, paths, surfaces, power, mut list, mut photons } in &mut tiles {
        let before = photons.rows();
        let (mut position, mut to_light, mut powers, segments) = photons.slices_mut(before + list.row.len());
        for (at, &row) in (before..).zip(&list.row) {
            let row = row as usize;
            position.put(at, surfaces.get(row).position);
            to_light.put(at, -rays.direction_of(row).as_vec3());
            let (whole, carried) = (power.rgb(paths.first[row] as usize), paths.throughput(row));
            powers.put(at, [0, 1, 2].each(|part| whole[part] * carried[part]));
            segments[at] = depth.0 + 1;
        }
        list.row.clear();
    }
}
// ANCHOR_END: store_photons

/// The stage that runs [`store_photons`].
pub fn store_photons_stage() -> Stage {
    Stage::new("Store photons", TileSystems::SampleLights, store_photons)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .changes::<MaterialRows>()
        .when(photon_evidence)
}

/// The power of one light path where it ended.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Photon {
    /// Where, in render space.
    pub position: Vec3,
    /// The direction to where it came from; a unit vector.
    pub to_light: Vec3,
    /// Red, green and blue, divided by the number of light paths.
    pub power: [f32; 3],
    /// The segments of its path.
    pub segments: u32,
}

/// Bytes of a light path that ends as a photon: in its batch's columns, in the list of all, and in the map.
pub const PHOTON_BYTES: u64 =
    (size_of::<[f32; 6]>() + size_of::<[f64; 3]>() + size_of::<u32>() + 2 * size_of::<Photon>()) as u64;

/// The photons of one sample, in a grid whose cells are twice the radius wide.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PhotonMap {
    /// The photons, cell by cell.
    photons: Vec<Photon>,
    /// Where those of each bucket begin, and the end; a power of two of buckets, which share the cells.
    first: Vec<u32>,
    /// The radius within which photons are counted, in scene units.
    radius: f64,
}

impl Table for PhotonMap {
    const NAME: &'static str = "photon map";

    /// Without photons: each sample has its own, which are traced before it.
    fn extract(_: &Census<'_>) -> Result<Self, SceneError> {
        Ok(Self::default())
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.photons[..]) + size_of_val(&self.first[..])
    }
}

impl PhotonMap {
    // ANCHOR: photon_grid
    /// The map of these photons, those of each bucket in the order that they have here.
    pub fn new(photons: &[Photon], radius: f64) -> Self {
        let buckets = photons.len().next_power_of_two();
        let room = vec![Photon::default(); photons.len()];
        let mut map = Self { photons: room, first: vec![0; buckets + 1], radius };
        let bucket_of = |photon: &Photon| bucket(cell_of(photon.position.as_dvec3(), radius), buckets);
        // How many lie in each bucket, then where each bucket ends, then back to where it begins.
        for photon in photons {
            map.first[bucket_of(photon)] += 1;
        }
        let mut sum = 0;
        for count in &mut map.first {
            sum += *count;
            *count = sum;
        }
        for photon in photons.iter().rev() {
            let first = &mut map.first[bucket_of(photon)];
            *first -= 1;
            map.photons[*first as usize] = *photon;
        }
        map
    }
    // ANCHOR_END: photon_grid

    /// Visits the photons within the radius of a point, each once.
    #[inline(always)]
    pub fn visit(&self, point: DVec3, mut found: impl FnMut(&Photon)) {
        let reach = DVec3::splat(self.radius);
        let [low, high] = [point - reach, point + reach].each(|corner| cell_of(corner, self.radius));
        // A cell is as wide as the sphere, which so overlaps at most eight; two of them may share a bucket.
        let (mut visited, mut count) = ([usize::MAX; 8], 0);
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    let own = bucket([x, y, z], self.first.len() - 1);
                    if count == visited.len() || visited[..count].contains(&own) {
                        continue;
                    }
                    visited[count] = own;
                    count += 1;
                    let [from, to] = [self.first[own], self.first[own + 1]].each(|at| at as usize);
                    for photon in &self.photons[from..to] {
                        if (photon.position.as_dvec3() - point).length_squared() <= self.radius * self.radius {
                            found(photon);
                        }
                    }
                }
            }
        }
    }

    /// Whether there is nothing to gather.
    pub fn is_empty(&self) -> bool {
        self.photons.is_empty()
    }

    /// The radius, in scene units.
    pub fn radius(&self) -> f64 {
        self.radius
    }
}

/// The cell of a point, where cells are twice the radius wide.
#[inline(always)]
fn cell_of(point: DVec3, radius: f64) -> [i64; 3] {
    (point / (2.0 * radius)).floor().to_array().each(|part| part as i64)
}

/// The bucket of a cell, among a power of two of them (Teschner et al. 2003).
#[inline(always)]
fn bucket([x, y, z]: [i64; 3], buckets: usize) -> usize {
    let mixed = x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663) ^ z.wrapping_mul(83_492_791);
    // The upper bits depend on all of a product.
    (mixed.wrapping_mul(-7_046_029_254_386_353_131) as u64 >> 32) as usize & (buckets - 1)
}

/// How fast the radius becomes smaller: the number of photons within it grows by this power of the number of samples.
const GROWTH: f64 = 2.0 / 3.0;

// ANCHOR: photon_radius
/// The radius for a sample, counted from 0: r² is multiplied by (i + α) / (i + 1) from the i-th sample to the next
/// (Knaus and Zwicker 2011).
///
/// The product of these factors is Γ(i + α) / (Γ(1 + α) Γ(i + 1)), with i from 1 on.
pub fn photon_radius(first: f64, sample: u32) -> f64 {
    let i = f64::from(sample) + 1.0;
    let squared = libm::lgamma(i + GROWTH) - libm::lgamma(1.0 + GROWTH) - libm::lgamma(i + 1.0);
    first * libm::exp(0.5 * (squared + libm::lgamma(2.0)))
}
// ANCHOR_END: photon_radius

/// How many photons the first radius is to hold.
const HELD: usize = 10;
/// Of at most how many photons the distances are measured, and to how many others.
const MAX_ASKED: usize = 256;
const MAX_OTHERS: usize = 1 << 16;

/// The fewest pixels of a radius: what is smaller does not show, and where photons lie far apart each would.
const PIXELS: f64 = 1.5;

/// The radius for the first sample: that which holds about ten photons around half of these photons, or some pixels where
/// they are seen if that is more, and 1 where there are too few to tell.
///
/// A pixel is as wide as the first number, in scene units, and the second for each at which it is seen.
pub fn first_radius(photons: &[Photon], [pixel, by_distance]: [f64; 2]) -> f64 {
    let mut distances: Vec<f64> = photons.iter().map(|photon| photon.position.as_dvec3().length()).collect();
    let middle = distances.len() / 2;
    let distance = if distances.is_empty() { 0.0 } else { *distances.select_nth_unstable_by(middle, f64::total_cmp).1 };
    radius_of_ten(photons).max(PIXELS * (pixel + by_distance * distance))
}

/// The radius that holds about ten photons around half of these photons; 1 where there are too few to tell.
fn radius_of_ten(photons: &[Photon]) -> f64 {
    // Of every how many of them the distances are measured; the others are taken to lie as densely.
    let step = photons.len().div_ceil(MAX_OTHERS).max(1);
    let others: Vec<DVec3> = photons.iter().step_by(step).map(|photon| photon.position.as_dvec3()).collect();
    let nth = HELD.div_ceil(step);
    if others.len() <= nth {
        return 1.0;
    }
    let distance = |from: &DVec3| {
        let mut squares: Vec<f64> = others.iter().map(|to| (*to - *from).length_squared()).collect();
        *squares.select_nth_unstable_by(nth, f64::total_cmp).1
    };
    let mut squares: Vec<f64> = others.iter().step_by(others.len().div_ceil(MAX_ASKED)).map(distance).collect();
    let middle = squares.len() / 2;
    let square = *squares.select_nth_unstable_by(middle, f64::total_cmp).1;
    let radius = (square * HELD as f64 / (nth * step) as f64).sqrt();
    if radius > 0.0 && radius.is_finite() { radius } else { 1.0 }
}

/// What camera paths see, and the radiance that photons add to.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct GatherView {
    depth: &'static Depth,
    eye: &'static WorldRays,
    surfaces: &'static Surfaces,
    shading: Option<&'static ShadingNormals>,
    list: &'static MaterialRows,
    radiance: &'static mut Radiance,
}

/// The part of the radius that a photon may be off the plane of the surface that counts it.
const FLATNESS: f64 = 0.25;

// ANCHOR: gather_photons
/// Adds the light of the photons around every surface that has this BSDF: their power over the area of the disk is an
/// irradiance, and each has a direction.
pub fn gather_photons<B: Bsdf>(
    (materials, bsdf, glass): (Res<Shared<MaterialTable>>, Res<Shared<B>>, Option<Res<Shared<GlassTable>>>),
    (map, integrator): (Res<Shared<PhotonMap>>, Res<Shared<IntegratorTable>>),
    mut tiles: Query<(GatherView, ParameterColumns, InterfaceView)>,
) {
    if map.is_empty() {
        return;
    }
    let radius = map.radius();
    for (GatherViewItem { depth, eye, surfaces, shading, list, mut radiance }, columns, interface) in &mut tiles {
        let interface = Interface::new(interface, glass.as_deref());
        let so_far = depth.0 + 1;
        for &row in &list.row {
            let row = row as usize;
            let surface = surfaces.get(row);
            let material = surface.material as usize;
            if materials.kind[material] != B::KIND {
                continue;
            }
            let (point, normal) = (surface.position.as_dvec3(), surface.normal.as_dvec3());
            let shaded = shading.map_or(normal, |shading| shading.get(row));
            let local_from_world = B::frame(shaded).transpose();
            let to_eye = local_from_world * -eye.direction_of(row);
            let of_row = (columns.get(&materials, row, material), row, material);
            let context = super::bsdf::shading_context::<B>(&materials, &interface, of_row, Transport::Radiance);
            let mut sum = [0.0; 3];
            map.visit(point, |photon| {
                let to_light = photon.to_light.as_dvec3();
                let (cosine, off) = (to_light.dot(normal), (photon.position.as_dvec3() - point).dot(normal));
                let arrives = cosine > 0.0 || (B::TRANSMITS && cosine < 0.0);
                let is_short = photon.segments.saturating_add(so_far) <= integrator.max_depth;
                if !arrives || !is_short || off.abs() > FLATNESS * radius {
                    return;
                }
                // Light is counted by the cosine to the shading normal, and came by that to the surface (Veach 1997, 5.3).
                let counted = (to_light.dot(shaded) / cosine).max(0.0);
                let reflected = bsdf.eval(&context, local_from_world * to_light, to_eye);
                for part in 0..3 {
                    sum[part] += reflected[part] * counted * f64::from(photon.power[part]);
                }
            });
            let of_disk = 1.0 / (PI * radius * radius);
            radiance.rgb.add(row, sum.each(|part| (part * of_disk).min(f64::from(f32::MAX)) as f32));
        }
    }
}
// ANCHOR_END: gather_photons

/// The stage that gathers photons at surfaces with a BSDF.
pub fn gather_photons_stage<B: Bsdf>() -> Stage {
    super::bsdf::at_interfaces::<B>(Stage::new(B::NAMES.photons, TileSystems::Shade, gather_photons::<B>))
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .when(|scene| photon_evidence(scene).and(|| bsdf_evidence::<B>(scene)))
}

/// Marks no camera path before its first surface.
pub fn start_photon_paths(mut tiles: Query<(&WorldRays, &mut CausticPaths)>) {
    tiles.iter_mut().for_each(|(rays, mut caustic)| caustic.slices_mut(rays.rows()).fill(0));
}

/// The stage that runs [`start_photon_paths`].
pub fn start_photon_paths_stage() -> Stage {
    Stage::new("Mark no path as one with photons", TileSystems::Start, start_photon_paths)
        .on_camera_paths()
        .on_first_bounce()
        .kind(StageKind::Alternative)
        .when(photon_evidence)
}

/// Marks the camera paths that have met a surface that is not specular: from there on, light that they find behind
/// mirrors or glass is the photons'.
pub fn mark_photon_paths(mut tiles: Query<(&Paths, &MaterialRows, &mut CausticPaths)>) {
    for (paths, list, mut caustic) in &mut tiles {
        for &row in &list.row {
            caustic.spread[paths.first[row as usize] as usize] = 1;
        }
    }
}

/// The stage that runs [`mark_photon_paths`].
pub fn mark_photon_paths_stage() -> Stage {
    Stage::new("Mark paths with photons", TileSystems::Step, mark_photon_paths)
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .changes::<CausticPaths>()
        .when(photon_evidence)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    fn some_photons(seed: u64, count: usize, within: f64) -> Vec<Photon> {
        let mut draws = Draws::new(seed, 0);
        let photon = |_| Photon {
            position: (draws.unit_vector() * within * draws.unit()).as_vec3(),
            to_light: Vec3::Y,
            power: [1.0; 3],
            segments: 2,
        };
        (0..count).map(photon).collect()
    }

    /// Against asking every photon, for radii so small that a cell holds none and so large that one holds all.
    #[test]
    fn every_photon_within_the_radius_is_visited_once() {
        let (mut asked, mut found) = (0, 0);
        for (seed, (count, radius)) in
            (38..).zip([(0, 1.0), (1, 1.0), (2000, 0.02), (2000, 0.3), (500, 1e6), (2000, 1e-9), (1000, 2.0)])
        {
            let photons = some_photons(seed, count, 3.0);
            let map = PhotonMap::new(&photons, radius);
            let mut points: Vec<DVec3> =
                some_photons(seed + 100, 200, 4.0).iter().map(|one| one.position.as_dvec3()).collect();
            points.extend(photons.iter().take(50).map(|one| one.position.as_dvec3()));
            for point in points {
                let is_near =
                    |photon: &&Photon| (photon.position.as_dvec3() - point).length_squared() <= radius * radius;
                let mut right: Vec<[u32; 3]> =
                    photons.iter().filter(is_near).map(|one| one.position.to_array().map(f32::to_bits)).collect();
                let mut visited = Vec::new();
                map.visit(point, |photon| visited.push(photon.position.to_array().map(f32::to_bits)));
                right.sort_unstable();
                visited.sort_unstable();
                assert_eq!(right, visited, "{count} photons, radius {radius}, {point}");
                (asked, found) = (asked + 1, found + visited.len());
            }
        }
        eprintln!("photons: {asked} points, {found} photons within a radius, 0 missed or counted twice");
    }

    #[test]
    fn the_radius_shrinks_by_its_factors() {
        let (mut squared, mut worst) = (1.0, 0.0_f64);
        for sample in 0..4096 {
            worst = worst.max((photon_radius(1.0, sample) / f64::sqrt(squared) - 1.0).abs());
            let i = f64::from(sample) + 1.0;
            squared *= (i + GROWTH) / (i + 1.0);
        }
        // Logarithms of Γ near 30,000, each within 2⁻⁵³ of its own size.
        assert!(worst < 3e-11, "{worst}");
        assert_eq!(photon_radius(0.25, 0), 0.25);
    }

    /// Photons in a square of area 1, so that a disk of area 10/n holds ten.
    #[test]
    fn the_first_radius_holds_ten_photons() {
        for count in [2000_usize, 300_000] {
            let mut draws = Draws::new(3801, count as u64);
            let photon = |_| Photon {
                position: Vec3::new(draws.unit() as f32, 0.0, draws.unit() as f32),
                to_light: Vec3::Y,
                power: [1.0; 3],
                segments: 2,
            };
            let photons: Vec<Photon> = (0..count).map(photon).collect();
            let radius = first_radius(&photons, [0.0; 2]);
            let held = PI * radius * radius * count as f64;
            assert!((7.0..15.0).contains(&held), "{count}: {held}");
        }
        let of = |photons: &[Photon]| first_radius(photons, [0.0; 2]);
        assert_eq!([of(&[]), of(&some_photons(1, 3, 1.0))], [1.0; 2]);
        assert_eq!(of(&[some_photons(1, 1, 1.0)[0]; 40]), 1.0, "all at one point");
        assert_eq!(first_radius(&[some_photons(1, 1, 1.0)[0]; 40], [4.0, 0.0]), 6.0, "never less than some pixels");
    }
}
