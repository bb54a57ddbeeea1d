//! Which kind of image a file is, by its first bytes: names are often wrong.

use image::ImageFormat;
use std::path::Path;

/// How many bytes at the start of a file tell its kind.
pub const TELLING_BYTES: usize = 32;

/// The kinds of image that are read, as messages list them.
pub const KINDS_READ: &str = "PNG, JPEG, TGA, BMP, HDR or EXR";

/// The beginnings of images that are read.
const READ: [(&[u8], ImageFormat); 5] = [
    (b"\x89PNG\r\n\x1a\n", ImageFormat::Png),
    (b"\xff\xd8\xff", ImageFormat::Jpeg),
    (b"\x76\x2f\x31\x01", ImageFormat::OpenExr),
    (b"#?", ImageFormat::Hdr),
    (b"BM", ImageFormat::Bmp),
];

/// The beginnings of images that are not, and what they are called.
const UNREAD: [(&[u8], &str); 13] = [
    (b"GIF8", "a GIF"),
    (b"II*\0", "a TIFF"),
    (b"MM\0*", "a TIFF"),
    (b"II+\0", "a TIFF"),
    (b"DDS ", "a DDS"),
    (b"\xabKTX 11", "a KTX"),
    (b"\xabKTX 20", "a KTX2"),
    (b"8BPS", "a Photoshop file"),
    (b"\xff\x0a", "a JPEG XL"),
    (b"\0\0\0\x0cJXL ", "a JPEG XL"),
    (b"\0\0\0\x0cjP  ", "a JPEG 2000"),
    (b"<svg", "an SVG"),
    (b"<?xml", "an SVG"),
];

/// The kind of an image by its first bytes; a TGA has no mark of its own, and is known by a head that can be one.
///
/// Errors: what the file is instead, as the end of a sentence.
pub fn image_kind(path: &Path, start: &[u8]) -> Result<ImageFormat, String> {
    if let Some((_, kind)) = READ.iter().find(|(mark, _)| start.starts_with(mark)) {
        return Ok(*kind);
    }
    let webp = start.starts_with(b"RIFF") && start.get(8..12) == Some(b"WEBP");
    let heif = start.get(4..8) == Some(b"ftyp");
    let unread = UNREAD.iter().find(|(mark, _)| start.starts_with(mark)).map(|(_, name)| *name);
    let what = unread.or(webp.then_some("a WebP")).or(heif.then_some("an AVIF or HEIF"));
    let is_named_tga = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("tga"));
    match what {
        Some(what) => Err(format!("it is {what}, and an image must be {KINDS_READ}")),
        None if start.is_empty() => Err("it is empty".into()),
        None if is_tga(start) || is_named_tga => Ok(ImageFormat::Tga),
        None => Err(format!("it is no image that is known, and an image must be {KINDS_READ}")),
    }
}

/// Whether this can be the head of a TGA: its colour map, its kind, its sides and its depth.
fn is_tga(head: &[u8]) -> bool {
    let [_, map, kind, .., low, high, low_down, high_down, depth, _] =
        head.first_chunk::<18>().copied().unwrap_or([0; 18]);
    let has_sides = [low, high] != [0; 2] && [low_down, high_down] != [0; 2];
    let fits = match kind {
        1 | 9 => map == 1 && depth == 8,
        2 | 10 => map <= 1 && [15, 16, 24, 32].contains(&depth),
        3 | 11 => map == 0 && [8, 16].contains(&depth),
        _ => false,
    };
    fits && has_sides
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_bytes_tell_the_kind_whatever_the_name_says() {
        let kind = |name: &str, start: &[u8]| image_kind(Path::new(name), start);
        assert_eq!(kind("a.png", b"\xff\xd8\xff\xe0...."), Ok(ImageFormat::Jpeg));
        assert_eq!(kind("a.jpg", b"\x89PNG\r\n\x1a\n"), Ok(ImageFormat::Png));
        assert_eq!(kind("a", b"#?RGBE\n"), Ok(ImageFormat::Hdr));
        assert_eq!(kind("a.hdr", b"\x76\x2f\x31\x01\x02"), Ok(ImageFormat::OpenExr));
        assert_eq!(kind("a.tga", b"BM......"), Ok(ImageFormat::Bmp));
        let tga = [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 4, 0, 24, 0];
        assert_eq!(kind("a.png", &tga), Ok(ImageFormat::Tga));
        assert_eq!(kind("a.TGA", b"anything"), Ok(ImageFormat::Tga));
        let refused = |start: &[u8]| kind("a.png", start).expect_err("refused");
        let accepted = "and an image must be PNG, JPEG, TGA, BMP, HDR or EXR";
        assert_eq!(refused(b"GIF89a"), format!("it is a GIF, {accepted}"));
        assert_eq!(refused(b"RIFF....WEBPVP8 "), format!("it is a WebP, {accepted}"));
        assert_eq!(refused(b"\0\0\0 ftypavif"), format!("it is an AVIF or HEIF, {accepted}"));
        assert_eq!(refused(b"# cargo"), format!("it is no image that is known, {accepted}"));
        assert_eq!(refused(b""), "it is empty");
    }
}
