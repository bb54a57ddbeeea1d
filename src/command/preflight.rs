use super::arguments::TryPreflight;
use super::subject::{Subject, every_stage};
use crate::chapter::Chapter;
use crate::look::{Preflight, SLIPS, preflight};
use crate::plan::Stage;
use crate::render::{check_film_fits, prepare};
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use std::io::Write;

/// What would be said before a render, a line each; without a subject, of small scenes with something wrong.
///
/// Errors: what the scene of a subject is refused for.
pub fn print_preflight(chapters: &[Chapter], asked: &TryPreflight, out: &mut dyn Write) -> Result {
    if let Some(chapter) = &asked.chapter {
        let subject = Subject::find(chapters, chapter)?;
        let wanted = asked.options.asked(false);
        let told = said(&subject.world(&wanted), &subject.stages()).map_err(|error| subject.placed(error, &wanted))?;
        return print_lines(&told, "", out);
    }
    let stages = every_stage().stages();
    for slip in SLIPS {
        let mut scene = World::new();
        (slip.scene)(&mut scene);
        writeln!(out, "{}", slip.what)?;
        match said(&scene, &stages) {
            Ok(told) => print_lines(&told, "  ", out)?,
            Err(Error::Refusal(refusal)) => writeln!(out, "  refused: {refusal}")?,
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

fn said(scene: &World, stages: &[Stage]) -> Result<Vec<String>> {
    let (plan, tables) = prepare(scene, stages)?;
    check_film_fits(scene, &plan)?;
    preflight(scene, (&plan, &tables), Preflight::default())
}

fn print_lines(told: &[String], indent: &str, out: &mut dyn Write) -> Result {
    if told.is_empty() {
        writeln!(out, "{indent}nothing to say")?;
    }
    for line in told {
        writeln!(out, "{indent}before rendering: {line}")?;
    }
    Ok(())
}
