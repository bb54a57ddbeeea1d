use crate::extract::NO_ROW;

// ANCHOR: MediumStack
/// The kinds of glass that a point lies in, the one that is there first; the first four of them.
///
/// Of those whose shapes hold the point the one of the highest priority is there, and of equals the one that was
/// spawned first, whichever was entered first (Schmidt and Budge 2002).
/// Where more than four shapes of glass may hold a point, [`DeeperMedia`](super::DeeperMedia) knows the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MediumStack {
    /// Rows of the table of glass in order of rank, each as often as its shapes hold the point; [`NO_ROW`] after them.
    pub rows: [u32; 4],
}

/// What is on both sides of a surface of glass, and what the far side's point lies in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crossing {
    /// The glass on the near side; [`NO_ROW`] for none.
    pub near: u32,
    /// That on the far side; where it is the same, the surface is none.
    pub far: u32,
    /// What the far side's point lies in.
    pub beyond: MediumStack,
}

impl MediumStack {
    /// Outside all glass.
    pub const OUTSIDE: Self = Self { rows: [NO_ROW; 4] };

    /// The glass that is there; [`NO_ROW`] for none.
    #[inline(always)]
    pub fn top(self) -> u32 {
        self.rows[0]
    }

    /// With one more shape of this glass about it.
    #[inline(always)]
    fn entered(self, row: u32, priorities: &[u32]) -> Self {
        let outranks =
            |other: u32| other == NO_ROW || (priorities[row as usize], other) > (priorities[other as usize], row);
        let mut rows = self.rows;
        let (mut at, mut carried) = (0, row);
        // Once the place is found, each is pushed one further down.
        let mut found = false;
        while at < rows.len() {
            found = found || outranks(rows[at]);
            if found {
                std::mem::swap(&mut rows[at], &mut carried);
            }
            at += 1;
        }
        Self { rows }
    }

    /// With one shape of this glass less about it; the same where there is none.
    #[inline(always)]
    fn left(self, row: u32) -> Self {
        let Some(place) = self.rows.iter().position(|own| *own == row) else { return self };
        let mut rows = self.rows;
        rows.copy_within(place + 1.., place);
        rows[3] = NO_ROW;
        Self { rows }
    }

    /// What a ray finds that comes from this stack's point and meets a surface of this glass, from outside or not.
    ///
    /// Who leaves a shape without having entered it was inside from the start.
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

    /// All orders in which intervals can begin and end along a ray, as a list of who begins or ends.
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

    /// What is there by the rule: of the shapes about a point the first of the highest priority.
    fn rule(inside: &[bool], glass: &[u32], priorities: &[u32]) -> u32 {
        let held = (0..inside.len()).filter(|&shape| inside[shape]).map(|shape| glass[shape]);
        held.min_by_key(|&row| (std::cmp::Reverse(priorities[row as usize]), row)).unwrap_or(NO_ROW)
    }

    /// Shapes that overlap in every order, with every priority, each of its own glass or some of the same; walked from
    /// outside, and begun at every place on the way without knowing where.
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
                        // The way back over the same surface is the same crossing.
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
        eprintln!("media: {walks} walks through 1 to 4 shapes, {surfaces} surfaces, all by the rule both ways");
    }

    /// A drink in a glass: the drink reaches into the wall, and of the wall's higher priority only three media are left
    /// on the way, air, wall, drink, without an air gap.
    #[test]
    fn a_glass_of_water() {
        let (wall, water) = (0, 1);
        let priorities = [2, 1];
        // Outer side of the wall, the water's own side within the wall, inner side of the wall.
        let way = [(wall, true), (water, true), (wall, false)];
        let mut stack = MediumStack::OUTSIDE;
        let mut met = Vec::new();
        for (row, from_outside) in way {
            let crossing = stack.crossing(row, from_outside, &priorities);
            met.push((crossing.near, crossing.far));
            stack = crossing.beyond;
        }
        assert_eq!(met, [(NO_ROW, wall), (wall, wall), (wall, water)], "the second surface is none");
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
