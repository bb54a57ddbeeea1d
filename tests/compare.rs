//! Images of known error, from files: every measure is what arithmetic says, to the last bit where it is exact.

use exr::prelude::{Encoding, Image, SpecificChannels, WritableImage};
use image::{Rgb, RgbImage};
use pinhole_lab::measure::image_error::{ImageError, Numbers, Oddities, image_error};
use serde_json::Value;
use std::path::{Path, PathBuf};

type Pixel = [f32; 3];

fn light(size: [u32; 2], pixels: &[Pixel]) -> Numbers {
    Numbers { size, pixels: pixels.iter().map(|pixel| pixel.map(f64::from)).collect(), white: None }
}

fn error(size: [u32; 2], reference: &[Pixel], image: &[Pixel]) -> ImageError {
    image_error(&light(size, reference), &light(size, image)).expect("one size")
}

#[test]
fn a_constant_offset() {
    // 0.25 and 0.5 are exact in binary, so every sum is.
    let found = error([3, 2], &[[0.5; 3]; 6], &[[0.75; 3]; 6]);
    let means = found.means.expect("means");
    assert_eq!((means.mse, means.rmse(), means.mae, means.largest), (0.0625, 0.25, 0.25, 0.25));
    assert_eq!(means.rel_mse, 0.0625 / (0.25 + 0.01), "the reference's square stands below, plus 0.01");
    assert_eq!((means.worst, found.compared, found.differing, found.peak), ([0, 0], 6, 6, 0.5));
    assert_eq!(found.psnr(), Some(20.0 * libm::log10(0.5 / 0.25)));
    // The sign of the error does not cancel: MAE takes it absolutely.
    let both = error([2, 1], &[[0.5; 3]; 2], &[[0.75; 3], [0.25; 3]]);
    assert_eq!(both.means.expect("means").mae, 0.25);
}

#[test]
fn one_pixel_that_differs() {
    let mut image = [[0.5; 3]; 12];
    image[7] = [0.5, 2.5, 0.5];
    let found = error([4, 3], &[[0.5; 3]; 12], &image);
    let means = found.means.expect("means");
    assert_eq!((means.largest, means.worst, found.differing), (2.0, [3, 1], 1));
    assert_eq!((means.mse, means.mae), (4.0 / 36.0, 2.0 / 36.0), "the count is that of all numbers, not one less");
}

#[test]
fn what_is_not_finite_is_counted_and_in_no_denominator() {
    let reference = [[1.0; 3], [1.0; 3], [f32::NEG_INFINITY, 1.0, 1.0], [1.0; 3]];
    let image = [[1.5; 3], [f32::NAN, 1.5, 9.0], [1.0; 3], [1.0, f32::INFINITY, -1.0]];
    let found = error([2, 2], &reference, &image);
    let means = found.means.expect("means");
    assert_eq!((found.compared, found.pixels(), found.differing), (1, 4, 4));
    assert_eq!((means.mse, means.mae, means.largest, means.worst), (0.25, 0.5, 0.5, [0, 0]));
    let odd = |nan, plus_infinite, minus_infinite, negative| Oddities { nan, plus_infinite, minus_infinite, negative };
    assert_eq!(found.oddities, [odd(0, 0, 1, 0), odd(1, 1, 0, 1)]);
    assert_eq!(found.peak, 1.0, "the peak is finite");
    let text = found.to_string();
    assert!(text.contains("means over 1 pixels × 3 numbers; 3 pixels left out"), "{text}");
}

#[test]
fn one_pixel_alone_and_none_at_all() {
    let found = error([1, 1], &[[0.0; 3]], &[[3.0, 0.0, 0.0]]);
    assert_eq!(found.means.expect("means").mse, 3.0, "9 / 3: N, not N − 1");
    assert_eq!(found.means.expect("means").rel_mse, 9.0 / 0.01 / 3.0);
    assert_eq!(found.psnr(), None, "a black reference has no peak");
    let nothing = error([1, 1], &[[f32::NAN; 3]], &[[f32::NAN; 3]]);
    assert_eq!((nothing.means, nothing.compared, nothing.differing, nothing.psnr()), (None, 0, 0, None));
    assert!(nothing.to_string().contains("no pixel is finite in both images"));
}

#[test]
fn equal_images_have_no_error() {
    let found = error([2, 1], &[[0.1, 0.2, 0.3], [7.0; 3]], &[[0.1, 0.2, 0.3], [7.0; 3]]);
    let means = found.means.expect("means");
    assert_eq!((means.mse, means.rel_mse, means.mae, means.largest, found.differing), (0.0, 0.0, 0.0, 0.0, 0));
    assert_eq!(found.psnr(), Some(f64::INFINITY));
    assert!(found.to_string().contains("PSNR    infinite"));
}

