//! The list of all stages: each once, in the order of the sets, whichever was offered first.

use bevy_ecs::prelude::*;
use pinhole::Chapter;
use pinhole::look::trace;
use pinhole::plan::{Census, Stage};
use pinhole::rays::WorldRays;
use pinhole::scene::{PerspectiveCamera, TracePixel};
use pinhole::stages::{all, sort};
use std::any::TypeId;
use std::collections::BTreeSet;

#[test]
fn every_stage_stands_in_the_list_once_and_the_list_follows_the_sets() {
    let all = all();
    let ids: BTreeSet<TypeId> = all.iter().map(|stage| stage.id).collect();
    let names: BTreeSet<&str> = all.iter().map(|stage| stage.name).collect();
    assert_eq!((ids.len(), names.len()), (all.len(), all.len()));
    for pair in all.windows(2) {
        assert!(pair[0].set <= pair[1].set, "\"{}\" stands before \"{}\"", pair[0].name, pair[1].name);
    }
}

#[test]
fn the_order_of_the_offer_does_not_matter() {
    let mut reversed: Vec<Stage> = all().into_iter().rev().collect();
    sort(&mut reversed);
    assert_eq!(reversed, all());
}

#[test]
fn a_trace_of_an_empty_scene_shows_the_camera_ray() {
    let mut world = World::new();
    world.spawn(PerspectiveCamera::default());
    let offer = Chapter::new("empty", "nothing", |_| ()).offer(all()).stages();
    let trace = trace(&Census::of(&world), &offer, TracePixel { x: 1, y: 2 }).expect("traced");
    let rays: Vec<_> = trace.stages.iter().filter(|own| own.column.is::<WorldRays>()).collect();
    assert!(!rays.is_empty() && rays.iter().all(|own| own.rows.len() == 1), "{:?}", trace.stages);
}
