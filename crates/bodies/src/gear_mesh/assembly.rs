//! Assembly of a sector: outline, cuts and clamp circle around it, the structured layer, triangles elsewhere.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::ops::Range;

use nalgebra::Vector2;

use super::cut::Cut;
use super::layer::{self, FlankNode, Layer, add};
use super::outline::{Outline, reaches};
use super::spacing::{OutlinePart, ToothSide};
use super::{
    FlankChain, GREATEST_MODULES, SectorSettings, ToothElement, ToothMeshError, ToothSector, ToothShape, interior,
};
use gearwear_mesh::quality;

/// Fewest elements on the clamp circle.
const FEWEST_ON_CLAMP: usize = 2;

/// Edge of the boundary of the triangles: end, middle, end.
type Edge = [u32; 3];

/// Meshes the sector within `outline` and its cuts.
pub(super) fn assemble(
    shape: &ToothShape,
    settings: &SectorSettings,
    outline: &Outline,
    cut: &Cut,
) -> Result<ToothSector, ToothMeshError> {
    let half_pitch_rad = PI / shape.tooth.z();
    // Nodes of the outline come first, in its order.
    let mut points_mm: Vec<Vector2<f64>> = outline.nodes.iter().map(|node| node.point_mm).collect();
    let ends = [(1.0, 0), (-1.0, outline.nodes.len() - 1)];
    let [right_cut, left_cut] = ends.map(|(side, top)| cut_nodes(cut, side * half_pitch_rad, top, &mut points_mm));
    let clamp = clamp_nodes(cut, half_pitch_rad, left_cut[0], right_cut[0], &mut points_mm);

    let flank = outline.part(ToothSide::Left, OutlinePart::Flank);
    let layer = layer_under(&working_flank(shape, outline, flank.clone()), settings, outline, &mut points_mm);

    let mut loop_edges: Vec<Edge> = edges(&right_cut);
    loop_edges.extend(outline_edges(outline, &flank, &layer));
    loop_edges.extend(edges(&reversed(&left_cut)));
    loop_edges.extend(edges(&clamp));

    let mut cells = layer.cells;
    let greatest_mm = GREATEST_MODULES * shape.normal_module_mm;
    cells.extend(triangles(&loop_edges, settings.growth(), greatest_mm, &mut points_mm)?);
    refuse_inverted(&points_mm, &cells)?;

    let [working_fillet, back_fillet] = both_from_root(outline, OutlinePart::Fillet);
    let [working_root_arc, back_root_arc] = both_from_root(outline, OutlinePart::RootArc);
    Ok(ToothSector {
        points_mm,
        cells,
        working_flank: flank_chain(outline, ToothSide::Left),
        back_flank: flank_chain(outline, ToothSide::Right),
        working_fillet,
        back_fillet,
        working_root_arc,
        back_root_arc,
        tip_land: reversed(&chain(outline, ToothSide::Right, OutlinePart::Land)),
        left_cut,
        right_cut,
        clamp,
    })
}

/// Structured layer under the resolved part of the working flank; empty on a coarse sector.
fn layer_under(
    flank: &[FlankNode],
    settings: &SectorSettings,
    outline: &Outline,
    points_mm: &mut Vec<Vector2<f64>>,
) -> Layer {
    let (Some(resolution), Some(from_rho_mm)) = (&settings.flank, outline.resolved_from_rho_mm) else {
        return Layer::default();
    };
    let rho_mm: Vec<f64> = flank.iter().map(|node| node.rho_mm).collect();
    let first = first_resolved(&rho_mm, from_rho_mm);
    let depth = resolution.depth_half_widths * resolution.elements_per_half_width;
    let mut layer = layer::build(&flank[first..], depth, points_mm);
    layer.covers = layer.covers.start + first..layer.covers.end + first;
    layer
}

/// Edges along the outline, below the layer where there is one.
fn outline_edges(outline: &Outline, flank: &Range<usize>, layer: &Layer) -> Vec<Edge> {
    let all: Vec<u32> = (0..outline.nodes.len() as u32).collect();
    if layer.border.is_empty() {
        return edges(&all);
    }
    // The layer counts nodes from the root, the outline from the tip.
    let (from, to) = (flank.end - layer.covers.end, flank.end - 1 - layer.covers.start);
    [edges(&all[..=from]), layer.border.clone(), edges(&all[to..])].concat()
}

/// Nodes of a part on one side in the order of the outline.
fn chain(outline: &Outline, side: ToothSide, part: OutlinePart) -> Vec<u32> {
    outline.part(side, part).map(|k| k as u32).collect()
}

/// Nodes of a part on the working and on the other side, each from the root up.
fn both_from_root(outline: &Outline, part: OutlinePart) -> [Vec<u32>; 2] {
    [reversed(&chain(outline, ToothSide::Left, part)), chain(outline, ToothSide::Right, part)]
}

fn reversed(nodes: &[u32]) -> Vec<u32> {
    nodes.iter().rev().copied().collect()
}

fn edges(chain: &[u32]) -> Vec<Edge> {
    chain.windows(3).step_by(2).map(|edge| [edge[0], edge[1], edge[2]]).collect()
}

