//! Fisheye and equirectangular cameras: directions lead back to their places, solid angles are whole, what lies outside a
//! circle is black; and one scene through every camera.

#[path = "cameras/registered.rs"]
mod registered;

use crate::scenes;

use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::cameras::in_image_circle;
use pinhole::extract::{ImageCircle, ImageFrame, PerspectiveProjection, SMALLEST_PIXEL, half_extent};
use pinhole::film::{Film, write_exr};
use pinhole::plan::{Census, Column, Table};
use pinhole::rays::{
    CameraRays, RasterPoints, camera_ray_equirectangular, camera_ray_fisheye, ndc_from_raster,
    screen_from_equirectangular, screen_from_fisheye, screen_from_ndc,
};
use pinhole::render::{inspect, render};
use pinhole::sample::{Purpose, uniform};
use pinhole::scene::*;
use pinhole::shade::direction_of;
use scenes::{Setup, all_round, film, fisheye, named, offer, one_world, textured};
use std::f64::consts::PI;

const AXES: [FovAxis; 5] =
    [FovAxis::Vertical, FovAxis::Horizontal, FovAxis::Smaller, FovAxis::Larger, FovAxis::Diagonal];

fn random(number: u32, of: u32) -> f64 {
    uniform(11, [number, of], 0, Purpose::Pixel)
}

fn direction(number: u32) -> DVec3 {
    let z = 2.0 * random(number, 0) - 1.0;
    let (sine, cosine) = (2.0 * PI * random(number, 1)).sin_cos();
    let across = (1.0 - z * z).sqrt();
    DVec3::new(across * cosine, across * sine, z)
}

fn raster_of(screen: DVec2, image: ImageFrame) -> DVec2 {
    let ndc = DVec2::new(0.5 + 0.5 * screen.x / image.aspect(), 0.5 - 0.5 * screen.y);
    ndc * image.size()
}

fn screen_of(raster: DVec2, image: ImageFrame) -> DVec2 {
    screen_from_ndc(ndc_from_raster(raster, image.size()), image.aspect())
}

/// Direction → raster → direction, and raster → direction → raster, for images of every shape.
#[test]
fn directions_lead_to_their_places_and_back() {
    let (mut worst, mut worst_raster, mut tried) = (0.0_f64, 0.0_f64, 0);
    for (width, height) in [(512, 512), (1024, 512), (100, 1000), (65_536, 3)] {
        let image = ImageFrame { width, height };
        for axis in AXES {
            for fov in [1.0_f64, 90.0, 180.0, 270.0, 360.0] {
                let circle =
                    ImageCircle { radius: half_extent(axis, image.aspect()), half_angle: Degrees(fov).radians() / 2.0 };
                for number in 0..300 {
                    // Directions that the circle shows: towards the axis by as much as it is narrower.
                    let there = direction(number);
                    let (across, z) = (there.truncate().normalize(), (-there.z).acos() * fov / 360.0);
                    let there = (across * z.sin()).extend(-z.cos());
                    let raster = raster_of(screen_from_fisheye(there, &circle), image);
                    let back = camera_ray_fisheye(screen_of(raster, image), &circle);
                    // A raster point is known to 2⁻⁵³ of the image's side, and each step of the chain rounds once more.
                    let rounding = 8.0 * 2.0_f64.powi(-53) * (1.0 + image.aspect().max(1.0) / circle.radius);
                    worst = worst.max((back - there).length() / rounding);
                    assert!((back.length() - 1.0).abs() < 4e-16);
                    tried += 1;
                }
            }
        }
        for number in 0..2000 {
            let there = direction(number);
            let raster = raster_of(screen_from_equirectangular(there, image.aspect()), image);
            assert!((0.0..=image.size().x).contains(&raster.x) && (0.0..=image.size().y).contains(&raster.y));
            let back = camera_ray_equirectangular(screen_of(raster, image), image.aspect());
            worst = worst.max((back - there).length() / (16.0 * 2.0_f64.powi(-53)));
            let at = DVec2::new(random(number, 2), random(number, 3)) * image.size();
            let seen = camera_ray_equirectangular(screen_of(at, image), image.aspect());
            let again = raster_of(screen_from_equirectangular(seen, image.aspect()), image);
            // Near a pole a step of longitude is a small step.
            let cosine = seen.x.hypot(seen.z);
            let off = (again - at) / image.size() * DVec2::new(cosine, 1.0);
            worst_raster = worst_raster.max(off.length());
            tried += 2;
        }
    }
    eprintln!(
        "round trips: {tried}, worst {worst:.2} of a rounding of the chain for directions; {worst_raster:.1e} of the \
         image for raster points"
    );
    assert!(worst < 1.5 && worst_raster < 1e-15);
}

