use super::area_lights::{EVEN, light_distribution};
use super::cameras::eye;
use super::integrator::bidirectional_request;
use super::lights_of::{light_kinds, shadowed_evidence};
use super::shapes::{listed_kind, one_shape, shape_entities};
use super::{
    AreaLightTable, EnvironmentLightTable, EnvironmentTable, MaterialTable, MeshLights, NO_ROW, ShapeTable,
    bidirectional_evidence, environment_light_evidence, luminance,
};
use crate::each::{Each, lanes};
use crate::lights::{
    AT_ONCE, AnyLight, Cones, MAX_TARGETS, MAX_TARGETS_SOLID_ANGLE, TOWARDS, Target, Targets, cones_around,
};
use crate::plan::{Census, Evidence, Table, VectorRowsMut};
use crate::scene::SceneError;
use crate::shapes::{Bounds, Emitter};
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::f64::consts::{PI, TAU};
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
    /// The area that the power of a light without a position is counted over, in square scene units.
    pub across: f64,
    /// What the targets subtend from each light without an area that has a position, and none from others; empty where this is
    /// not asked for.
    cones: Vec<Option<Cones>>,
    /// Whether light paths are joined to those of the camera, and start in all directions on lights with a position, some of
    /// them towards mirrors and glass.
    pub is_for_all_light: bool,
}

/// Whether a path starts towards mirrors and glass from a point of a light, or elsewhere.
pub struct Towards<'a> {
    /// What they subtend from there; none where all directions are sampled alike.
    cones: Option<&'a Cones>,
    /// Selects one of them; none where the path starts elsewhere.
    choice: Option<f64>,
    /// 1 over the probability of that.
    weight: f64,
}

impl Towards<'_> {
    /// A direction towards mirrors and glass and 1 over its pdf, in sr; none where the path starts elsewhere.
    #[inline(always)]
    pub fn sample(&self, u: [f64; 2]) -> Option<(DVec3, f64)> {
        let (direction, weight) = self.cones?.sample(self.choice?, u);
        Some((direction, weight * self.weight))
    }

    /// By what the power of a path in a direction that is sampled as if there were neither is multiplied: nothing starts that
    /// way towards mirrors and glass, where other paths do.
    #[inline(always)]
    pub fn weight_elsewhere(&self, direction: DVec3) -> f64 {
        let is_towards = self.cones.is_some_and(|cones| cones.around(direction, None) > 0);
        if is_towards { 0.0 } else { self.weight }
    }
}

impl LightPathTable {
    /// The light chosen by a 32-bit fraction.
    #[inline(always)]
    pub fn chosen(&self, fraction: u32) -> usize {
        self.until.partition_point(|&until| until <= u64::from(fraction))
    }

    /// What mirrors and glass subtend from a point of a light; none where that is nothing, or so much that sampling directions
    /// towards them gains nothing.
    #[inline(always)]
    pub fn cones(&self, from: DVec3) -> Option<Cones> {
        cones_from(&self.targets, from)
    }

    /// The same from a light without an area, for which it is computed once; none from one without a position.
    #[inline(always)]
    pub fn cones_of(&self, light: usize) -> Option<&Cones> {
        self.cones.get(light)?.as_ref()
    }

