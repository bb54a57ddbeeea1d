//! Trees of eight children: their boxes, their bytes, and packets of rays that go through them.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::label::Label;
use super::pen::{Fill, IMAGE, INK, Pen, RAY, WIDTH as DRAWN};
use super::picture::Picture;
use super::svg::{Drawing, Svg};
use crate::naive::stages::in_packets;
use glam::{DVec2, DVec3};
use pinhole::bvh::{Bvh, Child, ChildKind, WIDTH, WideNode};
use pinhole::extract::{SphereTable, eye};
use pinhole::plan::{Census, Table};
use pinhole::scene::{Degrees, FovAxis, Integrator, LightStrategy, LookAt, PerspectiveCamera, Sampling};
use pinhole::shapes::{PlacedSphere, hierarchy_of};
use pinhole::{Chapter, Overrides, Result};
use std::mem::offset_of;

/// The hierarchy over a chapter's spheres.
fn over_spheres(chapter: &Chapter, figure: &Figure) -> Result<(Vec<PlacedSphere>, Bvh)> {
    let scene = chapter.world(&Overrides::default());
    let spheres = SphereTable::extract(&Census::of(&scene))?.row;
    let bvh = hierarchy_of(&spheres).filter(|bvh| bvh.nodes.len() > 1);
    bvh.map(|bvh| (spheres, bvh)).ok_or_else(|| figure.unsuited("spheres enough for two levels of nodes"))
}

/// The children of a node that are there.
fn children(node: &WideNode) -> Vec<usize> {
    (0..WIDTH).filter(|&child| node.child[child] != Child::NONE).collect()
}

/// The boxes of the root's children, and of the children of the one that has most of the area, from the front.
pub fn draw_children(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let (spheres, bvh) = over_spheres(chapter, figure)?;
    let [low, high] = [bvh.around.low, bvh.around.high].map(|[x, y, _]| DVec2::new(x.into(), y.into()));
    let scale = (320.0 / (high.x - low.x)).min(380.0 / (high.y - low.y));
    let top = 40.0;
    let mut svg = Svg::new(figure.name, top + scale * (high.y - low.y) + 56.0);
    let area = |node: &WideNode, child: usize| {
        let [x, y, z] = [0, 1, 2].map(|axis| node.planes[1][axis][child] - node.planes[0][axis][child]);
        x * y + y * z + z * x
    };
    let root = &bvh.nodes[0];
    let inner = children(root).into_iter().filter_map(|child| match root.child[child].kind() {
        ChildKind::Node(number) => Some((child, number)),
        ChildKind::Leaf(_) => None,
    });
    let (widest, below) = inner
        .max_by(|a, b| area(root, a.0).total_cmp(&area(root, b.0)))
        .ok_or_else(|| figure.unsuited("two levels of nodes"))?;
    for (panel, node) in [root, &bvh.nodes[below]].into_iter().enumerate() {
        let left = (0.5 * DRAWN - scale * (high.x - low.x)) / 2.0 + 0.5 * DRAWN * panel as f64;
        let at = |x: f64, y: f64| DVec2::new(left + (x - low.x) * scale, top + (high.y - y) * scale);
        for sphere in spheres.iter().step_by(2) {
            let pen = Pen::new(INK, 0.6).faint(0.35);
            svg.circle(at(sphere.centre.x, sphere.centre.y), (sphere.radius * scale).max(0.4), None, Some(pen));
        }
        let outline = |svg: &mut Svg, node: &WideNode, child: usize, fill: Option<&Fill>, pen: Pen| {
            let [[x, right], [y, up]] = [0, 1].map(|axis| [0, 1].map(|side| f64::from(node.planes[side][axis][child])));
            svg.polygon(&[at(x, y), at(right, y), at(right, up), at(x, up)], fill, Some(pen));
        };
        for child in children(node) {
            let chosen = panel == 0 && child == widest;
            let (colour, opacity) = if chosen { (RAY, 0.16) } else { (IMAGE, 0.07) };
            outline(&mut svg, node, child, Some(&Fill::new(colour, opacity)), Pen::new(colour, 1.8));
        }
        if panel == 1 {
            outline(&mut svg, root, widest, None, Pen::new(RAY, 2.4).dashed("6 4"));
        }
        let title = ["the eight boxes of the root", "those of one of its children"][panel];
        let middle = DVec2::new(left + 0.5 * scale * (high.x - low.x), 18.0);
        svg.label(Label::near(middle, title, DVec2::Y, 0.0).title(0.95));
    }
    let max = bvh.nodes.iter().map(|node| children(node).len()).sum::<usize>() as f64 / bvh.nodes.len() as f64;
    let line = format!(
        "{} spheres in {} leaves and {} nodes, which have {max:.1} children on average",
        spheres.len(),
        bvh.leaves.len(),
        bvh.nodes.len()
    );
    let below = DVec2::new(0.5 * DRAWN, top + scale * (high.y - low.y));
    svg.label(Label::near(below, &line, DVec2::Y, 10.0).title(0.9));
    Ok(svg.finish(figure.about, &figure.stamp([480, 270], "the spheres and their boxes from the front")))
}

