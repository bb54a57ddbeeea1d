//! A figure whose values a reader of the served book moves: what a page declares, and what may be asked.

use crate::check::movement::{self, Movement};
use crate::program::Program;
use percent_encoding::percent_decode_str;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// The longest question, in bytes.
const LONGEST: usize = 1000;

/// Where the samples of a pixel stand in a scene.
const SAMPLES: &str = "camera.sampling.samples";

/// What a page declares, as the build writes it for the server and for the page's script.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LiveFigure {
    command: String,
    scene: String,
    size: Option<String>,
    view: Option<String>,
    /// The samples of the command, or else of the scene itself.
    samples: u32,
    /// Whether they are those of the command.
    are_fewer: bool,
    moves: Vec<Movement>,
}

impl LiveFigure {
    /// The figure of a command `render CHAPTER`, with the values that the chapter's scene has.
    ///
    /// Errors: another command, or movements of what the scene has not.
    pub fn read(program: &mut Program, command: &str, moves: &str) -> Result<Self, String> {
        let mut words = command.split_whitespace().skip(1);
        let scene = words.next().unwrap_or_default().to_owned();
        let (mut size, mut view, mut asked) = (None, None, None);
        while let Some(word) = words.next() {
            match word {
                "--size" => size = words.next().map(str::to_owned),
                "--view" => view = words.next().map(str::to_owned),
                "--samples" => asked = words.next().and_then(|count| count.parse().ok()),
                _ => {
                    let only = "but a figure that moves has only --size, --view and --samples";
                    return Err(format!("`{command}` has {word}, {only}."));
                }
            }
        }
        let moves = movement::read(moves)?;
        if asked.is_some() && moves.iter().any(|movement| movement.path == SAMPLES) {
            return Err(format!("`{command}` has --samples, which its reader moves."));
        }
        let paths = moves.iter().map(|movement| movement.path.as_str()).chain([SAMPLES]);
        let values = program.values(&scene, &paths.collect::<Vec<_>>())?;
        let mut starts = values.lines();
        let moves = moves.into_iter().map(|movement| movement.starting(starts.next().unwrap_or_default()));
        let moves = moves.collect::<Result<_, _>>()?;
        let own = starts.next().and_then(|count| count.parse().ok()).unwrap_or(1);
        let (samples, are_fewer) = (asked.unwrap_or(own), asked.is_some());
        Ok(Self { command: command.to_owned(), scene, size, view, samples, are_fewer, moves })
    }

    /// What `pinhole live` is told for `samples=4&value=…&value=…`, a value for each movement in their order.
    ///
    /// Errors: one sentence about what is not accepted.
    pub fn order(&self, number: u64, query: &str) -> Result<Value, String> {
        let samples = named(query, "samples").next().and_then(|count| count.parse::<u32>().ok());
        let samples = samples.filter(|count| *count > 0).ok_or("samples is a whole number from 1 on.")?;
        let values: Vec<String> = named(query, "value").collect();
        if values.len() != self.moves.len() {
            return Err(format!("this figure has {} values, but {} were given.", self.moves.len(), values.len()));
        }
        let settings = self.moves.iter().zip(&values).map(|(movement, value)| movement.setting(value));
        let mut set: Vec<String> = settings.filter_map(Result::transpose).collect::<Result<_, _>>()?;
        if self.are_fewer {
            set.push(format!("{SAMPLES}={}", self.samples));
        }
        let Self { scene, size, view, .. } = self;
        Ok(json!({ "number": number, "scene": scene, "set": set, "size": size, "view": view, "samples": samples }))
    }
}

/// The values of this name in a query.
pub fn named<'a>(query: &'a str, name: &'a str) -> impl Iterator<Item = String> + 'a {
    let pairs = query.split('&').filter_map(|pair| pair.split_once('='));
    let values = pairs.filter(move |(key, _)| *key == name && query.len() <= LONGEST);
    values.map(|(_, value)| percent_decode_str(value).decode_utf8_lossy().into_owned())
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// A figure of two movements.
    pub fn figure() -> LiveFigure {
        let program = Program::with(|words, out| {
            assert_eq!(words[..2], ["live", "08_x"]);
            let values = words.iter().filter(|word| word.contains('.'));
            let texts = values.map(|path| if path.ends_with("fov") { "60.0" } else { "16" });
            texts.into_iter().try_for_each(|text| writeln!(out, "{text}")).map_err(|error| error.to_string())
        });
        let moves = "field of view: camera.lens.fov from 5 to 170°; samples: camera.sampling.samples log from 1 to 64";
        LiveFigure::read(&mut program.borrow_mut(), "render 08_x --size 96x54", moves).expect("a figure")
    }

    #[test]
    fn an_order_holds_what_the_page_declares_and_the_reader_moved() {
        let order = figure().order(7, "figure=f&samples=4&value=62&value=16");
        let expected = json!({
            "number": 7, "scene": "08_x", "set": ["camera.lens.fov=62"], "size": "96x54", "view": null, "samples": 4
        });
        assert_eq!(order, Ok(expected));
        let order = figure().order(7, "samples=1&value=6%32&value=8").expect("an order");
        assert_eq!(order["set"], json!(["camera.lens.fov=62", "camera.sampling.samples=8"]));
    }

    #[test]
    fn fewer_samples_are_those_of_the_command() {
        let read = |moves: &str| {
            let program = Program::with(|_, out| writeln!(out, "60.0\n64").map_err(|error| error.to_string()));
            LiveFigure::read(&mut program.borrow_mut(), "render 08_x --samples 16", moves)
        };
        let figure = read("field of view: camera.lens.fov from 5 to 170°").expect("a figure");
        assert_eq!(figure.samples, 16);
        let order = figure.order(7, "samples=1&value=62").expect("an order");
        assert_eq!(order["set"], json!(["camera.lens.fov=62", "camera.sampling.samples=16"]));
        let told = read("samples: camera.sampling.samples log from 1 to 64").expect_err("refused");
        assert_eq!(told, "`render 08_x --samples 16` has --samples, which its reader moves.");
    }

    #[test]
    fn anything_else_is_refused_in_a_sentence() {
        let long = format!("samples=1&value=62&value={}", "1".repeat(LONGEST));
        for query in [
            "",
            "samples=0&value=62&value=8",
            "samples=4294967296&value=62&value=8",
            "samples=1&value=62",
            "samples=1&value=62&value=8&value=8",
            "samples=1&value=1000&value=8",
            "samples=1&value=62,%20axis:Larger&value=8",
            "samples=1&value=62&value=8.5",
            "samples=1&value=%ff&value=8",
            &long,
        ] {
            assert!(figure().order(7, query).is_err_and(|told| told.ends_with('.')), "{query}");
        }
    }
}
