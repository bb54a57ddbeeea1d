//! Tests run one by one: which functions each reaches, and which mutation it catches.

use super::choose::Mutation;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// One test of one program.
#[derive(Clone, Debug)]
pub struct Test {
    program: PathBuf,
    folder: PathBuf,
    name: String,
    /// How long it takes when nothing is mutated.
    takes: Duration,
    /// The mutated functions that it reaches.
    reaches: BTreeSet<usize>,
}

pub struct Limits {
    /// How many processes run at a time.
    pub jobs: usize,
    pub of_mutation: Duration,
    pub of_test: Duration,
    pub end: Instant,
}

/// What became of a mutation.
#[derive(Clone, Debug)]
pub enum Fate {
    Caught {
        by: String,
        in_time: Duration,
    },
    /// A test ran several times as long as without it.
    Hung {
        by: String,
    },
    Survived {
        of: usize,
        in_time: Duration,
    },
    /// As many tests as there was time for did not catch it.
    Unfinished {
        ran: usize,
        of: usize,
    },
    Unreached,
}

impl Fate {
    pub fn is_caught(&self) -> bool {
        matches!(self, Self::Caught { .. } | Self::Hung { .. })
    }
}

impl fmt::Display for Fate {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Caught { by, in_time } => write!(to, "caught in {:.1} s by {by}", in_time.as_secs_f64()),
            Self::Hung { by } => write!(to, "caught by its time: {by}"),
            Self::Survived { of, in_time } => write!(to, "SURVIVED {of} tests in {:.0} s", in_time.as_secs_f64()),
            Self::Unfinished { ran, of } => write!(to, "SURVIVED the {ran} quickest of {of} tests"),
            Self::Unreached => write!(to, "SURVIVED: no test reaches it"),
        }
    }
}

/// How one run of a test ended.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    Passed,
    Failed,
    TooLong,
}

impl Test {
    pub fn new(program: &str, folder: &Path, name: &str) -> Self {
        let (program, folder, name) = (program.into(), folder.into(), name.into());
        Self { program, folder, name, takes: Duration::ZERO, reaches: BTreeSet::new() }
    }

    /// The target and the test.
    fn called(&self) -> String {
        let file = self.program.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        format!("{}: {}", file.rsplit_once('-').map_or("", |(target, _)| target), self.name)
    }

    fn run(&self, mutation: &str, record: Option<&Path>, limit: Duration) -> End {
        let mut command = Command::new(&self.program);
        command.args(["--exact", &self.name, "--test-threads", "1"]).current_dir(&self.folder);
        command.env("PINHOLE_MUTATION", mutation).env("INSTA_FORCE_PASS", "1").env("INSTA_UPDATE", "no");
        command.env("CARGO_MANIFEST_DIR", &self.folder).env("RUST_BACKTRACE", "0");
        if let Some(path) = record {
            command.env("PINHOLE_MUTATION_FILE", path);
        }
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        let Ok(mut child) = command.spawn() else { return End::Failed };
        let started = Instant::now();
        loop {
            match child.try_wait() {
                Ok(Some(status)) => return if status.success() { End::Passed } else { End::Failed },
                Ok(None) if started.elapsed() < limit => std::thread::sleep(Duration::from_millis(3)),
                _ => {
                    _ = child.kill();
                    _ = child.wait();
                    return End::TooLong;
                }
            }
        }
    }
}

/// Does something to each of many things, several at a time; in their order.
fn each<T: Sync, R: Send>(jobs: usize, of: &[T], make: impl Fn(usize, &T) -> R + Sync) -> Vec<R> {
    let (next, done) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..jobs.max(1) {
            scope.spawn(|| {
                loop {
                    let at = next.fetch_add(1, Relaxed);
                    let Some(one) = of.get(at) else { break };
                    let made = make(at, one);
                    done.lock().expect("no thread fails").push((at, made));
                }
            });
        }
    });
    let mut done = done.into_inner().expect("no thread fails");
    done.sort_by_key(|(at, _)| *at);
    done.into_iter().map(|(_, made)| made).collect()
}

/// The tests that pass when nothing is mutated, with what they reach, the quickest first.
pub fn reached(tests: Vec<Test>, limits: &Limits, folder: &Path) -> Vec<Test> {
    let records = folder.with_file_name("reached");
    _ = fs::remove_dir_all(&records);
    fs::create_dir_all(&records).expect("a folder for records");
    let ran = each(limits.jobs, &tests, |at, test| {
        let (record, started) = (records.join(at.to_string()), Instant::now());
        let end = test.run("record", Some(&record), limits.of_test);
        let sites = fs::read_to_string(record).unwrap_or_default();
        let reaches = sites.lines().filter_map(|line| line.parse().ok()).collect();
        (end, Test { takes: started.elapsed(), reaches, ..test.clone() })
    });
    for (what, left_out) in [("fail", End::Failed), ("take too long", End::TooLong)] {
        let names: Vec<String> =
            ran.iter().filter(|(end, _)| *end == left_out).map(|(_, test)| test.called()).collect();
        println!("{} tests {what} without a mutation and are left out: {}", names.len(), names.join(", "));
    }
    let mut kept: Vec<Test> = ran.into_iter().filter(|(end, _)| *end == End::Passed).map(|(_, test)| test).collect();
    kept.sort_by_key(|test| test.takes);
    let seconds: f64 = kept.iter().map(|test| test.takes.as_secs_f64()).sum();
    println!("{} tests take {seconds:.0} s", kept.len());
    kept
}

/// What becomes of each mutation; none of those for which no time was left.
pub fn fates(mutations: &[Mutation], tests: &[Test], limits: &Limits) -> Vec<Option<Fate>> {
    let folder = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/target/mutations/sites"));
    let sites: BTreeMap<usize, usize> = fs::read_to_string(folder)
        .expect("the sites")
        .lines()
        .filter_map(|line| line.split_once(' '))
        .filter_map(|(number, site)| Some((number.parse().ok()?, site.parse().ok()?)))
        .collect();
    each(limits.jobs, mutations, |_, mutation| {
        if Instant::now() > limits.end {
            return None;
        }
        let site = sites[&mutation.number];
        let fate =
            fate(mutation, &tests.iter().filter(|test| test.reaches.contains(&site)).collect::<Vec<_>>(), limits);
        eprintln!("{} {}: {fate}", mutation.place(), mutation.change);
        Some(fate)
    })
}

fn fate(mutation: &Mutation, tests: &[&Test], limits: &Limits) -> Fate {
    let started = Instant::now();
    if tests.is_empty() {
        return Fate::Unreached;
    }
    for (ran, test) in tests.iter().enumerate() {
        if started.elapsed() > limits.of_mutation {
            return Fate::Unfinished { ran, of: tests.len() };
        }
        let limit = Duration::from_secs(20) + 6 * test.takes;
        match test.run(&mutation.number.to_string(), None, limit) {
            End::Passed => {}
            End::Failed => return Fate::Caught { by: test.called(), in_time: started.elapsed() },
            End::TooLong => return Fate::Hung { by: test.called() },
        }
    }
    Fate::Survived { of: tests.len(), in_time: started.elapsed() }
}
