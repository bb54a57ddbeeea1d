use super::image_frame::ImageFrame;
use crate::scene::SceneError;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use std::fmt::Debug;

/// Screen points, x to the right and y upward, as slices of one length.
#[derive(Clone, Copy, Debug)]
pub struct ScreenSlices<'a> {
    /// From −aspect to aspect in the image.
    pub x: &'a [f64],
    /// From −1 to 1 in the image.
    pub y: &'a [f64],
}

/// Rays in camera space that a camera writes, all zero before and of the length of the screen points.
#[derive(Debug)]
pub struct CameraRaySlices<'a> {
    /// x, y and z of the origins, in scene units.
    pub origin: [&'a mut [f64]; 3],
    /// x, y and z of the directions, which are unit vectors.
    pub direction: [&'a mut [f64]; 3],
}

/// How a camera's rays change across the image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RaySpread {
    /// They start at the eye and pass through an image plane at distance 1, whose half height this is.
    Central(f64),
    /// They are parallel to the axis and start on a window in the plane of the eye, whose half height this is, in scene
    /// units.
    Parallel(f64),
    /// They have no image plane: the largest angle between the rays of neighbouring pixels, in radians.
    Angular(f64),
}

/// What bounds the image of a camera that does not fill all pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outline {
    /// Its noun in messages, such as `circle`.
    pub noun: &'static str,
    /// The stage that blackens what is outside.
    pub stage: &'static str,
}

/// The names of a registered camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CameraNames {
    /// Its component's type.
    pub component: &'static str,
    /// Its noun, such as `perspective`.
    pub noun: &'static str,
    /// The stage that generates its rays.
    pub stage: &'static str,
}

/// All that the renderer asks of a camera; everything else is generic over it.
///
/// A value is the camera's projection as the kernels read it: its table; the default stands for a camera of another kind.
/// The types that implement it are listed at the head of this folder.
pub trait Camera: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// The component of the scene that it is made from.
    type Component: Component + Copy + Debug + Default;

    /// The name that the plan uses for its table.
    const TABLE: &'static str;
    /// Components near the limits of what is accepted for an image of 64 × 64 pixels; tests of every camera take them.
    const EXTREMES: &'static [Self::Component];
    /// Whether its rays pass through a plane or a window; only then can light paths be connected to it.
    const HAS_IMAGE_PLANE: bool = true;
    /// Whether its rays start at more than one point.
    const HAS_MANY_ORIGINS: bool = false;
    /// The outline of its image, if that does not fill all pixels.
    const OUTLINE: Option<Outline> = None;

    /// The projection of a component, for an image of this resolution; `who` is the entity in messages.
    ///
    /// Errors: a number that is not accepted.
    fn project(component: &Self::Component, image: ImageFrame, who: &str) -> Result<Self, SceneError>;

    /// Generates the rays through screen points; a component that it does not write is 0.
    fn generate(&self, screen: ScreenSlices<'_>, rays: CameraRaySlices<'_>);

    /// How its rays change across an image of this resolution.
    fn spread(&self, image: ImageFrame) -> RaySpread;

    /// The screen point whose ray passes through a point in camera space, which is the inverse of [`Self::generate`];
    /// none if no ray does.
    fn screen_from_camera(&self, point: DVec3) -> Option<DVec2>;

    /// Whether a screen point is inside its outline, edge included.
    #[inline(always)]
    fn is_in_image(&self, _screen: DVec2) -> bool {
        true
    }
}
