//! What a picture's file says beside its pixels.

use super::LayerNames;
use super::cryptomatte::{float_hash, hex_of, manifest};
use crate::cameras::{ImageFrame, RaySpread};
use crate::check::kind_and_name;
use crate::each::Each;
use crate::extract::{CameraAxes, LayerTable, camera_spread, eye, shape_entities, shape_name, sky_evidence};
use crate::material::media_entities;
use crate::plan::Census;
use crate::scene::{LayerKind, Name, SceneError};

/// What a picture's file says beside its pixels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FileAttributes {
    /// How many pixels the whole image has, to the right and down; none for as many as the film has.
    pub image: Option<[u32; 2]>,
    /// Where the camera is and what it sees.
    pub camera: Option<CameraMatrices>,
    /// Whether light comes from where nothing is hit.
    pub has_sky: bool,
    /// The shapes in the order of their numbers, for the layers that tell them apart.
    pub shapes: Vec<ShapeName>,
    /// Whose names the channels have.
    pub layer_names: LayerNames,
    /// What else is said, each with the name of its attribute.
    pub texts: Vec<(&'static str, String)>,
}

/// What a shape is called.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShapeName {
    /// Its kind and its name in quotes.
    pub in_messages: String,
    /// Its name alone; its kind and number where it has none.
    pub plain: String,
}

/// The matrices of a camera as OpenEXR's standard attributes have them (website, "Standard Attributes"): they multiply row
/// vectors, and are stored row by row, as Imath's `M44f` is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraMatrices {
    /// From world space to a left-handed camera space: x to the right, y up, z forward.
    pub world_to_camera: [f32; 16],
    /// From world space to (0, 0) at the upper left corner of the image and (1, 1) at the lower right one; none for a
    /// camera without an image plane.
    pub world_to_ndc: Option<[f32; 16]>,
    /// The width of the image on the plane at distance 1; 1 for a camera that is not a perspective one, as the format has
    /// it.
    pub screen_window_width: f32,
}

impl FileAttributes {
    /// Those of a scene's picture.
    ///
    /// Errors: an invalid camera.
    pub fn of(scene: &Census<'_>) -> Result<Self, SceneError> {
        let tell_apart = |kind: &LayerKind| matches!(kind, LayerKind::Entity | LayerKind::Cryptomatte);
        let has_names = LayerTable::kinds_of(scene).iter().any(tell_apart);
        let image = scene.table::<ImageFrame>()?;
        Ok(Self {
            image: Some([image.width, image.height]),
            camera: Some(CameraMatrices::of(scene)?),
            has_sky: sky_evidence(scene).needed,
            shapes: if has_names { names(scene) } else { Vec::new() },
            ..Self::default()
        })
    }

    /// The attributes of the layer `cryptomatte`, each with its name.
    pub(super) fn cryptomatte(&self) -> [(String, String); 4] {
        let name = format!("{}CryptoObject", self.layer_names.view_layer());
        let key = &hex_of(float_hash(&name))[..7];
        let said = [
            ("name", name.clone()),
            ("hash", "MurmurHash3_32".into()),
            ("conversion", "uint32_to_float32".into()),
            ("manifest", manifest(self.shapes.iter().map(|shape| shape.plain.as_str()))),
        ];
        said.each(|(word, text)| (format!("cryptomatte/{key}/{word}"), text))
    }
}

/// The names of all shapes, and of the media, whose scattering events are numbered after them.
fn names(scene: &Census<'_>) -> Vec<ShapeName> {
    let name = |(number, &entity): (usize, &_)| {
        let in_messages = shape_name(scene, number);
        let plain = scene.get::<Name>(entity).map_or_else(|| in_messages.clone(), |name| name.as_str().into());
        ShapeName { in_messages, plain }
    };
    let of_medium = |&entity: &_| {
        let in_messages = kind_and_name(scene, "medium", entity);
        let plain = scene.get::<Name>(entity).map_or_else(|| in_messages.clone(), |name| name.as_str().into());
        ShapeName { in_messages, plain }
    };
    let (shapes, media) = (shape_entities(scene), media_entities(scene));
    shapes.iter().enumerate().map(name).chain(media.iter().map(of_medium)).collect()
}

impl CameraMatrices {
    fn of(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (axes, eye) = (scene.table::<CameraAxes>()?.world_from_camera, eye(scene)?);
        let image = scene.table::<ImageFrame>()?;
        let forward = -axes.z_axis;
        // Columns: what a point's x, y, z and 1 contribute to a coordinate.
        let along = |axis: glam::DVec3| [axis.x, axis.y, axis.z, -axis.dot(eye)];
        let [right, up, depth] = [axes.x_axis, axes.y_axis, forward].each(along);
        const ONE: [f64; 4] = [0.0, 0.0, 0.0, 1.0];
        let sum = |a: f64, one: [f64; 4], b: f64, other: [f64; 4]| [0, 1, 2, 3].each(|at| a * one[at] + b * other[at]);
        let ndc = |half_height: f64, weight: [f64; 4]| {
            let x = sum(0.5 / (half_height * image.aspect()), right, 0.5, weight);
            let y = sum(-0.5 / half_height, up, 0.5, weight);
            [x, y]
        };
        let spread = camera_spread(scene)?;
        let world_to_ndc = match spread {
            RaySpread::Central(half_height) => {
                let [x, y] = ndc(half_height, depth);
                // Any third coordinate would do; this one makes a matrix that can be inverted.
                Some(rows([x, y, sum(1.0, depth, -1.0, ONE), depth]))
            }
            RaySpread::Parallel(half_height) => {
                let [x, y] = ndc(half_height, ONE);
                Some(rows([x, y, depth, ONE]))
            }
            RaySpread::Angular(_) => None,
        };
        let screen_window_width = match spread {
            RaySpread::Central(half_height) => (2.0 * half_height * image.aspect()) as f32,
            _ => 1.0,
        };
        Ok(Self { world_to_camera: rows([right, up, depth, ONE]), world_to_ndc, screen_window_width })
    }
}

/// A matrix of these columns, row by row.
fn rows(columns: [[f64; 4]; 4]) -> [f32; 16] {
    // A zero is a positive one.
    std::array::from_fn(|at| (columns[at % 4][at / 4] + 0.0) as f32)
}
