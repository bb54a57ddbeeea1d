//! What a film is shown as, what is read of it, and what is taken back, over HTTP: against closed forms and `compare`.

use super::{Viewing, ended, folder_with, program};
use pinhole_lab::measure::image_file::read_numbers;
use serde_json::{Value, json};
use std::fs;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A frame as a page is sent it.
struct Frame {
    head: Value,
    pixels: Vec<[u8; 4]>,
}

impl Viewing {
    /// The answer to an order that is carried out.
    fn done(&self, order: &Value) -> Value {
        let (status, said) = self.order(order);
        assert_eq!(status, 200, "{order}: {said}");
        serde_json::from_str(&said).expect("JSON")
    }

    fn last_frame(&self) -> Frame {
        let body = self.get("frame?after=0");
        let length = u32::from_le_bytes([body[0], body[1], body[2], body[3]]) as usize;
        let head = serde_json::from_slice(&body[4..4 + length]).expect("JSON");
        Frame { head, pixels: body[4 + length..].chunks_exact(4).map(|own| [own[0], own[1], own[2], own[3]]).collect() }
    }

    /// The frame of all changes so far that has all of its samples.
    fn settled(&self) -> Frame {
        let began = Instant::now();
        loop {
            let (sheet, frame) = (self.sheet(), self.last_frame());
            let head = &frame.head;
            let is_whole = head["samples"][0] == head["samples"][1] && head["size"] == sheet["size"];
            if is_whole && head["change"] == sheet["change"] {
                return frame;
            }
            assert!(began.elapsed() < Duration::from_secs(60), "no whole picture: {head}, {sheet}");
            sleep(Duration::from_millis(20));
        }
    }

    /// The light of the picture, line by line, from the EXR that is kept of it.
    fn light(&self) -> Vec<[f64; 3]> {
        let file = self.folder.path().join("kept.exr");
        fs::write(&file, self.get("picture.exr")).expect("written");
        read_numbers(&file).expect("an EXR").pixels
    }

    fn look(&self, look: &Value) -> Frame {
        self.done(&json!({ "look": look }));
        self.settled()
    }
}

const SIZE: [&str; 2] = ["--size", "32x18"];

/// The middle of a pixel of a picture of this size.
fn at([x, y]: [usize; 2], [width, height]: [usize; 2]) -> [f64; 2] {
    [(x as f64 + 0.5) / width as f64, (y as f64 + 0.5) / height as f64]
}

#[test]
fn exposure_and_curves_are_the_published_formulas_and_leave_the_exr_alone() {
    let viewing = Viewing::of("10", &SIZE);
    viewing.settled();
    let (light, exr) = (viewing.light(), viewing.get("picture.exr"));
    let srgb = |light: f64| if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    let curves: [(&str, &dyn Fn(f64) -> f64); 3] =
        [("none", &srgb), ("gamma", &|light| light.powf(1.0 / 2.2)), ("linear", &|light| light)];
    let mut compared = 0;
    for (name, curve) in curves {
        for stops in [-3.0, 0.0, 0.5, 4.0] {
            let frame = viewing.look(&json!({ "curve": name, "exposure": stops }));
            for (pixel, light) in frame.pixels.iter().zip(&light) {
                for part in 0..3 {
                    let wanted = 255.0 * curve((light[part] * f64::powf(2.0, stops)).clamp(0.0, 1.0));
                    assert!(
                        (f64::from(pixel[part]) - wanted).abs() < 0.5 + 1e-3,
                        "{name} {stops}: {pixel:?} {light:?}"
                    );
                    compared += 1;
                }
            }
            let png = image::load_from_memory(&viewing.get("picture.png")).expect("a PNG").into_rgba8();
            assert!(png.pixels().zip(&frame.pixels).all(|(own, shown)| own.0 == *shown), "a PNG is what is seen");
            assert_eq!(viewing.get("picture.exr"), exr, "{name} {stops}");
        }
    }
    // The other curves are those of the command line, which are held to their tables.
    let mut curves = 0;
    for own in viewing.sheet()["curves"].as_array().expect("curves") {
        let word = own.as_str().expect("a word");
        if ["scene", "none", "gamma", "linear"].contains(&word) {
            continue;
        }
        for (automatic, exposure) in [(false, "1.5"), (true, "auto-1")] {
            let stops = if automatic { -1.0 } else { 1.5 };
            let frame = viewing.look(&json!({ "curve": word, "exposure": stops, "automatic": automatic }));
            let words = ["render", "scene.ron", "--size", "32x18", "-q", "--exposure", exposure, "--tone-map", word];
            let drawn = ended(viewing.folder.path(), &[&words[..], &["-o", "toned.png"]].concat());
            assert!(drawn.status.success(), "{}", String::from_utf8_lossy(&drawn.stderr));
            let toned = image::open(viewing.folder.path().join("toned.png")).expect("a PNG").into_rgba8();
            assert!(toned.pixels().zip(&frame.pixels).all(|(own, shown)| own.0 == *shown), "{word} {exposure}");
            curves += 1;
        }
    }
    eprintln!("view: {compared} bytes are those of the formulas, {curves} pictures those of the command line");
}

