//! The media along a path.

use super::Scattered;
use crate::each::Each;
use crate::extract::{
    GlassBodyTable, GlassTable, MaterialTable, NO_ROW, absorption_evidence, deep_glass, end_close_to_glass_evidence,
    followed_evidence, glass_contact_evidence, glass_evidence, glass_overlaps, list_around,
};
use crate::intersect::{Contacts, GlassCrossing, SurfaceSides, Surfaces};
use crate::plan::{
    Census, Column, ColumnArrays, ColumnComponent, ComponentValues, Evidence, Lifetime, RowLists, Shared, Stage,
    TileSystems, VectorRowsMut, column, column_component,
};
use crate::rays::{RayTimes, WorldRays};
use crate::shapes::Bounds;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::DVec3;

column! {
    /// The glass that each ray travels through, as a stack of the media around its origin; exists where glass absorbs
    /// or overlaps.
    pub struct Media("media", "light", "rows of the table of glass", Path, begun in Media) {
        /// The medium at the origin, the one that would be there without it, and so on; those beyond the fourth are in the
        /// column of deeper media, where that exists.
        stack: [u32; 4] as [first, second, third, fourth],
    }
}

impl Media {
    /// The number of media in a row.
    pub(super) const PLACES: usize = 4;

    /// White inside glass.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [f32::from(u8::from(self.stack[0][row] != NO_ROW)); 3]
    }

    /// The media around a row's ray origin; none before any stage has set them.
    #[inline(always)]
    pub fn get(&self, row: usize) -> MediumStack {
        if row < self.rows() { MediumStack { rows: self.stack(row) } } else { MediumStack::OUTSIDE }
    }
}

/// What is read to find the media around the origins of rays, and what is filled.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct StartView {
    rays: &'static WorldRays,
    times: Option<&'static RayTimes>,
    media: &'static mut Media,
    deeper: Option<&'static mut DeeperMedia>,
}

// ANCHOR: start_media
/// Finds the media around the origin of every ray that starts on the camera or on a light: each body of glass is asked
/// whether the point is inside.
///
/// Nothing is concluded from what a ray hits first, which need not be the glass that it starts in.
pub fn start_media(
    (bodies, glass): (Res<Shared<GlassBodyTable>>, Res<Shared<GlassTable>>),
    (mut near, mut around): (Local<Vec<u32>>, Local<Vec<u32>>),
    mut tiles: Query<StartView>,
) {
    for StartViewItem { rays, times, mut media, mut deeper } in &mut tiles {
        let rows = rays.rows();
        // Few tiles start near any glass; the others ask no row.
        list_near(&bodies, rays, &mut near);
        if let Some(deeper) = &mut deeper {
            deeper.0.start(if near.is_empty() { rows } else { 0 });
        }
        let mut stacks = media.slices_mut(rows);
        stacks.set_all([NO_ROW; 4]);
        if near.is_empty() {
            continue;
        }
        let mut last = None;
        for row in 0..rows {
            let (origin, time) = (rays.origin_of(row), times.map_or(0.0, |times| times.time[row]));
            // All rays of a pinhole camera start at one point.
            if last != Some((origin, time)) {
                let near = near.iter().map(|&body| &bodies.row[body as usize]);
                list_around(near, &glass, (origin, time), &mut around);
                last = Some((origin, time));
            }
            let (stack, beyond) = MediumStack::of(&around);
            stacks.put(row, stack.rows);
            if let Some(deeper) = &mut deeper {
                deeper.0.push(beyond);
            }
        }
    }
}
// ANCHOR_END: start_media

