use super::json::Json;
use crate::model_error::ModelError;
use std::borrow::Cow;
use std::fmt;

/// The greatest whole number that a JSON number holds exactly.
const MAX: f64 = (1_u64 << 53) as f64;

/// An object of a glTF file, and its path in it.
#[derive(Clone, Debug)]
pub struct Object<'a> {
    /// The name of the file.
    pub file: &'a str,
    /// Its path, such as `materials[3].pbrMetallicRoughness`; empty for the whole file.
    pub path: String,
    fields: &'a [(Cow<'a, str>, Json<'a>)],
}

impl<'a> Object<'a> {
    /// The object at a path.
    ///
    /// Errors: it is none.
    pub fn at(file: &'a str, path: String, json: &'a Json<'a>) -> Result<Self, ModelError> {
        match json {
            Json::Object(fields) => Ok(Self { file, path, fields }),
            other => {
                let place = if path.is_empty() { "the file" } else { &path };
                Err(ModelError::new(file, place, other, "it must be an object"))
            }
        }
    }

    /// The value of a field.
    pub fn get(&self, field: &str) -> Option<&'a Json<'a>> {
        // A hostile file may have a hundred thousand fields in one object, and refer to it as often.
        let place = self.fields.partition_point(|(name, _)| &**name < field);
        self.fields.get(place).filter(|(name, _)| name == field).map(|(_, value)| value)
    }

    /// The names of its fields and their values.
    pub fn fields(&self) -> impl Iterator<Item = (&'a str, &'a Json<'a>)> + use<'a> {
        let fields = self.fields;
        fields.iter().map(|(name, value)| (&**name, value))
    }

    /// The path of a field.
    pub fn path_of(&self, field: impl fmt::Display) -> String {
        if self.path.is_empty() { field.to_string() } else { format!("{}.{field}", self.path) }
    }

    /// The error of a field.
    pub fn refused(
        &self,
        field: impl fmt::Display,
        value: impl fmt::Display,
        accepted: impl fmt::Display,
    ) -> ModelError {
        ModelError::new(self.file, self.path_of(field), value, accepted)
    }

    /// The value that a field must have.
    pub fn needed<T>(&self, field: &str, value: Option<T>) -> Result<T, ModelError> {
        value.ok_or_else(|| self.refused(field, "missing", "it is needed"))
    }

    /// A number.
    pub fn number(&self, field: &str) -> Result<Option<f64>, ModelError> {
        match self.get(field) {
            None => Ok(None),
            Some(Json::Number(number)) => Ok(Some(*number)),
            Some(other) => Err(self.refused(field, other, "it must be a number")),
        }
    }

    /// A whole number, at least 0.
    pub fn whole(&self, field: &str) -> Result<Option<u64>, ModelError> {
        match self.get(field) {
            None => Ok(None),
            Some(Json::Number(number)) if (0.0..=MAX).contains(number) && number.fract() == 0.0 => {
                Ok(Some(*number as u64))
            }
            Some(other) => Err(self.refused(field, other, "it must be a whole number from 0 to 2⁵³")),
        }
    }

    /// The index of a row of a table of this length.
    pub fn index(&self, field: &str, rows: usize) -> Result<Option<usize>, ModelError> {
        self.get(field).map(|json| self.index_in(field, json, rows)).transpose()
    }

    /// A value of this object as an index.
    pub fn index_in(&self, field: impl fmt::Display, json: &Json<'_>, rows: usize) -> Result<usize, ModelError> {
        match json {
            Json::Number(number) if *number >= 0.0 && *number < rows as f64 && number.fract() == 0.0 => {
                Ok(*number as usize)
            }
            other if rows == 0 => Err(self.refused(field, other, "there is nothing that it could refer to")),
            other => {
                let accepted = format!("it must be a whole number from 0 to {}, for there are {rows}", rows - 1);
                Err(self.refused(field, other, accepted))
            }
        }
    }

    /// So many numbers.
    pub fn numbers<const N: usize>(&self, field: &str) -> Result<Option<[f64; N]>, ModelError> {
        let Some(json) = self.get(field) else { return Ok(None) };
        let refused = || self.refused(field, json, format_args!("it must be a list of {N} numbers"));
        let Json::List(list) = json else { return Err(refused()) };
        if list.len() != N {
            return Err(refused());
        }
        let mut numbers = [0.0; N];
        for (number, json) in numbers.iter_mut().zip(list) {
            let Json::Number(own) = json else { return Err(refused()) };
            *number = *own;
        }
        Ok(Some(numbers))
    }

    /// A text.
    pub fn text(&self, field: &str) -> Result<Option<&'a str>, ModelError> {
        match self.get(field) {
            None => Ok(None),
            Some(Json::Text(text)) => Ok(Some(text)),
            Some(other) => Err(self.refused(field, other, "it must be a text")),
        }
    }

