//! What readers write: every stub fails, every solution passes, every typical mistake is called by its name.

use answers::Answers;
use listed::chapter_01_image::check::exercise as image;
use listed::chapter_05_pinhole::check::exercise as pinhole;
use listed::chapter_12_how_it_is_built::check::exercise as plan;
use pinhole_lab::exercise::{Exercise, Outcome, PATIENCE, Progress, Report, list_exercises, take_turn};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;
use wrong_answers::Fresh;

#[path = "exercises/answers.rs"]
mod answers;

#[path = "exercises/folders.rs"]
mod folders;

#[path = "exercises/mine.rs"]
mod mine;

#[path = "exercises/shown.rs"]
mod shown;

#[path = "bench/wrong_answers/mod.rs"]
mod wrong_answers;

/// What chapters ask their readers to write, as the program has it.
mod listed {
    include!(concat!(env!("OUT_DIR"), "/exercises.rs"));
}

/// The line that a stub has and a reader's own function has not.
const MARKER: &str = "// Yours to write:";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn stub(chapter: &str) -> String {
    fs::read_to_string(root().join("chapters").join(chapter).join("exercise.rs")).expect("a chapter's exercise")
}

/// Whether a chapter's exercise is still as it was handed out; in CI it must be.
fn untouched(chapter: &str) -> bool {
    let untouched = stub(chapter).contains(MARKER);
    assert!(untouched || std::env::var_os("CI").is_none(), "chapters/{chapter}/exercise.rs is no stub any more");
    if !untouched {
        eprintln!("chapters/{chapter}/exercise.rs is the reader's own now; it is not asked to fail");
    }
    untouched
}

/// What a reader would see of a report, all hints among it.
fn told(report: &Report) -> String {
    let mut out = Vec::new();
    report.print(9, &mut out).expect("printed");
    String::from_utf8(out).expect("UTF-8")
}

/// One turn: what it printed, and the sentence it ended with.
fn turn(exercise: &Exercise, file: &Path) -> (String, Option<String>) {
    let mut out = Vec::new();
    let ended = take_turn("05_pinhole", exercise, file, &mut out).err().map(|error| error.to_string());
    (String::from_utf8(out).expect("UTF-8"), ended)
}

fn hints(said: &str) -> usize {
    said.lines().filter(|line| line.starts_with("hint ")).count()
}

fn right() -> Exercise {
    pinhole(answers::chapter_05_pinhole::answers::solution)
}

/// A mistake that nobody foresaw.
fn wrong() -> Exercise {
    pinhole(|[x, y], tangent| [x * tangent + 0.125, y - tangent, -2.0])
}

/// One that is known by its name.
fn known() -> Exercise {
    pinhole(|[x, y], _| [x, y, -1.0])
}

#[test]
fn every_solution_is_right() {
    let mut inputs = 0;
    for (chapter, answers) in answers::ALL {
        let report = answers().solution.check(PATIENCE);
        assert!(matches!(report.outcome, Outcome::Right(_)), "{chapter}: {}", told(&report));
        inputs += report.inputs;
        eprintln!("{chapter}: {}", told(&report).lines().nth(1).unwrap_or_default());
    }
    eprintln!("solutions: {} right for {inputs} inputs", answers::ALL.len());
}

#[test]
fn every_stub_is_wrong() {
    let (mut stubs, mut asking) = (0, 0);
    for (chapter, exercise) in listed::all() {
        asking += 1;
        if untouched(chapter) {
            let report = exercise.check(PATIENCE);
            assert!(report.is_stub(), "{chapter}: {}", told(&report));
            stubs += 1;
        }
    }
    assert_eq!(asking, answers::ALL.len(), "chapters that ask for a function");
    eprintln!("stubs: {stubs} wrong, of {asking} exercises");
}

#[test]
fn chapters_stubs_and_solutions_agree() {
    for ((name, answers), (chapter, exercise)) in answers::ALL.iter().zip(listed::all()) {
        let solution = answers().solution;
        assert!(chapters::all().iter().any(|known| known.name == chapter), "{chapter} is no chapter");
        assert_eq!((*name, solution.function), (chapter, exercise.function));
        let signature = format!("pub fn {}(", exercise.function);
        assert!(stub(name).contains(&signature), "no {signature} in chapters/{name}/exercise.rs");
        let report = solution.check(PATIENCE);
        assert_eq!(report.function, exercise.function);
        assert!(report.hints.len() >= 3, "{name}: only {} hints", report.hints.len());
        let (file, word) = report.pinhole_has;
        let source = fs::read_to_string(root().join(file)).unwrap_or_else(|_| panic!("{name}: there is no {file}"));
        assert!(source.contains(word), "{name}: no {word} in {file}");
    }
}