/// Lists the bodies whose boxes overlap the box around the origins of a tile's rays.
fn list_near(bodies: &GlassBodyTable, rays: &WorldRays, near: &mut Vec<u32>) {
    near.clear();
    if rays.rows() == 0 {
        return;
    }
    let along = |origins: &[f32]| {
        // All rays of a pinhole camera start at one point.
        let first = origins[0];
        if origins.iter().fold(0, |differs, origin| differs | (origin.to_bits() ^ first.to_bits())) == 0 {
            return [first; 2].each(f64::from);
        }
        let range = origins.iter().fold([first; 2], |[min, max], &origin| {
            [if origin < min { origin } else { min }, if origin > max { origin } else { max }]
        });
        range.each(f64::from)
    };
    let [x, y, z] = rays.origin.slices(rays.rows()).each(along);
    let starts = Bounds { min: DVec3::new(x[0], y[0], z[0]), max: DVec3::new(x[1], y[1], z[1]) };
    let overlapping = bodies.row.iter().zip(0..).filter(|(body, _)| body.bounds.overlaps(&starts));
    near.extend(overlapping.map(|(_, number)| number));
}

/// The scattered rays, the glass that they leave, and the media that each of them starts in.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct CarryView {
    scattered: &'static Scattered,
    surfaces: &'static Surfaces,
    sides: &'static SurfaceSides,
    media: &'static mut Media,
    deeper: Option<&'static mut DeeperMedia>,
    contacts: Option<&'static Contacts>,
}

/// Gives each scattered ray the media of the ray it was scattered from, with the glass that it entered or left by
/// refraction.
pub fn carry_media(
    (materials, glass): (Res<Shared<MaterialTable>>, Res<Shared<GlassTable>>),
    mut kept: Local<Media>,
    mut carrier: Local<Carrier>,
    mut tiles: Query<CarryView>,
) {
    for CarryViewItem { scattered, surfaces, sides, mut media, mut deeper, contacts } in &mut tiles {
        carrier.start();
        let mut next_stacks = kept.slices_mut(scattered.rows());
        for ray in 0..scattered.rows() {
            let row = scattered.row[ray] as usize;
            let goes = scattered.direction_of(ray);
            let own = materials.interior[surfaces.material[row] as usize];
            let through = own != NO_ROW && goes.dot(surfaces.get(row).normal.as_dvec3()) < 0.0;
            let (stack, from_outside) = (media.get(row), sides.outside[row] != 0);
            let crossing = || stack.crossing(own, from_outside, &glass.priority).beyond;
            let together = contacts.map_or(&[][..], |contacts| contacts.crossings.get(row));
            let next = match &deeper {
                Some(deeper) => {
                    let alone = [GlassCrossing { glass: own, from_outside, depth: 0.0 }];
                    let crossed = if together.is_empty() { &alone } else { together };
                    carrier.push((stack, deeper.0.get(row)), if through { crossed } else { &[] }, &glass.priority)
                }
                None if !through => stack,
                None if together.is_empty() => crossing(),
                None => stack.beyond_all(together, &glass.priority),
            };
            next_stacks.put(ray, next.rows);
        }
        if let Some(deeper) = &mut deeper {
            carrier.swap(deeper);
        }
        std::mem::swap(&mut *kept, &mut *media);
    }
}

/// The stage that finds the media of rays from the camera and from lights.
pub fn start_media_stage() -> Stage {
    Stage::new("Find the media that rays start in", TileSystems::Media, start_media)
        .on_first_bounce()
        .when(media_evidence)
}

/// The stage that carries media to the next bounce.
pub fn carry_media_stage() -> Stage {
    Stage::new("Carry media to the next bounce", TileSystems::Step, carry_media)
        .reads_where::<DeeperMedia>(deeper_media_evidence)
        .when(media_evidence)
}

/// Evidence that the media along rays must be known: glass absorbs, or two glass shapes overlap.
pub fn media_evidence(scene: &Census<'_>) -> Evidence {
    let glass = glass_evidence(scene).and(|| followed_evidence(scene));
    if !glass.needed {
        return glass;
    }
    let (absorbs, overlaps) = (absorption_evidence(scene), glass_overlaps(scene));
    let touches = glass_contact_evidence(scene);
    let known = absorbs.or(overlaps);
    let known = if touches.needed { known.or(touches) } else { known };
    let close = end_close_to_glass_evidence(scene);
    if close.needed { known.or(close) } else { known }
}

