use super::emitters::emitters;
use super::inside::shape_around_camera;
use super::pilot::{Pilot, pilot};
use super::slow::{Effort, many_bounces, many_light_bounces, never_done, slow, why_slow};
use super::unseen::unseen;
use crate::extract::{
    ImageFrame, IntegratorTable, LightTracingTable, SamplingTable, ShapeTable, distant_start_evidence,
    emissive_evidence, followed_evidence, integrator_of, light_sampling_evidence, point_evidence,
    shadowed_distant_evidence, shadowed_point_evidence, shape_name, specular_evidence, traced_evidence,
};
use crate::plan::{Census, Evidence, ExtractedTable, Plan};
use crate::scene::Environment;
use crate::{Error, Result};
use std::time::{Duration, Instant};

/// The fraction of rays from which a picture is called black.
const NEARLY_ALL: f64 = 0.95;
/// The fraction of rays above white from which a warning about clipped highlights is given.
const MANY: f64 = 0.25;

/// The conditions under which a picture will be rendered, as far as they affect how long it takes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Preflight {
    /// The number of workers; none for one per core.
    pub threads: Option<usize>,
    /// Whether the render stops after a given time.
    pub ends_in_time: bool,
    /// How long test rays may take; none for one second.
    pub patience: Option<Duration>,
}

/// How long test rays are traced; a build without optimisation, about ten times as slow, gets ten times as long, so
/// that its warnings are the same.
const PATIENCE: Duration = Duration::from_secs(if cfg!(debug_assertions) { 10 } else { 1 });

impl Preflight {
    /// The same for a user who has been waiting since `began`: the time spent on reading the scene is subtracted from
    /// the time for test rays, of which at least a fifth always remains.
    pub fn since(self, began: Instant) -> Self {
        Self { patience: Some(PATIENCE.saturating_sub(began.elapsed()).max(PATIENCE / 5)), ..self }
    }
}

/// Warnings, a sentence each, that the picture of a scene will probably be black or clipped, lack some light, or take
/// very long; given before it is rendered.
///
/// Where the plan makes a picture of light, one sample per pixel of some small tiles of it is traced for this.
/// That takes about a second for any scene; the warnings then rest on the rays that were finished.
/// `prepared` holds the plan and the tables that the render has made of the scene.
/// Errors: whatever the render would refuse.
pub fn preflight(
    scene: &Census<'_>,
    prepared: (&Plan, &[ExtractedTable]),
    conditions: Preflight,
) -> Result<Vec<String>> {
    if prepared.0.view.is_some() {
        return Ok(Vec::new());
    }
    let pilot = pilot(scene, prepared, conditions.patience.unwrap_or(PATIENCE))?;
    let shapes = scene.table::<ShapeTable>().map_err(Error::from)?;
    let (effort, max_depth) = (effort(scene, conditions)?, scene.table::<IntegratorTable>()?.max_depth);
    let mut warnings = Vec::new();
    if pilot.rays > 0 {
        warnings.extend(by_pilot(scene, &pilot, &shapes));
        warnings.extend(many_bounces(&pilot, max_depth));
        warnings.extend(many_light_bounces(&pilot, max_depth));
    } else {
        warnings.push(never_done(&pilot, &why_slow(scene, &pilot, max_depth, shapes.kind.len()), effort));
    }
    warnings.extend(shape_around_camera(scene, &shapes)?);
    warnings.extend(unseen(scene));
    warnings.extend(emitters(scene)?);
    warnings.extend(missing_paths(scene));
    if pilot.rays > 0 {
        warnings.extend(slow(pilot.seconds_a_ray + effort.light_paths * pilot.seconds_a_light_path, effort));
    }
    Ok(warnings)
}

/// What a few test rays say about the picture.
fn by_pilot(scene: &Census<'_>, pilot: &Pilot, shapes: &ShapeTable) -> Vec<String> {
    let fraction = |count: usize| count as f64 / pilot.rays.max(1) as f64;
    let mut warnings = Vec::new();
    // The pilot's radiance does not include light traced from lights.
    let traced = traced_evidence(scene).needed;
    if fraction(pilot.black) >= NEARLY_ALL && !traced {
        warnings.push(format!("the picture will probably be black: {}", why_black(scene, pilot)));
    } else if pilot.hits == 0 && !shapes.kind.is_empty() {
        warnings.push(format!("none of {} test rays, spread over the picture, hits a shape", pilot.rays));
    }
    let percent = 100.0 * fraction(pilot.beyond_white);
    if fraction(pilot.beyond_white) >= MANY {
        warnings.push(format!(
            "{percent:.0} % of the test rays return more than white, which a PNG clips: the EXR keeps it, and \
             dimmer lights avoid it"
        ));
    }
    warnings
}

