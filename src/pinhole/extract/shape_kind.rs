//! Which entities are a shape, of which kind, and what extraction asks of each kind.

use super::check::kind_and_name;
use super::pose::non_uniformly_scaled;
use super::shapes_of::{ShapesOf, placed_shape};
use super::velocity::moves_while_open;
use crate::material::NUMBERS;
use crate::plan::{Added, Census, Evidence, TableKind, add_kind, united, with_added};
use crate::scene::SceneError;
use crate::shapes::{AnyShape, Bounds, Emitter, Listed, SceneShape, ShapeKind, ShapeVisitor, UvSlope, visit_shapes};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};
use std::sync::{Arc, OnceLock};

/// A registered shape as extraction handles it, without its type.
#[derive(Clone, Copy)]
pub struct ListedKind {
    /// The kind.
    pub kind: ShapeKind,
    /// The name of its component.
    pub component: &'static str,
    /// Its component in messages.
    pub word: &'static str,
    /// Which placements make this shape of its component, if not all do.
    pub(super) non_uniform: Option<bool>,
    /// Whether some of the component's examples, and whether all of them, can be made of glass.
    pub(super) examples_with_inside: fn() -> [bool; 2],
    /// Whether some of them, and whether all of them, are sampled where they emit.
    pub(super) examples_sampled: fn() -> [bool; 2],
    /// Whether an entity can be made of glass.
    pub has_inside: fn(&Census<'_>, Entity) -> bool,
    /// Whether several usually make up one surface.
    pub is_part: bool,
    /// Whether it consists of several primitives.
    pub(super) has_primitives: bool,
    /// Its table.
    pub table: TableKind,
    /// Evidence that the scene contains one that keeps still.
    pub evidence: fn(&Census<'_>) -> Evidence,
    entities: fn(&Census<'_>) -> Arc<[Entity]>,
    declared: fn(&Census<'_>) -> Arc<[Entity]>,
    component_evidence: fn(&Census<'_>) -> Evidence,
    carries: fn(&Census<'_>, Entity) -> bool,
    /// Extracts its table, which checks its components.
    pub check: fn(&Census<'_>) -> Result<(), SceneError>,
    /// A shape that moves.
    pub(super) body: fn(&Census<'_>, Entity, DVec3) -> Result<AnyShape, SceneError>,
    /// A row of its table as a light; none where it cannot be sampled.
    pub(super) emitter: fn(&Census<'_>, usize) -> Result<Option<Emitter>, SceneError>,
    /// Whether an entity of this kind is sampled where it emits.
    pub(super) is_sampled: fn(&Census<'_>, Entity) -> bool,
    /// The box around a row; none where it is infinite.
    pub(super) bounds: fn(&Census<'_>, usize) -> Result<Option<Bounds>, SceneError>,
    /// The sphere around a row; none where it is infinite.
    pub bounding_sphere: fn(&Census<'_>, usize) -> Result<Option<(DVec3, f64)>, SceneError>,
    /// The number of the first shape with a point in its inside.
    pub around: fn(&Census<'_>, DVec3) -> Result<Option<u32>, SceneError>,
    /// The linear map from world space to an entity's uv space.
    pub(super) uv_from_world: fn(&Census<'_>, Entity, DMat3) -> DMat3,
    /// Fills in the gradients of u and v along its rows.
    pub(super) fill_uv_slopes: fn(&Census<'_>, &[DMat3], &mut [UvSlope]) -> Result<(), SceneError>,
}

impl ListedKind {
    fn of<S: Listed>() -> Self {
        Self {
            examples_with_inside: || some_and_all(&S::Component::examples(), S::has_inside),
            examples_sampled: || some_and_all(&S::Component::examples(), S::is_sampled),
            kind: S::KIND,
            component: S::Component::NAME,
            word: S::Component::WORD,
            non_uniform: S::NON_UNIFORM,
            has_inside: |scene, entity| scene.get::<S::Component>(entity).is_some_and(S::has_inside),
            is_part: S::IS_PART,
            has_primitives: S::HAS_PRIMITIVES,
            table: TableKind::of::<ShapesOf<S>>(),
            evidence: kind_evidence::<S>,
            entities: |scene| scene.entities::<With<S::Component>>(),
            declared: |scene| scene.declared::<With<S::Component>>(),
            component_evidence: |scene| Evidence::of::<S::Component>(scene, S::Component::WORD),
            carries: |scene, entity| scene.get::<S::Component>(entity).is_some(),
            check: |scene| scene.table::<ShapesOf<S>>().map(drop),
            body: |scene, entity, eye| {
                placed_shape::<S>(scene, entity, eye).map(|(shape, surface_data)| shape.into_any_shape(surface_data))
            },
            emitter: |scene, row| {
                let shapes = scene.table::<ShapesOf<S>>()?;
                Ok(shapes.row[row].listed_emitter(&shapes.surface_data[row]))
            },
            is_sampled: |scene, entity| scene.get::<S::Component>(entity).is_some_and(S::is_sampled),
            bounds: |scene, row| Ok(scene.table::<ShapesOf<S>>()?.row[row].bounds()),
            bounding_sphere: |scene, row| Ok(scene.table::<ShapesOf<S>>()?.row[row].bounding_sphere()),
            around: |scene, point| {
                let shapes = scene.table::<ShapesOf<S>>()?;
                Ok(shapes.row.iter().position(|shape| shape.contains(point)).map(|row| shapes.shape[row]))
            },
            uv_from_world: |scene, entity, entity_from_world| {
                let component = scene.get::<S::Component>(entity).cloned().unwrap_or_default();
                S::uv_from_world(&component, entity_from_world)
            },
            fill_uv_slopes: |scene, uv_from_world, slopes| {
                let shapes = scene.table::<ShapesOf<S>>()?;
                for ((row, surface_data), &shape) in shapes.row.iter().zip(&shapes.surface_data).zip(&shapes.shape) {
                    slopes[shape as usize] = row.uv_slope(surface_data, uv_from_world[shape as usize]);
                }
                Ok(())
            },
        }
    }

    /// Whether it is the first of those that are made of its component.
    fn is_first(&self) -> bool {
        self.non_uniform != Some(true)
    }
}

/// Whether some components pass a test, and whether all of them do.
fn some_and_all<C>(components: &[C], is: fn(&C) -> bool) -> [bool; 2] {
    [components.iter().any(is), components.iter().all(is)]
}

/// The shapes of the library, in the order of its list.
fn library_kinds() -> &'static [ListedKind] {
    struct Collected(Vec<ListedKind>);
    impl ShapeVisitor for Collected {
        fn visit<S: Listed>(&mut self) {
            self.0.push(ListedKind::of::<S>());
        }
    }
    static KINDS: OnceLock<Vec<ListedKind>> = OnceLock::new();
    KINDS.get_or_init(|| {
        let mut collected = Collected(Vec::new());
        visit_shapes(&mut collected);
        collected.0
    })
}

/// All registered shapes: those of the library, and then those that the scene adds.
pub fn listed_kinds<'s>(scene: &'s Census<'_>) -> impl Iterator<Item = &'s ListedKind> + Clone {
    with_added(library_kinds(), scene)
}

/// Adds a shape of one's own to those that a scene may have, before it is planned.
pub fn add_shape<S: Listed>(scene: &mut World) {
    let (table, entities) =
        (TableKind::of::<ShapesOf<S>>(), |scene: &Census<'_>| scene.entities::<With<S::Component>>());
    let added = Added { table, word: S::Component::WORD, entities, stages: "of_shape" };
    add_kind::<S, _>(scene, ListedKind::of::<S>(), added);
}

/// Checks that no two shapes have the same kind.
///
/// Errors: one that a program adds with the number of another.
pub(super) fn check_kinds(scene: &Census<'_>) -> Result<(), SceneError> {
    for (at, own) in listed_kinds(scene).enumerate() {
        if let Some(other) = listed_kinds(scene).skip(at + 1).find(|other| other.kind == own.kind) {
            return Err(SceneError::new(other.component, "number", format!("that of {}", own.component), NUMBERS));
        }
    }
    Ok(())
}

/// A registered shape by its kind; none for moving shapes, which are of any.
pub fn listed_kind<'s>(scene: &'s Census<'_>, kind: ShapeKind) -> Option<&'s ListedKind> {
    listed_kinds(scene).find(|listed| listed.kind == kind)
}

/// Evidence that the scene contains a shape of one kind that keeps still.
pub fn kind_evidence<S: Listed>(scene: &Census<'_>) -> Evidence {
    let moves = moves_while_open(scene);
    Evidence::of_kind::<With<S::Component>>(scene, S::NOUN, |entity| {
        S::NON_UNIFORM.is_none_or(|non_uniform| non_uniform == non_uniformly_scaled(scene, entity)) && !moves(entity)
    })
}

/// Evidence that the scene contains a shape of any kind.
pub fn shape_evidence(scene: &Census<'_>) -> Evidence {
    let each = || listed_kinds(scene).filter(|listed| listed.is_first());
    let found = each().map(|listed| (listed.component_evidence)(scene)).reduce(Evidence::or).unwrap_or_default();
    if found.needed {
        return found;
    }
    let declared = united(&mut each().map(|listed| (listed.declared)(scene)));
    Evidence::among_entities(scene, "shape", |_| true, &[], &declared)
}

/// Evidence that the scene contains a shape that consists of several primitives, whether it moves or not.
pub fn primitive_evidence(scene: &Census<'_>) -> Evidence {
    let with_primitives = listed_kinds(scene).filter(|listed| listed.has_primitives);
    with_primitives.map(|listed| (listed.component_evidence)(scene)).reduce(Evidence::or).unwrap_or_default()
}

/// The enabled entities that are a shape, in spawn order; the place of one is its number.
pub fn shape_entities(scene: &Census<'_>) -> Arc<[Entity]> {
    scene.once(|scene| {
        let each = listed_kinds(scene).filter(|listed| listed.is_first());
        united(&mut each.map(|listed| (listed.entities)(scene))).into()
    })
}

/// The shapes of one kind, moving ones among them, with their numbers.
pub(super) fn numbered<S: Listed>(scene: &Census<'_>) -> Vec<(usize, Entity)> {
    let shapes = shape_entities(scene);
    let number = |entity: Entity| shapes.binary_search_by_key(&entity.index(), |shape| shape.index()).ok();
    let of_kind = |entity: &&Entity| {
        S::NON_UNIFORM.is_none_or(|non_uniform| non_uniform == non_uniformly_scaled(scene, **entity))
    };
    let found = scene.entities::<With<S::Component>>();
    found.iter().filter(of_kind).filter_map(|&entity| Some((number(entity)?, entity))).collect()
}

/// The shapes that move while the shutter is open, with their numbers.
pub(super) fn moving_shapes(scene: &Census<'_>) -> Arc<[(usize, Entity)]> {
    scene.once(|scene| {
        let moves = moves_while_open(scene);
        shape_entities(scene).iter().copied().enumerate().filter(|&(_, shape)| moves(shape)).collect()
    })
}

/// The name of a shape in messages, by its number: its kind and its entity's name.
pub fn shape_name(scene: &Census<'_>, shape: usize) -> String {
    let entity = shape_entities(scene).get(shape).copied();
    let listed = entity.and_then(|entity| listed_kinds(scene).find(|listed| (listed.carries)(scene, entity)));
    entity.zip(listed).map_or_else(String::new, |(entity, listed)| kind_and_name(scene, listed.word, entity))
}

/// The names of all shapes in messages, in the order of their numbers.
pub fn shape_names(scene: &Census<'_>) -> Vec<String> {
    (0..shape_entities(scene).len()).map(|shape| shape_name(scene, shape)).collect()
}

/// Whether an entity, enabled or not, carries a shape.
pub(super) fn is_shape(scene: &Census<'_>, entity: Entity) -> bool {
    listed_kinds(scene).any(|listed| (listed.carries)(scene, entity))
}

/// The kind of an entity that carries one shape component.
///
/// Errors: an entity with several.
pub(super) fn one_shape(scene: &Census<'_>, entity: Entity) -> Result<ListedKind, SceneError> {
    let carried = || listed_kinds(scene).filter(|listed| (listed.carries)(scene, entity));
    let components: Vec<&ListedKind> = carried().filter(|listed| listed.is_first()).collect();
    if let [one] = components[..] {
        let is_this = |listed: &&ListedKind| {
            listed.non_uniform.is_none_or(|non_uniform| non_uniform == non_uniformly_scaled(scene, entity))
        };
        return Ok(*carried().find(is_this).unwrap_or(one));
    }
    let names: Vec<&str> = components.iter().map(|listed| listed.component).collect();
    let value = format!("{} at once", names.join(" and "));
    Err(SceneError::new(kind_and_name(scene, "shape", entity), "shape", value, "an entity may be one shape only"))
}
