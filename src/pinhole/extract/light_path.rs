use super::area_light::light_distribution;
use super::shape_kind::listed_kind;
use super::{AreaLightTable, MaterialTable, NO_ROW, PointLightTable, ShapeTable, SpotLightTable, luminance};
use crate::plan::{Census, Table};
use crate::scene::SceneError;
use crate::shapes::{Bounds, Emitter};
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::f64::consts::PI;

/// With more specular shapes than this, one sphere bounds them all.
pub const MOST_TARGETS: usize = 16;
/// The factor by which a bounding sphere is enlarged, so that no rounding of a ray leads past it.
const MARGIN: f64 = 1.0 + 1e-5;

/// A light from which light paths start, in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightSource {
    /// A shape that emits.
    Area {
        /// The shape.
        emitter: Emitter,
        /// The radiance emitted at every point.
        radiance: [f64; 3],
        /// Whether it is emitted only on the side of the shape's own normal.
        one_sided: bool,
    },
    /// A point light, or a spot light.
    Point {
        /// Relative to the eye.
        position: DVec3,
        /// Radiant intensity, along the axis for a spot light.
        intensity: [f64; 3],
        /// The axis of a spot light and 1 − cos of its inner and outer half angles; none for a point light.
        cone: Option<(DVec3, [f64; 2])>,
    },
}

/// A bounding sphere of mirrors or glass, towards which light paths start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Relative to the eye.
    pub centre: DVec3,
    /// In scene units.
    pub radius: f64,
}

/// The lights from which light paths start, and their targets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightPathTable {
    /// The lights: area lights, then point lights, then spot lights, each in spawn order.
    pub light: Vec<LightSource>,
    /// The cumulative distribution in units of 2⁻³², as in [`super::AreaLightTable`].
    pub until: Vec<u64>,
    /// The probability of choosing each light: half in proportion to its power, half uniform.
    pub probability: Vec<f64>,
    /// Spheres that together bound all mirrors and glass; none where one of these is infinite.
    pub target: Vec<Target>,
}

impl LightPathTable {
    /// The light chosen by a 32-bit fraction.
    #[inline(always)]
    pub fn chosen(&self, fraction: u32) -> usize {
        self.until.partition_point(|&until| until <= u64::from(fraction))
    }
}

impl Table for LightPathTable {
    const NAME: &'static str = "light paths";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let areas = scene.table::<AreaLightTable>()?;
        let (mut light, mut powers) = (Vec::new(), Vec::new());
        for (number, emitter) in areas.emitter.iter().enumerate() {
            let (radiance, one_sided) = (areas.radiance[number], areas.one_sided[number]);
            let sides = if one_sided { 1.0 } else { 2.0 };
            powers.push(luminance(radiance) * emitter.area() * PI * sides);
            light.push(LightSource::Area { emitter: *emitter, radiance, one_sided });
        }
        // The light of a light without shadows passes through everything, so glass does not bend its rays.
        let points = scene.table::<PointLightTable>()?;
        for number in (0..points.position.len()).filter(|&number| points.casts_shadows[number]) {
            let (position, intensity) = (points.position[number], points.intensity[number]);
            powers.push(luminance(intensity) * 4.0 * PI);
            light.push(LightSource::Point { position, intensity, cone: None });
        }
        let spots = scene.table::<SpotLightTable>()?;
        for number in (0..spots.position.len()).filter(|&number| spots.casts_shadows[number]) {
            let (position, intensity) = (spots.position[number], spots.intensity[number]);
            let edges = [spots.inner[number], spots.outer[number]];
            powers.push(luminance(intensity) * PI * (edges[0] + edges[1]));
            light.push(LightSource::Point { position, intensity, cone: Some((spots.axis[number], edges)) });
        }
        let (until, probability) = light_distribution(&powers);
        Ok(Self { light, until, probability, target: targets(scene)? })
    }

    fn bytes(&self) -> usize {
        self.light.len() * (size_of::<LightSource>() + 16) + size_of_val(&self.target[..])
    }
}

/// Bounding spheres of all mirrors and glass; none where one of these is infinite.
fn targets(scene: &Census<'_>) -> Result<Vec<Target>, SceneError> {
    let (shapes, materials) = (scene.table::<ShapeTable>()?, scene.table::<MaterialTable>()?);
    let is_specular = |shape: &usize| match shapes.material[*shape] {
        NO_ROW => false,
        material => materials.kind[material as usize].is_specular(),
    };
    let mut found = Vec::new();
    for shape in (0..shapes.kind.len()).filter(is_specular) {
        let row = shapes.row[shape] as usize;
        let around = listed_kind(shapes.kind[shape]).map(|listed| (listed.bounding_sphere)(scene, row)).transpose()?;
        // A plane is infinite, and a moving shape may go anywhere.
        let Some((centre, radius)) = around.flatten() else { return Ok(Vec::new()) };
        found.push(Target::new(centre, radius));
    }
    if found.len() > MOST_TARGETS {
        let ends = |target: &Target| {
            let radius = DVec3::splat(target.radius);
            (target.centre - radius, target.centre + radius)
        };
        let (least, most) = found
            .iter()
            .map(ends)
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |all, own| (all.0.min(own.0), all.1.max(own.1)));
        let (centre, radius) = Bounds { least, most }.sphere_around();
        found = vec![Target::new(centre, radius)];
    }
    Ok(found)
}

impl Target {
    fn new(centre: DVec3, radius: f64) -> Self {
        Self { centre, radius: radius * MARGIN }
    }
}
