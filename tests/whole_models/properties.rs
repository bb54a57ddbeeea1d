//! What a glTF file may say, one property at a time.

use super::*;

/// What a file may say beside the base, each in a change or two, and whether the picture must show it.
pub fn properties() -> Vec<(&'static str, bool, Vec<(&'static str, Value)>)> {
    let texture = json!({ "index": 0 });
    let png = image(image::ImageFormat::Png, colourful);
    let mut flipped = png.clone();
    flipped[png.len() / 2] ^= 0xff;
    let base_texture = ("/materials/0/pbrMetallicRoughness/baseColorTexture", texture.clone());
    let textured = |place: &'static str, value: Value| vec![base_texture.clone(), (place, value)];
    let moved = |field: &str, value: Value| {
        let mut info = texture.clone();
        info["extensions"] = json!({ "KHR_texture_transform": { field: value } });
        vec![("/materials/0/pbrMetallicRoughness/baseColorTexture", info)]
    };
    let thin = ("/materials/0/pbrMetallicRoughness/baseColorFactor", json!([0.9, 0.9, 0.9, 0.4]));
    let clear = ("/materials/0/extensions/KHR_materials_transmission/transmissionFactor", json!(1.0));
    let skin = vec![
        ("/skins/0", json!({ "joints": [3], "inverseBindMatrices": 6 })),
        ("/nodes/0/skin", json!(0)),
        ("/meshes/0/primitives/0/attributes/WEIGHTS_0", json!(4)),
        ("/meshes/0/primitives/0/attributes/JOINTS_0", json!(5)),
    ];
    let mut all = vec![
        ("base colour", true, vec![("/materials/0/pbrMetallicRoughness/baseColorFactor", json!([0.1, 0.9, 0.1, 1.0]))]),
        ("metallic", true, vec![("/materials/0/pbrMetallicRoughness/metallicFactor", json!(1.0))]),
        ("roughness", true, vec![("/materials/0/pbrMetallicRoughness/roughnessFactor", json!(0.9))]),
        ("base colour texture", true, vec![base_texture.clone()]),
        (
            "metallic–roughness texture",
            true,
            vec![("/materials/0/pbrMetallicRoughness/metallicRoughnessTexture", texture.clone())],
        ),
        ("emission", true, vec![("/materials/0/emissiveFactor", json!([1.0, 0.0, 0.0]))]),
        ("emission texture", true, vec![("/materials/0/emissiveTexture", texture.clone())]),
        (
            "emissive strength",
            true,
            vec![("/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", json!(5.0))],
        ),
        ("occlusion", false, vec![("/materials/0/occlusionTexture", texture.clone())]),
        ("alpha mask", true, vec![thin.clone(), ("/materials/0/alphaMode", json!("MASK"))]),
        ("alpha blend", true, vec![thin, ("/materials/0/alphaMode", json!("BLEND"))]),
        (
            "clear coat",
            true,
            vec![("/materials/0/extensions/KHR_materials_clearcoat", json!({ "clearcoatFactor": 1.0 }))],
        ),
        ("alpha mode that is none", false, vec![("/materials/0/alphaMode", json!("GLASS"))]),
        ("single-sided", false, vec![("/materials/0/doubleSided", json!(false))]),
        ("index of refraction", true, vec![("/materials/0/extensions/KHR_materials_ior/ior", json!(2.5))]),
        ("transmission", true, vec![clear.clone()]),
        ("transmission in part", false, vec![(clear.0, json!(0.4))]),
        (
            "transmission texture",
            true,
            vec![
                clear.clone(),
                ("/materials/0/extensions/KHR_materials_transmission/transmissionTexture", texture.clone()),
            ],
        ),
        (
            "thickness",
            true,
            vec![clear.clone(), ("/materials/0/extensions/KHR_materials_volume/thicknessFactor", json!(0.1))],
        ),
        ("wrap along u", true, textured("/samplers/0/wrapS", json!(33648))),
        ("wrap along v", true, textured("/samplers/0/wrapT", json!(33071))),
        ("wrap mode that is none", true, textured("/samplers/0/wrapS", json!(1))),
        ("nearest texel", true, textured("/samplers/0/magFilter", json!(9728))),
        ("minification", true, textured("/samplers/0/minFilter", json!(9728))),
        ("texture offset", true, moved("offset", json!([0.3, 0.1]))),
        ("texture rotation", true, moved("rotation", json!(0.5))),
        ("texture scale", true, moved("scale", json!([2.0, 3.0]))),
        (
            "texture coordinates that are not there",
            true,
            vec![("/materials/0/pbrMetallicRoughness/baseColorTexture", json!({ "index": 0, "texCoord": 3 }))],
        ),
        ("image that is not there", false, textured("/images/0", json!({ "uri": "none.png" }))),
        ("image without data", false, textured("/images/0", json!({}))),
        ("image that is damaged", false, textured("/images/0/uri", uri(b"\x89PNG\r\n\x1a\nno"))),
        ("image that breaks off", false, textured("/images/0/uri", uri(&png[..png.len() - 20]))),
        ("image with a wrong checksum", false, textured("/images/0/uri", uri(&flipped))),
        ("image of another kind", false, textured("/images/0/uri", uri(b"GIF89a\0\0\0\0\0\0"))),
        ("texture without an image", false, textured("/textures/0", json!({}))),
        ("tangents", false, vec![("/meshes/0/primitives/0/attributes/TANGENT", json!(4))]),
        ("own attribute", false, vec![("/meshes/0/primitives/0/attributes/_OWN", json!(4))]),
        ("second coordinates", false, vec![("/meshes/0/primitives/0/attributes/TEXCOORD_1", json!(2))]),
        ("points", false, vec![("/meshes/0/primitives/1", json!({ "attributes": { "POSITION": 0 }, "mode": 0 }))]),
        ("lines", false, vec![("/meshes/0/primitives/1", json!({ "attributes": { "POSITION": 0 }, "mode": 1 }))]),
        (
            "morph target",
            true,
            vec![("/meshes/0/primitives/0/targets/0", json!({ "POSITION": 1 })), ("/meshes/0/weights", json!([0.5]))],
        ),
        (
            "morph target of another kind",
            true,
            vec![
                ("/meshes/0/primitives/0/targets/0", json!({ "POSITION": 1, "COLOR_0": 4 })),
                ("/meshes/0/weights", json!([0.5])),
            ],
        ),
        ("skin", true, skin),
        ("animation", false, vec![("/animations/0", json!({ "channels": [], "samplers": [] }))]),
        ("second scene", false, vec![("/scenes", json!([{ "nodes": [0, 1, 2] }, {}]))]),
        (
            "instances",
            true,
            vec![
                ("/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes", json!({ "TRANSLATION": 0, "SCALE": 4 })),
                ("/accessors/4", json!({ "bufferView": 4, "componentType": 5126, "count": 4, "type": "VEC3" })),
            ],
        ),
        ("scale", true, vec![("/nodes/0/scale", json!([0.5, 0.5, 0.5]))]),
        ("scale of 0", false, vec![("/nodes/0/scale", json!([1.0, 0.0, 1.0])), ("/nodes/3/mesh", json!(0))]),
        (
            "matrix that shears",
            true,
            vec![("/nodes/0/matrix", json!([1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]))],
        ),
        ("light colour", true, vec![("/extensions/KHR_lights_punctual/lights/0/color", json!([1.0, 0.0, 0.0]))]),
        ("light range", false, vec![("/extensions/KHR_lights_punctual/lights/0/range", json!(2.0))]),
        (
            "spot light",
            true,
            vec![(LIGHT, json!({ "type": "spot", "intensity": 50.0, "spot": { "outerConeAngle": 0.3 } }))],
        ),
        ("far clip plane", false, vec![("/cameras/0/perspective/zfar", json!(1.0))]),
        ("near clip plane", false, vec![("/cameras/0/perspective/znear", json!(5.0))]),
        ("second camera", false, vec![("/nodes/3/camera", json!(0))]),
        ("field of view", true, vec![("/cameras/0/perspective/yfov", json!(0.5))]),
        (
            "specular and glossiness beside another",
            false,
            vec![("/materials/0/extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor", json!(0.5))],
        ),
        (
            "specular and glossiness",
            true,
            vec![(
                "/materials/0",
                json!({ "doubleSided": true, "extensions": { "KHR_materials_pbrSpecularGlossiness": { "diffuseFactor": [0.1, 0.2, 0.3, 1.0] } } }),
            )],
        ),
    ];
    for name in ["unlit", "variants", "sheen", "specular", "iridescence", "anisotropy", "dispersion", "new"] {
        let place: &'static str = format!("/materials/0/extensions/KHR_materials_{name}").leak();
        all.push((name, false, vec![(place, json!({}))]));
        let required = ("/extensionsRequired", json!([format!("KHR_materials_{name}")]));
        all.push((name, false, vec![(place, json!({})), required]));
    }
    for holder in [
        "",
        "/asset",
        "/buffers/0",
        "/bufferViews/1",
        "/accessors/1",
        "/images/0",
        "/samplers/0",
        "/textures/0",
        "/meshes/0",
        "/meshes/0/primitives/0",
        "/cameras/0",
        "/cameras/0/perspective",
        "/nodes/1",
        LIGHT,
    ] {
        let place: &'static str = format!("{holder}/extensions/VENDOR_any").leak();
        all.push((place, false, vec![(place, json!({}))]));
    }
    all
}
