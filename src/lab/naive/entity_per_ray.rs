//! The renderer that bevy_ecs seems to ask for: an entity for every ray, a component for every stage.
//!
//! It calls pinhole's own functions of one row and reads pinhole's own tables, so its image is pinhole's to the last bit;
//! what differs is where the numbers lie.
//! It renders unlit scenes of spheres and planes under a perspective camera, on one thread.

use bevy_ecs::prelude::*;
use bevy_ecs::schedule::SingleThreadedExecutor;
use glam::{DVec2, DVec3, Vec3};
use pinhole::extract::{
    BackgroundTable, CameraAxes, ImageFrame, MaterialTable, NO_ROW, PerspectiveProjection, PlaneTable, ShapeTable,
    SphereTable,
};
use pinhole::film::Film;
use pinhole::intersect::{self, NO_SHAPE};
use pinhole::plan::{Census, Sample, Shared, Table, VectorRowsMut};
use pinhole::rays::{camera_ray_perspective, ndc_from_raster, raster_from_pixel, screen_from_ndc};
use pinhole::scene::SceneError;
use pinhole::shapes::{RayHit, ShapeKind, l1_norm, nearness, plane_t, sphere_t};

// ANCHOR: entity_per_ray
/// Which pixel an entity is.
#[derive(Component, Clone, Copy)]
struct Pixel([u32; 2]);

#[derive(Component, Clone, Copy, Default)]
struct RasterPoint(DVec2);

#[derive(Component, Clone, Copy, Default)]
struct NdcPoint(DVec2);

#[derive(Component, Clone, Copy, Default)]
struct ScreenPoint(DVec2);

#[derive(Component, Clone, Copy, Default)]
struct CameraRay([DVec3; 2]);

#[derive(Component, Clone, Copy, Default)]
struct WorldRay([Vec3; 2]);

#[derive(Component, Clone, Copy)]
struct Hit {
    t: f64,
    shape: u32,
}

#[derive(Component, Clone, Copy, Default)]
struct Surface(intersect::Surface);

#[derive(Component, Clone, Copy, Default)]
struct Radiance([f32; 3]);

/// Sums and count, as the film has them.
#[derive(Component, Clone, Copy, Default)]
struct FilmSum([f64; 3], u32);
// ANCHOR_END: entity_per_ray

/// A world with an entity for each pixel, and the systems that carry each from its pixel to light.
pub struct EntityPerRay {
    world: World,
    schedule: Schedule,
    image: ImageFrame,
}

impl EntityPerRay {
    /// Reads the scene's tables and spawns the entities.
    ///
    /// Errors: what pinhole refuses the scene for.
    pub fn spawn(scene: &World) -> Result<Self, SceneError> {
        let census = &Census::of(scene);
        pinhole::extract::validate(census)?;
        let shapes = census.table::<ShapeTable>()?;
        if shapes.kind.iter().any(|kind| !matches!(kind, ShapeKind::Sphere | ShapeKind::Plane)) {
            let accepted = "one entity a ray knows evenly scaled spheres and planes only";
            return Err(SceneError::new("the scene", "shapes", "another kind of shape", accepted));
        }
        if shapes.material.contains(&NO_ROW) {
            let accepted = "one entity a ray knows shapes that reflect light only";
            return Err(SceneError::new("the scene", "shapes", "a shape without a material", accepted));
        }
        let mut world = World::new();
        shared::<PerspectiveProjection>(&mut world, census)?;
        shared::<CameraAxes>(&mut world, census)?;
        shared::<SphereTable>(&mut world, census)?;
        shared::<PlaneTable>(&mut world, census)?;
        shared::<ShapeTable>(&mut world, census)?;
        shared::<MaterialTable>(&mut world, census)?;
        shared::<BackgroundTable>(&mut world, census)?;
        let image = shared::<ImageFrame>(&mut world, census)?;
        let pixels = (0..image.height).flat_map(|y| (0..image.width).map(move |x| Pixel([x, y])));
        let nothing = Hit { t: f64::INFINITY, shape: NO_SHAPE };
        let (points, rays) = ((RasterPoint::default(), NdcPoint::default(), ScreenPoint::default()), nothing);
        let empty = (CameraRay::default(), WorldRay::default(), Surface::default(), Radiance::default());
        world.spawn_batch(pixels.map(move |pixel| (pixel, points, rays, empty, FilmSum::default())));
        let mut schedule = Schedule::new(Sample);
        schedule.set_executor(SingleThreadedExecutor::new());
        let to_world = (place, free_of_size, centre, aim, turn);
        schedule.add_systems((to_world.chain(), (intersect, describe, shade, add).chain()).chain());
        Ok(Self { world, schedule, image })
    }

    /// Runs every system once over all entities.
    pub fn run(&mut self) {
        self.schedule.run(&mut self.world);
    }