    /// Whether a path starts towards mirrors and glass from a point, by what they subtend from there and a number in [0, 1):
    /// all do where caustics are all that is asked for, and some where all light is.
    #[inline(always)]
    pub fn towards<'a>(&self, cones: Option<&'a Cones>, u: f64) -> Towards<'a> {
        if !self.is_for_all_light || cones.is_none() {
            return Towards { choice: cones.is_some().then_some(u), cones, weight: 1.0 };
        }
        let is_towards = u < TOWARDS;
        let weight = 1.0 / if is_towards { TOWARDS } else { 1.0 - TOWARDS };
        Towards { cones, choice: is_towards.then_some(u / TOWARDS), weight }
    }

    /// How many times as many paths start from a point of a light in a direction as its share of the power says, where they
    /// are joined to those of the camera.
    ///
    /// Lights are taken to be as bright in all directions. Any function of the two will do, for all ways to find a path are
    /// weighted by the same one; the nearer it is to the truth, the better they are.
    #[inline(always)]
    pub fn density(&self, cones: Option<&Cones>, direction: DVec3) -> f64 {
        cones.map_or(1.0, |cones| density_of(cones.all, cones.around(direction, None) as f64))
    }

    /// The same of points and directions from them.
    #[inline(always)]
    pub fn densities(&self, of: impl Fn(usize) -> [DVec3; 2]) -> [f64; AT_ONCE] {
        if self.targets.sphere.is_empty() {
            return [1.0; AT_ONCE];
        }
        let mut rays = [[[0.0; AT_ONCE]; 3]; 2];
        for lane in 0..AT_ONCE {
            let ray = of(lane);
            rays[0].put(lane, ray[0]);
            rays[1].put(lane, ray[1]);
        }
        let [wholes, passed] = cones_around(&self.targets.sphere, &rays[0], &rays[1]);
        lanes(|lane| match TAU * wholes[lane] {
            all if subtends_little(all) => density_of(all, passed[lane]),
            _ => 1.0,
        })
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

    /// How many paths arrive at a unit of area at right angles to a ray from a light without an area that hits this point,
    /// of one path in all; 0 from another light.
    pub fn delta_density(&self, light: usize, direction: DVec3, point: DVec3) -> f64 {
        match self.light.get(light) {
            Some(LightSource::Delta(own)) if own.position().is_none() => {
                self.distant_density(luminance(own.irradiance(point)), direction, point)
            }
            Some(LightSource::Delta(own)) => {
                luminance(own.irradiance(point)) / self.power * self.density(self.cones_of(light), direction)
            }
            _ => 0.0,
        }
    }

    /// The same of a light without a position that sends so much irradiance along a direction.
    #[inline(always)]
    pub fn distant_density(&self, irradiance: f64, direction: DVec3, point: DVec3) -> f64 {
        irradiance / self.power * self.across * self.targets.parallel_pdf(direction, point)
    }

    /// Whether paths start on lights without a position towards everything.
    pub fn is_whole(&self) -> bool {
        self.targets.whole.is_some()
    }

    /// Whether paths start on a light outside the scene, since it has no position.
    pub fn is_distant(&self, light: usize) -> bool {
        self.light.get(light).is_some_and(LightSource::is_distant)
    }

    /// The mesh of a light that is one of its triangles.
    #[inline(always)]
    pub fn mesh_of(&self, light: usize) -> &MeshLights {
        &self.mesh[self.mesh.partition_point(|mesh| mesh.first as usize <= light) - 1]
    }
}

/// Whether mirrors and glass subtend something, and not so much that sampling directions towards them gains nothing.
#[inline(always)]
fn subtends_little(all: f64) -> bool {
    all > 0.0 && all < MAX_TARGETS_SOLID_ANGLE
}

/// What they subtend from a point, where paths start towards them.
#[inline(always)]
fn cones_from(targets: &Targets, from: DVec3) -> Option<Cones> {
    if targets.sphere.is_empty() {
        return None;
    }
    Some(Cones::new(&targets.sphere, from)).filter(|cones| subtends_little(cones.all))
}

/// How many times as many paths start in a direction that is in so many of the cones, which subtend so much together.
#[inline(always)]
fn density_of(all: f64, passed: f64) -> f64 {
    if passed > 0.0 { TOWARDS * 4.0 * PI * passed / all } else { 1.0 - TOWARDS }
}

impl LightSource {
    /// The luminance of its power; for a light without a position, of what passes through so many square scene units.
    fn power(&self, across: f64) -> f64 {
        match self {
            Self::Area { emitter, radiance, one_sided } => {
                luminance(*radiance) * emitter.area() * PI * if *one_sided { 1.0 } else { 2.0 }
            }
            Self::Delta(light) => luminance(light.power(across)),
            Self::Environment(environment, _) => environment_strength(environment) * across,
        }
    }

    /// Whether paths start on it outside the scene, since it has no position.
    fn is_distant(&self) -> bool {
        match self {
            Self::Area { .. } => false,
            Self::Delta(light) => light.position().is_none(),
            Self::Environment(..) => true,
        }
    }
}

