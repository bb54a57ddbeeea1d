//! How far the columns of a frame are off, at a grid of its pixels.

use super::exact_frame::{Exact, ExactShape};
use crate::measure::exact::{Dyadic, UNIT_ROUNDOFF_F32 as U};
use crate::measure::exact_vector::ExactVector;
use crate::measure::oracle_camera::{ExactCamera, ExactPoint};
use crate::measure::oracle_cuboid::cuboid_hit;
use crate::measure::oracle_disk::disk_hit;
use crate::measure::oracle_ellipsoid::{ellipsoid_hit, excess};
use crate::measure::oracle_plane::{Plane, plane_hit};
use crate::measure::oracle_rectangle::rectangle_hit;
use crate::measure::oracle_sphere::{Sphere, sphere_hit};
use crate::measure::oracle_triangle::triangle_hit;
use bevy_ecs::prelude::*;
use glam::{DVec2, Vec3};
use pinhole::Result;
use pinhole::film::film_stage;
use pinhole::intersect::{self, Hits, NO_SHAPE, Surfaces};
use pinhole::plan::{Stage, VectorRows};
use pinhole::rays::{self, CameraRays, NdcPoints, PixelSamples, RasterPoints, ScreenPoints, Tile, WorldRays};
use pinhole::render::{Inspection, first_bounce_only, inspect};
use pinhole::shade;

/// Pixels that are probed: across and down.
pub const PROBES: [u32; 2] = [24, 14];
/// The side of a tile.
const SIDE: u32 = 32;

/// The errors of the stages that have an exact value to be compared with, by name, in words.
///
/// Errors: what a render would be refused for.
pub fn stage_errors(scene: &World, offer: &[Stage]) -> Result<Vec<(&'static str, String)>> {
    let frame = inspect(scene, &first_bounce_only(offer), SIDE)?;
    let exact = Exact::of(scene, &frame)?;
    let mut worst = Worst::default();
    for (tile, row, pixel) in probes(&frame) {
        probe(&frame.world.entity(tile), row, pixel, &exact, &mut worst);
    }
    let mut errors = worst.in_words();
    let nothing_rounds = [
        intersect::start_stage(),
        intersect::classify_stage(),
        shade::start_stage(),
        shade::start_shadow_stage(),
        film_stage(),
    ];
    errors.extend(nothing_rounds.map(|stage| (stage.name, "exact".to_string())));
    Ok(errors)
}

/// The probed pixels: their tile, their row in it, their place in the image.
fn probes(frame: &Inspection) -> Vec<(Entity, usize, [u32; 2])> {
    let size = [frame.image.width, frame.image.height];
    let along = |axis: usize, step: u32| (2 * step + 1) * size[axis] / (2 * PROBES[axis]);
    let grid = (0..PROBES[1]).flat_map(|down| (0..PROBES[0]).map(move |across| [across, down]));
    let across = size[0].div_ceil(SIDE);
    grid.filter_map(|[right, down]| {
        let [x, y] = [along(0, right), along(1, down)];
        let tile = frame.tiles[(y / SIDE * across + x / SIDE) as usize];
        Some((tile, frame.world.get::<Tile>(tile)?.row_of(x, y)?, [x, y]))
    })
    .collect()
}

/// How many kinds of shape there are.
const KINDS: usize = 7;

/// The worst errors found: of points and rays in pixels, of hits in u of t, of surfaces in u of their numbers.
#[derive(Default)]
struct Worst {
    points: [Option<f64>; 4],
    world: Option<[f64; 2]>,
    hits: [OfKind; KINDS],
    surfaces: [Option<f64>; KINDS],
}

/// The worst error of one kind of shape's hits.
#[derive(Clone, Copy, Default)]
struct OfKind {
    probes: u32,
    misclassified: u32,
    worst: f64,
}

/// Takes note of an error.
fn note(worst: &mut Option<f64>, error: f64) {
    *worst = Some(worst.map_or(error, |worst| worst.max(error)));
}

fn probe(tile: &EntityRef<'_>, row: usize, pixel: [u32; 2], exact: &Exact, worst: &mut Worst) {
    let camera = &exact.camera;
    // A sample's place in its pixel is chosen at random, so it is taken for right; without samples it is the centre.
    let within = match (tile.get::<PixelSamples>(), tile.get::<RasterPoints>()) {
        (Some(_), Some(points)) => points.point(row) - DVec2::from(pixel.map(f64::from)),
        _ => DVec2::splat(0.5),
    };
    let raster = camera.raster(pixel, within);
    let size = DVec2::new(f64::from(camera.width), f64::from(camera.height));
    let rounded = |point: &ExactPoint| DVec2::new(point.x.to_f64(), point.y.to_f64());
    if let Some(points) = tile.get::<RasterPoints>() {
        note(&mut worst.points[0], (points.point(row) - rounded(&raster)).length());
    }
    if let Some(points) = tile.get::<NdcPoints>() {
        let off = points.point(row) - rounded(&camera.ndc(&raster));
        note(&mut worst.points[1], (off * size).length());
    }
    if let Some(points) = tile.get::<ScreenPoints>() {
        let off = points.point(row) - rounded(&camera.screen(&raster));
        note(&mut worst.points[2], off.length() * size.y / 2.0);
    }
    match exact.half_height {
        // Rays through a lens have no exact counterpart here.
        None if tile.contains::<rays::LensPoints>() => {}
        None => probe_perspective(tile, row, &raster, camera, worst),
        Some(half_height) => probe_orthographic(tile, row, &raster, camera, half_height, worst),
    }
    if exact.shapes.is_empty() {
        return;
    }
    if let (Some(world), Some(hits)) = (tile.get::<WorldRays>(), tile.get::<Hits>()) {
        probe_hit(world, hits, row, exact, worst);
        if let Some(surfaces) = tile.get::<Surfaces>() {
            probe_surface(hits.shape[row], surfaces, row, exact, worst);
        }
    }
}

