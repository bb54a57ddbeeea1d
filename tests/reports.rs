//! Each chapter's kept report was measured with the sources as they are, and is small.

use pinhole_cli::command::has_report;
use pinhole_lab::report::kept::{LARGEST, kept, made_from, place};
use std::fs;
use std::path::Path;

#[test]
fn reports_are_of_the_present_sources() {
    let (mut wrong, mut looked) = (Vec::new(), 0);
    for chapter in chapters::all().iter().filter(|chapter| has_report(chapter)) {
        looked += 1;
        let short = place(chapter.name).display().to_string();
        let bytes = fs::metadata(Path::new(env!("CARGO_MANIFEST_DIR")).join(&short)).map_or(0, |file| file.len());
        match kept(chapter.name) {
            Err(missing) => wrong.push(missing.to_string()),
            Ok(report) if report.made_from != made_from(chapter.name).expect("the sources are here") => {
                wrong.push(format!("{short} was measured with other sources than the present ones"));
            }
            Ok(report) => assert!(report.name == chapter.name && bytes <= LARGEST as u64, "{short}: {bytes} bytes"),
        }
    }
    assert!(
        wrong.is_empty(),
        "{};\nto measure anew, on a quiet machine: cargo run --release -- report all --write",
        wrong.join(",\n")
    );
    eprintln!("reports: {looked} kept reports are of the present sources");
}
