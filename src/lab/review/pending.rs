use super::snapshots::{read_file, snapshot_folder};
use pinhole::film::write_whole;
use pinhole::{Error, Result};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A chapter whose snapshots wait to be kept or thrown away.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pending {
    /// The chapter's stem.
    pub chapter: String,
    /// The folder of its snapshots.
    pub folder: PathBuf,
    /// The files that wait, without `.new`: `probes.snap`, `image.snap`; ascending.
    pub files: Vec<String>,
}

/// What a file that waits holds, ready to be kept.
struct Waiting {
    /// The snapshot without what insta keeps for a review only.
    kept: Vec<u8>,
    /// The ending and the bytes of the binary file beside it.
    binary: Option<(String, Vec<u8>)>,
}

/// The chapters of a folder whose tests have written snapshots that wait, in the order of their names.
///
/// Errors: a folder that cannot be read.
pub fn pending(chapters: &Path) -> Result<Vec<Pending>> {
    let mut found = Vec::new();
    for chapter in names(chapters)? {
        let folder = snapshot_folder(chapters, &chapter);
        if !folder.is_dir() {
            continue;
        }
        let kept = |name: String| name.strip_suffix(".new").filter(|kept| kept.ends_with(".snap")).map(String::from);
        let files: Vec<String> = names(&folder)?.into_iter().filter_map(kept).collect();
        if !files.is_empty() {
            found.push(Pending { chapter, folder, files });
        }
    }
    Ok(found)
}

fn names(folder: &Path) -> Result<Vec<String>> {
    let refused = |error| Error::Usage(format!("cannot read {}: {error}", folder.display()));
    let entries = fs::read_dir(folder).map_err(refused)?;
    let names = entries.map(|entry| entry.map(|entry| entry.file_name().to_string_lossy().into_owned()));
    let mut names = names.collect::<io::Result<Vec<String>>>().map_err(refused)?;
    names.sort();
    Ok(names)
}

impl Pending {
    /// Keeps everything that waits, as `cargo insta accept` does, and says which files were written.
    ///
    /// All files are read and checked before the first is written, and each is written whole or not at all.
    /// A file that waits goes away only after what it held stands in its place, so a stop half-way loses nothing.
    /// Errors: a file that is cut short or cannot be read or written.
    pub fn accept(&self) -> Result<Vec<PathBuf>> {
        let mut waiting = Vec::new();
        for file in &self.files {
            waiting.push((file, Waiting::read(&self.waits_in(file))?));
        }
        let mut written = Vec::new();
        for (file, Waiting { kept, binary }) in waiting {
            let path = self.folder.join(file);
            if let Some((ending, bytes)) = &binary {
                let beside = with_ending(&path, ending);
                write_whole(&beside, |file| file.write_all(bytes))?;
                written.push(beside);
            }
            write_whole(&path, |file| file.write_all(&kept))?;
            written.push(path);
            self.remove(file)?;
        }
        Ok(written)
    }

    /// Throws away everything that waits, as `cargo insta reject` does, and says which files are gone.
    ///
    /// Errors: a file that cannot be removed.
    pub fn reject(&self) -> Result<Vec<PathBuf>> {
        let mut gone = Vec::new();
        for file in &self.files {
            gone.extend(self.remove(file)?);
        }
        Ok(gone)
    }

    fn waits_in(&self, file: &str) -> PathBuf {
        self.folder.join(format!("{file}.new"))
    }

    /// Removes a file that waits, and the binary files beside it.
    fn remove(&self, file: &str) -> Result<Vec<PathBuf>> {
        let mut files = names(&self.folder)?;
        files.retain(|name| {
            let rest = name.strip_prefix(file).and_then(|rest| rest.strip_prefix(".new"));
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        });
        let files: Vec<PathBuf> = files.into_iter().map(|name| self.folder.join(name)).collect();
        for path in &files {
            fs::remove_file(path).map_err(|source| Error::Write { path: path.clone(), source })?;
        }
        Ok(files)
    }
}

impl Waiting {
    /// Reads a file that waits, with the line of its assertion left out, which insta writes for a review only.
    fn read(path: &Path) -> Result<Self> {
        let cut_short = |what: &str| {
            let chapter = path.parent().and_then(Path::parent).and_then(Path::file_name).unwrap_or_default();
            let chapter = chapter.to_string_lossy();
            Error::Usage(format!(
                "cannot accept {}: {what}; `cargo test --test chapters chapter_{chapter}` writes it again",
                path.display()
            ))
        };
        let text = String::from_utf8(read_file(path)?).map_err(|_| cut_short("it is no text"))?;
        let mut lines = text.split_inclusive('\n');
        let (mut kept, mut ending, mut closed) = (String::new(), None, false);
        if lines.next().map(str::trim_end) != Some("---") {
            return Err(cut_short("it does not start with ---"));
        }
        for line in lines.by_ref() {
            if line.trim_end() == "---" {
                closed = true;
                break;
            }
            if !line.starts_with("assertion_line:") {
                kept.push_str(line);
            }
            if let Some(value) = line.strip_prefix("extension:") {
                ending = Some(value.trim().trim_matches('"').to_string());
            }
        }
        if !closed {
            return Err(cut_short("its head does not end"));
        }
        let body: String = lines.collect();
        let binary = match ending {
            Some(ending) => {
                let bytes = read_file(&with_ending(path, &ending)).map_err(|error| cut_short(&error.to_string()))?;
                if ending == "png" && image::load_from_memory(&bytes).is_err() {
                    return Err(cut_short("the PNG beside it is cut short"));
                }
                Some((ending, bytes))
            }
            None => None,
        };
        Ok(Self { kept: format!("---\n{kept}---\n{body}").into_bytes(), binary })
    }
}

/// The name of the binary file that belongs to a snapshot.
fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_os_string();
    name.push(".");
    name.push(ending);
    name.into()
}