fn probe_perspective(tile: &EntityRef<'_>, row: usize, raster: &ExactPoint, exact: &ExactCamera, worst: &mut Worst) {
    if let Some(rays) = tile.get::<CameraRays>() {
        let direction = rays.direction(row);
        note(&mut worst.points[3], exact.camera_error_in_pixels(direction / -direction.z, raster));
    }
    if let Some(rays) = tile.get::<WorldRays>() {
        let direction = rays.direction(row);
        let errors = [exact.world_error_in_pixels(direction, raster), exact.world_error_in_radians(direction, raster)];
        let [pixels, radians] = worst.world.unwrap_or_default();
        worst.world = Some([pixels.max(errors[0]), radians.max(errors[1])]);
    }
}

/// Origins count in pixels, directions in radians.
fn probe_orthographic(
    tile: &EntityRef<'_>,
    row: usize,
    raster: &ExactPoint,
    exact: &ExactCamera,
    half_height: f64,
    worst: &mut Worst,
) {
    let screen = exact.screen(raster);
    let half = Dyadic::of(half_height);
    let origin = ExactVector { x: &screen.x * &half, y: &screen.y * &half, z: Dyadic::of(0) };
    let pixels = |off: ExactVector| off.squared_length().sqrt() * f64::from(exact.height) / (2.0 * half_height);
    if let Some(rays) = tile.get::<CameraRays>() {
        let measured = ExactVector::of(rays.origin.at(row));
        note(&mut worst.points[3], pixels(measured.minus(&origin)));
    }
    if let Some(rays) = tile.get::<WorldRays>() {
        let axes = [0, 1, 2].map(|axis| ExactVector::of(exact.rotation.row(axis)).dot(&origin));
        let [x, y, z] = axes;
        let measured = ExactVector::of(rays.origin.at(row));
        let direction = ExactVector::of(rays.direction.at(row));
        let across = direction.cross(&ExactVector::of(-exact.rotation.z_axis)).squared_length().sqrt();
        let [most_pixels, most_radians] = worst.world.unwrap_or_default();
        let off = pixels(measured.minus(&ExactVector { x, y, z }));
        worst.world = Some([most_pixels.max(off), most_radians.max(across)]);
    }
}

/// The nearest of all shapes, exactly; the first of equals.
fn exact_nearest(origin: Vec3, direction: Vec3, shapes: &[ExactShape]) -> Option<(usize, Dyadic)> {
    let mut nearest: Option<(usize, Dyadic)> = None;
    for (number, shape) in shapes.iter().enumerate() {
        let t = match shape {
            ExactShape::Sphere(sphere) => sphere_hit(origin, direction, *sphere),
            ExactShape::Plane(plane) => plane_hit(origin, direction, *plane),
            ExactShape::Ellipsoid(ellipsoid) => ellipsoid_hit(origin, direction, ellipsoid),
            ExactShape::Disk(planar) => disk_hit(origin, direction, planar),
            ExactShape::Rectangle(planar) => rectangle_hit(origin, direction, planar),
            ExactShape::Cuboid(slabs) => cuboid_hit(origin, direction, slabs).map(|(t, _)| t),
            ExactShape::Triangle(triangle, _) => triangle_hit(origin, direction, triangle.corners),
        };
        if let Some(t) = t.filter(|t| nearest.as_ref().is_none_or(|(_, nearest)| t < nearest)) {
            nearest = Some((number, t));
        }
    }
    nearest
}

/// 0 for a sphere, and so on.
fn kind(shape: &ExactShape) -> usize {
    match shape {
        ExactShape::Sphere(_) => 0,
        ExactShape::Plane(_) => 1,
        ExactShape::Ellipsoid(_) => 2,
        ExactShape::Disk(_) => 3,
        ExactShape::Rectangle(_) => 4,
        ExactShape::Cuboid(_) => 5,
        ExactShape::Triangle(..) => 6,
    }
}

