//! Two teeth that may touch, coupled by mortar on their true profiles in their true places.
//!
//! Contact ends at an edge of one of the flanks: below the pitch point at the wheel's tip edge or the corner of an undercut pinion,
//! above it at the pinion's tip edge or the corner of an undercut wheel. The flank of a sharp edge is the slave, so that multipliers end with it.
//! Where the edge is rounded the mate is the slave, so that normals are those of the smoother surface: normals that turn within the contact
//! would mix sliding into the gap.

use std::ops::Range;

use nalgebra::{Rotation2, Vector2};
use sprs::CsMat;

use super::condensed_pair::CondensedPair;
use super::condensed_pair::hertz_half_width_mm;
use super::flank_surface::MeshedFlank;
use super::placement::{axis_mm, in_place_mm, tooth_angle_rad};
use super::sandwich::CarriedRows;
use crate::gear::flank_edge::{FlankEdge, PathEnd};
use crate::gear::{Gear, PerGear};
use gearwear_fem::contact::mortar::MortarCoupling;
use gearwear_fem::elastic::Analysis;

/// Greatest length of rows that share a multiplier, in the greatest distance of the active profile's nodes, which resolves a smooth contact: where the mesh is
/// finer for the mate's tip edge, its rows are more than a smooth contact needs. Finer elements have shorter ones.
const MOST_LENGTH: f64 = 0.125;
/// Greatest length of rows that share a multiplier over their distance from a tip edge or a corner: pressures are as narrow there as its rounding, and
/// change less and less away from it.
const LENGTH_OVER_DISTANCE: f64 = 0.05;
/// Number of rows at an inner end of the window that must be without load.
const FREE_ROWS: usize = 3;
/// Extent of the window beyond an overlap over its half-length.
const BEYOND_OVERLAP: f64 = 0.5;

/// Component of a displacement of the flanks.
#[derive(Debug, Clone, Copy)]
pub(super) enum Direction {
    /// Along the normals, which opens gaps.
    AcrossFlank,
    /// From root to tip.
    AlongFlank,
}

/// Part of the flanks with multipliers: around the expected contact, and as far as flanks overlapped beside an earlier window.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SearchWindow {
    /// Number of tooth pairs on either side of the reference pair.
    pub beside: i32,
    /// Load for the half-width of contact, N/mm.
    pub line_load_n_per_mm: f64,
    /// Extent to either side of the expected contact, in half-widths.
    pub half_widths: f64,
    /// Greatest gap that has multipliers, mm.
    pub reach_mm: f64,
    /// Overlaps beside earlier windows, at most one of each tooth pair.
    pub overlaps: Vec<FlankOverlap>,
}

/// Overlap of the flanks of a tooth pair beside its window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FlankOverlap {
    pub pair: i32,
    /// Both ends on each flank, from its tip end, mm.
    pub from_tip_mm: PerGear<[f64; 2]>,
}

/// Two teeth in their places, and the parts of their flanks in the window.
pub(super) struct PlacedTeeth {
    pub pair: i32,
    pub slave: Gear,
    /// Numbers of both teeth among the fine ones.
    pub tooth: PerGear<usize>,
    /// Hertz half-width of contact under the whole load.
    pub half_width_mm: f64,
    /// Edges of each flank in the window.
    pub edges: PerGear<Range<usize>>,
    /// Turn from the frame of the master's tooth to that of the slave's.
    pub turn: Rotation2<f64>,
    /// Master's axis in the frame of the slave's tooth.
    pub master_axis_mm: Vector2<f64>,
    /// Expected contact from the slave's tip end, mm.
    expected_mm: f64,
    /// Pinion's axis in the frame of the slave's tooth.
    pinion_axis_mm: Vector2<f64>,
}

/// Loaded rows of one contact, by their number from tip to root.
struct LoadedRows {
    first: usize,
    last: usize,
    load: f64,
    /// Sum of load times tilt.
    tilted_load: f64,
}

