//! The book's live figures: orders of a program, one a line of JSON, each answered by a picture or a sentence.

use super::arguments::LiveFigures;
use super::chapter_text::ChapterText;
use super::error::{Error, Result};
use super::find;
use super::options::size;
use pinhole::render::Watch;
use pinhole::{Chapter, Overrides};
use pinhole_live::LiveFigure;
use serde::Deserialize;
use std::collections::VecDeque;
use std::io::{BufRead, Write, stdin};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// The figures whose workers are kept; that which was unused longest goes.
const MAX_FIGURES: usize = 2;

/// A frame that is asked for.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Order {
    number: u64,
    scene: String,
    #[serde(default)]
    set: Vec<String>,
    size: Option<String>,
    view: Option<String>,
    samples: u32,
}

impl Order {
    /// Whether both orders are for one figure, in which the newer counts.
    fn is_of(&self, other: &Self) -> bool {
        self.scene == other.scene && self.size == other.size && self.view == other.view
    }
}

/// What is asked for and not answered yet.
#[derive(Default)]
struct Queue {
    orders: VecDeque<Order>,
    rendering: bool,
    ended: bool,
}

#[derive(Default)]
struct Orders {
    queue: Mutex<Queue>,
    arrived: Condvar,
    stop: Arc<AtomicBool>,
}

/// Stops a frame for a newer order.
struct UntilNewer<'a>(&'a Orders);

impl Watch for UntilNewer<'_> {
    fn stopped(&self) -> bool {
        self.0.stop.load(Ordering::SeqCst)
    }

    fn stop_flag(&self) -> Option<Arc<AtomicBool>> {
        Some(Arc::clone(&self.0.stop))
    }
}

impl Orders {
    fn queue(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Reads orders to the end of standard input, which ends the program.
    fn read(&self) {
        for line in stdin().lock().lines().map_while(std::result::Result::ok) {
            let Ok(order) = serde_json::from_str::<Order>(&line) else { continue };
            let mut queue = self.queue();
            // Whoever asked before has moved on, or looks at another figure now.
            self.stop.store(queue.rendering, Ordering::SeqCst);
            queue.orders.push_back(order);
            self.arrived.notify_one();
        }
        self.queue().ended = true;
        self.stop.store(true, Ordering::SeqCst);
        self.arrived.notify_one();
    }

    /// The next order, and the numbers of those of the same figure that a newer one has made needless.
    fn next(&self) -> Option<(Order, Vec<u64>)> {
        let mut queue = self.queue();
        queue.rendering = false;
        while queue.orders.is_empty() && !queue.ended {
            queue = self.arrived.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
        if queue.ended {
            return None;
        }
        let first = queue.orders.pop_front()?;
        let (mut same, others): (Vec<Order>, Vec<Order>) =
            queue.orders.drain(..).partition(|order| order.is_of(&first));
        queue.orders.extend(others);
        same.insert(0, first);
        let newest = same.pop()?;
        queue.rendering = true;
        self.stop.store(false, Ordering::SeqCst);
        Some((newest, same.iter().map(|order| order.number).collect()))
    }
}

/// A chapter's text, and the render of what was last ordered of it.
struct Figure {
    text: ChapterText,
    last: Order,
    /// Whether that render has begun.
    begun: bool,
    frames: LiveFigure,
}

impl Figure {
    fn frame(&mut self, order: &Order, watch: &dyn Watch) -> Result<Option<Vec<u8>>> {
        if !self.begun || self.last.set != order.set {
            let size = order.size.as_deref().map(size).transpose().map_err(Error::CommandLine)?;
            let chapter = self.text.set(&order.set)?;
            let world = chapter.world(&Overrides { size, view: order.view.clone(), ..Overrides::default() });
            self.frames.show(world, chapter.stages());
            (self.last, self.begun) = (order.clone(), true);
        }
        Ok(self.frames.png(order.samples, watch)?)
    }
}

/// Answers orders until the end of standard input: `NUMBER png LENGTH` and a PNG, `NUMBER error LENGTH` and a sentence, or
/// `NUMBER newer 0` where a newer order has come meanwhile.
///
/// Errors: a value that is to be printed is not there, or standard output is closed.
pub fn live(chapters: &[Chapter], asked: &LiveFigures, out: &mut dyn Write) -> Result {
    if let Some(chapter) = &asked.chapter {
        let text = ChapterText::of(find::chapter(chapters, chapter)?)?;
        return asked.value.iter().try_for_each(|path| Ok(writeln!(out, "{}", text.value(path)?)?));
    }
    let orders = Arc::new(Orders::default());
    let reader = Arc::clone(&orders);
    std::thread::spawn(move || reader.read());
    let mut figures = VecDeque::new();
    while let Some((order, older)) = orders.next() {
        for number in older {
            answer(number, "newer", &[], out)?;
        }
        match frame(chapters, &mut figures, &order, &UntilNewer(&orders)) {
            Ok(Some(png)) => answer(order.number, "png", &png, out)?,
            Ok(None) => answer(order.number, "newer", &[], out)?,
            Err(error) => answer(order.number, "error", error.to_string().as_bytes(), out)?,
        }
    }
    Ok(())
}

fn frame(
    chapters: &[Chapter],
    figures: &mut VecDeque<Figure>,
    order: &Order,
    watch: &dyn Watch,
) -> Result<Option<Vec<u8>>> {
    let known = figures.iter().position(|figure| figure.last.is_of(order)).and_then(|at| figures.remove(at));
    let mut figure = match known {
        Some(figure) => figure,
        None => {
            figures.truncate(MAX_FIGURES - 1);
            let text = ChapterText::of(find::chapter(chapters, &order.scene)?)?;
            Figure { text, last: order.clone(), begun: false, frames: LiveFigure::default() }
        }
    };
    let frame = figure.frame(order, watch);
    figures.push_front(figure);
    frame
}

fn answer(number: u64, kind: &str, body: &[u8], out: &mut dyn Write) -> Result {
    writeln!(out, "{number} {kind} {}", body.len())?;
    out.write_all(body)?;
    Ok(out.flush()?)
}