/// The bytes of a node, a cache line in each row.
pub fn draw_layout(_: &Chapter, figure: &Figure) -> Result<Drawing> {
    const LINE: usize = 64;
    const ROW: f64 = 44.0;
    let (left, top, byte) = (96.0, 46.0, 600.0 / LINE as f64);
    let lines = size_of::<WideNode>() / LINE;
    let mut svg = Svg::new(figure.name, top + ROW * lines as f64 + 60.0);
    let planes = offset_of!(WideNode, planes);
    let row = WIDTH * size_of::<f32>();
    let mut fields: Vec<(usize, usize, String, &str)> = Vec::new();
    for (side, word) in ["lower", "upper"].into_iter().enumerate() {
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            fields.push((planes + (3 * side + axis) * row, row, format!("{word} *{name}* of 8"), IMAGE));
        }
    }
    fields.push((offset_of!(WideNode, child), WIDTH * size_of::<Child>(), "8 children".into(), RAY));
    let end = fields.iter().map(|(start, length, ..)| start + length).max().unwrap_or(0);
    if end < size_of::<WideNode>() {
        fields.push((end, size_of::<WideNode>() - end, "to spare".into(), INK));
    }
    for (start, length, name, colour) in &fields {
        let low = DVec2::new(left + (start % LINE) as f64 * byte, top + (start / LINE) as f64 * ROW);
        let size = DVec2::new(*length as f64 * byte, ROW - 8.0);
        let corners = [low, low + DVec2::X * size.x, low + size, low + DVec2::Y * size.y];
        svg.polygon(&corners, Some(&Fill::new(*colour, 0.16)), Some(Pen::new(INK, 1.0).faint(0.6)));
        svg.label(Label::near(low + 0.5 * size - DVec2::Y * 7.0, name, DVec2::Y, 0.0).title(0.9));
    }
    for line in 0..lines {
        let at = DVec2::new(left, top + (line as f64 + 0.5) * ROW - 4.0);
        svg.label(Label::near(at, &format!("byte {}", line * LINE), DVec2::NEG_X, 10.0).title(0.85));
    }
    let head = DVec2::new(left + 300.0, 20.0);
    let words = format!("a node: {} bytes in {lines} cache lines of {LINE}", size_of::<WideNode>());
    svg.label(Label::near(head, &words, DVec2::Y, 0.0).title(0.95));
    Ok(svg.finish(figure.about, &figure.stamp([480, 270], "any node of its hierarchies")))
}

/// The picture, and what becomes of it where a packet takes its first ray's signs for those of all.
pub fn draw_signs(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SIZE: [u32; 2] = [384, 216];
    // From right in front of the spheres, so that directions change their signs there.
    let (spheres, _) = over_spheres(chapter, figure)?;
    let scene = chapter.world(&Overrides::default());
    let from_eye = spheres.iter().map(|sphere| sphere.centre).sum::<DVec3>() / spheres.len() as f64;
    let target = eye(&Census::of(&scene))? + from_eye;
    let look = LookAt { eye: target + DVec3::Z * from_eye.length(), target, ..LookAt::default() };
    let exhibit = |taken_for_granted: bool, lines: [&str; 2]| -> Result<Exhibit> {
        let picture = Picture::replacing(chapter, SIZE, Some(in_packets(taken_for_granted)), |camera| {
            let lens = PerspectiveCamera { fov: Degrees(24.0), axis: FovAxis::Vertical };
            let sampling = Sampling { samples: 4, ..camera.get::<Sampling>().copied().unwrap_or_default() };
            let direct = Integrator::Path { max_depth: 2, lights: LightStrategy::Light, roulette: 0 };
            camera.insert((look, lens, sampling, direct));
        })?;
        Ok(Exhibit { picture, lines: lines.map(str::to_owned).to_vec() })
    };
    let exhibits = [
        exhibit(false, ["each ray by its own signs", "as it should be"])?,
        exhibit(true, ["64 rays by the signs of the first", "where signs differ, rays miss"])?,
    ];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::naive::wide::{closest, entered, first_planes};
    use pinhole::shapes::Shape;

    #[test]
    fn a_ray_whose_signs_are_another_s_misses() {
        let spheres: Vec<PlacedSphere> = (0..40)
            .map(|number| PlacedSphere { centre: DVec3::new(f64::from(number) - 20.0, 0.0, -9.0), radius: 0.4 })
            .collect();
        let bvh = hierarchy_of(&spheres).expect("bounded");
        let ray = [DVec3::ZERO, DVec3::new(-3.0, 0.0, -9.0)];
        let t_of = |number: usize| spheres[number].t(ray[0], ray[1]);
        let hit = |first| closest(&bvh, (ray, first), f64::INFINITY, entered, t_of).1;
        assert_eq!(hit(first_planes(ray[1])), 17);
        assert_eq!(hit(first_planes(DVec3::new(3.0, 0.0, -9.0))), usize::MAX);
    }
}
