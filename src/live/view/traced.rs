//! The pixel under the pointer, through all spaces.

use super::reading::Reading;
use bevy_ecs::prelude::World;
use glam::DVec3;
use pinhole::film::PixelErrors;
use pinhole::intersect::Surfaces;
use pinhole::look::{Recorded, Trace, ViewComponent};
use pinhole::plan::{ComponentNumber, Stage};
use pinhole::scene::{Integrator, TracePixel, View};
use pinhole::{extract, look, plan};
use serde::Serialize;
use std::collections::HashMap;

/// The last bounce that is shown; later ones are more of the same.
const LAST_BOUNCE: u32 = 7;

/// What the stages wrote for one pixel.
#[derive(Serialize)]
pub struct Traced {
    pixel: [u32; 2],
    columns: Vec<Written>,
    /// What the film has of it.
    reading: Option<Reading>,
}

#[derive(Serialize)]
struct Written {
    bounce: u32,
    stage: &'static str,
    column: &'static str,
    space: &'static str,
    unit: &'static str,
    rows: Vec<Vec<(&'static str, String)>>,
}

/// Traces a pixel of the picture, whether or not a column is painted instead.
///
/// A path that never ends is traced as far as it is shown.
///
/// Errors: whatever a render would refuse.
pub fn trace(scene: &mut World, offer: &[Stage], [x, y]: [u32; 2]) -> pinhole::Result<Trace> {
    let camera = extract::camera_entity(scene)?;
    let view = scene.entity_mut(camera).take::<View>();
    let component = scene.entity_mut(camera).take::<ViewComponent>();
    let errors = scene.entity_mut(camera).take::<PixelErrors>();
    let integrator = scene.get::<Integrator>(camera).copied();
    if let Some(
        Integrator::Path { max_depth, .. } | Integrator::Whitted { max_depth } | Integrator::Distribution { max_depth },
    ) = scene.get_mut::<Integrator>(camera).as_deref_mut()
    {
        *max_depth = (*max_depth).min(LAST_BOUNCE + 2);
    }
    let trace = look::trace(&plan::Census::of(scene), offer, TracePixel { x, y });
    if let Some(integrator) = integrator {
        scene.entity_mut(camera).insert(integrator);
    }
    let mut camera = scene.entity_mut(camera);
    view.into_iter().for_each(|own| _ = camera.insert(own));
    component.into_iter().for_each(|own| _ = camera.insert(own));
    errors.into_iter().for_each(|own| _ = camera.insert(own));
    trace
}

/// The point of the first surface that a pixel's ray hits, relative to the eye.
pub fn surface(trace: &Trace) -> Option<DVec3> {
    let of_camera_ray = |recorded: &&Recorded| recorded.depth == 0 && recorded.column.is::<Surfaces>();
    let row = trace.stages.iter().rev().find(of_camera_ray)?.rows.first()?;
    let part = |name: &str| match row.iter().find(|(own, _)| *own == name)?.1 {
        ComponentNumber::F64(value) => Some(value),
        ComponentNumber::F32(value) => Some(f64::from(value)),
        ComponentNumber::U32(_) => None,
    };
    let point = DVec3::new(part("px")?, part("py")?, part("pz")?);
    point.is_finite().then_some(point)
}

/// The name of the first shape that a pixel's ray hits.
pub fn entity(trace: &Trace) -> Option<String> {
    let of_camera_ray = trace.stages.iter().rev().filter(|recorded| recorded.depth == 0);
    let mut shapes = of_camera_ray.flat_map(|recorded| &recorded.rows).flatten().filter(|(name, _)| *name == "shape");
    shapes.find_map(|&(_, number)| trace.shape_name(number).map(|name| name.trim_matches('"').to_owned()))
}

impl Traced {
    /// Of a column that several stages wrote at one bounce, the last is what light goes on with.
    pub fn of(trace: &Trace, reading: Option<Reading>) -> Self {
        let mut last = HashMap::new();
        for (at, recorded) in trace.stages.iter().enumerate() {
            last.insert((recorded.depth, recorded.column.id), at);
        }
        let shown = trace.stages.iter().enumerate().filter(|(at, recorded)| {
            let listing = recorded.column.unit == "rows";
            let is_last = last.get(&(recorded.depth, recorded.column.id)) == Some(at);
            is_last && !listing && recorded.depth <= LAST_BOUNCE
        });
        let columns = shown.map(|(_, recorded)| Written::of(trace, recorded)).collect();
        Self { pixel: [trace.pixel.x, trace.pixel.y], columns, reading }
    }
}

impl Written {
    fn of(trace: &Trace, recorded: &Recorded) -> Self {
        let word = |&(name, number): &(&'static str, ComponentNumber)| match name {
            "row" => None,
            "shape" => Some((name, trace.shape_name(number).unwrap_or("none").to_owned())),
            _ => Some((name, number.to_string())),
        };
        let rows = recorded.rows.iter().map(|row| row.iter().filter_map(word).collect()).collect();
        let column = &recorded.column;
        Self {
            bounce: recorded.depth,
            stage: recorded.stage,
            column: column.name,
            space: column.space,
            unit: column.unit,
            rows,
        }
    }
}
