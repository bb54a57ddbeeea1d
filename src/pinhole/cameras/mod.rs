//! Cameras: what a camera is, the cameras there are, and the mathematics of each.
//!
//! Reads: a camera's component and the image's resolution; points of the screen.
//! Gives: the rays through these points, in camera space, in f64, and their inverse.
//! Space: screen (y up, the image is 2 high) and camera (the eye at the origin, looking down −z).
//!
//! [`Camera`] is all that the rest of the renderer asks of one; `with_cameras` lists those that implement it, one line
//! each.
//! A further camera is a file of this folder, its lines here, and its component and its word in `scene`.

/// The registered cameras, one line each; a further camera is added with a line, and everything else is generic over it.
///
/// A line holds the component's name, the type that implements [`Camera`](crate::cameras::Camera), and the noun for
/// messages and stages.
/// The order is that of the stages; it does not affect any picture.
#[doc(hidden)]
#[macro_export]
macro_rules! with_cameras {
    ($then:ident) => {
        $then! {
            PerspectiveCamera($crate::cameras::PerspectiveProjection) "perspective",
            OrthographicCamera($crate::cameras::OrthographicWindow) "orthographic",
            FisheyeCamera($crate::cameras::ImageCircle) "fisheye",
            EquirectangularCamera($crate::cameras::EquirectangularImage) "equirectangular",
        }
    };
}
pub use camera::{
    Camera, CameraNames, CameraRaySlices, ImageFrame, Listed, Outline, RaySpread, SMALLEST_PIXEL, ScreenSlices,
    half_extent, tan_half,
};
pub use with_cameras;

mod camera;
mod equirectangular;
mod fisheye;
mod orthographic;
mod perspective;

pub use equirectangular::{EquirectangularImage, camera_ray_equirectangular, screen_from_equirectangular};
pub use fisheye::{ImageCircle, camera_ray_fisheye, in_image_circle, screen_from_fisheye};
pub use orthographic::{OrthographicWindow, camera_ray_orthographic};
pub use perspective::{PerspectiveProjection, angle_across, angle_of_tan_half, camera_ray_perspective};
