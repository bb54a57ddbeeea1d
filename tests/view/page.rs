//! The page as a reader uses it, in a headless Chromium; where none is installed, the tests say so and pass.
//!
//! `PINHOLE_VIEW_SECONDS=600 cargo test --test program view::page::a_long -- --nocapture` is the long run;
//! `PINHOLE_VIEW_PICTURES=folder` keeps pictures of the page.

use super::Viewing;
use super::browser::Browser;
use serde_json::json;
use std::fs;
use std::time::{Duration, Instant};

/// The pixels of the picture, as a text that differs where they do.
const PIXELS: &str = "document.getElementById('picture').toDataURL()";
pub const DONE: &str = "document.body?.dataset.done === 'true'";

/// The page of a scene once its picture is complete.
pub fn opened(viewing: &Viewing) -> Option<Browser> {
    let Some(mut browser) = Browser::open(&viewing.address) else {
        eprintln!("no Chromium is installed, so the page is not looked at");
        return None;
    };
    browser.until(DONE);
    Some(browser)
}

/// The picture once it is complete again after a change.
pub fn next_picture(browser: &mut Browser, change: impl FnOnce(&mut Browser)) -> String {
    let before = browser.number("document.body.dataset.change");
    change(browser);
    browser.until(&format!("Number(document.body.dataset.change) > {before} && {DONE}"));
    picture(browser)
}

/// Waits until the picture is complete and this one; a late change of the layout may be drawn before it.
pub fn until_picture(browser: &mut Browser, expected: &str) {
    browser.until(&format!("{DONE} && {PIXELS} === {}", json!(expected)));
}

pub fn picture(browser: &mut Browser) -> String {
    browser.value(PIXELS).as_str().expect("a picture").to_owned()
}

pub fn middle(browser: &mut Browser) -> [f64; 2] {
    let part = |side: &str, size: &str| {
        format!(
            "(() => {{ const r = document.getElementById('picture').getBoundingClientRect(); return r.{side} + r.{size} / 2; }})()"
        )
    };
    [browser.number(&part("left", "width")), browser.number(&part("top", "height"))]
}

/// Drags from a point in steps, and waits for each step's frame; returns the milliseconds from input to frame.
pub fn drag(browser: &mut Browser, [x, y]: [f64; 2], step: [f64; 2], steps: u32, modifiers: u32) -> Vec<f64> {
    let mut took = Vec::new();
    browser.mouse("mousePressed", [x, y], "left", modifiers);
    for number in 1..=steps {
        browser.value("delete document.body.dataset.latency");
        let at = [x + step[0] * f64::from(number), y + step[1] * f64::from(number)];
        browser.mouse("mouseMoved", at, "left", modifiers);
        browser.until("document.body.dataset.latency");
        took.push(browser.number("document.body.dataset.latency"));
    }
    browser.mouse("mouseReleased", [x + step[0] * f64::from(steps), y], "left", modifiers);
    took
}

pub fn told(what: &str, mut took: Vec<f64>) -> f64 {
    took.sort_by(f64::total_cmp);
    let median = took[took.len() / 2];
    let (max, count) = (took[took.len() - 1], took.len());
    eprintln!("view: {what}: input to frame {median:.1} ms in the middle, {max:.1} ms at most, of {count}");
    median
}

/// Clicks what a selector finds, as soon as it is there: lists are made anew with each picture.
fn click(browser: &mut Browser, selector: &str) {
    browser.until(&format!("document.querySelector({})", json!(selector)));
    browser.value(&format!("document.querySelector({}).click()", json!(selector)));
}

fn paint(browser: &mut Browser, column: &str) {
    let choose =
        "const s = document.getElementById('columns'); s.value = COLUMN; s.dispatchEvent(new Event('change'));";
    browser.value(&format!("{{ {} }}", choose.replace("COLUMN", &json!(column).to_string())));
}

#[test]
fn the_camera_follows_the_mouse_and_comes_back() {
    let viewing = Viewing::of("10", &["--size", "240x135"]);
    let Some(mut browser) = opened(&viewing) else { return };
    let first = picture(&mut browser);
    let at = middle(&mut browser);
    for (what, modifiers) in [("orbit", 0), ("pan", 8)] {
        let mut took = Vec::new();
        let moved = next_picture(&mut browser, |browser| took = drag(browser, at, [9.0, 4.0], 12, modifiers));
        assert_ne!(moved, first, "{what}");
        assert!(told(what, took) < 1000.0);
        assert_eq!(next_picture(&mut browser, |browser| browser.key("0")), first, "the scene's own camera again");
    }
    for change in [|browser: &mut Browser, at| browser.wheel(at, -240.0), |browser: &mut Browser, _| browser.key("+")] {
        assert_ne!(next_picture(&mut browser, |browser| change(browser, at)), first);
        assert_eq!(next_picture(&mut browser, |browser| browser.key("0")), first);
    }
    let focused = next_picture(&mut browser, |browser| {
        browser.mouse("mouseMoved", [at[0] - 60.0, at[1] + 40.0], "none", 0);
        browser.key("f");
    });
    assert_ne!(focused, first);
    browser.photograph("camera");
    assert!(browser.errors.is_empty(), "{:?}", browser.errors);
}

