//! Connected components by union of pairs.

/// Sets that are joined pair by pair.
pub struct DisjointSets {
    parent: Vec<u32>,
}

impl DisjointSets {
    /// Sets of one member each.
    pub fn new(count: usize) -> Self {
        Self { parent: (0..count as u32).collect() }
    }

    /// Lowest member of the set of `of`.
    pub fn root(&mut self, mut of: u32) -> u32 {
        while self.parent[of as usize] != of {
            let above = self.parent[self.parent[of as usize] as usize];
            self.parent[of as usize] = above;
            of = above;
        }
        of
    }

    /// Joins the sets of both members.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// Number of the set of each member, in the order of lowest members, and the number of sets.
    pub fn numbered(mut self) -> (Vec<u32>, usize) {
        let mut number = vec![0; self.parent.len()];
        let mut count = 0;
        for member in 0..self.parent.len() as u32 {
            let root = self.root(member);
            if root == member {
                number[member as usize] = count;
                count += 1;
            } else {
                number[member as usize] = number[root as usize];
            }
        }
        (number, count as usize)
    }
}
