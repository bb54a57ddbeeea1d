//! The renderer of one entity a ray makes pinhole's image, and the pages say what was measured of it.

use bevy_ecs::prelude::*;
use pinhole::render::{Execution, render};
use pinhole::scene::{PointLight, Resolution};
use pinhole::{Chapter, Overrides};
use pinhole_lab::naive::entity_per_ray::EntityPerRay;
use std::path::Path;

#[path = "scenes/sunflower.rs"]
mod sunflower;

/// A chapter's picture without lamps and without a view.
fn unlit(name: &str, width: u32, height: u32) -> (Chapter, World) {
    let mut all = chapters::all().into_iter().chain([sunflower::sunflower()]);
    let mut chapter = all.find(|chapter| chapter.name == name).expect("a chapter");
    chapter.view = None;
    let mut world =
        chapter.world(&Overrides { resolution: Some(Resolution { width, height }), ..Overrides::default() });
    let lamps: Vec<Entity> = world.query_filtered::<Entity, With<PointLight>>().iter(&world).collect();
    lamps.into_iter().for_each(|lamp| _ = world.despawn(lamp));
    (chapter, world)
}

#[test]
fn its_image_is_pinhole_s_to_the_last_bit() {
    let mut pixels = 0;
    for name in ["sunflower", "05_pinhole", "12_how_it_is_built"] {
        for [width, height] in [[192, 108], [33, 65], [1, 1], [70, 1]] {
            let (chapter, world) = unlit(name, width, height);
            let pinhole = render(&world, &chapter.stages(), &Execution::default(), &()).expect("renders").film;
            let mut entities = EntityPerRay::spawn(&world).expect("spawns");
            entities.run();
            assert!(entities.film().tiles == pinhole.tiles, "{name} {width}x{height}");
            pixels += u64::from(width) * u64::from(height);
        }
    }
    eprintln!("entity per ray: {pixels} pixels, 0 differ");
}

fn kept() -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters/12_how_it_is_built/entity_per_ray.txt");
    std::fs::read_to_string(file).expect("the measurement is kept beside the chapter")
}

/// The pages say the kept numbers, rounded to ten.
#[test]
fn pages_say_what_was_measured() {
    let kept = kept();
    let megabytes = |words: &str| {
        let line = kept.lines().find(|line| line.trim_start().starts_with(words)).expect("a line for it");
        let number = line.split_whitespace().rev().nth(5).and_then(|number| number.parse::<f64>().ok());
        (number.expect("megabytes") / 10.0).round() * 10.0
    };
    let [entities, columns, tiles] = ["an entity a ray", "all tiles at once", "a tile a worker"].map(megabytes);
    let sentence = format!(
        "an entity for each ray took about {entities:.0} MB, the same numbers in tiles {columns:.0} MB, and \
         {tiles:.0} MB where each worker holds one tile at a time, as pinhole does"
    );
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("book/src/01_image.md");
    let page = std::fs::read_to_string(page).expect("the page");
    assert!(page.contains(&sentence), "book/src/01_image.md must say:\n{sentence}");
}
