//! A scene is read once: each table is extracted once, whoever asks for it.

use crate::scenes;
use bevy_ecs::prelude::*;
use pinhole::look::{Preflight, preflight, trace};
use pinhole::plan::{Census, Stage};
use pinhole::render::{Execution, RenderInProgress};
use pinhole::scene::TracePixel;
use pinhole::{Overrides, Size, scene};
use scenes::followed::{INTEGRATORS, followed};
use scenes::public::{PUBLIC, public};
use scenes::{Setup, offer, singles_and_pairs, toggled};
use std::fs;
use std::path::Path;
use std::time::Duration;

/// Begins a render, says what is said before it, and traces a pixel: the tables that were extracted.
fn tables_of(name: &str, world: &World, stages: &[Stage]) -> usize {
    let census = &Census::of(world);
    let execution = Execution { threads: Some(1), ..Execution::default() };
    let render = RenderInProgress::begin(census, stages, &execution).unwrap_or_else(|error| panic!("{name}: {error}"));
    let extracted = census.extractions();
    let twice: Vec<_> = extracted.iter().filter(|(_, times)| **times != 1).collect();
    assert!(twice.is_empty(), "{name}: extracted more than once: {twice:?}");
    for table in &render.plan.tables {
        assert!(extracted.contains_key(table.name), "{name}: {} did not come from the census", table.name);
    }
    let asked = Preflight { threads: Some(1), patience: Some(Duration::from_millis(1)), ..Preflight::default() };
    preflight(census, (&render.plan, render.tables()), asked).unwrap_or_else(|error| panic!("{name}: {error}"));
    trace(census, stages, TracePixel { x: 0, y: 0 }).unwrap_or_else(|error| panic!("{name}: {error}"));
    // A trace shows rays that the picture may not need, and so may be the first to read a table.
    let twice: Vec<_> = census.extractions().into_iter().filter(|(_, times)| *times != 1).collect();
    assert!(twice.is_empty(), "{name}: preflight or trace read again: {twice:?}");
    extracted.len()
}

#[test]
fn each_table_of_a_render_is_extracted_once() {
    let mut tables = 0;
    let size = Some(Size::Pixels(scene::Resolution { width: 16, height: 9 }));
    for chapter in chapters::all() {
        let world = chapter.world(&Overrides { size, ..Overrides::default() });
        tables += tables_of(chapter.name, &world, &chapter.stages());
    }
    let offer = offer();
    let setup = Setup { size: [16, 9], ..Setup::default() };
    for integrator in INTEGRATORS {
        tables += tables_of(&format!("{integrator:?}"), &followed(integrator, setup), &offer);
    }
    for name in PUBLIC {
        tables += tables_of(name, &public(name, scene::LightStrategy::Mis), &offer);
    }
    for on in singles_and_pairs() {
        let world = toggled(&on);
        // Some pairs cannot be rendered; what they are refused for is tested elsewhere.
        if pinhole::render::prepare(&Census::of(&world), &offer).is_ok() {
            tables += tables_of(&format!("{on:?}"), &world, &offer);
        }
    }
    assert!(tables > 1000, "{tables} tables of all scenes");
}

/// The count above would miss a table that is extracted behind the census's back.
#[test]
fn only_the_census_extracts() {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src/pinhole")];
    let (mut files, mut calls) = (0, Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a readable folder") {
            let path = entry.expect("a readable entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = fs::read_to_string(&path).expect("a readable file");
            files += 1;
            let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
            if code.contains("::extract(") {
                calls.push(path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default());
            }
        }
    }
    assert!(files > 100);
    assert_eq!(calls, ["census.rs"]);
}
