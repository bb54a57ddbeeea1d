//! What is kept of the curves of chapters 31, 34, 37 and 39 says when it was measured, and has the forms that the pages describe.

use pinhole::scene::MeshGeometry;
use pinhole::shapes::{MeshHierarchy, PlacedSphere, hierarchy_of};
use pinhole_lab::measure::specimen::shapes_in_a_cube;
use pinhole_lab::measure::torus_knot::{steps_for, torus_knot};
use std::path::Path;

fn kept(chapter: &str) -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters").join(chapter).join("curves.txt");
    std::fs::read_to_string(file).expect("the curves are kept beside the chapter")
}

/// Times belong to their day and machine, but the sizes of hierarchies are the same everywhere: those of the first rows are
/// built again.
#[test]
fn the_hierarchies_of_the_curves_are_of_the_sizes_that_are_kept() {
    let [along, sphere_rows] = [4..=7, 4..=8];
    let knots = along.map(|power| {
        let [along, around] = steps_for(power);
        let mesh = MeshGeometry::new(torus_knot(along, around));
        (mesh.triangles.len(), MeshHierarchy::of(&mesh).bytes())
    });
    let spheres = sphere_rows.map(|power| {
        let count = libm::round(libm::exp10(f64::from(power) / 2.0)) as usize;
        let bvh = hierarchy_of(&shapes_in_a_cube::<PlacedSphere>(count)).expect("bounded shapes");
        (count, bvh.bytes())
    });
    let mut looked = 0;
    for (title, columns, size, built) in
        [("triangles", 8, 6, knots.collect::<Vec<_>>()), ("spheres", 7, 5, spheres.collect())]
    {
        for ((count, row), (now, bytes)) in table("31_wide_tree", title, columns).iter().zip(built) {
            let kib = format!("{:.1}", bytes as f64 / 1024.0);
            let anew = "to measure anew, on a quiet machine: cargo run --release -- measure 31";
            assert!(
                *count == now as f64 && row[size].to_string() == kib.trim_end_matches(".0"),
                "{title}: {now} of them take {kib} KiB; {anew}"
            );
            looked += 1;
        }
    }
    eprintln!("curves: {looked} hierarchies of the sizes that are kept");
}

/// Each file says when and where its times were measured.
#[test]
fn curves_say_when_they_were_measured() {
    for chapter in ["31_wide_tree", "34_both", "37_rows", "39_both_ends"] {
        let kept = kept(chapter);
        assert!(kept.lines().any(|line| line.starts_with("machine: ")), "{chapter}");
        assert!(kept.lines().last().is_some_and(|line| line.starts_with("measured on ")), "{chapter}");
    }
}

/// The rows below the line that starts with this word: a count, and a number for each of so many columns.
fn table(chapter: &str, title: &str, columns: usize) -> Vec<(f64, Vec<f64>)> {
    let text = kept(chapter);
    let row = |line: &str| {
        let number = |cell: &str| if cell == "-" { Some(f64::NAN) } else { cell.parse().ok() };
        let cells: Option<Vec<f64>> = line.split_whitespace().map(number).collect();
        cells.filter(|cells| cells.len() == columns + 1).map(|cells| (cells[0], cells[1..].to_vec()))
    };
    let lines = text.lines().skip_while(|line| !line.starts_with(title)).skip(2);
    let rows: Vec<_> = lines.map_while(row).collect();
    assert!(rows.len() >= 5, "{} rows of {title}", rows.len());
    rows
}

