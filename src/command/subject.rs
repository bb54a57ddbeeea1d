use super::chapter_text::ChapterText;
use super::error::{Error, Result};
use super::export_model::fit_names;
use super::find;
use super::interrupt::interrupted;
use bevy_ecs::prelude::*;
use pinhole::extract::{camera_entity, validate};
use pinhole::plan::{Census, PlanError, Stage};
use pinhole::scene::{FileProblem, ModelScene, SceneFile, View, in_words_of_files, is_model_file};
use pinhole::{Chapter, Overrides, stages};
use std::borrow::Cow;
use std::ffi::OsStr;
use std::path::Path;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// How long to wait for standard input before Ctrl-C is asked about.
const PAUSE: Duration = Duration::from_millis(100);

/// What a reader names: a chapter, or a scene file.
#[derive(Clone)]
pub enum Subject<'c> {
    /// A chapter, with the stages that it offers.
    Chapter(Cow<'c, Chapter>),
    /// A scene file, for which every stage of pinhole is on offer.
    File {
        /// The scene.
        file: SceneFile,
        /// The path as it was typed.
        typed: String,
    },
    /// A model file, with a camera and lights where it has none.
    Model {
        /// The scene made of it.
        model: ModelScene,
        /// The path as it was typed.
        typed: String,
    },
}

impl<'c> Subject<'c> {
    /// The scene file that a path ending in `.ron` names, or `-` for one on standard input, or the chapter that any other
    /// word does.
    pub fn find(chapters: &'c [Chapter], asked: impl AsRef<OsStr>) -> Result<Self> {
        let asked = asked.as_ref();
        let typed = || asked.to_string_lossy().into_owned();
        if find::is_scene_file(asked) {
            Ok(Self::File { file: SceneFile::open(Path::new(asked))?, typed: typed() })
        } else if is_model_file(Path::new(asked)) {
            Ok(Self::Model { model: ModelScene::open(Path::new(asked))?, typed: typed() })
        } else if asked == "-" {
            Ok(Self::File { file: from_standard_input()?, typed: typed() })
        } else {
            Ok(Self::Chapter(Cow::Borrowed(find::chapter(chapters, asked)?)))
        }
    }

    /// The same with other values, each as in `camera.perspective_camera.fov=62`.
    ///
    /// Errors: one sentence about the first that cannot be set.
    pub fn set(self, settings: &[String]) -> Result<Self> {
        match self {
            same if settings.is_empty() => Ok(same),
            Self::Chapter(chapter) => Ok(Self::Chapter(Cow::Owned(ChapterText::of(&chapter)?.set(settings)?))),
            Self::File { mut file, typed } => {
                for setting in settings {
                    file = file.set(setting).map_err(Error::usage)?;
                }
                Ok(Self::File { file, typed })
            }
            Self::Model { mut model, typed } => {
                for setting in settings {
                    model = set_on_model(model, &typed, setting)?;
                }
                Ok(Self::Model { model, typed })
            }
        }
    }

