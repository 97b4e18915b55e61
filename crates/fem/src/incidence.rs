//! Groups of nodes, such as elements, by the nodes that they contain.

/// Numbers of the groups that contain each node, in rising order.
#[derive(Debug)]
pub(super) struct Incidence {
    start: Vec<usize>,
    groups: Vec<u32>,
}

impl Incidence {
    /// Incidence of `groups` over so many `nodes`.
    pub(super) fn new<'a, I: Iterator<Item = &'a [u32]>>(nodes: usize, groups: impl Fn() -> I) -> Self {
        let mut start = vec![0usize; nodes + 1];
        for node in groups().flatten() {
            start[*node as usize + 1] += 1;
        }
        for node in 0..nodes {
            start[node + 1] += start[node];
        }
        let mut next = start.clone();
        let mut of_nodes = vec![0; start[nodes]];
        for (number, group) in (0..).zip(groups()) {
            for node in group {
                of_nodes[next[*node as usize]] = number;
                next[*node as usize] += 1;
            }
        }
        Self { start, groups: of_nodes }
    }

    /// Groups that contain `node`.
    pub(super) fn of(&self, node: usize) -> &[u32] {
        &self.groups[self.start[node]..self.start[node + 1]]
    }
}
