use super::escape;
use crate::review::{StageBlocks, stage_blocks};
use std::fmt::Write;

/// Every stage in order, whether it wrote other numbers, and for the film a small map of the blocks that differ.
pub fn stages(before: &str, now: &str) -> String {
    let stages = stage_blocks(before, now);
    let same = stages.iter().take_while(|stage| stage.differing.is_empty() && !stage.gone && !stage.new).count();
    let mut rows = String::new();
    for (index, stage) in stages.iter().enumerate() {
        let first = if index == same { " class=\"here\"" } else { "" };
        let _ = writeln!(
            rows,
            "<tr{first}><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>",
            escape(&stage.stage),
            escape(&stage.column),
            told(stage),
            if stage.differing.is_empty() || stage.across * stage.down < 2 { String::new() } else { map(stage) }
        );
    }
    format!(
        "<div class=\"wide\"><table class=\"stages\"><thead><tr><th scope=\"col\">stage</th><th scope=\"col\">column</th>\
         <th scope=\"col\">numbers</th><th scope=\"col\">where</th></tr></thead><tbody>\n{rows}</tbody>\
         </table></div>\n"
    )
}

fn told(stage: &StageBlocks) -> String {
    match (stage.gone, stage.new, stage.differing.len()) {
        (true, ..) => "no longer runs".into(),
        (_, true, _) => "is new".into(),
        (.., 0) => "same".into(),
        _ if stage.across * stage.down < 2 => "differs".into(),
        (.., count) => format!("{count} of {} blocks differ", stage.across * stage.down),
    }
}

/// The blocks as squares, those that differ filled.
fn map(stage: &StageBlocks) -> String {
    const SIDE: usize = 6;
    let (width, height) = (stage.across * SIDE, stage.down * SIDE);
    let mut squares = String::new();
    for &[x, y] in &stage.differing {
        let _ = write!(squares, "M{} {}h5v5h-5z", x * SIDE, y * SIDE);
    }
    format!(
        "<svg class=\"map\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
         aria-label=\"map of the blocks that differ\"><path d=\"{squares}\"/></svg>"
    )
}
