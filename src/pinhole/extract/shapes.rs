//! Which entities are a shape, of which kind, and their tables.

use super::area_lights::emissive_entities;
use super::cameras::{eye, with_article};
use super::check::{finite_point, kind_and_name};
use super::medium::{bodies_without_surface, medium_evidence};
use super::motion::moves_while_open;
use super::non_opaque::is_non_opaque;
use super::pose::{non_uniformly_scaled, pose};
use crate::bvh::Bvh;
use crate::each::Each;
use crate::material::{NO_ROW, NUMBERS, components_in_words, material_entities, material_kind, media_entities};
use crate::plan::{Added, Census, Evidence, Table, TableKind, add_kind, check_is_added, counted, united, with_added};
use crate::scene::{ChildOf, Placement, SceneError, Triangle, UsesMaterial, called};
use crate::shapes::{
    AnyShape, Bounds, Ellipsoid, Emitter, Listed, Placed, PlacedDisk, PlacedMesh, PlacedPlane, PlacedRectangle,
    PlacedSphere, SceneShape, ShapeKind, ShapeVisitor, Slabs, TriangleRow, UvSlope, hierarchy_of, placed_normals,
    visit_shapes,
};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};
use std::collections::HashMap;
use std::marker::PhantomData;
use std::sync::{Arc, OnceLock};

/// All shapes in spawn order; a shape's index here is the shape number in hits.
///
/// After them come the media, in spawn order: what a ray hits where it is scattered in one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShapeTable {
    /// The table each shape is in.
    pub kind: Vec<ShapeKind>,
    /// Its row in that table.
    pub row: Vec<u32>,
    /// Its row in the material table; [`NO_ROW`] for a shape that reflects nothing.
    pub material: Vec<u32>,
    /// Whether its material is not specular, so that lights are sampled for it.
    pub non_specular: Vec<bool>,
    /// Its row in the table of emissive surfaces; [`NO_ROW`] for a shape that emits nothing.
    pub emissive: Vec<u32>,
}

impl Table for ShapeTable {
    const NAME: &'static str = "shapes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (materials, emissive) = (material_entities(scene), emissive_entities(scene));
        let kinds: Vec<_> = materials.iter().map(|&material| material_kind(scene, material)).collect();
        let non_specular =
            |row: u32| kinds.get(row as usize).copied().flatten().is_some_and(|kind| !kind.is_specular());
        let mut table = Self::default();
        let (mut rows_of_kind, moves) = (HashMap::<ShapeKind, u32>::new(), moves_while_open(scene));
        let (is_non_opaque, mut last) = (is_non_opaque(scene), Vec::new());
        for &entity in shape_entities(scene).iter() {
            let listed = one_shape(scene, entity)?;
            let kind = if moves(entity) { ShapeKind::Moving } else { listed.kind };
            // Those that are not opaque are in the table of their kind after all others.
            if kind != ShapeKind::Moving && is_non_opaque(entity) {
                last.push(table.row.len());
                table.row.push(0);
            } else {
                let rows = rows_of_kind.entry(kind).or_default();
                table.row.push(*rows);
                *rows += 1;
            }
            table.kind.push(kind);
            let used = scene.get::<UsesMaterial>(entity).map(|used| used.0);
            let [own, of_used] = [Some(entity), used].each(|entity| row_in(&materials, entity));
            let [emits, used_emits] = [Some(entity), used].each(|entity| row_in(&emissive, entity));
            let material = if own == NO_ROW { of_used } else { own };
            // A shape that emits light need not reflect any, but a material that it uses must exist.
            let is_missing = material.min(if used.is_some() { used_emits } else { emits }) == NO_ROW;
            if is_missing || (own != NO_ROW && used.is_some()) {
                return Err(wrong_material(scene, &kind_and_name(scene, listed.word, entity), own != NO_ROW, used));
            }
            table.non_specular.push(non_specular(material));
            table.material.push(material);
            table.emissive.push(if emits == NO_ROW { used_emits } else { emits });
        }
        for shape in last {
            let rows = rows_of_kind.entry(table.kind[shape]).or_default();
            table.row[shape] = *rows;
            *rows += 1;
        }
        for row in 0..media_entities(scene).len() {
            table.kind.push(ShapeKind::Medium);
            table.row.push(row as u32);
            table.material.push((materials.len() + row) as u32);
            table.non_specular.push(true);
            table.emissive.push(NO_ROW);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.kind.len() * (size_of::<ShapeKind>() + size_of::<bool>() + 12)
    }
}

