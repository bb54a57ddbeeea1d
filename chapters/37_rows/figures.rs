//! The figures of chapter 37, from what was measured and from the series themselves.

use pinhole_lab::figure::{Figure, curves, series};

/// What the page shows, in its order.
pub fn figures(chapter: &'static str) -> Vec<Figure> {
    vec![
        Figure {
            name: "37_terms",
            chapter,
            about: "the error of sine and cosine by their series over the number of terms, near 0 and over a full turn",
            draw: series::draw,
        },
        Figure {
            name: "37_rows",
            chapter,
            about: "the time of a row over the number of rows, row by row, in columns and fused",
            draw: curves::draw_rows,
        },
    ]
}
