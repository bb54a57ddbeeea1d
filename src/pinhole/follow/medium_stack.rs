use crate::extract::NO_ROW;
use crate::intersect::GlassCrossing;

// ANCHOR: MediumStack
/// The media around a point in order of rank, the one that is present first; at most four of them.
///
/// Where glass shapes overlap, the one of the highest priority is present, and among equals the one spawned first,
/// whichever was entered first (Schmidt and Budge 2002).
/// Where more than four glass shapes may overlap, [`DeeperMedia`](super::DeeperMedia) holds the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MediumStack {
    /// Rows of the glass table in order of rank, each as often as its shapes contain the point; [`NO_ROW`] after them.
    pub rows: [u32; 4],
}

/// The media on both sides of a glass surface, and the stack on its far side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crossing {
    /// The glass on the near side; [`NO_ROW`] for none.
    pub near: u32,
    /// The glass on the far side; where it is the same, the surface has no effect.
    pub far: u32,
    /// The media around a point on the far side.
    pub beyond: MediumStack,
}

impl MediumStack {
    /// The stack outside all glass.
    pub const OUTSIDE: Self = Self { rows: [NO_ROW; 4] };

    /// The first four of the media around a point, which are given in order of rank, and the others.
    #[inline(always)]
    pub fn of(around: &[u32]) -> (Self, &[u32]) {
        let (first, beyond) = around.split_at(around.len().min(4));
        let mut rows = [NO_ROW; 4];
        rows[..first.len()].copy_from_slice(first);
        (Self { rows }, beyond)
    }

    /// The medium that is present; [`NO_ROW`] for none.
    #[inline(always)]
    pub fn top(self) -> u32 {
        self.rows[0]
    }

    /// The stack after entering a shape of this glass.
    #[inline(always)]
    pub fn entered(self, row: u32, priorities: &[u32]) -> Self {
        let outranks =
            |other: u32| other == NO_ROW || (priorities[row as usize], other) > (priorities[other as usize], row);
        let mut rows = self.rows;
        let (mut at, mut moved) = (0, row);
        // From its place on, every entry is pushed down by one.
        let mut found = false;
        while at < rows.len() {
            found = found || outranks(rows[at]);
            if found {
                std::mem::swap(&mut rows[at], &mut moved);
            }
            at += 1;
        }
        Self { rows }
    }

    /// The stack after leaving a shape of this glass; unchanged where the glass is not in it.
    #[inline(always)]
    pub fn left(self, row: u32) -> Self {
        let Some(place) = self.rows.iter().position(|own| *own == row) else { return self };
        let mut rows = self.rows;
        rows.copy_within(place + 1.., place);
        rows[3] = NO_ROW;
        Self { rows }
    }

    /// The media beyond several surfaces that are crossed together, in whatever order rounding found them.
    #[inline(always)]
    pub fn beyond_all(self, crossings: &[GlassCrossing], priorities: &[u32]) -> Self {
        let left = crossings.iter().filter(|own| !own.from_outside && self.rows.contains(&own.glass));
        // Those it is in are left first, so that there is room; a layer is entered and left, in this order.
        let mut stack = left.fold(self, |stack, own| stack.left(own.glass));
        for own in crossings.iter().filter(|own| own.from_outside) {
            stack = stack.entered(own.glass, priorities);
        }
        for own in crossings.iter().filter(|own| !own.from_outside && !self.rows.contains(&own.glass)) {
            stack = stack.left(own.glass);
        }
        stack
    }

    /// The medium that is present beyond several surfaces that are crossed together, where `deeper` are the media around
    /// the point beyond these four.
    pub fn top_beyond<'a>(
        self,
        deeper: &[u32],
        crossings: impl Iterator<Item = &'a GlassCrossing> + Clone,
        priorities: &[u32],
    ) -> u32 {
        let around = || self.rows.iter().chain(deeper).copied().filter(|&row| row != NO_ROW);
        let crossed = |row: u32, from_outside: bool| {
            crossings.clone().filter(|own| own.glass == row && own.from_outside == from_outside).count()
        };
        let is_there =
            |&row: &u32| around().filter(|&own| own == row).count() + crossed(row, true) > crossed(row, false);
        let entered = crossings.clone().filter(|own| own.from_outside).map(|own| own.glass);
        let there = around().chain(entered).filter(is_there);
        there.min_by_key(|&row| (std::cmp::Reverse(priorities[row as usize]), row)).unwrap_or(NO_ROW)
    }

    /// What a ray with this stack crosses at a surface of this glass, hit from outside or from inside.
    ///
    /// A ray that leaves a shape without having entered it was inside from the start.
    #[inline(always)]
    pub fn crossing(self, row: u32, from_outside: bool, priorities: &[u32]) -> Crossing {
        if from_outside {
            let beyond = self.entered(row, priorities);
            return Crossing { near: self.top(), far: beyond.top(), beyond };
        }
        let within = if self.rows.contains(&row) { self } else { self.entered(row, priorities) };
        let beyond = within.left(row);
        Crossing { near: within.top(), far: beyond.top(), beyond }
    }
}
// ANCHOR_END: MediumStack

