use crate::extract::{ImageFrame, SamplingTable, shape_entities};
use crate::material::media_entities;
use crate::plan::{Census, ColumnKind, ComponentNumber, Evidence, Lifetime, Plan, Stage};
use crate::rays::{Depth, PathLight, Paths, Tile, WorldRays};
use crate::render::{Hook, inspect_pixel};
use crate::scene::{SceneError, TracePixel, called};
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use std::any::TypeId;
use std::collections::{BTreeMap, HashMap};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// What one stage wrote for one pixel; its address is (stage, pixel, sample, bounce).
#[derive(Clone, Debug, PartialEq)]
pub struct Recorded {
    /// The stage that has just run.
    pub stage: &'static str,
    /// The sample's number within the pixel.
    pub sample: u32,
    /// The bounce, counted from 0; 0 is the camera ray.
    pub depth: u32,
    /// The column that it wrote.
    pub column: ColumnKind,
    /// The components of each row of the column; no rows where the column says nothing about this pixel.
    pub rows: Vec<Vec<(&'static str, ComponentNumber)>>,
}

/// What the recorders have written, in order.
#[derive(Resource, Default)]
struct Recording(Vec<Recorded>);

/// The light path of a pixel, stage by stage.
#[derive(Clone, Debug)]
pub struct Trace {
    /// The pixel.
    pub pixel: TracePixel,
    /// The sample's number within the pixel.
    pub sample: u32,
    /// What each stage wrote.
    pub stages: Vec<Recorded>,
    /// The names of the shapes that stages wrote, by number.
    pub shapes: BTreeMap<u32, String>,
    /// Whether all bounces are printed, however many there are; otherwise only the first few and the last.
    pub prints_all: bool,
}

/// How many bounces of a long path are printed at its beginning and at its end.
const SHOWN: [u32; 2] = [16, 4];

/// Traces the first sample of a pixel by running the stages on a tile of that pixel.
///
/// Errors: whatever a render would refuse, and a pixel outside the image.
pub fn trace(scene: &Census<'_>, offer: &[Stage], pixel: TracePixel) -> Result<Trace> {
    trace_sample(scene, offer, pixel, 0)
}

/// The same for any of the pixel's samples.
///
/// Errors: those of [`trace`], and a sample that the camera does not take.
pub fn trace_sample(scene: &Census<'_>, offer: &[Stage], pixel: TracePixel, sample: u32) -> Result<Trace> {
    let image = scene.table::<ImageFrame>()?;
    if pixel.x >= image.width || pixel.y >= image.height {
        let value = format!("{},{}", pixel.x, pixel.y);
        let accepted = format!("the image has pixels 0,0 to {},{}", image.width - 1, image.height - 1);
        return Err(Error::from(SceneError::new("the trace", "pixel", value, accepted)));
    }
    let samples = scene.table::<SamplingTable>()?.samples;
    if sample >= samples {
        let accepted = match samples {
            1 => "the camera takes one sample of each pixel, number 0".into(),
            _ => format!("the camera takes samples 0 to {} of each pixel", samples - 1),
        };
        return Err(Error::from(SceneError::new("the trace", "sample", sample.to_string(), accepted)));
    }
    let hook = record_hook(pixel, sample);
    let offer = with_camera_rays(scene, offer);
    let mut inspection = inspect_pixel(scene, &offer, [pixel.x, pixel.y], sample, &[hook])?;
    let stages = inspection.world.remove_resource::<Recording>().unwrap_or_default().0;
    let shapes = shapes_named(scene, &stages);
    Ok(Trace { pixel, sample, stages, shapes, prints_all: false })
}

/// The stages on offer; in a scene without shapes, the film asks for the camera rays, which nothing else reads there.
fn with_camera_rays(scene: &Census<'_>, offer: &[Stage]) -> Vec<Stage> {
    let mut offer = offer.to_vec();
    if shape_entities(scene).is_empty() {
        let films = |stage: &&mut Stage| stage.writes.iter().any(|column| column.lifetime == Lifetime::Film);
        let asked: fn(&Census<'_>) -> Evidence = |_| Evidence::always("the trace prints them");
        offer.iter_mut().filter(films).for_each(|stage| stage.reads_where.push((ColumnKind::of::<WorldRays>(), asked)));
    }
    offer
}

/// The names of all shapes whose numbers a stage wrote.
fn shapes_named(scene: &Census<'_>, stages: &[Recorded]) -> BTreeMap<u32, String> {
    let (shapes, media) = (shape_entities(scene), media_entities(scene));
    let name = |&(component, number): &(&str, ComponentNumber)| match number {
        ComponentNumber::U32(Some(number)) if component == "shape" => {
            let own = shapes.iter().chain(media.iter()).nth(number as usize)?;
            Some((number, called(scene, *own)))
        }
        _ => None,
    };
    stages.iter().flat_map(|recorded| recorded.rows.iter().flatten()).filter_map(name).collect()
}

/// A system after each stage that copies what it wrote for the pixel, before a later bounce can overwrite it.
fn record_hook(pixel: TracePixel, sample: u32) -> Hook {
    Arc::new(move |_, stage: &Stage, plan: &Plan| {
        let name = stage.name;
        let columns: Vec<ColumnKind> = stage.writes.iter().copied().filter(|c| plan.columns.contains(c)).collect();
        let record = move |world: &mut World, tiles: &mut QueryState<Entity, With<Tile>>| {
            let mut recorded = Vec::new();
            for tile in tiles.iter(world) {
                let tile = world.entity(tile);
                let Some(path) = tile.get::<Tile>().and_then(|place| place.row_of(pixel.x, pixel.y)) else { continue };
                let depth = tile.get::<Depth>().map_or(0, |depth| depth.0);
                let is_alive = |paths: &Paths| paths.first.contains(&(path as u32));
                if depth > 0 && !tile.get::<Paths>().is_some_and(is_alive) {
                    continue;
                }
                for &column in &columns {
                    let components = (column.components)(&tile);
                    let show = |row| {
                        components.iter().map(|component| (component.name, component.values.number(row))).collect()
                    };
                    let rows = rows_at_depth(&tile, column, path as u32).into_iter().map(show).collect();
                    recorded.push(Recorded { stage: name, sample, depth, column, rows });
                }
            }
            world.get_resource_or_init::<Recording>().0.extend(recorded);
        };
        record.into_configs()
    })
}

/// The rows of a column that belong to a pixel at the current bounce: those of its rays, of which there may be several
/// or none after the first bounce.
fn rows_at_depth(tile: &EntityRef<'_>, column: ColumnKind, path: u32) -> Vec<usize> {
    let later = tile.get::<Depth>().is_some_and(|depth| depth.0 > 0);
    match tile.get::<Paths>().filter(|_| later && column.lifetime != Lifetime::Film && !column.is::<PathLight>()) {
        None => column.rows_of_path(tile, path),
        Some(paths) => {
            let rays = (0..paths.first.len()).filter(|&ray| paths.first[ray] == path);
            rays.flat_map(|ray| column.rows_of_path(tile, ray as u32)).collect()
        }
    }
}

impl fmt::Display for Trace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A later stage of the same bounce may overwrite what an earlier one wrote.
        let mut last: HashMap<(u32, TypeId), usize> = HashMap::new();
        for (position, recorded) in self.stages.iter().enumerate() {
            last.insert((recorded.depth, recorded.column.id), position);
        }
        let left_out = self.bounces_left_out();
        let mut announced = None;
        for (position, recorded) in self.stages.iter().enumerate() {
            let listing = recorded.column.unit == "rows";
            if last.get(&(recorded.depth, recorded.column.id)) != Some(&position) || listing {
                continue;
            }
            if left_out.contains(&recorded.depth) {
                if recorded.depth == left_out.start && announced != Some(recorded.depth) {
                    let (first, end) = (left_out.start, left_out.end - 1);
                    writeln!(f, "bounces {first} to {end} are left out; --all prints them")?;
                    announced = Some(recorded.depth);
                }
                continue;
            }
            if announced != Some(recorded.depth) {
                let (pixel, sample, depth) = (self.pixel, self.sample, recorded.depth);
                writeln!(f, "pixel {},{}   sample {sample}, bounce {depth}", pixel.x, pixel.y)?;
                announced = Some(depth);
            }
            let (name, space, unit) = (recorded.column.name, recorded.column.space, recorded.column.unit);
            let head = format!("{name:<10} {space:<20} {unit:<24}");
            if recorded.rows.is_empty() {
                writeln!(f, "{head} nothing")?;
            }
            for (row, components) in recorded.rows.iter().enumerate() {
                let head = if row == 0 { &head } else { "" };
                writeln!(f, "{head:<55} {}", self.show_row(components))?;
            }
        }
        Ok(())
    }
}

impl Trace {
    /// The bounces that are not printed: those in the middle of a long path.
    fn bounces_left_out(&self) -> Range<u32> {
        let max_depth = self.stages.iter().map(|recorded| recorded.depth).max().map_or(0, |last| last + 1);
        let [first, last] = SHOWN;
        if self.prints_all || max_depth <= first + last { 0..0 } else { first..max_depth - last }
    }

    /// The name of the shape with this number; none where nothing was hit.
    pub fn shape_name(&self, number: ComponentNumber) -> Option<&str> {
        let ComponentNumber::U32(Some(number)) = number else { return None };
        self.shapes.get(&number).map(String::as_str)
    }

    /// The components of a row, vectors in brackets, a shape by its name.
    fn show_row(&self, components: &[(&'static str, ComponentNumber)]) -> String {
        let word = |&(name, value): &(&'static str, ComponentNumber)| match name {
            "shape" => format!("shape {}", self.shape_name(value).unwrap_or("none")),
            name => format!("{name} {value}"),
        };
        let words: Vec<String> = components.iter().filter(|(name, _)| *name != "row").map(word).collect();
        words.join("  ")
    }
}
