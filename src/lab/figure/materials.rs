//! Materials side by side, on the shapes of a chapter's scene.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use bevy_ecs::prelude::*;
use pinhole::scene::{Glass, Integrator, Metal, Mirror, Principled, Rgb, RoughGlass, Sampling};
use pinhole::{Chapter, Result};

/// Three in a row.
const SIZE: [u32; 2] = [276, 155];

/// The chapter's scene by paths, with these materials in place of what the named entities are made of.
fn exhibit<M: Component + Clone>(chapter: &Chapter, materials: &[(&str, M)], lines: [String; 2]) -> Result<Exhibit> {
    let picture = Picture::of(chapter, SIZE, None, |camera| {
        camera.insert((Integrator::PATH, Sampling { samples: 24, ..Sampling::default() }));
        camera.world_scope(|world| {
            let mut named = world.query::<(Entity, &Name)>();
            let entities: Vec<(Entity, String)> =
                named.iter(world).map(|(entity, name)| (entity, name.to_string())).collect();
            for (entity, name) in entities {
                if let Some((_, material)) = materials.iter().find(|(own, _)| *own == name) {
                    world.entity_mut(entity).remove::<(Glass, Metal, Mirror)>().insert(material.clone());
                }
            }
        });
    })?;
    Ok(Exhibit { picture, lines: lines.to_vec() })
}

/// The glass ball, rougher and rougher.
pub fn draw_rough_glass(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |roughness: f64, line: &str| {
        let material = RoughGlass { roughness, ..RoughGlass::default() };
        exhibit(chapter, &[("ball", material)], [format!("*α* = {roughness}"), line.into()])
    };
    let exhibits = [
        of(0.02, "nearly smooth")?,
        of(0.15, "frosted: what is behind is blurred")?,
        of(0.5, "rough: only light comes through")?,
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// The three balls as dielectric, as a mixture, and as metal, each rougher from left to right.
pub fn draw_principled(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |metallic: f64, line: &str| {
        let material = |roughness| Principled {
            base_colour: Rgb::new(0.9, 0.35, 0.15),
            metallic,
            roughness,
            ..Principled::default()
        };
        let balls = [("smooth ball", 0.1), ("brushed ball", 0.4), ("rough ball", 0.8)];
        let materials = balls.map(|(name, roughness)| (name, material(roughness)));
        exhibit(chapter, &materials, [format!("metallic {metallic}"), line.into()])
    };
    let exhibits =
        [of(0.0, "coloured below a clear surface")?, of(0.5, "half of each")?, of(1.0, "coloured by its surface")?];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}
