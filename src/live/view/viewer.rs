use super::Showing;
use super::attention::Attention;
use super::look::{Look, PageSize, Region, ShownBy};
use super::memory::check_frames_fit;
use super::modes::{MODES, every_stage};
use super::orbit::Orbit;
use super::order::{Letter, Order};
use super::pace::Pace;
use super::painted::{ColumnRow, Painted, paint};
use super::reference::Reference;
use super::scene::Scene;
use super::sheet::{Sheet, StageRow, modes, quantities};
use super::shown::{FrameHead, Shown};
use super::source::{FrameSource, Shot, was_stopped};
use super::traced::{self, Traced};
use super::undo::{Step, Undo};
use crate::answer::Answer;
use bevy_ecs::prelude::World;
use pinhole::extract::camera_entity;
use pinhole::plan::{Census, Stage};
use pinhole::render::Execution;
use pinhole::scene::{Resolution, Statistics, View};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// How long samples are taken before the next frame is shown, so that showing them costs little.
const BETWEEN_FRAMES: Duration = Duration::from_millis(60);
/// How many times as long, where showing a frame takes long itself.
const SAMPLES_TO_SHOWING: u32 = 4;
/// How often someone looks whether the camera has come to rest, or a page is open.
const LOOK_AGAIN: Duration = Duration::from_millis(20);

/// What a reader has chosen.
#[derive(Clone)]
struct Choice {
    scene: Rc<dyn Scene>,
    mode: usize,
    painted: Painted,
    taken_out: Vec<&'static str>,
}

