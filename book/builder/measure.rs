//! How much of each page is prose, how much is printed, what is folded, and how long it takes: `cargo run -p book -- --measure`.

use crate::build::Book;
use crate::check::pattern::Measure;
use crate::check::work::Work;
use crate::check::{self, Page};
use crate::page;
use crate::program::Program;
use std::cell::RefCell;
use std::fmt::Write as _;
use std::io::Write;
use std::rc::Rc;

/// Writes a table with a row for each page.
///
/// Errors: a page that cannot be read, or a page with more monospaced lines than lines of prose before anything is
/// unfolded.
pub fn measure(book: &Book, program: &Rc<RefCell<Program>>, out: &mut dyn Write) -> Result<(), String> {
    let pages = check::read_pages(&book.pages).map_err(|problem| problem.to_string())?;
    program.borrow_mut().ask_for(&pages);
    let mut table = String::from(
        "page                          words  monospaced  of prose   folded: words  monospaced   minutes: read  write  do\n",
    );
    let mut worse = Vec::new();
    for page in pages.iter().filter(|page| page.name != "SUMMARY.md") {
        let own = of_page(page, &mut program.borrow_mut());
        let [words, folded_words] = own.words;
        let [monospaced, folded] = own.monospaced;
        let work = Work::of(page);
        let (reading, writing, exercises) = (work.reading, work.writing(), work.exercises);
        let (name, lines) = (&page.name, own.lines());
        let _ = writeln!(
            table,
            "{name:28}  {words:>5}  {monospaced:>10}  {lines:>8}  {folded_words:>14}  {folded:>10}  {reading:>14}  {writing:>5}  {exercises:>3}"
        );
        if page.name.starts_with(|first: char| first.is_ascii_digit()) && monospaced >= lines {
            worse.push(name.as_str());
        }
    }
    let _ = out.write_all(table.as_bytes());
    match worse.as_slice() {
        [] => Ok(()),
        pages => Err(format!("more monospaced lines than lines of prose: {}; fold some of them.", pages.join(", "))),
    }
}

fn of_page(page: &Page, program: &mut Program) -> Measure {
    Measure::of(page, |command| program.text(command).map_or(0, |text| page::fitted(command, &text).0.lines().count()))
}
