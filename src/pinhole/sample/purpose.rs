/// The number of dimensions per bounce, some of which are reserved.
pub const DIMENSIONS: u32 = 16;

/// What a random number is used for.
///
/// Each purpose has dimensions of its own, whether or not a scene uses the others, so that a stage that is left out
/// does not shift the numbers of the rest.
/// Which of them are drawn together is the sampler's to say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// The position in the pixel, to the right and downward.
    Pixel,
    /// The point of the lens.
    Lens,
    /// The point on an area light.
    LightPoint,
    /// The direction sampled from a BSDF.
    Direction,
    /// The choice of a light.
    LightChoice,
    /// The choice of a lobe of the BSDF, such as reflection or refraction.
    MaterialChoice,
    /// Russian roulette.
    Roulette,
    /// The time while the shutter is open.
    Time,
    /// The point of the environment map.
    EnvironmentPoint,
    /// The choice of one of many lights without an area.
    DeltaLightChoice,
    /// The wavelength of a path.
    Wavelength,
    /// The distance to a scattering event in a medium.
    Distance,
}

impl Purpose {
    /// All purposes.
    pub const ALL: [Self; 12] = [
        Self::Pixel,
        Self::Lens,
        Self::LightPoint,
        Self::Direction,
        Self::LightChoice,
        Self::MaterialChoice,
        Self::Roulette,
        Self::Time,
        Self::EnvironmentPoint,
        Self::DeltaLightChoice,
        Self::Wavelength,
        Self::Distance,
    ];

    /// The number of dimensions that it needs: 1 or 2.
    pub const fn numbers(self) -> u32 {
        match self {
            Self::Pixel | Self::Lens | Self::LightPoint | Self::Direction | Self::EnvironmentPoint => 2,
            Self::LightChoice
            | Self::MaterialChoice
            | Self::Roulette
            | Self::Time
            | Self::DeltaLightChoice
            | Self::Wavelength
            | Self::Distance => 1,
        }
    }

    /// Its first dimension at a bounce; depth 0 is the camera ray.
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
            Self::DeltaLightChoice => 14,
            Self::Wavelength => 15,
            // A bounce has no dimension left; these are counted from the end, where no path comes.
            Self::Distance => return u32::MAX - depth,
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
                    let is_within = dimension / DIMENSIONS == depth || purpose == Purpose::Distance;
                    assert!(is_within, "{purpose:?} exceeds its bounce");
                    assert!(
                        !taken.contains(&dimension),
                        "{purpose:?} at depth {depth} has dimension {dimension} in common with another"
                    );
                    taken.push(dimension);
                }
            }
        }
        eprintln!("purposes: {} dimensions at 3 depths, all distinct", taken.len());
    }
}
