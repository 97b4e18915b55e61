//! A study of improvement, in order: fast model, search, verification, proposals, tolerances.

use std::cell::RefCell;
use std::path::Path;
use std::time::Instant;

use gearwear::evaluate::output::SummaryOutput;
use gearwear::journal::{Journal, RowKeeper};
use gearwear::runs;
use gearwear::scene::draft::Draft;
use gearwear::scene::loaded::LoadedScene;
use gearwear::spread::{SpreadOutcome, seconds_of_a_run, spread};
use gearwear::varied_scene::one_line;
use gearwear_bodies::gear::GearPair;
use gearwear_physics::assessment::Done;
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::observer::Observer;
use gearwear_physics::plan::cost::RunCost;
use gearwear_physics::results::error::TotalError;
use gearwear_physics::results::run::StopReason;

use super::asked::{ImproveError, ImproveQuestion, of_entry};
use super::fast_model::{FastModel, Figures, figures_of};
use super::free_key::FreeKey;
use super::kept::{DesignRole, ImproveIdentity, KeptDesign};
use super::proposal::{Proposal, Sensitivity, compared, file_of, goals_of, reasons, values_of, worsening};
use super::reach::Tried;
use super::record::{GoalRecord, ImproveRecord};
use super::search::{Outcome, SearchProblem, SearchRecord, SearchSettings, SearchStop, front, search};
use super::tip_reliefs;

/// Designs of the front that are verified: of spur pairs, and of pairs in slices, which take longer.
const VERIFIED: usize = 8;
const VERIFIED_IN_SLICES: usize = 4;
/// Resolution at which pairs in slices are verified, at most: positions, points of a flank, and the error of the wear steps, µm, at least.
const SLICED_POSITIONS: usize = 150;
const SLICED_POINTS: usize = 300;
const SLICED_TOLERANCE_UM: f64 = 0.1;

/// Looks for better designs of `scene` on `threads` threads, as its table `[improve]` asks. Finished designs are kept in a journal in `folder`, with which
/// the same study goes on; without a folder in memory.
///
/// ```
/// use gearwear::{LoadedScene, Unwatched};
///
/// let scene = LoadedScene::preset("thesis-spur")?.with("contact.surface", "hertz-mean")?.with("numerics.positions", 40)?.with("numerics.verify", false)?;
/// let scene = scene.with_all([
///     ("improve.free".to_owned(), Some(vec!["pair.face_width_mm = 10:20"].into())),
///     ("improve.goals".to_owned(), Some(vec!["pinion.peak_wear_um"].into())),
///     ("improve.evaluations".to_owned(), Some(24.into())),
/// ])?;
/// let record = gearwear_studies::improve::study::improve(&scene, None, 2, &Unwatched)?;
/// assert_eq!(record.proposals[0].values[0].value, "20");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// What is wrong with the question; runs that all failed; a folder with the designs of another study, or that cannot be written.
pub fn improve(
    scene: &LoadedScene,
    folder: Option<&Path>,
    threads: usize,
    observer: &dyn Observer,
) -> Result<ImproveRecord, ImproveError> {
    let prepared = PreparedImprove::new(scene, observer)?;
    let identity = prepared.identity()?;
    let mut journal = match folder {
        None => Journal::in_memory(identity),
        Some(folder) => {
            let journal = Journal::open(folder, identity)?;
            super::report::begin(folder)?;
            journal
        }
    };
    prepared.run(&mut journal, threads, observer)
}

/// Scene with its question, its fast model, and what the scene as given comes to on it.
pub struct PreparedImprove<'a> {
    scene: &'a LoadedScene,
    question: ImproveQuestion,
    is_free_by_default: bool,
    fast: FastModel,
    /// Figures of the scene as given on the fast model.
    as_given: Vec<Option<f64>>,
    begun: Instant,
}

/// A design that is asked for.
struct AskedDesign {
    number: usize,
    role: DesignRole,
    values: Option<Vec<f64>>,
}

/// Designs of a study under way, each run once and kept.
struct Designs<'s, 'j> {
    prepared: &'s PreparedImprove<'s>,
    journal: &'j mut Journal<ImproveIdentity>,
    threads: usize,
    observer: &'s dyn Observer,
    done: Vec<KeptDesign>,
}

