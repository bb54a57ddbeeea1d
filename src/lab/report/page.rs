//! The report as a page in one file, which fetches nothing.

use super::deviation::RELATIVE_MSE;
use super::pictures::Shown;
use super::plot::{Against, plot};
use super::summary::{LevelSummary, Report, Statistic, VariantSummary};
use super::table::{at_words, short, slope_words, with_ends, with_half, with_percent};
use crate::review::escape;
use std::fmt::Write;
use std::io;

/// The whole page.
///
/// Errors: a picture that cannot be encoded.
pub fn page(report: &Report, shown: &[Shown]) -> io::Result<String> {
    let style = include_str!("page.css");
    let title = format!("Error and time: {}", report.name);
    let mut body = format!("<h1>{} <small>{}</small></h1>\n", escape(&title), escape(&report.title));
    headline(&mut body, report);
    plots(&mut body, report);
    for variant in &report.variants {
        levels(&mut body, variant);
    }
    comparisons(&mut body, report);
    pictures(&mut body, shown)?;
    for variant in &report.variants {
        stages(&mut body, variant);
    }
    reference(&mut body, report);
    provenance(&mut body, report);
    // The policy lets nothing in from anywhere, which a test relies on.
    Ok(format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; \
         style-src 'unsafe-inline'\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<link rel=\"icon\" href=\"data:,\">\n\
         <title>{}</title>\n<style>\n{style}</style>\n</head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n",
        escape(&title)
    ))
}

fn headline(body: &mut String, report: &Report) {
    let ([width, height], ladder) = (report.size, &report.ladder);
    let _ = writeln!(
        body,
        "<p>{width} × {height} pixels; {} seeds at each of {} sample counts; one warm-up run left out; variants in turn; \
         intervals at 95 % unless said otherwise.</p>",
        ladder.seeds,
        ladder.samples.len()
    );
    for variant in &report.variants {
        let _ = writeln!(body, "<p><b>{}</b>: {}.</p>", escape(&variant.name), escape(&slope_words(&variant.slope)));
    }
    for flag in &report.flags {
        let _ = writeln!(body, "<p class=\"flag\">{}</p>", escape(flag));
    }
}

fn plots(body: &mut String, report: &Report) {
    body.push_str("<h2>Error against time, and against samples</h2>\n<div class=\"plots\">\n");
    for against in [Against::Render, Against::Samples, Against::Whole] {
        let _ = writeln!(body, "<figure>{}</figure>", plot(report, against).text);
    }
    body.push_str("</div>\n");
}

/// A table of text cells, escaped.
fn table(body: &mut String, class: &str, head: &[&str], rows: &[Vec<String>]) {
    let _ = write!(body, "<div class=\"wide\"><table class=\"{class}\"><thead><tr>");
    for cell in head {
        let _ = write!(body, "<th>{}</th>", escape(cell));
    }
    body.push_str("</tr></thead><tbody>\n");
    for row in rows {
        let cells: String = row.iter().map(|cell| format!("<td>{}</td>", escape(cell))).collect();
        let _ = writeln!(body, "<tr>{cells}</tr>");
    }
    body.push_str("</tbody></table></div>\n");
}

fn levels(body: &mut String, variant: &VariantSummary) {
    let _ = writeln!(body, "<h2>{}</h2>\n<p class=\"note\">{}</p>", escape(&variant.name), escape(&variant.sampling));
    let head = ["samples", "MSE", "variance", "bias²", "1/(MSE·T)", "render, ms CPU", "MAD", "whole, ms", "wall, ms"];
    let milliseconds = |seconds: f64| short(1e3 * seconds);
    let row = |level: &LevelSummary| {
        vec![
            level.samples.to_string(),
            with_percent(&level.mse),
            with_percent(&level.variance),
            with_half(&level.bias_squared),
            with_percent(&level.efficiency),
            format!("{} ±{:.0}%", milliseconds(level.render.median.value), half_percent(level)),
            milliseconds(level.render.mad),
            milliseconds(level.whole.median.value),
            milliseconds(level.wall),
        ]
    };
    table(body, "", &head, &variant.levels.iter().map(row).collect::<Vec<_>>());
    let head = [
        "samples",
        "relMSE",
        "relMSE, trimmed",
        "MAE",
        "largest",
        "MSE from top 0.1 %",
        "NaN",
        "+Inf",
        "−Inf",
        "negative",
        "rejected",
    ];
    let row = |level: &LevelSummary| {
        let numbers = [level.rel_mse, level.trimmed_rel_mse, level.mae, level.largest];
        let mut row = vec![level.samples.to_string()];
        row.extend(numbers.map(short));
        row.push(format!("{:.1} %", 100.0 * level.tail_fraction));
        row.extend(level.odd.map(|count| count.to_string()));
        row.push(level.rejected.to_string());
        row
    };
    table(body, "", &head, &variant.levels.iter().map(row).collect::<Vec<_>>());
    for level in &variant.levels {
        if let Statistic::Refused(what) = &level.mse {
            let _ = writeln!(body, "<p class=\"flag\">Refused: {}.</p>", escape(what));
        }
    }
}

fn half_percent(level: &LevelSummary) -> f64 {
    let median = level.render.median;
    if median.value > 0.0 { 50.0 * (median.high - median.low) / median.value } else { 0.0 }
}