#[test]
fn relative_error_has_its_square_and_its_floor() {
    // pbrt's imgtool has (r + 0.01)² below: at r = 1e-3 that is 83 times smaller (NUMERICS.md, section 1).
    let (r, x) = (1e-3_f32, 2e-3_f32);
    let [wide_r, wide_x] = [r, x].map(f64::from);
    let expected = (wide_x - wide_r) * (wide_x - wide_r) / (wide_r * wide_r + 0.01);
    let found = error([1, 1], &[[r; 3]], &[[x; 3]]).means.expect("means").rel_mse;
    assert!((found / expected - 1.0).abs() < 1e-15, "{found} for {expected}");
    let other = (wide_x - wide_r) * (wide_x - wide_r) / ((wide_r + 0.01) * (wide_r + 0.01));
    assert!((other / found - 82.7).abs() < 0.1, "{}", other / found);
}

#[test]
fn sums_do_not_lose_small_errors() {
    // 2¹⁶ errors of 2⁻¹⁰ and one of 1: an f32 sum of squares would lose digits.
    let count = (1 << 16) + 1;
    let mut image = vec![[0.5 + 1.0 / 1024.0; 3]; count];
    image[0] = [1.5; 3];
    let found = error([count as u32, 1], &vec![[0.5; 3]; count], &image).means.expect("means");
    let expected = (1.0 + 65_536.0 / 1_048_576.0) / 65_537.0;
    assert!((found.mse / expected - 1.0).abs() < 1e-15);
}

fn write_exr(path: &Path, size: [u32; 2], pixels: &[Pixel]) {
    let at = |at: exr::math::Vec2<usize>| {
        let [r, g, b] = pixels[at.y() * size[0] as usize + at.x()];
        (r, g, b)
    };
    let channels = SpecificChannels::rgb(at);
    let size = (size[0] as usize, size[1] as usize);
    Image::from_encoded_channels(size, Encoding::FAST_LOSSLESS, channels).write().to_file(path).expect("written");
}

fn compare(words: &[&str]) -> Result<String, String> {
    let words: Vec<String> = std::iter::once("compare").chain(words.iter().copied()).map(String::from).collect();
    let mut out = Vec::new();
    pinhole_cli::command::run(&[], &words, &mut out).map_err(|error| error.to_string())?;
    Ok(String::from_utf8(out).expect("text"))
}

fn shown(path: &Path) -> String {
    path.display().to_string()
}

#[test]
fn exr_files_are_read_as_they_are() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let [r, x, d] = ["r.exr", "x.exr", "d.png"].map(|name| folder.path().join(name));
    let reference = [[0.5; 3], [2.0, 0.0, 1e-30], [1.0; 3], [0.0, 3.0, 0.0], [f32::INFINITY, 0.0, 0.0], [0.25; 3]];
    let mut image = reference;
    (image[2], image[3], image[5]) = ([1.0, 1.0, 4.0], [f32::NAN, -3.0, 0.0], [-0.25; 3]);
    write_exr(&r, [3, 2], &reference);
    write_exr(&x, [3, 2], &image);
    let expected = error([3, 2], &reference, &image);
    let [r, x, d] = [&r, &x, &d].map(|path| shown(path));
    let told = compare(&[&r, &x, "-o", &d]).expect("compared");
    assert!(told.contains(&expected.to_string()), "{told}\nis not\n{expected}");
    let json: Value = serde_json::from_str(&compare(&[&r, &x, "--json"]).expect("compared")).expect("JSON");
    assert_eq!(json["mse"], expected.means.expect("means").mse);
    assert_eq!(json["max_at"], serde_json::json!([2, 0]));
    assert_eq!(json["not_finite_or_negative"]["image"]["nan"], 1);
    assert_eq!(json["pixels_left_out"], 2);
    let difference = image::open(&d).expect("a PNG").to_rgb8();
    assert!(told.contains("|x − r| × 0.25; black is none, full white is 4 or more"), "{told}");
    assert_eq!(
        [(0, 0), (2, 0), (1, 1), (2, 1)].map(|(x, y)| difference.get_pixel(x, y).0),
        [[0, 0, 0], [0, 0, 191], [255, 0, 255], [32, 32, 32]]
    );
    let same: Value = serde_json::from_str(&compare(&[&r, &r, "--json"]).expect("compared")).expect("JSON");
    assert_eq!((&same["mse"], &same["psnr_decibels"]), (&serde_json::json!(0.0), &serde_json::json!("infinite")));
}

fn write_png(path: &Path, size: [u32; 2], byte: u8) -> PathBuf {
    RgbImage::from_pixel(size[0], size[1], Rgb([byte; 3])).save(path).expect("written");
    path.into()
}

#[test]
fn png_files_are_bytes_over_255() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = |name: &str, size, byte| shown(&write_png(&folder.path().join(name), size, byte));
    let (r, x, larger) = (file("r.png", [4, 2], 100), file("x.png", [4, 2], 151), file("l.png", [2, 4], 100));
    let json: Value = serde_json::from_str(&compare(&[&r, &x, "--json"]).expect("compared")).expect("JSON");
    let near = |name: &str, expected: f64| {
        let found = json[name].as_f64().expect(name);
        assert!((found / expected - 1.0).abs() < 1e-14, "{name}: {found} for {expected}");
    };
    near("mse", 0.04);
    near("rmse", 0.2);
    near("mae", 0.2);
    near("psnr_decibels", 20.0 * libm::log10(5.0));
    assert_eq!(json["psnr_peak"], 1.0);
    let told = compare(&[&r, &larger]).expect_err("refused");
    assert_eq!(told, "the reference has 4 × 2 pixels and the image 2 × 4: only images of one size can be compared");
}

