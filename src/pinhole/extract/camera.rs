use super::camera_entity::named_camera;
use super::check::{number, positive_length, triple};
use super::pose::world_from_entity;
use crate::plan::{Census, Table};
use crate::scene::{
    ChildOf, Degrees, FovAxis, OrthographicCamera, PerspectiveCamera, Placement, Resolution, SceneError, called,
};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec2, DVec3};

/// The narrowest pixel, in radians, for which a world ray in f32 is still accurate to 0.03 pixels.
pub const SMALLEST_PIXEL: f64 = 4e-6;
/// How far a camera's axes may be from orthonormal before it is considered scaled.
const ROTATION_TOLERANCE: f64 = 1e-9;
/// The greatest number of pixels along one side.
const LONGEST_SIDE: u32 = 65_536;
/// The greatest number of pixels of a film, whose sums take 28 bytes each.
const MOST_PIXELS: u64 = 1 << 30;

/// The camera's position in world space: the origin of render space.
pub fn eye(scene: &Census<'_>) -> Result<DVec3, SceneError> {
    scene.once(|scene| {
        let (who, camera) = named_camera(scene)?;
        Ok(world_from_entity(scene, &who, camera)?.translation)
    })
}

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

impl Table for ImageFrame {
    const NAME: &'static str = "image shape";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (who, camera) = named_camera(scene)?;
        let Resolution { width, height } = scene.get::<Resolution>(camera).copied().unwrap_or_default();
        let sides = 1..=LONGEST_SIDE;
        let pixels = u64::from(width) * u64::from(height);
        if !sides.contains(&width) || !sides.contains(&height) || pixels > MOST_PIXELS {
            let accepted = format!(
                "each side must have 1 to {LONGEST_SIDE} pixels, and the image at most {MOST_PIXELS} altogether"
            );
            return Err(SceneError::new(who, "resolution", format!("{width} × {height}"), accepted));
        }
        Ok(Self { width, height })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The perspective projection of screen points to the image plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerspectiveProjection {
    /// Half the image plane's height at distance 1: tan(fov / 2) for the vertical field of view.
    pub tan_half_vertical: f64,
}

impl PerspectiveProjection {
    /// The angle, in radians, subtended by the narrowest pixel of an image of this resolution: the one in a corner.
    pub fn narrowest_pixel(&self, image: ImageFrame) -> f64 {
        let corner = DVec2::new(image.aspect(), 1.0) * self.tan_half_vertical;
        2.0 * self.tan_half_vertical / f64::from(image.height) / (1.0 + corner.length_squared())
    }
}

impl Table for PerspectiveProjection {
    const NAME: &'static str = "pinhole";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (who, camera) = named_camera(scene)?;
        let image = scene.table::<ImageFrame>()?;
        let PerspectiveCamera { fov, axis } = scene.get::<PerspectiveCamera>(camera).copied().unwrap_or_default();
        if !(fov.0 > 0.0 && fov.0 < 180.0) {
            return Err(SceneError::new(
                who,
                "fov",
                format!("{}°", number(fov.0)),
                "it must lie strictly between 0° and 180°",
            ));
        }
        let tan_half_vertical = tan_half_vertical(fov, axis, image.aspect());
        let pixel = 2.0 * tan_half_vertical / f64::from(image.height);
        if pixel < SMALLEST_PIXEL {
            let (width, height) = (image.width, image.height);
            let value = format!("{}° over {width} × {height} pixels, {pixel:.1e} rad a pixel", number(fov.0));
            let accepted = format!(
                "a pixel must be at least {SMALLEST_PIXEL:.0e} rad wide for world rays in f32: \
                 widen the angle or take fewer pixels"
            );
            return Err(SceneError::new(who, "fov", value, accepted));
        }
        Ok(Self { tan_half_vertical })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
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
fn tan_half_vertical(fov: Degrees, axis: FovAxis, aspect: f64) -> f64 {
    tan_half(fov) / half_extent(axis, aspect)
}
// ANCHOR_END: half_extent

// ANCHOR: angle_across
/// The full angle whose half has this tangent; the inverse of [`tan_half`].
///
/// Beyond 90° it is computed from the difference to 180°, as in [`tan_half`].
pub fn angle_of_tan_half(tangent: f64) -> Degrees {
    let degrees = |radians: f64| radians * (180.0 / std::f64::consts::PI);
    Degrees(if tangent > 1.0 {
        180.0 - degrees(2.0 * libm::atan(1.0 / tangent))
    } else {
        degrees(2.0 * libm::atan(tangent))
    })
}

/// The full field of view along `axis` of this projection in an image of this aspect ratio.
pub fn angle_across(lens: &PerspectiveProjection, axis: FovAxis, aspect: f64) -> Degrees {
    angle_of_tan_half(lens.tan_half_vertical * half_extent(axis, aspect))
}
// ANCHOR_END: angle_across

/// The orthographic window: its extent on the view plane, for screen points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrthographicWindow {
    /// Half the window's height, in scene units.
    pub half_height: f64,
}

impl Table for OrthographicWindow {
    const NAME: &'static str = "view rectangle";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (who, camera) = named_camera(scene)?;
        let view = scene.get::<OrthographicCamera>(camera).copied().unwrap_or_default();
        Ok(Self { half_height: positive_length(&who, "view_height", view.view_height)? / 2.0 })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The camera's axes in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraAxes {
    /// Columns: the camera's x (right), y (up) and z (back) axes as unit vectors in world space.
    pub world_from_camera: DMat3,
}

impl Table for CameraAxes {
    const NAME: &'static str = "camera axes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (who, camera) = named_camera(scene)?;
        let world_from_camera = world_from_entity(scene, &who, camera)?.matrix3;
        let off = world_from_camera.transpose() * world_from_camera - DMat3::IDENTITY;
        let worst = off.to_cols_array().iter().fold(0.0_f64, |worst, part| worst.max(part.abs()));
        let rotation = worst <= ROTATION_TOLERANCE && world_from_camera.determinant() > 0.0;
        if !rotation {
            return Err(scaled(scene, who, camera));
        }
        Ok(Self { world_from_camera })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The error about the first entity from a camera up to its root that scales or mirrors it.
fn scaled(scene: &Census<'_>, who: String, camera: Entity) -> SceneError {
    let accepted = "a camera may only be rotated and moved, and no parent may scale or mirror it";
    let mut chain: Vec<(String, Entity)> = vec![(who.clone(), camera)];
    while let Some(parent) = scene.get::<ChildOf>(chain[chain.len() - 1].1).map(ChildOf::parent) {
        chain.push((format!("{who}'s parent {}", called(scene, parent)), parent));
    }
    let scale = |entity: Entity| scene.get::<Placement>(entity).map_or(DVec3::ONE, |placement| placement.scale);
    let scales =
        |(_, entity): &&(String, Entity)| (scale(*entity) - DVec3::ONE).abs().max_element() > ROTATION_TOLERANCE;
    let (who, entity) = chain.iter().find(scales).unwrap_or(&chain[0]);
    let scale = scale(*entity);
    let mirrors = if scale.x * scale.y * scale.z < 0.0 { ", which mirrors" } else { "" };
    SceneError::new(who.as_str(), "scale", format!("{}{mirrors}", triple(scale)), accepted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_of_view_along_an_axis_is_the_angle_along_that_axis() {
        let axes = [FovAxis::Vertical, FovAxis::Horizontal, FovAxis::Smaller, FovAxis::Larger, FovAxis::Diagonal];
        let (mut worst, mut tried) = (0.0_f64, 0);
        for axis in axes {
            for aspect in [1e-4, 0.5, 1.0, 16.0 / 9.0, 1e4] {
                for fov in [1e-4, 0.01, 1.0, 40.0, 60.0, 90.0, 120.0, 179.0, 179.99] {
                    let lens =
                        PerspectiveProjection { tan_half_vertical: tan_half_vertical(Degrees(fov), axis, aspect) };
                    let missing = |angle: f64| angle.min(180.0 - angle);
                    let back = angle_across(&lens, axis, aspect).0;
                    worst = worst.max((missing(back) - missing(fov)).abs() / missing(fov));
                    tried += 1;
                }
            }
        }
        eprintln!("{tried} projections: the angle is recovered within {worst:.1e} of itself");
        assert!(worst < 4.0 * f64::EPSILON);
    }
}
