//! Where a measurement was made: machine, compiler, commit, load.

use serde::{Deserialize, Serialize};
use std::fs;
use std::process::Command;
use std::time::SystemTime;

/// Where and by what a report was made.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// The command line, as it can be typed again.
    pub command: String,
    /// The commit, and whether files differ from it.
    pub commit: String,
    /// The compiler.
    pub rustc: String,
    /// The kind of processor that was compiled for.
    pub target: String,
    /// `release`, or `dev`, whose times say nothing.
    pub profile: String,
    /// The processor.
    pub processor: String,
    /// Threads that the machine has.
    pub cores: usize,
    /// The day, by universal time.
    pub date: String,
    /// Load average over the last minute, before and after, where the system says.
    pub load: [Option<f64>; 2],
}

impl Provenance {
    /// What is known before the first run; the second load is still to come.
    pub fn now(command: String) -> Self {
        let target = format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS);
        let flags = option_env!("RUSTFLAGS").filter(|flags| !flags.is_empty());
        Self {
            command,
            commit: commit(),
            rustc: compiler(),
            target: flags.map_or(format!("{target}, baseline"), |flags| format!("{target}, {flags}")),
            profile: if cfg!(debug_assertions) { "dev" } else { "release" }.into(),
            processor: processor(),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            date: today(),
            load: [load(), None],
        }
    }

    /// The line that a kept record ends with: when it was measured, and what of.
    pub fn measured(&self) -> String {
        let loads: Vec<String> = self.load.iter().flatten().map(|load| format!("{load:.2}")).collect();
        let load = if loads.is_empty() { String::new() } else { format!(", load {}", loads.join(" to ")) };
        format!("measured on {} at commit {}{load}", self.date, self.commit)
    }
}

/// The day, by universal time, such as 25 Nov 2026.
fn today() -> String {
    // "Wed, 25 Nov 2026 19:00:00 GMT"
    httpdate::fmt_http_date(SystemTime::now()).get(5..16).unwrap_or_default().into()
}

/// The processor, as far as the system says.
pub fn processor() -> String {
    let cpus = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = cpus.lines().find(|line| line.starts_with("model name")).and_then(|line| line.split_once(": "));
    model.map_or("unknown processor".into(), |(_, model)| model.into())
}

/// The processor and the sizes of its caches, as far as the system says.
pub fn processor_and_caches() -> String {
    let cache = |index: u32| {
        let of = |what: &str| fs::read_to_string(format!("/sys/devices/system/cpu/cpu0/cache/index{index}/{what}"));
        let [level, size, kind] = [of("level").ok()?, of("size").ok()?, of("type").ok()?];
        let kib: usize = size.trim().strip_suffix('K')?.parse().ok()?;
        (kind.trim() != "Instruction").then(|| format!("L{} {kib} KiB", level.trim()))
    };
    let caches: Vec<String> = (0..8).filter_map(cache).collect();
    format!("machine: {}; caches: {}", processor(), caches.join(", "))
}

/// The compiler that is at hand now, which under cargo is the one that built this.
pub fn compiler() -> String {
    let at_least = || format!("rustc {} or later", env!("CARGO_PKG_RUST_VERSION"));
    answer("rustc", &["--version"]).unwrap_or_else(at_least)
}

/// The load average over the last minute, where the system says.
pub fn load() -> Option<f64> {
    let text = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    text.split_whitespace().next().and_then(|load| load.parse().ok())
}

fn commit() -> String {
    // What is kept changes while it is measured; the sources count.
    let status =
        ["status", "--porcelain", "--untracked-files=no", "--", "src", "chapters/*.rs", "tests/bench", "Cargo.lock"];
    let changed = answer("git", &status).is_some_and(|text| !text.is_empty());
    let commit = answer("git", &["rev-parse", "--short=12", "HEAD"]);
    commit.map_or("unknown".into(), |commit| if changed { format!("{commit}, with changes") } else { commit })
}

fn answer(program: &str, words: &[&str]) -> Option<String> {
    let root = crate::repository();
    let answer = Command::new(program).args(words).current_dir(root).output().ok()?;
    answer.status.success().then(|| String::from_utf8_lossy(&answer.stdout).trim().to_string())
}
