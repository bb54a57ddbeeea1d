use super::faces::PlyFaces;
use super::vertices::Vertices;
use crate::centre::{about, centre_of};
use crate::model::{Instance, Model};
use crate::model_material::{ImageSource, ModelImage, ModelMaterial, ModelTexture};
use crate::polygon::Polygons;
use crate::remarks::Remarks;
use crate::triangle_mesh::TriangleMesh;
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// The model of vertices and faces: a mesh for each image.
pub fn model_of((vertices, faces): (Vertices, PlyFaces), textures: &[String], remarks: Remarks) -> Model {
    let mut model = Model { remarks, ..Model::default() };
    let PlyFaces { by_texture, wedges } = faces;
    let vertex_of = |corner: u32| wedges.as_ref().map_or(corner, |wedges| wedges[corner as usize].0) as usize;
    let Vertices { mut mesh, precise } = vertices;
    let mut used = vec![false; precise.as_ref().map_or(mesh.positions.len(), Vec::len)];
    let corners = || by_texture.iter().flat_map(Polygons::corners);
    corners().for_each(|corner| used[vertex_of(corner)] = true);
    model.remarks.unused_vertices += used.iter().filter(|used| !**used).count() as u64;
    let centre = precise.as_ref().map_or(DVec3::ZERO, |precise| {
        centre_of(precise.iter().zip(&used).filter(|(_, used)| **used).map(|(position, _)| *position))
    });
    if let Some(precise) = &precise {
        mesh.positions = precise.iter().map(|position| about(centre, *position)).collect();
    }
    let mesh = wedges.as_ref().map_or_else(|| mesh.clone(), |wedges| with_wedges(&mesh, wedges));
    let is_one = by_texture.iter().filter(|faces| faces.corners().next().is_some()).count() < 2;
    let mut whole = Some(mesh);
    for (image, polygons) in by_texture.into_iter().enumerate() {
        let at = |corner: u32| match &precise {
            Some(precise) => DVec3::from(precise[vertex_of(corner)]),
            None => {
                whole.as_ref().map_or(DVec3::ZERO, |own| DVec3::from(own.positions[corner as usize].map(f64::from)))
            }
        };
        let triangles = polygons.into_triangles(at, &mut model.remarks);
        if triangles.is_empty() {
            continue;
        }
        let columns = if is_one { whole.take() } else { whole.clone() };
        let mesh = TriangleMesh { triangles, ..columns.unwrap_or_default() }.cleaned(&mut model.remarks);
        if !mesh.triangles.is_empty() {
            place(&mut model, mesh, textures.get(image), centre);
        }
    }
    if model.meshes.is_empty() {
        model.remarks.empty_meshes += 1;
    }
    model
}

/// A vertex for each corner of each face.
fn with_wedges(mesh: &TriangleMesh, wedges: &[(u32, [f32; 2])]) -> TriangleMesh {
    let picked = |column: &Vec<[f32; 3]>| wedges.iter().map(|(vertex, _)| column[*vertex as usize]).collect();
    TriangleMesh {
        positions: picked(&mesh.positions),
        triangles: Vec::new(),
        normals: mesh.normals.as_ref().map(picked),
        uvs: Some(wedges.iter().map(|(_, [u, v])| [*u, 1.0 - v]).collect()),
        colours: mesh.colours.as_ref().map(picked),
    }
}

/// Adds a mesh, with a material if it has an image or colours.
fn place(model: &mut Model, mesh: TriangleMesh, texture: Option<&String>, centre: DVec3) {
    model.remarks.without_normals += u64::from(mesh.normals.is_none());
    model.remarks.without_uvs += u64::from(texture.is_some() && mesh.uvs.is_none());
    let texture = texture.map(|file| {
        let file: Arc<str> = file.as_str().into();
        let source = ImageSource::File(file.clone());
        model.images.push(ModelImage { name: file, source, is_srgb: true });
        ModelTexture { image: model.images.len() - 1, ..ModelTexture::default() }
    });
    let name = match &texture {
        Some(texture) => model.images[texture.image].name.clone(),
        None => "vertex colours".into(),
    };
    let material = (texture.is_some() || mesh.colours.is_some()).then(|| {
        model.materials.push(ModelMaterial {
            name,
            base_colour_texture: texture,
            double_sided: true,
            ..ModelMaterial::default()
        });
        model.materials.len() - 1
    });
    let world_from_object = DAffine3::from_translation(centre);
    model.instances.push(Instance { name: "".into(), mesh: model.meshes.len(), material, world_from_object });
    model.meshes.push(Arc::new(mesh));
}
