//! What `conventions` tells a reader to type makes the same rays there.
//!
//! How each program gets from its words to a ray is written out here from its source or manual, without pinhole: the
//! numbers are read off the printed lines, and the ray through a pixel is compared with pinhole's.

use bevy_ecs::prelude::*;
use glam::{DMat3, DVec2, DVec3};
use pinhole::Overrides;
use pinhole::extract::{PerspectiveProjection, angle_of_tan_half, half_extent};
use pinhole::look::convention::*;
use pinhole::plan::{Census, Table};
use pinhole::rays::{camera_ray_perspective, ndc_from_raster, raster_from_pixel, screen_from_ndc};
use pinhole::render::{Execution, render};
use pinhole::scene::*;

fn scene(name: &str, width: u32, height: u32) -> World {
    let chapter = chapters::all().into_iter().find(|chapter| chapter.name == name).expect("a chapter");
    chapter.world(&Overrides { resolution: Some(Resolution { width, height }), ..Overrides::default() })
}

/// Pinhole's own ray through a pixel's centre, in f64.
fn our_ray(camera: &PlacedCamera, pixel: [u32; 2]) -> DVec3 {
    let ndc = ndc_from_raster(raster_from_pixel(pixel[0], pixel[1]), camera.image.size());
    let screen = screen_from_ndc(ndc, camera.image.aspect());
    camera.world_from_camera * camera_ray_perspective(screen, camera.tan_half_vertical)
}

/// The numbers of a text; digits in a word such as `vec3` are none.
fn numbers(text: &str) -> Vec<f64> {
    let in_number = |letter: char| letter.is_ascii_digit() || letter == '.' || letter == '-';
    let mut found = Vec::new();
    let mut before = ' ';
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = rest.find(|letter| !in_number(letter)).unwrap_or(rest.len());
        if length > 0 && !before.is_alphabetic() {
            found.extend(rest[..length].parse::<f64>().ok());
        }
        let step = length.max(first.len_utf8());
        before = rest[..step].chars().next_back().unwrap_or(' ');
        rest = &rest[step..];
    }
    found
}

/// What a program reads, in order.
struct Typed {
    numbers: Vec<f64>,
    at: usize,
}

impl Typed {
    fn next(&mut self) -> f64 {
        self.at += 1;
        self.numbers[self.at - 1]
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }

    fn rows(&mut self) -> DMat3 {
        DMat3::from_cols(self.vector(), self.vector(), self.vector()).transpose()
    }
}

