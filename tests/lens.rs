//! The thin lens, against closed forms: where its rays start, where they converge, how wide what is out of focus becomes.

use crate::scenes;

use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::extract::{ImageFrame, LensTable, PerspectiveProjection, tan_half};
use pinhole::intersect::{Hits, NO_SHAPE};
use pinhole::plan::{Census, Column, Table, plan};
use pinhole::rays::{CameraRays, LensPoints, RasterPoints, WorldRays, camera_ray_lens, polygon_point};
use pinhole::render::inspect;
use pinhole::sample::{Purpose, uniform};
use pinhole::scene::*;
use pinhole_lab::naive::lens::onto_disk;
use scenes::{Eye, Setup, film, full, named, offer, textured, turned};
use std::f64::consts::PI;

const SAMPLES: u64 = 200_000;

fn point_of_square(number: u64) -> DVec2 {
    let pixel = [number as u32, (number >> 32) as u32];
    DVec2::new(uniform(7, pixel, 0, Purpose::Lens), uniform(7, pixel, 1, Purpose::Lens))
}

fn opening(blades: u32, turn: f64) -> LensTable {
    let lens = Lens { aperture: Aperture::Radius { radius: 1.0 }, blades, turn: Degrees(turn), ..Lens::default() };
    LensTable::of(&lens, "camera").expect("a lens")
}

fn point_on(lens: &LensTable, u: DVec2) -> DVec2 {
    if lens.corners.is_empty() { onto_disk(u) } else { polygon_point(u, &lens.corners) }
}

/// How far a χ² of `cells` cells lies above its mean, in standard deviations.
fn deviations(counts: &[u64]) -> f64 {
    let expected = counts.iter().sum::<u64>() as f64 / counts.len() as f64;
    let squared: f64 = counts.iter().map(|&count| (count as f64 - expected).powi(2) / expected).sum();
    let freedom = (counts.len() - 1) as f64;
    (squared - freedom) / (2.0 * freedom).sqrt()
}

/// Cells of equal area: rings of equal area on the disk, equal angles in each; triangles and strips of them on a polygon.
#[test]
fn points_are_spread_evenly_over_disk_and_polygon() {
    const RINGS: usize = 12;
    let mut told = Vec::new();
    for blades in [0, 3, 4, 5, 6, 9, 64] {
        let lens = opening(blades, 17.0);
        let sectors = if blades == 0 { 32 } else { 4 * blades as usize };
        let mut counts = vec![0_u64; RINGS * sectors];
        let mut second = [0.0; 3];
        for number in 0..SAMPLES {
            let at = point_on(&lens, point_of_square(number + (u64::from(blades) << 32)));
            second = [second[0] + at.x * at.x, second[1] + at.y * at.y, second[2] + at.x * at.y];
            let (fraction, sector) = cell(&lens, at, sectors);
            assert!((-1e-12..=1.0 + 1e-12).contains(&fraction), "{blades} blades: {at} is outside");
            counts[(fraction * RINGS as f64).clamp(0.0, RINGS as f64 - 1.0) as usize * sectors + sector] += 1;
        }
        let off = deviations(&counts);
        assert!(off < 4.0, "{blades} blades: χ² {off} standard deviations above its mean");
        // Of a disk 1/4; of a regular polygon (2 + cos 2π/n) / 12, by its triangles.
        let truth = if blades == 0 { 0.25 } else { (2.0 + (2.0 * PI / f64::from(blades)).cos()) / 12.0 };
        // No fourth moment is above 1/8 of the disk's, so no standard error of x² above 0.25 / √N.
        let error = 0.25 / (SAMPLES as f64).sqrt();
        let [xx, yy, xy] = second.map(|sum| sum / SAMPLES as f64);
        for (told, truth) in [(xx, truth), (yy, truth), (xy, 0.0)] {
            assert!((told - truth).abs() < 4.0 * error, "{blades} blades: second moment {told}, truth {truth}");
        }
        told.push(format!("{blades}: χ² {off:+.2}σ, x² {xx:.4} (truth {truth:.4} ± {error:.4})"));
    }
    eprintln!("openings: {SAMPLES} points each; {}", told.join("; "));
}

