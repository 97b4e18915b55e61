//! The transverse section of one pitch of a gear as few quadrilaterals in rows and columns, and its extrusion along the helix.
//!
//! Two grids share the line between the middles of the fillets: the tooth above it, and the body below it from cut to cut,
//!
//! ```text
//!          ┌──┬──┬──┐  tip
//!          │  │  │  │  flanks, then the upper half of each fillet
//!     ┌────┴──┴──┴──┴────┐
//!     │    │  │  │  │    │  to the clamp circle
//! ```
//!
//! A body with a web has a circle between, where the rim ends; below it there are elements in the web only.
//!
//! Frame and orientation are those of [`super::ToothSector`]: the tooth's centre line on +y, of an internal gear on −y, the working flank at x < 0. The profile is
//! the generated one without modifications or rounding of the tip edge; the nodes of the surface lie on it. In space each section
//! turns about the gear's axis by the same angle per mm.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use nalgebra::{Rotation2, Vector2, Vector3};

use super::layer::add;
use super::settings::{SAME_PLACE, SectionDivisions, SpaceBody, SpaceResolution};
use crate::gear::half_profile::in_tooth_frame;
use crate::gear::{Gear, GearPair, PerGear, tooth::Tooth};
use gearwear_mesh::{CellBlock, CellKind, Mesh};

/// Samples of the outline, for points by arc length.
const SAMPLES: usize = 400;
/// Slope, at its ends, of the line between the middles of the fillets: the three elements that meet there have similar angles.
const SAG: f64 = 0.27;
/// Ratio of lengths of neighbouring elements towards the clamp circle.
const RADIAL_GROWTH: f64 = 1.5;
/// Most rows of elements of a web.
const MOST_WEB_ROWS: usize = 5;

/// The section in the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothSection {
    /// Nodes, mm.
    pub points_mm: Vec<Vector2<f64>>,
    /// Serendipity quadrilaterals: corners anticlockwise, then the middles of the sides.
    pub quads: Vec<[u32; 8]>,
    /// Number of quadrilaterals, the first ones, that are as wide as the teeth; the others belong to the web.
    pub full_width_quads: usize,
    /// Nodes of the working flank from the end of the fillet to the tip circle, ends and middles of elements alternately.
    pub flank: Vec<u32>,
    /// Nodes of the clockwise (x > 0) and of the anticlockwise cut by increasing radius.
    pub cuts: [Vec<u32>; 2],
    /// Nodes on the clamp circle.
    pub clamp: Vec<u32>,
    /// Radii of the first and the last node of the flank; nodes are evenly spaced in radius.
    pub flank_radius_mm: [f64; 2],
    /// Node on the other side of the centre line, for each.
    mirrored: Vec<u32>,
}

/// The section extruded along the helix as hexahedra of twenty nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct ExtrudedTooth {
    /// The section at z = 0 before it is turned.
    pub section: ToothSection,
    /// Ends and middles of the layers alternately, from z = 0 to the face width.
    pub z_mm: Vec<f64>,
    /// Turn of the section per mm, rad/mm.
    pub twist_rad_per_mm: f64,
    /// Nodes, mm.
    pub points_mm: Vec<Vector3<f64>>,
    /// Hexahedra in the order of VTK: corners of the lower face, of the upper one, middles of the lower edges, of the upper ones, of those
    /// between.
    pub hexahedra: Vec<[u32; 20]>,
    /// Node above each node of the section, for each end and middle of a layer. `None` at middles of sides in the middle of a layer, and at
    /// nodes of the web outside it.
    nodes: Vec<Vec<Option<u32>>>,
}

/// Points of a chain by arc length.
struct Polyline {
    points: Vec<Vector2<f64>>,
    along_mm: Vec<f64>,
}

impl Polyline {
    fn new(points: Vec<Vector2<f64>>) -> Self {
        let mut along_mm = vec![0.0];
        for two in points.windows(2) {
            along_mm.push(along_mm[along_mm.len() - 1] + (two[1] - two[0]).norm());
        }
        Self { points, along_mm }
    }

    /// Point at a fraction of the length.
    fn at(&self, part: f64) -> Vector2<f64> {
        let last = self.points.len() - 1;
        let at_mm = part * self.along_mm[last];
        let k = self.along_mm.partition_point(|along| *along < at_mm).clamp(1, last);
        let weight = (at_mm - self.along_mm[k - 1]) / (self.along_mm[k] - self.along_mm[k - 1]);
        self.points[k - 1].lerp(&self.points[k], weight)
    }
}

