//! What a pixel covers of a texture, checked by its neighbours and by many samples; files found where a scene says.

#[path = "textures/aspect.rs"]
mod aspect;
#[path = "textures/maps.rs"]
mod maps;
#[path = "textures/odd_images.rs"]
mod odd_images;

use crate::scenes;

use bevy_ecs::prelude::*;
use glam::{DQuat, DVec2, DVec3};
use pinhole::extract::SamplingTable;
use pinhole::film::{Curve, Film, write_exr, write_png};
use pinhole::intersect::{Hits, ShadingNormals, SurfaceSides, SurfaceUvs, Surfaces};
use pinhole::plan::{Census, Table};
use pinhole::render::inspect;
use pinhole::scene::*;
use pinhole::shade::{SurfaceColours, TexturePoints, direction_of};
use scenes::{EYES, Eye, film, named, offer};
use std::fs;
use std::path::Path;

/// A camera before something, a tile of pixels each narrow enough that surfaces are flat across it.
fn close_up(eye: Eye, from: DVec3, at: DVec3) -> World {
    let mut world = World::new();
    let resolution = Resolution { width: 32, height: 32 };
    let look = LookAt { eye: from, target: at, up: DVec3::new(0.1, 1.0, 0.2) };
    let mut camera = world.spawn((Name::new("camera"), look, resolution));
    match eye {
        Eye::Perspective => camera.insert(PerspectiveCamera { fov: Degrees(0.8), ..Default::default() }),
        Eye::Orthographic => camera.insert(OrthographicCamera { view_height: 0.05 }),
    };
    world
}

/// One of every shape with uv, turned and unevenly scaled.
fn shape(world: &mut World, number: usize, texture: impl Bundle) {
    let orientation = DQuat::from_xyzw(0.2, -0.1, 0.3, 0.9).normalize();
    let placement = Placement { orientation, scale: DVec3::new(1.5, 0.8, -1.2), ..Placement::at(0.1, -0.2, 0.05) };
    let placement = if number == 0 { Placement::at(0.1, -0.2, 0.05) } else { placement };
    let placed = (placement, Matte::default(), texture);
    match number {
        0 => world.spawn((Sphere::default(), placed)),
        1 => world.spawn((Sphere::default(), placed)),
        2 => world.spawn((Plane { normal: DVec3::new(0.3, 1.0, 0.4) }, placed)),
        3 => world.spawn((Disk::default(), placed)),
        4 => world.spawn((Rectangle::default(), placed)),
        5 => {
            let vertices = [DVec3::new(-8.0, -0.5, -8.0), DVec3::new(8.0, 0.2, -9.0), DVec3::new(0.3, -0.3, 9.0)];
            let uvs = Some([DVec2::new(0.1, 0.2), DVec2::new(9.0, 0.3), DVec2::new(0.4, 13.0)]);
            world.spawn((Triangle { vertices, uvs, ..Triangle::default() }, placed))
        }
        6 => world.spawn((Cuboid::default(), placed)),
        7 => world.spawn((Cylinder::default(), placed)),
        8 => world.spawn((Cone::default(), placed)),
        _ => world.spawn((Torus { radius: 0.7, tube: 0.4 }, placed)),
    };
}

