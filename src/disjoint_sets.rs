//! Sets that are joined until those that hang together are one (union-find).

/// The numbers from 0 on in disjoint sets, each known by its least number.
#[derive(Clone)]
pub(crate) struct DisjointSets(Vec<u32>);

impl DisjointSets {
    /// Each of so many numbers in a set of its own.
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The least number of the set of a number; halves the path to it on the way.
    pub(crate) fn of(&mut self, mut number: u32) -> u32 {
        let Self(parents) = self;
        while parents[number as usize] != number {
            let grandparent = parents[parents[number as usize] as usize];
            parents[number as usize] = grandparent;
            number = grandparent;
        }
        number
    }

    /// Makes the sets of two numbers one.
    pub(crate) fn join(&mut self, one: u32, other: u32) {
        let (one, other) = (self.of(one), self.of(other));
        self.0[one.max(other) as usize] = one.min(other);
    }

    /// The numbers of each set, in order, and the sets by their least.
    pub(crate) fn members(mut self) -> Vec<Vec<u32>> {
        let mut members = vec![Vec::new(); self.0.len()];
        for number in 0..self.0.len() as u32 {
            members[self.of(number) as usize].push(number);
        }
        members.retain(|set| !set.is_empty());
        members
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_joined_is_known_by_its_least_number() {
        let mut sets = DisjointSets::new(6);
        for (one, other) in [(5, 3), (3, 4), (1, 1), (4, 2)] {
            sets.join(one, other);
        }
        let found: Vec<u32> = (0..6).map(|number| sets.of(number)).collect();
        assert_eq!(found, [0, 1, 2, 2, 2, 2]);
        assert_eq!(sets.members(), [vec![0], vec![1], vec![2, 3, 4, 5]]);
    }
}
