//! The report's runs as CSV: a line a run.

use super::ladder::Ladder;
use super::run::Run;
use super::runner::{Runs, Variant};
use super::sum_up::Measured;
use std::fmt::Write;

/// A line a run, under one that names the columns.
pub fn csv(variants: &[Variant<'_>], ladder: &Ladder, runs: &Runs, measured: &[Measured]) -> String {
    let mut text = String::from(
        "variant,samples,seed,mse,mse_less_v_ref,rel_mse,trimmed_rel_mse,mae,largest,tail_fraction,nan,plus_infinite,\
         minus_infinite,negative,rejected,wall_s,cpu_s,build_s,render_cpu_s\n",
    );
    for (own, (variant, measured)) in variants.iter().zip(measured).enumerate() {
        for (level, runs) in runs.levels[own].iter().enumerate() {
            let debiased = measured.curve.levels[level].ensemble.mse_of_runs();
            for (run, Run { times, rejected, .. }) in runs.iter().enumerate() {
                let each = &measured.deviations[level][run];
                let [nan, plus, minus, negative] = each.odd;
                let _ = writeln!(
                    text,
                    "{},{},{},{:e},{:e},{:e},{:e},{:e},{:e},{:e},{nan},{plus},{minus},{negative},{rejected},{:e},{:e},{:e},{:e}",
                    quoted(&variant.name),
                    ladder.samples[level],
                    ladder.seed(level, run as u32),
                    each.mse,
                    debiased[run],
                    each.rel_mse,
                    each.trimmed_rel_mse,
                    each.mae,
                    each.largest,
                    each.tail_fraction,
                    times.wall,
                    times.cpu,
                    times.build,
                    times.render()
                );
            }
        }
    }
    text
}

/// A field as RFC 4180 has it.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.into() }
}