/// Along the diagonal the angle from the axis is the arc tangent of the distance from the centre, which grows least in a
/// corner.
#[test]
fn the_narrowest_pixel_of_a_perspective_is_in_a_corner() {
    let image = ImageFrame { width: 30_000, height: 20_000 };
    for tan_half_vertical in [0.01, 0.5, 12.0] {
        let pitch = 2.0 * tan_half_vertical / 20_000.0;
        let corner = 1.5_f64.hypot(1.0) * tan_half_vertical;
        let angle = (corner + 0.5 * pitch).atan() - (corner - 0.5 * pitch).atan();
        let found = PerspectiveProjection { tan_half_vertical }.narrowest_pixel(image);
        assert!((found / angle - 1.0).abs() < 1e-6, "{tan_half_vertical}: {found} for {angle}");
    }
}

/// The solid angle of a triangle of unit vectors (van Oosterom and Strackee 1983).
fn solid_angle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    2.0 * a.dot(b.cross(c)).atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}

/// Triangles between the rays of a grid's corners: all directions are 4π, a fisheye's are 2π (1 − cos α/2).
#[test]
fn images_cover_what_they_say() {
    let image = ImageFrame { width: 256, height: 128 };
    let ray = |x: u32, y: u32| {
        camera_ray_equirectangular(screen_of(DVec2::new(f64::from(x), f64::from(y)), image), image.aspect())
    };
    let quad = |[a, b, c, d]: [DVec3; 4]| solid_angle(a, b, c) + solid_angle(a, c, d);
    let mut whole = 0.0;
    for (x, y) in (0..128).flat_map(|y| (0..256).map(move |x| (x, y))) {
        whole += quad([ray(x, y), ray(x + 1, y), ray(x + 1, y + 1), ray(x, y + 1)]);
    }
    assert!((whole / (4.0 * PI) - 1.0).abs() < 1e-12, "{whole}");
    let mut told = Vec::new();
    for fov in [1e-3, 10.0, 90.0, 180.0, 270.0, 359.0, 360.0] {
        let circle = ImageCircle { radius: 0.7, half_angle: Degrees(fov).radians() / 2.0 };
        const RINGS: u32 = 64;
        const TURNS: u32 = 4096;
        let ray = |ring: u32, turn: u32| {
            let (sine, cosine) = (f64::from(turn % TURNS) / f64::from(TURNS) * 2.0 * PI).sin_cos();
            camera_ray_fisheye(DVec2::new(cosine, sine) * (0.7 * f64::from(ring) / f64::from(RINGS)), &circle)
        };
        let mut seen = 0.0;
        for (ring, turn) in (0..RINGS).flat_map(|ring| (0..TURNS).map(move |turn| (ring, turn))) {
            seen += quad([ray(ring, turn), ray(ring + 1, turn), ray(ring + 1, turn + 1), ray(ring, turn + 1)]).abs();
        }
        let truth = 4.0 * PI * (circle.half_angle / 2.0).sin().powi(2);
        // A polygon of 4096 corners in the circle lacks (2π/4096)²/6 of it.
        assert!((seen / truth - 1.0).abs() < 1e-6, "{fov}°: {seen}, truth {truth}");
        told.push(format!("{fov}°: {:+.1e}", seen / truth - 1.0));
    }
    eprintln!("solid angles: all round {:+.1e} from 4π; fisheye {}", whole / (4.0 * PI) - 1.0, told.join(", "));
}

/// The rays that a render makes are those of the functions; neighbours are never the same.
#[test]
fn renders_aim_as_the_functions_say() {
    let mut tried = 0;
    for scene in [fisheye(Setup::default()), all_round(Setup::default())] {
        let inspection = inspect(&scene, &offer(), 32).expect("inspects");
        let circle = ImageCircle::extract(&Census::of(&scene)).expect("a circle");
        let round =
            inspection.plan.rows.iter().any(|row| row.kept && row.stage == "Generate camera rays: equirectangular");
        for &tile in &inspection.tiles {
            let tile = inspection.world.entity(tile);
            let (raster, rays) = (tile.get::<RasterPoints>().expect("raster"), tile.get::<CameraRays>().expect("rays"));
            for row in 0..rays.rows() {
                let screen = screen_of(raster.point(row), inspection.image);
                let expected = if round {
                    camera_ray_equirectangular(screen, inspection.image.aspect())
                } else {
                    camera_ray_fisheye(screen, &circle)
                };
                assert_eq!(rays.direction(row), expected);
                tried += 1;
            }
        }
    }
    eprintln!("cameras: {tried} rays of renders are those of the functions");
}

