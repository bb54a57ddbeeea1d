use super::document::{Document, Table};
use super::object::Object;
use super::uri::{data_of, file_name};
use crate::memory::Memory;
use crate::model_error::ModelError;
use crate::open::Open;
use std::borrow::Cow;
use std::collections::HashMap;
use std::rc::Rc;

/// The buffers of a file, each file read once.
pub struct Buffers<'a> {
    bytes: Vec<Rc<Cow<'a, [u8]>>>,
}

impl<'a> Buffers<'a> {
    /// Reads them; the first may be a part of a binary file.
    ///
    /// Errors: a buffer that cannot be read or is too short.
    pub fn read(
        document: &Document<'a>,
        own: Option<&'a [u8]>,
        memory: &mut Memory,
        open: Open<'_>,
    ) -> Result<Self, ModelError> {
        let mut bytes: Vec<Rc<Cow<'a, [u8]>>> = Vec::new();
        // The same data may be there twice, and a file by several spellings of its name.
        let mut by_uri: HashMap<Cow<'a, str>, Rc<Cow<'a, [u8]>>> = HashMap::new();
        for index in 0..document.rows(Table::Buffers) {
            let object = document.row(Table::Buffers, index)?;
            let buffer = match (object.text("uri")?, own) {
                (None, Some(own)) if index == 0 => Rc::new(Cow::Borrowed(own)),
                (None, _) => {
                    let accepted = "only the first buffer of a .glb file may do without";
                    return Err(object.refused("uri", "missing", accepted));
                }
                (Some(uri), _) => {
                    let data = data_of(uri);
                    let name = if data.is_some() { Cow::Borrowed(uri) } else { Cow::Owned(file_name(uri)) };
                    match by_uri.get(&name) {
                        Some(read) => read.clone(),
                        None => {
                            let bytes = bytes_of(&object, uri, (data, &name), memory, open)?;
                            let read: Rc<Cow<'a, [u8]>> = Rc::new(Cow::Owned(bytes));
                            by_uri.insert(name, read.clone());
                            read
                        }
                    }
                }
            };
            let length = object.needed("byteLength", object.whole("byteLength")?)?;
            if length > buffer.len() as u64 {
                let accepted = format!("the buffer has {} bytes", buffer.len());
                return Err(object.refused("byteLength", length, accepted));
            }
            bytes.push(buffer);
        }
        Ok(Self { bytes })
    }

