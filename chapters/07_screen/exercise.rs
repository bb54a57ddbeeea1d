//! The exercise of chapter 07; `cargo run --release -- check 7` compares it with pinhole's.

// ANCHOR: ndc_from_screen
/// The NDC point of a screen point: `screen_from_ndc` undone, for an image of this many pixels.
///
/// The screen has its centre at the origin, x to the right, y up; it reaches from −1 to 1 in height and from −aspect to
/// aspect in width, aspect = width / height. NDC has (0, 0) at the top left corner and (1, 1) at the bottom right one.
/// A point outside the image has its NDC too. Each part may be off by 1e-15.
pub fn ndc_from_screen(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    // Yours to write: put your own lines for the two below.
    let _ = (screen, width, height);
    [-1.0; 2]
}
// ANCHOR_END: ndc_from_screen