fn why_black(scene: &Census<'_>, pilot: &Pilot) -> String {
    let (points, areas) = (point_evidence(scene), emissive_evidence(scene).or(environment_evidence(scene)));
    let sampled = points.needed || light_sampling_evidence(scene).needed;
    let lights = points.or(areas);
    let blocked: usize = pilot.blocked.values().sum();
    let does = integrator_of(scene).integrator.transport();
    if let Some(distance) = does.occlusion {
        return format!("within {distance} units, something hides the sky from everything that the camera sees");
    }
    if !lights.needed {
        return "there is no light, no surface that emits light, and no background with a colour".into();
    }
    if pilot.hits == 0 {
        return format!("none of {} rays hits a shape, and there is no background with a colour", pilot.rays);
    }
    if does.max_depth == 1 {
        return format!(
            "at max_depth 1 a path has one segment, from a light to the camera, so that what emits nothing is black ({}); \
             max_depth 2 illuminates it",
            lights.reason
        );
    }
    if !sampled && does.samples_diffuse {
        let (found, rays) = (pilot.rays - pilot.black, pilot.rays);
        return format!(
            "{found} of {rays} rays hit a light at random ({}); LightStrategy::Mis samples lights as well",
            lights.reason
        );
    }
    if !sampled {
        return format!(
            "no light here is sampled with shadow rays, and the others illuminate nothing ({})",
            lights.reason
        );
    }
    if pilot.to_lights == 0 {
        return format!(
            "everything that the camera sees faces away from every light, or is not in any light's beam ({})",
            lights.reason
        );
    }
    if blocked == pilot.to_lights {
        let most = pilot.blocked.iter().max_by_key(|(_, count)| **count);
        let name = most.map_or_else(String::new, |(&shape, _)| shape_name(scene, shape as usize));
        return format!("all {blocked} shadow rays are blocked, most of them by the {name}");
    }
    format!("so little light arrives ({}) that nearly all of it is too dark to be seen", lights.reason)
}

fn environment_evidence(scene: &Census<'_>) -> Evidence {
    Evidence::of::<Environment>(scene, "environment")
}

/// The number of samples to take, and of paths from lights for each; none where the render ends after a given time.
fn effort(scene: &Census<'_>, conditions: Preflight) -> Result<Effort> {
    let image = scene.table::<ImageFrame>()?;
    let pixels = f64::from(image.width) * f64::from(image.height);
    let paths = if traced_evidence(scene).needed { scene.table::<LightTracingTable>()?.paths } else { 0.0 };
    let samples = f64::from(scene.table::<SamplingTable>()?.samples);
    let threads = conditions.threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    Ok(Effort { samples: (!conditions.ends_in_time).then_some(samples * pixels), light_paths: paths, threads })
}

/// The paths of light that the integrator cannot sample in this scene at all.
fn missing_paths(scene: &Census<'_>) -> Vec<String> {
    let (points, bends) = (point_evidence(scene), specular_evidence(scene));
    if !(points.needed && bends.needed && followed_evidence(scene).needed) {
        return Vec::new();
    }
    let distant = shadowed_distant_evidence(scene);
    let starts_outside = !distant.needed || distant_start_evidence(scene).needed;
    let started = shadowed_point_evidence(scene);
    let started = if distant.needed && starts_outside { started.or(distant.clone()) } else { started };
    let mut warnings = Vec::new();
    if started.needed && !traced_evidence(scene).needed {
        warnings.push(format!(
            "light that arrives through mirrors or glass ({}) from a light without an area ({}) is missing on matte \
             surfaces, since no sampled ray can hit a point; LightTracing on the camera, beside paths, finds it from the light",
            bends.reason, started.reason
        ));
    }
    if !starts_outside {
        warnings.push(format!(
            "no paths start on lights without a position ({}) where a mirror or glass is infinite: their light through \
             it is missing; a disk, a rectangle or a cuboid in its place is not",
            distant.reason
        ));
    }
    warnings
}
