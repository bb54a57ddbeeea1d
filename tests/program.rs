//! What the program must hold: its command lines, its files, its long renders.

#![allow(clippy::disallowed_methods, reason = "what a test expects may come from the platform's functions")]

mod bad_input;
mod command_line;
mod compare;
mod first_day;
mod long_renders;
mod methods;
mod report_command;
mod scene_files;
mod scenes;
mod view;
