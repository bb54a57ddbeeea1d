//! What is said before a render.

use super::emitters::emitters;
use super::inside::{ior_around_camera, shape_around_camera};
use super::media::odd_media;
use super::pilot::{Pilot, pilot};
use super::radians::radians;
use super::slow::{Effort, many_bounces, many_light_bounces, never_done, slow, why_slow};
use crate::each::Each;
use crate::extract::{
    AreaLightTable, CameraAxes, EmissiveTable, ImageFrame, IntegratorTable, LightPathTable, LightTracingTable,
    OrthographicWindow, PerspectiveProjection, SamplingTable, ShapeTable, adaptive_of, area_light_evidence,
    camera_entity, contact_evidence, delta_light_shines, dispersion_evidence, distant_start_evidence,
    emissive_evidence, environment_light_evidence, exposure_of, followed_evidence, glossy_evidence, integrator_of,
    joined_evidence, listed_kind, matte_evidence, medium_evidence, motion_evidence, photon_evidence, pixel_width,
    point_evidence, shadowed_distant_evidence, shadowed_point_evidence, shape_name, sky_evidence, specular_evidence,
    starts_on_glass, traced_evidence, unresolved,
};
use crate::film::srgb_from_linear;
use crate::material::{D_LINE, IndexCurve, interior_of};
use crate::plan::{Census, ExtractedTable, Plan, counted};
use crate::scene::{Dispersion, Exposure, Glass, LightTransport, OrthographicCamera, PerspectiveCamera, called};
use crate::{Error, Result};
use bevy_ecs::prelude::With;
use glam::DVec3;
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

/// How long test rays are traced.
const PATIENCE: Duration = Duration::from_secs(1);

