//! Images that chapters read from files: drawn by pinhole, so that nothing in them comes from elsewhere.

use glam::{DVec2, DVec3};
use image::Rgb;
use image::codecs::hdr::HdrEncoder;
use pinhole::film::{Curve, Film, png_bytes};
use pinhole::shade::direction_of;
use pinhole::{Error, Result};

/// An image that pinhole draws.
#[derive(Clone, Copy, Debug)]
pub struct DrawnImage {
    /// The file's name.
    pub file: &'static str,
    /// The folder that it is kept in.
    pub folder: &'static str,
    /// What it shows, in a few words.
    pub about: &'static str,
    size: [u32; 2],
    /// The linear colour at a point, (0, 0) the upper left corner, (1, 1) the lower right.
    colour: fn(DVec2) -> [f64; 3],
}

/// All of them.
pub const DRAWN_IMAGES: [DrawnImage; 3] = [
    DrawnImage {
        file: "card.png",
        folder: "chapters/16_textures",
        about: "eight by eight fields: hue from left to right, brightness from below, a dot in the lower left",
        size: [128, 128],
        colour: card,
    },
    DrawnImage {
        file: "evening.hdr",
        folder: "chapters/16_textures",
        about: "all directions of an evening: a low sun, a sky, hills",
        size: [192, 96],
        colour: |at| evening(direction_of(at)),
    },
    DrawnImage {
        file: "studs.hdr",
        folder: "chapters/16_textures",
        about: "a normal map: four by four round studs on a level ground",
        size: [64, 64],
        colour: studs,
    },
];

impl DrawnImage {
    /// The bytes of the file.
    pub fn bytes(&self) -> Result<Vec<u8>> {
        let [width, height] = self.size;
        let size = DVec2::new(f64::from(width), f64::from(height));
        let texels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        let centre = |[x, y]: [u32; 2]| DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) / size;
        let colours = texels.map(|texel| (self.colour)(centre(texel)).map(|part| part as f32));
        if self.file.ends_with(".png") {
            let mut film = Film::new(width, height, width.max(height));
            for (row, colour) in colours.enumerate() {
                film.tiles[0].add(row, colour);
            }
            return Ok(png_bytes(&film, Curve::Srgb)?);
        }
        let texels: Vec<Rgb<f32>> = colours.map(Rgb).collect();
        let mut bytes = Vec::new();
        let encoded = HdrEncoder::new(&mut bytes).encode(&texels, width as usize, height as usize);
        encoded.map_err(|error| Error::Usage(format!("cannot encode {}: {error}", self.file)))?;
        Ok(bytes)
    }
}

/// From 0 below `low` to 1 above `high`, smooth in between.
fn smooth(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn mixed(a: [f64; 3], b: [f64; 3], fraction: f64) -> [f64; 3] {
    [0, 1, 2].map(|part| a[part] + fraction * (b[part] - a[part]))
}

/// Eight by eight fields: the hue goes round from left to right, the brightness rises from below.
fn card(at: DVec2) -> [f64; 3] {
    let from_below = DVec2::new(at.x, 1.0 - at.y);
    let field = (from_below * 8.0).floor();
    let inside = from_below * 8.0 - field;
    let line = inside.min_element().min(1.0 - inside.max_element());
    let turn = (field.x + 0.5) / 8.0 * std::f64::consts::TAU;
    let bright = 0.12 + 0.75 * (field.y + 0.5) / 8.0;
    let hue = [0.0, 1.0, 2.0].map(|third| {
        let part = 0.5 + 0.5 * libm::cos(turn - third * std::f64::consts::TAU / 3.0);
        bright * (0.15 + 0.85 * part)
    });
    let dot = (inside - 0.5).length() < 0.3 && field == DVec2::ZERO;
    if dot {
        [0.9; 3]
    } else if line < 0.07 {
        [0.02; 3]
    } else {
        hue
    }
}

/// The normals of four by four caps of balls, each part from −1 to 1 as 0 to 1: right, up, out.
fn studs(at: DVec2) -> [f64; 3] {
    const RADIUS: f64 = 0.4;
    let cell = at * 4.0;
    let from_middle = cell - cell.floor() - 0.5;
    if from_middle.length() >= RADIUS {
        return [0.5, 0.5, 1.0];
    }
    // The image's y points down.
    let (x, y) = (from_middle.x * 1.5, -from_middle.y * 1.5);
    [x, y, (1.0 - x * x - y * y).sqrt()].map(|part| 0.5 + 0.5 * part)
}

/// Where the sun stands.
const SUN: DVec3 = DVec3::new(0.62, 0.22, -0.75);

/// The radiance of an evening sky; below the horizon, of dark hills.
fn evening(direction: DVec3) -> [f64; 3] {
    let to_sun = direction.dot(SUN.normalize());
    let longitude = libm::atan2(direction.x, -direction.z);
    let hills = 0.05 + 0.035 * libm::sin(3.0 * longitude + 0.7) + 0.02 * libm::sin(7.0 * longitude);
    let low = [0.75, 0.42, 0.24];
    let high = [0.07, 0.13, 0.32];
    let sky = mixed(low, high, smooth(-0.05, 0.55, direction.y));
    let glow = smooth(0.6, 1.0, to_sun);
    let disc = smooth(0.9968, 0.9982, to_sun);
    let sky = [0, 1, 2].map(|part| sky[part] + [1.1, 0.5, 0.15][part] * glow * glow + [60.0, 42.0, 24.0][part] * disc);
    let ground = mixed([0.035, 0.04, 0.03], [0.012, 0.012, 0.015], smooth(0.0, -0.6, direction.y));
    mixed(ground, sky, smooth(hills - 0.012, hills + 0.012, direction.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn what_is_kept_is_what_is_drawn() {
        for drawn in DRAWN_IMAGES {
            let path = crate::repository().join(drawn.folder).join(drawn.file);
            let kept = fs::read(&path).expect("kept");
            let bytes = drawn.bytes().expect("draws");
            assert!(kept.len() <= 60 << 10, "{} has {} bytes", drawn.file, kept.len());
            assert!(kept == bytes, "{}: cargo run --release -- draw {} -o {}", drawn.file, drawn.file, path.display());
        }
    }
}
