//! The screen's corners, and what three mistakes on the path to it make of the picture.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::label::Label;
use super::pen::{INK, Pen, WIDTH};
use super::picture::Picture;
use super::svg::{Drawing, Svg};
use crate::naive::screen::{mirrored, upside_down, without_aspect};
use crate::naive::stages::screen_placed_by;
use glam::DVec2;
use pinhole::Chapter;
use pinhole::Result;
use pinhole::rays::screen_from_ndc;

/// The two images, in pixels: as high as each other, the first twice as wide.
const SIZES: [[u32; 2]; 2] = [[200, 100], [100, 100]];
/// Units of the drawing for half a height.
const HALF: f64 = 82.0;
const TOP: f64 = 46.0;
/// Pixels for each of the image's own, so that the picture is sharp.
const FINE: u32 = 2;

/// Two images side by side with the corners of their screens.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let mut svg = Svg::new(figure.name, TOP + 2.0 * HALF + 96.0);
    let aspects = SIZES.map(|[width, height]| f64::from(width) / f64::from(height));
    let room = (WIDTH - 2.0 * HALF * aspects.iter().sum::<f64>()) / 3.0;
    let mut left = room;
    for (size, aspect) in SIZES.into_iter().zip(aspects) {
        let picture = Picture::of(chapter, size.map(|side| side * FINE), None, |_| ())?;
        let low = DVec2::new(left, TOP);
        svg.picture(low, DVec2::new(2.0 * aspect, 2.0) * HALF, &picture);
        let at = |ndc: DVec2| low + ndc * DVec2::new(2.0 * aspect, 2.0) * HALF;
        let middle = at(DVec2::splat(0.5));
        let pen = Pen::new("#fff", 1.6).faint(0.85);
        svg.arrow(middle, middle + DVec2::X * HALF, pen);
        svg.arrow(middle, middle - DVec2::Y * HALF, pen);
        for ndc in [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE] {
            let screen = screen_from_ndc(ndc, aspect);
            svg.dot(at(ndc), 4.0, INK);
            let outward = DVec2::new(0.0, 2.0 * ndc.y - 1.0);
            svg.label(Label::near(at(ndc), &pair(screen), outward, 9.0));
        }
        let [width, height] = size;
        let below = DVec2::new(middle.x, at(DVec2::ONE).y + 26.0);
        svg.label(
            Label::near(below, &format!("{width} × {height} pixels, aspect {aspect}"), DVec2::Y, 9.0).title(0.92),
        );
        left += 2.0 * HALF * aspect + room;
    }
    Ok(svg.finish(figure.about, &gallery_foot(chapter, figure, SIZES[0])))
}

fn pair(point: DVec2) -> String {
    format!("({}, {})", point.x, point.y).replace('-', "−")
}

/// The picture as it should be, and with each mistake.
pub fn draw_naive(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let size = [430, 215];
    let formulas: [(&str, &str, fn(DVec2, f64) -> DVec2); 4] = [
        ("right", "((2*x* − 1) · aspect, 1 − 2*y*)", screen_from_ndc),
        ("the aspect forgotten", "(2*x* − 1, 1 − 2*y*)", without_aspect),
        ("y still downward", "((2*x* − 1) · aspect, 2*y* − 1)", upside_down),
        ("x to the left", "((1 − 2*x*) · aspect, 1 − 2*y*)", mirrored),
    ];
    let exhibit = |(name, formula, place): (&str, &str, fn(DVec2, f64) -> DVec2)| {
        let picture = Picture::of(chapter, size, Some(screen_placed_by(place)), |_| ())?;
        Ok(Exhibit { picture, lines: vec![name.into(), formula.into()] })
    };
    let exhibits = formulas.map(exhibit).into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, size)))
}
