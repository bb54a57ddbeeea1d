//! Cameras at random: any angle, any size of image, turned any way, anywhere; one pixel of each.

use super::camera_chain::{
    CameraCase, CameraChain, Pose, axes_error, check_stages, check_world, seen_width, viewport_error,
};
use super::{Group, Method, Tally, Trial};
use crate::measure::camera_check::CameraOracle;
use crate::measure::draws::Draws;
use glam::{DMat3, DQuat, DVec3};
use pinhole::extract::SMALLEST_PIXEL;
use pinhole::scene::{FovAxis, LookAt};
use std::ops::Range;

/// The most that a point of the image may be off, in pixels.
pub(super) const STAGE_BOUND: f64 = 1e-3;
/// The most that a world ray may be off, in pixels, where they are at least [`SMALLEST_PIXEL`] wide.
pub(super) const WORLD_BOUND: f64 = 0.03;
/// And in radians, everywhere: 2u.
pub(super) const ANGLE_BOUND: f64 = 1.2e-7;

/// The rows of every case of cameras.
pub(super) const METHODS: [Method; 10] = [
    Method::pinhole("pinhole, refused if and only if too fine", "", 0.0),
    Method::pinhole("pinhole, axes where it looks", "rad", 4e-15),
    Method::pinhole("pinhole, raster", "px", 0.0),
    Method::pinhole("pinhole, ndc", "px", STAGE_BOUND),
    Method::pinhole("pinhole, screen", "px", STAGE_BOUND),
    Method::pinhole("pinhole, camera", "px", STAGE_BOUND),
    Method::pinhole("pinhole, world, pixels from 4e-6 rad", "px", WORLD_BOUND),
    Method::pinhole("pinhole, world, all pixels", "rad", ANGLE_BOUND),
    Method::pinhole("pinhole, length of R less 1", "u", 4.0),
    Method::naive("naive viewport of world points, f32", "px", WORLD_BOUND),
];

/// The case of cameras at random.
pub fn trials() -> Vec<Trial> {
    vec![trial("any camera, one pixel of each", any_camera)]
}

/// A case of cameras made by `ask`.
pub(super) fn trial(name: impl Into<String>, ask: impl Fn(u64) -> CameraCase + Send + Sync + 'static) -> Trial {
    Trial::new(Group::Camera, name, &METHODS, move |range| check(&ask, range))
}

fn check(ask: &impl Fn(u64) -> CameraCase, range: Range<u64>) -> Tally {
    let (mut tally, mut chain) = (Tally::new(METHODS.len()), CameraChain::new());
    for index in range {
        let asked = ask(index);
        let rotation = chain.set(asked);
        tally.count(rotation.is_ok());
        let check = chain.check(asked, *rotation.as_ref().unwrap_or(&DMat3::IDENTITY));
        let fine = check.pixel_pitch() < SMALLEST_PIXEL;
        tally.scores[0].check(rotation.as_ref().err().map(|scene_error| scene_error.field) == fine.then_some("fov"));
        if rotation.is_ok() {
            let pixel = any_pixel(asked.size, &mut Draws::new(71, index));
            check_pixel(&mut chain, asked, &check, pixel, &mut tally);
        }
    }
    tally
}

fn check_pixel(chain: &mut CameraChain, asked: CameraCase, check: &CameraOracle, pixel: [u32; 2], tally: &mut Tally) {
    let wrote = chain.pixels(pixel, 1)[0];
    let eye = match asked.pose {
        Pose::Turned(eye, _) => eye,
        Pose::Looking(look) => {
            tally.scores[1].measure(axes_error(check.rotation(), &look));
            look.eye
        }
    };
    check_stages(check, pixel, &wrote, &mut tally.scores[2..6]);
    check_world(check, pixel, &wrote, &mut tally.scores[6..9]);
    if seen_width(check, &wrote) >= SMALLEST_PIXEL {
        tally.scores[9].measure(viewport_error(check, eye, pixel));
    }
}

/// A pixel anywhere, a quarter of the coordinates at an edge, so that corners are common.
pub(super) fn any_pixel(size: [u32; 2], draws: &mut Draws) -> [u32; 2] {
    size.map(|extent| match draws.unit() {
        at if at < 0.125 => 0,
        at if at < 0.25 => extent - 1,
        _ => (draws.unit() * f64::from(extent)) as u32,
    })
}

/// Any angle from 1e-4 to 179.99 degrees, half of them uniform in their logarithm and half in that of what is missing to
/// 180; any axis; sides from 1 to 65536 pixels at aspects of 1e-4 to 1e4; any pose.
fn any_camera(index: u64) -> CameraCase {
    let mut draws = Draws::new(72, index);
    let keep_closest = draws.power_of_ten(-4.0, 2.255);
    let double_double = 180.0 - draws.power_of_ten(-2.0, 2.25);
    let fov = if draws.unit() < 0.5 { keep_closest } else { double_double };
    let axes = [FovAxis::Vertical, FovAxis::Horizontal, FovAxis::Smaller, FovAxis::Larger, FovAxis::Diagonal];
    let axis = axes[(draws.unit() * 5.0) as usize];
    CameraCase { size: any_size(&mut draws), fov: fov.min(179.99), axis, pose: any_pose(&mut draws) }
}

/// A longer side, and a shorter one by the aspect; together no more pixels than a film may have.
fn any_size(draws: &mut Draws) -> [u32; 2] {
    let longer = draws.power_of_ten(0.0, 4.8165).min(65_536.0);
    let shorter = (longer * draws.power_of_ten(-4.0, 0.0)).min(f64::from(1 << 30) / longer);
    let [longer, shorter] = [longer, shorter].map(|side| (side as u32).max(1));
    if draws.unit() < 0.5 { [longer, shorter] } else { [shorter, longer] }
}

/// Turned any way or looking at anything, the eye up to 1e7 from the world's origin.
pub(super) fn any_pose(draws: &mut Draws) -> Pose {
    let distance = draws.power_of_ten(-2.0, 7.0);
    let eye = draws.unit_vector() * distance;
    any_pose_at(eye, draws)
}

/// Turned any way or looking at anything from this eye.
pub(super) fn any_pose_at(eye: DVec3, draws: &mut Draws) -> Pose {
    if draws.unit() < 0.5 {
        return Pose::Turned(eye, any_turn(draws));
    }
    let target = eye + draws.unit_vector() * draws.power_of_ten(-2.0, 7.0);
    Pose::Looking(LookAt { eye, target, up: draws.unit_vector() })
}

/// A turn about any axis by any angle.
pub(super) fn any_turn(draws: &mut Draws) -> DQuat {
    let (axis, turn) = (draws.unit_vector(), draws.between(0.0, std::f64::consts::PI));
    let (sine, cosine) = (libm::sin(turn), libm::cos(turn));
    DQuat::from_xyzw(axis.x * sine, axis.y * sine, axis.z * sine, cosine)
}
