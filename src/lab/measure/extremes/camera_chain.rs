//! One camera's chain raster → NDC → screen → camera → world through pinhole's tables and stages, a pixel at a time.

use super::Score;
use super::bench::Bench;
use crate::measure::camera_check::CameraOracle;
use crate::measure::enclosure::Enclosure;
use crate::measure::exact::Dyadic;
use crate::measure::exact_vector::Vector;
use crate::measure::number::Number;
use crate::measure::oracle_camera::length_error_in_u;
use crate::naive::camera::viewport_f32;
use bevy_ecs::prelude::*;
use glam::{DMat3, DQuat, DVec2, DVec3, Vec3};
use pinhole::extract::{CameraAxes, ImageFrame, PerspectiveProjection, SMALLEST_PIXEL};
use pinhole::plan::{Census, Table};
use pinhole::rays::{self, CameraRays, NdcPoints, RasterPoints, ScreenPoints, Tile, WorldRays};
use pinhole::scene::{Degrees, FovAxis, LookAt, PerspectiveCamera, Placement, Resolution, SceneError};

/// How a camera stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pose {
    /// Turned by a quaternion.
    Turned(DVec3, DQuat),
    /// Looking at something.
    Looking(LookAt),
}

/// A camera as an author asks for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraCase {
    /// Pixels from left to right, from top to bottom.
    pub size: [u32; 2],
    /// The full angle.
    pub fov: f64,
    /// Across what the angle is measured.
    pub axis: FovAxis,
    /// How it stands.
    pub pose: Pose,
}

/// What the stages wrote for one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelChain {
    /// In pixels.
    pub raster: DVec2,
    /// From 0 to 1.
    pub ndc: DVec2,
    /// In half heights.
    pub screen: DVec2,
    /// The direction in camera space.
    pub camera: DVec3,
    /// The direction in the world.
    pub world: Vec3,
}

/// A scene with one camera, and the stages of ray generation.
pub struct CameraChain {
    scene: World,
    camera: Entity,
    bench: Bench,
    set: Option<(CameraCase, DMat3)>,
    check: Option<(CameraCase, CameraOracle)>,
}

impl CameraChain {
    /// A camera still to be asked for.
    pub fn new() -> Self {
        let mut scene = World::new();
        let camera = scene.spawn(PerspectiveCamera::default()).id();
        let stages = [
            rays::raster_stage(),
            rays::ndc_stage(),
            rays::screen_stage(),
            rays::perspective_stage(),
            rays::world_stage(),
        ];
        Self { scene, camera, bench: Bench::new(&stages), set: None, check: None }
    }

    /// Extracts this camera's tables, unless it is the one that is there, and answers its axes.
    ///
    /// Errors: what the scene is refused for.
    pub fn set(&mut self, asked: CameraCase) -> Result<DMat3, SceneError> {
        if let Some((_, axes)) = self.set.filter(|(there, _)| *there == asked) {
            return Ok(axes);
        }
        self.set = None;
        let [width, height] = asked.size;
        let mut camera = self.scene.entity_mut(self.camera);
        camera.insert((PerspectiveCamera { fov: Degrees(asked.fov), axis: asked.axis }, Resolution { width, height }));
        match asked.pose {
            Pose::Turned(position, orientation) => {
                camera.remove::<LookAt>().insert(Placement { position, orientation, ..Placement::default() })
            }
            Pose::Looking(look) => camera.insert((look, Placement::default())),
        };
        let census = &Census::of(&self.scene);
        let axes = CameraAxes::extract(census)?;
        self.bench.insert(ImageFrame::extract(census)?);
        self.bench.insert(PerspectiveProjection::extract(census)?);
        self.bench.insert(axes);
        self.set = Some((asked, axes.world_from_camera));
        Ok(axes.world_from_camera)
    }

    /// The oracle of what was asked, with these axes; its tangent is kept for the next that asks the same.
    pub fn check(&mut self, asked: CameraCase, rotation: DMat3) -> CameraOracle {
        let same = |kept: &CameraCase| (kept.size, kept.fov, kept.axis) == (asked.size, asked.fov, asked.axis);
        if let Some((_, check)) = self.check.as_ref().filter(|(kept, _)| same(kept)) {
            return check.turned(rotation);
        }
        let check = CameraOracle::new(asked.size[0], asked.size[1], asked.fov, asked.axis, rotation);
        self.check = Some((asked, check.clone()));
        check
    }

