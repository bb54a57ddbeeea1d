use super::PlacedCamera;
use crate::Result;
use crate::extract::{angle_of_tan_half, camera_entity};
use crate::scene::{ChildOf, Degrees, FovAxis, LookAt, PerspectiveCamera, Placement};
use bevy_ecs::prelude::*;
use glam::{DMat3, DQuat, DVec3};
use std::fmt;
use std::str::FromStr;

/// A mistake made with a convention of another program: it is read as if it were pinhole's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// Left and right are exchanged.
    Mirrored,
    /// Top and bottom are exchanged.
    UpsideDown,
    /// The camera looks along its +z axis.
    Backwards,
    /// The vertical field of view is applied to the width.
    TooNarrow,
    /// The horizontal field of view is applied to the height.
    TooWide,
    /// The world's z axis is taken for up.
    Rolled,
}

impl Mistake {
    /// All of the mistakes.
    pub const ALL: [Self; 6] =
        [Self::Mirrored, Self::UpsideDown, Self::Backwards, Self::TooNarrow, Self::TooWide, Self::Rolled];

    /// How the picture of the mistake is made in pinhole.
    pub fn made_by(self) -> &'static str {
        match self {
            Self::Mirrored => {
                "the shapes and lights get a parent that mirrors them left to right in front of the camera"
            }
            Self::UpsideDown => {
                "the shapes and lights get a parent that mirrors them top to bottom in front of the camera"
            }
            Self::Backwards => "the camera is turned by 180° about its own y axis",
            Self::TooNarrow => "the vertical angle is kept as a number, with FovAxis::Horizontal",
            Self::TooWide => "the horizontal angle is kept as a number, with FovAxis::Vertical",
            Self::Rolled => "the camera's up is (0, 0, 1)",
        }
    }

    /// Changes a scene to what this mistake makes of it.
    ///
    /// Errors: a scene that would not render, and an orthographic camera.
    pub fn commit(self, scene: &mut World) -> Result {
        let placed = PlacedCamera::of(scene)?;
        let camera = camera_entity(scene)?;
        let axes = placed.world_from_camera;
        let (fov, axis) = match self {
            Self::TooNarrow => (angle_of_tan_half(placed.tan_half_vertical), FovAxis::Horizontal),
            Self::TooWide => (angle_of_tan_half(placed.tan_half_vertical * placed.image.aspect()), FovAxis::Vertical),
            _ => (angle_of_tan_half(placed.tan_half_vertical), FovAxis::Vertical),
        };
        let look = match self {
            Self::Backwards => LookAt { eye: placed.look.eye, target: placed.look.eye + axes.z_axis, up: axes.y_axis },
            Self::Rolled => LookAt { up: DVec3::Z, ..placed.look },
            _ => placed.look,
        };
        if matches!(self, Self::TooNarrow | Self::TooWide) {
            scene.entity_mut(camera).insert(PerspectiveCamera { fov: Degrees(fov.0), axis });
        }
        scene.entity_mut(camera).remove::<ChildOf>().insert((look, Placement::default()));
        match self {
            Self::Mirrored => mirror(scene, camera, placed.look.eye, axes, DVec3::new(-1.0, 1.0, 1.0)),
            Self::UpsideDown => mirror(scene, camera, placed.look.eye, axes, DVec3::new(1.0, -1.0, 1.0)),
            _ => {}
        }
        Ok(())
    }
}

/// Puts everything but the camera under two parents that together mirror along the camera's axes: a scaling in those
/// axes, and a rotation back.
fn mirror(scene: &mut World, camera: Entity, eye: DVec3, axes: DMat3, scale: DVec3) {
    let mut roots = scene.query_filtered::<Entity, (With<Placement>, Without<ChildOf>)>();
    let roots: Vec<Entity> = roots.iter(scene).filter(|&root| root != camera).collect();
    let turn = DQuat::from_mat3(&axes).normalize();
    let mirror = scene.spawn(Placement { position: eye, orientation: turn, scale }).id();
    let back = turn.conjugate();
    let unturned = Placement { position: back * -eye, orientation: back, scale: DVec3::ONE };
    let unturned = scene.spawn((unturned, ChildOf(mirror))).id();
    for root in roots {
        scene.entity_mut(root).insert(ChildOf(unturned));
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Mirrored => "mirrored",
            Self::UpsideDown => "upside-down",
            Self::Backwards => "backwards",
            Self::TooNarrow => "too-narrow",
            Self::TooWide => "too-wide",
            Self::Rolled => "rolled",
        })
    }
}

impl FromStr for Mistake {
    type Err = String;
    fn from_str(word: &str) -> std::result::Result<Self, String> {
        let known = Self::ALL.into_iter().find(|mistake| mistake.to_string() == word);
        known.ok_or_else(|| "it must be mirrored, upside-down, backwards, too-narrow, too-wide or rolled".into())
    }
}
