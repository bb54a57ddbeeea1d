//! Pictures of one scene side by side, each with a line or two below it.

use super::Figure;
use super::label::Label;
use super::pen::WIDTH;
use super::picture::Picture;
use super::subject::{Lens, Subject};
use super::svg::{Drawing, Svg};
use crate::figure::subject::Ball;
use crate::naive::field_of_view::{tan_half_of_degrees_as_radians, tan_of_full_angle, whole_height};
use bevy_ecs::prelude::*;
use glam::DVec2;
use pinhole::Chapter;
use pinhole::Result;
use pinhole::extract::{
    PerspectiveProjection, angle_across, camera_entity, eye, half_extent, tan_half, world_from_entity,
};
use pinhole::plan::{Census, Column, Stage, TileSystems, VectorRowsMut};
use pinhole::rays::{CameraRays, ScreenPoints, camera_ray_perspective};
use pinhole::scene::{Degrees, FovAxis, LookAt, PerspectiveCamera, Placement};

const MARGIN: f64 = 8.0;
const GAP: f64 = 14.0;
/// Below a picture: its lines.
const LINE: f64 = 18.0;
const FOOT: f64 = 26.0;
/// Pixels for each unit of the drawing, so that pictures stay sharp on fine screens.
const FINE: f64 = 1.25;

/// A picture and the lines below it.
pub struct Exhibit {
    /// The picture.
    pub picture: Picture,
    /// What it is; then what else a reader has to know.
    pub lines: Vec<String>,
}

/// Hangs pictures in rows of `columns`, all at one scale.
pub fn hang(figure: &Figure, exhibits: &[Exhibit], columns: usize, foot: &str) -> Drawing {
    let widest = |row: &[Exhibit]| row.iter().map(|exhibit| f64::from(exhibit.picture.size[0])).sum::<f64>();
    let pixels = exhibits.chunks(columns).map(widest).fold(1.0, f64::max);
    let scale = (WIDTH - 2.0 * MARGIN - GAP * (columns as f64 - 1.0)) / pixels;
    let lines = exhibits.iter().map(|exhibit| exhibit.lines.len()).max().unwrap_or(0) as f64;
    let tall = |row: &[Exhibit]| row.iter().map(|exhibit| exhibit.picture.size[1]).max().map_or(0.0, f64::from) * scale;
    let rows: Vec<f64> = exhibits.chunks(columns).map(|row| tall(row) + lines * LINE + 2.0 * GAP).collect();
    let mut svg = Svg::new(figure.name, MARGIN + rows.iter().sum::<f64>() + FOOT);
    let mut top = MARGIN;
    for (row, height) in exhibits.chunks(columns).zip(&rows) {
        let width = scale * widest(row) + GAP * (row.len() as f64 - 1.0);
        let mut left = (WIDTH - width) / 2.0;
        for Exhibit { picture, lines } in row {
            let size = DVec2::from(picture.size.map(f64::from)) * scale;
            svg.picture(DVec2::new(left, top), size, picture);
            for (line, place) in lines.iter().zip(0_i32..) {
                let below = DVec2::new(left + size.x / 2.0, top + size.y + f64::from(place) * LINE);
                svg.label(Label::near(below, line, DVec2::Y, 9.0).title(0.92));
            }
            left += size.x + GAP;
        }
        top += height;
    }
    svg.finish(figure.about, foot)
}

/// The words at the foot of a gallery.
pub fn gallery_foot(chapter: &Chapter, figure: &Figure, size: [u32; 2]) -> String {
    let [width, height] = size;
    format!("scene {}, {width} × {height} pixels · cargo run --release -- figure {}", chapter.name, figure.name)
}

/// Pixels of a picture that is so wide in the drawing, at this aspect.
fn pixels(width: f64, aspect: f64) -> [u32; 2] {
    [width * FINE, width * FINE / aspect].map(|side| side.round() as u32)
}

fn degrees(angle: Degrees) -> String {
    let text = format!("{:.1}", angle.0);
    format!("{}°", text.trim_end_matches(".0"))
}

/// The chapter's own angle, or why there is none.
fn own_camera(chapter: &Chapter, figure: &Figure) -> Result<PerspectiveCamera> {
    let scene = chapter.world(&Default::default());
    let camera = scene.get::<PerspectiveCamera>(camera_entity(&scene)?);
    camera.copied().ok_or_else(|| figure.unsuited("a perspective camera"))
}

/// One place, three angles.
pub fn draw_angles(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let own = own_camera(chapter, figure)?;
    let size = pixels(226.0, 1.25);
    let exhibit = |factor: f64| {
        let tangent = factor * tan_half(own.fov);
        let fov = angle_across(&PerspectiveProjection { tan_half_vertical: tangent }, FovAxis::Vertical, 1.0);
        let picture = Picture::of(chapter, size, None, |camera| {
            camera.insert(PerspectiveCamera { fov, axis: FovAxis::Vertical });
        })?;
        Ok(Exhibit { picture, lines: vec![degrees(fov), format!("tan(*φ*/2) = {tangent:.3}")] })
    };
    let exhibits = [0.5, 1.0, 3.0].map(exhibit).into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, size)))
}

