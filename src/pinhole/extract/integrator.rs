//! Which integrator a scene has, and where light paths start.

use super::area_lights::emissive_evidence;
use super::cameras::{CAMERA_KINDS, any_of, camera_kind, camera_of, named_camera, with_article};
use super::check::{at_most_one, kind_and_name, number, positive_length};
use super::light_path::distant_start_evidence;
use super::lights_of::{light_kinds, shadowed_evidence};
use super::material::glossy_evidence;
use super::sky::sky_evidence;
use super::{
    GlassTable, ImageFrame, adaptive_of, area_light_evidence, dispersion_evidence, environment_light_evidence,
    glass_evidence, material_evidence, medium_evidence, motion_evidence, specular_evidence,
};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{BidirectionalPathTracing, Integrator, LightTracing, PhotonMapping, SceneError, called};
use bevy_ecs::prelude::*;

/// The integrator of a scene, and the reason for it.
#[derive(Clone, Debug, PartialEq)]
pub struct ChosenIntegrator {
    /// The one named on the camera, or the one that the scene needs.
    pub integrator: Integrator,
    /// The reason, in words.
    pub reason: String,
    /// Whether the camera names it.
    pub is_named: bool,
    /// The one that the same scene would have in front of a black sky, where that differs and none is named.
    pub without_sky: Option<Integrator>,
}

// ANCHOR: integrator_of
/// The integrator of a scene: the one named on its camera, or the simplest that shows everything in the scene.
///
/// Glossy materials such as rough metal, glass that disperses light, media, and other materials in the light of emitting
/// surfaces or of a sky that is not black, need sampled points, directions and wavelengths, hence path tracing; mirrors and
/// glass lit by lights without an area need none,
/// hence Whitted's method; everything else is seen by ray casting.
pub fn integrator_of(scene: &Census<'_>) -> ChosenIntegrator {
    scene.once(|scene| {
        if let Some((camera, integrator)) = named_integrator(scene) {
            let reason = format!("named on the camera {}", called(scene, camera));
            return ChosenIntegrator { integrator, reason, is_named: true, without_sky: None };
        }
        let (integrator, reason) = chosen_without_sky(scene);
        let chosen = ChosenIntegrator { integrator, reason, is_named: false, without_sky: None };
        let sky = sky_evidence(scene).and(|| material_evidence(scene));
        if sky.needed && !integrator.transport().samples_diffuse {
            let reason = format!("light from the sky, {}", sky.reason);
            return ChosenIntegrator { integrator: Integrator::PATH, reason, without_sky: Some(integrator), ..chosen };
        }
        chosen
    })
}

/// The same for a scene whose sky is black or that has no material to be lit by it.
fn chosen_without_sky(scene: &Census<'_>) -> (Integrator, String) {
    let medium = medium_evidence(scene);
    if medium.needed {
        return (Integrator::PATH, medium.reason);
    }
    let glossy = glossy_evidence(scene);
    let emitters = emissive_evidence(scene).and(|| material_evidence(scene));
    let specular = specular_evidence(scene);
    let sampled = glossy.or(emitters).or(dispersion_evidence(scene));
    if sampled.needed {
        return (Integrator::PATH, sampled.reason);
    }
    if specular.needed && has_points(scene) {
        return (Integrator::WHITTED, specular.reason);
    }
    if specular.needed {
        return (Integrator::PATH, format!("{}, and no light but what surrounds the scene", specular.reason));
    }
    (Integrator::RayCasting, specular.reason)
}
// ANCHOR_END: integrator_of

/// The camera and the integrator that it names.
fn named_integrator(scene: &Census<'_>) -> Option<(Entity, Integrator)> {
    let camera = camera_of(scene).ok()?;
    scene.get::<Integrator>(camera).map(|own| (camera, *own))
}

/// Whether there is a light without an area.
fn has_points(scene: &Census<'_>) -> bool {
    light_kinds(scene).any(|kind| !(kind.entities)(scene).is_empty())
}

/// Evidence that rays are traced beyond the first surface.
pub fn followed_evidence(scene: &Census<'_>) -> Evidence {
    needed_if(scene, |integrator| integrator.transport().follows_paths)
}

/// Evidence that the picture shows ambient occlusion.
pub fn occlusion_evidence(scene: &Census<'_>) -> Evidence {
    needed_if(scene, |integrator| integrator.transport().occlusion.is_some())
}

