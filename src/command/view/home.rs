//! Where a scene on the page is saved: nothing is replaced but what it is known to hold.

use crate::command::chapter_text::Held;
use crate::command::export_images::{OTHERS, place_beside};
use pinhole::Error;
use pinhole::film::{Replaces, write_whole};
use pinhole::models::glb_of;
use pinhole::scene::{IMAGE_FILE, MODEL_FILE, printable_path};
use std::cell::RefCell;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Where the scene of a chapter or of a model is saved.
const FOLDER: &str = "out";
/// The most scenes of one name that are saved there.
const MAX: u32 = 1000;

/// What stays the same while the text is edited.
pub struct Home {
    file: RefCell<PathBuf>,
    /// What the file is known to hold; none before it is there.
    saved: RefCell<Option<Vec<u8>>>,
    /// The name of the file without a number; none where the reader has named a file.
    stem: Option<String>,
    /// Whether its lines end in CR LF; a page knows LF alone.
    has_cr: bool,
    /// What the text names and only the program holds.
    pub held: Held,
}

impl Home {
    /// That of a file that was opened.
    pub fn of_file(file: PathBuf, text: &str) -> Self {
        let saved = RefCell::new(Some(text.as_bytes().to_vec()));
        let has_cr = text.contains("\r\n") && !text.replace("\r\n", "").contains(['\r', '\n']);
        Self { file: RefCell::new(file), saved, stem: None, has_cr, held: Held::default() }
    }

    /// That of a scene that has no file yet.
    pub fn free(file: PathBuf, stem: String, held: Held) -> Self {
        Self { file: RefCell::new(file), saved: RefCell::default(), stem: Some(stem), has_cr: false, held }
    }

    /// Where it is saved.
    pub fn file(&self) -> PathBuf {
        self.file.borrow().clone()
    }

    /// A text as the page has it.
    pub fn on_page(&self, text: &str) -> String {
        if self.has_cr { text.replace("\r\n", "\n") } else { text.into() }
    }

    /// Writes a text and what it names; says where, and the text with the names that it has there.
    ///
    /// Errors: the file was changed by another program, or something cannot be written; what was there is unchanged.
    pub fn save(&self, text: &str) -> Result<(PathBuf, String), String> {
        let mut text = text.to_owned();
        self.save_beside(&mut text)?;
        let bytes = if self.has_cr { text.replace('\n', "\r\n") } else { text.clone() }.into_bytes();
        let known = self.saved.borrow().clone();
        let write = |file: &Path| {
            let replaces = known.as_deref().map_or(Replaces::Nothing, Replaces::Bytes);
            write_whole(replaces.at(file), |out| out.write_all(&bytes))
        };
        let mut file = self.file();
        let mut written = write(&file);
        // Another viewer of the same chapter has saved first.
        if let (None, Some(stem)) = (&known, &self.stem) {
            for number in 2..=MAX {
                if !written.as_ref().is_err_and(is_taken) {
                    break;
                }
                file = numbered(stem, number);
                written = write(&file);
            }
        }
        written.map_err(|error| error.to_string())?;
        self.saved.replace(Some(bytes));
        self.file.replace(file.clone());
        Ok((file, text))
    }

    /// Writes what the text names and no file holds, and puts the names into the text that they have there.
    fn save_beside(&self, text: &mut String) -> Result<(), String> {
        let file = self.file();
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let meshes =
            self.held.meshes.iter().map(|mesh| (&mesh.file, MODEL_FILE, glb_of(&mesh.geometry).map(Arc::<[u8]>::from)));
        let files = self.held.files.iter().map(|(name, bytes)| (name, IMAGE_FILE, Some(Arc::clone(bytes))));
        for (name, kind, bytes) in meshes.chain(files) {
            if !text.contains(&quoted(name)) {
                continue;
            }
            let refused = |why: &str| format!("{} cannot be written: {why}", printable_path(&folder.join(name)));
            let bytes = bytes.ok_or_else(|| refused("it has more than 4 GiB"))?;
            let (free, is_new) = place_beside(folder, Path::new(name), &bytes, kind).ok_or_else(|| refused(OTHERS))?;
            if is_new {
                let place = folder.join(&free);
                write_whole(Replaces::Nothing.at(&place), |file| file.write_all(&bytes))
                    .map_err(|error| error.to_string())?;
            }
            if free != *name {
                *text = text.replace(&quoted(name), &quoted(&free));
            }
        }
        Ok(())
    }
}

/// A name as the text of a scene has it.
fn quoted(name: &str) -> String {
    format!("\"{}\"", name.chars().flat_map(char::escape_debug).collect::<String>())
}

fn is_taken(error: &Error) -> bool {
    matches!(error, Error::Write { source, .. } if source.kind() == ErrorKind::AlreadyExists)
}

fn numbered(stem: &str, number: u32) -> PathBuf {
    let name = if number == 1 { format!("{stem}.ron") } else { format!("{stem}-{number}.ron") };
    Path::new(FOLDER).join(name)
}

/// The first name that no file has.
pub fn free_file(stem: &str) -> PathBuf {
    let is_free = |file: &PathBuf| file.symlink_metadata().is_err_and(|why| why.kind() == ErrorKind::NotFound);
    (1..MAX).map(|number| numbered(stem, number)).find(is_free).unwrap_or_else(|| numbered(stem, MAX))
}
