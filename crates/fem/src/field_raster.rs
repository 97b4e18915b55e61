//! Nodal field within a window for plots, sampled on a raster of small squares with each element as linear triangles between its nodes,
//! and the sides of the elements there.

use super::solid::{Element, ElementKind};

/// Number of squares of a raster.
const SQUARES: f64 = 60_000.0;

/// Elements with the plotted coordinates of their nodes.
#[derive(Debug, Clone, Copy)]
pub struct Bodies<'a> {
    /// Coordinates of the nodes, mm.
    pub points_mm: &'a [[f64; 2]],
    /// Elements.
    pub elements: &'a [Element],
}

/// Plotted range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Range of x, mm.
    pub x_mm: [f64; 2],
    /// Range of y, mm.
    pub y_mm: [f64; 2],
}

/// Least and greatest coordinate of points along an axis.
fn range(points: &[[f64; 2]], axis: usize) -> [f64; 2] {
    points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [low.min(p[axis]), high.max(p[axis])])
}

impl Window {
    /// Window around all `points_mm`, with a margin.
    pub fn around(points_mm: &[[f64; 2]]) -> Self {
        let [x_mm, y_mm] = [0, 1].map(|axis| {
            let [low, high] = range(points_mm, axis);
            let room = 0.02 * (high - low).abs();
            [low - room, high + room]
        });
        Self { x_mm, y_mm }
    }

    /// Window from `half_height_mm` below `centre_mm` to the same above, and `width_over_height` times as wide.
    pub fn about(centre_mm: [f64; 2], half_height_mm: f64, width_over_height: f64) -> Self {
        let [x, y] = centre_mm;
        let half_width_mm = width_over_height * half_height_mm;
        Self { x_mm: [x - half_width_mm, x + half_width_mm], y_mm: [y - half_height_mm, y + half_height_mm] }
    }

    /// Intersection with `other`, along each axis that has one.
    pub fn within(self, other: Self) -> Self {
        let [x_mm, y_mm] = [(self.x_mm, other.x_mm), (self.y_mm, other.y_mm)]
            .map(|([a, b], [c, d])| if a.max(c) < b.min(d) { [a.max(c), b.min(d)] } else { [a, b] });
        Self { x_mm, y_mm }
    }

    /// Width, mm.
    pub fn width_mm(&self) -> f64 {
        self.x_mm[1] - self.x_mm[0]
    }

    /// Height, mm.
    pub fn height_mm(&self) -> f64 {
        self.y_mm[1] - self.y_mm[0]
    }

    /// Whether the box around `points` and the window intersect.
    fn meets(&self, points: &[[f64; 2]]) -> bool {
        [self.x_mm, self.y_mm].into_iter().enumerate().all(|(axis, [from, to])| {
            let [low, high] = range(points, axis);
            low <= to && high >= from
        })
    }
}

/// Greatest of the `values` at nodes within `reach_mm` of a point along x and y; at least 0.
pub fn greatest_near(bodies: Bodies<'_>, values: &[f64], centre_mm: [f64; 2], reach_mm: f64) -> f64 {
    let near = (bodies.points_mm.iter().zip(values))
        .filter(|(p, _)| (0..2).all(|axis| (p[axis] - centre_mm[axis]).abs() <= reach_mm));
    near.map(|(_, value)| *value).fold(0.0, f64::max)
}

/// Coordinates of the nodes after deformation.
pub fn deformed(points_mm: impl Iterator<Item = [f64; 2]>, displacement_mm: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points_mm.zip(displacement_mm).map(|(p, u)| [p[0] + u[0], p[1] + u[1]]).collect()
}

/// Sides of the elements within `window`, each once: first those of one element only, then all others. Nodes of a side run from one
/// end over the middle node, if there is one, to the other.
pub fn sides(bodies: Bodies<'_>, window: Window) -> (Vec<Vec<u32>>, Vec<Vec<u32>>) {
    let mut all: Vec<([u32; 2], Vec<u32>)> = Vec::new();
    for element in bodies.elements {
        for side in ring(element) {
            let points: Vec<[f64; 2]> = side.iter().map(|&node| bodies.points_mm[node as usize]).collect();
            if window.meets(&points) {
                let (first, last) = (side[0], side[side.len() - 1]);
                all.push(([first.min(last), first.max(last)], side));
            }
        }
    }
    all.sort_by_key(|(ends, _)| *ends);
    let (mut outline, mut inner) = (Vec::new(), Vec::new());
    for same in all.chunk_by(|a, b| a.0 == b.0) {
        if same.len() == 1 { &mut outline } else { &mut inner }.push(same[0].1.clone());
    }
    (outline, inner)
}

/// Sides of an element.
fn ring(element: &Element) -> Vec<Vec<u32>> {
    let nodes = element.nodes();
    let n = match element.kind {
        ElementKind::Triangle3 | ElementKind::Triangle6 => 3,
        ElementKind::Quad4 | ElementKind::Quad8 | ElementKind::Quad9 => 4,
    };
    (0..n)
        .map(|i| {
            let middle = (nodes.len() > n).then(|| nodes[n + i]);
            [Some(nodes[i]), middle, Some(nodes[(i + 1) % n])].into_iter().flatten().collect()
        })
        .collect()
}