    /// The bytes of a buffer view.
    ///
    /// Errors: it is beyond its buffer.
    pub fn view(&'a self, document: &Document<'a>, view: &Object<'a>) -> Result<&'a [u8], ModelError> {
        let buffer = view.needed("buffer", view.index("buffer", document.rows(Table::Buffers))?)?;
        let offset = view.whole("byteOffset")?.unwrap_or(0);
        let length = view.needed("byteLength", view.whole("byteLength")?)?;
        let bytes: &[u8] = self.bytes.get(buffer).map_or(&[], |buffer| buffer);
        let within = offset.checked_add(length).filter(|end| *end <= bytes.len() as u64);
        let Some(end) = within else {
            let accepted = format!("the buffer has {} bytes and the view begins at {offset}", bytes.len());
            return Err(view.refused("byteLength", length, accepted));
        };
        Ok(&bytes[offset as usize..end as usize])
    }
}

/// The bytes of a buffer's or an image's data URI, or of the file it names.
fn bytes_of(
    object: &Object<'_>,
    uri: &str,
    (data, name): (Option<Result<Vec<u8>, String>>, &str),
    memory: &mut Memory,
    open: Open<'_>,
) -> Result<Vec<u8>, ModelError> {
    let shown = || crate::model_error::shown(uri);
    match data {
        Some(data) => data.map_err(|accepted| object.refused("uri", shown(), accepted)),
        None => {
            let problem = |problem| object.refused("uri", shown(), format_args!("it cannot be read: {problem}"));
            let bytes = open(name).map_err(problem)?;
            memory.add_file(&bytes);
            Ok(bytes)
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::read_model;
    use crate::written::{data, read, refused};

    const VIEW: &str = "'bufferViews':[{'buffer':0,'byteLength':36}],'accessors':[{'bufferView':0,'componentType':5126,\
                        'count':3,'type':'VEC3'}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]";

    #[test]
    fn buffers_are_files_or_data() {
        let model = read(&format!("'buffers':[{{'uri':'a%20b.bin','byteLength':36}}],{VIEW}")).expect("read");
        assert_eq!(model.remarks.degenerate, 1);
        let model = read(&format!("'buffers':[{{'uri':'{}','byteLength':36}}],{VIEW}", data(&[0; 37]))).expect("read");
        assert_eq!(model.remarks.empty_meshes, 1);
    }

    #[test]
    fn each_file_is_opened_once() {
        let buffer = "{\"uri\":\"a.bin\",\"byteLength\":4}";
        let text = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"buffers\":[{}]}}", [buffer; 9].join(","));
        let opened = std::cell::Cell::new(0);
        let open = |_: &str| {
            opened.set(opened.get() + 1);
            Ok(vec![0; 4])
        };
        assert!(read_model("a.gltf", text.as_bytes(), &open).is_ok());
        assert_eq!(opened.get(), 1);
        // However its name is spelled.
        let spelled = ["b.bin", "./b.bin", "x/../b.bin", ".//b.bin", "%62.bin", ".\\\\b.bin"];
        let buffers = spelled.map(|uri| format!("{{\"uri\":\"{uri}\",\"byteLength\":4}}")).join(",");
        let text = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"buffers\":[{buffers}]}}");
        assert!(read_model("a.gltf", text.as_bytes(), &open).is_ok());
        assert_eq!(opened.get(), 2);
    }

    #[test]
    fn buffers_that_are_not_there_are_refused() {
        let missing = "buffers[0].uri is missing, but only the first buffer of a .glb file may do without";
        assert_eq!(refused("'buffers':[{'byteLength':36}]"), missing);
        let unread = "buffers[0].uri is \"../x.bin\", but it cannot be read: there is none";
        assert_eq!(refused("'buffers':[{'uri':'../x.bin','byteLength':36}]"), unread);
        let short = "buffers[0].byteLength is 37, but the buffer has 36 bytes";
        assert_eq!(refused("'buffers':[{'uri':'a b.bin','byteLength':37}]"), short);
        assert_eq!(refused("'buffers':[{'uri':'a b.bin'}]"), "buffers[0].byteLength is missing, but it is needed");
        let comma = "buffers[0].uri is \"data:;base64\", but data has a comma before them";
        assert_eq!(refused("'buffers':[{'uri':'data:;base64','byteLength':1}]"), comma);
    }

    #[test]
    fn views_beyond_their_buffer_are_refused() {
        let with = |view: &str| {
            let buffers = "'buffers':[{'uri':'a b.bin','byteLength':36}]";
            refused(&format!("{buffers},{}", VIEW.replace("'byteLength':36", view)))
        };
        let beyond = "bufferViews[0].byteLength is 33, but the buffer has 36 bytes and the view begins at 4";
        assert_eq!(with("'byteLength':33,'byteOffset':4"), beyond);
        let max = "bufferViews[0].byteLength is 9007199254740992, but the buffer has 36 bytes and the view begins at \
                    9007199254740992";
        assert_eq!(with("'byteLength':9007199254740992,'byteOffset':9007199254740992"), max);
        assert_eq!(
            refused(
                "'bufferViews':[{'buffer':0,'byteLength':1}],'accessors':[{'bufferView':0,'componentType':5126,\
                 'count':1,\
                     'type':'VEC3'}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]"
            ),
            "bufferViews[0].buffer is 0, but there is nothing that it could refer to"
        );
    }
}
