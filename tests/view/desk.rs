//! What a reader does on the page beside moving the camera: wide and narrow, by mouse and by keys, without an error in the
//! console; where no Chromium is installed, the tests say so and pass.

use super::Viewing;
use super::browser::Browser;
use super::page::{DONE, drag, middle, next_picture, opened, picture, told, until_picture};
use serde_json::json;
use std::thread::sleep;
use std::time::Duration;

/// Ctrl in the DevTools protocol.
const CTRL: u32 = 2;
const ALT: u32 = 1;
const SHIFT: u32 = 8;

fn sized(browser: &mut Browser, width: u32, height: u32) {
    let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
    browser.call("Emulation.setDeviceMetricsOverride", &size);
    sleep(Duration::from_millis(200));
}

/// Gives a control another value, as a reader does.
fn set(browser: &mut Browser, id: &str, value: &str) {
    let event = if id == "exposure" { "input" } else { "change" };
    // What a list offers may depend on what was chosen before.
    let is_offered = format!("[...c.options ?? []].some((own) => own.value === '{value}')");
    browser.until(&format!(
        "(() => {{ const c = document.getElementById('{id}'); return !c.options || {is_offered}; }})()"
    ));
    browser.value(&format!(
        "{{ const c = document.getElementById('{id}'); c.value = '{value}'; c.dispatchEvent(new Event('{event}')); }}"
    ));
}

fn text(browser: &mut Browser, id: &str) -> String {
    browser.value(&format!("document.getElementById('{id}').textContent")).as_str().expect("a text").to_owned()
}