#[test]
fn false_colour_shows_the_number_that_its_scale_says() {
    let viewing = Viewing::of("5", &SIZE);
    let table = String::from_utf8(viewing.get("viridis")).expect("text");
    let colour = |step: usize| -> [u8; 3] {
        [0, 2, 4].map(|part| u8::from_str_radix(&table[6 * step + part..6 * step + part + 2], 16).expect("hex"))
    };
    // Raster coordinates are known: the pixel's place and a half.
    viewing.done(&json!({ "column": "raster.x" }));
    let frame = viewing.look(&json!({ "range": [0.0, 32.0] }));
    assert_eq!(frame.head["scale"], json!({ "range": [0.0, 32.0], "numbers": [0.5, 31.5] }));
    for (place, pixel) in frame.pixels.iter().enumerate() {
        let wanted = colour((((place % 32) as f64 + 0.5) / 32.0 * 255.0).round() as usize);
        assert_eq!(pixel[..3], wanted, "{place}");
    }
    let automatic = viewing.look(&json!({})).head["scale"]["range"].clone();
    assert_eq!(automatic, json!([0.5, 31.5]), "of 576 numbers, the sixth from either end");

    // The picture's own numbers are those of its light.
    viewing.done(&json!({ "column": ".luminance" }));
    let frame = viewing.look(&json!({ "range": [0.0, 1.0] }));
    for (pixel, [r, g, b]) in frame.pixels.iter().zip(viewing.light()) {
        let step = 255.0 * (0.2126 * r + 0.7152 * g + 0.0722 * b).clamp(0.0, 1.0);
        let found = (0..256).any(|own| (own as f64 - step).abs() < 0.51 && pixel[..3] == colour(own));
        assert!(found, "{pixel:?} {step}");
    }

    // Every component of every column: what is painted is what the trace of that pixel says.
    let sheet = viewing.sheet();
    let (mut tried, mut negative) = (0, 0);
    for column in sheet["columns"].as_array().expect("columns") {
        let name = column["name"].as_str().expect("a name");
        for component in column["components"].as_array().expect("components") {
            let shown = format!("{name}.{}", component.as_str().expect("a name"));
            viewing.done(&json!({ "column": shown }));
            viewing.settled();
            let place = at([13, 7], [32, 18]);
            let traced = viewing.done(&json!({ "trace": place }));
            let written = traced["columns"].as_array().expect("columns").iter().rev();
            let own = written.clone().find(|own| own["column"] == name && own["bounce"] == 0);
            let row = own.and_then(|own| own["rows"][0].as_array().cloned()).unwrap_or_default();
            let value =
                row.iter().find(|part| part[0] == *component).and_then(|part| part[1].as_str().map(String::from));
            let (number, value) =
                (traced["reading"]["number"].as_f64(), value.and_then(|text| text.parse::<f64>().ok()));
            if let (Some(number), Some(value)) = (number, value) {
                assert!((number - value).abs() < 1e-5 * value.abs().max(1.0), "{shown}: {number}, traced {value}");
                tried += 1;
                negative += u32::from(value < 0.0);
            }
        }
    }
    assert!(tried > 20 && negative > 0, "{tried} numbers, {negative} of them below 0");
    eprintln!("view: {tried} components are painted as the trace has them, {negative} of them below 0");
}

