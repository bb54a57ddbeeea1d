//! Nothing is lost: wherever the program writes, removes or renames a file, what others have put there stays.
//!
//! [`PLACES`] is the list of all of these places; a source that writes elsewhere fails the second test.

use super::{pinhole, text};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};

/// A command, and the files that it writes without having been told their names.
const PLACES: [(&str, &[&str]); 21] = [
    ("render 5 --size 8x5", &["out/05_pinhole.png", "out/05_pinhole.exr"]),
    ("render 5 --size 8x5 -n 2", &["out/05_pinhole.png", "out/05_pinhole.exr", "out/05_pinhole.checkpoint"]),
    ("render 5 --size 8x5 -n 2 -o named.png", &["named.checkpoint"]),
    ("render 5 --size 8x5 -n 2 --write-every 1ms -o named.png", &["named.checkpoint", "named-2.checkpoint"]),
    ("render 5 --size 8x5 -n 2 --resume -o named.png", &["named.checkpoint"]),
    ("render 5 --size 8x5 --mine", &["out/05_mine.png"]),
    ("render 5 --size 8x5 --part 1/2", &["out/05_pinhole.part-1-of-2.checkpoint"]),
    (
        "farm 5 --size 8x5 --parts 2 --to slurm",
        &["out/05_pinhole.sbatch", "out/05_pinhole.submit.sh", "out/05_pinhole.files"],
    ),
    ("farm 5 --size 8x5 --parts 2 --to openjd", &["out/05_pinhole.template.json"]),
    ("farm 5 --size 8x5 --parts 2 --to parallel", &["out/05_pinhole.parallel.sh"]),
    ("figure 05_pinhole", &["out/05_pinhole.svg"]),
    ("draw card.png", &["out/card.png"]),
    ("yours 5", &["out/yours_05.png"]),
    ("draw evening.hdr", &["out/evening.hdr"]),
    ("conventions 5 --size 8x5 --mistake mirrored", &["out/05_pinhole_mirrored.png"]),
    ("export 16 -o scene.ron", &["scene.ron", "card.png", "evening.hdr"]),
    ("export 28 -o scene.ron", &["scene.ron", "mesh-1.glb"]),
    ("check 5", &["out/check.json", "out/check.damaged.json"]),
    ("review --mutate all --gallery", &["out/review/mutations.svg"]),
    ("review 6 --mutate half-pixel", &["out/review/index.html"]),
    (
        "report 18 --quick --size 8x5",
        &["out/report/18_error_and_time.html", "out/report/18_error_and_time.json", "out/report/18_error_and_time.csv"],
    ),
];

/// The sources that write by the rule, each with the number of calls; those without a remark make what `PLACES` lists.
const WRITERS: [(&str, usize); 26] = [
    ("src/command/compare.rs", 1), // where the reader says
    ("src/command/conventions.rs", 1),
    ("src/command/cost.rs", 1), // the repository's costs.txt, by --write
    ("src/command/draw.rs", 1),
    ("src/command/export.rs", 1),
    ("src/command/export_images.rs", 1),
    ("src/command/export_meshes.rs", 1),
    ("src/command/extremes.rs", 1), // where the reader says
    ("src/command/farm.rs", 1),
    ("src/command/figure.rs", 1),
    ("src/command/files.rs", 2),
    ("src/command/long_render.rs", 4),
    ("src/command/methods.rs", 1), // the repository's curves.txt, by measure
    ("src/command/mine.rs", 1),
    ("src/command/mutation.rs", 2),
    ("src/command/own_file.rs", 1),
    ("src/command/parts.rs", 2),
    ("src/command/render.rs", 2),
    ("src/command/report.rs", 2),
    ("src/command/review.rs", 1),
    ("src/command/view/home.rs", 2), // Save: tests/view/kept.rs
    ("src/command/yours.rs", 1),
    ("src/lab/exercise/progress.rs", 2),
    ("src/lab/report/kept.rs", 1),    // the repository's report.json, by --write
    ("src/lab/report/run.rs", 2),     // runs of a report: its own test
    ("src/lab/review/pending.rs", 2), // snapshots, by `review accept`
];

