use crate::sample::disk_point;
use glam::{DMat3, DVec3};
use std::f64::consts::FRAC_1_PI;

// ANCHOR: frame_of
/// An orthonormal frame about a unit normal: two tangents and the normal, the columns of a rotation.
///
/// The sign of the normal's z keeps the divisor at 1 or more, so no normal is a special case (Duff et al. 2017).
#[inline(always)]
pub fn frame_of(normal: DVec3) -> DMat3 {
    let sign = 1.0_f64.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    DMat3::from_cols(
        DVec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
        DVec3::new(b, sign + normal.y * normal.y * a, -normal.y),
        normal,
    )
}
// ANCHOR_END: frame_of

// ANCHOR: cosine_direction
/// A cosine-weighted direction about +z: two numbers in [0, 1) give a uniform point of the unit disk, which is
/// projected up to the hemisphere (Malley's method).
#[inline(always)]
pub fn cosine_direction(u: [f64; 2]) -> DVec3 {
    let on_disk = disk_point(u);
    let [x, y] = on_disk.point();
    DVec3::new(x, y, (1.0 - on_disk.squared()).sqrt())
}

/// The pdf of [`cosine_direction`] for directions of this cosine, in 1/sr; 0 at the horizon and below.
#[inline(always)]
pub fn cosine_pdf(cosine: f64) -> f64 {
    cosine.max(0.0) * FRAC_1_PI
}
// ANCHOR_END: cosine_direction

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::chi_squared::{Bins, p_value};
    use crate::measure::draws::Draws;
    use std::f64::consts::TAU;

    /// The rounding unit of f64.
    const U: f64 = 0.5 * f64::EPSILON;

    #[test]
    fn frames_are_orthonormal() {
        let mut worst = 0.0_f64;
        let special = [DVec3::Z, -DVec3::Z, DVec3::X, -DVec3::Y, DVec3::new(0.0, 0.0, -0.0)];
        let near_pole = (0..20_000).map(|index| {
            let mut draws = Draws::new(191, index);
            let (across, size) = (draws.unit_vector_across(DVec3::Z), draws.power_of_ten(-160.0, 0.0));
            (across * size - DVec3::Z).normalize()
        });
        let anywhere = (0..20_000).map(|index| Draws::new(192, index).unit_vector().normalize());
        for normal in special.into_iter().take(4).chain(near_pole).chain(anywhere) {
            let DMat3 { x_axis: x, y_axis: y, z_axis: z } = frame_of(normal);
            let off = [x.dot(y), x.dot(z), y.dot(z), x.length_squared() - 1.0, y.length_squared() - 1.0];
            worst = off.into_iter().fold(worst, |worst, off| worst.max(off.abs()));
            assert!((x.cross(y) - z).length() < 16.0 * U, "{normal} is not right-handed");
            let there = frame_of(normal).transpose() * normal;
            assert!((there - DVec3::Z).length() < 16.0 * U);
        }
        eprintln!("frames: 40004 normals, half about the pole; worst {:.1} u of f64", worst / U);
        assert!(worst <= 8.0 * U, "{worst}");
    }

    #[test]
    fn no_direction_lies_at_or_below_the_horizon() {
        const LAST: f64 = 1.0 - 1.0 / (1 << 24) as f64;
        let corners = [0.0, 1.0 / (1 << 24) as f64, 0.5, LAST];
        let mut tried = 0;
        for u in corners {
            for v in corners {
                let local = cosine_direction([u, v]);
                assert!(local.z >= 1.0 / 4096.0 && (local.length() - 1.0).abs() < 4.0 * U, "{u} {v}: {local}");
                assert!(cosine_pdf(local.z) > 0.0);
                for index in 0..500 {
                    // As in the stages, the normal and the direction are rounded to f32.
                    let normal = Draws::new(193, index).unit_vector().as_vec3();
                    let world = (frame_of(normal.as_dvec3().normalize()) * local).as_vec3();
                    assert!(normal.as_dvec3().dot(world.as_dvec3()) > 0.0, "{normal} {world}");
                    tried += 1;
                }
            }
        }
        assert_eq!([cosine_pdf(0.0), cosine_pdf(-0.5)], [0.0; 2]);
        eprintln!("cosine directions: {tried} of the hardest numbers, all above the horizon");
    }

    #[test]
    fn directions_have_their_pdf() {
        const SAMPLES: u64 = 200_000;
        // Bins of cosine and azimuth; ∫ cos θ / π over each is a difference of squares.
        let (rings, sectors) = (20, 30);
        let mut bins = Bins::new(rings * sectors);
        for ring in 0..rings {
            let [low, high] = [ring, ring + 1].map(|at| at as f64 / rings as f64);
            let fraction = (high * high - low * low) / sectors as f64;
            (0..sectors).for_each(|sector| bins.expect(ring * sectors + sector, fraction * SAMPLES as f64));
        }
        for index in 0..SAMPLES {
            let mut draws = Draws::new(194, index);
            let direction = cosine_direction([draws.unit(), draws.unit()]);
            let turn = libm::atan2(direction.y, direction.x) / TAU;
            let sector = ((turn - turn.floor()) * sectors as f64) as usize;
            bins.count((direction.z * rings as f64) as usize * sectors + sector.min(sectors - 1));
        }
        let (statistic, freedom) = bins.statistic();
        let p = p_value(statistic, freedom);
        eprintln!("cosine directions: chi squared {statistic:.1} of {freedom} degrees of freedom, p {p:.3}");
        assert!(p > 1e-3);
    }
}
