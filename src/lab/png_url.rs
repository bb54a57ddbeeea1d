use base64::Engine;
use base64::prelude::BASE64_STANDARD;

/// A data URL of a PNG, for self-contained pages and drawings.
pub fn png_url(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", BASE64_STANDARD.encode(png))
}
