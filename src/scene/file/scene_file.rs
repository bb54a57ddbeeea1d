use super::edit::{value_at, with_value, with_view};
use super::found::shown;
use super::mistake::{Mistake, place_of};
use super::read::{FileEntity, read_entity};
use super::refer::resolve;
use super::scan::{entities, fields};
use super::{FileProblem, PlaceInFile};
use crate::{
    ChildOf, Disabled, KeyCurve, Keys, LookAt, Name, SceneError, SceneFolder, SceneTime, Shutter, UsesMaterial,
    load_meshes,
};
use bevy_ecs::prelude::*;
use glam::DVec3;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};

/// Encloses the index of an entity that is named by it: a noncharacter of Unicode, which messages show unescaped.
const MARK: char = '\u{fdd0}';

/// The paths of values that move an entity.
const MOVES: [&str; 2] = ["placement.position", "look_at.eye"];

/// The components that say how the picture is taken, rather than what is in it.
const OF_THE_PICTURE: [&str; 12] = [
    "shutter",
    "resolution",
    "sampling",
    "adaptive",
    "rasterisation",
    "integrator",
    "light_tracing",
    "exposure",
    "tone_mapping",
    "view",
    "layers",
    "statistics",
];

/// Whether the path of a value leads into one of them.
fn is_of_the_picture(path: &str) -> bool {
    path.split('.').next().is_some_and(|word| OF_THE_PICTURE.contains(&word))
}

impl Keys {
    /// Whether they move their entity, by the value of this path.
    fn moves(&self, path: &str) -> bool {
        self.curve != KeyCurve::Step && MOVES.contains(&path) && !self.frames(path).is_empty()
    }
}

fn triple(v: DVec3) -> String {
    format!("({:?}, {:?}, {:?})", v.x, v.y, v.z)
}

/// A scene read from a file, with the position of each of its parts in the file.
#[derive(Clone)]
pub struct SceneFile {
    /// The file's path as it was given.
    pub path: PathBuf,
    text: String,
    entities: Vec<FileEntity>,
    /// The time at which its animated models are shown; none at rest.
    seconds: Option<f64>,
}

impl SceneFile {
    /// Parses a scene from the text of a file.
    ///
    /// Errors: the first mistake in it, with line and column.
    pub fn parse(path: &Path, text: String) -> Result<Self, FileProblem> {
        let read = || -> Result<Vec<FileEntity>, Mistake> {
            let mut read = Vec::new();
            for entity in entities(&text)? {
                read.push(read_entity(&text, &entity)?);
            }
            resolve(&text, &mut read)?;
            Ok(read)
        };
        match read() {
            Ok(entities) => Ok(Self { path: path.into(), text, entities, seconds: None }),
            Err(mistake) => {
                let place = Some(place_of(&text, mistake.at));
                Err(FileProblem { path: path.into(), place, what: mistake.what })
            }
        }
    }

    /// The same scene with another value, written as `camera.perspective_camera.fov=62`: an entity by its name, a
    /// component and its fields by their words, an element of a tuple by its number or as `x`, `y`, `z`.
    ///
    /// What the text leaves out is inserted.
    /// A capitalised word is a variant, as in `camera.integrator.Path.max_depth=3`, and replaces another one.
    ///
    /// Errors: nothing has that name, or the scene is no longer valid with it, in one sentence.
    pub fn set(&self, setting: &str) -> Result<Self, String> {
        let refused = |what| format!("cannot set `{}`: {what}", shown(setting));
        let text = with_value(&self.text, &self.entities, setting).map_err(refused)?;
        Self::parse(&self.path, text).map_err(|problem| refused(problem.what))
    }

    /// The scene at a frame of a film of so many frames in a unit of time, by the [`Keys`] of its entities.
    ///
    /// Its camera's [`Shutter`] opens and closes later by the time of the frame.
    /// What moves by keys while the shutter is open, by `placement.position` or `look_at.eye`, gets the [`Motion`](crate::Motion) that it
    /// has on average from the moment when it opens to that when it closes, unless its curve is
    /// [`Step`](crate::KeyCurve::Step).
    ///
    /// Errors: a key sets what cannot be set, in one sentence.
    pub fn at(&self, frame: f64, rate: f64) -> Result<Self, String> {
        let shutter = self.shutter_at(frame)?;
        self.keyed([frame, rate], 0.0, shutter.map_or(0.0, |shutter| shutter.open), shutter)
    }

