use super::map::Map;
use crate::model_material::{AlphaMode, ModelMaterial, ModelTexture};
use crate::remarks::Remarks;

/// The values of `illum` that let light through.
const TRANSPARENT: [f64; 4] = [4.0, 6.0, 7.0, 9.0];

/// A material as a library describes it: nothing but what is there.
#[derive(Clone, Debug, Default)]
pub struct MtlMaterial {
    /// From `newmtl`.
    pub name: String,
    /// From `Kd`.
    pub diffuse: Option<[f64; 3]>,
    /// From `Ks`.
    pub specular: Option<[f64; 3]>,
    /// From `Ke`.
    pub emission: Option<[f64; 3]>,
    /// From `Ns`, the exponent of Phong's highlight.
    pub exponent: Option<f64>,
    /// From `Ni`.
    pub ior: Option<f64>,
    /// From `d`, or 1 less `Tr`.
    pub opacity: Option<f64>,
    /// From `illum`.
    pub illumination: Option<f64>,
    /// From `Pr`.
    pub roughness: Option<f64>,
    /// From `Pm`.
    pub metallic: Option<f64>,
    /// From `map_Kd`.
    pub diffuse_map: Option<ModelTexture>,
    /// Whether there is a `map_Ka`.
    pub has_ambient_map: bool,
    /// From `map_d`.
    pub opacity_map: Option<ModelTexture>,
    /// From `map_Ke`.
    pub emission_map: Option<ModelTexture>,
    /// From `norm`.
    pub normal_map: Option<Map>,
    /// From `bump` or `map_Bump`.
    pub bump_map: Option<Map>,
}

impl MtlMaterial {
    /// The nearest material in the terms of glTF.
    ///
    /// A material that is black but for its highlight is a metal of the highlight's colour; one without a highlight is
    /// as rough as can be.
    pub fn into_material(self, remarks: &mut Remarks) -> ModelMaterial {
        let black = |colour: Option<[f64; 3]>| colour.is_some_and(|colour| colour == [0.0; 3]);
        let shines = self.specular.is_some_and(|colour| colour != [0.0; 3]);
        let is_metal = black(self.diffuse) && self.diffuse_map.is_none() && shines;
        let base_colour = if is_metal { self.specular } else { self.diffuse };
        let metallic = self.metallic.unwrap_or(if is_metal { 1.0 } else { 0.0 });
        let roughness = match (self.roughness, self.exponent) {
            (Some(roughness), _) => roughness,
            (None, Some(exponent)) if !black(self.specular) => roughness_of(exponent),
            _ => 1.0,
        };
        let opacity = remarks.clamp(self.opacity.unwrap_or(1.0), 0.0, 1.0);
        let is_glass = self.illumination.is_some_and(|illumination| TRANSPARENT.contains(&illumination));
        let alpha = if is_glass { 1.0 } else { opacity };
        if self.has_ambient_map && self.diffuse_map.is_none() {
            remarks.add_unread("`map_Ka` without `map_Kd`", 1);
        }
        // A map for `norm` is one of normals; in `map_Bump`, Blender and others write one, too, and grey ones are heights.
        let normal_map = self.normal_map.or(self.bump_map);
        // A factor makes a black base white under a texture, as older exporters mean it.
        let under_texture = self.diffuse_map.is_some() && (black(self.diffuse) || self.diffuse.is_none());
        ModelMaterial {
            name: self.name.into(),
            base_colour: if under_texture {
                [1.0; 3]
            } else {
                remarks.clamp_colour(base_colour.unwrap_or([0.8; 3]), 1.0)
            },
            base_colour_texture: self.diffuse_map,
            alpha,
            alpha_mode: if alpha < 1.0 || self.opacity_map.is_some() { AlphaMode::Blend } else { AlphaMode::Opaque },
            opacity_texture: self.opacity_map,
            metallic: remarks.clamp(metallic, 0.0, 1.0),
            roughness: remarks.clamp(roughness, 0.0, 1.0),
            normal_texture: normal_map.map(|map| map.texture),
            normal_scale: normal_map.map_or(1.0, |map| map.factor),
            emission: remarks.clamp_colour(
                self.emission.unwrap_or(if self.emission_map.is_some() { [1.0; 3] } else { [0.0; 3] }),
                f64::MAX,
            ),
            emission_texture: self.emission_map,
            ior: remarks.clamp(self.ior.unwrap_or(1.5), 1.0, 10.0),
            transmission: if is_glass { 1.0 - opacity } else { 0.0 },
            double_sided: true,
            ..ModelMaterial::default()
        }
    }
}