/// The fraction of the opening's area that is nearer the centre, and the sector.
fn cell(lens: &LensTable, at: DVec2, sectors: usize) -> (f64, usize) {
    if lens.corners.is_empty() {
        let turn = (at.y.atan2(at.x) / (2.0 * PI)).rem_euclid(1.0);
        return (at.length_squared(), ((turn * sectors as f64) as usize).min(sectors - 1));
    }
    let edges = lens.corners.len() - 1;
    // Coordinates in each triangle from the centre to an edge: how far out, how far along.
    for edge in 0..edges {
        let (a, b) = (lens.corners[edge], lens.corners[edge + 1]);
        let area = a.perp_dot(b);
        let (of_a, of_b) = (at.perp_dot(b) / area, a.perp_dot(at) / area);
        if of_a >= -1e-12 && of_b >= -1e-12 {
            let out = of_a + of_b;
            let along = if out > 0.0 { (of_b / out).clamp(0.0, 1.0) } else { 0.0 };
            let within = sectors / edges;
            return (out * out, edge * within + ((along * within as f64) as usize).min(within - 1));
        }
    }
    (f64::NAN, 0)
}

/// All rays of a screen point meet in one point of the plane in focus, whose distance is along the axis; at extremes too.
#[test]
fn what_is_in_focus_is_hit_by_all_rays() {
    let (mut worst, mut tried) = (0.0_f64, 0);
    for radius in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        for focus in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            for fov in [1e-3, 1.0, 45.0, 120.0, 179.0] {
                let tangent = tan_half(Degrees(fov));
                for number in 0..400 {
                    let screen = 2.0 * point_of_square(2 * number) - DVec2::ONE;
                    let lens = onto_disk(point_of_square(2 * number + 1)) * radius;
                    let direction = camera_ray_lens(screen, tangent, lens, focus);
                    assert!((direction.length() - 1.0).abs() < 4e-16, "{direction}");
                    // At the depth f, in the plane, from the lens; by what f64 rounds there.
                    let there = lens + direction.truncate() * (focus / -direction.z);
                    let truth = screen * (tangent * focus);
                    let rounding = (truth.length() + 2.0 * lens.length()) * 2.0_f64.powi(-52);
                    worst = worst.max((there - truth).length() / rounding);
                    tried += 1;
                }
            }
        }
    }
    eprintln!("in focus: {tried} rays, worst {worst:.2} of what f64 rounds (|P| + 2|L|) 2⁻⁵²");
    assert!(worst < 4.0);
}

/// A small disk at depth z, before a camera with a lens at the origin, one sample a pixel; more seeds, more samples.
fn confused(lens: Lens, depth: f64, source: f64, fov: f64, seed: u64) -> World {
    let mut world = World::new();
    let camera = (Name::new("camera"), PerspectiveCamera { fov: Degrees(fov), ..Default::default() }, lens);
    let sampling = Sampling { samples: 1, seed, sampler: Sampler::Independent, filter: Filter::BOX };
    world.spawn((camera, Resolution { width: 64, height: 64 }, sampling));
    let facing = Placement { orientation: DQuat::from_rotation_x(PI / 2.0), ..Placement::at(0.0, 0.0, -depth) };
    world.spawn((Name::new("point"), Disk { radius: source }, facing, Emissive::default()));
    world
}

