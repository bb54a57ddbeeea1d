//! Which surfaces single precision may not keep apart from those of glass: they touch, or a body is that thin.

use super::motion::{moves_while_open, velocity_of};
use super::shapes::{listed_kind, one_shape, shape_entities};
use super::{MaterialTable, NO_ROW, ShapeTable, ShutterTable, eye, followed_evidence, glass_evidence};
use crate::each::Each;
use crate::plan::{Census, Evidence, Table};
use crate::scene::{SceneError, called};
use crate::shapes::{AnyShape, Bounds, l1_norm, offset_bound};
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::sync::Arc;

/// How many times the error bound of a hit point two surfaces must be apart to be certainly kept apart: a ray that is
/// spawned from one of them starts up to 1.5 bounds from it, and the search for others goes to two.
const APART: f64 = 4.0;

/// A gap that is smaller than this fraction of the numbers from which it is computed is none.
const TOUCHING: f64 = 1.0 / (1_u64 << 44) as f64;

/// A shape that may touch glass, or is of glass.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// The shape.
    pub body: AnyShape,
    /// Its number.
    pub shape: u32,
    /// The row of its glass; [`NO_ROW`] where it is of something else.
    pub glass: u32,
    /// Its velocity while the shutter is open, in scene units per unit of time.
    pub velocity: DVec3,
    /// A box around all points from which rounding may not keep its surface apart; all of space for an infinite shape.
    near: Bounds,
    /// How far from its surface such points are at most.
    margin: f64,
}

impl Contact {
    /// Whether rounding may not keep its surface apart from a point: quick, and true where nothing better is known.
    #[inline(always)]
    pub fn is_near(&self, point: DVec3) -> bool {
        match &self.body {
            AnyShape::Sphere(ball, ()) => ((point - ball.centre).length() - ball.radius).abs() <= self.margin,
            AnyShape::Plane(plane, _) => {
                let margin = 2.0 * APART * f64::from(offset_bound(point, DVec3::ZERO, plane.offset.abs()));
                (plane.normal.dot(point) - plane.offset).abs() <= margin
            }
            AnyShape::Cuboid(slabs, ()) => {
                // Outside by so much along the axis on which it is farthest out, or inside by as much where that is below 0.
                let outside = |axis: usize| slabs.normal[axis].dot(point - slabs.centre).abs() - slabs.half[axis];
                let farthest = outside(0).max(outside(1)).max(outside(2));
                farthest.abs() <= self.margin
            }
            _ => self.near.contains(point),
        }
    }
}

/// For each shape of glass, the shapes whose surfaces may coincide with its own within rounding, itself among them where
/// its two sides may.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactTable {
    /// The shapes of glass that have any, and those that they may touch.
    pub contact: Vec<Contact>,
    /// For each shape of glass by its number its row in that list; [`NO_ROW`] for one that touches none, and for other
    /// shapes.
    pub row: Vec<u32>,
    /// For each row of that list, where its others end in `other`; they begin where the previous row's end.
    pub end: Vec<u32>,
    /// Rows of that list.
    pub other: Vec<u32>,
}

impl ContactTable {
    /// The contacts of a row.
    #[inline(always)]
    pub fn others(&self, row: usize) -> &[u32] {
        let start = if row == 0 { 0 } else { self.end[row - 1] };
        &self.other[start as usize..self.end[row] as usize]
    }

    /// Whether any of a row's contacts may be near a point of its surface at a time, itself where its two sides may.
    #[inline(always)]
    pub fn is_near_any(&self, row: usize, point: DVec3, time: f64) -> bool {
        self.others(row).iter().any(|&other| {
            let contact = &self.contact[other as usize];
            other as usize == row || contact.is_near(point - contact.velocity * time)
        })
    }
}

