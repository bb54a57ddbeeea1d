use super::buffers::Buffers;
use super::document::{Document, Table};
use super::object::Object;
use super::uri::{data_of, file_name};
use crate::memory::Memory;
use crate::model_error::ModelError;
use crate::model_error::shown;
use crate::model_material::{ImageSource, ModelImage, ModelTexture, TextureWrap};
use crate::remarks::Remarks;
use std::collections::HashMap;
use std::sync::Arc;

/// The images that materials have asked for so far.
pub struct Images<'a> {
    document: &'a Document<'a>,
    buffers: &'a Buffers<'a>,
    /// The bytes or the file of each image of the file.
    sources: HashMap<usize, ImageSource>,
    /// The bytes of each view that holds an image.
    by_view: HashMap<usize, Arc<[u8]>>,
    /// The index of each image as it is used: by the file's name, or by where its bytes are in memory.
    by_use: HashMap<(Result<Arc<str>, usize>, bool), usize>,
    /// The images.
    pub images: Vec<ModelImage>,
}

impl<'a> Images<'a> {
    /// None so far.
    pub fn of(document: &'a Document<'a>, buffers: &'a Buffers<'a>) -> Self {
        let (sources, by_view, by_use) = Default::default();
        Self { document, buffers, sources, by_view, by_use, images: Vec::new() }
    }

    /// The texture that a field of a material names, and the set of texture coordinates it uses.
    ///
    /// Errors: an index that is none, or an image that cannot be read.
    pub fn texture(
        &mut self,
        material: &Object<'a>,
        field: &str,
        is_srgb: bool,
        memory: &mut Memory,
        remarks: &mut Remarks,
    ) -> Result<Option<(ModelTexture, u64)>, ModelError> {
        let Some(info) = material.object(field)? else { return Ok(None) };
        let uv_set = info.whole("texCoord")?.unwrap_or(0);
        let texture = info.needed("index", self.document.refer(&info, "index", Table::Textures)?)?;
        if let Some(extensions) = info.object("extensions")? {
            for (name, _) in extensions.fields() {
                remarks.add_unread(&format!("the extension {name} of a texture"), 1);
            }
        }
        let Some(index) = texture.index("source", self.document.rows(Table::Images))? else {
            remarks.add_unread("textures without an image in PNG or JPEG", 1);
            return Ok(None);
        };
        let image = self.image(index, is_srgb, memory)?;
        let sampler = self.document.refer(&texture, "sampler", Table::Samplers)?;
        let (mut wrap, mut nearest) = ([TextureWrap::Repeat; 2], false);
        if let Some(sampler) = sampler {
            for (wrap, field) in wrap.iter_mut().zip(["wrapS", "wrapT"]) {
                *wrap = match sampler.whole(field)?.unwrap_or(10_497) {
                    10_497 => TextureWrap::Repeat,
                    33_071 => TextureWrap::Clamp,
                    33_648 => TextureWrap::Mirror,
                    code => {
                        return Err(sampler.refused(field, code, "it must be 10497, 33071 or 33648"));
                    }
                };
            }
            nearest = sampler.whole("magFilter")? == Some(9728);
        }
        Ok(Some((ModelTexture { image, wrap, nearest, ..ModelTexture::default() }, uv_set)))
    }

    fn image(&mut self, index: usize, is_srgb: bool, memory: &mut Memory) -> Result<usize, ModelError> {
        let object = self.document.row(Table::Images, index)?;
        let source = match self.sources.get(&index) {
            Some(source) => source.clone(),
            None => {
                let source = self.source(&object, memory)?;
                self.sources.insert(index, source.clone());
                source
            }
        };
        let place = match &source {
            ImageSource::File(file) => Ok(file.clone()),
            ImageSource::Bytes(bytes) => Err(bytes.as_ptr().addr()),
        };
        if let Some(known) = self.by_use.get(&(place.clone(), is_srgb)) {
            return Ok(*known);
        }
        let name = match (object.text("name")?, &source) {
            (None | Some(""), ImageSource::File(file)) => file.clone(),
            (name, _) => name.unwrap_or_default().into(),
        };
        self.by_use.insert((place, is_srgb), self.images.len());
        self.images.push(ModelImage { name, source, is_srgb });
        Ok(self.images.len() - 1)
    }

    fn source(&mut self, object: &Object<'a>, memory: &mut Memory) -> Result<ImageSource, ModelError> {
        if let Some(uri) = object.text("uri")? {
            return match data_of(uri) {
                None => Ok(ImageSource::File(file_name(uri).into())),
                Some(Ok(bytes)) => Ok(ImageSource::Bytes(bytes.into())),
                Some(Err(accepted)) => Err(object.refused("uri", shown(uri), accepted)),
            };
        }
        let view = object.index("bufferView", self.document.rows(Table::Views))?;
        let Some(view) = view else {
            return Err(object.refused("uri", "missing", "an image has a uri or a bufferView"));
        };
        let bytes = match self.by_view.get(&view) {
            Some(bytes) => bytes.clone(),
            None => {
                let bytes = self.buffers.view(self.document, &self.document.row(Table::Views, view)?)?;
                memory.take(bytes.len() as u64, 1, || [object.file.into(), object.path.clone()])?;
                let bytes: Arc<[u8]> = bytes.into();
                self.by_view.insert(view, bytes.clone());
                bytes
            }
        };
        Ok(ImageSource::Bytes(bytes))
    }
}