    /// The scene at one of so many moments of a frame, from 0 on: the time while its shutter is open is divided into as many
    /// equal stretches, and the shutter is open for one of them.
    ///
    /// Everything has the value of the middle of its stretch, but the settings of the picture, such as its number of
    /// samples, have that of the frame.
    /// What moves by `placement.position` or `look_at.eye` moves meanwhile, as at a [frame](Self::at); where it is `frozen`,
    /// the shutter is open for the middle alone.
    ///
    /// Errors: as for a [frame](Self::at).
    pub fn at_moment(&self, frame: f64, rate: f64, [number, of]: [u32; 2], frozen: bool) -> Result<Self, String> {
        let Shutter { open, close } = self.shutter_at(frame)?.unwrap_or(Shutter { open: 0.0, close: 0.0 });
        let time = |half: f64| open + (close - open) * (half / (2.0 * f64::from(of)));
        let [begins, middle, ends] = [0.0, 1.0, 2.0].map(|half| time(2.0 * f64::from(number) + half));
        let [open, close] = if frozen { [middle; 2] } else { [begins, ends] };
        self.keyed([frame, rate], middle, middle, Some(Shutter { open, close }))
    }

    /// How long the shutter is open at a frame, in units of time; 0 without one.
    ///
    /// Errors: as for a [frame](Self::at).
    pub fn exposure_time(&self, frame: f64) -> Result<f64, String> {
        Ok(self.shutter_at(frame)?.map_or(0.0, |shutter| shutter.close - shutter.open))
    }

