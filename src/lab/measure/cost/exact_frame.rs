//! What a frame is compared with: its camera and its shapes in exact numbers.

use crate::measure::oracle_camera::ExactCamera;
use crate::measure::oracle_plane::Plane;
use crate::measure::oracle_sphere::Sphere;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::Result;
use pinhole::extract::{CameraAxes, ShapeTable, any_shapes, camera_entity};
use pinhole::plan::{Census, Table};
use pinhole::render::Inspection;
use pinhole::scene::{OrthographicCamera, PerspectiveCamera};
use pinhole::shapes::{AnyShape, Ellipsoid, PlacedPlane, PlacedSphere, Planar, ShapeKind, Slabs, TriangleRow};

/// What the frame is compared with.
pub(super) struct Exact {
    pub camera: ExactCamera,
    /// Half the height of an orthographic camera's rectangle.
    pub half_height: Option<f64>,
    /// None where some move: each ray hits those elsewhere, so no hit is compared.
    pub shapes: Vec<ExactShape>,
}

pub(super) enum ExactShape {
    Sphere(Sphere),
    Plane(Plane),
    Ellipsoid(Ellipsoid),
    Disk(Planar),
    Rectangle(Planar),
    Cuboid(Slabs),
    Triangle(TriangleRow, DVec3),
}

impl Exact {
    pub fn of(scene: &World, frame: &Inspection) -> Result<Self> {
        let camera = camera_entity(scene)?;
        let (width, height) = (frame.image.width, frame.image.height);
        let census = &Census::of(scene);
        let axes = CameraAxes::extract(census)?.world_from_camera;
        let PerspectiveCamera { fov, axis } = scene.get::<PerspectiveCamera>(camera).copied().unwrap_or_default();
        let half_height = scene.get::<OrthographicCamera>(camera).map(|camera| camera.view_height / 2.0);
        let shape = |body: AnyShape| {
            Some(match body {
                AnyShape::Sphere(PlacedSphere { centre, radius }, ()) => ExactShape::Sphere(Sphere { centre, radius }),
                AnyShape::Plane(PlacedPlane { normal, offset }, ()) => ExactShape::Plane(Plane { normal, offset }),
                AnyShape::Ellipsoid(ellipsoid, ()) => ExactShape::Ellipsoid(ellipsoid),
                AnyShape::Disk(disk, ()) => ExactShape::Disk(disk.planar),
                AnyShape::Rectangle(rectangle, ()) => ExactShape::Rectangle(rectangle.planar),
                AnyShape::Cuboid(slabs, ()) => ExactShape::Cuboid(slabs),
                AnyShape::Triangle(triangle, face) => ExactShape::Triangle(triangle, face.normal),
                _ => return None,
            })
        };
        let moves = ShapeTable::extract(census)?.kind.contains(&ShapeKind::Moving);
        let bodies = if moves { Vec::new() } else { any_shapes(census)? };
        let shapes = bodies.into_iter().map(shape).collect::<Option<Vec<_>>>().unwrap_or_default();
        Ok(Self { camera: ExactCamera::new(width, height, fov.0, axis, axes), half_height, shapes })
    }
}
