//! Positions that are computed one after the other: their contacts in rows, from equilibrium to wear.
//!
//! A contact of the simplified model stays at its place on both flanks, so that nothing is interpolated in a wear
//! step. With the mean pressure and the sliding distance of [`crate::contact::hertz_mean`],
//!
//! ```text
//! p = w/(2a) = √w / (2 √α)          s = 2 a |ζ| = √w · 2 √α |ζ|          a = √(α w)
//! ```
//!
//! rows of both go to the wear law, and the depth opens the gap of the flanks before the next equilibrium, along the transverse line of
//! action by 1/cos β_b of the depth.

use super::closed_form::ContactForms;
use super::exact::SlicesInSeries;
use super::lanes::{LANES, Lanes};
use super::loaded_position::{Attempt, Common, LoadedPosition, Pack, Tangent, UNUSED_GAP_MM};
use crate::lubrication::running_pair::LoadedPlace;
use crate::mesh_cycle::{
    Work,
    coupled_teeth::CoupledTeeth,
    load_sharing::EquilibriumError,
    sliced_positions::{SliceContact, SlicedPosition},
};
use crate::thermal::{HeatedStrip, SpeedRatios, band::Spread};
use crate::wear::{ContactConditions, Lambda, SlidingRow, WearModel, heated_row::HeatedContact};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::reference::hertz_line::PEAK_OVER_MEAN;

/// Quantities of a contact over the square root of its load.
#[derive(Debug, Clone, Copy, Default)]
struct PerRoot {
    /// 1/(2 √α): mean pressure.
    pressure: Lanes,
    /// 2 √α |ζ|: sliding distance of both flanks.
    sliding: [Lanes; 2],
    /// √α: half-width.
    half_width: Lanes,
}

/// A value for every lane of some packs.
type Row = Vec<[f64; LANES]>;

/// Contacts of some positions in rows.
pub(crate) struct Batch {
    /// Positions with their contacts.
    pub positions: Vec<SlicedPosition>,
    /// State of each position.
    pub loaded_positions: Vec<LoadedPosition>,
    packs: Vec<Pack>,
    /// Gap of the unworn flanks along the transverse line of action.
    modification_mm: Vec<Lanes>,
    per_root: Vec<PerRoot>,
    /// Speed ratios of the surfaces at the contact in each lane.
    ratios: Vec<SpeedRatios>,
    /// Teeth of each position, where slices are coupled.
    teeth: Vec<CoupledTeeth>,
    common: Common,
    /// Gap along the transverse line of action over depth normal to the flanks ([`gearwear_bodies::gear::normal_section`]).
    gap_per_depth: f64,
    /// Depth that both flanks have lost at each contact, mm.
    wear_mm: PerGear<Row>,
    /// Depth that both flanks lose in one mesh at each contact, mm.
    depth_mm: PerGear<Row>,
    tangents: Vec<Tangent>,
    pressure_mpa: Row,
    sliding_mm: [Row; 2],
    conditions: Vec<ContactConditions>,
    lambda: Vec<f64>,
    places: Vec<LoadedPlace>,
    begun: bool,
    outcome: Result<Work, EquilibriumError>,
}

/// State of a contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LaneContact {
    /// w, N/mm.
    pub line_load_n_per_mm: f64,
    /// a, mm.
    pub half_width_mm: f64,
    /// Mean pressure, MPa.
    pub pressure_mpa: f64,
    /// 2 a |ζ| of both flanks, mm.
    pub sliding_mm: PerGear<f64>,
}

