//! The wear run: from the unworn pair through all phases of its operation.
//!
//! One evaluation of the mesh cycle on the flanks as they are gives the depth each point loses per mesh; [`super::advance`] takes
//! the flanks from there to their next evaluation. Snapshots and ends of phases are hit exactly. A phase begins with the
//! flanks that the one before has worn. Where a limit ends the service life of the pair ([`super::life`]), the run ends there.
//!
//! Source: the thesis, equation 12 (single-point observation, section 3.3).

use super::advance::{self, StepInterval, Stepper};
use super::checkpoint::{Checkpoint, Keeper, NothingKept};
use super::life::{LimitReached, LimitsOfPair, StepBeginning};
use super::mesh_contact::{LoadedMesh, MeshContact};
use super::settings::{LifeLimits, Numerics, Stepping, first_greatest};
use crate::contact::Flanks;
use crate::mesh_cycle::over_life::PeakToPeakOverLife;
use crate::mesh_cycle::wearing_pair::{Snapshot, WearingPair};
use crate::mesh_cycle::{Work, load_sharing::EquilibriumError};
use crate::observer::Observer;
use crate::results::run::StopReason;
use crate::stiffness::StiffnessError;
use crate::wear::{WearModel, stepping::adaptive::StepCounts};
use gearwear_bodies::gear::{
    Gear, GearPair, PerGear, flank::FlankGrid, flank_zones::FlankZones, removed_material::modifications_mm,
    slices::Slices,
};

/// Wear depth in modules up to which wear with the stiffness of unworn teeth is within 6 % of that by finite elements, and that stiffness
/// within 3 % of the worn tooth's, as measured (`docs/materials.md`).
pub const SMALL_WEAR_MODULES: f64 = 0.2;

/// Failure of a wear run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimulationError {
    /// Stiffness model and contact surface do not go together.
    #[error(transparent)]
    Stiffness(#[from] StiffnessError),
    /// The tooth pairs found no equilibrium.
    #[error("after {revolutions:.4e} pinion revolutions: {source}")]
    Equilibrium {
        /// Pinion revolutions reached.
        revolutions: f64,
        /// Failure of the equilibrium.
        source: EquilibriumError,
    },
    /// More is worn off than there is.
    #[error(
        "worn through after {revolutions:.4e} pinion revolutions: with one more mesh a flank of the {} has lost {depth_mm:.3e} mm, and its \
         tooth is {thickness_mm:.3} mm thick there; look at the wear coefficient and the duration",
        gear.name()
    )]
    WornThrough {
        /// Pinion revolutions reached.
        revolutions: f64,
        /// Gear of the flank.
        gear: Gear,
        /// Wear depth where least of the tooth is left, mm.
        depth_mm: f64,
        /// Transverse thickness of its unworn teeth there, at least half a module.
        thickness_mm: f64,
    },
    /// Checkpoint with other flank points or phases than the run has.
    #[error("the checkpoint is not of this run")]
    OtherRun,
}

/// Phase of the run under constant load and speed.
#[derive(Clone, Copy)]
pub struct RunPhase<'a> {
    /// Elastic model of the mesh.
    pub contact: MeshContact<'a>,
    /// Wear laws and their conditions.
    pub wear: WearModel<'a>,
    /// Total line load, N per mm of face width.
    pub line_load_n_per_mm: f64,
    /// End of the phase, in pinion revolutions from the beginning of the run.
    pub end_revolutions: f64,
}

/// Wear run of a gear pair.
#[derive(Clone, Copy)]
pub struct WearRun<'a> {
    /// Gear pair.
    pub pair: &'a GearPair,
    /// Zones of each flank, by which its wear is summarised.
    pub zones: PerGear<FlankZones>,
    /// Load spectrum: one phase at least.
    pub phases: &'a [RunPhase<'a>],
    /// Pinion revolutions at which the state is kept; that at the end of the run is always kept.
    pub snapshots_revolutions: &'a [f64],
    /// Meshes of a tooth of each gear in one revolution of the pinion.
    pub meshes_per_pinion_turn: PerGear<f64>,
    /// Limits that end the run early.
    pub limits: LifeLimits,
    /// Resolution.
    pub numerics: Numerics,
}

