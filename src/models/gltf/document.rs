use super::json::Json;
use super::object::Object;
use crate::model_error::ModelError;
use crate::model_error::shown;

/// The extension of lights.
pub const LIGHTS: &str = "KHR_lights_punctual";
/// The extension of a factor of the emission.
pub const EMISSIVE_STRENGTH: &str = "KHR_materials_emissive_strength";
/// The extension of the index of refraction.
pub const IOR: &str = "KHR_materials_ior";
/// The extension of dielectrics that let light through.
pub const TRANSMISSION: &str = "KHR_materials_transmission";

/// The extension of dielectrics with an interior.
pub const VOLUME: &str = "KHR_materials_volume";
/// The extension of surfaces under a clear coat.
pub const CLEARCOAT: &str = "KHR_materials_clearcoat";
/// The extension of materials by specular and glossiness.
pub const SPECULAR_GLOSSINESS: &str = "KHR_materials_pbrSpecularGlossiness";
/// The extension that offsets, rotates and scales texture coordinates.
pub const TEXTURE_TRANSFORM: &str = "KHR_texture_transform";
/// The extension of many instances at one node.
pub const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// The extensions that are read; the last allows whole numbers in all attributes.
pub const EXTENSIONS: [&str; 10] = [
    LIGHTS,
    EMISSIVE_STRENGTH,
    IOR,
    TRANSMISSION,
    VOLUME,
    CLEARCOAT,
    SPECULAR_GLOSSINESS,
    INSTANCING,
    TEXTURE_TRANSFORM,
    "KHR_mesh_quantization",
];

/// The extensions without which there is no geometry.
const COMPRESSIONS: [&str; 3] = ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"];

/// The tables of a glTF file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// `accessors`
    Accessors,
    /// `animations`
    Animations,
    /// `bufferViews`
    Views,
    /// `buffers`
    Buffers,
    /// `cameras`
    Cameras,
    /// `images`
    Images,
    /// `extensions.KHR_lights_punctual.lights`
    Lights,
    /// `materials`
    Materials,
    /// `meshes`
    Meshes,
    /// `nodes`
    Nodes,
    /// `samplers`
    Samplers,
    /// `scenes`
    Scenes,
    /// `skins`
    Skins,
    /// `textures`
    Textures,
}

const NAMES: [&str; 14] = [
    "accessors",
    "animations",
    "bufferViews",
    "buffers",
    "cameras",
    "images",
    "lights",
    "materials",
    "meshes",
    "nodes",
    "samplers",
    "scenes",
    "skins",
    "textures",
];

/// A glTF file: its tables by name.
pub struct Document<'a> {
    /// The whole file.
    pub root: Object<'a>,
    tables: [&'a [Json<'a>]; 14],
    lights: Option<Object<'a>>,
}

