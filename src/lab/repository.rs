use std::path::Path;

/// The folder of the sources that the laboratory was built from: its reports, costs and snapshots are kept there.
pub fn repository() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().nth(2).unwrap_or(package)
}
