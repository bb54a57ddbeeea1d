use super::buffers::Buffers;
use super::document::{Document, TEXTURE_TRANSFORM, Table};
use super::object::Object;
use super::uri::{data_of, file_name};
use crate::memory::Memory;
use crate::model_error::ModelError;
use crate::model_error::shown;
use crate::model_material::{ImageSource, ModelImage, ModelTexture, TextureWrap};
use crate::remarks::Remarks;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// The codes of filters: the nearest texel, and that of the trilinear one which is always used for minification.
const NEAREST: u64 = 9728;
const LINEAR_MIPMAP_LINEAR: u64 = 9987;

/// Where an image is.
enum Found<'a> {
    /// In a file, or in a URI.
    Source(ImageSource),
    /// In a buffer: its bytes there.
    View(&'a [u8]),
}

/// The images that materials have asked for so far.
pub struct Images<'a> {
    document: &'a Document<'a>,
    buffers: &'a Buffers<'a>,
    /// What became of each image of the file, by its use; none where it cannot be read.
    by_index: HashMap<(usize, bool), Option<usize>>,
    /// The index of each image as it is used, by what it is: one file or the same bytes are one image.
    by_source: HashMap<(ImageSource, bool), usize>,
    /// The bytes of the images in buffers, each once, and by where they are in memory.
    bytes: HashSet<Arc<[u8]>>,
    by_place: HashMap<(usize, usize), Arc<[u8]>>,
    /// The images.
    pub images: Vec<ModelImage>,
}

impl<'a> Images<'a> {
    /// None so far.
    pub fn of(document: &'a Document<'a>, buffers: &'a Buffers<'a>) -> Self {
        let (by_index, by_source, bytes, by_place) = Default::default();
        Self { document, buffers, by_index, by_source, bytes, by_place, images: Vec::new() }
    }

    /// The texture that a field of a material names, and the set of texture coordinates it uses; none where its image cannot be read,
    /// which the remarks say.
    ///
    /// Errors: an index that is none, or images that take too much memory.
    pub fn texture(
        &mut self,
        material: &Object<'a>,
        field: &str,
        is_srgb: bool,
        memory: &mut Memory,
        remarks: &mut Remarks,
    ) -> Result<Option<(ModelTexture, u64)>, ModelError> {
        let Some(info) = material.object(field)? else { return Ok(None) };
        let texture = info.needed("index", self.document.refer(&info, "index", Table::Textures)?)?;
        let Some(index) = texture.index("source", self.document.rows(Table::Images))? else {
            remarks.add_unread("textures without an image in PNG or JPEG", 1);
            return Ok(None);
        };
        let Some(image) = self.image(index, is_srgb, memory, remarks)? else { return Ok(None) };
        let sampler = self.document.refer(&texture, "sampler", Table::Samplers)?;
        let (mut wrap, mut nearest) = ([TextureWrap::Repeat; 2], false);
        if let Some(sampler) = sampler {
            for (wrap, field) in wrap.iter_mut().zip(["wrapS", "wrapT"]) {
                *wrap = match sampler.whole(field)?.unwrap_or(10_497) {
                    33_071 => TextureWrap::Clamp,
                    33_648 => TextureWrap::Mirror,
                    code => {
                        let is_known = code == 10_497;
                        remarks.add_unread(&format!("the {field} {code}, which is none"), u64::from(!is_known));
                        TextureWrap::Repeat
                    }
                };
            }
            nearest = sampler.whole("magFilter")? == Some(NEAREST);
            let of_far = sampler.whole("minFilter")?;
            let is_used = of_far.is_none_or(|code| code == if nearest { NEAREST } else { LINEAR_MIPMAP_LINEAR });
            remarks.add_unread("minification filters", u64::from(!is_used));
        }
        let (uv_set, transform) = coordinates(&info)?;
        Ok(Some((ModelTexture { image, wrap, nearest, ..transform }, uv_set)))
    }

    fn image(
        &mut self,
        index: usize,
        is_srgb: bool,
        memory: &mut Memory,
        remarks: &mut Remarks,
    ) -> Result<Option<usize>, ModelError> {
        if let Some(known) = self.by_index.get(&(index, is_srgb)) {
            return Ok(*known);
        }
        let object = self.document.row(Table::Images, index)?;
        let source = match self.source(&object) {
            Ok(Found::Source(source)) => Some(source),
            Ok(Found::View(bytes)) => Some(ImageSource::Bytes(self.kept(&object, bytes, memory)?)),
            Err(error) => {
                remarks.add_unread(&format!("{}, which cannot be an image's", error.place), 1);
                None
            }
        };
        let image = source.map(|source| self.image_of(&object, source, is_srgb)).transpose()?;
        self.by_index.insert((index, is_srgb), image);
        Ok(image)
    }

    fn image_of(&mut self, object: &Object<'a>, source: ImageSource, is_srgb: bool) -> Result<usize, ModelError> {
        if let Some(known) = self.by_source.get(&(source.clone(), is_srgb)) {
            return Ok(*known);
        }
        let name = match (object.text("name")?, &source) {
            (None | Some(""), ImageSource::File(file)) => file.clone(),
            (name, _) => name.unwrap_or_default().into(),
        };
        self.by_source.insert((source.clone(), is_srgb), self.images.len());
        self.images.push(ModelImage { name, source, is_srgb });
        Ok(self.images.len() - 1)
    }

