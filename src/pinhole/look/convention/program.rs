use super::PlacedCamera;
use crate::extract::{ImageFrame, angle_of_tan_half, half_extent, tan_half};
use crate::scene::{Degrees, FovAxis, LookAt};
use glam::{DMat3, DVec3};
use std::fmt;

/// A program or a book with a camera convention of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Program {
    /// *Ray Tracing in One Weekend*, version 4.
    OneWeekend,
    /// *Ray Tracing from the Ground Up*.
    GroundUp,
    /// OpenGL with the calls of its utility library.
    OpenGl,
    /// glTF 2.0.
    Gltf,
    /// pbrt, version 4.
    Pbrt,
    /// Mitsuba 3.
    Mitsuba,
    /// OpenCV.
    OpenCv,
    /// Blender.
    Blender,
}

/// The form in which a program states a camera's field of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Opening {
    /// The full angle along this axis of the image, in degrees.
    Degrees(FovAxis),
    /// The full angle along this axis of the image, in radians.
    Radians(FovAxis),
    /// The distance of the image plane from the eye, in pixels.
    Pixels,
    /// The focal length, for a film of this size along the axis, both in millimetres.
    Millimetres(f64, FovAxis),
}

/// A camera in a program's own convention.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Described {
    /// The field of view, in the form and unit of the program's [`Opening`].
    pub opening: f64,
    /// Columns: the camera's x, y and z axes as unit vectors in the program's world space.
    pub axes: DMat3,
    /// The eye in the program's world space.
    pub eye: DVec3,
}

/// Camera axes x, y and z: right, up and back, as pinhole has them.
const RIGHT_UP_BACK: DMat3 = DMat3::IDENTITY;
const RIGHT_UP_AHEAD: DMat3 = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::NEG_Z);
const LEFT_UP_AHEAD: DMat3 = DMat3::from_cols(DVec3::NEG_X, DVec3::Y, DVec3::NEG_Z);
const RIGHT_DOWN_AHEAD: DMat3 = DMat3::from_cols(DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z);
/// pinhole's (x, y, z) is (x, −z, y) where z points up.
const Z_UP_FROM_PINHOLE: DMat3 = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y);

impl Program {
    /// All of them, those with pinhole's axes first.
    pub const ALL: [Self; 8] = [
        Self::OneWeekend,
        Self::GroundUp,
        Self::OpenGl,
        Self::Gltf,
        Self::Pbrt,
        Self::Mitsuba,
        Self::OpenCv,
        Self::Blender,
    ];

    // ANCHOR: opening
    /// The form in which it states a camera's field of view.
    pub fn opening(self) -> Opening {
        match self {
            Self::OneWeekend | Self::OpenGl => Opening::Degrees(FovAxis::Vertical),
            Self::Gltf => Opening::Radians(FovAxis::Vertical),
            Self::Pbrt => Opening::Degrees(FovAxis::Smaller),
            Self::Mitsuba => Opening::Degrees(FovAxis::Horizontal),
            Self::Blender => Opening::Millimetres(36.0, FovAxis::Larger),
            Self::GroundUp | Self::OpenCv => Opening::Pixels,
        }
    }
    // ANCHOR_END: opening

    // ANCHOR: camera_axes
    /// Columns: its camera's x, y and z axes in pinhole's camera space, where x is right, y is up and z is back.
    pub fn camera_axes(self) -> DMat3 {
        match self {
            Self::OneWeekend | Self::GroundUp | Self::OpenGl | Self::Gltf | Self::Blender => RIGHT_UP_BACK,
            Self::Pbrt => RIGHT_UP_AHEAD,
            Self::Mitsuba => LEFT_UP_AHEAD,
            Self::OpenCv => RIGHT_DOWN_AHEAD,
        }
    }

