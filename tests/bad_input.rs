//! Every refusal: one sentence that names the entity, the field, the value and what is accepted; never a panic.

use crate::scenes;

#[path = "bad_input/cameras.rs"]
mod cameras;
#[path = "bad_input/cases.rs"]
mod cases;
#[path = "bad_input/textures.rs"]
mod textures;

use bevy_ecs::prelude::*;
use cases::*;
use glam::{DQuat, DVec3};
use pinhole::plan::{Census, PlanError};
use pinhole::render::prepare;
use pinhole::scene::*;
use pinhole::{Error, look};
use pinhole_cli::command;
use scenes::{Eye, offer};
use std::fmt::Display;
use std::fs;

/// What preparing a scene is refused with.
fn scene_error(scene: &World, what: &str) -> String {
    match prepare(&Census::of(scene), &offer()) {
        Err(error) => sentence(&error, what),
        Ok(_) => panic!("{what} is not refused"),
    }
}

/// A message, which must be one sentence on one line, without a full stop and without a number nobody can read.
fn sentence(error: &dyn Display, what: &str) -> String {
    let message = error.to_string();
    assert!(!message.contains('\n'), "{what}: more than one line: {message}");
    assert!(!message.contains(". ") && !message.ends_with('.'), "{what}: more than one sentence: {message}");
    // A view that nothing writes names the shapes that there are none of, ten kinds of them.
    assert!(message.chars().count() <= 400, "{what}: {} letters: {message}", message.chars().count());
    assert!(!message.contains("000000000000"), "{what}: a number without an exponent: {message}");
    message
}

fn kept(name: &str, lines: &[String]) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, lines.join("\n")));
}

#[test]
fn bad_scenes() {
    let mut lines = Vec::new();
    let groups = [
        (Eye::Perspective, CAMERAS),
        (Eye::Perspective, SHAPES),
        (Eye::Perspective, MATERIAL),
        (Eye::Orthographic, ORTHOGRAPHIC),
    ];
    for (eye, cases) in groups {
        prepare(&Census::of(&good(eye)), &offer()).map(|_| ()).expect("the good scene is good");
        for (what, words, spoil) in cases {
            let mut scene = good(eye);
            spoil(&mut scene);
            let message = scene_error(&scene, what);
            for word in *words {
                assert!(message.contains(word), "{what}: no {word} in: {message}");
            }
            lines.push(format!("{what:<34} {message}"));
        }
    }
    kept("bad_scenes", &lines);
    eprintln!("bad scenes: {} refused", lines.len());
}

#[test]
fn bad_textures() {
    let mut lines = Vec::new();
    prepare(&Census::of(&textures::good_textures()), &offer()).map(|_| ()).expect("the good scene is good");
    for (what, words, spoil) in textures::TEXTURES {
        let mut scene = textures::good_textures();
        spoil(&mut scene);
        let message = scene_error(&scene, what);
        for word in *words {
            assert!(message.contains(word), "{what}: no {word} in: {message}");
        }
        lines.push(format!("{what:<34} {message}"));
    }
    for (field, name, set) in textures::TEXTURE_FIELDS {
        for (value, shown) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf"), (f64::NEG_INFINITY, "-inf")] {
            let mut scene = textures::good_textures();
            set(&mut scene, value);
            let what = format!("{field} of \"{name}\" {shown}");
            let message = scene_error(&scene, &what);
            for word in [&format!("\"{name}\": "), &format!("{field} is "), shown] {
                assert!(message.contains(word), "{what}: no {word} in: {message}");
            }
            lines.push(message);
        }
    }
    kept("bad_textures", &lines);
    eprintln!("bad textures: {} refused", lines.len());
}