impl<'a> PreparedImprove<'a> {
    /// Prepares the study of `scene`: reads its question, makes the fast model and runs the scene as given on it.
    ///
    /// # Errors
    /// What is wrong with the question, a scene that cannot be run, an interrupt.
    pub fn new(scene: &'a LoadedScene, observer: &dyn Observer) -> Result<Self, ImproveError> {
        let begun = Instant::now();
        let mut question = ImproveQuestion::of(scene)?;
        let torque_curve = question.figures.iter().any(SummaryOutput::is_of_torque_curve);
        let fast = FastModel::of(scene, &question.free, torque_curve, observer)?;
        observer.stage("the scene as given, on the fast model");
        let is_free_by_default = question.free.is_empty();
        if is_free_by_default {
            question.free = tip_reliefs::of(&fast, observer)?;
        }
        let as_given = fast.figures([], &question.figures, observer).ok_or(ImproveError::Interrupted)?;
        let as_given = as_given.map_err(ImproveError::Base)?;
        if let Some(missing) =
            question.goals.iter().position(|goal| goal.value(|path| question.figure(&as_given, path)).is_none())
        {
            let said = format!(
                "found {}, which a run of this scene does not have; allowed: a figure that it has",
                question.goals[missing]
            );
            let problem = of_entry(&scene.given.text, &format!("improve.goals[{missing}]"), &said, None);
            return Err(scene.given.refused(vec![problem]).into());
        }
        let prepared = Self { scene, question, is_free_by_default, fast, as_given, begun };
        prepared.check_space()?;
        Ok(prepared)
    }

    /// Checks that some designs are scenes.
    fn check_space(&self) -> Result<(), ImproveError> {
        let free = &self.question.free;
        let at = |share: f64| free.iter().map(|one| one.value(share)).collect::<Vec<f64>>();
        let fault = |share: f64| self.fast.fault(self.in_scene(&at(share)));
        let faults: Option<Vec<String>> = [0.5, 0.25, 0.75, 0.0, 1.0].map(fault).into_iter().collect();
        let Some(first) = faults.and_then(|faults| faults.into_iter().next()) else { return Ok(()) };
        let said = format!(
            "found keys that make no scene in the middle of their ranges ({first}); allowed: keys whose values make one, the keys beside them given"
        );
        Err(self.scene.given.refused(vec![of_entry(&self.scene.given.text, "improve.free", &said, None)]).into())
    }

    /// Number of free keys.
    pub fn free(&self) -> &[FreeKey] {
        &self.question.free
    }

    /// Greatest number of designs of the search.
    pub fn evaluations(&self) -> usize {
        self.question.evaluations()
    }

    /// Time that the study takes on `threads` threads, s, at most: of the search and the tolerances by more runs of the scene as given on
    /// the fast model, one on each thread (the first of all also made what designs share), of the verification by the announced cost of a run; `None` where
    /// the verified scene is none.
    pub fn seconds_at_most(&self, threads: usize, observer: &dyn Observer) -> Option<f64> {
        let with_tolerance = self.question.free.iter().filter(|one| one.tolerance.is_some()).count();
        let on_fast_model = self.evaluations() + 2 * with_tolerance * self.most_verified();
        let scene = self.verified_scene_of(None).ok()?;
        let pair = GearPair::new(&scene.scene().pair).ok()?;
        let of_run = RunCost::of(scene.scene(), &scene.plan(), &pair).seconds;
        let of_fast = seconds_of_a_run(threads, observer, |within| {
            self.fast.figures([], &self.question.figures, within)?.ok().map(|_| ())
        })?;
        Some(on_fast_model as f64 * of_fast + (self.most_verified() + 1) as f64 * of_run / threads as f64)
    }

    /// Greatest number of designs that are verified.
    fn most_verified(&self) -> usize {
        if self.scene.scene().slices.is_some() { VERIFIED_IN_SLICES } else { VERIFIED }
    }

    /// Study that a journal keeps the designs of.
    ///
    /// # Errors
    /// A scene whose text cannot be read again.
    pub fn identity(&self) -> Result<ImproveIdentity, ImproveError> {
        let given = &self.scene.given;
        let draft = Draft::parse(&given.text).map_err(|problems| given.refused(problems))?;
        Ok(ImproveIdentity {
            program_version: env!("CARGO_PKG_VERSION").to_owned(),
            given_hash: draft.hash(),
            scene_hash: self.scene.resolved.scene_hash(),
            inputs_hash: self.scene.files.hash(),
            free: self.question.free.iter().map(FreeKey::as_given).collect(),
            goals: self.question.goals.iter().map(ToString::to_string).collect(),
            limits: self.question.limits.iter().map(ToString::to_string).collect(),
            evaluations: self.evaluations(),
            seed: self.question.seed,
            figures: self.question.figures.iter().map(|figure| figure.path.clone()).collect(),
        })
    }

