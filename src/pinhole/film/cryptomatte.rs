//! Cryptomatte: which shapes a pixel shows, and how much of it each of them covers (Friedman and Jones, *Fully Automatic ID
//! Mattes with Support for Motion Blur and Transparency*, 2015; Psyop's specification 1.2).

use super::{FileAttributes, Film, FilmLayers};
use crate::scene::LayerKind;

/// How many shapes of a pixel a file holds, as the specification suggests; those that cover most of it.
pub const RANKS: usize = 6;

/// MurmurHash3 of 32 bits (Appleby, `MurmurHash3_x86_32`) with the seed 0.
pub fn murmur_hash(bytes: &[u8]) -> u32 {
    let mix = |block: u32| block.wrapping_mul(0xcc9e_2d51).rotate_left(15).wrapping_mul(0x1b87_3593);
    let number = |bytes: &[u8]| bytes.iter().rev().fold(0_u32, |number, &byte| number << 8 | u32::from(byte));
    let blocks = bytes.chunks_exact(4);
    let rest = mix(number(blocks.remainder()));
    let hash = blocks.fold(0_u32, |hash, block| {
        (hash ^ mix(number(block))).rotate_left(13).wrapping_mul(5).wrapping_add(0xe654_6b64)
    });
    let hash = hash ^ rest ^ bytes.len() as u32;
    let hash = (hash ^ hash >> 16).wrapping_mul(0x85eb_ca6b);
    let hash = (hash ^ hash >> 13).wrapping_mul(0xc2b2_ae35);
    hash ^ hash >> 16
}

/// The number of a name in a picture: its hash as the bits of an f32, with one bit of the exponent flipped where that
/// would be zero, subnormal, infinite or NaN.
pub fn float_hash(name: &str) -> f32 {
    let hash = murmur_hash(name.as_bytes());
    let exponent = hash >> 23 & 0xff;
    f32::from_bits(if exponent == 0 || exponent == 0xff { hash ^ 1 << 23 } else { hash })
}

/// The eight hexadecimal digits of such a number.
pub fn hex_of(hash: f32) -> String {
    format!("{:08x}", hash.to_bits())
}

/// Names and their numbers as JSON; names that are alike share one.
pub fn manifest<'n>(names: impl Iterator<Item = &'n str>) -> String {
    let mut names: Vec<&str> = names.collect();
    names.sort_unstable();
    names.dedup();
    let entry = |name: &&str| format!("{}:\"{}\"", quoted(name), hex_of(float_hash(name)));
    format!("{{{}}}", names.iter().map(entry).collect::<Vec<_>>().join(","))
}

/// A string of JSON.
fn quoted(name: &str) -> String {
    let mut quoted = String::from('"');
    for letter in name.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            '\0'..'\x20' => quoted += &format!("\\u{:04x}", u32::from(letter)),
            _ => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}

/// The numbers of the shapes' names, as bits, in the order of the shapes.
pub(super) fn hashes(about: &FileAttributes) -> Vec<u32> {
    about.shapes.iter().map(|shape| float_hash(&shape.plain).to_bits()).collect()
}

/// The ranks of a pixel: the number of a shape's name and the part of the pixel's samples that hit it, the largest part
/// first; 0 and 0 where there are no more.
pub(super) fn ranked(layers: &FilmLayers, row: usize, hashes: &[u32]) -> [f32; 2 * RANKS] {
    let taken = f64::from(layers.taken[row].max(1));
    let parts = parts(layers, row, hashes);
    let mut ranked = [0.0; 2 * RANKS];
    for ([own, coverage], (hash, count)) in ranked.as_chunks_mut().0.iter_mut().zip(parts) {
        (*own, *coverage) = (f32::from_bits(hash), (f64::from(count) / taken) as f32);
    }
    ranked
}

/// The numbers of the names that a pixel shows, each with how many samples hit it, the most first.
fn parts(layers: &FilmLayers, row: usize, hashes: &[u32]) -> Vec<(u32, u32)> {
    let mut parts: Vec<(u32, u32)> = Vec::new();
    for (&(_, shape), &count) in layers.mattes.range((row as u32, 0)..=(row as u32, u32::MAX)) {
        // A picture that says no names has the shapes' numbers in their place.
        let hash = hashes.get(shape as usize).copied().unwrap_or_else(|| float_hash(&shape.to_string()).to_bits());
        match parts.iter_mut().find(|(own, _)| *own == hash) {
            // Shapes of the same name are one, as the specification wants it.
            Some((_, of_name)) => *of_name += count,
            None => parts.push((hash, count)),
        }
    }
    parts.sort_by_key(|&(hash, count)| (std::cmp::Reverse(count), hash));
    parts
}

/// In how many pixels a film's layer `cryptomatte` has more names than a file holds, and the largest part of a pixel that
/// is thereby left out.
pub fn left_out(film: &Film, about: &FileAttributes) -> (usize, f64) {
    let (hashes, mut pixels, mut largest) = (hashes(about), 0, 0.0_f64);
    for layers in film.layers.iter().filter(|layers| layers.kinds.contains(&LayerKind::Cryptomatte)) {
        for row in 0..layers.taken.len() {
            let rest: u32 = parts(layers, row, &hashes).iter().skip(RANKS).map(|&(_, count)| count).sum();
            pixels += usize::from(rest > 0);
            largest = largest.max(f64::from(rest) / f64::from(layers.taken[row].max(1)));
        }
    }
    (pixels, largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The examples of the specification, and what Blender 5.0 writes for its default scene.
    #[test]
    fn names_have_the_numbers_that_others_give_them() {
        assert_eq!(murmur_hash(b"torus"), 4_053_562_365);
        assert_eq!(murmur_hash("равнина".as_bytes()), 2_518_896_926);
        assert!((float_hash("torus") / -1.549_436_3e30 - 1.0).abs() < 1e-6);
        let known = [
            ("bunny", "13851a76"),
            ("default", "42c9679f"),
            ("bunny_porcelain_mat", "b24b26d4"),
            ("Cube", "a8fce865"),
            ("Light", "c77d43e5"),
        ];
        for (name, digits) in known {
            assert_eq!(hex_of(float_hash(name)), digits, "{name}");
        }
        // The key of Blender's attributes is the first seven digits of the layer's name.
        assert_eq!(&hex_of(float_hash("ViewLayer.CryptoObject"))[..7], "542cafa");
        eprintln!("cryptomatte: {} names as others number them", 3 + known.len());
    }

    #[test]
    fn no_name_is_numbered_by_what_is_no_normal_number() {
        let names = (0..100_000).map(|number| format!("shape {number}"));
        let flipped = names.filter(|name| {
            assert!(float_hash(name).is_normal(), "{name}");
            float_hash(name).to_bits() != murmur_hash(name.as_bytes())
        });
        let flipped = flipped.count();
        // Two exponents of 256.
        assert!((600..1000).contains(&flipped), "{flipped}");
        eprintln!("cryptomatte: 100000 names, {flipped} with a flipped bit");
    }

    #[test]
    fn a_manifest_is_json_whatever_the_names() {
        let names = ["b", "a \"quoted\" \\ name", "tab\there", "b", "Würfel"];
        assert_eq!(
            manifest(names.into_iter()),
            format!(
                r#"{{"Würfel":"{}","a \"quoted\" \\ name":"{}","b":"{}","tab\u0009here":"{}"}}"#,
                hex_of(float_hash("Würfel")),
                hex_of(float_hash(names[1])),
                hex_of(float_hash("b")),
                hex_of(float_hash(names[2]))
            )
        );
    }
}