/// The error of a shape that has no material, or two.
fn wrong_material(scene: &Census<'_>, who: &str, has_own: bool, used: Option<Entity>) -> SceneError {
    match (has_own, used) {
        (true, Some(used)) => {
            let value = format!("given twice, its own and that of {}", called(scene, used));
            SceneError::new(who, "material", value, "a shape may have one only")
        }
        (_, Some(used)) => {
            let value = format!("used from {}", called(scene, used));
            let accepted = format!(
                "that entity must carry a {} or an Emissive and not be disabled",
                components_in_words(scene, "", |_| true)
            );
            SceneError::new(who, "material", value, accepted)
        }
        (_, None) => {
            let accepted = format!(
                "a shape must carry a {}, a UsesMaterial or an Emissive",
                components_in_words(scene, "", |_| true)
            );
            SceneError::new(who, "material", "missing", accepted)
        }
    }
}

/// The row of an entity in a list in spawn order.
fn row_in(list: &[Entity], entity: Option<Entity>) -> u32 {
    let row = |entity: Entity| list.binary_search_by_key(&entity.index(), |other| other.index()).ok();
    let row = entity.and_then(|entity| row(entity).filter(|&row| list[row] == entity));
    row.map_or(NO_ROW, |row| row as u32)
}

// Which entities are a shape, of which kind, and what extraction asks of each kind.

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
    pub(super) entities: fn(&Census<'_>) -> Arc<[Entity]>,
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
    let (moves, without_surface) = (moves_while_open(scene), bodies_without_surface(scene));
    Evidence::of_kind::<With<S::Component>>(scene, S::NOUN, |entity| {
        S::NON_UNIFORM.is_none_or(|non_uniform| non_uniform == non_uniformly_scaled(scene, entity))
            && !moves(entity)
            && !without_surface.contains(&entity)
    })
}

/// Evidence that the scene contains a shape of any kind, or a medium, in which rays end as well.
pub fn shape_evidence(scene: &Census<'_>) -> Evidence {
    let each = || listed_kinds(scene).filter(|listed| listed.is_first());
    let found = each().map(|listed| (listed.component_evidence)(scene)).reduce(Evidence::or).unwrap_or_default();
    if found.needed {
        return found;
    }
    let medium = medium_evidence(scene);
    if medium.needed {
        return medium;
    }
    let declared = united(&mut each().map(|listed| (listed.declared)(scene)));
    Evidence::among_entities(scene, "shape", |_| true, &[], &declared)
}

/// Evidence that the scene contains a shape that consists of several primitives, whether it moves or not.
pub fn primitive_evidence(scene: &Census<'_>) -> Evidence {
    let with_primitives = listed_kinds(scene).filter(|listed| listed.has_primitives);
    with_primitives.map(|listed| (listed.component_evidence)(scene)).reduce(Evidence::or).unwrap_or_default()
}

