use super::arguments::ExportScene;
use super::called::{called, quoted};
use super::find::is_scene_file;
use super::subject::Subject;
use crate::chapter::{Asked, Chapter};
use crate::film::write_whole;
use crate::scene::{Environment, ImageTexture, SceneFolder, scene_text};
use crate::{Error, Result};
use bevy_ecs::prelude::World;
use std::io::Write;
use std::path::Path;

/// Writes a scene as a scene file; prints it where no file is named.
///
/// A chapter that shows a column exports the `view` that asks for it, so that the file shows the same picture; a column
/// of its own it leaves out, and says so.
///
/// Errors: a file of that name is there already, for it may have been edited.
pub fn export(chapters: &[Chapter], asked: &ExportScene, out: &mut dyn Write) -> Result {
    let subject = Subject::find(chapters, &asked.chapter)?;
    let mut world = subject.world(&Asked { sampling: asked.sampling.asked(), ..Asked::default() });
    let note = subject.own_view(&mut world).map_or(String::new(), |column| {
        format!(
            "// {} shows `{column}`, a column of its own, which no scene file has: here is its picture.\n",
            subject.name()
        )
    });
    let Some(file) = &asked.output else {
        write!(out, "{}{note}{}", head("scene.ron"), scene_text(&world)?)?;
        return Ok(());
    };
    name_images_from(&mut world, file);
    let scene = note + &scene_text(&world)?;
    let shown = file.display();
    if !is_scene_file(file) {
        return Err(Error::Usage(format!("cannot write {shown}: the name must end in .ron")));
    }
    if file.is_file() {
        let what = "it is there already and may have been edited; move it away, or choose another name";
        return Err(Error::Usage(format!("cannot write {shown}: {what}")));
    }
    let text = format!("{}{scene}", head(&shown.to_string()));
    write_whole(file, |file| file.write_all(text.as_bytes()))?;
    writeln!(out, "wrote {shown}")?;
    Ok(())
}

/// Names the scene's images by their whole paths where the file will lie in another folder than they are named from.
fn name_images_from(world: &mut World, file: &Path) {
    let here = SceneFolder::path_of(world, "");
    let there = file.parent().unwrap_or(Path::new(""));
    if here == there {
        return;
    }
    let whole = |name: &str| {
        let path = std::path::absolute(here.join(name)).unwrap_or_else(|_| name.into());
        path.to_string_lossy().into_owned()
    };
    for mut image in world.query::<&mut ImageTexture>().iter_mut(world) {
        image.file = whole(&image.file);
    }
    for mut environment in world.query::<&mut Environment>().iter_mut(world) {
        environment.file = whole(&environment.file);
    }
}

/// The comment at the head of a file: what it is, and how it is used.
fn head(file: &str) -> String {
    let stem = Path::new(file).file_stem().map_or("scene".into(), |stem| stem.to_string_lossy());
    let (file, called) = (quoted(file), called(""));
    format!(
        "// A scene for pinhole: a list of entities, and of each what it is made of. What is left out has its default.\n\
         // {called} render {file}            renders it to out/{stem}.png and out/{stem}.exr\n\
         // {called} render {file} --watch    renders it again at every save\n\
         // {called} plan {file}              says which stages it needs, and why\n"
    )
}
