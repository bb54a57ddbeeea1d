//! Boxes around meshes: rays that run along their faces, and how often a ray that hits one hits another in it.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::label::Label;
use super::pen::{IMAGE, INK, Pen, RAY, WIDTH};
use super::picture::Picture;
use super::svg::{Drawing, Svg};
use crate::naive::boxes::{SlabTest, enters, enters_by_min_and_max, meshes_in_boxes};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::extract::MeshTable;
use pinhole::plan::{Census, Table};
use pinhole::sample::{Purpose, uniform};
use pinhole::scene::{Integrator, LookAt, OrthographicCamera, PerspectiveCamera, Sampling};
use pinhole::shapes::MeshHierarchy;
use pinhole::{Chapter, Overrides, Result};
use std::f64::consts::TAU;

const SIZE: [u32; 2] = [256, 144];
/// Pixels for each scene unit, a power of two, so that pixel centres lie on the planes between blocks.
const FINE: f64 = 64.0;

/// The scene seen along an axis, each mesh tested only where a ray enters its box: by min and max, and by signs.
pub fn draw_faces(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let exhibit = |test: SlabTest, [what, why]: [&str; 2]| -> Result<Exhibit> {
        let picture = Picture::replacing(chapter, SIZE, Some(meshes_in_boxes(test)), along_z)?;
        Ok(Exhibit { picture, lines: vec![what.to_owned(), why.to_owned()] })
    };
    let exhibits = [
        exhibit(enters_by_min_and_max, ["by `min` and `max`", "rays between two blocks miss both"])?,
        exhibit(enters, ["by signs and comparisons", "no ray is lost"])?,
    ];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}

/// An orthographic camera that looks along −z, one ray a pixel, through multiples of 1/64.
fn along_z(camera: &mut EntityWorldMut<'_>) {
    let at = DVec3::new(0.5 / FINE, 0.875 + 0.5 / FINE, 8.0);
    // Without samples, a pixel's ray goes through its centre.
    camera.remove::<(PerspectiveCamera, Sampling)>();
    camera.insert((
        OrthographicCamera { view_height: f64::from(SIZE[1]) / FINE },
        LookAt { eye: at, target: at + DVec3::NEG_Z, ..LookAt::default() },
        Integrator::RayCasting,
    ));
}

const HEIGHT: f64 = 360.0;
/// Where 0 and 0 stand, and how far 1 and 1 are from there.
const CORNER: DVec2 = DVec2::new(220.0, 300.0);
const PLOTTED: f64 = 270.0;
/// The rays that are tried with each box.
const RAYS: u32 = 20_000;

/// Of the rays that hit the box around a mesh, the fraction that hits a box of its hierarchy, over the ratio of the two
/// areas; for the boxes of all meshes' first nodes.
pub fn draw_areas(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let meshes = MeshTable::extract(&Census::of(&chapter.world(&Overrides::default())))?;
    let mut svg = Svg::new(figure.name, HEIGHT);
    let at = |x: f64, y: f64| CORNER + DVec2::new(x, -y) * PLOTTED;
    svg.line(at(0.0, 0.0), at(1.0, 0.0), Pen::new(INK, 1.2));
    svg.line(at(0.0, 0.0), at(0.0, 1.0), Pen::new(INK, 1.2));
    svg.line(at(0.0, 0.0), at(1.0, 1.0), Pen::new(IMAGE, 1.6).dashed("5 4"));
    for part in [0.0, 0.5, 1.0] {
        svg.label(Label::near(at(part, 0.0), &format!("{part}"), DVec2::Y, 8.0).title(0.85));
        svg.label(Label::near(at(0.0, part), &format!("{part}"), DVec2::NEG_X, 8.0).title(0.85));
    }
    svg.label(Label::near(at(0.5, -0.09), "area of the inner box, of the outer box's", DVec2::Y, 8.0).title(0.95));
    svg.label(Label::near(at(0.03, 1.0), "rays that hit the inner box", DVec2::X, 8.0).title(0.95));
    let mut pairs: Vec<[[DVec3; 2]; 2]> = Vec::new();
    let mut seen = Vec::new();
    for mesh in &meshes.row {
        if !seen.iter().any(|geometry| mesh.geometry.is(geometry)) {
            seen.push(mesh.geometry.clone());
            pairs.extend(first_boxes(&MeshHierarchy::of(&mesh.geometry)));
        }
    }
    if pairs.is_empty() {
        return Err(figure.unsuited("a mesh with a hierarchy"));
    }
    let mut farthest: f64 = 0.0;
    for (number, &[outer, inner]) in pairs.iter().enumerate() {
        let (ratio, fraction) = (area(inner) / area(outer), fraction_that_hits(outer, inner, RAYS, number as u32));
        let deviation = libm::sqrt(ratio * (1.0 - ratio) / f64::from(RAYS));
        farthest = farthest.max((fraction - ratio).abs() / deviation);
        svg.dot(at(ratio, fraction), 3.5, RAY);
    }
    let boxes = pairs.len();
    svg.label(Label::near(at(1.06, 0.55), &format!("{boxes} boxes; the farthest is"), DVec2::X, 0.0).title(0.85));
    let off = format!("{farthest:.1} standard errors off");
    svg.label(Label::near(at(1.06, 0.47), &off, DVec2::X, 0.0).title(0.85));
    Ok(svg.finish(figure.about, &figure.stamp([WIDTH as u32, HEIGHT as u32], &format!("{RAYS} rays a box"))))
}