/// The last step is the reader's own: no hint is a formula with all of its parts.
#[test]
fn no_hint_is_the_solution() {
    for (chapter, answers) in answers::ALL {
        let report = answers().solution.check(PATIENCE);
        let last = report.hints.last().expect("hints");
        let signs = last.chars().filter(|sign| "=+−*/·√²^<>≤".contains(*sign)).count();
        assert!(signs <= 1, "{chapter}: \"{last}\"");
    }
}

/// One of the wrong answers of a chapter for each kind of mistake; where the answer has parts, one needs two mistakes.
#[test]
fn every_wrong_answer_is_called_by_its_name() {
    let (mut made, mut unnamed) = (0, Vec::new());
    for (chapter, answers) in answers::ALL {
        let mut said: Vec<String> = Vec::new();
        for (at, (answer, words)) in answers().wrong.iter().enumerate() {
            made += 1;
            let report = answer.check(PATIENCE);
            let looks_like = remark(&report);
            if words.is_empty() || !looks_like.contains(words) {
                unnamed.push(format!("{chapter}, answer {at}, \"{words}\": {looks_like}\n{}", told(&report)));
            }
            said.push(looks_like.into());
        }
        said.sort();
        said.dedup();
        if said.len() < 6 {
            unnamed.push(format!("{chapter}: only {} different remarks", said.len()));
        }
    }
    for Fresh { chapter, wrong, .. } in wrong_answers::all() {
        for (answer, words) in wrong.into_iter().filter(|(_, words)| !words.is_empty()) {
            made += 1;
            let report = answer.check(PATIENCE);
            if !remark(&report).contains(words) {
                unnamed.push(format!("{chapter}, \"{words}\": {}\n{}", remark(&report), told(&report)));
            }
        }
    }
    assert!(unnamed.is_empty(), "{} of {made}:\n{}", unnamed.len(), unnamed.join("\n"));
    eprintln!("wrong answers: {made}, all called by their names");
}

/// Other algebra, another order of branches, loops and library functions are right, too.
#[test]
fn right_answers_that_look_unlike_the_books_are_accepted() {
    let mut accepted = 0;
    for Fresh { chapter, right, .. } in wrong_answers::all() {
        for answer in right {
            let report = answer.check(PATIENCE);
            assert!(report.is_done(), "{chapter}: {}", told(&report));
            accepted += 1;
        }
    }
    assert!(accepted >= 70, "{accepted}");
}

/// What a report says that the mistake is.
fn remark(report: &Report) -> &str {
    match &report.outcome {
        Outcome::Wrong(mismatch) | Outcome::OrdinaryRight(mismatch) => {
            mismatch.looks_like.as_deref().unwrap_or("nothing known")
        }
        _ => "no mistake at all",
    }
}

/// The textbook's formula is right, whatever extreme inputs do to it.
#[test]
fn every_textbook_formula_is_accepted() {
    let (mut accepted, mut second_stars) = (0, 0);
    for (chapter, answers) in answers::ALL {
        let Answers { solution, textbook, .. } = answers();
        assert_eq!(
            textbook.is_some(),
            solution.check(PATIENCE).extremes > 0,
            "{chapter}: a formula for ordinary inputs"
        );
        let Some(textbook) = textbook else { continue };
        let report = textbook.check(PATIENCE);
        assert!(report.is_done(), "{chapter}: {}", told(&report));
        accepted += 1;
        second_stars += usize::from(matches!(report.outcome, Outcome::Right(_)));
    }
    eprintln!("textbooks: {accepted} formulas accepted, {second_stars} of them for extreme inputs, too");
    assert!(accepted > 0);
}

#[test]
fn a_mismatch_names_input_answer_and_expected() {
    let said = told(&image(|i, w| [(i % w as u64) as f64, (i / w as u64) as f64]).check(PATIENCE));
    for words in ["index 0, width 4", "yours      (0.0, 0.0)", "expected   (0.5, 0.5)", "difference (-0.5, -0.5)"] {
        assert!(said.contains(words), "no \"{words}\" in\n{said}");
    }
}

#[test]
fn hints_grow_and_progress_is_kept() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("out/check.json");
    let max = right().check(PATIENCE).hints.len();
    for time in 1..=max + 2 {
        let (said, ended) = turn(&wrong(), &file);
        assert_eq!(hints(&said), time.min(max), "{said}");
        assert!(said.contains("is wrong for"), "{said}");
        assert_eq!(ended.as_deref(), Some("edit chapters/05_pinhole/exercise.rs, then `check 5` again"));
        assert_eq!(Progress::read(&file).0.of("05_pinhole").wrong as usize, time);
    }
    let list = |file: &Path| {
        let mut out = Vec::new();
        list_exercises(&[("05_pinhole", wrong())], file, &mut out).expect("printed");
        String::from_utf8(out).expect("UTF-8")
    };
    assert!(list(&file).contains(&format!("tried {} times", max + 2)), "{}", list(&file));
    let (said, ended) = turn(&right(), &file);
    assert!(ended.is_none() && said.contains("is right for all") && hints(&said) == 0, "{said}");
    assert!(list(&file).contains("done"), "{}", list(&file));
    let (said, _) = turn(&wrong(), &file);
    assert_eq!(hints(&said), 1, "{said}");
    for _ in 0..3 {
        let (said, _) = turn(&known(), &file);
        assert!(said.contains("it looks as if ") && hints(&said) == 0, "whoever is told needs no hint: {said}");
    }
    let (said, _) = turn(&wrong(), &file);
    assert_eq!(hints(&said), 2, "named tries earn none: {said}");
    let stub = pinhole(|_, _| [0.0; 3]);
    let before = Progress::read(&file).0;
    let (said, ended) = turn(&stub, &file);
    assert!(ended.is_some_and(|ended| !ended.contains("stub")) && said.contains("as the stub does"), "{said}");
    assert_eq!(Progress::read(&file).0, before, "a stub counts as no try");
}

