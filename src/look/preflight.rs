use crate::extract::{
    CuboidTable, ImageShape, ShapeTable, SphereTable, area_light_evidence, emissive_evidence, followed_evidence,
    glass_evidence, integrator_of, mirror_evidence, traced_evidence,
};
use crate::intersect::{Hits, NO_SHAPE};
use crate::plan::{Column, Evidence, Plan, Stage, Table};
use crate::rays::{Leg, Tile};
use crate::render::{Execution, Hook, inspect_tile};
use crate::scene::{DirectionalLight, Integrator};
use crate::shade::{LightRays, Radiance, ShadowHits, point_evidence};
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// From this share of the rays on a picture counts as black or white.
const NEARLY_ALL: f64 = 0.95;
/// From this share on it is said that highlights are lost.
const MANY: f64 = 0.25;

/// What a few rays of the picture to come have met and brought back.
#[derive(Resource, Clone, Debug, Default)]
struct Pilot {
    rays: usize,
    met: usize,
    black: usize,
    beyond_white: usize,
    to_lights: usize,
    blocked: BTreeMap<u32, usize>,
}

/// Says why the picture of a scene is likely to be black or white, or to miss light, before it is rendered: a sentence
/// each.
///
/// Where the plan makes a picture of light, one sample of a few tiles is traced for it.
/// Errors: what the render would be refused for.
pub fn preflight(scene: &World, offer: &[Stage], plan: &Plan) -> Result<Vec<String>> {
    if plan.view.is_some() {
        return Ok(Vec::new());
    }
    let mut told = Vec::new();
    let pilot = pilot(scene, offer)?;
    let shapes = ShapeTable::extract(scene).map_err(Error::from)?;
    let share = |count: usize| count as f64 / pilot.rays.max(1) as f64;
    let inside = shape_around_camera(scene, &shapes)?;
    if share(pilot.black) >= NEARLY_ALL {
        told.push(format!("the picture is likely to be black: {}", why_black(scene, &pilot, &shapes)));
    }
    if let Some(name) = inside {
        told.push(format!("the camera is inside the {name}, and sees it from within"));
    }
    if share(pilot.beyond_white) >= MANY {
        let percent = 100.0 * share(pilot.beyond_white);
        told.push(format!(
            "{percent:.0} % of the rays tried bring back more than white, which a PNG cuts off: the EXR keeps it, and \
             dimmer lights avoid it"
        ));
    }
    told.extend(out_of_reach(scene));
    Ok(told)
}

fn why_black(scene: &World, pilot: &Pilot, shapes: &ShapeTable) -> String {
    let lit = lights(scene);
    let blocked: usize = pilot.blocked.values().sum();
    if pilot.met == 0 {
        return format!("none of {} rays meets a shape, and there is no background with a colour", pilot.rays);
    }
    if !lit.needed {
        return "there is no light, no surface that emits, and no background with a colour".into();
    }
    if pilot.to_lights == 0 {
        return format!("what the camera sees faces away from every light ({})", lit.reason);
    }
    if blocked == pilot.to_lights {
        let most = pilot.blocked.iter().max_by_key(|(_, count)| **count);
        let name = most.and_then(|(&shape, _)| shapes.name.get(shape as usize)).cloned().unwrap_or_default();
        return format!("each of {blocked} rays to lights is blocked, most of them by the {name}");
    }
    format!("so little light arrives ({}) that nearly all of it is below what can be seen", lit.reason)
}

/// Evidence of any light, with an area or without.
fn lights(scene: &World) -> Evidence {
    point_evidence(scene).or(emissive_evidence(scene))
}

/// What the integrator cannot find in this scene at all.
fn out_of_reach(scene: &World) -> Vec<String> {
    let (points, bends) = (point_evidence(scene), glass_evidence(scene).or(mirror_evidence(scene)));
    if !(points.needed && bends.needed && followed_evidence(scene).needed) {
        return Vec::new();
    }
    let traced = traced_evidence(scene).needed;
    let directional = Evidence::of::<DirectionalLight>(scene, "directional light");
    let mut told = Vec::new();
    if !traced {
        told.push(format!(
            "light that comes by way of mirrors or glass ({}) from a light without an area ({}) is missing from matte \
             surfaces, for no ray meets a point; LightTracing on the camera, beside paths, finds it from the light",
            bends.reason, points.reason
        ));
    } else if directional.needed {
        told.push(format!(
            "no rays start on lights without a place ({}): what comes from there by way of mirrors or glass is missing",
            directional.reason
        ));
    }
    let by_chance = matches!(integrator_of(scene).integrator, Integrator::Whitted { .. });
    if by_chance && area_light_evidence(scene).needed {
        told.push("Whitted's rays light nothing by surfaces that emit; a path does".into());
    }
    told
}

