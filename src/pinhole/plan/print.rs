use super::{Plan, RowKind};
use std::fmt;

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for pass in &self.passes {
            let row = match pass.row {
                RowKind::Pixel => "a pixel",
                RowKind::LightPath => "a path from a light",
            };
            writeln!(f, "pass \"{}\": a row is {row}, it produces the {}", pass.name, pass.product)?;
        }
        for row in &self.rows {
            let word = if row.kept { "kept" } else { "dropped" };
            writeln!(f, "  {word:<8} {:<32} {}", row.stage, row.reason)?;
        }
        let columns: Vec<String> =
            self.columns.iter().map(|column| format!("{} {} B", column.name, column.bytes_per_row())).collect();
        let bytes: usize = self.columns.iter().map(|column| column.bytes_per_row()).sum();
        writeln!(f, "columns, bytes per row: {} (together {bytes})", columns.join(", "))?;
        let tables: Vec<&str> = self.tables.iter().map(|table| table.name).collect();
        writeln!(f, "tables: {}", tables.join(", "))?;
        for (table, why) in &self.tables_left_out {
            writeln!(f, "without the {}: {why}", table.name)?;
        }
        if let Some(view) = self.view {
            writeln!(f, "view: `{}` is painted instead of the picture", view.name)?;
        }
        if self.statistics {
            writeln!(f, "statistics: every stage is timed and its rows are counted")?;
        }
        Ok(())
    }
}
