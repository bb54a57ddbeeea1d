//! The program that a reader writes from the first page on: every step compiles, and shows what pinhole shows.

#[path = "yours/programs.rs"]
pub mod programs;

use pinhole_lab::yours::{Comparison, Expected, picture_of_program, program_after, program_of, steps};
use programs::{Edit, MISTAKES, NOT_NAMED, RIGHT, found, said};

/// Chapters whose pictures have no noise, so that a mistake is told in a second; the bench `yours` tries all.
const QUICK: u32 = 13;

#[test]
fn every_state_shows_what_pinhole_shows() {
    let untouched: Vec<Edit> = steps().iter().map(|step| (step.number, "fn main", "fn main")).collect();
    for ((chapter, ..), found) in found(&untouched) {
        let lines = program_after(chapter).expect("applies").lines().count();
        let Comparison::Same { resolved } = found else { panic!("{chapter}: {found:?}") };
        assert!(resolved < 0.2, "{chapter}: {resolved}");
        eprintln!("{chapter}: {lines} lines, the same; {:.1} % would be told", 100.0 * resolved);
    }
}

/// Depth of field and the weights of two strategies change the picture of their own step only.
#[test]
fn two_steps_may_be_left_out() {
    for chapter in [25, 33] {
        let expected = Expected::after(chapter).expect("renders");
        for left_out in [&[23][..], &[26], &[23, 26]] {
            let program = program_of(|number| number <= chapter && !left_out.contains(&number)).expect("applies");
            let picture = picture_of_program(&program).expect("compiles, and writes a picture");
            let found = expected.compare(&picture, &mut || ()).expect("of its size");
            assert!(matches!(found, Comparison::Same { .. }), "{chapter} without {left_out:?}: {found:?}");
        }
    }
}

#[test]
fn mistakes_are_told_and_right_programs_accepted() {
    let quick = |edits: &[Edit]| edits.iter().copied().filter(|edit| edit.0 <= QUICK).collect::<Vec<_>>();
    let (mut tried, mut named) = (0, 0);
    for (edit, found) in found(&quick(&MISTAKES)) {
        let Some(said) = said(&found) else { panic!("{edit:?} is not told") };
        tried += 1;
        named += usize::from(said != NOT_NAMED);
    }
    for (edit, found) in found(&quick(&RIGHT)) {
        assert_eq!(said(&found), None, "{edit:?} is right");
    }
    eprintln!("mistakes in the reader's program: {tried} told, {named} of them named");
    assert!(tried >= 20 && 10 * named >= 7 * tried);
}

#[test]
fn what_is_no_picture_of_the_program_is_refused_in_one_sentence() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("picture.ppm");
    let odd = [
        ("", "does not begin with P3"),
        ("P6 1 1 255 abc", "does not begin with P3"),
        ("P3 2 2 255 1 2 3", "three numbers for each pixel"),
        ("P3 1 1 65535 1 2 3", "width, height, 255"),
        ("P3 18446744073709551615 3 255 1 2 3", "three numbers for each pixel"),
        ("P3 1 1 255 1 2 -3", "must be whole numbers"),
        ("P3 1 1 255 1 2 300", "above 255"),
        ("P3 1 1 255 1 2 3", "1 × 1 pixels, and pinhole's has 480 × 270"),
    ];
    for (text, told) in odd {
        std::fs::write(&file, text).expect("written");
        let words = ["yours", "5", file.to_str().expect("UTF-8")].map(String::from);
        let ended = pinhole_cli::command::run(&chapters::all(), &words, &mut Vec::new()).expect_err(text).to_string();
        assert!(ended.contains(told) && ended.lines().count() == 1, "{text}: {ended}");
    }
    eprintln!("pictures that are none: {} refused", odd.len());
}
