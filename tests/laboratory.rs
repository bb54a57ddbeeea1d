//! What the book, its figures, its numbers and its exercises must hold.

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
mod mutations;
mod naive;
mod report;
mod reports;