#[test]
fn a_step_ends_where_the_neighbour_s_point_is() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for eye in EYES {
        for by in [TextureBy::Uv, TextureBy::Space] {
            for number in 0..7 {
                let mut world = close_up(eye, DVec3::new(1.5, 2.5, 3.0), DVec3::new(0.4, -0.1, 0.3));
                shape(&mut world, number, Checker { by, size: 0.25, ..Checker::default() });
                let inspection = inspect(&world, &offer(), 32).expect("inspects");
                let tile = inspection.world.entity(inspection.tiles[0]);
                let points = tile.get::<TexturePoints>().expect("laid");
                let mut seen = 0;
                for y in 0..31 {
                    for x in 0..31 {
                        let row = y * 32 + x;
                        let here = points.get(row);
                        for (axis, beside) in [row + 1, row + 32].into_iter().enumerate() {
                            let moved = points.get(beside).point - here.point;
                            let step = here.steps[axis];
                            assert!(step.is_finite() && step.length() > 0.0, "{eye:?} {by:?} {number}");
                            worst = worst.max((moved - step).length() / step.length());
                            seen += 1;
                        }
                    }
                }
                assert_eq!(seen, 31 * 31 * 2);
                tried += seen;
            }
        }
    }
    eprintln!("footprints: {tried} steps to neighbours, the worst off by {worst:.4} of itself");
    assert!(worst < 0.003, "{worst}");
}

/// Wide cameras have no image plane whose pixels could be followed, so a footprint is as large as what the pixel's
/// neighbours span, however it lies.
#[test]
fn a_footprint_of_a_wide_camera_is_as_large_as_its_pixel() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for (fisheye, by) in
        [true, false].into_iter().flat_map(|fisheye| [(fisheye, TextureBy::Uv), (fisheye, TextureBy::Space)])
    {
        for number in [2, 4] {
            for distance in [1.0, 2.5] {
                let mut world = World::new();
                let at = DVec3::new(0.4, -0.1, 0.3);
                let from = at + distance * DVec3::new(1.1, 2.6, 2.7);
                let look = LookAt { eye: from, target: at, up: DVec3::Y };
                let (width, height) = if fisheye { (32, 32) } else { (720, 360) };
                let mut camera = world.spawn((Name::new("camera"), look, Resolution { width, height }));
                if fisheye {
                    camera.insert(FisheyeCamera { fov: Degrees(1.0), axis: FovAxis::Smaller });
                } else {
                    camera.insert(EquirectangularCamera);
                }
                shape(&mut world, number, Checker { by, size: 0.25, ..Checker::default() });
                let inspection = inspect(&world, &offer(), width).expect("inspects");
                let tile = inspection.world.entity(inspection.tiles[0]);
                let (points, hits) = (tile.get::<TexturePoints>().expect("points"), tile.get::<Hits>().expect("hits"));
                // About the middle, where a pixel is as wide as it is high.
                let (column, line) = (width as usize / 2, height as usize / 2);
                for (x, y) in (line - 6..line + 6).flat_map(|y| (column - 6..column + 6).map(move |x| (x, y))) {
                    let row = y * width as usize + x;
                    let beside = [row, row + 1, row + width as usize];
                    if beside.iter().any(|&row| hits.t[row] == f64::INFINITY) {
                        continue;
                    }
                    let [here, right, down] = beside.map(|row| points.get(row).point);
                    let area = (right - here).cross(down - here).length();
                    let steps = points.get(row).steps;
                    let off = (steps[0].cross(steps[1]).length() / area - 1.0).abs();
                    worst = worst.max(off);
                    tried += 1;
                }
            }
        }
    }
    eprintln!("wide footprints: {tried} of them, the worst {worst:.4} larger or smaller than what neighbours span");
    assert!(tried > 800 && worst < 0.1, "{tried}, {worst}");
}

/// A floor to the horizon, all of whose light is its texture's.
fn floor(checker: Checker, eye: DVec3, size: [u32; 2]) -> World {
    let mut world = World::new();
    let resolution = Resolution { width: size[0], height: size[1] };
    let look = LookAt { eye, target: eye + DVec3::new(0.3, -0.35, -1.0), up: DVec3::Y };
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(60.0), ..Default::default() },
        look,
        resolution,
    ));
    world.spawn((Name::new("floor"), Plane::default(), Matte::default(), checker));
    world
}

fn two_colours() -> Checker {
    Checker { first: Rgb::new(1.0, 0.5, 0.0), second: Rgb::new(0.0, 0.5, 1.0), ..Checker::default() }
}

