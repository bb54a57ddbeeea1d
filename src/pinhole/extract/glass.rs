//! What is made of glass, and what fills it.

use super::check::kind_and_name;
use super::material::{in_use, used_material};
use super::motion::{moves_while_open, velocity_of};
use super::shapes::{listed_kind, moving_shapes, one_shape, shape_name, shapes_with_inside};
use super::{
    MaterialTable, NO_ROW, ShapeTable, ShutterTable, TriangleTable, eye, followed_evidence, needed_if, shape_entities,
};
use crate::each::Each;
use crate::material::{D_LINE, IndexCurve, Interior, checked_curve, interior_of, material_entities, one_material};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Dispersion, SceneError, called};
use crate::shapes::emitter::triangle_solid_angle;
use crate::shapes::{AnyShape, Bounds};
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap};
use std::f64::consts::PI;
use std::sync::Arc;

/// What fills the shapes whose surfaces transmit light, one row for each such material, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GlassTable {
    /// The index of refraction relative to a vacuum; of glass that disperses light, the one at 587.56 nm.
    pub ior: Vec<f64>,
    /// The absorption coefficient per scene unit: red, green, blue, at least 0.
    pub absorption: Vec<[f64; 3]>,
    /// Where two overlap, the one with the higher priority is present.
    pub priority: Vec<u32>,
    /// The index by wavelength, of glass that disperses light; empty where none does.
    pub curve: Vec<Option<IndexCurve>>,
}

impl Table for GlassTable {
    const NAME: &'static str = "glass";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        for &entity in material_entities(scene).iter() {
            let Some(interior) = interior_of(scene, entity)? else { continue };
            let curve = curve_of(scene, entity)?;
            table.ior.push(curve.map_or(interior.ior, |curve| curve.index(D_LINE)));
            table.curve.push(curve);
            table.absorption.push(interior.absorption);
            table.priority.push(interior.priority);
        }
        if table.curve.iter().all(Option::is_none) {
            table.curve.clear();
        }
        check_owners(scene)?;
        check_closed(scene)?;
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.ior.len() * (size_of::<[f64; 4]>() + size_of::<u32>()) + size_of_val(&self.curve[..])
    }
}

impl GlassTable {
    /// The index of a row at a wavelength in nm.
    #[inline(always)]
    pub fn index_at(&self, row: u32, wavelength: f64) -> f64 {
        match self.curve.get(row as usize) {
            Some(Some(curve)) => curve.index(wavelength),
            _ => self.ior[row as usize],
        }
    }

    /// Whether a row's index depends on the wavelength; not that of a vacuum, [`NO_ROW`].
    #[inline(always)]
    pub fn disperses(&self, row: u32) -> bool {
        self.curve.get(row as usize).is_some_and(Option::is_some)
    }
}

/// The index of an entity's glass by wavelength, where it has a dispersion.
fn curve_of(scene: &Census<'_>, entity: Entity) -> Result<Option<IndexCurve>, SceneError> {
    let Some(&own) = scene.get::<Dispersion>(entity) else { return Ok(None) };
    checked_curve(&kind_and_name(scene, "dispersion", entity), own).map(Some)
}

/// Checks that every dispersion is beside a glass that fills shapes.
fn check_owners(scene: &Census<'_>) -> Result<(), SceneError> {
    let owners = scene.entities::<With<Dispersion>>();
    let Some(&owner) = owners.iter().find(|&&own| !matches!(interior_of(scene, own), Ok(Some(_)))) else {
        return Ok(());
    };
    let value = one_material(scene, owner).map_or("missing", |own| own.word);
    let accepted = "it belongs on a Glass or RoughGlass, whose index of refraction it gives";
    Err(SceneError::new(kind_and_name(scene, "dispersion", owner), "material", value, accepted))
}

/// What a sheet of glass without an interior can be made of.
const SHEETS: &str = "; a pane that is a single sheet is made of thin_glass";

/// Checks that no shape without an interior is made of glass.
fn check_closed(scene: &Census<'_>) -> Result<(), SceneError> {
    for &shape in shape_entities(scene).iter() {
        let listed = one_shape(scene, shape)?;
        let Some(material) = used_material(scene, shape).filter(|&own| matches!(interior_of(scene, own), Ok(Some(_))))
        else {
            continue;
        };
        // Asked last, since a mesh has to look at all of its edges.
        if (listed.has_inside)(scene, shape) {
            continue;
        }
        let value = format!("the glass {}", called(scene, material));
        let accepted = format!("glass needs a shape with an interior: {}{SHEETS}", shapes_with_inside(scene));
        return Err(SceneError::new(kind_and_name(scene, listed.word, shape), "material", value, accepted));
    }
    check_meshes(scene)
}

