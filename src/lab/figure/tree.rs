//! Trees of boxes: how they are divided, what rays are tested against in them, and what a mistake loses.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::label::Label;
use super::pen::{IMAGE, INK, Pen, RAY, WIDTH};
use super::picture::Picture;
use super::svg::{Drawing, Svg};
use crate::measure::draws::Draws;
use crate::naive::stages::{Find, first_found, through_tree};
use crate::naive::tree::{Below, Divide, Search, Tree, at_median, build, by_cost, to_visit};
use glam::{DVec2, DVec3};
use pinhole::bvh::BoundingBox;
use pinhole::extract::{MeshTable, SphereTable, camera_entity};
use pinhole::intersect::{BoxTests, PrimitiveTests, TraversalDepths};
use pinhole::plan::{Census, Column, Table};
use pinhole::rays::WorldRays;
use pinhole::render::{first_bounce_only, inspect};
use pinhole::scene::{Degrees, FovAxis, LookAt, PerspectiveCamera, Resolution, Sampling, View};
use pinhole::shapes::{PlacedMesh, PlacedSphere, Shape, TriangleRow, triangle_t};
use pinhole::{Chapter, Overrides, Result, stages};

/// Two in a row.
const SIZE: [u32; 2] = [384, 216];
const DIVISIONS: [(Divide, &str); 2] =
    [(at_median, "divided at the median"), (by_cost, "divided where it costs least")];

/// A chapter's picture, and the views of what its rays are tested against.
pub fn draw_views(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let picture = |view: Option<&str>| {
        Picture::of(chapter, SIZE, None, |camera| {
            camera.insert(Sampling { samples: 4, ..camera.get::<Sampling>().copied().unwrap_or_default() });
            if let Some(column) = view {
                camera.insert(View { column: column.into() });
            }
        })
    };
    let mut exhibits = vec![Exhibit { picture: picture(None)?, lines: vec!["the picture".into(), String::new()] }];
    for name in [BoxTests::NAME, PrimitiveTests::NAME, TraversalDepths::NAME] {
        let [mean, max] = mean_and_most(chapter, name)?;
        let line = format!("{mean:.1} on average, {max:.0} at most");
        exhibits.push(Exhibit { picture: picture(Some(name))?, lines: vec![format!("`{name}`"), line] });
    }
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}

/// A view's counts over the rays through the centres of all pixels.
fn mean_and_most(chapter: &Chapter, view: &str) -> Result<[f64; 2]> {
    let inspected = through_centres(chapter, Some(view))?;
    let counts = inspected.tiles.iter().flat_map(|&tile| {
        let tile = inspected.world.entity(tile);
        let one = |numbers: Option<&Vec<u32>>| numbers.cloned().unwrap_or_default();
        [
            one(tile.get::<BoxTests>().map(|column| &column.boxes)),
            one(tile.get::<PrimitiveTests>().map(|column| &column.primitives)),
            one(tile.get::<TraversalDepths>().map(|column| &column.depth)),
        ]
        .concat()
    });
    let (mut sum, mut max, mut number) = (0.0, 0.0, 0.0);
    for count in counts.map(f64::from) {
        (sum, max, number) = (sum + count, f64::max(max, count), number + 1.0);
    }
    Ok([sum / f64::max(number, 1.0), max])
}

/// The first bounce of a chapter with a ray through the centre of each pixel.
fn through_centres(chapter: &Chapter, view: Option<&str>) -> Result<pinhole::render::Inspection> {
    let [width, height] = SIZE;
    let mut whole = chapter.clone();
    (whole.view, whole.offer) = (None, stages::all());
    let asked = Overrides { resolution: Some(Resolution { width, height }), ..Overrides::default() };
    let mut scene = whole.world(&asked);
    let camera = camera_entity(&scene)?;
    let mut camera = scene.entity_mut(camera);
    camera.remove::<Sampling>();
    if let Some(column) = view {
        camera.insert(View { column: column.into() });
    }
    inspect(&scene, &first_bounce_only(&whole.stages()), width.max(height))
}