/// The mean radiance of each pixel.
fn pixels(world: &World) -> Vec<[f64; 3]> {
    let samples = SamplingTable::extract(&Census::of(world)).expect("sampling").samples;
    let film = film(world);
    film.pixels.iter().map(|pixel| [0, 1, 2].map(|part| f64::from_bits(pixel[part]) / f64::from(samples))).collect()
}

fn root_mean_square(one: &[[f64; 3]], other: &[[f64; 3]]) -> f64 {
    let square = |(one, other): (&[f64; 3], &[f64; 3])| (one[0] - other[0]) * (one[0] - other[0]);
    (one.iter().zip(other).map(square).sum::<f64>() / one.len() as f64).sqrt()
}

#[test]
fn a_filtered_pixel_is_nearer_to_many_samples_than_a_point_is() {
    for size in [0.5, 0.05, 0.005] {
        let render = |filter: bool, samples: u32| {
            let mut world = floor(Checker { filter, size, ..two_colours() }, DVec3::new(0.3, 1.0, 0.2), [48, 32]);
            if samples > 1 {
                let camera = named(&mut world, "camera");
                world.entity_mut(camera).insert(Sampling { samples, ..Sampling::default() });
            }
            pixels(&world)
        };
        let truth = render(false, 256);
        let (point, filtered) = (render(false, 1), render(true, 1));
        let errors = [root_mean_square(&point, &truth), root_mean_square(&filtered, &truth)];
        eprintln!("cells of {size}: a point a pixel is off by {:.3}, filtered by {:.3}", errors[0], errors[1]);
        assert!(errors[1] < 0.35 * errors[0], "{size}: {errors:?}");
        let mean = |pixels: &[[f64; 3]]| pixels.iter().map(|pixel| pixel[0]).sum::<f64>() / pixels.len() as f64;
        assert!((mean(&filtered) - mean(&truth)).abs() < 0.01, "{size}");
    }
}

#[test]
fn far_from_the_origin_and_at_the_horizon_it_is_the_mean() {
    for (eye, size) in [
        (DVec3::new(0.0, 1.0, 0.0), 1e-6),
        (DVec3::new(1e7, 1.0, -1e7), 1.0),
        (DVec3::new(1e7, 1e-7, 1e7), 1.0),
        (DVec3::new(0.0, 1e7, 0.0), 1.0),
    ] {
        let world = floor(Checker { size, ..two_colours() }, eye, [32, 64]);
        let inspection = inspect(&world, &offer(), 64).expect("inspects");
        let tile = inspection.world.entity(inspection.tiles[0]);
        let (hits, colours) = (tile.get::<Hits>().expect("hits"), tile.get::<SurfaceColours>().expect("coloured"));
        let (mut far, mut hit) = (0, 0);
        for row in 0..hits.t.len() {
            let colour = colours.rgb(row);
            assert!(colour.iter().all(|part| (0.0..=1.0).contains(part)), "{eye} {size} {row}: {colour:?}");
            if hits.t[row] < f64::INFINITY {
                hit += 1;
                // Cells of which a pixel covers more than 300 across.
                if hits.t[row] / 64.0 > 300.0 * size {
                    assert!((colour[0] - 0.5).abs() < 0.01, "{eye} {size} {row}: {colour:?}");
                    far += 1;
                }
            }
        }
        assert!(hit > 500);
        eprintln!("eye at {eye}, cells of {size}: {hit} pixels see the floor, {far} of them the mean");
    }
}

