//! What a camera is, and the list of cameras.

use crate::plan::Table;
use crate::scene::{Degrees, FovAxis, SceneError, number};
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

// ANCHOR: tan_half
/// tan(φ / 2) of a full angle φ, accurate to the last bits even near 180°: there it is the reciprocal of the tangent of
/// half the difference to 180°, which is subtracted exactly.
pub fn tan_half(angle: Degrees) -> f64 {
    if angle.0 > 90.0 {
        1.0 / libm::tan(Degrees(180.0 - angle.0).radians() / 2.0)
    } else {
        libm::tan(angle.radians() / 2.0)
    }
}
// ANCHOR_END: tan_half

// ANCHOR: half_extent
/// The extent of an image of this aspect ratio from its centre along `axis`, in half heights.
pub fn half_extent(axis: FovAxis, aspect: f64) -> f64 {
    match axis {
        FovAxis::Vertical => 1.0,
        FovAxis::Horizontal => aspect,
        FovAxis::Smaller => aspect.min(1.0),
        FovAxis::Larger => aspect.max(1.0),
        FovAxis::Diagonal => (1.0 + aspect * aspect).sqrt(),
    }
}

/// tan(fov / 2) for the vertical field of view, from an angle along `axis` of an image of this aspect ratio.
pub(super) fn tan_half_vertical(fov: Degrees, axis: FovAxis, aspect: f64) -> f64 {
    tan_half(fov) / half_extent(axis, aspect)
}
// ANCHOR_END: half_extent

/// The image's resolution and aspect ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageFrame {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
}

impl ImageFrame {
    /// Width and height in pixels.
    pub fn size(&self) -> DVec2 {
        DVec2::new(f64::from(self.width), f64::from(self.height))
    }

    /// Width over height.
    pub fn aspect(&self) -> f64 {
        f64::from(self.width) / f64::from(self.height)
    }
}

/// The narrowest pixel, in radians, for which a world ray in f32 is still accurate to 0.03 pixels.
pub const SMALLEST_PIXEL: f64 = 4e-6;

/// Checks that a field of view is wide enough for the image; `pixel` is the angle that a pixel subtends, in radians.
pub(super) fn wide_enough(who: &str, fov: Degrees, image: ImageFrame, pixel: f64) -> Result<(), SceneError> {
    if pixel >= SMALLEST_PIXEL {
        return Ok(());
    }
    let (width, height) = (image.width, image.height);
    let value = format!("{}° over {width} × {height} pixels, {pixel:.1e} rad a pixel", number(fov.0));
    let accepted = format!(
        "a pixel must be at least {SMALLEST_PIXEL:.0e} rad wide for world rays in f32: \
         widen the angle or take fewer pixels"
    );
    Err(SceneError::new(who, "fov", value, accepted))
}

/// A camera of the list.
pub trait Listed: Camera + Table {
    /// The names of what exists once for each camera.
    const NAMES: CameraNames;
}

macro_rules! registry {
    ($($component:ident($camera:ty) $noun:literal,)+) => {
        $(impl Listed for $camera {
            const NAMES: CameraNames = CameraNames {
                component: stringify!($component),
                noun: $noun,
                stage: concat!("Generate camera rays: ", $noun),
            };
        })+
    };
}
super::with_cameras!(registry);