    /// The same without what it borrows.
    pub fn owned(self) -> Subject<'static> {
        match self {
            Self::Chapter(chapter) => Subject::Chapter(Cow::Owned(chapter.into_owned())),
            Self::File { file, typed } => Subject::File { file, typed },
            Self::Model { model, typed } => Subject::Model { model, typed },
        }
    }

    /// What a reader types to name it again.
    pub fn name(&self) -> &str {
        match self {
            Self::Chapter(chapter) => chapter.name,
            Self::File { typed, .. } | Self::Model { typed, .. } => typed,
        }
    }

    /// The same as it is printed.
    pub fn shown(&self) -> String {
        match self.name() {
            "-" => "the scene on standard input".into(),
            name => find::shown(name.as_ref()),
        }
    }

    /// What its pictures are called.
    pub fn stem(&self) -> String {
        match self {
            Self::Chapter(chapter) => chapter.name.into(),
            Self::File { typed, .. } if typed == "-" => "scene".into(),
            Self::File { file: SceneFile { path, .. }, .. } | Self::Model { model: ModelScene { path, .. }, .. } => {
                path.file_stem().map_or("scene".into(), |stem| stem.to_string_lossy().into_owned())
            }
        }
    }

    /// What it is about, in a few words.
    pub fn title(&self) -> &str {
        match self {
            Self::Chapter(chapter) => chapter.title,
            Self::File { .. } => "a scene file",
            Self::Model { .. } => "a model file",
        }
    }

    /// The stages on offer, with those that every chapter has.
    pub fn stages(&self) -> Vec<Stage> {
        match self {
            Self::Chapter(chapter) => chapter.stages(),
            Self::File { .. } | Self::Model { .. } => every_stage().stages(),
        }
    }

    /// The scene, with what a reader asks of it.
    pub fn world(&self, asked: &Overrides) -> World {
        match self {
            Self::Chapter(chapter) => chapter.world(asked),
            Self::File { file, .. } => {
                let mut world = file.world();
                asked.put_on_camera(&mut world);
                world
            }
            Self::Model { model, .. } => {
                let mut world = model.world();
                fit_names(&mut world);
                asked.put_on_camera(&mut world);
                world
            }
        }
    }

    /// What is said of the scene in the words that its author uses: those of files, unless it is a chapter.
    pub fn in_its_words(&self, sentence: String) -> String {
        if let Self::Chapter(_) = self { sentence } else { in_words_of_files(&sentence) }
    }

    /// The same error with file, line and column, where it is the file that is at fault.
    pub fn placed(&self, error: pinhole::Error, asked: &Overrides) -> Error {
        let Self::File { file, .. } = self else { return error.into() };
        let place = match &error {
            pinhole::Error::SceneError(scene_error) if asked.sets_resolution() && scene_error.field == "resolution" => {
                return error.into();
            }
            pinhole::Error::SceneError(_) => file.place_of(|world| {
                asked.put_on_camera(world);
                validate(&Census::of(world)).err()
            }),
            pinhole::Error::Plan(PlanError::NoSuchView { .. }) if asked.view.is_none() => file.place_of_word("view"),
            _ => return error.into(),
        };
        FileProblem { path: file.path.clone(), place, what: in_words_of_files(&error.to_string()) }.into()
    }
}

/// A model with what a setting says: a factor of its picture's light, or that its single-sided materials are so.
fn set_on_model(model: ModelScene, typed: &str, setting: &str) -> Result<ModelScene> {
    let shown = |written: &str| find::shown(written.as_ref());
    let what = match setting.trim().split_once('=').map(|(field, written)| (field, written.trim())) {
        Some(("exposure", written)) => match written.parse::<f64>() {
            Ok(factor) if (1e-30..=1e30).contains(&factor) => return Ok(model.with_exposure(factor)),
            _ => format!("the exposure is {}, but it must be a number from 1e-30 to 1e30", shown(written)),
        },
        Some(("single_sided", written)) => match written.parse() {
            Ok(single_sided) => return Ok(ModelScene { single_sided, ..model }),
            Err(_) => format!("single_sided is {}, but it must be true or false", shown(written)),
        },
        Some(("shutter", written)) => match written.parse::<f64>() {
            Ok(shutter) if (0.0..=1e6).contains(&shutter) => return Ok(ModelScene { shutter, ..model }),
            _ => format!("the shutter is {}, but it must be a time in seconds from 0 to 1e6", shown(written)),
        },
        Some(("animation", written)) => return Ok(ModelScene { animation: written.into(), ..model }),
        _ => format!(
            "{typed} is a model file, which has no values to set but its exposure, as in exposure=1, whether backs of \
             its single-sided materials are left out, as in single_sided=true, which animation a film shows, as in \
             animation=walk, and how long its shutter is open, as in shutter=0.02: `export` makes a scene file of it"
        ),
    };
    Err(Error::CommandLine(what))
}

/// Takes away the view of a column that scene files are not offered, and names it.
pub fn own_view(world: &mut World) -> Option<String> {
    let camera = camera_entity(world).ok()?;
    let View { column } = world.get::<View>(camera)?.clone();
    let offered = every_stage().offer.iter().flat_map(|stage| stage.writes.clone()).any(|kind| kind.name == column);
    if offered {
        return None;
    }
    world.entity_mut(camera).remove::<View>();
    Some(column)
}

/// The scene on standard input, whose end Ctrl-C does not have to wait for.
fn from_standard_input() -> Result<SceneFile> {
    let (send, receive) = channel();
    thread::spawn(move || send.send(SceneFile::read(Path::new("standard input"), std::io::stdin().lock())));
    loop {
        match receive.recv_timeout(PAUSE) {
            Ok(file) => return Ok(file?),
            Err(_) if interrupted() => return Err(pinhole::Error::Interrupted.into()),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(FileProblem::of(Path::new("standard input"), "it cannot be read").into());
            }
        }
    }
}

/// What a scene file is offered: all that the chapters teach.
pub fn every_stage() -> Chapter {
    Chapter::new("scene", "a scene file", |_| ()).offer(stages::all())
}
