use super::camera::eye;
use super::check::{finite_point, kind_and_name, positive_length, triple};
use super::pose::{pose, unevenly_scaled};
use super::shape_kind::numbered;
use crate::plan::{Census, Table};
use crate::scene::{ChildOf, Placement, SceneError, Sphere};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};

/// The greatest ratio of an ellipsoid's longest to its shortest axis, up to which `extremes` has tested it.
const LARGEST_RATIO: f64 = 1e7;
/// The factor by which its bounding sphere is enlarged, so that no rounding of the map leads outside it.
const RADIUS_MARGIN: f64 = 1.0 + 1.0 / 65_536.0;

/// A sphere with a non-uniform scale: the points x of render space with |A (x − C)| = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// C, relative to the eye.
    pub centre: DVec3,
    /// A: from render space to the space in which it is the unit sphere, per scene unit.
    pub unit_from_world: DMat3,
    /// The Frobenius norm ‖A‖: an upper bound of the factor by which A lengthens a vector.
    pub norm: f64,
    /// The radius of a bounding sphere about the centre.
    pub bounding_radius: f64,
}

impl Ellipsoid {
    /// The ellipsoid of a map whose longest half axis has at most about this length.
    pub fn new(centre: DVec3, unit_from_world: DMat3, longest: f64) -> Self {
        let squares: f64 = unit_from_world.to_cols_array().iter().map(|part| part * part).sum();
        Self { centre, unit_from_world, norm: squares.sqrt(), bounding_radius: longest * RADIUS_MARGIN }
    }
}

/// Ellipsoids in render space, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EllipsoidTable {
    /// The ellipsoids.
    pub ellipsoid: Vec<Ellipsoid>,
    /// The shape's number.
    pub shape: Vec<u32>,
}

impl Table for EllipsoidTable {
    const NAME: &'static str = "ellipsoids";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let eye = eye(scene)?;
        let mut table = Self::default();
        for (shape, entity) in numbered::<Sphere>(scene) {
            let Some(sphere) = scene.get::<Sphere>(entity).filter(|_| unevenly_scaled(scene, entity)) else { continue };
            table.ellipsoid.push(ellipsoid(scene, entity, sphere.radius, eye)?);
            table.shape.push(shape as u32);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.ellipsoid.len() * (size_of::<Ellipsoid>() + size_of::<u32>())
    }
}

fn ellipsoid(scene: &Census<'_>, entity: Entity, radius: f64, eye: DVec3) -> Result<Ellipsoid, SceneError> {
    let who = kind_and_name(scene, "sphere", entity);
    let pose = pose(scene, &who, entity)?;
    positive_length(&who, "radius", radius)?;
    let centre = finite_point(&who, "position", pose.world_from_entity.translation - eye)?;
    let unit_from_world = pose.entity_from_world * (1.0 / radius);
    let longest = radius * stretch(pose.world_from_entity.matrix3);
    let shortest = 1.0 / stretch(unit_from_world.transpose());
    positive_length(&who, "longest half axis", longest)?;
    positive_length(&who, "shortest half axis", shortest)?;
    let ratio = longest / shortest;
    if ratio > LARGEST_RATIO {
        let own = scene.get::<Placement>(entity).copied().unwrap_or_default().scale;
        let with = if scene.get::<ChildOf>(entity).is_some() { "with its parents " } else { "" };
        let value = format!("{}, {with}{ratio:.1e} times as long as thick", triple(own));
        let accepted = format!("a sphere may be at most {LARGEST_RATIO:e} times as long as thick");
        return Err(SceneError::new(who, "scale", value, accepted));
    }
    Ok(Ellipsoid::new(centre, unit_from_world, longest))
}

/// The greatest factor by which a map lengthens a vector, or up to 1 % more where its columns are not perpendicular.
fn stretch(map: DMat3) -> f64 {
    const ROUNDS: u32 = 5;
    bound_of_eigenvalues(map.transpose() * map, ROUNDS).sqrt()
}