    /// Values of a design as the scene takes them.
    fn in_scene<'v>(&'v self, values: &'v [f64]) -> impl Iterator<Item = (&'v str, toml::Value)> {
        self.question.free.iter().zip(values).map(|(one, value)| (one.key.as_str(), one.in_scene(*value)))
    }

    /// The scene of a design, with its own surface and resolution.
    fn scene_of(&self, values: Option<&[f64]>, title: Option<String>) -> Result<LoadedScene, String> {
        let mut changes = vec![("improve".to_owned(), None)];
        changes.extend(title.map(|title| ("title".to_owned(), Some(title.into()))));
        let values = values.unwrap_or_default();
        changes.extend(self.in_scene(values).map(|(key, value)| (key.to_owned(), Some(value))));
        self.scene.with_all(changes).map_err(|error| one_line(&error.to_string()))
    }

    /// The same as it is verified: pairs in slices more coarsely.
    fn verified_scene_of(&self, values: Option<&[f64]>) -> Result<LoadedScene, String> {
        let scene = self.scene_of(values, None)?;
        let mut changes = vec![("numerics.error_estimate".to_owned(), Some(false.into()))];
        if scene.scene().slices.is_some() {
            let numerics = &scene.scene().numerics;
            let least = |own: usize, most: usize| Some(toml::Value::Integer(own.min(most) as i64));
            changes.push(("numerics.positions".to_owned(), least(numerics.positions, SLICED_POSITIONS)));
            changes.push(("numerics.flank_points".to_owned(), least(numerics.flank_points, SLICED_POINTS)));
            if let gearwear_physics::simulation::settings::Stepping::Adaptive { tolerance_mm } = numerics.stepping {
                let tolerance = (1e3 * tolerance_mm).max(SLICED_TOLERANCE_UM);
                changes.push(("numerics.tolerance_um".to_owned(), Some(tolerance.into())));
            }
        }
        let scene = scene.with_all(changes).map_err(|error| one_line(&error.to_string()))?;
        let is_asked = self.question.figures.iter().any(SummaryOutput::is_of_torque_curve);
        Ok(if is_asked { scene } else { scene.without_torque_curve() })
    }

    /// Figures of a verified design with its error; `None` where it was interrupted.
    fn verify(&self, values: Option<&[f64]>, observer: &dyn Observer) -> Option<(Figures, Option<TotalError>)> {
        let ran = guarded(|| {
            let scene = self.verified_scene_of(values)?;
            match runs::summarise(&scene, observer) {
                Ok(Done { record, failure: None }) => Ok(record),
                Ok(Done { failure: Some(failure), .. }) | Err(failure) => Err(failure.to_string()),
            }
        });
        match ran.unwrap_or_else(|said| Err(format!("a defect of the program: {said}"))) {
            Ok(summary) if summary.stopped == StopReason::Interrupted => None,
            Ok(summary) => Some((figures_of(&summary, &self.question.figures), Some(summary.error.total))),
            Err(_) if observer.interrupted() => None,
            Err(reason) => Some((Err(one_line(&reason)), None)),
        }
    }

    /// Runs a design; `None` where it was interrupted.
    fn run_design(&self, asked: &AskedDesign, observer: &dyn Observer) -> Option<KeptDesign> {
        let start = Instant::now();
        let (figures, total) = match asked.role {
            DesignRole::Verify => self.verify(asked.values.as_deref(), observer)?,
            DesignRole::Search | DesignRole::Tolerance => {
                let values = asked.values.as_deref().unwrap_or_default();
                (self.fast.figures(self.in_scene(values), &self.question.figures, observer)?, None)
            }
        };
        let (number, role, values) = (asked.number, asked.role, asked.values.clone());
        Some(KeptDesign { number, role, values, figures, total, wall_s: start.elapsed().as_secs_f64() })
    }

    /// Outcome of a design for the search; `None` where a goal or a limit has no figure.
    fn outcome(&self, figures: &Figures) -> Option<Outcome> {
        let figures = figures.as_ref().ok()?;
        let goals = goals_of(&self.question, figures)?;
        let excess = self
            .question
            .limits
            .iter()
            .map(|limit| Some(limit.excess(self.question.figure(figures, &limit.figure.path)?)));
        Some(Outcome { goals, excess: excess.collect::<Option<_>>()? })
    }

    /// Runs what `journal` does not have of the study, and evaluates it.
    ///
    /// # Errors
    /// An interrupt, no design with a result or within the limits, a journal that cannot be written.
    pub fn run(
        &self,
        journal: &mut Journal<ImproveIdentity>,
        threads: usize,
        observer: &dyn Observer,
    ) -> Result<ImproveRecord, ImproveError> {
        let mut designs = Designs { prepared: self, journal, threads, observer, done: Vec::new() };
        observer.stage("search on the fast model");
        let searched = self.search(&mut designs)?;
        let outcomes: Vec<Option<Outcome>> = searched.points.iter().map(|point| point.outcome.clone()).collect();
        let front = front(outcomes.iter().map(Option::as_ref));
        self.check_found(&designs.done, &outcomes, &front)?;
        observer.stage("verification of the front");
        let chosen = self.spread_over(&outcomes, &front);
        let mut asked = vec![None];
        asked.extend(chosen.iter().map(|&place| designs.done[place].values.clone()));
        let verified = designs.run(DesignRole::Verify, asked)?;
        let (as_given, verified) = (verified[0].clone(), &verified[1..]);
        if let Err(reason) = &as_given.figures {
            return Err(ImproveError::Base(reason.clone()));
        }
        observer.stage("tolerances of the proposals");
        let proposals = self.proposals(&mut designs, &chosen, verified, &as_given)?;
        let tried =
            Tried { question: &self.question, designs: &designs.done, outcomes: &outcomes, as_given: &as_given };
        let bounds = tried.statements();
        Ok(self.record(designs, &searched, (outcomes, front), proposals, bounds))
    }

    fn search(&self, designs: &mut Designs<'_, '_>) -> Result<SearchRecord, ImproveError> {
        let free = &self.question.free;
        let snapped =
            |at: &[f64]| -> Vec<f64> { free.iter().zip(at).map(|(one, share)| one.share(one.value(*share))).collect() };
        let problem = SearchProblem { dimensions: free.len(), goals: self.question.goals.len(), snapped: &snapped };
        let settings = SearchSettings { evaluations: self.evaluations(), seed: self.question.seed };
        let designs = RefCell::new(designs);
        search(&problem, settings, |batch| {
            let values =
                batch.iter().map(|at| Some(free.iter().zip(at).map(|(one, share)| one.value(*share)).collect()));
            let ran = designs.borrow_mut().run(DesignRole::Search, values.collect())?;
            Ok(ran.iter().map(|design| self.outcome(&design.figures)).collect())
        })
    }

    /// Checks that there is a front.
    fn check_found(
        &self,
        designs: &[KeptDesign],
        outcomes: &[Option<Outcome>],
        front: &[usize],
    ) -> Result<(), ImproveError> {
        if !front.is_empty() {
            return Ok(());
        }
        let count = outcomes.len();
        let excess = |outcome: &Outcome| outcome.excess.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let nearest = outcomes.iter().flatten().min_by(|a, b| excess(a).total_cmp(&excess(b)));
        let Some(nearest) = nearest else {
            let first = designs.iter().find_map(|design| design.figures.as_ref().err().cloned());
            let first = first.unwrap_or_else(|| "a goal has no value".to_owned());
            return Err(ImproveError::NoDesign { count, first });
        };
        let worst = (0..nearest.excess.len()).max_by(|a, b| nearest.excess[*a].total_cmp(&nearest.excess[*b]));
        let limit = worst.map_or_else(String::new, |worst| self.question.limits[worst].to_string());
        let by = 100.0 * excess(nearest);
        Err(ImproveError::NotWithinLimits { count, nearest: format!("the nearest misses {limit} by {by:.1} %") })
    }

    /// Designs of the front that are verified, by their places: those that would be proposed, then those furthest from them in the goals.
    fn spread_over(&self, outcomes: &[Option<Outcome>], front: &[usize]) -> Vec<usize> {
        let goals: Vec<Vec<f64>> =
            front.iter().filter_map(|&place| outcomes[place].as_ref()).map(|outcome| outcome.goals.clone()).collect();
        let most = self.most_verified();
        let reference = goals_of(&self.question, &self.as_given).unwrap_or_else(|| goals[0].clone());
        let mut chosen: Vec<usize> =
            reasons(&self.question.goals, &goals, &reference, &[]).into_iter().map(|(_, place)| place).collect();
        let extents: Vec<[f64; 2]> = (0..self.question.goals.len())
            .map(|goal| gearwear_bodies::reference::statistics::extent(goals.iter().map(|own| own[goal])))
            .collect();
        let distance = |a: usize, b: usize| {
            let parts = extents.iter().enumerate().map(|(goal, [least, greatest])| {
                let width = (greatest - least).max(f64::MIN_POSITIVE);
                ((goals[a][goal] - goals[b][goal]) / width).powi(2)
            });
            parts.sum::<f64>()
        };
        // The least of each goal by itself belongs to the front too.
        for goal in 0..self.question.goals.len() {
            let least = (0..goals.len()).min_by(|a, b| goals[*a][goal].total_cmp(&goals[*b][goal]));
            chosen.extend(least.filter(|least| !chosen.contains(least) && chosen.len() < most));
        }
        while chosen.len() < most.min(goals.len()) {
            let nearest =
                |place: usize| chosen.iter().map(|&other| distance(place, other)).fold(f64::INFINITY, f64::min);
            let others = (0..goals.len()).filter(|place| !chosen.contains(place));
            let Some(next) = others.max_by(|a, b| nearest(*a).total_cmp(&nearest(*b)).then(b.cmp(a))) else { break };
            chosen.push(next);
        }
        chosen.sort_unstable();
        chosen.dedup();
        chosen.into_iter().map(|place| front[place]).collect()
    }

    /// Proposals among the verified designs, with their tolerances; the designs of the search at `chosen` were verified.
    fn proposals(
        &self,
        designs: &mut Designs<'_, '_>,
        chosen: &[usize],
        verified: &[KeptDesign],
        as_given: &KeptDesign,
    ) -> Result<Vec<Proposal>, ImproveError> {
        let outcomes: Vec<Option<Outcome>> = verified.iter().map(|design| self.outcome(&design.figures)).collect();
        let front = front(outcomes.iter().map(Option::as_ref));
        let goals: Vec<Vec<f64>> =
            front.iter().filter_map(|&place| outcomes[place].as_ref()).map(|outcome| outcome.goals.clone()).collect();
        let given = as_given.figures.as_ref().ok().and_then(|figures| goals_of(&self.question, figures));
        let (Some(given), false) = (given, goals.is_empty()) else {
            let reason = verified.iter().find_map(|design| design.figures.as_ref().err().cloned());
            let nearest = reason.unwrap_or_else(|| "verified, the designs of the front are beyond a limit".to_owned());
            return Err(ImproveError::NotWithinLimits { count: verified.len(), nearest });
        };
        let on_fast: Vec<KeptDesign> = front.iter().map(|&place| designs.done[chosen[place]].clone()).collect();
        let sensitivities = self.sensitivities(designs, &on_fast)?;
        let together: Vec<Vec<Option<f64>>> = sensitivities.iter().map(|of| self.together(of)).collect();
        let mut proposals = Vec::new();
        for (name, place) in reasons(&self.question.goals, &goals, &given, &together) {
            let design = &verified[front[place]];
            let values = design.values.clone().unwrap_or_default();
            let fast_figures = on_fast[place].figures.as_deref().unwrap_or_default();
            let title = format!("{}: {name}", self.scene.resolved.title());
            let scene = self.scene_of(Some(&values), Some(title));
            proposals.push(Proposal {
                file: file_of(&name),
                design: design.number,
                values: values_of(&self.question.free, &values),
                figures: compared(&self.question, (design, as_given), fast_figures),
                tolerances_together: together[place].clone(),
                sensitivity: sensitivities[place].clone(),
                scene_toml: scene.map(|scene| scene.given.text.clone()).unwrap_or_default(),
                name,
            });
        }
        Ok(proposals)
    }

    /// Changes of the goals of each of these designs of the search by each tolerance.
    fn sensitivities(
        &self,
        designs: &mut Designs<'_, '_>,
        of: &[KeptDesign],
    ) -> Result<Vec<Vec<Sensitivity>>, ImproveError> {
        let beside = |design: &KeptDesign| {
            let values = design.values.iter().flatten();
            let beside = self.question.free.iter().zip(values).map(|(one, value)| one.within_tolerance(*value));
            beside.enumerate().filter(|(_, beside)| !beside.is_empty()).collect::<Vec<(usize, Vec<f64>)>>()
        };
        let mut asked = Vec::new();
        for design in of {
            for (key, value) in
                beside(design).into_iter().flat_map(|(key, values)| values.into_iter().map(move |v| (key, v)))
            {
                let mut values = design.values.clone().unwrap_or_default();
                values[key] = value;
                asked.push(Some(values));
            }
        }
        let ran = designs.run(DesignRole::Tolerance, asked)?;
        let mut ran = ran.iter();
        let goals = |design: &KeptDesign| goals_of(&self.question, design.figures.as_ref().ok()?);
        let of_designs = of.iter().map(|design| {
            let at = goals(design);
            let of_keys = beside(design).into_iter().filter_map(|(key, values)| {
                let beside: Vec<Option<Vec<f64>>> = ran.by_ref().take(values.len()).map(goals).collect();
                let one = &self.question.free[key];
                let (key, tolerance) = (one.key.clone(), one.tolerance.unwrap_or_default());
                Some(Sensitivity { key, tolerance, changes: worsening(at.as_ref()?, &beside) })
            });
            of_keys.collect()
        });
        Ok(of_designs.collect())
    }

    /// Changes of the goals by all tolerances together at worst: the sum of each by itself.
    fn together(&self, of: &[Sensitivity]) -> Vec<Option<f64>> {
        let of_goal = |goal: usize| -> Option<f64> {
            let changes: Option<Vec<f64>> = of.iter().map(|one| one.changes[goal]).collect();
            changes.filter(|changes| !changes.is_empty()).map(|changes| changes.iter().sum())
        };
        (0..self.question.goals.len()).map(of_goal).collect()
    }

    fn record(
        &self,
        designs: Designs<'_, '_>,
        searched: &SearchRecord,
        (outcomes, front): (Vec<Option<Outcome>>, Vec<usize>),
        proposals: Vec<Proposal>,
        bounds: Vec<String>,
    ) -> ImproveRecord {
        let free = &self.question.free;
        let said = |design: &KeptDesign| {
            let values = design.values.as_ref()?;
            Some(free.iter().zip(values).map(|(one, value)| one.said(*value)).collect())
        };
        let goal_values = |design: &KeptDesign| {
            let figures = design.figures.as_ref().ok()?;
            let goals = self.question.goals.iter();
            goals.map(|goal| goal.value(|path| self.question.figure(figures, path))).collect::<Option<Vec<f64>>>()
        };
        let threads = designs.threads;
        let designs = designs.done;
        let verified_scene = self.verified_scene_of(None).ok();
        let goals_of_designs: Vec<Option<Vec<f64>>> = designs.iter().map(goal_values).collect();
        ImproveRecord {
            title: self.scene.resolved.title().to_owned(),
            program_version: env!("CARGO_PKG_VERSION").to_owned(),
            scene_hash: self.scene.resolved.scene_hash(),
            status: "complete",
            free: free.iter().map(FreeKey::as_given).collect(),
            is_free_by_default: self.is_free_by_default,
            goals: self
                .question
                .goals
                .iter()
                .map(|goal| GoalRecord {
                    goal: goal.to_string(),
                    heading: goal.heading(),
                    unit: goal.unit().to_owned(),
                    is_raised: goal.is_raised(),
                })
                .collect(),
            limits: self.question.limits.iter().map(ToString::to_string).collect(),
            seed: self.question.seed,
            evaluations: self.evaluations(),
            searched: searched.points.len(),
            failed: outcomes.iter().filter(|outcome| outcome.is_none()).count(),
            first_failure: designs
                .iter()
                .filter(|design| design.role == DesignRole::Search)
                .find_map(|design| design.figures.as_ref().err().cloned()),
            within_limits: outcomes.iter().flatten().filter(|outcome| outcome.is_allowed()).count(),
            stopped: match searched.stopped {
                SearchStop::Settled => "the last designs did not improve on the front",
                SearchStop::Evaluations => "all evaluations were spent",
                SearchStop::Exhausted => "no further design is left",
            }
            .to_owned(),
            fast_model: self.fast.how.clone(),
            verified_on: verified_scene.map_or_else(String::new, |scene| verified_on(&scene)),
            greatest_difference: greatest_difference(&designs, &goals_of_designs, self.question.goals.len()),
            proposals,
            bounds,
            figures: self.question.figures.iter().map(|figure| figure.path.clone()).collect(),
            front: front.iter().map(|&place| designs[place].number).collect(),
            threads,
            wall_s: self.begun.elapsed().as_secs_f64(),
            keys: free.iter().map(|one| one.key.clone()).collect(),
            said: designs.iter().map(said).collect(),
            goals_of_designs,
            designs,
            scene_toml: self.scene.given.text.clone(),
        }
    }
}

