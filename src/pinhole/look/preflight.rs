use super::inside::shape_around_camera;
use super::pilot::{Pilot, pilot};
use super::slow::{Effort, many_bounces, never_done, slow, why_slow};
use super::unseen::unseen;
use crate::extract::{
    ImageFrame, IntegratorTable, LightTracingTable, SamplingTable, ShapeTable, emissive_evidence, followed_evidence,
    glass_evidence, integrator_of, light_sampling_evidence, mirror_evidence, shadowed_point_evidence, shape_name,
    traced_evidence,
};
use crate::plan::{Census, Evidence, ExtractedTable, Plan};
use crate::scene::{DirectionalLight, Environment, Integrator};
use crate::shade::point_evidence;
use crate::{Error, Result};
use std::time::{Duration, Instant};

/// From this share of the rays on a picture counts as black or white.
const NEARLY_ALL: f64 = 0.95;
/// From this share on it is said that highlights are lost.
const MANY: f64 = 0.25;

/// How a picture is to be rendered, as far as it matters to how long it takes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Preflight {
    /// Workers; none for as many as the machine has cores.
    pub threads: Option<usize>,
    /// Whether it ends after a given time.
    pub ends_in_time: bool,
    /// How long rays may be tried; none for a second.
    pub patience: Option<Duration>,
}

/// How long rays are tried. A build without optimisation is about ten times as slow and gets that much longer, so that it
/// says the same.
const PATIENCE: Duration = Duration::from_secs(if cfg!(debug_assertions) { 10 } else { 1 });

impl Preflight {
    /// The same for someone who has been waiting since `began`: what reading the scene took is taken off the time for
    /// trying rays, of which a fifth is always left.
    pub fn since(self, began: Instant) -> Self {
        Self { patience: Some(PATIENCE.saturating_sub(began.elapsed()).max(PATIENCE / 5)), ..self }
    }
}

/// Says why the picture of a scene is likely to be black or white, to miss light, or to take very long, before it is
/// rendered: a sentence each.
///
/// Where the plan makes a picture of light, one sample of each pixel of some small pieces of it is traced for that.
/// That ends after about a second, whatever the scene: what is said then rests on the rays that have come to an end.
/// `prepared` are the plan and the tables that the render has of the scene.
/// Errors: what the render would be refused for.
pub fn preflight(scene: &Census<'_>, prepared: (&Plan, &[ExtractedTable]), asked: Preflight) -> Result<Vec<String>> {
    if prepared.0.view.is_some() {
        return Ok(Vec::new());
    }
    let pilot = pilot(scene, prepared, asked.patience.unwrap_or(PATIENCE))?;
    let shapes = scene.table::<ShapeTable>().map_err(Error::from)?;
    let (effort, max_depth) = (effort(scene, asked)?, scene.table::<IntegratorTable>()?.max_depth);
    let mut told = Vec::new();
    if pilot.rays > 0 {
        told.extend(by_pilot(scene, &pilot, &shapes));
        told.extend(many_bounces(&pilot, max_depth));
    } else {
        told.push(never_done(&pilot, &why_slow(scene, &pilot, max_depth, shapes.kind.len()), effort));
    }
    told.extend(shape_around_camera(scene, &shapes)?);
    told.extend(unseen(scene));
    told.extend(out_of_reach(scene));
    if pilot.rays > 0 {
        told.extend(slow(pilot.seconds_a_ray, effort));
    }
    Ok(told)
}

/// What a few rays tell of the picture.
fn by_pilot(scene: &Census<'_>, pilot: &Pilot, shapes: &ShapeTable) -> Vec<String> {
    let share = |count: usize| count as f64 / pilot.rays.max(1) as f64;
    let mut told = Vec::new();
    // Light that is traced from lights is not among what the pilot brings.
    let traced = traced_evidence(scene).needed && point_evidence(scene).or(emissive_evidence(scene)).needed;
    if share(pilot.black) >= NEARLY_ALL && !traced {
        told.push(format!("the picture is likely to be black: {}", why_black(scene, pilot)));
    } else if pilot.met == 0 && !shapes.kind.is_empty() {
        told.push(format!("none of {} rays tried all over the picture meets a shape", pilot.rays));
    }
    let percent = 100.0 * share(pilot.beyond_white);
    if share(pilot.beyond_white) >= MANY {
        told.push(format!(
            "{percent:.0} % of the rays tried bring back more than white, which a PNG cuts off: the EXR keeps it, and \
             dimmer lights avoid it"
        ));
    }
    told
}

