use super::lines::{lines, rest_of};
use super::mtl_material::MtlMaterial;
use crate::memory::Memory;
use crate::model_error::ModelError;
use crate::model_error::shown_bytes;
use crate::model_material::{ImageSource, ModelImage, ModelMaterial, ModelTexture, TextureWrap};
use crate::number::{finite, words};
use crate::remarks::Remarks;
use std::collections::HashMap;
use std::sync::Arc;

/// The options of a map that come before its file name, and the greatest number of words each takes.
const MAP_OPTIONS: [(&str, usize); 14] = [
    ("-blendu", 1),
    ("-blendv", 1),
    ("-bm", 1),
    ("-boost", 1),
    ("-cc", 1),
    ("-clamp", 1),
    ("-colorspace", 1),
    ("-imfchan", 1),
    ("-mm", 2),
    ("-o", 3),
    ("-s", 3),
    ("-t", 3),
    ("-texres", 1),
    ("-type", 1),
];

/// What is read elsewhere, or has no counterpart in the material and is no loss: the ambient colour.
const IGNORED: [&[u8]; 2] = [b"Ka", b"map_Ka"];

/// Reads a material library.
///
/// Errors: a number that is none, or more materials than such a file may describe.
pub fn read_mtl(
    file: &str,
    bytes: &[u8],
    images: &mut MtlImages,
    memory: &mut Memory,
    remarks: &mut Remarks,
) -> Result<Vec<ModelMaterial>, ModelError> {
    let mut materials = Vec::new();
    let mut current: Option<MtlMaterial> = None;
    for (number, line) in lines(bytes) {
        let mut words = words(&line);
        let Some(keyword) = words.next() else { continue };
        if keyword == b"newmtl" {
            materials.extend(current.take().map(|read| read.into_material(remarks)));
            // The lists of materials are moved while they grow.
            let bytes = 4 * size_of::<ModelMaterial>() as u64;
            memory.take(1, bytes, || [file.into(), format!("the material on line {number}")])?;
            current = Some(MtlMaterial { name: rest_of(&line).into(), ..MtlMaterial::default() });
            continue;
        }
        let Some(material) = &mut current else {
            remarks.add_unread("lines before the first material of a library", 1);
            continue;
        };
        let mut parts = || {
            let mut parts = [0.0; 3];
            let mut count = 0;
            for (part, word) in parts.iter_mut().zip(&mut words) {
                *part = finite(word).ok_or_else(|| {
                    let place = format!("`{}` on line {number}", String::from_utf8_lossy(keyword));
                    ModelError::new(file, place, shown_bytes(word), "it needs a finite number")
                })?;
                count += 1;
            }
            Ok(match count {
                0 => None,
                // One number stands for three.
                1 => Some([parts[0]; 3]),
                _ => Some(parts),
            })
        };
        let mut map = |is_srgb| Map::read(&rest_of(&line), is_srgb, images);
        match keyword {
            b"Kd" => material.diffuse = parts()?,
            b"Ks" => material.specular = parts()?,
            b"Ke" => material.emission = parts()?,
            b"Ns" => material.exponent = first(parts()?),
            b"Ni" => material.ior = first(parts()?),
            b"d" => material.opacity = first(parts()?),
            b"Tr" => material.opacity = first(parts()?).map(|transparency| 1.0 - transparency),
            b"illum" => material.illumination = first(parts()?),
            b"Pr" => material.roughness = first(parts()?),
            b"Pm" => material.metallic = first(parts()?),
            b"map_Kd" => material.diffuse_map = map(true).map(|map| map.texture),
            b"map_Ke" => material.emission_map = map(true).map(|map| map.texture),
            b"norm" => material.normal_map = map(false),
            // Exporters write normal maps under these names as well as heights; only the former can be read.
            b"bump" | b"map_Bump" | b"map_bump" => material.bump_map = map(false),
            _ if IGNORED.contains(&keyword) => {}
            _ => remarks.add_unread(&format!("`{}`", String::from_utf8_lossy(&keyword[..keyword.len().min(80)])), 1),
        }
    }
    materials.extend(current.map(|read| read.into_material(remarks)));
    Ok(materials)
}

fn first(parts: Option<[f64; 3]>) -> Option<f64> {
    parts.map(|parts| parts[0])
}

/// The images that maps have named so far.
#[derive(Default)]
pub struct MtlImages {
    /// The images.
    pub images: Vec<ModelImage>,
    by_use: HashMap<(Arc<str>, bool), usize>,
}

impl MtlImages {
    /// The index of an image as it is used.
    fn index(&mut self, file: &str, is_srgb: bool) -> usize {
        let file: Arc<str> = file.into();
        *self.by_use.entry((file.clone(), is_srgb)).or_insert_with(|| {
            self.images.push(ModelImage { name: file.clone(), source: ImageSource::File(file), is_srgb });
            self.images.len() - 1
        })
    }
}

/// A map of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Map {
    /// Its image.
    pub texture: ModelTexture,
    /// Its factor, from `-bm`.
    pub factor: f64,
}

