//! Other units, another place, another turn, another camera: edits of a scene's components.

use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::extract::{camera_entity, upward};
use pinhole::plan::entities;
use pinhole::scene::*;
use pinhole::shapes::{Listed, SceneShape, ShapeVisitor, visit_shapes};

/// Everything 2ᵏ times as large and as far away, every light 4ᵏ times as strong: the same picture in other units.
pub fn scale(scene: &mut World, k: i32) {
    let scale = libm::ldexp(1.0, k);
    for entity in entities::<()>(scene) {
        let mut entity = scene.entity_mut(entity);
        visit_shapes(&mut Scaled(&mut entity, scale));
        if let Some(mut placement) = entity.get_mut::<Placement>() {
            placement.position *= scale;
        }
        if let Some(mut look) = entity.get_mut::<LookAt>() {
            look.eye *= scale;
            look.target *= scale;
        }
        if let Some(mut checker) = entity.get_mut::<Checker>().filter(|texture| texture.by == TextureBy::Space) {
            checker.size *= scale;
        }
        if let Some(mut stripes) = entity.get_mut::<Stripes>().filter(|texture| texture.by == TextureBy::Space) {
            stripes.size *= scale;
        }
        if let Some(mut image) = entity.get_mut::<ImageTexture>().filter(|texture| texture.by == TextureBy::Space) {
            image.size *= scale;
        }
        if let Some(mut camera) = entity.get_mut::<OrthographicCamera>() {
            camera.view_height *= scale;
        }
        if let Some(mut motion) = entity.get_mut::<Motion>() {
            motion.velocity *= scale;
        }
        if let Some(mut lens) = entity.get_mut::<Lens>() {
            lens.focus_distance *= scale;
            match &mut lens.aperture {
                Aperture::Radius { radius } => *radius *= scale,
                Aperture::FNumber { focal_length, .. } => *focal_length *= scale,
            }
        }
        if let Some(mut glass) = entity.get_mut::<Glass>() {
            let Rgb { r, g, b } = glass.absorption;
            glass.absorption = Rgb::new(r / scale, g / scale, b / scale);
        }
        if let Some(mut integrator) = entity.get_mut::<Integrator>()
            && let Integrator::AmbientOcclusion { distance } = &mut *integrator
        {
            *distance *= scale;
        }
        let stronger = |Rgb { r, g, b }: Rgb| Rgb::new(r * scale * scale, g * scale * scale, b * scale * scale);
        if let Some(mut light) = entity.get_mut::<PointLight>() {
            light.intensity = stronger(light.intensity);
        }
        if let Some(mut light) = entity.get_mut::<SpotLight>() {
            light.intensity = stronger(light.intensity);
        }
    }
}

/// An entity whose shape is scaled.
struct Scaled<'e, 'w>(&'e mut EntityWorldMut<'w>, f64);

impl ShapeVisitor for Scaled<'_, '_> {
    fn visit<S: Listed>(&mut self) {
        // One component may be listed as two shapes, and is scaled as the one that needs no uneven scale.
        if let Some(mut shape) = self.0.get_mut::<S::Component>().filter(|_| S::NON_UNIFORM != Some(true)) {
            shape.scale(self.1);
        }
    }
}

/// The entities that stand somewhere and hang on no parent.
fn roots(scene: &World) -> Vec<Entity> {
    // Asked one by one: a scene that has never known a parent knows no filter for one.
    let mut placed = entities::<With<Placement>>(scene);
    placed.retain(|&entity| scene.get::<ChildOf>(entity).is_none());
    placed
}

/// Every root's place, changed by `edit`: its position, or the points that it stands at and looks at.
fn edit_places(scene: &mut World, edit: impl Fn(DVec3) -> DVec3) {
    for entity in roots(scene) {
        let mut entity = scene.entity_mut(entity);
        if let Some(mut look) = entity.get_mut::<LookAt>() {
            (look.eye, look.target) = (edit(look.eye), edit(look.target));
        } else if let Some(mut placement) = entity.get_mut::<Placement>() {
            placement.position = edit(placement.position);
        }
    }
}

/// The whole scene moved.
pub fn shift(scene: &mut World, by: DVec3) {
    edit_places(scene, |point| point + by);
}

/// Every root's place brought to the nearest multiples of 2⁻²⁴, so that a move by 2²⁰ rounds nothing.
pub fn lay_on_grid(scene: &mut World) {
    const STEPS: f64 = (1 << 24) as f64;
    edit_places(scene, |point| (point * STEPS).round() / STEPS);
}

