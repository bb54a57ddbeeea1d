use glam::DVec3;

// ANCHOR: mirror_direction
/// The direction of specular reflection: `direction` points towards the surface, both are unit vectors.
#[inline(always)]
pub fn mirror_direction(direction: DVec3, normal: DVec3) -> DVec3 {
    direction - 2.0 * direction.dot(normal) * normal
}
// ANCHOR_END: mirror_direction

/// (η − 1)(η + 1) + c²: the square of η cos θt, below 0 for total internal reflection.
///
/// Written as η² − 1 + c², it would lose digits where the two media hardly differ.
#[inline(always)]
fn far_cosine_squared(cosine: f64, eta: f64) -> f64 {
    (eta - 1.0) * (eta + 1.0) + cosine * cosine
}

// ANCHOR: refract
/// The direction of refraction into a medium of relative index η; none for total internal reflection.
///
/// `direction` and `normal` are unit vectors, and the normal is on the side that the light comes from.
/// The component along the surface is divided by η (Snell's law), and the rest follows from the length of 1.
#[inline(always)]
pub fn refract(direction: DVec3, normal: DVec3, eta: f64) -> Option<DVec3> {
    let cosine = -direction.dot(normal);
    let squared = far_cosine_squared(cosine, eta);
    if squared < 0.0 {
        return None;
    }
    Some((direction + (cosine - squared.sqrt()) * normal) / eta)
}
// ANCHOR_END: refract

// ANCHOR: fresnel
/// The Fresnel reflectances of a smooth dielectric surface for s- and p-polarised light; `cosine` is that of the angle
/// of incidence, at least 0, and η is the index of the far medium over that of the near one.
///
/// With g = η cos θt, the amplitudes are r_s = (c − g)/(c + g) and r_p = r_s · (c(c + g) − 1)/(c(g − c) + 1).
/// c − g is computed as (1 − η²)/(c + g), which loses nothing where the two are nearly equal.
#[inline(always)]
pub fn fresnel_parts(cosine: f64, eta: f64) -> [f64; 2] {
    let squared = far_cosine_squared(cosine, eta);
    if squared < 0.0 {
        return [1.0; 2];
    }
    let sum = cosine + squared.sqrt();
    if sum == 0.0 {
        // At grazing incidence between equal media.
        return [0.0; 2];
    }
    let difference = (eta - 1.0) * (eta + 1.0) / sum;
    let across = difference / sum;
    let within = across * (cosine * sum - 1.0) / (cosine * difference + 1.0);
    [(across * across).min(1.0), (within * within).min(1.0)]
}