impl Batch {
    /// Prepares the contacts of `positions`, on flanks modified by `modification_mm` there.
    pub(crate) fn new(
        positions: Vec<SlicedPosition>,
        forms: &ContactForms<'_>,
        springs: &SlicesInSeries<'_>,
        modification_mm: impl Fn(&SliceContact) -> f64,
    ) -> Self {
        let count: usize = positions.iter().map(|position| position.contacts.len().div_ceil(LANES)).sum();
        let unused = Pack { rigid: Lanes::splat(1.0), gap_mm: Lanes::splat(UNUSED_GAP_MM), ..Pack::default() };
        let zeros = vec![[0.0; LANES]; count];
        let mut batch = Self {
            loaded_positions: Vec::with_capacity(positions.len()),
            modification_mm: Vec::new(),
            packs: vec![unused; count],
            per_root: vec![PerRoot::default(); count],
            ratios: vec![SpeedRatios::default(); LANES * count],
            teeth: Vec::new(),
            common: Common {
                log_compliance_mm2_per_n: forms.log_compliance_mm2_per_n(),
                line_load_n_per_mm: springs.line_load_n_per_mm,
            },
            gap_per_depth: springs.pair.obliquity().transverse_mm(1.0),
            wear_mm: PerGear { pinion: zeros.clone(), wheel: zeros.clone() },
            depth_mm: PerGear { pinion: zeros.clone(), wheel: zeros },
            tangents: Vec::new(),
            pressure_mpa: Vec::new(),
            sliding_mm: [Vec::new(), Vec::new()],
            conditions: Vec::new(),
            lambda: Vec::new(),
            places: Vec::new(),
            begun: false,
            outcome: Ok(Work::default()),
            positions: Vec::new(),
        };
        for position in &positions {
            batch.prepare(position, forms, springs, &modification_mm);
        }
        let longest = batch.loaded_positions.iter().map(|loaded| loaded.packs.len()).max().unwrap_or(0);
        batch.tangents = vec![Tangent::default(); longest];
        batch.pressure_mpa = vec![[0.0; LANES]; longest];
        batch.sliding_mm = [batch.pressure_mpa.clone(), batch.pressure_mpa.clone()];
        batch.modification_mm = batch.packs.iter().map(|pack| pack.gap_mm).collect();
        Self { positions, ..batch }
    }

    /// Prepares the contacts of the next position in the packs after those of the last one.
    fn prepare(
        &mut self,
        position: &SlicedPosition,
        forms: &ContactForms<'_>,
        springs: &SlicesInSeries<'_>,
        modification_mm: impl Fn(&SliceContact) -> f64,
    ) {
        let first = self.loaded_positions.last().map_or(0, |loaded| loaded.packs.end);
        let contacts = &position.contacts;
        let mean = springs.line_load_n_per_mm / contacts.len() as f64;
        let coupled = springs.sliced.is_coupled();
        let mut greatest_load_n_per_mm = f64::INFINITY;
        for (at, contact) in contacts.iter().enumerate() {
            let (pack, k) = (first + at / LANES, at % LANES);
            let position_mm = contact.cell.position_mm;
            let form = forms.at(position_mm);
            self.ratios[LANES * first + at] = SpeedRatios::over(springs.pair, position_mm, position_mm);
            let teeth = if coupled { 0.0 } else { springs.sliced.mm2_per_n(contact, &springs.along_path) };
            let (row, roots) = (&mut self.packs[pack], &mut self.per_root[pack]);
            row.rigid.0[k] = form.surface_mm2_per_n + teeth;
            for (series, own) in row.series.iter_mut().zip(form.series) {
                series.0[k] = own;
            }
            row.gap_mm.0[k] = modification_mm(contact);
            row.load.0[k] = mean;
            let half_width = form.square_half_width.sqrt();
            roots.half_width.0[k] = half_width;
            roots.pressure.0[k] = 0.5 / half_width;
            for (sliding, gear) in roots.sliding.iter_mut().zip(Gear::BOTH) {
                sliding.0[k] = 2.0 * half_width * springs.pair.path.specific_sliding(gear, position_mm).abs();
            }
            greatest_load_n_per_mm = greatest_load_n_per_mm.min(form.greatest_load_n_per_mm);
        }
        let teeth = springs
            .sliced
            .coupled_teeth(springs.pair, contacts, |contact| springs.sliced.mm2_per_n(contact, &springs.along_path));
        self.teeth.extend(teeth);
        self.loaded_positions.push(LoadedPosition {
            position_mm: position.position_mm,
            transmission_error_mm: 0.0,
            contacts: contacts.len(),
            greatest_load_n_per_mm,
            packs: first..first + contacts.len().div_ceil(LANES),
        });
    }

    /// Wears the flanks for so many `meshes` by the depth of the last evaluation, and finds the new equilibria and the new depth.
    pub(crate) fn evaluate(
        &mut self,
        meshes: PerGear<f64>,
        springs: &SlicesInSeries<'_>,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) {
        let mut work = Work::default();
        for index in 0..self.loaded_positions.len() {
            if stopped() {
                self.outcome = Err(EquilibriumError::Interrupted);
                return;
            }
            self.wear(index, meshes);
            match self.balance(index, springs) {
                Ok(iterations) => {
                    work.equilibria += 1;
                    work.newton_iterations += iterations;
                    work.pair_evaluations += iterations * self.loaded_positions[index].contacts as u64;
                }
                Err(failure) => {
                    self.outcome = Err(failure);
                    return;
                }
            }
            self.lose(index, wear);
        }
        self.begun = true;
        self.outcome = Ok(work);
    }

