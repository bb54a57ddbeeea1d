use super::mtl::{MtlImages, read_mtl};
use crate::memory::Memory;
use crate::model::Model;
use crate::model_error::{ModelError, shown};
use crate::model_material::{ModelImage, ModelMaterial};
use crate::open::Open;
use std::collections::{HashMap, HashSet};
use std::hash::{DefaultHasher, Hasher};
use std::sync::Arc;

/// The material libraries read so far.
pub struct Libraries {
    memory: Memory,
    images: MtlImages,
    /// The names of those that were asked for, however they are spelt.
    asked: HashSet<String>,
    /// The length and the hash of what was read: another name of the same file adds nothing.
    known: HashSet<(usize, u64)>,
    /// The index of each material.
    by_name: HashMap<Arc<str>, usize>,
}

impl Libraries {
    /// None yet, of a file.
    pub fn of(file: &[u8]) -> Self {
        let (images, asked, known, by_name) = Default::default();
        Self { memory: Memory::of(file), images, asked, known, by_name }
    }

    /// The index of the material of this name among those of the model.
    pub fn index_of(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).copied()
    }

    /// The images that they name.
    pub fn into_images(self) -> Vec<ModelImage> {
        self.images.images
    }

    /// Reads the library of a line, if it was not read before: a name may have spaces, and a line several names.
    ///
    /// Errors: more materials than the files may describe.
    pub fn read(&mut self, names: &str, open: Open<'_>, model: &mut Model) -> Result<(), ModelError> {
        let names = unquoted(names);
        if names.is_empty() || !self.asked.insert(as_one_spells(names)) {
            return Ok(());
        }
        match open(names) {
            Ok(bytes) => self.add(names, &bytes, model),
            Err(_) if names.contains(char::is_whitespace) => {
                for name in names.split_whitespace().map(unquoted) {
                    if self.asked.insert(as_one_spells(name)) {
                        match open(name) {
                            Ok(bytes) => self.add(name, &bytes, model)?,
                            Err(problem) => missing_library(name, &problem, model),
                        }
                    }
                }
                Ok(())
            }
            Err(problem) => {
                missing_library(names, &problem, model);
                Ok(())
            }
        }
    }

    fn add(&mut self, name: &str, bytes: &[u8], model: &mut Model) -> Result<(), ModelError> {
        let mut hasher = DefaultHasher::new();
        hasher.write(bytes);
        if !self.known.insert((bytes.len(), hasher.finish())) {
            return Ok(());
        }
        self.memory.add_file(bytes);
        for material in read_mtl(name, bytes, &mut self.images, &mut self.memory, &mut model.remarks)? {
            let ModelMaterial { name, .. } = &material;
            self.by_name.insert(name.clone(), model.materials.len());
            model.materials.push(material);
        }
        Ok(())
    }
}

/// A name without quotation marks about it.
pub fn unquoted(name: &str) -> &str {
    let name = name.trim();
    name.strip_prefix('"').and_then(|name| name.strip_suffix('"')).unwrap_or(name)
}

/// The one spelling of a path: `a/./b`, `a//b`, `c/../a/b` and `a\\b` are `a/b`.
fn as_one_spells(name: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for (number, part) in name.split(['/', '\\']).enumerate() {
        match part {
            "" if number > 0 => {}
            "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => _ = parts.pop(),
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

fn missing_library(name: &str, problem: &str, model: &mut Model) {
    model.remarks.add_unread(&format!("the library {}, since {problem}", shown(name)), 1);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn a_library_is_read_once_however_it_is_spelt() {
        let opened = Cell::new(0);
        let open = |name: &str| {
            opened.set(opened.get() + 1);
            if name.contains("none") { Err("there is none".to_owned()) } else { Ok(b"newmtl a\nmap_Kd a.png".to_vec()) }
        };
        let (mut libraries, mut model) = (Libraries::of(b""), Model::default());
        for name in ["a.mtl", "./a.mtl", ".//a.mtl", "b/../a.mtl", ".\\a.mtl", "\"a.mtl\"", "b/./c/../../a.mtl"] {
            libraries.read(name, &open, &mut model).expect("read");
        }
        assert_eq!((opened.get(), model.materials.len()), (1, 1));
        // Another name of what is the same, such as a link.
        libraries.read("link.mtl", &open, &mut model).expect("read");
        assert_eq!((opened.get(), model.materials.len()), (2, 1));
        libraries.read("none.mtl \"c.mtl\" ./none.mtl", &open, &mut model).expect("read");
        assert_eq!((opened.get(), model.remarks.unread.len()), (5, 1));
        assert_eq!(["../a", "a/..", "/a/b", "../../x"].map(as_one_spells), ["../a", "", "/a/b", "../../x"]);
    }
}
