use super::Purpose;

/// A number from 0 to below 1 with 24 bits, the same whenever it is asked for with the same arguments.
///
/// The finaliser of splitmix64 (Steele, Lea, Flood 2014), once for each argument.
#[inline(always)]
pub fn uniform(seed: u64, pixel: [u32; 2], sample: u32, purpose: Purpose) -> f64 {
    let pixel = u64::from(pixel[0]) | u64::from(pixel[1]) << 32;
    let address = u64::from(sample) | (purpose as u64) << 32;
    let bits = mixed(mixed(mixed(seed) ^ pixel) ^ address);
    (bits >> 40) as f64 * (1.0 / (1_u64 << 24) as f64)
}

#[inline(always)]
fn mixed(bits: u64) -> u64 {
    let mut z = bits.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
