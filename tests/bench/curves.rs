//! What a ray costs against the number of spheres and of triangles: `cargo bench --bench curves`.
//!
//! `--most 1000000` ends the curves there; `--only spheres` or `--only triangles` draws one of them.
//! Spheres lie at random in a cube and fill the same part of it at any number; triangles are those of a torus knot.
//! Coherent rays are those of a camera in 8 × 8 tiles, random ones start in the cube and go anywhere.
//! Each time is the least of five, of one thread, in processor time; for up to 1024 spheres, and some kinds of shapes
//! beside, testing all of them one after another is timed as well, which says from how many on a hierarchy pays.
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

use cpu_time::ProcessTime;
use glam::DVec3;
use pinhole::intersect::NO_SHAPE;
use pinhole::scene::{MeshGeometry, MeshInstance, Placement};
use pinhole::shapes::{ClosestHits, Ellipsoid, MeshHierarchy, PlacedCylinder, PlacedDisk, PlacedMesh, PlacedRectangle};
use pinhole::shapes::{PlacedSphere, PlacedTorus, RaySlices, Shape, Slabs, TriangleRow, hierarchy_of, keep_closest_of};
use pinhole_lab::measure::oracle::Oracle;
use pinhole_lab::measure::ray_aim::Draws;
use pinhole_lab::measure::specimen::Specimen;
use pinhole_lab::measure::torus_knot::torus_knot;

/// The rays that a stage gets at once.
const BATCH: usize = 1024;
/// The side of the picture whose rays are coherent; as many rays are random.
const SIDE: usize = 256;
const ROUNDS: usize = 5;

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

    /// Nanoseconds a ray that a kernel takes, and how many hit something.
    fn time(&self, mut keep_closest: impl FnMut(RaySlices<'_>, ClosestHits<'_>)) -> (f64, usize) {
        let rows = self.0[0].len();
        let (mut least, mut hit) = (f64::INFINITY, 0);
        for _ in 0..ROUNDS {
            let (mut t, mut shape) = (vec![f64::INFINITY; rows], vec![NO_SHAPE; rows]);
            let start = ProcessTime::now();
            for first in (0..rows).step_by(BATCH) {
                let batch = first..rows.min(first + BATCH);
                let [ox, oy, oz, dx, dy, dz] = self.0.each_ref().map(|column| &column[batch.clone()]);
                let rays = RaySlices { origin: [ox, oy, oz], direction: [dx, dy, dz] };
                let (t, shape) = (&mut t[batch.clone()], &mut shape[batch]);
                keep_closest(rays, ClosestHits { t, shape, primitive: None, any: false });
            }
            least = least.min(start.elapsed().as_nanos() as f64 / rows as f64);
            hit = shape.iter().filter(|shape| **shape != NO_SHAPE).count();
        }
        (least, hit)
    }
}

/// So many shapes of a kind, in a cube of half side 1.
fn shapes_of<S: Oracle>(count: usize) -> Vec<S> {
    let mut draws = Draws::new(78, 0);
    let mut shapes = Vec::with_capacity(count);
    let size = 0.5 / (count as f64).cbrt();
    while shapes.len() < count {
        let position = DVec3::from([(); 3].map(|()| draws.between(-1.0, 1.0)));
        let placement = Placement { position, scale: DVec3::splat(size), ..Placement::default() };
        let specimen = Specimen::<S>::of(S::Component::default(), placement).expect("an example");
        shapes.push(specimen.shape);
    }
    shapes
}