/// Lights without a position are chosen at most so many times as often as all others together, however large the scene is
/// that they shine on: most of it may be far from what the camera sees, or behind the walls of a room.
const MAX_DISTANT: f64 = 1.0;

impl Table for LightPathTable {
    const NAME: &'static str = "light paths";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let areas = scene.table::<AreaLightTable>()?;
        let mut light = Vec::new();
        for (number, emitter) in areas.emitter.iter().enumerate() {
            let (radiance, one_sided) = (areas.radiance[number], areas.one_sided[number]);
            light.push(LightSource::Area { emitter: *emitter, radiance, one_sided });
        }
        let is_for_all_light = bidirectional_evidence(scene).needed;
        let targets = Targets::clone(&*targets(scene)?);
        let is_started = |is_distant: bool| !is_distant || !targets.is_empty();
        for kind in light_kinds(scene).filter(|kind| is_started(kind.is_distant)) {
            light.extend((kind.sources)(scene)?.into_iter().map(LightSource::Delta));
        }
        if started_environment_evidence(scene).needed && is_started(true) {
            light.push(LightSource::Environment(scene.table()?, scene.table()?));
        }
        let mut mesh = areas.mesh.clone();
        let mut of_mesh = Vec::new();
        for lights in &mut mesh {
            lights.first = (light.len() + of_mesh.len()) as u32;
            let own = lights.first as usize..lights.first as usize + lights.triangles();
            of_mesh.extend(own.map(|light| lights.power(light)));
        }
        let mut across = targets.across();
        if targets.whole.is_some() {
            let sum = |is_distant: bool| {
                let own = light.iter().filter(|light| light.is_distant() == is_distant);
                own.map(|light| light.power(1.0)).filter(|power| *power > 0.0).sum::<f64>()
            };
            let near = sum(false) + of_mesh.iter().filter(|power| **power > 0.0).sum::<f64>();
            across = if near > 0.0 { across.min(MAX_DISTANT * near / sum(true)) } else { across };
        }
        let powers: Vec<f64> = light.iter().map(|light| light.power(across)).chain(of_mesh).collect();
        let (until, probability) = light_distribution(&powers, if is_for_all_light { 0.0 } else { EVEN });
        let power = powers.iter().filter(|power| !power.is_nan()).sum();
        let from = |light: &LightSource| match light {
            LightSource::Delta(light) => light.position().and_then(|from| cones_from(&targets, from)),
            _ => None,
        };
        let has_cones = is_for_all_light && !targets.sphere.is_empty();
        let cones = light.iter().filter(|_| has_cones).map(from).collect();
        Ok(Self { light, mesh, until, probability, power, targets, across, cones, is_for_all_light })
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.light[..])
            + size_of_val(&self.mesh[..])
            + self.until.len() * 16
            + size_of_val(&self.cones[..])
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
    let around = all.map_or_else(Target::default, |all| Target::around(all.sphere_around()));
    let whole = (infinite.is_empty() && all.is_some() && starts_on_everything(scene)).then_some(around);
    Ok(Targets { sphere: found, whole, scene: around, infinite })
}

/// Whether paths on lights without a position start towards everything, if it has an end: where they are joined to those of
/// the camera, unless one of many such lights is chosen for each surface, with a probability that a path does not know.
fn starts_on_everything(scene: &Census<'_>) -> bool {
    let mut distant = light_kinds(scene).filter(|kind| kind.is_distant);
    bidirectional_request(scene).needed && !distant.any(|kind| kind.is_chosen_of_many(scene))
}

/// Evidence that paths on lights without a position start towards mirrors and glass alone.
pub fn specular_start_evidence(scene: &Census<'_>) -> Evidence {
    let own = "paths on such a light start towards mirrors and glass alone";
    distant_start_evidence(scene).and(|| match targets(scene) {
        Ok(targets) if targets.whole.is_none() => Evidence::always(own),
        _ => Evidence { needed: false, reason: "they start towards everything".into(), count: 0 },
    })
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
        Ok(targets) if targets.whole.is_some() => Evidence::always("every shape is bounded"),
        Ok(targets) if !targets.is_empty() => Evidence::always("every mirror and glass is bounded"),
        _ => Evidence { needed: false, reason: "a mirror or glass is infinite".into(), count: 0 },
    })
}
