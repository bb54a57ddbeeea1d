//! Light that no path of the camera's integrator carries, and what finds it.

use super::pilot::Pilot;
use crate::extract::{
    distant_start_evidence, followed_evidence, point_evidence, shadowed_distant_evidence, shadowed_point_evidence,
    specular_evidence, traced_evidence,
};
use crate::plan::Census;

/// From this fraction of camera rays that first hit a mirror or glass, it is said that what they show lacks light.
const MANY: f64 = 0.1;

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
    let through = "no line from a light path to the camera passes glass or a mirror";
    let area = "a small sphere or disk that emits, in place of the light, is found by paths there, too";
    let mut warnings = Vec::new();
    if started.needed && !is_traced {
        let missing = format!(
            "light that arrives through mirrors or glass ({}) from a light without an area ({}) is missing on matte \
             surfaces, since no sampled ray can hit a point",
            bends.reason, started.reason
        );
        let advice = if pilot.hits > 0 && pilot.specular_first == pilot.hits {
            format!(
                "here LightTracing does not find it, for the camera sees everything through glass or in mirrors; {area}"
            )
        } else if pilot.specular_first as f64 >= MANY * pilot.rays as f64 && pilot.rays > 0 {
            format!(
                "LightTracing on the camera, beside paths, finds it from the light on what the camera sees directly, but \
                 {seen} test rays first hit a mirror or glass; {area}"
            )
        } else {
            "LightTracing on the camera, beside paths, finds it from the light".into()
        };
        warnings.push(format!("{missing}; {advice}"));
    }
    if started.needed && is_traced && pilot.specular_first as f64 >= MANY * pilot.rays as f64 && pilot.rays > 0 {
        warnings.push(format!(
            "light that arrives through mirrors or glass ({}) from a light without an area ({}) is still missing on what \
             the camera sees through glass or in a mirror, which {seen} test rays hit first: {through}; {area}",
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
