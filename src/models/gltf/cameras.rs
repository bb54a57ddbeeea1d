//! Cameras and lights, as their nodes place them.

use super::document::{Document, LIGHTS, Table};
use super::object::Object;
use crate::model::{LightKind, ModelCamera, ModelLight, Projection};
use crate::model_error::ModelError;
use crate::model_error::shown;
use crate::remarks::Remarks;
use glam::DAffine3;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// The camera of a node, if it has one.
///
/// Errors: a field of another kind or out of its range.
pub fn camera(
    document: &Document<'_>,
    node: &Object<'_>,
    world_from_camera: DAffine3,
) -> Result<Option<ModelCamera>, ModelError> {
    let index = node.index("camera", document.rows(Table::Cameras))?;
    let Some(camera) = index.map(|index| document.row(Table::Cameras, index)).transpose()? else { return Ok(None) };
    let positive = |holder: &Object<'_>, field: &str, max: f64| {
        let number = holder.number(field)?;
        match number.filter(|number| !(*number > 0.0 && *number < max)) {
            None => Ok(number),
            Some(number) if max < f64::INFINITY => {
                Err(holder.refused(field, number, format_args!("it must be above 0 and less than {max}")))
            }
            Some(number) => Err(holder.refused(field, number, "it must be above 0")),
        }
    };
    let kind = camera.needed("type", camera.text("type")?)?;
    let projection = match kind {
        "perspective" => {
            let own = camera.needed(kind, camera.object(kind)?)?;
            let yfov = own.needed("yfov", positive(&own, "yfov", PI)?)?;
            Projection::Perspective { yfov, aspect: positive(&own, "aspectRatio", f64::INFINITY)? }
        }
        "orthographic" => {
            let own = camera.needed(kind, camera.object(kind)?)?;
            let magnitude = |field| own.needed(field, positive(&own, field, f64::INFINITY)?);
            Projection::Orthographic { xmag: magnitude("xmag")?, ymag: magnitude("ymag")? }
        }
        other => {
            let accepted = "it must be \"perspective\" or \"orthographic\"";
            return Err(camera.refused("type", shown(other), accepted));
        }
    };
    let own = camera.needed(kind, camera.object(kind)?)?;
    let clip = [own.number("znear")?.unwrap_or(0.0), own.number("zfar")?.unwrap_or(f64::INFINITY)];
    Ok(Some(ModelCamera { name: name_of(node, &camera)?.into(), projection, clip, world_from_camera }))
}

/// The light of a node, if it has one.
///
/// Errors: a field of another kind, or an unknown type.
pub fn light(
    document: &Document<'_>,
    node: &Object<'_>,
    world_from_light: DAffine3,
    remarks: &mut Remarks,
) -> Result<Option<ModelLight>, ModelError> {
    let Some(reference) = node.extension(LIGHTS)? else { return Ok(None) };
    let index = reference.needed("light", reference.index("light", document.rows(Table::Lights))?)?;
    let light = document.row(Table::Lights, index)?;
    let kind = match light.needed("type", light.text("type")?)? {
        "directional" => LightKind::Directional,
        "point" => LightKind::Point,
        "spot" => {
            let spot = light.object("spot")?;
            let angle = |field: &str| spot.as_ref().map_or(Ok(None), |spot| spot.number(field));
            let outer = remarks.clamp(angle("outerConeAngle")?.unwrap_or(FRAC_PI_4), f64::MIN_POSITIVE, FRAC_PI_2);
            // The inner cone must be the narrower one.
            let inner = remarks.clamp(angle("innerConeAngle")?.unwrap_or(0.0), 0.0, outer.next_down());
            LightKind::Spot { inner, outer }
        }
        other => {
            let accepted = "it must be \"directional\", \"point\" or \"spot\"";
            return Err(light.refused("type", shown(other), accepted));
        }
    };
    let range = light.number("range")?.filter(|range| *range > 0.0);
    remarks.add_unread("the range of lights", u64::from(range.is_some()));
    Ok(Some(ModelLight {
        name: name_of(node, &light)?.into(),
        kind,
        colour: remarks.clamp_colour(light.numbers("color")?.unwrap_or([1.0; 3]), 1.0),
        intensity: remarks.clamp(light.number("intensity")?.unwrap_or(1.0), 0.0, f64::MAX),
        range,
        world_from_light,
    }))
}

