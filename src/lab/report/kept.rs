//! A chapter's report as it is kept beside the chapter: the curve with its intervals, in `report.json`.

use super::summary::Report;
use pinhole::film::write_whole;
use pinhole::scene::{FileKind, read_file};
use pinhole::{Error, Result};
use serde_json::Value;
use std::io::Write;
use std::path::{Path, PathBuf};

const REPORT: FileKind = FileKind { name: "a report", max: 64 << 20 };

/// The most bytes that a kept report may have.
pub const LARGEST: usize = 20 * 1024;

/// Where a chapter's report is kept, from the repository's root.
pub fn place(chapter: &str) -> PathBuf {
    Path::new("chapters").join(chapter).join("report.json")
}

/// Keeps a chapter's report.
///
/// Errors: a report of more than 20 KiB, or a file that cannot be written.
pub fn keep(report: &Report) -> Result {
    let mut curves = report.clone();
    // What the stages cost stands in costs.txt already.
    curves.variants.iter_mut().for_each(|variant| variant.stages.clear());
    let mut value = serde_json::to_value(curves).map_err(std::io::Error::from)?;
    round(&mut value);
    let text = format!("{value}\n");
    if text.len() > LARGEST {
        let (bytes, name) = (text.len(), &report.name);
        let what = format!("the report of {name} has {bytes} bytes, more than the {LARGEST} that are kept");
        return Err(Error::Usage(format!("{what}; compare with fewer variants")));
    }
    let file = crate::repository().join(place(&report.name));
    write_whole(&file, |file| file.write_all(text.as_bytes()))
}

/// Five digits are more than any interval leaves.
fn round(value: &mut Value) {
    match value {
        Value::Number(number) if number.is_f64() => {
            let short = number.as_f64().and_then(|number| format!("{number:.4e}").parse::<f64>().ok());
            *value = short.and_then(serde_json::Number::from_f64).map_or(Value::Null, Value::Number);
        }
        Value::Array(values) => values.iter_mut().for_each(round),
        Value::Object(fields) => fields.values_mut().for_each(round),
        _ => {}
    }
}

/// Reads what is kept.
///
/// Errors: nothing is kept, or it is no report.
pub fn kept(chapter: &str) -> Result<Report> {
    let short = place(chapter);
    let text = read_file(&crate::repository().join(&short), REPORT);
    let make = format!("measure {chapter}");
    let text = text.map_err(|_| Error::Usage(format!("no report of {chapter} is kept; `{make}` measures one")))?;
    let wrong = |_| Error::Usage(format!("{} is no report of this version; `{make}` measures one", short.display()));
    serde_json::from_slice(&text).map_err(wrong)
}
