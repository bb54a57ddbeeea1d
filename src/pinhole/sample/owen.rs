// ANCHOR: owen_scrambled
/// Owen scrambling of a fraction whose bits are reversed, so that the first digit is lowest: each digit is flipped or
/// not by a hash of the digits before it.
///
/// Thus the halves of the interval are swapped or not, then the quarters within each half, and so on (Owen 1995), which
/// preserves the stratification of a point set.
/// In each step a bit depends on itself and on lower bits only, as in Laine and Karras (2011); the constants are
/// Vegdahl's (2021).
#[inline(always)]
pub fn owen_scrambled(reversed: u32, seed: u32) -> u32 {
    let mut x = reversed;
    x ^= x.wrapping_mul(0x3D20_ADEA);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6C56);
    x ^= x.wrapping_mul(0x53A2_2864);
    x
}
// ANCHOR_END: owen_scrambled

#[cfg(test)]
mod tests {
    use super::super::hash::mixed;
    use super::*;

    /// A digit may depend on itself and on those before it only; and fractions that differ in a digit must still differ
    /// in it.
    #[test]
    fn digits_depend_on_earlier_digits_only() {
        let mut tried = 0;
        for trial in 0..2000_u64 {
            let [x, seed] = [mixed(trial) as u32, mixed(trial ^ 1 << 40) as u32];
            for bit in 0..32 {
                let changed = owen_scrambled(x, seed) ^ owen_scrambled(x ^ 1 << bit, seed);
                assert_eq!(changed & ((1_u32 << bit) - 1), 0, "an earlier digit changed");
                assert_eq!(changed >> bit & 1, 1, "the digit itself did not change");
                tried += 1;
            }
        }
        eprintln!("scramble: {tried} digits flipped, none changed an earlier one");
    }

    /// Over all seeds every digit is flipped half of the time, whatever the digits before it.
    #[test]
    fn every_digit_is_flipped_half_of_the_time() {
        const SEEDS: u32 = 20_000;
        let mut worst = 0.0_f64;
        for x in [0_u32, 1, 2, 3, 0x5555_5555, 0xDEAD_BEEF, u32::MAX] {
            let mut flipped = [0_u32; 32];
            for trial in 0..SEEDS {
                let changed = owen_scrambled(x, mixed(u64::from(trial)) as u32) ^ x;
                flipped.iter_mut().enumerate().for_each(|(bit, flipped)| *flipped += changed >> bit & 1);
            }
            for flipped in flipped {
                worst = worst.max((f64::from(flipped) / f64::from(SEEDS) - 0.5).abs());
            }
        }
        let limit = 4.5 * 0.5 / f64::from(SEEDS).sqrt();
        eprintln!("scramble: 7 fractions × 32 digits × {SEEDS} seeds, worst {worst:.4} from 1/2, limit {limit:.4}");
        assert!(worst < limit);
    }
}
