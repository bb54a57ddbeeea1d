use super::document::{CLEARCOAT, Document, EMISSIVE_STRENGTH, IOR, SPECULAR_GLOSSINESS, TRANSMISSION, Table, VOLUME};
use super::images::Images;
use super::object::Object;
use super::specular_glossiness::specular_glossiness;
use crate::memory::Memory;
use crate::model_error::ModelError;
use crate::model_error::shown;
use crate::model_material::{AlphaMode, ModelMaterial, ModelTexture};
use crate::remarks::Remarks;

/// The least part of an attenuation colour: an absorption is not infinite.
const DARKEST: f64 = 1e-4;

/// A material, and the set of texture coordinates that its textures use.
pub struct ReadMaterial {
    /// The material.
    pub material: ModelMaterial,
    /// The set of its first texture's, or 0.
    pub uv_set: u64,
    /// Whether it has a texture.
    pub has_texture: bool,
}

/// Base colour with its opacity, metallic, roughness, and the textures of both, as the material gives them.
pub struct Reflection {
    /// The factor of the base colour and, last, of the opacity.
    pub base: [f64; 4],
    /// The base colour's image.
    pub base_colour_texture: Option<ModelTexture>,
    /// How much of it is metal.
    pub metallic: f64,
    /// The perceived roughness.
    pub roughness: f64,
    /// The image of both.
    pub metallic_roughness_texture: Option<ModelTexture>,
}

/// The material of what has none: every value is its default (glTF 2.0, 3.7.2.1 and 3.9.2), so white, all metal, rough and
/// seen from one side.
pub fn default_material() -> ModelMaterial {
    ModelMaterial { name: "default material".into(), metallic: 1.0, thin: true, ..ModelMaterial::default() }
}

/// Reads the materials.
///
/// Errors: a field of another kind, or images that take too much memory.
pub fn read_materials<'a>(
    document: &'a Document<'a>,
    images: &mut Images<'a>,
    memory: &mut Memory,
    remarks: &mut Remarks,
) -> Result<Vec<ReadMaterial>, ModelError> {
    let rows = document.rows(Table::Materials);
    let file = || [document.root.file.into(), "the list of materials".into()];
    // They are moved once, so that they are there twice.
    memory.take(rows as u64, 2 * size_of::<ReadMaterial>() as u64, file)?;
    let mut materials = Vec::with_capacity(rows);
    for index in 0..rows {
        let object = document.row(Table::Materials, index)?;
        materials.push(read_material(&object, images, memory, remarks)?);
    }
    Ok(materials)
}