fn wide_and_narrow(name: &str, width: u32, height: u32) {
    let viewing = Viewing::of("10", &["--size", "240x135"]);
    let Some(mut browser) = opened(&viewing) else { return };
    sized(&mut browser, width, height);
    let first = picture(&mut browser);
    let at = middle(&mut browser);

    // Exposure by slider and by key, and the curve.
    let brighter = next_picture(&mut browser, |browser| set(browser, "exposure", "2"));
    assert!(brighter != first);
    for _ in 0..4 {
        next_picture(&mut browser, |browser| browser.press("E", SHIFT));
    }
    assert!(picture(&mut browser) == first, "two stops there and back");
    assert!(next_picture(&mut browser, |browser| set(browser, "curve", "agx")) != first);
    assert!(next_picture(&mut browser, |browser| set(browser, "curve", "scene")) == first);

    // False colour: a scale with its numbers and their unit, by itself and fixed.
    next_picture(&mut browser, |browser| set(browser, "columns", "raster"));
    next_picture(&mut browser, |browser| set(browser, "component", "x"));
    browser.until("!document.getElementById('legend').hidden");
    assert!(text(&mut browser, "unit").contains("raster x: pixels"), "{}", text(&mut browser, "unit"));
    assert_eq!(text(&mut browser, "found"), "there: 0.5 to 239.5");
    next_picture(&mut browser, |browser| set(browser, "most", "120"));
    assert_eq!(browser.number("document.body.dataset.most"), 120.0);
    assert_eq!(browser.value("document.getElementById('automatic').checked"), false);
    browser.mouse("mouseMoved", at, "none", 0);
    browser.until("document.querySelectorAll('#readings tr')[1]?.children[3]?.textContent === '120.5'");
    browser.photograph(&format!("false_colour_{name}"));
    next_picture(&mut browser, |browser| browser.key("g"));
    assert_eq!(browser.value("document.getElementById('automatic').checked"), true);
    assert!(next_picture(&mut browser, |browser| set(browser, "columns", "")) == first);

    // The pixel's mean with its samples; a second by keys; two pinned and compared. The scale has left its place by then.
    browser.until("document.getElementById('legend').hidden");
    let at = middle(&mut browser);
    browser.mouse("mouseMoved", at, "none", 0);
    browser.until("document.querySelectorAll('#readings tr')[1]?.children[1]?.textContent === '120, 67'");
    browser.key("p");
    browser.until("document.querySelectorAll('#pins .pin').length === 1");
    browser.press("L", SHIFT);
    browser.until("document.querySelectorAll('#readings tr')[1]?.children[1]?.textContent === '130, 67'");
    browser.key("p");
    browser.until("[...document.querySelectorAll('#readings th')].some((e) => e.textContent === 'B / A')");
    let rows = text(&mut browser, "readings");
    assert!(rows.contains("B − A") && rows.contains("A120, 67"), "{rows}");
    browser.photograph(&format!("pinned_{name}"));

    // The picture magnified about its middle, moved, one to one, and fitting again; the camera stays.
    let scale = |browser: &mut Browser| browser.number("document.body.dataset.scale");
    sleep(Duration::from_millis(200));
    let fitting = scale(&mut browser);
    browser.wheel_with(at, -240.0, CTRL);
    browser.until(&format!("Number(document.body.dataset.scale) > {fitting} * 1.5"));
    let moved = |browser: &mut Browser| browser.value("document.getElementById('paper').style.transform");
    let before = moved(&mut browser);
    browser.mouse("mousePressed", at, "left", ALT);
    browser.mouse("mouseMoved", [at[0] + 20.0, at[1]], "left", ALT);
    browser.mouse("mouseReleased", [at[0] + 20.0, at[1]], "left", ALT);
    assert_ne!(moved(&mut browser), before);
    for _ in 0..4 {
        browser.press("Z", SHIFT);
    }
    assert_eq!(scale(&mut browser), fitting);
    browser.key("x");
    assert_eq!(scale(&mut browser), 1.0);
    browser.key("x");
    assert_eq!((scale(&mut browser), picture(&mut browser) == first), (fitting, true));

    // The picture kept, another beside it: A and B, their difference, and a number for it.
    next_picture(&mut browser, |browser| browser.key("q"));
    browser.until("document.body.dataset.error === '0'");
    let other = next_picture(&mut browser, |browser| browser.press("ArrowRight", 0));
    assert!(other != first);
    assert!(browser.number("document.body.dataset.error") > 0.0 && text(&mut browser, "error").contains("relMSE"));
    assert!(next_picture(&mut browser, |browser| browser.key("a")) == first, "the reference");
    assert!(next_picture(&mut browser, |browser| browser.key("a")) == other, "what is rendered");
    assert!(next_picture(&mut browser, |browser| browser.key("d")) != other);
    browser.photograph(&format!("difference_{name}"));
    next_picture(&mut browser, |browser| browser.press("Q", SHIFT));

    // A movement taken back and done again; views kept; an address that is seen from the same place.
    assert!(next_picture(&mut browser, |browser| browser.press("z", CTRL)) == first);
    browser.until("location.hash === ''");
    assert!(next_picture(&mut browser, |browser| browser.press("Z", CTRL | SHIFT)) == other);
    browser.until("location.hash.includes('eye=')");
    let hash = browser.value("location.hash");
    browser.key("b");
    browser.digit('7', 0);
    assert!(next_picture(&mut browser, |browser| browser.key("0")) == first);
    assert!(next_picture(&mut browser, |browser| browser.digit('7', SHIFT)) == other, "the view that was kept");
    next_picture(&mut browser, |browser| browser.key("0"));
    browser.until("location.hash === ''");
    let shared = format!("location.hash = {hash} + '&show=ndc.x'");
    next_picture(&mut browser, |browser| _ = browser.value(&shared));
    browser.until("sheet.camera && sheet.column === 'ndc.x' && !document.getElementById('legend').hidden");
    set(&mut browser, "columns", "");
    until_picture(&mut browser, &other);
    // The page writes its own address before the browser has told it of this one.
    browser.value("location.hash = '#curve=cubic'; keepAddress()");
    browser.until("document.getElementById('message').textContent.includes('no curve is called \"cubic\"')");
    next_picture(&mut browser, |browser| browser.key("0"));
    browser.until("document.getElementById('message').hidden");
    browser.value("location.hash = '#curve=agx'");
    browser.until("look.curve === 'agx'");
    browser.value("setLook({ curve: 'scene' }).then(() => (location.hash = '#curve=agx', location.reload()))");
    browser.until("typeof look === 'object' && look.curve === 'agx' && location.hash === '#curve=agx'");
    browser.until(DONE);
    next_picture(&mut browser, |browser| _ = browser.value("location.hash = '#curve=scene'"));
    browser.until("location.hash === ''");

    // A pause, a region, as many pixels as there is room for; panels.
    browser.key(" ");
    browser.until("document.body.dataset.paused === 'true'");
    browser.key(" ");
    browser.until("document.body.dataset.paused === 'false'");
    let at = middle(&mut browser);
    browser.mouse("mousePressed", at, "left", CTRL);
    browser.mouse("mouseMoved", [at[0] + 40.0, at[1] + 30.0], "left", CTRL);
    browser.mouse("mouseReleased", [at[0] + 40.0, at[1] + 30.0], "left", CTRL);
    browser.until("sheet.region && !document.getElementById('region').hidden");
    browser.key("r");
    browser.until("!sheet.region && document.getElementById('region').hidden");
    next_picture(&mut browser, |browser| browser.key("w"));
    browser.until("sheet.fills && sheet.size[0] === document.getElementById('frame').clientWidth");
    browser.photograph(&format!("filled_{name}"));
    assert!(next_picture(&mut browser, |browser| browser.key("w")) == first);
    browser.key("n");
    assert_eq!(browser.value("document.querySelector('aside').offsetWidth"), 0);
    browser.key("n");
    browser.key("n");
    browser.key("?");
    browser.until("document.getElementById('keys').open");
    browser.photograph(&format!("keys_{name}"));
    assert!(browser.number("document.documentElement.scrollWidth") <= f64::from(width), "{name}: too wide");
    browser.value("document.getElementById('keys').close()");

    // Every key of the list does something that the script knows.
    let keys = browser.number("Object.keys(keys).length");
    let took = drag(&mut browser, at, [5.0, 2.0], 6, 0);
    told(&format!("desk at {width}"), took);
    browser.until(DONE);
    eprintln!("view: at {width} × {height} with {keys} keys, {} errors in the console", browser.errors.len());
    assert!(browser.errors.is_empty(), "{:?}", browser.errors);
}