/// The image of a disk that is out of focus is the disk as the pinhole shows it, spread by the circle of confusion: both
/// are uniform, so second moments add, and no point lies beyond the sum of the radii.
#[test]
fn circles_of_confusion() {
    let mut told = Vec::new();
    // Radius, focus, depth, blades: before and behind the plane in focus, near and far.
    let cases = [
        (0.05, 5.0, 2.5, 0),
        (0.05, 5.0, 20.0, 0),
        (0.3, 4.0, 1.5, 0),
        (10.0 * 0.3_f64.to_radians().tan(), 10.0, 30.0, 0),
        (0.05, 5.0, 2.5, 5),
        (0.05, 5.0, 20.0, 6),
        (2e5, 5e6, 2.5e6, 0),
        (2e-7, 5e-6, 2e-5, 3),
    ];
    for (radius, focus, depth, blades) in cases {
        let aperture = Aperture::Radius { radius };
        let lens = Lens { aperture, focus_distance: focus, blades, turn: Degrees(10.0) };
        let table = LensTable::of(&lens, "camera").expect("a lens");
        let circle = table.circle_of_confusion(depth);
        // The source two fifths of the circle, the image a little wider than both, 64 pixels to its height.
        let source = 0.2 * circle * depth / focus;
        let radius = 0.5 * circle + source * focus / depth;
        let fov = 2.0 * (1.1 * radius / focus).atan().to_degrees();
        let (mut sums, mut hits, mut farthest) = ([0.0; 5], 0_u32, 0.0_f64);
        for seed in 0..40 {
            let inspection = inspect(&confused(lens, depth, source, fov, seed), &offer(), 32).expect("inspects");
            for &tile in &inspection.tiles {
                let tile = inspection.world.entity(tile);
                let (raster, found) = (tile.get::<RasterPoints>().expect("raster"), tile.get::<Hits>().expect("hits"));
                for row in (0..found.rows()).filter(|&row| found.shape[row] != NO_SHAPE) {
                    // From the image's centre, in units of the plane in focus.
                    let scale = 1.1 * radius / 32.0;
                    let at = DVec2::new(raster.point[0][row] - 32.0, 32.0 - raster.point[1][row]) * scale;
                    let more = [at.x, at.y, at.length_squared(), at.length_squared().powi(2), 0.0];
                    (0..5).for_each(|part| sums[part] += more[part]);
                    farthest = farthest.max(at.length());
                    hits += 1;
                }
            }
        }
        let count = f64::from(hits);
        let [x, y, squared, fourth, _] = sums.map(|sum| sum / count);
        let of_opening = if blades == 0 { 0.25 } else { (2.0 + (2.0 * PI / f64::from(blades)).cos()) / 12.0 };
        let truth = 2.0 * (0.25 * circle * circle * of_opening + (source * focus / depth).powi(2) * 0.25);
        let error = ((fourth - squared * squared) / count).sqrt();
        let off = (squared - truth) / error;
        assert!(error / truth < 0.01, "SE {} of {truth}", error / truth);
        assert!(off.abs() < 4.0, "{lens:?} at {depth}: second moment {squared}, truth {truth}, {off} SE");
        // Few points come near a corner.
        let min = if blades == 0 { 0.95 } else { 0.9 };
        let of_mean = (squared / 2.0 / count).sqrt();
        assert!(x.abs() < 4.0 * of_mean && y.abs() < 4.0 * of_mean, "centre ({x}, {y})");
        assert!(farthest <= radius * (1.0 + 1e-6) && farthest > min * radius, "edge {farthest}, truth {radius}");
        told.push(format!(
            "R {radius:.1e} f {focus} z {depth} blades {blades}: {hits} hits, moment {off:+.2} SE of {:.2} %, edge {:.4}",
            100.0 * error / truth,
            farthest / radius
        ));
    }
    eprintln!("circles of confusion:\n  {}", told.join("\n  "));
}

fn with_lens(mut scene: World, lens: Lens) -> World {
    let camera = named(&mut scene, "camera");
    scene.entity_mut(camera).insert(lens);
    scene
}