/// Nodes of a cut at angle `theta` clockwise, by increasing radius; the last one is `top`.
fn cut_nodes(cut: &Cut, theta: f64, top: usize, points_mm: &mut Vec<Vector2<f64>>) -> Vec<u32> {
    let (sin, cos) = theta.sin_cos();
    let below = &cut.radius_mm[..cut.radius_mm.len() - 1];
    let mut nodes: Vec<u32> = below.iter().map(|&r| add(points_mm, r * Vector2::new(sin, cos))).collect();
    nodes.push(top as u32);
    nodes
}

/// Nodes of the clamp circle from the left cut to the right one.
fn clamp_nodes(cut: &Cut, half_pitch_rad: f64, left: u32, right: u32, points_mm: &mut Vec<Vector2<f64>>) -> Vec<u32> {
    let radius_mm = cut.radius_mm[0];
    let arc_mm = 2.0 * half_pitch_rad * radius_mm;
    let halves = 2 * ((arc_mm / cut.lowest_mm).round() as usize).max(FEWEST_ON_CLAMP);
    let mut nodes = vec![left];
    for k in 1..halves {
        let (sin, cos) = (half_pitch_rad * (2.0 * k as f64 / halves as f64 - 1.0)).sin_cos();
        nodes.push(add(points_mm, radius_mm * Vector2::new(sin, cos)));
    }
    nodes.push(right);
    nodes
}

/// Nodes of the working flank from root to tip, with the involute's normals.
fn working_flank(shape: &ToothShape, outline: &Outline, flank: Range<usize>) -> Vec<FlankNode> {
    let base = shape.tooth.involute.base_radius_mm;
    flank
        .rev()
        .map(|k| {
            let node = outline.nodes[k];
            let rho_mm = outline.rho_mm[k];
            let (sin, cos) = (shape.tooth.base_half_angle_rad - rho_mm / base).sin_cos();
            FlankNode { id: k as u32, node, inward: Vector2::new(cos, sin), rho_mm }
        })
        .collect()
}

/// Flank, rounding and chamfer of a side, from root to tip.
fn flank_chain(outline: &Outline, side: ToothSide) -> FlankChain {
    let (flank, tip_edge) = (outline.part(side, OutlinePart::Flank), outline.part(side, OutlinePart::TipEdge));
    let involute = 0..flank.len();
    // Flank and tip edge share the node between them.
    let numbers: Vec<usize> = match side {
        ToothSide::Right => flank.chain(tip_edge.skip(1)).collect(),
        ToothSide::Left => flank.rev().chain(tip_edge.rev().skip(1)).collect(),
    };
    let rho_mm: Vec<f64> = numbers.iter().map(|&k| outline.rho_mm[k]).collect();
    let resolved = match outline.resolved_from_rho_mm {
        Some(from) if side == ToothSide::Left => first_resolved(&rho_mm, from)..numbers.len(),
        _ => 0..0,
    };
    FlankChain { nodes: numbers.into_iter().map(|k| k as u32).collect(), rho_mm, involute, resolved }
}

/// The first end of an element, from the root, where the resolved part has begun.
fn first_resolved(rho_mm: &[f64], from_rho_mm: f64) -> usize {
    2 * rho_mm.iter().step_by(2).position(|&rho| reaches(rho, from_rho_mm)).unwrap_or(0)
}

/// Six-node triangles inside a loop of edges, which keep their middle nodes; other middles lie halfway between corners.
fn triangles(
    loop_edges: &[Edge],
    growth: f64,
    greatest_mm: f64,
    points_mm: &mut Vec<Vector2<f64>>,
) -> Result<Vec<ToothElement>, ToothMeshError> {
    let ring: Vec<Vector2<f64>> = loop_edges.iter().map(|edge| points_mm[edge[0] as usize]).collect();
    let filling = interior::fill(&ring, growth, greatest_mm)?;
    let mut ids: Vec<u32> = loop_edges.iter().map(|edge| edge[0]).collect();
    ids.extend(filling.points_mm[ring.len()..].iter().map(|&point| add(points_mm, point)));
    let mut middles: BTreeMap<[u32; 2], u32> =
        loop_edges.iter().map(|&[a, middle, b]| ([a.min(b), a.max(b)], middle)).collect();
    Ok(filling
        .triangles
        .iter()
        .map(|triangle| {
            let corners @ [a, b, c] = triangle.map(|k| ids[k]);
            let between = [[a, b], [b, c], [c, a]].map(|[a, b]| {
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    let point = 0.5 * (points_mm[a as usize] + points_mm[b as usize]);
                    add(points_mm, point)
                })
            });
            ToothElement::triangle(corners, between)
        })
        .collect())
}

fn refuse_inverted(points_mm: &[Vector2<f64>], cells: &[ToothElement]) -> Result<(), ToothMeshError> {
    let mut nodes = Vec::with_capacity(8);
    for (number, cell) in cells.iter().enumerate() {
        nodes.clear();
        nodes.extend(cell.nodes().iter().map(|&node| points_mm[node as usize]));
        if quality::of_cell(cell.kind, &nodes).is_some_and(|quality| quality.jacobian_ratio <= 0.0) {
            return Err(ToothMeshError::Inverted { cell: number, at_mm: nodes[0].into() });
        }
    }
    Ok(())
}