/// The shape that holds the camera, by its name.
fn shape_around_camera(scene: &World, shapes: &ShapeTable) -> Result<Option<String>> {
    let spheres = SphereTable::extract(scene)?;
    let within = |row: &usize| spheres.centre(*row).length() < spheres.radius[*row];
    let sphere = (0..spheres.radius.len()).find(within).map(|row| spheres.shape[row]);
    let cuboids = CuboidTable::extract(scene)?;
    let within = |row: &usize| cuboids.slabs[*row].holds_the_eye();
    let cuboid = (0..cuboids.slabs.len()).find(within).map(|row| cuboids.shape[row]);
    Ok(sphere.or(cuboid).and_then(|shape| shapes.name.get(shape as usize).cloned()))
}

/// One sample of the tiles in the middle and near the corners.
fn pilot(scene: &World, offer: &[Stage]) -> Result<Pilot> {
    let image = ImageShape::extract(scene)?;
    let mut sum = Pilot::default();
    let at = |share: [u32; 2]| [image.width * share[0] / 8, image.height * share[1] / 8];
    let mut tiles: Vec<[u32; 2]> = [[4, 4], [1, 1], [6, 1], [1, 6], [6, 6]].map(at).to_vec();
    let side = Execution::default().tile_side;
    tiles.sort_by_key(|[x, y]| [x / side, y / side]);
    tiles.dedup_by_key(|[x, y]| [*x / side, *y / side]);
    for pixel in tiles {
        let mut found = inspect_tile(scene, offer, pixel, 0, &[counting_hook()])?;
        let counted = found.world.remove_resource::<Pilot>().unwrap_or_default();
        sum.met += counted.met;
        sum.to_lights += counted.to_lights;
        counted.blocked.into_iter().for_each(|(shape, count)| *sum.blocked.entry(shape).or_default() += count);
        for tile in found.tiles {
            let Some(radiance) = found.world.get::<Radiance>(tile) else { continue };
            let (r, g, b) = radiance.slices();
            sum.rays += radiance.rows();
            // Half of the smallest step of a PNG near black.
            let dark = |row: &usize| r[*row].max(g[*row]).max(b[*row]) < 1.5e-4;
            sum.black += (0..radiance.rows()).filter(dark).count();
            sum.beyond_white += (0..radiance.rows()).filter(|&row| r[row].min(g[row]).min(b[row]) > 1.0).count();
        }
    }
    Ok(sum)
}

/// Counts on the first leg what was met, and which rays to lights are blocked.
fn counting_hook() -> Hook {
    Arc::new(|_, stage: &Stage, _| {
        let [hits, shadows] =
            [Hits::NAME, ShadowHits::NAME].map(|name| stage.writes.iter().any(|column| column.name == name));
        let count = move |world: &mut World,
                          tiles: &mut QueryState<
            (&Leg, Option<&Hits>, Option<(&LightRays, &ShadowHits)>),
            With<Tile>,
        >| {
            if !(hits || shadows) {
                return;
            }
            let mut pilot = world.remove_resource::<Pilot>().unwrap_or_default();
            for (leg, met, light) in tiles.iter(world) {
                if leg.0 > 0 {
                    continue;
                }
                if let (true, Some(met)) = (hits, met) {
                    pilot.met = met.shape.iter().filter(|&&shape| shape != NO_SHAPE).count();
                }
                if let (true, Some((rays, shadows))) = (shadows, light) {
                    pilot.to_lights = rays.rows();
                    pilot.blocked.clear();
                    for &shape in shadows.shape.iter().filter(|&&shape| shape != NO_SHAPE) {
                        *pilot.blocked.entry(shape).or_default() += 1;
                    }
                }
            }
            world.insert_resource(pilot);
        };
        count.into_configs()
    })
}
