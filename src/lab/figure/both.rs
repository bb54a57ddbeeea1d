//! One scene by projection alone, by projection with rays from what is seen, and by rays alone.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use crate::measure::visibility::compare_visibility;
use crate::naive::both::globe;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::extract::{MeshTable, SphereTable, camera_entity};
use pinhole::film::{Curve, byte_from_linear};
use pinhole::intersect::{Hits, Surfaces};
use pinhole::plan::{Census, VectorRows};
use pinhole::rasterise::Projection;
use pinhole::rays::WorldRays;
use pinhole::render::{Execution, first_bounce_only, inspect, render};
use pinhole::scene::{
    DirectionalLight, Integrator, MeshInstance, Mirror, PointLight, Rasterisation, Resolution, Sampling, Sphere,
    SpotLight,
};
use pinhole::shapes::Shape;
use pinhole::{Chapter, Overrides, Result, stages};

/// Pixels of each picture.
const SIZE: [u32; 2] = [480, 270];
/// Triangles around each sphere of a scene that is projected alone.
const AROUND: u32 = 48;

const ORANGE: [f32; 3] = [0.9, 0.28, 0.03];
const BLUE: [f32; 3] = [0.05, 0.25, 0.7];
const GREEN: [f32; 3] = [0.08, 0.4, 0.12];
const DARK: [f32; 3] = [0.03, 0.03, 0.04];

/// The chapter with all stages, and its scene with a ray through the centre of each pixel.
fn through_centres(chapter: &Chapter) -> Result<(Chapter, World)> {
    let asked = Overrides { resolution: Some(Resolution { width: SIZE[0], height: SIZE[1] }), ..Overrides::default() };
    let mut whole = chapter.clone();
    (whole.view, whole.offer) = (None, stages::all());
    let mut scene = whole.world(&asked);
    let camera = camera_entity(&scene)?;
    scene.entity_mut(camera).remove::<Sampling>();
    Ok((whole, scene))
}

/// The radiance of each pixel after `change` has had the scene and its camera.
fn pixels(chapter: &Chapter, change: fn(&mut World, Entity)) -> Result<Vec<[f32; 3]>> {
    let (whole, mut scene) = through_centres(chapter)?;
    let camera = camera_entity(&scene)?;
    change(&mut scene, camera);
    let film = render(&scene, &whole.stages(), &Execution::default(), &())?.film;
    Ok(places().map(|[x, y]| film.mean(x, y)).collect())
}

/// Pixels line by line.
fn places() -> impl Iterator<Item = [u32; 2]> {
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]))
}

/// No shadow rays, nothing beyond the first surface, and triangles in place of spheres.
fn projected_alone(scene: &mut World, camera: Entity) {
    projected_with_shadows(scene, camera);
    scene.query::<&mut PointLight>().iter_mut(scene).for_each(|mut light| light.casts_shadows = false);
    scene.query::<&mut SpotLight>().iter_mut(scene).for_each(|mut light| light.casts_shadows = false);
    scene.query::<&mut DirectionalLight>().iter_mut(scene).for_each(|mut light| light.casts_shadows = false);
    let spheres: Vec<(Entity, f64)> =
        scene.query::<(Entity, &Sphere)>().iter(scene).map(|(entity, sphere)| (entity, sphere.radius)).collect();
    for (entity, radius) in spheres {
        scene.entity_mut(entity).remove::<Sphere>().insert(MeshInstance::new(globe(radius, AROUND)));
    }
}

fn projected_with_shadows(scene: &mut World, camera: Entity) {
    scene.entity_mut(camera).insert((Rasterisation, Integrator::RayCasting));
}

fn both(scene: &mut World, camera: Entity) {
    scene.entity_mut(camera).insert(Rasterisation);
}

fn by_rays(scene: &mut World, camera: Entity) {
    scene.entity_mut(camera).remove::<Rasterisation>();
}

/// In which pixels two pictures differ, as files of 8 bits hold them.
fn differ(one: &[[f32; 3]], other: &[[f32; 3]]) -> Vec<bool> {
    let bytes = |radiance: [f32; 3]| radiance.map(|part| byte_from_linear(part, Curve::Srgb));
    one.iter().zip(other).map(|(&one, &other)| bytes(one) != bytes(other)).collect()
}

