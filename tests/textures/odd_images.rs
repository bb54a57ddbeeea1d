//! Images that are odd: what is read of them, and what is said.

use super::*;
use exr::prelude::{self as openexr, WritableImage};
use pinhole::extract::{EnvironmentTable, ImageTable, NormalMapTable, image_remarks};
use std::path::PathBuf;

/// Texels that no two colours of are alike, as bytes.
fn sample() -> image::RgbImage {
    image::RgbImage::from_fn(4, 4, |x, y| image::Rgb([40 * x as u8 + 20, 50 * y as u8 + 30, 90]))
}

fn written(folder: &Path, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, bytes).expect("written");
    path
}

fn encoded(format: image::ImageFormat) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    sample().write_to(&mut bytes, format).expect("encoded");
    bytes.into_inner()
}

/// A world in which an image is the texture, the normal map and the sky of something.
enum Use {
    Colour,
    Normals,
    Sky,
}

fn world_with(file: &Path, of: Use) -> World {
    let mut world = close_up(Eye::Perspective, DVec3::new(0.0, 6.0, 0.1), DVec3::ZERO);
    let file = file.to_string_lossy().into_owned();
    let floor = world.spawn((Rectangle { width: 4.0, depth: 4.0 }, Matte::default())).id();
    match of {
        Use::Colour => _ = world.entity_mut(floor).insert(ImageTexture { file, ..ImageTexture::default() }),
        Use::Normals => _ = world.entity_mut(floor).insert(NormalMap { file, ..NormalMap::default() }),
        Use::Sky => _ = world.spawn(Environment { file, ..Environment::default() }),
    }
    world
}

/// The texels of an image in that use, and what is said of it.
fn read(file: &Path, of: Use) -> Result<(Vec<[f32; 3]>, Vec<String>), String> {
    let is = [matches!(of, Use::Colour), matches!(of, Use::Normals)];
    let world = world_with(file, of);
    let census = Census::of(&world);
    let rgb = match is {
        [true, _] => census.table::<ImageTable>().map(|table| table.pyramid[0].levels[0].rgb.clone()),
        [_, true] => census.table::<NormalMapTable>().map(|table| table.image[0].texels.rgb.clone()),
        _ => census.table::<EnvironmentTable>().map(|table| table.image.rgb.clone()),
    };
    let rgb = rgb.map_err(|error| error.to_string())?;
    Ok((rgb, image_remarks(&census).expect("read before")))
}

/// An EXR of 2 × 1 texels with these channels, and these chromaticities.
fn exr_of(path: &Path, channels: &[(&str, [f32; 2])], chromaticities: Option<[[f32; 2]; 4]>) {
    let channel = |(name, samples): &(&str, [f32; 2])| {
        openexr::AnyChannel::new(*name, openexr::FlatSamples::F32(samples.to_vec()))
    };
    let channels = openexr::AnyChannels::sort(channels.iter().map(channel).collect());
    let mut image = openexr::Image::from_channels((2, 1), channels);
    image.attributes.chromaticities = chromaticities.map(|own| {
        let [red, green, blue, white] = own.map(|[x, y]| openexr::Vec2(x, y));
        exr::meta::attribute::Chromaticities { red, green, blue, white }
    });
    image.write().to_file(path).expect("written");
}

/// Every kind of file under every name, as a colour and as a sky.
#[test]
fn images_are_told_by_their_first_bytes() {
    use image::ImageFormat::{Bmp, Jpeg, Png, Tga};
    let folder = tempfile::tempdir().expect("a folder");
    let reference = read(&written(folder.path(), "right.png", &encoded(Png)), Use::Colour).expect("read").0;
    for (format, tolerance) in [(Png, 0.0), (Tga, 0.0), (Bmp, 0.0), (Jpeg, 0.35)] {
        for name in ["a.png", "a.jpg", "a.tga", "a.hdr", "a.exr", "a.bmp"] {
            let file = written(folder.path(), name, &encoded(format));
            for of in [Use::Colour, Use::Sky] {
                let (rgb, said) = read(&file, of).unwrap_or_else(|error| panic!("{format:?} as {name}: {error}"));
                let near =
                    |one: &[f32; 3], other: &[f32; 3]| (0..3).all(|part| (one[part] - other[part]).abs() <= tolerance);
                assert!(rgb.iter().zip(&reference).all(|(one, other)| near(one, other)), "{format:?} as {name}");
                assert_eq!(said, Vec::<String>::new(), "{format:?} as {name}");
            }
        }
    }
    let gif = written(folder.path(), "b.png", b"GIF89a................");
    let sentence = read(&gif, Use::Colour).expect_err("refused");
    assert!(sentence.ends_with("it is a GIF, and an image must be PNG, JPEG, TGA, BMP, HDR or EXR"), "{sentence}");
    let half = encoded(Jpeg);
    let (_, said) = read(&written(folder.path(), "c.jpg", &half[..half.len() - 20]), Use::Colour).expect("read");
    assert!(said.len() == 1 && said[0].starts_with("c.jpg: it breaks off before its end"), "{said:?}");
}