/// The right half of the outline, x > 0.
struct HalfOutline<'a> {
    tooth: &'a Tooth,
    /// From the cut to the middle of the fillet.
    lower: Polyline,
    /// From there to the end of the fillet.
    upper: Polyline,
}

impl<'a> HalfOutline<'a> {
    fn new(tooth: &'a Tooth) -> Self {
        let fillet: Vec<Vector2<f64>> = (0..=SAMPLES)
            .map(|k| {
                let t = FRAC_PI_2 + (tooth.fillet_end_angle_rad - FRAC_PI_2) * sample(k);
                in_tooth_frame(tooth, tooth.trochoid.point_mm(t))
            })
            .collect();
        let (root_mm, at_cut) = (tooth.root_radius_mm, PI / tooth.z());
        let (_, begins) = tooth.polar(fillet[0]);
        let mut outline: Vec<Vector2<f64>> = Vec::with_capacity(2 * SAMPLES);
        if (at_cut - begins) * root_mm > 1e-6 * root_mm.abs() {
            outline.extend((0..SAMPLES).map(|k| {
                let angle = at_cut + (begins - at_cut) * sample(k);
                root_mm * Vector2::new(angle.sin(), angle.cos())
            }));
        }
        outline.extend(fillet);
        let steep = outline.windows(2).position(|two| (two[1].y - two[0].y).atan2(two[0].x - two[1].x) >= FRAC_PI_4);
        let middle = steep.unwrap_or(outline.len() / 2).clamp(2, outline.len() - 3);
        Self {
            tooth,
            upper: Polyline::new(outline[middle..].to_vec()),
            lower: Polyline::new(outline[..=middle].to_vec()),
        }
    }

    /// Point of the flank.
    fn flank(&self, radius_mm: f64) -> Vector2<f64> {
        let half_angle = self.tooth.half_angle_rad(radius_mm);
        radius_mm * Vector2::new(half_angle.sin(), half_angle.cos())
    }
}

/// Fraction of the outline's sampling range at sample `k`.
fn sample(k: usize) -> f64 {
    k as f64 / SAMPLES as f64
}

/// Relative depth below the outline of a row of nodes, ends and middles of growing elements alternately.
fn depth(row: usize, elements: usize) -> f64 {
    let before: f64 = (0..row / 2).map(growth).sum();
    let whole: f64 = (0..elements).map(growth).sum();
    (before + if row % 2 == 1 { 0.5 * growth(row / 2) } else { 0.0 }) / whole
}

/// Length of an element over that of the first one.
fn growth(element: usize) -> f64 {
    RADIAL_GROWTH.powi(element as i32)
}

/// Rows of elements of a web `depth_mm` deep, about as long as the last of the rim's `radial` ones.
fn web_rows(rim_thickness_mm: f64, depth_mm: f64, radial: usize) -> usize {
    let last_mm = rim_thickness_mm * (1.0 - depth(2 * radial - 2, radial));
    ((depth_mm / last_mm).round() as usize).clamp(1, MOST_WEB_ROWS)
}

/// Places of the nodes of the two grids.
struct Grids<'a> {
    outline: HalfOutline<'a>,
    divisions: SectionDivisions,
    clamp_radius_mm: f64,
    /// Inner radius of the rows that are as wide as the teeth.
    rim_radius_mm: f64,
    /// Rows of elements of the web.
    web_rows: usize,
}

impl<'a> Grids<'a> {
    fn new(tooth: &'a Tooth, body: SpaceBody, divisions: SectionDivisions) -> Self {
        let SpaceBody { clamp_radius_mm, web } = body;
        let (rim_radius_mm, web_rows) = match web {
            None => (clamp_radius_mm, 0),
            Some(web) => {
                let rim_radius_mm = tooth.root_radius_mm - web.rim_thickness_mm;
                let rows = web_rows(web.rim_thickness_mm, rim_radius_mm - clamp_radius_mm, divisions.radial);
                (rim_radius_mm, rows)
            }
        };
        Self { outline: HalfOutline::new(tooth), divisions, clamp_radius_mm, rim_radius_mm, web_rows }
    }

    /// Last column of the body's grid.
    fn columns(&self) -> usize {
        2 * (2 * self.divisions.land + self.divisions.across)
    }

    /// Last row of the body's grid.
    fn rows(&self) -> usize {
        2 * (self.divisions.radial + self.web_rows)
    }

    /// Last row of the tooth's grid.
    fn tooth_rows(&self) -> usize {
        2 * (self.divisions.fillet + self.divisions.flank)
    }

