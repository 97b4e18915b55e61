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
//! Frame and orientation are those of [`super::ToothSector`]: the tooth's centre line on +y, the working flank at x < 0. The profile is
//! the generated one without modifications or rounding of the tip edge; the nodes of the surface lie on it. In space each section
//! turns about the gear's axis by the same angle per mm.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use nalgebra::{Rotation2, Vector2, Vector3};

use super::settings::{SectionDivisions, SpaceBody, SpaceResolution};
use crate::gear::half_profile::in_tooth_frame;
use crate::gear::{Gear, GearPair, PerGear, tooth::Tooth};
use gearwear_mesh::{CellBlock, CellKind, Mesh};

/// Samples of the outline from which places by length of arc are taken.
const SAMPLES: usize = 400;
/// Slope, at its ends, of the line between the middles of the fillets: three elements meet there at much the same angle.
const SAG: f64 = 0.27;
/// Each element towards the clamp circle over the one before.
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
    /// How many of them, the first ones, are as wide as the teeth; the others belong to the web.
    pub full_width_quads: usize,
    /// Nodes of the working flank from the end of the fillet to the tip circle, ends and middles of elements alternately.
    pub flank: Vec<u32>,
    /// Nodes of the clockwise (x > 0) and of the anticlockwise cut by increasing radius.
    pub cuts: [Vec<u32>; 2],
    /// Nodes on the clamp circle.
    pub clamp: Vec<u32>,
    /// Radii of the first and the last node of the flank; nodes are evenly spaced in radius.
    pub flank_radius_mm: [f64; 2],
}

/// The section extruded along the helix as hexahedra of twenty nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct ExtrudedTooth {
    /// The section at z = 0 before it is turned.
    pub section: ToothSection,
    /// Places of the layers' ends and middles alternately, from z = 0 to the face width.
    pub z_mm: Vec<f64>,
    /// Turn of the section per mm, rad/mm.
    pub twist_rad_per_mm: f64,
    /// Nodes, mm.
    pub points_mm: Vec<Vector3<f64>>,
    /// Hexahedra in the order of VTK: corners of the lower face, of the upper one, middles of the lower edges, of the upper ones, of those
    /// between.
    pub hexahedra: Vec<[u32; 20]>,
    /// For each end and middle of a layer the node above each node of the section; middles have corners only, and outside the web there is none
    /// of its.
    nodes: Vec<Vec<Option<u32>>>,
}

/// Points by length of arc.
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

    /// At this part of its length.
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
        let sample = |k: usize| k as f64 / SAMPLES as f64;
        let fillet: Vec<Vector2<f64>> = (0..=SAMPLES)
            .map(|k| {
                let t = FRAC_PI_2 + (tooth.fillet_end_angle_rad - FRAC_PI_2) * sample(k);
                in_tooth_frame(tooth, tooth.trochoid.point_mm(t))
            })
            .collect();
        let (root_mm, at_cut) = (tooth.root_radius_mm, PI / f64::from(tooth.teeth));
        let begins = fillet[0].x.atan2(fillet[0].y);
        let mut outline: Vec<Vector2<f64>> = Vec::with_capacity(2 * SAMPLES);
        if (at_cut - begins) * root_mm > 1e-6 * root_mm {
            let angle = |k: usize| at_cut + (begins - at_cut) * sample(k);
            outline.extend((0..SAMPLES).map(|k| root_mm * Vector2::new(angle(k).sin(), angle(k).cos())));
        }
        outline.extend(fillet);
        let steep = |two: &[Vector2<f64>]| (two[1].y - two[0].y).atan2(two[0].x - two[1].x) >= FRAC_PI_4;
        let middle = outline.windows(2).position(steep).unwrap_or(outline.len() / 2).clamp(2, outline.len() - 3);
        Self {
            tooth,
            upper: Polyline::new(outline[middle..].to_vec()),
            lower: Polyline::new(outline[..=middle].to_vec()),
        }
    }

    /// At this radius of the flank.
    fn flank(&self, radius_mm: f64) -> Vector2<f64> {
        let half_angle = self.tooth.half_angle_rad(radius_mm);
        radius_mm * Vector2::new(half_angle.sin(), half_angle.cos())
    }
}