/// Where a pixel's samples are nothing or L, with mean m, the variance of n samples is n m (L − m) / (n − 1).
const DISK: &str = "[(name: \"camera\", perspective_camera: (fov: 40), resolution: (width: 32, height: 18), \
    sampling: (samples: 16, filter: Box(radius: 0.5)), integrator: RayCasting), \
    (name: \"lamp\", sphere: (radius: 1), emissive: (radiance: (1, 2, 4)), placement: (position: (0, 0, -4)))]";

#[test]
fn a_pixels_mean_and_standard_error_are_those_of_its_samples() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("disk.ron"), DISK).expect("written");
    let mut command = program(folder.path());
    command.args(["view", "disk.ron"]);
    let viewing = Viewing::started(command, folder);
    viewing.settled();
    let light = viewing.light();
    let edge: Vec<usize> = (0..light.len()).filter(|&own| light[own][0] > 0.0 && light[own][0] < 1.0).collect();
    assert!(edge.len() > 8, "{} pixels at the edge", edge.len());
    let read = |own: &[usize]| {
        let places: Vec<[f64; 2]> = own.iter().map(|own| at([own % 32, own / 32], [32, 18])).collect();
        viewing.done(&json!({ "pin": places })).as_array().expect("pins").clone()
    };
    let mut compared = 0;
    for some in edge.chunks(8) {
        for (pinned, &own) in read(some).iter().zip(some) {
            let reading = &pinned["reading"];
            assert_eq!((&reading["samples"], &reading["pixel"]), (&json!(16), &json!([own % 32, own / 32])));
            for (part, most) in [1.0, 2.0, 4.0].into_iter().enumerate() {
                let (mean, error) = (&reading["mean"][part], &reading["error"][part]);
                let mean = mean.as_f64().expect("a mean");
                assert!((mean - light[own][part]).abs() < 1e-6, "{reading}");
                let wanted = (mean * (most - mean) / 15.0).sqrt();
                assert!((error.as_f64().expect("an error") - wanted).abs() < 1e-6, "{reading}: not {wanted}");
                compared += 1;
            }
        }
    }
    let hit = read(&[9 * 32 + 16, 0]);
    assert_eq!((&hit[0]["entity"], &hit[1]["entity"]), (&json!("lamp"), &Value::Null));
    assert_eq!(hit[0]["reading"]["error"], json!([0.0, 0.0, 0.0]));
    // The same numbers come with every frame, after that of the pointer.
    let again = viewing.look(&json!({ "exposure": 1.0 })).head["pixels"].clone();
    assert_eq!((&again[1], &again[2]), (&hit[0]["reading"], &hit[1]["reading"]));
    eprintln!("view: {compared} standard errors at the edge of a disk are those of the closed form");
}