/// What stands in the way: how it is put there.
const HOSTILE: [(&str, fn(&Path)); 9] = [
    ("another program's text", |file| fs::write(file, "precious\n").expect("written")),
    ("nothing", |file| fs::write(file, "").expect("written")),
    ("broken UTF-8", |file| fs::write(file, b"\xff\xfe precious \x80").expect("written")),
    ("a file nobody may write to", |file| {
        fs::write(file, "precious\n").expect("written");
        fs::set_permissions(file, fs::Permissions::from_mode(0o444)).expect("set");
    }),
    ("a file nobody may read", |file| {
        fs::write(file, "precious\n").expect("written");
        fs::set_permissions(file, fs::Permissions::from_mode(0o000)).expect("set");
    }),
    ("a folder", |file| {
        fs::create_dir(file).expect("made");
        fs::write(file.join("inside"), "precious\n").expect("written");
    }),
    ("a file longer than any of its kind", |file| {
        let made = fs::File::create(file).expect("made");
        made.set_len(5 << 30).expect("sparse");
    }),
    ("a link to another program's file", |file| {
        let aim = file.with_file_name("aim of a link");
        fs::write(&aim, "precious\n").expect("written");
        symlink("aim of a link", file).expect("linked");
    }),
    ("a link that leads in a circle", |file| symlink(file.file_name().expect("a name"), file).expect("linked")),
];

/// Everything in a folder: what files hold, where links lead, and that folders are there.
fn held(folder: &Path, into: &mut BTreeMap<PathBuf, String>) {
    for entry in fs::read_dir(folder).expect("listed") {
        let path = entry.expect("listed").path();
        let found = fs::symlink_metadata(&path).expect("there");
        let what = if found.is_symlink() {
            format!("a link to {}", fs::read_link(&path).expect("read").display())
        } else if found.is_dir() {
            held(&path, into);
            "a folder".into()
        } else if found.len() > 1 << 20 {
            format!("{} bytes", found.len())
        } else {
            let mode = found.permissions().mode();
            fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).expect("set");
            let bytes = fs::read(&path).expect("read");
            fs::set_permissions(&path, fs::Permissions::from_mode(mode)).expect("set");
            format!("{bytes:?}, {:o}", mode & 0o777)
        };
        into.insert(path, what);
    }
}

#[test]
fn no_file_of_others_is_replaced_or_removed() {
    let (mut tried, mut told) = (0, 0);
    let mut lost = Vec::new();
    for (turn, (command, files)) in PLACES.into_iter().enumerate() {
        // What also reads its file meets all of them; the others, which one function writes for, meet a text and two more,
        // in turn.
        let reads =
            ["check", "review", "yours"].iter().any(|own| command.starts_with(own)) || command.contains("--resume");
        for file in files {
            let meets = |at: usize| reads || at == 0 || (at + turn).is_multiple_of(4);
            for (_, (what, put)) in HOSTILE.into_iter().enumerate().filter(|(at, _)| meets(*at)) {
                let folder = tempfile::tempdir().expect("a temporary folder");
                let place = folder.path().join(file);
                fs::create_dir_all(place.parent().expect("a folder")).expect("made");
                put(&place);
                let (mut before, mut after) = (BTreeMap::new(), BTreeMap::new());
                held(folder.path(), &mut before);
                let ended = pinhole(folder.path()).args(command.split(' ')).output().expect("the program starts");
                held(folder.path(), &mut after);
                // A record that is damaged is set aside, under a name of its own.
                let is_kept = |(path, held): (&PathBuf, &String)| {
                    after.get(path) == Some(held)
                        || (command.starts_with("check") && path == &place && after.values().any(|own| own == held))
                };
                let said = text(&ended.stderr);
                assert!(!said.contains("panicked") && !said.contains("precious"), "{command}, {what}: {said}");
                told += usize::from(!said.is_empty());
                if !before.iter().all(is_kept) {
                    lost.push(format!("{command}: {what} at {file}: {said}"));
                }
                let is_part = |path: &&PathBuf| path.extension().is_some_and(|ending| ending == "part");
                assert_eq!(after.keys().filter(is_part).count(), 0, "{command}, {what}");
                tried += 1;
            }
        }
    }
    assert!(lost.is_empty(), "{} of {tried} lost:\n{}", lost.len(), lost.join("\n"));
    assert!(told * 2 > tried, "only {told} of {tried} were told why");
    eprintln!("files in the way: {tried} commands, none of them lost, {told} told why");
}