/// Outcome of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Reason why the run ended.
    pub stop: StopReason,
    /// Limit that ended the run.
    pub limit_reached: Option<LimitReached>,
    /// Failure of a run that did not converge.
    pub failure: Option<SimulationError>,
    /// Points of each flank, the same in every slice.
    pub grid: PerGear<FlankGrid>,
    /// Zones of each flank, by which its wear is summarised.
    pub zones: PerGear<FlankZones>,
    /// Slices over the face width: one where all sections are alike.
    pub slices: Slices,
    /// Material removed by the modifications, mm, slice after slice as all fields of a flank.
    pub modification_mm: PerGear<Vec<f64>>,
    /// Unworn pair under the greatest load of any phase.
    pub new: Snapshot,
    /// Pair at each snapshot reached, in order; where the run was interrupted, also at that moment.
    pub snapshots: Vec<Snapshot>,
    /// Pair at the end of the run, as in the last snapshot, but under the load of `new`.
    pub worn: Snapshot,
    /// Wear of that pair at each place at which the model keeps it, mm; `None` where nothing is worn yet.
    pub worn_places_mm: Option<PerGear<Vec<f64>>>,
    /// Index of the phase of that load. Where the worn pair finds no equilibrium under it, `worn` is under the load of its own phase.
    pub reference_phase: usize,
    /// Counts of the wear steps.
    pub steps: StepCounts,
    /// Estimated error of adaptive steps in each gear's wear where that is greatest, mm.
    pub step_error_mm: Option<PerGear<f64>>,
    /// Total work.
    pub work: Work,
}

impl Outcome {
    /// The unworn pair, then the pair at each snapshot.
    pub fn states(&self) -> impl Iterator<Item = &Snapshot> {
        [&self.new].into_iter().chain(&self.snapshots)
    }

    /// Greatest pressure in any of [`Self::states`], at sharp tip edges too, MPa.
    pub fn greatest_pressure_mpa(&self) -> f64 {
        self.states().map(|state| state.cycle.peak_pressure_mpa()).fold(0.0, f64::max)
    }

    /// The outcome as it would be had the run ended at its snapshot after `revolutions`; `None` where it has none. Counts of the work stay those of
    /// the whole run.
    pub fn ended_at(&self, revolutions: f64) -> Option<Self> {
        let last = self.snapshots.iter().position(|snapshot| snapshot.revolutions.total_cmp(&revolutions).is_eq())?;
        let snapshots = self.snapshots[..=last].to_vec();
        let worn = snapshots[last].clone();
        // The places at which wear is kept are those of the end.
        Some(Self { worn, worn_places_mm: None, snapshots, ..self.clone() })
    }
}

/// Both flanks before the first mesh.
pub(super) struct UnwornFlanks {
    pub grid: PerGear<FlankGrid>,
    pub slices: Slices,
    pub modification_mm: PerGear<Vec<f64>>,
    /// Thickness of the tooth at every point of the grid, mm.
    thickness_mm: PerGear<Vec<f64>>,
}

/// State of an unfinished run.
struct RunState {
    /// Index of the current phase.
    phase: usize,
    revolutions: f64,
    stepper: Stepper,
    work: Work,
    over_life: PeakToPeakOverLife,
    /// Unworn pair, then each snapshot.
    states: Vec<Snapshot>,
    /// Wear depth at the beginning of the phase; none of new flanks.
    wear_mm: Option<PerGear<Vec<f64>>>,
    /// Wear depth at the last of the states; none before the first and after a checkpoint.
    wear_of_last_state_mm: Option<PerGear<Vec<f64>>>,
    /// Revolutions and wear depth where the run last arrived with no tooth worn through.
    arrived: Option<(f64, PerGear<Vec<f64>>)>,
    /// Number of snapshots due so far.
    passed: usize,
    /// Limit reached.
    limit_reached: Option<LimitReached>,
    /// Whether the run goes on from a checkpoint, whose state is evaluated once more without counting its work and snapshot again.
    is_repeated: bool,
}

/// End of a phase.
enum PhaseEnd {
    /// Last revolution of the phase reached.
    Reached,
    /// The whole run ended or was interrupted.
    Stopped,
    /// A failure, after something was finished.
    Failed(SimulationError),
}

/// Keeper of checkpoints and observer of a run.
#[derive(Clone, Copy)]
struct Attendants<'a> {
    keeper: &'a dyn Keeper,
    progress: &'a dyn Observer,
}

