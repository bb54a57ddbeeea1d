//! Frames of a chapter's film: its curves, its shutter, its moments.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::{Picture, few};
use super::svg::Drawing;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::film::{Curve, Film, png_bytes};
use pinhole::plan::Census;
use pinhole::render::{Execution, RenderInProgress};
use pinhole::scene::{Keys, Name, Placement, SceneFile, scene_text, smooth};
use pinhole::{Chapter, Error, Result, stages};
use std::path::Path;

const SIZE: [u32; 2] = [276, 184];
/// The size of a picture in which the wheel alone is seen.
const SQUARE: [u32; 2] = [180, 180];
/// The frames in a unit of time.
const RATE: f64 = 24.0;
/// Where the camera stands that looks at the wheel alone.
const AT_THE_WHEEL: [&str; 4] = [
    "camera.keys=(values: {})",
    "camera.look_at.eye=(-2.2, 1.2, 3.6)",
    "camera.look_at.target=(-2.2, 1.2, -0.6)",
    "camera.perspective_camera.fov=32",
];

/// Where it stands that looks at the ball's path.
const AT_THE_PATH: [&str; 4] = [
    "camera.keys=(values: {})",
    "camera.look_at.eye=(0.9, 1.1, 6.3)",
    "camera.look_at.target=(0.9, 1.05, 0.6)",
    "camera.perspective_camera.fov=26",
];

/// A chapter's film with these settings.
fn film(chapter: &Chapter, [width, height]: [u32; 2], samples: u32, settings: &[&str]) -> Result<SceneFile> {
    let usage = |what: String| Error::Usage(what);
    let text = scene_text(&chapter.world(&Default::default()))?;
    let mut file = SceneFile::parse(Path::new("film.ron"), text).map_err(|problem| usage(problem.to_string()))?;
    let size = format!("camera.resolution=(width: {width}, height: {height})");
    let samples = format!("camera.sampling.samples={}", few(samples));
    for setting in [size.as_str(), samples.as_str(), "camera.integrator=RayCasting"].iter().chain(settings) {
        file = file.set(setting).map_err(usage)?;
    }
    Ok(file)
}

/// A frame of a film at so many moments.
fn frame(file: &SceneFile, frame: f64, moments: u32) -> Result<Film> {
    let own = file.clone();
    let scene = move |number: u32, of: u32| -> Result<World> {
        Ok(own.at_moment(frame, RATE, [number, of], false).map_err(Error::Usage)?.world())
    };
    let offer = Chapter::new("film", "", |_| ()).offer(stages::all()).stages();
    let world = scene(0, 1)?;
    let mut render = RenderInProgress::begin(&Census::of(&world), &offer, &Execution::default())?;
    render.at_moments(moments, Box::new(scene), offer);
    render.advance(render.steps(), &())?;
    Ok(render.finish().film)
}

fn exhibit(film: &Film, line: String) -> Result<Exhibit> {
    let picture = Picture { size: [film.width, film.height], url: crate::png_url(&png_bytes(film, Curve::Srgb)?) };
    Ok(Exhibit { picture, lines: vec![line] })
}

/// A component of a film's ball.
fn of_ball<C: Component + Clone>(film: &SceneFile) -> Result<C> {
    let mut scene = film.world();
    let mut query = scene.query::<(&Name, &C)>();
    let found = query.iter(&scene).find(|(name, _)| name.as_str() == "ball").map(|(_, own)| own.clone());
    found.ok_or_else(|| Error::Usage("the film has no ball that moves".into()))
}

/// Where a film's ball is at a frame.
fn ball(film: &SceneFile, frame: f64) -> Result<DVec3> {
    Ok(of_ball::<Placement>(&film.at(frame, RATE).map_err(Error::Usage)?)?.position)
}

/// The same on the curve for keys that are one apart, whatever their distances.
fn ball_of_even_keys(film: &SceneFile, frame: f64) -> Result<DVec3> {
    let keys = of_ball::<Keys>(film)?.frames("placement.position");
    let last = keys.len().saturating_sub(2);
    let next = keys.iter().position(|key| *key > frame).unwrap_or(last).clamp(2, last.max(2));
    let Some(four) = keys.get(next - 2..next + 2) else { return ball(film, frame) };
    let places = four.iter().map(|key| ball(film, *key)).collect::<Result<Vec<_>>>()?;
    let u = (frame - four[1]) / (four[2] - four[1]);
    let along = |axis: usize| smooth([0.0, 1.0, 2.0, 3.0], [0, 1, 2, 3].map(|key: usize| places[key][axis]), 1.0 + u);
    Ok(DVec3::new(along(0), along(1), along(2)))
}

/// Where the ball is at every frame, along straight lines and along curves.
pub fn draw_curves(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let shown = |curve: &str, line: &str, ball: fn(&SceneFile, f64) -> Result<DVec3>| {
        let curve = format!("ball.keys.curve={curve}");
        let film = film(chapter, SIZE, 16, &[&AT_THE_PATH[..], &["camera.shutter.close=0", &curve]].concat())?;
        let mut still = film.at(0.0, RATE).map_err(Error::Usage)?;
        for number in 1..48 {
            let DVec3 { x, y, z } = ball(&film, f64::from(number))?;
            let place = format!("pearl {number}.placement.position=({x:?}, {y:?}, {z:?})");
            still = still.set(&place).map_err(Error::Usage)?;
        }
        exhibit(&frame(&still, 0.0, 1)?, line.into())
    };
    let exhibits = [
        shown("Linear", "straight lines", ball)?,
        shown("Smooth", "as if the keys were one apart", ball_of_even_keys)?,
        shown("Smooth", "the smooth curve", ball)?,
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// Four frames in a row, the shutter closed at once.
pub fn draw_wagon_wheel(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let file = film(chapter, SQUARE, 16, &[&AT_THE_WHEEL[..], &["camera.shutter.close=0"]].concat())?;
    let shown = |number: u32| exhibit(&frame(&file, number.into(), 1)?, format!("frame {number}"));
    let exhibits = (0..4).map(shown).collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 4, &gallery_foot(chapter, figure, SQUARE)))
}

/// One frame through shutters of several angles.
pub fn draw_angles(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let shown = |angle: f64| {
        let close = format!("camera.shutter.close={}", angle / 360.0 / RATE);
        let file = film(chapter, SQUARE, 32, &[&AT_THE_WHEEL[..], &[close.as_str()]].concat())?;
        let moments = if angle > 0.0 { 32 } else { 1 };
        exhibit(&frame(&file, 1.0, moments)?, format!("{angle}°"))
    };
    let exhibits = [0.0, 90.0, 180.0, 360.0].map(shown).into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 4, &gallery_foot(chapter, figure, SQUARE)))
}

/// One frame at few moments and at more, with the same samples.
pub fn draw_moments(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let file = film(chapter, SQUARE, 64, &AT_THE_WHEEL)?;
    let shown = |moments: u32| exhibit(&frame(&file, 1.0, moments)?, format!("{moments} moments"));
    let exhibits = [2, 4, 16, 64].map(shown).into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 4, &gallery_foot(chapter, figure, SQUARE)))
}
