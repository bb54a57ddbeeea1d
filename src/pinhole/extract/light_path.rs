use super::area_lights::{EVEN, light_distribution};
use super::cameras::eye;
use super::integrator::bidirectional_request;
use super::lights_of::{light_kinds, shadowed_evidence};
use super::shapes::{listed_kind, one_shape, shape_entities};
use super::{
    AreaLightTable, EnvironmentLightTable, EnvironmentTable, MaterialTable, MeshLights, NO_ROW, ShapeTable,
    bidirectional_evidence, environment_light_evidence, luminance,
};
use crate::each::Each;
use crate::lights::{AnyLight, MAX_TARGETS, Target, Targets};
use crate::plan::{Census, Evidence, Table};
use crate::scene::SceneError;
use crate::shapes::{Bounds, Emitter};
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// A light from which light paths start, in render space.
#[derive(Clone, Debug, PartialEq)]
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
    /// A light without an area.
    Delta(AnyLight),
    /// An environment image, and how directions to it are sampled.
    Environment(Arc<EnvironmentTable>, Arc<EnvironmentLightTable>),
}

/// The luminance of the irradiance that an environment sends from all directions together through an area at right
/// angles to each of them.
fn environment_strength(environment: &EnvironmentTable) -> f64 {
    let image = &environment.image;
    let row_weight = |row: usize| libm::sin(PI * (row as f64 + 0.5) / image.height as f64);
    let rows = image.rgb.chunks(image.width).enumerate();
    let sum = |row: &[[f32; 3]]| row.iter().map(|texel| luminance(texel.each(f64::from))).sum::<f64>();
    let weighted: f64 = rows.map(|(at, row)| sum(row) * row_weight(at)).sum();
    4.0 * PI * weighted / (image.width as f64 * (0..image.height).map(row_weight).sum::<f64>())
}

/// The lights from which light paths start, and their targets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightPathTable {
    /// The lights: area lights, then those without an area, kind after kind, each in spawn order, then the
    /// environment image.
    ///
    /// The triangles of emitting meshes follow.
    pub light: Vec<LightSource>,
    /// The meshes that emit.
    pub mesh: Vec<MeshLights>,
    /// The cumulative distribution in units of 2⁻³², as in [`super::AreaLightTable`].
    pub until: Vec<u64>,
    /// The probability of choosing each light: a quarter in proportion to its power, the rest uniform; all of it by power
    /// where light paths are joined to those of the camera.
    pub probability: Vec<f64>,
    /// The luminance of the power of all lights together.
    pub power: f64,
    /// The mirrors and the glass, towards which they start.
    pub targets: Targets,
    /// Whether light paths are joined to those of the camera, and start in all directions on lights with a position.
    pub is_for_all_light: bool,
}

/// Where paths start in all directions.
static NO_TARGETS: Targets =
    Targets { sphere: Vec::new(), scene: Target { centre: DVec3::ZERO, radius: 0.0 }, infinite: Vec::new() };

impl LightPathTable {
    /// The light chosen by a 32-bit fraction.
    #[inline(always)]
    pub fn chosen(&self, fraction: u32) -> usize {
        self.until.partition_point(|&until| until <= u64::from(fraction))
    }

    /// The targets of lights with a position.
    #[inline(always)]
    pub fn near_targets(&self) -> &Targets {
        if self.is_for_all_light { &NO_TARGETS } else { &self.targets }
    }

    /// The number that a light has among those with an area, and the luminance of its radiance; none for one without.
    pub fn area_light(&self, areas: &AreaLightTable, light: usize) -> Option<(usize, f64)> {
        match self.light.get(light) {
            Some(LightSource::Area { radiance, .. }) => Some((light, luminance(*radiance))),
            Some(_) => None,
            None => {
                let at = self.mesh.partition_point(|mesh| mesh.first as usize <= light) - 1;
                let own = light - self.mesh[at].first as usize + areas.mesh[at].first as usize;
                Some((own, luminance(self.mesh[at].radiance)))
            }
        }
    }

    /// The luminance of the irradiance at normal incidence that a light without an area sends to a point; 0 from another.
    pub fn delta_irradiance(&self, light: usize, point: DVec3) -> f64 {
        match self.light.get(light) {
            Some(LightSource::Delta(own)) => luminance(own.irradiance(point)),
            _ => 0.0,
        }
    }

    /// Whether paths start on a light outside the scene, since it has no position.
    pub fn is_distant(&self, light: usize) -> bool {
        match self.light.get(light) {
            Some(LightSource::Delta(own)) => own.position().is_none(),
            Some(LightSource::Environment(..)) => true,
            Some(LightSource::Area { .. }) | None => false,
        }
    }