#[test]
fn bad_numbers() {
    let mut lines = Vec::new();
    let height: Field = ("view_height", "main", |w, v| edit::<OrthographicCamera>(w, "main", |c| c.view_height = v));
    let fields = FIELDS.iter().map(|field| (Eye::Perspective, field)).chain([(Eye::Orthographic, &height)]);
    for (eye, (field, name, set)) in fields {
        for (value, shown) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf"), (f64::NEG_INFINITY, "-inf")] {
            let mut scene = good(eye);
            set(&mut scene, value);
            let what = format!("{field} of \"{name}\" {shown}");
            let message = scene_error(&scene, &what);
            for word in [&format!("\"{name}\": "), &format!("{field} is "), shown] {
                assert!(message.contains(word), "{what}: no {word} in: {message}");
            }
            lines.push(message);
        }
    }
    kept("bad_numbers", &lines);
    eprintln!("bad numbers: {} fields × NaN, ∞, −∞, all refused by name", lines.len() / 3);
}

/// Refusing must not go so far as to refuse what works.
#[test]
fn scenes_at_the_edge_are_accepted() {
    type Edge = (&'static str, fn(&mut World));
    let edges: [Edge; 21] = [
        ("fov 179.99", |w| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(179.99))),
        ("fov 0.01", |w| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(0.01))),
        ("1 × 1", |w| put(w, "main", Resolution { width: 1, height: 1 })),
        ("a turned parent of the camera", |w| {
            let orientation = DQuat::from_xyzw(0.5, 0.5, 0.5, 0.5);
            let parent = w.spawn(Placement { orientation, ..Placement::default() }).id();
            child_of(w, "main", parent);
        }),
        ("a far camera", |w| edit::<Placement>(w, "main", |p| p.position = DVec3::splat(1e17))),
        ("radius 1e17", |w| edit::<Sphere>(w, "ball", |s| s.radius = 1e17)),
        ("radius 1e-17", |w| edit::<Sphere>(w, "ball", |s| s.radius = 1e-17)),
        ("a mirrored sphere", |w| edit::<Placement>(w, "ball", |p| p.scale = DVec3::new(-2.0, 2.0, 2.0))),
        ("a mirrored egg", |w| edit::<Placement>(w, "ball", |p| p.scale = DVec3::new(1.0, -2.0, 1.0))),
        ("a needle", |w| edit::<Placement>(w, "ball", |p| p.scale = DVec3::new(1e-3, 9e3, 1e-3))),
        ("a plane stretched unevenly", |w| edit::<Placement>(w, "floor", |p| p.scale = DVec3::new(1.0, 2.0, 3.0))),
        ("a long normal", |w| edit::<Plane>(w, "floor", |p| p.normal = DVec3::new(0.0, 1e300, 1e299))),
        ("a mirrored triangle", |w| edit::<Placement>(w, "sail", |p| p.scale = DVec3::new(-1.0, 2.0, 3.0))),
        ("a sliver", |w| edit::<Triangle>(w, "sail", |t| t.vertices[2] = DVec3::new(0.5, 1e-13, 0.0))),
        ("a small triangle", |w| edit::<Triangle>(w, "sail", |t| t.vertices = t.vertices.map(|v| v * 1e-30))),
        ("a triangle lost to rounding", |w| {
            edit::<Triangle>(w, "sail", |t| t.vertices = t.vertices.map(|v| v * 1e-9));
            edit::<Placement>(w, "sail", |p| p.position = DVec3::splat(1e10));
        }),
        ("long and inward normals", |w| {
            edit::<Triangle>(w, "sail", |t| t.normals = Some([DVec3::NEG_Z * 1e300, -DVec3::ONE, DVec3::NEG_Z]));
        }),
        ("black and white", |w| edit::<Matte>(w, "ball", |m| m.colour = Rgb::new(0.0, 1.0, 0.0))),
        ("a light of no light", |w| edit::<PointLight>(w, "lamp", |l| l.intensity = Rgb::BLACK)),
        ("up almost along the view", |w| {
            look_at(w, LookAt { eye: DVec3::new(1e-5, 5.0, 0.0), target: DVec3::ZERO, up: DVec3::Y });
        }),
        ("a long up", |w| look_at(w, LookAt { up: DVec3::new(0.0, 1e300, 0.0), ..LookAt::default() })),
    ];
    for (what, change) in edges {
        let mut scene = good(Eye::Perspective);
        change(&mut scene);
        let film = scenes::film(&scene);
        assert_eq!(film.rejected, 0, "{what}: rejected samples");
    }
    eprintln!("edges: {} scenes accepted, no sample rejected", edges.len());
}