/// Part of the way from the outline that a row, ends and middles of elements alternately, is at, where elements grow towards the other end.
fn depth(row: usize, elements: usize) -> f64 {
    let step = |k: usize| RADIAL_GROWTH.powi(k as i32);
    let before: f64 = (0..row / 2).map(step).sum();
    let whole: f64 = (0..elements).map(step).sum();
    (before + if row % 2 == 1 { 0.5 * step(row / 2) } else { 0.0 }) / whole
}

/// Rows of elements of a web of such a depth, about as long as the last of the rim's `radial` ones.
fn web_rows(rim_thickness_mm: f64, depth_mm: f64, radial: usize) -> usize {
    let last_mm = rim_thickness_mm * (1.0 - depth(2 * radial - 2, radial));
    ((depth_mm / last_mm).round() as usize).clamp(1, MOST_WEB_ROWS)
}

impl ToothSection {
    /// Of a tooth on its body.
    pub fn new(tooth: &Tooth, body: SpaceBody, divisions: SectionDivisions) -> Self {
        let SectionDivisions { across, fillet, flank, land, radial } = divisions;
        // Where the rows that are as wide as the teeth end, and how many are below.
        let (rim_radius_mm, web_rows) = match body.web {
            None => (body.clamp_radius_mm, 0),
            Some(web) => {
                let rim_radius_mm = tooth.root_radius_mm - web.rim_thickness_mm;
                (rim_radius_mm, web_rows(web.rim_thickness_mm, rim_radius_mm - body.clamp_radius_mm, radial))
            }
        };
        let outline = HalfOutline::new(tooth);
        let flank_radius_mm = [tooth.root_form_radius_mm, tooth.tip_radius_mm];
        let (columns, rim_rows) = (2 * (2 * land + across), 2 * radial);
        let rows = rim_rows + 2 * web_rows;
        let tooth_rows = 2 * (fillet + flank);
        let tip = outline.flank(tooth.tip_radius_mm);
        let tip_bulge = (tooth.tip_radius_mm - tip.y) / tip.x;
        // The tooth's grid: i from the working side, j from the middle of the fillet.
        let in_tooth = |i: usize, j: usize| {
            let edge = if j <= 2 * fillet {
                outline.upper.at(j as f64 / (2 * fillet) as f64)
            } else {
                let part = (j - 2 * fillet) as f64 / (2 * flank) as f64;
                outline.flank(flank_radius_mm[0] + part * (flank_radius_mm[1] - flank_radius_mm[0]))
            };
            let s = i as f64 / across as f64 - 1.0;
            let bulge = -0.5 * SAG + (tip_bulge + 0.5 * SAG) * j as f64 / tooth_rows as f64;
            let x = edge.x * s;
            if j == tooth_rows {
                Vector2::new(x, (tooth.tip_radius_mm.powi(2) - x * x).sqrt())
            } else {
                Vector2::new(x, edge.y + bulge * edge.x * (1.0 - s * s))
            }
        };
        let middle = outline.lower.at(1.0);
        let (at_cut, at_middle) = (PI / f64::from(tooth.teeth), middle.x.atan2(middle.y));
        let in_web = |j: usize| (j - rim_rows) as f64 / (rows - rim_rows) as f64;
        // The body's grid: i from the working side's cut, j from the outline.
        let in_body = |i: usize, j: usize| {
            let beside = 2 * land;
            let (top, angle) = if i < beside || i > columns - beside {
                let from_cut = i.min(columns - i) as f64 / beside as f64;
                let side = if i < beside { -1.0 } else { 1.0 };
                let point = outline.lower.at(from_cut);
                (Vector2::new(side * point.x, point.y), side * (at_cut + from_cut * (at_middle - at_cut)))
            } else {
                let k = i - beside;
                (in_tooth(k, 0), at_middle * (k as f64 / across as f64 - 1.0))
            };
            let outward = Vector2::new(angle.sin(), angle.cos());
            match j <= rim_rows {
                true => top.lerp(&(rim_radius_mm * outward), depth(j, radial)),
                false => (rim_radius_mm + in_web(j) * (body.clamp_radius_mm - rim_radius_mm)) * outward,
            }
        };
        let mut points_mm = Vec::new();
        let mut number = |points: Vec<Vec<Option<Vector2<f64>>>>| -> Vec<Vec<u32>> {
            let mut of_point = |point: Option<Vector2<f64>>| {
                point.map_or(u32::MAX, |point| {
                    points_mm.push(point);
                    points_mm.len() as u32 - 1
                })
            };
            points.into_iter().map(|row| row.into_iter().map(&mut of_point).collect()).collect()
        };
        // Middles of quadrilaterals are no nodes.
        let is_node = |i: usize, j: usize| i.is_multiple_of(2) || j.is_multiple_of(2);
        let body_grid =
            number((0..=rows).map(|j| (0..=columns).map(|i| is_node(i, j).then(|| in_body(i, j))).collect()).collect());
        let mut tooth_grid = vec![body_grid[0][2 * land..=columns - 2 * land].to_vec()];
        tooth_grid.extend(number(
            (1..=tooth_rows)
                .map(|j| (0..=2 * across).map(|i| is_node(i, j).then(|| in_tooth(i, j))).collect())
                .collect(),
        ));
        let mut quads = Vec::new();
        // Of two grids whose rows go up and down.
        let mut add = |grid: &[Vec<u32>], up: bool| {
            for j in (0..grid.len() - 1).step_by(2) {
                let (low, high) = if up { (j, j + 2) } else { (j + 2, j) };
                for i in (0..grid[0].len() - 1).step_by(2) {
                    let at = |di: usize, row: usize| grid[row][i + di];
                    quads.push([
                        at(0, low),
                        at(2, low),
                        at(2, high),
                        at(0, high),
                        at(1, low),
                        at(2, j + 1),
                        at(1, high),
                        at(0, j + 1),
                    ]);
                }
            }
        };
        add(&tooth_grid, true);
        add(&body_grid, false);
        let cut = |i: usize| body_grid.iter().rev().map(|row| row[i]).collect();
        Self {
            flank: tooth_grid[2 * fillet..].iter().map(|row| row[0]).collect(),
            cuts: [cut(columns), cut(0)],
            clamp: body_grid[rows].clone(),
            full_width_quads: quads.len() - web_rows * columns / 2,
            quads,
            points_mm,
            flank_radius_mm,
        }
    }