    /// Work of the last evaluation.
    pub(crate) fn outcome(&self) -> Result<Work, EquilibriumError> {
        self.outcome.clone()
    }

    /// Wears both flanks at a position, h ← h + meshes · dh, and opens their gap.
    fn wear(&mut self, loaded: usize, meshes: PerGear<f64>) {
        let range = self.loaded_positions[loaded].packs.clone();
        for gear in Gear::BOTH {
            let (wear, depth) = (&mut self.wear_mm[gear][range.clone()], &self.depth_mm[gear][range.clone()]);
            for (pack, (h, dh)) in self.packs[range.clone()].iter_mut().zip(wear.iter_mut().zip(depth)) {
                let lost = Lanes(*dh) * meshes[gear];
                *h = (Lanes(*h) + lost).0;
                pack.gap_mm += lost * self.gap_per_depth;
            }
        }
    }

    /// Finds the equilibrium of a position. Returns the number of Newton steps.
    fn balance(&mut self, index: usize, springs: &SlicesInSeries<'_>) -> Result<u64, EquilibriumError> {
        let loaded = &mut self.loaded_positions[index];
        let packs = &mut self.packs[loaded.packs.clone()];
        let tangents = &mut self.tangents[..packs.len()];
        let mut teeth = self.teeth.get_mut(index);
        let mut iterations = 0;
        if self.begun {
            match loaded.follow(packs, tangents, teeth.as_deref_mut(), &self.common) {
                Attempt::Settled(steps) => return Ok(steps),
                Attempt::Lost(steps) => iterations += steps,
            }
        }
        match loaded.settle(packs, tangents, teeth, &self.common) {
            Attempt::Settled(steps) => return Ok(iterations + steps),
            Attempt::Lost(steps) => iterations += steps,
        }
        let gaps = packs.iter().flat_map(|pack| pack.gap_mm.0);
        let (loads, equilibrium) = springs.balance(&self.positions[index].contacts, gaps, loaded.position_mm)?;
        for (at, load) in loads.into_iter().enumerate() {
            let (pack, k) = (&mut packs[at / LANES], at % LANES);
            pack.load.0[k] = load;
            pack.log_load.0[k] = if load > 0.0 { load.ln() } else { 0.0 };
            (pack.correction.0[k], pack.change.0[k]) = (0.0, 0.0);
        }
        loaded.transmission_error_mm = equilibrium.transmission_error_mm;
        Ok(iterations + equilibrium.iterations)
    }

    /// Finds the depth that both flanks lose in one mesh at the contacts of a position.
    fn lose(&mut self, index: usize, wear: &WearModel<'_>) {
        let range = self.loaded_positions[index].packs.clone();
        let [sliding_1, sliding_2] = &mut self.sliding_mm;
        let rows = self.pressure_mpa.iter_mut().zip(sliding_1.iter_mut().zip(&mut *sliding_2));
        let contacts = self.packs[range.clone()].iter().zip(&self.per_root[range.clone()]);
        for ((pack, per_root), (pressure, (of_pinion, of_wheel))) in contacts.zip(rows) {
            let root = pack.loads().sqrt();
            *pressure = (root * per_root.pressure).0;
            *of_pinion = (root * per_root.sliding[0]).0;
            *of_wheel = (root * per_root.sliding[1]).0;
        }
        let pressure = self.pressure_mpa[..range.len()].as_flattened();
        let packs = &self.packs[range.clone()];
        // Lanes without a contact carry no load; their place does not matter.
        let positions = self.positions[index].contacts.iter().map(|contact| contact.cell.position_mm);
        let positions = positions.chain(std::iter::repeat(self.loaded_positions[index].position_mm));
        let loads = packs.iter().flat_map(|pack| pack.loads().0).zip(pressure);
        self.places.clear();
        if wear.reads_places() {
            self.places.extend(positions.zip(loads).map(|(position_mm, (line_load_n_per_mm, &mean_mpa))| {
                LoadedPlace {
                    position_mm,
                    line_load_n_per_mm,
                    peak_pressure_mpa: PEAK_OVER_MEAN * mean_mpa,
                    half_width_mm: if mean_mpa > 0.0 { 0.5 * line_load_n_per_mm / mean_mpa } else { 0.0 },
                }
            }));
        }
        let places = &self.places;
        for (gear, sliding) in [(Gear::Pinion, &*sliding_1), (Gear::Wheel, &*sliding_2)] {
            let depth = self.depth_mm[gear][range.clone()].as_flattened_mut();
            depth.fill(0.0);
            let sliding_mm = sliding[..range.len()].as_flattened();
            let conditions = wear.heat_of_law(gear).map(|heat| {
                let half_widths = packs.iter().zip(&self.per_root[range.clone()]);
                let half_widths = half_widths.flat_map(|(pack, root)| (pack.loads().sqrt() * root.half_width).0);
                let ratios = &self.ratios[LANES * range.start..LANES * range.end];
                self.conditions.clear();
                self.conditions.extend(places.iter().zip(half_widths.zip(ratios)).map(
                    |(place, (half_width_mm, &ratios))| {
                        let strip = HeatedStrip {
                            ratios,
                            line_load_n_per_mm: place.line_load_n_per_mm,
                            half_width_mm,
                            friction_coefficient: wear.friction(heat, place),
                        };
                        HeatedContact { heat, strip }.at_hottest(gear, Spread::Even)
                    },
                ));
                &*self.conditions
            });
            let lambda = wear.films_of_law(gear).map(|films| {
                self.lambda.clear();
                self.lambda.extend(places.iter().map(|place| films.lambda(place)));
                Lambda::OfEach(&self.lambda)
            });
            let row = SlidingRow { pressure_mpa: pressure, sliding_mm, conditions, lambda, is_continuous: false };
            wear.laws[gear].add_depth(&row, depth);
        }
    }