#[test]
fn bad_views_and_pixels() {
    let mut lines = Vec::new();
    let view = |word: &str| {
        let mut scene = good(Eye::Perspective);
        put(&mut scene, "main", View { column: word.into() });
        scene
    };
    let scene = view("colour");
    assert!(matches!(prepare(&Census::of(&scene), &offer()), Err(Error::Plan(PlanError::NoSuchView { .. }))));
    lines.push(scene_error(&scene, "an unknown column"));
    let shapes = ["ball", "floor", "sail", "glossy", "satin", "glow"];
    let lights = ["lamp", "sun", "spot", "glow"];
    for (word, gone) in [("surface", shapes.as_slice()), ("shadow hit", &lights), ("shadow ray", &lights)] {
        let mut scene = view(word);
        for name in gone {
            put(&mut scene, name, Disabled);
        }
        let message = scene_error(&scene, word);
        // A message names the first three of a kind.
        assert!(message.contains(gone[0]), "{word}: {} is disabled, but: {message}", gone[0]);
        lines.push(message);
    }
    for [x, y] in [[16, 0], [0, 9], [u32::MAX, u32::MAX]] {
        let traced = look::trace(&Census::of(&good(Eye::Perspective)), &offer(), TracePixel { x, y });
        let message = sentence(&traced.expect_err("outside"), "a pixel outside");
        assert!(message.contains(&format!("{x},{y}")) && message.contains("15,8"), "{message}");
        lines.push(message);
    }
    look::trace(&Census::of(&good(Eye::Perspective)), &offer(), TracePixel { x: 15, y: 8 }).expect("the last pixel");
    kept("bad_views", &lines);
    eprintln!("bad views and pixels: {} refused", lines.len());
}

fn typed(words: &[&str]) -> command::Result<String> {
    let words: Vec<String> = words.iter().map(|word| word.to_string()).collect();
    let mut out = Vec::new();
    command::run(&chapters::all(), &words, &mut out)?;
    Ok(String::from_utf8(out).expect("text"))
}