#[test]
fn a_damaged_file_of_progress_is_set_aside() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("check.json");
    turn(&wrong(), &file);
    let whole = fs::read(&file).expect("written");
    let halves = (0..whole.len() - 2).map(|length| whole[..length].to_vec());
    let others: [&[u8]; 5] =
        [b"[]", b"{\"05_pinhole\": 3}", b"{\"a\": {\"tried\": -1}}", b"\xff\xfe", b"{\"a\": {\"x\": 1}}"];
    let mut damaged = 0;
    for bytes in halves.chain(others.map(<[u8]>::to_vec)) {
        fs::write(&file, &bytes).expect("written");
        let (said, ended) = turn(&right(), &file);
        assert!(ended.is_none() && said.contains("is damaged") && said.contains("is set aside as"), "{said}");
        let aside =
            said.split("is set aside as ").nth(1).and_then(|rest| rest.split(", and counting").next()).expect("a name");
        assert_eq!(fs::read(aside).expect("set aside"), bytes);
        assert!(Progress::read(&file).0.of("05_pinhole").done);
        damaged += 1;
        let kept = fs::read_dir(folder.path()).expect("listed").count();
        assert_eq!(kept, damaged + 1, "what was set aside before stays");
    }
    let occluders = folder.path().join("folder");
    fs::create_dir(&occluders).expect("made");
    let (said, ended) = turn(&right(), &occluders);
    assert!(ended.is_none() && said.contains("will not be remembered"), "{said}");
    eprintln!("progress: {damaged} damaged files set aside");
}

#[test]
fn a_function_that_panics_or_never_ends_is_reported() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("check.json");
    let panics = pinhole(|screen, tan| {
        assert!(screen[0] >= 0.0, "the image\nis mirrored");
        answers::chapter_05_pinhole::answers::solution(screen, tan)
    });
    let (said, ended) = turn(&panics, &file);
    assert!(said.contains("panicked: the image is mirrored") && said.contains("screen (-1.0, 0.0)"), "{said}");
    assert!(said.contains("input 3 ") && ended.is_some() && hints(&said) == 1, "{said}");
    let endless = plan(|_, _| {
        loop {
            std::thread::sleep(Duration::from_millis(50));
        }
    });
    let report = endless.check(Duration::from_millis(300));
    assert!(matches!(report.outcome, Outcome::Late(..)));
    assert!(told(&report).contains("has not answered within 0.3 s"), "{}", told(&report));
}

fn run(folder: &Path, words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pinhole")).current_dir(folder).args(words).output().expect("the program starts")
}

#[test]
fn the_program_lists_checks_and_ends_with_1_on_a_mismatch() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let list = run(folder.path(), &["check"]);
    let said = String::from_utf8(list.stdout).expect("UTF-8");
    assert!(list.status.success());
    for (chapter, answers) in answers::ALL {
        assert!(said.contains(chapter) && said.contains(answers().solution.function), "no {chapter} in\n{said}");
    }
    let columns = |line: &str| line.strip_suffix("not tried").map(|before| before.chars().count());
    let columns: std::collections::BTreeSet<_> = said.lines().filter_map(columns).collect();
    assert_eq!(columns.len(), 1, "what is said of each is no column: {said}");
    assert!(!said.contains("cover") && !folder.path().join("out").exists(), "{said}");
    let none = run(folder.path(), &["check", "cover"]);
    let said = String::from_utf8(none.stderr).expect("UTF-8");
    assert!(none.status.code() == Some(1) && said.contains("cover has no exercise"), "{said}");
    if untouched("05_pinhole") {
        let wrong = run(folder.path(), &["check", "5"]);
        let said = String::from_utf8(wrong.stdout).expect("UTF-8");
        assert_eq!(wrong.status.code(), Some(1), "{said}");
        assert!(said.contains("perspective_direction is wrong for"), "{said}");
        let last = String::from_utf8_lossy(&wrong.stderr);
        assert!(last.lines().count() == 1 && last.contains("then `check 5` again"), "{last}");
        assert!(!folder.path().join("out").exists(), "a stub counts as no try");
    }
}