/// Model of verified designs, in a sentence.
fn verified_on(scene: &LoadedScene) -> String {
    let of = scene.scene();
    let slices = of.slices.map_or_else(String::new, |slices| format!(", {} slices", slices.count));
    let error = if of.verify { ", with its error against finite elements" } else { "" };
    format!(
        "contact surface {}, {} positions, {} points a flank{slices}{error}",
        of.contact.surface.name(),
        of.numerics.positions,
        of.numerics.flank_points
    )
}

/// Greatest relative difference of each goal of a verified design to that on the fast model.
fn greatest_difference(designs: &[KeptDesign], goals: &[Option<Vec<f64>>], count: usize) -> Vec<Option<f64>> {
    let in_role = |role: DesignRole| designs.iter().zip(goals).filter(move |(design, _)| design.role == role);
    let pairs: Vec<(&Vec<f64>, &Vec<f64>)> = in_role(DesignRole::Verify)
        .filter_map(|(design, own)| {
            let (_, fast) = in_role(DesignRole::Search).find(|(other, _)| other.values == design.values)?;
            Some((own.as_ref()?, fast.as_ref()?))
        })
        .collect();
    let of_goal = |goal: usize| {
        let differences = pairs.iter().map(|(own, fast)| (fast[goal] / own[goal] - 1.0).abs());
        differences.filter(|difference| difference.is_finite()).reduce(f64::max)
    };
    (0..count).map(of_goal).collect()
}

