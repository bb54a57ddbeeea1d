//! The reader's function in the picture of chapter 09: the normals of scaled spheres.

use super::question::{Input, Vector};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{EllipsoidTable, ShapeTable};
use pinhole::intersect;
use pinhole::intersect::{Hits, ShapeRows, Surfaces};
use pinhole::plan::Shared;
use pinhole::rays::WorldRays;
use pinhole::shapes::Ellipsoid;
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Normals of ellipsoids, from those of the unit spheres that they are in object space.
pub fn mine(ask: Ask<Input, Vector>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        intersect::ellipsoid_surface_stage,
        move |ellipsoids: Res<Shared<EllipsoidTable>>,
              shapes: Res<Shared<ShapeTable>>,
              mut tiles: Query<(RowPlaces, &WorldRays, &Hits, &ShapeRows<Ellipsoid>, &mut Surfaces)>| {
            for (place, rays, hits, list, mut surfaces) in &mut tiles {
                for &row in &list.row {
                    let row = row as usize;
                    let ellipsoid = &ellipsoids.row[shapes.row[hits.shape[row] as usize] as usize];
                    let from_centre = rays.point_at(row, hits.t[row]) - ellipsoid.centre;
                    let own = (ellipsoid.unit_from_world * from_centre).normalize();
                    let map = ellipsoid.unit_from_world.inverse();
                    let columns = [map.x_axis, map.y_axis, map.z_axis].map(DVec3::into);
                    let Some(normal) = ask.at(place, row, (columns, own.into())) else { continue };
                    let mut surface = surfaces.get(row);
                    let outside = surface.normal.as_dvec3().dot(from_centre) >= 0.0;
                    let normal = DVec3::from(normal).as_vec3();
                    surface.normal = if outside { normal } else { -normal };
                    surfaces.set(row, surface);
                }
            }
        },
    )
}