    /// Point of the tooth's grid: `i` from the working side, `j` from the middle of the fillet.
    fn in_tooth(&self, i: usize, j: usize) -> Vector2<f64> {
        let (SectionDivisions { across, fillet, flank, .. }, tooth) = (self.divisions, self.outline.tooth);
        let edge = if j <= 2 * fillet {
            self.outline.upper.at(j as f64 / (2 * fillet) as f64)
        } else {
            let part = (j - 2 * fillet) as f64 / (2 * flank) as f64;
            self.outline.flank(tooth.root_form_radius_mm + part * (tooth.tip_radius_mm - tooth.root_form_radius_mm))
        };
        let s = i as f64 / across as f64 - 1.0;
        let x = edge.x * s;
        if j == self.tooth_rows() {
            return Vector2::new(x, tooth.involute.signed((tooth.tip_radius_mm.powi(2) - x * x).sqrt()));
        }
        let tip = self.outline.flank(tooth.tip_radius_mm);
        let tip_bulge = (tooth.tip_radius_mm - tip.y) / tip.x;
        let bulge = -0.5 * SAG + (tip_bulge + 0.5 * SAG) * j as f64 / self.tooth_rows() as f64;
        Vector2::new(x, edge.y + bulge * edge.x * (1.0 - s * s))
    }

    /// Point of the body's grid: `i` from the cut on the working side, `j` from the outline.
    fn in_body(&self, i: usize, j: usize) -> Vector2<f64> {
        let SectionDivisions { across, land, radial, .. } = self.divisions;
        let (beside, columns, rim_rows) = (2 * land, self.columns(), 2 * radial);
        let middle = self.outline.lower.at(1.0);
        let (at_cut, at_middle) = (PI / self.outline.tooth.z(), self.outline.tooth.polar(middle).1);
        let (top, angle) = if i < beside || i > columns - beside {
            let from_cut = i.min(columns - i) as f64 / beside as f64;
            let side = if i < beside { -1.0 } else { 1.0 };
            let point = self.outline.lower.at(from_cut);
            (Vector2::new(side * point.x, point.y), side * (at_cut + from_cut * (at_middle - at_cut)))
        } else {
            let k = i - beside;
            (self.in_tooth(k, 0), at_middle * (k as f64 / across as f64 - 1.0))
        };
        let outward = Vector2::new(angle.sin(), angle.cos());
        if j <= rim_rows {
            return top.lerp(&(self.rim_radius_mm * outward), depth(j, radial));
        }
        let in_web = (j - rim_rows) as f64 / (self.rows() - rim_rows) as f64;
        (self.rim_radius_mm + in_web * (self.clamp_radius_mm - self.rim_radius_mm)) * outward
    }
}

/// Numbers of the nodes of row `j`, which are added to `points_mm`; `u32::MAX` in the middles of quadrilaterals, which are no nodes.
fn add_row(
    points_mm: &mut Vec<Vector2<f64>>,
    last_column: usize,
    j: usize,
    point: impl Fn(usize, usize) -> Vector2<f64>,
) -> Vec<u32> {
    (0..=last_column)
        .map(|i| if i.is_multiple_of(2) || j.is_multiple_of(2) { add(points_mm, point(i, j)) } else { u32::MAX })
        .collect()
}

/// Quadrilaterals of a grid whose rows go upwards or downwards.
fn quads(grid: &[Vec<u32>], upwards: bool) -> Vec<[u32; 8]> {
    let mut quads = Vec::new();
    for rows in grid.windows(3).step_by(2) {
        let middle = &rows[1];
        let (low, high) = if upwards { (&rows[0], &rows[2]) } else { (&rows[2], &rows[0]) };
        for i in (0..middle.len() - 1).step_by(2) {
            let [a, b, c, d] = [low[i], low[i + 2], high[i + 2], high[i]];
            quads.push([a, b, c, d, low[i + 1], middle[i + 2], high[i + 1], middle[i]]);
        }
    }
    quads
}