fn read_material<'a>(
    object: &Object<'a>,
    images: &mut Images<'a>,
    memory: &mut Memory,
    remarks: &mut Remarks,
) -> Result<ReadMaterial, ModelError> {
    let mut uv_sets = Vec::new();
    let mut texture = |holder: &Object<'a>, field: &str, is_srgb: bool, remarks: &mut Remarks| {
        let read = images.texture(holder, field, is_srgb, memory, remarks)?;
        uv_sets.extend(read.map(|(_, uv_set)| uv_set));
        Ok(read.map(|(texture, _)| texture))
    };
    let mut reflection = Reflection {
        base: [1.0; 4],
        base_colour_texture: None,
        metallic: 1.0,
        roughness: 1.0,
        metallic_roughness_texture: None,
    };
    let pbr = object.object("pbrMetallicRoughness")?;
    let specular = object.extension(SPECULAR_GLOSSINESS)?;
    // Where a material is given both ways, the one of glTF itself is what this renderer has.
    remarks.add_unread(
        &format!("{SPECULAR_GLOSSINESS} beside metallic and roughness"),
        u64::from(pbr.is_some() && specular.is_some()),
    );
    if let Some(pbr) = pbr {
        reflection.base_colour_texture = texture(&pbr, "baseColorTexture", true, remarks)?;
        reflection.metallic_roughness_texture = texture(&pbr, "metallicRoughnessTexture", false, remarks)?;
        reflection.base = pbr.numbers("baseColorFactor")?.unwrap_or([1.0; 4]);
        reflection.metallic = pbr.number("metallicFactor")?.unwrap_or(1.0);
        reflection.roughness = pbr.number("roughnessFactor")?.unwrap_or(1.0);
    } else if let Some(specular) = specular {
        reflection = specular_glossiness(&specular, &mut texture, remarks)?;
    }
    let normal_texture = texture(object, "normalTexture", false, remarks)?;
    let is_nearest = normal_texture.is_some_and(|texture: ModelTexture| texture.nearest);
    remarks.add_unread("the nearest filter of normal maps", u64::from(is_nearest));
    let normal_scale = object.object("normalTexture")?.map_or(Ok(None), |normal| normal.number("scale"))?;
    let emission_texture = texture(object, "emissiveTexture", true, remarks)?;
    remarks.add_unread("occlusion textures", u64::from(object.get("occlusionTexture").is_some()));
    let factor = object.numbers("emissiveFactor")?.unwrap_or([0.0; 3]);
    let of_extension = |name: &str, field: &str, default: f64| {
        object.extension(name)?.map_or(Ok(default), |own| Ok(own.number(field)?.unwrap_or(default)))
    };
    let strength = of_extension(EMISSIVE_STRENGTH, "emissiveStrength", 1.0)?;
    let ior = of_extension(IOR, "ior", 1.5)?;
    let transmission = of_extension(TRANSMISSION, "transmissionFactor", 0.0)?;
    let coat = of_extension(CLEARCOAT, "clearcoatFactor", 0.0)?;
    let coat_roughness = of_extension(CLEARCOAT, "clearcoatRoughnessFactor", 0.0)?;
    if let Some(own) = object.extension(CLEARCOAT)? {
        let textures = ["clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"];
        let there = textures.iter().filter(|texture| own.get(texture).is_some()).count();
        remarks.add_unread("textures of clear coats", there as u64);
    }
    if let Some(own) = object.extension(TRANSMISSION)? {
        remarks.add_unread("transmission textures", u64::from(own.get("transmissionTexture").is_some()));
    }
    let thickness = of_extension(VOLUME, "thicknessFactor", 0.0)?;
    let uv_set = uv_sets.first().copied().unwrap_or(0);
    let others = uv_sets.iter().filter(|own| **own != uv_set).count();
    remarks.add_unread("a second set of texture coordinates", others as u64);
    let Reflection { base: [r, g, b, alpha], metallic, roughness, .. } = reflection;
    let strength = remarks.clamp(strength, 0.0, f64::MAX);
    let material = ModelMaterial {
        name: object.text("name")?.unwrap_or_default().into(),
        base_colour: remarks.clamp_colour([r, g, b], 1.0),
        base_colour_texture: reflection.base_colour_texture,
        alpha: remarks.clamp(alpha, 0.0, 1.0),
        alpha_mode: alpha_mode(object, remarks)?,
        opacity_texture: None,
        metallic: remarks.clamp(metallic, 0.0, 1.0),
        roughness: remarks.clamp(roughness, 0.0, 1.0),
        metallic_roughness_texture: reflection.metallic_roughness_texture,
        normal_texture,
        normal_scale: normal_scale.unwrap_or(1.0),
        // A product may be too large for a number.
        emission: remarks.clamp_colour(factor, 1.0).map(|part| (part * strength).min(f64::MAX)),
        emission_texture,
        // 0 stands for a reflectance of 1.
        ior: if ior == 0.0 { 0.0 } else { remarks.clamp(ior, 1.0, f64::MAX) },
        transmission: remarks.clamp(transmission, 0.0, 1.0),
        coat: remarks.clamp(coat, 0.0, 1.0),
        coat_roughness: remarks.clamp(coat_roughness, 0.0, 1.0),
        thin: thickness <= 0.0,
        absorption: if thickness > 0.0 { absorption(object, remarks)? } else { [0.0; 3] },
        double_sided: object.flag("doubleSided")?,
    };
    Ok(ReadMaterial { material, uv_set, has_texture: !uv_sets.is_empty() })
}

