//! Files that are valid but odd, or not quite valid: what must be read of them, and which sentence must be said.

use glam::DVec3;
use pinhole::models::{AlphaMode, Model, read_model};
use proptest::prelude::*;

/// A file, the files beside it, what the model must hold, and a part of what must be said; nothing if nothing may be.
struct Odd {
    what: &'static str,
    name: &'static str,
    text: String,
    beside: &'static [(&'static str, &'static str)],
    holds: fn(&Model) -> bool,
    said: &'static [&'static str],
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const PLAIN: &str = "vn 0 0 1\nf 1//1 2//1 3//1 4//1\n";
const PLY_SQUARE: &str = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

fn ply(comments: &str, vertex: &str, rows: &str, faces: &str) -> String {
    let xyz = "property float x\nproperty float y\nproperty float z";
    format!(
        "ply\nformat ascii 1.0\n{comments}element vertex {}\n{xyz}\n{vertex}element face {}\nproperty list uchar int \
         vertex_indices\nend_header\n{rows}{faces}",
        rows.lines().count(),
        faces.lines().count(),
    )
}

fn read(name: &str, bytes: &[u8], beside: &[(&str, &str)]) -> Result<Model, String> {
    let open = |other: &str| {
        let found = beside.iter().find(|(own, _)| *own == other);
        found.map(|(_, text)| text.as_bytes().to_vec()).ok_or_else(|| "there is none".to_owned())
    };
    read_model(name, bytes, &open).map_err(|error| error.to_string())
}

/// The area of all triangles in the world.
fn area(model: &Model) -> f64 {
    let of = |instance: &pinhole::models::Instance| {
        let mesh = &model.meshes[instance.mesh];
        let triangle = |own: &[u32; 3]| {
            let [a, b, c] = own.map(|at| {
                let at = DVec3::from(mesh.positions[at as usize].map(f64::from));
                instance.world_from_object.transform_point3(at)
            });
            0.5 * (b - a).cross(c - a).length()
        };
        mesh.triangles.iter().map(triangle).sum::<f64>()
    };
    model.instances.iter().map(of).sum()
}

fn is_square(model: &Model) -> bool {
    (area(model) - 1.0).abs() < 1e-9
}