#[test]
fn columns_modes_stages_and_the_pixel_are_shown() {
    let viewing = Viewing::of("10", &["--size", "240x135"]);
    let Some(mut browser) = opened(&viewing) else { return };
    let first = picture(&mut browser);

    let painted = next_picture(&mut browser, |browser| paint(browser, "ndc"));
    assert_ne!(painted, first);
    assert_eq!(next_picture(&mut browser, |browser| paint(browser, "")), first);

    let at = middle(&mut browser);
    browser.mouse("mouseMoved", [at[0], at[1] + 60.0], "none", 0);
    browser.until("document.querySelectorAll('#pixel dt').length > 5");
    let spaces = browser.value("[...document.querySelectorAll('#pixel dt')].map((e) => e.textContent).join(' ')");
    for space in ["raster", "ndc", "screen", "camera", "world", "hit", "surface", "radiance"] {
        assert!(spaces.as_str().expect("text").contains(space), "no {space} in {spaces}");
    }
    browser.photograph("pixel");

    let direct = next_picture(&mut browser, |browser| browser.key("3"));
    assert_ne!(direct, first, "path tracing shows more light");
    browser.until("document.querySelector('#modes [aria-pressed=true]').textContent === '3path traced'");
    assert_eq!(next_picture(&mut browser, |browser| browser.key("1")), first);

    click(&mut browser, "[data-panel=stages]");
    let stage = |name: &str| format!("#stages [aria-label={}]", json!(name));
    let lighting = stage("Evaluate direct light: matte");
    assert!(
        browser.number(
            "[...document.querySelectorAll('#kept .number')].reduce((sum, e) => sum + Number(e.textContent), 0)"
        ) > 0.0
    );
    browser.photograph("stages");
    let unlit = next_picture(&mut browser, |browser| click(browser, &lighting));
    assert_ne!(unlit, first);
    click(&mut browser, &lighting);
    until_picture(&mut browser, &first);
    let rays = stage("Generate camera rays: perspective");
    click(&mut browser, &rays);
    browser.until("!document.getElementById('message').hidden");
    let reason = browser.value("document.getElementById('message').textContent");
    assert!(reason.as_str().expect("text").contains("reads the column `camera`"), "{reason}");
    browser.until(&format!("document.querySelector({})?.checked", json!(rays)));
    browser.photograph("refused");
    assert_eq!(picture(&mut browser), first);
    assert!(browser.errors.is_empty(), "{:?}", browser.errors);
}

#[test]
fn the_scene_is_edited_saved_and_its_picture_kept() {
    let viewing = Viewing::of("10", &["--size", "96x54"]);
    let Some(mut browser) = opened(&viewing) else { return };
    let first = picture(&mut browser);
    let file = viewing.folder.path().join("scene.ron");
    let before = fs::read_to_string(&file).expect("there");
    assert_eq!(browser.value("document.getElementById('text').value"), before.as_str());
    click(&mut browser, "[data-panel=edit]");
    browser.photograph("scene");

    let type_text = |browser: &mut Browser, text: &str| {
        browser.value(&format!("document.getElementById('text').value = {}", json!(text)));
    };
    type_text(&mut browser, &before.replacen("sphere: (radius: ", "sphere: (radius: -", 1));
    click(&mut browser, "#apply");
    browser.until("document.getElementById('said').className === 'bad'");
    let said = browser.value("document.getElementById('said').textContent");
    let line = before.lines().position(|line| line.contains("sphere: (")).expect("a sphere") + 1;
    assert!(said.as_str().expect("text").contains(&format!("scene.ron:{line}:")), "{said}");
    assert_eq!(picture(&mut browser), first, "what was there stays");
    browser.photograph("mistake");

    type_text(&mut browser, &before);
    browser.value("document.getElementById('text').dispatchEvent(new Event('input'))");
    let wider = next_picture(&mut browser, |browser| {
        let slide = "const i = document.querySelector('#numbers input[type=number]'); i.value = 70; i.dispatchEvent(new Event('input'));";
        browser.value(&format!("{{ {slide} }}"));
    });
    assert_ne!(wider, first);
    let text = browser.value("document.getElementById('text').value");
    let text = text.as_str().expect("text");
    assert!(text.contains("fov: 70.0") && !before.contains("fov: 70.0"), "{text}");
    assert_eq!(fs::read_to_string(&file).expect("there"), before, "nothing is written before it is saved");
    click(&mut browser, "#save");
    browser.until("document.getElementById('said').textContent.startsWith('Saved as ')");
    assert_eq!(fs::read_to_string(&file).expect("there"), text);

    // What is seen from where the camera was dragged to is seen from the text that keeps the view, too.
    let at = middle(&mut browser);
    let moved = next_picture(&mut browser, |browser| _ = drag(browser, at, [12.0, 4.0], 3, 0));
    assert_ne!(moved, wider);
    assert_eq!(next_picture(&mut browser, |browser| click(browser, "#view")), moved, "the same view");
    browser.until("document.getElementById('said').textContent === 'The camera is in the text.'");
    let kept = browser.value("document.getElementById('text').value");
    assert_ne!(kept.as_str(), Some(text), "the text has another camera");
    assert_eq!(next_picture(&mut browser, |browser| browser.key("0")), moved, "it is the scene's own camera now");

    fs::write(&file, &before).expect("written");
    type_text(&mut browser, &text.replace("70.0", "60.0"));
    click(&mut browser, "#save");
    browser.until("document.getElementById('said').textContent.includes('by another program')");
    assert_eq!(fs::read_to_string(&file).expect("there"), before, "what another program wrote is not lost");

    browser.until(DONE);
    let png = image::load_from_memory(&viewing.get("picture.png")).expect("a PNG");
    assert_eq!((png.width(), png.height()), (96, 54));
    assert!(viewing.get("picture.exr").starts_with(&[0x76, 0x2f, 0x31, 0x01]), "an OpenEXR file");
    assert!(browser.errors.is_empty(), "{:?}", browser.errors);
}

