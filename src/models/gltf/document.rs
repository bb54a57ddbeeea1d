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

/// The extensions that are read; the last allows whole numbers in all attributes.
pub const EXTENSIONS: [&str; 5] = [LIGHTS, EMISSIVE_STRENGTH, IOR, TRANSMISSION, "KHR_mesh_quantization"];

/// The tables of a glTF file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// `accessors`
    Accessors,
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
    /// `textures`
    Textures,
}

const NAMES: [&str; 12] = [
    "accessors",
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
    "textures",
];

/// A glTF file: its tables by name.
pub struct Document<'a> {
    /// The whole file.
    pub root: Object<'a>,
    tables: [&'a [Json<'a>]; 12],
    lights: Option<Object<'a>>,
}

impl<'a> Document<'a> {
    /// That of a file.
    ///
    /// Errors: it needs another version or an extension that is not read, or one of its tables is no list.
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
            let is_read = matches!(name, Json::Text(name) if EXTENSIONS.contains(&&**name));
            if !is_read {
                let accepted =
                    format!("of the extensions that a file may require, those read are {}", EXTENSIONS.join(", "));
                return Err(root.refused(format_args!("extensionsRequired[{index}]"), name, accepted));
            }
        }
        let lights = root.extension(LIGHTS)?;
        let mut tables: [&[Json<'_>]; 12] = [&[]; 12];
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
    fn extensions_that_a_file_requires_are_read_or_refused() {
        for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu"] {
            let expected = format!(
                "extensionsRequired[1] is \"{name}\", but of the extensions that a file may require, those read are \
                 KHR_lights_punctual, KHR_materials_emissive_strength, KHR_materials_ior, KHR_materials_transmission, \
                 KHR_mesh_quantization"
            );
            assert_eq!(refused(&format!("'extensionsRequired':['KHR_materials_ior','{name}']")), expected);
        }
        let model =
            read("'extensionsUsed':['KHR_materials_ior','KHR_animation_pointer'],'animations':[{}],'skins':[{},{}]");
        let sentences = model.expect("read").remarks.sentences();
        assert_eq!(sentences, ["Not read: the extension KHR_animation_pointer (1), animations (1), skins (2)."]);
        assert_eq!(refused("'nodes':{}"), "nodes is an object, but it must be a list");
    }
}
