//! An image in object space keeps its aspect ratio, and stands upright.

use super::*;

const PIXELS: u32 = 80;

/// The colours of a wall's pixels, 20 of which are a unit, from left to right and top to bottom: an image of this size
/// repeats on it.
fn on_a_wall([width, height]: [u32; 2], texel: fn(u32, u32) -> [u8; 3]) -> impl Fn(u32, u32) -> [f64; 3] {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("image.png");
    image::RgbImage::from_fn(width, height, |x, y| image::Rgb(texel(x, y))).save(&file).expect("written");
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.013, 0.017, 5.0), target: DVec3::new(0.013, 0.017, 0.0), up: DVec3::Y };
    let resolution = Resolution { width: PIXELS, height: PIXELS };
    world.spawn((Name::new("camera"), OrthographicCamera { view_height: 4.0 }, look, resolution));
    let by = TextureBy::Space;
    let texture =
        ImageTexture { file: file.to_string_lossy().into_owned(), by, filter: false, ..ImageTexture::default() };
    world.spawn((Plane { normal: DVec3::Z }, Matte::default(), texture));
    let inspected = inspect(&world, &offer(), PIXELS).expect("inspects");
    let colours = inspected.world.get::<SurfaceColours>(inspected.tiles[0]).expect("colours").clone();
    move |x, y| colours.rgb((y * PIXELS + x) as usize)
}

/// An image of 4 × 2 texels on a wall: its texels are squares, so that it repeats after one unit across and after half
/// of one down.
#[test]
fn an_image_in_object_space_is_as_high_as_its_aspect_ratio_says() {
    let colour = on_a_wall([4, 2], |x, y| [(60 * x + 20) as u8, (100 * y + 50) as u8, (30 * x * y) as u8]);
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
}

/// Texels of a quarter of a unit, whose lines are red, green and blue.
#[test]
fn an_image_in_object_space_stands_upright() {
    let colour = on_a_wall([4, 3], |_, y| [0, 1, 2].map(|part| if part == y { 255 } else { 0 }));
    for (x, y) in (0..PIXELS - 5).flat_map(|y| (0..PIXELS).map(move |x| (x, y))) {
        let [r, g, b] = colour(x, y);
        assert_eq!(colour(x, y + 5), [b, r, g], "a line below ({x}, {y})");
    }
}
