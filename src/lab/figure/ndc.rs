//! One point of the image, in two resolutions.

use super::Figure;
use super::label::Label;
use super::pen::{Fill, INK, Pen, WIDTH};
use super::svg::{Drawing, Svg};
use glam::DVec2;
use pinhole::Result;
use pinhole::film::{Curve, byte_from_linear};
use pinhole::rays::{NdcPoints, Tile, ndc_stage, raster_stage};
use pinhole::render::inspect;
use pinhole::scene::Resolution;
use pinhole::{Chapter, Overrides};

/// The two images, in pixels, and in each the pixel whose centre is the same point.
const IMAGES: [([u32; 2], [u32; 2]); 2] = [([4, 2], [1, 0]), ([12, 6], [4, 1])];
const SIDE: DVec2 = DVec2::new(272.0, 136.0);
const TOP: f64 = 66.0;

/// Two images of one shape with the NDC points of their pixels; a point of the image is one point in both.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let mut svg = Svg::new(figure.name, TOP + SIDE.y + 104.0);
    let room = (WIDTH - 2.0 * SIDE.x) / 3.0;
    for ((size, chosen), left) in IMAGES.into_iter().zip([room, 2.0 * room + SIDE.x]) {
        let low = DVec2::new(left, TOP);
        paint(&mut svg, low, size, chosen, &ndc_points(chapter, size)?);
    }
    let [[width, height], _] = IMAGES[0].into();
    let foot = format!("scene {}, {width} × {height} pixels and more", chapter.name);
    Ok(svg.finish(figure.about, &format!("{foot} · cargo run --release -- figure {}", figure.name)))
}

/// What the stages wrote for an image of this size: pixels and their NDC points.
fn ndc_points(chapter: &Chapter, [width, height]: [u32; 2]) -> Result<Vec<([u32; 2], DVec2)>> {
    let mut whole = chapter.clone();
    whole.offer = vec![raster_stage(), ndc_stage()];
    let asked =
        Overrides { resolution: Some(Resolution { width, height }), view: Some("ndc".into()), ..Overrides::default() };
    let inspection = inspect(&whole.world(&asked), &whole.stages(), width.max(height))?;
    let mut points = Vec::new();
    for &tile in &inspection.tiles {
        let tile = inspection.world.entity(tile);
        if let (Some(place), Some(ndc)) = (tile.get::<Tile>(), tile.get::<NdcPoints>()) {
            points.extend((0..place.rows()).map(|row| (place.pixel_of(row), ndc.point(row))));
        }
    }
    Ok(points)
}

fn paint(svg: &mut Svg, low: DVec2, size: [u32; 2], chosen: [u32; 2], points: &[([u32; 2], DVec2)]) {
    let at = |ndc: DVec2| low + ndc * SIDE;
    let cell = SIDE / DVec2::from(size.map(f64::from));
    let grid = Pen::new("#fff", 0.8).faint(0.5);
    for &(pixel, ndc) in points {
        let corner = low + DVec2::from(pixel.map(f64::from)) * cell;
        let [r, g] = [ndc.x, ndc.y].map(|part| byte_from_linear(part as f32, Curve::Straight));
        let around = [corner, corner + DVec2::X * cell.x, corner + cell, corner + DVec2::Y * cell.y];
        svg.polygon(&around, Some(&Fill::new(format!("#{r:02x}{g:02x}00"), 1.0)), Some(grid));
    }
    for &(pixel, ndc) in points {
        svg.dot(at(ndc), 2.0, "#fff");
        if pixel == chosen {
            svg.circle(at(ndc), 6.5, None, Some(Pen::new("#fff", 1.8)));
            let words = format!("pixel {},{}: ({}, {})", pixel[0], pixel[1], ndc.x, ndc.y);
            svg.label(Label::near(at(ndc), &words, DVec2::new(0.0, -1.0), 30.0 + ndc.y * SIDE.y));
        }
    }
    for (ndc, words, toward) in [
        (DVec2::ZERO, "(0, 0)", DVec2::new(0.0, -1.0)),
        (DVec2::X, "(1, 0)", DVec2::new(0.0, -1.0)),
        (DVec2::Y, "(0, 1)", DVec2::new(0.0, 1.0)),
        (DVec2::ONE, "(1, 1)", DVec2::new(0.0, 1.0)),
    ] {
        svg.dot(at(ndc), 4.0, INK);
        svg.label(Label::near(at(ndc), words, toward, 9.0));
    }
    // The middle of the foot of the image, below its corners' labels.
    let below = at(DVec2::new(0.5, 1.0)) + DVec2::Y * 26.0;
    svg.label(Label::near(below, &format!("{} × {} pixels", size[0], size[1]), DVec2::Y, 9.0).title(0.92));
}