#[test]
fn a_reference_is_compared_as_the_command_compares() {
    let viewing = Viewing::of("10", &SIZE);
    viewing.settled();
    let (light, path) = (viewing.light(), viewing.folder.path());
    fs::rename(path.join("kept.exr"), path.join("first.exr")).expect("renamed");
    assert_eq!(viewing.order(&json!({ "look": { "compare": "reference" } })).0, 422, "there is none yet");
    viewing.done(&json!({ "reference": true }));
    assert_eq!(viewing.settled().head["rel_mse"], 0.0);
    let first = viewing.last_frame().pixels;
    viewing.done(&json!({ "orbit": [0.1, 0.05] }));
    let moved = viewing.settled();
    let other = viewing.light();
    let told = ended(path, &["compare", "first.exr", "kept.exr", "--json"]);
    let told: Value = serde_json::from_slice(&told.stdout).expect("JSON");
    let (own, wanted) = (moved.head["rel_mse"].as_f64().expect("one"), told["rel_mse"].as_f64().expect("one"));
    assert!(wanted > 1e-3 && (own / wanted - 1.0).abs() < 1e-4, "{own}, and `compare` says {wanted}");
    assert!(viewing.look(&json!({ "compare": "reference" })).pixels == first, "the reference as it was seen");
    assert!(viewing.look(&json!({ "compare": "render" })).pixels == moved.pixels);
    let apart = viewing.look(&json!({ "compare": "difference", "curve": "linear" }));
    for ((pixel, x), r) in apart.pixels.iter().zip(&other).zip(&light) {
        let wanted = [0, 1, 2].map(|part| 255.0 * (x[part] - r[part]).abs().min(1.0));
        assert!((0..3).all(|part| (f64::from(pixel[part]) - wanted[part]).abs() < 0.51), "{pixel:?} {wanted:?}");
    }
    viewing.done(&json!({ "column": "ndc" }));
    assert_eq!(viewing.order(&json!({ "reference": true })).0, 422, "a column is no picture");
    viewing.done(&json!({ "reference": false }));
    assert_eq!(
        (viewing.sheet()["reference"].clone(), viewing.settled().head["rel_mse"].clone()),
        (Value::Null, Value::Null)
    );

    // The same from a file; a PNG is light again, as exactly as 8 bits can be.
    let folder = folder_with("10");
    fs::write(folder.path().join("a.exr"), fs::read(path.join("first.exr")).expect("read")).expect("written");
    let drawn = ended(folder.path(), &["render", "scene.ron", "--size", "32x18", "-q", "-o", "a.png"]);
    assert!(drawn.status.success(), "{}", String::from_utf8_lossy(&drawn.stderr));
    for (file, most) in [("a.exr", 0.0), ("a.png", 1e-3)] {
        let mut command = program(folder.path());
        command.args(["view", "scene.ron", "--size", "32x18", "--reference", file, "--threads", "1"]);
        let viewing = Viewing::started(command, tempfile::tempdir().expect("a temporary folder"));
        let error = viewing.settled().head["rel_mse"].as_f64().expect("one");
        assert!(error <= most, "{file}: {error}");
        assert_eq!(viewing.sheet()["reference"], file);
    }
    for (words, said) in [
        (&["--reference", "a.exr"][..], "only pictures of one size"),
        (&["--reference", "none.exr", "--size", "32x18"], "none.exr"),
        (&["--reference", "scene.ron"], "must end in .png or .exr"),
        (&["--threads", "0"], "0"),
    ] {
        let done = ended(folder.path(), &[&["view", "scene.ron"], words].concat());
        let told = String::from_utf8_lossy(&done.stderr);
        assert!(!done.status.success() && told.contains(said), "{words:?}: {told}");
    }
}

#[test]
fn movements_and_edits_are_taken_back_and_done_again() {
    let viewing = Viewing::of("5", &SIZE);
    let first = viewing.settled().pixels;
    let text = viewing.text();
    viewing.done(&json!({ "orbit": [0.2, 0.1] }));
    viewing.done(&json!({ "orbit": [0.1, 0.0] }));
    let (moved, camera) = (viewing.settled().pixels, viewing.sheet()["camera"].clone());
    assert!(moved != first && camera.is_object());
    let edited = text.replacen("radius: ", "radius: 2", 1);
    viewing.done(&json!({ "apply": edited }));
    let wider = viewing.settled().pixels;
    assert_eq!(viewing.sheet()["undo"], json!([2, 0]), "a drag is one step");
    viewing.done(&json!("undo"));
    assert!(viewing.settled().pixels == moved && viewing.text() == text);
    viewing.done(&json!("undo"));
    assert!(viewing.settled().pixels == first && viewing.sheet()["camera"].is_null());
    viewing.done(&json!("undo"));
    assert_eq!(viewing.sheet()["undo"], json!([0, 2]), "there is nothing more to be taken back");
    viewing.done(&json!("redo"));
    viewing.done(&json!("redo"));
    assert!(viewing.settled().pixels == wider && viewing.text() == edited && viewing.sheet()["camera"] == camera);
    // A camera that an address carries is seen from the same place.
    viewing.done(&json!("undo"));
    viewing.done(&json!("reset"));
    assert!(viewing.settled().pixels == first);
    viewing.done(&json!({ "camera": camera }));
    assert!(viewing.settled().pixels == moved);
}

