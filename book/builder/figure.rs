//! Figures: a picture that pinhole made, its caption, and the command that makes it.

use crate::edit::escape;
use crate::live_figure::LiveFigure;
use crate::math;
use crate::program::Program;
use pulldown_cmark::{Event, Options, Parser};
use std::collections::BTreeMap;
use std::rc::Rc;

/// What a reader types before a command of pinhole.
pub const TYPED: &str = "cargo run --release --";

/// Pictures narrower than this are meant to show their pixels.
const SHOWS_PIXELS: u32 = 200;

/// How wide a picture that shows its pixels may grow.
const GROWN: u32 = 480;

/// The pictures of one build, by the name they will have under `figures/`.
#[derive(Debug, Default, Clone)]
pub struct Pictures {
    /// Each with its command.
    pub files: BTreeMap<String, (String, Rc<[u8]>)>,
    /// The drawings of the pages, which mdBook never sees: to read and write them once more takes it seconds.
    pub drawings: Vec<String>,
    /// Those whose values a reader of the served book moves, by the name that the page has for them.
    pub live: BTreeMap<String, LiveFigure>,
}

/// The block that stands for one figure directive.
pub fn block(
    program: &mut Program,
    pictures: &mut Pictures,
    command: &str,
    caption: &str,
    moves: &str,
) -> Result<String, String> {
    let spoken = escape(&plain(caption));
    let picture = if extension(command) == "svg" {
        let file = program.file(command, "svg")?;
        inline(&String::from_utf8_lossy(&file), &spoken, &stem_of(command))
            .map_err(|what| format!("`{command}` {what}"))?
    } else {
        let file = program.file(command, "png")?;
        let size = png_size(&file).ok_or_else(|| format!("`{command}` wrote a file that is no PNG."))?;
        image(&store(pictures, command, file), size, &spoken)
    };
    let caption = math::expand(caption)?;
    let mut live = String::new();
    if !moves.is_empty() {
        let figure = LiveFigure::read(program, command, moves)?;
        let name = format!("{}-{}", stem_of(command), pictures.live.len() + 1);
        live = format!(" data-live=\"{name}\"");
        pictures.live.insert(name, figure);
    }
    let made = typed(command);
    // Blank lines let markdown into the caption; the picture itself must hold none.
    Ok(format!(
        "\n<figure{live}>\n{picture}\n<figcaption>\n\n{caption}\n\n\
         <div class=\"made\">made by <code>{made}</code></div>\n</figcaption>\n</figure>\n"
    ))
}

/// A command as a reader types it; a line may break between its words, never inside `--size`.
pub fn typed(command: &str) -> String {
    let words = TYPED.split(' ').chain(command.split_whitespace());
    words.map(|word| format!("<span>{}</span>", escape(word))).collect::<Vec<_>>().join(" ")
}

/// What a command writes: a drawing, or a picture of pixels.
pub fn extension(command: &str) -> &'static str {
    let draws = ["figure", "report"].contains(&command.split_whitespace().next().unwrap_or_default());
    if draws || command.split_whitespace().any(|word| word == "--gallery") { "svg" } else { "png" }
}

/// The words of a caption, for those who hear the page.
fn plain(caption: &str) -> String {
    let events = Parser::new_ext(caption, Options::ENABLE_MATH);
    let words = events.filter_map(|event| match event {
        Event::Text(text) | Event::Code(text) | Event::InlineMath(text) | Event::DisplayMath(text) => Some(text),
        _ => None,
    });
    words.map(String::from).collect()
}

fn image(name: &str, (width, height): (u32, u32), spoken: &str) -> String {
    let pixels = if width < SHOWS_PIXELS {
        let grown = width * (GROWN / width.max(1)).max(1);
        format!(" class=\"pixels\" style=\"width: {grown}px\"")
    } else {
        String::new()
    };
    format!("<img src=\"figures/{name}\" width=\"{width}\" height=\"{height}\" alt=\"{spoken}\"{pixels}>")
}

/// A command as one word that can name a file.
fn stem_of(command: &str) -> String {
    let letter = |letter: char| {
        if letter.is_ascii_alphanumeric() || letter == '_' { letter } else { '-' }
    };
    let stem: String = command.chars().map(letter).collect();
    let words: Vec<&str> = stem.split('-').filter(|word| !word.is_empty()).collect();
    words.join("-")
}

/// Keeps a picture under a name that tells its command.
fn store(pictures: &mut Pictures, command: &str, file: Rc<[u8]>) -> String {
    let stem = stem_of(command);
    let mut name = format!("{stem}.png");
    let mut count = 1;
    // Two commands may come down to the same letters.
    while pictures.files.get(&name).is_some_and(|(other, _)| other != command) {
        count += 1;
        name = format!("{stem}-{count}.png");
    }
    pictures.files.insert(name.clone(), (command.to_owned(), file));
    name
}