#[test]
fn texels_out_of_range_are_replaced_and_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("odd.exr");
    exr_of(&file, &[("R", [-1e-7, f32::NAN]), ("G", [f32::INFINITY, 0.5]), ("B", [0.25, 4.0])], None);
    let (rgb, said) = read(&file, Use::Sky).expect("read");
    assert_eq!(rgb, [[0.0, 4.0, 0.25], [0.0, 0.5, 4.0]]);
    assert_eq!(said.len(), 3, "{said:?}");
    let (rgb, said) = read(&file, Use::Colour).expect("read");
    assert_eq!((rgb, said.len()), (vec![[0.0, 1.0, 0.25], [0.0, 0.5, 1.0]], 3));
    let dark = written(folder.path(), "dark.png", &encoded(image::ImageFormat::Png));
    let (rgb, said) = read(&dark, Use::Normals).expect("read");
    assert!(rgb.iter().all(|texel| texel[2] > 0.5));
    assert!(said.len() == 1 && said[0].contains("16 texels with a normal that does not point out"), "{said:?}");
    let heights = image::GrayImage::from_fn(8, 8, |x, _| image::Luma([if x < 4 { 0 } else { 255 }]));
    let file = folder.path().join("heights.png");
    heights.save(&file).expect("written");
    let (rgb, said) = read(&file, Use::Normals).expect("read");
    assert!(said.len() == 1 && said[0].contains("taken for heights"), "{said:?}");
    // Flat but for both sides of the step, which rises to the right.
    assert_eq!(rgb[1], [0.5, 0.5, 1.0]);
    assert!(rgb[4][0] < 0.499 && rgb[0][0] > 0.501 && rgb[4][1] == 0.5, "{:?} {:?}", rgb[4], rgb[0]);
}

#[test]
fn an_exr_s_channels_and_primaries_are_those_it_has() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("a.exr");
    let grey = [[0.25, 0.25, 0.25], [0.5, 0.5, 0.5]];
    exr_of(&file, &[("Y", [0.25, 0.5])], None);
    let (rgb, said) = read(&file, Use::Sky).expect("read");
    assert_eq!((&rgb[..], &said[..]), (&grey[..], &["a.exr: its channel Y is read as grey".to_owned()][..]));
    let file = folder.path().join("b.exr");
    exr_of(
        &file,
        &[("beauty.R", [1.0, 2.0]), ("beauty.G", [3.0, 4.0]), ("beauty.B", [5.0, 6.0]), ("depth.Z", [9.0; 2])],
        None,
    );
    let (rgb, said) = read(&file, Use::Sky).expect("read");
    assert_eq!(
        (rgb, said),
        (vec![[1.0, 3.0, 5.0], [2.0, 4.0, 6.0]], vec!["b.exr: its layer beauty is read".to_owned()])
    );
    let file = folder.path().join("c.exr");
    exr_of(&file, &[("U", [1.0; 2]), ("V", [1.0; 2])], None);
    let sentence = read(&file, Use::Sky).expect_err("refused");
    assert!(sentence.contains("it has the channels U, V, and an image needs R, G and B"), "{sentence}");
    // XYZ as primaries: equal parts are white, X of Rec. 709's red is its red.
    let file = folder.path().join("d.exr");
    let third = 1.0 / 3.0;
    exr_of(
        &file,
        &[("R", [1.0, 0.0]), ("G", [1.0, 0.0]), ("B", [1.0, 0.0])],
        Some([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [third, third]]),
    );
    let (rgb, said) = read(&file, Use::Sky).expect("read");
    assert!(rgb[0].iter().all(|part| (part - 1.0).abs() < 1e-5), "{rgb:?}");
    assert_eq!(said, ["d.exr: its colours are converted from its own primaries to those of Rec. 709"]);
}

