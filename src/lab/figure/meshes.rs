//! A scene of meshes beside what two mistakes make of it.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use crate::naive::mesh::directions_normalised_in_object_space;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::Chapter;
use pinhole::Result;
use pinhole::models::TriangleMesh;
use pinhole::scene::{MeshGeometry, MeshInstance, Placement, Sampling};

const SIZE: [u32; 2] = [276, 155];

/// Right; with directions normalised in object space; with normals taken to the world as directions are.
pub fn draw_mistakes(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let exhibit = |picture: Result<Picture>, [what, why]: [&str; 2]| -> Result<Exhibit> {
        Ok(Exhibit { picture: picture?, lines: vec![what.to_owned(), why.to_owned()] })
    };
    let normalised = Picture::replacing(chapter, SIZE, Some(directions_normalised_in_object_space()), sampled);
    let exhibits = [
        exhibit(Picture::of(chapter, SIZE, None, sampled), ["right", "one t for all"])?,
        exhibit(normalised, ["direction normalised", "each mesh counts t in its own unit"])?,
        exhibit(
            Picture::of(chapter, SIZE, None, with_normals_as_directions),
            ["normals like directions", "look left of the spire's ribs"],
        )?,
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

fn sampled(camera: &mut EntityWorldMut<'_>) {
    camera.insert(Sampling { samples: 8, seed: 28, ..Sampling::default() });
}

/// Gives each unevenly scaled mesh the normals that pinhole's map of normals takes where the map of directions takes
/// those that it had.
fn with_normals_as_directions(camera: &mut EntityWorldMut<'_>) {
    sampled(camera);
    camera.world_scope(|world| {
        for (mut mesh, placement) in world.query::<(&mut MeshInstance, &Placement)>().iter_mut(world) {
            if placement.scale.min_element() < placement.scale.max_element() {
                let spoilt = scaled_normals(&mesh.geometry, placement.scale * placement.scale);
                mesh.geometry = MeshGeometry::new(spoilt);
            }
        }
    });
}

fn scaled_normals(mesh: &TriangleMesh, by: DVec3) -> TriangleMesh {
    let mut mesh = mesh.clone();
    for normal in mesh.normals.iter_mut().flatten() {
        *normal = (DVec3::from(normal.map(f64::from)) * by).normalize_or_zero().as_vec3().to_array();
    }
    mesh
}
