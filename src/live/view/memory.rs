use pinhole::extract::camera_entity;
use pinhole::plan::{Census, Plan};
use pinhole::render::film_bytes_per_pixel;
use pinhole::scene::{Resolution, SceneError, called, check_memory};

/// Bytes that a pixel takes in frames: its colour as it is made, as it is sent, in the frame before, and in one that a slow
/// page still reads.
const FRAMES: u64 = 4 * 4;
/// Bytes that it takes beside where frames gather: radiance, guides and numbers of samples of two frames, and what smooths
/// them.
const GATHERED: u64 = (2 * 13 + 3 * 4) * size_of::<f32>() as u64;

/// Bytes that it takes where numbers of it are shown or compared: its mean, the number, and the reference's mean.
const COMPARED: u64 = (3 + 1 + 3) * size_of::<f32>() as u64;

/// Checks that there is memory for a scene's film and for the frames that a page is sent, before any of it is allocated.
///
/// Errors: the size, what it needs and what there is.
pub fn check_frames_fit(
    scene: &Census<'_>,
    plan: &Plan,
    size: Resolution,
    [gathers, compares]: [bool; 2],
) -> Result<(), pinhole::Error> {
    let Resolution { width, height } = size;
    let beside = if gathers { GATHERED } else { 0 } + if compares { COMPARED } else { 0 };
    let a_pixel = film_bytes_per_pixel(scene, plan)? + FRAMES + beside;
    let pixels = u64::from(width) * u64::from(height);
    check_memory(pixels.saturating_mul(a_pixel)).map_err(|too_little| {
        let who = camera_entity(scene).map_or("camera".into(), |own| format!("camera {}", called(scene, own)));
        let accepted =
            format!("such a film, with the frames that a page is sent, {too_little}: --size makes it smaller");
        SceneError::new(who, "resolution", format!("{width} × {height}"), accepted).into()
    })
}