/// Outside its circle a fisheye is black whatever the scene, and inside a white sky it is white.
#[test]
fn outside_the_circle_all_is_black() {
    let (mut black, mut white, mut between) = (0, 0, 0);
    for (axis, fov) in AXES.into_iter().flat_map(|axis| [40.0, 180.0, 360.0].map(|fov| (axis, fov))) {
        for samples in [None, Some(5)] {
            let mut world = World::new();
            let camera = (Name::new("camera"), FisheyeCamera { fov: Degrees(fov), axis });
            let camera = world.spawn((camera, Resolution { width: 40, height: 24 })).id();
            if let Some(samples) = samples {
                let sampling = Sampling { samples, filter: Filter::BOX, ..Sampling::default() };
                world.entity_mut(camera).insert(sampling);
            }
            world.spawn((Name::new("sky"), Background { colour: Rgb::grey(1.0) }));
            let census = &Census::of(&world);
            let circle = ImageCircle::extract(census).expect("a circle");
            let image = ImageFrame::extract(census).expect("an image");
            let film = render(&world, &offer(), &one_world(), &()).expect("renders").film;
            assert_eq!(film.rejected().0, 0);
            for (x, y) in (0..24).flat_map(|y| (0..40).map(move |x| (x, y))) {
                let inside = |dx: f64, dy: f64| {
                    let raster = DVec2::new(f64::from(x) + dx, f64::from(y) + dy);
                    in_image_circle(screen_of(raster, image), &circle)
                };
                let places = if samples.is_some() { vec![0.0, 1.0] } else { vec![0.5] };
                let corners: Vec<bool> = places
                    .iter()
                    .flat_map(|&dx| places.iter().map(move |&dy| (dx, dy)))
                    .map(|(dx, dy)| inside(dx, dy))
                    .collect();
                let shown = film.mean(x, y);
                if corners.iter().all(|&corner| corner) {
                    assert_eq!(shown, [1.0; 3], "{axis:?} {fov}° at {x},{y}");
                    white += 1;
                } else if corners.iter().all(|&corner| !corner) && !inside(0.5, 0.5) {
                    // The circle may reach into a pixel between its corners, if it is sampled there.
                    assert!(shown == [0.0; 3] || (samples.is_some() && shown[0] < 0.5), "{axis:?} {fov}° at {x},{y}");
                    black += 1;
                } else {
                    assert!((0.0..=1.0).contains(&shown[0]));
                    between += 1;
                }
            }
        }
    }
    assert!(black > 1000 && white > 1000, "{black} black, {white} white");
    eprintln!("circles: {white} pixels inside white, {black} outside black, {between} on the edge");
}

