//! What the served book answers: files below one folder and nothing else, and pages that reload themselves.

use std::path::{Path, PathBuf};

/// Where an open page asks which build it shows.
pub const REVISION: &str = "/__revision";

/// Put into every page that is served: asks for the revision, reloads on a new one, shows what stopped a build.
const RELOAD: &str = r#"<script>
(() => {
  const shown = "REVISION";
  const note = document.createElement("pre");
  note.style.cssText = "position:fixed;inset:auto 0 0 0;margin:0;padding:1em;z-index:2000;max-height:50vh;" +
    "overflow:auto;white-space:pre-wrap;background:#7d1f1f;color:#fff";
  const ask = async () => {
    try {
      const [revision, ...told] = (await (await fetch("/__revision")).text()).split("\n");
      if (revision !== shown) { location.reload(); return; }
      note.textContent = told.join("\n");
      if (told.length) { document.body.append(note); } else { note.remove(); }
    } catch { /* the builder was stopped: ask again */ }
    setTimeout(ask, 500);
  };
  ask();
})();
</script>
"#;

/// What the server shows.
#[derive(Debug)]
pub struct Site {
    /// The folder of the built book.
    pub out: PathBuf,
    /// Grows with every build.
    pub revision: u32,
    /// What stopped the last build, if anything did.
    pub told: Option<String>,
}

/// What one address answers.
#[derive(Debug, PartialEq, Eq)]
pub struct Answer {
    /// The HTTP status.
    pub status: u16,
    /// The media type.
    pub kind: &'static str,
    /// What is sent.
    pub body: Vec<u8>,
}

/// A sentence instead of a page.
pub fn plain(status: u16, text: &str) -> Answer {
    Answer { status, kind: "text/plain; charset=utf-8", body: text.as_bytes().to_vec() }
}

/// What the site answers at an address.
pub fn answer(site: &Site, url: &str) -> Answer {
    let path = url.split(['?', '#']).next().unwrap_or_default();
    if path == REVISION {
        let told = site.told.as_ref().map(|told| format!("\n{told}")).unwrap_or_default();
        return plain(200, &format!("{}{told}", site.revision));
    }
    let file = below(&site.out, path).map(|file| if file.is_dir() { file.join("index.html") } else { file });
    let Some((file, body)) = file.and_then(|file| Some((file.clone(), std::fs::read(file).ok()?))) else {
        return plain(404, "there is no such page in the book");
    };
    let kind = kind_of(&file);
    if kind.starts_with("text/html") {
        let script = RELOAD.replace("REVISION", &site.revision.to_string());
        let page = String::from_utf8_lossy(&body).replace("</body>", &format!("{script}</body>"));
        return Answer { status: 200, kind, body: page.into_bytes() };
    }
    Answer { status: 200, kind, body }
}

/// The file an address means, never one outside the folder.
fn below(folder: &Path, path: &str) -> Option<PathBuf> {
    let mut file = folder.to_path_buf();
    for part in decoded(path)?.split('/').filter(|part| !part.is_empty() && *part != ".") {
        if part == ".." || part.contains(['\\', ':', '\0']) {
            return None;
        }
        file.push(part);
    }
    // A link inside the folder could still lead out of it.
    let (file, folder) = (file.canonicalize().ok()?, folder.canonicalize().ok()?);
    file.starts_with(folder).then_some(file)
}

fn decoded(path: &str) -> Option<String> {
    let mut parts = path.split('%');
    let mut bytes = parts.next()?.as_bytes().to_vec();
    for part in parts {
        let (code, rest) = part.split_at_checked(2)?;
        bytes.push(u8::from_str_radix(code, 16).ok()?);
        bytes.extend_from_slice(rest.as_bytes());
    }
    String::from_utf8(bytes).ok()
}

fn kind_of(file: &Path) -> &'static str {
    match file.extension().and_then(|extension| extension.to_str()).unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "json" => "application/json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "woff2" => "font/woff2",
        "txt" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::build;
    use crate::build::tests::{little_book, little_kit};

    #[test]
    fn pages_are_served_and_nothing_else() {
        let (_folder, book) = little_book();
        build(&book, &little_kit()).expect("the little book builds");
        let site = Site { out: book.out.clone(), revision: 7, told: Some("a slip".to_owned()) };
        let status = |url: &str| answer(&site, url).status;
        assert_eq!([status("/"), status("/01_one.html?x#y"), status("/figures/render.png")], [200; 3]);
        assert_eq!([status("/none.html"), status("/../src/01_one.md"), status("/%2e%2e/src/01_one.md")], [404; 3]);
        assert_eq!([status("/figures/..%2f..%2fsrc/01_one.md"), status("/..\\src"), status("/%zz")], [404; 3]);
        assert_eq!(answer(&site, REVISION), plain(200, "7\na slip"));
        let page = String::from_utf8(answer(&site, "/02_two.html").body).expect("text");
        assert!(page.contains("const shown = \"7\""));
        let written = std::fs::read_to_string(book.out.join("02_two.html")).expect("a page");
        assert!(!written.contains(REVISION), "the built page knows nothing of the server");
    }
}