    /// true or false; false if it is missing.
    pub fn flag(&self, field: &str) -> Result<bool, ModelError> {
        match self.get(field) {
            None => Ok(false),
            Some(Json::Flag(flag)) => Ok(*flag),
            Some(other) => Err(self.refused(field, other, "it must be true or false")),
        }
    }

    /// An object.
    pub fn object(&self, field: &str) -> Result<Option<Self>, ModelError> {
        self.get(field).map(|json| Self::at(self.file, self.path_of(field), json)).transpose()
    }

    /// The object of an extension.
    pub fn extension(&self, name: &str) -> Result<Option<Self>, ModelError> {
        self.object("extensions")?.map_or(Ok(None), |extensions| extensions.object(name))
    }

    /// A list; empty if it is missing.
    pub fn list(&self, field: &str) -> Result<&'a [Json<'a>], ModelError> {
        match self.get(field) {
            None => Ok(&[]),
            Some(Json::List(list)) => Ok(list),
            Some(other) => Err(self.refused(field, other, "it must be a list")),
        }
    }

    /// An object of one of its lists.
    pub fn item(&self, field: &str, index: usize, json: &'a Json<'a>) -> Result<Self, ModelError> {
        Self::at(self.file, format!("{}[{index}]", self.path_of(field)), json)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_field_of_another_kind_is_refused_with_its_path() {
        let text = "{\"a\": {\"number\": 1.5, \"text\": \"x\", \"flag\": 1, \"list\": [1, 2], \"words\": [1, \"x\"], \
                    \"index\": 3}}";
        let json = Json::read(text.as_bytes()).expect("JSON");
        let root = Object::at("a.gltf", String::new(), &json).expect("an object");
        let object = root.object("a").expect("an object").expect("there");
        let said = |error: Option<ModelError>| error.map_or(String::new(), |error| error.to_string());
        assert_eq!(said(object.number("text").err()), "a.gltf: a.text is \"x\", but it must be a number");
        let whole = "a.gltf: a.number is 1.5, but it must be a whole number from 0 to 2⁵³";
        assert_eq!(said(object.whole("number").err()), whole);
        let index = "a.gltf: a.index is 3, but it must be a whole number from 0 to 2, for there are 3";
        assert_eq!(said(object.index("index", 3).err()), index);
        assert_eq!(object.index("index", 4), Ok(Some(3)));
        let nothing = "a.gltf: a.index is 3, but there is nothing that it could refer to";
        assert_eq!(said(object.index("index", 0).err()), nothing);
        let numbers = "a.gltf: a.list is a list of 2, but it must be a list of 3 numbers";
        assert_eq!(said(object.numbers::<3>("list").err()), numbers);
        assert_eq!(object.numbers("list"), Ok(Some([1.0, 2.0])));
        assert!(object.numbers::<2>("words").is_err() && object.numbers::<2>("text").is_err());
        assert_eq!(said(object.text("number").err()), "a.gltf: a.number is 1.5, but it must be a text");
        assert_eq!(said(object.flag("flag").err()), "a.gltf: a.flag is 1, but it must be true or false");
        assert_eq!(said(object.object("list").err()), "a.gltf: a.list is a list of 2, but it must be an object");
        assert_eq!(said(object.list("flag").err()), "a.gltf: a.flag is 1, but it must be a list");
        assert_eq!(said(object.needed::<u64>("x", None).err()), "a.gltf: a.x is missing, but it is needed");
        let list = object.list("list").expect("a list");
        let item = "a.gltf: a.list[0] is 1, but it must be an object";
        assert_eq!(said(object.item("list", 0, &list[0]).err()), item);
        let file = Json::Number(1.0);
        let whole = Object::at("a.gltf", String::new(), &file).err();
        assert_eq!(said(whole), "a.gltf: the file is 1, but it must be an object");
    }
}
