//! What projection has to be told: triangles in place of a sphere, the rectangle in which a sphere is to be looked for; and
//! cameras that it refuses.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::label::Label;
use super::pen::{Pen, WIDTH};
use super::picture::Picture;
use super::svg::{Drawing, Svg};
use crate::naive::both::{globe, interval_at_its_depth, sphere_interval};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::extract::{camera_entity, eye, tan_half, world_from_entity};
use pinhole::intersect::Hits;
use pinhole::plan::Census;
use pinhole::render::{first_bounce_only, inspect};
use pinhole::scene::{
    Aperture, Degrees, FisheyeCamera, FovAxis, Lens, LookAt, Matte, MeshInstance, Motion, PerspectiveCamera, Placement,
    Rasterisation, Resolution, Sampling, Shutter, Sphere,
};
use pinhole::{Chapter, Overrides, Result, stages};

/// A sphere of the scene that is not transparent, and where it is in world space.
#[derive(Clone, Copy)]
struct Ball {
    entity: Entity,
    radius: f64,
    centre: DVec3,
}

fn ball(chapter: &Chapter, figure: &Figure) -> Result<Ball> {
    let mut scene = chapter.world(&Overrides::default());
    let mut found = scene.query_filtered::<(Entity, &Sphere, &Placement), With<Matte>>();
    let found = found.iter(&scene).next().map(|(entity, sphere, placement)| Ball {
        entity,
        radius: sphere.radius,
        centre: placement.position,
    });
    found.ok_or_else(|| figure.unsuited("a matte sphere"))
}

/// Which shape each pixel's ray hits.
fn shapes_seen(chapter: &Chapter, size: [u32; 2], change: impl FnOnce(&mut World, Entity)) -> Result<Vec<u32>> {
    let [width, height] = size;
    let asked = Overrides { resolution: Some(Resolution { width, height }), ..Overrides::default() };
    let mut whole = chapter.clone();
    (whole.view, whole.offer) = (None, stages::all());
    let mut scene = whole.world(&asked);
    let camera = camera_entity(&scene)?;
    scene.entity_mut(camera).remove::<(Sampling, Rasterisation)>();
    change(&mut scene, camera);
    let frame = inspect(&scene, &first_bounce_only(&whole.stages()), width.max(height))?;
    let hits = frame.world.entity(frame.tiles[0]).get::<Hits>();
    Ok(hits.map(|hits| hits.shape.clone()).unwrap_or_default())
}

