//! A solution of the exercise of chapter 06; look here when you have done yours.

pub fn pixel_from_ndc(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let along = |n: f64, size: u32| (0.0..1.0).contains(&n).then(|| (n * f64::from(size)) as u32);
    Some([along(ndc[0], width)?, along(ndc[1], height)?])
}