/// The perceived roughness whose highlight is as wide as that of a Phong exponent: α² = 2 / (exponent + 2).
fn roughness_of(exponent: f64) -> f64 {
    libm::sqrt(libm::sqrt(2.0 / (exponent.max(0.0) + 2.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::Memory;
    use crate::obj::mtl::{MtlImages, read_mtl};

    fn read(text: &str) -> (ModelMaterial, Remarks) {
        let mut remarks = Remarks::default();
        let text = format!("newmtl a b\n{text}");
        let (mut images, mut memory) = (MtlImages::default(), Memory::of(&[]));
        let materials = read_mtl("a.mtl", text.as_bytes(), &mut images, &mut memory, &mut remarks).expect("read");
        (materials[0].clone(), remarks)
    }

    #[test]
    fn a_material_without_a_word_is_grey_and_rough() {
        let (material, remarks) = read("");
        assert_eq!((&*material.name, material.base_colour, material.roughness), ("a b", [0.8; 3], 1.0));
        assert_eq!((material.metallic, material.ior, material.alpha, material.transmission), (0.0, 1.5, 1.0, 0.0));
        assert_eq!(remarks, Remarks::default());
    }

    #[test]
    fn phong_s_exponent_becomes_a_roughness() {
        assert_eq!(read("Ks 0.5 0.5 0.5\nNs 0").0.roughness, 1.0);
        assert!((read("Ns 30").0.roughness - 0.5).abs() < 1e-15);
        assert_eq!(read("Ks 0 0 0\nNs 30").0.roughness, 1.0);
        assert_eq!(read("Ns 30\nPr 0.25\nPm 0.75").0.roughness, 0.25);
        assert_eq!(read("Pm 0.75").0.metallic, 0.75);
        assert_eq!(read("Ns -5").0.roughness, 1.0);
    }

    #[test]
    fn black_with_a_highlight_is_a_metal() {
        let (material, _) = read("Kd 0 0 0\nKs 0.9 0.7 0.3\nNs 100");
        assert_eq!((material.metallic, material.base_colour), (1.0, [0.9, 0.7, 0.3]));
        let (material, _) = read("Kd 0 0 0\nKs 0.9 0.7 0.3\nmap_Kd a.png");
        assert_eq!((material.metallic, material.base_colour), (0.0, [1.0; 3]));
    }

    #[test]
    fn opacity_is_alpha_or_transmission() {
        let (material, _) = read("d 0.25");
        assert_eq!((material.alpha, material.alpha_mode, material.transmission), (0.25, AlphaMode::Blend, 0.0));
        assert_eq!(read("Tr 0.25").0.alpha, 0.75);
        let (material, _) = read("d 0.25\nillum 7\nNi 1.33");
        assert_eq!((material.alpha, material.alpha_mode, material.transmission), (1.0, AlphaMode::Opaque, 0.75));
        assert_eq!(material.ior, 1.33);
    }

    #[test]
    fn light_and_normals_are_read() {
        let (material, _) = read("Ke 5 0 0\nmap_Bump -bm 0.5 n.png");
        assert_eq!((material.emission, material.normal_scale), ([5.0, 0.0, 0.0], 0.5));
        assert_eq!(read("map_Ke n.png").0.emission, [1.0; 3]);
        let (material, _) = read("norm n.png\nbump -bm 9 h.png");
        assert_eq!((material.normal_scale, material.normal_texture.map(|texture| texture.image)), (1.0, Some(0)));
    }

    #[test]
    fn numbers_out_of_range_are_clamped_and_counted() {
        let (material, remarks) = read("Kd 2 1 -1\nPr 2\nPm -1\nd 1.5\nNi 0\nKe -1 0 0");
        assert_eq!((material.base_colour, material.roughness, material.metallic), ([1.0, 1.0, 0.0], 1.0, 0.0));
        assert_eq!((material.alpha, material.ior, material.emission), (1.0, 1.0, [0.0; 3]));
        assert_eq!(remarks.clamped, 6);
    }
}
