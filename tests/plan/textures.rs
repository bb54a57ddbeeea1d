//! Textures and backgrounds: each column and stage exists where something asks for it, and nowhere else.

use super::*;
use pinhole::plan::Census;
use scenes::{TextureToggle, textured_by};

/// All combinations of what a texture may be and what may be behind everything.
fn all() -> Vec<Vec<TextureToggle>> {
    let toggles = TextureToggle::ALL;
    let chosen = |bits: usize| (0..toggles.len()).filter(|bit| bits >> bit & 1 == 1).map(|bit| toggles[bit]).collect();
    (0..1 << toggles.len()).map(chosen).collect()
}

#[test]
fn a_texture_brings_what_it_needs_and_nothing_else() {
    use TextureToggle::*;
    let mut tried = 0;
    let plain = film(&textured_by(&[]));
    for on in all() {
        let has = |toggle| on.contains(&toggle);
        let scene = textured_by(&on);
        if has(Gradient) && has(Environment) {
            let told = prepare(&Census::of(&scene), &offer()).err().map(|error| error.to_string()).unwrap_or_default();
            assert!(told.starts_with("the scene: background is given as a Gradient by \"sky\""), "{told}");
            continue;
        }
        let (plan, tables) = prepare(&Census::of(&scene), &offer()).unwrap_or_else(|error| panic!("{on:?}: {error}"));
        let textured = has(Checker) || has(Stripes) || has(Image);
        let filtered = textured && has(Filter);
        let stages = [
            ("Look up surface colours", textured),
            ("Compute texture points", textured),
            ("Compute footprints", filtered),
            ("Evaluate textures: checkers", has(Checker)),
            ("Evaluate textures: stripes", has(Stripes)),
            ("Evaluate textures: images", has(Image)),
            ("Add the gradient", has(Gradient)),
            ("Add the environment", has(Environment)),
            ("Add the background", false),
        ];
        for (stage, needed) in stages {
            let row = row(&plan, stage);
            assert_eq!(row.kept, needed, "{on:?}: {stage}: {}", row.reason);
        }
        let columns: BTreeSet<&str> = plan.columns.iter().map(|column| column.name).collect();
        for (column, needed) in
            [("colour", textured), ("texture", textured), ("footprint", filtered), ("uv", textured && has(Uv))]
        {
            assert_eq!(columns.contains(column), needed, "{on:?}: {column}");
        }
        let tables: BTreeSet<&str> = tables.iter().map(|table| table.name).collect();
        for (table, needed) in [
            ("texture maps", textured),
            ("shape spaces", textured),
            ("pixel steps", filtered),
            ("uv slopes", filtered && has(Uv)),
            ("checkers", has(Checker)),
            ("stripes", has(Stripes)),
            ("images", has(Image)),
            ("gradient", has(Gradient)),
            ("environment", has(Environment)),
        ] {
            assert_eq!(tables.contains(table), needed, "{on:?}: {table}");
        }
        let film = film(&scene);
        assert_eq!(film.rejected, 0, "{on:?}");
        let shows = film != plain;
        assert_eq!(shows, textured || has(Gradient) || has(Environment), "{on:?}: {} colours", film.colours());
        tried += 1;
    }
    eprintln!("textures: {tried} combinations, each with its own stages, columns and tables");
}

#[test]
fn what_no_shape_is_made_of_is_left_out() {
    let mut scene = toggled(&[Toggle::Sphere, Toggle::Light]);
    scene.spawn((Name::new("spare"), Matte::default(), Checker::default()));
    let plan = plan_of(&scene);
    for stage in
        ["Look up surface colours", "Compute texture points", "Compute footprints", "Evaluate textures: checkers"]
    {
        let row = row(&plan, stage);
        assert!(!row.kept && row.reason.contains("\"spare\", unused"), "{row:?}");
    }
}
