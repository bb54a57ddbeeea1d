use super::attention::Attention;
use super::memory::check_frames_fit;
use super::modes::{MODES, every_stage};
use super::orbit::Orbit;
use super::order::{Letter, Order};
use super::pace::Pace;
use super::paint::paint;
use super::scene::Scene;
use super::sheet::{Sheet, StageRow, modes};
use super::shown::{FrameHead, Shown};
use super::source::{FrameSource, Shot, was_stopped};
use super::traced::{self, Traced};
use crate::answer::Answer;
use bevy_ecs::prelude::World;
use pinhole::extract::camera_entity;
use pinhole::plan::{Census, Stage};
use pinhole::scene::{Resolution, Statistics, View};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// How long samples are taken before the next frame is shown, so that showing them costs little.
const BETWEEN_FRAMES: Duration = Duration::from_millis(60);
/// How often someone looks whether the camera has come to rest, or a page is open.
const LOOK_AGAIN: Duration = Duration::from_millis(20);

/// What a reader has chosen.
#[derive(Clone)]
struct Choice {
    scene: Rc<dyn Scene>,
    mode: usize,
    column: Option<String>,
    taken_out: Vec<&'static str>,
}

/// The stages on offer before any is taken out.
fn stages_of(choice: &Choice) -> Vec<Stage> {
    if MODES[choice.mode].every_stage { every_stage() } else { choice.scene.stages() }
}

/// Renders what a reader has chosen, from where they look at it, frame after frame.
pub struct Viewer {
    choice: Choice,
    size: Option<pinhole::Size>,
    world: World,
    offer: Vec<Stage>,
    columns: Vec<&'static str>,
    full: Resolution,
    orbit: Option<Orbit>,
    source: FrameSource,
    pace: Pace,
    /// The size of the last frame; none where the next one begins anew.
    begun: Option<Resolution>,
    done: bool,
    error: Option<String>,
    change: u64,
    shown: watch::Sender<Shown>,
    attention: Arc<Attention>,
}

impl Viewer {
    /// A viewer of a scene, of the scene's own size or of another.
    ///
    /// Errors: the scene cannot be rendered, in one sentence.
    pub fn new(
        scene: Rc<dyn Scene>,
        size: Option<pinhole::Size>,
        shown: watch::Sender<Shown>,
        attention: Arc<Attention>,
    ) -> Result<Self, String> {
        // A chapter about one space shows its column from the beginning.
        let world = scene.world();
        let camera = camera_entity(&world).map_err(|error| scene.explain(error.into()))?;
        let column = world.get::<View>(camera).map(|view| view.column.clone());
        let choice = Choice { scene, mode: 0, column, taken_out: Vec::new() };
        let mut viewer = Self {
            choice: choice.clone(),
            size,
            world: World::new(),
            offer: Vec::new(),
            columns: Vec::new(),
            full: Resolution::default(),
            orbit: None,
            source: FrameSource::default(),
            pace: Pace::default(),
            begun: None,
            done: false,
            error: None,
            change: 0,
            shown,
            attention,
        };
        viewer.choose(choice)?;
        Ok(viewer)
    }