/// The enabled entities that are a shape with a surface, in spawn order; the place of one is its number.
pub fn shape_entities(scene: &Census<'_>) -> Arc<[Entity]> {
    scene.once(|scene| {
        let each = listed_kinds(scene).filter(|listed| listed.is_first());
        let mut all = united(&mut each.map(|listed| (listed.entities)(scene)));
        let without_surface = bodies_without_surface(scene);
        all.retain(|shape| !without_surface.contains(shape));
        all.into()
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

/// Shapes of one kind in render space, in spawn order, except for those that [move](super::MovingTable); those that
/// [are not opaque](super::NonOpaqueTable) come last, and only their surfaces are computed from here.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapesOf<S: Listed> {
    /// The shapes, as the intersection kernels read them.
    pub row: Vec<S>,
    /// What the surface of each needs besides.
    pub surface_data: Vec<S::SurfaceData>,
    /// The shape's number.
    pub shape: Vec<u32>,
    /// How many, from the first on, are opaque to every ray.
    pub opaque: usize,
    /// What is prepared of these, once it is asked for.
    prepared: OnceLock<S::Prepared>,
}

/// The table of spheres.
pub type SphereTable = ShapesOf<PlacedSphere>;
/// The table of spheres with a non-uniform scale.
pub type EllipsoidTable = ShapesOf<Ellipsoid>;
/// The table of planes.
pub type PlaneTable = ShapesOf<PlacedPlane>;
/// The table of disks.
pub type DiskTable = ShapesOf<PlacedDisk>;
/// The table of rectangles.
pub type RectangleTable = ShapesOf<PlacedRectangle>;
/// The table of cuboids.
pub type CuboidTable = ShapesOf<Slabs>;
/// The table of triangles.
pub type TriangleTable = ShapesOf<TriangleRow>;

/// The table of meshes.
pub type MeshTable = ShapesOf<PlacedMesh>;

impl<S: Listed> Default for ShapesOf<S> {
    fn default() -> Self {
        Self { row: Vec::new(), surface_data: Vec::new(), shape: Vec::new(), opaque: 0, prepared: OnceLock::new() }
    }
}

impl<S: Listed> ShapesOf<S> {
    /// Appends an opaque shape, with what its surface needs and its number.
    pub fn push(&mut self, (row, surface_data): (S, S::SurfaceData), shape: u32) {
        self.row.push(row);
        self.surface_data.push(surface_data);
        self.shape.push(shape);
        self.opaque += 1;
        self.prepared.take();
    }

    /// The opaque shapes, and their numbers.
    #[inline(always)]
    pub fn opaque(&self) -> (&[S], &[u32]) {
        (&self.row[..self.opaque], &self.shape[..self.opaque])
    }

    /// What [`Shape::keep_closest`](crate::shapes::Shape::keep_closest) reads of the opaque shapes besides.
    pub fn prepared(&self) -> &S::Prepared {
        self.prepared.get_or_init(|| S::prepared(self.opaque().0))
    }

    /// Those that pass a test, at the moment when the shutter opens.
    ///
    /// Errors: what is wrong with one of them.
    pub(super) fn that(scene: &Census<'_>, such: impl Fn(Entity) -> bool) -> Result<Self, SceneError> {
        let (eye, is_non_opaque) = (eye(scene)?, is_non_opaque(scene));
        let those = numbered::<S>(scene).into_iter().filter(|&(_, entity)| such(entity));
        let (others, opaque): (Vec<_>, Vec<_>) = those.partition(|&(_, entity)| is_non_opaque(entity));
        let (mut table, count) = (Self::default(), opaque.len());
        for (shape, entity) in opaque.into_iter().chain(others) {
            table.push(placed_shape::<S>(scene, entity, eye)?, shape as u32);
        }
        table.opaque = count;
        Ok(table)
    }
}

/// The shapes, numbered from 0.
impl<S: Listed> FromIterator<S> for ShapesOf<S> {
    fn from_iter<I: IntoIterator<Item = S>>(shapes: I) -> Self {
        let mut table = Self::default();
        shapes.into_iter().zip(0..).for_each(|(row, shape)| table.push((row, S::SurfaceData::default()), shape));
        table
    }
}

impl<S: Listed> Table for ShapesOf<S> {
    const NAME: &'static str = S::NAMES.table;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        if matches!(S::KIND, ShapeKind::Custom(_)) {
            check_is_added::<Self>(scene, S::Component::WORD, "add_shape")?;
        }
        let moves = moves_while_open(scene);
        Self::that(scene, |entity| !moves(entity))
    }

    fn bytes(&self) -> usize {
        self.row.len() * (size_of::<S>() + size_of::<S::SurfaceData>() + size_of::<u32>())
            + S::bytes_of_surface_data(&self.row)
    }
}

