use super::panics::heard;
use super::question::Question;
use super::shown::Shown;
use pinhole::rays::{Paths, PixelSamples, Tile};
use std::sync::{Arc, OnceLock};

/// What a render has to say against a reader's function; empty while all is well.
pub type Complaint = Arc<OnceLock<String>>;

/// What a tile has of [`RowPlaces`].
pub type RowPlace<'w> = (&'w Tile, Option<&'w PixelSamples>, Option<&'w Paths>);

/// Asks a reader's function in the midst of a render, up to the first answer that no picture can hold.
pub struct Ask<I, A> {
    function: &'static str,
    question: fn() -> Question<I, A>,
    written: Arc<dyn Fn(&I) -> A + Send + Sync>,
    complaint: Complaint,
}

impl<I, A> Clone for Ask<I, A> {
    fn clone(&self) -> Self {
        Self { written: Arc::clone(&self.written), complaint: Arc::clone(&self.complaint), ..*self }
    }
}

impl<I: Clone + 'static, A: Shown + 'static> Ask<I, A> {
    /// Nothing asked yet.
    pub fn new(
        function: &'static str,
        question: fn() -> Question<I, A>,
        written: Arc<dyn Fn(&I) -> A + Send + Sync>,
    ) -> Self {
        Self { function, question, written, complaint: Complaint::default() }
    }

    /// Where it is told what went wrong.
    pub fn complaint(&self) -> Complaint {
        Arc::clone(&self.complaint)
    }

    /// The function's answer for a row; none once it has panicked, or answered what is not a finite number.
    pub fn at(&self, place: RowPlace<'_>, row: usize, input: I) -> Option<A> {
        self.answer(input, pixel_of(place, row))
    }

    /// The same where no row of a pixel asks.
    pub fn once(&self, input: I) -> Option<A> {
        self.answer(input, None)
    }

    fn answer(&self, input: I, pixel: Option<[u32; 2]>) -> Option<A> {
        if self.complaint.get().is_some() {
            return None;
        }
        let (asked, of_panic) = (self.clone(), input.clone());
        let answer = heard(
            || (self.written)(&input),
            move |words| asked.complain(format!("panicked {}: {words}", asked.place(&of_panic, pixel))),
        )?;
        // A picture's numbers are f32 in the end.
        if answer.numbers().iter().all(|number| (*number as f32).is_finite()) {
            return Some(answer);
        }
        self.complain(format!("gave {} {}: no picture can hold that", answer.shown(), self.place(&input, pixel)));
        None
    }

    /// Which pixel asks what.
    fn place(&self, input: &I, pixel: Option<[u32; 2]>) -> String {
        let pixel = pixel.map_or_else(String::new, |[x, y]| format!("at pixel ({x}, {y}), "));
        format!("{pixel}asked {}", (self.question)().tell_on_one_line(input))
    }

    /// Says what is wrong with the function, unless something else was said before; gives what was said first.
    pub fn complain(&self, what: String) -> String {
        self.complaint.get_or_init(|| format!("{} {what}", self.function)).clone()
    }
}

/// The columns that tell which pixel a row belongs to.
pub type RowPlaces = (&'static Tile, Option<&'static PixelSamples>, Option<&'static Paths>);

/// The pixel of a row.
fn pixel_of((tile, samples, paths): RowPlace<'_>, row: usize) -> Option<[u32; 2]> {
    let first = paths.map_or(Some(row), |paths| paths.first.get(row).map(|&first| first as usize))?;
    let pixel = samples.map_or(Some(first), |samples| samples.pixel.get(first).map(|&pixel| pixel as usize))?;
    (pixel < tile.width as usize * tile.height as usize).then(|| tile.pixel_of(pixel))
}
