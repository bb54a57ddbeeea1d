use crate::review::{ChangedRow, changed_rows};
use std::fmt::Write;

/// Where the components of a probe's line start: after its column's name, space and unit.
const COMPONENTS_AT: usize = 55;

/// What changed at the probes: a table a probe, a line a number that changed, with its differing digits marked.
///
/// None where nothing changed at any probe.
pub fn rays(before: &str, now: &str) -> Option<String> {
    let rows = changed_rows(before, now);
    let mut probes: Vec<(&str, String, usize)> = Vec::new();
    for row in &rows {
        if probes.last().is_none_or(|(probe, ..)| *probe != row.probe) {
            probes.push((row.probe, String::new(), 0));
        }
        if let Some((_, lines, count)) = probes.last_mut() {
            let changed = changed_components(row);
            *count += changed.len();
            for Changed { column, component, before, now } in changed {
                let [before, now] = marked(&before, &now);
                let _ = writeln!(
                    lines,
                    "<tr><th scope=\"row\">{}</th><td>{}</td><td>{before}</td><td>{now}</td></tr>",
                    escape(&column),
                    escape(&component)
                );
            }
        }
    }
    let mut text = String::new();
    for (index, (probe, lines, count)) in probes.iter().enumerate() {
        let open = if index == 0 { " open" } else { "" };
        let (place, _) = probe.split_once("   ").unwrap_or((probe, ""));
        let _ = write!(
            text,
            "<details{open}><summary>{} <small>{count} changed</small></summary><div class=\"wide\"><table>\
             <thead><tr><th scope=\"col\">column</th><th scope=\"col\">component</th><th scope=\"col\">before</th>\
             <th scope=\"col\">now</th></tr></thead><tbody>\n{lines}</tbody></table></div></details>\n",
            escape(place)
        );
    }
    (!text.is_empty()).then_some(text)
}

/// One number, or one line where the two cannot be set side by side number by number.
#[derive(Debug, PartialEq)]
struct Changed {
    column: String,
    component: String,
    before: String,
    now: String,
}

/// The components of a column that changed at a probe.
fn changed_components(row: &ChangedRow<'_>) -> Vec<Changed> {
    let split = |lines: &[&str]| lines.iter().map(|line| components(line)).collect::<Vec<_>>();
    let (before, now) = (split(&row.before), split(&row.now));
    let named = before.first().or(now.first());
    let column = named.map_or("", |(name, _)| name).to_string();
    let mut changed = Vec::new();
    for index in 0..before.len().max(now.len()) {
        let [old, new] = [&before, &now].map(|lines| lines.get(index).map_or(&[][..], |(_, components)| components));
        let several = before.len().max(now.len()) > 1;
        let number = if several { format!(" ({})", index + 1) } else { String::new() };
        let same_components = old.len() == new.len() && old.iter().zip(new).all(|(old, new)| old.0 == new.0);
        if same_components {
            let pairs = old.iter().zip(new).filter(|(old, new)| old != new);
            changed.extend(pairs.map(|((component, before), (_, now))| Changed {
                column: column.clone(),
                component: format!("{component}{number}"),
                before: before.clone(),
                now: now.clone(),
            }));
        } else {
            let [before, now] = [old, new].map(|components| {
                let words: Vec<String> = components
                    .iter()
                    .map(|(component, value)| format!("{component} {value}").trim().to_string())
                    .collect();
                words.join("  ")
            });
            changed.push(Changed { column: column.clone(), component: number.trim().to_string(), before, now });
        }
    }
    changed
}

/// A line's column, and its components: a name and a value each.
fn components(line: &str) -> (String, Vec<(String, String)>) {
    let letters: Vec<char> = line.chars().collect();
    let aligned = letters.get(COMPONENTS_AT - 1) == Some(&' ') && letters.len() > COMPONENTS_AT;
    let cut = if aligned { COMPONENTS_AT } else { 0 };
    let (head, rest): (String, String) = (letters[..cut].iter().collect(), letters[cut..].iter().collect());
    let name = head.split("  ").next().unwrap_or_default().trim().to_string();
    let pairs = rest.trim().split("  ").filter(|pair| !pair.is_empty());
    let components = pairs.map(|pair| pair.trim().split_once(' ').unwrap_or((pair.trim(), "")));
    (name, components.map(|(component, value)| (component.to_string(), value.to_string())).collect())
}

/// Both values, from the first letter that differs on between marks.
fn marked(before: &str, now: &str) -> [String; 2] {
    let shared: usize = before.chars().zip(now.chars()).take_while(|(a, b)| a == b).map(|(a, _)| a.len_utf8()).sum();
    [before, now].map(|value| {
        let (same, other) = value.split_at(shared);
        let other = if other.is_empty() { String::new() } else { format!("<mark>{}</mark>", escape(other)) };
        format!("{}{other}", escape(same))
    })
}

/// A text as HTML holds it.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    const PROBES: &str = "96 × 54 pixels\n\ntop: pixel 48,0   sample 0, depth 0\n\
        world     world, from the eye  scene units              dx +0.100000  dy +0.223456  dz -1.000000\n\
        hit       along the ray        scene units              t +12.500000  shape near ball\n\
        light     world, from the eye  scene units              nothing\n";

    #[test]
    fn only_numbers_that_changed_stand_there_and_their_digits_are_marked() {
        let now = PROBES.replace("+0.223456", "+0.223999").replace("near ball", "far <ball>");
        let text = rays(PROBES, &now).unwrap_or_default();
        for row in [
            "<tr><th scope=\"row\">world</th><td>dy</td><td>+0.223<mark>456</mark></td><td>+0.223<mark>999</mark></td></tr>",
            "<tr><th scope=\"row\">hit</th><td>shape</td><td><mark>near ball</mark></td><td><mark>far &lt;ball&gt;</mark></td></tr>",
            "<summary>top: pixel 48,0 <small>2 changed</small></summary>",
        ] {
            assert!(text.contains(row), "no {row} in\n{text}");
        }
        assert_eq!(text.matches("<tr><th scope=\"row\">").count(), 2, "{text}");
        assert_eq!(rays(PROBES, PROBES), None);
    }

    #[test]
    fn a_row_that_comes_stands_whole() {
        let row = "light     world, from the eye  scene units              ox +1.000000  oy +2.000000";
        let now = PROBES.replace("light     world, from the eye  scene units              nothing", row);
        let text = rays(PROBES, &now).unwrap_or_default();
        let cells = "<td></td><td><mark>nothing</mark></td><td><mark>ox +1.000000  oy +2.000000</mark></td>";
        assert!(text.contains(cells), "{text}");
    }

    #[test]
    fn rows_after_the_first_say_which_they_are() {
        let two = |last: &str| format!("{PROBES}{:<55} ox +0.500000  oy {last}\n", "");
        let text = rays(&two("+1.000000"), &two("+2.000000")).unwrap_or_default();
        assert!(text.contains("<th scope=\"row\">light</th><td>oy (2)</td>"), "{text}");
    }
}