impl WearRun<'_> {
    /// Runs the whole duration, or until a limit or an interrupt.
    pub fn run(&self, progress: &dyn Observer) -> Result<Outcome, SimulationError> {
        self.run_from(None, &NothingKept, progress)
    }

    /// Runs from the beginning or from a checkpoint of this same run on, to the same bits; `keeper` receives new checkpoints.
    pub fn run_from(
        &self,
        checkpoint: Option<Checkpoint>,
        keeper: &dyn Keeper,
        progress: &dyn Observer,
    ) -> Result<Outcome, SimulationError> {
        let slices = self.phases.first().map_or_else(|| Slices::new(self.pair, 1), |one| one.contact.slices(self.pair));
        let flanks = self.unworn_flanks(slices);
        let mut run_state = match checkpoint {
            None => self.beginning(),
            Some(checkpoint) if checkpoint.fits(flanks.modification_mm.as_ref().map(Vec::len)) => {
                self.resumed(checkpoint)?
            }
            Some(_) => return Err(SimulationError::OtherRun),
        };
        let (mut failure, mut step_error_mm) = (None, None);
        while run_state.phase < self.phases.len() {
            let phase = &self.phases[run_state.phase];
            let mut pair = self.wearing_pair(phase, &flanks)?;
            let end = self.through_phase(&mut run_state, &mut *pair, &flanks, Attendants { keeper, progress })?;
            step_error_mm = run_state.stepper.error_mm(&*pair);
            match end {
                PhaseEnd::Reached => run_state.wear_mm = Some(pair.wear_mm()),
                PhaseEnd::Stopped => break,
                PhaseEnd::Failed(error) => {
                    failure = Some(error);
                    break;
                }
            }
            run_state.phase += 1;
        }
        let stop = match &failure {
            Some(SimulationError::WornThrough { .. }) => StopReason::WornThrough,
            Some(_) => StopReason::NotConverged,
            None if run_state.limit_reached.is_some() => StopReason::LimitReached,
            None if self.due(run_state.passed).is_none() => StopReason::Completed,
            None => StopReason::Interrupted,
        };
        let steps = run_state.stepper.counts();
        let worn_places_mm = run_state.wear_of_last_state_mm.take().filter(|_| run_state.states.len() > 1);
        let [new, worn] = self.new_and_worn(&mut run_state, worn_places_mm.as_ref(), &flanks)?;
        run_state.states.remove(0);
        let UnwornFlanks { grid, slices, modification_mm, .. } = flanks;
        Ok(Outcome {
            stop,
            limit_reached: run_state.limit_reached.filter(|_| stop == StopReason::LimitReached),
            failure,
            grid,
            zones: self.zones,
            slices,
            modification_mm,
            new,
            snapshots: run_state.states,
            worn,
            worn_places_mm,
            reference_phase: reference_phase(self.phases),
            steps,
            step_error_mm,
            work: run_state.work,
        })
    }

    /// First and last of the states under the load of the reference phase, where that finds an equilibrium.
    fn new_and_worn(
        &self,
        run_state: &mut RunState,
        last_wear_mm: Option<&PerGear<Vec<f64>>>,
        flanks: &UnwornFlanks,
    ) -> Result<[Snapshot; 2], SimulationError> {
        let reference = reference_phase(self.phases);
        let last_phase = run_state.phase.min(self.phases.len() - 1);
        let RunState { states, work, .. } = run_state;
        let (first, last) = (&states[0], &states[states.len() - 1]);
        let new = match reference {
            0 => first.clone(),
            _ => self.under_reference(flanks, first, None, work)?,
        };
        let worn = match last_wear_mm {
            _ if states.len() == 1 => new.clone(),
            Some(wear_mm) if last_phase != reference => self.under_reference(flanks, last, Some(wear_mm), work)?,
            _ => last.clone(),
        };
        Ok([new, worn])
    }

    /// The state `own`, with `wear_mm`, under the load of the reference phase; `own` itself where there is no equilibrium under it.
    fn under_reference(
        &self,
        flanks: &UnwornFlanks,
        own: &Snapshot,
        wear_mm: Option<&PerGear<Vec<f64>>>,
        work: &mut Work,
    ) -> Result<Snapshot, SimulationError> {
        let phase = &self.phases[reference_phase(self.phases)];
        let mut pair = self.wearing_pair(phase, flanks)?;
        if let Some(wear_mm) = wear_mm.filter(|wear_mm| fits(&*pair, wear_mm)) {
            pair.set_wear_mm(wear_mm);
        }
        let evaluated = pair.evaluate(&phase.wear, &|| false);
        let state = evaluated.and_then(|done| {
            *work += done;
            pair.snapshot(own.revolutions).map(|state| Snapshot { over_life: own.over_life, ..state })
        });
        Ok(state.unwrap_or_else(|_| own.clone()))
    }

    /// Unworn flanks in these slices.
    pub(super) fn unworn_flanks(&self, slices: Slices) -> UnwornFlanks {
        let grid = PerGear::from_fn(|gear| {
            FlankGrid::new(self.pair, gear, self.numerics.flank_points, self.numerics.point_spacing)
        });
        let modification_mm = PerGear::from_fn(|gear| modifications_mm(self.pair, gear, &grid[gear], &slices));
        let thickness_mm = PerGear::from_fn(|gear| thickness_mm(self.pair, gear, &grid[gear]));
        UnwornFlanks { grid, slices, modification_mm, thickness_mm }
    }

    /// Pair under the load of `phase`.
    pub(super) fn wearing_pair<'b>(
        &'b self,
        phase: &RunPhase<'b>,
        flanks: &'b UnwornFlanks,
    ) -> Result<Box<dyn WearingPair + 'b>, SimulationError> {
        // Positions on the finite elements of other phases make room.
        let others = self.phases.iter().map(|phase| phase.contact);
        others.filter(|other| !other.is_on_elements_of(&phase.contact)).for_each(|other| other.drop_idle_positions());
        let mesh = LoadedMesh {
            pair: self.pair,
            contact: phase.contact,
            line_load_n_per_mm: phase.line_load_n_per_mm,
            numerics: self.numerics,
            zones: self.zones,
        };
        Ok(mesh.wearing_pair(Flanks::of_gears(self.pair, flanks.grid.as_ref()), &flanks.modification_mm)?)
    }

    /// State before the first step.
    fn beginning(&self) -> RunState {
        RunState {
            phase: 0,
            revolutions: 0.0,
            stepper: Stepper::new(self.numerics.stepping, self.end_revolutions(), self.meshes_per_pinion_turn),
            work: Work::default(),
            over_life: PeakToPeakOverLife::default(),
            states: Vec::new(),
            wear_mm: None,
            wear_of_last_state_mm: None,
            arrived: None,
            passed: 0,
            limit_reached: None,
            is_repeated: false,
        }
    }

    /// State at a checkpoint.
    fn resumed(&self, from: Checkpoint) -> Result<RunState, SimulationError> {
        let mut run_state = RunState {
            phase: from.phase,
            revolutions: from.revolutions,
            work: from.work,
            over_life: from.over_life,
            states: from.states,
            is_repeated: true,
            ..self.beginning()
        };
        let is_within = from.phase < self.phases.len() && (0.0..self.end_revolutions()).contains(&from.revolutions);
        if !is_within || !run_state.stepper.resume(from.stepper, &from.wear_mm) {
            return Err(SimulationError::OtherRun);
        }
        run_state.wear_mm = Some(from.wear_mm);
        self.pass_due(&mut run_state);
        Ok(run_state)
    }

    fn end_revolutions(&self) -> f64 {
        self.phases.last().map_or(0.0, |phase| phase.end_revolutions)
    }

    /// Pinion revolutions of the snapshot number `passed`, from 0; the last is the end of the run.
    fn due(&self, passed: usize) -> Option<f64> {
        let end = self.end_revolutions();
        self.snapshots_revolutions.iter().copied().chain([end]).nth(passed)
    }

    /// Counts the snapshots that are reached.
    fn pass_due(&self, run_state: &mut RunState) {
        while self.due(run_state.passed).is_some_and(|next| next <= run_state.revolutions) {
            run_state.passed += 1;
        }
    }

    /// Failure of `pair`, which is evaluated, where a tooth is worn through, or will be with one more mesh.
    fn worn_through(
        pair: &dyn WearingPair,
        thickness_mm: &PerGear<Vec<f64>>,
        revolutions: f64,
    ) -> Option<SimulationError> {
        let wear_mm = pair.wear_mm();
        let mut next_mm = wear_mm.clone();
        pair.depth_mm(&mut next_mm);
        Gear::BOTH.into_iter().find_map(|gear| {
            let depths_mm = wear_mm[gear].iter().zip(&next_mm[gear]).map(|(worn, next)| worn + next);
            let points = depths_mm.zip(thickness_mm[gear].iter().cycle());
            let (depth_mm, &thickness_mm) = points.max_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)))?;
            (depth_mm >= thickness_mm).then_some(SimulationError::WornThrough {
                revolutions,
                gear,
                depth_mm,
                thickness_mm,
            })
        })
    }

    /// Runs to the end of the phase that `run_state` is in.
    ///
    /// # Errors
    /// [`SimulationError`] before anything is finished.
    fn through_phase(
        &self,
        run_state: &mut RunState,
        pair: &mut dyn WearingPair,
        flanks: &UnwornFlanks,
        Attendants { keeper, progress }: Attendants<'_>,
    ) -> Result<PhaseEnd, SimulationError> {
        let phase = &self.phases[run_state.phase];
        let stopped: &(dyn Fn() -> bool + Sync) = &|| progress.gives_up();
        if let Some(wear_mm) = &run_state.wear_mm {
            if !fits(pair, wear_mm) {
                return Err(SimulationError::OtherRun);
            }
            pair.set_wear_mm(wear_mm);
        }
        let mut evaluated = pair.evaluate(&phase.wear, stopped);
        if std::mem::take(&mut run_state.is_repeated) {
            evaluated = evaluated.map(|_| Work::default());
        } else {
            run_state.stepper.begin_phase();
        }
        // The pair of a phase is made anew, which is a clean start.
        let (mut is_clean, mut cleaned_at) = (true, 0);
        let clean_after = phase.contact.evaluations_between_clean_starts(self.numerics.positions);
        loop {
            if let Some(end) = self.arrive(run_state, pair, flanks, evaluated, progress)? {
                return Ok(end);
            }
            if is_clean {
                cleaned_at = run_state.work.mesh_cycles;
                if run_state.revolutions > 0.0 && keeper.is_due() {
                    keeper.keep(&run_state.checkpoint(pair.wear_mm()));
                }
            }
            is_clean = run_state.work.mesh_cycles - cleaned_at >= clean_after;
            let limit =
                self.due(run_state.passed).map_or(phase.end_revolutions, |next| next.min(phase.end_revolutions));
            let interval = StepInterval { from: run_state.revolutions, limit, clean_start: is_clean };
            evaluated = self.step(run_state, pair, flanks, interval, stopped);
        }
    }

    /// Counts the work of the evaluated state and keeps the state where that is due; the end of the phase where it is reached.
    ///
    /// # Errors
    /// No equilibrium of the unworn pair.
    fn arrive(
        &self,
        run_state: &mut RunState,
        pair: &mut dyn WearingPair,
        flanks: &UnwornFlanks,
        evaluated: Result<Work, EquilibriumError>,
        progress: &dyn Observer,
    ) -> Result<Option<PhaseEnd>, SimulationError> {
        let revolutions = run_state.revolutions;
        let is_due = self.due(run_state.passed).is_some_and(|next| revolutions >= next);
        let ends = progress.interrupted() || run_state.limit_reached.is_some();
        let worn_through =
            evaluated.is_ok().then(|| Self::worn_through(pair, &flanks.thickness_mm, revolutions)).flatten();
        let keep = run_state.states.is_empty() || (worn_through.is_none() && (is_due || ends));
        let state = evaluated.and_then(|done| {
            run_state.work += done;
            if worn_through.is_none() {
                run_state.over_life.note(revolutions, pair.peak_to_peak_mm());
            }
            keep.then(|| pair.snapshot(revolutions)).transpose()
        });
        match state {
            Ok(Some(state)) => {
                run_state.states.push(Snapshot { over_life: run_state.over_life, ..state });
                run_state.wear_of_last_state_mm = Some(pair.wear_mm());
            }
            Ok(None) => {}
            // Before anything is finished there is nothing to keep.
            Err(source) if run_state.states.is_empty() => {
                return Err(SimulationError::Equilibrium { revolutions, source });
            }
            Err(EquilibriumError::Interrupted) => return Ok(Some(PhaseEnd::Stopped)),
            Err(source) => return Ok(Some(PhaseEnd::Failed(SimulationError::Equilibrium { revolutions, source }))),
        }
        if let Some(worn_through) = worn_through {
            self.keep_arrived(run_state, pair, progress);
            return Ok(Some(PhaseEnd::Failed(worn_through)));
        }
        run_state.arrived = Some((revolutions, pair.wear_mm()));
        self.pass_due(run_state);
        progress.progress(revolutions, self.end_revolutions());
        if ends || self.due(run_state.passed).is_none() {
            return Ok(Some(PhaseEnd::Stopped));
        }
        let is_reached = revolutions >= self.phases[run_state.phase].end_revolutions;
        Ok(is_reached.then_some(PhaseEnd::Reached))
    }

    /// Keeps the state where the run last arrived with no tooth worn through, if it is after all states and has an equilibrium.
    fn keep_arrived(&self, run_state: &mut RunState, pair: &mut dyn WearingPair, progress: &dyn Observer) {
        let Some((revolutions, wear_mm)) = run_state.arrived.take() else { return };
        if run_state.states.last().is_some_and(|state| state.revolutions >= revolutions) {
            return;
        }
        pair.set_wear_mm(&wear_mm);
        let evaluated = pair.evaluate(&self.phases[run_state.phase].wear, &|| progress.gives_up());
        let state = evaluated.and_then(|done| {
            run_state.work += done;
            pair.snapshot(revolutions)
        });
        if let Ok(state) = state {
            run_state.states.push(Snapshot { over_life: run_state.over_life, ..state });
            run_state.wear_of_last_state_mm = Some(wear_mm);
        }
    }

    /// Takes one wear step within `interval`, up to the first limit that it passes, and evaluates the pair there.
    fn step(
        &self,
        run_state: &mut RunState,
        pair: &mut dyn WearingPair,
        flanks: &UnwornFlanks,
        interval: StepInterval,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        let wear = &self.phases[run_state.phase].wear;
        let beginning = self.limits.are_set().then(|| StepBeginning::of(pair, interval.from));
        let advanced = run_state.stepper.advance(pair, wear, interval, stopped);
        let evaluated = advanced.evaluated;
        run_state.revolutions = advanced.revolutions;
        // A step that was taken may have passed a limit, even if there is no equilibrium at its end.
        let is_taken = run_state.revolutions > interval.from && evaluated != Err(EquilibriumError::Interrupted);
        let Some(beginning) = beginning.filter(|_| is_taken) else { return evaluated };
        let smooth = matches!(self.numerics.stepping, Stepping::Adaptive { .. });
        let limits = LimitsOfPair {
            limits: self.limits,
            pair: self.pair,
            meshes: self.meshes_per_pinion_turn,
            grid: &flanks.grid,
            zones: &self.zones,
        };
        let Some(within) = beginning.limit_within(&limits, pair, run_state.revolutions, smooth) else {
            return evaluated;
        };
        run_state.work += evaluated.unwrap_or_default();
        run_state.revolutions = within.revolutions;
        let evaluated = advance::evaluate(pair, wear, stopped);
        run_state.limit_reached = evaluated.is_ok().then_some(within.reached);
        evaluated
    }
}

