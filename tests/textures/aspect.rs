//! An image in object space keeps its aspect ratio.

use super::*;

/// An image of 4 × 2 texels on a wall: its texels are squares, so that it repeats after one unit across and after half
/// of one down.
#[test]
fn an_image_in_object_space_is_as_high_as_its_aspect_ratio_says() {
    const PIXELS: u32 = 80;
    let file = std::env::temp_dir().join(format!("pinhole_aspect_{}.png", std::process::id()));
    let texel = |x: u32, y: u32| image::Rgb([(60 * x + 20) as u8, (100 * y + 50) as u8, (30 * x * y) as u8]);
    image::RgbImage::from_fn(4, 2, texel).save(&file).expect("written");
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.013, 0.017, 5.0), target: DVec3::new(0.013, 0.017, 0.0), up: DVec3::Y };
    let resolution = Resolution { width: PIXELS, height: PIXELS };
    world.spawn((Name::new("camera"), OrthographicCamera { view_height: 4.0 }, look, resolution));
    let by = TextureBy::Space;
    let texture =
        ImageTexture { file: file.to_string_lossy().into_owned(), by, filter: false, ..ImageTexture::default() };
    world.spawn((Plane { normal: DVec3::Z }, Matte::default(), texture));
    let inspected = inspect(&world, &offer(), PIXELS).expect("inspects");
    let colours = inspected.world.get::<SurfaceColours>(inspected.tiles[0]).expect("colours");
    let colour = |x: u32, y: u32| colours.get((y * PIXELS + x) as usize);
    // 20 pixels are a unit.
    let (mut same, mut other) = (0, 0);
    for y in 0..PIXELS - 20 {
        for x in 0..PIXELS - 20 {
            assert_eq!(colour(x, y), colour(x, y + 10), "half a unit below ({x}, {y})");
            assert_eq!(colour(x, y), colour(x + 20, y), "a unit beside ({x}, {y})");
            assert_ne!(colour(x, y), colour(x, y + 5), "a quarter of a unit below ({x}, {y})");
            assert_ne!(colour(x, y), colour(x + 5, y), "a quarter of a unit beside ({x}, {y})");
            (same, other) = (same + 2, other + 2);
        }
    }
    eprintln!("aspect: {same} pairs of pixels a period apart alike, {other} a texel apart not");
    _ = fs::remove_file(file);
}