/// The name of a node, or else of what it places.
fn name_of<'a>(node: &Object<'a>, own: &Object<'a>) -> Result<&'a str, ModelError> {
    Ok(match node.text("name")? {
        None | Some("") => own.text("name")?.unwrap_or_default(),
        Some(name) => name,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::written::{read, refused};
    use glam::DVec3;

    #[test]
    fn cameras_are_placed_by_their_nodes() {
        let model = read(
            "'cameras':[{'name':'wide','type':'perspective','perspective':{'yfov':1,'aspectRatio':2,'znear':0.1}},\
             {'type':'orthographic','orthographic':{'xmag':3,'ymag':4,'znear':0,'zfar':1}}],\
             'nodes':[{'camera':0,'translation':[1,2,3]},{'name':'side','camera':1}]",
        );
        let cameras = model.expect("read").cameras;
        assert_eq!(cameras[0].projection, Projection::Perspective { yfov: 1.0, aspect: Some(2.0) });
        assert_eq!(cameras[0].world_from_camera.translation, DVec3::new(1.0, 2.0, 3.0));
        assert_eq!(cameras[1].projection, Projection::Orthographic { xmag: 3.0, ymag: 4.0 });
        assert_eq!((&*cameras[0].name, &*cameras[1].name), ("wide", "side"));
        assert_eq!([cameras[0].clip, cameras[1].clip], [[0.1, f64::INFINITY], [0.0, 1.0]]);
    }

    #[test]
    fn broken_cameras_are_refused() {
        let with = |camera: &str| refused(&format!("'cameras':[{{{camera}}}],'nodes':[{{'camera':0}}]"));
        let kind = "cameras[0].type is \"fisheye\", but it must be \"perspective\" or \"orthographic\"";
        assert_eq!(with("'type':'fisheye'"), kind);
        assert_eq!(with("'type':'perspective'"), "cameras[0].perspective is missing, but it is needed");
        let yfov = "cameras[0].perspective.yfov is 4, but it must be above 0 and less than 3.141592653589793";
        assert_eq!(with("'type':'perspective','perspective':{'yfov':4}"), yfov);
        let xmag = "cameras[0].orthographic.xmag is -1, but it must be above 0";
        assert_eq!(with("'type':'orthographic','orthographic':{'xmag':-1,'ymag':1}"), xmag);
        let ymag = "cameras[0].orthographic.ymag is missing, but it is needed";
        assert_eq!(with("'type':'orthographic','orthographic':{'xmag':1}"), ymag);
    }

    fn with_light(light: &str) -> String {
        format!(
            "'extensions':{{'KHR_lights_punctual':{{'lights':[{{{light}}}]}}}},\
             'nodes':[{{'translation':[0,5,0],'extensions':{{'KHR_lights_punctual':{{'light':0}}}}}}]"
        )
    }

    #[test]
    fn lights_are_placed_by_their_nodes() {
        let light = |fields: &str| read(&with_light(fields)).expect("read").lights.remove(0);
        let sun = light("'type':'directional'");
        assert_eq!((sun.kind, sun.colour, sun.intensity, sun.range), (LightKind::Directional, [1.0; 3], 1.0, None));
        assert_eq!(sun.world_from_light.translation, DVec3::new(0.0, 5.0, 0.0));
        let lamp = light("'type':'point','name':'lamp','color':[1,0.5,0],'intensity':30,'range':7");
        assert_eq!((&*lamp.name, lamp.kind, lamp.colour), ("lamp", LightKind::Point, [1.0, 0.5, 0.0]));
        assert_eq!((lamp.intensity, lamp.range), (30.0, Some(7.0)));
        assert_eq!(light("'type':'spot'").kind, LightKind::Spot { inner: 0.0, outer: FRAC_PI_4 });
        let spot = light("'type':'spot','spot':{'innerConeAngle':0.1,'outerConeAngle':0.2}");
        assert_eq!(spot.kind, LightKind::Spot { inner: 0.1, outer: 0.2 });
        let wide = read(&with_light("'type':'spot','spot':{'innerConeAngle':2,'outerConeAngle':2},'intensity':-1"));
        let wide = wide.expect("read");
        let kind = LightKind::Spot { inner: FRAC_PI_2.next_down(), outer: FRAC_PI_2 };
        assert_eq!((wide.lights[0].kind, wide.lights[0].intensity, wide.remarks.clamped), (kind, 0.0, 3));
    }

    #[test]
    fn broken_lights_are_refused() {
        let place = "extensions.KHR_lights_punctual.lights[0]";
        let kind = format!("{place}.type is \"area\", but it must be \"directional\", \"point\" or \"spot\"");
        assert_eq!(refused(&with_light("'type':'area'")), kind);
        assert_eq!(refused(&with_light("")), format!("{place}.type is missing, but it is needed"));
        let beyond = with_light("'type':'point'").replace("'light':0", "'light':1");
        let expected = "nodes[0].extensions.KHR_lights_punctual.light is 1, but it must be a whole number from 0 to \
                        0, for \
                        there are 1";
        assert_eq!(refused(&beyond), expected);
    }
}