/// A primitive of a figure's trees.
enum Part {
    Sphere(PlacedSphere),
    Mesh(PlacedMesh),
    Triangle(TriangleRow),
}

/// The bounded things of a chapter's scene and the boxes around them: spheres, the triangles of the mesh that has most,
/// and the other meshes as a whole.
struct Parts {
    parts: Vec<Part>,
    boxes: Vec<BoundingBox>,
}

impl Parts {
    fn of(chapter: &Chapter) -> Result<Self> {
        let scene = chapter.world(&Overrides::default());
        let census = Census::of(&scene);
        let (spheres, meshes) = (SphereTable::extract(&census)?, MeshTable::extract(&census)?);
        let mut parts: Vec<Part> = spheres.row.into_iter().map(Part::Sphere).collect();
        let max = meshes.row.iter().map(|mesh| mesh.geometry.triangles.len()).max();
        for mesh in meshes.row {
            if Some(mesh.geometry.triangles.len()) == max {
                let row = |corners| TriangleRow { corners, size: 1.0, centre: DVec3::ZERO, bounding_radius: 0.0 };
                parts.extend(mesh.placed_triangles().map(|corners| Part::Triangle(row(corners))));
            } else {
                parts.push(Part::Mesh(mesh));
            }
        }
        let boxes = parts.iter().map(Part::around).collect();
        Ok(Self { parts, boxes })
    }

    fn tree(&self, divide: Divide) -> Tree {
        build(&self.boxes, (0..self.boxes.len()).collect(), divide)
    }
}

impl Part {
    fn around(&self) -> BoundingBox {
        let bounds = match self {
            Self::Sphere(sphere) => sphere.bounds(),
            Self::Mesh(mesh) => mesh.bounds(),
            Self::Triangle(TriangleRow { corners: [a, b, c], .. }) => {
                return BoundingBox::around(a.min(*b).min(*c), a.max(*b).max(*c));
            }
        };
        bounds.map_or_else(BoundingBox::default, |bounds| BoundingBox::around(bounds.min, bounds.max))
    }

    fn t(&self, [origin, direction]: [DVec3; 2]) -> f64 {
        match self {
            Self::Sphere(sphere) => sphere.t(origin, direction),
            Self::Mesh(mesh) => mesh.t(origin, direction),
            Self::Triangle(triangle) => triangle_t(origin, direction, triangle),
        }
    }
}

/// The number of tests in two trees over the same parts, pixel by pixel.
pub fn draw_divisions(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let parts = Parts::of(chapter)?;
    let inspected = through_centres(chapter, None)?;
    let tiles = || inspected.tiles.iter().filter_map(|&tile| inspected.world.entity(tile).get::<WorldRays>());
    let mut exhibits = Vec::new();
    for (divide, title) in DIVISIONS {
        let tree = parts.tree(divide);
        let (mut pixels, mut boxes, mut primitives) = (Vec::new(), 0, 0);
        for rays in tiles() {
            for row in 0..rays.rows() {
                let ray = [rays.origin_of(row), rays.direction_of(row)];
                let mut search = Search::new(ray, f64::INFINITY);
                tree.closest(&mut search, &to_visit, &mut |number| parts.parts[number].t(ray));
                (boxes, primitives) = (boxes + search.boxes, primitives + search.primitives);
                let tests = BoxTests { boxes: vec![(search.boxes + search.primitives) as u32] };
                pixels.push(tests.paint(0, SIZE).map(linear));
            }
        }
        let of = |count: usize| count as f64 / pixels.len() as f64;
        let line = format!("{:.1} boxes and {:.1} primitives a ray", of(boxes), of(primitives));
        exhibits.push(Exhibit { picture: Picture::painted(SIZE, &pixels)?, lines: vec![title.into(), line] });
    }
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}

/// The light that a byte of a picture shows.
fn linear(part: f32) -> f32 {
    if part <= 0.04045 { part / 12.92 } else { libm::powf((part + 0.055) / 1.055, 2.4) }
}