fn probe_hit(rays: &WorldRays, hits: &Hits, row: usize, exact: &Exact, worst: &mut Worst) {
    let origin = rays.origin(row);
    let direction = rays.direction(row);
    let nearest = exact_nearest(origin, direction, &exact.shapes);
    let found = Some(hits.shape[row] as usize).filter(|_| hits.shape[row] != NO_SHAPE);
    let Some(shape) = found.or(nearest.as_ref().map(|(shape, _)| *shape)) else { return };
    let of_kind = &mut worst.hits[kind(&exact.shapes[shape])];
    of_kind.probes += 1;
    match nearest {
        Some((shape, t)) if found == Some(shape) => {
            let t = t.to_f64();
            of_kind.worst = of_kind.worst.max((hits.t[row] - t).abs() / t / U);
        }
        _ => of_kind.misclassified += 1,
    }
}

fn probe_surface(shape: u32, surfaces: &Surfaces, row: usize, exact: &Exact, worst: &mut Worst) {
    let Some(shape) = exact.shapes.get(shape as usize) else { return };
    let position = surfaces.get(row).position;
    let point = ExactVector::of(position);
    let off = match shape {
        ExactShape::Sphere(Sphere { centre, radius }) => {
            let distance = point.minus(&ExactVector::of(*centre)).length();
            (&distance - &Dyadic::of(*radius)).to_f64().abs() / (U * (centre.length() + radius))
        }
        ExactShape::Plane(Plane { normal, offset }) => {
            let above = &ExactVector::of(*normal).dot(&point) - &Dyadic::of(*offset);
            above.to_f64().abs() / (U * position.as_dvec3().length())
        }
        ExactShape::Ellipsoid(ellipsoid) => {
            // The step to the surface along the gradient 2 AᵀA (x − C) of |A (x − C)|² − 1.
            let (map, place) = (ellipsoid.unit_from_world, position.as_dvec3());
            let gradient = 2.0 * (map.transpose() * (map * (place - ellipsoid.centre))).length();
            excess(place, ellipsoid).to_f64().abs() / gradient / (U * place.length())
        }
        ExactShape::Disk(planar) | ExactShape::Rectangle(planar) => {
            let above = ExactVector::of(planar.normal).dot(&point.minus(&ExactVector::of(planar.centre)));
            above.to_f64().abs() / (U * position.as_dvec3().length())
        }
        ExactShape::Cuboid(slabs) => {
            let from_centre = point.minus(&ExactVector::of(slabs.centre));
            let beyond = |axis: usize| {
                let along = ExactVector::of(slabs.normal[axis]).dot(&from_centre).abs();
                (&along - &Dyadic::of(slabs.half[axis])).to_f64()
            };
            // Within rounding of one face, behind the others.
            let farthest = beyond(0).max(beyond(1)).max(beyond(2));
            farthest.abs() / (U * position.as_dvec3().length())
        }
        ExactShape::Triangle(triangle, normal) => {
            let above = ExactVector::of(*normal).dot(&point.minus(&ExactVector::of(triangle.corners[0])));
            above.to_f64().abs() / (U * position.as_dvec3().length())
        }
    };
    note(&mut worst.surfaces[kind(shape)], off);
}

impl Worst {
    fn in_words(&self) -> Vec<(&'static str, String)> {
        let in_pixels = |error: f64| if error == 0.0 { "exact".into() } else { format!("{error:.1e} px") };
        let rays = [rays::perspective_stage().name, rays::orthographic_stage().name];
        let points = [rays::raster_stage().name, rays::ndc_stage().name, rays::screen_stage().name];
        let mut words = Vec::new();
        for (stage, error) in
            points.into_iter().zip(self.points).chain(rays.into_iter().map(|name| (name, self.points[3])))
        {
            words.extend(error.map(|error| (stage, in_pixels(error))));
        }
        let world = self.world.map(|[pixels, radians]| format!("{pixels:.1e} px, {radians:.1e} rad"));
        words.extend(world.map(|world| (rays::world_stage().name, world)));
        let hit_stages = [
            intersect::sphere_stage(),
            intersect::plane_stage(),
            intersect::ellipsoid_stage(),
            intersect::disk_stage(),
            intersect::rectangle_stage(),
            intersect::cuboid_stage(),
            intersect::triangle_stage(),
        ]
        .map(|stage| stage.name);
        for (stage, OfKind { probes, misclassified, worst }) in hit_stages.into_iter().zip(self.hits) {
            let error = format!("{worst:.0e} u of t, {misclassified} of {probes} wrong");
            words.extend((probes > 0).then_some((stage, error)));
        }
        let surface_stages = [
            (intersect::sphere_surface_stage(), "|c| + r"),
            (intersect::plane_surface_stage(), "|p|"),
            (intersect::ellipsoid_surface_stage(), "|p|"),
            (intersect::disk_surface_stage(), "|p|"),
            (intersect::rectangle_surface_stage(), "|p|"),
            (intersect::cuboid_surface_stage(), "|p|"),
            (intersect::triangle_surface_stage(), "|p|"),
        ];
        for ((stage, size), worst) in surface_stages.into_iter().zip(self.surfaces) {
            words.extend(worst.map(|worst| (stage.name, format!("{worst:.2} u of {size} off it"))));
        }
        words
    }
}