/// A Radiance file under another program's name, and with an exposure.
#[test]
fn radiance_files_may_begin_with_another_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let pixel = [128, 64, 32, 129];
    let file = |head: &str| [head.as_bytes(), b"FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n", &pixel].concat();
    let plain = read(&written(folder.path(), "a.hdr", &file("#?RADIANCE\n")), Use::Sky).expect("read");
    assert!(plain.1.is_empty() && plain.0[0][0] > 0.9, "{plain:?}");
    assert_eq!(read(&written(folder.path(), "b.hdr", &file("#?RGBE\n")), Use::Sky), Ok(plain.clone()));
    let (rgb, said) =
        read(&written(folder.path(), "c.hdr", &file("#?RGBE\nEXPOSURE=2\nEXPOSURE=2\n")), Use::Sky).expect("read");
    assert_eq!(rgb[0], plain.0[0].map(|part| part / 4.0));
    assert_eq!(said, ["c.hdr: its texels are divided by its EXPOSURE, 4"]);
}

/// The colours of vertices, interpolated, are a factor of the material's own and of its texture's.
#[test]
fn vertex_colours_are_a_factor_of_the_colour() {
    use pinhole::models::TriangleMesh;
    let mesh = TriangleMesh {
        positions: vec![[-2.0, 0.0, 2.0], [2.0, 0.0, 2.0], [2.0, 0.0, -2.0], [-2.0, 0.0, -2.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        colours: Some([[0.0, 1.0, 0.5], [1.0, 1.0, 0.5], [1.0, 0.0, 0.5], [0.0, 0.0, 0.5]].to_vec()),
        ..TriangleMesh::default()
    };
    for motion in [None, Some(Motion { velocity: DVec3::X })] {
        let mut world = close_up(Eye::Perspective, DVec3::new(0.3, 6.0, 0.4), DVec3::new(0.3, 0.0, 0.4));
        let camera = named(&mut world, "camera");
        world.entity_mut(camera).insert(Integrator::RayCasting);
        let tint = Tint { factor: Rgb::new(0.5, 1.0, 1.0), by_vertex: true };
        let own = Matte { colour: Rgb::grey(0.8) };
        let entity = world.spawn((MeshInstance::new(mesh.clone()), own, tint)).id();
        if let Some(motion) = motion {
            world.entity_mut(entity).insert(motion);
            world.entity_mut(camera).insert(Shutter { open: 0.0, close: 1e-9 });
        }
        let inspected = inspect(&world, &offer(), 32).expect("inspects");
        let tile = inspected.world.entity(inspected.tiles[0]);
        let (colours, surfaces) =
            (tile.get::<SurfaceColours>().expect("colours"), tile.get::<Surfaces>().expect("hits"));
        for row in 0..32 * 32 {
            let at = surfaces.get(row).position;
            let (x, z) = (f64::from(at.x) + 0.3, f64::from(at.z) + 0.4);
            let expected = [0.8 * 0.5 * (x + 2.0) / 4.0, 0.8 * (z + 2.0) / 4.0, 0.8 * 0.5];
            let found = colours.rgb(row);
            assert!(
                (0..3).all(|part| (found[part] - expected[part]).abs() < 1e-4),
                "({x}, {z}): {found:?}, {expected:?}"
            );
        }
    }
}

/// A camera that was held upright says so beside the image, and other programs turn it.
#[test]
fn an_orientation_that_is_not_applied_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let plain = encoded(image::ImageFormat::Jpeg);
    let with_orientation = |orientation: u8| {
        let tiff =
            [b"II*\0", &[8, 0, 0, 0, 1, 0, 0x12, 1, 3, 0, 1, 0, 0, 0, orientation, 0, 0, 0, 0, 0, 0, 0][..]].concat();
        let chunk = [b"Exif\0\0", &tiff[..]].concat();
        let length = (chunk.len() as u16 + 2).to_be_bytes();
        [&plain[..2], &[0xff, 0xe1], &length, &chunk, &plain[2..]].concat()
    };
    let expected = read(&written(folder.path(), "plain.jpg", &plain), Use::Colour).expect("read").0;
    for orientation in 1..=8 {
        let file = written(folder.path(), &format!("{orientation}.jpg"), &with_orientation(orientation));
        let (texels, said) = read(&file, Use::Colour).expect("read");
        assert!(texels == expected, "{orientation}: its texels lie otherwise");
        let sentence = format!(
            "{orientation}.jpg: its EXIF orientation is {orientation}, and its texels are used as they lie in the file"
        );
        assert_eq!(said, if orientation == 1 { vec![] } else { vec![sentence] });
    }
}