/// Eye and direction, in our world, of the ray that a program makes of what was typed.
fn their_ray(program: Program, typed: &mut Typed, size: [u32; 2], [i, j]: [u32; 2]) -> (DVec3, DVec3) {
    let (x, y) = (f64::from(i) + 0.5, f64::from(j) + 0.5);
    let [w, h] = size.map(f64::from);
    match program {
        // https://raytracing.github.io/books/RayTracingInOneWeekend.html, camera::initialize and get_ray.
        Program::OneWeekend => {
            let width = typed.next();
            let aspect = typed.next() / typed.next();
            let height = (width / aspect).round();
            assert_eq!([width, height], [w, h]);
            let viewport_height = 2.0 * (typed.next().to_radians() / 2.0).tan();
            let viewport_width = viewport_height * (width / height);
            let (from, at, up) = (typed.vector(), typed.vector(), typed.vector());
            let back = (from - at).normalize();
            let right = up.cross(back).normalize();
            let (u, v) = (viewport_width * right, -viewport_height * back.cross(right));
            let first = -back - u / 2.0 - v / 2.0 + 0.5 * (u / width + v / height);
            (from, first + f64::from(i) * u / width + f64::from(j) * v / height)
        }
        // Suffern, Ray Tracing from the Ground Up, section 9.3; its rows are counted from the bottom.
        Program::GroundUp => {
            assert_eq!([typed.next(), typed.next()], [w, h]);
            let s = typed.next();
            let (eye, at, distance) = (typed.vector(), typed.vector(), typed.next());
            let back = (eye - at).normalize();
            let right = DVec3::Y.cross(back).normalize();
            let row = h - 1.0 - f64::from(j);
            let (px, py) = (s * (f64::from(i) - 0.5 * w + 0.5), s * (row - 0.5 * h + 0.5));
            (eye, px * right + py * back.cross(right) - distance * back)
        }
        // The manual pages of gluPerspective and gluLookAt; window coordinates start at the bottom.
        Program::OpenGl => {
            let f = 1.0 / (typed.next().to_radians() / 2.0).tan();
            let aspect = typed.next() / typed.next();
            let (eye, at, up) = (typed.vector(), typed.vector(), typed.vector());
            let ahead = (at - eye).normalize();
            let side = ahead.cross(up).normalize();
            let (ndc_x, ndc_y) = (2.0 * x / w - 1.0, 2.0 * (h - y) / h - 1.0);
            (eye, ndc_x * aspect / f * side + ndc_y / f * side.cross(ahead) + ahead)
        }
        // glTF 2.0, sections 3.10.1 and 3.10.3.3; a node's rotation is the quaternion (x, y, z, w).
        Program::Gltf => {
            let (tan, aspect) = ((typed.next() / 2.0).tan(), typed.next());
            typed.at += 2;
            let (eye, q, real) = (typed.vector(), typed.vector(), typed.next());
            let d = DVec3::new((2.0 * x / w - 1.0) * aspect * tan, (1.0 - 2.0 * y / h) * tan, -1.0);
            (eye, d + 2.0 * q.cross(q.cross(d) + real * d))
        }
        // pbrt-v4, cameras.cpp (PerspectiveCamera::Create: the screen window) and transform.cpp (LookAt).
        Program::Pbrt => {
            let scale = typed.vector();
            let (eye, at, up) = (typed.vector(), typed.vector(), typed.vector());
            let tan = (typed.next().to_radians() / 2.0).tan();
            assert_eq!([typed.next(), typed.next()], [w, h]);
            let ahead = (at - eye).normalize();
            let right = up.normalize().cross(ahead).normalize();
            let frame = w / h;
            let (sx, sy) = if frame > 1.0 { (frame, 1.0) } else { (1.0, 1.0 / frame) };
            let p = DVec3::new((2.0 * x / w - 1.0) * sx * tan, (1.0 - 2.0 * y / h) * sy * tan, 1.0) / scale;
            (eye, p.x * right + p.y * ahead.cross(right) + p.z * ahead)
        }
        // Mitsuba 3, sensors/perspective.cpp (camera_to_sample) and transform.h (look_at).
        Program::Mitsuba => {
            let tan = (typed.next().to_radians() / 2.0).tan();
            let (eye, at, up) = (typed.vector(), typed.vector(), typed.vector());
            assert_eq!([typed.next(), typed.next()], [w, h]);
            let ahead = (at - eye).normalize();
            let left = up.cross(ahead).normalize();
            let (cx, cy) = (1.0 - 2.0 * x / w, (1.0 - 2.0 * y / h) * h / w);
            (eye, cx * tan * left + cy * tan * ahead.cross(left) + ahead)
        }
        // OpenCV, calib3d: u = fx X/Z + cx, v = fy Y/Z + cy, (X, Y, Z) = R p + t; pixel centres are whole numbers.
        Program::OpenCv => {
            let (k, r, t) = (typed.rows(), typed.rows(), typed.vector());
            let d = DVec3::new((f64::from(i) - k.z_axis.x) / k.x_axis.x, (f64::from(j) - k.z_axis.y) / k.y_axis.y, 1.0);
            (r.transpose() * -t, r.transpose() * d)
        }
        // Blender, blenkernel/intern/camera.c: sensor_fit AUTO takes the sensor's width for the longer side.
        Program::Blender => {
            assert_eq!([typed.next(), typed.next()], [w, h]);
            let half = typed.next() / 2.0 / typed.next() / w.max(h);
            let rows = [0; 3].map(|_| (typed.vector(), typed.next()));
            let d = DVec3::new((2.0 * x - w) * half, (h - 2.0 * y) * half, -1.0);
            let [right, depth, up] = rows.map(|(row, _)| row.dot(d));
            let [ex, ey, ez] = rows.map(|(_, at)| at);
            (DVec3::new(ex, ez, -ey), DVec3::new(right, up, -depth))
        }
    }
}

/// How far the two rays part, in pixels of the image's height, and how far the eyes do, relative to their distance.
fn apart(program: Program, camera: &PlacedCamera, pixel: [u32; 2]) -> [f64; 2] {
    let text = lines(program, camera).join("\n");
    let mut typed = Typed { numbers: numbers(&text), at: 0 };
    let (eye, direction) = their_ray(program, &mut typed, [camera.image.width, camera.image.height], pixel);
    let angle = direction.normalize().cross(our_ray(camera, pixel)).length();
    assert!(direction.dot(our_ray(camera, pixel)) > 0.0, "{program} looks the other way");
    let pixel_angle = 2.0 * camera.tan_half_vertical / f64::from(camera.image.height);
    [angle / pixel_angle, (eye - camera.look.eye).length() / camera.look.eye.length().max(1.0)]
}

