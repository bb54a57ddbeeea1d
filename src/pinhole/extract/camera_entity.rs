use super::check::kind_and_name;
use crate::cameras::{CameraNames, ImageFrame, Listed, RaySpread, with_cameras};
use crate::plan::{Census, counted, declared, entities};
use crate::scene::{SceneError, called, some_of};
use bevy_ecs::prelude::*;

/// A registered camera without its type.
#[derive(Clone, Copy)]
pub struct CameraKind {
    /// Its names.
    pub names: CameraNames,
    /// Whether its rays pass through a plane or a window.
    pub has_image_plane: bool,
    /// Whether its rays start at more than one point.
    pub has_many_origins: bool,
    /// How its rays change across the image of a scene.
    pub(super) spread: fn(&Census<'_>) -> Result<RaySpread, SceneError>,
    carrying: fn(&World) -> Vec<Entity>,
    declared: fn(&World) -> Vec<Entity>,
}

impl CameraKind {
    const fn of<C: Listed>() -> Self {
        Self {
            names: C::NAMES,
            has_image_plane: C::HAS_IMAGE_PLANE,
            has_many_origins: C::HAS_MANY_ORIGINS,
            spread: |scene| Ok(scene.table::<C>()?.spread(*scene.table::<ImageFrame>()?)),
            carrying: entities::<With<C::Component>>,
            declared: declared::<With<C::Component>>,
        }
    }
}

macro_rules! kinds {
    ($($component:ident($camera:ty) $noun:literal,)+) => {
        /// The registered cameras.
        pub const CAMERA_KINDS: &[CameraKind] = &[$(CameraKind::of::<$camera>()),+];
    };
}
with_cameras!(kinds);

/// A noun with its article: `a fisheye`, `an orthographic`.
pub(super) fn with_article(noun: &str) -> String {
    let article = if noun.to_lowercase().starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {noun}")
}

/// The names of cameras, each with its article: `a fisheye or an orthographic`.
pub(super) fn any_of(names: impl Iterator<Item = &'static str>) -> String {
    let names: Vec<String> = names.map(with_article).collect();
    match &names[..] {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        _ => names.concat(),
    }
}

/// The one camera of the scene.
pub fn camera_entity(scene: &World) -> Result<Entity, SceneError> {
    find_camera(scene).map(|(camera, _)| camera)
}

fn find_camera(scene: &World) -> Result<(Entity, &'static CameraKind), SceneError> {
    let of_kind = |kind: &'static CameraKind| (kind.carrying)(scene).into_iter().map(move |camera| (camera, kind));
    let found: Vec<(Entity, &CameraKind)> = CAMERA_KINDS.iter().flat_map(of_kind).collect();
    let components = any_of(CAMERA_KINDS.iter().map(|kind| kind.names.component));
    let accepted = format!("exactly one entity must carry {components}");
    let value = match found[..] {
        [camera] => return Ok(camera),
        [] => {
            let disabled = CAMERA_KINDS.iter().flat_map(|kind| (kind.declared)(scene)).next();
            disabled.map_or("missing".into(), |own| format!("{}, which is disabled", called(scene, own)))
        }
        [(one, _), ..] if found.iter().all(|&(other, _)| other == one) => {
            let kinds: Vec<String> = found.iter().map(|(_, kind)| with_article(kind.names.component)).collect();
            format!("{} at once, on {}", kinds.join(" and "), called(scene, one))
        }
        _ => {
            let cameras: Vec<Entity> = found.iter().map(|&(camera, _)| camera).collect();
            format!("given {}: {}", counted(cameras.len(), "time"), some_of(scene, &cameras, ", "))
        }
    };
    Err(SceneError::new("the scene", "camera", value, accepted))
}

/// The camera of the scene and its kind, looked up once per census.
fn found_camera(scene: &Census<'_>) -> Result<(Entity, &'static CameraKind), SceneError> {
    scene.once(|scene| find_camera(scene))
}

/// The camera of the scene.
pub(super) fn camera_of(scene: &Census<'_>) -> Result<Entity, SceneError> {
    found_camera(scene).map(|(camera, _)| camera)
}

/// What kind of camera the scene has.
pub fn camera_kind(scene: &Census<'_>) -> Result<&'static CameraKind, SceneError> {
    found_camera(scene).map(|(_, kind)| kind)
}

/// The camera and its name in messages.
pub(super) fn named_camera(scene: &Census<'_>) -> Result<(String, Entity), SceneError> {
    let camera = camera_of(scene)?;
    Ok((kind_and_name(scene, "camera", camera), camera))
}
