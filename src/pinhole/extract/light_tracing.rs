use super::camera_entity::{CAMERA_KINDS, any_of, camera_kind, camera_of, named_camera, with_article};
use super::check::{at_most_one, kind_and_name, number};
use super::light_path::distant_start_evidence;
use super::lights_of::shadowed_evidence;
use super::{
    ImageFrame, adaptive_of, area_light_evidence, environment_light_evidence, integrator_of, material_evidence,
    motion_evidence, specular_evidence,
};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{LightTracing, SceneError};
use bevy_ecs::prelude::*;

/// The greatest number of light paths per camera path.
const MAX_PATHS: f64 = 1024.0;

/// The number of light paths.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightTracingTable {
    /// Light paths per sample of every pixel.
    pub paths: f64,
}

impl Table for LightTracingTable {
    const NAME: &'static str = "light tracing";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let Some(entity) = at_most_one::<LightTracing>(scene, "light_tracing", "LightTracing")? else {
            return Ok(Self::default());
        };
        let camera = camera_of(scene)?;
        if camera != entity {
            let who = kind_and_name(scene, "light tracing", entity);
            return Err(SceneError::new(who, "light_tracing", "on no camera", "it must be on the camera"));
        }
        let paths = scene.get::<LightTracing>(camera).map_or(0.0, |own| own.paths);
        let who = kind_and_name(scene, "camera", camera);
        if !(1.0 / MAX_PATHS..=MAX_PATHS).contains(&paths) {
            let accepted = format!("it must be a number from 1/{MAX_PATHS} to {MAX_PATHS}");
            return Err(SceneError::new(who, "light_tracing paths", number(paths), accepted));
        }
        let refused = |value: &str, accepted: &str| Err(SceneError::new(who, "light_tracing", value, accepted));
        if !integrator_of(scene).integrator.transport().samples_diffuse {
            return refused(
                "without paths",
                "light tracing complements the camera's paths: give it the integrator Path()",
            );
        }
        if !camera_kind(scene)?.has_image_plane {
            return no_image_plane(scene);
        }
        if motion_evidence(scene).needed {
            return refused("while something moves", "light paths need a scene without motion: remove the Motion");
        }
        if adaptive_of(scene)?.is_some() {
            let accepted = "a light path may contribute to any pixel, so none can request more: remove the Adaptive";
            return refused("with adaptive sampling", accepted);
        }
        scene.table::<ImageFrame>()?;
        Ok(Self { paths })
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
    Err(SceneError::new(who, "light_tracing", value, accepted))
}

/// Evidence that caustics are traced from the lights: the camera requests it, and there are a light to start on,
/// mirrors or glass, and non-specular surfaces.
pub fn traced_evidence(scene: &Census<'_>) -> Evidence {
    let requested = Evidence::of::<LightTracing>(scene, "light-tracing camera");
    if !requested.needed {
        return requested;
    }
    requested.and(|| specular_evidence(scene)).and(|| material_evidence(scene)).and(|| started_on_evidence(scene))
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
    traced_evidence(scene).and(|| environment_light_evidence(scene)).and(|| distant_start_evidence(scene))
}
