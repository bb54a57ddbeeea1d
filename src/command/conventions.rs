use super::arguments::CompareConventions;
use super::interrupt::Waiting;
use super::subject::Subject;
use crate::chapter::{Asked, Chapter};
use crate::extract::validate;
use crate::film::{check_place, write_png};
use crate::look::convention::{Mistake, PlacedCamera, Program, back, lines, round_trip};
use crate::render::{Execution, render};
use crate::{Error, Result};
use bevy_ecs::prelude::World;
use std::io::Write;
use std::path::Path;

/// A scene's camera in the words of other programs, a picture of a mistake, or how exact the words are.
pub fn print_conventions(chapters: &[Chapter], asked: &CompareConventions, out: &mut dyn Write) -> Result {
    let subject = Subject::find(chapters, &asked.chapter)?;
    let size = Asked { size: asked.size, ..Asked::default() };
    let scene = subject.world(&size);
    validate(&scene).map_err(|refusal| subject.placed(refusal.into(), &size))?;
    match (asked.mistake, asked.round_trips) {
        (Some(mistake), _) => render_mistake(&subject, scene, mistake, asked, out),
        (None, Some(cameras)) => print_round_trips(cameras, out),
        (None, None) => print_lines(&subject, &PlacedCamera::of(&scene)?, out),
    }
}

fn print_lines(subject: &Subject<'_>, camera: &PlacedCamera, out: &mut dyn Write) -> Result {
    writeln!(out, "camera of {}, {} x {} pixels", subject.name(), camera.image.width, camera.image.height)?;
    for program in Program::ALL {
        writeln!(out, "\n{program}")?;
        for line in lines(program, camera) {
            writeln!(out, "    {line}")?;
        }
        let [wide, place] = back(program);
        writeln!(out, "  back: {wide};\n        {place}")?;
    }
    Ok(())
}

fn print_round_trips(cameras: u64, out: &mut dyn Write) -> Result {
    writeln!(out, "{cameras} cameras there and back; ε = 2^-52")?;
    writeln!(out, "{:<32} {:>8} {:>14} {:>16}", "", "moved", "other tangent", "worst tangent")?;
    for program in Program::ALL {
        let trip = round_trip(program, cameras);
        writeln!(out, "{:<32} {:>8} {:>14} {:>14.1} ε", program.to_string(), trip.moved, trip.widened, trip.worst)?;
    }
    Ok(())
}

/// The picture of a scene after a mistake.
fn render_mistake(
    subject: &Subject<'_>,
    mut scene: World,
    mistake: Mistake,
    asked: &CompareConventions,
    out: &mut dyn Write,
) -> Result {
    let in_out = || Path::new("out").join(format!("{}_{mistake}.png", subject.stem()));
    let file = asked.output.clone().unwrap_or_else(in_out);
    if file.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("png")) {
        return Err(Error::CommandLine(format!("cannot write {}: the name must end in .png", file.display())));
    }
    check_place(&file)?;
    mistake.commit(&mut scene)?;
    let rendered = render(&scene, &subject.stages(), &Execution::default(), &Waiting::new(0, true))?;
    write_png(&rendered.film, rendered.curve(), &file)?;
    writeln!(out, "{mistake}: {}", mistake.made_by())?;
    writeln!(out, "wrote {}", file.display())?;
    Ok(())
}