impl Preflight {
    /// The same for a user who has been waiting since `began`: the time spent on reading the scene is subtracted from
    /// the time for test rays, of which at least a fifth always remains.
    pub fn since(self, began: Instant) -> Self {
        let patience = self.patience.unwrap_or(PATIENCE);
        Self { patience: Some(patience.saturating_sub(began.elapsed()).max(patience / 5)), ..self }
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
    warnings.extend(unused_indices(scene)?);
    warnings.extend(emitters(scene)?);
    warnings.extend(odd_media(scene)?);
    warnings.extend(missing_paths(scene, &pilot));
    warnings.extend(odd_radius(scene)?);
    if let (true, Some(ray), Some(path)) = (pilot.rays > 0, pilot.seconds_a_ray, pilot.seconds_a_light_path) {
        warnings.extend(slow(ray + effort.light_paths * path, pilot.is_least, effort));
    }
    Ok(Foretold { warnings, lit_pixel: pilot.lit_pixel })
}

/// A radius of photons that is far below a pixel, so that hardly any lies within it, or as large as the scene.
fn odd_radius(scene: &Census<'_>) -> Result<Option<String>> {
    const SMALL: f64 = 0.1;
    let radius = scene.table::<LightTracingTable>()?.radius;
    if radius == 0.0 || !photon_evidence(scene).needed {
        return Ok(None);
    }
    let ([pixel, by_distance], around) = (pixel_width(scene)?, scene.table::<LightPathTable>()?.targets.scene);
    let width = pixel + by_distance * around.centre.length().max(around.radius);
    let advice = "0 lets it follow from the photons";
    Ok(if around.radius > 0.0 && radius < SMALL * width {
        Some(format!(
            "the photons' radius of {radius} is {:.1e} of a pixel's width in the middle of the scene: hardly any photon lies \
             within it, so what they bring will be missing, or show as specks; {advice}",
            radius / width
        ))
    } else if around.radius > 0.0 && radius > around.radius {
        Some(format!(
            "the photons' radius of {radius} is larger than the scene, whose radius is {:.3}: what they bring is spread over all \
             of it, and each sample asks every photon; {advice}",
            around.radius
        ))
    } else {
        None
    })
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
            None => "dimmer lights or fewer stops of exposure avoid it".into(),
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

// Pictures that will be black, or so dark that they look it, and why.

/// The fraction of pixels from which a picture is called black; one that shows a small light is not.
pub(super) const NEARLY_ALL: f64 = 0.995;
/// A picture whose brightest part is no brighter looks black on a screen: 5 of 255.
const LOOKS_BLACK: f64 = 1.6e-3;

/// The sentence about a picture that will be black or look it; none about any other, nor where test rays cannot tell.
///
/// `samples` is how many each pixel gets.
/// Errors: a light that is not accepted.
pub fn black(scene: &Census<'_>, pilot: &Pilot, samples: f64) -> Result<Option<String>> {
    let black = pilot.black as f64 / pilot.rays.max(1) as f64;
    if black < NEARLY_ALL || !pilot.is_everywhere() {
        return if pilot.is_everywhere() { too_dark(scene, pilot) } else { Ok(None) };
    }
    let (why, is_certain) = why_black(scene, pilot, samples)?;
    if is_certain || pilot.lit_fraction(samples) <= 1.0 - NEARLY_ALL {
        return Ok(Some(format!("the picture will probably be black: {why}")));
    }
    if pilot.black == pilot.rays {
        return Ok(Some(format!("none of {} test rays returned light that can be seen: {why}", pilot.rays)));
    }
    too_dark(scene, pilot)
}

/// The sentence about a picture that is not black, but too dark for a screen.
fn too_dark(scene: &Census<'_>, pilot: &Pilot) -> Result<Option<String>> {
    let how = looks_black(pilot.brightest(), exposure_of(scene)?.0);
    Ok(how.map(|how| format!("the picture will look black: {how}")))
}

/// By how much an exposure multiplies light; before the render it is not known of an automatic one, which leaves nothing
/// dark but what is black.
pub(super) fn exposure_factor(exposure: Exposure) -> f64 {
    const OF_THE_LEAST_F32: f64 = 149.0;
    libm::exp2(if exposure.automatic { OF_THE_LEAST_F32 } else { exposure.stops })
}

/// How dark a picture is whose brightest part has this radiance, and by what factor it is too dark; none where it can be
/// seen.
pub fn looks_black(brightest: f64, exposure: Exposure) -> Option<String> {
    let exposed = brightest * exposure_factor(exposure);
    (exposed > 0.0 && exposed <= LOOKS_BLACK).then(|| {
        let byte = (255.0 * srgb_from_linear(exposed)).round();
        let (factor, stops) = (two_digits(1.0 / exposed), libm::ceil(-libm::log2(exposed)));
        format!(
            "its brightest parts have a radiance of about {brightest:.1e}, {byte} of 255 in a PNG; lights {factor} times \
             as bright, or {stops} more stops of exposure, would bring them to white"
        )
    })
}

/// A number to two digits, written out.
fn two_digits(number: f64) -> String {
    if !number.is_finite() {
        return "any number of".into();
    }
    let rounded: f64 = format!("{number:.1e}").parse().unwrap_or(number);
    if rounded < 1e9 { format!("{rounded}") } else { format!("{rounded:.1e}") }
}

/// Why nearly all test rays are black, and whether that is so for any ray.
fn why_black(scene: &Census<'_>, pilot: &Pilot, samples: f64) -> Result<(String, bool)> {
    let does = integrator_of(scene).integrator.transport();
    let sky = sky_evidence(scene);
    let lights = point_evidence(scene).or(emissive_evidence(scene)).or(sky.clone());
    if pilot.hits_nothing() {
        let behind = if sky.needed { "the background is black there" } else { "there is no background with a colour" };
        return Ok((format!("none of {} rays hits a shape, and {behind}", pilot.rays), false));
    }
    if let Some(distance) = does.occlusion {
        let within = if distance.is_finite() { format!("within {distance} units, ") } else { String::new() };
        return Ok((format!("{within}something hides the sky from everything that the camera sees"), false));
    }
    if !lights.needed {
        return Ok(("there is no light, no surface that emits light, and no background with a colour".into(), true));
    }
    if !sky.needed && !shines(scene)? {
        return Ok((format!("all that could emit light is black ({})", lights.reason), true));
    }
    if does.max_depth == 1 {
        let why = format!(
            "at max_depth 1 a path has one segment, from a light to the camera, so that what emits nothing is black ({}); \
             max_depth 2 illuminates it",
            lights.reason
        );
        return Ok((why, false));
    }
    Ok((why_unlit(scene, pilot, (&does, samples))?, false))
}

/// Why surfaces that the camera sees return nothing of the light that there is.
fn why_unlit(scene: &Census<'_>, pilot: &Pilot, (does, samples): (&LightTransport, f64)) -> Result<String> {
    let (points, sky) = (point_evidence(scene), sky_evidence(scene));
    let areas = emissive_evidence(scene).or(environment_light_evidence(scene));
    let lights = points.clone().or(emissive_evidence(scene)).or(sky.clone());
    let specular = specular_evidence(scene);
    if pilot.specular_first == pilot.hits && specular.needed && !does.follows_paths {
        return Ok(format!("{} renders mirrors and glass black ({})", does.name, specular.reason));
    }
    if sky.needed && !points.needed && !emissive_evidence(scene).needed {
        return Ok(why_no_sky(pilot, does, &sky.reason));
    }
    let is_sampled = points.needed || does.samples_lights() && has_area_lights(scene)?;
    if !is_sampled && does.samples_diffuse {
        let (found, rays) = (pilot.rays - pilot.black, pilot.rays);
        let more = if samples < 2.0 { ", and more samples a pixel find more" } else { "" };
        // Light sampling helps where it is not used and there is something that it can sample.
        let helps = !does.samples_lights() && areas.needed;
        let advice = if helps { "; LightStrategy::Mis samples lights as well" } else { more };
        return Ok(format!("{found} of {rays} rays find a light at random ({}){advice}", lights.reason));
    }
    if !is_sampled && does.lights.is_none() {
        return Ok(format!(
            "no light here is sampled with shadow rays, and the others illuminate nothing ({})",
            lights.reason
        ));
    }
    if is_sampled && pilot.to_lights == 0 && pilot.specular_first < pilot.hits && !sky.needed {
        return Ok(format!(
            "what the camera sees is black, or faces away from every light, or is not in any light's beam ({})",
            lights.reason
        ));
    }
    let blocked: usize = pilot.blocked.values().sum();
    if pilot.to_lights > 0 && blocked == pilot.to_lights {
        let max = pilot.blocked.iter().max_by_key(|(_, count)| **count);
        let name = max.map_or_else(String::new, |(&shape, _)| shape_name(scene, shape as usize));
        return Ok(format!("all {blocked} shadow rays are blocked, most of them by the {name}"));
    }
    Ok(format!(
        "so little light arrives, or so little of it is reflected ({}), that nearly all of it is too dark to be seen",
        lights.reason
    ))
}

/// Why a background or an environment, which are the only light, illuminate nothing that the camera sees.
fn why_no_sky(pilot: &Pilot, does: &LightTransport, sky: &str) -> String {
    if !does.samples_diffuse && pilot.beyond == 0 {
        return format!("with {} the background illuminates nothing ({sky}); with Integrator::Path it does", does.name);
    }
    if pilot.beyond == 0 {
        return format!("what the camera sees reflects no light, and there is none but the background's ({sky})");
    }
    if pilot.escaped == 0 {
        return format!(
            "there is no light but the background's ({sky}), and none of the {} rays that go on from what the camera sees \
             reaches it: shapes enclose it all around",
            pilot.beyond
        );
    }
    format!(
        "there is no light but the background's ({sky}); {} of the {} rays that go on from what the camera sees reach it, \
         and next to none of it is reflected to the camera",
        pilot.escaped, pilot.beyond
    )
}

/// Whether anything but the sky emits.
fn shines(scene: &Census<'_>) -> Result<bool> {
    let emits = emissive_evidence(scene).needed
        && scene.table::<EmissiveTable>()?.radiance.iter().any(|radiance| radiance.iter().any(|&part| part > 0.0));
    Ok(emits || delta_light_shines(scene)?)
}

/// Whether light sampling has a surface or an environment to sample.
fn has_area_lights(scene: &Census<'_>) -> Result<bool> {
    let of_shapes = area_light_evidence(scene).needed && {
        let lights = scene.table::<AreaLightTable>()?;
        !lights.emitter.is_empty() || !lights.mesh.is_empty()
    };
    Ok(of_shapes || environment_light_evidence(scene).needed)
}

// Light that no path of the camera's integrator carries, and what finds it.

/// From this fraction of camera rays that first hit a mirror or glass, it is said that what they show lacks light.
const MANY_SPECULAR: f64 = 0.1;

/// The paths of light that the integrator cannot sample in this scene at all.
///
/// Light tracing connects a light path to the camera by a straight line from a matte surface, so it finds nothing where
/// the camera sees that surface through glass or in a mirror.
pub fn missing_paths(scene: &Census<'_>, pilot: &Pilot) -> Vec<String> {
    let (points, bends) = (point_evidence(scene), specular_evidence(scene));
    if !(points.needed && bends.needed && followed_evidence(scene).needed) {
        return Vec::new();
    }
    let distant = shadowed_distant_evidence(scene);
    let starts_outside = !distant.needed || distant_start_evidence(scene).needed;
    let started = shadowed_point_evidence(scene);
    let started = if distant.needed && starts_outside { started.or(distant.clone()) } else { started };
    let (is_traced, seen) = (traced_evidence(scene).needed, format!("{} of {}", pilot.specular_first, pilot.rays));
    let is_joined = joined_evidence(scene).needed;
    let through = "no line from a light path to the camera passes glass or a mirror";
    let area = "a small sphere or disk that emits, in place of the light, is found by paths there, too";
    // What is refused is not advised.
    let is_adaptive = adaptive_of(scene).is_ok_and(|own| own.is_some());
    let is_refused = is_adaptive || motion_evidence(scene).needed;
    let are_photons_refused = is_refused || medium_evidence(scene).needed || dispersion_evidence(scene).needed;
    let photons = if are_photons_refused { area } else { "PhotonMapping in its place finds it there, too" };
    let mut warnings = Vec::new();
    if started.needed && !is_traced {
        let missing = format!(
            "light that arrives through mirrors or glass ({}) from a light without an area ({}) is missing on matte \
             surfaces, since no sampled ray can hit a point",
            bends.reason, started.reason
        );
        let advice = if is_refused {
            area.into()
        } else if pilot.hits > 0 && pilot.specular_first == pilot.hits {
            format!(
                "here LightTracing does not find it, for the camera sees everything through glass or in mirrors; {photons}"
            )
        } else if pilot.specular_first as f64 >= MANY_SPECULAR * pilot.rays as f64 && pilot.rays > 0 {
            format!(
                "with LightTracing on the camera it is found from the light on what the camera sees directly, but \
                 {seen} test rays first hit a mirror or glass; {photons}"
            )
        } else {
            "with LightTracing on the camera it is found from the light".into()
        };
        warnings.push(format!("{missing}; {advice}"));
    }
    if started.needed && is_joined && pilot.specular_first as f64 >= MANY_SPECULAR * pilot.rays as f64 && pilot.rays > 0
    {
        warnings.push(format!(
            "light that arrives through mirrors or glass ({}) from a light without an area ({}) is still missing on what \
             the camera sees through glass or in a mirror, which {seen} test rays hit first: {through}; {photons}",
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

// Light and materials that the camera's integrator leaves out, and the integrator that includes them.

/// A sentence for each kind of light or material in the scene that its integrator does not render.
pub fn unseen(scene: &Census<'_>) -> Vec<String> {
    let (material, emitters) = (matte_evidence(scene), emissive_evidence(scene));
    let (specular, glossy) = (specular_evidence(scene), glossy_evidence(scene));
    let lit_by_area = emitters.needed && (material.needed || glossy.needed);
    let does = integrator_of(scene).integrator.transport();
    let (name, mut warnings) = (does.name, Vec::new());
    if does.occlusion.is_some() {
        let all = specular.or(glossy);
        if all.needed {
            warnings.push(format!(
                "{name} renders mirrors, glass and metal like all other surfaces ({}); Integrator::Path shows what they \
                 reflect",
                all.reason
            ));
        }
        return warnings;
    }
    if specular.needed && !does.follows_paths {
        warnings.push(format!(
            "{name} renders mirrors and glass black ({}); Integrator::Whitted traces reflection and refraction",
            specular.reason
        ));
    }
    let disperses = dispersion_evidence(scene);
    if disperses.needed && does.splits_at_glass {
        warnings.push(format!(
            "{name} shows glass that disperses light with its index at 587.56 nm ({}); Integrator::Path parts the colours",
            disperses.reason
        ));
    }
    if glossy.needed && does.follows_paths && !does.samples_glossy {
        warnings.push(format!(
            "{name} shows only lights without an area on glossy surfaces ({}); Integrator::Path shows the rest",
            glossy.reason
        ));
    }
    // Beside other lights, emitting surfaces that are visible at the first hit but do not illuminate are taken to be
    // intended.
    if lit_by_area && does.lights.is_none() && (does.follows_paths || !point_evidence(scene).needed) {
        warnings.push(format!(
            "with {name}, surfaces that emit light do not illuminate others ({}); with Integrator::Path they do",
            emitters.reason
        ));
    }
    let is_caustic = emitters.needed && material.needed && specular.needed;
    if is_caustic && does.lights.is_some() && !does.samples_diffuse {
        warnings.push(format!(
            "light that arrives through mirrors or glass ({}) from surfaces that emit it ({}) is missing on matte \
             surfaces, from which {name} does not trace further; Integrator::Path finds it",
            specular.reason, emitters.reason
        ));
    }
    warnings
}

/// How far an index of refraction may be from that of the dispersion beside it before this is said.
const ROUNDED: f64 = 1e-3;

/// A sentence for each glass whose index of refraction is written and not used, since a dispersion beside it gives another.
///
/// Errors: a glass or a dispersion that is not accepted.
pub fn unused_indices(scene: &Census<'_>) -> Result<Vec<String>> {
    let mut warnings = Vec::new();
    for &entity in scene.entities::<With<Dispersion>>().iter() {
        let (Some(own), Some(&dispersion)) = (interior_of(scene, entity)?, scene.get::<Dispersion>(entity)) else {
            continue;
        };
        let index = IndexCurve::of(dispersion).index(D_LINE);
        if own.ior != Glass::default().ior && (own.ior - index).abs() > ROUNDED {
            warnings.push(format!(
                "the glass {} has the ior {}, which is not used: its dispersion gives {index:.4} at 587.56 nm",
                called(scene, entity),
                own.ior
            ));
        }
    }
    Ok(warnings)
}

/// Warnings of glass that is thinner, or nearer to another surface, than single precision can keep apart.
pub fn unresolved_glass(scene: &Census<'_>) -> Result<Vec<String>> {
    if !contact_evidence(scene).needed {
        return Ok(Vec::new());
    }
    let warning = |([one, other], apart): ([usize; 2], f64)| {
        let [name, of] = [one, other].each(|shape| shape_name(scene, shape));
        if one == other {
            format!(
                "the {name} is {apart:.1e} thick, which single precision does not always keep apart at its distance from \
                 the camera: both of its sides reflect, but where it does not, nothing is absorbed between them, and on \
                 something opaque the {name} is not there"
            )
        } else {
            format!(
                "the {name} and the {of} are {apart:.1e} apart, which single precision does not always keep apart at their \
                 distance from the camera: where it does not, they are taken to touch"
            )
        }
    };
    Ok(unresolved(scene)?.into_iter().map(warning).collect())
}

/// Warnings of a camera or a light without an area that lies exactly on the surface of glass.
pub fn on_the_surface(scene: &Census<'_>) -> Result<Vec<String>> {
    let warning = |name: String| {
        format!(
            "the {name} lies exactly on the surface of glass: its rays start inside or outside, each on the side that it \
             leads to; move it a little to have all of them on one side"
        )
    };
    Ok(starts_on_glass(scene)?.into_iter().map(warning).collect())
}

// Shapes so small in the picture that its rays miss them.

/// So many shapes are looked at.
const MAX: usize = 10_000;
/// So many small shapes are named beside others that are not.
const FEW: usize = 3;

/// A sentence about shapes in front of the camera that are less than a pixel wide and that no test ray hit; triangles are
/// left out, since they are parts of a surface.
///
/// Errors: a shape or camera that is not accepted.
pub fn tiny_shapes(scene: &Census<'_>, pilot: &Pilot, shapes: &ShapeTable) -> Result<Option<String>> {
    let image = *scene.table::<ImageFrame>()?;
    let camera = camera_entity(scene)?;
    // Half of the image's height in scene units, at distance 1 and at any distance.
    let [growing, constant] = if scene.get::<PerspectiveCamera>(camera).is_some() {
        [scene.table::<PerspectiveProjection>()?.tan_half_vertical, 0.0]
    } else if scene.get::<OrthographicCamera>(camera).is_some() {
        [0.0, scene.table::<OrthographicWindow>()?.half_height]
    } else {
        return Ok(None);
    };
    let camera_from_world = scene.table::<CameraAxes>()?.world_from_camera.transpose();
    let width_in_pixels = |centre: DVec3, radius: f64| {
        let [x, y, z] = (camera_from_world * centre).to_array();
        let half_height = constant - growing * z;
        let is_inside = z < -radius && x.abs() <= half_height * image.aspect() && y.abs() <= half_height;
        is_inside.then_some(radius / half_height * f64::from(image.height))
    };
    let (mut tiny, mut others): (Vec<(usize, f64)>, usize) = (Vec::new(), pilot.shapes.len());
    for shape in (0..shapes.kind.len().min(MAX)).filter(|&shape| !pilot.shapes.contains(&(shape as u32))) {
        let Some(listed) = listed_kind(scene, shapes.kind[shape]).filter(|listed| !listed.is_part) else { continue };
        let around = (listed.bounding_sphere)(scene, shapes.row[shape] as usize)?;
        let width = around.and_then(|(centre, radius)| width_in_pixels(centre, radius));
        match width {
            Some(width) if width < 1.0 => tiny.push((shape, width)),
            Some(_) => others += 1,
            None => {}
        }
    }
    // Many beside others are meant: pearls, stars, sand.
    if tiny.len() > FEW && others > 0 {
        return Ok(None);
    }
    let Some(&(first, width)) = tiny.first() else { return Ok(None) };
    let name = shape_name(scene, first);
    Ok(Some(if tiny.len() == 1 {
        format!(
            "the {name} is {width:.2} pixels wide in the picture, where rays may miss it altogether: it is far away or small"
        )
    } else {
        format!(
            "{} are less than a pixel wide in the picture, where rays may miss them altogether; the first, the {name}, is \
             {width:.2} pixels wide",
            counted(tiny.len(), "shape")
        )
    }))
}