/// The absorption of which the attenuation colour is left after the attenuation distance.
fn absorption(object: &Object<'_>, remarks: &mut Remarks) -> Result<[f64; 3], ModelError> {
    let Some(volume) = object.extension(VOLUME)? else { return Ok([0.0; 3]) };
    let distance = volume.number("attenuationDistance")?.unwrap_or(f64::INFINITY);
    let colour = remarks.clamp_colour(volume.numbers("attenuationColor")?.unwrap_or([1.0; 3]), 1.0);
    let distance = remarks.clamp(distance, f64::MIN_POSITIVE, f64::INFINITY);
    Ok(colour.map(|part| (-libm::log(part.max(DARKEST)) / distance).clamp(0.0, f64::MAX)))
}

fn alpha_mode(object: &Object<'_>, remarks: &mut Remarks) -> Result<AlphaMode, ModelError> {
    match object.text("alphaMode")? {
        None | Some("OPAQUE") => Ok(AlphaMode::Opaque),
        Some("MASK") => {
            let cutoff = object.number("alphaCutoff")?.unwrap_or(0.5);
            Ok(AlphaMode::Mask { cutoff: remarks.clamp(cutoff, 0.0, f64::MAX) })
        }
        Some("BLEND") => Ok(AlphaMode::Blend),
        Some(other) => {
            remarks.add_unread(&format!("the alphaMode {}, which is none", shown(other)), 1);
            Ok(AlphaMode::Opaque)
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::written::{mesh, read, refused};
    use crate::{AlphaMode, ImageSource, Model, ModelMaterial, ModelTexture, TextureWrap};

    const IMAGES: &str = "'images':[{'uri':'a%20b.png'},{'uri':'a b.png','name':'again'},{'bufferView':0},\
                          {'bufferView':0}],\
                          'textures':[{'source':0},{'source':1},{'source':2,'sampler':0},{'source':3},{}],\
                          'samplers':[{'wrapS':33071,'wrapT':33648,'magFilter':9728}]";

    fn model(material: &str) -> Model {
        read(&format!("{},{IMAGES},'materials':[{{{material}}}]", mesh("{'attributes':{'POSITION':0}}"))).expect("read")
    }

    fn material(fields: &str) -> ModelMaterial {
        model(fields).materials[0].clone()
    }

    fn refusal(material: &str) -> String {
        refused(&format!("{IMAGES},'materials':[{{{material}}}],'bufferViews':[{{}}]"))
    }

    #[test]
    fn what_a_material_does_not_say_is_gltf_s_default() {
        assert_eq!(material(""), ModelMaterial { metallic: 1.0, thin: true, ..ModelMaterial::default() });
    }

    /// As if the file gave an empty one, whether it gives others or none.
    #[test]
    fn what_has_no_material_has_gltf_s_default() {
        for others in ["", ",'materials':[{'pbrMetallicRoughness':{'roughnessFactor':0.5}}]"] {
            let model = read(&format!("{}{others}", mesh("{'attributes':{'POSITION':0}}"))).expect("read");
            let own = &model.materials[model.instances[0].material.expect("the default")];
            assert_eq!(*own, ModelMaterial { name: "default material".into(), ..material("") }, "{others}");
            assert_eq!((own.base_colour, own.metallic, own.roughness, own.double_sided), ([1.0; 3], 1.0, 1.0, false));
        }
        assert_eq!(model("").materials.len(), 2, "one of the file's that is not used");
    }

    #[test]
    fn every_field_is_read() {
        let all = "'name':'all','pbrMetallicRoughness':{'baseColorFactor':[0.1,0.2,0.3,0.4],'metallicFactor':0.5,\
                   'roughnessFactor':0.6,'baseColorTexture':{'index':0},'metallicRoughnessTexture':{'index':1}},\
                   'normalTexture':{'index':2,'scale':0.7},'emissiveFactor':[0.5,0.25,1],'emissiveTexture':{'index':3},\
                   'alphaMode':'MASK','alphaCutoff':0.8,'doubleSided':true,'extensions':{\
                   'KHR_materials_emissive_strength':{'emissiveStrength':4},'KHR_materials_ior':{'ior':1.25},\
                   'KHR_materials_transmission':{'transmissionFactor':0.9}}";
        let model = model(all);
        let own = &model.materials[0];
        assert_eq!((&*own.name, own.base_colour, own.alpha), ("all", [0.1, 0.2, 0.3], 0.4));
        assert_eq!((own.metallic, own.roughness, own.normal_scale), (0.5, 0.6, 0.7));
        assert_eq!((own.emission, own.ior, own.transmission), ([2.0, 1.0, 4.0], 1.25, 0.9));
        assert_eq!((own.alpha_mode, own.double_sided), (AlphaMode::Mask { cutoff: 0.8 }, true));
        let normal = own.normal_texture.expect("a texture");
        assert_eq!((normal.wrap, normal.nearest), ([TextureWrap::Clamp, TextureWrap::Mirror], true));
        // The same file by two names is one image for each use, and so are the same bytes.
        let images: Vec<_> = model.images.iter().map(|image| (&*image.name, image.is_srgb)).collect();
        assert_eq!(images, [("a b.png", true), ("again", false), ("", false), ("", true)]);
        assert_eq!(model.images[0].source, ImageSource::File("a b.png".into()));
        match (&model.images[2].source, &model.images[3].source) {
            (ImageSource::Bytes(first), ImageSource::Bytes(second)) => assert!(std::sync::Arc::ptr_eq(first, second)),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn numbers_out_of_range_are_clamped_and_counted() {
        let model = model(
            "'pbrMetallicRoughness':{'baseColorFactor':[2,-1,0.5,3],'metallicFactor':-1,'roughnessFactor':7},\
             'emissiveFactor':[2,0,0],'alphaMode':'BLEND','extensions':{'KHR_materials_ior':{'ior':0.5},\
             'KHR_materials_transmission':{'transmissionFactor':2},\
             'KHR_materials_emissive_strength':{'emissiveStrength':-1}}",
        );
        let own = &model.materials[0];
        assert_eq!((own.base_colour, own.alpha, own.metallic, own.roughness), ([1.0, 0.0, 0.5], 1.0, 0.0, 1.0));
        assert_eq!((own.emission, own.ior, own.transmission), ([0.0; 3], 1.0, 1.0));
        assert_eq!((own.alpha_mode, model.remarks.clamped), (AlphaMode::Blend, 8));
        assert_eq!(material("'extensions':{'KHR_materials_ior':{'ior':0}}").ior, 0.0);
        let bright =
            "'emissiveFactor':[1,1,1],'extensions':{'KHR_materials_emissive_strength':{'emissiveStrength':1e308}}";
        assert_eq!(material(bright).emission, [1e308; 3]);
    }

    #[test]
    fn what_is_not_read_is_said() {
        let model = model(
            "'occlusionTexture':{'index':0},'emissiveTexture':{'index':4},'normalTexture':{'index':0,'texCoord':1,\
             'extensions':{'KHR_texture_transform':{}}},'extensions':{'KHR_materials_sheen':{},\
             'KHR_materials_transmission':{'transmissionTexture':{}}}",
        );
        assert_eq!(
            model.remarks.sentences()[1],
            "Not read: the extension KHR_materials_sheen (1), textures without an image in PNG or JPEG (1), \
             occlusion textures (1), transmission textures (1), corners behind the last triangle (1)."
        );
    }

    #[test]
    fn textures_choose_the_set_of_texture_coordinates() {
        let textured = |set: usize| {
            let primitive = "{'attributes':{'POSITION':0,'TEXCOORD_1':2},'indices':3,'material':0}";
            let material = format!("'emissiveTexture':{{'index':0,'texCoord':{set}}}");
            read(&format!("{},{IMAGES},'materials':[{{{material}}}]", mesh(primitive))).expect("read")
        };
        let (first, second) = (textured(0), textured(1));
        assert!(first.meshes[0].uvs.is_none() && second.meshes[0].uvs.is_some());
        assert_eq!((first.remarks.without_uvs, second.remarks.without_uvs), (1, 0));
    }

    /// The extension may choose another set, and each texture has its own.
    #[test]
    fn textures_transform_their_coordinates() {
        let textured = |transforms: [&str; 2]| {
            let of =
                |own: &str| format!("{{'index':0,'texCoord':7,'extensions':{{'KHR_texture_transform':{{{own}}}}}}}");
            let material = format!("'normalTexture':{},'emissiveTexture':{}", of(transforms[0]), of(transforms[1]));
            let primitive = "{'attributes':{'POSITION':0,'TEXCOORD_1':2},'indices':3,'material':0}";
            read(&format!("{},{IMAGES},'materials':[{{{material}}}]", mesh(primitive))).expect("read")
        };
        let moved = "'texCoord':1,'scale':[4,2],'offset':[0,0.5],'rotation':0.25";
        let model = textured([moved, "'texCoord':1"]);
        let ModelMaterial { normal_texture, emission_texture, .. } = &model.materials[0];
        let of = |texture: &Option<ModelTexture>| texture.map(|own| (own.scale, own.offset, own.rotation));
        assert_eq!(of(normal_texture), Some(([4.0, 2.0], [0.0, 0.5], 0.25)));
        assert_eq!(of(emission_texture), Some(([1.0; 2], [0.0; 2], 0.0)));
        assert!(model.meshes[0].uvs.is_some());
        assert_eq!(model.remarks.sentences().len(), 1, "no normals");
        let said = textured([moved, ""]).remarks.sentences().join(" ");
        assert!(said.contains("a second set of texture coordinates (1)"), "{said}");
    }

    #[test]
    fn broken_materials_are_refused() {
        let texture =
            "materials[0].normalTexture.index is 5, but it must be a whole number from 0 to 4, for there are 5";
        assert_eq!(refusal("'normalTexture':{'index':5}"), texture);
        assert_eq!(refusal("'normalTexture':{}"), "materials[0].normalTexture.index is missing, but it is needed");
        let colour =
            "materials[0].pbrMetallicRoughness.baseColorFactor is a list of 3, but it must be a list of 4 numbers";
        assert_eq!(refusal("'pbrMetallicRoughness':{'baseColorFactor':[1,1,1]}"), colour);
    }

    /// With a thickness it is filled with what the attenuation colour is left of; without, it is a thin sheet.
    #[test]
    fn a_volume_has_an_absorption_and_a_surface_without_one_is_thin() {
        let glass = |volume: &str| material(&format!("'extensions':{{'KHR_materials_volume':{{{volume}}}}}"));
        assert!(material("").thin && glass("").thin && glass("'thicknessFactor':0,'attenuationDistance':2").thin);
        let filled = glass("'thicknessFactor':0.1,'attenuationDistance':2,'attenuationColor':[1,0.5,0]");
        assert!(!filled.thin);
        let left = filled.absorption.map(|part| libm::exp(-2.0 * part));
        assert!((left[0] - 1.0).abs() + (left[1] - 0.5).abs() + (left[2] - 1e-4).abs() < 1e-12, "{left:?}");
        assert_eq!(glass("'thicknessFactor':1").absorption, [0.0; 3]);
    }
}
