//! A camera that a reader moves: around a point, along the image, and nearer.

use bevy_ecs::prelude::World;
use glam::DVec3;
use pinhole::Result;
use pinhole::extract::{camera_entity, world_from_entity};
use pinhole::plan::Census;
use pinhole::scene::{ChildOf, LookAt, Motion, OrthographicCamera, PerspectiveCamera, Placement};
use serde::{Deserialize, Serialize};

/// Half a turn in radians, for a drag across the whole height of the picture.
const TURN: f64 = std::f64::consts::PI;
/// How near the view may come to straight up or down, in radians.
const STEEPEST: f64 = 0.02;
/// The heights of view that can be reckoned with: their squares are neither zero nor infinite.
const EXTENT: std::ops::RangeInclusive<f64> = NEAREST..=1e100;
/// The least distance between eye and target.
const NEAREST: f64 = 1e-100;
/// Turning the view by more than this sideways is not what an upright camera does.
const UPRIGHT: f64 = 1e-6;

/// Where the camera is and what it turns around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    eye: DVec3,
    target: DVec3,
    up: DVec3,
    /// The height of what is seen at the target, over the distance of the target or as it is.
    extent: Extent,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Extent {
    OverDistance(f64),
    Fixed(f64),
}

/// A camera as an address carries it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraAt {
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    /// The height of what is seen at the target; only an orthographic camera takes it.
    height: f64,
}

impl Orbit {
    /// The scene's camera, which turns around a point at this distance, or around the point that it looks at.
    ///
    /// Errors: the camera's placement is invalid.
    pub fn of(scene: &World, distance: Option<f64>) -> Result<Self> {
        let camera = camera_entity(scene)?;
        let pose = world_from_entity(&Census::of(scene), "camera", camera)?;
        let (eye, right) = (pose.translation, pose.matrix3.x_axis.normalize());
        let ahead = -pose.matrix3.z_axis.normalize();
        let look = scene.get::<LookAt>(camera).filter(|_| scene.get::<ChildOf>(camera).is_none());
        let target = match (look, distance) {
            (Some(look), _) => look.target,
            (None, distance) => eye + ahead * distance.unwrap_or_else(|| eye.length().max(1.0)),
        };
        let up = if right.y.abs() < UPRIGHT { DVec3::Y } else { pose.matrix3.y_axis.normalize() };
        let fixed = scene.get::<OrthographicCamera>(camera).map(|own| Extent::Fixed(own.view_height));
        let fov = scene.get::<PerspectiveCamera>(camera).map_or(60.0, |own| own.fov.0);
        let over_distance = || Extent::OverDistance(2.0 * libm::tan(fov.to_radians().min(3.0) / 2.0));
        Ok(Self { eye, target, up, extent: fixed.unwrap_or_else(over_distance) })
    }

    /// As an address carries it.
    pub fn at(&self) -> CameraAt {
        let [eye, target, up] = [self.eye, self.target, self.up].map(|own| own.to_array());
        CameraAt { eye, target, up, height: self.view_height() }
    }

    /// The same camera there; none where it could not stand.
    pub fn put_at(self, there: &CameraAt) -> Option<Self> {
        let [eye, target, up] = [there.eye, there.target, there.up].map(DVec3::from);
        let extent = match self.extent {
            Extent::Fixed(_) => Extent::Fixed(there.height),
            own @ Extent::OverDistance(_) => own,
        };
        let own = Self { eye, target, up: up.try_normalize()?, extent };
        let sideways = own.up.cross((eye - target).try_normalize()?).length();
        (own.is_in_range() && sideways > libm::sin(STEEPEST) / 2.0).then_some(own)
    }

    /// Turns around the target: by fractions of the picture's height, to the right and down.
    pub fn turn(&mut self, [x, y]: [f64; 2]) {
        let back = self.eye - self.target;
        let steep = libm::acos((back.dot(self.up) / back.length()).clamp(-1.0, 1.0));
        let wanted = (steep - y * TURN).clamp(STEEPEST, std::f64::consts::PI - STEEPEST);
        let right = self.up.cross(back).try_normalize().unwrap_or(DVec3::X);
        self.eye = self.target + rotated(rotated(back, right, wanted - steep), self.up, -x * TURN);
    }

    /// Moves along the image, so that what is at the target follows the pointer.
    pub fn pan(&mut self, [x, y]: [f64; 2]) {
        let back = self.eye - self.target;
        let right = self.up.cross(back).try_normalize().unwrap_or(DVec3::X);
        let above = back.normalize().cross(right);
        let step = (above * y - right * x) * self.view_height();
        (self.eye, self.target) = (self.eye + step, self.target + step);
    }

    /// Brings the target nearer by this factor, below 1, or further away.
    pub fn zoom(&mut self, factor: f64) {
        match &mut self.extent {
            Extent::OverDistance(_) => self.eye = self.target + (self.eye - self.target) * factor,
            Extent::Fixed(height) => *height *= factor,
        }
    }

    /// Turns around another point from now on, and looks at it.
    pub fn focus(&mut self, target: DVec3) {
        if (self.eye - target).length() > 0.0 {
            self.target = target;
        }
    }

    /// Where this camera is after the scene's own has changed; none where that one was put elsewhere, which is then to be
    /// seen.
    pub fn after_edit(self, before: Self, after: Self) -> Option<Self> {
        let place = |own: Self| (own.eye, own.target, own.up);
        let extent = if before.extent == after.extent { self.extent } else { after.extent };
        (place(before) == place(after)).then_some(Self { extent, ..self })
    }

