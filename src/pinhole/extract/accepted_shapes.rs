//! The shapes that something accepts, in words: asked of the registered shapes, so that a new one is named, too.

use super::camera_entity::with_article;
use super::shape_kind::{ListedKind, listed_kinds};
use crate::plan::Census;

/// The shapes that can be made of glass: `a sphere, a closed cylinder, …, or triangles that close`.
pub fn shapes_with_inside(scene: &Census<'_>) -> String {
    let named = |listed: &ListedKind| {
        let [some, all] = (listed.examples_with_inside)();
        let always = all && !listed.has_primitives && !listed.is_part;
        some.then(|| named(listed, always, " that close"))
    };
    alternatives(listed_kinds(scene).filter_map(named))
}

/// The shapes that can be sampled where they emit light: `a sphere, a disk, …, or triangles`.
pub fn sampled_shapes(scene: &Census<'_>) -> String {
    let named = |listed: &ListedKind| {
        let [some, all] = (listed.examples_sampled)();
        some.then(|| named(listed, all, ""))
    };
    alternatives(listed_kinds(scene).filter_map(named))
}

/// A kind with its article, or as many where several make up a surface; closed where some of the kind are open.
fn named(listed: &ListedKind, always: bool, together: &str) -> String {
    // A component of which only one kind is accepted has no word for itself: the placement decides.
    let by_scale = match listed.non_uniform {
        Some(true) => " with an uneven scale",
        Some(false) => " with a uniform scale",
        None => "",
    };
    match (listed.is_part, always) {
        (true, _) => format!("{}s{together}", listed.word),
        (false, true) => format!("{}{by_scale}", with_article(listed.word)),
        (false, false) => format!("a closed {}{by_scale}", listed.word),
    }
}

/// Each once; where both kinds of a component are accepted, its scale is not mentioned.
fn alternatives(names: impl Iterator<Item = String>) -> String {
    let mut listed: Vec<String> = Vec::new();
    for name in names {
        let other = name.replace(" with an uneven scale", " with a uniform scale");
        match listed.iter_mut().find(|own| **own == other && other != name) {
            Some(own) => *own = name.replace(" with an uneven scale", ""),
            None => listed.push(name),
        }
    }
    match &listed[..] {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        _ => listed.concat(),
    }
}
