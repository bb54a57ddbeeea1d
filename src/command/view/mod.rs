//! A scene in the browser.

mod browser;
mod home;
mod scene;

use super::arguments::ViewScene;
use super::called::called;
use super::error::{Error, Result};
use super::format::{Format, print_json};
use super::streams::Streams;
use super::subject::Subject;
use crate::command::warnings::notes;
use pinhole::film::linear_from_srgb;
use pinhole::plan::Census;
use pinhole::scene::printable_path;
use pinhole::{Chapter, Overrides};
use pinhole_lab::measure::image_file::{ImageKind, read_numbers};
use pinhole_live::{Reference, Showing, View};
use scene::ViewedScene;
use serde_json::json;
use std::ffi::OsStr;
use std::io::ErrorKind;
use std::net::TcpListener;
use std::path::Path;
use std::rc::Rc;

/// Shows a scene at an address of this machine, until the program is stopped.
///
/// Errors: there is no such scene, it cannot be rendered, or the port cannot be opened.
pub fn view(chapters: &[Chapter], asked: &ViewScene, format: Format, streams: &mut Streams<'_>) -> Result {
    let name = asked.chapter.as_deref().unwrap_or(OsStr::new("cover"));
    if name == "-" {
        return Err(Error::CommandLine(
            "standard input has no file to be edited: save it as a scene file first".into(),
        ));
    }
    let subject = Subject::find(chapters, name)?;
    let shown = subject.shown();
    let reference = asked.reference.as_deref().map(reference).transpose()?;
    let listener = listen(asked.port)?;
    if !format.is_json() {
        // What cannot be rendered is said on the page.
        let world = subject.world(&Overrides::default());
        notes(&Census::of(&world)).unwrap_or_default().iter().try_for_each(|note| streams.note(note))?;
    }
    let scene = Rc::new(ViewedScene::of(subject));
    let showing = Showing { size: asked.size, threads: asked.threads.map(usize::from), reference };
    let view = View::open(scene, showing, listener).map_err(Error::usage)?;
    let address = &view.address;
    if format.is_json() {
        print_json(&json!({ "address": address }), streams.out)?;
    } else {
        let opened = !asked.no_open && browser::open(address);
        let what = if opened { "is opened in the browser" } else { "is the address to open in a browser" };
        writeln!(streams.out, "{address} {what}: it shows {shown} until Ctrl-C.")?;
    }
    streams.out.flush()?;
    view.run();
    Ok(())
}

/// A picture from a file, as light.
fn reference(file: &Path) -> Result<Reference> {
    let kind = ImageKind::of(file).map_err(Error::usage)?;
    let numbers = read_numbers(file).map_err(Error::usage)?;
    let light = |part: f64| if kind == ImageKind::Png { linear_from_srgb(part) } else { part };
    let means = numbers.pixels.iter().map(|pixel| pixel.map(|part| light(part) as f32)).collect();
    Ok(Reference { name: printable_path(file), size: numbers.size, means })
}

fn listen(port: u16) -> Result<TcpListener> {
    TcpListener::bind(("127.0.0.1", port)).map_err(|error| match error.kind() {
        ErrorKind::AddrInUse => {
            let what = format!("port {port} is in use by another program: `{}` finds a free one", called("view"));
            Error::usage(what)
        }
        _ => Error::usage(format!("port {port} cannot be opened on 127.0.0.1: {error}")),
    })
}