/// "The same loop now takes 2.1 ns", "of a few thousand rows, each then takes 1.7 ns", "only where the columns no longer fit there does the fused
/// loop win", "and a row takes 6.7 ns": what the page says of the rows of chapter 37, as ratios that hold on any machine
/// whose registers hold four f64 or more.
#[test]
fn rows_take_less_time_in_columns_and_by_lists() {
    let rows = table("37_rows", "rows at once", 7);
    let [tile, last] = [1024.0, 1_048_576.0].map(|count| rows.iter().find(|row| row.0 == count).expect("a row"));
    let [library, series, columns, fused, mixed, listed] = [0, 1, 2, 3, 4, 5];
    assert!(tile.1[library] > 2.0 * tile.1[series], "the library is called");
    assert!(last.1[library] > 1.2 * tile.1[library], "a thousand rows are learned by heart");
    assert!(tile.1[columns] < 1.1 * tile.1[series], "columns are not gathered");
    assert!(tile.1[fused] > 0.9 * tile.1[columns], "a fused loop gains nothing for a tile");
    assert!(last.1[fused] < 0.95 * last.1[columns], "it does for a million rows");
    assert!(tile.1[mixed] > 1.5 * tile.1[listed], "rows of one kind are done at once");
}

/// The exponent with which a column grows between two rows.
fn growth(rows: &[(f64, Vec<f64>)], column: usize, [from, to]: [usize; 2]) -> f64 {
    (rows[to].1[column] / rows[from].1[column]).ln() / (rows[to].0 / rows[from].0).ln()
}

/// "The lines of rays rise slowly. Those of projection are level … and rise when triangles are."
#[test]
fn against_triangles_projection_begins_below_and_the_curves_come_together() {
    let rows = table("34_both", "triangles", 7);
    let last = rows.len() - 1;
    let ratio = |row: usize, size: usize| rows[row].1[2 * size] / rows[row].1[2 * size + 1];
    for size in 0..3 {
        let [rays, projection] = [2 * size, 2 * size + 1];
        assert!(growth(&rows, rays, [0, last]) < 0.35, "rays, size {size}");
        assert!(growth(&rows, projection, [last - 1, last]) > growth(&rows, projection, [0, 1]), "size {size}");
        assert!(ratio(0, size) > 1.0, "few triangles, size {size}: {}", ratio(0, size));
        assert!(ratio(last, size) < ratio(0, size), "many triangles, size {size}: {}", ratio(last, size));
    }
    let [small, large] = [1, 5].map(|column| growth(&rows, column, [last - 1, last]));
    assert!(small > 0.35 && small > large, "many triangles for each pixel: {small}, fewer: {large}");
    assert!(ratio(last, 0) < 1.0 && ratio(last, 2) > ratio(last, 0), "the crossing is later in a large picture");
    // "A mesh that is bent anew for every picture pays for the grey line each time."
    assert!(rows.iter().all(|(_, row)| (0..3).all(|size| row[2 * size] + row[6] > row[2 * size + 1])));
}

/// "Twice the pixels are twice the rays, and nearly twice the time"; projection begins with the cost of its triangles.
#[test]
fn against_pixels_rays_grow_in_proportion_and_projection_less() {
    let rows = table("34_both", "pixels", 2);
    let ends = [0, rows.len() - 1];
    let [rays, projection] = [0, 1].map(|column| growth(&rows, column, ends));
    assert!(rays > 0.6 && rays < 1.05 && projection < rays, "{rays} and {projection}");
}

/// "Here the two unbroken lines become one"; lights without shadows cost far less; one light of many costs what one does.
#[test]
fn against_lights_shadow_rays_decide() {
    let rows = table("34_both", "lights", 6);
    let summed: Vec<_> = rows.iter().filter(|(_, row)| row[0].is_finite()).cloned().collect();
    let chosen: Vec<_> = rows.iter().filter(|(_, row)| row[3].is_finite()).cloned().collect();
    assert!(summed.len() + chosen.len() == rows.len() && summed.len() > 3 && chosen.len() > 2);
    let last = &summed[summed.len() - 1].1;
    assert!((last[0] / last[1] - 1.0).abs() < 0.15, "{} and {} of many lights", last[0], last[1]);
    assert!(last[2] < 0.5 * last[1], "{} without shadows", last[2]);
    let ends = [summed.len() - 2, summed.len() - 1];
    assert!(growth(&summed, 1, ends) > 0.8, "in proportion to the lights");
    let ends = [0, chosen.len() - 1];
    assert!([3, 4, 5].iter().all(|&column| growth(&chosen, column, ends) < 0.25), "one light of any number");
    assert!(chosen[0].1[4] < 0.5 * last[1]);
}
