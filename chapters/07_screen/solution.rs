//! A solution of the exercise of chapter 07; look here when you have done yours.

pub fn ndc_from_screen(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
    let aspect = f64::from(width) / f64::from(height);
    [(screen[0] / aspect + 1.0) / 2.0, (1.0 - screen[1]) / 2.0]
}
