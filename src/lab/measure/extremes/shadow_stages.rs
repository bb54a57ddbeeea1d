//! From a ray to the shadow ray that leaves its hit, through pinhole's stages.

use super::bench::{Bench, plane_table, sphere_table};
use crate::measure::draws::Draws;
use crate::measure::oracle_plane::Plane;
use crate::measure::oracle_sphere::Sphere;
use crate::measure::ray_aim::AimedRay;
use glam::{DVec3, Vec3};
use pinhole::extract::{MaterialKind, MaterialTable, NO_ROW, PointLightTable, ShapeTable};
use pinhole::intersect::{self, Hits, MaterialRows, NO_SHAPE, Surface, Surfaces};
use pinhole::lights::PlacedPointLight;
use pinhole::plan::{Column, Stage};
use pinhole::shade::{self, ShadowHits, ShadowRays};
use pinhole::shapes::ShapeKind;

/// A shadow ray as the stages made it, and what they found along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shadow {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes.
    pub direction: Vec3,
    /// How far it looks.
    pub t_max: f32,
    /// The number of the shape that it hit before its t_max.
    pub blocked: Option<u32>,
}

/// Two benches: the stages up to the surface, and those from the surface to what lies before the light.
pub struct ShadowStages {
    to_surface: Bench,
    to_light: Bench,
}

impl ShadowStages {
    /// The stages for spheres, a light still to be placed.
    pub fn of_spheres() -> Self {
        let to_surface = [intersect::sphere_stage(), intersect::classify_stage(), intersect::sphere_surface_stage()];
        Self::of(&to_surface, shade::sphere_shadow_stage())
    }

    /// The stages for planes, a light still to be placed.
    pub fn of_planes() -> Self {
        let to_surface = [intersect::plane_stage(), intersect::classify_stage(), intersect::plane_surface_stage()];
        Self::of(&to_surface, shade::plane_shadow_stage())
    }

    fn of(to_surface: &[Stage], shadow_stage: Stage) -> Self {
        let to_surface = [&[intersect::start_stage()], to_surface].concat();
        let to_light =
            [shade::start_shadow_rays_stage(), shade::point_light_stage(), shade::start_shadow_stage(), shadow_stage];
        let mut stages = Self { to_surface: Bench::new(&to_surface), to_light: Bench::new(&to_light) };
        stages.to_light.insert(MaterialTable::opaque(vec![MaterialKind::Matte], vec![[0.5; 3]]));
        let mut first = MaterialRows::default();
        first.slices_mut(1)[0] = 0;
        stages.to_light.put(first);
        stages
    }

    /// The scene's spheres; a sphere's place is its number.
    pub fn spheres(&mut self, spheres: &[Sphere]) {
        self.shapes(ShapeKind::Sphere, spheres.len());
        self.to_surface.insert(sphere_table(spheres));
        self.to_light.insert(sphere_table(spheres));
    }

    /// The scene's planes; a plane's place is its number.
    pub fn planes(&mut self, planes: &[Plane]) {
        self.shapes(ShapeKind::Plane, planes.len());
        self.to_surface.insert(plane_table(planes));
        self.to_light.insert(plane_table(planes));
    }

    fn shapes(&mut self, kind: ShapeKind, count: usize) {
        let row = (0..count as u32).collect();
        let (material, emissive) = (vec![0; count], vec![NO_ROW; count]);
        let non_specular = vec![true; count];
        let table = ShapeTable { kind: vec![kind; count], row, material, non_specular, emissive };
        self.to_surface.insert(table);
    }

    /// The number of the shape that a ray hits first, and the surface there.
    pub fn surface(&mut self, ray: AimedRay) -> Option<(u32, Surface)> {
        self.to_surface.aim(&[ray]);
        self.to_surface.run();
        let shape = self.to_surface.column::<Hits>().shape[0];
        (shape != NO_SHAPE).then(|| (shape, self.to_surface.column::<Surfaces>().get(0)))
    }

    /// The shadow ray from a surface to a light, if the surface faces it.
    pub fn shadow(&mut self, surface: Surface, light: DVec3) -> Option<Shadow> {
        let mut surfaces = Surfaces::default();
        surfaces.slices_mut(1);
        surfaces.set(0, surface);
        self.to_light.put(surfaces);
        let light = PlacedPointLight { position: light, intensity: [1.0; 3] };
        self.to_light.insert(PointLightTable { row: vec![light], casts_shadows: vec![true], choice: None });
        self.to_light.run();
        let (rays, hits) = (self.to_light.column::<ShadowRays>(), self.to_light.column::<ShadowHits>());
        (rays.rows() == 1).then(|| Shadow {
            origin: rays.origin(0),
            direction: rays.direction(0),
            t_max: rays.t_max[0],
            blocked: Some(hits.shape[0]).filter(|&shape| shape != NO_SHAPE),
        })
    }
}

/// A direction above the surface's tangent plane, not of unit length: often nearly along it.
pub fn leaving(draws: &mut Draws, normal: Vec3, flattest: f64) -> DVec3 {
    let normal = normal.as_dvec3();
    let along = draws.unit_vector_across(normal.try_normalize().unwrap_or(DVec3::X));
    along + normal * draws.power_of_ten(-flattest, 1.0)
}