impl ToothSection {
    /// Section of a tooth on its body.
    pub fn new(tooth: &Tooth, body: SpaceBody, divisions: SectionDivisions) -> Self {
        let SectionDivisions { across, fillet, land, .. } = divisions;
        let grids = Grids::new(tooth, body, divisions);
        let (columns, rows) = (grids.columns(), grids.rows());
        let mut points_mm = Vec::new();
        let body_grid: Vec<Vec<u32>> =
            (0..=rows).map(|j| add_row(&mut points_mm, columns, j, |i, j| grids.in_body(i, j))).collect();
        let mut tooth_grid = vec![body_grid[0][2 * land..=columns - 2 * land].to_vec()];
        for j in 1..=grids.tooth_rows() {
            tooth_grid.push(add_row(&mut points_mm, 2 * across, j, |i, j| grids.in_tooth(i, j)));
        }
        let mut mirrored = vec![0; points_mm.len()];
        for row in body_grid.iter().chain(&tooth_grid) {
            let of_row = row.iter().zip(row.iter().rev()).filter(|(node, _)| **node != u32::MAX);
            of_row.for_each(|(node, other)| mirrored[*node as usize] = *other);
        }
        let mut quads_of_both = quads(&tooth_grid, true);
        quads_of_both.extend(quads(&body_grid, false));
        Self {
            flank: tooth_grid[2 * fillet..].iter().map(|row| row[0]).collect(),
            cuts: [columns, 0].map(|i| body_grid.iter().rev().map(|row| row[i]).collect()),
            clamp: body_grid[rows].clone(),
            full_width_quads: quads_of_both.len() - grids.web_rows * columns / 2,
            quads: quads_of_both,
            points_mm,
            flank_radius_mm: [tooth.root_form_radius_mm, tooth.tip_radius_mm],
            mirrored,
        }
    }

    /// Quadrilaterals of the body at `z_mm`, whose web is in the range `web_mm`; all without a web.
    fn quads_at(&self, z_mm: f64, web_mm: Option<[f64; 2]>) -> &[[u32; 8]] {
        let in_web = web_mm.is_none_or(|[from, to]| (from..to).contains(&z_mm));
        &self.quads[..if in_web { self.quads.len() } else { self.full_width_quads }]
    }

    /// The section as a plane mesh.
    pub fn to_mesh(&self) -> Mesh {
        let nodes = self.quads.iter().flatten().map(|node| *node as usize).collect();
        Mesh {
            points: self.points_mm.iter().map(|point| [point.x, point.y, 0.0]).collect(),
            cells: vec![CellBlock::new(CellKind::Quad8, nodes)],
            ..Mesh::default()
        }
    }

    /// Place of a radius among the nodes of the flank: the first node of its element and ξ in it from −1 to 1; beyond the flank, the nearest end.
    pub fn on_flank(&self, radius_mm: f64) -> (usize, f64) {
        let [first, last] = self.flank_radius_mm;
        let elements = self.flank.len() / 2;
        let place = (radius_mm - first) / (last - first) * elements as f64;
        let element = (place.max(0.0) as usize).min(elements - 1);
        (2 * element, (2.0 * (place - element as f64) - 1.0).clamp(-1.0, 1.0))
    }
}

/// Hexahedron over `quad` in a layer: `nodes` of the section at the lower end, the middle and the upper end of the layer.
fn hexahedron(quad: &[u32; 8], nodes: &[Vec<Option<u32>>]) -> [u32; 20] {
    let mut hexahedron = [0; 20];
    for a in 0..4 {
        for (first, end) in [(0, &nodes[0]), (4, &nodes[2])] {
            hexahedron[first + a] = end[quad[a] as usize].unwrap_or_default();
            hexahedron[8 + first + a] = end[quad[4 + a] as usize].unwrap_or_default();
        }
        hexahedron[16 + a] = nodes[1][quad[a] as usize].unwrap_or_default();
    }
    hexahedron
}

impl ExtrudedTooth {
    /// One pitch of a gear of `pair` over its face width. Layers of both gears end at the same z.
    pub fn of_gear(pair: &GearPair, gear: Gear, bodies: &PerGear<SpaceBody>, resolution: &SpaceResolution) -> Self {
        let tooth = &pair.teeth[gear];
        // Forward on the path of contact, where slices at small z are, is anticlockwise for the pinion.
        let forward = match gear {
            Gear::Pinion => 1.0,
            Gear::Wheel => -1.0,
        };
        let twist_rad_per_mm = -forward * pair.base_helix_angle_rad().tan() / tooth.involute.base_radius_mm;
        let section = ToothSection::new(tooth, bodies[gear], resolution.section);
        let web_mm = bodies[gear].web.map(|web| web.from_to_mm(pair.spec.face_width_mm));
        Self::new(section, &resolution.layer_ends_mm(&pair.spec, bodies), web_mm, twist_rad_per_mm)
    }

    /// Elements over the face width.
    pub fn layers(&self) -> usize {
        self.z_mm.len() / 2
    }

    /// Ends of the layers over the face width, from z = 0 on.
    pub fn layer_ends_mm(&self) -> Vec<f64> {
        self.z_mm.iter().copied().step_by(2).collect()
    }

