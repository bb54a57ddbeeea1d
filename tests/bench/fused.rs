//! The hand-written loop that the stages are measured against: one pixel after another, nothing kept in between.
//!
//! It calls pinhole's own functions of one row and reads pinhole's own tables, so that its image is the same to the
//! last bit and only the arrangement of the work differs.
//! Its spheres are tested sixteen at a time for one ray, as pinhole's stage tests sixteen rays for one sphere.

use bevy_ecs::prelude::World;
use glam::{DVec2, DVec3, Vec3};
use multiversion::multiversion;
use pinhole::extract::{
    BackgroundTable, CameraAxes, DirectionalLightTable, FilterTable, ImageFrame, MaterialKind, MaterialTable,
    PerspectiveProjection, PlaneTable, PointLightTable, SamplingTable, ShapeTable, SphereTable, SpotLightTable,
};
use pinhole::film::{Film, FilmTile};
use pinhole::intersect::{NO_SHAPE, Surface};
use pinhole::lights::irradiance_from_point;
use pinhole::material::lambertian;
use pinhole::plan::{Census, Table};
use pinhole::rays::{camera_ray_perspective, ndc_from_raster, raster_from_pixel, sampling_evidence, screen_from_ndc};
use pinhole::sample::{
    Draw, PixelKey, Purpose, SampleIndex, box_offset, table_offset, tent_offset, unit, with_sampler,
};
use pinhole::scene::{Filter, SceneError};
use pinhole::shade::shadow_t_max;
use pinhole::shapes::{PlacedSphere, RayHit, ShapeKind, l1_norm, nearness, offset_origin, plane_t, sphere_t};
use std::sync::{Mutex, PoisonError};

/// Spheres tested together.
const LANES: usize = 16;

/// Spheres as a structure of arrays, so that sixteen of them are loaded at once.
struct Spheres {
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
    radius: Vec<f64>,
    shape: Vec<u32>,
}

impl Spheres {
    fn of(table: &SphereTable) -> Self {
        let part = |of: fn(&PlacedSphere) -> f64| table.row.iter().map(of).collect();
        Self {
            x: part(|sphere| sphere.centre.x),
            y: part(|sphere| sphere.centre.y),
            z: part(|sphere| sphere.centre.z),
            radius: part(|sphere| sphere.radius),
            shape: table.shape.clone(),
        }
    }

    #[inline(always)]
    fn centre(&self, row: usize) -> DVec3 {
        DVec3::new(self.x[row], self.y[row], self.z[row])
    }
}

/// Everything the loop reads.
pub struct Scene {
    image: ImageFrame,
    lens: PerspectiveProjection,
    axes: CameraAxes,
    spheres: Spheres,
    planes: PlaneTable,
    shapes: ShapeTable,
    materials: MaterialTable,
    lights: PointLightTable,
    background: BackgroundTable,
    /// None for one ray through the middle of each pixel.
    sampling: Option<SamplingTable>,
    filter: FilterTable,
}

impl Scene {
    /// Reads the same tables as pinhole.
    ///
    /// # Panics
    /// When the scene holds a shape that this loop does not know.
    pub fn extract(world: &World) -> Result<Self, SceneError> {
        let census = &Census::of(world);
        let kinds = ShapeTable::extract(census)?.kind;
        let known = kinds.iter().all(|kind| matches!(kind, ShapeKind::Sphere | ShapeKind::Plane));
        assert!(known, "the scenes that are measured hold spheres and planes only");
        let materials: MaterialTable = Table::extract(census)?;
        assert!(materials.kind.iter().all(|&kind| kind == MaterialKind::Matte), "they hold matte things");
        let (directional, spot) = (DirectionalLightTable::extract(census)?, SpotLightTable::extract(census)?);
        assert!(directional.row.is_empty() && spot.row.is_empty(), "and point lights");
        Ok(Self {
            image: Table::extract(census)?,
            lens: Table::extract(census)?,
            axes: Table::extract(census)?,
            spheres: Spheres::of(&Table::extract(census)?),
            planes: Table::extract(census)?,
            shapes: Table::extract(census)?,
            materials,
            lights: Table::extract(census)?,
            background: Table::extract(census)?,
            sampling: sampling_evidence(census).needed.then(|| Table::extract(census)).transpose()?,
            filter: Table::extract(census)?,
        })
    }
}

/// A whole frame on this many threads.
pub fn render(world: &World, threads: usize) -> Film {
    let scene = Scene::extract(&Census::of(world)).expect("the scene is a chapter's");
    let mut film = Film::new(scene.image.width, scene.image.height, 32);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("workers start");
    let tiles = Mutex::new(film.tiles.iter_mut());
    pool.broadcast(|_| {
        while let Some(tile) = { tiles.lock().unwrap_or_else(PoisonError::into_inner).next() } {
            render_tile(&scene, tile);
        }
    });
    film
}

