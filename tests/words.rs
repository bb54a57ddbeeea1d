//! pinhole speaks the language of its field: no private word stands in sources, chapters, tests or book.

use std::fs;
use std::path::Path;

const FOLDERS: [&str; 6] = ["src", "chapters", "tests", "book/src", "book/builder", "README.md"];
const ENDINGS: [&str; 6] = ["rs", "md", "snap", "txt", "json", "ron"];
/// This file, which has to name them.
const EXEMPT: &str = "tests/words.rs";

/// Words and phrases that no idiom of English needs, and what the field says.
#[rustfmt::skip]
const RULES: [(&[&str], &str); 21] = [
    (&["chance", "chances"], "probability; BSDF sampling; at random"),
    (&["how likely", "as likely as", "as likely anywhere"], "pdf, probability"),
    (&["by lot"], "at random"),
    (&["all alike", "dense as", "as dense", "were dense"], "uniform, cosine-weighted, pdf"),
    (&["aim at lights", "aim at a light", "aim at the light", "aimed at lights", "aimed at a light", "aimed at the light",
       "light aimed", "aimed light", "aim at the sky"], "sample a light (next-event estimation), light sampling"),
    (&["weigh", "weighs", "weighed", "weighing"], "weight (verb), weighted; MIS"),
    (&["kit", "kits"], "pinhole, the renderer"),
    (&["ours"], "pinhole's"),
    (&["facet", "facets", "tiny mirror", "tiny mirrors"], "microfacet; a mesh has faces, triangles"),
    (&["glint", "glints"], "BSDF sample, microfacet sample"),
    (&["polished"], "specular"),
    (&["squarely"], "at normal incidence"),
    (&["flat angle", "flat angles", "flat incidence"], "grazing incidence"),
    (&["half ball", "half balls", "half sphere", "half spheres"], "hemisphere"),
    (&["stranger", "strangers"], "independent"),
    (&["verdict", "verdicts"], "intersection; result"),
    (&["doubtful"], "uncertain"),
    (&["judge", "judges", "judged", "judging", "judgement"], "oracle; check, compare"),
    (&["plant", "plants", "planted", "planting"], "mutation, mutate"),
    (&["flat shape", "flat shapes", "flat piece", "flat light", "flat lights", "flat surface", "flat surfaces",
       "flat colour", "flat colours", "looks flat", "shade flat"], "planar; unlit"),
    (&["swings across", "swings within", "swing across", "swing within"], "s-polarised, p-polarised"),
];

/// A text's words in small letters with single spaces between them, names split at `_` and at capitals.
fn normal(text: &str) -> String {
    let (mut normal, mut before) = (String::from(" "), ' ');
    for letter in text.chars() {
        if letter.is_ascii_alphabetic() {
            if letter.is_ascii_uppercase() && before.is_ascii_lowercase() {
                normal.push(' ');
            }
            normal.push(letter.to_ascii_lowercase());
        } else if !normal.ends_with(' ') {
            normal.push(' ');
        }
        before = letter;
    }
    normal + " "
}

/// The private words of a text, and what the field says.
fn private(text: &str) -> Vec<(&'static str, &'static str)> {
    let text = normal(text);
    let rules = RULES.iter().flat_map(|(forms, term)| forms.iter().map(move |form| (*form, *term)));
    rules.filter(|(form, _)| text.contains(&format!(" {form} "))).collect()
}

/// The files below a folder, or the file itself.
fn files(root: &Path, path: &Path, found: &mut Vec<String>) {
    if path.is_dir() {
        for entry in fs::read_dir(path).expect("a readable folder") {
            files(root, &entry.expect("a readable entry").path(), found);
        }
    } else if path.extension().is_some_and(|ending| ENDINGS.iter().any(|known| ending == *known)) {
        let path = path.strip_prefix(root).expect("below the root");
        found.push(path.to_string_lossy().replace('\\', "/"));
    }
}

#[test]
fn no_private_word_stands_anywhere() {
    let (root, mut paths) = (Path::new(env!("CARGO_MANIFEST_DIR")), Vec::new());
    FOLDERS.iter().for_each(|folder| files(root, &root.join(folder), &mut paths));
    paths.retain(|path| path != EXEMPT);
    let read = |path: &String| fs::read_to_string(root.join(path)).expect("readable text");
    let told = paths.iter().flat_map(|path| private(&read(path)).into_iter().map(move |word| (path, word)));
    let told: Vec<String> = told.map(|(path, (word, term))| format!("{path}: {word} → {term}")).collect();
    assert!(paths.len() > 500, "only {} files were read", paths.len());
    assert!(told.is_empty(), "private words, and the field's terms:\n{}", told.join("\n"));
}

#[test]
fn a_private_word_is_known_in_prose_and_in_names() {
    for text in ["found by\n/// chance", "the kit's own", "struct HalfSphere;", "fn half_ball()", "tiny\nmirrors"] {
        assert!(!private(text).is_empty(), "{text}");
    }
    for text in ["a microfacet", "a kitchen", "perchance", "ahalf ballot", "no glinting"] {
        assert_eq!(private(text), [], "{text}");
    }
}
