use super::shape_kind::{one_shape, shape_entities};
use super::velocity::{moves_while_open, velocity_of};
use super::{GlassTable, MaterialTable, NO_ROW, ShapeTable, ShutterTable, eye};
use crate::plan::{Census, Table};
use crate::scene::SceneError;
use crate::shapes::emitter::triangle_solid_angle;
use crate::shapes::{AnyShape, Bounds};
use glam::DVec3;
use std::collections::BTreeMap;
use std::f64::consts::PI;

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
                    let seen = corners.map(|corner| corner - at_rest);
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
