use super::home::{Home, free_file};
use crate::command::chapter_text::{Held, text_beside};
use crate::command::export_model::take_models_apart;
use crate::command::subject::{Subject, every_stage, own_view};
use bevy_ecs::prelude::*;
use pinhole::plan::Stage;
use pinhole::scene::{SceneFile, printable_path};
use pinhole::{Chapter, Overrides};
use pinhole_live::Scene;
use std::borrow::Cow;
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// A scene on the page: as it was opened, or as its text was edited since.
pub struct ViewedScene {
    name: String,
    stem: String,
    text: RefCell<String>,
    source: Source,
    home: Rc<Home>,
}

enum Source {
    Chapter(Chapter),
    /// Of a file, or of a text that was edited.
    Other(Subject<'static>),
}

impl ViewedScene {
    /// The scene that a reader names.
    pub fn of(subject: Subject<'_>) -> Self {
        let (name, stem) = (subject.shown(), subject.stem());
        if let Subject::File { file, typed } = subject {
            let home = Home::of_file(file.path.clone(), file.text());
            let text = RefCell::new(home.on_page(file.text()));
            let source = Source::Other(Subject::File { file, typed });
            return Self { name, stem, text, source, home: Rc::new(home) };
        }
        let mut world = subject.world(&Overrides::default());
        let _ = own_view(&mut world);
        let mut said = Vec::new();
        if let Subject::Model { .. } = subject {
            said = take_models_apart(&mut world);
        }
        let file = free_file(&stem);
        let (text, held) = text_beside(world, file.parent().unwrap_or(Path::new(".")), &stem);
        let home = Home::free(file, stem.clone(), held);
        let said: String = said.iter().map(|said| format!("// {said}.\n")).collect();
        let text = text.unwrap_or_else(|error| format!("// There is no text of this scene: {error}\n"));
        let source = match subject {
            Subject::Chapter(chapter) => Source::Chapter(chapter.into_owned()),
            Subject::Model { model, typed } => Source::Other(Subject::Model { model, typed }),
            Subject::File { file, typed } => Source::Other(Subject::File { file, typed }),
        };
        Self { name, stem, text: RefCell::new(said + &text), source, home: Rc::new(home) }
    }

    fn with_subject<R>(&self, use_it: impl FnOnce(&Subject<'_>) -> R) -> R {
        match &self.source {
            Source::Chapter(chapter) => use_it(&Subject::Chapter(Cow::Borrowed(chapter))),
            Source::Other(subject) => use_it(subject),
        }
    }

    /// What the text names and only the program holds.
    pub fn held(&self) -> &Held {
        &self.home.held
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
        self.text.borrow().clone()
    }

    fn world(&self) -> World {
        let mut world = self.with_subject(|subject| subject.world(&Overrides::default()));
        if matches!(self.source, Source::Other(Subject::File { .. })) {
            self.held().fill_in(&mut world);
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
        let (text, path) = (self.home.on_page(&text), self.home.file());
        let file = SceneFile::parse(&path, text.clone()).map_err(|problem| problem.to_string())?;
        let source = Source::Other(Subject::File { file, typed: printable_path(&path) });
        let (name, stem, home) = (self.name.clone(), self.stem.clone(), Rc::clone(&self.home));
        Ok(Rc::new(Self { name, stem, text: RefCell::new(text), source, home }))
    }

    fn save(&self) -> Result<PathBuf, String> {
        let (file, text) = self.home.save(&self.text())?;
        self.text.replace(text);
        Ok(file)
    }
}