/// The shape of an entity, at the moment when the shutter opens.
pub(super) fn placed_shape<S: Listed>(
    scene: &Census<'_>,
    entity: Entity,
    eye: DVec3,
) -> Result<(S, S::SurfaceData), SceneError> {
    let component = scene.get::<S::Component>(entity).cloned().unwrap_or_default();
    let who = kind_and_name(scene, S::Component::WORD, entity);
    S::place(&component, &placed(scene, &who, entity, eye)?)
}

/// Where a shape's entity is placed.
fn placed<'a>(scene: &Census<'_>, who: &'a str, entity: Entity, eye: DVec3) -> Result<Placed<'a>, SceneError> {
    let pose = pose(scene, who, entity)?;
    let position = finite_point(who, "position", pose.world_from_entity.translation - eye)?;
    let scale = scene.get::<Placement>(entity).copied().unwrap_or_default().scale;
    Ok(Placed { who, pose, position, scale, has_parent: scene.get::<ChildOf>(entity).is_some() })
}

/// Vertex normals in world space, one row per triangle, in the order of [`TriangleTable`] and its sorted corners.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexNormalTable {
    /// Unit vectors on the side of the table's normal; all 0 where the author gave none.
    pub normals: Vec<[DVec3; 3]>,
    /// The same for each row of [`MovingTable`](super::MovingTable); all 0 where it holds another shape.
    pub moving: Vec<[DVec3; 3]>,
}

impl Table for VertexNormalTable {
    const NAME: &'static str = "vertex normals";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (eye, entities) = (eye(scene)?, shape_entities(scene));
        let of = |entity: Entity| -> Result<[DVec3; 3], SceneError> {
            let Some(triangle) = scene.get::<Triangle>(entity) else { return Ok([DVec3::ZERO; 3]) };
            let who = kind_and_name(scene, Triangle::WORD, entity);
            Ok(placed_normals(triangle, &placed(scene, &who, entity, eye)?)?.unwrap_or_default())
        };
        let still = &scene.table::<TriangleTable>()?.shape;
        let normals = still.iter().map(|&shape| of(entities[shape as usize])).collect::<Result<_, _>>()?;
        let moving = moving_shapes(scene).iter().map(|&(_, entity)| of(entity)).collect::<Result<_, _>>()?;
        Ok(Self { normals, moving })
    }

    fn bytes(&self) -> usize {
        (self.normals.len() + self.moving.len()) * size_of::<[DVec3; 3]>()
    }
}

/// The hierarchy over the opaque shapes of one kind, in the order of their table.
#[derive(Clone, Debug, Default)]
pub struct HierarchyOf<S: Listed> {
    /// The hierarchy; none where a shape has no bounding box.
    pub bvh: Option<Bvh>,
    of: PhantomData<fn() -> S>,
}

impl<S: Listed> Table for HierarchyOf<S> {
    const NAME: &'static str = S::NAMES.hierarchy;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let shapes = scene.table::<ShapesOf<S>>()?;
        let opaque = shapes.opaque().0;
        Ok(Self { bvh: if opaque.is_empty() { None } else { hierarchy_of(opaque) }, of: PhantomData })
    }

    fn bytes(&self) -> usize {
        self.bvh.as_ref().map_or(0, Bvh::bytes)
    }
}

/// Evidence that there are so many shapes of a kind that a hierarchy over them saves time.
pub fn hierarchy_evidence<S: Listed>(scene: &Census<'_>) -> Evidence {
    let found = kind_evidence::<S>(scene);
    if !(S::IS_BOUNDED && found.needed) {
        return Evidence { needed: false, count: 0, ..found };
    }
    let needed = found.count >= S::HIERARCHY_FROM;
    let those = counted(found.count, S::NOUN);
    let reason = match found.count {
        _ if needed => found.reason,
        1 => format!("{those} is tested alone"),
        _ => format!("{those} are tested one by one"),
    };
    Evidence { needed, reason, ..found }
}