/// The media around each ray's origin beyond the four that [`Media`] holds, in order of rank; exists only where more
/// than four glass shapes may overlap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeeperMedia(
    /// Rows of the glass table.
    pub RowLists<u32>,
);

/// The glass on the near side of a glass surface and on the far side: like [`MediumStack::crossing`], but including the
/// media beyond the fourth.
#[inline(always)]
pub(super) fn near_and_far(
    stack: MediumStack,
    beyond: &[u32],
    row: u32,
    from_outside: bool,
    priorities: &[u32],
) -> [u32; 2] {
    // A ray that leaves a glass not among the first four stays in the first one.
    if !from_outside && !stack.rows.contains(&row) && beyond.contains(&row) {
        return [stack.top(); 2];
    }
    let crossing = stack.crossing(row, from_outside, priorities);
    [crossing.near, crossing.far]
}

/// Collects the media of the scattered rays, one ray after another.
#[derive(Default)]
pub struct Carrier {
    whole: Vec<u32>,
    kept: DeeperMedia,
}

impl Carrier {
    /// Clears the rays of the previous tile.
    pub(super) fn start(&mut self) {
        self.kept.0.start(0);
    }

    /// Appends the media of a ray scattered from another, which crossed these surfaces of glass; returns the first four.
    pub(super) fn push(
        &mut self,
        (stack, beyond): (MediumStack, &[u32]),
        crossed: &[GlassCrossing],
        priorities: &[u32],
    ) -> MediumStack {
        // Where the first four have room for what is entered, there is nothing to keep beyond them.
        let has_room = beyond.is_empty() && stack.rows[3] == NO_ROW;
        if crossed.is_empty() || (has_room && crossed.len() == 1) {
            self.kept.0.push(beyond);
            let across = |own: &GlassCrossing| stack.crossing(own.glass, own.from_outside, priorities).beyond;
            return crossed.first().map_or(stack, across);
        }
        let whole = &mut self.whole;
        whole.clear();
        whole.extend(stack.rows.iter().filter(|&&row| row != NO_ROW));
        whole.extend_from_slice(beyond);
        for row in crossed.iter().filter(|own| own.from_outside).map(|own| own.glass) {
            let outranks = |&other: &u32| (priorities[row as usize], other) > (priorities[other as usize], row);
            let place = whole.iter().position(outranks).unwrap_or(whole.len());
            whole.insert(place, row);
        }
        for row in crossed.iter().filter(|own| !own.from_outside).map(|own| own.glass) {
            if let Some(place) = whole.iter().position(|&own| own == row) {
                whole.remove(place);
            }
        }
        let (first, beyond) = MediumStack::of(whole);
        self.kept.0.push(beyond);
        first
    }

    /// Exchanges the collected media with those of the column.
    pub(super) fn swap(&mut self, with: &mut DeeperMedia) {
        std::mem::swap(&mut self.kept, with);
    }
}

column_component!(DeeperMedia);

impl Column for DeeperMedia {
    const NAME: &'static str = "deeper media";
    const SPACE: &'static str = "light";
    const UNIT: &'static str = "places in a list of glass";
    const LIFETIME: Lifetime = Lifetime::Path;

    fn rows(&self) -> usize {
        self.0.ends().len()
    }

    fn components(&self) -> Vec<ColumnComponent<'_>> {
        vec![ColumnComponent { name: "end", values: ComponentValues::U32(self.0.ends()) }]
    }

    fn paint(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [f32::from(u8::from(!self.0.get(row).is_empty())); 3]
    }
}

/// Evidence that a ray may be inside more than four glass shapes at once.
pub fn deeper_media_evidence(scene: &Census<'_>) -> Evidence {
    glass_evidence(scene).and(|| followed_evidence(scene)).and(|| deep_glass(scene, Media::PLACES))
}

