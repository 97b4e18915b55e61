//! Bodies that are not held: refused before the solver meets a singular matrix.
//!
//! A piece of the solid that shares no node with the rest can move rigidly in three ways: along x, along y, and turning
//! about its centre c, scaled with its size L. With q those amplitudes for all pieces, every held degree of freedom and,
//! as if it were closed, every edge of a contact is one equation
//!
//! ```text
//! e · u(x) = 0                              u(x) = q₀ eₓ + q₁ e_y + q₂ ẑ × (x − c)/L
//! n · (u_slave(x) − u_master(x)) = 0        n the slave's normal in the middle of its edge
//! ```
//!
//! Motions that satisfy all of them, the null space of the sum of the outer products of their coefficients, stay possible
//! whatever the contacts do. The converse does not hold: a contact may open, and then the solver finds the body floating.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, SymmetricEigen, Vector2};

use crate::scene::findings::Findings;
use gearwear_fem::disjoint_sets::DisjointSets;
use gearwear_fem::elastic::Analysis;
use gearwear_fem::problem::{Edge, Problem};
use gearwear_fem::solid::Solid;

/// Ratio of the sum of squared equations to the greatest, below which a motion is free.
const FREE: f64 = 1e-10;
/// Greatest number of connected pieces that are checked; above it the check is left to the solver.
const MOST_PIECES: usize = 100;
/// Degrees of freedom of a piece.
const WAYS: usize = 3;

/// Pieces of the solid that share no node.
struct Pieces {
    /// The piece of each node.
    of_node: Vec<usize>,
    /// The body of each.
    body: Vec<u16>,
    centre_mm: Vec<Vector2<f64>>,
    size_mm: Vec<f64>,
}

/// Coefficients of one equation: those of each piece that takes part.
type Equation = Vec<(usize, [f64; WAYS])>;

/// Refuses bodies that can move even with all contacts closed.
pub(super) fn check(problem: &Problem, solid: &Solid, findings: &mut Findings) {
    let pieces = Pieces::of(solid);
    let mut equations: Vec<Equation> = Vec::new();
    if problem.analysis == Analysis::Axisymmetric {
        // Every motion but the one along the axis strains a body of revolution.
        let straining = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        equations.extend((0..pieces.body.len()).flat_map(|piece| straining.map(|motion| vec![(piece, motion)])));
    }
    for held in &problem.held {
        let node = (held.dof / 2) as usize;
        let direction = if held.dof % 2 == 0 { Vector2::x() } else { Vector2::y() };
        let piece = pieces.of_node[node];
        equations.push(vec![(piece, pieces.motion(piece, solid.points_mm[node], direction))]);
    }
    for contact in &problem.contacts {
        let master: Vec<(Vector2<f64>, usize)> =
            contact.master.iter().map(|edge| (middle(edge, solid), pieces.of_node[edge.ends[0] as usize])).collect();
        for edge in &contact.slave {
            let at = middle(edge, solid);
            let [a, b] = edge.ends.map(|node| solid.points_mm[node as usize]);
            let normal = Vector2::new(b.y - a.y, a.x - b.x).normalize();
            let distances = master.iter().map(|(to, piece)| ((to - at).norm_squared(), *piece));
            let Some((_, other)) = distances.min_by(|(a, _), (b, _)| a.total_cmp(b)) else { continue };
            let own = pieces.of_node[edge.ends[0] as usize];
            equations.push(vec![(own, pieces.motion(own, at, normal)), (other, pieces.motion(other, at, -normal))]);
        }
    }
    for (members, own) in pieces.clusters(&equations) {
        if members.len() <= MOST_PIECES {
            check_cluster(&pieces, &members, &own, problem.contacts.is_empty(), findings);
        }
    }
}

/// Motions of connected pieces.
fn check_cluster(pieces: &Pieces, members: &[usize], equations: &[&Equation], alone: bool, findings: &mut Findings) {
    let place: BTreeMap<usize, usize> = members.iter().enumerate().map(|(i, &piece)| (piece, WAYS * i)).collect();
    let mut gram = DMatrix::<f64>::zeros(WAYS * members.len(), WAYS * members.len());
    for equation in equations {
        let entries: Vec<(usize, f64)> =
            equation.iter().flat_map(|(piece, motion)| (place[piece]..).zip(*motion)).collect();
        for &(i, a) in &entries {
            for &(j, b) in &entries {
                gram[(i, j)] += a * b;
            }
        }
    }
    let eigen = SymmetricEigen::new(gram);
    let limit = FREE * eigen.eigenvalues.amax();
    let free: Vec<usize> = (0..eigen.eigenvalues.len()).filter(|&i| eigen.eigenvalues[i] <= limit).collect();
    if free.is_empty() {
        return;
    }
    let part = |piece: usize| -> f64 {
        let rows = place[&piece]..place[&piece] + WAYS;
        free.iter().flat_map(|&i| rows.clone().map(move |row| (row, i))).map(|at| eigen.eigenvectors[at].powi(2)).sum()
    };
    let mut piece = members[0];
    for &other in members {
        // Tolerance for round-off, so that of equal ones the first is named.
        if part(other) > part(piece) * (1.0 + 1e-6) {
            piece = other;
        }
    }
    let motion = match free.as_slice() {
        [only] => pieces.in_words(piece, [0, 1, 2].map(|way| eigen.eigenvectors[(place[&piece] + way, *only)])),
        several if several.len() == WAYS && equations.is_empty() => "nothing holds".to_owned(),
        several => format!("can move in {} ways that nothing resists", several.len()),
    };
    let found = format!("a body that {motion}");
    let allowed =
        if alone { "supports that hold every body" } else { "supports and contacts that together hold every body" };
    let body = pieces.body[piece];
    findings.not_allowed(&format!("body[{body}]"), found, allowed);
    findings.help(
        "hold it in one more direction with [[fixed]], or on a line of symmetry; there is no friction to hold it",
    );
}

