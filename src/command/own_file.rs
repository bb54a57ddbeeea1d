use pinhole::film::{Replaces, check_place, marked, write_whole};
use std::borrow::Cow;
use std::io::Write;
use std::path::Path;

/// Checks that a file can be written, before what it is to hold is computed.
///
/// Errors: as for [`write_file`].
pub fn check_file(named: bool, file: &Path) -> pinhole::Result {
    check_place(Replaces::if_named(named).at(file))
}

/// Writes a file as it is where the reader has named it, and otherwise with the mark by which it may be replaced the next
/// time.
///
/// Errors: as for [`write_whole`].
pub fn write_file(named: bool, file: &Path, bytes: &[u8]) -> pinhole::Result {
    let bytes = if named { Cow::Borrowed(bytes) } else { marked(bytes) };
    write_whole(Replaces::if_named(named).at(file), |out| out.write_all(&bytes))
}
