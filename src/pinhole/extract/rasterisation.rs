use super::cameras::{camera_kind, named_camera};
use super::shapes::kind_evidence;
use super::{camera_moves_evidence, lens_evidence};
use crate::plan::{Census, Evidence};
use crate::scene::{Rasterisation, SceneError};
use crate::shapes::{Listed, PlacedMesh, TriangleRow};

/// Checks that the scene's camera can rasterise, if it is asked to.
pub(super) fn check_rasterisation(scene: &Census<'_>) -> Result<(), SceneError> {
    let (who, camera) = named_camera(scene)?;
    if scene.get::<Rasterisation>(camera).is_none() {
        return Ok(());
    }
    let refused = |value: &str, accepted: &str| Err(SceneError::new(who.as_str(), "rasterisation", value, accepted));
    if !camera_kind(scene)?.has_image_plane {
        return no_plane_to_rasterise(scene);
    }
    if lens_evidence(scene).needed {
        let accepted = "all points project through one: remove the lens, or the rasterisation";
        return refused("asked of a camera with a lens", accepted);
    }
    if camera_moves_evidence(scene).needed {
        let accepted = "vertices are projected once for all samples: remove the camera's motion, or the rasterisation";
        return refused("asked of a camera that moves", accepted);
    }
    Ok(())
}

/// The error about a camera that has no image plane.
pub fn no_plane_to_rasterise<T>(scene: &Census<'_>) -> Result<T, SceneError> {
    let accepted = "only a perspective or an orthographic camera maps straight edges to straight edges: take one, or \
                    remove the rasterisation";
    let (who, _) = named_camera(scene)?;
    Err(SceneError::new(who, "rasterisation", "asked of a camera without an image plane", accepted))
}

/// Evidence that the camera rasterises, and that there is something to rasterise.
pub fn rasterisation_evidence(scene: &Census<'_>) -> Evidence {
    rasterising_camera(scene).and(|| kind_evidence::<TriangleRow>(scene).or(kind_evidence::<PlacedMesh>(scene)))
}

/// Evidence that the camera rasterises, and that there are shapes of this kind whose boxes are rasterised.
pub fn box_evidence<S: Listed>(scene: &Census<'_>) -> Evidence {
    rasterising_camera(scene).and(|| kind_evidence::<S>(scene))
}

/// Evidence that the camera rasterises.
pub fn rasterising_camera(scene: &Census<'_>) -> Evidence {
    Evidence::of::<Rasterisation>(scene, "rasterising camera")
}