/// An upper bound of a symmetric matrix's eigenvalues, its largest row sum; each round squares the matrix, which halves
/// the logarithm of the bound's excess.
fn bound_of_eigenvalues(matrix: DMat3, rounds: u32) -> f64 {
    let bound = [0, 1, 2].map(|row| matrix.row(row).abs().element_sum()).iter().copied().fold(0.0, f64::max);
    if rounds == 0 || bound == 0.0 || !bound.is_finite() {
        return bound;
    }
    let reduced = matrix * (1.0 / bound);
    bound * bound_of_eigenvalues(reduced * reduced, rounds - 1).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extract::{ShapeKind, ShapeTable, SphereTable};
    use crate::scene::{Matte, PerspectiveCamera};
    use glam::DQuat;

    fn scene(scales: &[DVec3]) -> (World, Vec<Entity>) {
        let mut world = World::new();
        world.spawn((PerspectiveCamera::default(), Placement::at(0.0, 0.0, 9.0)));
        let orientation = DQuat::from_xyzw(0.5, -0.1, 0.7, 0.5).normalize();
        let spawn = |&scale: &DVec3| {
            let placement = Placement { scale, orientation, position: DVec3::new(1.0, 2.0, 3.0) };
            world.spawn((Sphere { radius: 2.0 }, Matte::default(), placement)).id()
        };
        let spheres = scales.iter().map(spawn).collect();
        (world, spheres)
    }

    #[test]
    fn a_sphere_is_in_one_table_or_the_other() {
        let uneven = [DVec3::new(1.0, 1.0, 1.0 + 2e-9), DVec3::new(-1.0, 1.0, 2.0), DVec3::new(1e-3, 1.0, 1e3)];
        let even = [DVec3::ONE, DVec3::new(1.0, 1.0, 1.0 + 1e-12), DVec3::new(-2.0, 2.0, 2.0), DVec3::splat(-1e-9)];
        let (world, spheres) = scene(&[&uneven[..], &even].concat());
        let (shapes, ellipsoids) =
            (ShapeTable::extract(&Census::of(&world)), EllipsoidTable::extract(&Census::of(&world)));
        let (shapes, ellipsoids) = (shapes.expect("shapes"), ellipsoids.expect("ellipsoids"));
        let spheres_left = SphereTable::extract(&Census::of(&world)).expect("spheres");
        assert_eq!(ellipsoids.shape, [0, 1, 2]);
        assert_eq!(spheres_left.shape, [3, 4, 5, 6]);
        for (number, &sphere) in spheres.iter().enumerate() {
            let kind =
                if unevenly_scaled(&Census::of(&world), sphere) { ShapeKind::Ellipsoid } else { ShapeKind::Sphere };
            assert_eq!(shapes.kind[number], kind, "sphere {number}");
        }
    }

    #[test]
    fn the_map_takes_poles_to_the_unit_sphere() {
        let scale = DVec3::new(-1e-3, 3.0, 1e3);
        let (world, spheres) = scene(&[scale]);
        let table = EllipsoidTable::extract(&Census::of(&world)).expect("ellipsoids");
        let pose = pose(&Census::of(&world), "", spheres[0]).expect("a pose");
        let Ellipsoid { centre, unit_from_world, bounding_radius, .. } = table.ellipsoid[0];
        assert_eq!(centre, DVec3::new(1.0, 2.0, -6.0));
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let pole = pose.world_from_entity.matrix3 * (axis * 2.0);
            assert!((unit_from_world * pole - axis).length() < 1e-7, "{axis}: {}", unit_from_world * pole);
            assert!(pole.length() <= bounding_radius);
        }
        assert!(bounding_radius < 2e3 * 1.0001);
    }

    #[test]
    fn a_sheared_sphere_fills_its_bounding_radius() {
        let (mut world, spheres) = scene(&[DVec3::new(1.0, 2.0, 0.5)]);
        let parent = world.spawn(Placement { scale: DVec3::new(3.0, 1.0, 100.0), ..Placement::default() }).id();
        world.entity_mut(spheres[0]).insert(ChildOf(parent));
        let map = pose(&Census::of(&world), "", spheres[0]).expect("a pose").world_from_entity.matrix3;
        let bounding_radius =
            EllipsoidTable::extract(&Census::of(&world)).expect("ellipsoids").ellipsoid[0].bounding_radius;
        let steps = (0..100_000).map(|step| f64::from(step) * 1e-5 * std::f64::consts::TAU * 100.0);
        let point = |angle: f64| {
            let (height, round) = (libm::sin(angle / 200.0), libm::cos(angle / 200.0));
            map * (DVec3::new(libm::cos(angle) * round, libm::sin(angle) * round, height) * 2.0)
        };
        let farthest = steps.map(|angle| point(angle).length()).fold(0.0, f64::max);
        assert!(
            farthest <= bounding_radius && bounding_radius <= farthest * 1.02,
            "{farthest} within {bounding_radius}"
        );
    }

    #[test]
    fn an_ellipsoid_longer_than_ten_million_times_its_thickness_is_refused() {
        let table = |ratio: f64| EllipsoidTable::extract(&Census::of(&scene(&[DVec3::new(1.0, 1.0, ratio)]).0));
        assert!(table(0.999e7).is_ok() && table(1.001e-7).is_ok());
        for ratio in [2e7, 1e-8] {
            let scene_error = table(ratio).expect_err("refused").to_string();
            assert!(scene_error.contains("scale is (1, 1, ") && scene_error.contains("1e7 times"), "{scene_error}");
        }
    }
}
