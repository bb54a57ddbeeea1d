//! The copy of the workspace, mutations written into it behind switches, and the tests built from it.

use super::choose::Mutation;
use super::run::Test;
use super::source::{functions, masked};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The module that says which mutation is on, and which functions a test reaches.
const SWITCH: &str = r#"//! Written by the bench `mutations`.
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};

static ACTIVE: AtomicU32 = AtomicU32::new(0);
static REACHED: [AtomicBool; SITES] = [const { AtomicBool::new(false) }; SITES];

/// The number of the mutation that is on; 2 for none, 1 while functions that are reached are recorded.
#[inline]
pub fn at(site: usize) -> u32 {
    let active = ACTIVE.load(Relaxed);
    if active > 1 { active } else { look(site, active) }
}

#[cold]
fn look(site: usize, mut active: u32) -> u32 {
    if active == 0 {
        let asked = std::env::var("PINHOLE_MUTATION").unwrap_or_default();
        active = if asked == "record" { 1 } else { asked.parse().unwrap_or(2) };
        ACTIVE.store(active, Relaxed);
    }
    if active == 1 && !REACHED[site].swap(true, Relaxed) {
        if let Ok(path) = std::env::var("PINHOLE_MUTATION_FILE") {
            let file = std::fs::OpenOptions::new().create(true).append(true).open(path);
            if let Ok(mut file) = file {
                let _ = std::io::Write::write_all(&mut file, format!("{site}\n").as_bytes());
            }
        }
    }
    active
}
"#;

/// A copy of the workspace, with a folder of its own for what is built.
pub struct Workspace {
    root: PathBuf,
    pub folder: PathBuf,
    cargo: Vec<String>,
}

/// Where a mutated body stands in the copy: file, first and last line, the mutation or the site as a whole.
struct Place {
    file: String,
    lines: [usize; 2],
    mutation: Option<usize>,
    site: usize,
}

impl Workspace {
    /// Copies what git knows or would add; a file that is the same already is left alone.
    pub fn copied(root: &Path, cargo: &str) -> Self {
        let folder = root.join("target/mutations/workspace");
        let own = Self { root: root.into(), folder, cargo: cargo.split_whitespace().map(String::from).collect() };
        let listed = Command::new("git")
            .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
            .current_dir(root)
            .output()
            .expect("git lists the files");
        let listed = String::from_utf8_lossy(&listed.stdout);
        let names: BTreeSet<&str> = listed.split('\0').filter(|name| root.join(name).is_file()).collect();
        own.remove_all_but(&names, "");
        for name in names {
            own.write(name, &fs::read(root.join(name)).expect("a file of the workspace"));
        }
        own
    }

    /// Removes what an earlier copy held and the workspace no longer has.
    fn remove_all_but(&self, names: &BTreeSet<&str>, below: &str) {
        for entry in fs::read_dir(self.folder.join(below)).into_iter().flatten().flatten() {
            let name = format!("{below}{}", entry.file_name().to_string_lossy());
            if entry.path().is_dir() {
                self.remove_all_but(names, &format!("{name}/"));
            } else if !names.contains(name.as_str()) {
                fs::remove_file(entry.path()).expect("a file of the copy");
            }
        }
    }

    fn write(&self, name: &str, contents: &[u8]) {
        let path = self.folder.join(name);
        if fs::read(&path).is_ok_and(|old| old == contents) {
            return;
        }
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder for the copy");
        fs::write(path, contents).expect("a file of the copy");
    }

    fn cargo(&self) -> Command {
        let mut command = Command::new(&self.cargo[0]);
        command.args(&self.cargo[1..]).current_dir(&self.folder);
        command.env("CARGO_TARGET_DIR", self.folder.with_file_name("built"));
        command.env("CARGO_INCREMENTAL", "1").stderr(Stdio::null());
        command
    }

