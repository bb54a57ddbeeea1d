use std::cmp::Reverse;

/// How many characters of a name are compared: nobody types more by hand.
const LETTERS: usize = 64;
/// How many names are compared.
const CANDIDATES: usize = 1000;

/// The name most similar to a mistyped one; `None` if there are no names.
///
/// The work is bounded whatever a file holds: long names are truncated, and of many names only those with the longest
/// common prefix are compared.
pub fn nearest<'n>(names: impl Iterator<Item = &'n str>, typed: &str) -> Option<&'n str> {
    let typed = cut(typed);
    let mut names: Vec<&str> = names.collect();
    if names.len() > CANDIDATES {
        let alike = |name: &str| typed.chars().zip(name.chars()).take_while(|(one, other)| one == other).count();
        names.sort_by_cached_key(|name| (Reverse(alike(name)), cut(name).len().abs_diff(typed.len())));
        names.truncate(CANDIDATES);
    }
    names.sort_unstable();
    names.into_iter().max_by_key(|name| (strsim::jaro_winkler(cut(name), typed) * 1e6) as u64)
}

fn cut(name: &str) -> &str {
    name.char_indices().nth(LETTERS).and_then(|(end, _)| name.get(..end)).unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    #[test]
    fn the_nearest_is_found_among_few_and_among_many() {
        assert_eq!(nearest(["ball", "floor", "wall"].into_iter(), "bal"), Some("ball"));
        assert_eq!(nearest(std::iter::empty(), "ball"), None);
        let names: Vec<String> = (0..50_000).map(|number| format!("ball {number:05}")).collect();
        let found = nearest(names.iter().map(String::as_str), "ball 4242");
        assert!(found.is_some_and(|name| name.starts_with("ball 42")), "{found:?}");
    }

    #[test]
    fn long_names_and_many_take_no_time() {
        let names: Vec<String> = (0..60_000).map(|number| format!("{}{number:05}", "n".repeat(90))).collect();
        let typed = "n".repeat(8 << 20);
        let began = Instant::now();
        assert!(nearest(names.iter().map(String::as_str), &typed).is_some());
        assert!(began.elapsed() < Duration::from_secs(2), "{:?}", began.elapsed());
    }
}