    /// Whether keys change something while the shutter is open that no [`Motion`](crate::Motion) shows: anything but
    /// `placement.position` and `look_at.eye`, and these where they are farther from a straight line at an even speed than
    /// half of one of so many equal stretches.
    ///
    /// Errors: as for a [frame](Self::at).
    pub fn changes(&self, frame: f64, rate: f64, stretches: u32) -> Result<bool, String> {
        let Some(Shutter { open, close }) = self.shutter_at(frame)?.filter(|shutter| shutter.close > shutter.open)
        else {
            return Ok(false);
        };
        let halves = 2 * stretches;
        let fraction = |half: u32| f64::from(half) / f64::from(halves);
        let frames: Vec<f64> =
            (0..=halves).map(|half| frame + rate * (open + (close - open) * fraction(half))).collect();
        let keyed = self.entities.iter().filter_map(|entity| self.component::<Keys>(entity, "keys"));
        for keys in keyed {
            let values: Vec<Vec<(&str, String)>> = frames.iter().map(|frame| keys.at(*frame).collect()).collect();
            for (at, (path, first)) in values[0].iter().enumerate().filter(|(_, (path, _))| !is_of_the_picture(path)) {
                let texts = || values.iter().map(|values| &values[at].1);
                let places: Option<Vec<DVec3>> = texts().map(|text| ron::from_str(text).ok()).collect();
                let is_straight = match places {
                    Some(places) if keys.moves(path) => {
                        let [from, to] = [places[0], places[halves as usize]];
                        let near = (to - from).length() * fraction(1) + 1e-12 * from.abs().max(to.abs()).max_element();
                        (0..).zip(&places).all(|(half, place)| place.distance(from.lerp(to, fraction(half))) <= near)
                    }
                    _ => texts().all(|text| text == first),
                };
                if !is_straight {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// The shutter at a frame, in units of time from that of the frame on.
    fn shutter_at(&self, frame: f64) -> Result<Option<Shutter>, String> {
        let has = |entity: &FileEntity| entity.parts.iter().any(|part| part.word == "shutter");
        let Some(index) = self.entities.iter().position(has) else { return Ok(None) };
        let mut file = self.clone();
        if let (Some(keys), Some(name)) =
            (self.component::<Keys>(&self.entities[index], "keys"), &self.entities[index].name)
        {
            for (path, value) in keys.at(frame).filter(|(path, _)| path.starts_with("shutter")) {
                file = file.set(&format!("{name}.{path}={value}"))?;
            }
        }
        Ok(file.component::<Shutter>(&file.entities[index], "shutter"))
    }

    /// The scene at a frame, with the values of a time from that of the frame on, and with what moves where its motion is at a
    /// reference time while this shutter is open.
    fn keyed(
        &self,
        [frame, rate]: [f64; 2],
        time: f64,
        reference: f64,
        shutter: Option<Shutter>,
    ) -> Result<Self, String> {
        let (now, mut file) = (frame / rate, self.clone());
        for entity in &self.entities {
            let Some(keys) = self.component::<Keys>(entity, "keys") else { continue };
            let Some(name) = &entity.name else {
                return Err("an entity with keys has no name, by which a key sets its value".into());
            };
            let (of_the_frame, of_the_time) = (keys.at(frame), keys.at(frame + time * rate));
            for ((path, of_the_frame), (_, of_the_time)) in of_the_frame.zip(of_the_time) {
                let value = if is_of_the_picture(path) { of_the_frame } else { of_the_time };
                file = file.set(&format!("{name}.{path}={value}"))?;
            }
            for path in MOVES.into_iter().filter(|path| keys.moves(path)) {
                let open = shutter.filter(|shutter| shutter.close > shutter.open);
                let Some(Shutter { open, close }) = open else { continue };
                let there = |time: f64| {
                    let value = keys.at(frame + time * rate).find(|(own, _)| *own == path)?.1;
                    ron::from_str::<DVec3>(&value).ok()
                };
                let (Some(from), Some(to)) = (there(open), there(close)) else { continue };
                let velocity = (to - from) / (close - open);
                if velocity == DVec3::ZERO {
                    continue;
                }
                // What has a motion is placed as it would be at time 0, and what a camera looks at goes with it.
                let back = -velocity * (now + reference);
                let from = from + velocity * (reference - open);
                file = file.set(&format!("{name}.{path}={}", triple(from + back)))?;
                file = file.set(&format!("{name}.motion.velocity={}", triple(velocity)))?;
                if path == "look_at.eye" {
                    let target = file.value(&format!("{name}.look_at.target"))?;
                    let target = ron::from_str::<DVec3>(&target).map_err(|error| error.to_string())?;
                    file = file.set(&format!("{name}.look_at.target={}", triple(target + back)))?;
                }
            }
        }
        if let (Some(Shutter { open, close }), Some(name)) = (shutter, self.name_of_shutter()) {
            file = file.set(&format!("{name}.shutter.open={:?}", open + now))?;
            file = file.set(&format!("{name}.shutter.close={:?}", close + now))?;
        }
        file.seconds = Some(now + time);
        Ok(file)
    }

    /// Whether anything in it may change with time: what has keys, and models, which may be animated.
    pub fn may_change(&self) -> bool {
        let changes = |entity: &FileEntity| entity.parts.iter().any(|part| ["keys", "mesh"].contains(&&*part.word));
        self.entities.iter().any(changes)
    }

    fn name_of_shutter(&self) -> Option<&str> {
        let has = |entity: &&FileEntity| entity.parts.iter().any(|part| part.word == "shutter");
        self.entities.iter().find(has)?.name.as_deref()
    }

    /// A component of an entity, as the text has it.
    fn component<C: DeserializeOwned>(&self, entity: &FileEntity, word: &str) -> Option<C> {
        let part = entity.parts.iter().find(|part| part.word == word)?;
        ron::from_str(&self.text[part.value.clone()]).ok()
    }

    /// The same scene with its camera elsewhere: at an eye, looking at a target, and with this height of view where it is
    /// orthographic.
    ///
    /// Errors: the file has no camera, or one that a parent or a motion carries, in one sentence.
    pub fn with_view(&self, view: &LookAt, view_height: f64) -> Result<Self, String> {
        let refused = |what| format!("the view cannot be put into the text: {what}");
        let text = with_view(&self.text, &self.entities, view, view_height).map_err(refused)?;
        Self::parse(&self.path, text).map_err(|problem| refused(problem.what))
    }

    /// The text of a value that [`set`](Self::set) could set, or that of its default.
    ///
    /// Errors: nothing has that name, in one sentence.
    pub fn value(&self, path: &str) -> Result<String, String> {
        value_at(&self.text, &self.entities, path)
    }

    /// The text that it was read from.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The number of entities in the file.
    pub fn len(&self) -> usize {
        self.entities.len()
    }

    /// Whether the file has no entities.
    pub fn is_empty(&self) -> bool {
        self.entities.is_empty()
    }

    /// The scene as a world, with its entities spawned in the order of the file.
    pub fn world(&self) -> World {
        self.world_of(self.seconds.map(|seconds| SceneTime { seconds }), |entity, _| entity.name.clone())
    }

    /// The scene as a world, with its model files at a time of their animations, in seconds.
    pub fn world_at(&self, seconds: f64) -> World {
        self.world_of(Some(SceneTime { seconds }), |entity, _| entity.name.clone())
    }

    /// The position of what causes a scene error: the value of the field that it names, or else the start of the
    /// entity.
    ///
    /// `check` is called with a scene whose entities are named by their index, so that entities of equal name, or of
    /// none, can be distinguished.
    pub fn place_of(&self, check: impl FnOnce(&mut World) -> Option<SceneError>) -> Option<PlaceInFile> {
        let scene_error = check(&mut self.world_of(None, |_, number| Some(format!("{MARK}{number}{MARK}"))))?;
        let marked = |text: &str| text.rsplit(MARK).nth(1).and_then(|number| number.parse::<usize>().ok());
        let number = marked(&scene_error.entity).or_else(|| marked(&scene_error.value))?;
        let entity = self.entities.get(number)?;
        let kind = scene_error.entity.split(' ').next().unwrap_or("");
        // The name of a nested field begins with that of the outer one, as in `filter radius`.
        let outer = scene_error.field.split(' ').next().unwrap_or("");
        let at = self.field(entity, kind, scene_error.field).or_else(|| self.field(entity, kind, outer));
        let at = at.unwrap_or(entity.at);
        Some(place_of(&self.text, at))
    }

    /// The position of the first component with this word.
    pub fn place_of_word(&self, word: &str) -> Option<PlaceInFile> {
        let mut parts = self.entities.iter().flat_map(|entity| &entity.parts);
        parts.find(|part| part.word == word).map(|part| place_of(&self.text, part.at))
    }

    /// The byte offset of a field's value or of a component's word: in the component that the error names if it is
    /// there, or else in any other.
    fn field(&self, entity: &FileEntity, kind: &str, field: &str) -> Option<usize> {
        let mut parts: Vec<_> = entity.parts.iter().collect();
        parts.sort_by_key(|part| !part.word.starts_with(kind));
        parts.iter().find_map(|part| {
            if part.word == field {
                return Some(part.at);
            }
            let fields = fields(&self.text, part.value.clone());
            fields.iter().find(|own| own.word == field).map(|own| own.value.start)
        })
    }

    fn world_of(&self, time: Option<SceneTime>, name: impl Fn(&FileEntity, usize) -> Option<String>) -> World {
        let mut world = World::new();
        let spawned: Vec<Entity> = self.entities.iter().map(|_| world.spawn_empty().id()).collect();
        for (number, entity) in self.entities.iter().enumerate() {
            let mut put = world.entity_mut(spawned[number]);
            if let Some(name) = name(entity, number) {
                put.insert(Name::new(name));
            }
            for component in &entity.components {
                component(&mut put);
            }
            if let Some(parent) = entity.parent {
                put.insert(ChildOf(spawned[parent]));
            }
            if let Some(material) = entity.material {
                put.insert(UsesMaterial(spawned[material]));
            }
            if entity.disabled {
                put.insert(Disabled);
            }
        }
        // Inserted last, since it spawns an entity of its own and would shift the indices of the others.
        world.insert_resource(SceneFolder::of(&self.path));
        if let Some(time) = time {
            world.insert_resource(time);
        }
        load_meshes(&mut world);
        world
    }
}