/// Width and height as the header of a PNG states them.
pub fn png_size(file: &[u8]) -> Option<(u32, u32)> {
    let header = file.strip_prefix(b"\x89PNG\r\n\x1a\n")?;
    let number = |at: usize| Some(u32::from_be_bytes(header.get(at..at + 4)?.try_into().ok()?));
    (header.get(4..8)? == b"IHDR").then_some(())?;
    Some((number(8)?, number(12)?))
}

/// An SVG as part of the page, so that `currentColor` is the text's, as wide as the text allows and no wider than drawn.
fn inline(svg: &str, spoken: &str, stem: &str) -> Result<String, String> {
    let start = svg.find("<svg").ok_or("wrote a file that is no SVG.")?;
    let svg = svg[start..].trim_end();
    let end = svg.find('>').ok_or("wrote an SVG whose first tag does not end.")?;
    let (tag, rest) = svg.split_at(end);
    let view = attribute(tag, "viewBox").ok_or("wrote an SVG without a viewBox, which cannot be fitted to a page.")?;
    let width = attribute(tag, "width").and_then(|width| width.trim_end_matches("px").parse::<f64>().ok());
    let width = width.or_else(|| view.split([' ', ',']).filter_map(|number| number.parse().ok()).nth(2));
    let width = width.ok_or_else(|| format!("wrote an SVG with the viewBox `{view}`, which has no width."))?;
    let least = width * (LEGIBLE / smallest_letters(svg)).min(1.0);
    let kept = ["xmlns", "viewBox", "font-family", "font-size", "fill", "stroke", "stroke-width", "text-anchor"];
    let kept = kept.iter().filter_map(|name| Some(format!("{name}=\"{}\"", attribute(tag, name)?)));
    let kept: Vec<String> = kept.collect();
    let lines: Vec<&str> = rest.lines().filter(|line| !line.trim().is_empty()).collect();
    let style = format!("width: 100%; max-width: {width}px; --least: {least:.0}px; height: auto");
    let tag = format!("<svg {} role=\"img\" aria-label=\"{spoken}\" style=\"{style}\"", kept.join(" "));
    let drawing = without_command(&own_names(&lines.join("\n"), stem));
    Ok(format!("{DRAWING}{tag}{drawing}\n</div>"))
}

/// A page with a mark for each drawing.
pub fn with_drawings_apart(page: &str, pictures: &mut Pictures) -> String {
    let (mut out, mut rest) = (String::new(), page);
    while let Some((before, from)) = rest.split_once(DRAWING) {
        let Some((drawing, after)) = from.split_once("</svg>\n</div>") else { break };
        out += &format!("{before}<div class=\"drawing\"><!--{}--></div>", pictures.drawings.len());
        pictures.drawings.push(format!("{drawing}</svg>"));
        rest = after;
    }
    out + rest
}

/// A page as mdBook made it, its drawings in their places again.
pub fn with_drawings(page: &str, pictures: &Pictures) -> String {
    let (mut out, mut rest) = (String::new(), page);
    while let Some((before, from)) = rest.split_once("<div class=\"drawing\"><!--") {
        let mark = from.split_once("-->").and_then(|(number, after)| Some((number.parse::<usize>().ok()?, after)));
        let drawing = mark.and_then(|(number, after)| Some((pictures.drawings.get(number)?, after)));
        let Some((drawing, after)) = drawing else { break };
        out += &format!("{before}{DRAWING}{drawing}\n");
        rest = after;
    }
    out + rest
}

/// How a drawing begins on a page.
const DRAWING: &str = "<div class=\"drawing\">\n";

/// The height in pixels that letters of a drawing keep in a narrow window, which then shows a part of it at a time.
const LEGIBLE: f64 = 9.1;

/// The height of the smallest letters in a drawing.
fn smallest_letters(svg: &str) -> f64 {
    let sizes = svg.split("font-size=\"").skip(1).filter_map(|rest| rest.split('"').next());
    sizes.filter_map(|size| size.trim_end_matches("px").parse::<f64>().ok()).fold(f64::INFINITY, f64::min)
}

/// A drawing whose foot does not tell the command that the page has below it.
fn without_command(svg: &str) -> String {
    let Some((before, after)) = svg.split_once(TYPED) else { return svg.to_owned() };
    let rest = after.find('<').map_or("", |end| &after[end..]);
    format!("{}{rest}", before.trim_end().trim_end_matches('·').trim_end())
}