/// Linear triangles between the nodes of an element, by local node numbers.
fn triangles(kind: ElementKind) -> &'static [[usize; 3]] {
    match kind {
        ElementKind::Triangle3 => &[[0, 1, 2]],
        ElementKind::Triangle6 => &[[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
        ElementKind::Quad4 => &[[0, 1, 2], [0, 2, 3]],
        ElementKind::Quad8 => &[[0, 4, 7], [4, 1, 5], [5, 2, 6], [6, 3, 7], [4, 5, 6], [4, 6, 7]],
        ElementKind::Quad9 => &[[0, 4, 8], [4, 1, 8], [1, 5, 8], [5, 2, 8], [2, 6, 8], [6, 3, 8], [3, 7, 8], [7, 0, 8]],
    }
}

/// Values on squares; `None` outside the bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    /// Centres of the squares from left to right.
    pub x_mm: Vec<f64>,
    /// Centres of the squares from below.
    pub y_mm: Vec<f64>,
    /// Values by rows from below.
    pub values: Vec<Vec<Option<f64>>>,
}

impl Raster {
    /// Samples the nodal values `nodal`.
    pub fn sample(bodies: Bodies<'_>, nodal: &[f64], window: Window) -> Self {
        let side_mm = (window.width_mm() * window.height_mm() / SQUARES).sqrt();
        let [x_mm, y_mm]: [Vec<f64>; 2] = [window.x_mm, window.y_mm].map(|[from, to]| {
            let count = ((to - from) / side_mm).round().max(1.0) as usize;
            (0..count).map(|i| from + (i as f64 + 0.5) * (to - from) / count as f64).collect()
        });
        let mut values = vec![vec![None; x_mm.len()]; y_mm.len()];
        for element in bodies.elements {
            let nodes = element.nodes();
            for triangle in triangles(element.kind) {
                let points = triangle.map(|i| bodies.points_mm[nodes[i] as usize]);
                if !window.meets(&points) {
                    continue;
                }
                let at_corners = triangle.map(|i| nodal[nodes[i] as usize]);
                fill(&mut values, &x_mm, &y_mm, points, at_corners);
            }
        }
        Self { x_mm, y_mm, values }
    }
}

/// Writes the values of a linear triangle at the centres within it.
fn fill(values: &mut [Vec<Option<f64>>], x_mm: &[f64], y_mm: &[f64], points: [[f64; 2]; 3], at_corners: [f64; 3]) {
    let [a, b, c] = points;
    let doubled_area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if doubled_area == 0.0 {
        return;
    }
    let [columns, rows] = [(x_mm, 0), (y_mm, 1)].map(|(centres, axis)| {
        let [low, high] = range(&points, axis);
        centres.partition_point(|&x| x < low)..centres.partition_point(|&x| x <= high)
    });
    for row in rows {
        for column in columns.clone() {
            let (x, y) = (x_mm[column] - a[0], y_mm[row] - a[1]);
            let second = (x * (c[1] - a[1]) - (c[0] - a[0]) * y) / doubled_area;
            let third = ((b[0] - a[0]) * y - x * (b[1] - a[1])) / doubled_area;
            let share = [1.0 - second - third, second, third];
            // The tolerance assigns centres on a side to a triangle despite round-off.
            if share.iter().all(|&share| share >= -1e-9) {
                values[row][column] = Some(share.iter().zip(at_corners).map(|(share, value)| share * value).sum());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT_NODES: [[f64; 2]; 9] =
        [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 0.0], [2.0, 1.0], [1.0, 2.0], [0.0, 1.0], [1.0, 1.0]];

    fn element(kind: ElementKind) -> Element {
        let nodes: &[u32] = match kind {
            ElementKind::Triangle3 => &[0, 1, 2],
            ElementKind::Triangle6 => &[0, 1, 2, 4, 5, 8],
            ElementKind::Quad4 => &[0, 1, 2, 3],
            ElementKind::Quad8 => &[0, 1, 2, 3, 4, 5, 6, 7],
            ElementKind::Quad9 => &[0, 1, 2, 3, 4, 5, 6, 7, 8],
        };
        Element::new(kind, nodes, 0)
    }

    /// A linear function of x and y is sampled exactly by every kind of element, everywhere
    /// inside it and nowhere outside.
    #[test]
    fn ver_linear_fields_are_sampled_exactly() {
        let nodal: Vec<f64> = UNIT_NODES.iter().map(|p| 1.0 + 3.0 * p[0] + 10.0 * p[1]).collect();
        for kind in
            [ElementKind::Triangle3, ElementKind::Triangle6, ElementKind::Quad4, ElementKind::Quad8, ElementKind::Quad9]
        {
            let elements = [element(kind)];
            let bodies = Bodies { points_mm: &UNIT_NODES, elements: &elements };
            let raster = Raster::sample(bodies, &nodal, Window { x_mm: [-1.0, 3.0], y_mm: [-1.0, 3.0] });
            let triangle = matches!(kind, ElementKind::Triangle3 | ElementKind::Triangle6);
            for (row, &y) in raster.y_mm.iter().enumerate() {
                for (column, &x) in raster.x_mm.iter().enumerate() {
                    let inside = (0.0..=2.0).contains(&x) && (0.0..=2.0).contains(&y) && !(triangle && y > x + 1e-9);
                    match raster.values[row][column] {
                        Some(value) => {
                            let exact = 1.0 + 3.0 * x + 10.0 * y;
                            assert!(inside && (value / exact - 1.0).abs() < 1e-12, "{kind:?} at {x} {y}: {value}");
                        }
                        None => assert!(!inside, "{kind:?}: nothing at {x} {y}"),
                    }
                }
            }
        }
    }

    /// Two neighbouring quadrilaterals: six sides outside, one between them.
    #[test]
    fn a_side_of_two_elements_is_drawn_once() {
        let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [0.0, 1.0]];
        let elements =
            [Element::new(ElementKind::Quad4, &[0, 1, 4, 5], 0), Element::new(ElementKind::Quad4, &[1, 2, 3, 4], 1)];
        let (outline, inner) = sides(Bodies { points_mm: &points, elements: &elements }, Window::around(&points));
        assert_eq!((outline.len(), inner), (6, vec![vec![1, 4]]));
    }
}