fn percent(count: usize) -> String {
    format!("{:.1} %", 100.0 * count as f64 / f64::from(SIZE[0] * SIZE[1]))
}

fn count(marks: &[bool]) -> usize {
    marks.iter().filter(|mark| **mark).count()
}

/// By projection alone, with rays for one question after another, and by rays alone.
pub fn draw_alone(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let steps: [(&str, fn(&mut World, Entity)); 4] = [
        ("projection alone", projected_alone),
        ("true spheres, shadows by rays", projected_with_shadows),
        ("reflection and refraction too", both),
        ("rays alone", by_rays),
    ];
    let made = steps.map(|(_, change)| pixels(chapter, change)).into_iter().collect::<Result<Vec<_>>>()?;
    let exhibit = |((name, _), shown): (&(&str, _), &Vec<[f32; 3]>)| -> Result<Exhibit> {
        let apart = count(&differ(shown, &made[3]));
        let told = if *name == steps[3].0 { "every question by rays".into() } else { told(apart) };
        Ok(Exhibit { picture: Picture::painted(SIZE, shown)?, lines: vec![(*name).into(), told] })
    };
    let exhibits = steps.iter().zip(&made).map(exhibit).collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}

fn told(apart: usize) -> String {
    if apart < 200 {
        let (pixels, differ) = if apart == 1 { ("pixel", "differs") } else { ("pixels", "differ") };
        return format!("{apart} {pixels} {differ} from rays alone");
    }
    format!("{} of the pixels differ from rays alone", percent(apart))
}

/// What shadow rays, and reflected and refracted ones, add to projection; and where both classes together differ from
/// rays alone.
pub fn draw_difference(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    /// How far a mark reaches from its pixel.
    const MARK: u32 = 3;
    let [alone, shadowed, together, traced] =
        [projected_alone, projected_with_shadows, both, by_rays].map(|change| pixels(chapter, change));
    let (alone, shadowed, together, traced) = (alone?, shadowed?, together?, traced?);
    let (shadows, further) = (differ(&alone, &shadowed), differ(&shadowed, &together));
    let missing: Vec<[f32; 3]> = (0..traced.len())
        .map(|at| match (shadows[at], further[at]) {
            (_, true) => BLUE,
            (true, false) => ORANGE,
            _ => traced[at].map(|part| 0.25 * part),
        })
        .collect();
    let apart: Vec<[u32; 2]> =
        places().zip(together.iter().zip(&traced)).filter(|(_, (one, other))| one != other).map(|(at, _)| at).collect();
    let is_near = |[x, y]: [u32; 2]| apart.iter().any(|own| x.abs_diff(own[0]) <= MARK && y.abs_diff(own[1]) <= MARK);
    let marks: Vec<[f32; 3]> = places()
        .zip(&traced)
        .map(|(at, shown)| if is_near(at) { ORANGE } else { shown.map(|part| 0.25 * part) })
        .collect();
    let seen = compare_visibility(&mut through_centres(chapter)?.1)?;
    let explained = seen.at_edges + seen.at_equal_depth;
    let exhibits = [
        Exhibit {
            picture: Picture::painted(SIZE, &missing)?,
            lines: vec![
                "what rays add to projection".into(),
                format!("orange: spheres and shadows, {}", percent(count(&shadows))),
                format!("blue: reflection and refraction, {}", percent(count(&further))),
            ],
        },
        Exhibit {
            picture: Picture::painted(SIZE, &marks)?,
            lines: vec![
                "both together against rays alone".into(),
                format!("{} pixels differ in a bit, {} see another triangle", apart.len(), seen.differ),
                format!("{explained} of these within the rounding"),
            ],
        },
    ];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}

/// Where the image shows what a reflected ray hits.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    Shown,
    Hidden,
    Outside,
    Behind,
    Sky,
}

