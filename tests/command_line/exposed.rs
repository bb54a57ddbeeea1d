//! Exposure, tone mapping and the depth of a PNG as they are typed.

use super::{names, run, text};
use std::fs;
use std::path::Path;

const SIZE: [&str; 4] = ["render", "5", "--size", "32x18"];

/// Renders, and reads a file that it has written.
fn bytes(folder: &Path, words: &[&str], file: &str) -> Vec<u8> {
    let told = run(folder, &[&SIZE[..], &["-q"], words].concat());
    assert!(told.status.success(), "{words:?}: {}", text(&told.stderr));
    fs::read(folder.join(file)).expect("written")
}

/// What a PNG says under each of its keywords.
fn said(folder: &Path, file: &str) -> Vec<(String, String)> {
    let file = std::io::BufReader::new(fs::File::open(folder.join(file)).expect("written"));
    let mut read = png::Decoder::new(file).read_info().expect("a PNG");
    let pixels = read.output_buffer_size().expect("of a size");
    read.next_frame(&mut vec![0; pixels]).expect("decoded");
    let latin = read.info().uncompressed_latin1_text.iter().map(|own| (own.keyword.clone(), own.text.clone()));
    latin.collect()
}

fn pixels(png: &[u8]) -> Vec<u8> {
    image::load_from_memory(png).expect("a PNG").into_rgb8().into_raw()
}

#[test]
fn an_exposure_changes_the_png_and_never_the_exr_or_the_checkpoint() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    let both = ["-n", "4", "-o", "a.exr", "-o", "a.png"];
    let exr = bytes(path, &both, "a.exr");
    let plain = pixels(&fs::read(path.join("a.png")).expect("written"));
    let mut seen = vec![plain.clone()];
    for more in [
        &["--exposure", "2"][..],
        &["--exposure", "-1.5"],
        &["--exposure", "auto"],
        &["--exposure", "auto-1"],
        &["--tone-map", "reinhard"],
        &["--tone-map", "aces"],
        &["--tone-map", "pbr-neutral"],
        &["--tone-map", "agx", "--exposure", "1"],
    ] {
        assert!(bytes(path, &[&both[..], more].concat(), "a.exr") == exr, "{more:?} changed an EXR");
        let png = pixels(&fs::read(path.join("a.png")).expect("written"));
        assert!(!seen.contains(&png), "{more:?} has no picture of its own");
        seen.push(png);
    }
    for same in [&["--exposure", "0"][..], &["--tone-map", "none"]] {
        assert!(pixels(&bytes(path, &[&both[..], same].concat(), "a.png")) == plain, "{same:?}");
    }
    // A checkpoint of one exposure serves another.
    let kept = ["--write-every", "1ms", "-o", "b.png"];
    bytes(path, &[&["-n", "4", "--exposure", "3"], &kept[..]].concat(), "b.png");
    let words = [&SIZE[..], &["-n", "9", "--exposure", "-1", "--resume"], &kept].concat();
    let told = run(path, &words);
    assert!(text(&told.stderr).contains("continuing from b.checkpoint, 4 samples"), "{}", text(&told.stderr));
    let resumed = fs::read(path.join("b.png")).expect("written");
    let at_once = bytes(path, &["-n", "9", "--exposure", "-1", "-o", "c.png"], "c.png");
    assert!(resumed == at_once, "the same file, resumed or not");
    eprintln!("exposed: {} pictures of one EXR, and one continued by another exposure", seen.len());
}

#[test]
fn a_scene_file_has_both_and_the_command_line_has_the_last_word() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    let scene = text(&run(path, &["export", "5"]).stdout);
    let with = |words: &str| {
        let file = scene.replace("integrator: RayCasting,", &format!("integrator: RayCasting, {words},"));
        fs::write(path.join("s.ron"), file).expect("written");
    };
    let render = |more: &[&str]| {
        let told = run(path, &[&["render", "s.ron", "--size", "32x18", "-q", "-o", "s.png"], more].concat());
        assert!(told.status.success(), "{more:?}: {}", text(&told.stderr));
        pixels(&fs::read(path.join("s.png")).expect("written"))
    };
    let mut tried = 0;
    for (words, more) in [
        ("exposure: (stops: 2)", &["--exposure", "2"][..]),
        ("exposure: (automatic: true)", &["--exposure", "auto"]),
        ("tone_mapping: Agx", &["--tone-map", "agx"]),
        ("tone_mapping: Reinhard()", &["--tone-map", "reinhard"]),
        ("exposure: (stops: -1), tone_mapping: Aces", &["--exposure", "-1", "--tone-map", "aces"]),
    ] {
        with(words);
        let from_file = render(&[]);
        let plain = render(&["--exposure", "0", "--tone-map", "none"]);
        assert!(from_file != plain, "{words}");
        let told = run(path, &["export", "s.ron", "-o", "again.ron"]);
        assert!(told.status.success(), "{}", text(&told.stderr));
        fs::rename(path.join("again.ron"), path.join("s.ron")).expect("renamed");
        assert!(render(&[]) == from_file, "{words} does not survive an export");
        with("exposure: (stops: 7), tone_mapping: PbrNeutral");
        let last = match more {
            ["--exposure", _] => [&["--tone-map", "none"], more].concat(),
            [_, _] => [&["--exposure", "0"], more].concat(),
            _ => more.to_vec(),
        };
        assert!(render(&last) == from_file, "{last:?} over another exposure");
        tried += 1;
    }
    with("exposure: (stops: 1)");
    let set = render(&["--set", "camera.exposure.stops=2"]);
    with("exposure: (stops: 2)");
    assert!(set == render(&[]));
    eprintln!("scene files: {tried} cameras, each as its options");
}

