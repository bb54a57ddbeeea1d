//! What the book, its figures, its numbers and its exercises must hold.

#![allow(clippy::disallowed_methods, reason = "what a test expects may come from the platform's functions")]

// What takes longest begins first, and tests begin in the order of their names.
#[path = "yours.rs"]
mod a_program_of_yours;
mod book;
mod book_numbers;
mod conventions;
mod conventions_lens;
mod costs;
mod curves;
mod entity_per_ray;
mod exercises;
mod extremes;
mod figures;
mod naive;
mod report;
mod reports;