impl Map {
    /// The map that the rest of a line describes, if it names a file.
    fn read(line: &str, is_srgb: bool, images: &mut MtlImages) -> Option<Self> {
        let (mut rest, mut factor, mut wrap) = (line, 1.0, TextureWrap::Repeat);
        let cut = |text: &str| {
            let end = text.find(char::is_whitespace).unwrap_or(text.len());
            (text[..end].to_owned(), end)
        };
        while let (option, end) = cut(rest)
            && let Some((_, most)) = MAP_OPTIONS.iter().find(|(name, _)| *name == option)
        {
            rest = rest[end..].trim_start();
            for taken in 0..*most {
                let (word, end) = cut(rest);
                let number = finite(word.as_bytes());
                // Of up to three numbers, those that are not numbers belong to what follows.
                if taken > 0 && number.is_none() {
                    break;
                }
                match option.as_str() {
                    "-bm" => factor = number.unwrap_or(1.0),
                    "-clamp" if word == "on" => wrap = TextureWrap::Clamp,
                    _ => {}
                }
                rest = rest[end..].trim_start();
            }
        }
        if rest.is_empty() {
            return None;
        }
        let image = images.index(rest, is_srgb);
        Some(Self { texture: ModelTexture { image, wrap: [wrap; 2], ..ModelTexture::default() }, factor })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(line: &str) -> Option<(String, f64, TextureWrap)> {
        let mut images = MtlImages::default();
        let map = Map::read(line, true, &mut images)?;
        Some((images.images[0].name.to_string(), map.factor, map.texture.wrap[0]))
    }

    #[test]
    fn options_come_before_a_map_s_file() {
        let found = |name: &str, factor, wrap| Some((name.to_owned(), factor, wrap));
        assert_eq!(map("brick.png"), found("brick.png", 1.0, TextureWrap::Repeat));
        assert_eq!(map("red brick.png"), found("red brick.png", 1.0, TextureWrap::Repeat));
        assert_eq!(map("-bm 0.5 -clamp on a/b.jpg"), found("a/b.jpg", 0.5, TextureWrap::Clamp));
        assert_eq!(map("-s 1 1 1 -o 0.5 -mm 0 1 b.png"), found("b.png", 1.0, TextureWrap::Repeat));
        assert_eq!(map("-clamp off -imfchan r b.png"), found("b.png", 1.0, TextureWrap::Repeat));
        assert_eq!(map("-bm 0.5"), None);
        assert_eq!(map(""), None);
    }

    #[test]
    fn images_are_listed_once_for_each_use() {
        let text = "newmtl a\nmap_Kd x.png\nnorm x.png\nnewmtl b\nmap_Kd x.png\nmap_Ke y.png\n";
        let (mut images, mut remarks) = (MtlImages::default(), Remarks::default());
        let materials =
            read_mtl("a.mtl", text.as_bytes(), &mut images, &mut Memory::of(&[]), &mut remarks).expect("read");
        let names: Vec<_> = images.images.iter().map(|image| (&*image.name, image.is_srgb)).collect();
        assert_eq!(names, [("x.png", true), ("x.png", false), ("y.png", true)]);
        let image = |texture: Option<ModelTexture>| texture.map(|texture| texture.image);
        assert_eq!(image(materials[0].base_colour_texture), Some(0));
        assert_eq!(image(materials[0].normal_texture), Some(1));
        assert_eq!(image(materials[1].base_colour_texture), Some(0));
        assert_eq!(image(materials[1].emission_texture), Some(2));
        assert_eq!(remarks, Remarks::default());
    }

    #[test]
    fn a_word_that_is_not_numeric_is_refused_with_its_line() {
        let refused = |text: &str| {
            let (mut images, mut memory) = (MtlImages::default(), Memory::of(&[]));
            let read = read_mtl("a.mtl", text.as_bytes(), &mut images, &mut memory, &mut Remarks::default());
            read.expect_err("refused").to_string()
        };
        assert_eq!(refused("newmtl a\nKd 1 two 3"), "a.mtl: `Kd` on line 2 is \"two\", but it needs a finite number");
        let many = "newmtl a\n".repeat(10_000);
        assert!(refused(&many).contains("the material on line "), "{}", refused(&many));
        assert_eq!(refused("newmtl a\n\nNs inf"), "a.mtl: `Ns` on line 3 is \"inf\", but it needs a finite number");
    }

    #[test]
    fn what_is_not_read_is_said() {
        let text = "Kd 1 1 1\nnewmtl a\nKa 1 1 1\nTf 1 1 1\nTf 1 1 1\nmap_Ks z.png\n";
        let mut remarks = Remarks::default();
        let (mut images, mut memory) = (MtlImages::default(), Memory::of(&[]));
        read_mtl("a.mtl", text.as_bytes(), &mut images, &mut memory, &mut remarks).expect("read");
        assert_eq!(
            remarks.sentences(),
            ["Not read: lines before the first material of a library (1), `Tf` (2), `map_Ks` (1)."]
        );
    }
}
