//! The colour in which a view shows numbers that are chosen here, column by column.

use super::*;
use pinhole::extract::NO_ROW;
use pinhole::follow::{CausticPaths, JoinRatios, LightPower, Media, Scattered, Splats};
use pinhole::intersect::{
    BoxTests, Contacts, EmissiveRows, GlassCrossing, HitPrimitives, Hits, MaterialRows, NO_SHAPE, PrimitiveTests,
    ShadingNormals, SurfaceSides, SurfaceUvs, Surfaces, TraversalDepths,
};
use pinhole::plan::{Column, RowLists};
use pinhole::rays::{
    CameraRays, LensPoints, NdcPoints, PathLight, Paths, PixelSamples, RasterPoints, RayTimes, SampleSigns,
    ScreenPoints, WorldRays,
};
use pinhole::shade::{
    EmissionFactors, Footprints, JoinPoints, LightPdfs, MetallicRoughness, Radiance, ShadowHits, ShadowRays,
    SurfaceColours, TexturePoints, TransmissiveRows,
};

const SIZE: [u32; 2] = [400, 200];
const BLACK: [f32; 3] = [0.0; 3];
const WHITE: [f32; 3] = [1.0; 3];
/// The unit vector (0.6, 0, −0.8), each component mapped from [−1, 1] to [0, 1].
const LEANING: [f32; 3] = [0.8, 0.5, 0.1];
const COLOUR: [f32; 3] = [0.25, 0.5, 2.0];

/// Paints every row of a column, and gives its name.
fn shown<C: Column>(column: C, expected: &[[f32; 3]]) -> &'static str {
    assert_eq!(column.rows(), expected.len(), "{}", C::NAME);
    for (row, expected) in expected.iter().enumerate() {
        let found = column.paint(row, SIZE);
        let close = (0..3).all(|part| (found[part] - expected[part]).abs() < 1e-6);
        assert!(close, "{}: row {row} is {found:?}, not {expected:?}", C::NAME);
    }
    C::NAME
}