    /// Runs the stages for `count` pixels of a row, from this one on.
    pub fn pixels(&mut self, [x, y]: [u32; 2], count: u32) -> Vec<PixelChain> {
        self.bench.put(Tile { x, y, width: count, height: 1 });
        self.bench.run();
        let bench = &self.bench;
        let (raster, ndc) = (bench.column::<RasterPoints>(), bench.column::<NdcPoints>());
        let (screen, camera) = (bench.column::<ScreenPoints>(), bench.column::<CameraRays>());
        let world = bench.column::<WorldRays>();
        let chain = |row: usize| PixelChain {
            raster: raster.point(row),
            ndc: ndc.point(row),
            screen: screen.point(row),
            camera: camera.direction(row),
            world: world.direction(row),
        };
        (0..count as usize).map(chain).collect()
    }
}

/// How far the raster, NDC, screen and camera points of a pixel are off, in pixels, into four scores.
pub fn check_stages(check: &CameraOracle, pixel: [u32; 2], wrote: &PixelChain, scores: &mut [Score]) {
    let size = DVec2::new(f64::from(check.width), f64::from(check.height));
    scores[0].measure((wrote.raster - check.raster(pixel)).length());
    scores[1].measure(((wrote.ndc - check.ndc(pixel)) * size).length());
    scores[2].measure((wrote.screen - check.screen(pixel)).length() * size.y / 2.0);
    scores[3].measure(check.camera_error_in_pixels(wrote.camera / -wrote.camera.z, pixel));
}

/// How wide a pixel is where it is narrowest, seen from the eye, in radians: towards the edge of a wide image its plane
/// is both farther and oblique.
pub fn seen_width(check: &CameraOracle, wrote: &PixelChain) -> f64 {
    check.pixel_pitch() * wrote.camera.z * wrote.camera.z
}

/// How far a world ray is off into three scores: in pixels where these are wide enough for f32, in radians everywhere,
/// its length in u.
pub fn check_world(check: &CameraOracle, pixel: [u32; 2], wrote: &PixelChain, scores: &mut [Score]) {
    if seen_width(check, wrote) >= SMALLEST_PIXEL {
        scores[0].measure(check.world_error_in_pixels(wrote.world, pixel));
    }
    scores[1].measure(check.world_error_in_radians(wrote.world, pixel));
    scores[2].measure(length_error_in_u(wrote.world).abs());
}

/// How far the naive ray of a pixel is off, in pixels; it gets the exact vertical angle and pinhole's axes, rounded to
/// f32.
pub fn viewport_error(check: &CameraOracle, eye: DVec3, pixel: [u32; 2]) -> f64 {
    let vertical = 2.0 * libm::atan(check.tan_half_vertical()).to_degrees();
    let size = [check.width, check.height];
    let direction = viewport_f32(eye.as_vec3(), check.rotation().as_mat3(), vertical as f32, size, pixel);
    check.world_error_in_pixels(direction, pixel)
}

/// How far the axes of a camera that looks at something are from where it looks and from upright, in radians.
///
/// The nearer up lies to the view, the less it says of what is upright, so that error counts times the sine between.
pub fn axes_error(axes: DMat3, look: &LookAt) -> f64 {
    let enclosed = axes_errors::<Enclosure>(axes, look);
    let [back, right, sine] = enclosed.or_else(|| axes_errors::<Dyadic>(axes, look)).unwrap_or([f64::INFINITY; 3]);
    let upright = (axes.x_axis.cross(axes.y_axis) - axes.z_axis).length();
    back.max(sine * right.max(upright))
}

/// The angles by which back and right are off, and the sine between up and back.
fn axes_errors<N: Number>(axes: DMat3, look: &LookAt) -> Option<[f64; 3]> {
    let (up, back) = (Vector::<N>::of(look.up), Vector::<N>::of(look.eye).minus(&Vector::of(look.target)));
    let right = up.cross(&back);
    let sine = right.length_about()? / up.length_about()? / back.length_about()?;
    let angle =
        |axis: DVec3, exact: &Vector<N>| Some(Vector::of(axis).cross(exact).length_about()? / exact.length_about()?);
    Some([angle(axes.z_axis, &back)?, angle(axes.x_axis, &right)?, sine])
}
