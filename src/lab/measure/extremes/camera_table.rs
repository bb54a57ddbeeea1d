//! Cameras at their limits: the narrowest and the widest angle, the largest and the smallest image, the farthest eye.

use super::camera::{METHODS, WORLD_BOUND, any_pixel, any_pose, any_pose_at, any_turn, trial};
use super::camera_chain::{CameraCase, CameraChain, Pose, viewport_error};
use super::camera_limits::FEW;
use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::naive::camera::ndc_over_last;
use glam::{DMat3, DQuat, DVec3};
use pinhole::scene::{FovAxis, LookAt};

/// Pixels that are tried of each camera.
const PIXELS: u64 = 8;

/// The cases of limits.
pub fn trials() -> Vec<Trial> {
    let lens = |name: &str, size, fov| trial(name, move |index| posed(index, size, fov));
    let far =
        |distance: f64| trial(format!("40 degrees, the eye at {distance:e}"), move |index| far_eye(index, distance));
    vec![
        lens("179.99 degrees, 1024 x 768", [1024, 768], 179.99),
        lens("179.99 degrees, 65536 x 16384", [65_536, 16_384], 179.99),
        lens("90 degrees, 65536 x 16384", [65_536, 16_384], 90.0),
        lens("the narrowest pixels: 0.235 degrees, 1024 x 1024", [1024, 1024], 0.235),
        lens("90 degrees, 1 x 10000", [1, 10_000], 90.0),
        lens("90 degrees, 10000 x 1", [10_000, 1], 90.0),
        far(1e4),
        far(1e5),
        far(1e7),
        too_narrow(),
        one_pixel(),
        monotone(),
        nearly_upright(),
    ]
}

fn posed(index: u64, size: [u32; 2], fov: f64) -> CameraCase {
    CameraCase { size, fov, axis: FovAxis::Vertical, pose: any_pose(&mut Draws::new(73, index / PIXELS)) }
}

fn far_eye(index: u64, distance: f64) -> CameraCase {
    let mut draws = Draws::new(74, index / PIXELS);
    let eye = draws.unit_vector() * distance;
    CameraCase { size: [1024, 768], fov: 40.0, axis: FovAxis::Vertical, pose: any_pose_at(eye, &mut draws) }
}

/// A case whose inputs are checked one by one, right or wrong.
pub(super) fn one_by_one(
    name: &str,
    methods: &[Method],
    check: impl Fn(&mut CameraChain, u64, &mut Tally) + Send + Sync + 'static,
) -> Trial {
    let rows = methods.len();
    Trial::new(Group::Camera, name, methods, move |range| {
        let (mut tally, mut chain) = (Tally::new(rows), CameraChain::new());
        range.for_each(|index| check(&mut chain, index, &mut tally));
        tally
    })
}

pub(super) fn turned(size: [u32; 2], fov: f64, turn: DQuat) -> CameraCase {
    CameraCase { size, fov, axis: FovAxis::Vertical, pose: Pose::Turned(DVec3::ZERO, turn) }
}

/// A lens that f32 world rays cannot serve is refused by name; the naive viewport draws it all the same.
fn too_narrow() -> Trial {
    const ROWS: [Method; 2] = [
        Method::pinhole("pinhole, refused: fov, 4e-6 rad", "", 0.0),
        Method::naive(METHODS[METHODS.len() - 1].name, "px", WORLD_BOUND),
    ];
    one_by_one("1e-4 degrees, 1024 x 1024", &ROWS, |chain, index, tally| {
        let mut draws = Draws::new(75, index);
        let turn = any_turn(&mut draws);
        let asked = turned([1024, 1024], 1e-4, turn);
        let scene_error = chain.set(asked).err().map(|scene_error| scene_error.to_string()).unwrap_or_default();
        tally.count(scene_error.is_empty());
        tally.scores[0].check(scene_error.contains("fov is 0.0001°") && scene_error.contains("4e-6 rad"));
        let check = chain.check(asked, DMat3::from_quat(turn));
        tally.scores[1].measure(viewport_error(&check, DVec3::ZERO, any_pixel(asked.size, &mut draws)));
    })
    .at_most(FEW)
}

/// The one pixel of an image looks straight ahead, to the last bit.
fn one_pixel() -> Trial {
    const ROWS: [Method; 2] = [
        Method::pinhole("pinhole, straight ahead to the last bit", "", 0.0),
        Method::naive("naive, pixel / (width - 1)", "", 0.0),
    ];
    one_by_one("1 x 1, any angle", &ROWS, |chain, index, tally| {
        let mut draws = Draws::new(76, index);
        let turn = any_turn(&mut draws);
        let axes = chain.set(turned([1, 1], 180.0 - draws.power_of_ten(-2.0, 2.2), turn));
        tally.count(axes.is_ok());
        let wrote = chain.pixels([0, 0], 1)[0];
        let ahead = axes.is_ok_and(|axes| wrote.world == (-axes.z_axis).as_vec3());
        tally.scores[0].check(ahead && wrote.camera == DVec3::NEG_Z);
        tally.scores[1].check(ndc_over_last(0, 1) == 0.5);
    })
}

/// From pixel to pixel rays turn to the right, also where f32 hardly tells them apart.
fn monotone() -> Trial {
    const ROWS: [Method; 1] = [Method::pinhole("pinhole, each to the right of the last", "", 0.0)];
    one_by_one("179.99 degrees, 65536 x 16384, neighbours", &ROWS, |chain, index, tally| {
        let mut draws = Draws::new(77, index);
        let asked = turned([65_536, 16_384], 179.99, DQuat::IDENTITY);
        let axes = chain.set(asked);
        tally.count(axes.is_ok());
        let [x, y] = any_pixel(asked.size, &mut draws);
        let wrote = chain.pixels([x.min(65_534), y], 2);
        let [left, right] = [wrote[0], wrote[1]];
        tally.scores[0].check(left.camera.x < right.camera.x && left.world.x <= right.world.x);
    })
}

/// An up that nearly lies along the view gives orthonormal axes, or is refused by name.
fn nearly_upright() -> Trial {
    const ROWS: [Method; 1] = [Method::pinhole("pinhole, orthonormal, or up refused", "u", 4.0)];
    one_by_one("up from 1e-10 to 1 rad off the view", &ROWS, |chain, index, tally| {
        let mut draws = Draws::new(78, index);
        let back = draws.unit_vector();
        let up = back + draws.unit_vector_across(back) * draws.power_of_ten(-10.0, 0.0);
        let look = LookAt { eye: back * draws.power_of_ten(-2.0, 7.0), target: DVec3::ZERO, up };
        let asked = turned([64, 64], 45.0, DQuat::IDENTITY);
        let axes = chain.set(CameraCase { pose: Pose::Looking(look), ..asked });
        tally.count(axes.is_ok());
        match axes {
            Ok(axes) => {
                let off = axes.transpose() * axes - DMat3::IDENTITY;
                let worst = off.to_cols_array().iter().fold(0.0_f64, |worst, part| worst.max(part.abs()));
                tally.scores[0].measure(worst * f64::from(1 << 24));
            }
            Err(scene_error) => tally.scores[0].check(scene_error.field == "up"),
        }
    })
}