/// Checks that the triangles of each kind of glass close around an interior, and move together if they move.
fn check_meshes(scene: &Census<'_>) -> Result<(), SceneError> {
    let shapes = shape_entities(scene);
    let all = if moving_shapes(scene).is_empty() { None } else { Some(TriangleTable::that(scene, |_| true)?) };
    let still = scene.table::<TriangleTable>()?;
    let triangles = all.as_ref().unwrap_or(&still);
    let mut meshes: BTreeMap<Entity, Vec<usize>> = BTreeMap::new();
    for (row, &shape) in triangles.shape.iter().enumerate() {
        let material = shapes.get(shape as usize).and_then(|&shape| used_material(scene, shape));
        if let Some(material) = material.filter(|&own| matches!(interior_of(scene, own), Ok(Some(_)))) {
            meshes.entry(material).or_default().push(row);
        }
    }
    let moves = moves_while_open(scene);
    let velocity = |row: usize| {
        let entity = shapes[triangles.shape[row] as usize];
        if moves(entity) { velocity_of(scene, entity) } else { DVec3::ZERO }
    };
    for rows in meshes.values() {
        if let Some(&row) = rows.iter().find(|&&row| velocity(row) != velocity(rows[0])) {
            let accepted =
                "while the shutter is open all triangles of one glass must move alike, so that it stays closed";
            let who = shape_name(scene, triangles.shape[row] as usize);
            return Err(SceneError::new(who, "motion", "another than its neighbours'", accepted));
        }
    }
    let open = meshes.iter().filter_map(|(material, rows)| Some((open_mesh(triangles, rows)?, *material)));
    let Some((OpenMesh { row, turned }, material)) = open.min_by_key(|(open, _)| open.row) else { return Ok(()) };
    let why = if turned {
        "this triangle shows another side than its neighbour: swap two of its vertices".to_owned()
    } else {
        format!("this triangle has an edge that no other triangle of the same glass has{SHEETS}")
    };
    let value = format!("the glass {}", called(scene, material));
    let accepted = format!("glass needs a shape with an interior, and {why}");
    Err(SceneError::new(shape_name(scene, triangles.shape[row] as usize), "material", value, accepted))
}

/// What encloses the inside of a glass body.
#[derive(Clone, Debug, PartialEq)]
enum Enclosure {
    /// A shape with an inside of its own.
    Shape(Box<AnyShape>),
    /// The loose triangles of one glass, which close around its inside: corners and outward normals.
    Triangles(Vec<([DVec3; 3], DVec3)>),
}

/// A body of glass in render space, of which points are asked whether they are inside.
#[derive(Clone, Debug, PartialEq)]
pub struct GlassBody {
    enclosure: Enclosure,
    /// Its row in the table of glass.
    pub glass: u32,
    /// Its velocity while the shutter is open, in scene units per unit of time.
    pub velocity: DVec3,
    /// A box around all places that it is at while the shutter is open; of infinite size for an infinite body.
    pub bounds: Bounds,
}

impl GlassBody {
    /// How many times its surface is around a point, at a time since the shutter opened.
    ///
    /// Around a point inside them, the solid angles of triangles that close, counted negative where a front is seen, add
    /// up to 4π for each time that they are around it, and to 0 for a point outside (Van Oosterom and Strackee 1983).
    pub fn windings(&self, point: DVec3, time: f64) -> u32 {
        let at_rest = point - self.velocity * time;
        match &self.enclosure {
            Enclosure::Shape(body) => body.windings(at_rest),
            Enclosure::Triangles(triangles) => {
                let signed = |(corners, normal): &([DVec3; 3], DVec3)| {
                    let seen = corners.each(|corner| corner - at_rest);
                    let angle = triangle_solid_angle(&seen);
                    if angle.is_finite() { angle.copysign(normal.dot(seen[0])) } else { 0.0 }
                };
                let around = triangles.iter().map(signed).sum::<f64>() / (4.0 * PI);
                around.round().max(0.0) as u32
            }
        }
    }
}

