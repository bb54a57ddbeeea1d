//! The list of words is complete: no component of a scene is lost in a file.

use pinhole::scene::{scene_text, words};
use std::fs;
use std::path::Path;

/// Components that a file holds in another way than by a word for their type.
const OTHERWISE: [(&str, &str); 5] = [
    ("UsesMaterial", "by `material` and a name"),
    ("UsedByShapes", "kept by bevy_ecs, the other end of UsesMaterial"),
    ("MeshInstance", "made of the file that a `mesh` names"),
    ("MeshPart", "made with it"),
    ("UnreadMesh", "said instead where that file cannot be read"),
];

#[test]
fn every_component_of_a_scene_has_a_word() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/scene");
    let mut components = Vec::new();
    let folders = [folder.clone(), folder.join("model")];
    let entries = folders.map(|folder| fs::read_dir(folder).expect("a readable folder"));
    for entry in entries.into_iter().flatten() {
        let path = entry.expect("an entry").path();
        let Ok(text) = fs::read_to_string(&path) else { continue };
        for after in text.split("#[derive(").skip(1) {
            let (derived, rest) = after.split_once(')').expect("a closed derive");
            if derived.split(',').any(|word| word.trim() == "Component") {
                let (_, named) = rest.split_once("pub ").expect("a component is public");
                let (_, named) = named.split_once(' ').expect("a struct or an enum, and its name");
                components.push(named.chars().take_while(|letter| letter.is_alphanumeric()).collect::<String>());
            }
        }
    }
    let lists = ["file/word.rs", "material.rs"].map(|list| fs::read_to_string(folder.join(list)).expect("kept"));
    let list = lists.concat();
    for component in &components {
        let listed = list.contains(&format!("Word::of::<{component}>("));
        let otherwise = OTHERWISE.iter().any(|(name, _)| name == component);
        assert!(
            listed != otherwise,
            "{component} has no word in scene/file/word.rs or scene/material.rs, or is held otherwise too"
        );
    }
    assert_eq!(components.len(), words().count() + OTHERWISE.len(), "{components:?}");
    eprintln!("words: {} components, {} of them held otherwise", components.len(), OTHERWISE.len());
}

#[test]
fn a_component_without_a_word_is_not_lost_in_silence() {
    #[derive(bevy_ecs::prelude::Component)]
    struct Wobble;
    let mut world = bevy_ecs::world::World::new();
    world.spawn((pinhole::scene::Name::new("jelly"), pinhole::scene::Sphere::default(), Wobble));
    let told = scene_text(&world).expect_err("refused").to_string();
    assert_eq!(told, "\"jelly\": component is Wobble, but scene files have no word for it");
}