fn cases() -> Vec<Odd> {
    let obj =
        |what, text: &str, beside, holds, said| Odd { what, name: "a.obj", text: text.into(), beside, holds, said };
    let of_ply = |what, text: String, holds, said| Odd { what, name: "a.ply", text, beside: &[], holds, said };
    let mut all = vec![
        obj("a mark of the byte order", &format!("\u{feff}{SQUARE}{PLAIN}"), &[], is_square, &[]),
        obj("a comment with a backslash", &format!("# C:\\models\\\n{SQUARE}# \\\n{PLAIN}"), &[], is_square, &[]),
        obj("an absent normal", &format!("{SQUARE}f 1//1 2//1 3//1 4//1"), &[], is_square, &["go without"]),
        obj(
            "an absent texture coordinate",
            &format!("{SQUARE}vn 0 0 1\nf 1/1/1 2/2/1 3//1 4//1"),
            &[],
            is_square,
            &["2 corners have a texture coordinate"],
        ),
        obj("a vertex that comes later", &format!("vn 0 0 1\nf 1//1 2//1 3//1 4//1\n{SQUARE}"), &[], is_square, &[]),
        obj(
            "a vertex that never comes",
            &format!("{SQUARE}{PLAIN}f 1 2 9\nf 0 1 2"),
            &[],
            is_square,
            &["2 faces with a vertex"],
        ),
        obj(
            "a concave quadrilateral",
            "v 0 0 0\nv 4 4 0\nv 0 1 0\nv -4 4 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1",
            &[],
            |model| (area(model) - 4.0).abs() < 1e-6,
            &[],
        ),
        obj(
            "a quadrilateral that crosses itself",
            "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1",
            &[],
            |model| model.meshes[0].triangles.len() == 2,
            &["crosses itself"],
        ),
        obj(
            "numbers that are none",
            &format!("{SQUARE}v -nan(ind) 1.#QNAN 1.#INF\n{PLAIN}f 1 2 5"),
            &[],
            is_square,
            &["not a number"],
        ),
        obj(
            "points and lines only",
            "v 0 0 0\nv 1 0 0\np 1\nl 1 2",
            &[],
            |model| model.instances.is_empty(),
            &["`p` (1), `l` (1)"],
        ),
        obj(
            "colours of vertices",
            &format!("{}{PLAIN}", SQUARE.replace(" 0\n", " 0 1 0.5 0\n")),
            &[],
            |model| {
                is_square(model)
                    && model.meshes[0]
                        .colours
                        .as_ref()
                        .is_some_and(|own| own[0][0] == 1.0 && (own[0][1] - 0.2140).abs() < 1e-4)
                    && model.instances[0].material.is_some()
            },
            &[],
        ),
        obj(
            "colours of vertices that are no colours",
            &format!("v 0 0 0 nan 0 0\nv 1 0 0 1.5 -1 inf\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\n{PLAIN}"),
            &[],
            |model| {
                is_square(model)
                    && model.meshes[0]
                        .colours
                        .as_ref()
                        .is_some_and(|own| own[..2] == [[0.0; 3], [1.0, 0.0, 1.0]] && own[3] == [1.0; 3])
            },
            &["1 vertex has a colour with a part that is not a number", "1 vertex has a colour with a part below 0"],
        ),
        obj(
            "colours of vertices as bytes",
            &format!("{}{PLAIN}", SQUARE.replace(" 0\n", " 0 200 100 0\n")),
            &[],
            |model| is_square(model) && model.meshes[0].colours.as_ref().is_some_and(|own| own[0] == [1.0, 1.0, 0.0]),
            &["4 vertices have a colour with a part below 0 or above 1", "go up to 200, as if they were bytes"],
        ),
        obj(
            "faces with normals and faces with texture coordinates",
            &format!("mtllib b.mtl\nusemtl m\n{SQUARE}vt 0 0\nvn 0 0 1\nvn 0 0 0\nf 1/1 2/1 3/1\nf 1//1 3//1 4//2"),
            &[("b.mtl", "newmtl m\nmap_Kd a.png\n")],
            is_square,
            &[
                "1 vertex normal has no direction",
                "3 vertices have no normal, as others of their mesh have",
                "3 vertices have no texture coordinate, as others of their mesh have",
            ],
        ),
        obj(
            "a missing library",
            &format!("mtllib b.mtl\n{SQUARE}{PLAIN}"),
            &[],
            is_square,
            &["the library \"b.mtl\", since there is none"],
        ),
        obj(
            "Kd spectral and Ns nan",
            &format!("mtllib b.mtl\nusemtl m\n{SQUARE}{PLAIN}"),
            &[("b.mtl", "newmtl m\nKd spectral a.rfl\nNs nan\nKe 2 0 0\n")],
            |model| is_square(model) && model.materials[0].emission == [2.0, 0.0, 0.0],
            &["`Kd` on line 2 of \"b.mtl\"", "`Ns` on line 3"],
        ),
        obj(
            "a transparent material",
            &format!("mtllib b.mtl\nusemtl m\n{SQUARE}{PLAIN}"),
            &[("b.mtl", "newmtl m\nTr 0.75\n")],
            |model| model.materials[0].alpha == 0.25 && model.materials[0].alpha_mode == AlphaMode::Blend,
            // What the renderer makes of it is said where it makes it.
            &[],
        ),
        obj(
            "scaled and shifted",
            &format!("mtllib b.mtl\nusemtl m\nvt 0 0\n{SQUARE}vn 0 0 1\nf 1/1/1 2/1/1 3/1/1 4/1/1"),
            &[("b.mtl", "newmtl m\nmap_Kd -s 4 4 1 -o 0.5 -mm 0 2 a.png\n")],
            |model| {
                model.materials[0]
                    .base_colour_texture
                    .is_some_and(|own| own.scale == [4.0, 4.0] && own.offset == [0.5, -3.0])
            },
            &["the option `-mm` of a map"],
        ),
        of_ply(
            "more values than properties",
            ply("", "", "0 0 0 7\n1 0 0 7 7\n1 1 0\n0 1 0 8\n", "4 0 1 2 3 255 0 0\n"),
            is_square,
            &["4 rows have more values"],
        ),
        of_ply(
            "a mark of the byte order",
            format!("\u{feff}{}", ply("", "", PLY_SQUARE, "4 0 1 2 3\n")),
            is_square,
            &["no vertex normals"],
        ),
        of_ply(
            "a vertex that no face uses",
            ply("", "", &format!("{PLY_SQUARE}1e9 1e9 1e9\n"), "4 0 1 2 3\n"),
            |model| is_square(model) && model.meshes[0].positions.len() == 4,
            &["1 vertex that no triangle uses"],
        ),
        of_ply(
            "a concave face",
            ply("", "", "0 0 0\n4 4 0\n0 1 0\n-4 4 0\n", "4 0 1 2 3\n"),
            |model| (area(model) - 4.0).abs() < 1e-6,
            &["no vertex normals"],
        ),
        of_ply(
            "points without faces",
            ply("", "", PLY_SQUARE, "").replace("element face 0\nproperty list uchar int vertex_indices\n", ""),
            |model| model.instances.is_empty(),
            &["points without faces (4)"],
        ),
        of_ply(
            "colours of vertices as bytes in floats",
            ply(
                "",
                "property float red\nproperty float green\nproperty float blue\n",
                &PLY_SQUARE.replace(" 0\n", " 0 250 100 nan\n"),
                "4 0 1 2 3\n",
            ),
            |model| is_square(model) && model.meshes[0].colours.as_ref().is_some_and(|own| own[0] == [1.0, 1.0, 0.0]),
            &["4 vertices have a colour with a part that is not a number", "go up to 250, as if they were bytes"],
        ),
        of_ply(
            "colours of vertices",
            ply(
                "",
                "property uchar red\nproperty uchar green\nproperty uchar blue\n",
                &PLY_SQUARE.replace(" 0\n", " 0 255 0 0\n"),
                "4 0 1 2 3\n",
            ),
            |model| {
                is_square(model)
                    && model.meshes[0].colours.as_ref().is_some_and(|own| own[0] == [1.0, 0.0, 0.0])
                    && model.materials[0].base_colour == [1.0; 3]
            },
            &["no vertex normals"],
        ),
        of_ply(
            "a TextureFile",
            ply(
                "comment TextureFile a b.png\n",
                "property float s\nproperty float t\n",
                &PLY_SQUARE.replace(" 0\n", " 0 0.25 0.25\n"),
                "4 0 1 2 3\n",
            ),
            |model| {
                model.materials[0].base_colour_texture.is_some()
                    && &*model.images[0].name == "a b.png"
                    && model.meshes[0].uvs.as_ref().is_some_and(|own| own[0] == [0.25, 0.75])
            },
            &["no vertex normals"],
        ),
    ];
    // A grid of 0.25 m at UTM coordinates.
    let utm: String = (0..4)
        .map(|own| {
            format!(
                "v {} {} 12.5\n",
                499_000.25 + 0.25 * f64::from([0, 1, 1, 0][own]),
                5_349_000.75 + 0.25 * f64::from(own as u32 / 2)
            )
        })
        .collect();
    let small: fn(&Model) -> bool = |model| (area(model) - 0.0625).abs() < 1e-9;
    all.push(obj("UTM coordinates", &format!("{utm}{PLAIN}"), &[], small, &[]));
    let rows = utm.replace("v ", "");
    all.push(of_ply("UTM coordinates", ply("", "", &rows, "4 0 1 2 3\n"), small, &["no vertex normals"]));
    let wedges = ply(
        "comment TextureFile a.png\ncomment TextureFile b.png\n",
        "",
        PLY_SQUARE,
        "3 0 1 2 6 0 0 1 0 1 1 0\n3 0 2 3 6 0 0 1 1 0 1 1\n",
    )
    .replace("vertex_indices\n", "vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\n");
    all.push(of_ply(
        "texture coordinates of corners, two images",
        wedges,
        |model| {
            is_square(model)
                && model.images.len() == 2
                && model.meshes[1].uvs.as_ref().is_some_and(|own| own[2] == [0.0, 0.0])
        },
        &["no vertex normals"],
    ));
    let strips = ply("", "", PLY_SQUARE, "").replace(
        "element face 0\nproperty list uchar int vertex_indices",
        "element tristrips 1\nproperty list int int vertex_indices",
    ) + "8 0 1 3 2 -1 0 1 3\n";
    all.push(of_ply(
        "strips of triangles",
        strips,
        |model| model.meshes[0].triangles == [[0, 1, 3], [3, 1, 2], [0, 1, 3]],
        &["no vertex normals"],
    ));
    all
}