// ANCHOR: MediumStack
/// The media around a point in order of rank, the one that is present first; at most four of them.
///
/// Where glass shapes overlap, the one of the highest priority is present, and among equals the one spawned first,
/// whichever was entered first (Schmidt and Budge 2002).
/// Where more than four glass shapes may overlap, [`DeeperMedia`](super::DeeperMedia) holds the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MediumStack {
    /// Rows of the glass table in order of rank, each as often as its shapes contain the point; [`NO_ROW`] after them.
    pub rows: [u32; 4],
}

/// The media on both sides of a glass surface, and the stack on its far side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crossing {
    /// The glass on the near side; [`NO_ROW`] for none.
    pub near: u32,
    /// The glass on the far side; where it is the same, the surface has no effect.
    pub far: u32,
    /// The media around a point on the far side.
    pub beyond: MediumStack,
}

impl MediumStack {
    /// The stack outside all glass.
    pub const OUTSIDE: Self = Self { rows: [NO_ROW; 4] };

    /// The first four of the media around a point, which are given in order of rank, and the others.
    #[inline(always)]
    pub fn of(around: &[u32]) -> (Self, &[u32]) {
        let (first, beyond) = around.split_at(around.len().min(4));
        let mut rows = [NO_ROW; 4];
        rows[..first.len()].copy_from_slice(first);
        (Self { rows }, beyond)
    }

    /// The medium that is present; [`NO_ROW`] for none.
    #[inline(always)]
    pub fn top(self) -> u32 {
        self.rows[0]
    }

    /// The stack after entering a shape of this glass.
    #[inline(always)]
    pub fn entered(self, row: u32, priorities: &[u32]) -> Self {
        let outranks =
            |other: u32| other == NO_ROW || (priorities[row as usize], other) > (priorities[other as usize], row);
        let mut rows = self.rows;
        let (mut at, mut moved) = (0, row);
        // From its place on, every entry is pushed down by one.
        let mut found = false;
        while at < rows.len() {
            found = found || outranks(rows[at]);
            if found {
                std::mem::swap(&mut rows[at], &mut moved);
            }
            at += 1;
        }
        Self { rows }
    }

    /// The stack after leaving a shape of this glass; unchanged where the glass is not in it.
    #[inline(always)]
    pub fn left(self, row: u32) -> Self {
        let Some(place) = self.rows.iter().position(|own| *own == row) else { return self };
        let mut rows = self.rows;
        for at in place..3 {
            rows[at] = rows[at + 1];
        }
        rows[3] = NO_ROW;
        Self { rows }
    }

    /// The media beyond several surfaces that are crossed together, in whatever order rounding found them.
    #[inline(always)]
    pub fn beyond_all(self, crossings: &[GlassCrossing], priorities: &[u32]) -> Self {
        let left = crossings.iter().filter(|own| !own.from_outside && self.rows.contains(&own.glass));
        // Those it is in are left first, so that there is room; a layer is entered and left, in this order.
        let mut stack = left.fold(self, |stack, own| stack.left(own.glass));
        for own in crossings.iter().filter(|own| own.from_outside) {
            stack = stack.entered(own.glass, priorities);
        }
        for own in crossings.iter().filter(|own| !own.from_outside && !self.rows.contains(&own.glass)) {
            stack = stack.left(own.glass);
        }
        stack
    }

