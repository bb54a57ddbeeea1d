use crate::Placement;
use glam::{DAffine3, DMat3, DQuat, DVec3};

/// A matrix that is no product of a rotation and scales along the axes differs from the nearest by more than this
/// fraction of its size.
const SHEARED: f64 = 1e-9;
/// Rounds of rotations, of which a few suffice.
const ROUNDS: usize = 40;

/// The placements that a matrix stands for, the outermost first: one, or two where it shears; none where it is too flat
/// for that.
pub fn placements_of(matrix: &DAffine3) -> Option<Vec<Placement>> {
    let (scale, orientation, position) = matrix.to_scale_rotation_translation();
    let one = Placement { position, orientation, scale };
    if is_same(&[one], matrix.matrix3) {
        return Some(vec![one]);
    }
    let two = sheared(matrix);
    is_same(&two, matrix.matrix3).then(|| two.into())
}

/// Whether placements together are a matrix.
fn is_same(placements: &[Placement], matrix: DMat3) -> bool {
    let of = |own: &Placement| DMat3::from_quat(own.orientation) * DMat3::from_diagonal(own.scale);
    let placed = placements.iter().map(of).fold(DMat3::IDENTITY, |all, own| all * own);
    let greatest = |of: DMat3| of.to_cols_array().map(f64::abs).into_iter().fold(0.0, f64::max);
    let scales = placements.iter().all(|own| own.scale.is_finite() && own.scale.min_element() != 0.0);
    scales && greatest(placed - matrix) <= SHEARED * greatest(matrix)
}

/// The two placements of a matrix that shears: a rotation, then scales, then another rotation, which is its singular
/// value decomposition.
///
/// Columns are rotated in pairs until all are perpendicular (Hestenes 1958): A V = U Σ.
fn sheared(matrix: &DAffine3) -> [Placement; 2] {
    let size = matrix.matrix3.to_cols_array().map(f64::abs).into_iter().fold(f64::MIN_POSITIVE, f64::max);
    let mut columns = [0, 1, 2].map(|axis| matrix.matrix3.col(axis) / size);
    let mut turned = [DVec3::X, DVec3::Y, DVec3::Z];
    for _ in 0..ROUNDS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let (own, other, both) =
                (columns[p].length_squared(), columns[q].length_squared(), columns[p].dot(columns[q]));
            if both.abs() <= 1e-17 * (own * other).sqrt() {
                continue;
            }
            let ratio = (other - own) / (2.0 * both);
            let tangent = ratio.signum() / (ratio.abs() + (1.0 + ratio * ratio).sqrt());
            let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
            let sine = cosine * tangent;
            for pair in [&mut columns, &mut turned] {
                let [x, y] = [pair[p], pair[q]];
                pair[p] = cosine * x - sine * y;
                pair[q] = sine * x + cosine * y;
            }
        }
    }
    let lengths = columns.map(DVec3::length);
    let [x, y] = [columns[0] / lengths[0], columns[1] / lengths[1]];
    // A rotation has no mirroring; that is in the last scale.
    let z = x.cross(y);
    let outer = DMat3::from_cols(x, y, z);
    let last = if columns[2].dot(z) < 0.0 { -lengths[2] } else { lengths[2] };
    let inner = DMat3::from_cols_array_2d(&turned.map(|axis| axis.to_array())).transpose();
    let scale = DVec3::new(lengths[0], lengths[1], last) * size;
    [
        Placement { position: matrix.translation, orientation: DQuat::from_mat3(&outer), scale },
        Placement { position: DVec3::ZERO, orientation: DQuat::from_mat3(&inner), scale: DVec3::ONE },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draws::Draws;

    /// Matrices of every kind, sheared, mirrored, rounded to f32 and nearly flat ones among them.
    #[test]
    fn placements_together_are_the_matrix() {
        let (mut one, mut two) = (0, 0);
        for index in 0..4000 {
            let mut draws = Draws::new(1958, index);
            let mut column = || draws.unit_vector() * draws.power_of_ten(-3.0, 3.0);
            let mut matrix = DMat3::from_cols(column(), column(), column());
            match index % 4 {
                0 => matrix = DMat3::from_diagonal(matrix.col(0)),
                1 => matrix = DMat3::from_cols_array(&matrix.to_cols_array().map(|part| f64::from(part as f32))),
                2 => matrix.x_axis = -matrix.x_axis,
                _ => {}
            }
            let translation = DVec3::new(1.0, 2.0, 3.0);
            let placed = placements_of(&DAffine3::from_mat3_translation(matrix, translation)).expect("placements");
            assert!(is_same(&placed, matrix) && placed[0].position == translation, "{index}");
            one += u32::from(placed.len() == 1);
            two += u32::from(placed.len() == 2);
        }
        eprintln!("matrices: {one} of one placement, {two} of two");
        assert!(one >= 1000 && two >= 2500);
    }
}
