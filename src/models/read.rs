use crate::gltf;
use crate::model::{Model, Moment};
use crate::model_error::ModelError;
use crate::model_error::shown_bytes;
use crate::number::without_mark;
use crate::obj;
use crate::open::Open;
use crate::ply;

/// Reads a model file: .gltf, .glb, .obj or .ply.
///
/// `open` returns the bytes of the files it names, buffers and materials; their names are those of the model file,
/// glTF's with their percent signs decoded, and whether to follow one that leads upward is for `open` to decide.
/// Images are named or passed on, not decoded.
///
/// Errors: one sentence, with the file, the place in it, the value, and what would be accepted.
///
/// ```
/// let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
/// let model = pinhole_models::read_model("one.obj", text.as_bytes(), &|_| Err("there is none".into()))?;
/// assert_eq!(model.meshes[0].triangles, [[0, 1, 2]]);
/// # Ok::<(), pinhole_models::ModelError>(())
/// ```
pub fn read_model(name: &str, bytes: &[u8], open: Open<'_>) -> Result<Model, ModelError> {
    read_model_at(name, bytes, None, open)
}

/// Reads a model file at rest, or at a moment of its animations, which glTF files alone may have.
///
/// Errors: those of [`read_model`], and animations that are not as the format demands.
pub fn read_model_at(
    name: &str,
    bytes: &[u8],
    moment: Option<Moment<'_>>,
    open: Open<'_>,
) -> Result<Model, ModelError> {
    let file_name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let ending = file_name.rsplit_once('.').map_or(String::new(), |(_, ending)| ending.to_ascii_lowercase());
    let refused = |accepted: &str| {
        let start = &bytes[..bytes.len().min(16)];
        Err(ModelError::new(name, "the start of the file", shown_bytes(start), accepted))
    };
    let text = without_mark(bytes);
    match ending.as_str() {
        "ply" if !text.starts_with(b"ply") => refused("a .ply file begins with \"ply\""),
        "ply" => ply::read_ply(name, text),
        "glb" if !bytes.starts_with(b"glTF") => refused("a .glb file begins with \"glTF\""),
        "gltf" if bytes.starts_with(b"glTF") => refused("a .gltf file is JSON; name it .glb if it is binary"),
        "glb" | "gltf" => gltf::read_gltf(name, bytes, moment, open),
        "obj" if bytes.starts_with(b"glTF") || bytes.contains(&0) => refused("an .obj file is text"),
        "obj" => obj::read_obj(name, text, open),
        _ => {
            let shown = crate::model_error::shown(&ending);
            Err(ModelError::new(name, "the file name's ending", shown, "a model is a .gltf, .glb, .obj or .ply file"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_what_its_name_and_its_first_bytes_say() {
        let refused = |name: &str, bytes: &[u8]| {
            let none = |_: &str| Err("there is none".to_owned());
            read_model(name, bytes, &none).expect_err(name).to_string()
        };
        assert_eq!(
            refused("a/ball.stl", b"solid"),
            "a/ball.stl: the file name's ending is \"stl\", but a model is a .gltf, .glb, .obj or .ply file"
        );
        assert_eq!(
            refused("ball", b"ply"),
            "ball: the file name's ending is \"\", but a model is a .gltf, .glb, .obj or .ply file"
        );
        assert_eq!(
            refused("ball.PLY", b"{}"),
            "ball.PLY: the start of the file is \"{}\", but a .ply file begins with \"ply\""
        );
        assert_eq!(
            refused("ball.glb", b"{}"),
            "ball.glb: the start of the file is \"{}\", but a .glb file begins with \"glTF\""
        );
        assert_eq!(
            refused("ball.gltf", b"glTF\x02"),
            "ball.gltf: the start of the file is \"glTF\\u{2}\", but a .gltf file is JSON; name it .glb if it is binary"
        );
        assert_eq!(
            refused("ball.obj", b"v 0 0\0"),
            "ball.obj: the start of the file is \"v 0 0\\u{0}\", but an .obj file is text"
        );
    }
}
