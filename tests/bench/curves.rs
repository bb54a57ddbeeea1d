//! What a ray costs against the number of spheres and of triangles: `cargo bench --bench curves`.
//!
//! `--max 1000000` ends the curves there; `--only spheres` or `--only triangles` draws one of them; `--write` keeps both
//! beside chapter 31, whose page shows them.
//! Spheres lie at random in a cube and fill the same part of it at any number; triangles are those of a torus knot.
//! Coherent rays are those of a camera in 8 × 8 tiles, random ones start in the cube and go anywhere.
//! Each time is the least of five, of one thread, in processor time; where testing everything would take too long, fewer
//! rays do it.
//! The binary tree is the laboratory's plain one, of single boxes and single triangles in f64; rays alone are traced in
//! columns too short for packets and for lockstep.
//! For some kinds of shapes beside, it is timed from how many on a hierarchy pays.
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

use cpu_time::ProcessTime;
use glam::DVec3;
use pinhole::bvh::BoundingBox;
use pinhole::intersect::NO_SHAPE;
use pinhole::scene::{MeshGeometry, MeshInstance, Placement};
use pinhole::shapes::{
    ClosestHits, Ellipsoid, HierarchyRoom, MeshHierarchy, PlacedCylinder, PlacedDisk, PlacedMesh, PlacedRectangle,
};
use pinhole::shapes::{PlacedSphere, PlacedTorus, RaySlices, Shape, Slabs, TriangleRow};
use pinhole::shapes::{hierarchy_of, keep_closest_of, triangle_t};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::oracle::Oracle;
use pinhole_lab::measure::specimen::{Specimen, shapes_in_a_cube};
use pinhole_lab::measure::torus_knot::{steps_for, torus_knot};
use pinhole_lab::naive::tree::{Search, Tree, build as build_tree, by_cost, to_visit};
use pinhole_lab::report::provenance::{Provenance, processor_and_caches};

/// The rays that a stage gets at once.
const BATCH: usize = 1024;
/// The side of the picture whose rays are coherent; as many rays are random.
const SIDE: usize = 256;
const ROUNDS: usize = 5;
/// A column of so few rays has no packet, and its rays go alone.
const ALONE: usize = 8;
/// The most primitives that are all tested, and that are put in the binary tree.
const MAX_ALL: usize = 120_000;
const MAX_BINARY: usize = 1_200_000;

const CHAPTER: &str = "31_wide_tree";

/// Rays as the columns of a tile hold them.
struct Rays([Vec<f32>; 6]);

impl Rays {
    fn of(rays: impl Iterator<Item = [DVec3; 2]>) -> Self {
        let mut columns: [Vec<f32>; 6] = Default::default();
        for [origin, direction] in rays {
            let direction = direction.normalize();
            for axis in 0..3 {
                columns[axis].push(origin[axis] as f32);
                columns[axis + 3].push(direction[axis] as f32);
            }
        }
        Self(columns)
    }

    /// Those of a camera on the z axis that sees a cube of this half side, tile by tile.
    fn coherent(half: f64) -> Self {
        let tiles = (0..SIDE / 8).flat_map(|y| (0..SIDE / 8).map(move |x| [8 * x, 8 * y]));
        let pixels = tiles.flat_map(|[x, y]| (0..64).map(move |at| [x + at % 8, y + at / 8]));
        let eye = DVec3::new(0.1, 0.2, 4.0) * half;
        Self::of(pixels.map(move |pixel| {
            let [x, y] = pixel.map(|at| (2.0 * (at as f64 + 0.5) / SIDE as f64 - 1.0) * half);
            [eye, DVec3::new(x, y, 0.0) - eye]
        }))
    }

    fn random(half: f64) -> Self {
        let mut draws = Draws::new(77, 0);
        Self::of((0..SIDE * SIDE).map(move |_| {
            let origin = DVec3::from([(); 3].map(|()| draws.between(-half, half)));
            [origin, draws.unit_vector()]
        }))
    }

