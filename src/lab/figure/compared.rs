//! A chapter's scene several times, side by side: by several integrators, with other materials, and with one mistake each.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use crate::naive::caustics::join_without_cosine;
use crate::naive::mesh::directions_normalised_in_object_space;
use crate::naive::mistake::{
    MatteSample, glass_that_keeps_beams_narrow, light_samples_counted_in_full, light_without_cosine,
    light_without_jacobian, metal_counted_as_matte, scatter_matte_by, sky_in_all_directions_alike,
};
use crate::naive::path::{uniform_direction, weight_without_cosine, weight_without_pi};
use crate::naive::ways::{Way, only};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::material::cosine_direction;
use pinhole::models::TriangleMesh;
use pinhole::plan::Stage;
use pinhole::scene::{
    BidirectionalPathTracing, Cuboid, Degrees, Emissive, Exposure, FovAxis, Glass, Integrator, LightStrategy,
    LightTracing, LookAt, Matte, Medium, MeshGeometry, MeshInstance, Metal, Mirror, NormalMap, PerspectiveCamera,
    PhotonMapping, Placement, Plane, Principled, Rgb, RoughGlass, Sampler, Sampling, Sphere, SpotLight,
};
use pinhole::{Chapter, Result};

/// Three in a row.
const SMALL: [u32; 2] = [276, 155];
/// Two in a row.
pub(super) const LARGE: [u32; 2] = [384, 216];

pub(super) fn exhibit(picture: Result<Picture>, lines: [&str; 2]) -> Result<Exhibit> {
    Ok(Exhibit { picture: picture?, lines: lines.map(str::to_owned).to_vec() })
}

/// Exhibits of one size in rows.
pub(super) fn rows<const N: usize>(
    chapter: &Chapter,
    figure: &Figure,
    size: [u32; 2],
    exhibits: [Result<Exhibit>; N],
) -> Result<Drawing> {
    let exhibits = exhibits.into_iter().collect::<Result<Vec<Exhibit>>>()?;
    let columns = if size == LARGE || N == 2 { 2 } else { 3 };
    Ok(hang(figure, &exhibits, columns, &gallery_foot(chapter, figure, size)))
}

/// So many samples a pixel, of this seed.
pub(super) fn sampled(samples: u32, seed: u64) -> impl Fn(&mut EntityWorldMut<'_>) + Copy {
    move |camera| {
        camera.insert(Sampling { samples, seed, ..Sampling::default() });
    }
}

/// The chapter's scene by an integrator, with so many samples.
fn integrated(
    chapter: &Chapter,
    size: [u32; 2],
    samples: u32,
    integrator: Integrator,
    lines: [&str; 2],
) -> Result<Exhibit> {
    let change = |camera: &mut EntityWorldMut<'_>| {
        sampled(samples, 22)(camera);
        camera.insert(integrator);
    };
    exhibit(Picture::of(chapter, size, None, change), lines)
}

/// What is near hides the sky, then what is farther too.
pub fn draw_distance(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |distance, lines| integrated(chapter, SMALL, 16, Integrator::AmbientOcclusion { distance }, lines);
    let exhibits = [
        of(0.25, ["distance 0.25", "only creases are dark"]),
        of(1.0, ["distance 1", "what is near darkens"]),
        of(f64::INFINITY, ["no distance", "all that hides the sky"]),
    ];
    rows(chapter, figure, SMALL, exhibits)
}

/// Ray casting beside paths of more and more segments.
pub fn draw_segments(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let paths = |max_depth| Integrator::Path { max_depth, lights: LightStrategy::Mis, roulette: 5 };
    let of = |integrator, lines| integrated(chapter, LARGE, 12, integrator, lines);
    let exhibits = [
        of(Integrator::RayCasting, ["ray casting", "the lamp is seen, and lights nothing"]),
        of(paths(2), ["paths of 2 segments", "light to surface to eye"]),
        of(paths(3), ["paths of 3 segments", "off one more surface"]),
        of(paths(1 << 20), ["paths of any length", "all the light there is"]),
    ];
    rows(chapter, figure, LARGE, exhibits)
}

/// Three strategies for the same lights.
pub fn draw_strategies(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |lights, lines| {
        let integrator = Integrator::Path { max_depth: 2, lights, roulette: 0 };
        integrated(chapter, LARGE, 16, integrator, lines)
    };
    let exhibits = [
        of(LightStrategy::Bsdf, ["BSDF sampling", "as the metal sends light on"]),
        of(LightStrategy::Light, ["light sampling", "points on the lights"]),
        of(LightStrategy::Mis, ["MIS", "both, each where its pdf is high"]),
    ];
    rows(chapter, figure, LARGE, exhibits)
}