// The shapes that something accepts, in words: asked of the registered shapes, so that a new one is named, too.

/// The shapes that can be made of glass: `a sphere, a closed cylinder, …, or triangles that close`.
pub fn shapes_with_inside(scene: &Census<'_>) -> String {
    let named = |listed: &ListedKind| {
        let [some, all] = (listed.examples_with_inside)();
        let always = all && !listed.has_primitives && !listed.is_part;
        some.then(|| named(listed, always, " that close"))
    };
    alternatives(listed_kinds(scene).filter_map(named))
}

/// The shapes that a medium can fill by themselves: `a sphere, a closed cylinder, … or a closed mesh`.
pub(super) fn bodies_in_words(scene: &Census<'_>) -> String {
    let named = |listed: &ListedKind| {
        let [some, all] = (listed.examples_with_inside)();
        (some && !listed.is_part).then(|| named(listed, all && !listed.has_primitives, ""))
    };
    alternatives(listed_kinds(scene).filter_map(named))
}

/// The shapes that can be sampled where they emit light: `a sphere, a disk, …, or triangles`.
pub fn sampled_shapes(scene: &Census<'_>) -> String {
    let named = |listed: &ListedKind| {
        let [some, all] = (listed.examples_sampled)();
        some.then(|| named(listed, all, ""))
    };
    alternatives(listed_kinds(scene).filter_map(named))
}

/// A kind with its article, or as many where several make up a surface; closed where some of the kind are open.
fn named(listed: &ListedKind, always: bool, together: &str) -> String {
    // A component of which only one kind is accepted has no word for itself: the placement decides.
    let by_scale = match listed.non_uniform {
        Some(true) => " with an uneven scale",
        Some(false) => " with a uniform scale",
        None => "",
    };
    match (listed.is_part, always) {
        (true, _) => format!("{}s{together}", listed.word),
        (false, true) => format!("{}{by_scale}", with_article(listed.word)),
        (false, false) => format!("a closed {}{by_scale}", listed.word),
    }
}

/// Each once; where both kinds of a component are accepted, its scale is not mentioned.
fn alternatives(names: impl Iterator<Item = String>) -> String {
    let mut listed: Vec<String> = Vec::new();
    for name in names {
        let other = name.replace(" with an uneven scale", " with a uniform scale");
        match listed.iter_mut().find(|own| **own == other && other != name) {
            Some(own) => *own = name.replace(" with an uneven scale", ""),
            None => listed.push(name),
        }
    }
    match &listed[..] {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        _ => listed.concat(),
    }
}

#[cfg(test)]
mod shapes_of_tests {
    use super::*;
    use crate::extract::{ShapeTable, non_uniformly_scaled};
    use crate::scene::{Matte, PerspectiveCamera, Sphere};
    use crate::shapes::ShapeKind;
    use glam::DQuat;

    fn scene(scales: &[DVec3]) -> (World, Vec<Entity>) {
        let mut world = World::new();
        world.spawn((PerspectiveCamera::default(), Placement::at(0.0, 0.0, 9.0)));
        let orientation = DQuat::from_xyzw(0.5, -0.1, 0.7, 0.5).normalize();
        let spawn = |&scale: &DVec3| {
            let placement = Placement { scale, orientation, position: DVec3::new(1.0, 2.0, 3.0) };
            world.spawn((Sphere { radius: 2.0 }, Matte::default(), placement)).id()
        };
        let spheres = scales.iter().map(spawn).collect();
        (world, spheres)
    }