#[test]
fn a_png_of_16_bits_says_how_it_was_made_and_nothing_of_when_or_where_to() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    let asked = ["--bits", "16", "-n", "3", "--seed", "7", "--tone-map", "agx"];
    let first = bytes(path, &[&asked[..], &["-o", "a.png", "-j", "1"]].concat(), "a.png");
    assert_eq!(image::load_from_memory(&first).expect("a PNG").color(), image::ColorType::Rgb16);
    for (file, threads) in [("b.png", "1"), ("c.png", "3"), ("d.png", "2")] {
        assert!(bytes(path, &[&asked[..], &["-o", file, "-j", threads]].concat(), file) == first, "{file}");
    }
    let expected = [
        ("Software", "pinhole"),
        ("Scene", "05_pinhole"),
        ("Command", "pinhole render 05_pinhole --size 32x18 --samples 3 --seed 7 --tone-map agx"),
        ("Seed", "7"),
        ("Samples", "3"),
    ];
    let told = said(path, "a.png");
    let told: Vec<(&str, &str)> = told.iter().map(|(keyword, text)| (keyword.as_str(), text.as_str())).collect();
    assert_eq!(told, expected);
    let again: Vec<&str> = told[2].1.split(' ').skip(1).collect();
    let told = run(path, &[&again[..], &["--bits", "16", "-q", "-o", "e.png"]].concat());
    assert!(told.status.success(), "{}", text(&told.stderr));
    assert!(fs::read(path.join("e.png")).expect("written") == first, "the command that it names makes it again");
    // A ray through each pixel's centre has no seed and no number of samples.
    bytes(path, &["-o", "f.png"], "f.png");
    let keywords: Vec<String> = said(path, "f.png").into_iter().map(|(keyword, _)| keyword).collect();
    assert_eq!(keywords, ["Software", "Scene", "Command"]);
    eprintln!("provenance: 5 files of one picture, the same bytes; {}", names(path).join(", "));
}

#[test]
fn an_exposure_that_is_none_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut tried = 0;
    for (more, words) in [
        (&["--exposure", "bright"][..], "a number of stops"),
        (&["--exposure", "auto1"], "a number of stops"),
        (&["--exposure", "NaN"], "exposure stops is NaN, but it must be a number from -128 to 128"),
        (&["--exposure", "inf"], "exposure stops is inf"),
        (&["--exposure", "-129"], "exposure stops is -129"),
        (&["--tone-map", "filmic"], "a tone mapping is one of none, reinhard, aces, pbr-neutral, agx"),
        (&["--bits", "12"], "a PNG has 8 bits or 16"),
        (&["--bits", "16", "-o", "a.exr"], "no PNG is written"),
    ] {
        let told = run(folder.path(), &[&SIZE[..], more].concat());
        let noted = text(&told.stderr);
        assert!(!told.status.success() && noted.contains(words), "{more:?}: {noted}");
        tried += 1;
    }
    assert!(names(folder.path()).iter().all(|name| name == "out"), "{:?}", names(folder.path()));
    eprintln!("refused: {tried} options, a sentence each");
}

/// What is said of a picture's light is said of it as it is exposed.
#[test]
fn warnings_know_the_exposure() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    let scene = text(&run(path, &["export", "5"]).stdout);
    let lit = |intensity: &str| {
        let file = scene.replace("(95.0, 95.0, 95.0)", intensity);
        assert_ne!(file, scene);
        fs::write(path.join("s.ron"), file.replace("(0.008, 0.012, 0.02)", "(0, 0, 0)")).expect("written");
    };
    let said = |more: &[&str]| {
        let told = run(path, &[&["render", "s.ron", "--size", "64x36", "-o", "s.png"], more].concat());
        assert!(told.status.success(), "{}", text(&told.stderr));
        text(&told.stderr)
    };
    lit("(0.001, 0.001, 0.001)");
    for dark in [&[][..], &["--exposure", "3"]] {
        assert!(said(dark).contains("black"), "{dark:?}: {}", said(dark));
    }
    for brighter in ["16", "auto"] {
        assert!(!said(&["--exposure", brighter]).contains("black"), "{}", said(&["--exposure", brighter]));
    }
    lit("(90000, 90000, 90000)");
    assert!(said(&[]).contains("a PNG clips"), "{}", said(&[]));
    for more in [&["--exposure", "-12"][..], &["--exposure", "auto"], &["--tone-map", "reinhard"]] {
        assert!(!said(more).contains("clips"), "{more:?}: {}", said(more));
    }
    eprintln!("warnings: a dark and a bright scene, right with each exposure");
}