/// A window that widens: above with the vertical angle kept, below with the horizontal angle kept.
pub fn draw_window(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let own = own_camera(chapter, figure)?;
    let height = 136.0;
    let mut exhibits = Vec::new();
    for axis in [FovAxis::Vertical, FovAxis::Horizontal] {
        for aspect in [1.0, 1.5, 2.2] {
            let size = pixels(height * aspect, aspect);
            let shape = f64::from(size[0]) / f64::from(size[1]);
            let picture = Picture::of(chapter, size, None, |camera| {
                camera.insert(PerspectiveCamera { fov: own.fov, axis });
            })?;
            let lens = PerspectiveProjection { tan_half_vertical: tan_half(own.fov) / half_extent(axis, shape) };
            let [vertical, horizontal] =
                [FovAxis::Vertical, FovAxis::Horizontal].map(|axis| degrees(angle_across(&lens, axis, shape)));
            exhibits.push(Exhibit { picture, lines: vec![format!("{horizontal} × {vertical}")] });
        }
    }
    let size = exhibits[0].picture.size;
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, size)))
}

/// The sphere in the middle keeps its size: what the angle loses, the distance makes up for.
pub fn draw_zoom(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let subject = Subject::of(chapter, 45, 27)?;
    let Lens::Perspective(tangent) = subject.lens else { return Err(figure.unsuited("a perspective camera")) };
    let middle = subject.rays.iter().filter_map(|ray| Some((ray, subject.ball_hit(ray)?)));
    let nearest = middle.min_by(|a, b| subject.off_centre(a.0.pixel).total_cmp(&subject.off_centre(b.0.pixel)));
    let (_, Ball { centre, radius, .. }) = nearest.ok_or_else(|| figure.unsuited("a sphere that a ray hits"))?;
    let scene = chapter.world(&Default::default());
    let census = &Census::of(&scene);
    let target = eye(census)? + *centre;
    let up = world_from_entity(census, "the figure", camera_entity(&scene)?)?.matrix3.y_axis;
    // Seen from d the outline is at the angle whose tangent is r / √(d² − r²).
    let outline = |distance: f64| radius / (distance * distance - radius * radius).sqrt();
    let size = pixels(226.0, 1.25);
    let exhibit = |factor: f64| {
        let distance = (centre.length() * factor).max(radius * 1.2);
        let lens = PerspectiveProjection { tan_half_vertical: tangent * outline(distance) / outline(centre.length()) };
        let fov = angle_across(&lens, FovAxis::Vertical, 1.0);
        let look = LookAt { eye: target - centre.normalize() * distance, target, up };
        let picture = Picture::of(chapter, size, None, |camera| {
            camera.insert((PerspectiveCamera { fov, axis: FovAxis::Vertical }, Placement::default(), look));
        })?;
        Ok(Exhibit { picture, lines: vec![degrees(fov), format!("distance {distance:.1}")] })
    };
    let exhibits = [0.5, 1.0, 4.0].map(exhibit).into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, size)))
}

/// The chapter's angle as pinhole takes it, and with three mistakes.
pub fn draw_naive(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let own = own_camera(chapter, figure)?.fov;
    let size = pixels(345.0, 2.0);
    let in_f32 = own.0 as f32;
    let mistakes = [
        ("tan(*φ*/2)", tan_half(own)),
        ("tan *φ*: the half forgotten", f64::from(tan_of_full_angle(in_f32))),
        ("2 tan(*φ*/2): the whole height for half of it", f64::from(whole_height(in_f32))),
        ("degrees taken for radians", f64::from(tan_half_of_degrees_as_radians(in_f32))),
    ];
    let exhibit = |(name, tangent): (&str, f64)| {
        let picture = Picture::of(chapter, size, Some(aimed_with(tangent)), |_| ())?;
        Ok(Exhibit { picture, lines: vec![name.into(), format!("{tangent:.3}").replace('-', "−")] })
    };
    let exhibits = mistakes.map(exhibit).into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, size)))
}

/// The perspective camera's stage with this number for the half height of its plane.
fn aimed_with(tangent: f64) -> Stage {
    let fill = move |mut tiles: Query<(&ScreenPoints, &mut CameraRays)>| {
        for (screen, mut rays) in &mut tiles {
            let (_, mut direction) = rays.slices_mut(screen.rows());
            for row in 0..screen.rows() {
                direction.put(row, camera_ray_perspective(screen.point(row), tangent));
            }
        }
    };
    Stage::new("Aim rays with another tangent", TileSystems::Camera, fill)
}