/// The f32 rays of a camera hit the point in focus to the tolerance that the pinhole's have: 0.03 pixels.
#[test]
fn world_rays_converge_in_focus_to_a_pixel_s_tolerance() {
    let (mut worst, mut tried) = (0.0_f64, 0);
    for (radius, focus, fov) in [
        (0.05, 5.0, 45.0),
        (1e-6, 1e6, 45.0),
        (1e6, 1e6, 45.0),
        (1e-6, 1e-6, 45.0),
        (1.0, 0.6, 0.05),
        (1e3, 1e3, 179.0),
    ] {
        let mut scene = turned(Setup { size: [48, 48], ..Setup::default() });
        let camera = named(&mut scene, "camera");
        let lens = Lens { aperture: Aperture::Radius { radius }, focus_distance: focus, ..Lens::default() };
        let perspective = PerspectiveCamera { fov: Degrees(fov), ..Default::default() };
        scene.entity_mut(camera).insert((lens, perspective, Sampling { samples: 1, ..Sampling::default() }));
        let census = &Census::of(&scene);
        let axes = pinhole::extract::CameraAxes::extract(census).expect("axes").world_from_camera;
        let pinhole = PerspectiveProjection::extract(census).expect("a pinhole");
        let image = ImageFrame::extract(census).expect("an image");
        let pixel = 2.0 * pinhole.tan_half_vertical / f64::from(image.height) * focus;
        let inspection = inspect(&scene, &offer(), 32).expect("inspects");
        for &tile in &inspection.tiles {
            let tile = inspection.world.entity(tile);
            let (raster, rays) = (tile.get::<RasterPoints>().expect("raster"), tile.get::<WorldRays>().expect("rays"));
            for row in 0..rays.rows() {
                let to_camera = axes.transpose();
                let (o, d) = (to_camera * rays.origin_of(row), to_camera * rays.direction_of(row));
                let there = o + d * ((-focus - o.z) / d.z);
                let at = DVec2::new(there.x, there.y) / pixel;
                let truth = DVec2::new(raster.point[0][row] - 24.0, 24.0 - raster.point[1][row]);
                // What is oblique moves farther: by one over the cosine for the length, one more for the angle.
                let scale = 1.0 / (d.z * d.z);
                worst = worst.max((at - truth).length() / scale);
                tried += 1;
            }
        }
    }
    eprintln!("world rays: {tried}, worst {worst:.4} pixels from the point in focus");
    assert!(worst < 0.03);
}

/// A lens whose aperture is 0 is dropped by name, and every bit is the pinhole's.
#[test]
fn radius_0_is_the_pinhole() {
    let mut tried = 0;
    for sampling in [None, Some(Sampling { samples: 3, ..Sampling::default() })] {
        for aperture in [Aperture::Radius { radius: 0.0 }, Aperture::Radius { radius: -0.0 }] {
            for scene in [full, turned, textured] {
                let mut plain = scene(Setup { size: [40, 24], ..Setup::default() });
                let camera = named(&mut plain, "camera");
                if let Some(sampling) = sampling {
                    plain.entity_mut(camera).insert(sampling);
                }
                let expected = film(&plain);
                let closed = with_lens(plain, Lens { aperture, ..Lens::default() });
                film(&closed).assert_is(&expected, "aperture 0");
                let plan = plan(&Census::of(&closed), &offer()).expect("plans");
                let row =
                    plan.rows.iter().find(|row| row.stage == "Generate camera rays: thin lens").expect("on offer");
                assert!(!row.kept && row.reason == "aperture 0: the lens of \"camera\" is a pinhole", "{row:?}");
                let pinhole =
                    plan.rows.iter().find(|row| row.stage == "Generate camera rays: perspective").expect("on offer");
                assert!(pinhole.kept, "{pinhole:?}");
                tried += 1;
            }
        }
    }
    // And the thin stage itself, run with lens points of 0, gives the pinhole's directions.
    for number in 0..1000 {
        let screen = 4.0 * point_of_square(number) - 2.0 * DVec2::ONE;
        let own = pinhole::rays::camera_ray_perspective(screen, 0.7);
        assert_eq!(camera_ray_lens(screen, 0.7, DVec2::ZERO, 3.0), own);
    }
    eprintln!("aperture 0: {tried} renders and 1000 directions equal bit for bit");
}

