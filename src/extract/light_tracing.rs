use super::check::{at_most_one, kind_and_name};
use super::{
    ImageShape, adaptive_of, area_light_evidence, camera_entity, glass_evidence, integrator_of, lens_evidence,
    material_evidence, mirror_evidence, motion_evidence,
};
use crate::plan::{Carried, Evidence, Table};
use crate::scene::{EquirectangularCamera, FisheyeCamera, Integrator, LightTracing, PointLight, Refusal, SpotLight};
use bevy_ecs::prelude::*;

/// The most rays from the lights for a ray of the camera.
const MOST_PATHS: u32 = 1024;

/// How many ways start on lights.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightTracingTable {
    /// Ways from the lights for every sample of every pixel.
    pub paths: u32,
}

impl Table for LightTracingTable {
    const NAME: &'static str = "light tracing";

    fn extract(scene: &World) -> Result<Self, Refusal> {
        let Some(entity) = at_most_one::<LightTracing>(scene, "light_tracing", "LightTracing")? else {
            return Ok(Self::default());
        };
        let camera = camera_entity(scene)?;
        if camera != entity {
            let who = kind_and_name(scene, "light tracing", entity);
            return Err(Refusal::new(who, "light_tracing", "on no camera", "it must be on the camera"));
        }
        let paths = scene.get::<LightTracing>(camera).map_or(0, |own| own.paths);
        let who = kind_and_name(scene, "camera", camera);
        if !(1..=MOST_PATHS).contains(&paths) {
            let accepted = format!("it must be a whole number from 1 to {MOST_PATHS}");
            return Err(Refusal::new(who, "light_tracing paths", paths.to_string(), accepted));
        }
        let refused = |value: &str, accepted: &str| Err(Refusal::new(who, "light_tracing", value, accepted));
        if !matches!(integrator_of(scene).integrator, Integrator::Path { .. }) {
            return refused("without paths", "light from the lights joins the camera's paths: give it Path(…)");
        }
        let [fisheye, around] =
            [scene.get::<FisheyeCamera>(camera).is_some(), scene.get::<EquirectangularCamera>(camera).is_some()];
        if fisheye || around || lens_evidence(scene).needed {
            let camera = match (fisheye, around) {
                (true, _) => "on a fisheye camera",
                (_, true) => "on an equirectangular camera",
                _ => "on a camera with a lens",
            };
            return refused(camera, "light is joined to a perspective camera without a lens, or an orthographic one");
        }
        if motion_evidence(scene).needed {
            return refused("while something moves", "light is joined to what stands still: take off the Motion");
        }
        if adaptive_of(scene)?.is_some() {
            let accepted = "a ray from a light may reach any pixel, so none can ask for more: take off the Adaptive";
            return refused("with adaptive sampling", accepted);
        }
        ImageShape::extract(scene)?;
        Ok(Self { paths })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// Evidence that caustics are traced from the lights: that the camera asks for it, and that there are a light to start
/// on, mirrors or glass, and surfaces that spread light.
pub fn traced_evidence(scene: &World) -> Evidence {
    let asked = Evidence::of::<LightTracing>(scene, "camera that traces light");
    if !asked.needed {
        return asked;
    }
    let polished = || {
        let (mirrors, glass) = (mirror_evidence(scene), glass_evidence(scene));
        mirrors.or(glass)
    };
    asked.and(polished).and(|| material_evidence(scene)).and(|| started_on_evidence(scene))
}

/// Evidence of a light that rays can start on.
pub fn started_on_evidence(scene: &World) -> Evidence {
    const POINTS: [Carried; 2] = [Carried::of::<PointLight>(), Carried::of::<SpotLight>()];
    let points = Evidence::among_any(scene, "point or spot light", &POINTS, |light| {
        light.get::<PointLight>().is_none_or(|light| light.casts_shadows)
            && light.get::<SpotLight>().is_none_or(|light| light.casts_shadows)
    });
    area_light_evidence(scene).or(points)
}