    /// Renders and answers until nobody can ask any more.
    pub fn run(&mut self, letters: &Receiver<Letter>) {
        loop {
            self.attention.taken();
            while let Ok(letter) = letters.try_recv() {
                self.answer(letter);
            }
            let coarse = self.begun.is_some_and(|size| size != self.full);
            let unfinished = !self.done || (coarse && !self.pace.is_moving());
            if unfinished && self.attention.is_looked_at() {
                self.frame();
                continue;
            }
            // Nothing is computed while no page is open.
            let next = if coarse || unfinished {
                letters.recv_timeout(LOOK_AGAIN)
            } else {
                letters.recv().map_err(RecvTimeoutError::from)
            };
            match next {
                Ok(letter) => self.answer(letter),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    /// Carries out an order, unless whoever sent it has left: they were told that nothing came of it.
    fn answer(&mut self, (order, reply): Letter) {
        if !reply.is_closed() {
            let _ = reply.send(self.carry_out(order));
        }
    }

    /// Makes another choice; where nothing can be rendered of it, the one before stays.
    fn choose(&mut self, choice: Choice) -> Result<(), String> {
        let mut world = choice.scene.world();
        let explain = |error| choice.scene.explain(error);
        let camera = camera_entity(&world).map_err(|error| explain(error.into()))?;
        let mut camera = world.entity_mut(camera);
        camera.insert(Statistics);
        let own = camera.get::<Resolution>().copied().unwrap_or_default();
        let full = self.size.map_or(own, |size| size.of(own));
        camera.insert(full);
        (MODES[choice.mode].prepare)(&mut camera);
        let stages = stages_of(&choice);
        let offer: Vec<Stage> = stages.into_iter().filter(|stage| !choice.taken_out.contains(&stage.name)).collect();
        let (columns, plan) = paint(&mut world, &offer, choice.column.as_deref()).map_err(explain)?;
        check_frames_fit(&Census::of(&world), &plan, full, MODES[choice.mode].denoised > 0).map_err(explain)?;
        if let Some(orbit) = &self.orbit {
            orbit.put(&mut world);
        }
        (self.world, self.offer, self.columns, self.full) = (world, offer, columns, full);
        self.choice = choice;
        self.source.forget();
        self.renew();
        Ok(())
    }

    /// The next frame shows a change, so it begins anew.
    fn renew(&mut self) {
        self.change += 1;
        (self.begun, self.done, self.error) = (None, false, None);
    }

    fn frame(&mut self) {
        let began = Instant::now();
        let pixels = u64::from(self.full.width) * u64::from(self.full.height);
        let divisor = self.pace.divisor(pixels);
        let size = Resolution { width: self.full.width.div_ceil(divisor), height: self.full.height.div_ceil(divisor) };
        let moving = divisor > 1 || self.pace.is_moving();
        self.set_size(size);
        let patience = if moving { Duration::ZERO } else { BETWEEN_FRAMES };
        let changed = self.begun != Some(size);
        let levels = MODES[self.choice.mode].denoised;
        let shot = Shot { scene: &self.world, offer: &self.offer, changed, patience, gathers: levels > 0 };
        // A frame of a camera that moves is short, and is shown before the next movement, unless it is not so short.
        let watch = self.attention.watch(moving);
        (self.begun, self.done) = (Some(size), false);
        match self.source.film(&shot, &watch) {
            Ok(progress) => {
                let names = progress.plan.stages.iter().map(|stage| stage.name);
                let costs = progress.laps.iter().map(|lap| lap.time.as_secs_f64() * 1e3);
                let rendered = u64::from(size.width) * u64::from(size.height);
                if changed {
                    self.pace.note(rendered, progress.time);
                }
                self.done = progress.is_done() || (moving && divisor > 1);
                let pixels = progress.pixels(levels);
                let head = FrameHead {
                    frame: self.shown.borrow().frame + 1,
                    change: self.change,
                    size: [size.width, size.height],
                    samples: progress.samples,
                    milliseconds: began.elapsed().as_secs_f64() * 1e3,
                    stages: names.zip(costs).collect(),
                    error: None,
                };
                self.shown.send_replace(Shown::new(&head, &pixels));
            }
            Err(error) if was_stopped(&error) => {}
            Err(error) => {
                let sentence = self.choice.scene.explain(error);
                self.fail(sentence);
            }
        }
    }

    /// Says why there is no picture.
    fn fail(&mut self, sentence: String) {
        let (frame, error) = (self.shown.borrow().frame + 1, Some(sentence.clone()));
        let (size, samples, stages) = ([0, 0], [0, 0], Vec::new());
        let head = FrameHead { frame, change: self.change, size, samples, milliseconds: 0.0, stages, error };
        self.shown.send_replace(Shown::new(&head, &[]));
        (self.error, self.done, self.begun) = (Some(sentence), true, Some(self.full));
    }

    fn set_size(&mut self, size: Resolution) {
        if let Ok(camera) = camera_entity(&self.world) {
            self.world.entity_mut(camera).insert(size);
        }
    }

    fn carry_out(&mut self, order: Order) -> Answer {
        let choice = self.choice.clone();
        let done = match order {
            Order::Orbit(drag) => self.moved(|orbit| orbit.turn(drag)),
            Order::Pan(drag) => self.moved(|orbit| orbit.pan(drag)),
            Order::Zoom(factor) => self.moved(|orbit| orbit.zoom(factor.clamp(0.01, 100.0))),
            Order::Focus(at) => self.focus(at),
            Order::Reset => {
                self.orbit = None;
                self.choose(choice)
            }
            Order::Mode(key) => match MODES.iter().position(|mode| mode.key == key) {
                Some(mode) => self.choose(Choice { mode, ..choice }),
                None => Err(format!("no mode has the key {key:?}")),
            },
            Order::Column(column) => self.choose(Choice { column, ..choice }),
            Order::Stage(name, offered) => self.offer_stage(&name, offered),
            Order::Apply(text) => self.edit(text),
            Order::Save(text) => {
                return self
                    .edit(text)
                    .and_then(|()| self.save())
                    .map_or_else(Answer::refused, |file| Answer::json(&file));
            }
            Order::Trace(at) => {
                return self.trace(at).map_or_else(Answer::refused, |trace| Answer::json(&Traced::of(&trace)));
            }
            Order::Sheet => return Answer::json(&self.sheet()),
            Order::PutView => self.put_view(),
            Order::Picture(kind) => return self.picture(kind),
        };
        done.map_or_else(Answer::refused, |()| Answer::json(&self.change))
    }

    fn moved(&mut self, change: impl FnOnce(&mut Orbit)) -> Result<(), String> {
        let mut orbit = match self.orbit {
            Some(orbit) => orbit,
            None => {
                let middle = self.trace([0.5; 2]).ok();
                let distance = middle.and_then(|trace| traced::surface(&trace)).map(|point| point.length());
                Orbit::of(&self.world, distance).map_err(|error| self.choice.scene.explain(error))?
            }
        };
        change(&mut orbit);
        if !orbit.is_in_range() {
            return Err("the camera cannot be moved so far, nor so near".into());
        }
        orbit.put(&mut self.world);
        self.orbit = Some(orbit);
        self.pace.moved();
        self.renew();
        Ok(())
    }

    fn focus(&mut self, at: [f64; 2]) -> Result<(), String> {
        let point = traced::surface(&self.trace(at)?).ok_or("there is nothing at this point of the picture")?;
        self.moved(|orbit| orbit.focus(orbit.eye() + point))
    }

    fn trace(&mut self, [x, y]: [f64; 2]) -> Result<pinhole::look::Trace, String> {
        let size = self.full;
        let pixel = |part: f64, pixels: u32| ((part * f64::from(pixels)).max(0.0) as u32).min(pixels.saturating_sub(1));
        self.set_size(size);
        let traced = traced::trace(&mut self.world, &self.offer, [pixel(x, size.width), pixel(y, size.height)]);
        traced.map_err(|error| self.choice.scene.explain(error))
    }

    fn offer_stage(&mut self, name: &str, offered: bool) -> Result<(), String> {
        let stages = stages_of(&self.choice);
        let name = stages.iter().map(|stage| stage.name).find(|own| *own == name).ok_or("there is no such stage")?;
        let mut choice = self.choice.clone();
        choice.taken_out.retain(|own| *own != name);
        if !offered {
            choice.taken_out.push(name);
        }
        self.choose(choice)
    }

    fn edit(&mut self, text: String) -> Result<(), String> {
        if text == self.choice.scene.text() {
            return Ok(());
        }
        let scene = self.choice.scene.edited(text)?;
        let known: Vec<&str> = scene.stages().iter().map(|stage| stage.name).collect();
        let mut choice = Choice { scene, ..self.choice.clone() };
        choice.taken_out.retain(|name| known.contains(name));
        let [before, after] =
            [&self.choice.scene, &choice.scene].map(|scene| Orbit::of(&scene.world(), Some(1.0)).ok());
        let moved = self.orbit;
        self.orbit = moved.zip(before.zip(after)).and_then(|(orbit, (before, after))| orbit.after_edit(before, after));
        let chosen = self.choose(choice);
        if chosen.is_err() {
            self.orbit = moved;
        }
        chosen
    }

    fn sheet(&self) -> Sheet {
        let rows = self.source.plan().map(|plan| plan.rows.iter().map(StageRow::offered));
        let out = self.choice.taken_out.iter().map(|name| StageRow::taken_out(name));
        Sheet {
            scene: self.choice.scene.name(),
            text: self.choice.scene.text(),
            size: [self.full.width, self.full.height],
            modes: modes(),
            mode: MODES[self.choice.mode].key,
            columns: self.columns.clone(),
            column: self.choice.column.clone(),
            stages: rows.into_iter().flatten().chain(out).collect(),
            change: self.change,
        }
    }
}

mod keep;
#[cfg(test)]
mod tests;