    /// The rotation from pinhole's world space to the program's.
    pub fn world_from_pinhole(self) -> DMat3 {
        if self == Self::Blender { Z_UP_FROM_PINHOLE } else { DMat3::IDENTITY }
    }
    // ANCHOR_END: camera_axes
}

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::OneWeekend => "Ray Tracing in One Weekend",
            Self::GroundUp => "Ray Tracing from the Ground Up",
            Self::OpenGl => "OpenGL",
            Self::Gltf => "glTF 2.0",
            Self::Pbrt => "pbrt-v4",
            Self::Mitsuba => "Mitsuba 3",
            Self::OpenCv => "OpenCV",
            Self::Blender => "Blender",
        })
    }
}

// ANCHOR: theirs_from_pinhole
/// A camera of pinhole's in a program's convention.
pub fn theirs_from_pinhole(program: Program, camera: &PlacedCamera) -> Described {
    let (tan, aspect) = (camera.tan_half_vertical, camera.image.aspect());
    let opening = match program.opening() {
        Opening::Degrees(axis) => angle_of_tan_half(tan * half_extent(axis, aspect)).0,
        Opening::Radians(axis) => angle_of_tan_half(tan * half_extent(axis, aspect)).radians(),
        Opening::Pixels => f64::from(camera.image.height) / (2.0 * tan),
        Opening::Millimetres(film, axis) => film / (2.0 * tan * half_extent(axis, aspect)),
    };
    let world = program.world_from_pinhole();
    Described { opening, axes: world * camera.world_from_camera * program.camera_axes(), eye: world * camera.look.eye }
}

/// A program's camera in pinhole's convention.
pub fn pinhole_from_theirs(program: Program, described: &Described, image: ImageFrame) -> PlacedCamera {
    let (number, aspect) = (described.opening, image.aspect());
    let tan_half_vertical = match program.opening() {
        Opening::Degrees(axis) => tan_half(Degrees(number)) / half_extent(axis, aspect),
        Opening::Radians(axis) => tan_half(Degrees(number.to_degrees())) / half_extent(axis, aspect),
        Opening::Pixels => f64::from(image.height) / (2.0 * number),
        Opening::Millimetres(film, axis) => film / (2.0 * number * half_extent(axis, aspect)),
    };
    // A matrix of permutations and signs is inverted by transposing it.
    let world = program.world_from_pinhole().transpose();
    let world_from_camera = world * described.axes * program.camera_axes().transpose();
    let eye = world * described.eye;
    let look = LookAt { eye, target: eye - world_from_camera.z_axis, up: world_from_camera.y_axis };
    PlacedCamera { look, world_from_camera, tan_half_vertical, image }
}
// ANCHOR_END: theirs_from_pinhole

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn handedness_is_as_each_program_documents() {
        for program in Program::ALL {
            let (camera, world) = (program.camera_axes().determinant(), program.world_from_pinhole().determinant());
            assert_eq!(camera, if program == Program::Pbrt { -1.0 } else { 1.0 }, "{program}");
            assert_eq!(world, 1.0, "{program}");
        }
        assert_eq!(Z_UP_FROM_PINHOLE * DVec3::Y, DVec3::Z);
        assert_eq!(Z_UP_FROM_PINHOLE * DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, -3.0, 2.0));
    }

    #[test]
    fn a_square_image_has_one_angle_for_all_axes() {
        for axis in [FovAxis::Vertical, FovAxis::Horizontal, FovAxis::Smaller, FovAxis::Larger] {
            assert_eq!(half_extent(axis, 1.0), 1.0);
        }
        assert_eq!(half_extent(FovAxis::Diagonal, 0.75), 1.25);
    }

    #[test]
    fn smaller_and_larger_change_places_in_a_portrait_image() {
        for (aspect, smaller, larger) in [(16.0 / 9.0, 1.0, 16.0 / 9.0), (9.0 / 16.0, 9.0 / 16.0, 1.0)] {
            assert_eq!(
                [half_extent(FovAxis::Smaller, aspect), half_extent(FovAxis::Larger, aspect)],
                [smaller, larger]
            );
        }
    }
}