/// The first boxes of both trees, from above.
pub fn draw_boxes(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const HEIGHT: f64 = 400.0;
    let parts = Parts::of(chapter)?;
    let mut svg = Svg::new(figure.name, HEIGHT);
    for (panel, (divide, title)) in DIVISIONS.into_iter().enumerate() {
        let tree = parts.tree(divide);
        let [low, high] = [tree.around.low, tree.around.high].map(|[x, _, z]| DVec2::new(x.into(), z.into()));
        let scale = 332.0 / (high - low).max_element();
        let corner = DVec2::new(14.0 + panel as f64 * WIDTH / 2.0, 30.0);
        let at = |x: f32, z: f32| corner + (DVec2::new(x.into(), z.into()) - low) * scale;
        let outline = |svg: &mut Svg, around: &BoundingBox, pen: Pen| {
            let ([x, _, z], [right, _, front]) = (around.low, around.high);
            svg.polygon(&[at(x, z), at(right, z), at(right, front), at(x, front)], None, Some(pen));
        };
        for around in parts.boxes.iter().step_by(parts.boxes.len() / 1200 + 1) {
            outline(&mut svg, around, Pen::new(INK, 0.6).faint(0.3));
        }
        let mut level = vec![&tree];
        for pen in [Pen::new(IMAGE, 4.0), Pen::new(RAY, 2.6), Pen::new(IMAGE, 1.6), Pen::new(RAY, 1.0)] {
            level.iter().for_each(|tree| outline(&mut svg, &tree.around, pen));
            level = level.into_iter().flat_map(children).collect();
        }
        let middle = DVec2::new(corner.x + 0.5 * scale * (high.x - low.x), 14.0);
        svg.label(Label::near(middle, title, DVec2::Y, 0.0).title(0.95));
        let form = tree.form();
        let line = format!("{} leaves, at most {} nodes above one another", form[0], form[1]);
        let below = DVec2::new(middle.x, corner.y + scale * (high.y - low.y));
        svg.label(Label::near(below, &line, DVec2::Y, 8.0).title(0.85));
    }
    Ok(svg.finish(figure.about, &figure.stamp(SIZE, "from above: all, and three levels of boxes below it")))
}

fn children(tree: &Tree) -> Vec<&Tree> {
    match &tree.below {
        Below::Primitives(_) => Vec::new(),
        Below::Trees(trees) => trees.iter().collect(),
    }
}