/// Lists the glass of the bodies that are around a point, at a time since the shutter opened; the first is what is there.
pub fn list_around<'b>(
    bodies: impl IntoIterator<Item = &'b GlassBody>,
    glass: &GlassTable,
    (point, time): (DVec3, f64),
    around: &mut Vec<u32>,
) {
    around.clear();
    for body in bodies {
        let windings = if body.bounds.contains(point) { body.windings(point, time) } else { 0 };
        around.extend((0..windings).map(|_| body.glass));
    }
    around.sort_by_key(|&row| (std::cmp::Reverse(glass.priority[row as usize]), row));
}

/// All bodies of glass: the medium at a point follows from which of them it is inside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GlassBodyTable {
    /// The bodies.
    pub row: Vec<GlassBody>,
}

impl Table for GlassBodyTable {
    const NAME: &'static str = "glass bodies";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (shapes, materials) = (scene.table::<ShapeTable>()?, scene.table::<MaterialTable>()?);
        let (eye, entities, moves) = (eye(scene)?, shape_entities(scene), moves_while_open(scene));
        let open = scene.table::<ShutterTable>()?.length;
        let mut table = Self::default();
        let mut loose: BTreeMap<u32, GlassBody> = BTreeMap::new();
        for (shape, &entity) in entities.iter().enumerate() {
            let material = shapes.material[shape];
            let glass = if material == NO_ROW { NO_ROW } else { materials.interior[material as usize] };
            if glass == NO_ROW {
                continue;
            }
            let velocity = if moves(entity) { velocity_of(scene, entity) } else { DVec3::ZERO };
            let body = (one_shape(scene, entity)?.body)(scene, entity, eye)?;
            let bounds = swept(body.bounds(), velocity * open);
            if let AnyShape::Triangle(row, face) = &body {
                let whole = loose.entry(glass).or_insert_with(|| GlassBody {
                    enclosure: Enclosure::Triangles(Vec::new()),
                    glass,
                    velocity,
                    bounds,
                });
                whole.bounds = whole.bounds.joined(&bounds);
                if let Enclosure::Triangles(triangles) = &mut whole.enclosure {
                    triangles.push((row.corners, face.normal));
                }
            } else {
                table.row.push(GlassBody { enclosure: Enclosure::Shape(Box::new(body)), glass, velocity, bounds });
            }
        }
        table.row.extend(loose.into_values());
        Ok(table)
    }

    fn bytes(&self) -> usize {
        let of = |body: &GlassBody| match &body.enclosure {
            Enclosure::Shape(_) => 0,
            Enclosure::Triangles(triangles) => size_of_val(&triangles[..]),
        };
        size_of_val(&self.row[..]) + self.row.iter().map(of).sum::<usize>()
    }
}

/// A box around a shape at rest and moved by so much; all of space for an infinite shape.
fn swept(bounds: Option<Bounds>, moved: DVec3) -> Bounds {
    let Some(Bounds { min, max }) = bounds else { return Bounds::ALL };
    Bounds { min, max }.joined(&Bounds { min: min + moved, max: max + moved })
}

/// A glass shape with its bounding box.
struct BoundedGlass {
    /// Its number.
    shape: usize,
    /// The row of its glass.
    of: u32,
    /// Whether it is part of a larger surface, such as a triangle of a mesh.
    part: bool,
    bounds: Bounds,
}

/// Evidence of a shape filled with what passes a test.
fn glass_that(scene: &Census<'_>, noun: &str, such: impl Fn(&Interior) -> bool) -> Evidence {
    let such = |&entity: &Entity| interior_of(scene, entity).ok().flatten().is_some_and(|own| such(&own));
    let of = |entities: Arc<[Entity]>| entities.iter().copied().filter(such).collect::<Vec<_>>();
    let (in_use, found) = (in_use(scene), of(material_entities(scene)));
    Evidence::among_entities(scene, noun, |entity| in_use.contains(&entity), &found, &found)
}

/// Evidence that a shape is made of absorbing glass.
pub fn absorption_evidence(scene: &Census<'_>) -> Evidence {
    glass_that(scene, "absorbing glass surface", |glass| glass.absorption != [0.0; 3])
}

