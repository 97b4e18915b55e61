//! Two teeth that may touch: coupled by mortar on their true profiles in their true places.
//!
//! One of the two flanks ends the contact with an edge: below the pitch point with the wheel's tip edge or the corner of an undercut pinion,
//! above it with the pinion's tip edge or the corner of an undercut wheel. Where that edge is sharp, the pressure lives on its flank, so that multipliers end where the flank ends. Where it is rounded, the
//! pressure lives on the mate, so that normals are those of the smoother surface: normals that turn within the contact
//! would mix the sliding of the surfaces on each other into the gap.

use std::ops::Range;

use nalgebra::{Rotation2, Vector2};
use sprs::CsMat;

use super::condensed_pair::CondensedPair;
use super::condensed_pair::hertz_half_width_mm;
use super::flank_surface::FlankSurface;
use super::placement::{axis_mm, in_place_mm, tooth_angle_rad};
use crate::gear::flank_edge::{FlankEdge, PathEnd};
use crate::gear::{Gear, PerGear};
use gearwear_fem::contact::mortar::Coupling;

/// Rows at an inner end of the window that must stay without load.
const FREE_ROWS: usize = 3;
/// How far beyond an overlap the window reaches, in its own half-lengths.
const BEYOND_OVERLAP: f64 = 0.5;

/// Which way a displacement of the flanks is looked at.
#[derive(Debug, Clone, Copy)]
pub(super) enum Direction {
    /// Along the normals: what opens gaps.
    AcrossFlank,
    /// From root to tip.
    AlongFlank,
}

/// Where multipliers are looked for: around the expected contact, and as far as flanks overlapped beside an earlier window.
#[derive(Debug, Clone)]
pub(super) struct Window {
    /// Tooth pairs on either side of the reference pair.
    pub beside: i32,
    /// Load that sets the half-width, N/mm.
    pub line_load_n_per_mm: f64,
    /// To either side of the expected contact.
    pub half_widths: f64,
    /// Distance between the flanks within which they may come to touch, mm.
    pub reach_mm: f64,
    /// One of a tooth pair at most.
    pub overlaps: Vec<Overlap>,
}

/// Where the flanks of a tooth pair overlapped beside its window.
#[derive(Debug, Clone, Copy)]
pub(super) struct Overlap {
    pub pair: i32,
    /// From and to on either flank, from its tip end, mm.
    pub from_tip_mm: PerGear<[f64; 2]>,
}

/// Two teeth in their places, and the parts of their flanks that are looked at.
pub(super) struct PlacedTeeth {
    pub pair: i32,
    pub slave: Gear,
    /// Their places among the fine ones.
    pub tooth: PerGear<usize>,
    /// Hertz half-width of contact under the whole load.
    pub half_width_mm: f64,
    /// Edges of each flank in the window.
    pub edges: PerGear<Range<usize>>,
    /// From the frame of the master's tooth to that of the slave's: a turn, and where the master's axis lies.
    pub turn: Rotation2<f64>,
    pub master_axis_mm: Vector2<f64>,
    /// Expected contact from the slave's tip end, mm.
    expected_mm: f64,
    /// The pinion's axis in the frame of the slave's tooth.
    pinion_axis_mm: Vector2<f64>,
}

/// Loaded rows of a tooth pair that belong together, by their places from tip to root.
struct LoadedRows {
    first: usize,
    last: usize,
    load: f64,
    /// Each row's load times its tilt.
    tilted_load: f64,
}

/// A tooth pair prepared for contact.
pub(super) struct FacingTeeth {
    pub pair: i32,
    pub slave: Gear,
    /// Places of its teeth among the fine ones.
    pub tooth: PerGear<usize>,
    pub coupling: Coupling,
    /// Edges of each flank that are looked at.
    pub edges: PerGear<Range<usize>>,
    /// B for each gear, in its own tooth's frame.
    pub operator: PerGear<CsMat<f64>>,
    /// Expected contact from the slave's tip end, mm.
    pub expected_mm: f64,
    /// The pinion's axis in the frame of the slave's tooth.
    pub pinion_axis_mm: Vector2<f64>,
    /// Whether the window's ends are inner ones: towards the tip, towards the root.
    pub inner_ends: (bool, bool),
    /// Its rows from tip to root.
    pub from_tip: Vec<usize>,
    /// Distance from the slave's tip end of each of these, mm.
    along_mm: Vec<f64>,
    /// Hertz half-width of contact under the whole load.
    half_width_mm: f64,
    pub first_row: usize,
}