/// The mirror's pixels, by where the image would have what they show.
pub fn draw_mirrored(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let (whole, mut scene) = through_centres(chapter)?;
    let mirrors: Vec<MeshInstance> =
        scene.query_filtered::<&MeshInstance, With<Mirror>>().iter(&scene).cloned().collect();
    let Some(mirror) = mirrors.first() else { return Err(figure.unsuited("a mirror that is a mesh")) };
    let frame = inspect(&scene, &first_bounce_only(&whole.stages()), SIZE[0].max(SIZE[1]))?;
    let tile = frame.world.entity(frame.tiles[0]);
    let (Some(hits), Some(rays), Some(surfaces)) =
        (tile.get::<Hits>(), tile.get::<WorldRays>(), tile.get::<Surfaces>())
    else {
        return Err(figure.unsuited("a surface that a ray hits"));
    };
    let census = Census::of(&scene);
    let (projection, spheres) = (*census.table::<Projection>()?, census.table::<SphereTable>()?);
    let meshes = census.table::<MeshTable>()?;
    let number = meshes.row.iter().position(|mesh| mesh.geometry.is(&mirror.geometry));
    let Some(number) = number.map(|row| meshes.shape[row]) else { return Err(figure.unsuited("a mirror")) };
    let closest = |origin: DVec3, direction: DVec3| {
        let of_meshes = meshes.row.iter().zip(&meshes.shape).filter(|(_, shape)| **shape != number);
        let of_meshes = of_meshes.map(|(mesh, _)| mesh.closest(origin, direction).t);
        of_meshes.chain(spheres.row.iter().map(|sphere| sphere.t(origin, direction))).fold(f64::INFINITY, f64::min)
    };
    let place = |row: usize| {
        let [nx, ny, nz] = surfaces.normal.at(row).map(f64::from);
        let (normal, direction) = (DVec3::new(nx, ny, nz), rays.direction_of(row));
        let origin = rays.origin_of(row) + direction * hits.t[row];
        let reflected = direction - 2.0 * direction.dot(normal) * normal;
        let t = closest(origin, reflected);
        if t == f64::INFINITY {
            return Place::Sky;
        }
        let point = origin + reflected * t;
        let clip = projection.clip(point);
        if clip.w <= 0.0 {
            return Place::Behind;
        }
        let raster = projection.raster(clip);
        if raster.cmplt(DVec2::ZERO).any() || raster.cmpge(projection.size).any() {
            return Place::Outside;
        }
        // The surface in that pixel is a little nearer or farther than the point, where it is seen obliquely.
        let shown = raster.y as usize * SIZE[0] as usize + raster.x as usize;
        if point.length() <= 1.02 * hits.t[shown] { Place::Shown } else { Place::Hidden }
    };
    let of_row = |row: usize| (hits.shape[row] == number).then(|| place(row));
    let found: Vec<Option<Place>> = (0..hits.t.len()).map(of_row).collect();
    let all = found.iter().flatten().count().max(1);
    let part = |of: Place| {
        let own = found.iter().filter(|place| **place == Some(of)).count();
        format!("{:.0} %", 100.0 * own as f64 / all as f64)
    };
    let traced = pixels(chapter, by_rays)?;
    let painted: Vec<[f32; 3]> = found
        .iter()
        .zip(&traced)
        .map(|(place, shown)| match place {
            None => shown.map(|part| 0.25 * part),
            Some(Place::Shown) => GREEN,
            Some(Place::Hidden) => BLUE,
            Some(Place::Outside) => ORANGE,
            Some(Place::Behind) => DARK,
            Some(Place::Sky) => [0.6, 0.6, 0.58],
        })
        .collect();
    let exhibits = [
        Exhibit {
            picture: Picture::painted(SIZE, &traced)?,
            lines: vec!["what the mirror shows".into(), format!("{all} pixels"), "by one reflected ray each".into()],
        },
        Exhibit {
            picture: Picture::painted(SIZE, &painted)?,
            lines: vec![
                format!("grey: sky, {}; green: seen in the image, {}", part(Place::Sky), part(Place::Shown)),
                format!("blue: hidden behind something, {}", part(Place::Hidden)),
                format!("orange: beside the image, {}", part(Place::Outside)),
                format!("black: behind the eye, {}", part(Place::Behind)),
            ],
        },
    ];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}
