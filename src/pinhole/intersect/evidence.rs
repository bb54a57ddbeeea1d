use super::cuboid::cuboid_evidence;
use super::plane::plane_evidence;
use crate::plan::{Census, Evidence};
use crate::scene::{Disk, Rectangle, Sphere, Triangle};

/// Evidence that the scene contains a shape of any kind.
pub fn shape_evidence(scene: &Census<'_>) -> Evidence {
    Evidence::of::<Sphere>(scene, "sphere")
        .or(plane_evidence(scene))
        .or(Evidence::of::<Disk>(scene, "disk"))
        .or(Evidence::of::<Rectangle>(scene, "rectangle"))
        .or(cuboid_evidence(scene))
        .or(Evidence::of::<Triangle>(scene, "triangle"))
}
