use crate::plan::TileSystems;
use crate::render::{Rendered, peak_memory};
use serde::Serialize;
use std::fmt;
use std::time::Duration;

/// Time and rows of one stage over all tiles and workers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StageStats {
    /// The stage's name.
    pub stage: &'static str,
    /// Rows of the column that it wrote: points, rays or hits.
    pub rows: u64,
    /// Milliseconds, summed over workers.
    pub milliseconds: f64,
    /// Nanoseconds per row; none where it had no rows.
    pub nanoseconds_a_row: Option<f64>,
}

/// What a render cost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RenderStats {
    /// The chapter.
    pub chapter: String,
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
    /// The number of workers.
    pub threads: usize,
    /// Elapsed time from the first tile to the last, in milliseconds.
    pub milliseconds: f64,
    /// Millions of rays per second.
    pub megarays_a_second: f64,
    /// Rays of all kinds: camera rays and shadow rays.
    pub rays: u64,
    /// Memory of the film, in bytes.
    pub film_bytes: usize,
    /// Bytes of film per pixel.
    pub film_bytes_a_pixel: f64,
    /// Memory of the tables, in bytes.
    pub table_bytes: usize,
    /// Memory of the columns of one tile, in bytes.
    pub column_bytes_a_tile: usize,
    /// The peak memory of the process, in bytes, where the system reports it.
    pub peak_memory_bytes: Option<u64>,
    /// Samples that were rejected because they were negative, infinite or NaN.
    pub rejected_samples: u64,
    /// The stages that ran, in order.
    pub stages: Vec<StageStats>,
    /// The stages that were left out, and why.
    pub left_out: Vec<(String, String)>,
}

impl RenderStats {
    /// Collects the statistics of a finished render.
    pub fn of(chapter: &str, rendered: &Rendered, tile_side: u32) -> Self {
        let pixels = f64::from(rendered.film.width) * f64::from(rendered.film.height);
        let stages: Vec<StageStats> = rendered
            .plan
            .stages
            .iter()
            .zip(&rendered.laps)
            .map(|(stage, lap)| StageStats {
                stage: stage.name,
                rows: lap.rows,
                milliseconds: milliseconds(lap.time),
                nanoseconds_a_row: (lap.rows > 0).then(|| lap.time.as_nanos() as f64 / lap.rows as f64),
            })
            .collect();
        let rays_of = |name: &str| stages.iter().find(|stage| stage.stage == name).map_or(0, |stage| stage.rows);
        // Each kind of light appends its shadow rays to those of the kinds before it.
        let shadow_rays =
            rendered.plan.stages.iter().zip(&stages).filter(|(stage, _)| stage.set == TileSystems::SampleLights);
        let light_rays = shadow_rays.map(|(_, stage)| stage.rows).max().unwrap_or(0);
        let rays = rays_of("Transform rays to world space") + light_rays;
        let tile_side = tile_side.min(rendered.film.tile_side);
        let row_bytes: usize = rendered.plan.columns.iter().map(|column| column.bytes_a_row()).sum();
        let left_out = rendered.plan.rows.iter().filter(|row| !row.kept);
        Self {
            chapter: chapter.into(),
            width: rendered.film.width,
            height: rendered.film.height,
            threads: rendered.threads,
            milliseconds: milliseconds(rendered.time),
            // Where nothing was left to do, no time passed.
            megarays_a_second: if rendered.time.is_zero() {
                0.0
            } else {
                rays as f64 / rendered.time.as_secs_f64() / 1e6
            },
            rays,
            film_bytes: rendered.film.bytes(),
            film_bytes_a_pixel: rendered.film.bytes() as f64 / pixels,
            table_bytes: rendered.table_bytes,
            column_bytes_a_tile: row_bytes * (tile_side * tile_side) as usize,
            peak_memory_bytes: peak_memory(),
            rejected_samples: rendered.film.rejected().0,
            left_out: left_out.map(|row| (row.stage.to_string(), row.reason.clone())).collect(),
            stages,
        }
    }
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

impl fmt::Display for RenderStats {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<34} {:>9} {:>9} {:>11}", "what ran", "rows", "ms", "ns a row")?;
        for stage in &self.stages {
            let each = stage.nanoseconds_a_row.map_or_else(|| "-".into(), |each| format!("{each:.2}"));
            writeln!(f, "  {:<32} {:>9} {:>9.2} {:>11}", stage.stage, stage.rows, stage.milliseconds, each)?;
        }
        writeln!(f, "what was left out, and why")?;
        for (stage, reason) in &self.left_out {
            writeln!(f, "  {stage:<32} {reason}")?;
        }
        if self.left_out.is_empty() {
            writeln!(f, "  nothing: this scene needs every stage on offer")?;
        }
        writeln!(
            f,
            "{} × {} pixels, {} rays in {:.0} ms on {} threads ({:.1} million rays a second)",
            self.width, self.height, self.rays, self.milliseconds, self.threads, self.megarays_a_second
        )?;
        let peak =
            self.peak_memory_bytes.map_or_else(String::new, |peak| format!(", {} MiB at most in all", peak >> 20));
        writeln!(
            f,
            "memory: film {} KiB ({:.1} bytes a pixel), tables {} bytes, columns {} KiB a worker{peak}",
            self.film_bytes >> 10,
            self.film_bytes_a_pixel,
            self.table_bytes,
            self.column_bytes_a_tile >> 10
        )
    }
}