/// What is told of the last frame that was shown.
#[derive(Clone, Default)]
struct Told {
    change: u64,
    size: Option<Resolution>,
    samples: [u32; 2],
    milliseconds: f64,
    stages: Vec<(&'static str, f64)>,
}

/// Where a step of the reader began.
struct State {
    orbit: Option<Orbit>,
    scene: Rc<dyn Scene>,
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
    columns: Vec<ColumnRow>,
    full: Resolution,
    orbit: Option<Orbit>,
    undo: Undo<State>,
    look: Look,
    reference: Option<Reference>,
    paused: bool,
    region: Option<Region>,
    /// The size that the page asks for.
    fills: Option<PageSize>,
    pointer: Option<[f64; 2]>,
    pins: Vec<[f64; 2]>,
    source: FrameSource,
    pace: Pace,
    /// The size of the last frame; none where the next one begins anew.
    begun: Option<Resolution>,
    told: Told,
    /// How long it took to show the last frame.
    presenting: Duration,
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
        showing: Showing,
        shown: watch::Sender<Shown>,
        attention: Arc<Attention>,
    ) -> Result<Self, String> {
        // A chapter about one space shows its column from the beginning.
        let world = scene.world();
        let camera = camera_entity(&world).map_err(|error| scene.explain(error.into()))?;
        let column = world.get::<View>(camera).map(|view| view.column.clone());
        let painted = column.map_or(Painted::Picture, Painted::Column);
        let choice = Choice { scene, mode: 0, painted, taken_out: Vec::new() };
        let execution = Execution { threads: showing.threads, ..Execution::default() };
        let mut viewer = Self {
            choice: choice.clone(),
            size: showing.size,
            world: World::new(),
            offer: Vec::new(),
            columns: Vec::new(),
            full: Resolution::default(),
            orbit: None,
            undo: Undo::default(),
            look: Look::default(),
            reference: None,
            paused: false,
            region: None,
            fills: None,
            pointer: None,
            pins: Vec::new(),
            source: FrameSource::new(execution),
            pace: Pace::default(),
            begun: None,
            told: Told::default(),
            presenting: Duration::ZERO,
            done: false,
            error: None,
            change: 0,
            shown,
            attention,
        };
        viewer.choose(choice)?;
        showing.reference.map_or(Ok(()), |reference| viewer.take_reference(reference))?;
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
            let rests = self.done || (self.paused && self.is_shown());
            let unfinished = !rests || (coarse && !self.pace.is_moving());
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
        let asked = self.fills.map(|PageSize([width, height])| Resolution { width, height });
        let full = asked.unwrap_or_else(|| self.size.map_or(own, |size| size.of(own)));
        camera.insert(full);
        (MODES[choice.mode].prepare)(&mut camera);
        let stages = stages_of(&choice);
        let offer: Vec<Stage> = stages.into_iter().filter(|stage| !choice.taken_out.contains(&stage.name)).collect();
        let (columns, plan) = paint(&mut world, &offer, &choice.painted, explain)?;
        let shows_numbers = matches!(choice.painted, Painted::Quantity(_) | Painted::Component(..));
        let beside = [MODES[choice.mode].denoised > 0, shows_numbers || self.reference.is_some()];
        check_frames_fit(&Census::of(&world), &plan, full, beside).map_err(explain)?;
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
        let patience = if moving || self.paused {
            Duration::ZERO
        } else {
            BETWEEN_FRAMES.max(self.presenting * SAMPLES_TO_SHOWING)
        };
        let changed = self.begun != Some(size);
        let levels = MODES[self.choice.mode].denoised;
        let part = |part: f64, pixels: u32| (part * f64::from(pixels)).round() as u32;
        let region = self.region.map(|Region([left, top, right, bottom])| {
            let [right, bottom] = [part(right, size.width), part(bottom, size.height)];
            [part(left, size.width).min(right - 1), part(top, size.height).min(bottom - 1), right, bottom]
        });
        let shot = Shot { scene: &self.world, offer: &self.offer, changed, patience, gathers: levels > 0, region };
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
                let (samples, stages) = (progress.samples, names.zip(costs).collect());
                self.told = Told { change: self.change, size: Some(size), samples, milliseconds: 0.0, stages };
                self.present(Some(began));
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
        let (scale, rel_mse, pixels) = (None, None, Vec::new());
        let (change, milliseconds) = (self.change, 0.0);
        let head = FrameHead { frame, change, size, samples, milliseconds, stages, scale, rel_mse, pixels, error };
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
                self.undo.took(Step::Other, self.state());
                self.orbit = None;
                self.choose(choice)
            }
            Order::Camera(there) => self.put_camera(&there),
            Order::Undo => self.go(Undo::back),
            Order::Redo => self.go(Undo::forward),
            Order::Mode(key) => match MODES.iter().position(|mode| mode.key == key) {
                Some(mode) => self.choose(Choice { mode, ..choice }),
                None => Err(format!("no mode has the key {key:?}")),
            },
            Order::Column(name) => {
                Painted::of(name.as_deref()).and_then(|painted| self.choose(Choice { painted, ..choice }))
            }
            Order::Look(look) => self.take_look(look),
            Order::Reference(kept) => self.keep_reference(kept),
            Order::Pause(paused) => {
                self.paused = paused;
                Ok(())
            }
            Order::Region(region) => {
                (self.region, self.done) = (region, false);
                Ok(())
            }
            Order::Size(fills) => self.fill(fills, choice),
            Order::Stage(name, offered) => self.offer_stage(&name, offered),
            Order::Apply(text) => self.edit(text),
            Order::Save(text) => {
                return self
                    .edit(text)
                    .and_then(|()| self.save())
                    .map_or_else(Answer::refused, |file| Answer::json(&file));
            }
            Order::Trace(at) => {
                self.pointer = Some(at);
                let reading = self.reading(at);
                let traced = self.trace(at).map(|trace| Traced::of(&trace, reading));
                return traced.map_or_else(Answer::refused, |traced| Answer::json(&traced));
            }
            Order::Pin(pins) => return self.pin(pins).map_or_else(Answer::refused, |pinned| Answer::json(&pinned)),
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
        self.undo.took(Step::Move, self.state());
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
        let before = self.state();
        self.choose(choice).map(|()| self.undo.took(Step::Other, before))
    }

    fn edit(&mut self, text: String) -> Result<(), String> {
        if text == self.choice.scene.text() {
            return Ok(());
        }
        let scene = self.choice.scene.edited(text)?;
        let known: Vec<&str> = scene.stages().iter().map(|stage| stage.name).collect();
        let mut choice = Choice { scene, ..self.choice.clone() };
        choice.taken_out.retain(|name| known.contains(name));
        let [own, edited] = [&self.choice.scene, &choice.scene].map(|scene| Orbit::of(&scene.world(), Some(1.0)).ok());
        let (moved, before) = (self.orbit, self.state());
        self.orbit = moved.zip(own.zip(edited)).and_then(|(orbit, (own, edited))| orbit.after_edit(own, edited));
        let chosen = self.choose(choice);
        match chosen {
            Ok(()) => self.undo.took(Step::Edit, before),
            Err(_) => self.orbit = moved,
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
            quantities: quantities(),
            column: self.choice.painted.name(),
            curves: ShownBy::all().map(|(word, _)| word).collect(),
            look: self.look.clone(),
            reference: self.reference.as_ref().map(|own| own.name.clone()),
            paused: self.paused,
            region: self.region,
            fills: self.fills.is_some(),
            pins: self.pins.clone(),
            camera: self.orbit.map(|orbit| orbit.at()),
            undo: self.undo.steps(),
            stages: rows.into_iter().flatten().chain(out).collect(),
            change: self.change,
        }
    }
}

mod keep;
mod past;
mod show;
#[cfg(test)]
mod tests;