/// A sphere as few, more and many triangles, and as what it is.
pub fn draw_tessellated(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SIZE: [u32; 2] = [226, 226];
    let ball = ball(chapter, figure)?;
    let eye = eye(&Census::of(&chapter.world(&Overrides::default())))?;
    let distance = eye.distance(ball.centre);
    let close = move |scene: &mut World, camera: Entity| {
        let fov = Degrees(2.6 * libm::asin((ball.radius / distance).min(0.5)).to_degrees());
        let look = LookAt { eye, target: ball.centre, ..LookAt::default() };
        scene.entity_mut(camera).insert((PerspectiveCamera { fov, axis: FovAxis::Vertical }, look));
    };
    let tessellate = move |scene: &mut World, around: u32| {
        let geometry = MeshInstance::new(globe(ball.radius, around));
        scene.entity_mut(ball.entity).remove::<Sphere>().insert(geometry);
    };
    let exact = shapes_seen(chapter, SIZE, close)?;
    let middle = exact[exact.len() / 2 + SIZE[0] as usize / 2];
    let all = exact.iter().filter(|shape| **shape == middle).count();
    let exhibit = |around: u32| -> Result<Exhibit> {
        let picture = Picture::of(chapter, SIZE, None, |camera| {
            sample_less(camera);
            let entity = camera.id();
            camera.world_scope(|scene| {
                close(scene, entity);
                tessellate(scene, around);
            });
        })?;
        let seen = shapes_seen(chapter, SIZE, |scene, camera| {
            close(scene, camera);
            tessellate(scene, around);
        })?;
        let apart = exact.iter().zip(&seen).filter(|(one, other)| (**one == middle) != (**other == middle)).count();
        let triangles = globe(ball.radius, around).triangles.len();
        let lines = vec![format!("{around} around: {triangles} triangles"), format!("{apart} of {all} pixels missing")];
        Ok(Exhibit { picture, lines })
    };
    let exhibits = [exhibit(8)?, exhibit(16)?, exhibit(32)?];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// A sphere beside a camera that is close to it, and two rectangles: that of a disk at its depth, and the right one.
pub fn draw_rectangle(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SIZE: [u32; 2] = [640, 320];
    const FOV: Degrees = Degrees(100.0);
    /// From the eye, in radii: to the right, upward, ahead.
    const FROM_EYE: [f64; 3] = [0.8, -0.25, 1.8];
    let ball = ball(chapter, figure)?;
    let scene = chapter.world(&Overrides::default());
    let axes = world_from_entity(&Census::of(&scene), "the figure", camera_entity(&scene)?)?.matrix3;
    let [right, up, ahead] = FROM_EYE.map(|part| part * ball.radius);
    let eye = ball.centre - axes.x_axis * right - axes.y_axis * up + axes.z_axis * ahead;
    let look = LookAt { eye, target: eye - axes.z_axis, up: axes.y_axis };
    let picture = Picture::of(chapter, SIZE, None, |camera| {
        sample_less(camera);
        camera.remove::<Rasterisation>();
        camera.insert((PerspectiveCamera { fov: FOV, axis: FovAxis::Vertical }, look));
    })?;
    let size = DVec2::from(SIZE.map(f64::from));
    let half = DVec2::new(size.x / size.y, 1.0) * tan_half(FOV);
    let low = DVec2::new((WIDTH - size.x) / 2.0, 8.0);
    let raster = |x: f64, y: f64| low + DVec2::new(0.5 + 0.5 * x / half.x, 0.5 - 0.5 * y / half.y) * size;
    let rectangle = |[left, right]: [f64; 2], [foot, head]: [f64; 2]| {
        [raster(left, foot), raster(right, foot), raster(right, head), raster(left, head)]
    };
    let mut svg = Svg::new(figure.name, size.y + 64.0);
    svg.picture(low, size, &picture);
    let naive = [right, up].map(|across| interval_at_its_depth(across, ahead, ball.radius));
    let whole = [0, 1].map(|axis| sphere_interval([right, up][axis], ahead, ball.radius, half[axis]));
    svg.polygon(&rectangle(naive[0], naive[1]), None, Some(Pen::new("#ff5a1f", 2.0).dashed("6 4")));
    svg.polygon(&rectangle(whole[0], whole[1]), None, Some(Pen::new("#ffffff", 2.4)));
    svg.dot(raster(right / ahead, up / ahead), 3.0, "#103a66");
    let below = |part: f64| DVec2::new(low.x + part * size.x, low.y + size.y);
    let told = ["dashed: a disk at the depth of the centre", "unbroken: the sphere's own", "dot: its centre"];
    for (part, text) in [0.2, 0.6, 0.87].into_iter().zip(told) {
        svg.label(Label::near(below(part), text, DVec2::Y, 10.0).title(0.92));
    }
    Ok(svg.finish(figure.about, &figure.stamp(SIZE, "")))
}

/// Cameras that projection refuses, by rays, and what the renderer says.
pub fn draw_refused(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SIZE: [u32; 2] = [300, 200];
    /// Letters of a line below a picture.
    const LETTERS: usize = 28;
    let distance = {
        let scene = chapter.world(&Overrides::default());
        eye(&Census::of(&scene))?.distance(ball(chapter, figure)?.centre)
    };
    let changes: [&dyn Fn(&mut EntityWorldMut<'_>); 3] = [
        &|camera| {
            camera.remove::<PerspectiveCamera>().insert(FisheyeCamera::default());
        },
        &|camera| {
            let aperture = Aperture::Radius { radius: distance / 40.0 };
            camera.insert(Lens { aperture, focus_distance: distance, ..Lens::default() });
        },
        &|camera| {
            let velocity = DVec3::X * distance / 20.0;
            camera.insert((Motion { velocity }, Shutter::default()));
        },
    ];
    let exhibit = |change: &dyn Fn(&mut EntityWorldMut<'_>)| -> Result<Exhibit> {
        let picture = Picture::of(chapter, SIZE, None, |camera| {
            change(camera);
            sample_less(camera);
            camera.remove::<Rasterisation>();
        })?;
        let refused = Picture::of(chapter, SIZE, None, |camera| {
            change(camera);
            camera.insert(Rasterisation);
        });
        let sentence = refused.err().ok_or_else(|| figure.unsuited("a camera that cannot project"))?.to_string();
        Ok(Exhibit { picture, lines: wrapped(&sentence, LETTERS) })
    };
    let exhibits = changes.into_iter().map(exhibit).collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// What these pictures show are outlines, and fields of view.
fn sample_less(camera: &mut EntityWorldMut<'_>) {
    if let Some(mut sampling) = camera.get_mut::<Sampling>() {
        sampling.samples = 8;
    }
}

/// A sentence in lines of at most so many letters, if no word has more.
fn wrapped(sentence: &str, letters: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in sentence.split_whitespace() {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && lines[last].chars().count() + 1 + word.chars().count() > letters {
            lines.push(word.into());
        } else {
            let gap = if lines[last].is_empty() { "" } else { " " };
            lines[last] += &format!("{gap}{word}");
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_are_wrapped_between_words() {
        assert_eq!(wrapped("one two  three", 7), ["one two", "three"]);
        assert_eq!(wrapped("seventeen x", 4), ["seventeen", "x"]);
        assert_eq!(wrapped("", 4), [""]);
    }
}