/// Whether `wear_mm` has a value for every place of `pair`.
pub(super) fn fits(pair: &dyn WearingPair, wear_mm: &PerGear<Vec<f64>>) -> bool {
    wear_mm.as_ref().map(Vec::len) == pair.wear_mm().map(|row| row.len())
}

/// Transverse thickness of a tooth at every point of its flank; near a pointed tip half a module.
fn thickness_mm(pair: &GearPair, gear: Gear, grid: &FlankGrid) -> Vec<f64> {
    let tooth = &pair.teeth[gear];
    let least_mm = 0.5 * pair.spec.normal_module_mm;
    let rho_mm = grid.coordinate_mm.iter();
    rho_mm.map(|&rho| tooth.thickness_mm(tooth.involute.radius_mm(rho)).max(least_mm)).collect()
}

/// Index of the phase of the greatest load, the first of equals: figures of the new and of the worn pair are under that load.
pub fn reference_phase(phases: &[RunPhase<'_>]) -> usize {
    first_greatest(phases.iter().map(|phase| phase.line_load_n_per_mm))
}

impl RunState {
    /// Checkpoint of the run with the wear `wear_mm`.
    fn checkpoint(&self, wear_mm: PerGear<Vec<f64>>) -> Checkpoint {
        Checkpoint {
            phase: self.phase,
            revolutions: self.revolutions,
            wear_mm,
            stepper: self.stepper.state(),
            work: self.work,
            over_life: self.over_life,
            states: self.states.clone(),
        }
    }
}
