//! Surfaces that are computed together are those that are computed one by one.

use glam::{DVec2, DVec3};
use pinhole::shapes::{HITS, HitBlock, RayHit, Shape, ShapeKind, TriangleFace, TriangleRow, triangle_t, with_shapes};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::oracle::Oracle;
use pinhole_lab::measure::specimen::Specimen;

/// Fills a block with hits, compares each surface to the last bit, and starts another.
fn compare<S: Shape>(
    shapes: &[S],
    surface_data: &[S::SurfaceData],
    block: &mut HitBlock,
    hits: &mut Vec<(u32, RayHit)>,
) -> usize {
    for (lane, (row, hit)) in hits.iter().enumerate() {
        block.set_hit(lane, *row, hit);
    }
    S::fill_surfaces(shapes, surface_data, block, hits.len());
    for (lane, (row, hit)) in hits.iter().enumerate() {
        let expected = shapes[*row as usize].surface(&surface_data[*row as usize], hit);
        let found = block.surface(lane);
        // Two NaN agree, as where a placement is so flat that its normal is lost.
        assert_eq!(format!("{found:?}"), format!("{expected:?}"), "lane {lane} of {}, {hit:?}", hits.len());
    }
    let count = hits.len();
    hits.clear();
    count
}

/// Shapes near and far, so that a ray to some of them is moved on first, and blocks of any length.
fn check_together<S: Oracle>(name: &str) {
    let (mut draws, mut block, mut tried, mut missed) = (Draws::new(1207, 0), HitBlock::default(), 0, 0);
    for round in 0..120 {
        let away = [2.0, 30.0, 1e4][round % 3];
        let drawn: Vec<Specimen<S>> = (0..2).filter_map(|_| Specimen::drawn(&mut draws, [-2.0, 2.0], away)).collect();
        let shapes: Vec<S> = drawn.iter().map(|specimen| specimen.shape.clone()).collect();
        let surface_data: Vec<S::SurfaceData> = drawn.iter().map(|specimen| specimen.surface_data.clone()).collect();
        let (mut hits, max) = (Vec::new(), 1 + (draws.unit() * HITS as f64) as usize);
        for attempt in 0..3 * HITS {
            let row = if round % 2 == 0 { 0 } else { attempt % drawn.len() };
            let (_, radius) = drawn[row].sphere_around();
            let origin = if attempt % 4 == 0 { DVec3::ZERO } else { draws.unit_vector().as_vec3().as_dvec3() * radius };
            let direction = (drawn[row].aim(&mut draws) - origin).normalize().as_vec3().as_dvec3();
            match drawn[row].hit(origin, direction) {
                Some(hit) => hits.push((row as u32, hit)),
                None => missed += 1,
            }
            if hits.len() == max.min(HITS) {
                tried += compare(&shapes, &surface_data, &mut block, &mut hits);
            }
        }
        tried += compare(&shapes, &surface_data, &mut block, &mut hits);
    }
    assert!(tried > 1000, "{name}: {tried} hits and {missed} misses");
    eprintln!("{name}: {tried} hits, 0 differ");
}

macro_rules! for_each_shape {
    ($($kind:ident($shape:ty) $field:ident $plural:literal,)+) => {
        #[test]
        fn surfaces_together_are_surfaces_one_by_one() {
            $(
                let _ = ShapeKind::$kind;
                check_together::<$shape>($plural);
            )+
        }
    };
}
with_shapes!(for_each_shape);

/// Small whole numbers, so that many rays pass exactly through vertices, along edges and in planes; and thin triangles.
#[test]
fn triangles_hit_at_vertices_and_edges_are_the_same_together() {
    const TRIED: usize = 40_000;
    let (mut draws, mut block, mut tried) = (Draws::new(903, 0), HitBlock::default(), 0);
    let (mut shapes, mut faces, mut hits) = (Vec::new(), Vec::new(), Vec::new());
    for number in 0..TRIED {
        let mut point = || DVec3::from([0; 3].map(|_| draws.between(-2.0, 2.0).round()));
        let ([a, b, mut c], [origin, target]) = ([point(), point(), point()], [point(), point()]);
        if number % 4 == 0 {
            c = b + 1e-9 * (c - b);
        }
        let direction = if origin == target { DVec3::X } else { target - origin };
        let (row, face) = TriangleFace::of([a, b, c], [DVec2::ZERO, DVec2::X, DVec2::Y]);
        let t = triangle_t(origin, direction, &row);
        if t < f64::INFINITY {
            hits.push((shapes.len() as u32, RayHit::at_rest(origin, direction, t)));
            shapes.push(row);
            faces.push(face);
        }
        if hits.len() == HITS {
            tried += compare::<TriangleRow>(&shapes, &faces, &mut block, &mut hits);
            shapes.clear();
            faces.clear();
        }
    }
    eprintln!("{TRIED} rays, {tried} hits: 0 differ");
    assert!(tried > TRIED / 50);
}