#[test]
fn what_cannot_be_compared_is_refused_in_a_sentence_and_nothing_is_written() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name);
    let png = shown(&write_png(&path("a.png"), [2, 2], 9));
    write_exr(&path("a.exr"), [2, 2], &[[0.5; 3]; 4]);
    let whole = std::fs::read(path("a.exr")).expect("read");
    std::fs::write(path("half.exr"), &whole[..whole.len() / 2]).expect("written");
    std::fs::write(path("no.png"), b"no").expect("written");
    let exr = shown(&path("a.exr"));
    let out = shown(&path("d.jpg"));
    for (words, told) in [
        (vec![&*png, &*exr], "one holds bytes after the curve, the other light"),
        (vec![&*png, &*shown(&path("b.png"))], "there is no file"),
        (vec![&*png, &*shown(&path("no.png"))], "cannot read"),
        (vec![&*exr, &*shown(&path("half.exr"))], "cannot read"),
        (vec![&*png, "a.txt"], "cannot compare a.txt: the name must end in .png or .exr"),
        (vec![&*png, &*png, "-o", &*out], "the name must end in .png"),
    ] {
        let sentence = compare(&words).expect_err("refused");
        assert!(sentence.contains(told), "{sentence}");
        assert!(!sentence.contains('\n') && !sentence.ends_with('.'), "{sentence}");
    }
    assert!(!path("d.jpg").exists());
}

/// A head that says more than the file can hold, in its only part and in its second.
#[test]
fn images_that_say_they_are_huge_are_refused_before_memory_is_asked_for() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name);
    write_exr(&path("a.exr"), [2, 2], &[[0.5; 3]; 4]);
    let part = |name: &str| {
        let channels = SpecificChannels::rgb(|_: exr::math::Vec2<usize>| (0.5_f32, 0.5_f32, 0.5_f32));
        let attributes = exr::prelude::LayerAttributes::named(name);
        exr::prelude::Layer::new((2, 2), attributes, Encoding::UNCOMPRESSED, channels)
    };
    let size = exr::meta::attribute::IntegerBounds::from_dimensions((2, 2));
    let attributes = exr::prelude::ImageAttributes::new(size);
    let two = Image::empty(attributes).with_layer(part("one")).with_layer(part("two"));
    two.write().non_parallel().to_file(path("two.exr")).expect("written");
    for (from, part, name) in [("a.exr", 0, "huge.exr"), ("two.exr", 1, "multi.exr")] {
        let mut bytes = std::fs::read(path(from)).expect("read");
        let head = b"dataWindow\0box2i\0\x10\0\0\0";
        let at: Vec<usize> = (0..bytes.len() - head.len()).filter(|&at| bytes[at..].starts_with(head)).collect();
        // The largest x of the window, so that the number of lines stays what it is.
        let x = at[part] + head.len() + 8;
        bytes[x..x + 4].copy_from_slice(&900_000_000_i32.to_le_bytes());
        std::fs::write(path(name), bytes).expect("written");
        let said = compare(&[&shown(&path("a.exr")), &shown(&path(name))]).expect_err("refused");
        assert!(said.starts_with("cannot read ") && !said.contains('\n'), "{said}");
        assert!(said.contains("900000001 × 2 pixels, which do not fit into its"), "{said}");
    }
}

#[cfg(unix)]
#[test]
fn pipes_are_refused_and_bombs_are_measured() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name);
    write_png(&path("a.png"), [2, 2], 9);
    for name in ["pipe.png", "pipe.exr"] {
        assert!(std::process::Command::new("mkfifo").arg(path(name)).status().expect("mkfifo").success());
        let said = compare(&[&shown(&path(name)), &shown(&path(name))]).expect_err("refused");
        assert!(said.ends_with("is not a regular file"), "{said}");
    }
    if cfg!(target_os = "linux") {
        let mut encoder = png::Encoder::new(std::fs::File::create(path("bomb.png")).expect("made"), 16384, 16384);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::One);
        encoder.write_header().expect("a head").write_image_data(&vec![0; 16384 * 2048]).expect("pixels");
        let command = "ulimit -v 4000000 && exec \"$@\"";
        let program = env!("CARGO_BIN_EXE_pinhole");
        let words = ["-c", command, "sh", program, "compare", "a.png", "bomb.png"];
        let out = std::process::Command::new("sh").args(words).current_dir(folder.path()).output().expect("starts");
        let said = String::from_utf8(out.stderr).expect("text");
        assert_eq!((out.status.code(), said.lines().count()), (Some(1), 1), "{said}");
        assert!(said.contains("16384 × 16384 pixels, and comparing them needs 6.5 GiB"), "{said}");
    }
}