    /// Nanoseconds a ray that a kernel takes, and the part of the rays that hits something; `rows` rays in columns of
    /// `batch`.
    fn time(
        &self,
        rows: usize,
        batch: usize,
        mut keep_closest: impl FnMut(RaySlices<'_>, ClosestHits<'_>),
    ) -> (f64, f64) {
        let rows = rows.min(self.0[0].len());
        let (mut min, mut hit) = (f64::INFINITY, 0);
        for _ in 0..ROUNDS {
            let (mut t, mut shape) = (vec![f64::INFINITY; rows], vec![NO_SHAPE; rows]);
            let start = ProcessTime::now();
            for first in (0..rows).step_by(batch) {
                let batch = first..rows.min(first + batch);
                let [ox, oy, oz, dx, dy, dz] = self.0.each_ref().map(|column| &column[batch.clone()]);
                let rays = RaySlices { origin: [ox, oy, oz], direction: [dx, dy, dz] };
                let (t, shape) = (&mut t[batch.clone()], &mut shape[batch]);
                keep_closest(rays, ClosestHits { t, shape, primitive: None, any: false });
            }
            min = min.min(start.elapsed().as_nanos() as f64 / rows as f64);
            hit = shape.iter().filter(|shape| **shape != NO_SHAPE).count();
        }
        (min, hit as f64 / rows as f64)
    }
}

/// So many rays test everything where there are so many primitives.
fn rays_for(primitives: usize) -> usize {
    (200_000_000 / primitives).clamp(BATCH, SIDE * SIDE)
}

/// A table of numbers, a row for each count.
struct Curve {
    title: String,
    columns: Vec<&'static str>,
    rows: Vec<(usize, Vec<Option<f64>>)>,
}

