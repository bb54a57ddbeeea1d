use crate::png_url;
use crate::review::{Difference, Place, Snapshots, picture_contrast};
use pinhole::Result;
use std::fmt::Write;

/// Before, now and their difference: side by side, swiped, blended, toggled, enlarged with square pixels.
pub fn viewer(name: &str, before: &Snapshots, now: &Snapshots, first: Option<&Difference>) -> Result<String> {
    let size = |png: &[u8]| image::load_from_memory(png).ok().map(|image| [image.width(), image.height()]);
    let [old, new] = [before, now].map(|snapshots| size(&snapshots.picture));
    if before.picture == now.picture {
        return Ok(match new {
            Some(size) => {
                format!("<div class=\"shots\">{}</div>\n", shot("now", "before and now", &now.picture, size, ""))
            }
            None => "<p>There is no picture.</p>\n".into(),
        });
    }
    let frame = old.or(new).zip(first).map_or(String::new(), |(size, first)| frame(first, size));
    let mut shots = String::new();
    for (class, words, picture, size) in [("before", "before", &before.picture, old), ("now", "now", &now.picture, new)]
    {
        match size {
            Some(size) => shots += &shot(class, words, picture, size, &frame),
            None => {
                let _ = write!(shots, "<p>There is no picture {words} that can be decoded.</p>");
            }
        }
    }
    let comparable = old.is_some() && old == new;
    if let (true, Some(size), Some((png, words))) = (comparable, new, picture_contrast(&before.picture, &now.picture)?)
    {
        shots += &shot("difference", &words, &png, size, &frame);
    }
    let tools = if comparable { tools(name, !frame.is_empty()) } else { String::new() };
    Ok(format!("<figure class=\"viewer\" data-mode=\"side\">\n{tools}<div class=\"shots\">{shots}</div>\n</figure>\n"))
}

fn shot(class: &str, words: &str, png: &[u8], [width, height]: [u32; 2], frame: &str) -> String {
    format!(
        "<div class=\"shot {class}\"><div class=\"pixels\" style=\"--w:{width};--h:{height}\">\
         <img src=\"{}\" width=\"{width}\" height=\"{height}\" alt=\"{words}\">{frame}</div>\
         <p class=\"words\">{words}</p></div>\n",
        png_url(png)
    )
}

/// A box around the first block that differs, in fractions of the picture.
fn frame(first: &Difference, [width, height]: [u32; 2]) -> String {
    let Place::Block { pixels: [x, y], .. } = &first.place else { return String::new() };
    let percent = |pixels: u32, side: u32| f64::from(pixels) / f64::from(side) * 100.0;
    format!(
        "<i class=\"frame\" style=\"left:{:.3}%;top:{:.3}%;width:{:.3}%;height:{:.3}%\"></i>",
        percent(*x.start(), width),
        percent(*y.start(), height),
        percent(x.end() + 1 - x.start(), width),
        percent(y.end() + 1 - y.start(), height)
    )
}

fn tools(name: &str, framed: bool) -> String {
    let mut modes = String::new();
    for (index, (value, words)) in [
        ("side", "side by side"),
        ("swipe", "swipe"),
        ("blend", "blend"),
        ("toggle", "toggle"),
        ("difference", "difference"),
    ]
    .into_iter()
    .enumerate()
    {
        let checked = if index == 0 { " checked" } else { "" };
        let _ = write!(
            modes,
            "<label><input type=\"radio\" name=\"mode-{name}\" value=\"{value}\"{checked}> {words}</label>"
        );
    }
    let frame = if framed {
        "<label><input type=\"checkbox\" class=\"framing\" checked> frame the first block</label>"
    } else {
        ""
    };
    format!(
        "<div class=\"tools\" hidden>\n<fieldset class=\"modes\"><legend>show</legend>{modes}</fieldset>\n\
         <label class=\"at\"><span class=\"ends\">before</span> <input type=\"range\" min=\"0\" max=\"100\" value=\"50\" \
         aria-label=\"how far from before to now\"> <span class=\"ends\">now</span></label>\n\
         <button type=\"button\" class=\"swap\">show the other</button>\n\
         <span class=\"zoom\"><button type=\"button\" class=\"smaller\" aria-label=\"smaller\">−</button>\
         <output>4×</output><button type=\"button\" class=\"larger\" aria-label=\"larger\">+</button></span>\n{frame}\n\
         </div>\n"
    )
}
