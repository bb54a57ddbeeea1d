use super::arguments::CompareImages;
use super::error::{Error, Result};
use super::format::{Format, number_or_word, print_json, shown};
use pinhole::film::write_whole;
use pinhole_lab::measure::image_error::{ImageError, Numbers, Oddities, RELATIVE_FLOOR, image_error};
use pinhole_lab::measure::image_file::{ImageKind, read_numbers};
use pinhole_lab::review::{difference_png, full_white};
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;

/// How far an image is from a reference, and a picture of it if asked for.
///
/// Errors: files that cannot be read or are not of one kind and size; nothing is written then.
pub fn compare(asked: &CompareImages, format: Format, out: &mut dyn Write) -> Result {
    let [reference, image] = [&asked.reference, &asked.image];
    let (kind, other) = (kind_of(reference)?, kind_of(image)?);
    if kind != other {
        let (r, x) = (reference.display(), image.display());
        return Err(Error::usage(format!(
            "cannot compare {r} with {x}: one holds bytes after the curve, the other light"
        )));
    }
    let [reference, image] = [reference, image].map(|file| read_numbers(file).map_err(Error::usage));
    let (reference, image) = (reference?, image?);
    let error = image_error(&reference, &image).map_err(Error::usage)?;
    let scale = match &asked.output {
        Some(file) => Some((file, write_difference(&reference, &image, &error, file)?)),
        None => None,
    };
    if asked.json || format.is_json() {
        return print_json(&as_json(asked, kind, &error, scale.map(|(_, full)| full)), out);
    }
    writeln!(out, "reference r: {}", asked.reference.display())?;
    writeln!(out, "image x:     {}", asked.image.display())?;
    writeln!(out, "numbers:     {}", kind.numbers())?;
    write!(out, "{error}")?;
    if let Some((file, full)) = scale {
        writeln!(
            out,
            "wrote {}: |x − r| × {}; black is none, full white is {full} or more, magenta is not finite",
            file.display(),
            1.0 / full
        )?;
    }
    Ok(())
}

fn kind_of(file: &Path) -> Result<ImageKind> {
    ImageKind::of(file).map_err(Error::usage)
}

/// Writes the difference as a PNG and says which difference is full white.
fn write_difference(reference: &Numbers, image: &Numbers, error: &ImageError, file: &Path) -> Result<f64> {
    if file.extension().is_none_or(|ending| ending != "png") {
        return Err(Error::usage(format!("cannot write {}: the name must end in .png", file.display())));
    }
    let full = full_white(error.means.map_or(0.0, |means| means.largest));
    let png = difference_png(error.size, full, |x, y| {
        let index = y as usize * error.size[0] as usize + x as usize;
        let (r, x) = (reference.pixels[index], image.pixels[index]);
        [0, 1, 2].map(|part| (x[part] - r[part]).abs())
    })?;
    write_whole(file, |out| out.write_all(&png))?;
    Ok(full)
}

/// The same numbers for machines; what is not finite or does not exist is null, and an infinite PSNR is "infinite".
fn as_json(asked: &CompareImages, kind: ImageKind, error: &ImageError, full: Option<f64>) -> Value {
    let odd = |odd: &Oddities| {
        json!({
            "nan": odd.nan, "plus_infinite": odd.plus_infinite, "minus_infinite": odd.minus_infinite,
            "negative": odd.negative,
        })
    };
    let means = error.means.as_ref();
    json!({
        "reference": shown(&asked.reference),
        "image": shown(&asked.image),
        "numbers": kind.numbers(),
        "width": error.size[0],
        "height": error.size[1],
        "pixels_differing": error.differing,
        "pixels_compared": error.compared,
        "pixels_left_out": error.pixels() - error.compared,
        "numbers_compared": 3 * error.compared,
        "mse": means.map(|means| means.mse),
        "rmse": means.map(|means| means.rmse()),
        "rel_mse": means.map(|means| means.rel_mse),
        "rel_mse_formula": format!("mean of (x - r)^2 / (r^2 + {RELATIVE_FLOOR})"),
        "mae": means.map(|means| means.mae),
        "max": means.map(|means| means.largest),
        "max_at": means.map(|means| means.worst),
        "psnr_decibels": error.psnr().map(number_or_word),
        "psnr_peak": error.peak,
        "difference_full_white": full,
        "files": asked.output.iter().map(|file| shown(file)).collect::<Vec<String>>(),
        "not_finite_or_negative": { "reference": odd(&error.oddities[0]), "image": odd(&error.oddities[1]) },
    })
}
