//! What the book, its figures, its numbers and its exercises must hold.

#![allow(clippy::disallowed_methods, reason = "what a test expects may come from the platform's functions")]

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
mod yours;
