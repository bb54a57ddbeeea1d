//! All pages and slides of the built book in a headless Chromium: 1,280 and 390 pixels wide, light and dark, everything
//! unfolded.
//!
//! `cargo test -p book --bench pages`, after `cargo run -p book`; `PINHOLE_VIEW_PICTURES=folder` keeps a picture of each.
//! It fails where a page complains on the console, asks anything of another machine, or is wider than the window, and
//! where a listing or a formula has to be scrolled at 1,280 pixels or a table at 390.
#![allow(clippy::print_stdout, reason = "what it prints is what it is run for")]

#[allow(dead_code, reason = "pages need no mouse and no keys")]
#[path = "../view/browser.rs"]
mod browser;

use browser::Browser;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// What sticks out of a page on which everything is unfolded; `SCROLLED` is what must not have to be scrolled.
const STICKING_OUT: &str = r#"(async () => {
  document.querySelectorAll("details").forEach((folded) => { folded.open = true; });
  await document.fonts.ready;
  const width = document.documentElement.clientWidth, named = (it) => `${it.tagName} "${it.textContent.trim().slice(0, 40)}"`;
  const scrolled = [...document.querySelectorAll("main :is(SCROLLED)")].filter((it) => it.scrollWidth > it.clientWidth + 1);
  const found = scrolled.map((it) => `${named(it)} is ${it.scrollWidth - it.clientWidth} pixels too wide`);
  if (document.documentElement.scrollWidth > width + 1) {
    const beyond = [...document.querySelectorAll("main *")].filter((it) => it.getBoundingClientRect().right > width + 1);
    found.push(`the page is ${document.documentElement.scrollWidth} pixels wide: ${beyond.slice(0, 3).map(named).join(", ")}`);
  }
  const asked = performance.getEntriesByType("resource").map((it) => it.name);
  found.push(...asked.filter((name) => !/^(file|blob|data):/.test(name)).map((name) => `it asks for ${name}`));
  return found;
})()"#;

fn main() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../out/book");
    let name_of = |page: &Path| {
        let name = page.strip_prefix(&folder).unwrap_or(page).with_extension("");
        name.to_string_lossy().replace('\\', "/")
    };
    let inside = |folder: PathBuf| folder.read_dir().into_iter().flatten().flatten().map(|entry| entry.path());
    let mut pages: Vec<PathBuf> = inside(folder.clone()).chain(inside(folder.join("slides"))).collect();
    pages.retain(|page| page.extension().is_some_and(|extension| extension == "html") && !page.ends_with("toc.html"));
    pages.sort();
    if pages.is_empty() {
        println!("There is no book yet: cargo run -p book");
        std::process::exit(1);
    }
    let address = |page: &Path| format!("file://{}", page.canonicalize().expect("a page").display());
    let Some(mut browser) = Browser::open(&address(&pages[0])) else {
        return println!("No Chromium is installed, so no page was looked at.");
    };
    let (mut looked, mut problems) = (0, Vec::new());
    for (width, scrolled) in [(1280, "pre > code, .formula, table"), (390, "table")] {
        let size = json!({ "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 500 });
        browser.call("Emulation.setDeviceMetricsOverride", &size);
        for theme in ["light", "coal"] {
            let words = format!("try {{ localStorage.setItem('mdbook-theme', '{theme}') }} catch {{}}");
            let script = browser.call("Page.addScriptToEvaluateOnNewDocument", &json!({ "source": words }));
            for page in &pages {
                let name = name_of(page);
                browser.call("Page.navigate", &json!({ "url": address(page) }));
                browser.until(&format!(
                    "location.pathname.endsWith('/{name}.html') && document.readyState === 'complete' \
                     && document.querySelector('main')"
                ));
                let found = browser.value(&STICKING_OUT.replace("SCROLLED", scrolled));
                let found = found.as_array().into_iter().flatten().filter_map(Value::as_str).map(str::to_owned);
                let complaints = std::mem::take(&mut browser.errors);
                let place = format!("{name}, {width} pixels, {theme}");
                problems.extend(found.chain(complaints).map(|what| format!("{place}: {what}")));
                browser.photograph(&format!("{}_{width}_{theme}", name.replace('/', "_")));
                looked += 1;
            }
            browser.call("Page.removeScriptToEvaluateOnNewDocument", &script);
        }
    }
    drop(browser);
    problems.iter().for_each(|problem| println!("{problem}"));
    println!("{looked} pages looked at, {} problems", problems.len());
    std::process::exit(i32::from(!problems.is_empty()));
}
