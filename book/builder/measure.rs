//! How much of each page is prose, how much is printed, and what is folded: `cargo run -p book -- --measure`.

use crate::build::Book;
use crate::check::pattern::Measure;
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
        "page                          words  minutes  monospaced  of prose   folded: words  monospaced\n",
    );
    let mut worse = Vec::new();
    for page in pages.iter().filter(|page| page.name != "SUMMARY.md") {
        let own = of_page(page, &mut program.borrow_mut());
        let [words, folded_words] = own.words;
        let [monospaced, folded] = own.monospaced;
        let (name, minutes, lines) = (&page.name, own.minutes(), own.lines());
        let _ = writeln!(
            table,
            "{name:28}  {words:>5}  {minutes:>7}  {monospaced:>10}  {lines:>8}  {folded_words:>14}  {folded:>10}"
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