fn shape_curve<S: Oracle>(plural: &str, counts: &[usize], one_by_one: usize) {
    let sets = [("coherent", Rays::coherent(1.0)), ("random", Rays::random(1.0))];
    println!("{plural}: ns a ray through the hierarchy and one by one, build, bytes each");
    for &count in counts {
        let shapes = shapes_of::<S>(count);
        let numbers: Vec<u32> = (0..count as u32).collect();
        let start = ProcessTime::now();
        let bvh = hierarchy_of(&shapes).expect("bounded shapes");
        let build = 1e3 * start.elapsed().as_secs_f64();
        print!("{count:>9}");
        for (name, rays) in &sets {
            let (ns, hits) = rays.time(|rays, hits| keep_closest_of((&shapes, &numbers, &bvh), rays, hits));
            print!("  {name} {ns:>7.1} ns");
            if count <= one_by_one {
                let (all, same) = rays.time(|rays, hits| S::keep_closest(&shapes, &numbers, rays, hits));
                assert_eq!(hits, same, "{count} {plural}");
                print!(" for {all:>8.1}");
            }
            print!(" ({:.0} % hit)", 100.0 * hits as f64 / (SIDE * SIDE) as f64);
        }
        println!("  built in {build:.2} ms, {:.1} bytes", bvh.bytes() as f64 / count as f64);
    }
}

fn triangle_curve(most: usize) {
    let sets = [("coherent", Rays::coherent(3.5)), ("random", Rays::random(3.0))];
    println!("triangles of a mesh: ns a ray, build, bytes each");
    for power in 4..=14 {
        // 2 · 12.8 a · a triangles.
        let around = libm::round(libm::sqrt(libm::exp10(f64::from(power) / 2.0) / 25.6)).max(3.0);
        let [along, around] = [libm::round(12.8 * around), around].map(|part| part as u32);
        let geometry = MeshGeometry::new(torus_knot(along, around));
        let count = geometry.triangles.len();
        if count > most + most / 4 {
            break;
        }
        let start = ProcessTime::now();
        let bytes = MeshHierarchy::of(&geometry).bytes();
        let build = 1e3 * start.elapsed().as_secs_f64();
        let mesh = Specimen::<PlacedMesh>::of(MeshInstance { geometry }, Placement::default()).expect("a mesh").shape;
        print!("{count:>9}");
        for (name, rays) in &sets {
            let one = std::slice::from_ref(&mesh);
            let (ns, hits) = rays.time(|rays, hits| PlacedMesh::keep_closest(one, &[0], rays, hits));
            print!("  {name} {ns:>7.1} ns ({:.0} % hit)", 100.0 * hits as f64 / (SIDE * SIDE) as f64);
        }
        println!("  built in {build:.2} ms, {:.1} bytes", bytes as f64 / count as f64);
    }
}

fn main() {
    let after = |flag: &str| std::env::args().skip_while(|word| word != flag).nth(1);
    let most = after("--most").map_or(10_000_000, |most| most.parse().expect("a number"));
    let only = after("--only");
    let wants = |what: &str| only.as_deref().is_none_or(|only| only == what);
    if wants("spheres") {
        let counts: Vec<usize> = [16, 32, 64, 100, 128, 192, 256, 512, 1000, 10_000, 100_000, 1_000_000]
            .into_iter()
            .filter(|&count| count <= most)
            .collect();
        shape_curve::<PlacedSphere>("spheres", &counts, 1024);
        shape_curve::<Slabs>("cuboids", &[16, 32, 64, 128, 256], 1024);
        shape_curve::<TriangleRow>("single triangles", &[16, 32, 64, 128, 192, 256], 1024);
        shape_curve::<PlacedMesh>("meshes", &[2, 4, 8, 16, 32, 64], 1024);
        shape_curve::<PlacedDisk>("disks", &[16, 32, 64, 128, 192, 256], 1024);
        shape_curve::<PlacedRectangle>("rectangles", &[16, 32, 64, 128, 192, 256], 1024);
        shape_curve::<PlacedCylinder>("cylinders", &[8, 16, 32, 64, 128], 1024);
        shape_curve::<PlacedTorus>("tori", &[4, 8, 16, 32, 64], 1024);
        shape_curve::<Ellipsoid>("ellipsoids", &[16, 32, 64, 128, 192, 256], 1024);
    }
    if wants("triangles") {
        triangle_curve(most);
    }
}