/// The whole scene turned about the world's origin.
pub fn turn(scene: &mut World, by: DQuat) {
    for entity in roots(scene) {
        let mut entity = scene.entity_mut(entity);
        if let Some(mut look) = entity.get_mut::<LookAt>() {
            look.up = by * upward(&look);
        } else if let Some(mut placement) = entity.get_mut::<Placement>() {
            placement.orientation = (by * placement.orientation).normalize();
        }
    }
    edit_places(scene, |point| by * point);
    for entity in entities::<With<Motion>>(scene) {
        if let Some(mut motion) = scene.entity_mut(entity).get_mut::<Motion>() {
            motion.velocity = by * motion.velocity;
        }
    }
}

/// Another field of view; nothing where the camera has none.
pub fn set_fov(scene: &mut World, degrees: f64) {
    let Ok(camera) = camera_entity(scene) else { return };
    if let Some(mut camera) = scene.entity_mut(camera).get_mut::<PerspectiveCamera>() {
        camera.fov = Degrees(degrees);
    }
}

/// Another number of pixels.
pub fn set_size(scene: &mut World, [width, height]: [u32; 2]) {
    if let Ok(camera) = camera_entity(scene) {
        scene.entity_mut(camera).insert(Resolution { width, height });
    }
}

/// Whether anything hangs on a parent: its place in the world is then a sum that rounds.
pub fn has_children(scene: &World) -> bool {
    !entities::<With<ChildOf>>(scene).is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pinhole::extract::{CameraAxes, PlaneTable, SphereTable};
    use pinhole::plan::{Census, Table};

    /// A camera that looks at a ball on a floor, and another ball that hangs on the first.
    fn scene(with_child: bool) -> World {
        let mut world = World::new();
        world.spawn((PerspectiveCamera::default(), LookAt { eye: DVec3::Z * 4.0, target: DVec3::ZERO, up: DVec3::Y }));
        let ball = world.spawn((Sphere { radius: 1.0 }, Placement::at(0.5, 0.0, 0.0), Matte::default())).id();
        world.spawn((Plane::default(), Placement::at(0.0, -1.0, 0.0), Matte::default()));
        if with_child {
            world.spawn((Sphere { radius: 0.25 }, Placement::at(2.0, 0.0, 0.0), Matte::default(), ChildOf(ball)));
        }
        world
    }

    /// The first ball's centre in the world.
    fn place(world: &World) -> DVec3 {
        let ball = entities::<With<Sphere>>(world)[0];
        world.get::<Placement>(ball).expect("a ball stands somewhere").position
    }

    #[test]
    fn every_edit_edits_every_root_and_no_child() {
        for with_child in [false, true] {
            let mut moved = scene(with_child);
            shift(&mut moved, DVec3::new(1.0, 2.0, 3.0));
            assert_eq!(place(&moved), DVec3::new(1.5, 2.0, 3.0));
            assert_eq!(pinhole::extract::eye(&Census::of(&moved)), Ok(DVec3::new(1.0, 2.0, 7.0)));
            // From the eye nothing has moved, also not what hangs on a parent.
            let of = |world: &World| SphereTable::extract(&Census::of(world)).expect("spheres");
            assert_eq!(of(&moved).row, of(&scene(with_child)).row);

            let mut turned = scene(with_child);
            let half = std::f64::consts::FRAC_1_SQRT_2;
            turn(&mut turned, DQuat::from_xyzw(0.0, 0.0, half, half));
            assert!((place(&turned) - DVec3::Y * 0.5).length() < 1e-15);
            let census = &Census::of(&turned);
            let axes = CameraAxes::extract(census).expect("axes").world_from_camera;
            assert!((axes.y_axis + DVec3::X).length() < 1e-15);
            let normal = PlaneTable::extract(census).expect("planes").row[0].normal;
            assert!((normal + DVec3::X).length() < 1e-7);

            // An up that nobody wrote turns, too, where it is not the default's direction.
            let mut down = scene(with_child);
            let camera = camera_entity(&down).expect("a camera");
            down.entity_mut(camera).insert(LookAt { eye: DVec3::Y * 4.0, target: DVec3::ZERO, up: DVec3::Y });
            turn(&mut down, DQuat::from_xyzw(0.0, 0.0, half, half));
            let axes = CameraAxes::extract(&Census::of(&down)).expect("axes").world_from_camera;
            assert!((axes.y_axis + DVec3::Z).length() + (axes.x_axis - DVec3::Y).length() < 1e-15);

            let mut large = scene(with_child);
            scale(&mut large, 3);
            assert_eq!(place(&large), DVec3::X * 4.0);
            assert_eq!(of(&large).row[0].radius, 8.0);
            assert_eq!(has_children(&large), with_child);
        }
    }
}
