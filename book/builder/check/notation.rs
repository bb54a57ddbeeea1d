//! One letter, one meaning: every letter of a page's formulas is in one of the glossary's two tables.

use super::scan::Scan;
use super::{Page, Problem};
use std::collections::{BTreeMap, BTreeSet};

/// The page of the two tables.
const GLOSSARY: &str = "glossary.md";
/// What stands before the first table, and between the two.
const BEGINS: [&str; 2] = ["## Notation", "These mean something only"];
/// The letters that TeX has as words.
const GREEK: [&str; 37] = [
    "alpha",
    "beta",
    "gamma",
    "delta",
    "epsilon",
    "varepsilon",
    "zeta",
    "eta",
    "theta",
    "iota",
    "kappa",
    "lambda",
    "mu",
    "nu",
    "xi",
    "rho",
    "sigma",
    "tau",
    "upsilon",
    "phi",
    "varphi",
    "chi",
    "psi",
    "omega",
    "Gamma",
    "Delta",
    "Theta",
    "Lambda",
    "Xi",
    "Sigma",
    "Upsilon",
    "Phi",
    "Psi",
    "Omega",
    "Pi",
    "ell",
    "pi",
];
/// Words of TeX whose argument is text and no letters.
const TEXT: [&str; 7] = ["text", "mathrm", "operatorname", "textbf", "mathbf", "mathit", "tag"];
/// The letters that need no row: the coordinates, an index, the d of an integral and π.
const KNOWN: [&str; 8] = ["x", "y", "z", "u", "v", "i", "d", "pi"];

/// The letters of some formulas.
fn letters(formula: &str) -> BTreeSet<String> {
    let (mut found, mut rest) = (BTreeSet::new(), formula);
    while let Some(letter) = rest.chars().next() {
        rest = &rest[letter.len_utf8()..];
        if let Some(computed) = rest.strip_prefix('{').filter(|_| letter == '{') {
            rest = computed.split_once("}}").map_or("", |(_, after)| after);
        } else if letter == '\\' {
            let length = rest.bytes().take_while(u8::is_ascii_alphabetic).count();
            let word = &rest[..length];
            rest = &rest[length..];
            if TEXT.contains(&word) {
                rest = rest.split_once('}').map_or("", |(_, after)| after);
            } else if GREEK.contains(&word) {
                found.insert(word.to_owned());
            }
        } else if letter.is_ascii_alphabetic() {
            found.insert(letter.to_string());
        }
    }
    found
}

/// The formulas of a page, without their dollars.
fn formulas(page: &Page) -> String {
    let scan = Scan::new(&page.text);
    let prose: Vec<String> =
        scan.prose().filter(|line| !line.text.starts_with("{{#")).map(|line| without_code(line.text)).collect();
    let prose = prose.join("\n");
    let (mut found, mut inside) = (String::new(), false);
    for part in prose.replace("$$", "$").split('$') {
        if inside {
            found.push_str(part);
            found.push(' ');
        }
        inside = !inside;
    }
    found
}

/// A line without what stands between backticks.
fn without_code(line: &str) -> String {
    line.split('`').step_by(2).collect::<Vec<_>>().join(" ")
}

/// The letters of a table's row, and the pages that its meaning links.
fn row(line: &str) -> Option<(BTreeSet<String>, Vec<&str>)> {
    let (own, meaning) = line.strip_prefix("| $")?.split_once(" | ")?;
    let pages = meaning.split("](").skip(1).filter_map(|link| link.split(')').next()).collect();
    Some((letters(&own.replace('$', " ")), pages))
}

/// Letters that no table explains.
pub fn problems(pages: &[Page]) -> Vec<Problem> {
    let glossary = pages.iter().find(|page| page.name == GLOSSARY);
    let tables = glossary.and_then(|page| page.text.split_once(BEGINS[0])?.1.split_once(BEGINS[1]));
    let Some((general, local)) = tables else {
        return vec![Problem::new(GLOSSARY, 1, format!("there is no {:?} with {:?} below it.", BEGINS[0], BEGINS[1]))];
    };
    let general: BTreeSet<String> =
        general.lines().filter_map(row).flat_map(|(letters, _)| letters).chain(KNOWN.map(str::to_owned)).collect();
    let mut own: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for (letters, named) in local.lines().filter_map(row) {
        named.into_iter().for_each(|page| own.entry(page).or_default().extend(letters.clone()));
    }
    let is_taught = |page: &&Page| {
        page.name.starts_with(|first: char| first.is_ascii_digit())
            || ["monte_carlo.md", "appendix.md"].contains(&&*page.name)
    };
    let mut problems = Vec::new();
    for page in pages.iter().filter(is_taught) {
        let known = own.get(&*page.name);
        for letter in letters(&formulas(page)) {
            if !general.contains(&letter) && !known.is_some_and(|known| known.contains(&letter)) {
                let what = format!("no table of {GLOSSARY} says what the letter {letter} means on this page.");
                problems.push(Problem::new(&page.label, 1, what));
            }
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::super::made_up;
    use super::*;

    const TABLES: &str = "## Notation\n\n| letter | meaning |\n|---|---|\n| $L$, $L_e$ | radiance |\n\n\
                          These mean something only on the pages named.\n\n| $\\beta$, $H$ | [5](05_b.md): an angle, a height |\n";

    #[test]
    fn letters_are_found_in_formulas_alone() {
        let page = made_up(
            "05_b.md",
            "a $H \\cdot \\frac{\\beta}{2}\\text{ if so}$, `$q$` and\n\n$$\nL_e = {{= 2*3 : 0}}\n$$\n\n```\n$w$\n```\n",
        );
        let found: Vec<String> = letters(&formulas(&page)).into_iter().collect();
        assert_eq!(found, ["H", "L", "beta", "e"]);
    }

    #[test]
    fn a_letter_without_a_row_is_named() {
        let glossary = || made_up(GLOSSARY, TABLES);
        assert!(problems(&[glossary(), made_up("05_b.md", "$H L \\beta$\n")]).is_empty());
        let told = problems(&[glossary(), made_up("06_c.md", "$H L$\n")]);
        let told: Vec<String> = told.iter().map(ToString::to_string).collect();
        assert_eq!(told, ["06_c.md:1: no table of glossary.md says what the letter H means on this page."]);
        assert_eq!(problems(&[made_up("05_b.md", "")]).len(), 1);
    }
}