/// What samplers work out once for all pixels is worked out once a tile, as in pinhole.
fn render_tile(scene: &Scene, film: &mut FilmTile) {
    let Some(SamplingTable { samples, sampler, .. }) = scene.sampling else { return add_centres(scene, film) };
    let (numbers, purpose) = (0..samples, Purpose::Pixel);
    let sample = |number| SampleIndex { number, samples, depth: 0 };
    with_sampler!(sampler, D => {
        add_samples(scene, &numbers.map(|n| D::of(sample(n), purpose)).collect::<Vec<_>>(), film);
    });
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn add_centres(scene: &Scene, film: &mut FilmTile) {
    for row in 0..film.tile.rows() {
        let [x, y] = film.tile.pixel_of(row);
        let radiance = radiance(scene, raster_from_pixel(x, y));
        film.add(row, radiance);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn add_samples<D: Draw>(scene: &Scene, draws: &[D], film: &mut FilmTile) {
    let seed = scene.sampling.unwrap_or_default().seed;
    for row in 0..film.tile.rows() {
        let [x, y] = film.tile.pixel_of(row);
        let key = PixelKey::new(seed, [x, y]);
        for draw in draws {
            let [(right, across), (down, along)] = draw.two(key).map(|bits| offset(&scene.filter, unit(bits)));
            let radiance = radiance(scene, raster_from_pixel(x, y) + DVec2::new(right, down));
            if across == along {
                film.add(row, radiance);
            } else {
                film.add_negative(row, radiance);
            }
        }
    }
}

/// How far beside the pixel's centre a sample lies, and whether the filter is negative there.
#[inline(always)]
fn offset(filter: &FilterTable, u: f64) -> (f64, bool) {
    match filter.filter {
        Filter::Box { radius } => (box_offset(u, radius), false),
        Filter::Tent { radius } => (tent_offset(u, radius), false),
        _ => table_offset(u, &filter.cells),
    }
}

#[inline(always)]
fn radiance(scene: &Scene, raster: DVec2) -> [f32; 3] {
    let ndc = ndc_from_raster(raster, scene.image.size());
    let screen: DVec2 = screen_from_ndc(ndc, scene.image.aspect());
    let camera = camera_ray_perspective(screen, scene.lens.tan_half_vertical);
    let direction = (scene.axes.world_from_camera * camera).as_vec3().as_dvec3();
    let (t, shape) = nearest(scene, DVec3::ZERO, direction, f64::INFINITY, false);
    if shape == NO_SHAPE {
        return scene.background.radiance;
    }
    light(scene, &surface(scene, direction, t, shape as usize))
}

#[inline(always)]
fn surface(scene: &Scene, direction: DVec3, t: f64, shape: usize) -> Surface {
    let (row, material) = (scene.shapes.row[shape] as usize, scene.shapes.material[shape]);
    let point = DVec3::ZERO + t * direction;
    let (normal, size) = match scene.shapes.kind[shape] {
        ShapeKind::Sphere => {
            let centre = scene.spheres.centre(row);
            let outward = (point - centre).try_normalize().unwrap_or(-direction);
            (outward, l1_norm(centre) + scene.spheres.radius[row])
        }
        // Nothing but planes is left, as `extract` has made sure.
        _ => (scene.planes.row[row].normal, scene.planes.row[row].offset.abs()),
    };
    let hit = RayHit::at_rest(DVec3::ZERO, direction, t);
    Surface::of(hit.facing(point, normal, size), material)
}

#[inline(always)]
fn light(scene: &Scene, surface: &Surface) -> [f32; 3] {
    let mut radiance = [0.0_f32; 3];
    let origin: Vec3 = offset_origin(surface.position, surface.normal, surface.bound);
    for (light, row) in scene.lights.row.iter().enumerate() {
        let to_light = row.position - origin.as_dvec3();
        let distance = to_light.length();
        let direction = (to_light * (1.0 / distance)).as_vec3().as_dvec3();
        let cosine = surface.normal.as_dvec3().dot(direction);
        if cosine > 0.0 && !blocked(scene, light, origin, direction, distance) {
            let colour = scene.materials.parameters[surface.material as usize].colour;
            let irradiance = irradiance_from_point(row.intensity, cosine, distance * distance);
            // Pinhole keeps irradiance in a column of f32.
            let brdf = lambertian(colour);
            for ((sum, brdf), irradiance) in radiance.iter_mut().zip(brdf).zip(irradiance) {
                *sum += (brdf * f64::from(irradiance as f32)) as f32;
            }
        }
    }
    radiance
}

#[inline(always)]
fn blocked(scene: &Scene, light: usize, origin: Vec3, direction: DVec3, distance: f64) -> bool {
    let t_max = f64::from(shadow_t_max(distance));
    scene.lights.casts_shadows[light] && nearest(scene, origin.as_dvec3(), direction, t_max, true).1 != NO_SHAPE
}

/// What the ray hits before `t_max`: the nearest, or for `any` the first found.
#[inline(always)]
fn nearest(scene: &Scene, origin: DVec3, direction: DVec3, t_max: f64, any: bool) -> (f64, u32) {
    let (mut t, mut shape) = (t_max, NO_SHAPE);
    for (plane, &number) in scene.planes.row.iter().zip(&scene.planes.shape) {
        let found = plane_t(origin, direction, plane.normal, plane.offset);
        keep_closest(found, number, &mut t, &mut shape);
    }
    let spheres = &scene.spheres;
    let count = spheres.x.len();
    let inverse = 1.0 / direction.dot(direction);
    let mut start = 0;
    while start < count && !(any && shape != NO_SHAPE) {
        let mut near = [f64::NEG_INFINITY; LANES];
        let here = LANES.min(count - start);
        let (x, y, z) =
            (&spheres.x[start..start + here], &spheres.y[start..start + here], &spheres.z[start..start + here]);
        let radius = &spheres.radius[start..start + here];
        for lane in 0..here {
            near[lane] = nearness(DVec3::new(x[lane], y[lane], z[lane]) - origin, direction, inverse, radius[lane]);
        }
        for lane in 0..here {
            if near[lane] >= 0.0 {
                let found = sphere_t(origin, direction, spheres.centre(start + lane), radius[lane]);
                keep_closest(found, spheres.shape[start + lane], &mut t, &mut shape);
            }
        }
        start += LANES;
    }
    (t, shape)
}

#[inline(always)]
fn keep_closest(found: f64, number: u32, t: &mut f64, shape: &mut u32) {
    if found < *t || (found == *t && number < *shape && found < f64::INFINITY) {
        (*t, *shape) = (found, number);
    }
}