/// Evidence of a shape filled with glass whose index depends on the wavelength.
pub fn dispersion_evidence(scene: &Census<'_>) -> Evidence {
    let in_use = in_use(scene);
    Evidence::among::<With<Dispersion>>(scene, "dispersing glass surface", |entity| in_use.contains(&entity.id()))
}

/// Evidence that each path has a wavelength: glass disperses light, and its rays are sampled instead of split.
pub fn wavelength_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let sampled = || {
            let splits = needed_if(scene, |integrator| integrator.transport().splits_at_glass);
            let reason = format!("{} splits rays instead of sampling them", splits.reason);
            if splits.needed { Evidence { needed: false, reason, count: 0 } } else { followed_evidence(scene) }
        };
        dispersion_evidence(scene).and(sampled)
    })
}

/// Evidence that two glass shapes may overlap, according to their bounding boxes.
///
/// Triangles of the same glass are taken for parts of one surface.
pub fn glass_overlaps(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let none = || Evidence { needed: false, reason: "no two shapes of glass overlap".into(), count: 0 };
        // A scene that cannot be extracted is reported before anything is rendered.
        let Ok(shapes) = bounded_glass(scene) else { return none() };
        match first_overlap(shapes) {
            None => none(),
            Some(pair) => {
                let entities = shape_entities(scene);
                let [one, other] =
                    pair.each(|shape| entities.get(shape).map_or_else(String::new, |&e| called(scene, e)));
                let reason = format!("shapes of glass may overlap: {one}, {other}");
                Evidence { needed: true, reason, count: 2 }
            }
        }
    })
}

/// Evidence that more than this many glass shapes may contain a common point, according to their bounding boxes.
///
/// It may be wrong for shapes that do not, but never misses shapes that do.
pub fn deep_glass(scene: &Census<'_>, places: usize) -> Evidence {
    let none = || Evidence { needed: false, reason: format!("no {} shapes of glass overlap", places + 1), count: 0 };
    // A scene that cannot be extracted is reported before anything is rendered.
    let Ok(shapes) = bounded_glass(scene) else { return none() };
    if !overlap_deeply(&surfaces(shapes), places) {
        return none();
    }
    let count = places + 1;
    Evidence { needed: true, reason: format!("{count} shapes of glass or more may overlap"), count }
}

/// The same with the parts of one surface merged.
fn surfaces(shapes: Vec<BoundedGlass>) -> Vec<BoundedGlass> {
    let (parts, mut whole): (Vec<BoundedGlass>, Vec<BoundedGlass>) = shapes.into_iter().partition(|shape| shape.part);
    let mut of_glass: BTreeMap<u32, BoundedGlass> = BTreeMap::new();
    for part in parts {
        let surface = of_glass.entry(part.of).or_insert(BoundedGlass { ..part });
        surface.bounds.min = surface.bounds.min.min(part.bounds.min);
        surface.bounds.max = surface.bounds.max.max(part.bounds.max);
    }
    whole.extend(of_glass.into_values());
    whole
}

/// Whether a point may be inside more than this many shapes.
fn overlap_deeply(shapes: &[BoundedGlass], places: usize) -> bool {
    let mut order: Vec<&Bounds> = shapes.iter().map(|shape| &shape.bounds).collect();
    order.sort_by(|a, b| a.min.x.partial_cmp(&b.min.x).unwrap_or(Ordering::Equal));
    let mut open: Vec<&Bounds> = Vec::new();
    for bounds in order {
        open.retain(|other| other.max.x >= bounds.min.x);
        let mut about: Vec<&Bounds> = open.iter().copied().filter(|other| other.overlaps(bounds)).collect();
        about.push(bounds);
        if about.len() > places && have_a_common_point(&about, places) {
            return true;
        }
        open.push(bounds);
    }
    false
}

/// With more boxes than this that overlap one of them, some are assumed to have a common point, since a closer look
/// would take long.
const MANY: usize = 64;

/// Whether more than this many boxes, which all contain the x at which the last of them begins, have a common point: if
/// any does, then one at whose y and z some of them begin.
fn have_a_common_point(boxes: &[&Bounds], places: usize) -> bool {
    let contains = |along: usize, at: f64| move |other: &&&Bounds| (other.min[along]..=other.max[along]).contains(&at);
    boxes.len() > MANY
        || boxes.iter().any(|first| {
            let beside: Vec<&Bounds> = boxes.iter().filter(contains(1, first.min.y)).copied().collect();
            let deepest = beside.iter().map(|own| beside.iter().filter(contains(2, own.min.z)).count()).max();
            deepest.is_some_and(|deepest| deepest > places)
        })
}