/// A spotlight that shines on a ball and past it.
fn beam(world: &mut World) {
    let look = LookAt { eye: DVec3::new(0.0, 1.4, 5.0), target: DVec3::new(0.0, 1.0, 0.0), ..LookAt::default() };
    let camera = PerspectiveCamera { fov: Degrees(32.0), axis: FovAxis::Vertical };
    world.spawn((camera, look, Integrator::Path { max_depth: 4, lights: LightStrategy::Mis, roulette: 0 }));
    world.spawn((Plane::default(), Matte { colour: Rgb::grey(0.4) }));
    let clay = Matte { colour: Rgb::new(0.8, 0.3, 0.15) };
    world.spawn((Sphere { radius: 0.28 }, Placement::at(-0.2, 1.15, 0.0), clay));
    let from = LookAt { eye: DVec3::new(-2.4, 2.6, 0.0), target: DVec3::new(0.8, 0.5, 0.0), ..LookAt::default() };
    let light = SpotLight {
        intensity: Rgb::new(90.0, 81.0, 66.0),
        inner_angle: Degrees(20.0),
        outer_angle: Degrees(24.0),
        casts_shadows: true,
    };
    world.spawn((light, from));
}

/// The same, with a ball of glass and paths from the light.
fn bent_beam(world: &mut World) {
    beam(world);
    let mut balls = world.query_filtered::<Entity, With<Sphere>>();
    let balls: Vec<Entity> = balls.iter(world).collect();
    balls.into_iter().for_each(|ball| _ = world.entity_mut(ball).remove::<Matte>().insert(Glass::default()));
    let mut cameras = world.query_filtered::<Entity, With<PerspectiveCamera>>();
    let cameras: Vec<Entity> = cameras.iter(world).collect();
    let integrator = Integrator::Path { max_depth: 6, lights: LightStrategy::Mis, roulette: 0 };
    let both_ends = (integrator, BidirectionalPathTracing::default());
    cameras.into_iter().for_each(|camera| _ = world.entity_mut(camera).insert(both_ends));
}

/// A spotlight's beam without fog, with it, and through glass in it.
pub fn draw_fog(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |scene: fn(&mut World), (scattering, samples): (f64, u32), line: &str| {
        let change = |camera: &mut EntityWorldMut<'_>| {
            sampled(samples, 25)(camera);
            if scattering > 0.0 {
                camera.insert(Medium { scattering: Rgb::grey(scattering), ..Medium::default() });
            }
        };
        let scene = chapter.clone().with_scene(scene);
        exhibit(Picture::of(&scene, SMALL, None, change), [line, &format!("*σ*ₛ = {scattering}")])
    };
    let exhibits =
        [of(beam, (0.0, 4), "no fog"), of(beam, (0.15, 24), "fog"), of(bent_beam, (0.15, 10), "glass, from both ends")];
    rows(chapter, figure, SMALL, exhibits)
}

/// A pool, with a ball and a buoy in it, and a lamp above.
fn pool(world: &mut World) {
    let look = LookAt { eye: DVec3::new(0.0, 4.2, 6.4), target: DVec3::new(0.0, 0.0, 0.2), ..LookAt::default() };
    let camera = PerspectiveCamera { fov: Degrees(36.0), axis: FovAxis::Vertical };
    world.spawn((camera, look, Integrator::PATH));
    let ground = Matte { colour: Rgb::new(0.55, 0.65, 0.7) };
    world.spawn((Plane::default(), Placement::at(0.0, -1.0, 0.0), ground));
    let wall = Matte { colour: Rgb::new(0.7, 0.68, 0.65) };
    for ([x, z], [width, depth]) in
        [([0.0, -2.15], [5.2, 0.3]), ([0.0, 2.15], [5.2, 0.3]), ([-2.45, 0.0], [0.3, 4.0]), ([2.45, 0.0], [0.3, 4.0])]
    {
        world.spawn((Cuboid { size: DVec3::new(width, 1.2, depth) }, Placement::at(x, -0.4, z), wall));
    }
    let water = Glass { ior: 1.33, absorption: Rgb::new(0.25, 0.05, 0.03), ..Glass::default() };
    // It reaches into the walls and into the ground.
    world.spawn((Cuboid { size: DVec3::new(4.7, 0.9, 4.1) }, Placement::at(0.0, -0.55, 0.0), water));
    let ball = Glass { priority: 1, ..Glass::default() };
    world.spawn((Sphere { radius: 0.45 }, Placement::at(0.9, -0.2, 0.1), ball));
    let buoy = Matte { colour: Rgb::new(0.9, 0.3, 0.1) };
    world.spawn((Sphere { radius: 0.35 }, Placement::at(-0.9, -0.1, 0.4), buoy));
    let emissive = Emissive { radiance: Rgb::new(2700.0, 2550.0, 2250.0), ..Emissive::default() };
    world.spawn((Sphere { radius: 0.12 }, Placement::at(-1.6, 4.0, -1.0), emissive));
}

