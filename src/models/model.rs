use crate::model_material::{ModelImage, ModelMaterial};
use crate::remarks::Remarks;
use crate::triangle_mesh::TriangleMesh;
use glam::DAffine3;
use std::sync::Arc;

/// What a model file holds, as plain data: meshes, and where they stand in the world.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Its meshes, each once, however many instances it has.
    pub meshes: Vec<Arc<TriangleMesh>>,
    /// Its materials.
    pub materials: Vec<ModelMaterial>,
    /// The images of its materials, each once, however many textures use it.
    pub images: Vec<ModelImage>,
    /// Its meshes as they stand in the world.
    pub instances: Vec<Instance>,
    /// Its cameras.
    pub cameras: Vec<ModelCamera>,
    /// Its lights without an area.
    pub lights: Vec<ModelLight>,
    /// Its animations.
    pub animations: Vec<ModelAnimation>,
    /// What was dropped, replaced or not read.
    pub remarks: Remarks,
}

/// An animation of a model file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModelAnimation {
    /// Its name; may be empty.
    pub name: String,
    /// The time of its last key, in seconds, as the file says it.
    pub seconds: f64,
}

/// A moment at which a model is read: a time of some of its animations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment<'a> {
    /// The time, in seconds; before the first key of a channel it is as at the first, after the last as at the last.
    pub seconds: f64,
    /// The name of an animation, its index in the file, or `all`, of which the first counts where several change one
    /// property of a node; the first animation if this is missing.
    pub animation: Option<&'a str>,
}

/// A mesh in the world, with its material.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// The name of the node, or of the material if there are no nodes; may be empty.
    pub name: Arc<str>,
    /// The index of its mesh.
    pub mesh: usize,
    /// The index of its material, if it has one.
    pub material: Option<usize>,
    /// The matrix that takes points of the mesh to the world, with y up.
    pub world_from_object: DAffine3,
}

/// A camera, which looks along its own −z with y up.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelCamera {
    /// Its name, or that of its node; may be empty.
    pub name: Arc<str>,
    /// How it projects.
    pub projection: Projection,
    /// The distances before which and beyond which it is meant to see nothing.
    pub clip: [f64; 2],
    /// The matrix that takes its own space to the world.
    pub world_from_camera: DAffine3,
}

/// How a camera of a model projects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Through a pinhole.
    Perspective {
        /// The vertical field of view, in radians, between 0 and π.
        yfov: f64,
        /// Width over height, if the file says it.
        aspect: Option<f64>,
    },
    /// Along parallel rays.
    Orthographic {
        /// Half the width of the view, in scene units.
        xmag: f64,
        /// Half its height.
        ymag: f64,
    },
}

/// A light without an area, which shines along its own −z where it has a direction.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelLight {
    /// Its name, or that of its node; may be empty.
    pub name: Arc<str>,
    /// Which light it is.
    pub kind: LightKind,
    /// Its colour, linear Rec. 709.
    pub colour: [f64; 3],
    /// Its intensity, in candela, or its illuminance in lux if it is directional.
    pub intensity: f64,
    /// The distance beyond which it may be ignored, if the file says one.
    pub range: Option<f64>,
    /// The matrix that takes its own space to the world.
    pub world_from_light: DAffine3,
}

/// The kinds of light of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Infinitely far away.
    Directional,
    /// Shines alike in all directions.
    Point,
    /// Shines into a cone.
    Spot {
        /// The half angle within which it is brightest, in radians.
        inner: f64,
        /// The half angle beyond which it is dark, in radians, greater than the inner one, at most π/2.
        outer: f64,
    },
}