/// A chapter is no file: what is edited becomes one of its own, with the meshes that the chapter makes beside it.
#[test]
fn a_chapter_is_saved_to_a_new_file() {
    let folder = super::folder_with("28");
    let mut command = super::program(folder.path());
    command.args(["view", "28", "--size", "48x27"]);
    let viewing = Viewing::started(command, folder);
    let Some(mut browser) = opened(&viewing) else { return };
    let first = picture(&mut browser);
    let text = browser.value("document.getElementById('text').value");
    let edited = text.as_str().expect("text").replacen("fov: ", "fov: 1", 1);
    browser.value(&format!("document.getElementById('text').value = {}", json!(edited)));
    assert_ne!(next_picture(&mut browser, |browser| click(browser, "#save")), first);
    browser.until("document.getElementById('said').textContent === 'Saved as out/28_meshes.ron.'");
    let rendered =
        super::ended(viewing.folder.path(), &["render", "out/28_meshes.ron", "--size", "8x5", "-q", "-o", "a.png"]);
    assert!(rendered.status.success(), "{}", String::from_utf8_lossy(&rendered.stderr));
    assert!(browser.errors.is_empty(), "{:?}", browser.errors);
}

#[test]
#[cfg(target_os = "linux")]
fn a_long_run_takes_no_more_memory() {
    let seconds = std::env::var("PINHOLE_VIEW_SECONDS").ok().and_then(|text| text.parse().ok()).unwrap_or(5);
    let viewing = Viewing::of("10", &["--size", "240x135"]);
    let Some(mut browser) = opened(&viewing) else { return };
    let (at, began) = (middle(&mut browser), Instant::now());
    let (mut took, mut sampled) = (Vec::new(), Vec::new());
    while began.elapsed() < Duration::from_secs(seconds) {
        took.extend(drag(&mut browser, at, [7.0, 3.0], 6, 0));
        took.extend(drag(&mut browser, at, [-7.0, -3.0], 6, 8));
        next_picture(&mut browser, |browser| paint(browser, "ndc"));
        next_picture(&mut browser, |browser| paint(browser, ""));
        next_picture(&mut browser, |browser| browser.key("0"));
        sampled.push(viewing.memory());
    }
    told(&format!("{seconds} s"), took);
    let quarter = sampled.len() / 4;
    let (early, late) = (sampled[quarter], sampled[sampled.len() - 1]);
    let frames = browser.number("document.body.dataset.frame");
    eprintln!(
        "view: {frames} frames; {early:.1} MiB after a quarter of {} rounds, {late:.1} MiB at the end",
        sampled.len()
    );
    assert!(late < early + 12.0, "the memory grows: {sampled:?}");
    assert!(browser.errors.is_empty(), "{:?}", browser.errors);
}

/// Pictures of the page for someone to look at, in the light and in the dark, wide and narrow.
#[test]
fn the_page_is_readable_in_the_light_and_in_the_dark() {
    let viewing = Viewing::of("25", &["--size", "480x270"]);
    let Some(mut browser) = opened(&viewing) else { return };
    let at = middle(&mut browser);
    for (name, scheme, width, height) in
        [("light", "light", 1200, 800), ("dark", "dark", 1200, 800), ("narrow", "light", 480, 900)]
    {
        let features = json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
        browser.call("Emulation.setEmulatedMedia", &features);
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        browser.call("Emulation.setDeviceMetricsOverride", &size);
        browser.mouse("mouseMoved", [at[0].min(200.0), at[1].min(150.0)], "none", 0);
        std::thread::sleep(Duration::from_millis(300));
        assert!(browser.number("document.documentElement.scrollWidth") <= f64::from(width), "{name} is too wide");
        let contrast = "getComputedStyle(document.body).color !== getComputedStyle(document.body).backgroundColor";
        assert_eq!(browser.value(contrast), true, "{name}");
        browser.photograph(name);
        browser.value("document.querySelectorAll('nav button')[1].click()");
        browser.photograph(&format!("{name}_stages"));
        browser.value("document.querySelectorAll('nav button')[0].click()");
    }
    assert!(browser.errors.is_empty(), "{:?}", browser.errors);
}
