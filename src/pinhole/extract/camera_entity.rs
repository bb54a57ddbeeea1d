use super::check::kind_and_name;
use crate::plan::{Census, counted, declared, entities};
use crate::scene::{
    EquirectangularCamera, FisheyeCamera, OrthographicCamera, PerspectiveCamera, SceneError, called, some_of,
};
use bevy_ecs::prelude::*;

/// The components that are cameras, each with its article; a new kind is added with a line.
const CAMERAS: [CameraKind; 4] = [
    CameraKind::of::<PerspectiveCamera>("a PerspectiveCamera"),
    CameraKind::of::<OrthographicCamera>("an OrthographicCamera"),
    CameraKind::of::<FisheyeCamera>("a FisheyeCamera"),
    CameraKind::of::<EquirectangularCamera>("an EquirectangularCamera"),
];

/// A kind of camera.
struct CameraKind {
    name: &'static str,
    enabled: fn(&World) -> Vec<Entity>,
    declared: fn(&World) -> Vec<Entity>,
}

impl CameraKind {
    const fn of<C: Component>(name: &'static str) -> Self {
        Self { name, enabled: entities::<With<C>>, declared: declared::<With<C>> }
    }
}

/// The one camera of the scene.
pub fn camera_entity(scene: &World) -> Result<Entity, SceneError> {
    let kinds = CAMERAS.iter().flat_map(|kind| (kind.enabled)(scene).into_iter().map(move |own| (kind.name, own)));
    let kinds: Vec<(&str, Entity)> = kinds.collect();
    let cameras: Vec<Entity> = kinds.iter().map(|&(_, camera)| camera).collect();
    let accepted = "exactly one entity must carry a PerspectiveCamera, an OrthographicCamera, a FisheyeCamera or an \
                    EquirectangularCamera";
    match cameras[..] {
        [camera] => Ok(camera),
        [] => {
            let disabled = CAMERAS.iter().flat_map(|kind| (kind.declared)(scene)).next();
            let value = disabled.map_or("missing".into(), |own| format!("{}, which is disabled", called(scene, own)));
            Err(SceneError::new("the scene", "camera", value, accepted))
        }
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

/// The camera of the scene, looked up once per census.
pub(super) fn camera_of(scene: &Census<'_>) -> Result<Entity, SceneError> {
    scene.once(|scene| camera_entity(scene))
}

/// The camera and its name in messages.
pub(super) fn named_camera(scene: &Census<'_>) -> Result<(String, Entity), SceneError> {
    let camera = camera_of(scene)?;
    Ok((kind_and_name(scene, "camera", camera), camera))
}
