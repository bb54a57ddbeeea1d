//! Where a ray is inside each slab of a cuboid, and inside all three.

use super::Figure;
use super::label::Label;
use super::pen::{IMAGE, INK, Pen, RAY, WIDTH};
use super::pixel_ray::PixelRay;
use super::subject::Subject;
use super::svg::{Drawing, Svg};
use glam::DVec2;
use pinhole::Result;
use pinhole::extract::CuboidTable;
use pinhole::plan::{Census, Table};
use pinhole::shapes::Slabs;
use pinhole::{Chapter, Overrides};

const HEIGHT: f64 = 300.0;
/// The first row of bars, and the distance to the next.
const ROWS: [f64; 2] = [52.0, 52.0];
const LEFT: f64 = 110.0;

/// Where a pixel's ray is inside each slab of a cuboid, and inside all of them.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let subject = Subject::of(chapter, 96, 54)?;
    let table = CuboidTable::extract(&Census::of(&chapter.world(&Overrides::default())))?;
    let told = telling(&subject, &table).ok_or_else(|| figure.unsuited("a cuboid that a pixel's ray hits"))?;
    let (ray, spans) = told;
    let mut svg = Svg::new(figure.name, HEIGHT);
    let enters = spans.iter().map(|span| span[0]).fold(f64::NEG_INFINITY, f64::max);
    let leaves = spans.iter().map(|span| span[1]).fold(f64::INFINITY, f64::min);
    let (first, last) = drawn_range(&spans);
    let x = |t: f64| LEFT + (t.clamp(first, last) - first) / (last - first) * (WIDTH - LEFT - 40.0);
    let row = |number: f64| ROWS[0] + ROWS[1] * number;
    for (number, (span, name)) in spans.iter().zip(["x", "y", "z"]).enumerate() {
        let y = row(number as f64);
        svg.line(DVec2::new(x(span[0]), y), DVec2::new(x(span[1]), y), Pen::new(IMAGE, 7.0).faint(0.8));
        for (t, side) in [(span[0], "enters"), (span[1], "leaves")] {
            if t > first && t < last {
                svg.dot(DVec2::new(x(t), y), 4.0, INK);
                svg.label(Label::near(DVec2::new(x(t), y), side, DVec2::new(0.0, -1.0), 9.0).title(0.85));
            }
        }
        svg.label(Label::near(DVec2::new(LEFT - 14.0, y), &format!("slab {name}"), DVec2::new(-1.0, 0.0), 6.0));
    }
    let y = row(3.0);
    svg.line(DVec2::new(x(enters), y), DVec2::new(x(leaves), y), Pen::new(RAY, 9.0));
    svg.label(Label::near(DVec2::new(LEFT - 14.0, y), "all three", DVec2::new(-1.0, 0.0), 6.0));
    for (t, name) in [(enters, "*hit*"), (leaves, "*out again*")] {
        svg.quiet_line(DVec2::new(x(t), row(0.0) - 20.0), DVec2::new(x(t), y), Pen::new(INK, 1.0).dashed("4 4"));
        svg.label(Label::near(DVec2::new(x(t), y), name, DVec2::new(0.0, 1.0), 14.0));
    }
    let axis = row(4.0) - 4.0;
    svg.arrow(DVec2::new(LEFT, axis), DVec2::new(WIDTH - 24.0, axis), Pen::new(INK, 1.2));
    svg.label(Label::near(DVec2::new(WIDTH - 60.0, axis), "*t*, along the ray", DVec2::new(-0.4, 1.0), 8.0));
    Ok(svg.finish(figure.about, &figure.foot(&subject, &format!("pixel {},{}", ray.pixel[0], ray.pixel[1]))))
}

/// From where to where the ray is inside each slab.
fn spans(ray: &PixelRay, slabs: &Slabs) -> [[f64; 2]; 3] {
    let f = slabs.centre - ray.origin;
    [0, 1, 2].map(|axis| {
        let (middle, approach) = (slabs.normal[axis].dot(f), slabs.normal[axis].dot(ray.direction));
        let ends = [(middle - slabs.half[axis]) / approach, (middle + slabs.half[axis]) / approach];
        if ends[0] < ends[1] { ends } else { [ends[1], ends[0]] }
    })
}

/// A little more than where any slab begins or ends, but no more than three times the length inside the cuboid to each side.
fn drawn_range(spans: &[[f64; 2]; 3]) -> (f64, f64) {
    let enters = spans.iter().map(|span| span[0]).fold(f64::NEG_INFINITY, f64::max);
    let leaves = spans.iter().map(|span| span[1]).fold(f64::INFINITY, f64::min);
    let aside = 3.0 * (leaves - enters);
    let min = spans.iter().map(|span| span[0]).fold(f64::INFINITY, f64::min).max(enters - aside);
    let max = spans.iter().map(|span| span[1]).fold(f64::NEG_INFINITY, f64::max).min(leaves + aside);
    let margin = 0.08 * (max - min);
    (min - margin, max + margin)
}

/// Of the cuboid that most rays hit, the ray whose six ends stand farthest apart on the drawing; first those that enter
/// through one pair of faces and leave through another.
fn telling<'s>(subject: &'s Subject, table: &CuboidTable) -> Option<(&'s PixelRay, [[f64; 2]; 3])> {
    let hitting = |shape: u32| subject.rays.iter().filter(move |ray| ray.hit.is_some_and(|(_, hit)| hit == shape));
    let row = (0..table.shape.len()).max_by_key(|&row| hitting(table.shape[row]).count())?;
    let slabs = &table.row[row];
    let apart = |ray: &&PixelRay| {
        let spans = spans(ray, slabs);
        let (first, last) = drawn_range(&spans);
        let mut ends: Vec<f64> = spans.iter().flatten().map(|&end| end.clamp(first, last)).collect();
        ends.sort_by(f64::total_cmp);
        let nearest = ends.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
        let last_entered = (0..3).max_by(|&a, &b| spans[a][0].total_cmp(&spans[b][0]));
        let first_left = (0..3).min_by(|&a, &b| spans[a][1].total_cmp(&spans[b][1]));
        f64::from(u8::from(last_entered != first_left)) + nearest / (last - first)
    };
    let ray = hitting(table.shape[row]).max_by(|a, b| apart(a).total_cmp(&apart(b)))?;
    Some((ray, spans(ray, slabs)))
}