/// The ground of a pool by each method for caustics, at the same number of samples.
pub fn draw_photons(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let pool = chapter.clone().with_scene(pool);
    let of = |change: &dyn Fn(&mut EntityWorldMut<'_>), lines| {
        let change = |camera: &mut EntityWorldMut<'_>| {
            sampled(12, 27)(camera);
            change(camera);
        };
        exhibit(Picture::of(&pool, SMALL, None, change), lines)
    };
    let exhibits = [
        of(&|_| {}, ["path tracing", "few paths hit the lamp"]),
        of(&|camera| _ = camera.insert(LightTracing::default()), ["light tracing", "no line passes the water"]),
        of(&|camera| _ = camera.insert(PhotonMapping::default()), ["photon mapping", "paths that end near each other"]),
    ];
    rows(chapter, figure, SMALL, exhibits)
}

/// The camera's rays alone and with rays from the lights, at the same number of samples.
pub fn draw_sides(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |replaced: Option<Stage>, traced: Option<f64>, lines| {
        let change = |camera: &mut EntityWorldMut<'_>| {
            sampled(4, 27)(camera);
            camera.insert(Integrator::PATH);
            match traced {
                Some(paths) => camera.insert(LightTracing { paths }),
                None => camera.remove::<LightTracing>(),
            };
        };
        exhibit(Picture::replacing(chapter, LARGE, replaced, change), lines)
    };
    let exhibits = [
        of(None, None, ["from the camera alone", "few rays hit the light"]),
        of(None, Some(1.0), ["from the lamp too", "as many rays again"]),
        of(None, Some(8.0), ["more from the lamp", "eight for each of the camera"]),
        of(Some(join_without_cosine()), Some(1.0), ["the cosine forgotten", "too bright where seen grazingly"]),
    ];
    rows(chapter, figure, LARGE, exhibits)
}

/// Puts a component on each entity that has one of these names, in the place of a material that it had.
fn on_named<C: Component + Clone>(camera: &mut EntityWorldMut<'_>, components: &[(&str, C)]) {
    camera.world_scope(|world| {
        let mut named = world.query::<(Entity, &Name)>();
        let own = |name: &Name| components.iter().find(|(own, _)| *own == name.as_str()).map(|(_, own)| own.clone());
        let found: Vec<(Entity, C)> =
            named.iter(world).filter_map(|(entity, name)| Some((entity, own(name)?))).collect();
        for (entity, component) in found {
            world.entity_mut(entity).insert(component);
        }
    });
}

/// The chapter's scene by paths, with these materials in place of what the named entities are made of.
fn made_of<M: Component + Clone>(chapter: &Chapter, materials: &[(&str, M)], lines: [&str; 2]) -> Result<Exhibit> {
    let picture = Picture::of(chapter, SMALL, None, |camera| {
        camera.insert((Integrator::PATH, Sampling { samples: 16, ..Sampling::default() }));
        camera.world_scope(|world| {
            let mut named = world.query::<(Entity, &Name)>();
            let is_one = |name: &Name| materials.iter().any(|(own, _)| *own == name.as_str());
            let found: Vec<Entity> =
                named.iter(world).filter(|(_, name)| is_one(name)).map(|(entity, _)| entity).collect();
            found.into_iter().for_each(|entity| _ = world.entity_mut(entity).remove::<(Glass, Metal, Mirror)>());
        });
        on_named(camera, materials);
    });
    exhibit(picture, lines)
}

/// The glass ball, rougher and rougher.
pub fn draw_rough_glass(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |roughness: f64, line: &str| {
        let material = RoughGlass { roughness, ..RoughGlass::default() };
        made_of(chapter, &[("ball", material)], [&format!("*α* = {roughness}"), line])
    };
    let exhibits = [
        of(0.02, "nearly smooth"),
        of(0.15, "frosted: what is behind is blurred"),
        of(0.5, "rough: only light comes through"),
    ];
    rows(chapter, figure, SMALL, exhibits)
}