impl CondensedPair<'_> {
    /// All tooth pairs whose tip circles reach each other with the reference pair at `position_mm`.
    pub(super) fn placed_teeth(&self, position_mm: f64, window: &Window) -> Vec<PlacedTeeth> {
        let pairs = -window.beside..=window.beside;
        pairs.filter_map(|pair| self.placed(position_mm, pair, window)).collect()
    }

    /// Those with anything in their window that may touch, rows numbered through.
    pub(super) fn facings(&self, placed: &[PlacedTeeth], window: &Window) -> Vec<FacingTeeth> {
        let mut first_row = 0;
        let facing = |placed: &PlacedTeeth| {
            let mut facing = self.facing(placed, window)?;
            facing.first_row = first_row;
            first_row += facing.coupling.len();
            Some(facing)
        };
        placed.iter().filter_map(facing).collect()
    }

    fn placed(&self, position_mm: f64, pair: i32, window: &Window) -> Option<PlacedTeeth> {
        let path = &self.pair.path;
        let own_mm = position_mm + f64::from(pair) * path.base_pitch_mm;
        let [before_mm, after_mm] = self.pair.farthest_touch_mm();
        if own_mm < path.start_mm - before_mm || own_mm > path.end_mm + after_mm {
            return None;
        }
        let edge = self.pair.edge(if own_mm <= path.pitch_point_mm { PathEnd::Start } else { PathEnd::End });
        let slave = if edge.is_sharp { edge.gear } else { edge.gear.mate() };
        let master = slave.mate();
        let expected = self.expected_from_tip_mm(position_mm, pair, own_mm);
        let half_width_mm = hertz_half_width_mm(self.pair, self.contact_modulus_mpa, window.line_load_n_per_mm, own_mm);
        let window_mm = window.half_widths * half_width_mm;
        let overlap = window.overlaps.iter().find(|overlap| overlap.pair == pair);
        let edges = PerGear::from_fn(|gear| {
            // The master must be met over the whole of the slave's window, also where it is seen a little askew.
            let window_mm = if gear == slave { window_mm } else { 1.3 * window_mm };
            let mut ends_mm = [expected[gear] - window_mm, expected[gear] + window_mm];
            if let Some(Overlap { from_tip_mm, .. }) = overlap {
                let beyond_mm = BEYOND_OVERLAP * window_mm;
                let [from_mm, to_mm] = from_tip_mm[gear];
                ends_mm = [ends_mm[0].min(from_mm - beyond_mm), ends_mm[1].max(to_mm + beyond_mm)];
            }
            self.flanks[gear].edges_between(ends_mm[0], ends_mm[1])
        });
        // Both in the frame of the slave's tooth.
        let angle_rad = |gear| tooth_angle_rad(self.pair, gear, position_mm, pair);
        let from_slave = |point: Vector2<f64>| Rotation2::new(-angle_rad(slave)) * (point - axis_mm(self.pair, slave));
        let middle = (self.gears.pinion.teeth() / 2) as i32;
        Some(PlacedTeeth {
            pair,
            slave,
            // The pair ahead is the next anticlockwise tooth of the pinion, and the next clockwise one of the wheel.
            tooth: PerGear { pinion: (middle + pair) as usize, wheel: (middle - pair) as usize },
            half_width_mm,
            edges,
            turn: Rotation2::new(angle_rad(master) - angle_rad(slave)),
            master_axis_mm: from_slave(axis_mm(self.pair, master)),
            expected_mm: expected[slave],
            pinion_axis_mm: from_slave(axis_mm(self.pair, Gear::Pinion)),
        })
    }

    fn facing(&self, placed: &PlacedTeeth, window: &Window) -> Option<FacingTeeth> {
        let PlacedTeeth { slave, ref edges, turn, master_axis_mm, .. } = *placed;
        let master = slave.mate();
        let inner_ends = (edges[slave].start > 0, edges[slave].end < self.flanks[slave].surface.edges.len());
        let slave_part = self.flanks[slave].surface.part(edges[slave].clone());
        let master_part =
            self.flanks[master].surface.part(edges[master].clone()).placed(|x| turn * x + master_axis_mm, |n| turn * n);
        let coupling = Coupling::new(&slave_part, &master_part, window.reach_mm);
        if coupling.is_empty() {
            return None;
        }
        let from_tip_mm = |row: &usize| self.flanks[slave].from_tip_mm[coupling.nodes[*row]];
        let mut from_tip: Vec<usize> = (0..coupling.len()).collect();
        from_tip.sort_by(|a, b| from_tip_mm(a).total_cmp(&from_tip_mm(b)));
        let along_mm = from_tip.iter().map(from_tip_mm).collect();
        let of_master = turned(&coupling.master, turn.inverse());
        let operator = match slave {
            Gear::Pinion => PerGear { pinion: coupling.slave.clone(), wheel: of_master },
            Gear::Wheel => PerGear { pinion: of_master, wheel: coupling.slave.clone() },
        };
        Some(FacingTeeth {
            pair: placed.pair,
            slave,
            tooth: placed.tooth,
            coupling,
            edges: edges.clone(),
            operator,
            expected_mm: placed.expected_mm,
            pinion_axis_mm: placed.pinion_axis_mm,
            inner_ends,
            along_mm,
            half_width_mm: placed.half_width_mm,
            from_tip,
            first_row: 0,
        })
    }

    /// The edge beyond which a tooth pair with its theoretical contact point at `own_mm` is; none between A and E.
    pub(super) fn edge_passed(&self, own_mm: f64) -> Option<FlankEdge> {
        let path = &self.pair.path;
        if own_mm < path.start_mm {
            Some(self.pair.edge(PathEnd::Start))
        } else if own_mm > path.end_mm {
            Some(self.pair.edge(PathEnd::End))
        } else {
            None
        }
    }

    /// ρ of the mate's flank at the radius that `edge` has from the mate's axis.
    pub(super) fn rho_at_edge_mm(&self, edge: FlankEdge, position_mm: f64, pair: i32) -> f64 {
        let own = &self.flanks[edge.gear];
        let point = own.surface.points_mm[if edge.at_root { own.root_node() } else { own.tip_node() }];
        let point = in_place_mm(self.pair, edge.gear, position_mm, pair, point);
        let mate = edge.gear.mate();
        self.pair.path.involute[mate].curvature_radius_mm((point - axis_mm(self.pair, mate)).norm())
    }

    /// Where contact is expected on each flank, from its tip end: on the line of action, or before A and after E at the
    /// edge.
    fn expected_from_tip_mm(&self, position_mm: f64, pair: i32, own_mm: f64) -> PerGear<f64> {
        let edge = self.edge_passed(own_mm);
        PerGear::from_fn(|gear| {
            let flank = &self.flanks[gear];
            match edge {
                Some(edge) if edge.gear == gear && edge.at_root => flank.from_tip_mm[flank.root_node()],
                Some(edge) if edge.gear == gear => 0.0,
                Some(edge) => flank.distance_to_tip_mm(self.rho_at_edge_mm(edge, position_mm, pair)),
                None => flank.distance_to_tip_mm(self.pair.path.rho_mm(gear, own_mm)),
            }
        })
    }

    /// Change of each gap of a pair, or of its place along the flank from root to tip, per transmission error.
    pub(super) fn by_rotation<'b>(
        &'b self,
        facing: &'b FacingTeeth,
        direction: Direction,
    ) -> impl Iterator<Item = f64> + 'b {
        let turned = move |row: sprs::CsVecView<'_, f64>| {
            row.iter().map(|(column, b)| b * self.rotation(column, direction)).sum()
        };
        facing.operator.pinion.outer_iterator().map(turned)
    }

    /// Displacement of a candidate column of the pinion per transmission error, `direction` being that of the column's normal.
    pub(super) fn rotation(&self, column: usize, direction: Direction) -> f64 {
        let point = self.flanks.pinion.surface.points_mm[column / 2];
        let r_b = self.pair.path.involute.pinion.base_radius_mm;
        let [x, y] = match direction {
            Direction::AcrossFlank => [-point.y, point.x],
            // Along R(−90°) n.
            Direction::AlongFlank => [-point.x, -point.y],
        };
        if column.is_multiple_of(2) { x / r_b } else { y / r_b }
    }
}

