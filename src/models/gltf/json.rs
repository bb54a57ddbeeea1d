use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use std::borrow::Cow;
use std::fmt;

/// A value of JSON.
///
/// `serde_json`'s own may take two hundred times the memory of its text; this one takes forty at most.
#[derive(Clone, Debug, PartialEq)]
pub enum Json<'t> {
    /// null
    Null,
    /// true or false
    Flag(bool),
    /// A number.
    Number(f64),
    /// A text.
    Text(Cow<'t, str>),
    /// A list.
    List(Box<[Json<'t>]>),
    /// An object.
    Object(Fields<'t>),
}

/// The fields of an object, in the order of their names.
pub type Fields<'t> = Box<[(Cow<'t, str>, Json<'t>)]>;

impl<'t> Json<'t> {
    /// Reads a text.
    ///
    /// Errors: `serde_json`'s message.
    pub fn read(text: &'t [u8]) -> Result<Self, String> {
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        serde_json::from_slice(text).map_err(|error| error.to_string())
    }
}

/// The value as messages show it.
impl fmt::Display for Json<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Null => f.write_str("null"),
            Self::Flag(flag) => write!(f, "{flag}"),
            Self::Number(number) if number.abs() < 1e15 => write!(f, "{number}"),
            Self::Number(number) => write!(f, "{number:e}"),
            Self::Text(text) => f.write_str(&crate::model_error::shown(text)),
            Self::List(list) => write!(f, "a list of {}", list.len()),
            Self::Object(_) => f.write_str("an object"),
        }
    }
}

impl<'de> Deserialize<'de> for Json<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(JsonVisitor)
    }
}

struct JsonVisitor;

impl<'de> Visitor<'de> for JsonVisitor {
    type Value = Json<'de>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("JSON")
    }

    fn visit_unit<E>(self) -> Result<Self::Value, E> {
        Ok(Json::Null)
    }

    fn visit_bool<E>(self, flag: bool) -> Result<Self::Value, E> {
        Ok(Json::Flag(flag))
    }

    fn visit_f64<E>(self, number: f64) -> Result<Self::Value, E> {
        Ok(Json::Number(number))
    }

    fn visit_i64<E>(self, number: i64) -> Result<Self::Value, E> {
        Ok(Json::Number(number as f64))
    }

    fn visit_u64<E>(self, number: u64) -> Result<Self::Value, E> {
        Ok(Json::Number(number as f64))
    }

    fn visit_borrowed_str<E>(self, text: &'de str) -> Result<Self::Value, E> {
        Ok(Json::Text(Cow::Borrowed(text)))
    }

    fn visit_str<E>(self, text: &str) -> Result<Self::Value, E> {
        Ok(Json::Text(Cow::Owned(text.to_owned())))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut list = Vec::new();
        while let Some(value) = seq.next_element()? {
            list.push(value);
        }
        Ok(Json::List(list.into_boxed_slice()))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut fields = Vec::new();
        while let Some(Key(name)) = map.next_key()? {
            fields.push((name, map.next_value()?));
        }
        // Of two fields of one name, the first is found, for the order of equal ones is kept.
        fields.sort_by(|(a, _), (b, _)| a.cmp(b));
        Ok(Json::Object(fields.into_boxed_slice()))
    }
}

/// A field's name: borrowed from the text unless it has escapes.
struct Key<'t>(Cow<'t, str>);

impl<'de> Deserialize<'de> for Key<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match deserializer.deserialize_str(JsonVisitor)? {
            Json::Text(text) => Ok(Self(text)),
            _ => Ok(Self(Cow::Borrowed(""))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_is_read_as_it_is() {
        let text = "\u{feff} {\"a\": [1, -2.5, 1e3, true, null, \"x\\n\"], \"b\\u0020c\": {}}";
        let list = [
            Json::Number(1.0),
            Json::Number(-2.5),
            Json::Number(1000.0),
            Json::Flag(true),
            Json::Null,
            Json::Text("x\n".into()),
        ];
        let fields = [("a".into(), Json::List(list.into())), ("b c".into(), Json::Object([].into()))];
        assert_eq!(Json::read(text.as_bytes()), Ok(Json::Object(fields.into())));
    }

    #[test]
    fn deep_nesting_is_refused() {
        assert!(Json::read("[".repeat(100_000).as_bytes()).is_err_and(|error| error.contains("recursion limit")));
        assert!(Json::read(b"{\"a\": 1e400}").is_err());
        assert!(Json::read(b"{\"a\": \"\xff\"}").is_err());
    }

    #[test]
    fn values_are_shown_in_few_words() {
        let shown = |text: &str| Json::read(text.as_bytes()).map(|json| json.to_string());
        let cases = [
            ("null", "null"),
            ("false", "false"),
            ("3", "3"),
            ("0.25", "0.25"),
            ("1e300", "1e300"),
            ("\"a\"", "\"a\""),
            ("[1, 2]", "a list of 2"),
            ("{\"a\": 1}", "an object"),
        ];
        for (text, expected) in cases {
            assert_eq!(shown(text), Ok(expected.into()));
        }
    }
}