    /// The section as a plane mesh.
    pub fn to_mesh(&self) -> Mesh {
        let nodes = self.quads.iter().flatten().map(|node| *node as usize).collect();
        Mesh {
            points: self.points_mm.iter().map(|point| [point.x, point.y, 0.0]).collect(),
            cells: vec![CellBlock { kind: CellKind::Quad8, nodes }],
            ..Mesh::default()
        }
    }

    /// Where a radius of the flank lies among its nodes: the first node of the element, and ξ in it from −1 to 1; outside, in the
    /// element at that end.
    pub fn on_flank(&self, radius_mm: f64) -> (usize, f64) {
        let [first, last] = self.flank_radius_mm;
        let elements = self.flank.len() / 2;
        let place = (radius_mm - first) / (last - first) * elements as f64;
        let element = (place.max(0.0) as usize).min(elements - 1);
        (2 * element, (2.0 * (place - element as f64) - 1.0).clamp(-1.0, 1.0))
    }
}

impl ExtrudedTooth {
    /// One pitch of a gear of `pair` over its face width. Elements of both gears end at the same places over it.
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

    /// Where elements over the face width end, from z = 0 on.
    pub fn layer_ends_mm(&self) -> Vec<f64> {
        self.z_mm.iter().copied().step_by(2).collect()
    }