impl Designs<'_, '_> {
    /// Runs designs in a role, those that the journal does not have, and adds them.
    fn run(&mut self, role: DesignRole, values: Vec<Option<Vec<f64>>>) -> Result<Vec<KeptDesign>, ImproveError> {
        let first = self.done.len();
        let asked: Vec<AskedDesign> = values
            .into_iter()
            .enumerate()
            .map(|(place, values)| AskedDesign { number: first + place, role, values })
            .collect();
        let rows = &self.journal.contents.rows;
        let is_kept = |asked: &AskedDesign| {
            rows.get(&asked.number).is_some_and(|row| row.role == asked.role && row.values == asked.values)
        };
        let open: Vec<&AskedDesign> = asked.iter().filter(|asked| !is_kept(asked)).collect();
        let (things, total) = match role {
            DesignRole::Search => ("designs", self.prepared.evaluations()),
            DesignRole::Verify => ("verified", asked.len()),
            DesignRole::Tolerance => ("tolerances", asked.len()),
        };
        let before = if role == DesignRole::Search { first } else { 0 };
        let mut finished = before + asked.len() - open.len();
        let observer = self.observer;
        let tell = |_: &KeptDesign| {
            finished += 1;
            observer.counted(finished, total, things, "");
        };
        let mut kept = RowKeeper { journal: self.journal, tell, error: None };
        let run = |asked: &&AskedDesign, within: &dyn Observer| self.prepared.run_design(asked, within);
        let ended = spread(&open, self.threads.max(1), observer, run, |row| kept.keep(row));
        if let Some(error) = kept.error {
            return Err(error.into());
        }
        if ended == SpreadOutcome::Interrupted {
            return Err(ImproveError::Interrupted);
        }
        let rows = &self.journal.contents.rows;
        let ran: Vec<KeptDesign> = asked.iter().filter_map(|asked| rows.get(&asked.number).cloned()).collect();
        self.done.extend(ran.iter().cloned());
        Ok(ran)
    }
}