/// Two drawings on one page must not answer to each other's ids.
fn own_names(svg: &str, stem: &str) -> String {
    [" id=\"", "url(#", "href=\"#"]
        .iter()
        .fold(svg.to_owned(), |svg, mark| svg.replace(mark, &format!("{mark}{stem}-")))
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = tag.split_once(&format!(" {name}=\""))?;
    rest.split_once('"').map(|(value, _)| value)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PNG: &[u8] = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x60\0\0\0\x36";
    const SVG: &str = "<?xml version=\"1.0\"?>\n<svg xmlns=\"s\" width=\"300\" height=\"9\" viewBox=\"0 0 300 9\">\n\n<g id=\"a\" fill=\"url(#a)\"/>\n</svg>\n";

    fn program(svg: &'static str) -> Rc<std::cell::RefCell<Program>> {
        Program::with(move |words, _| {
            let path = words.last().cloned().unwrap_or_default();
            let bytes = if path.ends_with(".svg") { svg.as_bytes() } else { PNG };
            std::fs::write(path, bytes).map_err(|error| error.to_string())
        })
    }

    #[test]
    fn a_picture_has_its_size_and_its_command() {
        let mut pictures = Pictures::default();
        let program = program(SVG);
        let block = block(&mut program.borrow_mut(), &mut pictures, "render 05_x --size 96x54", "A *box* of `a<b`", "");
        let block = block.expect("a figure");
        let image = "<img src=\"figures/render-05_x-size-96x54.png\" width=\"96\" height=\"54\" \
                     alt=\"A box of a&lt;b\" class=\"pixels\" style=\"width: 480px\">";
        assert!(block.contains(image), "{block}");
        assert!(block.contains("<span>--size</span> <span>96x54</span></code></div>"), "{block}");
        assert!(pictures.files.contains_key("render-05_x-size-96x54.png"));
    }

    #[test]
    fn a_drawing_is_inlined_and_fluid() {
        let program = program(SVG);
        let block = block(&mut program.borrow_mut(), &mut Pictures::default(), "figure 05_x", "It", "");
        let expected = "<figure>\n<div class=\"drawing\">\n<svg xmlns=\"s\" viewBox=\"0 0 300 9\" role=\"img\" aria-label=\"It\" \
                        style=\"width: 100%; max-width: 300px; --least: 0px; height: auto\">\n<g id=\"figure-05_x-a\" fill=\"url(#figure-05_x-a)\"/>\n</svg>\n</div>\n<figcaption>";
        assert!(block.as_ref().is_ok_and(|block| block.contains(expected)), "{block:?}");
    }

    #[test]
    fn a_drawing_stays_legible_and_the_command_stands_once() {
        let text = "<svg viewBox=\"0 0 300 9\"><text font-size=\"13\">x</text>\
                    <text font-size=\"18.2px\">a scene · cargo run --release -- figure 05_x --at 1</text></svg>";
        let drawing = inline(text, "It", "x").expect("a drawing");
        assert!(drawing.contains("--least: 210px") && drawing.contains(">a scene</text></svg>"), "{drawing}");
    }

    #[test]
    fn a_drawing_without_a_view_box_is_refused() {
        let program = program("<svg width=\"3\"></svg>");
        let told =
            block(&mut program.borrow_mut(), &mut Pictures::default(), "figure 05_x", "It", "").expect_err("refused");
        assert_eq!(told, "`figure 05_x` wrote an SVG without a viewBox, which cannot be fitted to a page.");
    }

    #[test]
    fn drawings_come_back_to_their_places() {
        let mut pictures = Pictures::default();
        let page = ["one", "two"].map(|text| format!("a\n{DRAWING}<svg>{text}</svg>\n</div>\nb")).concat();
        let apart = with_drawings_apart(&page, &mut pictures);
        assert!(!apart.contains("svg") && pictures.drawings == ["<svg>one</svg>", "<svg>two</svg>"], "{apart}");
        assert_eq!(with_drawings(&apart, &pictures), page);
        assert_eq!(with_drawings(&[&apart, &apart[..]].concat(), &pictures), [&page, &page[..]].concat());
    }

    #[test]
    fn names_do_not_collide() {
        let mut pictures = Pictures::default();
        let bytes: Rc<[u8]> = Rc::from(PNG);
        assert_eq!(store(&mut pictures, "render a --b", Rc::clone(&bytes)), "render-a-b.png");
        assert_eq!(store(&mut pictures, "render a -b", Rc::clone(&bytes)), "render-a-b-2.png");
        assert_eq!(store(&mut pictures, "render a --b", bytes), "render-a-b.png");
    }
}