/// The evidence of something that lighting needs, except with ambient occlusion, which has no lights.
pub fn unless_occlusion(scene: &Census<'_>, evidence: Evidence) -> Evidence {
    let occlusion = occlusion_evidence(scene);
    let instead = || Evidence { needed: false, reason: format!("{} shows no other light", occlusion.reason), count: 0 };
    if occlusion.needed && evidence.needed { instead() } else { evidence }
}

/// Evidence that area lights are sampled (next-event estimation).
pub fn light_sampling_evidence(scene: &Census<'_>) -> Evidence {
    needed_if(scene, |integrator| integrator.transport().samples_lights())
}

/// Evidence that light sampling and BSDF sampling are combined by multiple importance sampling.
pub fn mis_evidence(scene: &Census<'_>) -> Evidence {
    needed_if(scene, |integrator| integrator.transport().is_mis())
}

/// Evidence that the scene's integrator is of a kind.
pub fn needed_if(scene: &Census<'_>, is_of_kind: impl Fn(Integrator) -> bool) -> Evidence {
    let ChosenIntegrator { integrator, reason, .. } = integrator_of(scene);
    let reason = format!("{}: {reason}", integrator.in_words());
    Evidence { needed: is_of_kind(integrator), reason, count: 0 }
}

/// The integrator's parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct IntegratorTable {
    /// The greatest number of path segments, camera ray included: 1 for emitted light only, 2 for direct light.
    pub max_depth: u32,
    /// The depth from which Russian roulette terminates paths.
    pub roulette: u32,
    /// The throughput below which it may do so.
    ///
    /// Variance for the time is least where a path survives with the probability of what it may bring, over the noise of one
    /// sample (Bolin and Meyer 1997); in a Cornell box that noise is about a quarter of the light.
    /// Where each vertex is joined with all of another path, one more costs more than it brings.
    pub at_risk: f64,
    /// Whether area lights are sampled (next-event estimation).
    pub samples_lights: bool,
    /// The factor by which radiance is scaled in the densest glass: its index of refraction squared, at least 1.
    pub eta_scale: f64,
    /// Whether light sampling and BSDF sampling are combined by multiple importance sampling.
    pub mis: bool,
    /// The distance within which a shape occludes the sky, in scene units.
    pub distance: f32,
}

