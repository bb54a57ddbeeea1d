use super::check::kind_and_name;
use crate::plan::{Census, counted, entities};
use crate::scene::{
    EquirectangularCamera, FisheyeCamera, OrthographicCamera, PerspectiveCamera, SceneError, called, some_of,
};
use bevy_ecs::prelude::*;

/// The components that are cameras, each with its article and its entities; a new kind is added with a line.
const CAMERAS: [(&str, fn(&World) -> Vec<Entity>); 4] = [
    ("a PerspectiveCamera", entities::<With<PerspectiveCamera>>),
    ("an OrthographicCamera", entities::<With<OrthographicCamera>>),
    ("a FisheyeCamera", entities::<With<FisheyeCamera>>),
    ("an EquirectangularCamera", entities::<With<EquirectangularCamera>>),
];

/// The one camera of the scene.
pub fn camera_entity(scene: &World) -> Result<Entity, SceneError> {
    let kinds = CAMERAS.iter().flat_map(|&(kind, carrying)| carrying(scene).into_iter().map(move |own| (kind, own)));
    let kinds: Vec<(&str, Entity)> = kinds.collect();
    let cameras: Vec<Entity> = kinds.iter().map(|&(_, camera)| camera).collect();
    let accepted = "exactly one entity must carry a PerspectiveCamera, an OrthographicCamera, a FisheyeCamera or an \
                    EquirectangularCamera";
    match cameras[..] {
        [camera] => Ok(camera),
        [] => Err(SceneError::new("the scene", "camera", "missing", accepted)),
        [one, ..] if cameras.iter().all(|&other| other == one) => {
            let kinds: Vec<&str> = kinds.iter().map(|&(kind, _)| kind).collect();
            let value = format!("{} at once, on {}", kinds.join(" and "), called(scene, one));
            Err(SceneError::new("the scene", "camera", value, accepted))
        }
        _ => {
            let value = format!("given {}: {}", counted(cameras.len(), "time"), some_of(scene, &cameras, ", "));
            Err(SceneError::new("the scene", "camera", value, accepted))
        }
    }
}

/// The same, found once per census.
pub(super) fn camera_of(scene: &Census<'_>) -> Result<Entity, SceneError> {
    scene.once(|scene| camera_entity(scene))
}

/// The camera and its name in messages.
pub(super) fn named_camera(scene: &Census<'_>) -> Result<(String, Entity), SceneError> {
    let camera = camera_of(scene)?;
    Ok((kind_and_name(scene, "camera", camera), camera))
}
