//! The command line of pinhole.
fn main() {}
