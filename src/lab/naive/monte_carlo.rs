//! Monte Carlo by program: two small ones, which a reader types, runs and changes.
//!
//! The page on Monte Carlo includes them; the test below compiles and runs each, and compares what it prints with what its
//! last lines say.
#![allow(dead_code, reason = "each is a program of its own, for a reader and for the test")]
#![allow(clippy::print_stdout, reason = "what a reader's program says")]

// ANCHOR: random
/// A random number from 0 up to 1, by splitmix64: a counter, well stirred.
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut bits = *state;
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}
// ANCHOR_END: random

mod pi {
    use super::random;

    // ANCHOR: pi
    fn main() {
        let (mut state, mut inside) = (4, 0);
        for n in 1..=1_000_000 {
            let (x, y) = (random(&mut state), random(&mut state));
            if x * x + y * y < 1.0 {
                inside += 1;
            }
            if [100, 10_000, 1_000_000].contains(&n) {
                println!("{n} points: {:.4}", 4.0 * inside as f64 / n as f64);
            }
        }
    }
    // 100 points: 3.1200
    // 10000 points: 3.1376
    // 1000000 points: 3.1438
    // ANCHOR_END: pi
}

mod integral {
    use super::random;

    // ANCHOR: integral
    /// From a random number, a place x between 0 and 1 and its pdf. Yours to change.
    fn sample(u: f64) -> (f64, f64) {
        (u, 1.0)
    }

    fn main() {
        let (n, mut state) = (10_000, 4);
        let (mut sum, mut squares, mut halves) = (0.0, 0.0, [0.0; 2]);
        for _ in 0..n {
            let (x, pdf) = sample(random(&mut state));
            let estimate = x * x / pdf;
            sum += estimate;
            squares += estimate * estimate;
            halves[(2.0 * x) as usize] += 1.0 / pdf;
        }
        let mean = sum / n as f64;
        let error = ((squares / n as f64 - mean * mean).max(0.0) / n as f64).sqrt();
        let [left, right] = halves.map(|half| half / n as f64);
        println!("{mean:.4} ± {error:.4}; the halves are {left:.2} and {right:.2} long");
    }
    // 0.3336 ± 0.0030; the halves are 0.50 and 0.50 long
    // ANCHOR_END: integral
}

#[cfg(test)]
mod tests {
    use std::process::Command;

    /// A listing of this file, as the page shows it.
    fn listing(name: &str) -> String {
        let text = include_str!("monte_carlo.rs");
        let begins = format!("// ANCHOR: {name}\n");
        let rest = text.split(&begins).nth(1).expect("a listing");
        rest.split("// ANCHOR_END").next().expect("its end").to_owned()
    }

    /// What a program of these listings prints.
    fn printed(program: &str) -> String {
        let folder = tempfile::tempdir().expect("a temporary folder");
        std::fs::write(folder.path().join("main.rs"), program).expect("written");
        let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let words = ["-O", "--edition", "2024", "main.rs", "-o", "program"];
        let told = Command::new(compiler).args(words).current_dir(folder.path()).output().expect("a compiler");
        assert!(told.status.success(), "{}", String::from_utf8_lossy(&told.stderr));
        let told = Command::new(folder.path().join("program")).output().expect("runs");
        String::from_utf8(told.stdout).expect("UTF-8")
    }

    #[test]
    fn the_programs_print_what_they_say() {
        for name in ["pi", "integral"] {
            let listing = listing(name);
            let says: Vec<&str> = listing.lines().filter_map(|line| line.trim().strip_prefix("// ")).collect();
            assert_eq!(printed(&(super::tests::listing("random") + &listing)).lines().collect::<Vec<_>>(), says);
        }
    }

    /// What stands on the page of the program with another `sample`.
    #[test]
    fn other_pdfs_print_what_the_page_says() {
        let page = include_str!("../../../book/src/monte_carlo.md");
        let listing = listing("random") + &listing("integral");
        let mut tried = 0;
        for line in page.lines().filter(|line| line.starts_with("| `(")) {
            let cells: Vec<&str> = line.split(" | ").map(|cell| cell.trim_matches(['|', '`', ' '])).collect();
            let told = printed(&listing.replace("(u, 1.0)", cells[0]));
            assert_eq!(told.trim(), cells[1], "{}", cells[0]);
            tried += 1;
        }
        assert!(tried >= 4);
        let written = listing.replace("x * x / pdf", "x * x.exp() / pdf");
        let told = printed(&written.replace("(u, 1.0)", "(u.sqrt(), 2.0 * u.sqrt())"));
        assert!(page.contains(told.split(';').next().expect("what it prints")), "{told}");
        assert!(printed(&written).contains("± 0.0077") && page.contains("leave 0.0077"));
        eprintln!("pdfs on the page of Monte Carlo: {tried}, printed as they stand there");
    }
}