/// The numbers of two shapes whose boxes overlap, the first such pair along x.
fn first_overlap(mut shapes: Vec<BoundedGlass>) -> Option<[usize; 2]> {
    let by_least = |a: &BoundedGlass, b: &BoundedGlass| {
        a.bounds.min.x.partial_cmp(&b.bounds.min.x).unwrap_or(Ordering::Equal).then(a.shape.cmp(&b.shape))
    };
    shapes.sort_by(by_least);
    let mut open: Vec<&BoundedGlass> = Vec::new();
    for shape in &shapes {
        open.retain(|other| other.bounds.max.x >= shape.bounds.min.x);
        let overlaps = |other: &&&BoundedGlass| {
            let one_surface = shape.part && other.part && shape.of == other.of;
            !one_surface && other.bounds.overlaps(&shape.bounds)
        };
        if let Some(other) = open.iter().find(overlaps) {
            let (one, other) = (shape.shape.min(other.shape), shape.shape.max(other.shape));
            return Some([one, other]);
        }
        open.push(shape);
    }
    None
}

/// Every glass shape.
fn bounded_glass(scene: &Census<'_>) -> Result<Vec<BoundedGlass>, SceneError> {
    let (shapes, materials) = (scene.table::<ShapeTable>()?, scene.table::<MaterialTable>()?);
    let is_glass = |&shape: &usize| {
        let material = shapes.material[shape];
        material != NO_ROW && materials.interior[material as usize] != NO_ROW
    };
    let glass: Vec<usize> = (0..shapes.kind.len()).filter(is_glass).collect();
    let entities = shape_entities(scene);
    let bounded = glass.into_iter().map(|shape| {
        let (listed, row) = (listed_kind(scene, shapes.kind[shape]), shapes.row[shape] as usize);
        // A plane is infinite, and a moving shape may go anywhere.
        let anywhere = Bounds { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
        let bounds = listed.map_or(Ok(None), |listed| (listed.bounds)(scene, row))?.unwrap_or(anywhere);
        let part = one_shape(scene, entities[shape])?.is_part;
        Ok(BoundedGlass { shape, of: materials.interior[shapes.material[shape] as usize], part, bounds })
    });
    bounded.collect()
}

// Whether triangles enclose an interior.

/// Corners nearer to one another than this fraction of the mesh's extent may be one corner that rounding has moved.
const ONE_CORNER: f64 = 1e-9;
/// How many corners after it, in order of x, are compared with each corner.
const COMPARED: usize = 256;

/// Why triangles have no interior.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct OpenMesh {
    /// The row of the first triangle with such an edge.
    pub row: usize,
    /// Whether its neighbour is there, but shows the other side.
    pub turned: bool,
}

/// A corner of some triangle, by its bits.
type Corner = [u64; 3];
/// An edge, its smaller corner first.
type Edge = [Corner; 2];

/// The first of these rows that has an edge without a neighbour; none if every edge is passed as often in one direction
/// as in the other, as it is on a closed surface whose triangles all show the same side.
pub(super) fn open_mesh(triangles: &TriangleTable, rows: &[usize]) -> Option<OpenMesh> {
    let mut unmatched = sums(triangles, rows, &|corner| corner);
    unmatched.retain(|_, (sum, _)| *sum != 0);
    if unmatched.is_empty() {
        return None;
    }
    let joined = joined(triangles, rows, unmatched.keys().flatten().copied().collect());
    let sums = sums(triangles, rows, &|corner| joined.get(&corner).copied().unwrap_or(corner));
    let open = sums.values().filter(|(sum, _)| *sum != 0).min_by_key(|(_, (row, _))| *row);
    open.map(|&(_, (row, count))| OpenMesh { row, turned: count > 1 })
}

