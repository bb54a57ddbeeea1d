// ANCHOR: owen_scrambled
/// Scrambles a fraction whose bits stand in reverse, the first digit lowest: every digit is turned over or not by what
/// looks like a coin for the digits before it.
///
/// So halves change places, then quarters within each half, and so on (Owen 1995): a set of points that has one point in
/// each box of a grid keeps that.
/// Each step here lets a bit depend on itself and on lower ones only, as Laine and Karras (2011) do; the constants are
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

    /// A digit may depend on itself and on those before it, and on nothing else; and it must keep its own difference.
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
        eprintln!("scramble: {tried} digits turned over, none changed an earlier one");
    }

    /// Over seeds every digit is turned over half of the time, whatever the digits before it are.
    #[test]
    fn every_digit_is_turned_over_half_of_the_time() {
        const SEEDS: u32 = 20_000;
        let mut worst = 0.0_f64;
        for x in [0_u32, 1, 2, 3, 0x5555_5555, 0xDEAD_BEEF, u32::MAX] {
            let mut turned = [0_u32; 32];
            for trial in 0..SEEDS {
                let changed = owen_scrambled(x, mixed(u64::from(trial)) as u32) ^ x;
                turned.iter_mut().enumerate().for_each(|(bit, turned)| *turned += changed >> bit & 1);
            }
            for turned in turned {
                worst = worst.max((f64::from(turned) / f64::from(SEEDS) - 0.5).abs());
            }
        }
        let limit = 4.5 * 0.5 / f64::from(SEEDS).sqrt();
        eprintln!("scramble: 7 fractions × 32 digits × {SEEDS} seeds, worst {worst:.4} from 1/2, limit {limit:.4}");
        assert!(worst < limit);
    }
}