impl Window {
    /// Reaches as far as `overlap`, too.
    pub(super) fn reach_to(&mut self, overlap: Overlap) {
        let Some(known) = self.overlaps.iter_mut().find(|known| known.pair == overlap.pair) else {
            return self.overlaps.push(overlap);
        };
        for gear in Gear::BOTH {
            let ([from, to], [other_from, other_to]) = (known.from_tip_mm[gear], overlap.from_tip_mm[gear]);
            known.from_tip_mm[gear] = [from.min(other_from), to.max(other_to)];
        }
    }
}

impl FacingTeeth {
    /// Distance of a node of the slave from the expected contact, towards the pinion's tip.
    pub(super) fn towards_pinion_tip_mm(&self, slave: &FlankSurface, node: usize) -> f64 {
        let from_tip_mm = slave.from_tip_mm[node] - self.expected_mm;
        if self.slave == Gear::Pinion { -from_tip_mm } else { from_tip_mm }
    }

    /// Sets for each of its rows what it has of what `tilt_rad` is at the slave's nodes: within a half-width of loaded rows the mean over the
    /// load of their contact, farther off the mean over a half-width to either side. Loaded rows farther apart than a half-width belong to two
    /// contacts. Without load nothing is set.
    pub(super) fn set_mean_tilts(&self, force: &[f64], tilt_rad: impl Fn(usize) -> f64, of_rows: &mut [f64]) {
        let tilt_rad = |at: usize| tilt_rad(self.coupling.nodes[self.from_tip[at]]);
        let mut contacts: Vec<LoadedRows> = Vec::new();
        for (at, row) in self.from_tip.iter().enumerate() {
            let force = force[self.first_row + row];
            if force <= 0.0 {
                continue;
            }
            match contacts.last_mut() {
                Some(contact) if self.along_mm[at] - self.along_mm[contact.last] <= self.half_width_mm => {
                    contact.last = at;
                    contact.load += force;
                    contact.tilted_load += force * tilt_rad(at);
                }
                _ => contacts.push(LoadedRows { first: at, last: at, load: force, tilted_load: force * tilt_rad(at) }),
            }
        }
        if contacts.is_empty() {
            return;
        }
        let ([mut from, mut to], mut sum) = ([0, 0], 0.0);
        for (at, row) in self.from_tip.iter().enumerate() {
            let here_mm = self.along_mm[at];
            while to < self.along_mm.len() && self.along_mm[to] <= here_mm + self.half_width_mm {
                sum += tilt_rad(to);
                to += 1;
            }
            while self.along_mm[from] < here_mm - self.half_width_mm {
                sum -= tilt_rad(from);
                from += 1;
            }
            let off_mm = |contact: &LoadedRows| {
                (self.along_mm[contact.first] - here_mm).max(here_mm - self.along_mm[contact.last])
            };
            let nearest = contacts.iter().min_by(|a, b| off_mm(a).total_cmp(&off_mm(b)));
            of_rows[self.first_row + row] = match nearest {
                Some(contact) if off_mm(contact) <= self.half_width_mm => contact.tilted_load / contact.load,
                _ => sum / (to - from) as f64,
            };
        }
    }

    /// Whether load comes close to an inner end of the window, so that it may have been cut off.
    pub(super) fn is_cramped(&self, force: &[f64]) -> bool {
        let loaded = |row: &usize| force[self.first_row + row] > 0.0;
        let rows = &self.from_tip;
        let (mut first, mut last) = (rows.iter().take(FREE_ROWS), rows.iter().rev().take(FREE_ROWS));
        (self.inner_ends.0 && first.any(loaded)) || (self.inner_ends.1 && last.any(loaded))
    }
}

/// B with each pair of columns turned into another frame.
pub(super) fn turned(operator: &CsMat<f64>, turn: Rotation2<f64>) -> CsMat<f64> {
    let mut triplets = sprs::TriMat::new(operator.shape());
    for (i, row) in operator.outer_iterator().enumerate() {
        for (column, value) in row.iter() {
            let unit = if column.is_multiple_of(2) { Vector2::x() } else { Vector2::y() };
            let image = turn * (*value * unit);
            triplets.add_triplet(i, column - column % 2, image.x);
            triplets.add_triplet(i, column - column % 2 + 1, image.y);
        }
    }
    triplets.to_csr()
}
