//! Boxes: rays along axes and in faces, no box missed that a ray hits, and few hit that it misses.

use glam::{DVec3, Vec3};
use pinhole::bvh::{BoundingBox, BoxPacket, BoxRay, Child, PACKET, ROW, ROWS, WIDTH, WideNode};
use pinhole::shapes::Slabs;
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::oracle_cuboid::cuboid_hit;
use pinhole_lab::naive::boxes::{enters, enters_by_min_and_max};

/// A node whose last child is this box; a ray that enters nothing else may enter only that one.
fn node_of(around: &BoundingBox) -> WideNode {
    let mut node = WideNode::empty();
    node.set(WIDTH - 1, Child::leaf(0), around);
    node
}

fn entered(origin: DVec3, direction: DVec3, around: &BoundingBox, t_max: f64) -> bool {
    let ray = BoxRay::new(origin, direction, around);
    let mask = ray.enters(&node_of(around), ray.limit(t_max), &mut [0.0; WIDTH]);
    assert!(mask == 0 || mask == 1 << (8 * (WIDTH - 1)), "an empty box was entered");
    mask != 0
}

/// The same by a packet whose rays are all this one: all at once, and by a row.
fn entered_by_packet(origin: DVec3, direction: DVec3, around: &BoundingBox) -> [bool; 2] {
    let all = |vector: DVec3| vector.to_array().map(|part| [[part; ROW]; ROWS]);
    let mut packet = BoxPacket::default();
    packet.set(&all(origin), &all(direction), direction.abs().max_element());
    let node = node_of(around);
    let mask = packet.enters(&node, f32::INFINITY, &mut [0.0; WIDTH]);
    [mask != 0, packet.row_enters(&node, WIDTH - 1, 0, &[f32::INFINITY; ROW])]
}

/// Every sign of a direction, a zero of either sign among them; origins below, on, in, on and above each slab, which may
/// be flat; whether a ray hits is found by walking along it.
#[test]
fn no_ray_along_axes_or_in_faces_gets_a_wrong_answer() {
    assert_eq!(PACKET, ROW * ROWS);
    let three = |values: &[f64]| -> Vec<DVec3> {
        let pairs = values.iter().flat_map(|&x| values.iter().map(move |&y| (x, y)));
        pairs.flat_map(|(x, y)| values.iter().map(move |&z| DVec3::new(x, y, z))).collect()
    };
    let directions = three(&[-1.0, -0.0, 0.0, 1.0]).into_iter().filter(|direction| *direction != DVec3::ZERO);
    let directions: Vec<DVec3> = directions.collect();
    let (origins, flat) = (three(&[-2.0, -1.0, 0.0, 1.0, 2.0]), three(&[0.0, 1.0]));
    let (mut tried, mut lost_by_min_and_max, mut wrong) = (0, 0, Vec::new());
    for (half, origin) in flat.iter().flat_map(|half| origins.iter().map(move |origin| (*half, *origin))) {
        let sides = [-half, half];
        let around = BoundingBox::around(sides[0], sides[1]);
        for &direction in &directions {
            for t_max in [f64::INFINITY, 0.5, 1.0, 2.5] {
                // All that happens on such a ray happens at whole t, up to 3.
                let is_in = |t: &f64| {
                    let at = origin + *t * direction;
                    *t <= t_max && at.cmpge(sides[0]).all() && at.cmple(sides[1]).all()
                };
                let expected = [0.0, 1.0, 2.0, 3.0].iter().any(is_in);
                let mut answers = vec![
                    ("a node", entered(origin, direction, &around, t_max)),
                    ("the plain test", enters(origin, direction.recip(), sides, t_max)),
                ];
                if t_max.is_infinite() {
                    let [all, row] = entered_by_packet(origin, direction, &around);
                    answers.extend([("a packet", all), ("a row of a packet", row)]);
                }
                tried += answers.len();
                let is_wrong = |&(what, answer): &(&'static str, bool)| (answer != expected).then_some(what);
                let bad = answers.iter().filter_map(is_wrong);
                wrong
                    .extend(bad.map(|what| format!("{what}: {origin} {direction} half {half} to {t_max}, {expected}")));
                let lost = expected && !enters_by_min_and_max(origin, direction.recip(), sides, t_max);
                lost_by_min_and_max += u32::from(lost);
            }
        }
    }
    eprintln!("{tried} answers, {} wrong; min and max lose {lost_by_min_and_max} rays", wrong.len());
    assert!(wrong.is_empty(), "{} of {tried}, the first: {:?}", wrong.len(), &wrong[..wrong.len().min(5)]);
    assert!(lost_by_min_and_max > 1000, "{lost_by_min_and_max}");
}

/// Rays at edges and corners of boxes of any size, from near and far; what they hit is known from exact arithmetic.
#[test]
fn a_box_may_be_hit_falsely_and_is_never_missed_falsely() {
    const RAYS: u64 = 40_000;
    let (mut missed, mut hits, mut falsely) = (0, 0, 0);
    for index in 0..RAYS {
        let mut draws = Draws::new(2902, index);
        let mut three = |extent: f64| DVec3::from([(); 3].map(|()| draws.between(-extent, extent)));
        let (centre, half) = (three(2.0).as_vec3(), three(1.0).abs().as_vec3());
        // A corner, or a place on one of its three edges.
        let along = three(1.0).as_vec3();
        let distance = draws.power_of_ten(-2.0, 4.0);
        let free = (draws.unit() * 4.0) as usize;
        let mut target = half;
        if free < 3 {
            target[free] *= along[free];
        }
        let target = centre + target;
        let origin = (target.as_dvec3() + distance * draws.unit_vector()).as_vec3();
        let direction = (target.as_dvec3() - origin.as_dvec3()).normalize().as_vec3();
        let around = BoundingBox { low: (centre - half).to_array(), high: (centre + half).to_array() };
        // The oracle's box is the one with these corners, exactly.
        let [low, high] = [around.low, around.high].map(|side| Vec3::from(side).as_dvec3());
        let half = 0.5 * (high - low);
        let edges = [DVec3::X * half.x, DVec3::Y * half.y, DVec3::Z * half.z];
        let exact = cuboid_hit(origin, direction, &Slabs::new(0.5 * (low + high), DVec3::AXES, edges)).is_some();
        let answer = entered(origin.as_dvec3(), direction.as_dvec3(), &around, f64::INFINITY);
        hits += u64::from(exact);
        missed += u64::from(exact && !answer);
        falsely += u64::from(answer && !exact);
    }
    let misses = RAYS - hits;
    eprintln!("{RAYS} rays at edges: {hits} hit, {missed} of them missed; {falsely} of {misses} misses count as hits");
    assert_eq!(missed, 0);
    assert!(hits > RAYS / 4 && misses > RAYS / 4, "{hits}");
}
