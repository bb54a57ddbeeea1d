//! Every figure of the book, drawn from the chapters as they are: well-formed, finite, stamped, and legible.
#![allow(missing_docs, reason = "a test")]

use std::sync::OnceLock;

use pinhole_cli::figures;
use pinhole_lab::figure::{
    Drawing, Figure, Grid, Subject, chosen_rays, draw, drawn_distance, overlap, with_few_samples,
};
use rayon::prelude::*;

/// All of them, drawn once for all tests.
fn drawings() -> &'static [(&'static str, Drawing)] {
    static DRAWINGS: OnceLock<Vec<(&str, Drawing)>> = OnceLock::new();
    DRAWINGS.get_or_init(|| {
        let chapters = chapters::all();
        let figures = figures::all();
        let drawn = |figure: &Figure| {
            let drawing = with_few_samples(1, || draw(&figures, &chapters, figure.name)).expect(figure.name);
            assert!(
                ["scene", "chapter"].iter().any(|word| drawing.text.contains(&format!("{word} {}", figure.chapter))),
                "{} names no scene",
                figure.name
            );
            assert!(drawing.labels.len() >= 3, "{}", figure.name);
            (figure.name, drawing)
        };
        figures.par_iter().map(drawn).collect()
    })
}

/// Reads tags and checks that each is closed by its own name.
fn assert_well_formed(name: &str, text: &str) {
    let mut open = Vec::new();
    for part in text.split('<').skip(1) {
        let (tag, after) = part.split_once('>').unwrap_or_else(|| panic!("{name}: a tag does not end: {part}"));
        assert!(!after.contains('>'), "{name}: a bare > after <{tag}>");
        assert_eq!(tag.matches('"').count() % 2, 0, "{name}: quotes of <{tag}>");
        let word = tag.split([' ', '/']).find(|word| !word.is_empty()).expect("a tag's name");
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(word), "{name}: </{word}> closes another tag");
        } else if !tag.ends_with('/') {
            open.push(word);
        }
    }
    assert!(open.is_empty(), "{name}: never closed: {open:?}");
    let bare =
        text.split('&').skip(1).find(|rest| !["amp;", "lt;", "gt;", "quot;"].iter().any(|e| rest.starts_with(e)));
    assert!(bare.is_none(), "{name}: a bare &");
}

#[test]
fn every_figure_is_well_formed_finite_and_stamped() {
    for (name, drawing) in drawings() {
        let text = &drawing.text;
        assert_well_formed(name, text);
        assert!(text.starts_with("<svg") && text.contains("viewBox=\"0 0 720 "), "{name}: no viewBox");
        assert!(text.contains(&format!("cargo run --release -- figure {name}<")), "{name}: its command is missing");
        let numbers = text.split(['"', ' ', ',']).filter(|word| ["NaN", "inf", "-inf"].contains(word)).count();
        assert_eq!(numbers, 0, "{name}: a number is not finite");
    }
}

#[test]
fn no_label_stands_on_another_or_leaves_the_drawing() {
    for (name, drawing) in drawings() {
        let height: f64 = drawing
            .text
            .split("viewBox=\"0 0 720 ")
            .nth(1)
            .and_then(|rest| rest.split('"').next()?.parse().ok())
            .expect(name);
        for (index, label) in drawing.labels.iter().enumerate() {
            let extent = label.extent();
            let inside = extent[0].x >= 0.0 && extent[0].y >= 0.0 && extent[1].x <= 720.0 && extent[1].y <= height;
            assert!(inside, "{name}: {} leaves the drawing: {extent:?}", label.text);
            for other in &drawing.labels[index + 1..] {
                assert!(!overlap(extent, other.extent()), "{name}: {} stands on {}", label.text, other.text);
            }
        }
    }
}

#[test]
fn the_rays_of_the_pinhole_pass_through_their_pixel_centres() {
    let chapters = chapters::all();
    let chapter = chapters.iter().find(|chapter| chapter.name == "05_pinhole").expect("the chapter");
    let subject = Subject::of(chapter, 12, 8).expect("its columns");
    let grid = Grid::of(&subject, drawn_distance(&subject));
    assert!(!chosen_rays(&subject).is_empty());
    for ray in &subject.rays {
        let centre = grid.centre(ray.pixel);
        let off = ray.direction.cross(centre - ray.origin).length() / centre.length();
        assert!(off < 1e-6, "the ray of pixel {:?} passes its centre by {off} rad", ray.pixel);
    }
}

#[test]
fn the_command_lists_draws_and_refuses() {
    let chapters = chapters::all();
    let run = |words: &[&str]| {
        let words: Vec<String> = words.iter().map(|word| word.to_string()).collect();
        let mut out = Vec::new();
        let done = pinhole_cli::command::run(&chapters, &words, &mut out);
        (done.map_err(|error| error.to_string()), String::from_utf8(out).expect("text"))
    };
    let (done, listed) = run(&["figure"]);
    assert!(done.is_ok() && listed.lines().count() == figures::all().len());
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("x.svg");
    let (done, told) = run(&["figure", "02_ray", "-o", &file.display().to_string()]);
    assert_eq!((done, told), (Ok(()), format!("wrote {}\n", file.display())));
    assert!(std::fs::read_to_string(&file).is_ok_and(|text| text.starts_with("<svg")));
    let (done, _) = run(&["figure", "05_pinhloe"]);
    assert!(done.is_err_and(|told| told.contains("the nearest is 05_pinhole")));
}

#[test]
fn a_camera_of_the_other_kind_is_refused_in_a_sentence() {
    let mut chapters = chapters::all();
    chapters.retain(|chapter| chapter.name != "05_pinhole");
    let other = chapters.iter_mut().find(|chapter| chapter.name == "04_orthographic").expect("the chapter");
    other.name = "05_pinhole";
    let refused = draw(&figures::all(), &chapters, "05_pinhole").err().expect("refused");
    let sentence = "the figure 05_pinhole needs a perspective camera, and the scene of 05_pinhole has none";
    assert_eq!(refused.to_string(), sentence);
}