/// The Fresnel reflectance of unpolarised light: the mean of the two reflectances.
#[inline(always)]
pub fn fresnel(cosine: f64, eta: f64) -> f64 {
    let [across, within] = fresnel_parts(cosine, eta);
    0.5 * (across + within)
}
// ANCHOR_END: fresnel

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use crate::measure::exact::Dyadic;

    const ONE: f64 = 1.0;

    /// The reflectance in exact arithmetic, but for roots and quotients with errors below 2⁻³⁰⁰.
    fn exact_fresnel(cosine: f64, eta: f64) -> f64 {
        let (c, one) = (Dyadic::of(cosine), Dyadic::of(ONE));
        let eta = Dyadic::of(eta);
        let squared = &(&eta.squared() - &one) + &c.squared();
        if squared.sign() < 0 {
            return 1.0;
        }
        let g = squared.square_root();
        // η t = g: r_s = (c − g)/(c + g), r_p = (η² c − g)/(η² c + g).
        let dense = &eta.squared() * &c;
        let reflectance = |a: &Dyadic| (a - &g).divided_by(&(a + &g)).squared();
        (&reflectance(&c) + &reflectance(&dense)).scaled(-1).to_f64()
    }

    #[test]
    fn reflectances_against_exact_arithmetic() {
        // η ≥ 1; η < 1 away from the critical angle; within 200 units in the last place of the critical angle.
        let mut worst = [0.0_f64; 3];
        let mut tried = [0; 3];
        for index in 0..6000 {
            let mut draws = Draws::new(1941, index);
            let near_one = ONE + draws.power_of_ten(-15.0, 0.0);
            let eta = if index % 2 == 0 { near_one } else { draws.power_of_ten(0.0, 1.5) };
            let cosine = if index % 3 == 0 { draws.power_of_ten(-12.0, 0.0) } else { draws.unit().max(1e-9) };
            let off = |eta: f64, cosine: f64| (fresnel(cosine, eta) - exact_fresnel(cosine, eta)).abs();
            (worst[0], tried[0]) = (worst[0].max(off(eta, cosine)), tried[0] + 1);
            let thin = ONE / eta;
            let critical = ((ONE - thin) * (ONE + thin)).sqrt();
            if (cosine - critical).abs() > 1e-3 * critical {
                (worst[1], tried[1]) = (worst[1].max(off(thin, cosine)), tried[1] + 1);
            }
            let near = f64::from_bits((critical.to_bits() as i64 + draws.between(-200.0, 200.0) as i64) as u64);
            if near <= ONE {
                (worst[2], tried[2]) = (worst[2].max(off(thin, near)), tried[2] + 1);
            }
        }
        eprintln!("fresnel: {tried:?} reflectances, worst errors {worst:?}: denser, thinner, at the critical angle");
        assert!(worst[0] <= 1e-14 && worst[1] <= 1e-12 && worst[2] <= 3e-4, "{worst:?}");
        assert!(tried.iter().all(|tried| *tried > 5000), "{tried:?}");
    }

    #[test]
    fn closed_forms() {
        for index in 0..10_000 {
            let mut draws = Draws::new(1942, index);
            assert_eq!(fresnel(draws.unit(), 1.0), 0.0, "one medium");
            let eta = draws.power_of_ten(-2.0, 2.0);
            let normal = (eta - 1.0) / (eta + 1.0);
            assert!((fresnel(1.0, eta) - normal * normal).abs() < 1e-15 / eta.min(1.0), "η {eta}, normal incidence");
            if eta != 1.0 {
                assert!((fresnel(0.0, eta) - 1.0).abs() < 1e-15, "η {eta}, grazing incidence");
            }
            // The tangent of Brewster's angle is η.
            let brewster = 1.0 / libm::sqrt(1.0 + eta * eta);
            let [across, within] = fresnel_parts(brewster, eta);
            assert!(within < 1e-15 && across > 0.0 || (eta - 1.0).abs() < 1e-9, "η {eta}: {across} {within}");
            // The reflectance is the same from either side.
            let cosine = draws.between(0.05, 1.0);
            let far = libm::sqrt((eta - 1.0) * (eta + 1.0) + cosine * cosine) / eta;
            if far > 1e-3 {
                assert!((fresnel(cosine, eta) - fresnel(far, 1.0 / eta)).abs() < 1e-9, "η {eta}, cos {cosine}");
            }
        }
        assert_eq!([fresnel(0.0, 1.0), fresnel(0.1, 0.5), fresnel(0.0, 0.5)], [0.0, 1.0, 1.0]);
        eprintln!("fresnel: 10000 indices at normal and grazing incidence, at Brewster's angle and reversed");
    }

    #[test]
    fn refraction_obeys_snell_and_can_be_reversed() {
        let (mut worst, mut through, mut back) = ([0.0_f64; 3], 0, 0);
        for index in 0..40_000 {
            let mut draws = Draws::new(1943, index);
            let eta = draws.power_of_ten(-0.7, 0.7);
            let normal = draws.unit_vector().normalize();
            let cosine = if index % 4 == 0 { draws.power_of_ten(-9.0, 0.0) } else { draws.unit() };
            let across = draws.unit_vector_across(normal);
            let direction = (across * libm::sqrt(1.0 - cosine * cosine) - normal * cosine).normalize();
            let mirrored = mirror_direction(direction, normal);
            assert!((mirrored.dot(normal) + direction.dot(normal)).abs() < 4e-15);
            assert!((mirrored.cross(normal) - direction.cross(normal)).length() < 4e-15);
            let Some(bent) = refract(direction, normal, eta) else {
                let sine = direction.cross(normal).length();
                assert!(sine / eta > 1.0 - 1e-12, "{index}: total internal reflection at sin {sine}, η {eta}");
                assert_eq!(fresnel(-direction.dot(normal), eta), 1.0);
                back += 1;
                continue;
            };
            through += 1;
            let snell = (bent.cross(normal) * eta - direction.cross(normal)).length();
            let length = (bent.length() - 1.0).abs();
            (worst[0], worst[1]) = (worst[0].max(snell), worst[1].max(length));
            assert!(bent.dot(normal) <= 0.0);
            // Reversed from the far side; near the critical angle and near grazing, a rounding error grows to its
            // square root.
            let leaves = -bent.dot(normal);
            if let Some(again) = refract(-bent, -normal, 1.0 / eta) {
                let doubt = 2e-13 / leaves.min(cosine).max(1e-6);
                assert!((again + direction).length() < doubt, "{index}: {again} {direction}");
                worst[2] = worst[2].max((again + direction).length() * leaves.min(cosine));
            } else {
                assert!(eta > 1.0 && cosine < 1e-7, "{index}: no refraction back");
            }
        }
        eprintln!("refraction: {through} transmitted, {back} totally reflected; Snell, length, reversal {worst:?}");
        assert!(worst[0] < 1e-12 && worst[1] < 1e-12, "{worst:?}");
        assert!(through > 20_000 && back > 5_000);
    }
}
