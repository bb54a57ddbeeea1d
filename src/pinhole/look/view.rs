use crate::each::Each;
use crate::extract::ImageFrame;
use crate::plan::{
    Census, Column, ColumnKind, ComponentNumber, ComponentValues, Evidence, Shared, Stage, Table, TileSystems,
    VectorRowsMut,
};
use crate::rays::{RasterPoints, Tile};
use crate::scene::{SceneError, View};
use crate::shade::Radiance;
use bevy_ecs::prelude::*;
use bevy_ecs::world::EntityRef;

/// On a camera with a [`View`]: put the numbers of this component of the column onto the film, instead of colours.
///
/// A film takes no negative sample, so red has the numbers above 0, green those below without their sign, and blue 1
/// where there is a finite number at all: (red − green) / blue is the mean over the samples that have one.
#[derive(Component, Clone, Debug, PartialEq, Eq)]
pub struct ViewComponent(pub String);

/// The column that a view shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ViewTable {
    /// The column's name.
    pub column: String,
    /// The component whose numbers are wanted; none for the column's colours.
    pub component: Option<String>,
}

impl Table for ViewTable {
    const NAME: &'static str = "view";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let viewers = scene.entities::<With<View>>();
        let viewer = viewers.first().copied();
        let view = viewer.and_then(|viewer| scene.get::<View>(viewer));
        let component = viewer.and_then(|viewer| scene.get::<ViewComponent>(viewer));
        Ok(Self {
            column: view.map(|view| view.column.clone()).unwrap_or_default(),
            component: component.map(|own| own.0.clone()),
        })
    }

    fn bytes(&self) -> usize {
        self.column.len() + self.component.as_ref().map_or(0, String::len)
    }
}

/// A system that paints the column that the view names, one of `columns`.
///
/// A column without a row for a pixel leaves it black; one with several gives it the first.
fn paint_view(columns: Vec<ColumnKind>) -> impl FnMut(&mut World, &mut QueryState<Entity, With<Tile>>) + Clone {
    move |world, tiles| {
        let view = world.resource::<Shared<ViewTable>>();
        let Some(column) = columns.iter().copied().find(|column| column.name == view.column) else { return };
        let component = view.component.clone();
        let image: [u32; 2] = {
            let image = world.resource::<Shared<ImageFrame>>();
            [image.width, image.height]
        };
        for tile in tiles.iter(world).collect::<Vec<_>>() {
            let painted = match &component {
                Some(component) => numbers_of_tile(column, component, &world.entity(tile)),
                None => paint_tile(column, &world.entity(tile), image),
            };
            if let Some(mut radiance) = world.get_mut::<Radiance>(tile) {
                *radiance = painted;
            }
        }
    }
}

fn paint_tile(column: ColumnKind, tile: &EntityRef<'_>, image: [u32; 2]) -> Radiance {
    let rows = tile.get::<RasterPoints>().map_or(0, Column::rows);
    let mut painted = Radiance::default();
    let mut rgb = painted.slices_mut(rows);
    for (row, path) in (0..(column.rows)(tile)).zip(paths(column, tile)).rev() {
        // Samples beyond the image's edge have coordinates below 0, which no picture can show.
        let shown = (column.paint)(tile, row, image).each(|part| if part < 0.0 { 0.0 } else { part });
        rgb.put(path, shown);
    }
    painted
}

/// The numbers of a component, as [`ViewComponent`] says.
fn numbers_of_tile(column: ColumnKind, component: &str, tile: &EntityRef<'_>) -> Radiance {
    let rows = tile.get::<RasterPoints>().map_or(0, Column::rows);
    let mut numbers = Radiance::default();
    let mut rgb = numbers.slices_mut(rows);
    let components = (column.components)(tile);
    let Some(found) = components.iter().find(|own| own.name == component) else { return numbers };
    for (row, path) in (0..(column.rows)(tile)).zip(paths(column, tile)).rev() {
        let number = match found.values.number(row) {
            ComponentNumber::F64(number) => number as f32,
            ComponentNumber::F32(number) => number,
            ComponentNumber::U32(number) => number.map_or(f32::NAN, |number| number as f32),
        };
        let parts = if number.is_finite() { [number.max(0.0), (-number).max(0.0), 1.0] } else { [0.0; 3] };
        rgb.put(path, parts);
    }
    numbers
}

/// The path of each row of a column, in order: the row's own number, unless a component `path` or `row` gives it.
pub fn paths<'t>(column: ColumnKind, tile: &EntityRef<'t>) -> Vec<usize> {
    let components = (column.components)(tile);
    match components.iter().find(|component| component.name == "row").map(|component| component.values) {
        Some(ComponentValues::U32(paths)) => paths.iter().map(|&path| path as usize).collect(),
        _ => (0..(column.rows)(tile)).collect(),
    }
}

/// The stage that paints any of the columns that the other stages on offer write.
pub fn view_stage(offer: &[Stage]) -> Stage {
    let columns = offer.iter().flat_map(|stage| &stage.writes).copied().collect();
    Stage::new("Paint the view", TileSystems::View, paint_view(columns))
        .reads::<RasterPoints>()
        .reads_the_view()
        .writes::<Radiance>()
        .table::<ViewTable>()
        .table::<ImageFrame>()
        .when(|scene| Evidence::of::<View>(scene, "view"))
}