/// Coupled flanks of a tooth pair.
pub(super) struct FacingTeeth {
    pub pair: i32,
    pub slave: Gear,
    /// Numbers of both teeth among the fine ones.
    pub tooth: PerGear<usize>,
    pub coupling: MortarCoupling,
    /// Edges of each flank in the window.
    pub edges: PerGear<Range<usize>>,
    /// Matrix B of the coupling for each gear, in its own tooth's frame.
    pub operator: PerGear<CsMat<f64>>,
    /// The same rows with the displacements that cuts carry.
    pub carried: PerGear<CarriedRows>,
    /// Expected contact from the slave's tip end, mm.
    pub expected_mm: f64,
    /// Pinion's axis in the frame of the slave's tooth.
    pub pinion_axis_mm: Vector2<f64>,
    /// Whether the window ends within both flanks towards the slave's tip, towards its root.
    pub inner_ends: (bool, bool),
    /// Distance of the rows, which run from tip to root, from the slave's tip end, mm.
    along_mm: Vec<f64>,
    /// Hertz half-width of contact under the whole load.
    pub half_width_mm: f64,
    pub first_row: usize,
}

impl CondensedPair<'_> {
    /// Tooth pairs within reach of both tip circles with the reference pair at `position_mm`.
    pub(super) fn placed_teeth(&self, position_mm: f64, window: &SearchWindow) -> Vec<PlacedTeeth> {
        let pairs = -window.beside..=window.beside;
        pairs.filter_map(|pair| self.placed(position_mm, pair, window)).collect()
    }

    /// Coupled flanks of the tooth pairs with multipliers in their window, rows numbered through.
    pub(super) fn facings(&self, placed: &[PlacedTeeth], window: &SearchWindow) -> Vec<FacingTeeth> {
        let mut facings: Vec<FacingTeeth> = placed.iter().filter_map(|placed| self.facing(placed, window)).collect();
        let mut first_row = 0;
        for facing in &mut facings {
            facing.first_row = first_row;
            first_row += facing.coupling.len();
        }
        facings
    }

    fn placed(&self, position_mm: f64, pair: i32, window: &SearchWindow) -> Option<PlacedTeeth> {
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
            // The master's window faces all of the slave's, also where it is a little oblique.
            let window_mm = if gear == slave { window_mm } else { 1.3 * window_mm };
            let mut ends_mm = [expected[gear] - window_mm, expected[gear] + window_mm];
            if let Some(FlankOverlap { from_tip_mm, .. }) = overlap {
                let beyond_mm = BEYOND_OVERLAP * window_mm;
                let [from_mm, to_mm] = from_tip_mm[gear];
                ends_mm = [ends_mm[0].min(from_mm - beyond_mm), ends_mm[1].max(to_mm + beyond_mm)];
            }
            self.flanks[gear].edges_between(ends_mm[0], ends_mm[1])
        });
        let angle_rad = PerGear::from_fn(|gear| tooth_angle_rad(self.pair, gear, position_mm, pair));
        // In the frame of the slave's tooth.
        let [master_axis_mm, pinion_axis_mm] = [master, Gear::Pinion]
            .map(|gear| Rotation2::new(-angle_rad[slave]) * (axis_mm(self.pair, gear) - axis_mm(self.pair, slave)));
        let middle = (self.gears.pinion.teeth() / 2) as i32;
        Some(PlacedTeeth {
            pair,
            slave,
            // The pair ahead has the next tooth of the pinion anticlockwise, and of the wheel clockwise.
            tooth: PerGear { pinion: (middle + pair) as usize, wheel: (middle - pair) as usize },
            half_width_mm,
            edges,
            turn: Rotation2::new(angle_rad[master] - angle_rad[slave]),
            master_axis_mm,
            expected_mm: expected[slave],
            pinion_axis_mm,
        })
    }

    fn facing(&self, placed: &PlacedTeeth, window: &SearchWindow) -> Option<FacingTeeth> {
        let PlacedTeeth { slave, ref edges, turn, master_axis_mm, .. } = *placed;
        let master = slave.mate();
        let own = &edges[slave];
        let slave_part = self.flanks[slave].surface.part(edges[slave].clone());
        let master_part =
            self.flanks[master].surface.part(edges[master].clone()).placed(|x| turn * x + master_axis_mm, |n| turn * n);
        let fine = MortarCoupling::new(&slave_part, &master_part, window.reach_mm, Analysis::PlaneStrain);
        if fine.is_empty() {
            return None;
        }
        let coupling = fine.grouped(&self.groups(&fine, placed));
        // Where the master itself ends there are no rows that the window could cut off; from the slave's tip to its root the master runs towards its tip.
        let mate = &edges[master];
        let mate_ends = (mate.end == self.flanks[master].surface.edges.len(), mate.start == 0);
        let has_row_on = |edge: usize| {
            let nodes = self.flanks[slave].surface.edges[edge].nodes();
            coupling.ends.iter().flatten().any(|node| nodes.contains(node))
        };
        let inner_ends = (
            own.start > 0 && (has_row_on(own.start) || !mate_ends.0),
            own.end < self.flanks[slave].surface.edges.len() && (has_row_on(own.end - 1) || !mate_ends.1),
        );
        let along_mm = coupling.nodes.iter().map(|&node| self.flanks[slave].from_tip_mm[node]).collect();
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
            carried: PerGear::from_fn(|gear| CarriedRows::new(&self.gears[gear], &operator[gear])),
            operator,
            expected_mm: placed.expected_mm,
            pinion_axis_mm: placed.pinion_axis_mm,
            inner_ends,
            along_mm,
            half_width_mm: placed.half_width_mm,
            first_row: 0,
        })
    }

    /// Rows of `fine` that share a multiplier, from tip to root: put together outwards from the expected contact, so that they are the same in wider
    /// windows.
    fn groups(&self, fine: &MortarCoupling, placed: &PlacedTeeth) -> Vec<Vec<usize>> {
        let far_mm = |row: usize| self.flanks[placed.slave].from_tip_mm[fine.nodes[row]] - placed.expected_mm;
        let mut rows: Vec<usize> = (0..fine.len()).collect();
        rows.sort_by(|&a, &b| far_mm(a).total_cmp(&far_mm(b)));
        let (to_tip, to_root) = rows.split_at(rows.partition_point(|&row| far_mm(row) < 0.0));
        let active_rho_mm = self.pair.active_start_rho_mm(placed.slave);
        let most_mm = MOST_LENGTH * self.flanks[placed.slave].farthest_nodes_mm(active_rho_mm);
        let edges_mm = self.edges_mm(fine, placed);
        let length_mm = |row: usize| {
            let from_edges_mm = edges_mm.iter().map(|edge_mm| (far_mm(row) - edge_mm).abs());
            most_mm.min(LENGTH_OVER_DISTANCE * from_edges_mm.fold(f64::INFINITY, f64::min))
        };
        let outwards = |rows: &mut dyn Iterator<Item = usize>| {
            let mut groups: Vec<Vec<usize>> = Vec::new();
            let mut begins_mm = 0.0;
            for row in rows {
                let here_mm = far_mm(row).abs();
                match groups.last_mut() {
                    Some(group) if here_mm - begins_mm < length_mm(row) => group.push(row),
                    _ => {
                        groups.push(vec![row]);
                        begins_mm = here_mm;
                    }
                }
            }
            groups
        };
        let mut groups = outwards(&mut to_tip.iter().rev().copied());
        groups.reverse();
        groups.extend(outwards(&mut to_root.iter().copied()));
        groups
    }

    /// Places of the rows of `fine` at a tip edge, on its rounding or at a corner of one of the flanks, from the expected contact.
    fn edges_mm(&self, fine: &MortarCoupling, placed: &PlacedTeeth) -> Vec<f64> {
        let at_edge = |gear: Gear, column: usize| {
            let (flank, node) = (&self.flanks[gear], column / 2);
            // ρ is NaN on a rounding.
            !flank.rho_mm[node].is_finite() || node == flank.tip_node() || node == flank.root_node()
        };
        let of_gears = [(placed.slave, &fine.slave), (placed.slave.mate(), &fine.master)];
        let rows = fine.nodes.iter().enumerate().filter(|(row, _)| {
            let of_gear = |(gear, operator): (Gear, &CsMat<f64>)| {
                operator.outer_view(*row).is_some_and(|row| row.indices().iter().any(|&column| at_edge(gear, column)))
            };
            of_gears.into_iter().any(of_gear)
        });
        let slave = &self.flanks[placed.slave];
        rows.map(|(_, &node)| slave.from_tip_mm[node] - placed.expected_mm).collect()
    }

    /// Edge that a tooth pair touches with where its theoretical contact point is at `own_mm`; `None` between A and E.
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

    /// ρ of the mate's flank at the distance of `edge` from the mate's axis, mm.
    pub(super) fn rho_at_edge_mm(&self, edge: FlankEdge, position_mm: f64, pair: i32) -> f64 {
        let own = &self.flanks[edge.gear];
        let point = own.surface.points_mm[if edge.at_root { own.root_node() } else { own.tip_node() }];
        let point = in_place_mm(self.pair, edge.gear, position_mm, pair, point);
        let mate = edge.gear.mate();
        self.pair.path.involute[mate].curvature_radius_mm((point - axis_mm(self.pair, mate)).norm())
    }

    /// Expected contact on each flank from its tip end, mm: on the line of action, or at the edge before A and after E.
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

    /// Displacement of each row of a pair per transmission error: opening of the gap, or along the flank from root to tip.
    pub(super) fn by_rotation<'b>(
        &'b self,
        facing: &'b FacingTeeth,
        direction: Direction,
    ) -> impl Iterator<Item = f64> + 'b {
        let rows = facing.operator.pinion.outer_iterator();
        rows.map(move |row| row.iter().map(|(column, b)| b * self.rotation(column, direction)).sum())
    }

    /// Displacement of a candidate column of the pinion per transmission error, or with `AlongFlank` turned by −90°.
    pub(super) fn rotation(&self, column: usize, direction: Direction) -> f64 {
        let point = self.flanks.pinion.surface.points_mm[column / 2];
        let r_b = self.pair.path.involute.pinion.base_radius_mm;
        let [x, y] = match direction {
            Direction::AcrossFlank => [-point.y, point.x],
            Direction::AlongFlank => [-point.x, -point.y],
        };
        if column.is_multiple_of(2) { x / r_b } else { y / r_b }
    }
}