impl Pieces {
    fn of(solid: &Solid) -> Self {
        let mut sets = DisjointSets::new(solid.points_mm.len());
        for nodes in solid.elements.iter().map(|element| element.nodes()) {
            nodes.iter().for_each(|&node| sets.join(nodes[0], node));
        }
        let mut number: BTreeMap<u32, usize> = BTreeMap::new();
        let mut body = Vec::new();
        for element in &solid.elements {
            number.entry(sets.root(element.nodes()[0])).or_insert_with(|| {
                body.push(element.material);
                body.len() - 1
            });
        }
        let of_node: Vec<usize> = (0..solid.points_mm.len() as u32).map(|node| number[&sets.root(node)]).collect();
        let mut centre_mm = vec![Vector2::zeros(); body.len()];
        let mut count = vec![0.0; body.len()];
        for (point, &piece) in solid.points_mm.iter().zip(&of_node) {
            centre_mm[piece] += point;
            count[piece] += 1.0;
        }
        centre_mm.iter_mut().zip(count).for_each(|(sum, count)| *sum /= count);
        let mut size_mm = vec![0.0; body.len()];
        for (point, &piece) in solid.points_mm.iter().zip(&of_node) {
            size_mm[piece] = f64::max(size_mm[piece], (point - centre_mm[piece]).norm());
        }
        Self { of_node, body, centre_mm, size_mm }
    }

    /// The amplitudes' parts in the displacement of `at_mm` along `direction`.
    fn motion(&self, piece: usize, at_mm: Vector2<f64>, direction: Vector2<f64>) -> [f64; WAYS] {
        let arm = (at_mm - self.centre_mm[piece]) / self.size_mm[piece];
        [direction.x, direction.y, arm.perp(&direction)]
    }

    /// Connected pieces, with their equations.
    fn clusters<'e>(&self, equations: &'e [Equation]) -> Vec<(Vec<usize>, Vec<&'e Equation>)> {
        let mut sets = DisjointSets::new(self.body.len());
        for pair in equations.iter().flat_map(|equation| equation.windows(2)) {
            sets.join(pair[0].0 as u32, pair[1].0 as u32);
        }
        let mut clusters: BTreeMap<u32, (Vec<usize>, Vec<&Equation>)> = BTreeMap::new();
        for piece in 0..self.body.len() {
            clusters.entry(sets.root(piece as u32)).or_default().0.push(piece);
        }
        for equation in equations {
            if let Some((piece, _)) = equation.first() {
                clusters.entry(sets.root(*piece as u32)).or_default().1.push(equation);
            }
        }
        clusters.into_values().collect()
    }

    /// A motion in words: a turn has a centre, where c + L ẑ × (q₀, q₁)/q₂ stands still.
    fn in_words(&self, piece: usize, [along_x, along_y, turn]: [f64; WAYS]) -> String {
        let shift = Vector2::new(along_x, along_y);
        if turn.abs() > 1e-6 * shift.norm() {
            let at = self.centre_mm[piece] + Vector2::new(-along_y, along_x) * (self.size_mm[piece] / turn);
            return format!("can turn about x = {:.4}, y = {:.4}", at.x + 0.0, at.y + 0.0);
        }
        let direction = shift.normalize();
        match (direction.x.abs() < 1e-6, direction.y.abs() < 1e-6) {
            (false, true) => "can move along x".to_owned(),
            (true, false) => "can move along y".to_owned(),
            _ => format!("can move along ({:.3}, {:.3})", direction.x, direction.y),
        }
    }
}

fn middle(edge: &Edge, solid: &Solid) -> Vector2<f64> {
    match edge.middle {
        Some(node) => solid.points_mm[node as usize],
        None => edge.ends.map(|node| solid.points_mm[node as usize]).iter().sum::<Vector2<f64>>() / 2.0,
    }
}