    /// Each contact of a position with its lane and its state.
    pub(crate) fn contacts(&self, index: usize) -> impl Iterator<Item = (&SliceContact, usize, LaneContact)> {
        let first = LANES * self.loaded_positions[index].packs.start;
        self.positions[index].contacts.iter().enumerate().map(move |(at, contact)| {
            let lane = first + at;
            (contact, lane, self.contact(lane))
        })
    }

    /// Number of lanes, those without a contact included.
    pub(crate) fn lanes(&self) -> usize {
        LANES * self.packs.len()
    }

    /// Depth that `gear`'s flank has lost in each lane, and loses in one mesh, mm.
    pub(crate) fn rows(&self, gear: Gear) -> impl Iterator<Item = [f64; 2]> {
        let [wear, depth] = [&self.wear_mm, &self.depth_mm].map(|rows| rows[gear].as_flattened());
        wear.iter().zip(depth).map(|(&wear, &depth)| [wear, depth])
    }

    /// Sets the wear of both flanks in each lane.
    pub(crate) fn set_wear_mm(&mut self, wear_mm: PerGear<&[f64]>) {
        for gear in Gear::BOTH {
            self.wear_mm[gear].as_flattened_mut().copy_from_slice(wear_mm[gear]);
        }
        for (index, pack) in self.packs.iter_mut().enumerate() {
            pack.gap_mm = self.modification_mm[index];
            for gear in Gear::BOTH {
                pack.gap_mm += Lanes(self.wear_mm[gear][index]) * self.gap_per_depth;
            }
        }
    }

    /// Returns to the state before any evaluation, on the present flanks.
    pub(crate) fn reset(&mut self) {
        for loaded in &mut self.loaded_positions {
            let mean = self.common.line_load_n_per_mm / loaded.contacts as f64;
            loaded.transmission_error_mm = 0.0;
            for (at, pack) in self.packs[loaded.packs.clone()].iter_mut().enumerate() {
                let loads = std::array::from_fn(|lane| if at * LANES + lane < loaded.contacts { mean } else { 0.0 });
                pack.load = Lanes(loads);
                (pack.log_load, pack.correction, pack.change) = Default::default();
            }
        }
        self.teeth.iter_mut().for_each(CoupledTeeth::straighten);
        self.begun = false;
    }

    /// Depth that `gear`'s flank has lost at the contact in a lane, and loses in one mesh, mm.
    pub(crate) fn of_lane(&self, gear: Gear, lane: usize) -> [f64; 2] {
        [&self.wear_mm, &self.depth_mm].map(|rows| rows[gear].as_flattened()[lane])
    }

    /// State of the contact in a lane.
    pub(crate) fn contact(&self, lane: usize) -> LaneContact {
        let (pack, per_root, k) = (&self.packs[lane / LANES], &self.per_root[lane / LANES], lane % LANES);
        let load = pack.loads().0[k];
        let root = load.sqrt();
        let [pinion, wheel] = per_root.sliding.map(|sliding| root * sliding.0[k]);
        LaneContact {
            line_load_n_per_mm: load,
            half_width_mm: root * per_root.half_width.0[k],
            pressure_mpa: root * per_root.pressure.0[k],
            sliding_mm: PerGear { pinion, wheel },
        }
    }
}