fn why_black(scene: &Census<'_>, pilot: &Pilot) -> String {
    let (points, areas) = (point_evidence(scene), emissive_evidence(scene).or(environment_evidence(scene)));
    let aimed = points.needed || light_sampling_evidence(scene).needed;
    let lit = points.or(areas);
    let blocked: usize = pilot.blocked.values().sum();
    let integrator = integrator_of(scene).integrator;
    if let Integrator::AmbientOcclusion { distance } = integrator {
        return format!("within the distance of {distance} something hides the sky from all that the camera sees");
    }
    if !lit.needed {
        return "there is no light, no surface that emits, and no background with a colour".into();
    }
    if pilot.met == 0 {
        return format!("none of {} rays meets a shape, and there is no background with a colour", pilot.rays);
    }
    if !aimed && matches!(integrator, Integrator::Path { .. }) {
        let (found, rays) = (pilot.rays - pilot.black, pilot.rays);
        return format!(
            "{found} of {rays} rays came upon a light by random ({}); LightStrategy::Mis aims at lights too",
            lit.reason
        );
    }
    if !aimed {
        return format!("no light that is aimed at is there, and others light nothing here ({})", lit.reason);
    }
    if pilot.to_lights == 0 {
        return format!(
            "what the camera sees faces away from every light, or the lights shine elsewhere ({})",
            lit.reason
        );
    }
    if blocked == pilot.to_lights {
        let most = pilot.blocked.iter().max_by_key(|(_, count)| **count);
        let name = most.map_or_else(String::new, |(&shape, _)| shape_name(scene, shape as usize));
        return format!("each of {blocked} rays to lights is blocked, most of them by the {name}");
    }
    format!("so little light arrives ({}) that nearly all of it is below what can be seen", lit.reason)
}

fn environment_evidence(scene: &Census<'_>) -> Evidence {
    Evidence::of::<Environment>(scene, "environment")
}

/// How many samples there are to take, a way from a light being one; without an end by time.
fn effort(scene: &Census<'_>, asked: Preflight) -> Result<Effort> {
    let image = scene.table::<ImageFrame>()?;
    let pixels = f64::from(image.width) * f64::from(image.height);
    let paths = if traced_evidence(scene).needed { scene.table::<LightTracingTable>()?.paths } else { 0.0 };
    let samples = f64::from(scene.table::<SamplingTable>()?.samples) * (1.0 + paths);
    let threads = asked.threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    Ok(Effort { samples: (!asked.ends_in_time).then_some(samples * pixels), threads })
}

/// What the integrator cannot find in this scene at all.
fn out_of_reach(scene: &Census<'_>) -> Vec<String> {
    let (points, bends) = (point_evidence(scene), glass_evidence(scene).or(mirror_evidence(scene)));
    if !(points.needed && bends.needed && followed_evidence(scene).needed) {
        return Vec::new();
    }
    let directional = Evidence::of::<DirectionalLight>(scene, "directional light");
    let placed = shadowed_point_evidence(scene);
    let mut told = Vec::new();
    if placed.needed && !traced_evidence(scene).needed {
        told.push(format!(
            "light that comes by way of mirrors or glass ({}) from a light without an area ({}) is missing from matte \
             surfaces, for no ray meets a point; LightTracing on the camera, beside paths, finds it from the light",
            bends.reason, placed.reason
        ));
    }
    if directional.needed {
        told.push(format!(
            "no rays start on lights without a place ({}): what comes from there by way of mirrors or glass is missing",
            directional.reason
        ));
    }
    told
}