/// For each edge how often it is passed from its smaller corner to its greater minus how often back, the first row that
/// has it, and the number of triangles that have it.
fn sums(
    triangles: &TriangleTable,
    rows: &[usize],
    joined: &dyn Fn(Corner) -> Corner,
) -> HashMap<Edge, (i64, (usize, usize))> {
    let mut sums = HashMap::new();
    for &row in rows {
        let corners = triangles.row[row].corners.each(|corner| joined(bits(corner)));
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let [from, to] = [corners[from], corners[to]];
            let step = if (from < to) == triangles.surface_data[row].turned { -1 } else { 1 };
            if from != to {
                let (sum, (_, count)) = sums.entry([from.min(to), from.max(to)]).or_insert((0, (row, 0)));
                *sum += step;
                *count += 1;
            }
        }
    }
    sums
}

fn bits(corner: DVec3) -> Corner {
    // −0 and 0 are one place.
    corner.to_array().each(|part| (part + 0.0).to_bits())
}

/// For each of these corners the one that stands for all that may be the same.
fn joined(triangles: &TriangleTable, rows: &[usize], corners: Vec<Corner>) -> HashMap<Corner, Corner> {
    let all = || rows.iter().flat_map(|&row| triangles.row[row].corners);
    let (min, max) = all().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), at| (min.min(at), max.max(at)));
    let apart = ONE_CORNER * (max - min).max_element();
    let mut sorted: Vec<DVec3> = corners.into_iter().map(|corner| DVec3::from(corner.each(f64::from_bits))).collect();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
    sorted.dedup();
    let mut joined = HashMap::new();
    for (number, &corner) in sorted.iter().enumerate() {
        let own = *joined.entry(bits(corner)).or_insert(bits(corner));
        let near = sorted[number + 1..].iter().take(COMPARED).take_while(|other| other.x - corner.x <= apart);
        for &other in near.filter(|other| (**other - corner).abs().max_element() <= apart) {
            joined.entry(bits(other)).or_insert(own);
        }
    }
    joined
}

#[cfg(test)]
mod glass_overlap_tests {
    use super::*;
    use crate::scene::{Glass, Matte, Name, PerspectiveCamera, Placement, Plane, Sphere, Triangle, UsesMaterial};

    fn world(balls: &[(f64, f64)]) -> World {
        let mut world = World::new();
        world.spawn((PerspectiveCamera::default(), Placement::at(0.0, 0.0, 9.0)));
        for &(x, radius) in balls {
            world.spawn((
                Name::new(format!("ball at {x}")),
                Sphere { radius },
                Glass::default(),
                Placement::at(x, 0.0, 0.0),
            ));
        }
        world
    }

    #[test]
    fn overlaps_are_found_and_named() {
        let apart = [(0.0, 1.0), (2.5, 1.0), (-3.0, 0.5), (10.0, 1.0)];
        assert!(!glass_overlaps(&Census::of(&world(&apart))).needed);
        let mut touching = world(&apart);
        touching.spawn((Name::new("bubble"), Sphere { radius: 0.2 }, Glass::default(), Placement::at(2.5, 0.0, 0.0)));
        let found = glass_overlaps(&Census::of(&touching));
        assert!(
            found.needed && found.reason.contains("\"ball at 2.5\"") && found.reason.contains("\"bubble\""),
            "{found:?}"
        );
        let mut pond = world(&apart[..1]);
        assert!(!glass_overlaps(&Census::of(&pond)).needed);
        pond.spawn((Plane::default(), Glass::default()));
        assert!(glass_overlaps(&Census::of(&pond)).needed, "a plane is infinite");
        let mut stone = world(&apart[..1]);
        stone.spawn((Sphere { radius: 0.5 }, Matte::default()));
        assert!(!glass_overlaps(&Census::of(&stone)).needed, "a material other than glass");
    }

    #[test]
    fn depth_counts_boxes_with_a_common_point() {
        let depth =
            |balls: &[(f64, f64)]| (0..12).find(|&places| !deep_glass(&Census::of(&world(balls)), places).needed);
        assert_eq!(depth(&[]), Some(0));
        assert_eq!(depth(&[(0.0, 1.0), (5.0, 1.0)]), Some(1));
        assert_eq!(depth(&[(0.0, 1.0), (0.0, 0.9), (0.0, 0.8), (0.0, 0.7), (0.0, 0.6)]), Some(5));
        // A row of balls, each of which overlaps with both of its neighbours, within a large one.
        let row: Vec<(f64, f64)> = (0..9).map(|at| (1.5 * f64::from(at), 1.0)).chain([(6.0, 20.0)]).collect();
        assert_eq!(depth(&row), Some(3));
    }