    /// Layer at `z_mm` and ζ in it from −1 to 1.
    pub(crate) fn across_width(&self, z_mm: f64) -> (usize, f64) {
        let ends_before = self.z_mm.iter().step_by(2).filter(|end| **end <= z_mm).count();
        let layer = ends_before.clamp(1, self.layers()) - 1;
        let [from, to] = [self.z_mm[2 * layer], self.z_mm[2 * layer + 2]];
        (layer, 2.0 * (z_mm - from) / (to - from) - 1.0)
    }

    /// `section` over the face width in layers that end at `layer_ends_mm`, from z = 0 on, with its web in the range `web_mm`.
    fn new(section: ToothSection, layer_ends_mm: &[f64], web_mm: Option<[f64; 2]>, twist_rad_per_mm: f64) -> Self {
        let (layers, face_width_mm) = (layer_ends_mm.len() - 1, layer_ends_mm[layer_ends_mm.len() - 1]);
        let z_mm: Vec<f64> =
            (0..=2 * layers).map(|k| layer_ends_mm[k / 2].midpoint(layer_ends_mm[k.div_ceil(2)])).collect();
        let mut is_node = vec![vec![false; section.points_mm.len()]; z_mm.len()];
        for layer in 0..layers {
            for quad in section.quads_at(z_mm[2 * layer + 1], web_mm) {
                for (k, of_quad) in [(2 * layer, &quad[..]), (2 * layer + 1, &quad[..4]), (2 * layer + 2, &quad[..])] {
                    of_quad.iter().for_each(|node| is_node[k][*node as usize] = true);
                }
            }
        }
        let mut points_mm = Vec::new();
        let mut nodes = Vec::with_capacity(z_mm.len());
        for (z, is_node) in z_mm.iter().zip(&is_node) {
            let turn = Rotation2::new(twist_rad_per_mm * (z - 0.5 * face_width_mm));
            let mut at_place = Vec::with_capacity(is_node.len());
            for (point, is_node) in section.points_mm.iter().zip(is_node) {
                at_place.push(is_node.then(|| {
                    let point = turn * point;
                    points_mm.push(Vector3::new(point.x, point.y, *z));
                    points_mm.len() as u32 - 1
                }));
            }
            nodes.push(at_place);
        }
        let mut hexahedra = Vec::new();
        for layer in 0..layers {
            let quads = section.quads_at(z_mm[2 * layer + 1], web_mm);
            hexahedra.extend(quads.iter().map(|quad| hexahedron(quad, &nodes[2 * layer..=2 * layer + 2])));
        }
        Self { section, z_mm, twist_rad_per_mm, points_mm, hexahedra, nodes }
    }

    /// Turn of the section at an end or a middle of a layer; 0 in the middle of the face width.
    pub(crate) fn turn_rad(&self, place: usize) -> f64 {
        self.twist_rad_per_mm * (self.z_mm[place] - 0.5 * self.z_mm[self.z_mm.len() - 1])
    }

    /// The nodes over `section_nodes`, end by end and middle by middle of the layers.
    pub fn over(&self, section_nodes: &[u32]) -> Vec<u32> {
        let over_all = self.nodes.iter().flat_map(|nodes| section_nodes.iter().map(|node| nodes[*node as usize]));
        over_all.flatten().collect()
    }

    /// The node over a node of the section at an end (even) or a middle of a layer, where there is one.
    pub fn node(&self, section_node: u32, place: usize) -> Option<u32> {
        self.nodes[place][section_node as usize]
    }

    /// Node onto which each goes by half a turn about the centre line of the tooth in the middle of the face width; none where layers or web are not
    /// the same on both sides of it.
    pub(crate) fn half_turned(&self) -> Option<Vec<u32>> {
        let last = self.z_mm.len() - 1;
        let off_mm = |k: usize| (self.z_mm[k] + self.z_mm[last - k] - self.z_mm[last]).abs();
        if (0..=last).any(|k| off_mm(k) > SAME_PLACE * self.z_mm[last]) {
            return None;
        }
        let mut turned = vec![0; self.points_mm.len()];
        for (nodes, opposite) in self.nodes.iter().zip(self.nodes.iter().rev()) {
            for (node, mirrored) in nodes.iter().zip(&self.section.mirrored) {
                match (node, opposite[*mirrored as usize]) {
                    (Some(node), Some(other)) => turned[*node as usize] = other,
                    (None, None) => {}
                    _ => return None,
                }
            }
        }
        Some(turned)
    }
}
