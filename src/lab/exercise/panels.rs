//! Pinhole's picture, the reader's and their difference, side by side.

use super::letters::{HEIGHT, WIDTH, write};
use super::picture_pair::PicturePair;
use crate::review::full_white;
use image::{ImageFormat, Rgb, RgbImage};
use std::io::{self, Cursor};

/// No panel is narrower, or its words would not fit.
const MIN_WIDTH: u32 = 320;
/// The space between panels and about them.
const GAP: u32 = 12;
/// How large a dot of a letter is.
const DOT: u32 = 2;
/// The line above a panel.
const TITLE: u32 = HEIGHT * DOT + 10;
/// The bar of colours, and the line below it.
const LEGEND: u32 = 12 + TITLE;
const PAPER: Rgb<u8> = Rgb([28, 28, 30]);
const INK: Rgb<u8> = Rgb([225, 225, 220]);
/// The least that the brightest colour stands for, of 255: one of 255 is rounding.
const MIN_FULL: f64 = 8.0;
/// The part of the pixels that may differ by more than the brightest colour stands for.
const BEYOND: f64 = 0.002;

/// Pictures in several scenes, each with what is special about it, as one PNG: below each other those of each scene, side by
/// side pinhole's, the reader's and their difference.
///
/// Errors: an encoder that refuses.
pub fn sheet(pairs: &[(&str, PicturePair)]) -> io::Result<Vec<u8>> {
    let narrowest = pairs.first().map_or(0, |(_, pair)| pair.size[0]).max(MIN_WIDTH);
    // A picture of few pixels is drawn as large as the first, in squares.
    let high = pairs.first().map_or(0, |(_, pair)| pair.size[1] * (narrowest / pair.size[0].max(1)));
    let zoom = |[width, height]: [u32; 2]| (narrowest / width.max(1)).min(high / height.max(1)).max(1);
    let zooms: Vec<u32> = pairs.iter().map(|(_, pair)| zoom(pair.size)).collect();
    let sizes = || pairs.iter().zip(&zooms).map(|((_, pair), zoom)| pair.size.map(|side| side * zoom));
    let across = sizes().map(|[width, _]| width).max().unwrap_or(0).max(MIN_WIDTH);
    let down: u32 = sizes().map(|[_, height]| GAP + TITLE + height + LEGEND).sum();
    let mut sheet = RgbImage::from_pixel(3 * across + 4 * GAP, down + GAP, PAPER);
    let mut top = GAP;
    for ((what, pair), zoom) in pairs.iter().zip(zooms) {
        let title = if what.is_empty() { "pinhole's" } else { what };
        draw(&mut sheet, (title, pair), zoom, (across, top));
        top += GAP + TITLE + pair.size[1] * zoom + LEGEND;
    }
    let mut png = Cursor::new(Vec::new());
    sheet.write_to(&mut png, ImageFormat::Png).map_err(io::Error::other)?;
    Ok(png.into_inner())
}

/// One scene's three panels, from this height on.
fn draw(sheet: &mut RgbImage, (title, pair): (&str, &PicturePair), zoom: u32, (across, top): (u32, u32)) {
    let [width, height] = pair.size;
    let bytes = pair.light.each_ref().map(|light| pair.bytes(light));
    let apart = |at: usize| signed(bytes[0][at], bytes[1][at]);
    let full = full_of((0..bytes[0].len()).map(|at| apart(at).abs()).collect());
    let titles = [title.to_owned(), "yours".to_owned(), format!("difference × {}", 256.0 / full)];
    for (panel, title) in (0..3).zip(&titles) {
        let left = GAP + panel * (across + GAP);
        write(sheet, title, [left, top], (DOT, INK));
        for (x, y) in (0..height * zoom).flat_map(|y| (0..width * zoom).map(move |x| (x, y))) {
            let at = (y / zoom * width + x / zoom) as usize;
            let colour = if panel == 2 { coloured(apart(at) / full) } else { bytes[panel as usize][at] };
            sheet.put_pixel(left + x, top + TITLE + y, Rgb(colour));
        }
    }
    let (left, top) = (GAP + 2 * (across + GAP), top + TITLE + height * zoom + 6);
    for (x, y) in (0..12).flat_map(|y| (0..across).map(move |x| (x, y))) {
        let along = 2.0 * (f64::from(x) + 0.5) / f64::from(across) - 1.0;
        sheet.put_pixel(left + x, top + y, Rgb(coloured(along)));
    }
    let most = full.min(255.0);
    let words = [format!("-{most} darker"), format!("brighter +{most}")];
    let wide = |words: &str| words.chars().count() as u32 * WIDTH * DOT;
    write(sheet, &words[0], [left, top + 16], (DOT, INK));
    write(sheet, &words[1], [left + across - wide(&words[1]), top + 16], (DOT, INK));
}

/// The difference of the colour that differs most, below 0 where the reader's pixel is the darker one.
fn signed(pinholes: [u8; 3], readers: [u8; 3]) -> f64 {
    let off = [0, 1, 2].map(|channel| f64::from(readers[channel]) - f64::from(pinholes[channel]));
    let most = off.iter().fold(0.0, |max: f64, off| max.max(off.abs()));
    if off.iter().sum::<f64>() < 0.0 { -most } else { most }
}

/// The difference that the brightest colour stands for, of 255: a power of two.
fn full_of(mut apart: Vec<f64>) -> f64 {
    apart.sort_by(f64::total_cmp);
    let last = apart.len().saturating_sub(1 + (apart.len() as f64 * BEYOND) as usize);
    let largest = apart.get(last).copied().unwrap_or(0.0);
    full_white(largest.max(MIN_FULL)).min(256.0)
}

/// Black for no difference, to a bright blue for darker pixels and to a bright orange for brighter ones.
fn coloured(part: f64) -> [u8; 3] {
    // What is not 0 must not look like 0.
    let strength = if part == 0.0 { 0.0 } else { (0.15 + 0.85 * part.abs()).min(1.0) };
    let brightest = if part < 0.0 { [90.0, 160.0, 255.0] } else { [255.0, 170.0, 60.0] };
    brightest.map(|channel: f64| (strength * channel).round() as u8)
}