    /// The file or the data of an image, or else its bytes in a buffer.
    ///
    /// Errors: it has none of these.
    fn source(&self, object: &Object<'a>) -> Result<Found<'a>, ModelError> {
        if let Some(uri) = object.text("uri")? {
            return match data_of(uri) {
                None => Ok(Found::Source(ImageSource::File(file_name(uri).into()))),
                Some(Ok(bytes)) => Ok(Found::Source(ImageSource::Bytes(bytes.into()))),
                Some(Err(accepted)) => Err(object.refused("uri", shown(uri), accepted)),
            };
        }
        let view = self.document.refer(object, "bufferView", Table::Views)?;
        let Some(view) = view else {
            return Err(object.refused("uri", "missing", "an image has a uri or a bufferView"));
        };
        Ok(Found::View(self.buffers.view(self.document, &view)?))
    }

    /// A copy of an image's bytes, which is made once however many views there are of them.
    fn kept(&mut self, object: &Object<'a>, bytes: &[u8], memory: &mut Memory) -> Result<Arc<[u8]>, ModelError> {
        let place = (bytes.as_ptr().addr(), bytes.len());
        if let Some(known) = self.by_place.get(&place) {
            return Ok(known.clone());
        }
        let kept = match self.bytes.get(bytes) {
            Some(known) => known.clone(),
            None => {
                memory.take(bytes.len() as u64, 1, || [object.file.into(), object.path.clone()])?;
                let copy: Arc<[u8]> = bytes.into();
                self.bytes.insert(copy.clone());
                copy
            }
        };
        self.by_place.insert(place, kept.clone());
        Ok(kept)
    }
}

/// The set of texture coordinates that a reference to a texture uses, and how it changes them.
fn coordinates(info: &Object<'_>) -> Result<(u64, ModelTexture), ModelError> {
    let (set, plain) = (info.whole("texCoord")?.unwrap_or(0), ModelTexture::default());
    let Some(own) = info.extension(TEXTURE_TRANSFORM)? else { return Ok((set, plain)) };
    let changed = ModelTexture {
        offset: own.numbers("offset")?.unwrap_or(plain.offset),
        rotation: own.number("rotation")?.unwrap_or(plain.rotation),
        scale: own.numbers("scale")?.unwrap_or(plain.scale),
        ..plain
    };
    Ok((own.whole("texCoord")?.unwrap_or(set), changed))
}

#[cfg(test)]
mod tests {
    use crate::written::{data, mesh, read};
    use crate::{ImageSource, TextureWrap};

    #[test]
    fn images_are_there_once() {
        let images = "'images':[{'uri':'a%20b.png'},{'uri':'./a b.png'}],'textures':[{'source':0},{'source':1}]";
        let material = "'pbrMetallicRoughness':{'baseColorTexture':{'index':0}},'emissiveTexture':{'index':1}";
        let file = format!("{},{images},'materials':[{{{material}}}]", mesh("{'attributes':{'POSITION':0}}"));
        let model = read(&file).expect("read");
        assert_eq!(model.images.len(), 1);
        let uri = data(b"\x89PNG");
        let embedded = format!(
            "'images':[{{'uri':'{uri}'}}],'textures':[{{'source':0}}],'materials':[{{'emissiveTexture':{{'index':0}}}}]"
        );
        let images = read(&embedded).expect("read").images;
        assert_eq!(images[0].source, ImageSource::Bytes(b"\x89PNG"[..].into()));
    }

    /// The material with its factors, and a sentence.
    #[test]
    fn what_is_merely_odd_is_read_and_said() {
        let said = |fields: &str| {
            let model = read(fields).expect("read");
            assert_eq!(model.materials.len(), 1);
            (model.materials[0].normal_texture, model.remarks.sentences().join(" "))
        };
        let with = |images: &str, more: &str| {
            said(&format!(
                "'images':[{{{images}}}],'textures':[{{'source':0{more}}}],\
                 'materials':[{{'normalTexture':{{'index':0}},'alphaMode':'GLASS'}}],'bufferViews':[{{}}]"
            ))
        };
        let mode = "the alphaMode \"GLASS\", which is none (1).";
        for (images, place) in
            [("", "images[0].uri"), ("'bufferView':0", "bufferViews[0].buffer"), ("'uri':'data:x'", "images[0].uri")]
        {
            let (texture, sentence) = with(images, "");
            assert_eq!(texture, None, "{images}");
            assert_eq!(sentence, format!("Not read: {place}, which cannot be an image's (1), {mode}"));
        }
        let odd = "'uri':'x'}],'samplers':[{'wrapS':1,'minFilter':9729}],'images':[{'uri':'x'";
        let (texture, sentence) = with(odd, ",'sampler':0");
        assert_eq!(texture.map(|texture| texture.wrap), Some([TextureWrap::Repeat; 2]));
        let unread = "Not read: the wrapS 1, which is none (1), minification filters (1), ";
        assert_eq!(sentence, format!("{unread}{mode}"));
    }

    #[test]
    fn the_same_bytes_are_one_image_however_many_views_there_are() {
        let views: Vec<String> = (0..24).map(|_| "{'buffer':0,'byteLength':8}".into()).collect();
        let images: Vec<String> = (0..24).map(|view| format!("{{'bufferView':{view}}}")).collect();
        let textures: Vec<String> = (0..24).map(|image| format!("{{'source':{image}}}")).collect();
        let materials: Vec<String> =
            (0..24).map(|texture| format!("{{'emissiveTexture':{{'index':{texture}}}}}")).collect();
        let model = read(&format!(
            "'buffers':[{{'uri':'{}','byteLength':8}}],'bufferViews':[{}],'images':[{}],'textures':[{}],'materials':[{}]",
            data(b"\x89PNG\r\n\x1a\n"),
            views.join(","),
            images.join(","),
            textures.join(","),
            materials.join(",")
        ));
        assert_eq!(model.expect("read").images.len(), 1);
    }
}
