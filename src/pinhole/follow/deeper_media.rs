use super::{Media, MediumStack};
use crate::extract::{NO_ROW, deep_glass, followed_evidence, glass_evidence};
use crate::intersect::GlassCrossing;
use crate::plan::{Census, Column, ColumnComponent, ComponentValues, Evidence, Lifetime, RowLists, column_component};

/// The media around each ray's origin beyond the four that [`Media`] holds, in order of rank; exists only where more
/// than four glass shapes may overlap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeeperMedia(
    /// Rows of the glass table.
    pub RowLists<u32>,
);

/// The glass on the near side of a glass surface and on the far side: like [`MediumStack::crossing`], but including the
/// media beyond the fourth.
#[inline(always)]
pub(super) fn near_and_far(
    stack: MediumStack,
    beyond: &[u32],
    row: u32,
    from_outside: bool,
    priorities: &[u32],
) -> [u32; 2] {
    // A ray that leaves a glass not among the first four stays in the first one.
    if !from_outside && !stack.rows.contains(&row) && beyond.contains(&row) {
        return [stack.top(); 2];
    }
    let crossing = stack.crossing(row, from_outside, priorities);
    [crossing.near, crossing.far]
}

/// Collects the media of the scattered rays, one ray after another.
#[derive(Default)]
pub struct Carrier {
    whole: Vec<u32>,
    kept: DeeperMedia,
}

impl Carrier {
    /// Clears the rays of the previous tile.
    pub(super) fn start(&mut self) {
        self.kept.0.start(0);
    }

    /// Appends the media of a ray scattered from another, which crossed these surfaces of glass; returns the first four.
    pub(super) fn push(
        &mut self,
        (stack, beyond): (MediumStack, &[u32]),
        crossed: &[GlassCrossing],
        priorities: &[u32],
    ) -> MediumStack {
        let whole = &mut self.whole;
        whole.clear();
        whole.extend(stack.rows.iter().filter(|&&row| row != NO_ROW));
        whole.extend_from_slice(beyond);
        for row in crossed.iter().filter(|own| own.from_outside).map(|own| own.glass) {
            let outranks = |&other: &u32| (priorities[row as usize], other) > (priorities[other as usize], row);
            let place = whole.iter().position(outranks).unwrap_or(whole.len());
            whole.insert(place, row);
        }
        for row in crossed.iter().filter(|own| !own.from_outside).map(|own| own.glass) {
            if let Some(place) = whole.iter().position(|&own| own == row) {
                whole.remove(place);
            }
        }
        let (first, beyond) = MediumStack::of(whole);
        self.kept.0.push(beyond);
        first
    }

    /// Exchanges the collected media with those of the column.
    pub(super) fn swap(&mut self, with: &mut DeeperMedia) {
        std::mem::swap(&mut self.kept, with);
    }
}

column_component!(DeeperMedia);

impl Column for DeeperMedia {
    const NAME: &'static str = "deeper media";
    const SPACE: &'static str = "light";
    const UNIT: &'static str = "places in a list of glass";
    const LIFETIME: Lifetime = Lifetime::Path;

    fn rows(&self) -> usize {
        self.0.ends().len()
    }

    fn components(&self) -> Vec<ColumnComponent<'_>> {
        vec![ColumnComponent { name: "end", values: ComponentValues::U32(self.0.ends()) }]
    }

    fn paint(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [f32::from(u8::from(!self.0.get(row).is_empty())); 3]
    }
}

/// Evidence that a ray may be inside more than four glass shapes at once.
pub fn deeper_media_evidence(scene: &Census<'_>) -> Evidence {
    glass_evidence(scene).and(|| followed_evidence(scene)).and(|| deep_glass(scene, Media::PLACES))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::ray_aim::Draws;

    /// Random walks in and out of nine glass shapes; the medium at each point must be the one of the highest priority,
    /// and among equals the first.
    #[test]
    fn the_medium_is_right_at_any_depth() {
        const SHAPES: usize = 9;
        let (mut surfaces, mut deepest) = (0, 0);
        for walk in 0..3000 {
            let mut draws = Draws::new(1717, walk);
            let below = |draws: &mut Draws, max: usize| (draws.unit() * max as f64) as usize;
            let priorities: Vec<u32> = (0..SHAPES).map(|_| below(&mut draws, 4) as u32).collect();
            let glass: Vec<u32> = (0..SHAPES).map(|_| below(&mut draws, SHAPES) as u32).collect();
            let rule = |inside: &[bool]| {
                let around = (0..SHAPES).filter(|&shape| inside[shape]).map(|shape| glass[shape]);
                around.min_by_key(|&row| (std::cmp::Reverse(priorities[row as usize]), row)).unwrap_or(NO_ROW)
            };
            let (mut inside, mut stack, mut beyond) = ([false; SHAPES], MediumStack::OUTSIDE, DeeperMedia::default());
            beyond.0.start(1);
            let mut carrier = Carrier::default();
            for _ in 0..40 {
                let shape = below(&mut draws, SHAPES);
                let (row, from_outside) = (glass[shape], !inside[shape]);
                let [near, far] = near_and_far(stack, beyond.0.get(0), row, from_outside, &priorities);
                assert_eq!(near, rule(&inside), "walk {walk}");
                inside[shape] = !inside[shape];
                assert_eq!(far, rule(&inside), "walk {walk}");
                carrier.start();
                let crossed = [GlassCrossing { glass: row, from_outside, depth: 0.0 }];
                stack = carrier.push((stack, beyond.0.get(0)), &crossed, &priorities);
                carrier.swap(&mut beyond);
                let depth = stack.rows.iter().filter(|&&row| row != NO_ROW).count() + beyond.0.get(0).len();
                assert_eq!(depth, inside.iter().filter(|&&inside| inside).count(), "nothing is forgotten");
                deepest = deepest.max(depth);
                surfaces += 1;
            }
        }
        assert!(deepest > 7, "only {deepest} deep");
        eprintln!("deeper media: {surfaces} surfaces, up to {deepest} shapes about a point");
    }
}