    /// The medium that is present beyond several surfaces that are crossed together, where `deeper` are the media around
    /// the point beyond these four.
    pub fn top_beyond<'a>(
        self,
        deeper: &[u32],
        crossings: impl Iterator<Item = &'a GlassCrossing> + Clone,
        priorities: &[u32],
    ) -> u32 {
        let around = || self.rows.iter().chain(deeper).copied().filter(|&row| row != NO_ROW);
        let crossed = |row: u32, from_outside: bool| {
            crossings.clone().filter(|own| own.glass == row && own.from_outside == from_outside).count()
        };
        let is_there =
            |&row: &u32| around().filter(|&own| own == row).count() + crossed(row, true) > crossed(row, false);
        let entered = crossings.clone().filter(|own| own.from_outside).map(|own| own.glass);
        let there = around().chain(entered).filter(is_there);
        there.min_by_key(|&row| (std::cmp::Reverse(priorities[row as usize]), row)).unwrap_or(NO_ROW)
    }

    /// What a ray with this stack crosses at a surface of this glass, hit from outside or from inside.
    ///
    /// A ray that leaves a shape without having entered it was inside from the start.
    #[inline(always)]
    pub fn crossing(self, row: u32, from_outside: bool, priorities: &[u32]) -> Crossing {
        if from_outside {
            let beyond = self.entered(row, priorities);
            return Crossing { near: self.top(), far: beyond.top(), beyond };
        }
        let within = if self.rows.contains(&row) { self } else { self.entered(row, priorities) };
        let beyond = within.left(row);
        Crossing { near: within.top(), far: beyond.top(), beyond }
    }
}
// ANCHOR_END: MediumStack

#[cfg(test)]
mod deeper_media_tests {
    use super::*;
    use crate::measure::draws::Draws;

    /// Random walks in and out of nine glass shapes; the medium at each point must be the one of the highest priority,
    /// and among equals the first.
    #[test]
    fn the_medium_is_right_at_any_depth() {
        const SHAPES: usize = 9;
        let (mut surfaces, mut deepest) = (0, 0);
        for walk in 0..3000 {
            let mut draws = Draws::new(1717, walk);
            let below = |draws: &mut Draws, max: usize| (draws.unit() * max as f64) as usize;
            let priorities: Vec<u32> = (0..SHAPES).map(|_| below(&mut draws, 4) as u32).collect();
            let glass: Vec<u32> = (0..SHAPES).map(|_| below(&mut draws, SHAPES) as u32).collect();
            let rule = |inside: &[bool]| {
                let around = (0..SHAPES).filter(|&shape| inside[shape]).map(|shape| glass[shape]);
                around.min_by_key(|&row| (std::cmp::Reverse(priorities[row as usize]), row)).unwrap_or(NO_ROW)
            };
            let (mut inside, mut stack, mut beyond) = ([false; SHAPES], MediumStack::OUTSIDE, DeeperMedia::default());
            beyond.0.start(1);
            let mut carrier = Carrier::default();
            for _ in 0..40 {
                let shape = below(&mut draws, SHAPES);
                let (row, from_outside) = (glass[shape], !inside[shape]);
                let [near, far] = near_and_far(stack, beyond.0.get(0), row, from_outside, &priorities);
                assert_eq!(near, rule(&inside), "walk {walk}");
                inside[shape] = !inside[shape];
                assert_eq!(far, rule(&inside), "walk {walk}");
                carrier.start();
                let crossed = [GlassCrossing { glass: row, from_outside, depth: 0.0 }];
                stack = carrier.push((stack, beyond.0.get(0)), &crossed, &priorities);
                carrier.swap(&mut beyond);
                let depth = stack.rows.iter().filter(|&&row| row != NO_ROW).count() + beyond.0.get(0).len();
                assert_eq!(depth, inside.iter().filter(|&&inside| inside).count(), "nothing is forgotten");
                deepest = deepest.max(depth);
                surfaces += 1;
            }
        }
        assert!(deepest > 7, "only {deepest} deep");
        eprintln!("deeper media: {surfaces} surfaces, up to {deepest} shapes about a point");
    }
}

#[cfg(test)]
mod medium_stack_tests {
    use super::*;

    /// All orders in which intervals along a ray can begin and end, each a list of the intervals that begin or end.
    fn orders(left: &mut Vec<u32>, order: &mut Vec<u32>, all: &mut Vec<Vec<u32>>) {
        if left.iter().all(|ends| *ends == 0) {
            all.push(order.clone());
        }
        for shape in 0..left.len() {
            if left[shape] > 0 {
                left[shape] -= 1;
                order.push(shape as u32);
                orders(left, order, all);
                order.pop();
                left[shape] += 1;
            }
        }
    }