impl SearchWindow {
    /// Extends the window to `overlap`.
    pub(super) fn reach_to(&mut self, overlap: FlankOverlap) {
        let Some(known) = self.overlaps.iter_mut().find(|known| known.pair == overlap.pair) else {
            return self.overlaps.push(overlap);
        };
        for gear in Gear::BOTH {
            let ([from, to], [other_from, other_to]) = (known.from_tip_mm[gear], overlap.from_tip_mm[gear]);
            known.from_tip_mm[gear] = [from.min(other_from), to.max(other_to)];
        }
    }
}

impl LoadedRows {
    /// Distance of the loaded rows from `here_mm`, negative within them.
    fn distance_mm(&self, along_mm: &[f64], here_mm: f64) -> f64 {
        (along_mm[self.first] - here_mm).max(here_mm - along_mm[self.last])
    }
}

impl FacingTeeth {
    /// Rows of the tooth pair among those of the position.
    pub(super) fn rows(&self) -> Range<usize> {
        self.first_row..self.first_row + self.coupling.len()
    }

    /// Distance of a node of the slave from the expected contact, towards the pinion's tip.
    pub(super) fn towards_pinion_tip_mm(&self, slave: &MeshedFlank, node: usize) -> f64 {
        let from_tip_mm = slave.from_tip_mm[node] - self.expected_mm;
        if self.slave == Gear::Pinion { -from_tip_mm } else { from_tip_mm }
    }

