use super::material::in_use;
use super::shape_kind::{listed_kind, one_shape};
use super::{MaterialTable, NO_ROW, ShapeTable, shape_entities};
use crate::material::{Interior, interior_of, material_entities};
use crate::plan::{Census, Evidence};
use crate::scene::{SceneError, called};
use crate::shapes::Bounds;
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::sync::Arc;

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
                    pair.map(|shape| entities.get(shape).map_or_else(String::new, |&e| called(scene, e)));
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

#[cfg(test)]
mod tests {
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