impl Curve {
    fn new(title: &str, columns: &[&'static str]) -> Self {
        println!("{title}");
        Self { title: title.into(), columns: columns.to_vec(), rows: Vec::new() }
    }

    /// Keeps a row and prints it.
    fn push(&mut self, count: usize, row: Vec<Option<f64>>) {
        self.rows.push((count, row));
        if self.rows.len() == 1 {
            println!("{}", self.lines()[0]);
        }
        println!("{}", self.lines()[self.rows.len()]);
    }

    /// The names of its columns, and a line for each row.
    fn lines(&self) -> Vec<String> {
        let named = |name: &&str| format!("  {name:>10}");
        let mut lines = vec![format!("{:>9}{}", "count", self.columns.iter().map(named).collect::<String>())];
        for (count, row) in &self.rows {
            let shown = |(value, name): (&Option<f64>, &&str)| {
                let number = value.map_or_else(|| "-".into(), |value| format!("{value:.1}"));
                format!("  {number:>width$}", width = name.len().max(10))
            };
            let shown: String = row.iter().zip(&self.columns).map(shown).collect();
            lines.push(format!("{count:>9}{shown}"));
        }
        lines
    }
}

/// Where a hierarchy begins to pay for a kind of shape.
fn shape_curve<S: Oracle>(plural: &str, counts: &[usize]) {
    let columns = ["tree, coherent", "all, coherent", "tree, random", "all, random"];
    let mut curve = Curve::new(plural, &columns);
    let sets = [Rays::coherent(1.0), Rays::random(1.0)];
    for &count in counts {
        let shapes = shapes_in_a_cube::<S>(count);
        let numbers: Vec<u32> = (0..count as u32).collect();
        let (bvh, prepared) = (hierarchy_of(&shapes).expect("bounded shapes"), S::prepared(&shapes));
        let row = sets.iter().flat_map(|rays| {
            let (all, mut room) = (SIDE * SIDE, HierarchyRoom::default());
            let (tree, hits) =
                rays.time(all, BATCH, |rays, hits| keep_closest_of((&shapes, &numbers, &bvh), rays, hits, &mut room));
            let (one_by_one, same) = rays.time(all, BATCH, |rays, hits| {
                S::keep_closest((&shapes, &prepared), &numbers, rays, hits);
            });
            assert_eq!(hits, same, "{count} {plural}");
            [Some(tree), Some(one_by_one)]
        });
        curve.push(count, row.collect());
    }
}

/// One ray after another through the laboratory's tree.
fn through_plain_tree(
    tree: &Tree,
    t_of: impl Fn(usize, [DVec3; 2]) -> f64,
) -> impl FnMut(RaySlices<'_>, ClosestHits<'_>) {
    move |rays, hits| {
        for row in 0..hits.t.len() {
            let ray = rays.ray(row);
            let mut search = Search::new(ray, hits.t[row]);
            tree.closest(&mut search, &to_visit, &mut |number| t_of(number, ray));
            (hits.t[row], hits.shape[row]) = (search.t, search.number.min(NO_SHAPE as usize) as u32);
        }
    }
}

const SPHERES: [&str; 7] =
    ["all, random", "binary, random", "wide, random", "all, coherent", "wide, coherent", "hierarchy KiB", "build ms"];

fn sphere_curve(counts: &[usize]) -> Curve {
    let mut curve = Curve::new("spheres at random in a cube", &SPHERES);
    let [coherent, random] = [Rays::coherent(1.0), Rays::random(1.0)];
    let whole = SIDE * SIDE;
    for &count in counts {
        let shapes = shapes_in_a_cube::<PlacedSphere>(count);
        let numbers: Vec<u32> = (0..count as u32).collect();
        let start = ProcessTime::now();
        let bvh = hierarchy_of(&shapes).expect("bounded shapes");
        let build = 1e3 * start.elapsed().as_secs_f64();
        let wide = |rays: &Rays| {
            let mut room = HierarchyRoom::default();
            rays.time(whole, BATCH, |rays, hits| keep_closest_of((&shapes, &numbers, &bvh), rays, hits, &mut room)).0
        };
        let all = |rays: &Rays| {
            let few = rays_for(count);
            let kernel = |rays: RaySlices<'_>, hits: ClosestHits<'_>| {
                PlacedSphere::keep_closest((&shapes, &()), &numbers, rays, hits);
            };
            (count <= MAX_ALL).then(|| rays.time(few, BATCH, kernel).0)
        };
        let binary = (count <= MAX_BINARY).then(|| {
            let tree = Tree::of_shapes(&shapes, by_cost);
            random.time(whole, BATCH, through_plain_tree(&tree, |at, [o, d]| shapes[at].t(o, d))).0
        });
        let row = [all(&random), binary, Some(wide(&random)), all(&coherent), Some(wide(&coherent))];
        let rest = [bvh.bytes() as f64 / 1024.0, build].map(Some);
        curve.push(count, row.into_iter().chain(rest).collect());
    }
    curve
}

const TRIANGLES: [&str; 8] = [
    "all, random",
    "binary, random",
    "alone, random",
    "lockstep, random",
    "alone, coherent",
    "packets, coherent",
    "hierarchy KiB",
    "build ms",
];

fn triangle_curve(max: usize) -> Curve {
    let mut curve = Curve::new("triangles of a torus knot", &TRIANGLES);
    let [coherent, random] = [Rays::coherent(3.5), Rays::random(3.0)];
    let whole = SIDE * SIDE;
    for power in 4..=14 {
        let [along, around] = steps_for(power);
        let geometry = MeshGeometry::new(torus_knot(along, around));
        let count = geometry.triangles.len();
        if count > max + max / 4 {
            break;
        }
        let start = ProcessTime::now();
        let bytes = MeshHierarchy::of(&geometry).bytes();
        let build = 1e3 * start.elapsed().as_secs_f64();
        let binary = (count <= MAX_BINARY).then(|| {
            let row = |triangle: usize| {
                let corners = geometry.corners(triangle).map(|corner| DVec3::from(corner.map(f64::from)));
                TriangleRow { corners, size: 10.0, centre: DVec3::ZERO, bounding_radius: 0.0 }
            };
            let rows: Vec<TriangleRow> = (0..count).map(row).collect();
            let around = |TriangleRow { corners: [a, b, c], .. }: &TriangleRow| {
                BoundingBox::around(a.min(*b).min(*c), a.max(*b).max(*c))
            };
            let tree = build_tree(&rows.iter().map(around).collect::<Vec<_>>(), (0..count).collect(), by_cost);
            random.time(whole, BATCH, through_plain_tree(&tree, |at, [o, d]| triangle_t(o, d, &rows[at])))
        });
        let mesh = Specimen::<PlacedMesh>::of(MeshInstance { geometry }, Placement::default()).expect("a mesh").shape;
        let one = std::slice::from_ref(&mesh);
        let all = (count <= MAX_ALL).then(|| {
            random.time(rays_for(count), BATCH, |rays, hits| {
                for row in 0..hits.t.len() {
                    let [origin, direction] = rays.ray(row);
                    let closest = mesh.closest_of_all(origin, direction);
                    (hits.t[row], hits.shape[row]) = (closest.t, closest.shape);
                }
            })
        });
        let wide = |rays: &Rays, batch: usize| {
            rays.time(whole, batch, |rays, hits| PlacedMesh::keep_closest((one, &()), &[0], rays, hits))
        };
        let [alone, lockstep] = [ALONE, BATCH].map(|batch| wide(&random, batch));
        let [coherent_alone, packets] = [ALONE, BATCH].map(|batch| wide(&coherent, batch));
        assert!(alone.1 == lockstep.1 && coherent_alone.1 == packets.1, "{count} triangles: other rays hit");
        assert!(binary.is_none_or(|(_, hits)| hits == alone.1), "{count} triangles: other rays hit the binary tree");
        let row = [all, binary, Some(alone), Some(lockstep), Some(coherent_alone), Some(packets)];
        let rest = [bytes as f64 / 1024.0, build].map(Some);
        curve.push(count, row.into_iter().map(|timed| timed.map(|(ns, _)| ns)).chain(rest).collect());
    }
    curve
}

/// Keeps the curves beside their chapter.
fn keep(curves: &[Curve]) {
    let head = "nanoseconds a ray, processor time of one thread, the least of five; - is not measured";
    let mut text = format!("{head}\n");
    for curve in curves {
        text += &format!("\n{}\n{}\n", curve.title, curve.lines().join("\n"));
    }
    text += &format!("\n{}\n{}\n", processor_and_caches(), Provenance::now(String::new()).measured());
    let file = format!("{}/chapters/{CHAPTER}/curves.txt", env!("CARGO_MANIFEST_DIR"));
    std::fs::write(file, text).expect("the curves can be written");
}

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let after = |flag: &str| words.iter().position(|word| word == flag).and_then(|at| words.get(at + 1));
    let max = after("--most").map_or(10_000_000, |max| max.parse().expect("a number"));
    let only = after("--only");
    let wants = |what: &str| only.is_none_or(|only| only == what);
    let mut curves = Vec::new();
    if wants("triangles") {
        curves.push(triangle_curve(max));
    }
    if wants("spheres") {
        let counts = (4..=12).map(|power| libm::round(libm::exp10(f64::from(power) / 2.0)) as usize);
        let counts: Vec<usize> = counts.filter(|&count| count <= max).collect();
        curves.push(sphere_curve(&counts));
    }
    println!("{}", processor_and_caches());
    if words.iter().any(|word| word == "--write") && only.is_none() {
        return keep(&curves);
    }
    if wants("spheres") {
        shape_curve::<PlacedSphere>("spheres", &[16, 32, 64, 100, 128, 192, 256, 512]);
        shape_curve::<Slabs>("cuboids", &[16, 32, 64, 128, 256]);
        shape_curve::<TriangleRow>("single triangles", &[16, 32, 64, 128, 192, 256]);
        shape_curve::<PlacedMesh>("meshes", &[2, 4, 8, 16, 32, 64]);
        shape_curve::<PlacedDisk>("disks", &[16, 32, 64, 128, 192, 256]);
        shape_curve::<PlacedRectangle>("rectangles", &[16, 32, 64, 128, 192, 256]);
        shape_curve::<PlacedCylinder>("cylinders", &[8, 16, 32, 64, 128]);
        shape_curve::<PlacedTorus>("tori", &[4, 8, 16, 32, 64]);
        shape_curve::<Ellipsoid>("ellipsoids", &[16, 32, 64, 128, 192, 256]);
    }
}
