//! How much memory is available, checked before a large allocation: a process whose allocation fails half way through a
//! render dies, and its work is lost.

use std::{fmt, fs};

/// What a worker takes of the address space when it is started, however little memory it needs: its stack, and the part of
/// the heap that the system sets apart for each thread.
const A_WORKER: u64 = (2 + 64) << 20;

/// Requests below this are not checked.
const SMALL: u64 = 64 << 20;

/// More memory is needed than there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLittleMemory {
    /// Bytes that are needed.
    pub needed: u64,
    /// Bytes that are free.
    pub free: u64,
}

impl TooLittleMemory {
    /// The bytes that may be taken: an eighth is left for the rest of the program and for other processes.
    pub fn usable(&self) -> u64 {
        self.free - self.free / 8
    }
}

impl fmt::Display for TooLittleMemory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "needs {}, and {} are free", in_words(self.needed), in_words(self.usable()))
    }
}

/// Checks that this many bytes can be allocated.
///
/// Errors: the bytes needed and the bytes free, if they do not suffice.
pub fn check_memory(needed: u64) -> Result<(), TooLittleMemory> {
    if needed < SMALL {
        return Ok(());
    }
    free_memory().map_or(Ok(()), |free| within(needed, free))
}

fn within(needed: u64, free: u64) -> Result<(), TooLittleMemory> {
    let answer = TooLittleMemory { needed, free };
    if needed <= answer.usable() { Ok(()) } else { Err(answer) }
}

/// The bytes that this process can still allocate: what the machine has available, or what a limit on the process or on
/// its control group leaves, whichever is least; `None` if the system does not say.
fn free_memory() -> Option<u64> {
    [available(), address_space_left(), group_left()].into_iter().flatten().min()
}

fn available() -> Option<u64> {
    field(&fs::read_to_string("/proc/meminfo").ok()?, "MemAvailable:").map(|kibibytes| kibibytes * 1024)
}

fn address_space_left() -> Option<u64> {
    let (left, threads) = address_space()?;
    let workers = std::thread::available_parallelism().map_or(1, |count| count.get() as u64);
    Some(after_workers(left, workers, threads))
}

/// What a limit leaves of the address space, and how many threads there are already.
fn address_space() -> Option<(u64, u64)> {
    let limit = field(&fs::read_to_string("/proc/self/limits").ok()?, "Max address space")?;
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let (used, threads) = (field(&status, "VmSize:")? * 1024, field(&status, "Threads:")?);
    Some((limit.saturating_sub(used), threads))
}

/// What is left of the address space once as many workers have started as there are cores.
fn after_workers(left: u64, workers: u64, threads: u64) -> u64 {
    left.saturating_sub((workers + 1).saturating_sub(threads) * A_WORKER)
}

/// Checks that this many workers can be started.
///
/// Errors: a limit of the address space leaves no room for them.
pub fn check_workers(workers: usize) -> Result<(), TooLittleMemory> {
    match address_space() {
        Some((free, _)) => within(workers as u64 * A_WORKER, free),
        None => Ok(()),
    }
}

/// What the limit of the root control group leaves, which in a container is the container's; the page cache does not
/// count as used, since it is released on demand.
fn group_left() -> Option<u64> {
    let number = |file: &str| fs::read_to_string(format!("/sys/fs/cgroup/{file}")).ok()?.trim().parse::<u64>().ok();
    let cached = |file: &str, name: &str| {
        fs::read_to_string(format!("/sys/fs/cgroup/{file}")).ok().and_then(|text| field(&text, name)).unwrap_or(0)
    };
    let (limit, used, cached) = match number("memory.max") {
        Some(limit) => (limit, number("memory.current")?, cached("memory.stat", "inactive_file ")),
        None => (
            number("memory/memory.limit_in_bytes")?,
            number("memory/memory.usage_in_bytes")?,
            cached("memory/memory.stat", "total_inactive_file "),
        ),
    };
    Some(limit.saturating_sub(used.saturating_sub(cached)))
}

/// The number after a name at the start of a line.
fn field(text: &str, name: &str) -> Option<u64> {
    text.lines().find_map(|line| line.strip_prefix(name))?.split_whitespace().next()?.parse().ok()
}

/// A number of bytes in MiB or GiB.
pub fn in_words(bytes: u64) -> String {
    let mebibytes = bytes as f64 / f64::from(1 << 20);
    if mebibytes < 1024.0 { format!("{mebibytes:.0} MiB") } else { format!("{:.1} GiB", mebibytes / 1024.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_eighth_of_what_is_free_stays_free() {
        assert_eq!(within(7 << 30, 8 << 30), Ok(()));
        let refused = within((7 << 30) + 1, 8 << 30).expect_err("refused");
        assert_eq!(refused.to_string(), "needs 7.0 GiB, and 7.0 GiB are free");
        assert_eq!(check_memory(SMALL - 1), Ok(()));
    }

    #[test]
    fn workers_that_are_still_to_come_have_their_room() {
        assert_eq!(after_workers(1 << 30, 4, 1), (1 << 30) - 4 * A_WORKER);
        assert_eq!(after_workers(1 << 30, 4, 5), 1 << 30);
        assert_eq!(after_workers(1 << 20, 4, 1), 0);
    }

    #[test]
    fn numbers_are_found_by_their_names() {
        let limits = "Limit    Soft Limit\nMax address space         6144000000           unlimited            bytes\n";
        assert_eq!(field(limits, "Max address space"), Some(6_144_000_000));
        assert_eq!(field("Max address space         unlimited  unlimited  bytes", "Max address space"), None);
        assert_eq!(field("MemTotal: 3 kB\nMemAvailable:   21420840 kB", "MemAvailable:"), Some(21_420_840));
        assert_eq!(field("", "MemAvailable:"), None);
    }

    #[test]
    fn this_machine_says_how_much_it_has() {
        if cfg!(target_os = "linux") {
            assert!(free_memory().is_some_and(|free| free > 1 << 20));
        }
        assert!(check_memory(1 << 62).is_err() || free_memory().is_none());
    }
}