impl Table for IntegratorTable {
    const NAME: &'static str = "integrator";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let camera = camera_of(scene)?;
        let who = || kind_and_name(scene, "camera", camera);
        if let Some(other) = at_most_one::<Integrator>(scene, "integrator", "Integrator")?
            && other != camera
        {
            let who = kind_and_name(scene, "integrator", other);
            return Err(SceneError::new(who, "integrator", "on no camera", "it must be on the camera"));
        }
        let does = integrator_of(scene).integrator.transport();
        let distance = match does.occlusion {
            Some(distance) if distance != f64::INFINITY => positive_length(&who(), "integrator distance", distance)?,
            Some(distance) => distance,
            None => 0.0,
        };
        let table = Self {
            max_depth: does.max_depth,
            roulette: does.roulette,
            at_risk: if bidirectional_evidence(scene).needed { 1.0 } else { 0.25 },
            samples_lights: does.samples_lights(),
            eta_scale: eta_scale_in_glass(scene)?,
            mis: does.is_mis(),
            distance: distance as f32,
        };
        if table.max_depth == 0 {
            let accepted = "it must be at least 1, for emitted light, or 2, for direct light";
            return Err(SceneError::new(who(), "integrator max_depth", "0", accepted));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The largest squared index of refraction among the kinds of glass in use; 1 without any.
fn eta_scale_in_glass(scene: &Census<'_>) -> Result<f64, SceneError> {
    if !glass_evidence(scene).needed {
        return Ok(1.0);
    }
    let densest = scene.table::<GlassTable>()?.ior.iter().copied().fold(1.0, f64::max);
    Ok(densest * densest)
}

/// The number of light paths in a batch.
pub const LIGHT_PATHS: u32 = 1024;

/// The greatest number of light paths per camera path.
const MAX_PATHS: f64 = 1024.0;

/// The radii that photons may be gathered within, in scene units.
const RADII: std::ops::RangeInclusive<f64> = 1e-12..=1e12;

/// The number of light paths, and the radius of photons.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightTracingTable {
    /// Light paths per sample of every pixel.
    pub paths: f64,
    /// The radius of photons for the first sample, in scene units; 0 where it follows from them.
    pub radius: f64,
    /// Light paths for a sample of all pixels, where each sample has its own: whole batches of them.
    pub each_sample: f64,
}

/// What messages call each way to start paths on lights: the field, the field of its number, and the noun.
const TRACING: [&str; 3] = ["light_tracing", "light_tracing paths", "light tracing"];
const MAPPING: [&str; 3] = ["photon_mapping", "photon_mapping paths", "photon mapping"];
const BIDIRECTIONAL: [&str; 3] =
    ["bidirectional_path_tracing", "bidirectional_path_tracing paths", "bidirectional path tracing"];

/// The number of light paths for so many samples of pixels: whole batches of them.
fn paths_of(samples: f64, paths: f64) -> f64 {
    (samples * paths / f64::from(LIGHT_PATHS)).ceil() * f64::from(LIGHT_PATHS)
}

impl Table for LightTracingTable {
    const NAME: &'static str = "light tracing";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let asked = [
            (at_most_one::<LightTracing>(scene, "light_tracing", "LightTracing")?, TRACING),
            (at_most_one::<PhotonMapping>(scene, "photon_mapping", "PhotonMapping")?, MAPPING),
            (
                at_most_one::<BidirectionalPathTracing>(
                    scene,
                    "bidirectional_path_tracing",
                    "BidirectionalPathTracing",
                )?,
                BIDIRECTIONAL,
            ),
        ];
        let mut asked = asked.into_iter().filter_map(|(entity, names)| Some((entity?, names)));
        let Some((entity, [field, paths_field, kind])) = asked.next() else { return Ok(Self::default()) };
        if let Some((other, [other_field, _, other_kind])) = asked.next() {
            let (who, beside) = (kind_and_name(scene, other_kind, other), format!("beside {field}"));
            return Err(SceneError::new(who, other_field, beside, "either finds the same light: keep one of the two"));
        }
        let camera = camera_of(scene)?;
        if camera != entity {
            let who = kind_and_name(scene, kind, entity);
            return Err(SceneError::new(who, field, "on no camera", "it must be on the camera"));
        }
        let photons = scene.get::<PhotonMapping>(camera).copied();
        let joined = scene.get::<BidirectionalPathTracing>(camera).copied();
        let paths = scene.get::<LightTracing>(camera).map(|own| own.paths).or(photons.map(|own| own.paths));
        let paths = paths.or(joined.map(|own| own.paths));
        let paths = paths.unwrap_or_default();
        let who = kind_and_name(scene, "camera", camera);
        if !(1.0 / MAX_PATHS..=MAX_PATHS).contains(&paths) {
            let accepted = format!("it must be a number from 1/{MAX_PATHS} to {MAX_PATHS}");
            return Err(SceneError::new(who, paths_field, number(paths), accepted));
        }
        let radius = photons.map_or(0.0, |own| own.radius);
        if !(radius == 0.0 || RADII.contains(&radius)) {
            let accepted = format!(
                "it must be a number from {} to {}, or 0 for one that follows from the photons",
                RADII.start(),
                RADII.end()
            );
            return Err(SceneError::new(who, "photon_mapping radius", number(radius), accepted));
        }
        let refused = |value: &str, accepted: &str| Err(SceneError::new(who, field, value, accepted));
        if !integrator_of(scene).integrator.transport().samples_diffuse {
            return refused(
                "without paths",
                "paths from the lights complement the camera's: give it the integrator Path()",
            );
        }
        if (photons.is_some() || joined.is_some()) && dispersion_evidence(scene).needed {
            let accepted = "the two paths that meet have each a wavelength: use light_tracing";
            return refused("beside dispersion", accepted);
        }
        if joined.is_some() && !integrator_of(scene).integrator.transport().is_mis() {
            let accepted = "each way to find light counts by its MIS weight: give it Path(), whose lights are Mis";
            return refused("without MIS", accepted);
        }
        if joined.is_some() && light_kinds(scene).any(|kind| !kind.is_distant && kind.is_chosen_of_many(scene)) {
            let accepted = "with more than 64 lights of a kind without an area one is chosen for each surface: use fewer, or \
                            small spheres that emit";
            return refused("with so many lights", accepted);
        }
        if photons.is_none() && !camera_kind(scene)?.has_image_plane {
            return no_image_plane(scene);
        }
        if motion_evidence(scene).needed {
            return refused("while something moves", "light paths need a scene without motion: remove the Motion");
        }
        if adaptive_of(scene)?.is_some() {
            let accepted =
                "a path from a light may contribute to any pixel, so none can request more: remove the Adaptive";
            return refused("with adaptive sampling", accepted);
        }
        let image = scene.table::<ImageFrame>()?;
        Ok(Self { paths, radius, each_sample: paths_of(f64::from(image.width) * f64::from(image.height), paths) })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The error of light tracing with a camera that has no image plane.
pub(super) fn no_image_plane<T>(scene: &Census<'_>) -> Result<T, SceneError> {
    let (who, _) = named_camera(scene)?;
    let planes = CAMERA_KINDS.iter().filter(|kind| kind.has_image_plane).map(|kind| kind.names.noun);
    let accepted = format!("light paths are connected to {} camera", any_of(planes));
    let value = format!("on {} camera", with_article(camera_kind(scene)?.names.noun));
    let field = if bidirectional_request(scene).needed { BIDIRECTIONAL[0] } else { TRACING[0] };
    Err(SceneError::new(who, field, value, accepted))
}

fn tracing_request(scene: &Census<'_>) -> Evidence {
    Evidence::of::<LightTracing>(scene, "light-tracing camera")
}

/// Evidence that the camera requests it.
pub(super) fn bidirectional_request(scene: &Census<'_>) -> Evidence {
    Evidence::of::<BidirectionalPathTracing>(scene, "camera for bidirectional path tracing")
}

/// Evidence that paths start on lights: for caustics alone, or for all light.
pub fn traced_evidence(scene: &Census<'_>) -> Evidence {
    let caustics = caustics_evidence(scene);
    if caustics.needed { caustics } else { either(bidirectional_evidence(scene), caustics) }
}

/// Evidence that caustics are traced from the lights: the camera requests it, and there are a light to start on,
/// mirrors or glass, and non-specular surfaces.
pub fn caustics_evidence(scene: &Census<'_>) -> Evidence {
    let photons = Evidence::of::<PhotonMapping>(scene, "photon-mapping camera");
    let requested = if photons.needed { photons } else { tracing_request(scene) };
    if !requested.needed {
        return requested;
    }
    requested.and(|| specular_evidence(scene)).and(|| material_evidence(scene)).and(|| started_on_evidence(scene))
}

/// Evidence that paths from the lights and from the camera are joined vertex by vertex: the camera requests it, and there
/// are a light to start on and surfaces that are not specular.
pub fn bidirectional_evidence(scene: &Census<'_>) -> Evidence {
    bidirectional_request(scene).and(|| material_evidence(scene)).and(|| started_on_evidence(scene))
}

/// Evidence that light paths are connected to the camera by straight lines.
pub fn joined_evidence(scene: &Census<'_>) -> Evidence {
    let caustics = joined_caustics_evidence(scene);
    if caustics.needed { caustics } else { either(bidirectional_evidence(scene), caustics) }
}

/// Evidence that those of them that come from mirrors and glass are.
pub fn joined_caustics_evidence(scene: &Census<'_>) -> Evidence {
    let requested = tracing_request(scene);
    if requested.needed { caustics_evidence(scene) } else { requested }
}

/// The first evidence where something asked for it, or else the second.
fn either(one: Evidence, other: Evidence) -> Evidence {
    if one.needed { one } else { other }
}

/// Evidence that they are found by photons.
pub fn photon_evidence(scene: &Census<'_>) -> Evidence {
    let requested = Evidence::of::<PhotonMapping>(scene, "photon-mapping camera");
    if requested.needed { traced_evidence(scene) } else { requested }
}

/// Evidence of a light on which light paths can start.
pub fn started_on_evidence(scene: &Census<'_>) -> Evidence {
    area_light_evidence(scene).or(shadowed_point_evidence(scene)).or(distant_start_evidence(scene))
}

/// Evidence of a light with a position and no area that casts shadows.
pub fn shadowed_point_evidence(scene: &Census<'_>) -> Evidence {
    shadowed_evidence(scene, false)
}

/// Evidence of a light without a position that casts shadows.
pub fn shadowed_distant_evidence(scene: &Census<'_>) -> Evidence {
    shadowed_evidence(scene, true)
}

/// Evidence that light paths start on an environment image, so that the camera's paths must not find the same light.
pub fn environment_traced_evidence(scene: &Census<'_>) -> Evidence {
    caustics_evidence(scene).and(|| environment_light_evidence(scene)).and(|| distant_start_evidence(scene))
}