#[test]
fn each_column_is_painted_as_its_page_says() {
    let grey = |part| [part; 3];
    let mut crossings = RowLists::default();
    crossings.push(&[GlassCrossing { glass: 0, from_outside: true, depth: 0.0 }]);
    crossings.push(&[]);
    let normal = [0.6, 0.0, -0.8].map(|part| vec![part, 0.0]);
    let rgb = COLOUR.map(|part| vec![f64::from(part)]);
    let direction = [0.6_f32, 0.0, -0.8].map(|part| vec![part]);
    let at_zero = [0.0; 3].map(|part| vec![part]);
    let names = [
        shown(RasterPoints { point: [vec![100.0], vec![150.0]] }, &[[0.25, 0.75, 0.0]]),
        shown(NdcPoints { point: [vec![0.25], vec![0.75]] }, &[[0.25, 0.75, 0.0]]),
        // Twice as wide as high, x is from −2 to 2.
        shown(ScreenPoints { point: [vec![-1.0, 0.0], vec![0.5, 0.0]] }, &[[0.25, 0.75, 0.0], [0.5, 0.5, 0.0]]),
        shown(LensPoints { point: [vec![0.3, 0.0], vec![-0.4, 0.0]] }, &[[0.8, 0.1, 0.5], [0.5; 3]]),
        shown(
            CameraRays { direction: [0.6, 0.0, -0.8].map(|part| vec![part]), origin: [0.0; 3].map(|part| vec![part]) },
            &[LEANING],
        ),
        shown(WorldRays { direction: direction.clone(), origin: at_zero }, &[LEANING]),
        shown(RayTimes { time: vec![0.0, 1.0, 3.0] }, &[BLACK, grey(0.5), grey(0.75)]),
        shown(PixelSamples { pixel: vec![5; 3], sample: vec![0, 1, 3] }, &[BLACK, grey(0.5), grey(0.75)]),
        shown(SampleSigns { sign: vec![1.0, -1.0] }, &[WHITE, [1.0, 0.0, 0.0]]),
        shown(Paths { throughput: rgb.clone(), first: vec![0], pdf: vec![1.0] }, &[COLOUR]),
        shown(PathLight { rgb: rgb.clone() }, &[COLOUR]),
        shown(Surfaces { position: normal.clone(), normal: normal.clone(), ..Default::default() }, &[LEANING, BLACK]),
        shown(ShadingNormals { normal }, &[LEANING, BLACK]),
        shown(SurfaceUvs { uv: [vec![1.25], vec![-0.25]] }, &[[0.25, 0.75, 0.0]]),
        shown(SurfaceSides { outside: vec![1, 0] }, &[WHITE, BLACK]),
        shown(MaterialRows { row: vec![3] }, &[WHITE]),
        shown(EmissiveRows { row: vec![3], emissive: vec![1] }, &[WHITE]),
        shown(TransmissiveRows { row: vec![3] }, &[WHITE]),
        shown(CausticPaths { spread: vec![1, 0] }, &[WHITE, BLACK]),
        shown(LightPower { rgb: rgb.clone() }, &[COLOUR]),
        // x of 1 + x.
        shown(
            JoinRatios { row: vec![0; 2], onward: vec![0.0, 1.0], reverse: vec![3.0, 0.0] },
            &[[0.0, 0.75, 0.0], [0.5, 0.0, 0.0]],
        ),
        shown(Splats { rgb: rgb.clone(), raster: [vec![9.0], vec![9.0]] }, &[COLOUR]),
        shown(Scattered { row: vec![0], direction: direction.clone(), ..Default::default() }, &[LEANING]),
        shown(Media { stack: [4, 0, 0, 0].map(|row| vec![row, NO_ROW]) }, &[WHITE, BLACK]),
        shown(Contacts { crossings, ..Default::default() }, &[WHITE, BLACK]),
        // √9 of √9 + 1; a footprint without an end is all of it.
        shown(
            Footprints {
                right: [vec![1.0, f64::INFINITY], vec![0.0; 2], vec![0.0; 2]],
                down: [vec![0.0; 2], vec![9.0; 2], vec![0.0; 2]],
            },
            &[[0.5, 0.75, 0.0], [1.0, 0.75, 0.0]],
        ),
        shown(JoinPoints { point: [vec![0.25], vec![0.75]] }, &[[0.25, 0.75, 0.0]]),
        shown(ShadowHits { t: vec![1.0; 2], shape: vec![NO_SHAPE, 0], ..Default::default() }, &[WHITE, BLACK]),
        shown(SurfaceColours { rgb }, &[COLOUR]),
        shown(MetallicRoughness { metallic: vec![0.25, 0.0], roughness: vec![0.5, 0.0] }, &[[0.0, 0.5, 0.25], BLACK]),
        shown(EmissionFactors { rgb: [vec![0.25], vec![0.5], vec![0.75]] }, &[[0.25, 0.5, 0.75]]),
        shown(
            TexturePoints { point: [vec![1.25], vec![-0.25], vec![0.5]], ..Default::default() },
            &[[0.25, 0.75, 0.5]],
        ),
        shown(ShadowRays { row: vec![0], direction, ..Default::default() }, &[LEANING]),
        shown(LightPdfs { row: vec![0; 2], pdf: vec![0.0, 3.0] }, &[BLACK, grey(0.75)]),
        // Half of the scale, which is red, at 64 boxes, 16 primitives or 4 nodes; white would be infinity.
        shown(BoxTests { boxes: vec![0, 64] }, &[BLACK, [0.8, 0.22, 0.28]]),
        shown(PrimitiveTests { primitives: vec![0, 16, 48] }, &[BLACK, [0.8, 0.22, 0.28], [0.98, 0.66, 0.15]]),
        shown(TraversalDepths { depth: vec![0, 4] }, &[BLACK, [0.8, 0.22, 0.28]]),
        shown(Radiance { rgb: [vec![0.25], vec![0.5], vec![2.0]] }, &[COLOUR]),
    ];
    let hits = Hits { t: vec![0.0, 60.0, 0.0, 1.0], shape: vec![0, 0, 1, NO_SHAPE] };
    let colours = [0, 1, 2, 3].map(|row| hits.paint(row, SIZE));
    // 1 / √(1 + 0.05 t) is a half at t = 60.
    assert!((0..3).all(|part| (colours[1][part] - 0.5 * colours[0][part]).abs() < 1e-6), "{colours:?}");
    assert!(colours[0] != colours[2] && colours[3] == BLACK, "{colours:?}");
    let primitives = HitPrimitives { primitive: vec![0, 1, u32::MAX] };
    let colours = [0, 1, 2].map(|row| primitives.paint(row, SIZE));
    assert!(colours[0] != colours[1] && colours[2] == BLACK, "{colours:?}");
    let offered = view_names(&offer());
    let missing: Vec<&str> = offered
        .into_iter()
        .filter(|name| {
            ![Hits::NAME, HitPrimitives::NAME].contains(name) && !names.contains(name) && !name.ends_with(" rows")
        })
        .collect();
    assert!(missing.is_empty(), "no colours are known of {missing:?}");
    eprintln!("paintings: {} columns", names.len() + 2);
}
