/// How many dimensions each leg of a light's way has, some of them kept for purposes to come.
pub const DIMENSIONS: u32 = 16;

/// What a random number is for.
///
/// Each purpose has dimensions of its own, whether or not a scene uses the others: so a stage that is left out shifts
/// nobody's numbers.
/// Those that matter most come first, for the first dimensions of a Sobol sequence are the most even together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Where in the pixel, to the right and downward.
    Pixel,
    /// Where on the lens.
    Lens,
    /// Where on a light.
    LightPoint,
    /// Which way from a surface.
    Direction,
    /// Which light.
    LightChoice,
    /// Which part of a surface's matter.
    MaterialChoice,
    /// Whether the way ends here.
    Roulette,
    /// When, while the shutter is open.
    Time,
    /// Where in the environment.
    EnvironmentPoint,
}

impl Purpose {
    /// All, in the order of their dimensions.
    pub const ALL: [Self; 9] = [
        Self::Pixel,
        Self::Lens,
        Self::LightPoint,
        Self::Direction,
        Self::LightChoice,
        Self::MaterialChoice,
        Self::Roulette,
        Self::Time,
        Self::EnvironmentPoint,
    ];

    /// How many numbers it needs: 1 or 2.
    pub const fn numbers(self) -> u32 {
        match self {
            Self::Pixel | Self::Lens | Self::LightPoint | Self::Direction | Self::EnvironmentPoint => 2,
            Self::LightChoice | Self::MaterialChoice | Self::Roulette | Self::Time => 1,
        }
    }

    /// Its first dimension on a leg of the light's way; leg 0 is the one to the eye.
    #[inline(always)]
    pub const fn dimension(self, depth: u32) -> u32 {
        let within = match self {
            Self::Pixel => 0,
            Self::Lens => 2,
            Self::LightPoint => 4,
            Self::Direction => 6,
            Self::LightChoice => 8,
            Self::MaterialChoice => 9,
            Self::Roulette => 10,
            Self::Time => 11,
            Self::EnvironmentPoint => 12,
        };
        depth * DIMENSIONS + within
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_purposes_share_a_dimension() {
        let mut taken = Vec::new();
        for depth in 0..3 {
            for purpose in Purpose::ALL {
                for number in 0..purpose.numbers() {
                    let dimension = purpose.dimension(depth) + number;
                    assert!(dimension / DIMENSIONS == depth, "{purpose:?} leaves its leg");
                    assert!(!taken.contains(&dimension), "{purpose:?} of leg {depth} shares dimension {dimension}");
                    taken.push(dimension);
                }
            }
        }
        eprintln!("purposes: {} dimensions of 3 legs, no two alike", taken.len());
    }
}
