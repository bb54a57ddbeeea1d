use super::Strip;
use crate::measure::extremes::{Case, Outcome};
use std::io;

const STYLE: &str = "\
:root{color-scheme:light dark;--line:#8884;--bad:#b3261e;--good:#1b6e3c;--soft:#777}\
@media(prefers-color-scheme:dark){:root{--bad:#f2867e;--good:#7fd3a0;--soft:#999}}\
body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:0 auto;padding:1rem}\
h1,h2,h3{line-height:1.25}h3{font-size:1rem;margin:1.6rem 0 .3rem}\
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums;font-size:.9rem}\
th,td{text-align:right;padding:.15rem .5rem;border-bottom:1px solid var(--line)}\
th:first-child,td:first-child{text-align:left}th{color:var(--soft);font-weight:normal}\
.breaks,.not-held{color:var(--bad)}.held{color:var(--good)}.passes,p.note,figcaption{color:var(--soft)}\
p.note{margin:.2rem 0;font-size:.85rem;overflow-wrap:anywhere}\
.strip{display:grid;grid-template-columns:repeat(auto-fit,minmax(11rem,1fr));gap:.8rem;margin:.5rem 0 2rem}\
figure{margin:0}img{width:100%;image-rendering:pixelated;display:block}figcaption{font-size:.85rem}\
@media(max-width:32rem){thead{display:none}tr{display:grid;grid-template-columns:1fr auto;\
border-bottom:1px solid var(--line);padding:.3rem 0}td{border:0;padding:0 .2rem}td:first-child{grid-column:1/-1}\
td::before{content:attr(data-is)' ';color:var(--soft)}td:first-child::before{content:none}td:empty{display:none}}";

/// The page: pictures first, then every group's table.
///
/// Errors: a picture that cannot be encoded.
pub fn page(cases: &[Case], strips: &[Strip], scene: &str) -> io::Result<String> {
    let held = cases.iter().filter(|case| case.held()).count();
    let rays: u64 = cases.iter().map(|case| case.rays).sum();
    let mut html = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\
         <title>pinhole: extremes</title><style>{STYLE}</style></head><body>\n\
         <h1>Extremes</h1>\n<p>Pinhole's methods where numbers are hardest, beside naive ones and exact arithmetic. \
         {held} of {} cases hold, {rays} inputs in all. None wrong of N bounds the rate of wrong ones by 3/N, with 95 % \
         confidence. u = 2<sup>−24</sup>.</p>\n<h2>Pictures</h2>\n<p>Of the scene of {}, unless said otherwise.</p>\n",
        cases.len(),
        escaped(scene)
    );
    for strip in strips {
        html +=
            &format!("<h3>{}</h3>\n<p>{}</p>\n<div class=\"strip\">\n", escaped(&strip.title), escaped(&strip.says));
        for (name, picture) in &strip.pictures {
            let (name, url) = (escaped(name), picture.url()?);
            html += &format!("<figure><img alt=\"{name}\" src=\"{url}\"><figcaption>{name}</figcaption></figure>\n");
        }
        html += "</div>\n";
    }
    let mut group = None;
    for case in cases {
        if group.replace(case.group) != Some(case.group) {
            html += &format!("<h2>{}</h2>\n", escaped(&case.group.to_string()));
        }
        html += &table(case);
    }
    Ok(html + "</body></html>\n")
}

/// A case: a row a method, then its worst input.
fn table(case: &Case) -> String {
    let head = "<thead><tr><th>method</th><th>wrong</th><th>worst error</th><th>asked</th><th></th></tr></thead>";
    let rows: String = case.outcomes.iter().map(row).collect();
    let mut html = format!(
        "<h3>{}</h3>\n<p class=\"note\">{} tried, {} of them with something to check</p>\n\
         <table>{head}<tbody>\n{rows}</tbody></table>\n",
        escaped(&case.name),
        case.rays,
        case.hits
    );
    for line in case.worst_lines() {
        html += &format!("<p class=\"note\">{}</p>\n", escaped(&line));
    }
    html
}

fn row(outcome: &Outcome) -> String {
    let words = outcome.words();
    let proves = if words.proves_nothing { " (proves nothing here)" } else { "" };
    format!(
        "<tr><td>{}</td><td data-is=\"wrong\">{}</td><td data-is=\"worst\">{}</td><td data-is=\"asked\">{}</td>\
         <td class=\"{}\">{}{proves}</td></tr>\n",
        escaped(outcome.method.name),
        outcome.score.wrong,
        words.worst,
        escaped(&words.asked),
        words.result.to_lowercase().replace(' ', "-"),
        words.result.to_lowercase()
    )
}

/// Text as it may stand in a page.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