#[test]
fn a_wide_page_does_all_that_it_offers() {
    wide_and_narrow("wide", 1280, 800);
}

#[test]
fn a_narrow_page_does_the_same() {
    wide_and_narrow("narrow", 390, 844);
}

/// A page of 1280 × 800 once left 240 of its lines empty.
#[test]
fn a_wide_page_is_filled() {
    let viewing = Viewing::of("25", &["--size", "160x90"]);
    let Some(mut browser) = opened(&viewing) else { return };
    sized(&mut browser, 1280, 800);
    let at = middle(&mut browser);
    browser.mouse("mouseMoved", at, "none", 0);
    browser.until("document.querySelectorAll('#readings tr').length > 1");
    for (key, least) in [("", 0.8), ("n", 0.8), ("n", 0.9)] {
        if !key.is_empty() {
            browser.key(key);
            sleep(Duration::from_millis(100));
        }
        let used = "(() => { const s = document.getElementById('stage'); const shown = [document.getElementById('picture'), \
                    ...s.querySelectorAll('#status, .tools, #gathered')].map((e) => e.getBoundingClientRect().height); \
                    return shown.reduce((a, b) => a + b) / s.clientHeight; })()";
        let used = browser.number(used);
        eprintln!("view: {:.0} % of the page's height is used", 100.0 * used);
        assert!(used > least, "{used}");
    }
    assert!(browser.errors.is_empty(), "{:?}", browser.errors);
}