#[cfg(test)]
mod tests {
    use super::*;

    /// All orders in which intervals along a ray can begin and end, each a list of the intervals that begin or end.
    fn orders(left: &mut Vec<u32>, order: &mut Vec<u32>, all: &mut Vec<Vec<u32>>) {
        if left.iter().all(|ends| *ends == 0) {
            all.push(order.clone());
        }
        for shape in 0..left.len() {
            if left[shape] > 0 {
                left[shape] -= 1;
                order.push(shape as u32);
                orders(left, order, all);
                order.pop();
                left[shape] += 1;
            }
        }
    }

    /// The medium by the rule: of the shapes around a point, the first of the highest priority.
    fn rule(inside: &[bool], glass: &[u32], priorities: &[u32]) -> u32 {
        let around = (0..inside.len()).filter(|&shape| inside[shape]).map(|shape| glass[shape]);
        around.min_by_key(|&row| (std::cmp::Reverse(priorities[row as usize]), row)).unwrap_or(NO_ROW)
    }

    /// Shapes that overlap in every order and with every priority, each of its own glass or some of the same; rays
    /// start outside, and also at every point between, with an unknown stack.
    #[test]
    fn every_order_and_priority() {
        let (mut walks, mut surfaces) = (0, 0);
        for shapes in 1..=4_usize {
            let mut all = Vec::new();
            orders(&mut vec![2; shapes], &mut Vec::new(), &mut all);
            let levels = shapes as u32;
            for order in &all {
                for code in 0..levels.pow(levels) * levels.pow(levels) {
                    if shapes == 4 && code % 499 != 0 {
                        continue;
                    }
                    let digit = |at: usize| code / levels.pow(at as u32) % levels;
                    let priorities: Vec<u32> = (0..shapes).map(digit).collect();
                    let glass: Vec<u32> = (0..shapes).map(|shape| digit(shape + shapes)).collect();
                    let mut inside = vec![false; shapes];
                    let mut stack = MediumStack::OUTSIDE;
                    for &shape in order {
                        let shape = shape as usize;
                        let crossing = stack.crossing(glass[shape], !inside[shape], &priorities);
                        assert_eq!(crossing.near, rule(&inside, &glass, &priorities), "{order:?} {priorities:?}");
                        // Crossing the same surface backwards gives the same media.
                        let back = crossing.beyond.crossing(glass[shape], inside[shape], &priorities);
                        assert_eq!((back.near, back.far, back.beyond), (crossing.far, crossing.near, stack));
                        inside[shape] = !inside[shape];
                        assert_eq!(crossing.far, rule(&inside, &glass, &priorities), "{order:?} {priorities:?}");
                        stack = crossing.beyond;
                        surfaces += 1;
                    }
                    assert_eq!(stack, MediumStack::OUTSIDE);
                    walks += 1;
                }
            }
        }
        eprintln!(
            "media: {walks} walks through 1 to 4 shapes, {surfaces} surfaces, all by the rule in both directions"
        );
    }

    /// Water in a glass whose sides overlap: with the higher priority of the wall, a ray finds air, wall and water,
    /// without an air gap.
    #[test]
    fn a_glass_of_water() {
        let (wall, water) = (0, 1);
        let priorities = [2, 1];
        // The outer side of the wall, the water's own side within the wall, the inner side of the wall.
        let surfaces = [(wall, true), (water, true), (wall, false)];
        let mut stack = MediumStack::OUTSIDE;
        let mut crossed = Vec::new();
        for (row, from_outside) in surfaces {
            let crossing = stack.crossing(row, from_outside, &priorities);
            crossed.push((crossing.near, crossing.far));
            stack = crossing.beyond;
        }
        assert_eq!(crossed, [(NO_ROW, wall), (wall, wall), (wall, water)], "the second surface has no effect");
    }

    #[test]
    fn begun_inside_and_a_fifth() {
        let priorities = [0, 1, 2, 3, 4];
        let begun = MediumStack::OUTSIDE.crossing(3, false, &priorities);
        assert_eq!((begun.near, begun.far, begun.beyond), (3, NO_ROW, MediumStack::OUTSIDE));
        let mut stack = MediumStack::OUTSIDE;
        for row in 0..5 {
            stack = stack.crossing(row, true, &priorities).beyond;
        }
        assert_eq!(stack.rows, [4, 3, 2, 1]);
        for row in (0..5).rev() {
            let crossing = stack.crossing(row, false, &priorities);
            assert_eq!(crossing.near, row);
            stack = crossing.beyond;
        }
        assert_eq!(stack, MediumStack::OUTSIDE);
    }
}
