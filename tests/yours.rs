//! The program that a reader writes from the first page on: every step compiles, and shows what pinhole shows.

#[path = "yours/programs.rs"]
pub mod programs;

use pinhole_lab::yours::{Comparison, Expected, Program, picture_of_program, program_after, program_of, steps};
use programs::{Edit, MISTAKES, RIGHT, edited, found, found_of};

/// Chapters whose pictures have no noise, so that a mistake is told in a second; the bench `yours` tries all.
const QUICK: u32 = 13;

#[test]
fn every_state_shows_what_pinhole_shows() {
    for chapter in steps().into_iter().map(|step| step.number) {
        let program = program_after(chapter).expect("applies");
        let lines = program.lines().count();
        // Enough samples for what is asked below; the pictures of these three have the most noise.
        let samples = if [21, 23, 28].contains(&chapter) { 32 } else { 16 };
        let few = program.replace("SAMPLES: usize = 64;", &format!("SAMPLES: usize = {samples};"));
        let expected = Expected::with_samples(chapter, samples).expect("renders");
        let picture = picture_of_program(&few).expect("a picture");
        let mut comparison = expected.compare(&picture).expect("of its size");
        let into = expected.look_into(&program, &picture, &mut comparison, &mut || ()).expect("applies");
        let Comparison::Same { resolved } = comparison else { panic!("{chapter}: {comparison:?}") };
        assert_eq!(into, Program::Books);
        assert!(resolved < 0.2, "{chapter}: {resolved}");
        eprintln!("{chapter}: {lines} lines, the same; {:.1} % would be told", 100.0 * resolved);
    }
}

/// Depth of field and the weights of two strategies change the picture of their own step only.
#[test]
fn two_steps_may_be_left_out() {
    // The step of chapter 26 comes after chapter 25.
    for (chapter, steps) in [(25, &[&[23][..]][..]), (33, &[&[23], &[26], &[23, 26]])] {
        let expected = Expected::after(chapter).expect("renders");
        for left_out in steps {
            let program = program_of(|number| number <= chapter && !left_out.contains(&number)).expect("applies");
            let picture = picture_of_program(&program).expect("compiles, and writes a picture");
            let found = expected.compare(&picture).expect("of its size");
            assert!(matches!(found, Comparison::Same { .. }), "{chapter} without {left_out:?}: {found:?}");
        }
    }
}

#[test]
fn mistakes_are_told_and_right_programs_accepted() {
    let quick = |edits: &[Edit]| edits.iter().copied().filter(|edit| edit.0 <= QUICK).collect::<Vec<_>>();
    let mut tried = 0;
    for (edit, program, found) in found(&quick(&MISTAKES)) {
        let right = program_after(edit.0).expect("applies");
        assert!(found.names(&right, &program), "{edit:?}: {:?}, {:?}", found.comparison, found.program);
        tried += 1;
    }
    for (edit, _, found) in found(&quick(&RIGHT)) {
        assert!(!found.is_wrong(), "{edit:?} is right: {:?}", found.program);
    }
    eprintln!("mistakes in the reader's program: {tried}, each found in its line");
    assert!(tried >= 20);
}

/// The line is found, too, in a program that looks unlike the book's in many places that are right.
#[test]
fn a_mistake_is_found_among_much_that_is_right() {
    let unlike: [Edit; 6] = [
        (10, "(2.0 * x - WIDTH as f64) / HEIGHT as f64", "(x - WIDTH as f64 / 2.0) / (HEIGHT as f64 / 2.0)"),
        (
            10,
            "let back = EYE.sub(TARGET).unit();",
            "let ahead = TARGET.sub(EYE).unit();\n    let back = ahead.times(-1.0);",
        ),
        (10, "LAMPS {", "LAMPS.into_iter().rev() {"),
        (10, "to_lamp", "path_to_it"),
        (10, "half_b", "h"),
        (
            10,
            "    let light = light.clamp(0.0, 1.0);\n",
            "    // between black and white\n    let light = light.max(0.0).min(1.0);\n",
        ),
    ];
    let expected = Expected::after(10).expect("renders");
    let mut tried = 0;
    for mistake in MISTAKES.iter().filter(|edit| edit.0 == 10) {
        // The mistake in the reader's own words.
        let own = |text: &str| text.replace("to_lamp", "path_to_it").replace("half_b", "h");
        let right = edited(10, &unlike).expect("applies");
        // The last function but one stands first.
        let (before, byte) = right.split_once("/// The byte that").expect("it is there");
        let (byte, main) = byte.split_once("\n\n").expect("more behind it");
        let right = format!("/// The byte that{byte}\n\n{before}{main}");
        let (old, new) = (own(mistake.1), own(mistake.2));
        if !right.contains(&old) {
            continue;
        }
        let wrong = right.replace(&old, &new);
        let found = found_of(&expected, &wrong).expect("a picture");
        assert!(found.names(&right, &wrong), "{mistake:?}: {:?}", found.program);
        tried += 1;
    }
    eprintln!("mistakes in a program that looks unlike the book's: {tried}, each found in its line");
    assert!(tried >= 4);
}