#[test]
fn by_space_the_texture_goes_with_its_shape() {
    let picture = |placement: Placement, look: LookAt, by: TextureBy| {
        let mut world = World::new();
        let resolution = Resolution { width: 24, height: 24 };
        world.spawn((Name::new("camera"), PerspectiveCamera::default(), look, resolution));
        let checker = Checker { size: 0.3, by, ..two_colours() };
        world.spawn((Cuboid::default(), placement, Matte::default(), checker));
        pixels(&world)
    };
    let look = LookAt { eye: DVec3::new(2.0, 3.0, 5.0), target: DVec3::ZERO, up: DVec3::Y };
    let (turn, shift) = (DQuat::from_xyzw(0.5, -0.1, 0.7, 0.5).normalize(), DVec3::new(30.0, -7.0, 11.0));
    for by in [TextureBy::Uv, TextureBy::Space] {
        let still = picture(Placement::default(), look, by);
        let placed = Placement { position: shift, orientation: turn, scale: DVec3::splat(2.0) };
        let moved = |point: DVec3| turn * (2.0 * point) + shift;
        let along = LookAt { eye: moved(look.eye), target: moved(look.target), up: turn * look.up };
        let there = picture(placed, along, by);
        let apart = still.iter().zip(&there).filter(|(one, other)| (one[0] - other[0]).abs() > 0.01).count();
        assert!(apart <= 3, "{by:?}: {apart} of {} pixels differ", still.len());
        assert!(still.iter().filter(|pixel| pixel[0] > 0.6).count() > 20);
    }
}

/// A film of a function of the pixel.
/// The normal that a map of one direction makes, by the neighbours' points and their u and v alone.
#[test]
fn a_mapped_normal_leans_along_the_neighbours_u_and_v() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("leaning.exr");
    let local = DVec3::new(0.3, -0.5, 0.7);
    write_exr(&drawn([1, 1], |_, _| local.to_array().map(|part| (0.5 + 0.5 * part) as f32)), &file).expect("written");
    let map = NormalMap { file: file.to_string_lossy().into_owned(), ..NormalMap::default() };
    let (mut tried, mut worst) = (0, [0.0_f64; 10]);
    for (number, worst) in worst.iter_mut().enumerate() {
        let (mut seen, mut from_behind) = (0, 0);
        for from in [DVec3::new(1.5, 2.5, 3.0), DVec3::new(-1.2, -2.5, 2.4), DVec3::new(-0.5, -3.5, -1.0)] {
            let mut world = close_up(Eye::Perspective, from, DVec3::new(0.4, -0.1, 0.3));
            shape(&mut world, number, map.clone());
            world.spawn((PointLight::default(), Placement { position: from, ..Placement::default() }));
            let inspection = inspect(&world, &offer(), 32).expect("inspects");
            let tile = inspection.world.entity(inspection.tiles[0]);
            let (surfaces, shading) =
                (tile.get::<Surfaces>().expect("laid"), tile.get::<ShadingNormals>().expect("laid"));
            let (uvs, sides) = (tile.get::<SurfaceUvs>().expect("laid"), tile.get::<SurfaceSides>().expect("laid"));
            for row in (0..31).flat_map(|y| (0..31).map(move |x| y * 32 + x)) {
                let offset = |beside: usize| {
                    let moved = surfaces.get(beside).position.as_dvec3() - surfaces.get(row).position.as_dvec3();
                    (moved, uvs.uv[0][beside] - uvs.uv[0][row], uvs.uv[1][beside] - uvs.uv[1][row])
                };
                let ((right, u, v), (down, other_u, other_v)) = (offset(row + 1), offset(row + 32));
                let normal = surfaces.get(row).normal.as_dvec3();
                // Both neighbours are on the same face, and not beyond a seam where u or v begins again.
                let beside = [row + 1, row + 32].map(|beside| surfaces.get(beside).normal.as_dvec3());
                let on_face = beside.iter().all(|beside| beside.dot(normal) > 0.99)
                    && right.dot(normal).abs() + down.dot(normal).abs() < 0.1 * right.length();
                if !on_face || [u, v, other_u, other_v].iter().any(|step| step.abs() > 0.3) {
                    continue;
                }
                let area = u * other_v - other_u * v;
                let (along_u, along_v) = ((right * other_v - down * v) / area, (down * u - right * other_u) / area);
                let outward = if sides.outside[row] == 1 { normal } else { -normal };
                let tangent = (along_u - outward * outward.dot(along_u)).normalize();
                let up = outward.cross(tangent);
                let up = if up.dot(along_v) > 0.0 { -up } else { up };
                let leaning = (local.x * tangent + local.y * up + local.z * outward).normalize();
                let expected = if sides.outside[row] == 1 { leaning } else { -leaning };
                *worst = worst.max((shading.get(row) - expected).length());
                seen += 1;
                from_behind += u32::from(sides.outside[row] == 0);
            }
        }
        let has_inside = !matches!(number, 2..6);
        assert!(seen > 900 && (from_behind > 100 || has_inside), "{number}: {seen} seen, {from_behind} from behind");
        tried += seen;
    }
    eprintln!("normal maps: {tried} normals on ten shapes, the worst of each {worst:.3?} apart");
    assert!(worst.iter().all(|worst| *worst < 0.03), "{worst:?}");
}

