//! How many of the renderer's files stand behind a pixel: what a reader opens who wants to have read all that made it.
//!
//! `cargo bench --bench files` counts, for chapters 5 and 25 or those that are named, the files of the systems that run
//! and of the types that these are compiled for, of the columns, tables and components that exist, and of the loop.
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

use bevy_ecs::prelude::*;
use pinhole::Overrides;
use pinhole::plan::{Bounce, Census};
use pinhole::render::{RenderWorld, prepare};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// What plans a scene and loops over its tiles.
const LOOP: [&str; 8] = [
    "pinhole/plan/census.rs",
    "pinhole/plan/column.rs",
    "pinhole/plan/decide.rs",
    "pinhole/plan/stage.rs",
    "pinhole/render/execution.rs",
    "pinhole/render/in_progress.rs",
    "pinhole/render/render_world.rs",
    "pinhole/stages.rs",
];

fn main() {
    let named: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let wanted = if named.is_empty() { vec!["05".into(), "25".into()] } else { named };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let sources = ["pinhole", "scene"].iter().flat_map(|package| sources(&folder, package)).collect::<Vec<_>>();
    for chapter in chapters::all().into_iter().filter(|chapter| wanted.iter().any(|own| chapter.name.starts_with(own)))
    {
        let scene = chapter.world(&Overrides::default());
        let (plan, tables) = prepare(&Census::of(&scene), &chapter.stages()).expect("prepares");
        let mut names = components(&scene);
        let mut made = RenderWorld::new(&plan, &tables, 1, &[]);
        names.extend(systems(&mut made.schedule, &mut made.world));
        let bounce = made.world.resource_mut::<Schedules>().remove(Bounce);
        if let Some(mut bounce) = bounce {
            names.extend(systems(&mut bounce, &mut made.world));
        }
        let mut files: BTreeSet<PathBuf> = LOOP.iter().map(PathBuf::from).collect();
        files.extend(names.iter().flat_map(|name| files_in(name, &folder)));
        let columns = plan.columns.iter().map(|column| ["column! {", column.name].map(String::from));
        let tables = tables.iter().map(|table| ["impl Table for", table.name].map(String::from));
        for [declares, name] in columns.chain(tables) {
            let is_there = |text: &str| {
                let before = ["(", "const NAME: &'static str = "];
                text.contains(&declares) && before.iter().any(|before| text.contains(&format!("{before}\"{name}\"")))
            };
            files.extend(sources.iter().filter(|(_, text)| is_there(text)).map(|(file, _)| file.clone()));
        }
        let lines: usize =
            files.iter().map(|file| fs::read_to_string(folder.join(file)).map_or(0, |text| text.lines().count())).sum();
        println!("{}: {} files, {lines} lines", chapter.name, files.len());
        files.iter().for_each(|file| println!("  {}", file.display()));
    }
}

/// The files of the renderer, with what is in them.
fn sources(folder: &Path, package: &str) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut left = vec![folder.join(package)];
    while let Some(next) = left.pop() {
        for entry in fs::read_dir(next).expect("a folder").map(|entry| entry.expect("an entry").path()) {
            if entry.is_dir() {
                left.push(entry);
            } else if let (Ok(file), Ok(text)) = (entry.strip_prefix(folder), fs::read_to_string(&entry)) {
                found.push((file.to_path_buf(), text));
            }
        }
    }
    found
}

/// The components that a scene's entities have, by their types' names.
fn components(scene: &World) -> BTreeSet<String> {
    let held = scene.archetypes().iter().filter(|archetype| !archetype.is_empty());
    let ids = held.flat_map(|archetype| archetype.components().to_vec());
    ids.filter_map(|id| scene.components().get_info(id)).map(|info| info.name().to_string()).collect()
}

/// The systems of a schedule, each with the types that it is compiled for.
fn systems(schedule: &mut Schedule, world: &mut World) -> Vec<String> {
    if let Err(error) = schedule.initialize(world) {
        panic!("{}", error.to_string(schedule.graph(), world));
    }
    schedule.systems().expect("initialised").map(|(_, system)| system.name().to_string()).collect()
}

/// The files of the paths `pinhole::…` and `pinhole_scene::…` in a name.
fn files_in(name: &str, folder: &Path) -> Vec<PathBuf> {
    let paths = name.split(|letter: char| !(letter.is_alphanumeric() || matches!(letter, ':' | '_')));
    let file = |path: &str| {
        let path = path.replace("pinhole_scene::", "scene::");
        let modules: Vec<&str> = path.split("::").collect();
        let file = |count: usize| PathBuf::from(modules[..count].join("/")).with_extension("rs");
        (2..=modules.len()).rev().map(file).find(|file| folder.join(file).is_file())
    };
    paths.filter_map(file).collect()
}
