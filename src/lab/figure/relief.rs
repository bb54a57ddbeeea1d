//! A normal map on the shapes of a chapter's scene.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use bevy_ecs::prelude::*;
use pinhole::scene::{NormalMap, Sampling};
use pinhole::{Chapter, Result};

/// Three in a row.
const SIZE: [u32; 2] = [276, 155];
/// What gets the map.
const MAPPED: [&str; 3] = ["ball", "panel", "block"];

/// The chapter's scene with its studs level, half as high, and as they are.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |scale: f64, line: &str| -> Result<Exhibit> {
        let map = NormalMap { file: "studs.hdr".into(), scale, size: 0.5, ..NormalMap::default() };
        let picture = Picture::of(chapter, SIZE, None, |camera| {
            camera.insert(Sampling::default());
            camera.world_scope(|world| {
                let mut named = world.query::<(Entity, &Name)>();
                let is_mapped = |(entity, name): (Entity, &Name)| MAPPED.contains(&name.as_str()).then_some(entity);
                let entities: Vec<Entity> = named.iter(world).filter_map(is_mapped).collect();
                entities.into_iter().for_each(|entity| _ = world.entity_mut(entity).insert(map.clone()));
            });
        })?;
        Ok(Exhibit { picture, lines: vec![format!("scale {scale}"), line.into()] })
    };
    let exhibits = [of(0.0, "the surfaces as they are")?, of(0.5, "a shallow relief")?, of(1.0, "the map as it is")?];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}