fn drawn(size: [u32; 2], of: impl Fn(u32, u32) -> [f32; 3]) -> Film {
    let mut film = Film::new(size[0], size[1], size[0].max(size[1]));
    for y in 0..size[1] {
        for x in 0..size[0] {
            film.tiles[0].add((y * size[0] + x) as usize, of(x, y));
        }
    }
    film
}

#[test]
fn a_file_is_looked_for_beside_its_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let pictures = folder.path().join("pictures");
    fs::create_dir(&pictures).expect("made");
    let left_to_right = |x: u32, _: u32| [if x < 4 { 0.0 } else { 1.0 }, 0.25, 0.5];
    write_png(&drawn([8, 4], left_to_right), Curve::Srgb, &pictures.join("card.png")).expect("written");
    write_exr(&drawn([8, 4], left_to_right), &pictures.join("card.exr")).expect("written");
    for ending in ["png", "exr"] {
        let scene = format!(
            "[(name: \"camera\", orthographic_camera: (), placement: (position: (0.0, 5.0, 0.0), \
             orientation: (-0.7071067811865476, 0.0, 0.0, 0.7071067811865476)), resolution: (width: 8, height: 8)),\n\
             (rectangle: (), matte: (), image_texture: (file: \"pictures/card.{ending}\"))]\n"
        );
        let path = folder.path().join("scene.ron");
        fs::write(&path, scene).expect("written");
        let file = SceneFile::open(&path).expect("opens");
        let pixels = pixels(&file.world());
        // Four pixels left of the middle and four right of it, each on a texel's centre across.
        let expected = |x: usize| if x < 4 { 0.0 } else { 1.0 };
        for (number, pixel) in pixels.iter().enumerate() {
            let off = (pixel[0] - expected(number % 8)).abs();
            assert!(off < 1e-6 && (pixel[2] - 0.5).abs() < 0.005, "{ending} {number}: {pixel:?}");
        }
        let text = scene_text(&file.world()).expect("writes");
        assert!(text.contains(&format!("file: \"pictures/card.{ending}\"")), "{text}");
    }
}

