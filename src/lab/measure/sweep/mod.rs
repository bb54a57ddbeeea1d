//! Sweeps: one scene in other units, elsewhere, turned, seen through other angles, in other sizes.
//!
//! Reads: a scene and the stages on offer. Writes: a line for each thing that was done: what is asked and what came.
//! A picture has no units and no place, so most of the time the same bits are asked for.

mod edit;
mod frame;

pub use edit::{lay_on_grid, scale, set_fov, set_size, shift, turn};
pub use frame::{Difference, Frame, PixelHit, difference};

use bevy_ecs::prelude::*;
use edit::has_children;
use glam::{DQuat, DVec3};
use pinhole::plan::Stage;
use pinhole::render::{Execution, Watch, render};
use pinhole::scene::{PerspectiveCamera, Sampling};
use pinhole::{Error, Result};
use serde::Serialize;
use std::fmt;

/// Pixels of a frame that is swept.
pub const SIZE: [u32; 2] = [96, 54];
/// The largest power of two that a scene is scaled by.
const LARGEST: i32 = 20;
/// How far the surface may be off across itself, relative to its distance, where nothing but rounding changed.
///
/// A direction in f32 is off by up to 2⁻²³ rad, and so is that of the other frame: 2.4e-7, and four times that for what
/// second order adds next to a silhouette.
const ACROSS: f64 = 1e-6;
/// One pixel in so many may change hands: those whose ray passes an edge by less than it is off.
const ONE_IN: usize = 1000;
/// The angles of the sweep.
const ANGLES: [f64; 16] =
    [1e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0, 10.0, 45.0, 90.0, 120.0, 150.0, 170.0, 179.0, 179.9, 179.99, 180.0];
/// The sizes of the sweep.
const SIZES: [[u32; 2]; 6] = [[1, 1], [1, 257], [257, 1], [1, 65_536], [65_536, 1], [33, 65]];

/// One thing that was done to a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// What was done.
    pub done: String,
    /// What is asked.
    pub asked: String,
    /// What came.
    pub came: String,
    /// Whether that is what is asked.
    pub held: bool,
    /// The same in numbers, where hits are compared.
    pub difference: Option<Difference>,
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = if self.held { "held" } else { "NOT HELD" };
        write!(f, "{:<39}{:<44}{word:<9}{}", self.done, self.came, self.asked)
    }
}

/// Sweeps the scene that `make` makes, with one sample a pixel.
///
/// Errors: what a render of the scene as it is would be refused for, or a stop by the one who watches.
pub fn sweep(make: &dyn Fn() -> World, offer: &[Stage], watch: &dyn Watch) -> Result<Vec<Line>> {
    let make = &|| {
        let mut scene = make();
        scene.query::<&mut Sampling>().iter_mut(&mut scene).for_each(|mut sampling| sampling.samples = 1);
        scene
    };
    let small = || {
        let mut scene = make();
        set_size(&mut scene, SIZE);
        scene
    };
    let plain = Frame::of(&small(), offer)?;
    let mut lines = Vec::new();
    for k in (-LARGEST..=LARGEST).filter(|&k| k != 0) {
        lines.push(scaled(&small, offer, &plain, k)?);
        go_on(watch)?;
    }
    let mut lines = vec![all_scales(lines)];
    lines.extend(moved(&small, offer, &plain)?);
    lines.extend(turned(&small, offer, &plain)?);
    go_on(watch)?;
    lines.extend(angles(&small, offer)?);
    for size in SIZES {
        lines.push(sized(make, offer, size, watch)?);
        go_on(watch)?;
    }
    Ok(lines)
}

fn go_on(watch: &dyn Watch) -> Result {
    if watch.stopped() { Err(Error::Interrupted) } else { Ok(()) }
}

/// The same scene in units 2⁻ᵏ as long.
fn scaled(make: &dyn Fn() -> World, offer: &[Stage], plain: &Frame, k: i32) -> Result<Line> {
    let mut scene = make();
    scale(&mut scene, k);
    let frame = Frame::of(&scene, offer)?;
    let factor = libm::ldexp(1.0, k);
    let same = |(one, other): (&PixelHit, &PixelHit)| {
        one.shape == other.shape && (one.t * factor).to_bits() == other.t.to_bits()
    };
    let hits = plain.pixel_hits.iter().zip(&frame.pixel_hits).filter(|&pair| !same(pair)).count();
    let film = if plain.viewed { None } else { frame.film.difference(&plain.film) };
    let came = film.unwrap_or_else(|| match hits {
        0 => "every bit the same".into(),
        _ => format!("{hits} hits differ"),
    });
    let held = came == "every bit the same";
    Ok(Line {
        done: format!("scaled by 2^{k}, lights by 4^{k}"),
        asked: "every bit the same".into(),
        came,
        held,
        difference: None,
    })
}

/// All powers in one line, or the first that does not hold.
fn all_scales(lines: Vec<Line>) -> Line {
    let count = lines.len();
    match lines.into_iter().find(|line| !line.held) {
        Some(line) => line,
        None => Line {
            done: format!("scaled by 2^k, k to +-{LARGEST}"),
            asked: "every bit the same".into(),
            came: format!("{count} scales, every bit the same"),
            held: true,
            difference: None,
        },
    }
}

/// What is asked where nothing but rounding changed.
fn nearly(done: String, plain: &Frame, other: &Frame) -> Line {
    let found = difference(plain, other);
    let Difference { hits, changed_hands, worst } = found;
    let held = worst <= ACROSS && changed_hands * ONE_IN <= hits.max(ONE_IN);
    let came = match hits {
        0 => "nothing is hit, before or after".into(),
        _ => format!("off by {worst:.1e} t; {changed_hands} of {hits} changed hands"),
    };
    Line { done, asked: format!("{ACROSS:.0e} t, 1 in {ONE_IN}"), came, held, difference: Some(found) }
}

