//! Pinhole's own stages, run on rows that no camera made.

use crate::measure::oracle_plane::Plane;
use crate::measure::oracle_sphere::Sphere;
use crate::measure::ray_aim::AimedRay;
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::SingleThreadedExecutor;
use pinhole::extract::{PlaneTable, SphereTable};
use pinhole::plan::{Column, Sample, Shared, Stage, Table, VectorRowsMut, in_order};
use pinhole::rays::{Tile, WorldRays};
use pinhole::shapes::{PlacedPlane, PlacedSphere};

/// A world with one tile, and stages that run on it in the order given.
///
/// The systems are those that a render runs, SIMD and all; only what they read is put there by hand.
pub struct Bench {
    world: World,
    schedule: Schedule,
    tile: Entity,
}

impl Bench {
    /// A bench with the columns that the stages read and write, all empty.
    pub fn new(stages: &[Stage]) -> Self {
        let mut world = World::new();
        let mut tile = world.spawn(Tile { width: 1, height: 1, ..Tile::default() });
        let mut schedule = Schedule::new(Sample);
        schedule.set_executor(SingleThreadedExecutor::new());
        for column in stages.iter().flat_map(|stage| stage.reads.iter().chain(&stage.writes)) {
            (column.insert)(&mut tile);
        }
        schedule.add_systems(in_order(stages.iter().map(|stage| (stage.system)()).collect()));
        let tile = tile.id();
        Self { world, schedule, tile }
    }

    /// Puts a table where the stages look for it.
    pub fn insert<T: Table>(&mut self, table: T) {
        self.world.insert_resource(Shared::new(table));
    }

    /// Puts a column, or the tile's rectangle, where the stages look for it.
    pub fn put(&mut self, component: impl Component) {
        self.world.entity_mut(self.tile).insert(component);
    }

    /// Makes these the tile's world rays.
    pub fn aim(&mut self, rays: &[AimedRay]) {
        let Some(mut column) = self.world.get_mut::<WorldRays>(self.tile) else { return };
        let (mut origin, mut direction) = column.slices_mut(rays.len());
        for (row, ray) in rays.iter().enumerate() {
            origin.put(row, ray.origin);
            direction.put(row, ray.direction);
        }
    }

    /// Runs the stages once.
    pub fn run(&mut self) {
        self.schedule.run(&mut self.world);
    }

    /// What a stage has written.
    ///
    /// # Panics
    /// When no stage reads or writes that column.
    pub fn column<C: Column>(&self) -> &C {
        self.world.get::<C>(self.tile).expect("the column of a stage on the bench")
    }
}

/// The table of these spheres; a sphere's shape number is its place.
pub fn sphere_table(spheres: &[Sphere]) -> SphereTable {
    spheres.iter().map(|&Sphere { centre, radius }| PlacedSphere { centre, radius }).collect()
}

/// The table of these planes; a plane's shape number is its place.
pub fn plane_table(planes: &[Plane]) -> PlaneTable {
    planes.iter().map(|&Plane { normal, offset }| PlacedPlane { normal, offset }).collect()
}