    /// The mesh of a light that is one of its triangles.
    #[inline(always)]
    pub fn mesh_of(&self, light: usize) -> &MeshLights {
        &self.mesh[self.mesh.partition_point(|mesh| mesh.first as usize <= light) - 1]
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
        let is_for_all_light = bidirectional_evidence(scene).needed;
        let is_needed = !is_for_all_light || distant_start_evidence(scene).needed;
        let targets = if is_needed { Targets::clone(&*targets(scene)?) } else { Targets::default() };
        let across = targets.across();
        let is_started = |is_distant: bool| !is_distant || !targets.sphere.is_empty();
        for kind in light_kinds(scene).filter(|kind| is_started(kind.is_distant)) {
            for source in (kind.sources)(scene)? {
                powers.push(luminance(source.power(across)));
                light.push(LightSource::Delta(source));
            }
        }
        if started_environment_evidence(scene).needed && is_started(true) {
            let environment = scene.table::<EnvironmentTable>()?;
            powers.push(environment_strength(&environment) * across);
            light.push(LightSource::Environment(environment, scene.table()?));
        }
        let mut mesh = areas.mesh.clone();
        for lights in &mut mesh {
            lights.first = powers.len() as u32;
            let own = lights.first as usize..lights.first as usize + lights.triangles();
            powers.extend(own.map(|light| lights.power(light)));
        }
        let (until, probability) = light_distribution(&powers, if is_for_all_light { 0.0 } else { EVEN });
        let power = powers.iter().filter(|power| !power.is_nan()).sum();
        Ok(Self { light, mesh, until, probability, power, targets, is_for_all_light })
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.light[..])
            + size_of_val(&self.mesh[..])
            + self.until.len() * 16
            + size_of_val(&self.targets.sphere[..])
            + size_of_val(&self.targets.infinite[..])
    }
}

/// The mirrors and the glass of a scene, and what else light paths from outside need to know of its shapes.
fn targets(scene: &Census<'_>) -> Result<Arc<Targets>, SceneError> {
    scene.once(|scene| find_targets(scene).map(Arc::new))
}

fn find_targets(scene: &Census<'_>) -> Result<Targets, SceneError> {
    let (shapes, materials) = (scene.table::<ShapeTable>()?, scene.table::<MaterialTable>()?);
    let is_specular = |shape: usize| match shapes.material[shape] {
        NO_ROW => false,
        material => materials.kind[material as usize].is_specular(),
    };
    let (eye, entities) = (eye(scene)?, shape_entities(scene));
    let (mut found, mut infinite, mut all) = (Vec::new(), Vec::new(), None::<Bounds>);
    let mut bounded = true;
    for shape in 0..entities.len() {
        // What moves is none of the listed kinds, and may go anywhere.
        let listed = listed_kind(scene, shapes.kind[shape]);
        let row = shapes.row[shape] as usize;
        if is_specular(shape) {
            let around = listed.map(|listed| (listed.bounding_sphere)(scene, row)).transpose()?.flatten();
            bounded &= around.is_some();
            found.extend(around.map(Target::around));
        }
        match listed.map(|listed| (listed.bounds)(scene, row)).transpose()?.flatten() {
            Some(own) => {
                let min = all.map_or(own.min, |all| all.min.min(own.min));
                all = Some(Bounds { min, max: all.map_or(own.max, |all| all.max.max(own.max)) });
            }
            None => infinite.push((one_shape(scene, entities[shape])?.body)(scene, entities[shape], eye)?),
        }
    }
    if !bounded {
        found.clear();
    }
    if found.len() > MAX_TARGETS {
        found = vec![Target::around_all(&found)];
    }
    let scene = all.map_or_else(Target::default, |all| Target::around(all.sphere_around()));
    Ok(Targets { sphere: found, scene, infinite })
}

/// Evidence of an environment image on which light paths start: not where they are joined to those of the camera, which
/// find its light behind mirrors and glass as well.
fn started_environment_evidence(scene: &Census<'_>) -> Evidence {
    let joined = bidirectional_request(scene);
    if joined.needed { Evidence { needed: false, ..joined } } else { environment_light_evidence(scene) }
}

/// Evidence of a light from which light paths start outside the scene: one without a position, or an environment image.
///
/// None start on a background or a gradient: such light arrives from everywhere nearly alike, so that BSDF sampling
/// finds it with a sixth of the variance.
/// Where a mirror or glass is infinite, no area across such a light holds all that it sends there, and none starts.
pub fn distant_start_evidence(scene: &Census<'_>) -> Evidence {
    let distant = shadowed_evidence(scene, true).or(started_environment_evidence(scene));
    distant.and(|| match targets(scene) {
        Ok(targets) if !targets.sphere.is_empty() => Evidence::always("every mirror and glass is bounded"),
        _ => Evidence { needed: false, reason: "a mirror or glass is infinite".into(), count: 0 },
    })
}