    /// Writes the first mutations that compile into the copy, and numbers them; how many were refused.
    pub fn instrumented(&self, candidates: Vec<Mutation>, count: usize) -> (Vec<Mutation>, usize) {
        let mut queue = candidates.into_iter();
        let mut kept: Vec<Mutation> = Vec::new();
        let mut refused = 0;
        loop {
            kept.extend(queue.by_ref().take(count.saturating_sub(kept.len())));
            kept.iter_mut().enumerate().for_each(|(at, mutation)| mutation.number = at + 3);
            let places = self.written(&kept);
            let wrong = self.errors(&places);
            if wrong.is_empty() {
                return (kept, refused);
            }
            refused += wrong.len();
            kept.retain(|mutation| !wrong.contains(&mutation.number));
            eprintln!("{} of the mutations do not compile; {} are left", wrong.len(), kept.len());
        }
    }

    /// Writes mutations into the copy, each as a body of its function beside the original.
    fn written(&self, mutations: &[Mutation]) -> Vec<Place> {
        let mut by_file: BTreeMap<&str, BTreeMap<usize, Vec<&Mutation>>> = BTreeMap::new();
        let files: BTreeSet<String> = mutations.iter().map(|mutation| mutation.file.clone()).collect();
        for mutation in mutations {
            by_file.entry(&mutation.file).or_default().entry(mutation.function).or_default().push(mutation);
        }
        let (mut places, mut site) = (Vec::new(), 0);
        // Files that an earlier round had changed, and that none changes now, are what they were.
        let before = fs::read_to_string(self.folder.with_file_name("changed")).unwrap_or_default();
        for file in before.lines().filter(|file| !files.contains(*file)) {
            self.write(file, &fs::read(self.root.join(file)).unwrap_or_default());
        }
        fs::write(self.folder.with_file_name("changed"), files.into_iter().collect::<Vec<_>>().join("\n"))
            .expect("written");
        for (file, functions_of_file) in by_file {
            let source = fs::read_to_string(self.root.join(file)).expect("a source file");
            let all = functions(&masked(&source));
            let switch = if file.starts_with("src/pinhole/") { "crate" } else { "pinhole" };
            let (mut out, mut done) = (String::new(), 0);
            for (function, mutations) in functions_of_file {
                let own = &all[function];
                let head = source[done..own.start].rfind(['}', ';']).map_or(done, |at| done + at);
                out.push_str(&source[done..head]);
                // Bodies inlined into bodies would grow without end.
                out.push_str(&source[head..own.start].replace("#[inline(always)]", "#[inline]"));
                out.push_str(&source[own.start..own.body.start]);
                let line_of = |out: &str| out.matches('\n').count() + 1;
                let first = line_of(&out);
                out.push_str(&format!("{{ match {switch}::mutation_switch::at({site}) {{\n"));
                for mutation in mutations {
                    let from = line_of(&out);
                    let [start, end] = [&source[own.body.start..mutation.from], &source[mutation.to..own.body.end]];
                    out.push_str(&format!("{} => {start}{}{end}\n", mutation.number, mutation.by));
                    let lines = [from, line_of(&out)];
                    places.push(Place { file: file.into(), lines, mutation: Some(mutation.number), site });
                }
                out.push_str(&format!("_ => {} }} }}", &source[own.body.clone()]));
                places.push(Place { file: file.into(), lines: [first, line_of(&out)], mutation: None, site });
                done = own.body.end;
                site += 1;
            }
            out.push_str(&source[done..]);
            self.write(file, out.as_bytes());
        }
        self.write("src/pinhole/mutation_switch.rs", SWITCH.replace("SITES", &site.max(1).to_string()).as_bytes());
        let root = fs::read_to_string(self.root.join("src/pinhole/lib.rs")).expect("the renderer's root");
        self.write(
            "src/pinhole/lib.rs",
            format!("{root}\n/// Written by a bench.\npub mod mutation_switch;\n").as_bytes(),
        );
        fs::write(self.folder.with_file_name("sites"), sites_of(&places)).expect("written");
        places
    }

