use super::camera_entity::camera_of;
use super::emissive::emissive_evidence;
use super::lights_of::light_kinds;
use super::material::{glossy_evidence, material_evidence, specular_evidence};
use super::sky::sky_evidence;
use crate::plan::{Census, Evidence};
use crate::scene::{Integrator, called};
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
/// Glossy materials such as rough metal, and others in the light of emitting surfaces or of a sky that is not black,
/// need sampled points and directions, hence path tracing; mirrors and glass lit by lights without an area need none,
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
    let glossy = glossy_evidence(scene);
    let emitters = emissive_evidence(scene).and(|| material_evidence(scene));
    let specular = specular_evidence(scene);
    let by_bsdf = glossy.or(emitters);
    if by_bsdf.needed {
        return (Integrator::PATH, by_bsdf.reason);
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
