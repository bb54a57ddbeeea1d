use crate::command::chapter_text::{Held, text_of};
use crate::command::subject::{Subject, every_stage, own_view};
use bevy_ecs::prelude::*;
use pinhole::film::write_whole;
use pinhole::models::glb_of;
use pinhole::plan::Stage;
use pinhole::scene::{FileKind, MODEL_FILE, SceneFile, read_file};
use pinhole::{Chapter, Overrides};
use pinhole_live::Scene;
use std::borrow::Cow;
use std::cell::RefCell;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Where the scene of a chapter or of a model is saved.
const FOLDER: &str = "out";
const SCENE_FILE: FileKind = FileKind { name: "a scene file", most: 16 << 20 };

/// A scene on the page: as it was opened, or as its text was edited since.
pub struct ViewedScene {
    name: String,
    stem: String,
    text: String,
    source: Source,
    home: Rc<Home>,
}

enum Source {
    Chapter(Chapter),
    /// Of a file, or of a text that was edited.
    Other(Subject<'static>),
}

/// What stays the same while the text is edited.
struct Home {
    /// Where it is saved.
    file: PathBuf,
    /// What the file is known to hold; none before it is there.
    saved: RefCell<Option<String>>,
    held: Held,
}

impl ViewedScene {
    /// The scene that a reader names.
    pub fn of(subject: Subject<'_>) -> Self {
        let (name, stem) = (subject.shown(), subject.stem());
        if let Subject::File { file, typed } = subject {
            let text = file.text().to_owned();
            let saved = RefCell::new(Some(text.clone()));
            let home = Home { file: file.path.clone(), saved, held: Held::default() };
            let source = Source::Other(Subject::File { file, typed });
            return Self { name, stem, text, source, home: Rc::new(home) };
        }
        let mut world = subject.world(&Overrides::default());
        let _ = own_view(&mut world);
        let (text, held) = text_of(world);
        let home = Home { file: free_file(&stem), saved: RefCell::default(), held };
        let text = text.unwrap_or_else(|error| format!("// There is no text of this scene: {error}\n"));
        let source = match subject {
            Subject::Chapter(chapter) => Source::Chapter(chapter.into_owned()),
            Subject::Model { model, typed } => Source::Other(Subject::Model { model, typed }),
            Subject::File { file, typed } => Source::Other(Subject::File { file, typed }),
        };
        Self { name, stem, text, source, home: Rc::new(home) }
    }

    fn with_subject<R>(&self, use_it: impl FnOnce(&Subject<'_>) -> R) -> R {
        match &self.source {
            Source::Chapter(chapter) => use_it(&Subject::Chapter(Cow::Borrowed(chapter))),
            Source::Other(subject) => use_it(subject),
        }
    }

    /// Writes what the text names and no file holds.
    fn save_beside(&self) -> Result<(), String> {
        let folder = self.home.file.parent().unwrap_or(Path::new("."));
        let meshes = self.home.held.meshes.iter().map(|mesh| (&mesh.file, glb_of(&mesh.geometry)));
        let files = self.home.held.files.iter().map(|(name, bytes)| (name, Some(bytes.to_vec())));
        for (name, bytes) in meshes.chain(files) {
            let place = folder.join(name);
            let bytes = bytes.ok_or_else(|| format!("{name} cannot be written: it has more than 4 GiB"))?;
            match read_file(&place, MODEL_FILE) {
                Ok(there) if there == bytes => {}
                Ok(_) => return Err(format!("{} is there already, and is another file", place.display())),
                Err(_) => write_whole(&place, |file| file.write_all(&bytes)).map_err(|error| error.to_string())?,
            }
        }
        Ok(())
    }
}

impl Scene for ViewedScene {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn stem(&self) -> String {
        self.stem.clone()
    }

    fn text(&self) -> String {
        self.text.clone()
    }

    fn world(&self) -> World {
        let mut world = self.with_subject(|subject| subject.world(&Overrides::default()));
        if matches!(self.source, Source::Other(Subject::File { .. })) {
            self.home.held.fill_in(&mut world);
        }
        world
    }

    fn stages(&self) -> Vec<Stage> {
        match &self.source {
            Source::Chapter(chapter) => chapter.stages(),
            Source::Other(_) => every_stage().stages(),
        }
    }

    fn explain(&self, error: pinhole::Error) -> String {
        self.with_subject(|subject| subject.placed(error, &Overrides::default()).to_string())
    }

    fn edited(&self, text: String) -> Result<Rc<dyn Scene>, String> {
        let file = SceneFile::parse(&self.home.file, text.clone()).map_err(|problem| problem.to_string())?;
        let source = Source::Other(Subject::File { file, typed: self.home.file.display().to_string() });
        let (name, stem, home) = (self.name.clone(), self.stem.clone(), Rc::clone(&self.home));
        Ok(Rc::new(Self { name, stem, text, source, home }))
    }

    fn save(&self) -> Result<PathBuf, String> {
        let file = &self.home.file;
        let there = read_file(file, SCENE_FILE).ok().map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        if there.is_some() && there != *self.home.saved.borrow() {
            return Err(format!("{} was changed by another program meanwhile, and stays as it is", file.display()));
        }
        self.save_beside()?;
        write_whole(file, |file| file.write_all(self.text.as_bytes())).map_err(|error| error.to_string())?;
        *self.home.saved.borrow_mut() = Some(self.text.clone());
        Ok(file.clone())
    }
}

/// The first name that no file has.
fn free_file(stem: &str) -> PathBuf {
    let file = |number: u32| {
        let name = if number == 1 { format!("{stem}.ron") } else { format!("{stem}-{number}.ron") };
        Path::new(FOLDER).join(name)
    };
    let free = (1..1000).map(file).find(|file| file.symlink_metadata().is_err());
    free.unwrap_or_else(|| file(1000))
}