    /// Whether it is anywhere at all, and what it shows has a size that can be reckoned with.
    pub fn is_in_range(&self) -> bool {
        let apart = (self.eye - self.target).length();
        let min = NEAREST.max(f64::EPSILON * self.eye.length());
        self.eye.is_finite() && self.target.is_finite() && apart > min && EXTENT.contains(&self.view_height())
    }

    /// Where the eye is.
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// Where the camera stands and looks.
    pub fn look_at(&self) -> LookAt {
        LookAt { eye: self.eye, target: self.target, up: self.up }
    }

    /// The height of what is seen at the target, in scene units.
    pub fn view_height(&self) -> f64 {
        match self.extent {
            Extent::OverDistance(ratio) => ratio * (self.eye - self.target).length(),
            Extent::Fixed(height) => height,
        }
    }

    /// Puts the scene's camera there.
    pub fn put(&self, scene: &mut World) {
        let Ok(camera) = camera_entity(scene) else { return };
        let mut camera = scene.entity_mut(camera);
        camera.remove::<(ChildOf, Motion)>();
        camera.insert((Placement::default(), self.look_at()));
        if let (Extent::Fixed(height), Some(mut own)) = (self.extent, camera.get_mut::<OrthographicCamera>()) {
            own.view_height = height;
        }
    }
}

/// A vector turned about a unit axis (Rodrigues' formula).
fn rotated(v: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> World {
        let mut scene = World::new();
        let look = LookAt { eye: DVec3::new(0.0, 1.0, 4.0), target: DVec3::new(0.0, 1.0, 0.0), up: DVec3::Y };
        scene.spawn((PerspectiveCamera::default(), look));
        scene
    }

    #[test]
    fn a_drag_there_and_back_changes_nothing() {
        let mut orbit = Orbit::of(&scene(), None).expect("a camera");
        let before = orbit;
        for (x, y) in [(0.3, 0.1), (-0.3, -0.1)] {
            orbit.turn([x, y]);
            orbit.pan([x, y]);
        }
        orbit.zoom(0.5);
        orbit.zoom(2.0);
        let moved = (orbit.eye - before.eye).length();
        assert!(moved > 1e-3 && moved < 1.0, "the pans went along images that are turned: {moved}");
        let mut orbit = before;
        orbit.turn([0.3, 0.1]);
        orbit.turn([-0.3, -0.1]);
        assert!((orbit.eye - before.eye).length() < 1e-12, "{orbit:?}");
        orbit.pan([0.3, 0.1]);
        orbit.pan([-0.3, -0.1]);
        assert!((orbit.target - before.target).length() < 1e-12, "{orbit:?}");
    }

    #[test]
    fn a_drag_to_the_right_shows_the_left_side_and_a_drag_down_the_top() {
        let mut orbit = Orbit::of(&scene(), None).expect("a camera");
        orbit.turn([0.5, 0.0]);
        assert!((orbit.eye - DVec3::new(-4.0, 1.0, 0.0)).length() < 1e-12, "{orbit:?}");
        orbit.turn([0.0, 9.0]);
        assert!(orbit.eye.y > 4.9 && orbit.eye.y < 5.0, "it stops short of the pole: {orbit:?}");
    }

    #[test]
    fn what_is_at_the_target_follows_the_pointer() {
        let mut orbit = Orbit::of(&scene(), None).expect("a camera");
        let height = 2.0 * libm::tan(22.5_f64.to_radians()) * 4.0;
        orbit.pan([0.0, 0.5]);
        assert!((orbit.target.y - (1.0 + height / 2.0)).abs() < 1e-12, "{orbit:?}");
    }

    #[test]
    fn no_zoom_leads_where_none_leads_back_from() {
        for camera in [true, false] {
            let mut scene = scene();
            if !camera {
                let own = camera_entity(&scene).expect("a camera");
                scene.entity_mut(own).remove::<PerspectiveCamera>().insert(OrthographicCamera { view_height: 3.0 });
            }
            let start = Orbit::of(&scene, None).expect("a camera");
            for factor in [100.0, 0.01] {
                let (mut orbit, mut steps) = (start, 0);
                loop {
                    let mut next = orbit;
                    next.zoom(factor);
                    if !next.is_in_range() {
                        break;
                    }
                    (orbit, steps) = (next, steps + 1);
                }
                assert!((5..200).contains(&steps), "{steps} steps of {factor}");
                (0..steps).for_each(|_| orbit.zoom(1.0 / factor));
                assert!((orbit.view_height() / start.view_height() - 1.0).abs() < 1e-3, "{factor}: {orbit:?}");
            }
        }
    }

    #[test]
    fn an_orthographic_camera_zooms_by_its_view_height() {
        let mut scene = World::new();
        let camera = scene.spawn((OrthographicCamera { view_height: 3.0 }, Placement::at(0.0, 0.0, 2.0))).id();
        let mut orbit = Orbit::of(&scene, Some(2.0)).expect("a camera");
        assert_eq!(orbit.target, DVec3::ZERO);
        orbit.zoom(0.5);
        orbit.put(&mut scene);
        assert_eq!(scene.get::<OrthographicCamera>(camera).map(|own| own.view_height), Some(1.5));
        assert_eq!(scene.get::<LookAt>(camera).map(|look| look.eye), Some(DVec3::new(0.0, 0.0, 2.0)));
    }
}