#[test]
fn an_f_number_is_a_radius() {
    let of = |aperture| LensTable::of(&Lens { aperture, ..Lens::default() }, "camera").expect("a lens").radius;
    assert_eq!(of(Aperture::FNumber { number: 2.0, focal_length: 0.05 }), 0.0125);
    assert_eq!(of(Aperture::FNumber { number: 1.4, focal_length: 0.05 }), 0.05 / 2.8);
}

/// The lens's columns exist where there is a lens, and rays start on it.
#[test]
fn rays_start_on_the_lens() {
    let lens = Lens { aperture: Aperture::Radius { radius: 0.25 }, ..Lens::default() };
    let scene = with_lens(full(Setup { eye: Eye::Perspective, size: [33, 20], ..Setup::default() }), lens);
    let inspection = inspect(&scene, &offer(), 32).expect("inspects");
    let (mut tried, mut distinct) = (0, std::collections::BTreeSet::new());
    for &tile in &inspection.tiles {
        let tile = inspection.world.entity(tile);
        let (points, rays) = (tile.get::<LensPoints>().expect("points"), tile.get::<CameraRays>().expect("rays"));
        let world = tile.get::<WorldRays>().expect("rays");
        for row in 0..rays.rows() {
            assert_eq!(
                (rays.origin[0][row], rays.origin[1][row], rays.origin[2][row]),
                (points.point[0][row], points.point[1][row], 0.0)
            );
            let length = DVec3::new(points.point[0][row], points.point[1][row], 0.0).length();
            assert!(length <= 0.25 && (world.origin_of(row).length() - length).abs() < 1e-7);
            distinct.insert(points.point[0][row].to_bits());
            tried += 1;
        }
    }
    assert!(distinct.len() > tried * 9 / 10, "{} places of {tried} rays", distinct.len());
    eprintln!("lens points: {tried} rays start on the lens, in {} places", distinct.len());
}

/// An aperture of straight edges has its first corner at its turn, anticlockwise from the right: rays start within that
/// polygon and near each of its corners.
#[test]
fn blades_are_turned_anticlockwise() {
    let mut tried = 0;
    for (blades, turn) in [(3, 17.0), (3, -40.0), (4, 10.0), (5, 200.0), (7, 5.0)] {
        let lens = Lens { aperture: Aperture::Radius { radius: 0.25 }, blades, turn: Degrees(turn), ..Lens::default() };
        let scene = with_lens(full(Setup { eye: Eye::Perspective, size: [96, 64], ..Setup::default() }), lens);
        let inspection = inspect(&scene, &offer(), 32).expect("inspects");
        let corner = |blade: u32| {
            let angle = (turn + 360.0 * f64::from(blade) / f64::from(blades)).to_radians();
            0.25 * DVec2::new(angle.cos(), angle.sin())
        };
        let mut nearest = vec![f64::INFINITY; blades as usize];
        for &tile in &inspection.tiles {
            let points = inspection.world.entity(tile).get::<LensPoints>().expect("points");
            for row in 0..points.rows() {
                let at = points.point(row);
                for blade in 0..blades {
                    let (a, b) = (corner(blade), corner(blade + 1));
                    assert!((b - a).perp_dot(at - a) > -1e-9, "{blades} blades at {turn}°: {at} is outside");
                    nearest[blade as usize] = nearest[blade as usize].min(at.distance(a));
                }
                tried += 1;
            }
        }
        // The corner within a distance d has a part of the opening of some d² / 0.16; 6144 points leave none empty.
        assert!(nearest.iter().all(|&distance| distance < 0.03), "{blades} blades at {turn}°: {nearest:?}");
    }
    eprintln!("blades: {tried} points within their polygons, and in every corner");
}