#[test]
fn the_lines_to_type_make_the_same_rays() {
    let mut tried = 0;
    let mut worst = [0.0_f64; 2];
    for name in ["10_light_and_shadow", "05_pinhole", "11_conventions"] {
        for [width, height] in [[480, 270], [270, 480], [100, 100], [64, 1], [1, 1]] {
            let camera = PlacedCamera::of(&scene(name, width, height)).expect("a perspective camera");
            let (right, bottom) = (width - 1, height - 1);
            for pixel in
                [[0, 0], [right, 0], [0, bottom], [right, bottom], [width / 3, height / 5], [width / 2, bottom]]
            {
                for program in Program::ALL {
                    let [ray, eye] = apart(program, &camera, pixel);
                    assert!(ray < 1e-7, "{program}, {name} {width}x{height} pixel {pixel:?}: {ray} px");
                    assert!(eye < 1e-10, "{program}, {name}: the eye is {eye} off");
                    worst = [worst[0].max(ray), worst[1].max(eye)];
                    tried += 1;
                }
            }
        }
    }
    eprintln!("conventions: {tried} rays, worst {:.1e} px, eye {:.1e}", worst[0], worst[1]);
}

/// Without its part of the lines, each program makes another ray: the comparison can fail.
#[test]
fn a_wrong_line_is_seen() {
    let camera = PlacedCamera::of(&scene("11_conventions", 480, 270)).expect("a camera");
    let seen = |program: Program, from: &str, to: &str| {
        let text = lines(program, &camera).join("\n");
        assert!(text.contains(from), "{program} says {from}");
        let mut typed = Typed { numbers: numbers(&text.replace(from, to)), at: 0 };
        let (_, direction) = their_ray(program, &mut typed, [480, 270], [100, 50]);
        direction.normalize().cross(our_ray(&camera, [100, 50])).length() > 0.01
    };
    assert!(seen(Program::Pbrt, "Scale -1 1 1", "Scale 1 1 1"), "a mirrored pbrt");
    assert!(seen(Program::Mitsuba, "65.8104350172", "40"), "a vertical angle for Mitsuba's x");
    assert!(seen(Program::OpenCv, "370.9", "470.9"), "another focal length");
    assert!(seen(Program::Blender, "27.818208872", "35"), "another lens");
    assert!(seen(Program::Gltf, "0.976159676946", "0.9"), "another turn");
}

#[test]
fn what_an_angle_is_across_is_what_extraction_takes_it_for() {
    let mut tried = 0;
    for axis in [FovAxis::Vertical, FovAxis::Horizontal, FovAxis::Smaller, FovAxis::Larger, FovAxis::Diagonal] {
        for [width, height] in [[480, 270], [270, 480], [7, 7], [65_536, 1], [1, 65_536]] {
            let mut world = World::new();
            world.spawn((PerspectiveCamera { fov: Degrees(70.0), axis }, Resolution { width, height }));
            let Ok(lens) = PerspectiveProjection::extract(&Census::of(&world)) else { continue };
            let tan = lens.tan_half_vertical * half_extent(axis, f64::from(width) / f64::from(height));
            let back = angle_of_tan_half(tan).0;
            assert!((back - 70.0).abs() < 1e-12, "{axis:?} {width}x{height}: {back}");
            tried += 1;
        }
    }
    eprintln!("axes: {tried} cameras");
    assert!(tried >= 20);
}

/// The picture of a chapter's scene after a mistake, or without one.
fn picture(mistake: Option<Mistake>) -> pinhole::film::Film {
    let chapter = chapters::all().into_iter().find(|chapter| chapter.name == "11_conventions").expect("a chapter");
    let mut scene = scene("11_conventions", 96, 54);
    if let Some(mistake) = mistake {
        mistake.commit(&mut scene).expect("a scene that renders");
    }
    render(&scene, &chapter.stages(), &Execution::default(), &()).expect("renders").film
}

#[test]
fn mirrored_pictures_are_the_right_one_turned_over() {
    let right = picture(None);
    let flips: [(Mistake, fn([u32; 2]) -> [u32; 2]); 2] =
        [(Mistake::Mirrored, |[x, y]| [95 - x, y]), (Mistake::UpsideDown, |[x, y]| [x, 53 - y])];
    for (mistake, flip) in flips {
        let wrong = picture(Some(mistake));
        let mut differ = 0;
        for pixel in (0..54).flat_map(|y| (0..96).map(move |x| [x, y])) {
            let [ox, oy] = flip(pixel);
            let (a, b) = (right.mean(pixel[0], pixel[1]), wrong.mean(ox, oy));
            let near = (0..3).all(|part| (a[part] - b[part]).abs() <= 1e-4 * a[part].max(b[part]));
            differ += usize::from(!near);
        }
        eprintln!("{mistake}: {differ} of 5184 pixels differ from the right picture turned over");
        assert!(differ <= 4, "{mistake}: {differ} pixels");
        assert!(wrong != right);
    }
}