fn comparisons(body: &mut String, report: &Report) {
    let Some(first) = report.variants.first().filter(|_| !report.comparisons.is_empty()) else { return };
    let _ = writeln!(
        body,
        "<h2>Compared with {}</h2>\n<p class=\"note\">Each interval is at {:.3} %, so that all of them hold together with \
         95 % (Šidák). A ratio whose interval holds 1 says nothing. Equal time is read on straight lines between the \
         levels, in logarithms.</p>",
        escape(&first.name),
        100.0 * report.family_level
    );
    let rows: Vec<Vec<String>> = (report.comparisons.iter())
        .map(|row| {
            let efficiency = row.efficiency.as_ref().map_or_else(|| "–".into(), with_ends);
            vec![row.variant.clone(), at_words(row.at), with_ends(&row.mse), efficiency]
        })
        .collect();
    table(body, "words", &["variant", "at equal", "MSE ratio", "efficiency ratio"], &rows);
}

fn pictures(body: &mut String, shown: &[Shown]) -> io::Result<()> {
    body.push_str("<h2>Images, and where they are wrong</h2>\n");
    for strip in shown {
        let _ = writeln!(body, "<h3>{}</h3>\n<p class=\"note\">{}</p>", escape(&strip.title), escape(&strip.says));
        body.push_str("<div class=\"strip\">\n");
        for (name, picture) in &strip.pictures {
            let (name, url) = (escape(name), picture.url()?);
            let _ =
                writeln!(body, "<figure><img alt=\"{name}\" src=\"{url}\"><figcaption>{name}</figcaption></figure>");
        }
        body.push_str("</div>\n");
    }
    Ok(())
}

fn stages(body: &mut String, variant: &VariantSummary) {
    let _ = writeln!(body, "<h2>Where the time of {} goes</h2>", escape(&variant.name));
    let all: f64 = variant.stages.iter().map(|stage| stage.milliseconds).sum();
    let row = |stage: &super::summary::StageSummary| {
        let each = if stage.rows > 0 { short(1e6 * stage.milliseconds / stage.rows as f64) } else { "–".into() };
        let percent = if all > 0.0 { 100.0 * stage.milliseconds / all } else { 0.0 };
        vec![stage.stage.clone(), stage.rows.to_string(), short(stage.milliseconds), each, format!("{percent:.1} %")]
    };
    let rows: Vec<Vec<String>> = variant.stages.iter().map(row).collect();
    table(body, "", &["stage", "rows", "ms", "ns a row", "of all"], &rows);
    let [camera, shadow] = variant.rays;
    let _ = writeln!(
        body,
        "<p class=\"note\">From one run of 16 samples a pixel with timers, which is no part of the runs above. Rays a \
         sample: {} from the camera, {} towards lights. Light is followed for one depth, from the surface that is seen to \
         the eye; each ray is tested against all {} shapes, for there is no hierarchy.</p>",
        short(camera),
        short(shadow),
        variant.tests_a_ray
    );
}

fn reference(body: &mut String, report: &Report) {
    let ladder = &report.ladder;
    let longest = ladder.samples.last().copied().unwrap_or(0);
    let seeds = [ladder.seeds(), ladder.reference_seeds()].map(|seeds| {
        let [first, last] = [seeds.first(), seeds.last()].map(|seed| seed.copied().unwrap_or(0));
        format!("{first} to {last}")
    });
    let _ = writeln!(
        body,
        "<h2>The reference, and what is subtracted</h2>\n<p class=\"note\">{} independent samples a pixel in {} batches, \
         of seeds {}; runs have seeds {}. The longest run has {:.1} % of its samples. Its own variance V_ref is known from \
         its batches and subtracted from every MSE, which is the mean over pairs of batches A, B of (X − A)(X − B). \
         bias² is the mean of (Xᵢ − A)(Xⱼ − B) over pairs of runs and of batches, so it can come out negative. \
         {}, V_ref's part subtracted; MAE as measured. Trimmed: without the 0.1 % of pixels that add most. A variant of \
         another filter or scene has a reference of its own, as it converges to another image.</p>",
        ladder.reference_samples(),
        ladder.batches,
        seeds[1],
        seeds[0],
        100.0 * f64::from(longest) / ladder.reference_samples() as f64,
        RELATIVE_MSE
    );
    let rows: Vec<Vec<String>> = (report.variants.iter())
        .map(|variant| {
            vec![variant.name.clone(), short(variant.reference_variance), variant.scene.clone(), variant.film.clone()]
        })
        .collect();
    table(body, "words", &["variant", "V_ref", "hash of the scene", "of the film"], &rows);
}

fn provenance(body: &mut String, report: &Report) {
    let provenance = &report.provenance;
    let load = provenance.load.map(|load| load.map_or_else(|| "unknown".into(), |load| format!("{load:.2}")));
    let timers = report.timers.map_or_else(|| "not measured".into(), |timers| with_ends(&Statistic::Value(timers)));
    let rows = [
        ("command", provenance.command.clone()),
        ("day", provenance.date.clone()),
        ("commit", provenance.commit.clone()),
        ("compiler", format!("{}, {}, {}", provenance.rustc, provenance.profile, provenance.target)),
        (
            "machine",
            format!(
                "{}, {} threads; load {} before, {} after",
                provenance.processor, provenance.cores, load[0], load[1]
            ),
        ),
        ("threads of a run", report.threads.to_string()),
        ("time with timers over time without", timers),
        ("precision", "points, sums and statistics in f64, rays in f32".into()),
    ];
    body.push_str("<h2>Where this was measured</h2>\n");
    let rows: Vec<Vec<String>> = rows.map(|(what, value)| vec![what.into(), value]).to_vec();
    table(body, "words", &["", ""], &rows);
}
