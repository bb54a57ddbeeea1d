//! Surfaces that coincide with a hit within rounding: they are crossed, or hit, in one event.

use super::{HitPrimitives, Hits, Surfaces, list_rows};
use crate::extract::{Contact, ContactTable, NO_ROW, contact_evidence};
use crate::plan::{
    Column, ColumnComponent, ComponentValues, Lifetime, RowLists, Shared, Stage, TileSystems, column_component,
};
use crate::rays::{RayTimes, WorldRays};
use crate::shapes::{RayHit, SurfacePoint};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::DVec3;

/// A surface of glass that is crossed together with others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlassCrossing {
    /// The row of its glass.
    pub glass: u32,
    /// Whether the ray arrives on the outward side.
    pub from_outside: bool,
    /// How far it lies beyond the hit point along the normal, in scene units.
    pub depth: f32,
}

/// The surfaces of glass that each ray crosses in one event, where there are several, its hit among them, the nearest
/// first; exists where surfaces of glass may coincide within rounding.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contacts {
    /// The surfaces; none where a ray crosses its hit alone.
    pub crossings: RowLists<GlassCrossing>,
    /// The rows that hit something else than glass behind glass that is in contact with it, and how far behind.
    pub behind: Vec<(u32, f32)>,
}

impl Contacts {
    /// How far beyond the hit point the last of them lies.
    #[inline(always)]
    pub fn depth(&self, row: usize) -> f32 {
        self.crossings
            .get(row)
            .iter()
            .fold(0.0, |max, crossing| if crossing.depth > max { crossing.depth } else { max })
    }
}

column_component!(Contacts);

impl Column for Contacts {
    const NAME: &'static str = "contacts";
    const SPACE: &'static str = "along the normal";
    const UNIT: &'static str = "places in a list of surfaces";
    const LIFETIME: Lifetime = Lifetime::Ray;

    fn rows(&self) -> usize {
        self.crossings.ends().len()
    }

    fn components(&self) -> Vec<ColumnComponent<'_>> {
        vec![ColumnComponent { name: "end", values: ComponentValues::U32(self.crossings.ends()) }]
    }

    fn paint(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [f32::from(u8::from(!self.crossings.get(row).is_empty())); 3]
    }
}

/// How far in front of a hit the search begins, as a fraction of its error bound: more than f64 can be wrong by.
const IN_FRONT: f64 = 1.0 / 8.0;
/// How far beyond the last surface found it goes on: a spawned ray starts at most 1.5 bounds beyond.
const BEYOND: f64 = 2.0;
/// The step from one surface to the search for the next, as a fraction of the bound.
const STEP: f64 = 1.0 / (1_u64 << 16) as f64;
/// A surface found near a hit, and which of the shapes near it has it.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    depth: f64,
    contact: u32,
    from_outside: bool,
    primitive: u32,
}

// ANCHOR: find_contacts
/// Looks for the surfaces that the segment from just in front of a hit to just beyond it crosses: a ray that is spawned
/// on the far side would start beyond them all.
///
/// The segment runs along the normal, as the offset of a spawned ray does, and grows with each surface found, so that
/// nothing within the error bound of the last one is left out.
fn find(table: &ContactTable, row: usize, (surface, time): (&SurfacePoint, f64), found: &mut Vec<Found>) {
    let bound = f64::from(surface.bound);
    let (start, inward) = (surface.point + IN_FRONT * bound * surface.normal, -surface.normal);
    let mut end = BEYOND * bound;
    loop {
        found.clear();
        // Its own surface is there, and may come again.
        let others = table.others(row).iter().copied().filter(|&other| other != row as u32);
        for contact in std::iter::once(row as u32).chain(others) {
            let (Contact { body, velocity, .. }, mut from) = (&table.contact[contact as usize], 0.0);
            let start = start - *velocity * time;
            loop {
                let origin = start + from * inward;
                let t = body.t(origin, inward);
                let depth = from + t - IN_FRONT * bound;
                if !(depth <= end) {
                    break;
                }
                let primitive = body.primitive_at(origin, inward, t);
                let hit = RayHit { primitive, ..RayHit::at_rest(origin, inward, t) };
                found.push(Found { depth, contact, from_outside: body.surface(&hit).outside, primitive });
                from += t + STEP * bound;
            }
        }
        let deepest = found.iter().fold(0.0, |max, own| f64::max(max, own.depth));
        if deepest + BEYOND * bound <= end {
            break;
        }
        end = deepest + BEYOND * bound;
    }
    found.sort_by(|a, b| a.depth.total_cmp(&b.depth));
}
// ANCHOR_END: find_contacts

/// The hits of a tile, and the lists of surfaces that coincide with them.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct ContactView {
    rays: &'static WorldRays,
    times: Option<&'static RayTimes>,
    hits: &'static mut Hits,
    primitives: Option<&'static mut HitPrimitives>,
    contacts: Option<&'static mut Contacts>,
}