/// Exercise 8 of page 10: a step off the surface that grows with the scene is right where a constant is not.
#[test]
fn a_step_that_grows_is_right_in_every_size() {
    const STEP: &str = "1e-9";
    const GROWS: &str = "1e-12 * (point.0.abs() + point.1.abs() + point.2.abs())";
    const BOUND: &str = "2.0 * f64::EPSILON * (point.0.abs() + point.1.abs() + point.2.abs())";
    let far = [
        ("centre: V(0.0", "centre: V(1e8"),
        ("EYE: V = V(2.5", "EYE: V = V(1e8 + 2.5"),
        ("TARGET: V = V(0.0", "TARGET: V = V(1e8"),
        ("(V(3.0", "(V(1e8 + 3.0"),
        ("(V(-4.0", "(V(1e8 - 4.0"),
    ];
    let small = [
        ("-3.0), radius: 1.0", "-3e-9), radius: 1e-9"),
        ("-101.0, -3.0), radius: 100.0", "-101e-9, -3e-9), radius: 100e-9"),
        ("V(2.5, 1.4, 1.4)", "V(2.5e-9, 1.4e-9, 1.4e-9)"),
        ("V(0.0, -0.3, -3.0)", "V(0.0, -0.3e-9, -3e-9)"),
        ("V(3.0, 4.0, 0.0)", "V(3e-9, 4e-9, 0.0)"),
        ("V(-4.0, 3.0, -1.0)", "V(-4e-9, 3e-9, -1e-9)"),
        ("V(60.0, 54.0, 45.0)", "V(60e-18, 54e-18, 45e-18)"),
        ("V(8.0, 14.0, 24.0)", "V(8e-18, 14e-18, 24e-18)"),
    ];
    let drawn = |edits: &[(&str, &str)], step: &str| {
        let program = program_after(10).expect("applies");
        let program = edits.iter().fold(program, |program, (old, new)| {
            assert!(program.contains(old), "{old}");
            program.replace(old, new)
        });
        assert!(program.contains(&format!("normal.times({STEP})")));
        picture_of_program(&program.replace(&format!("normal.times({STEP})"), &format!("normal.times({step})")))
            .expect("a picture")
            .1
    };
    let home = drawn(&[], STEP);
    let differ = |edits: &[(&str, &str)], step: &str| {
        let other = drawn(edits, step);
        let differ = home
            .iter()
            .zip(&other)
            .filter(|(one, other)| (0..3).any(|part| one[part].abs_diff(other[part]) > 8))
            .count();
        differ as f64 / home.len() as f64
    };
    for (edits, at_least) in [(&[][..], 0.0), (&far, 0.01), (&small, 0.2)] {
        assert!(differ(edits, STEP) >= at_least, "the constant step");
        assert!(differ(edits, GROWS) < 1e-3, "the step that grows");
    }
    assert!(differ(&[], BOUND) > 0.2, "the bound of a hit that is exact before it is rounded");
}

/// Of a picture alone, without the program, the known mistakes are said that make it.
#[test]
fn a_picture_alone_names_a_known_mistake() {
    let expected = Expected::after(5).expect("renders");
    let (mut tried, mut named) = (0, 0);
    for edit in MISTAKES.iter().filter(|edit| edit.0 == 5) {
        let program = edited(5, &[*edit]).expect("applies");
        let picture = picture_of_program(&program).expect("a picture");
        let mut found = expected.compare(&picture).expect("of its size");
        expected.look_for_known(&picture, &mut found, &mut || ()).expect("renders");
        assert!(!matches!(found, Comparison::Same { .. }), "{edit:?}");
        let is_named = !matches!(found, Comparison::Differs { looks_like: None, .. });
        (tried, named) = (tried + 1, named + usize::from(is_named));
        eprintln!("{:<45} {found:?}", edit.1);
    }
    eprintln!("pictures of mistakes, without the program: {tried}, named {named}");
    assert!(tried >= 10 && 10 * named >= 7 * tried);
}

/// What was written by another program than the one beside it is not explained by that one.
#[test]
fn a_picture_of_another_program_is_told() {
    let (expected, book) = (Expected::after(5).expect("renders"), program_after(5).expect("applies"));
    let dark = book.replace("INTENSITY * cosine", "0.5 * INTENSITY * cosine");
    let blue = book.replace("byte(r), byte(g), byte(b)", "byte(b), byte(g), byte(r)");
    let picture = picture_of_program(&dark).expect("a picture");
    for (program, told) in [
        (&book, "run it again"),
        (&blue, "another picture than this one"),
        (&"fn main() {".to_owned(), "cannot be compiled"),
    ] {
        let mut found = expected.compare(&picture).expect("of its size");
        let into = expected.look_into(program, &picture, &mut found, &mut || ()).expect("applies");
        assert!(matches!(&into, Program::Another(why) if why.contains(told)), "{told}: {into:?}");
    }
    let mut found = expected.compare(&picture).expect("of its size");
    let earlier = expected.look_into(&program_after(1).expect("applies"), &picture, &mut found, &mut || ());
    assert_eq!(earlier.expect("applies"), Program::Earlier(1));
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