#[test]
fn bad_command_lines() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("file");
    fs::write(&file, "in the way").expect("written");
    fs::create_dir(folder.path().join("folder.png")).expect("made");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let small = ["--size", "8x8", "-q", "-o"];
    let output = |name: &str| [["render", "cover"].as_slice(), &small, &[&path(name)]].concat().join("\u{1f}");
    let lines: Vec<(String, &[&str])> = vec![
        ("render pinhol".into(), &["pinhol", "05_pinhole", "list"]),
        ("render 99".into(), &["99", "from 1 to ", "list"]),
        ("plan covr".into(), &["covr", "the nearest is cover"]),
        ("trace 04_orthografic --pixel 1,1".into(), &["04_orthographic"]),
        ("rendr cover".into(), &["rendr", "render"]),
        ("nonsense".into(), &["nonsense", "--help"]),
        ("lst".into(), &["lst", "list"]),
        ("pinhol".into(), &["pinhol", "05_pinhole"]),
        ("render glas".into(), &["glas", "20_glass"]),
        ("render caustic".into(), &["caustic", "27_caustics"]),
        ("render xyzzy".into(), &["xyzzy", "none", "list"]),
        ("render model.obj".into(), &["model.obj", "no such file"]),
        ("render model.stl".into(), &["model.stl", ".glb", ".ron"]),
        ("cost scene.ron".into(), &["scene.ron", "takes a chapter"]),
        ("render".into(), &["CHAPTER", "--help"]),
        ("render cover --size wide".into(), &["wide", "--size", "960x540", "1080p", "50%"]),
        ("render cover --size 8x8 --width 8".into(), &["--size", "--width"]),
        ("render cover --width -5".into(), &["-5", "--width"]),
        ("render cover --samples 0".into(), &["0", "--samples", "4k"]),
        ("render 5 --size 8x8 --resume -n 4 -o -".into(), &["nothing to continue", "standard output"]),
        ("render 5 --verbose --quiet".into(), &["--verbose", "--quiet"]),
        ("completions tcsh".into(), &["tcsh", "bash", "fish"]),
        ("render cover --size 960x".into(), &["960x", "--size", "960x540"]),
        ("render cover --size -1x5".into(), &["-1x5", "--size"]),
        ("render cover --size 1.5x5".into(), &["1.5x5", "--size"]),
        ("render cover --size 0x5".into(), &["0 × 5", "resolution"]),
        ("render cover --size 99999999999x5".into(), &["99999999999x5", "--size"]),
        ("trace cover --pixel 5".into(), &["5", "--pixel", "48,27"]),
        ("trace cover --pixel a,b".into(), &["a,b", "--pixel"]),
        ("trace cover".into(), &["--pixel"]),
        ("trace cover --size 8x8 --pixel 8,8".into(), &["8,8", "7,7"]),
        ("render cover --threads 0".into(), &["0", "--threads", "1"]),
        ("render cover --threads -3".into(), &["-3", "--threads", "1"]),
        ("render cover --threads many".into(), &["many", "--threads", "1 to 1024"]),
        ("render cover --view colours --size 8x8".into(), &["colours", "raster"]),
        ("render cover --time 5".into(), &["5", "--time", "10s"]),
        ("render cover --time 0s".into(), &["0s", "--time", "above 0"]),
        ("render cover --time soon".into(), &["soon", "--time", "10s"]),
        ("render cover --write-every 1d".into(), &["1d", "--write-every", "10s"]),
        ("render 10 --error 0 --size 8x8".into(), &["error is 0", "above 0"]),
        ("render 10 --error 2 --size 8x8".into(), &["error is 2", "at most 1"]),
        ("render 10 --error little".into(), &["little", "--error", "above 0 and at most 1"]),
        ("render cover --layers normals".into(), &["normals", "position", "normal", "all"]),
        ("render 5 --resume --size 8x8".into(), &["nothing to continue", "--samples"]),
        ("render cover --layers all --size 8x8 -o picture.png".into(), &["picture.png", "layers", ".exr"]),
        ("render cover --stats --quiet".into(), &["--stats", "--quiet"]),
        ("render cover --sizes 8x8".into(), &["--sizes", "--size"]),
        ("report 18 --quick -o plot.svg".into(), &["--quick", "--output"]),
        ("report 18 --samples-axis".into(), &["--kept"]),
        ("report 18 --kept -o plot.png".into(), &["plot.png", ".svg"]),
        ("figure 17_points -o points".into(), &["points", ".svg"]),
        (output("picture.jpg"), &["picture.jpg", ".png", ".exr"]),
        (output("picture"), &["picture", ".png", ".exr"]),
        (output("file/picture.png"), &["cannot write", "file/picture.png", "file is a file"]),
        (output("file/below/picture.exr"), &["cannot write", "file/below/picture.exr", "file is a file"]),
        (output("folder.png"), &["cannot write", "folder.png", "folder of that name"]),
    ];
    let mut messages = Vec::new();
    for (line, expected) in &lines {
        let words: Vec<&str> = line.split([' ', '\u{1f}']).collect();
        let shown = words.join(" ").replace(&path(""), "FOLDER/");
        let error = typed(&words).err().unwrap_or_else(|| panic!("`{shown}` is not refused"));
        let message = match &error {
            command::Error::Clap(answer) => answer.to_string().trim_end().replace("\n\n", "\n").replace('\n', "\n    "),
            command::Error::Pinhole(error) => sentence(error, &shown),
            command::Error::CommandLine(_) | command::Error::Unfinished(_) => sentence(&error, &shown),
        };
        for word in *expected {
            assert!(message.contains(word), "`{shown}`: no {word} in: {message}");
        }
        let mut message = message.replace(&path(""), "FOLDER/");
        if let (command::Error::Pinhole(Error::Write { source, .. }), false) =
            (&error, shown.contains("folder.png") || message.contains("is a file"))
        {
            message = message.replace(&source.to_string(), "(what the system says)");
        }
        // What a new command or chapter changes is checked above and not kept.
        if !["render 99", "lst", "rendr cover"].contains(&shown.as_str()) {
            messages.push(format!("`{shown}`: {message}"));
        }
    }
    let left: Vec<String> = names_in(folder.path());
    assert_eq!(left, ["file", "folder.png"], "a refused command leaves nothing");
    assert!(names_in(&folder.path().join("folder.png")).is_empty());
    assert_eq!(fs::read_to_string(&file).expect("still there"), "in the way");
    kept("bad_command_lines", &messages);
    eprintln!("bad command lines: {} refused, nothing written", lines.len());
}

