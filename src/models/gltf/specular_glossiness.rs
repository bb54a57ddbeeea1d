use super::materials::Reflection;
use super::object::Object;
use crate::model_error::ModelError;
use crate::model_material::ModelTexture;
use crate::remarks::Remarks;

/// The reflectance at normal incidence of the dielectric of the other model.
const DIELECTRIC: f64 = 0.04;

/// Reads a texture of a field, in sRGB or not.
type ReadTexture<'r, 'a> =
    &'r mut dyn FnMut(&Object<'a>, &str, bool, &mut Remarks) -> Result<Option<ModelTexture>, ModelError>;

/// A material by specular and glossiness in terms of metallic and roughness.
///
/// An image of specular and glossiness has no counterpart there, and is said to be left out.
/// Errors: a field of another kind.
pub fn specular_glossiness<'a>(
    own: &Object<'a>,
    texture: ReadTexture<'_, 'a>,
    remarks: &mut Remarks,
) -> Result<Reflection, ModelError> {
    let [r, g, b, alpha] = own.numbers("diffuseFactor")?.unwrap_or([1.0; 4]);
    let diffuse = remarks.clamp_colour([r, g, b], 1.0);
    let specular = remarks.clamp_colour(own.numbers("specularFactor")?.unwrap_or([1.0; 3]), 1.0);
    let glossiness = remarks.clamp(own.number("glossinessFactor")?.unwrap_or(1.0), 0.0, 1.0);
    let base_colour_texture = texture(own, "diffuseTexture", true, remarks)?;
    let is_mapped = own.get("specularGlossinessTexture").is_some();
    remarks.add_unread("textures of specular and glossiness", u64::from(is_mapped));
    let is_shiny = base_colour_texture.is_some() && specular.iter().any(|part| *part > 2.0 * DIELECTRIC);
    remarks.add_unread("specular colours beside a diffuse texture", u64::from(is_shiny && !is_mapped));
    // Of an image that is not read, the factors alone say nothing.
    let (base, metallic, roughness) = match is_mapped {
        true => (diffuse, 0.0, 0.5),
        false if base_colour_texture.is_some() => (diffuse, 0.0, 1.0 - glossiness),
        false => {
            let metallic = metallic_of(diffuse, specular);
            (base_of(diffuse, specular, metallic), metallic, 1.0 - glossiness)
        }
    };
    let base = [base[0], base[1], base[2], alpha];
    Ok(Reflection { base, base_colour_texture, metallic, roughness, metallic_roughness_texture: None })
}

/// How bright a colour looks, roughly: by the squares of its parts.
fn brightness([r, g, b]: [f64; 3]) -> f64 {
    libm::sqrt(0.299 * r * r + 0.587 * g * g + 0.114 * b * b)
}

/// How much of the surface is metal, for its diffuse albedo d and its specular reflectance s to be those given: with
/// base colour c, d = c (1 − F) (1 − m) and s = F (1 − m) + c m, where F is that of the dielectric; c is eliminated.
fn metallic_of(diffuse: [f64; 3], specular: [f64; 3]) -> f64 {
    let strongest = specular.into_iter().fold(0.0, f64::max);
    let (diffuse, specular) = (brightness(diffuse) * (1.0 - strongest) / (1.0 - DIELECTRIC), brightness(specular));
    if specular <= DIELECTRIC {
        return 0.0;
    }
    // F m² + (d + s − 2 F) m + F − s = 0
    let (b, c) = (diffuse + specular - 2.0 * DIELECTRIC, DIELECTRIC - specular);
    ((libm::sqrt((b * b - 4.0 * DIELECTRIC * c).max(0.0)) - b) / (2.0 * DIELECTRIC)).clamp(0.0, 1.0)
}

/// The base colour: that of the diffuse albedo for a dielectric, that of the specular reflectance for a metal.
fn base_of(diffuse: [f64; 3], specular: [f64; 3], metallic: f64) -> [f64; 3] {
    let strongest = specular.into_iter().fold(0.0, f64::max);
    let weight = metallic * metallic;
    [0, 1, 2].map(|part| {
        let of_diffuse = diffuse[part] * (1.0 - strongest) / (1.0 - DIELECTRIC) / (1.0 - metallic).max(1e-4);
        let of_specular = (specular[part] - DIELECTRIC * (1.0 - metallic)) / metallic.max(1e-4);
        ((1.0 - weight) * of_diffuse + weight * of_specular).clamp(0.0, 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::written::read;

    /// What is made of the base colour and the metallic of the other model gives them back.
    #[test]
    fn dielectrics_and_metals_come_back() {
        for base in [[0.8, 0.3, 0.1], [0.5, 0.5, 0.5], [0.9, 0.9, 0.2]] {
            for is_metal in [false, true] {
                let (diffuse, specular) = if is_metal { ([0.0; 3], base) } else { (base, [DIELECTRIC; 3]) };
                let metallic = metallic_of(diffuse, specular);
                let found = base_of(diffuse, specular, metallic);
                let apart = (0..3).map(|part| (found[part] - base[part]).abs()).fold(0.0, f64::max);
                assert!((metallic - f64::from(u8::from(is_metal))).abs() < 1e-9 && apart < 1e-9, "{base:?}: {found:?}");
            }
        }
    }

    #[test]
    fn a_material_by_specular_and_glossiness_is_read_where_there_is_no_other() {
        let material = |fields: &str| {
            let own = "'extensions':{'KHR_materials_pbrSpecularGlossiness':{'diffuseFactor':[0.2,0.4,0.6,0.5],\
                       'specularFactor':[0.04,0.04,0.04],'glossinessFactor':0.75}}";
            let model = read(&format!("'materials':[{{{own}{fields}}}]")).expect("read");
            (model.materials[0].clone(), model.remarks.sentences())
        };
        let (own, said) = material("");
        assert_eq!((own.metallic, own.roughness, own.alpha, said.len()), (0.0, 0.25, 0.5, 0));
        assert!((own.base_colour[2] - 0.6).abs() < 1e-12);
        let (other, said) = material(",'pbrMetallicRoughness':{'roughnessFactor':0.5,'metallicFactor':0}");
        assert_eq!((other.roughness, other.base_colour), (0.5, [1.0; 3]));
        assert!(said[0].contains("KHR_materials_pbrSpecularGlossiness"), "{said:?}");
    }
}