/// Merges the surfaces that coincide with the hits of a tile on glass.
///
/// Where one of them is of something else than glass, it is what the ray hits, whichever was found first, for nothing
/// goes through it; the glass in front of it and the glass that the ray is in are then in contact with it.
/// Where all are of glass, they are crossed together.
pub fn merge_contacts(
    table: Res<Shared<ContactTable>>,
    (mut list, mut near, mut together): (Local<Vec<u32>>, Local<Vec<Found>>, Local<Vec<GlassCrossing>>),
    mut tiles: Query<ContactView>,
) {
    for ContactViewItem { rays, times, mut hits, mut primitives, mut contacts } in &mut tiles {
        if let Some(contacts) = &mut contacts {
            contacts.crossings.start(0);
            contacts.behind.clear();
        }
        // Neither a miss nor a scattering event is in the table.
        list_rows(&hits, &table.row, &mut list, |&row| row != NO_ROW);
        for row in list.iter().map(|&row| row as usize) {
            together.clear();
            let time = times.map_or(0.0, |times| times.time[row]);
            let primitive = primitives.as_ref().map_or(0, |primitives| primitives.primitive[row]);
            if let Some((own, surface)) = touching(&table, rays, &hits, (row, primitive, time)) {
                find(&table, own, (&surface, time), &mut near);
                match near.iter().find(|found| table.contact[found.contact as usize].glass == NO_ROW) {
                    Some(found) => {
                        let ray = [rays.origin_of(row), rays.direction_of(row)];
                        hits.t[row] = t_behind(&table, found, (ray, time), (hits.t[row], &surface));
                        hits.shape[row] = table.contact[found.contact as usize].shape;
                        if let Some(primitives) = &mut primitives {
                            primitives.primitive[row] = found.primitive;
                        }
                        if let Some(contacts) = contacts.as_mut().filter(|_| found.depth > 0.0) {
                            contacts.behind.push((row as u32, found.depth as f32));
                        }
                    }
                    // Its own surface alone is crossed as any other.
                    None if near.len() > 1 => together.extend(near.iter().map(|found| GlassCrossing {
                        glass: table.contact[found.contact as usize].glass,
                        from_outside: found.from_outside,
                        depth: found.depth as f32,
                    })),
                    None => {}
                }
            }
            if let Some(contacts) = contacts.as_mut().filter(|_| !together.is_empty()) {
                contacts.crossings.fill_to(row);
                contacts.crossings.push(&together);
            }
        }
        if let Some(contacts) = &mut contacts {
            contacts.crossings.fill_to(hits.rows());
        }
    }
}

/// The row of contacts of the shape that a listed ray hit, and the surface there, if any other is near.
#[inline(always)]
fn touching(
    table: &ContactTable,
    rays: &WorldRays,
    hits: &Hits,
    (row, primitive, time): (usize, u32, f64),
) -> Option<(usize, SurfacePoint)> {
    let own = table.row[hits.shape[row] as usize];
    if !table.is_near_any(own as usize, rays.point_at(row, hits.t[row]), time) {
        return None;
    }
    let Contact { body, velocity, .. } = &table.contact[own as usize];
    let displacement = *velocity * time;
    let (origin, direction) = (rays.origin_of(row) - displacement, rays.direction_of(row));
    let mut surface = body.surface(&RayHit { origin, direction, t: hits.t[row], primitive, displacement });
    surface.point += displacement;
    Some((own as usize, surface))
}

/// The t at which a ray hits what is found behind the glass that it hit at `t`, which is the same but for rounding: of a
/// ray that grazes an edge and goes on elsewhere, it stays what it is.
fn t_behind(
    table: &ContactTable,
    found: &Found,
    ([origin, direction], time): ([DVec3; 2], f64),
    (t, surface): (f64, &SurfacePoint),
) -> f64 {
    let Contact { body, velocity, .. } = &table.contact[found.contact as usize];
    let own = body.t(origin - *velocity * time, direction);
    let apart = (own - t).abs() * surface.normal.dot(direction).abs();
    if apart <= found.depth.abs() + BEYOND * f64::from(surface.bound) { own } else { t }
}

/// Widens the bounds of hits behind glass that is in contact with them, so that the rays which they spawn start in front
/// of it: these are in the medium that the ray came in.
pub fn widen_bounds(mut tiles: Query<(&Contacts, &mut Surfaces)>) {
    for (contacts, mut surfaces) in &mut tiles {
        for &(row, depth) in &contacts.behind {
            surfaces.bound[row as usize] += depth;
        }
    }
}

/// The stage that runs [`widen_bounds`].
pub fn contact_bound_stage() -> Stage {
    Stage::new("Widen the bounds of surfaces that touch", TileSystems::Normal, widen_bounds).when(contact_evidence)
}

/// The stage that runs [`merge_contacts`].
pub fn contact_stage() -> Stage {
    Stage::new("Merge surfaces that touch", TileSystems::Contact, merge_contacts).when(contact_evidence)
}