    /// The light that arrived, as a film of pinhole's.
    pub fn film(&mut self) -> Film {
        let mut film = Film::new(self.image.width, self.image.height, 32);
        let across = self.image.width.div_ceil(32);
        for (pixel, sum) in self.world.query::<(&Pixel, &FilmSum)>().iter(&self.world) {
            let [x, y] = pixel.0;
            let tile = &mut film.tiles[(y / 32 * across + x / 32) as usize];
            if let Some(row) = tile.tile.row_of(x, y) {
                tile.sum.put(row, sum.0);
                tile.count[row] = sum.1;
            }
        }
        film
    }
}

/// Puts a table of the scene where systems find it.
fn shared<T: Table + Clone>(world: &mut World, scene: &Census<'_>) -> Result<T, SceneError> {
    let table = T::clone(&*scene.table::<T>()?);
    world.insert_resource(Shared::new(table.clone()));
    Ok(table)
}

// ANCHOR: place
fn place(mut rays: Query<(&Pixel, &mut RasterPoint)>) {
    for (pixel, mut raster) in &mut rays {
        raster.0 = raster_from_pixel(pixel.0[0], pixel.0[1]);
    }
}
// ANCHOR_END: place

fn free_of_size(image: Res<Shared<ImageFrame>>, mut rays: Query<(&RasterPoint, &mut NdcPoint)>) {
    for (raster, mut ndc) in &mut rays {
        ndc.0 = ndc_from_raster(raster.0, image.size());
    }
}

fn centre(image: Res<Shared<ImageFrame>>, mut rays: Query<(&NdcPoint, &mut ScreenPoint)>) {
    for (ndc, mut screen) in &mut rays {
        screen.0 = screen_from_ndc(ndc.0, image.aspect());
    }
}

fn aim(lens: Res<Shared<PerspectiveProjection>>, mut rays: Query<(&ScreenPoint, &mut CameraRay)>) {
    for (screen, mut camera) in &mut rays {
        camera.0[1] = camera_ray_perspective(screen.0, lens.tan_half_vertical);
    }
}

fn turn(axes: Res<Shared<CameraAxes>>, mut rays: Query<(&CameraRay, &mut WorldRay)>) {
    for (camera, mut world) in &mut rays {
        world.0[1] = (axes.world_from_camera * camera.0[1]).as_vec3();
    }
}

fn intersect(
    spheres: Res<Shared<SphereTable>>,
    planes: Res<Shared<PlaneTable>>,
    mut rays: Query<(&WorldRay, &mut Hit)>,
) {
    for (ray, mut hit) in &mut rays {
        let [origin, direction] = ray.0.map(|part| part.as_dvec3());
        let inverse = 1.0 / direction.dot(direction);
        *hit = Hit { t: f64::INFINITY, shape: NO_SHAPE };
        for row in 0..spheres.row.len() {
            let (centre, radius) = (spheres.row[row].centre, spheres.row[row].radius);
            if nearness(centre - origin, direction, inverse, radius) >= 0.0 {
                hit.keep_closest(sphere_t(origin, direction, centre, radius), spheres.shape[row]);
            }
        }
        for (plane, &shape) in planes.row.iter().zip(&planes.shape) {
            hit.keep_closest(plane_t(origin, direction, plane.normal, plane.offset), shape);
        }
    }
}

impl Hit {
    fn keep_closest(&mut self, t: f64, shape: u32) {
        if t < self.t || (t == self.t && shape < self.shape && t < f64::INFINITY) {
            *self = Self { t, shape };
        }
    }
}

fn describe(
    spheres: Res<Shared<SphereTable>>,
    planes: Res<Shared<PlaneTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut rays: Query<(&WorldRay, &Hit, &mut Surface)>,
) {
    for (ray, hit, mut surface) in &mut rays {
        if hit.shape == NO_SHAPE {
            continue;
        }
        let shape = hit.shape as usize;
        let (row, material) = (shapes.row[shape] as usize, shapes.material[shape]);
        let [origin, direction] = ray.0.map(|part| part.as_dvec3());
        let point = origin + hit.t * direction;
        let (normal, size) = match shapes.kind[shape] {
            ShapeKind::Sphere => {
                let centre = spheres.row[row].centre;
                let outward = (point - centre).try_normalize().unwrap_or(-direction);
                (outward, l1_norm(centre) + spheres.row[row].radius)
            }
            // Nothing but planes is left, as `spawn` has made sure.
            _ => (planes.row[row].normal, planes.row[row].offset.abs()),
        };
        let hit = RayHit::at_rest(origin, direction, hit.t);
        surface.0 = intersect::Surface::of(hit.facing(point, normal, size), material);
    }
}

fn shade(
    materials: Res<Shared<MaterialTable>>,
    background: Res<Shared<BackgroundTable>>,
    mut rays: Query<(&Hit, &Surface, &mut Radiance)>,
) {
    for (hit, surface, mut radiance) in &mut rays {
        radiance.0 = match hit.shape {
            NO_SHAPE => background.radiance,
            _ => materials.parameters[surface.0.material as usize].colour.map(|part| part as f32),
        };
    }
}

fn add(mut rays: Query<(&Radiance, &mut FilmSum)>) {
    for (radiance, mut sum) in &mut rays {
        for (sum, part) in sum.0.iter_mut().zip(radiance.0) {
            *sum += f64::from(part);
        }
        sum.1 += 1;
    }
}
