//! The chapters in order: one list for the command line, the tests and the book, made of the folders beside this file.
#![allow(dead_code, reason = "each chapter is also an example with a main of its own")]

include!(concat!(env!("OUT_DIR"), "/chapters.rs"));
