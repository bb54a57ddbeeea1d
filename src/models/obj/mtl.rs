use super::lines::{lines, rest_of};
use super::map::Map;
use super::mtl_material::MtlMaterial;
use crate::memory::Memory;
use crate::model_error::ModelError;
use crate::model_error::{shown, shown_bytes};
use crate::model_material::{ImageSource, ModelImage, ModelMaterial};
use crate::number::{finite, without_mark, words};
use crate::remarks::Remarks;
use std::collections::HashMap;
use std::sync::Arc;

/// What is read elsewhere, or has no counterpart in the material and is no loss: the ambient colour.
const IGNORED: [&[u8]; 1] = [b"ka"];

/// Reads a material library; a number that is none is one of the remarks, as if its line were not there.
///
/// Errors: more materials than such a file may describe.
pub fn read_mtl(
    file: &str,
    bytes: &[u8],
    images: &mut MtlImages,
    memory: &mut Memory,
    remarks: &mut Remarks,
) -> Result<Vec<ModelMaterial>, ModelError> {
    let mut materials = Vec::new();
    let mut current: Option<MtlMaterial> = None;
    for (number, line) in lines(without_mark(bytes)) {
        let mut words = words(&line);
        let Some(written) = words.next() else { continue };
        // Some programs write `map_kd`.
        let keyword = written.to_ascii_lowercase();
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
                let Some(number) = finite(word) else {
                    let (written, word) = (shown_keyword(written), shown_bytes(word));
                    let place = format!("{written} on line {number} of {}", shown(file));
                    remarks.add_unread(&format!("{place}, since {word} is no finite number"), 1);
                    return None;
                };
                *part = number;
                count += 1;
            }
            match count {
                0 => None,
                // One number stands for three.
                1 => Some([parts[0]; 3]),
                _ => Some(parts),
            }
        };
        match &keyword[..] {
            b"kd" => replace(&mut material.diffuse, parts()),
            b"ks" => replace(&mut material.specular, parts()),
            b"ke" => replace(&mut material.emission, parts()),
            b"ns" => replace(&mut material.exponent, first(parts())),
            b"ni" => replace(&mut material.ior, first(parts())),
            b"d" => replace(&mut material.opacity, first(parts())),
            b"tr" => replace(&mut material.opacity, first(parts()).map(|transparency| 1.0 - transparency)),
            b"illum" => replace(&mut material.illumination, first(parts())),
            b"pr" => replace(&mut material.roughness, first(parts())),
            b"pm" => replace(&mut material.metallic, first(parts())),
            _ if IGNORED.contains(&&keyword[..]) => {}
            _ => {
                let mut map = |is_srgb| Map::read(&rest_of(&line), is_srgb, images, remarks);
                match &keyword[..] {
                    b"map_kd" => replace(&mut material.diffuse_map, map(true).map(|map| map.texture)),
                    b"map_d" => replace(&mut material.opacity_map, map(false).map(|map| map.texture)),
                    b"map_ka" => material.has_ambient_map = true,
                    b"map_ke" => replace(&mut material.emission_map, map(true).map(|map| map.texture)),
                    b"norm" => replace(&mut material.normal_map, map(false)),
                    // Exporters write normal maps under these names as well as heights; their texels tell.
                    b"bump" | b"map_bump" => replace(&mut material.bump_map, map(false)),
                    _ => remarks.add_unread(&shown_keyword(written), 1),
                }
            }
        }
    }
    materials.extend(current.map(|read| read.into_material(remarks)));
    Ok(materials)
}

/// Sets what a line gives, if it gives anything.
fn replace<T>(field: &mut Option<T>, given: Option<T>) {
    if given.is_some() {
        *field = given;
    }
}

fn shown_keyword(keyword: &[u8]) -> String {
    format!("`{}`", String::from_utf8_lossy(&keyword[..keyword.len().min(80)]))
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
    pub fn index(&mut self, file: &str, is_srgb: bool) -> usize {
        let file: Arc<str> = file.into();
        *self.by_use.entry((file.clone(), is_srgb)).or_insert_with(|| {
            self.images.push(ModelImage { name: file.clone(), source: ImageSource::File(file), is_srgb });
            self.images.len() - 1
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model_material::ModelTexture;

    fn read(text: &str) -> (Vec<ModelMaterial>, MtlImages, Remarks) {
        let (mut images, mut remarks) = (MtlImages::default(), Remarks::default());
        let read = read_mtl("a.mtl", text.as_bytes(), &mut images, &mut Memory::of(&[]), &mut remarks);
        (read.expect("read"), images, remarks)
    }

    #[test]
    fn images_are_listed_once_for_each_use() {
        let (materials, images, remarks) =
            read("newmtl a\nmap_Kd x.png\nnorm x.png\nnewmtl b\nmap_Kd x.png\nmap_Ke y.png\n");
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
    fn a_line_whose_numbers_are_none_is_left_out_and_said() {
        let (materials, _, remarks) = read("newmtl a\nKd 0 1 0\nKd 1 two 3\nNs inf\nKs spectral a.rfl\nPr 0.25");
        assert_eq!((materials[0].base_colour, materials[0].roughness), ([0.0, 1.0, 0.0], 0.25));
        let of = |keyword: &str, line: u32, word: &str| {
            format!("`{keyword}` on line {line} of \"a.mtl\", since \"{word}\" is no finite number (1)")
        };
        let all = [of("Kd", 3, "two"), of("Ns", 4, "inf"), of("Ks", 5, "spectral")].join(", ");
        assert_eq!(remarks.sentences(), [format!("Not read: {all}.")]);
    }

    #[test]
    fn a_library_describes_as_many_materials_as_its_bytes_allow() {
        let (mut images, mut memory) = (MtlImages::default(), Memory::of(&[]));
        let many = "newmtl a\n".repeat(10_000);
        let read = read_mtl("a.mtl", many.as_bytes(), &mut images, &mut memory, &mut Remarks::default());
        let sentence = read.expect_err("refused").to_string();
        assert!(sentence.contains("the material on line "), "{sentence}");
    }

    #[test]
    fn keywords_may_be_in_any_case() {
        let (materials, images, remarks) = read("\u{feff}newmtl A\nkd 1 0 0\nmap_kd a.png\nMAP_BUMP b.png\nKA 1 1 1\n");
        assert_eq!((&*materials[0].name, images.images.len()), ("A", 2));
        assert_eq!(remarks, Remarks::default());
    }

    #[test]
    fn what_is_not_read_is_said() {
        let (_, _, remarks) = read("Kd 1 1 1\nnewmtl a\nKa 1 1 1\nTf 1 1 1\nTf 1 1 1\nmap_Ks z.png\nmap_Ka a.png");
        let sentence = "Not read: lines before the first material of a library (1), `Tf` (2), `map_Ks` (1), `map_Ka` \
                        without `map_Kd` (1).";
        assert_eq!(remarks.sentences(), [sentence]);
        let (_, _, remarks) = read("newmtl a\nmap_Ka a.png\nmap_Kd a.png\nd 0.5\nillum 7");
        assert_eq!(remarks, Remarks::default());
    }
}