    /// The mutations in which the compiler finds errors.
    fn errors(&self, places: &[Place]) -> BTreeSet<usize> {
        let mut command = self.cargo();
        command.args(["check", "-p", "pinhole", "-p", "pinhole-lab", "--message-format=json"]);
        let out = command.output().expect("cargo checks the copy");
        let mut wrong = BTreeSet::new();
        let mut unplaced = Vec::new();
        for message in messages(&out.stdout).filter(|message| message["reason"] == "compiler-message") {
            let message = &message["message"];
            if message["level"] != "error" || message["spans"].as_array().is_none_or(|spans| spans.is_empty()) {
                continue;
            }
            let found = in_places(message, places);
            if found.is_empty() {
                unplaced.push(message["rendered"].as_str().unwrap_or_default().to_string());
            }
            wrong.extend(found);
        }
        assert!(out.status.success() || !wrong.is_empty(), "the copy does not compile:\n{}", unplaced.join("\n"));
        wrong
    }

    /// Builds the tests of the copy: unit tests, and these targets.
    pub fn tests(&self, targets: &[String]) -> Vec<Test> {
        let mut command = self.cargo();
        command.args([
            "test",
            "--no-run",
            "--message-format=json",
            "-p",
            "pinhole",
            "-p",
            "pinhole-lab",
            "-p",
            "pinhole-cli",
        ]);
        command.arg("--lib");
        targets.iter().for_each(|target| _ = command.args(["--test", target]));
        let out = command.output().expect("cargo builds the tests");
        assert!(out.status.success(), "the copy's tests do not build");
        let mut tests = Vec::new();
        for message in messages(&out.stdout).filter(|message| message["profile"]["test"] == true) {
            let Some(program) = message["executable"].as_str() else { continue };
            let manifest = PathBuf::from(message["manifest_path"].as_str().expect("a manifest"));
            let folder = manifest.parent().expect("a package's folder");
            let listed = Command::new(program).args(["--list", "--format", "terse"]).current_dir(folder).output();
            let listed = String::from_utf8(listed.expect("tests are listed").stdout).expect("text");
            let names = listed.lines().filter_map(|line| line.strip_suffix(": test"));
            tests.extend(names.map(|name| Test::new(program, folder, name)));
        }
        tests
    }
}

/// Which site each mutation belongs to, a line each.
fn sites_of(places: &[Place]) -> String {
    let of = |place: &Place| place.mutation.map(|number| format!("{number} {}\n", place.site));
    places.iter().filter_map(of).collect()
}

fn messages(out: &[u8]) -> impl Iterator<Item = Value> {
    let lines = String::from_utf8_lossy(out).into_owned();
    lines.lines().filter_map(|line| serde_json::from_str(line).ok()).collect::<Vec<Value>>().into_iter()
}

/// The mutations in whose bodies an error lies; of one beside them, all of that function.
fn in_places(message: &Value, places: &[Place]) -> BTreeSet<usize> {
    let spans = message["spans"].as_array().cloned().unwrap_or_default();
    let mut inside = BTreeSet::new();
    let mut beside = BTreeSet::new();
    for span in &spans {
        let Some(line) = span["line_start"].as_u64().map(|line| line as usize) else { continue };
        let name = span["file_name"].as_str().unwrap_or_default();
        for place in places.iter().filter(|place| name.ends_with(&place.file)) {
            if (place.lines[0]..=place.lines[1]).contains(&line) {
                match place.mutation {
                    Some(number) => _ = inside.insert(number),
                    None => _ = beside.insert(place.site),
                }
            }
        }
    }
    if !inside.is_empty() {
        return inside;
    }
    places.iter().filter(|place| beside.contains(&place.site)).filter_map(|place| place.mutation).collect()
}