    /// Sets the tilt of each row from `tilt_rad` at the slave's nodes: within a half-width of loaded rows the mean over the
    /// load of their contact, farther off the mean over a half-width to either side. Loaded rows farther apart than a half-width are two
    /// contacts. Without load nothing is set.
    pub(super) fn set_mean_tilts(&self, force: &[f64], tilt_rad: impl Fn(usize) -> f64, of_rows: &mut [f64]) {
        let tilt_rad: Vec<f64> = self.coupling.nodes.iter().map(|&node| tilt_rad(node)).collect();
        let contacts = self.contacts(force, &tilt_rad);
        if contacts.is_empty() {
            return;
        }
        let ([mut from, mut to], mut sum) = ([0, 0], 0.0);
        for (row, &here_mm) in self.along_mm.iter().enumerate() {
            while to < self.along_mm.len() && self.along_mm[to] <= here_mm + self.half_width_mm {
                sum += tilt_rad[to];
                to += 1;
            }
            while self.along_mm[from] < here_mm - self.half_width_mm {
                sum -= tilt_rad[from];
                from += 1;
            }
            let nearest = contacts
                .iter()
                .map(|contact| (contact, contact.distance_mm(&self.along_mm, here_mm)))
                .min_by(|(_, a), (_, b)| a.total_cmp(b));
            of_rows[self.first_row + row] = match nearest {
                Some((contact, distance_mm)) if distance_mm <= self.half_width_mm => contact.tilted_load / contact.load,
                _ => sum / (to - from) as f64,
            };
        }
    }

