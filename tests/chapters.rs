//! Every chapter against its snapshots: what it computes, stage by stage, is what it computed when they were kept.
//!
//! One chapter: `cargo test --test chapters 05`.
//! What they compute otherwise now waits beside what is kept: `cargo run -- review` shows it, and
//! `cargo run -- review accept all` keeps it.

#![allow(clippy::disallowed_methods, reason = "what a test expects may come from the platform's functions")]

#[path = "chapters/files.rs"]
mod files;
#[path = "chapters/message.rs"]
mod message;
#[path = "chapters/mutation.rs"]
mod mutation;
#[path = "chapters/png_pixels.rs"]
mod png_pixels;
#[path = "chapters/snapshots.rs"]
mod snapshots;
#[path = "chapters/waiting.rs"]
mod waiting;

/// A test for each chapter, named `chapter_` and its stem.
macro_rules! test_chapters {
    ($($chapter:ident)+) => {
        $(#[test]
        fn $chapter() -> Result<(), message::Mismatch> {
            snapshots::check(&chapters::$chapter::chapter())
        })+
    };
}

chapters::for_each_chapter!(test_chapters);

#[test]
fn every_snapshot_file_is_there_and_none_is_unused() -> Result<(), message::Mismatch> {
    let names: Vec<&str> = chapters::all().iter().map(|chapter| chapter.name).collect();
    files::check(&names)
}