/// What a ray is tested against, over the number of spheres: everything, or two trees.
pub fn draw_growth(_: &Chapter, figure: &Figure) -> Result<Drawing> {
    const HEIGHT: f64 = 330.0;
    const RAYS: u64 = 300;
    let (corner, size) = (DVec2::new(64.0, 262.0), DVec2::new(500.0, 226.0));
    let counts = [10, 30, 100, 300, 1000, 3000, 10_000];
    let mut curves: Vec<(&str, &'static str, Vec<f64>)> = vec![("all of them", INK, Vec::new())];
    curves.extend([("median", IMAGE, Vec::new()), ("least cost", RAY, Vec::new())]);
    for count in counts {
        let spheres = random_spheres(count);
        curves[0].2.push(count as f64);
        for (curve, (divide, _)) in DIVISIONS.into_iter().enumerate() {
            let tree = Tree::of_shapes(&spheres, divide);
            let tests = (0..RAYS).map(|index| {
                let mut draws = Draws::new(3005, index);
                let origin = DVec3::from([(); 3].map(|()| draws.between(-1.0, 1.0)));
                let ray = [origin, draws.unit_vector()];
                let mut search = Search::new(ray, f64::INFINITY);
                tree.closest(&mut search, &to_visit, &mut |number| spheres[number].t(ray[0], ray[1]));
                search.boxes + search.primitives
            });
            curves[curve + 1].2.push(tests.sum::<usize>() as f64 / RAYS as f64);
        }
    }
    let top = 1.15 * curves[1..].iter().flat_map(|(.., tests)| tests).fold(0.0, |max, &tests| f64::max(max, tests));
    let at =
        |count: f64, tests: f64| corner + DVec2::new((libm::log10(count) - 1.0) / 3.0, -(tests / top).min(1.0)) * size;
    let mut svg = Svg::new(figure.name, HEIGHT);
    svg.line(at(10.0, 0.0), at(10_000.0, 0.0), Pen::new(INK, 1.2));
    svg.line(at(10.0, 0.0), at(10.0, top), Pen::new(INK, 1.2));
    for count in [10, 100, 1000, 10_000] {
        let place = at(f64::from(count), 0.0);
        svg.label(Label::near(place, &count.to_string(), DVec2::Y, 6.0).title(0.85));
    }
    for tests in (0..6).map(|step| f64::from(step) * 50.0).filter(|&tests| tests < top) {
        svg.quiet_line(at(10.0, tests), at(10_000.0, tests), Pen::new(INK, 0.8).faint(0.18));
        svg.label(Label::near(at(10.0, tests), &format!("{tests:.0}"), DVec2::NEG_X, 6.0).title(0.85));
    }
    for (name, colour, tests) in &curves {
        let points: Vec<DVec2> = counts.iter().zip(tests).map(|(&count, &tests)| at(count as f64, tests)).collect();
        for (pair, tests) in points.windows(2).zip(tests).filter(|(_, tests)| **tests < top) {
            svg.line(pair[0], pair[1], Pen::new(colour, 2.0));
            svg.dot(pair[0], if *tests < top { 3.0 } else { 0.0 }, colour);
        }
        let Some((&end, &last)) = points.last().zip(tests.last()) else { continue };
        if last < top {
            svg.dot(end, 3.0, colour);
            let text = format!("{name}: {last:.0}");
            svg.label(Label::near(end, &text, DVec2::X, 8.0).coloured(colour).title(0.9));
        } else {
            svg.label(Label::near(at(100.0, top), name, DVec2::X, 14.0).title(0.9));
        }
    }
    svg.label(Label::near(at(330.0, 0.0), "spheres", DVec2::Y, 24.0).title(0.9));
    svg.label(Label::near(at(10.0, top), "boxes and spheres a ray", DVec2::new(1.0, -1.0), 10.0).title(0.9));
    let note = format!("{RAYS} random rays a point, in a cube of random spheres");
    Ok(svg.finish(figure.about, &figure.stamp(SIZE, &note)))
}

/// So many spheres in a cube, which fill the same part of it at any number.
fn random_spheres(count: usize) -> Vec<PlacedSphere> {
    let radius = 0.5 / libm::cbrt(count as f64);
    let mut draws = Draws::new(3004, 0);
    let centre = |draws: &mut Draws| DVec3::from([(); 3].map(|()| draws.between(-1.0, 1.0)));
    (0..count).map(|_| PlacedSphere { centre: centre(&mut draws), radius }).collect()
}

/// Pebbles through a tree, and through one whose farther child is left out once something was hit.
pub fn draw_first_found(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let right: Find = |tree, search, spheres| {
        let ray = search.ray;
        tree.closest(search, &to_visit, &mut |number| spheres[number].t(ray[0], ray[1]));
    };
    let exhibit = |find: Find, lines: [&str; 2]| {
        let picture = Picture::replacing(chapter, SIZE, Some(through_tree(find)), |camera| {
            // Lower and with a longer lens, so that more pebbles stand behind one another.
            let mut look = camera.get::<LookAt>().copied().unwrap_or_default();
            look.eye.y *= 0.35;
            let lens = PerspectiveCamera { fov: Degrees(16.0), axis: FovAxis::Vertical };
            let sampling = Sampling { samples: 2, ..camera.get::<Sampling>().copied().unwrap_or_default() };
            camera.insert((look, lens, sampling));
        })?;
        Ok(Exhibit { picture, lines: lines.map(str::to_owned).to_vec() })
    };
    let exhibits = [
        exhibit(right, ["both boxes where they are entered", "up to the closest hit"]),
        exhibit(first_found, ["the first hit that is found", "pebbles behind others are in front of them"]),
    ];
    let exhibits = exhibits.into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}