    #[test]
    fn a_mesh_is_one_surface() {
        let mut mesh = world(&[]);
        let glass = mesh.spawn(Glass::default()).id();
        for at in 0..4 {
            mesh.spawn((Triangle::default(), UsesMaterial(glass), Placement::at(0.1 * f64::from(at), 0.0, 0.0)));
        }
        assert!(!glass_overlaps(&Census::of(&mesh)).needed);
        mesh.spawn((Sphere { radius: 0.1 }, UsesMaterial(glass)));
        assert!(glass_overlaps(&Census::of(&mesh)).needed);
    }
}

#[cfg(test)]
mod closed_mesh_tests {
    use super::*;
    use crate::measure::draws::Draws;
    use crate::shapes::TriangleFace;
    use glam::{DQuat, DVec2};

    /// The corners of a platonic solid's triangles, anticlockwise from outside.
    fn solids() -> [(&'static str, Vec<[DVec3; 3]>); 3] {
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
        let facing =
            |[a, b, c]: [DVec3; 3]| if (b - a).cross(c - a).dot(a + b + c) > 0.0 { [a, b, c] } else { [a, c, b] };
        let corners = [x + y + z, x - y - z, y - x - z, z - x - y];
        let tetrahedron = (0..4).map(|left| {
            let [a, b, c] = [1, 2, 3].map(|step| corners[(left + step) % 4]);
            facing([a, b, c])
        });
        let octahedron = (0..8).map(|octant: u32| {
            let side = |bit: u32| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
            facing([x * side(0), y * side(1), z * side(2)])
        });
        let cube = [x, y, z].into_iter().flat_map(|axis| [axis, -axis]).flat_map(|out| {
            let (u, v) = (DVec3::new(out.y, out.z, out.x), DVec3::new(out.z, out.x, out.y));
            [[out + u + v, out - u + v, out - u - v], [out + u + v, out - u - v, out + u - v]].each(facing)
        });
        [("tetrahedron", tetrahedron.collect()), ("octahedron", octahedron.collect()), ("cube", cube.collect())]
    }

    fn table(triangles: &[[DVec3; 3]]) -> (TriangleTable, Vec<usize>) {
        let mut table = TriangleTable::default();
        for corners in triangles {
            let (row, face) = TriangleFace::of(*corners, [DVec2::ZERO, DVec2::X, DVec2::Y]);
            table.row.push(row);
            table.surface_data.push(face);
            table.shape.push(0);
        }
        (table, (0..triangles.len()).collect())
    }

    /// Solids as they are, one of their triangles missing, one turned round, all turned round, and corners that rounding
    /// has moved.
    #[test]
    fn solids_are_closed_and_no_part_of_them_is() {
        let (mut closed, mut open) = (0, 0);
        for (name, solid) in solids() {
            for index in 0..20 {
                let mut draws = Draws::new(27, index);
                let turn = DQuat::from_vec4(draws.unit_vector().extend(draws.between(-1.0, 1.0))).normalize();
                let (size, place) = (draws.power_of_ten(-6.0, 6.0), draws.unit_vector() * 3.0);
                let solid: Vec<_> = solid.iter().map(|corners| corners.map(|at| size * (turn * at + place))).collect();
                let found = |triangles: &[[DVec3; 3]]| {
                    let (table, rows) = table(triangles);
                    open_mesh(&table, &rows)
                };
                assert_eq!(found(&solid), None, "{name}");
                let turned: Vec<_> = solid.iter().map(|&[a, b, c]| [a, c, b]).collect();
                assert_eq!(found(&turned), None, "{name} inside out");
                let shaken: Vec<_> =
                    solid.iter().map(|at| at.map(|at| at + 1e-15 * size * draws.unit_vector())).collect();
                assert_eq!(found(&shaken), None, "{name} with rounded corners");
                closed += 3;
                for missing in 0..solid.len() {
                    let mut holed = solid.clone();
                    holed.remove(missing);
                    assert!(found(&holed).is_some_and(|open| !open.turned), "{name} without {missing}");
                    let mut wrong = solid.clone();
                    wrong[missing].swap(0, 1);
                    assert!(found(&wrong).is_some_and(|open| open.turned), "{name} with {missing} turned");
                    open += 2;
                }
            }
        }
        eprintln!("meshes: {closed} closed, {open} open or with a triangle turned round");
    }
}