fn moved(make: &dyn Fn() -> World, offer: &[Stage], plain: &Frame) -> Result<Vec<Line>> {
    let mut lines = Vec::new();
    let far = f64::from(1 << 20);
    let mut laid = make();
    lay_on_grid(&mut laid);
    let on_grid = Frame::of(&laid, offer)?;
    let rounds = has_children(&laid);
    for by in [DVec3::X * far, DVec3::new(-far, far, -far)] {
        let mut scene = make();
        lay_on_grid(&mut scene);
        shift(&mut scene, by);
        let frame = Frame::of(&scene, offer)?;
        let axes = if by.y == 0.0 { "x" } else { "x, y, z" };
        let done = format!("moved by 2^20 along {axes}, on a grid");
        if rounds {
            lines.push(nearly(done, &on_grid, &frame));
            continue;
        }
        let differ = frame.film.difference(&on_grid.film);
        let held = differ.is_none() && frame.pixel_hits == on_grid.pixel_hits;
        let came = differ.unwrap_or_else(|| if held { "every bit the same" } else { "hits differ" }.into());
        lines.push(Line { done, asked: "every bit the same".into(), came, held, difference: None });
    }
    for distance in [1e2, 1e4, 1e6] {
        let mut scene = make();
        shift(&mut scene, DVec3::new(0.577_3, -0.311_7, 0.691_9) * distance);
        lines.push(nearly(format!("moved by about {distance:e}, any way"), plain, &Frame::of(&scene, offer)?));
    }
    Ok(lines)
}

fn turned(make: &dyn Fn() -> World, offer: &[Stage], plain: &Frame) -> Result<Vec<Line>> {
    let axis = DVec3::new(0.48, -0.6, 0.64);
    let turns = [1e-3, 30.0, 90.0, 180.0].map(|degrees: f64| {
        let half = degrees.to_radians() / 2.0;
        let (sine, cosine) = (libm::sin(half), libm::cos(half));
        let by = DQuat::from_xyzw(axis.x * sine, axis.y * sine, axis.z * sine, cosine).normalize();
        let mut scene = make();
        turn(&mut scene, by);
        Ok(nearly(format!("turned by {degrees} degrees"), plain, &Frame::of(&scene, offer)?))
    });
    turns.into_iter().collect()
}

/// Every angle is refused by name, or gives finite rays, which go on to the right along a line if they pass through the
/// centres of pixels.
fn angles(make: &dyn Fn() -> World, offer: &[Stage]) -> Result<Vec<Line>> {
    let mut lines = Vec::new();
    let mut plain = make();
    if plain.query::<&PerspectiveCamera>().iter(&plain).next().is_none() {
        return Ok(lines);
    }
    let through_centres = plain.query::<&Sampling>().iter(&plain).next().is_none();
    let asked = if through_centres { "refused by name, or in order" } else { "refused by name, or finite" };
    for degrees in ANGLES {
        let mut scene = make();
        set_fov(&mut scene, degrees);
        let (came, held) = match Frame::of(&scene, offer) {
            Err(Error::SceneError(scene_error)) => {
                (format!("refused: {}", scene_error.field), scene_error.field == "fov")
            }
            Err(error) => return Err(error),
            Ok(frame) => {
                let finite = frame.middle.iter().all(|direction| direction.is_finite());
                let (rejected, monotone) = (frame.film.rejected, !through_centres || goes_on(&frame.middle));
                let word = match (frame.middle.is_empty(), finite, monotone) {
                    (true, _, _) => "no rays are made",
                    (_, false, _) => "not finite",
                    (_, _, false) => "not in order",
                    _ if through_centres => "finite, each to the right",
                    _ => "finite",
                };
                let counted = frame.film.pixels.iter().all(|pixel| pixel[3] == 1);
                (format!("{word}, {rejected} rejected"), finite && monotone && rejected == 0 && counted)
            }
        };
        let done = format!("field of view {degrees} degrees");
        lines.push(Line { done, asked: asked.into(), came, held, difference: None });
    }
    Ok(lines)
}

/// Whether directions along a line turn the same way all along, none back; so do none at all.
fn goes_on(directions: &[DVec3]) -> bool {
    let (Some(&first), Some(&last)) = (directions.first(), directions.last()) else { return true };
    let ahead = last - first;
    directions.windows(2).all(|pair| (pair[1] - pair[0]).dot(ahead) > 0.0)
}

/// A size: a sample for every pixel, none rejected.
fn sized(make: &dyn Fn() -> World, offer: &[Stage], size: [u32; 2], watch: &dyn Watch) -> Result<Line> {
    let mut scene = make();
    set_size(&mut scene, size);
    let [width, height] = size;
    let done = format!("{width} x {height} pixels");
    let asked = "a sample a pixel, or refused by name".into();
    let film = match render(&scene, offer, &Execution::default(), watch) {
        Ok(rendered) => rendered.film,
        Err(Error::SceneError(scene_error)) => {
            let held = scene_error.field == "fov" && size[1] > SIZE[1];
            return Ok(Line { done, asked, came: format!("refused: {}", scene_error.field), held, difference: None });
        }
        Err(error) => return Err(error),
    };
    let counts = || film.tiles.iter().flat_map(|tile| tile.count.iter());
    let (pixels, rejected) = (counts().count() as u64, film.rejected().0);
    let held = counts().all(|&count| count == 1) && rejected == 0 && pixels == u64::from(width) * u64::from(height);
    Ok(Line { done, asked, came: format!("{pixels} samples, {rejected} rejected"), held, difference: None })
}