/// What a reader names is replaced, unless it is write-protected or no file; what the program has written is replaced, too.
#[test]
fn what_a_reader_names_and_what_the_program_wrote_is_replaced() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = |words: &str| pinhole(folder.path()).args(words.split(' ')).output().expect("the program starts");
    let picture = folder.path().join("named.png");
    for (what, put) in HOSTILE {
        put(&picture);
        let replaced = run("render 5 --size 8x5 -q -o named.png").status.success();
        let stays =
            ["a file nobody may write to", "a folder", "a file nobody may read", "a link that leads in a circle"];
        assert_eq!(replaced, !stays.contains(&what), "{what}");
        let _ = fs::remove_dir_all(&picture).or_else(|_| fs::remove_file(&picture));
    }
    // What takes long is written by the same functions as the rest.
    let long = |command: &str| ["export", "report", "review --mutate all"].iter().any(|own| command.starts_with(own));
    for (command, files) in PLACES.iter().filter(|(command, _)| !long(command)) {
        for _ in 0..2 {
            let ended = run(command);
            let said = text(&ended.stderr);
            assert!(!said.contains("cannot write"), "{command}: {said}");
        }
        eprintln!("{command}: twice, {}", files[0]);
    }
}

/// The calls by which a source writes, removes or renames.
const CALLS: [&str; 9] = [
    "fs::write(",
    "File::create",
    "fs::remove_",
    "fs::rename(",
    "fs::hard_link(",
    "fs::copy(",
    "fs::create_dir",
    "OpenOptions::new(",
    "set_permissions(",
];

/// Where such calls stand, and why there.
const CALLERS: [(&str, &str); 8] = [
    ("src/pinhole/film/whole_file.rs", "the one place that writes"),
    ("src/pinhole/film/replaces.rs", "looks whether a file may be written to"),
    ("src/scene/open_file.rs", "opens for reading"),
    ("src/lab/report/run.rs", "removes the folder of runs once it is empty"),
    ("src/lab/review/pending.rs", "removes snapshots that a reader accepts or rejects"),
    ("src/lab/yours/joined.rs", "the text of a program that writes its own picture"),
    ("src/lab/yours/known.rs", "programs, in folders of their own for a moment"),
    ("src/lab/naive/one_page.rs", "a program for the book's first page"),
];

#[test]
fn every_place_that_writes_is_in_the_list() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut sources = Vec::new();
    sources_in(&root.join("src"), &mut sources);
    let mut writers = BTreeMap::new();
    for path in sources {
        let source = fs::read_to_string(&path).expect("a source");
        let source = source.split("#[cfg(test)]").next().unwrap_or_default();
        let name = path.strip_prefix(root).expect("below").display().to_string();
        let calls = CALLS.iter().any(|call| source.contains(call));
        assert!(!calls || CALLERS.iter().any(|(own, _)| *own == name), "{name} writes by itself");
        let code: Vec<&str> = source.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
        let by_rule = [
            "write_whole(",
            "write_file(",
            "write_png(",
            "write_png_as(",
            "write_exr(",
            "write_exr_with(",
            "set_aside(",
            "remove_own(",
            "keep_checkpoint(",
            "write_done(",
        ];
        let count =
            code.iter().filter(|line| !line.contains("fn ") && by_rule.iter().any(|call| line.contains(call))).count();
        if count > 0 && !name.starts_with("src/pinhole") {
            writers.insert(name, count);
        }
    }
    let listed: BTreeMap<String, usize> = WRITERS.iter().map(|(name, count)| ((*name).to_owned(), *count)).collect();
    assert_eq!(writers, listed, "a place that writes has come or gone: what it may replace belongs into PLACES");
}

fn sources_in(folder: &Path, sources: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("listed") {
        let path = entry.expect("listed").path();
        if path.is_dir() {
            sources_in(&path, sources);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            sources.push(path);
        }
    }
}