impl<'a> Document<'a> {
    /// That of a file.
    ///
    /// Any other extension that it requires may be left out of the picture, which the remarks say.
    ///
    /// Errors: it needs another version or compressed geometry, or one of its tables is no list.
    pub fn of(file: &'a str, json: &'a Json<'a>) -> Result<Self, ModelError> {
        let root = Object::at(file, String::new(), json)?;
        let asset = root.needed("asset", root.object("asset")?)?;
        for (field, is_needed) in [("version", true), ("minVersion", false)] {
            let version = asset.text(field)?;
            let is_read = version
                .map_or(!is_needed, |version| if is_needed { version.starts_with("2.") } else { version == "2.0" });
            if !is_read {
                let value = version.map_or("missing".to_owned(), shown);
                return Err(asset.refused(field, value, "glTF 2.0 is read"));
            }
        }
        for (index, name) in root.list("extensionsRequired")?.iter().enumerate() {
            if matches!(name, Json::Text(name) if COMPRESSIONS.contains(&&**name)) {
                let accepted = "compressed geometry is not read; export the model without it";
                return Err(root.refused(format_args!("extensionsRequired[{index}]"), name, accepted));
            }
        }
        let lights = root.extension(LIGHTS)?;
        let mut tables: [&[Json<'_>]; 14] = [&[]; 14];
        for (table, name) in tables.iter_mut().zip(NAMES) {
            *table = if name == NAMES[Table::Lights as usize] {
                lights.as_ref().map_or(Ok(&[][..]), |lights| lights.list(name))?
            } else {
                root.list(name)?
            };
        }
        Ok(Self { root, tables, lights })
    }

    /// The number of a table's rows.
    pub fn rows(&self, table: Table) -> usize {
        self.tables[table as usize].len()
    }

    /// A row of a table, which must be there.
    ///
    /// Errors: it is no object.
    pub fn row(&self, table: Table, index: usize) -> Result<Object<'a>, ModelError> {
        let holder = match (table, &self.lights) {
            (Table::Lights, Some(lights)) => lights,
            _ => &self.root,
        };
        let json = self.tables[table as usize].get(index).unwrap_or(&Json::Null);
        holder.item(NAMES[table as usize], index, json)
    }

    /// The row of a table that a field of an object refers to.
    ///
    /// Errors: there is no such row.
    pub fn refer(&self, object: &Object<'a>, field: &str, table: Table) -> Result<Option<Object<'a>>, ModelError> {
        let index = object.index(field, self.rows(table))?;
        index.map(|index| self.row(table, index)).transpose()
    }
}

#[cfg(test)]
mod tests {
    use crate::read_model;
    use crate::written::{read, refused};

    #[test]
    fn other_versions_are_refused() {
        let refused = |text: &str| {
            let none = |_: &str| Err("there is none".to_owned());
            read_model("a.gltf", text.as_bytes(), &none).expect_err("refused").to_string()
        };
        assert_eq!(refused("[]"), "a.gltf: the file is a list of 0, but it must be an object");
        assert_eq!(refused("{}"), "a.gltf: asset is missing, but it is needed");
        assert_eq!(refused("{\"asset\":{}}"), "a.gltf: asset.version is missing, but glTF 2.0 is read");
        let first = "{\"asset\":{\"version\":\"1.0\"}}";
        assert_eq!(refused(first), "a.gltf: asset.version is \"1.0\", but glTF 2.0 is read");
        let later = "{\"asset\":{\"version\":\"2.1\",\"minVersion\":\"2.1\"}}";
        assert_eq!(refused(later), "a.gltf: asset.minVersion is \"2.1\", but glTF 2.0 is read");
        let broken = "a.gltf: the JSON of the file is broken, but it must be whole: EOF while parsing an object at \
                      line 1 column 1";
        assert_eq!(refused("{"), broken);
    }

    #[test]
    fn compressed_geometry_is_refused_and_any_other_extension_only_said() {
        for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression"] {
            let expected = format!(
                "extensionsRequired[1] is \"{name}\", but compressed geometry is not read; export the model without it"
            );
            assert_eq!(refused(&format!("'extensionsRequired':['KHR_materials_ior','{name}']")), expected);
        }
        let said = |fields: &str| read(fields).expect("read").remarks.sentences();
        for name in ["KHR_materials_unlit", "KHR_materials_variants", "KHR_texture_basisu", "VENDOR_new"] {
            let fields = format!("'extensionsRequired':['{name}'],'extensionsUsed':['{name}']");
            assert_eq!(said(&fields), [format!("Not read: the extension {name}, which the file requires (1).")]);
        }
        let used = "'extensionsUsed':['KHR_materials_ior','KHR_animation_pointer'],'animations':[{}]";
        assert_eq!(
            said(used),
            [
                "1 animation of 0 s: shown at rest; --frames shows it.",
                "Not read: the extension KHR_animation_pointer (1).",
            ]
        );
        assert_eq!(refused("'nodes':{}"), "nodes is an object, but it must be a list");
    }

    /// Wherever an extension stands, also within another.
    #[test]
    fn every_extension_is_read_or_said() {
        let own = |name: &str| format!("'extensions':{{'{name}':{{}}}}");
        let fields = format!(
            "'scenes':[{{{}}}],'nodes':[{{{}}},{{{}}}],'samplers':[{{'extensions':{{'KHR_materials_ior':{{{}}}}}}}]",
            own("A"),
            own("B"),
            own("B"),
            own("C")
        );
        let said = read(&fields).expect("read").remarks.sentences();
        assert_eq!(said, ["Not read: the extension B (2), the extension C (1), the extension A (1)."]);
    }
}