#[test]
fn mistaken_cameras_look_where_they_are_said_to() {
    let of = |mistake: Mistake| {
        let mut scene = scene("11_conventions", 480, 270);
        mistake.commit(&mut scene).expect("a scene that renders");
        PlacedCamera::of(&scene).expect("a camera")
    };
    let right = PlacedCamera::of(&scene("11_conventions", 480, 270)).expect("a camera");
    let backwards = of(Mistake::Backwards);
    assert!((backwards.world_from_camera.z_axis + right.world_from_camera.z_axis).length() < 1e-15);
    assert!((backwards.world_from_camera.y_axis - right.world_from_camera.y_axis).length() < 1e-15);
    let aspect = 480.0 / 270.0;
    assert!((of(Mistake::TooNarrow).tan_half_vertical * aspect / right.tan_half_vertical - 1.0).abs() < 1e-14);
    assert!((of(Mistake::TooWide).tan_half_vertical / aspect / right.tan_half_vertical - 1.0).abs() < 1e-14);
    let rolled = of(Mistake::Rolled);
    assert!((rolled.world_from_camera.z_axis - right.world_from_camera.z_axis).length() < 1e-15);
    assert!(rolled.world_from_camera.y_axis.z > 0.0);
}

#[test]
fn a_camera_of_parallel_rays_is_refused_in_one_sentence() {
    let told = PlacedCamera::of(&scene("04_orthographic", 8, 8)).expect_err("refused").to_string();
    assert_eq!(told, "the conventions are those of perspective cameras, and this scene's camera is orthographic");
}

#[test]
fn a_camera_on_a_turned_parent_is_described_where_it_stands() {
    let mut world = World::new();
    let turned = Placement {
        orientation: glam::DQuat::from_xyzw(0.0, 0.6, 0.0, 0.8),
        position: DVec3::new(1.0, 2.0, 3.0),
        ..Placement::default()
    };
    let parent = world.spawn(turned).id();
    let look = LookAt { eye: DVec3::new(0.0, 1.0, 2.0), target: DVec3::ZERO, up: DVec3::Y };
    world.spawn((PerspectiveCamera::default(), look, ChildOf(parent), Resolution { width: 64, height: 36 }));
    let camera = PlacedCamera::of(&world).expect("a camera");
    for program in Program::ALL {
        let [ray, eye] = apart(program, &camera, [5, 30]);
        assert!(ray < 1e-7 && eye < 1e-10, "{program}: {ray} px, eye {eye}");
    }
    assert!(((camera.look.target - camera.look.eye).length() - 1.0).abs() < 1e-15);
    assert_eq!(camera.image.size(), DVec2::new(64.0, 36.0));
}

/// Swaps and signs are exact; a tangent t comes back within what rounding an angle of its size can do to it: a few ε,
/// and near 180°, where an angle's last digit is worth (1 + t²) / 2t of them, that many.
#[test]
fn cameras_come_back_within_the_rounding_of_their_words() {
    let right = PlacedCamera::of(&scene("11_conventions", 480, 270)).expect("a camera");
    let (mut tried, mut worst) = (0, 0.0_f64);
    for step in 0..2_000 {
        let degrees = 1e-4 + (179.99 - 1e-4) * f64::from(step) / 1_999.0;
        for [width, height] in [[480, 270], [270, 480], [1, 1], [65_536, 1], [1, 65_536]] {
            let image = pinhole::extract::ImageFrame { width, height };
            let tan_half_vertical = pinhole::extract::tan_half(Degrees(degrees));
            let pinhole_camera = PlacedCamera { tan_half_vertical, image, ..right };
            for program in Program::ALL {
                let back = pinhole_from_theirs(program, &theirs_from_pinhole(program, &pinhole_camera), image);
                assert_eq!(back.world_from_camera, pinhole_camera.world_from_camera, "{program}");
                assert_eq!(back.look.eye, pinhole_camera.look.eye, "{program}");
                let (axis, angle) = match program.opening() {
                    Opening::Degrees(axis) | Opening::Radians(axis) => (axis, true),
                    Opening::Pixels => (FovAxis::Vertical, false),
                    Opening::Millimetres(_, axis) => (axis, false),
                };
                let t = tan_half_vertical * half_extent(axis, image.aspect());
                let stretch = if angle && t > 1.0 { (1.0 + t * t) / (2.0 * t) } else { 1.0 };
                let error = (back.tan_half_vertical / tan_half_vertical - 1.0).abs() / f64::EPSILON;
                let ratio = error / (4.0 + 2.0 * std::f64::consts::PI * stretch);
                assert!(ratio <= 1.0, "{program}, {degrees}°, {width}x{height}: {error} ε");
                worst = worst.max(ratio);
                tried += 1;
            }
        }
    }
    eprintln!("there and back: {tried} cameras, at most {worst:.2} of the bound");
}