/// The three balls as dielectric, as a mixture, and as metal, each rougher from left to right.
pub fn draw_principled(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |metallic: f64, line: &str| {
        let base_colour = Rgb::new(0.9, 0.35, 0.15);
        let material = |roughness| Principled { base_colour, metallic, roughness, ..Principled::default() };
        let balls = [("smooth ball", 0.1), ("brushed ball", 0.4), ("rough ball", 0.8)];
        let materials = balls.map(|(name, roughness)| (name, material(roughness)));
        made_of(chapter, &materials, [&format!("metallic {metallic}"), line])
    };
    let exhibits =
        [of(0.0, "coloured below a clear surface"), of(0.5, "half of each"), of(1.0, "coloured by its surface")];
    rows(chapter, figure, SMALL, exhibits)
}

/// The room by paths from the camera, and in the same time by paths from both ends.
pub fn draw_ends(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let alone = Picture::of(chapter, LARGE, None, |camera| {
        sampled(24, 39)(camera);
        camera.remove::<BidirectionalPathTracing>();
    });
    let both = Picture::of(chapter, LARGE, None, sampled(6, 39));
    let exhibits = [
        exhibit(alone, ["path tracing, 24 samples", "few paths find the keyhole"]),
        exhibit(both, ["from both ends, 6 samples", "about the same time"]),
    ];
    rows(chapter, figure, LARGE, exhibits)
}

/// The light of each kind of way, weighted, which add up to the picture.
pub fn draw_ways(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |way, lines| exhibit(Picture::beside(chapter, SMALL, Some(only(way)), sampled(6, 39)), lines);
    let exhibits = [
        of(Way::LightSamples, ["light samples", "0 steps from the lamp"]),
        of(Way::Joins, ["joined vertices", "1 step from either end, or more"]),
        of(Way::ToTheCamera, ["connected to the camera", "0 steps from the camera"]),
    ];
    rows(chapter, figure, SMALL, exhibits)
}

/// The chapter's scene with its studs level, half as high, and as they are.
pub fn draw_relief(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |scale: f64, line: &str| {
        let map = NormalMap { file: "studs.hdr".into(), scale, size: 0.5, ..NormalMap::default() };
        let picture = Picture::of(chapter, SMALL, None, |camera| {
            camera.insert(Sampling::default());
            on_named(camera, &["ball", "panel", "block"].map(|name| (name, map.clone())));
        });
        exhibit(picture, [&format!("scale {scale}"), line])
    };
    let exhibits = [of(0.0, "the surfaces as they are"), of(0.5, "a shallow relief"), of(1.0, "the map as it is")];
    rows(chapter, figure, SMALL, exhibits)
}

/// The pdf of a light as it should be; without the light's cosine; without distance and cosine.
pub fn draw_jacobian(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SIZE: [u32; 2] = [276, 184];
    let change = Sampling { samples: 16, seed: 21, sampler: Sampler::Sobol, ..Sampling::default() };
    let of = |forget: Option<Stage>, stops, lines| {
        let picture = Picture::beside(chapter, SIZE, forget, |camera| {
            camera.insert((change, Exposure { stops, automatic: false }));
        });
        exhibit(picture, lines)
    };
    // Without the distance the floor is some thirty times too bright.
    let exhibits = [
        of(None, 0.0, ["*d*² / (*A* cos *θ*ₗ)", "as it should be"]),
        of(Some(light_without_cosine()), 0.0, ["*d*² / *A*", "without the cosine"]),
        of(Some(light_without_jacobian()), -5.0, ["1 / *A*, shown 32 times darker", "without distance and cosine"]),
    ];
    rows(chapter, figure, SIZE, exhibits)
}

/// As it should be.
fn right(chapter: &Chapter, samples: u32) -> Result<Exhibit> {
    exhibit(Picture::of(chapter, SMALL, None, sampled(samples, 19)), ["right", "as it should be"])
}

/// Rough metal, and by the wrong pdf.
pub fn draw_metal(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let spoiled = Picture::beside(chapter, SMALL, Some(metal_counted_as_matte()), sampled(8, 19));
    let wrong = exhibit(spoiled, ["the wrong pdf", "microfacets sampled, a matte pdf"]);
    rows(chapter, figure, SMALL, [right(chapter, 8), wrong])
}

/// Right, and with another stage in the place of those that do the same.
fn replaced(chapter: &Chapter, figure: &Figure, samples: u32, stage: Stage, lines: [&str; 2]) -> Result<Drawing> {
    let wrong = exhibit(Picture::of(chapter, SMALL, Some(stage), sampled(samples, 19)), lines);
    rows(chapter, figure, SMALL, [right(chapter, samples), wrong])
}

