//! The pictures of a report: images at equal time, and where each is wrong.

use super::runner::{Runs, Variant};
use super::sum_up::Measured;
use super::summary::Report;
use super::table::short;
use crate::measure::extremes_page::{Picture, Strip};
use crate::measure::image_error::Numbers;
use pinhole::film::Curve;

/// Pictures side by side.
pub type Shown = Strip;

/// The fraction of an error picture's numbers that its white leaves room for.
const SHOWN_FRACTION: f64 = 0.995;

/// The last level of each variant that is done in the time that all of them have, then every level of the first.
pub fn pictures(report: &Report, variants: &[Variant<'_>], runs: &Runs, measured: &[Measured]) -> Vec<Shown> {
    let time = |own: usize, level: usize| report.variants[own].levels[level].render.median.value;
    let last = report.ladder.samples.len() - 1;
    let common = (0..variants.len()).map(|own| time(own, last)).fold(f64::INFINITY, f64::min);
    let in_time = |own: usize| (0..=last).rev().find(|&level| time(own, level) <= 1.02 * common).unwrap_or(0);
    // All error pictures of a strip have one white, or they could not be compared.
    let strip = |title: String, says: &str, chosen: Vec<(usize, usize)>| {
        let errors: Vec<Numbers> = chosen
            .iter()
            .map(|&(own, level)| error(&runs.levels[own][level][0].image, &measured[own].reference.mean))
            .collect();
        let white = white(errors.first());
        let mut pictures = Vec::new();
        for (&(own, level), error) in chosen.iter().zip(&errors) {
            let summary = &report.variants[own].levels[level];
            let name = format!(
                "{}, {} samples, {} ms",
                report.variants[own].name,
                summary.samples,
                short(1e3 * summary.render.median.value)
            );
            pictures.push((name, picture(&runs.levels[own][level][0].image, 1.0, Curve::Srgb)));
            let name = format!("its error, white at {}", short(white));
            pictures.push((name, picture(error, 1.0 / white, Curve::Straight)));
        }
        Shown { title, says: says.into(), pictures }
    };
    let mut strips = Vec::new();
    if variants.len() > 1 {
        let chosen = (0..variants.len()).map(|own| (own, in_time(own))).collect();
        let title = format!("At equal time: what each has done after {} ms", short(1e3 * common));
        strips.push(strip(title, "Errors are |x − r|, on one scale.", chosen));
    }
    let mut of_first = strip(
        format!("{}, from few samples to many", report.variants[0].name),
        "Errors are |x − r|, on the scale of the first.",
        (0..=last).map(|level| (0, level)).collect(),
    );
    of_first.pictures.push(("the reference".into(), picture(&measured[0].reference.mean, 1.0, Curve::Srgb)));
    strips.push(of_first);
    strips
}

/// |x − r|.
fn error(image: &Numbers, reference: &Numbers) -> Numbers {
    let pixels = image.pixels.iter().zip(&reference.pixels);
    let pixels = pixels.map(|(x, r)| [0, 1, 2].map(|part| (x[part] - r[part]).abs())).collect();
    Numbers { size: image.size, pixels, white: None }
}

/// The number that all but a few of an error picture's lie below.
fn white(error: Option<&Numbers>) -> f64 {
    let mut values: Vec<f64> = error.iter().flat_map(|error| error.pixels.iter().flatten().copied()).collect();
    values.sort_by(f64::total_cmp);
    let at = (SHOWN_FRACTION * values.len() as f64) as usize;
    values.get(at.min(values.len().saturating_sub(1))).copied().filter(|white| *white > 0.0).unwrap_or(1.0)
}

fn picture(image: &Numbers, scale: f64, curve: Curve) -> Picture {
    let pixels = image.pixels.iter().map(|pixel| pixel.map(|part| (scale * part) as f32)).collect();
    Picture { width: image.size[0], pixels, curve }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_picture_is_black_where_all_is_right_and_white_where_it_is_most_wrong() {
        let grey = |values: &[f64]| Numbers {
            size: [values.len() as u32, 1],
            pixels: values.iter().map(|value| [*value; 3]).collect(),
            white: None,
        };
        let error = error(&grey(&[1.0, 0.5, 3.0]), &grey(&[1.0, 1.0, 1.0]));
        assert_eq!(error.pixels, [[0.0; 3], [0.5; 3], [2.0; 3]]);
        let white = white(Some(&error));
        assert_eq!(picture(&error, 1.0 / white, Curve::Straight).pixels, [[0.0; 3], [0.25; 3], [1.0; 3]]);
    }
}