/// The boxes in the first node of a hierarchy, each with the box around all.
fn first_boxes(hierarchy: &MeshHierarchy) -> Vec<[[DVec3; 2]; 2]> {
    let around = [hierarchy.bvh.around.low, hierarchy.bvh.around.high].map(|side| DVec3::from(side.map(f64::from)));
    let Some(root) = hierarchy.bvh.nodes.first() else { return Vec::new() };
    let side = |side: usize, child: usize| DVec3::from([0, 1, 2].map(|axis| f64::from(root.planes[side][axis][child])));
    let boxes = (0..root.child.len()).map(|child| [side(0, child), side(1, child)]);
    boxes.filter(|[low, high]| low.cmple(*high).all()).map(|inner| [around, inner]).collect()
}

/// The surface area of a box.
fn area([low, high]: [DVec3; 2]) -> f64 {
    let DVec3 { x, y, z } = high - low;
    2.0 * (x * y + y * z + z * x)
}

/// Of the rays that hit a box, the fraction that hits another box in it.
///
/// The uniform lines through a convex body enter it uniformly over its surface, their directions cosine-weighted.
fn fraction_that_hits(outer: [DVec3; 2], inner: [DVec3; 2], rays: u32, number: u32) -> f64 {
    let size = outer[1] - outer[0];
    let faces = [size.y * size.z, size.z * size.x, size.x * size.y];
    let hits = (0..rays).filter(|&ray| {
        let draw = |sample: u32| uniform(29, [ray, number], sample, Purpose::Direction);
        let mut chosen = draw(0) * 2.0 * faces.iter().sum::<f64>();
        let mut face = 0;
        while face < 5 && chosen >= faces[face % 3] {
            chosen -= faces[face % 3];
            face += 1;
        }
        let (axis, upper) = (face % 3, face / 3);
        let mut place = outer[0] + size * DVec3::new(draw(1), draw(2), draw(3));
        place[axis] = outer[upper][axis];
        // As a point of the unit disk under the hemisphere (Malley).
        let (radius, angle) = (libm::sqrt(draw(4)), TAU * draw(5));
        let mut direction = DVec3::ZERO;
        direction[axis] = libm::sqrt(1.0 - radius * radius) * if upper == 0 { 1.0 } else { -1.0 };
        direction[(axis + 1) % 3] = radius * libm::cos(angle);
        direction[(axis + 2) % 3] = radius * libm::sin(angle);
        enters(place, direction.recip(), inner, f64::INFINITY)
    });
    hits.count() as f64 / f64::from(rays)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_hits_an_inner_box_as_often_as_the_areas_say() {
        const RAYS: u32 = 20_000;
        let outer = [DVec3::new(-1.0, 0.0, 2.0), DVec3::new(2.0, 1.0, 4.0)];
        for (number, [low, high]) in [
            [[-1.0, 0.0, 2.0], [2.0, 1.0, 4.0]],
            [[0.0, 0.25, 2.5], [1.0, 0.75, 3.5]],
            [[-1.0, 0.0, 2.0], [2.0, 0.5, 4.0]],
            [[0.5, 0.0, 2.0], [0.5, 1.0, 4.0]],
            [[1.5, 0.75, 3.875], [1.625, 0.875, 4.0]],
        ]
        .into_iter()
        .enumerate()
        {
            let inner = [DVec3::from(low), DVec3::from(high)];
            let ratio = area(inner) / area(outer);
            let fraction = fraction_that_hits(outer, inner, RAYS, number as u32);
            let deviation = libm::sqrt(ratio * (1.0 - ratio) / f64::from(RAYS));
            eprintln!("{fraction:.4} of {RAYS} rays, the areas say {ratio:.4}");
            assert!((fraction - ratio).abs() <= 4.0 * deviation, "{fraction} {ratio}");
        }
    }
}