    /// The medium by the rule: of the shapes around a point, the first of the highest priority.
    fn rule(inside: &[bool], glass: &[u32], priorities: &[u32]) -> u32 {
        let around = (0..inside.len()).filter(|&shape| inside[shape]).map(|shape| glass[shape]);
        around.min_by_key(|&row| (std::cmp::Reverse(priorities[row as usize]), row)).unwrap_or(NO_ROW)
    }

    /// Shapes that overlap in every order and with every priority, each of its own glass or some of the same; rays
    /// start outside, and also at every point between, with an unknown stack.
    #[test]
    fn every_order_and_priority() {
        let (mut walks, mut surfaces) = (0, 0);
        for shapes in 1..=4_usize {
            let mut all = Vec::new();
            orders(&mut vec![2; shapes], &mut Vec::new(), &mut all);
            let levels = shapes as u32;
            for order in &all {
                for code in 0..levels.pow(levels) * levels.pow(levels) {
                    if shapes == 4 && code % 499 != 0 {
                        continue;
                    }
                    let digit = |at: usize| code / levels.pow(at as u32) % levels;
                    let priorities: Vec<u32> = (0..shapes).map(digit).collect();
                    let glass: Vec<u32> = (0..shapes).map(|shape| digit(shape + shapes)).collect();
                    let mut inside = vec![false; shapes];
                    let mut stack = MediumStack::OUTSIDE;
                    for &shape in order {
                        let shape = shape as usize;
                        let crossing = stack.crossing(glass[shape], !inside[shape], &priorities);
                        assert_eq!(crossing.near, rule(&inside, &glass, &priorities), "{order:?} {priorities:?}");
                        // Crossing the same surface backwards gives the same media.
                        let back = crossing.beyond.crossing(glass[shape], inside[shape], &priorities);
                        assert_eq!((back.near, back.far, back.beyond), (crossing.far, crossing.near, stack));
                        inside[shape] = !inside[shape];
                        assert_eq!(crossing.far, rule(&inside, &glass, &priorities), "{order:?} {priorities:?}");
                        stack = crossing.beyond;
                        surfaces += 1;
                    }
                    assert_eq!(stack, MediumStack::OUTSIDE);
                    walks += 1;
                }
            }
        }
        eprintln!(
            "media: {walks} walks through 1 to 4 shapes, {surfaces} surfaces, all by the rule in both directions"
        );
    }

    /// Water in a glass whose sides overlap: with the higher priority of the wall, a ray finds air, wall and water,
    /// without an air gap.
    #[test]
    fn a_glass_of_water() {
        let (wall, water) = (0, 1);
        let priorities = [2, 1];
        // The outer side of the wall, the water's own side within the wall, the inner side of the wall.
        let surfaces = [(wall, true), (water, true), (wall, false)];
        let mut stack = MediumStack::OUTSIDE;
        let mut crossed = Vec::new();
        for (row, from_outside) in surfaces {
            let crossing = stack.crossing(row, from_outside, &priorities);
            crossed.push((crossing.near, crossing.far));
            stack = crossing.beyond;
        }
        assert_eq!(crossed, [(NO_ROW, wall), (wall, wall), (wall, water)], "the second surface has no effect");
    }

    #[test]
    fn begun_inside_and_a_fifth() {
        let priorities = [0, 1, 2, 3, 4];
        let begun = MediumStack::OUTSIDE.crossing(3, false, &priorities);
        assert_eq!((begun.near, begun.far, begun.beyond), (3, NO_ROW, MediumStack::OUTSIDE));
        let mut stack = MediumStack::OUTSIDE;
        for row in 0..5 {
            stack = stack.crossing(row, true, &priorities).beyond;
        }
        assert_eq!(stack.rows, [4, 3, 2, 1]);
        for row in (0..5).rev() {
            let crossing = stack.crossing(row, false, &priorities);
            assert_eq!(crossing.near, row);
            stack = crossing.beyond;
        }
        assert_eq!(stack, MediumStack::OUTSIDE);
    }
}