#[test]
fn an_environment_is_seen_where_it_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("all.exr");
    let radiance = |direction: DVec3| [1.5 + direction.x, 1.5 + direction.y, 1.5 + direction.z];
    let size = [256, 128];
    let at = |x: u32, y: u32| glam::DVec2::new((f64::from(x) + 0.5) / 256.0, (f64::from(y) + 0.5) / 128.0);
    let image = drawn(size, |x, y| radiance(direction_of(at(x, y))).map(|part| part as f32));
    write_exr(&image, &path).expect("written");
    let mut worst = 0.0_f64;
    for turn in [0.0, 90.0, -30.0] {
        for target in [DVec3::NEG_Z, DVec3::X, DVec3::new(0.2, 1.0, 0.1), DVec3::new(0.0, -1.0, 1e-6), DVec3::Z] {
            let mut world = World::new();
            let up = if target.y.abs() > 0.9 { DVec3::Z } else { DVec3::Y };
            let look = LookAt { eye: DVec3::new(5.0, 6.0, 7.0), target: DVec3::new(5.0, 6.0, 7.0) + target, up };
            let resolution = Resolution { width: 5, height: 5 };
            world.spawn((
                Name::new("camera"),
                PerspectiveCamera { fov: Degrees(1.0), ..Default::default() },
                look,
                resolution,
            ));
            let file = path.to_string_lossy().into_owned();
            world.spawn((Name::new("sky"), Environment { file, turn: Degrees(turn), scale: 2.0 }));
            let centre = pixels(&world)[12];
            let straight = DQuat::from_rotation_y(-Degrees(turn).radians()) * target.normalize();
            for (told, truth) in centre.into_iter().zip(radiance(straight)) {
                worst = worst.max((told - 2.0 * truth).abs());
            }
        }
    }
    eprintln!("environment: 15 views, the worst off by {worst:.1e}");
    assert!(worst < 2e-3, "{worst}");
}

#[test]
fn files_that_are_no_images_are_refused_in_a_sentence() {
    let folder = tempfile::tempdir().expect("a folder");
    let put = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).expect("written");
    let card = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters/16_textures/card.png")).expect("kept");
    let evening =
        fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters/16_textures/evening.hdr")).expect("kept");
    put("empty.png", b"");
    put("text.png", b"this is no picture at all");
    put("cut.png", &card[..card.len() / 2]);
    put("cut.hdr", &evening[..evening.len() / 2]);
    put("cut.exr", b"v/1\x01\x02\x00\x00\x00");
    put("text.exr", b"nor is this");
    put("text.hdr", b"#?RADIANCE\n\n-Y 99999999 +X 99999999\n");
    fs::create_dir(folder.path().join("folder.png")).expect("made");
    let names = [
        "empty.png",
        "text.png",
        "cut.png",
        "cut.hdr",
        "cut.exr",
        "text.exr",
        "text.hdr",
        "folder.png",
        "missing.png",
        "card.gif",
        "card",
        "",
        "pictures/../missing.exr",
        "a\nb.png",
    ];
    for name in names {
        let mut world = floor(Checker::default(), DVec3::Y, [4, 4]);
        let floor = named(&mut world, "floor");
        let file = ImageTexture { file: name.into(), ..ImageTexture::default() };
        world.entity_mut(floor).remove::<Checker>().insert(file);
        world.insert_resource(SceneFolder(folder.path().into()));
        let scene_error = pinhole::extract::validate(&Census::of(&world)).expect_err(name).to_string();
        let shown = scene_error.replace(&folder.path().display().to_string(), "…");
        eprintln!("{shown}");
        assert!(shown.starts_with("image texture \"floor\": file is ") && !shown.contains('\n'), "{shown}");
        assert!(!shown.ends_with('.') && shown.contains(", but "), "{shown}");
    }
}

/// At the pole of a sphere u has no derivative, so that a pixel there shows the mean, whatever runs across the stripes.
#[test]
fn stripes_at_a_pole_are_their_mean() {
    for across in [DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.0, -1.0, 0.0)] {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::Y * 3.0, target: DVec3::ZERO, up: DVec3::Z };
        world.spawn((OrthographicCamera { view_height: 0.01 }, look, Resolution { width: 1, height: 1 }));
        let (first, second) = (Rgb::grey(0.75), Rgb::grey(0.25));
        let stripes = Stripes { first, second, across, by: TextureBy::Uv, ..Stripes::default() };
        world.spawn((Sphere { radius: 1.0 }, Matte::default(), stripes));
        assert_eq!(pixels(&world), [[0.5; 3]], "across {across}");
    }
}
