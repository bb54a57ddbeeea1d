//! What the page shows of a render: the picture, a number of each of its pixels, a column, or a component of one.

use bevy_ecs::prelude::World;
use pinhole::extract::camera_entity;
use pinhole::film::PixelErrors;
use pinhole::look::ViewComponent;
use pinhole::plan::{Census, ColumnKind, Plan, Stage, plan, view_names};
use pinhole::render::prepare;
use pinhole::scene::{Sampling, View, printable};
use serde::Serialize;

/// A number of each pixel of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Relative luminance (Rec. 709).
    Luminance,
    /// One channel.
    Channel(usize),
    /// The standard error of the luminance.
    StandardError,
    /// The number of samples.
    Samples,
    /// The luminance less that of the reference.
    Difference,
    /// What the pixel adds to relMSE.
    RelativeSquare,
}

/// The quantities by name, each with its unit.
pub const QUANTITIES: [(&str, Quantity, &str); 8] = [
    ("luminance", Quantity::Luminance, "linear Rec. 709"),
    ("red", Quantity::Channel(0), "linear Rec. 709"),
    ("green", Quantity::Channel(1), "linear Rec. 709"),
    ("blue", Quantity::Channel(2), "linear Rec. 709"),
    ("standard error", Quantity::StandardError, "linear Rec. 709, of the luminance"),
    ("samples", Quantity::Samples, "samples"),
    ("difference", Quantity::Difference, "linear Rec. 709, luminance less the reference's"),
    ("relative square", Quantity::RelativeSquare, "(x − r)² / (r² + 0.01), mean of the channels"),
];

/// What is painted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Painted {
    /// The picture.
    #[default]
    Picture,
    /// A number of each of its pixels, in false colour.
    Quantity(Quantity),
    /// A column, in its own colours.
    Column(String),
    /// A component of a column, in false colour.
    Component(String, String),
}

impl Painted {
    /// What a page names: nothing for the picture, `.luminance` for one of its numbers, `ndc` for a column, `ndc.x` for a
    /// component.
    ///
    /// Errors: there is no such quantity; whether there is such a column, the plan says.
    pub fn of(name: Option<&str>) -> Result<Self, String> {
        let Some(name) = name.filter(|name| !name.is_empty()) else { return Ok(Self::Picture) };
        match name.split_once('.') {
            None => Ok(Self::Column(name.into())),
            Some(("", name)) => {
                let found = QUANTITIES.iter().find(|(own, ..)| *own == name);
                let all = || QUANTITIES.map(|(own, ..)| own).join(", ");
                let refused = || format!("the picture has no number {:?}: it has {}", printable(name, 40), all());
                found.map(|&(_, quantity, _)| Self::Quantity(quantity)).ok_or_else(refused)
            }
            Some((column, component)) => Ok(Self::Component(column.into(), component.into())),
        }
    }

    /// The same as a page names it.
    pub fn name(&self) -> Option<String> {
        match self {
            Self::Picture => None,
            Self::Quantity(_) => self.quantity().map(|(name, _)| format!(".{name}")),
            Self::Column(column) => Some(column.clone()),
            Self::Component(column, component) => Some(format!("{column}.{component}")),
        }
    }

    /// The column that a view paints.
    pub fn column(&self) -> Option<&str> {
        match self {
            Self::Column(column) | Self::Component(column, _) => Some(column),
            _ => None,
        }
    }

    /// The name and the unit of a quantity.
    pub fn quantity(&self) -> Option<(&'static str, &'static str)> {
        let Self::Quantity(own) = self else { return None };
        QUANTITIES.iter().find(|(_, quantity, _)| quantity == own).map(|&(name, _, unit)| (name, unit))
    }
}

/// A column that can be painted, as the page lists it.
#[derive(Clone, Serialize)]
pub struct ColumnRow {
    pub name: &'static str,
    pub space: &'static str,
    pub unit: &'static str,
    pub components: Vec<&'static str>,
}

impl ColumnRow {
    fn of(column: &ColumnKind) -> Self {
        let mut world = World::new();
        let mut tile = world.spawn_empty();
        (column.insert)(&mut tile);
        let tile = tile.id();
        let names = (column.components)(&world.entity(tile)).into_iter().map(|component| component.name);
        let components = names.filter(|name| *name != "row").collect();
        Self { name: column.name, space: column.space, unit: column.unit, components }
    }
}

/// Puts the view of what is painted on the scene's camera, or takes it away, and says which columns could be viewed, and by
/// which plan the picture is made.
///
/// Errors: the column has no such component, or the scene cannot be rendered so.
pub fn paint(
    world: &mut World,
    offer: &[Stage],
    painted: &Painted,
    explain: impl Fn(pinhole::Error) -> String,
) -> Result<(Vec<ColumnRow>, Plan), String> {
    let camera = camera_entity(world).map_err(|error| explain(error.into()))?;
    world.entity_mut(camera).remove::<(View, ViewComponent, PixelErrors)>();
    let writes = || offer.iter().flat_map(|stage| &stage.writes);
    let kinds: Vec<ColumnKind> = match plan(&Census::of(world), offer) {
        Ok(plan) => plan.columns.into_iter().filter(ColumnKind::is_viewed).collect(),
        // The first chapters have columns and no picture.
        Err(_) => view_names(offer).iter().filter_map(|&name| writes().find(|own| own.name == name).copied()).collect(),
    };
    let columns: Vec<ColumnRow> = kinds.iter().map(ColumnRow::of).collect();
    let mut camera = world.entity_mut(camera);
    if let Some(column) = painted.column() {
        camera.insert(View { column: column.into() });
    } else if camera.get::<Sampling>().is_some_and(|own| own.samples > 1) {
        camera.insert(PixelErrors);
    }
    if let Painted::Component(column, component) = painted {
        let own = columns.iter().find(|own| own.name == column);
        if let Some(own) = own.filter(|own| !own.components.contains(&component.as_str())) {
            let (wanted, all) = (printable(component, 40), own.components.join(", "));
            return Err(format!("the column `{column}` has no component {wanted:?}: it has {all}"));
        }
        camera.insert(ViewComponent(component.clone()));
    }
    let (plan, _) = prepare(&Census::of(world), offer).map_err(explain)?;
    Ok((columns, plan))
}
