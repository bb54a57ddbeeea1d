use super::black::black;
use super::emitters::emitters;
use super::inside::{ior_around_camera, shape_around_camera};
use super::missing::missing_paths;
use super::pilot::{Pilot, pilot};
use super::radians::radians;
use super::slow::{Effort, many_bounces, many_light_bounces, never_done, slow, why_slow};
use super::thin::{on_the_surface, unresolved_glass};
use super::tiny::tiny_shapes;
use super::unseen::unseen;
use crate::extract::{ImageFrame, IntegratorTable, LightTracingTable, SamplingTable, ShapeTable, traced_evidence};
use crate::plan::{Census, ExtractedTable, Plan};
use crate::{Error, Result};
use std::time::{Duration, Instant};

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
    foretell(scene, prepared, conditions).map(|foretold| foretold.warnings)
}

/// What is said before a render.
#[derive(Clone, Debug, Default)]
pub struct Foretold {
    /// A sentence each.
    pub warnings: Vec<String>,
    /// A pixel near the middle of the picture that shows a lit surface; none where no test ray found one.
    pub lit_pixel: Option<[u32; 2]>,
}

/// The same as [`preflight`], with a pixel that is worth a trace.
///
/// Errors: whatever the render would refuse.
pub fn foretell(scene: &Census<'_>, prepared: (&Plan, &[ExtractedTable]), conditions: Preflight) -> Result<Foretold> {
    if prepared.0.view.is_some() {
        return Ok(Foretold::default());
    }
    let pilot = pilot(scene, prepared, conditions.patience.unwrap_or(PATIENCE))?;
    let shapes = scene.table::<ShapeTable>().map_err(Error::from)?;
    let (effort, max_depth) = (effort(scene, conditions)?, scene.table::<IntegratorTable>()?.max_depth);
    let mut warnings = radians(scene);
    if pilot.rays > 0 {
        warnings.extend(by_pilot(scene, &pilot, &shapes, samples_each(scene)?)?);
        warnings.extend(tiny_shapes(scene, &pilot, &shapes)?);
        warnings.extend(many_bounces(&pilot, max_depth));
        warnings.extend(many_light_bounces(&pilot, max_depth));
    } else {
        warnings.push(never_done(&pilot, &why_slow(scene, &pilot, max_depth, shapes.kind.len()), effort));
    }
    warnings.extend(shape_around_camera(scene, &shapes)?);
    warnings.extend(unresolved_glass(scene)?);
    warnings.extend(on_the_surface(scene)?);
    warnings.extend(unseen(scene));
    warnings.extend(emitters(scene)?);
    warnings.extend(missing_paths(scene, &pilot));
    if let (true, Some(ray), Some(path)) = (pilot.rays > 0, pilot.seconds_a_ray, pilot.seconds_a_light_path) {
        warnings.extend(slow(ray + effort.light_paths * path, pilot.is_least, effort));
    }
    Ok(Foretold { warnings, lit_pixel: pilot.lit_pixel })
}

/// What a few test rays say about the picture.
fn by_pilot(scene: &Census<'_>, pilot: &Pilot, shapes: &ShapeTable, samples: f64) -> Result<Vec<String>> {
    let mut warnings = Vec::new();
    // The pilot's radiance does not include light traced from lights.
    let dark = if traced_evidence(scene).needed { None } else { black(scene, pilot, samples)? };
    if dark.is_none() && pilot.hits_nothing() && !shapes.kind.is_empty() && pilot.is_everywhere() {
        warnings.push(format!("none of {} test rays, spread over the picture, hits a shape", pilot.rays));
    }
    warnings.extend(dark);
    let beyond_white = pilot.beyond_white as f64 / pilot.rays.max(1) as f64;
    if beyond_white >= MANY && pilot.is_everywhere() {
        // What arrives there is refracted into fewer directions: it is no mistake of the lights.
        let why = match ior_around_camera(scene)?.filter(|ior| *ior > 1.0) {
            Some(ior) => format!(
                "the camera is in glass whose index of refraction is {ior}, where radiance is {:.3} times that outside",
                ior * ior
            ),
            None => "dimmer lights avoid it".into(),
        };
        warnings.push(format!(
            "{:.0} % of the test rays return more than white, which a PNG clips: the EXR keeps it, and {why}",
            100.0 * beyond_white
        ));
    }
    Ok(warnings)
}

/// The number of samples to take, and of paths from lights for each; none where the render ends after a given time.
fn effort(scene: &Census<'_>, conditions: Preflight) -> Result<Effort> {
    let image = scene.table::<ImageFrame>()?;
    let pixels = f64::from(image.width) * f64::from(image.height);
    let paths = if traced_evidence(scene).needed { scene.table::<LightTracingTable>()?.paths } else { 0.0 };
    let samples = samples_each(scene)?;
    let threads = conditions.threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    Ok(Effort { samples: (!conditions.ends_in_time).then_some(samples * pixels), light_paths: paths, threads })
}

fn samples_each(scene: &Census<'_>) -> Result<f64> {
    Ok(f64::from(scene.table::<SamplingTable>()?.samples))
}
