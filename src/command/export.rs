use super::arguments::ExportScene;
use super::called::{called, quoted};
use super::error::{Error, Result};
use super::export_images::{carry_images, name_images_whole};
use super::export_meshes::{name_models, write_meshes};
use super::export_model::take_models_apart;
use super::find::is_scene_file;
use super::format::{Format, print_json, shown};
use super::streams::Streams;
use super::subject::{Subject, own_view};
use super::visible::visible;
use super::warnings::notes;
use pinhole::film::{Replaces, check_place, write_whole};
use pinhole::plan::Census;
use pinhole::scene::{meshes_in_memory, printable, printable_path, scene_text};
use pinhole::{Chapter, Overrides};
use serde_json::json;
use std::io::Write;
use std::path::Path;

/// Writes a scene as a scene file; prints it where no file is named.
///
/// A chapter that shows a column exports the `view` that asks for it, so that the file shows the same picture; a column
/// of its own it leaves out, and says so.
/// Images that lie elsewhere are copied beside the file, and meshes that a chapter makes are written there, so that its
/// folder can be moved.
/// A model file is taken apart where a file is named: its meshes, materials and images then lie beside the scene file, and
/// every value can be edited; printed, the scene names the model file.
///
/// Errors: a file of that name is there already, for it may have been edited; its name cannot stand in a comment; an image
/// cannot be copied, or a mesh not be written.
pub fn export(chapters: &[Chapter], asked: &ExportScene, format: Format, streams: &mut Streams<'_>) -> Result {
    let subject = Subject::find(chapters, &asked.chapter)?;
    let mut world = subject.world(&Overrides { sampling: asked.sampling.asked(), ..Overrides::default() });
    if !format.is_json() {
        // What cannot be rendered can be exported, and edited.
        notes(&Census::of(&world)).unwrap_or_default().iter().try_for_each(|note| streams.note(note))?;
    }
    let out = &mut *streams.out;
    let note = own_view(&mut world).map_or(String::new(), |column| {
        format!(
            "// {} shows `{column}`, a column of its own, which no scene file has: here is its picture.\n",
            subject.shown()
        )
    });
    let Some(file) = &asked.output else {
        name_models(&mut world, None);
        let mut only_here = name_images_whole(&mut world);
        only_here.extend(meshes_in_memory(&world).into_iter().map(|mesh| mesh.file));
        let embedded: String = only_here
            .iter()
            .map(|name| {
                format!("// {} is in the program only: -o FILE puts a copy beside the file.\n", printable(name, 200))
            })
            .collect();
        let text = format!("{}{note}{embedded}{}", head("scene.ron"), visible(&scene_text(&world)?));
        if format.is_json() {
            return print_json(&json!({ "scene": subject.name(), "scene_file": text }), out);
        }
        write!(out, "{text}")?;
        return Ok(());
    };
    let shown = file.to_string_lossy();
    let refused = |what: &str| Err(Error::CommandLine(format!("cannot write {}: {what}", shown.escape_debug())));
    if shown.contains(char::is_control) {
        return refused("the file's first lines name it, so its path must be without control characters");
    }
    if !is_scene_file(file) {
        return refused("the name must end in .ron");
    }
    if file.symlink_metadata().is_ok_and(|found| !found.is_dir()) {
        return refused("it is there already and may have been edited; move it away, or choose another name");
    }
    check_place(Replaces::Nothing.at(file))?;
    let mut whole = String::new();
    if let Subject::Model { .. } = subject {
        let said = take_models_apart(&mut world);
        whole = said.iter().map(|said| format!("// {}.\n", printable(said, 300))).collect();
    }
    // Whatever no file can hold is refused before anything is written.
    scene_text(&world)?;
    let mut beside = carry_images(&mut world, file)?;
    beside.extend(write_meshes(&mut world, file)?);
    let text = format!("{}{note}{whole}{}", head(&shown), visible(&scene_text(&world)?));
    write_whole(Replaces::Nothing.at(file), |file| file.write_all(text.as_bytes()))?;
    if format.is_json() {
        let files: Vec<String> = std::iter::once(file).chain(beside.iter()).map(|file| self::shown(file)).collect();
        return print_json(&json!({ "files": files }), out);
    }
    writeln!(out, "wrote {}", printable_path(file))?;
    for file in beside {
        writeln!(out, "wrote {}, which it names", printable_path(&file))?;
    }
    Ok(())
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