impl Table for ContactTable {
    const NAME: &'static str = "contacts";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (shapes, pairs) = (glass_of_shapes(scene)?, contact_pairs(scene)?);
        let mut others: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for &[glass, other] in &pairs.touching {
            others.entry(glass).or_default().push(other);
            others.entry(other).or_default();
        }
        let mut table = Self { row: vec![NO_ROW; shapes.len()], ..Self::default() };
        for (number, &shape) in others.keys().enumerate() {
            table.row[shape] = number as u32;
            let body = body_of(scene, shape)?;
            let velocity = velocity_while_open(scene, shape);
            let (near, margin) = body.bounds().map_or((Bounds::ALL, 0.0), |bounds| (grow(&bounds), margin(&bounds)));
            table.contact.push(Contact { body, shape: shape as u32, glass: shapes[shape], velocity, near, margin });
        }
        for touched in others.values() {
            table.other.extend(touched.iter().map(|&shape| table.row[shape]));
            table.end.push(table.other.len() as u32);
        }
        for (&shape, _) in others.iter().filter(|(_, touched)| touched.is_empty()) {
            table.row[shape] = NO_ROW;
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.contact[..]) + (self.row.len() + self.end.len() + self.other.len()) * size_of::<u32>()
    }
}

/// Evidence that a surface may coincide with one of glass within rounding.
pub fn contact_evidence(scene: &Census<'_>) -> Evidence {
    evidence_of(scene, "nothing touches glass, and none is thin", |_| true)
}

/// Evidence that two surfaces of glass may.
pub fn glass_contact_evidence(scene: &Census<'_>) -> Evidence {
    evidence_of(scene, "no two surfaces of glass touch", |other| other != NO_ROW)
}

fn evidence_of(scene: &Census<'_>, none: &str, such: impl Fn(u32) -> bool) -> Evidence {
    let glass = glass_evidence(scene).and(|| followed_evidence(scene));
    if !glass.needed {
        return glass;
    }
    // A scene that cannot be extracted is reported before anything is rendered.
    let (Ok(shapes), Ok(pairs)) = (glass_of_shapes(scene), contact_pairs(scene)) else { return Evidence::default() };
    let mut found = pairs.touching.iter().filter(|[_, other]| such(shapes[*other]));
    let Some(&[one, other]) = found.next() else {
        return Evidence { needed: false, reason: none.into(), count: 0 };
    };
    let entities = shape_entities(scene);
    let [of, with] = [one, other].each(|shape| entities.get(shape).map_or_else(String::new, |&e| called(scene, e)));
    let reason = if one == other { format!("thin glass: {of}") } else { format!("{of} may touch {with}") };
    Evidence { needed: true, reason, count: 1 + found.count() }
}

/// What single precision cannot keep apart in a scene although it is apart: glass that is very thin, and balls with a
/// narrow gap between them; of either kind the first in spawn order, by their numbers, and how far apart they are, in
/// scene units.
pub fn unresolved(scene: &Census<'_>) -> Result<Vec<([usize; 2], f64)>, SceneError> {
    let (mut thin, mut gap) = (None, None);
    for &[one, other] in &contact_pairs(scene)?.touching {
        let (a, b) = (body_of(scene, one)?, body_of(scene, other)?);
        match (&a, &b) {
            _ if one == other => thin = thin.or(Some(([one, other], a.thickness()))),
            (AnyShape::Sphere(a, ()), AnyShape::Sphere(b, ())) => {
                let apart = (a.centre - b.centre).length();
                let between = (apart - (a.radius + b.radius)).abs().min((apart - (a.radius - b.radius).abs()).abs());
                // Rounding alone leaves as much between balls that touch.
                if between > TOUCHING * (a.radius + b.radius + l1_norm(a.centre)) {
                    gap = gap.or(Some(([one, other], between)));
                }
            }
            _ => {}
        }
    }
    Ok(thin.into_iter().chain(gap).collect())
}

/// Pairs of shapes, the first of them of glass, whose surfaces may coincide within rounding.
#[derive(Debug, Default)]
struct ContactPairs {
    touching: Vec<[usize; 2]>,
}

/// The row of each shape's glass; [`NO_ROW`] for other shapes.
fn glass_of_shapes(scene: &Census<'_>) -> Result<Vec<u32>, SceneError> {
    let (shapes, materials) = (scene.table::<ShapeTable>()?, scene.table::<MaterialTable>()?);
    let interior = |&material: &u32| if material == NO_ROW { NO_ROW } else { materials.interior[material as usize] };
    Ok(shapes.material.iter().map(interior).collect())
}

/// A shape at the moment when the shutter opens.
fn body_of(scene: &Census<'_>, shape: usize) -> Result<AnyShape, SceneError> {
    let entity = shape_entities(scene)[shape];
    (one_shape(scene, entity)?.body)(scene, entity, eye(scene)?)
}