    /// Where a place over the face width lies in its element: which, and ζ in it from −1 to 1.
    pub(crate) fn across_width(&self, z_mm: f64) -> (usize, f64) {
        let ends_before = self.z_mm.iter().step_by(2).filter(|end| **end <= z_mm).count();
        let layer = ends_before.clamp(1, self.layers()) - 1;
        let [from, to] = [self.z_mm[2 * layer], self.z_mm[2 * layer + 2]];
        (layer, 2.0 * (z_mm - from) / (to - from) - 1.0)
    }

    /// `section` over the face width in layers that end at these places, from z = 0 on; its web is from one place to another.
    fn new(section: ToothSection, layer_ends_mm: &[f64], web_mm: Option<[f64; 2]>, twist_rad_per_mm: f64) -> Self {
        let (layers, face_width_mm) = (layer_ends_mm.len() - 1, layer_ends_mm[layer_ends_mm.len() - 1]);
        let end = |k: usize| layer_ends_mm[k / 2];
        let z_mm: Vec<f64> = (0..=2 * layers).map(|k| end(k).midpoint(end(k + 1))).collect();
        let quads_of = |layer: usize| {
            let in_web = web_mm.is_none_or(|[from, to]| (from..to).contains(&z_mm[2 * layer + 1]));
            &section.quads[..if in_web { section.quads.len() } else { section.full_width_quads }]
        };
        let mut is_node = vec![vec![false; section.points_mm.len()]; z_mm.len()];
        for layer in 0..layers {
            for quad in quads_of(layer) {
                for (k, of_quad) in [(2 * layer, &quad[..]), (2 * layer + 1, &quad[..4]), (2 * layer + 2, &quad[..])] {
                    of_quad.iter().for_each(|node| is_node[k][*node as usize] = true);
                }
            }
        }
        let mut points_mm = Vec::new();
        let mut nodes = Vec::with_capacity(z_mm.len());
        for (z, is_node) in z_mm.iter().zip(&is_node) {
            let turn = Rotation2::new(twist_rad_per_mm * (z - 0.5 * face_width_mm));
            let mut of_node = |(point, is_node): (&Vector2<f64>, &bool)| {
                is_node.then(|| {
                    let point = turn * point;
                    points_mm.push(Vector3::new(point.x, point.y, *z));
                    points_mm.len() as u32 - 1
                })
            };
            nodes.push(section.points_mm.iter().zip(is_node).map(&mut of_node).collect::<Vec<_>>());
        }
        let at = |k: usize, node: u32| nodes[k][node as usize].unwrap_or_default();
        let mut hexahedra = Vec::new();
        for layer in 0..layers {
            for quad in quads_of(layer) {
                let mut hexahedron = [0; 20];
                for (first, k) in [(0, 2 * layer), (4, 2 * layer + 2)] {
                    for a in 0..4 {
                        hexahedron[first + a] = at(k, quad[a]);
                        hexahedron[8 + first + a] = at(k, quad[4 + a]);
                    }
                }
                for a in 0..4 {
                    hexahedron[16 + a] = at(2 * layer + 1, quad[a]);
                }
                hexahedra.push(hexahedron);
            }
        }
        Self { section, z_mm, twist_rad_per_mm, points_mm, hexahedra, nodes }
    }

    /// Turn of the section at an end or a middle of a layer; none in the middle of the face width.
    pub(crate) fn turn_rad(&self, place: usize) -> f64 {
        self.twist_rad_per_mm * (self.z_mm[place] - 0.5 * self.z_mm[self.z_mm.len() - 1])
    }

    /// The nodes over `section_nodes`, end by end and middle by middle of the layers.
    pub fn over(&self, section_nodes: &[u32]) -> Vec<u32> {
        let of_place = |nodes: &'_ Vec<Option<u32>>| -> Vec<u32> {
            section_nodes.iter().filter_map(|node| nodes[*node as usize]).collect()
        };
        self.nodes.iter().flat_map(of_place).collect()
    }

    /// The node over a node of the section at an end (even) or a middle of a layer, where there is one.
    pub fn node(&self, section_node: u32, place: usize) -> Option<u32> {
        self.nodes[place][section_node as usize]
    }
}
