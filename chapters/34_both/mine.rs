//! The reader's function in the picture of chapter 34: in which pixels spheres are looked for.

use super::question::Input;
use bevy_ecs::prelude::*;
use glam::DVec2;
use pinhole::extract::SphereTable;
use pinhole::intersect::Hits;
use pinhole::plan::{Column, Shared};
use pinhole::rasterise::{Projection, box_stage};
use pinhole::rays::WorldRays;
use pinhole::shapes::{PlacedSphere, Shape};
use pinhole_lab::exercise::{Ask, Setting, StandIn};
use std::sync::{Arc, OnceLock};

/// The least and greatest x and y of the image plane at distance 1 at which a sphere is looked for.
type Rectangle = [DVec2; 2];

/// Spheres in their rectangles on the image, whose sides the reader's function gives.
pub fn mine(ask: Ask<Input, [f64; 2]>, _: &Setting<'_>) -> StandIn {
    let kept: Arc<OnceLock<Vec<Rectangle>>> = Arc::default();
    StandIn::instead(
        box_stage::<PlacedSphere>,
        move |projection: Res<Shared<Projection>>,
              spheres: Res<Shared<SphereTable>>,
              mut tiles: Query<(&WorldRays, &mut Hits)>| {
            let rectangles = kept.get_or_init(|| {
                let on_image = |sphere: &PlacedSphere| rectangle(&ask, &projection, sphere);
                spheres.row.iter().map(on_image).collect()
            });
            for (rays, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    let [origin, direction] = [rays.origin_of(row), rays.direction_of(row)];
                    let camera = projection.camera_from_world * direction;
                    let at = DVec2::new(camera.x, camera.y) / -camera.z;
                    for ((sphere, [low, high]), &shape) in spheres.row.iter().zip(rectangles).zip(&spheres.shape) {
                        if !(at.cmpge(*low) & at.cmple(*high)).all() {
                            continue;
                        }
                        let t = sphere.t(origin, direction);
                        if t < hits.t[row] {
                            (hits.t[row], hits.shape[row]) = (t, shape);
                        }
                    }
                }
            }
        },
    )
}

/// The rectangle of one sphere: one interval for its width, one for its height.
fn rectangle(ask: &Ask<Input, [f64; 2]>, projection: &Projection, sphere: &PlacedSphere) -> Rectangle {
    let centre = projection.camera_from_world * sphere.centre;
    let nowhere = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    if -centre.z <= -sphere.radius {
        return nowhere;
    }
    let ends = |axis: usize| ask.once([centre[axis], -centre.z, sphere.radius, projection.half[axis]]);
    let (Some([left, right]), Some([low, high])) = (ends(0), ends(1)) else { return nowhere };
    // A ray in f32 may be a hair beside the sample that it was made for.
    let hair = f64::from(f32::EPSILON) * projection.half;
    [DVec2::new(left, low) - hair, DVec2::new(right, high) + hair]
}
