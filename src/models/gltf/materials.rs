use super::document::{Document, EMISSIVE_STRENGTH, EXTENSIONS, IOR, TRANSMISSION, Table};
use super::images::Images;
use super::object::Object;
use crate::memory::Memory;
use crate::model_error::ModelError;
use crate::model_error::shown;
use crate::model_material::{AlphaMode, ModelMaterial, ModelTexture};
use crate::remarks::Remarks;

/// A material, and the set of texture coordinates that its textures use.
pub struct ReadMaterial {
    /// The material.
    pub material: ModelMaterial,
    /// The set of its first texture's, or 0.
    pub uv_set: u64,
    /// Whether it has a texture.
    pub has_texture: bool,
}

/// Reads the materials.
///
/// Errors: a field of another kind, or an image that cannot be read.
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
    remark_extensions(object, remarks)?;
    let mut uv_sets = Vec::new();
    let mut texture = |holder: &Object<'a>, field: &str, is_srgb: bool, remarks: &mut Remarks| {
        let read = images.texture(holder, field, is_srgb, memory, remarks)?;
        uv_sets.extend(read.map(|(_, uv_set)| uv_set));
        Ok(read.map(|(texture, _)| texture))
    };
    let pbr = object.object("pbrMetallicRoughness")?;
    let mut base_colour_texture: Option<ModelTexture> = None;
    let mut metallic_roughness_texture = None;
    let (mut base, mut metallic, mut roughness) = ([1.0; 4], 1.0, 1.0);
    if let Some(pbr) = pbr {
        base_colour_texture = texture(&pbr, "baseColorTexture", true, remarks)?;
        metallic_roughness_texture = texture(&pbr, "metallicRoughnessTexture", false, remarks)?;
        base = pbr.numbers("baseColorFactor")?.unwrap_or(base);
        metallic = pbr.number("metallicFactor")?.unwrap_or(1.0);
        roughness = pbr.number("roughnessFactor")?.unwrap_or(1.0);
    }
    let normal_texture = texture(object, "normalTexture", false, remarks)?;
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
    if let Some(own) = object.extension(TRANSMISSION)? {
        remarks.add_unread("transmission textures", u64::from(own.get("transmissionTexture").is_some()));
    }
    let uv_set = uv_sets.first().copied().unwrap_or(0);
    let others = uv_sets.iter().filter(|own| **own != uv_set).count();
    remarks.add_unread("a second set of texture coordinates", others as u64);
    let [r, g, b, alpha] = base;
    let strength = remarks.clamp(strength, 0.0, f64::MAX);
    let material = ModelMaterial {
        name: object.text("name")?.unwrap_or_default().into(),
        base_colour: remarks.clamp_colour([r, g, b], 1.0),
        base_colour_texture,
        alpha: remarks.clamp(alpha, 0.0, 1.0),
        alpha_mode: alpha_mode(object, remarks)?,
        metallic: remarks.clamp(metallic, 0.0, 1.0),
        roughness: remarks.clamp(roughness, 0.0, 1.0),
        metallic_roughness_texture,
        normal_texture,
        normal_scale: normal_scale.unwrap_or(1.0),
        // A product may be too large for a number.
        emission: remarks.clamp_colour(factor, 1.0).map(|part| (part * strength).min(f64::MAX)),
        emission_texture,
        // 0 stands for a reflectance of 1.
        ior: if ior == 0.0 { 0.0 } else { remarks.clamp(ior, 1.0, f64::MAX) },
        transmission: remarks.clamp(transmission, 0.0, 1.0),
        double_sided: object.flag("doubleSided")?,
    };
    Ok(ReadMaterial { material, uv_set, has_texture: !uv_sets.is_empty() })
}

fn alpha_mode(object: &Object<'_>, remarks: &mut Remarks) -> Result<AlphaMode, ModelError> {
    match object.text("alphaMode")? {
        None | Some("OPAQUE") => Ok(AlphaMode::Opaque),
        Some("MASK") => {
            let cutoff = object.number("alphaCutoff")?.unwrap_or(0.5);
            Ok(AlphaMode::Mask { cutoff: remarks.clamp(cutoff, 0.0, f64::MAX) })
        }
        Some("BLEND") => Ok(AlphaMode::Blend),
        Some(other) => Err(object.refused("alphaMode", shown(other), "it must be \"OPAQUE\", \"MASK\" or \"BLEND\"")),
    }
}

fn remark_extensions(object: &Object<'_>, remarks: &mut Remarks) -> Result<(), ModelError> {
    if let Some(extensions) = object.object("extensions")? {
        for (name, _) in extensions.fields() {
            if !EXTENSIONS.contains(&name) {
                remarks.add_unread(&format!("the extension {name} of a material"), 1);
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::written::{data, mesh, read, refused};
    use crate::{AlphaMode, ImageSource, Model, ModelMaterial, TextureWrap};

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
        assert_eq!(material(""), ModelMaterial { metallic: 1.0, ..ModelMaterial::default() });
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
    fn images_are_there_once() {
        let model = model("'pbrMetallicRoughness':{'baseColorTexture':{'index':0}},'emissiveTexture':{'index':1}");
        assert_eq!(model.images.len(), 1);
        let uri = data(b"\x89PNG");
        let embedded = format!(
            "'images':[{{'uri':'{uri}'}}],'textures':[{{'source':0}}],'materials':[{{'emissiveTexture':{{'index':0}}}}]"
        );
        let images = read(&embedded).expect("read").images;
        assert_eq!(images[0].source, ImageSource::Bytes(b"\x89PNG"[..].into()));
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
             'extensions':{'KHR_texture_transform':{}}},'extensions':{'KHR_materials_clearcoat':{},\
             'KHR_materials_transmission':{'transmissionTexture':{}}}",
        );
        assert_eq!(
            model.remarks.sentences()[1],
            "Not read: the extension KHR_materials_clearcoat of a material (1), the extension KHR_texture_transform \
             of a \
             texture (1), textures without an image in PNG or JPEG (1), occlusion textures (1), transmission textures \
             (1), \
             corners behind the last triangle (1)."
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

    #[test]
    fn broken_materials_are_refused() {
        let mode = "materials[0].alphaMode is \"GLASS\", but it must be \"OPAQUE\", \"MASK\" or \"BLEND\"";
        assert_eq!(refusal("'alphaMode':'GLASS'"), mode);
        let texture =
            "materials[0].normalTexture.index is 5, but it must be a whole number from 0 to 4, for there are 5";
        assert_eq!(refusal("'normalTexture':{'index':5}"), texture);
        assert_eq!(refusal("'normalTexture':{}"), "materials[0].normalTexture.index is missing, but it is needed");
        let view = "bufferViews[0].buffer is missing, but it is needed";
        assert_eq!(refusal("'normalTexture':{'index':2}"), view);
        let colour =
            "materials[0].pbrMetallicRoughness.baseColorFactor is a list of 3, but it must be a list of 4 numbers";
        assert_eq!(refusal("'pbrMetallicRoughness':{'baseColorFactor':[1,1,1]}"), colour);
        let image = "images[0].uri is missing, but an image has a uri or a bufferView";
        let fields = "'images':[{}],'textures':[{'source':0}],'materials':[{'normalTexture':{'index':0}}]";
        assert_eq!(refused(fields), image);
        let wrap = "samplers[0].wrapS is 1, but it must be 10497, 33071 or 33648";
        let fields = "'images':[{'uri':'x'}],'textures':[{'source':0,'sampler':0}],'samplers':[{'wrapS':1}],\
                      'materials':[{'normalTexture':{'index':0}}]";
        assert_eq!(refused(fields), wrap);
    }
}