/// What the camera of all directions shows of an environment image is that image.
#[test]
fn an_environment_seen_all_round_is_its_image() {
    let mut scene = textured(Setup { size: [64, 32], ..Setup::default() });
    let mut shapes = scene.query_filtered::<Entity, Or<(With<Sphere>, With<Plane>, With<Disk>, With<Rectangle>, With<Cuboid>, With<Triangle>)>>();
    for shape in shapes.iter(&scene).collect::<Vec<_>>() {
        scene.despawn(shape);
    }
    let camera = named(&mut scene, "camera");
    scene.entity_mut(camera).remove::<(PerspectiveCamera, LookAt)>();
    scene.entity_mut(camera).insert((EquirectangularCamera, Placement::default()));
    let inspection = inspect(&scene, &offer(), 32).expect("inspects");
    let mut worst = 0.0_f64;
    for &tile in &inspection.tiles {
        let tile = inspection.world.entity(tile);
        let (raster, rays) = (tile.get::<RasterPoints>().expect("raster"), tile.get::<CameraRays>().expect("rays"));
        for row in 0..rays.rows() {
            let expected = direction_of(DVec2::new(raster.point[0][row] / 64.0, raster.point[1][row] / 32.0));
            worst = worst.max((rays.direction(row) - expected).length());
        }
    }
    assert!(worst < 1e-15, "{worst}");
    eprintln!("environments: the camera's directions are the image's to {worst:.1e}");
    // An image of as many pixels, no two of them alike: each is looked up at its texel's centre.
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("all.exr");
    let colour = |x: u32, y: u32| [x as f32 / 64.0, y as f32 / 32.0, ((x * 7 + y * 13) % 32) as f32 / 8.0];
    let mut image = Film::new(64, 32, 64);
    for (x, y) in (0..32).flat_map(|y| (0..64).map(move |x| (x, y))) {
        image.tiles[0].add((y * 64 + x) as usize, colour(x, y));
    }
    write_exr(&image, &path).expect("written");
    let mut world = World::new();
    world.spawn((EquirectangularCamera, Placement::default(), Resolution { width: 64, height: 32 }));
    let file = path.to_string_lossy().into_owned();
    world.spawn(Environment { file, turn: Degrees(0.0), scale: 2.0 });
    let film = render(&world, &offer(), &one_world(), &()).expect("renders").film;
    let mut worst = 0.0_f32;
    for (x, y) in (0..32).flat_map(|y| (0..64).map(move |x| (x, y))) {
        let (shown, texel) = (film.mean(x, y), colour(x, y));
        (0..3).for_each(|part| worst = worst.max((shown[part] - 2.0 * texel[part]).abs()));
    }
    assert!(worst < 1e-4, "{worst}");
    eprintln!("environments: 2048 pixels show their texel to {worst:.1e}");
}

/// Refused, and not.
#[test]
fn angles_are_refused_by_name() {
    let refused = |fov: f64, [width, height]: [u32; 2]| {
        let mut world = World::new();
        let camera = FisheyeCamera { fov: Degrees(fov), ..FisheyeCamera::default() };
        world.spawn((Name::new("eye"), camera, Resolution { width, height }));
        pinhole::extract::validate(&Census::of(&world)).err().map(|refusal| refusal.to_string())
    };
    for fov in [0.0, -1.0, 360.1, f64::NAN, f64::INFINITY] {
        let told = refused(fov, [16, 9]).expect("refused");
        assert!(
            told.starts_with("camera \"eye\": fov is ") && told.ends_with("above 0° and be at most 360°"),
            "{told}"
        );
    }
    let told = refused(0.01, [1024, 1024]).expect("refused");
    assert!(told.contains("0.01° over 1024 × 1024 pixels, 1.7e-7 rad a pixel") && told.contains("4e-6"), "{told}");
    for (fov, size) in [(360.0, [16, 9]), (0.25, [1024, 1024]), (1e-3, [1, 1])] {
        assert_eq!(refused(fov, size), None);
    }
    // Of two pixels each is half of the angle.
    let narrowest = 2.0 * SMALLEST_PIXEL * 180.0 / PI;
    assert_eq!(Degrees(narrowest).radians() / 2.0, SMALLEST_PIXEL);
    assert_eq!(refused(narrowest, [2, 2]), None);
    assert!(refused(narrowest.next_down(), [2, 2]).is_some());
    let mut world = World::new();
    world.spawn((Name::new("eye"), FisheyeCamera::default(), EquirectangularCamera));
    let told = pinhole::extract::validate(&Census::of(&world)).expect_err("refused").to_string();
    assert!(told.contains("a FisheyeCamera and an EquirectangularCamera at once, on \"eye\""), "{told}");
    let mut world = fisheye(Setup::default());
    let camera = named(&mut world, "camera");
    world.entity_mut(camera).insert(Layers::all());
    let told = pinhole::extract::validate(&Census::of(&world)).expect_err("refused").to_string();
    assert!(told.starts_with("camera \"camera\": layers is requested, but a fisheye camera has none"), "{told}");
}

/// One scene through every camera: another picture each, and of each many colours.
#[test]
fn one_scene_through_every_camera() {
    let setup = Setup { size: [48, 24], ..Setup::default() };
    let orthographic = Setup { eye: scenes::Eye::Orthographic, ..setup };
    let films = [
        film(&textured(setup)),
        film(&textured(orthographic)),
        film(&fisheye(setup)),
        film(&all_round(setup)),
        film(&scenes::blurred(setup)),
    ];
    for (number, film) in films.iter().enumerate() {
        assert!(film.colours() > 100, "camera {number} has {} colours", film.colours());
        assert_eq!(film.rejected, 0);
        assert!(films.iter().skip(number + 1).all(|other| other != film));
    }
}
