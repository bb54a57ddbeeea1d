//! Pictures that will be black, or so dark that they look it, and why.

use super::pilot::Pilot;
use crate::Result;
use crate::extract::{
    AreaLightTable, EmissiveTable, area_light_evidence, delta_light_shines, emissive_evidence,
    environment_light_evidence, integrator_of, point_evidence, shape_name, sky_evidence, specular_evidence,
};
use crate::film::srgb_from_linear;
use crate::plan::Census;
use crate::scene::LightTransport;

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
        return Ok(if pilot.is_everywhere() { too_dark(pilot) } else { None });
    }
    let (why, is_certain) = why_black(scene, pilot, samples)?;
    if is_certain || pilot.lit_fraction(samples) <= 1.0 - NEARLY_ALL {
        return Ok(Some(format!("the picture will probably be black: {why}")));
    }
    if pilot.black == pilot.rays {
        return Ok(Some(format!("none of {} test rays returned light that can be seen: {why}", pilot.rays)));
    }
    Ok(too_dark(pilot))
}

/// The sentence about a picture that is not black, but too dark for a screen.
fn too_dark(pilot: &Pilot) -> Option<String> {
    looks_black(pilot.brightest()).map(|how| format!("the picture will look black: {how}"))
}

/// How dark a picture is whose brightest part has this radiance, and by what factor it is too dark; none where it can be
/// seen.
pub fn looks_black(brightest: f64) -> Option<String> {
    (brightest <= LOOKS_BLACK).then(|| {
        let byte = (255.0 * srgb_from_linear(brightest)).round();
        let factor = two_digits(1.0 / brightest);
        format!(
            "its brightest parts have a radiance of about {brightest:.1e}, {byte} of 255 in a PNG; lights {factor} times \
             as bright would bring them to white"
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