#[test]
fn what_is_merely_odd_is_read_and_said() {
    let _alone = super::ALONE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let mut failed = Vec::new();
    for Odd { what, name, text, beside, holds, said } in cases() {
        let found = match read(name, text.as_bytes(), beside) {
            Err(sentence) => format!("refused: {sentence}"),
            Ok(model) => {
                let sentences = model.remarks.sentences().join(" ");
                let all_said = said.iter().all(|part| sentences.contains(part));
                let is_silent = !said.is_empty() || sentences.is_empty();
                if holds(&model) && all_said && is_silent {
                    continue;
                } else {
                    format!("{sentences} {:?}", model.meshes)
                }
            }
        };
        failed.push(format!("{name}, {what}: {found}"));
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// What does not change what a text says: the mark of the byte order, the ends of lines, spaces at their ends, comments,
/// and what stands behind the values of a row.
fn dressed(text: &str, comment: &str, [mark, spaces, comments, extra]: [bool; 4], end: &str, header: usize) -> String {
    let mut lines = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let is_row = number >= header && !line.is_empty();
        let tail = if extra && is_row && line.starts_with(|first: char| first.is_ascii_digit() || first == 'v') {
            " 7"
        } else {
            ""
        };
        lines.push(format!("{line}{tail}{}", if spaces { "  \t" } else { "" }));
        if comments && (header == 0 || number > 1 && number + 1 < header) {
            lines.push(format!("{comment} C:\\a\\"));
        }
    }
    format!("{}{}{end}", if mark { "\u{feff}" } else { "" }, lines.join(end))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// Only what is behind the values of a row of a PLY is said.
    #[test]
    fn a_text_reads_the_same_however_it_is_dressed(flags in any::<[bool; 4]>(), end in 0..3_usize) {
        let _alone = super::ALONE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let end = ["\n", "\r\n", "\r"][end];
        let obj = format!("mtllib b.mtl\n{SQUARE}vn 0 0 1\nusemtl m\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n");
        let mtl = "newmtl m\nKd 1 0 0\nmap_Kd -s 2 2 2 a.png\n";
        let plain = read("a.obj", obj.as_bytes(), &[("b.mtl", mtl)]).expect("read");
        let library = dressed(mtl, "#", [flags[0], flags[1], flags[2], false], end, 0);
        let odd = dressed(&obj, "#", flags, end, 0);
        let found = read("a.obj", odd.as_bytes(), &[("b.mtl", &library)]);
        prop_assert_eq!(found.as_ref(), Ok(&plain), "{:?}", odd);

        let ply = ply("", "property float nx\nproperty float ny\nproperty float nz\n", &PLY_SQUARE.replace(" 0\n", " 0 0 0 1\n"), "4 0 1 2 3\n");
        let header = ply.lines().position(|line| line == "end_header").expect("a header") + 1;
        let plain = read("a.ply", ply.as_bytes(), &[]).expect("read");
        let odd = dressed(&ply, "comment", flags, end, header);
        let mut found = read("a.ply", odd.as_bytes(), &[]).map_err(|error| TestCaseError::fail(format!("{error}: {odd:?}")))?;
        prop_assert_eq!(found.remarks.extra_values, if flags[3] { 5 } else { 0 }, "{:?}", odd);
        found.remarks.extra_values = 0;
        prop_assert_eq!(found, plain, "{:?}", odd);
    }
}