fn names_in(folder: &std::path::Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a readable folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A place that cannot be written to is found out before the picture is made, not after.
#[test]
fn a_bad_place_is_refused_before_the_render() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("file");
    fs::write(&file, "").expect("written");
    let place = file.join("picture.png").display().to_string();
    // The view is refused too, but only when the render begins.
    let error = typed(&["render", "cover", "-q", "--view", "nonsense", "-o", &place]).expect_err("refused");
    assert!(matches!(error, command::Error::Pinhole(Error::Write { .. })), "{error}");
    let good = folder.path().join("good.png").display().to_string();
    typed(&["render", "cover", "-q", "--view", "nonsense", "-o", &good]).expect_err("refused");
    assert_eq!(names_in(folder.path()), ["file"], "trying a place leaves nothing there");
}

/// A chapter that offers too few stages for its scene is told so, and no shape is missing from a picture without a word.
#[test]
fn shapes_that_no_stage_on_offer_intersects() {
    let mut scene = good(Eye::Perspective);
    let (matte, planar) = (Matte::default, Placement { scale: DVec3::new(1.0, 0.5, 1.0), ..Placement::default() });
    scene.spawn((Name::new("egg"), Sphere::default(), matte(), planar));
    scene.spawn((Name::new("lid"), Disk::default(), matte()));
    scene.spawn((Name::new("board"), Rectangle::default(), matte()));
    scene.spawn((Name::new("crate"), Cuboid::default(), matte()));
    let census = &Census::of(&scene);
    prepare(census, &offer()).map(|_| ()).expect("all can be hit");
    let mut refused = 0;
    for column in ["hit", "surface", "shadow hit"] {
        for (table, name) in [
            ("spheres", "sphere \"ball\""),
            ("planes", "plane \"floor\""),
            ("triangles", "triangle \"sail\""),
            ("ellipsoids", "sphere \"egg\""),
            ("disks", "disk \"lid\""),
            ("rectangles", "rectangle \"board\""),
            ("cuboids", "cuboid \"crate\""),
        ] {
            let mut fewer = offer();
            let before = fewer.len();
            fewer.retain(|stage| {
                let writes = stage.writes.iter().any(|written| written.name == column);
                !(writes && stage.tables.iter().any(|read| read.name == table))
            });
            // Shapes that have a box and are not made of triangles can be rasterised, too.
            let stages = if column == "hit" && !["planes", "triangles"].contains(&table) { 2 } else { 1 };
            assert_eq!(fewer.len() + stages, before, "{stages} stages of {column} read {table}");
            let told = prepare(census, &fewer).err().expect("refused").to_string();
            let start = format!("{name}: shape is in the table of {table}, but no stage on offer ");
            assert!(told.starts_with(&start) && told.contains("; offer "), "{column}: {told}");
            refused += 1;
        }
    }
    eprintln!("offers: {refused} that lack a stage for a shape refused");
}