    /// Loaded rows from tip to root, with the tilts of all rows.
    fn contacts(&self, force: &[f64], tilt_rad: &[f64]) -> Vec<LoadedRows> {
        let mut contacts: Vec<LoadedRows> = Vec::new();
        for (at, &force) in force[self.first_row..][..self.along_mm.len()].iter().enumerate() {
            if force <= 0.0 {
                continue;
            }
            match contacts.last_mut() {
                Some(contact) if self.along_mm[at] - self.along_mm[contact.last] <= self.half_width_mm => {
                    contact.last = at;
                    contact.load += force;
                    contact.tilted_load += force * tilt_rad[at];
                }
                _ => contacts.push(LoadedRows { first: at, last: at, load: force, tilted_load: force * tilt_rad[at] }),
            }
        }
        contacts
    }

    /// Whether load comes close to an end of the window within the flank, so that it may have been cut off.
    pub(super) fn is_cramped(&self, force: &[f64]) -> bool {
        let force = &force[self.first_row..][..self.along_mm.len()];
        let is_loaded = |force: &f64| *force > 0.0;
        (self.inner_ends.0 && force.iter().take(FREE_ROWS).any(is_loaded))
            || (self.inner_ends.1 && force.iter().rev().take(FREE_ROWS).any(is_loaded))
    }
}

/// B turned into another frame: its rows have both columns of each node that they have one of.
pub(super) fn turned(operator: &CsMat<f64>, turn: Rotation2<f64>) -> CsMat<f64> {
    let mut turned = operator.clone();
    for entries in turned.data_mut().chunks_exact_mut(2) {
        let image = turn * Vector2::new(entries[0], entries[1]);
        entries.copy_from_slice(image.as_slice());
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gear_fem::tilted::tests::{condensed_fzg_a, fzg_a};

    /// Rows run from tip to root, so that a row and the next are neighbours.
    #[test]
    fn rows_run_from_tip_to_root() {
        let pair = fzg_a();
        let model = condensed_fzg_a(&pair);
        let window = SearchWindow {
            beside: 0,
            line_load_n_per_mm: 300.0,
            half_widths: 3.0,
            reach_mm: 0.1,
            overlaps: Vec::new(),
        };
        let facings = model.facings(&model.placed_teeth(pair.path.pitch_point_mm, &window), &window);
        let facing = facings.first().expect("the reference pair touches at the pitch point");
        assert!(
            5 < facing.along_mm.len() && facing.along_mm.windows(2).all(|two| two[0] < two[1]),
            "{:?}",
            facing.along_mm
        );
    }
}