/// The velocity of a shape that moves while the shutter is open; 0 for others.
fn velocity_while_open(scene: &Census<'_>, shape: usize) -> DVec3 {
    let entity = shape_entities(scene)[shape];
    if moves_while_open(scene)(entity) { velocity_of(scene, entity) } else { DVec3::ZERO }
}

/// A shape, with the box around all its positions while the shutter is open; none for an infinite one.
struct Boxed {
    shape: usize,
    bounds: Option<Bounds>,
}

fn contact_pairs(scene: &Census<'_>) -> Result<Arc<ContactPairs>, SceneError> {
    scene.once(|scene| find_pairs(scene).map(Arc::new))
}

fn find_pairs(scene: &Census<'_>) -> Result<ContactPairs, SceneError> {
    let (table, glass) = (scene.table::<ShapeTable>()?, glass_of_shapes(scene)?);
    let is_glass = |shape: usize| glass[shape] != NO_ROW;
    let mut pairs = ContactPairs::default();
    if !(0..glass.len()).any(is_glass) {
        return Ok(pairs);
    }
    let mut boxed = Vec::new();
    for shape in 0..shape_entities(scene).len() {
        // What moves is none of the listed kinds.
        let bounds = match listed_kind(scene, table.kind[shape]) {
            Some(listed) => (listed.bounds)(scene, table.row[shape] as usize)?,
            None => body_of(scene, shape)?.bounds(),
        };
        let moved = velocity_while_open(scene, shape) * scene.table::<ShutterTable>()?.length;
        let swept = |at: Bounds| at.joined(&Bounds { min: at.min + moved, max: at.max + moved });
        boxed.push(Boxed { shape, bounds: bounds.map(swept) });
    }
    let (mut bounded, infinite): (Vec<Boxed>, Vec<Boxed>) = boxed.into_iter().partition(|own| own.bounds.is_some());
    let grown = |own: &Boxed| own.bounds.map(|bounds| grow(&bounds)).unwrap_or(Bounds::ALL);
    bounded.sort_by(|a, b| {
        let [a_least, b_least] = [a, b].each(|own| grown(own).min.x);
        a_least.partial_cmp(&b_least).unwrap_or(Ordering::Equal).then(a.shape.cmp(&b.shape))
    });
    let mut candidates = Vec::new();
    // The boxes that a sweep along x is in; none of two opaque shapes concern glass.
    let mut open: Vec<&Boxed> = Vec::new();
    for own in &bounded {
        let bounds = grown(own);
        open.retain(|other| grown(other).max.x >= bounds.min.x);
        let near = open.iter().filter(|other| is_glass(own.shape) || is_glass(other.shape));
        candidates.extend(near.filter(|other| grown(other).overlaps(&bounds)).map(|other| [own.shape, other.shape]));
        open.push(own);
    }
    for plane in &infinite {
        let others = bounded.iter().chain(infinite.iter().filter(|other| other.shape < plane.shape));
        candidates.extend(others.map(|other| [plane.shape, other.shape]));
    }
    let mut bodies: BTreeMap<usize, AnyShape> = BTreeMap::new();
    for pair in candidates.into_iter().filter(|pair| pair.iter().any(|&shape| is_glass(shape))) {
        for shape in pair {
            if let std::collections::btree_map::Entry::Vacant(place) = bodies.entry(shape) {
                place.insert(body_of(scene, shape)?);
            }
        }
        let [one, other] = pair.each(|shape| velocity_while_open(scene, shape));
        if one != other || may_touch(pair.each(|shape| &bodies[&shape]), pair.each(|shape| glass[shape])) {
            let glassy = [pair, [pair[1], pair[0]]].into_iter().filter(|&[first, _]| is_glass(first));
            pairs.touching.extend(glassy);
        }
    }
    for own in bounded.iter().filter(|own| is_glass(own.shape)) {
        let body = body_of(scene, own.shape)?;
        if body.thickness() <= own.bounds.map_or(0.0, |bounds| margin(&bounds)) {
            pairs.touching.push([own.shape, own.shape]);
        }
    }
    pairs.touching.sort_unstable();
    pairs.touching.dedup();
    Ok(pairs)
}

