//! One piece of work row by row, in columns and fused, over the number of rows: `cargo bench --bench rows`.
//!
//! `-- --write` keeps the answer beside chapter 37, whose page shows it.
//! Each time is the least of seven, of one thread, in processor time, for the instructions that this machine has.
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

use cpu_time::ProcessTime;
use multiversion::multiversion;
use pinhole::sample::circle_point;
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::naive::rows::{
    Columns, Sample, as_they_come, circle_by_library, circle_in_f32, fused, in_columns, listed, row_by_row,
};
use pinhole_lab::report::provenance::{Provenance, processor_and_caches};
use std::fmt::Write as _;
use std::hint::black_box;

const CHAPTER: &str = "37_rows";
/// So many rows are done for each time, as often as it takes.
const ROWS: usize = 1 << 21;
const ROUNDS: usize = 7;

/// For the plainest machine, as the library is, so that no call changes from one set of instructions to another.
#[inline(never)]
fn by_library(samples: &[Sample], t: &mut [f64]) {
    row_by_row(samples, circle_by_library, t);
}

/// What is compiled for several machines, each of which runs what it can.
macro_rules! for_each_machine {
    ($(fn $name:ident($($argument:ident: $of:ty),*) $body:tt)+) => {
        $(#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
        fn $name($($argument: $of),*) $body)+
    };
}

for_each_machine! {
    fn by_series(samples: &[Sample], t: &mut [f64]) {
        row_by_row(samples, circle_point, t);
    }
    fn staged(columns: &mut Columns) {
        in_columns(columns);
    }
    fn in_one(given: [&[f64]; 4], t: &mut [f64]) {
        fused(given, t);
    }
    fn mixed(samples: &[Sample], kinds: &[u32], t: &mut [f64]) {
        as_they_come(samples, kinds, t);
    }
    fn by_lists(given: [&[f64]; 4], kinds: &[u32], list: &mut [u32], t: &mut [f64]) {
        listed(given, kinds, list, t);
    }
    fn points_by_library(turns: &[f64], x: &mut [f64], y: &mut [f64]) {
        for ((turn, x), y) in turns.iter().zip(x).zip(y) {
            [*x, *y] = circle_by_library(*turn);
        }
    }
    fn points_by_series(turns: &[f64], x: &mut [f64], y: &mut [f64]) {
        for ((turn, x), y) in turns.iter().zip(x).zip(y) {
            [*x, *y] = circle_point(*turn);
        }
    }
    fn points_in_f32(turns: &[f32], x: &mut [f32], y: &mut [f32]) {
        for ((turn, x), y) in turns.iter().zip(x).zip(y) {
            [*x, *y] = circle_in_f32(*turn);
        }
    }
}

/// Nanoseconds a row.
fn time(rows: usize, mut work: impl FnMut()) -> f64 {
    let times = ROWS.div_ceil(rows);
    let mut min = f64::INFINITY;
    for _ in 0..ROUNDS {
        let start = ProcessTime::now();
        (0..times).for_each(|_| work());
        min = min.min(1e9 * start.elapsed().as_secs_f64() / (times * rows) as f64);
    }
    min
}

fn main() {
    let mut text = String::from("nanoseconds a row, processor time of one thread, the least of seven\n");
    let names = ["by library", "by series", "in columns", "fused", "as they come", "listed", "columns KiB"];
    let _ = write!(text, "\nrows at once\n    count");
    for name in names {
        let _ = write!(text, "  {name:>12}");
    }
    let mut draws = Draws::new(3702, 0);
    for power in 2..=10 {
        let rows = 1_usize << (2 * power);
        let mut one = || Sample {
            u: [draws.unit(), draws.unit()],
            focus: [draws.between(-0.25, 0.25), draws.between(-0.25, 0.25)],
        };
        let samples: Vec<Sample> = (0..rows).map(|_| one()).collect();
        let (mut columns, mut t) = (Columns::of(&samples), vec![0.0; rows]);
        let library = time(rows, || by_library(black_box(&samples), black_box(&mut t)));
        let series = time(rows, || by_series(black_box(&samples), black_box(&mut t)));
        let expected = t.clone();
        let in_columns = time(rows, || staged(black_box(&mut columns)));
        assert!(expected == columns.t, "{rows} rows differ");
        let given = columns.given.each_ref().map(Vec::as_slice);
        let in_one = time(rows, || in_one(black_box(given), black_box(&mut t)));
        assert!(expected == t, "{rows} rows differ");
        let kinds: Vec<u32> = (0..rows).map(|_| u32::from(draws.unit() < 0.125)).collect();
        let mut list = vec![0; rows];
        let as_they_come = time(rows, || mixed(black_box(&samples), black_box(&kinds), black_box(&mut t)));
        let expected = t.clone();
        let listed = time(rows, || by_lists(given, black_box(&kinds), black_box(&mut list), black_box(&mut t)));
        assert!(expected == t, "{rows} rows of two kinds differ");
        let _ = write!(text, "\n{rows:>9}");
        let kib = (rows * 10 * size_of::<f64>()) as f64 / 1024.0;
        for number in [library, series, in_columns, in_one, as_they_come, listed, kib] {
            let _ = write!(text, "  {number:>12.2}");
        }
    }
    let _ = write!(text, "\n\npoints of a circle, of 4096 rows\n");
    let turns: Vec<f64> = (0..4096).map(|_| draws.unit()).collect();
    let in_f32: Vec<f32> = turns.iter().map(|turn| *turn as f32).collect();
    let (mut x, mut y) = (vec![0.0; 4096], vec![0.0; 4096]);
    let (mut x32, mut y32) = (vec![0.0_f32; 4096], vec![0.0_f32; 4096]);
    for (name, ns) in [
        ("the library's, one by one", time(4096, || points_by_library(black_box(&turns), &mut x, &mut y))),
        ("the series in f64, in columns", time(4096, || points_by_series(black_box(&turns), &mut x, &mut y))),
        ("half the series in f32, in columns", time(4096, || points_in_f32(black_box(&in_f32), &mut x32, &mut y32))),
    ] {
        let _ = writeln!(text, "{name:<36}{ns:>6.2}");
    }
    let _ = write!(text, "\n{}\n{}\n", processor_and_caches(), Provenance::now(String::new()).measured());
    print!("{text}");
    if std::env::args().any(|word| word == "--write") {
        let file = format!("{}/chapters/{CHAPTER}/curves.txt", env!("CARGO_MANIFEST_DIR"));
        std::fs::write(file, text).expect("the times can be written");
    }
}
