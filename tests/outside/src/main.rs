//! What a program does with pinhole beyond rendering a file: a picture in memory, columns as arrays, a render that is watched
//! and stopped, in a world that is its own.

use outside::{stages, table, table_with_contours};
use pinhole::extend::*;
use pinhole::intersect::Hits;
use pinhole::prelude::*;
use std::io::{self, Write};
use std::sync::atomic::{AtomicU64, Ordering};

/// Counts samples, and stops the render after so many.
struct Patience {
    taken: AtomicU64,
    max: u64,
}

impl Watch for Patience {
    fn traced(&self, samples: u64) {
        self.taken.fetch_add(samples, Ordering::Relaxed);
    }

    fn stopped(&self) -> bool {
        self.taken.load(Ordering::Relaxed) >= self.max
    }
}

fn main() -> pinhole::Result {
    let mut out = io::stdout().lock();
    let mut say = |line: String| writeln!(out, "{line}").map_err(|why| pinhole::Error::Usage(why.to_string()));

    // A picture in memory: no file is written.
    let film = render(&table_with_contours(72, 24), &stages(), &Execution::default(), &())?.film;
    let letter = |x, y| b" .:-=+*#%@"[(film.mean(x, y)[1].sqrt() * 9.0).min(9.0) as usize] as char;
    for y in 0..24 {
        say((0..72).map(|x| letter(x, y)).collect())?;
    }

    // A column as an array of one's own: how far each ray went.
    let seen = inspect(&table(32, 18), &stages(), 32)?;
    let hits = seen.tiles.iter().filter_map(|&tile| seen.world.get::<Hits>(tile));
    let distances: Vec<f64> = hits.flat_map(|hits| hits.t.iter().copied()).collect();
    let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
    say(format!("{} rays, the nearest hit at {nearest:.3}", distances.len()))?;

    // A render that is watched from step to step, and stopped: what is there by then can be shown.
    let (scene, offer) = (table(72, 24), stages());
    let census = Census::of(&scene);
    let mut progress = RenderInProgress::begin(&census, &offer, &Execution::default())?;
    let patience = Patience { taken: AtomicU64::new(0), max: 8 * 72 * 24 };
    let stopped = matches!(progress.advance(progress.steps(), &patience), Err(pinhole::Error::Interrupted));
    let (taken, seen) = (patience.taken.load(Ordering::Relaxed), progress.film.mean(36, 12));
    say(format!("stopped: {stopped}, after {taken} of {} samples; the middle is {seen:.3?}", 16 * 72 * 24))
}
