//! The chapters in order: one list for the command line, the tests and the book, made of the folders beside this file.
#![allow(clippy::duplicate_mod, reason = "each chapter of a part is an example of its own with the part's model")]
#![allow(dead_code, reason = "each chapter is also an example with a main of its own")]

include!(concat!(env!("OUT_DIR"), "/chapters.rs"));
