use super::options::SceneOptions;
use super::subject::Subject;
use crate::Result;
use crate::review::plan_text;
use std::io::Write;

/// The plan of a scene.
pub fn print_plan(subject: &Subject<'_>, options: &SceneOptions, out: &mut dyn Write) -> Result {
    let asked = options.asked(false);
    let text = plan_text(subject.name(), subject.title(), &subject.world(&asked), &subject.stages());
    write!(out, "{}", text.map_err(|error| subject.placed(error, &asked))?)?;
    Ok(())
}
