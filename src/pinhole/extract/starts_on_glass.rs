//! Points that paths start from, the eye and lights without an area, on or close to the surface of glass.

use super::cameras::camera_entity;
use super::lights_of::light_kinds;
use super::{GlassBodyTable, eye, glass_evidence, joined_evidence};
use crate::each::Each;
use crate::plan::{Census, Evidence, Table};
use crate::scene::{SceneError, called};
use crate::shapes::Bounds;
use glam::DVec3;
use std::sync::Arc;

/// How far a ray's origin is moved off a surface that it is on, as a fraction of its distance from the eye: some steps of
/// f32.
const STEP: f64 = 1.0 / (1 << 22) as f64;
/// How close a point is to a surface that it is on, as a fraction of the scene's extent: more than f64 rounds by.
const ROUNDING: f64 = STEP * STEP;
/// How close to a surface a light is close, as a fraction of the scene's extent about the eye: beyond it, shadow rays are
/// certain to hit the surface between.
const CLOSE: f64 = 1.0 / 1024.0;

/// A point that paths start from, or end at, close to the surface of glass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlassStart {
    /// In render space, in the precision that rays start in.
    pub position: DVec3,
    /// Whether it is on the surface, as far as rounding tells.
    pub is_on: bool,
    /// How far along a ray from it the media around it are looked up; 0 where it is not on the surface.
    pub step: f64,
}

/// The points that paths start from close to the surface of glass.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GlassStartTable {
    /// The points: the eye first, if it is one of them.
    pub row: Vec<GlassStart>,
}

impl GlassBodyTable {
    /// Whether a surface of glass is within this distance of a point, as far as the corners, edges and faces of a cube
    /// around it tell.
    fn is_close(&self, point: DVec3, distance: f64) -> bool {
        let steps = [-1.0, 0.0, 1.0];
        let around = steps.each(|x| steps.each(|y| steps.each(|z| DVec3::new(x, y, z))));
        let around = around.as_flattened().as_flattened();
        let within = Bounds { min: point - distance, max: point + distance };
        self.row.iter().filter(|body| body.bounds.overlaps(&within)).any(|body| {
            let here = body.windings(point, 0.0);
            around.iter().any(|step| body.windings(point + distance * *step, 0.0) != here)
        })
    }
}

/// Each point that paths start from close to glass, with its name; found once for the plan and the table.
fn starts(scene: &Census<'_>) -> Result<Arc<[(String, GlassStart)]>, SceneError> {
    scene.once(|scene| find_starts(scene).map(Arc::from))
}

fn find_starts(scene: &Census<'_>) -> Result<Vec<(String, GlassStart)>, SceneError> {
    if !glass_evidence(scene).needed {
        return Ok(Vec::new());
    }
    let bodies = scene.table::<GlassBodyTable>()?;
    let extent = bodies.row.iter().flat_map(|body| [body.bounds.min, body.bounds.max]);
    let extent =
        extent.filter(|corner| corner.is_finite()).fold(0.0, |max: f64, corner| max.max(corner.abs().max_element()));
    let place = |name: String, position: DVec3, from_origin: f64| {
        let position = position.as_vec3().as_dvec3();
        let far = position.abs().max_element();
        let scale = from_origin.max(extent);
        let rounding = ROUNDING * if scale > 0.0 { scale } else { 1.0 };
        let is_on = bodies.is_close(position, rounding);
        let is_close = is_on || bodies.is_close(position, CLOSE * far.max(extent));
        let step = if is_on { rounding.max(STEP * far) } else { 0.0 };
        is_close.then_some((name, GlassStart { position, is_on, step }))
    };
    let from_origin = eye(scene)?.abs().max_element();
    let camera = camera_entity(scene).map_or("camera".into(), |camera| format!("camera {}", called(scene, camera)));
    let mut found: Vec<_> = place(camera, DVec3::ZERO, from_origin).into_iter().collect();
    for kind in light_kinds(scene).filter(|kind| !kind.is_distant) {
        // Those that cast shadows, as the sources.
        let entities = (kind.entities)(scene);
        let shadowed = entities.iter().filter(|light| (kind.casts_shadows)(scene.entity(**light)));
        for (light, &entity) in (kind.sources)(scene)?.iter().zip(shadowed) {
            let name = format!("{} {}", kind.word, called(scene, entity));
            found.extend(light.position().and_then(|at| place(name, at, from_origin)));
        }
    }
    Ok(found)
}

impl Table for GlassStartTable {
    const NAME: &'static str = "starts close to glass";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        Ok(Self { row: starts(scene)?.iter().map(|(_, start)| *start).collect() })
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.row[..])
    }
}

/// Evidence of such points, of those that pass a test.
fn evidence(scene: &Census<'_>, such: impl Fn(&GlassStart) -> bool, at: &str) -> Evidence {
    // What is wrong with the scene is said elsewhere.
    let found = starts(scene).unwrap_or_else(|_| Arc::new([]));
    let names: Vec<&str> = found.iter().filter(|(_, start)| such(start)).map(|(name, _)| &**name).collect();
    let reason = match &names[..] {
        [] => format!("0 cameras and lights without an area {at} of glass"),
        [one] => format!("1 start of paths {at} of glass: the {one}"),
        [one, ..] => format!("{} starts of paths {at} of glass: the {one}, …", names.len()),
    };
    Evidence { needed: !names.is_empty(), reason, count: names.len() }
}

/// The names of the camera and of the lights that are on the surface of glass.
pub fn starts_on_glass(scene: &Census<'_>) -> Result<Vec<String>, SceneError> {
    Ok(starts(scene)?.iter().filter(|(_, start)| start.is_on).map(|(name, _)| name.clone()).collect())
}

/// Evidence that the eye or a light is on the surface of glass.
pub fn start_on_glass_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| evidence(scene, |start| start.is_on, "on the surface"))
}

/// Evidence that a light, or the eye where light paths are connected to it, is close to the surface of glass.
pub fn end_close_to_glass_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let traced = joined_evidence(scene).needed;
        evidence(scene, |start| traced || start.position != DVec3::ZERO, "close to the surface")
    })
}