/// How far from a surface in this box another must be to be certainly kept apart from it.
fn margin(bounds: &Bounds) -> f64 {
    let farthest = bounds.min.abs().max(bounds.max.abs());
    APART * f64::from(offset_bound(farthest, DVec3::ZERO, l1_norm(farthest)))
}

fn grow(bounds: &Bounds) -> Bounds {
    let by = DVec3::splat(margin(bounds));
    Bounds { min: bounds.min - by, max: bounds.max + by }
}

/// Whether the surfaces of two shapes whose boxes overlap may coincide over an area: true where nothing better is known.
///
/// Surfaces that only cross each other do not: the rays that come as near as rounding to such a line are too few to be
/// seen.
fn may_touch([one, other]: [&AnyShape; 2], glass: [u32; 2]) -> bool {
    let margin = [one, other].iter().filter_map(|body| body.bounds()).map(|own| margin(&own)).fold(0.0, f64::max);
    match (one, other) {
        (AnyShape::Sphere(a, ()), AnyShape::Sphere(b, ())) => {
            let apart = (a.centre - b.centre).length();
            let gaps = [apart - (a.radius + b.radius), apart - (a.radius - b.radius).abs()];
            gaps.iter().any(|gap| gap.abs() <= margin)
        }
        (AnyShape::Sphere(ball, ()), AnyShape::Plane(plane, _))
        | (AnyShape::Plane(plane, _), AnyShape::Sphere(ball, ())) => {
            let height = plane.normal.dot(ball.centre) - plane.offset;
            (height.abs() - ball.radius).abs() <= margin
        }
        (AnyShape::Cuboid(a, ()), AnyShape::Cuboid(b, ())) => {
            // Two faces of theirs must lie in one plane.
            let in_one_plane = |[own, other]: [usize; 2]| {
                let (n, m) = (a.normal[own], b.normal[other]);
                let side = n.dot(m).signum();
                let turned = (n - side * m).length() * (a.bounding_radius + b.bounding_radius);
                let apart = n.dot(a.centre) - side * m.dot(b.centre);
                let ends = [a.half[own] + b.half[other], a.half[own] - b.half[other]];
                turned <= margin && ends.iter().any(|end| (apart.abs() - end.abs()).abs() <= margin)
            };
            (0..9).any(|pair| in_one_plane([pair / 3, pair % 3]))
        }
        (AnyShape::Plane(a, _), AnyShape::Plane(b, _)) => {
            let side = a.normal.dot(b.normal).signum();
            let (turned, apart) = (a.normal - side * b.normal, a.offset - side * b.offset);
            let bound = f64::from(offset_bound(a.normal * a.offset, DVec3::ZERO, a.offset.abs()));
            turned.length() < 1e-6 && apart.abs() <= APART * bound
        }
        (AnyShape::Plane(plane, _), AnyShape::Mesh(mesh, ()))
        | (AnyShape::Mesh(mesh, ()), AnyShape::Plane(plane, _)) => {
            let is_in = |corner: &DVec3| (plane.normal.dot(*corner) - plane.offset).abs() <= margin;
            mesh.placed_triangles().any(|corners| corners.iter().all(is_in))
        }
        (AnyShape::Plane(plane, _), body) | (body, AnyShape::Plane(plane, _)) => {
            let Some(bounds) = body.bounds() else { return true };
            let (centre, half) = (0.5 * (bounds.min + bounds.max), 0.5 * (bounds.max - bounds.min));
            let (height, extent) = (plane.normal.dot(centre) - plane.offset, plane.normal.abs().dot(half));
            height.abs() <= extent + margin
        }
        // Neighbours in one surface have common corners.
        (AnyShape::Triangle(a, _), AnyShape::Triangle(b, _)) => {
            glass[0] != glass[1] || !a.corners.iter().any(|corner| b.corners.contains(corner))
        }
        (AnyShape::Mesh(mesh, ()), body) | (body, AnyShape::Mesh(mesh, ())) => {
            let Some(near) = body.bounds().map(|bounds| grow(&bounds)) else { return true };
            let around = |[a, b, c]: [DVec3; 3]| Bounds { min: a.min(b).min(c), max: a.max(b).max(c) };
            mesh.placed_triangles().any(|corners| around(corners).overlaps(&near))
        }
        _ => true,
    }
}
