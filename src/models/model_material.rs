use std::sync::Arc;

/// A material in the terms of glTF 2.0's metallic–roughness model, whichever file it is from.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelMaterial {
    /// Its name; may be empty.
    pub name: Arc<str>,
    /// The diffuse albedo of the dielectric and the reflectance of the metal, linear Rec. 709, from 0 to 1; a factor of
    /// the texture's.
    pub base_colour: [f64; 3],
    /// The base colour's image, in sRGB.
    pub base_colour_texture: Option<ModelTexture>,
    /// The opacity, from 0 to 1; a factor of the base colour texture's alpha.
    pub alpha: f64,
    /// How the alpha is meant.
    pub alpha_mode: AlphaMode,
    /// An image of the opacity in red, a factor of the alpha, in place of the base colour texture's.
    pub opacity_texture: Option<ModelTexture>,
    /// 0 for a dielectric, 1 for a metal; a factor of the texture's blue.
    pub metallic: f64,
    /// The perceived roughness, from 0 to 1; a factor of the texture's green.
    pub roughness: f64,
    /// The image of roughness, in green, and metallic, in blue; linear.
    pub metallic_roughness_texture: Option<ModelTexture>,
    /// The normal map in tangent space; linear.
    pub normal_texture: Option<ModelTexture>,
    /// The factor of the normal map's parts to the right and up.
    pub normal_scale: f64,
    /// The emitted radiance, linear Rec. 709, at least 0, the strength included; a factor of the texture's.
    pub emission: [f64; 3],
    /// The emitted radiance's image, in sRGB.
    pub emission_texture: Option<ModelTexture>,
    /// The index of refraction, at least 1, or 0 for a dielectric that reflects all light.
    pub ior: f64,
    /// The fraction of the dielectric's light that passes through it instead of its diffuse base, from 0 to 1.
    pub transmission: f64,
    /// How much of the surface is under a clear coat, from 0 to 1.
    pub coat: f64,
    /// The perceived roughness of the coat, from 0 to 1.
    pub coat_roughness: f64,
    /// Whether what it transmits goes through an infinitely thin sheet, which does not bend it, instead of into an interior.
    pub thin: bool,
    /// The absorption coefficient of the interior, per scene unit of the world; each part at least 0.
    pub absorption: [f64; 3],
    /// Whether both sides are seen; if not, the back is meant to be left out.
    pub double_sided: bool,
}

impl Default for ModelMaterial {
    /// White, a dielectric of index 1.5, as rough as can be.
    fn default() -> Self {
        Self {
            name: "".into(),
            base_colour: [1.0; 3],
            base_colour_texture: None,
            alpha: 1.0,
            alpha_mode: AlphaMode::Opaque,
            opacity_texture: None,
            metallic: 0.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
            emission: [0.0; 3],
            emission_texture: None,
            ior: 1.5,
            transmission: 0.0,
            coat: 0.0,
            coat_roughness: 0.0,
            thin: false,
            absorption: [0.0; 3],
            double_sided: false,
        }
    }
}

/// How a material's alpha is meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// It is ignored.
    Opaque,
    /// What is below the cutoff is not there.
    Mask {
        /// The least alpha that is seen.
        cutoff: f64,
    },
    /// It is the opacity.
    Blend,
}

/// An image as a material uses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelTexture {
    /// The index of the image.
    pub image: usize,
    /// What lies beyond the image's edges, along u and along v.
    pub wrap: [TextureWrap; 2],
    /// Whether it is to be looked up without interpolation.
    pub nearest: bool,
    /// Added to u and v last, in units of the image, v down.
    pub offset: [f64; 2],
    /// The rotation of u and v about (0, 0) after they are scaled, in radians, anticlockwise as one sees the image.
    pub rotation: f64,
    /// The factors of u and v.
    pub scale: [f64; 2],
}

impl Default for ModelTexture {
    /// The first image, repeated, as the mesh's texture coordinates place it.
    fn default() -> Self {
        Self { image: 0, wrap: Default::default(), nearest: false, offset: [0.0; 2], rotation: 0.0, scale: [1.0; 2] }
    }
}

/// What lies beyond an image's edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextureWrap {
    /// The image again.
    #[default]
    Repeat,
    /// Its outermost texels.
    Clamp,
    /// The image again, every second one mirrored.
    Mirror,
}

/// An image, not decoded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelImage {
    /// Its name in the model, or its file name; may be empty.
    pub name: Arc<str>,
    /// Where its bytes are.
    pub source: ImageSource,
    /// Whether its texels are colours in sRGB, or numbers that are taken as they are.
    pub is_srgb: bool,
}

/// Where an image's bytes are.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum ImageSource {
    /// In a file of this name, as the model file names it.
    File(Arc<str>),
    /// In the model file.
    Bytes(Arc<[u8]>),
}
