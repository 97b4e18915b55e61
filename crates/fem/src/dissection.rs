//! Nested dissection: an order of elimination by halves of a mesh.
//!
//! The elements are cut in two where few nodes belong to both halves. Each half is ordered likewise, and the nodes between them come last: what is
//! eliminated in one half fills in nothing in the other. In space that leaves a factor with fewer entries than a local rule such as minimum degree.
//!
//! Source: A. George, *SIAM J. Numer. Anal.* 10 (1973) 345–363.

use nalgebra::Vector3;

/// Elements that are not cut any more.
const LEAF: usize = 4;
/// Part of the elements between which a half ends.
const BALANCED: [f64; 2] = [0.38, 0.62];
/// Cuts tried along each axis.
const CUTS: usize = 7;

/// Nodes of `elements` that are not held, in the order of elimination.
pub fn dissected<E: AsRef<[u32]>>(
    points_mm: &[Vector3<f64>],
    elements: &[E],
    is_held: impl Fn(u32) -> bool,
) -> Vec<u32> {
    let centres_mm = elements.iter().map(|element| {
        let nodes = element.as_ref();
        nodes.iter().map(|node| points_mm[*node as usize]).sum::<Vector3<f64>>() / nodes.len() as f64
    });
    let mut dissection = Dissection {
        elements,
        centres_mm: centres_mm.collect(),
        taken: (0..points_mm.len() as u32).map(is_held).collect(),
        seen: vec![0; points_mm.len()],
        sweep: 0,
        order: Vec::with_capacity(points_mm.len()),
    };
    dissection.order_of((0..elements.len()).collect());
    dissection.order
}

struct Dissection<'a, E> {
    elements: &'a [E],
    centres_mm: Vec<Vector3<f64>>,
    /// Nodes that are held, or have their place.
    taken: Vec<bool>,
    /// Last sweep over the elements that came across each node.
    seen: Vec<u32>,
    sweep: u32,
    order: Vec<u32>,
}

/// A cut of some elements in two.
struct Cut {
    /// The elements, those of the first half first.
    elements: Vec<usize>,
    /// Number of elements of the first half.
    first: usize,
    /// Nodes of both halves.
    between: Vec<u32>,
}

impl<E: AsRef<[u32]>> Dissection<'_, E> {
    /// Orders the nodes of `elements` that are not taken.
    fn order_of(&mut self, elements: Vec<usize>) {
        if elements.len() <= LEAF {
            for node in elements.iter().flat_map(|element| self.elements[*element].as_ref()) {
                if !std::mem::replace(&mut self.taken[*node as usize], true) {
                    self.order.push(*node);
                }
            }
            return;
        }
        let Cut { mut elements, first, between } = self.best_cut(elements);
        between.iter().for_each(|node| self.taken[*node as usize] = true);
        let second = elements.split_off(first);
        self.order_of(elements);
        self.order_of(second);
        self.order.extend(between);
    }

    /// The cut along an axis with the fewest nodes between halves of about the same size.
    fn best_cut(&mut self, elements: Vec<usize>) -> Cut {
        let mut best: Option<(f64, Cut)> = None;
        for axis in 0..3 {
            let mut sorted = elements.clone();
            sorted.sort_by(|a, b| self.centres_mm[*a][axis].total_cmp(&self.centres_mm[*b][axis]));
            for first in self.places(&sorted, axis) {
                let between = self.between(&sorted, first);
                let cost = between.len() as f64 / first.min(sorted.len() - first) as f64;
                if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                    best = Some((cost, Cut { elements: sorted.clone(), first, between }));
                }
            }
        }
        best.map(|(_, cut)| cut).expect("more than one element is cut")
    }

    /// Numbers of elements in the first half, of those `sorted` along an axis: evenly spaced ones, and that before the widest step.
    fn places(&self, sorted: &[usize], axis: usize) -> Vec<usize> {
        let [from, to] =
            BALANCED.map(|part| ((part * sorted.len() as f64).round() as usize).clamp(1, sorted.len() - 1));
        let step_mm = |k: &usize| self.centres_mm[sorted[*k]][axis] - self.centres_mm[sorted[*k - 1]][axis];
        let widest = (from..=to).max_by(|a, b| step_mm(a).total_cmp(&step_mm(b)));
        let evenly = (0..CUTS).map(|k| from + (to - from) * k / (CUTS - 1));
        evenly.chain(widest).collect()
    }

    /// Nodes that are not taken, of both the first and the other elements.
    fn between(&mut self, sorted: &[usize], first: usize) -> Vec<u32> {
        let mut between = Vec::new();
        let (of_first, of_both) = (self.sweep + 1, self.sweep + 2);
        self.sweep = of_both;
        let Self { elements, taken, seen, .. } = self;
        for node in sorted[..first].iter().flat_map(|element| elements[*element].as_ref()) {
            seen[*node as usize] = of_first;
        }
        for node in sorted[first..].iter().flat_map(|element| elements[*element].as_ref()) {
            let seen = &mut seen[*node as usize];
            if *seen == of_first && !taken[*node as usize] {
                *seen = of_both;
                between.push(*node);
            }
        }
        between
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of cubes of eight nodes: each free node once, and those between the halves last.
    #[test]
    fn ver_nodes_between_halves_come_last() {
        let points_mm: Vec<Vector3<f64>> =
            (0..17 * 4).map(|k| Vector3::new(f64::from(k / 4), f64::from(k % 2), f64::from(k % 4 / 2))).collect();
        let elements: Vec<[u32; 8]> = (0..16).map(|k| std::array::from_fn(|i| 4 * k + i as u32)).collect();
        let order = dissected(&points_mm, &elements, |node| node < 4);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (4..68).collect::<Vec<u32>>());
        let mut last = order[order.len() - 4..].to_vec();
        last.sort_unstable();
        assert!(last[0] % 4 == 0 && last == (last[0]..last[0] + 4).collect::<Vec<u32>>(), "{last:?}");
        assert!((24..48).contains(&last[0]), "{last:?}");
    }
}