    #[test]
    fn a_sphere_is_in_one_table_or_the_other() {
        let non_uniform = [DVec3::new(1.0, 1.0, 1.0 + 2e-9), DVec3::new(-1.0, 1.0, 2.0), DVec3::new(1e-3, 1.0, 1e3)];
        let even = [DVec3::ONE, DVec3::new(1.0, 1.0, 1.0 + 1e-12), DVec3::new(-2.0, 2.0, 2.0), DVec3::splat(-1e-9)];
        let (world, spheres) = scene(&[&non_uniform[..], &even].concat());
        let (shapes, ellipsoids) =
            (ShapeTable::extract(&Census::of(&world)), EllipsoidTable::extract(&Census::of(&world)));
        let (shapes, ellipsoids) = (shapes.expect("shapes"), ellipsoids.expect("ellipsoids"));
        let spheres_left = SphereTable::extract(&Census::of(&world)).expect("spheres");
        assert_eq!(ellipsoids.shape, [0, 1, 2]);
        assert_eq!(spheres_left.shape, [3, 4, 5, 6]);
        for (number, &sphere) in spheres.iter().enumerate() {
            let kind = if non_uniformly_scaled(&Census::of(&world), sphere) {
                ShapeKind::Ellipsoid
            } else {
                ShapeKind::Sphere
            };
            assert_eq!(shapes.kind[number], kind, "sphere {number}");
        }
    }

    #[test]
    fn the_map_takes_poles_to_the_unit_sphere() {
        let scale = DVec3::new(-1e-3, 3.0, 1e3);
        let (world, spheres) = scene(&[scale]);
        let table = EllipsoidTable::extract(&Census::of(&world)).expect("ellipsoids");
        let pose = pose(&Census::of(&world), "", spheres[0]).expect("a pose");
        let Ellipsoid { centre, unit_from_world, bounding_radius, .. } = table.row[0];
        assert_eq!(centre, DVec3::new(1.0, 2.0, -6.0));
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let pole = pose.world_from_entity.matrix3 * (axis * 2.0);
            assert!((unit_from_world * pole - axis).length() < 1e-7, "{axis}: {}", unit_from_world * pole);
            assert!(pole.length() <= bounding_radius);
        }
        assert!(bounding_radius < 2e3 * 1.0001);
    }

    #[test]
    fn a_sheared_sphere_fills_its_bounding_radius() {
        let (mut world, spheres) = scene(&[DVec3::new(1.0, 2.0, 0.5)]);
        let parent = world.spawn(Placement { scale: DVec3::new(3.0, 1.0, 100.0), ..Placement::default() }).id();
        world.entity_mut(spheres[0]).insert(ChildOf(parent));
        let map = pose(&Census::of(&world), "", spheres[0]).expect("a pose").world_from_entity.matrix3;
        let bounding_radius = EllipsoidTable::extract(&Census::of(&world)).expect("ellipsoids").row[0].bounding_radius;
        let steps = (0..100_000).map(|step| f64::from(step) * 1e-5 * std::f64::consts::TAU * 100.0);
        let point = |angle: f64| {
            let (height, round) = (libm::sin(angle / 200.0), libm::cos(angle / 200.0));
            map * (DVec3::new(libm::cos(angle) * round, libm::sin(angle) * round, height) * 2.0)
        };
        let farthest = steps.map(|angle| point(angle).length()).fold(0.0, f64::max);
        assert!(
            farthest <= bounding_radius && bounding_radius <= farthest * 1.02,
            "{farthest} within {bounding_radius}"
        );
    }

    #[test]
    fn an_ellipsoid_longer_than_ten_million_times_its_thickness_is_refused() {
        let table = |ratio: f64| EllipsoidTable::extract(&Census::of(&scene(&[DVec3::new(1.0, 1.0, ratio)]).0));
        assert!(table(0.999e7).is_ok() && table(1.001e-7).is_ok());
        for ratio in [2e7, 1e-8] {
            let scene_error = table(ratio).expect_err("refused").to_string();
            assert!(scene_error.contains("scale is (1, 1, ") && scene_error.contains("1e7 times"), "{scene_error}");
        }
    }
}
