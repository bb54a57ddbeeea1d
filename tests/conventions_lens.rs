//! The lens and the rows of the lines that `conventions` prints.

use bevy_ecs::prelude::*;
use pinhole::extract::LensTable;
use pinhole::look::convention::{PlacedCamera, Program, lines, lines_with_lens};
use pinhole::plan::{Census, Table};
use pinhole::scene::*;

fn scene(width: u32, height: u32, lens: Lens) -> World {
    let mut world = World::new();
    let camera = PerspectiveCamera { fov: Degrees(40.0), axis: FovAxis::Vertical };
    world.spawn((Name::new("camera"), camera, lens, Placement::at(0.0, 0.0, 5.0), Resolution { width, height }));
    world.spawn((Sphere::default(), Emissive::default()));
    world
}

/// The last number of a line of this program that contains a word.
fn number(text: &[String], word: &str) -> f64 {
    let line = text.iter().find(|line| line.contains(word)).unwrap_or_else(|| panic!("no {word} in {text:#?}"));
    let after = &line[line.find(word).expect("there") + word.len()..];
    let digits: String = after
        .chars()
        .skip_while(|letter| !letter.is_ascii_digit())
        .take_while(|letter| letter.is_ascii_digit() || ['.', 'e', '-'].contains(letter))
        .collect();
    digits.parse().expect("a number")
}

/// Each program's words give the same radius and distance, or it says that it has no lens.
#[test]
fn a_lens_is_told_to_every_program() {
    let mut tried = 0;
    for (radius, focus, blades) in [(0.1, 3.0, 0), (0.02, 0.5, 6), (2.0, 40.0, 5)] {
        let lens = Lens { aperture: Aperture::Radius { radius }, focus_distance: focus, blades, ..Lens::default() };
        let world = scene(140, 120, lens);
        let (camera, lens) =
            (PlacedCamera::of(&world).expect("a camera"), LensTable::extract(&Census::of(&world)).expect("a lens"));
        for program in Program::ALL {
            let text = lines_with_lens(program, &camera, Some(&lens));
            let told = match program {
                Program::OneWeekend => {
                    let distance = number(&text, "focus_dist");
                    Some([distance * libm::tan(number(&text, "defocus_angle").to_radians() / 2.0), distance])
                }
                Program::GroundUp => Some([number(&text, "set_lens_radius"), number(&text, "set_focal_distance")]),
                Program::Pbrt => Some([number(&text, "lensradius"), number(&text, "focaldistance")]),
                Program::Mitsuba => {
                    assert!(text[0].contains("'thinlens'"), "{text:#?}");
                    Some([number(&text, "aperture_radius"), number(&text, "focus_distance")])
                }
                Program::Blender => {
                    let line = text.iter().find(|line| line.contains("aperture_fstop")).expect("a line");
                    let (_, numbers) = line.split_once(" = ").expect("numbers");
                    let numbers: Vec<f64> =
                        numbers.split(", ").map(|number| number.parse().expect("a number")).collect();
                    let focal = 36.0 / (2.0 * camera.tan_half_vertical * camera.image.aspect());
                    Some([1e-3 * focal / (2.0 * numbers[1]), numbers[0]])
                }
                Program::OpenGl | Program::Gltf | Program::OpenCv => {
                    assert!(text.iter().any(|line| line.contains("the lens is left out")), "{text:#?}");
                    None
                }
            };
            if let Some([told_radius, told_focus]) = told {
                assert!((told_radius / radius - 1.0).abs() < 1e-9, "{program}: {told_radius} is not {radius}");
                assert!((told_focus / focus - 1.0).abs() < 1e-9, "{program}: {told_focus} is not {focus}");
                let edges = text.iter().any(|line| line.contains("straight edges") || line.contains("aperture_blades"));
                assert_eq!(edges, blades > 0, "{program}: {text:#?}");
            }
            assert_eq!(lines_with_lens(program, &camera, None), lines(program, &camera));
            tried += 1;
        }
    }
    eprintln!("lenses: {tried} programs and lenses");
}

/// *One Weekend* computes `int(image_width / aspect_ratio)` rows.
#[test]
fn one_weekend_gets_as_many_rows() {
    let mut tried = 0;
    let sizes = (1..=160).flat_map(|width| (1..=160).map(move |height| [width, height]));
    for [width, height] in sizes.chain([[140, 120], [110, 90], [110, 100], [1920, 1080], [3840, 2160], [1, 65_536]]) {
        let world = scene(width, height, Lens::default());
        let Ok(camera) = PlacedCamera::of(&world) else { continue };
        let first = &lines(Program::OneWeekend, &camera)[0];
        let (_, ratio) = first.split_once("aspect_ratio = ").expect("a ratio");
        let parts: Vec<f64> =
            ratio.trim_end_matches(';').split(" / ").map(|part| part.parse().expect("a number")).collect();
        let rows = (f64::from(width) / (parts[0] / parts[1])) as u32;
        assert_eq!(rows, height, "{width} x {height}: {first}");
        tried += 1;
    }
    eprintln!("rows: {tried} sizes");
    assert!(tried > 25_000);
}