#[test]
fn a_pause_and_a_region_hold_samples_back_and_the_page_may_ask_for_a_size() {
    let viewing = Viewing::of("25", &["--size", "96x54"]);
    let text = viewing.text();
    let start = text.find("samples: ").expect("samples") + 9;
    let end = start + text[start..].find(|letter: char| !letter.is_ascii_digit()).expect("their end");
    viewing.done(&json!("sheet"));
    viewing.done(&json!({ "pause": true }));
    viewing.done(&json!({ "apply": format!("{}1000000{}", &text[..start], &text[end..]) }));
    let taken = || viewing.last_frame().head["samples"][0].as_u64().expect("a number");
    let waited = |least: u64| {
        let began = Instant::now();
        while viewing.last_frame().head["samples"][1] != 1_000_000 || taken() < least {
            assert!(began.elapsed() < Duration::from_secs(60), "{}", viewing.last_frame().head);
            sleep(Duration::from_millis(20));
        }
    };
    waited(1);
    let before = taken();
    sleep(Duration::from_millis(500));
    assert_eq!((before, taken()), (1, 1), "a pause shows the first sample of what changes, and takes no other");
    viewing.done(&json!({ "region": [0.0, 0.0, 0.3, 0.5] }));
    viewing.done(&json!({ "pause": false }));
    waited(5);
    viewing.done(&json!({ "pause": true }));
    // Tiles have 32 pixels a side at most, so these two are not of one.
    let samples = || {
        let pinned = viewing.done(&json!({ "pin": [[0.05, 0.05], [0.9, 0.9]] }));
        [0, 1].map(|own| pinned[own]["reading"]["samples"].as_u64().expect("a number"))
    };
    let [inside, outside] = samples();
    assert!(inside >= 5 && outside == 1, "{inside} samples inside, {outside} outside");
    viewing.done(&json!({ "region": null }));
    viewing.done(&json!({ "pause": false }));
    waited(inside + 2);
    let [inside, outside] = samples();
    assert!(inside.abs_diff(outside) <= 1, "everywhere again: {inside} and {outside}");

    viewing.done(&json!({ "size": [40, 30] }));
    assert_eq!(viewing.sheet()["size"], json!([40, 30]));
    waited(1);
    viewing.done(&json!({ "size": null }));
    assert_eq!(viewing.sheet()["size"], json!([96, 54]));
}

#[test]
fn bad_values_are_refused_in_one_sentence() {
    let viewing = Viewing::of("5", &SIZE);
    let first = viewing.settled().pixels;
    let malformed = [
        json!({ "look": { "exposure": 33 } }),
        json!({ "look": { "exposure": "bright" } }),
        json!({ "look": { "curve": "cubic" } }),
        json!({ "look": { "range": [1, 1] } }),
        json!({ "look": { "range": [2, 1] } }),
        json!({ "look": { "range": [0, 1e300] } }),
        json!({ "look": { "compare": "nothing" } }),
        json!({ "look": { "gain": 2 } }),
        json!({ "region": [0.5, 0, 0.5, 1] }),
        json!({ "region": [0, 0, 2, 1] }),
        json!({ "region": [0, 0] }),
        json!({ "size": [0, 10] }),
        json!({ "size": [8193, 10] }),
        json!({ "size": [-1, 10] }),
        json!({ "camera": { "eye": [0, 0, 0] } }),
        json!({ "camera": { "eye": [0, 0, null], "target": [0, 0, 0], "up": [0, 1, 0], "height": 1 } }),
        json!({ "pin": [[0.5]] }),
        json!({ "pause": 1 }),
        json!({ "reference": "a.exr" }),
        json!("again"),
    ];
    let refused = [
        json!({ "column": ".lightness" }),
        json!({ "column": "ndc.q" }),
        json!({ "column": "none.x" }),
        json!({ "look": { "compare": "difference" } }),
        json!({ "camera": { "eye": [0, 0, 0], "target": [0, 0, 0], "up": [0, 1, 0], "height": 1 } }),
        json!({ "camera": { "eye": [0, 1, 0], "target": [0, 0, 0], "up": [0, 1, 0], "height": 1 } }),
        json!({ "camera": { "eye": [1e200, 0, 0], "target": [0, 0, 0], "up": [0, 1, 0], "height": 1 } }),
        json!({ "pin": vec![[0.5, 0.5]; 9] }),
    ];
    let all = malformed.iter().map(|order| (order, 400)).chain(refused.iter().map(|order| (order, 422)));
    let mut tried = 0;
    for (order, status) in all {
        let (told, said) = viewing.order(order);
        assert_eq!(told, status, "{order}: {said}");
        assert!(said.lines().count() == 1 && said.len() > 20 && said.len() < 500, "{order}: {said}");
        tried += 1;
    }
    viewing.done(&json!({ "region": null }));
    assert!(viewing.settled().pixels == first, "nothing of it was done");
    eprintln!("view: {tried} bad orders were refused in a sentence");
}
