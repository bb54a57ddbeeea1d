//! Textures at one point a pixel, over what a pixel covers, and at many points a pixel.

use super::Figure;
use super::label::Label;
use super::pen::WIDTH;
use super::picture::Picture;
use super::svg::{Drawing, Svg};
use bevy_ecs::prelude::*;
use glam::DVec2;
use pinhole::Result;
use pinhole::extract::texture_evidence;
use pinhole::plan::{Census, entities};
use pinhole::render::{Execution, render};
use pinhole::scene::{Checker, ImageTexture, Resolution, Stripes};
use pinhole::{Chapter, Overrides, SamplingOverrides};

/// Pixels of each of the three pictures.
const SIZE: [u32; 2] = [120, 68];
/// Samples a pixel of the one that the others are measured by.
const SAMPLES: u32 = 32;
const GAP: f64 = 10.0;
const HEAD: f64 = 30.0;

/// A chapter's textures at one point a pixel, filtered, and at many points a pixel.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let across = (WIDTH - 4.0 * GAP) / 3.0;
    let panel = DVec2::new(across, across * f64::from(SIZE[1]) / f64::from(SIZE[0]));
    let pictures = pictures(chapter, figure)?;
    let off = |picture: usize| format!("off by {:.3} (root mean square)", apart(&pictures[picture], &pictures[2]));
    let told = [
        ("a point a pixel", off(0)),
        ("what a pixel covers", off(1)),
        ("many points a pixel", format!("{SAMPLES} points, unfiltered")),
    ];
    let mut svg = Svg::new(figure.name, HEAD + panel.y + 58.0);
    for (column, ((title, below), picture)) in told.iter().zip(&pictures).enumerate() {
        let low = DVec2::new(GAP + column as f64 * (across + GAP), HEAD);
        svg.picture(low, panel, &Picture::painted(SIZE, picture)?);
        let middle = DVec2::X * (across / 2.0);
        svg.label(Label::near(low + middle - DVec2::Y * 6.0, title, DVec2::NEG_Y, 0.0).title(1.0));
        svg.label(Label::near(low + middle + DVec2::Y * (panel.y + 5.0), below, DVec2::Y, 0.0).title(0.85));
    }
    Ok(svg.finish(figure.about, &figure.stamp(SIZE, "")))
}

/// The three pictures: a point a pixel, filtered, many points a pixel.
fn pictures(chapter: &Chapter, figure: &Figure) -> Result<[Vec<[f32; 3]>; 3]> {
    let picture = |filter: bool, samples: Option<u32>| -> Result<Vec<[f32; 3]>> {
        let resolution = Some(Resolution { width: SIZE[0], height: SIZE[1] });
        let sampling = SamplingOverrides { samples, ..SamplingOverrides::default() };
        let mut scene = chapter.world(&Overrides { resolution, sampling, ..Overrides::default() });
        if !texture_evidence(&Census::of(&scene)).needed {
            return Err(figure.unsuited("a textured surface"));
        }
        set_filters(&mut scene, filter);
        let film = render(&scene, &chapter.stages(), &Execution::default(), &())?.film;
        let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
        Ok(pixels.map(|(x, y)| film.mean(x, y)).collect())
    };
    Ok([picture(false, None)?, picture(true, None)?, picture(false, Some(SAMPLES))?])
}

fn set_filters(scene: &mut World, filter: bool) {
    for entity in entities::<With<Checker>>(scene) {
        if let Some(mut texture) = scene.get_mut::<Checker>(entity) {
            texture.filter = filter;
        }
    }
    for entity in entities::<With<Stripes>>(scene) {
        if let Some(mut texture) = scene.get_mut::<Stripes>(entity) {
            texture.filter = filter;
        }
    }
    for entity in entities::<With<ImageTexture>>(scene) {
        if let Some(mut texture) = scene.get_mut::<ImageTexture>(entity) {
            texture.filter = filter;
        }
    }
}

/// The root of the mean square of all parts' differences.
fn apart(one: &[[f32; 3]], other: &[[f32; 3]]) -> f64 {
    let parts = one.iter().flatten().zip(other.iter().flatten());
    let squares = parts.map(|(one, other)| f64::from(one - other) * f64::from(one - other)).sum::<f64>();
    (squares / (3 * one.len()) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::trial;

    #[test]
    fn filtered_is_nearer_to_many_points() {
        let figure = trial::figure(draw);
        let [point, filtered, many] = pictures(&trial::chapter(trial::checkered), &figure).expect("pictures");
        let (naive, kit) = (apart(&point, &many), apart(&filtered, &many));
        eprintln!("a point is off by {naive:.4}, filtered by {kit:.4}");
        assert!(kit < 0.7 * naive);
    }
}