/// A sky without the cosine.
pub fn draw_sky(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let lines = ["the missing cosine", "light that grazes counts in full"];
    replaced(chapter, figure, 16, sky_in_all_directions_alike(), lines)
}

/// Two ways to find a light, both counted.
pub fn draw_weights(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let lines = ["light samples without a weight", "found twice, counted twice"];
    replaced(chapter, figure, 8, light_samples_counted_in_full(), lines)
}

/// Glass that bends the wrong way, and glass that keeps beams narrow.
pub fn draw_glass(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let upside_down = |camera: &mut EntityWorldMut<'_>| {
        sampled(2, 19)(camera);
        camera.world_scope(|world| {
            world.query::<&mut Glass>().iter_mut(world).for_each(|mut glass| glass.ior = 1.0 / glass.ior);
        });
    };
    let narrow = Picture::beside(chapter, SMALL, Some(glass_that_keeps_beams_narrow()), sampled(2, 19));
    let exhibits = [
        right(chapter, 2),
        exhibit(Picture::of(chapter, SMALL, None, upside_down), ["*η* upside down", "as if air were the denser"]),
        exhibit(narrow, ["*η*² forgotten on the way out", "beams stay narrow, and dark"]),
    ];
    rows(chapter, figure, SMALL, exhibits)
}

/// Paths whose surfaces send on too much or too little, and a picture encoded twice.
pub fn draw_paths(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    // So few segments that what grows at each of them is still a picture.
    const MAX_DEPTH: u32 = 4;
    let change = |camera: &mut EntityWorldMut<'_>| {
        sampled(4, 25)(camera);
        camera.insert(Integrator::Path { max_depth: MAX_DEPTH, lights: LightStrategy::Light, roulette: 0 });
    };
    let uniform = |u| DVec3::from(uniform_direction(u));
    let by = |direction: fn([f64; 2]) -> DVec3, weight: fn(f64, f64) -> f64, lines: [&str; 2]| {
        let stage = scatter_matte_by(MatteSample { direction, weight });
        exhibit(Picture::of(chapter, SMALL, Some(stage), change), lines)
    };
    let exhibits = [
        exhibit(Picture::of(chapter, SMALL, None, change), ["right", &format!("{MAX_DEPTH} segments")]),
        by(uniform, |albedo, _| weight_without_cosine(albedo), ["the missing cosine", "twice what it may"]),
        by(cosine_direction, |albedo, _| weight_without_pi(albedo), ["the forgotten π", "π times too much"]),
        by(uniform, |albedo, _| albedo, ["the wrong pdf", "uniform, counted as cosine-weighted"]),
        by(cosine_direction, |albedo, cosine| albedo * cosine, ["the cosine twice", "a third is lost"]),
        exhibit(Picture::encoded_twice(chapter, SMALL, change), ["gamma twice", "light is right, bytes are not"]),
    ];
    rows(chapter, figure, SMALL, exhibits)
}

/// Meshes; with directions normalised in object space; with normals taken to the world as directions are.
pub fn draw_meshes(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let normalised = directions_normalised_in_object_space();
    let normalised = Picture::replacing(chapter, SMALL, Some(normalised), sampled(8, 28));
    let leaning = Picture::of(chapter, SMALL, None, with_normals_as_directions);
    let exhibits = [
        exhibit(Picture::of(chapter, SMALL, None, sampled(8, 28)), ["right", "one t for all"]),
        exhibit(normalised, ["direction normalised", "each mesh counts t in its own unit"]),
        exhibit(leaning, ["normals like directions", "look left of the spire's ribs"]),
    ];
    rows(chapter, figure, SMALL, exhibits)
}

/// Gives each unevenly scaled mesh the normals that pinhole's map of normals takes where the map of directions takes
/// those that it had.
fn with_normals_as_directions(camera: &mut EntityWorldMut<'_>) {
    sampled(8, 28)(camera);
    camera.world_scope(|world| {
        for (mut mesh, placement) in world.query::<(&mut MeshInstance, &Placement)>().iter_mut(world) {
            if placement.scale.min_element() < placement.scale.max_element() {
                let spoilt = scaled_normals(&mesh.geometry, placement.scale * placement.scale);
                mesh.geometry = MeshGeometry::new(spoilt);
            }
        }
    });
}

fn scaled_normals(mesh: &TriangleMesh, by: DVec3) -> TriangleMesh {
    let mut mesh = mesh.clone();
    for normal in mesh.normals.iter_mut().flatten() {
        *normal = (DVec3::from(normal.map(f64::from)) * by).normalize_or_zero().as_vec3().to_array();
    }
    mesh
}
