//! The main figures of a scene of either kind.
//!
//! Those of a pair are the catalogue's ([`figures`]). A stage has them of each mesh, called by their paths in its summary, of a gear by its flank:
//!
//! | of a pair | of a stage |
//! |---|---|
//! | `pinion.peak_wear_um` | `sun.peak_wear_um`, `planet.ring_flank.peak_wear_um` |
//! | `wheel.peak_wear_um` | `planet.sun_flank.peak_wear_um`, `ring.peak_wear_um` |
//! | `new.flank_pressure_MPa` | `sun_planet.new.flank_pressure_MPa`, `planet_ring.new.flank_pressure_MPa` |
//!
//! and some of its own, such as its transmission error and its life.

use std::sync::LazyLock;

use crate::planetary_run::record::PlanetarySummary;
use crate::report::unit;
use crate::scene::opened::{EachMesh, SceneKind};
use crate::scene::planetary::mesh::{PerMesh, StageMesh};
use crate::varied_scene::{SceneSummary, StudiedRun};
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::error::TotalError;
use gearwear_physics::results::figures::{self, MainFigure, PEAK_WEAR_OF_EITHER, STATED_ERRORS};

/// A figure of a stage that neither of its meshes has.
struct StageFigure {
    name: &'static str,
    heading: &'static str,
    meaning: &'static str,
    unit: &'static str,
    wants_less: bool,
    in_headline: bool,
    value: fn(&PlanetarySummary) -> Option<f64>,
    error: Option<ErrorOfStage>,
}

type ErrorOfStage = fn(&PerMesh<TotalError>) -> Option<f64>;

fn greatest(values: impl IntoIterator<Item = Option<f64>>) -> Option<f64> {
    values.into_iter().collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::max)
}

static OF_STAGE: [StageFigure; 6] = [
    StageFigure {
        name: PEAK_WEAR_OF_EITHER,
        heading: "maximum wear of any flank",
        meaning: "maximum wear depth on the active profiles of sun, planet and ring, their tip edges apart",
        unit: "µm",
        wants_less: true,
        in_headline: false,
        value: |s| greatest(s.flanks().map(|(_, wear)| Some(wear?.peak_wear_um))),
        error: Some(|totals| {
            greatest(totals.both().into_iter().flat_map(|total| [total.peak_wear.pinion, total.peak_wear.wheel]))
        }),
    },
    StageFigure {
        name: "transmission_error.new.peak_to_peak",
        heading: "transmission error of the stage, peak to peak, new",
        meaning: "mean of all planets, of both meshes together, at the base circle of the sun, new",
        unit: "µm",
        wants_less: true,
        in_headline: true,
        value: |s| Some(s.transmission_error.new.as_ref()?.peak_to_peak),
        error: None,
    },
    StageFigure {
        name: "transmission_error.worn.peak_to_peak",
        heading: "transmission error of the stage, peak to peak, worn",
        meaning: "mean of all planets, of both meshes together, at the base circle of the sun, worn",
        unit: "µm",
        wants_less: true,
        in_headline: true,
        value: |s| Some(s.transmission_error.worn.as_ref()?.peak_to_peak),
        error: None,
    },
    StageFigure {
        name: "planet.worn_mass_mg",
        heading: "worn mass of a planet",
        meaning: "worn off one planet, both flanks of all teeth",
        unit: "mg",
        wants_less: true,
        in_headline: false,
        value: |s| s.planet.worn_mass_mg,
        error: None,
    },
    StageFigure {
        name: "life.hours",
        heading: "life of the stage",
        meaning: "until the first limit of operation.stop is reached in either mesh; empty where none is within the duration",
        unit: "h",
        wants_less: false,
        in_headline: false,
        value: |s| s.life.as_ref()?.hours,
        error: None,
    },
    StageFigure {
        name: "life.revolutions",
        heading: "life of the stage",
        meaning: "the same in revolutions of the given member",
        unit: "revolutions",
        wants_less: false,
        in_headline: false,
        value: |s| s.life.as_ref()?.revolutions,
        error: None,
    },
];

/// A main figure of a scene.
pub struct StudyFigure {
    /// Path in the summary.
    pub name: String,
    /// Short heading, lower case, without unit.
    pub heading: String,
    /// Meaning of the value, in a phrase.
    pub meaning: String,
    /// Its place among the figures that a sweep keeps.
    column: Option<usize>,
    source: Source,
}

enum Source {
    /// Of a pair, or of a mesh of a stage.
    Mesh(Option<StageMesh>, &'static MainFigure),
    Stage(&'static StageFigure),
}

impl std::fmt::Debug for StudyFigure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.name)
    }
}

impl PartialEq for StudyFigure {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl StudyFigure {
    /// Figure of a pair, or of a mesh of a stage.
    fn of_mesh(mesh: Option<StageMesh>, figure: &'static MainFigure) -> Self {
        let (name, heading, meaning) = match mesh {
            None => (figure.name.clone(), figure.heading.clone(), figure.meaning.clone()),
            Some(mesh) => in_stage(mesh, figure),
        };
        Self { name, heading, meaning, column: None, source: Source::Mesh(mesh, figure) }
    }

    fn of_stage(figure: &'static StageFigure) -> Self {
        let StageFigure { name, heading, meaning, .. } = figure;
        let [name, heading, meaning] = [name, heading, meaning].map(|text| (*text).to_owned());
        Self { name, heading, meaning, column: None, source: Source::Stage(figure) }
    }

    /// Unit; empty for a ratio.
    pub fn unit(&self) -> &'static str {
        match &self.source {
            // Of a stage, these are turns on the carrier.
            Source::Mesh(Some(_), figure) if figure.name == "life.revolutions" => "revolutions on the carrier",
            Source::Mesh(_, figure) => figure.unit(),
            Source::Stage(figure) => figure.unit,
        }
    }

    /// Heading and unit: `line load, N/mm`.
    pub fn with_unit(&self) -> String {
        if self.unit().is_empty() { self.heading.clone() } else { format!("{}, {}", self.heading, self.unit()) }
    }

    /// Whether one looks for the combination where it is least.
    pub fn less_is_better(&self) -> bool {
        match &self.source {
            Source::Mesh(_, figure) => figure.family.less_is_better,
            Source::Stage(figure) => figure.wants_less,
        }
    }

    /// Whether it is among the first words of a run.
    pub fn in_headline(&self) -> bool {
        match &self.source {
            Source::Mesh(_, figure) => figure.family.in_headline,
            Source::Stage(figure) => figure.in_headline,
        }
    }

    /// Value in a run; `None` where the scene does not compute it.
    pub fn value(&self, run: &StudiedRun) -> Option<f64> {
        match (&self.source, run.summary()) {
            (Source::Mesh(mesh, figure), _) => figure.value(&run.pairs().of(*mesh)?.summary),
            (Source::Stage(figure), SceneSummary::Stage(summary)) => (figure.value)(summary),
            (Source::Stage(_), SceneSummary::Pair(_)) => None,
        }
    }

    /// Whether a run states errors of it.
    pub fn has_errors(&self) -> bool {
        match &self.source {
            Source::Mesh(_, figure) => figure.error_paths().next().is_some(),
            Source::Stage(figure) => figure.error.is_some(),
        }
    }

    /// Relative error that a run states of it; `None` where it is not known.
    pub fn error(&self, totals: &EachMesh<TotalError>) -> Option<f64> {
        match (&self.source, totals) {
            (Source::Mesh(mesh, figure), _) => figure.error(totals.of(*mesh)?),
            (Source::Stage(figure), EachMesh::Stage(totals)) => figure.error?(totals),
            (Source::Stage(_), EachMesh::Pair(_)) => None,
        }
    }

    /// Whether it is a depth that a history has.
    pub fn has_history(&self) -> bool {
        matches!(&self.source, Source::Mesh(_, figure) if figure.depth_of_history().is_some())
    }

    /// Time, in hours where the scene has a speed and else in revolutions that it counts in, and depth at each moment of a run.
    pub fn growth(&self, run: &StudiedRun) -> Vec<(f64, f64)> {
        let Source::Mesh(mesh, figure) = &self.source else { return Vec::new() };
        let pairs = run.pairs();
        let (Some(pair), Some(depth)) = (pairs.of(*mesh), figure.depth_of_history()) else { return Vec::new() };
        let time = |hours: Option<f64>, revolutions: f64| hours.unwrap_or(revolutions / run.turns(*mesh));
        pair.history.iter().map(|row| (time(row.hours, row.revolutions), depth(row))).collect()
    }

    /// Its place among the figures that a sweep keeps.
    pub fn column(&self) -> Option<usize> {
        self.column
    }
}

/// Name, heading and meaning of a pair's figure as of a mesh of a stage.
fn in_stage(mesh: StageMesh, figure: &MainFigure) -> (String, String, String) {
    let of_gear = figure.gear().and_then(|gear| Some((gear, figure.name.strip_prefix(gear.name())?)));
    let name = match of_gear {
        Some((gear, rest)) => format!("{}{rest}", mesh.flank(gear)),
        None => format!("{}.{}", mesh.table(), figure.name),
    };
    match figure.gear() {
        Some(gear) => {
            let said = |text: &str| text.replace(gear.name(), mesh.flank_in_words(gear));
            (name, said(&figure.heading), said(&figure.meaning))
        }
        None => {
            let heading = format!("{} ({})", of_mesh(&figure.heading, mesh), mesh.in_words());
            (name, heading, of_mesh(&figure.meaning, mesh))
        }
    }
}

/// Figures of a kind of scene: first those that a sweep keeps, in the order of its columns.
fn catalogue(kind: SceneKind) -> Vec<StudyFigure> {
    let of_stage = if kind == SceneKind::Stage { &OF_STAGE[..] } else { &[] };
    let in_sweeps = figures::in_sweeps();
    let others: Vec<&MainFigure> = figures::all().iter().filter(|figure| !in_sweeps.contains(figure)).collect();
    // A stage has one of any flank instead.
    let is_own = |mesh: Option<StageMesh>, figure: &MainFigure| mesh.is_none() || figure.name != PEAK_WEAR_OF_EITHER;
    let of_meshes = |figures: &[&'static MainFigure]| -> Vec<StudyFigure> {
        let each = kind.meshes().into_iter().flat_map(|mesh| figures.iter().map(move |figure| (mesh, *figure)));
        each.filter(|(mesh, figure)| is_own(*mesh, figure))
            .map(|(mesh, figure)| StudyFigure::of_mesh(mesh, figure))
            .collect()
    };
    let kept = of_stage.iter().map(StudyFigure::of_stage).chain(of_meshes(in_sweeps));
    let kept = kept.enumerate().map(|(at, figure)| StudyFigure { column: Some(at), ..figure });
    kept.chain(of_meshes(&others)).collect()
}

/// All main figures of a kind of scene.
pub fn all(kind: SceneKind) -> &'static [StudyFigure] {
    static OF_PAIRS: LazyLock<Vec<StudyFigure>> = LazyLock::new(|| catalogue(SceneKind::Pair));
    static OF_STAGES: LazyLock<Vec<StudyFigure>> = LazyLock::new(|| catalogue(SceneKind::Stage));
    match kind {
        SceneKind::Pair => &OF_PAIRS,
        SceneKind::Stage => &OF_STAGES,
    }
}

/// Figures that a sweep keeps of each run, in the order of its columns.
pub fn in_sweeps(kind: SceneKind) -> &'static [StudyFigure] {
    let all = all(kind);
    &all[..all.partition_point(|figure| figure.column.is_some())]
}

/// The figure of this name; of a pair also by the name that it had in the version before.
pub fn find(kind: SceneKind, name: &str) -> Option<&'static StudyFigure> {
    let name = if kind.is_pair() { figures::name_now(name).unwrap_or(name) } else { name };
    all(kind).iter().find(|figure| figure.name == name)
}

/// The greatest wear of any flank.
pub fn peak_wear(kind: SceneKind) -> &'static StudyFigure {
    // Both catalogues have it.
    find(kind, PEAK_WEAR_OF_EITHER).unwrap_or(&all(kind)[0])
}

/// Paths of the figures that a study of uncertainty keeps where no outputs are asked for.
pub fn default_outputs(kind: SceneKind) -> Vec<&'static str> {
    if kind.is_pair() {
        return figures::default_outputs().iter().map(|figure| &*figure.name).collect();
    }
    let of_depth = |end: &'static str| move |figure: &&StudyFigure| figure.has_history() && figure.name.ends_with(end);
    let depths =
        [".peak_wear_um", ".tip_edge_wear_um"].into_iter().flat_map(|end| all(kind).iter().filter(of_depth(end)));
    depths.map(|figure| &*figure.name).chain(["transmission_error.worn.peak_to_peak"]).collect()
}

/// Unit of the number at a path of the summary, if its name or the catalogue says it.
pub fn unit_of(kind: SceneKind, path: &str) -> Option<&'static str> {
    match find(kind, path) {
        Some(figure) => Some(figure.unit()).filter(|unit| !unit.is_empty()),
        None => unit::of(path),
    }
}

/// An error that the run of a pair, or of a mesh of a stage, states.
#[derive(Debug)]
pub struct StudyClaim {
    /// Path in the summary.
    pub name: String,
    /// Words for what the error is of.
    pub title: String,
    mesh: Option<StageMesh>,
    error: fn(&TotalError) -> Option<f64>,
}

impl StudyClaim {
    /// The error; `None` where it is not known.
    pub fn of(&self, totals: &EachMesh<TotalError>) -> Option<f64> {
        (self.error)(totals.of(self.mesh)?)
    }
}

/// All errors that a run states, in the order of tables.
pub fn claims(kind: SceneKind) -> &'static [StudyClaim] {
    static OF_PAIRS: LazyLock<Vec<StudyClaim>> = LazyLock::new(|| all_claims(SceneKind::Pair));
    static OF_STAGES: LazyLock<Vec<StudyClaim>> = LazyLock::new(|| all_claims(SceneKind::Stage));
    match kind {
        SceneKind::Pair => &OF_PAIRS,
        SceneKind::Stage => &OF_STAGES,
    }
}

fn all_claims(kind: SceneKind) -> Vec<StudyClaim> {
    let claim = |mesh: Option<StageMesh>, stated: &figures::StatedError| StudyClaim {
        name: mesh.map_or_else(|| stated.name.to_owned(), |mesh| format!("{}.{}", mesh.table(), stated.name)),
        title: mesh.map_or_else(
            || stated.title.to_owned(),
            |mesh| format!("{} ({})", of_mesh(stated.title, mesh), mesh.in_words()),
        ),
        mesh,
        error: stated.of,
    };
    kind.meshes().into_iter().flat_map(|mesh| STATED_ERRORS.iter().map(move |stated| claim(mesh, stated))).collect()
}

/// `text` about a pair with the names of a mesh's gears.
fn of_mesh(text: &str, mesh: StageMesh) -> String {
    Gear::BOTH.into_iter().fold(text.to_owned(), |text, gear| text.replace(gear.name(), mesh.gears()[gear as usize]))
}

/// Source of the errors, or the reasons why they are not known.
pub fn how(totals: &EachMesh<TotalError>) -> String {
    match totals {
        EachMesh::Pair(total) => total.how.clone(),
        EachMesh::Stage(totals) => {
            let of_each = StageMesh::BOTH.map(|mesh| format!("{}: {}", mesh.in_words(), totals[mesh].how));
            of_each.join("; ")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::output::SummaryOutput;

    /// Each has a name of its own that leads to a number, and a sweep of pairs has the columns that it had.
    #[test]
    fn figures_of_both_kinds_are_numbers_of_their_summaries() {
        for kind in [SceneKind::Pair, SceneKind::Stage] {
            for (at, figure) in all(kind).iter().enumerate() {
                assert_eq!(find(kind, &figure.name), Some(&all(kind)[at]), "{}", figure.name);
                assert!(SummaryOutput::of_kind(kind, &figure.name).is_ok(), "{}", figure.name);
                assert!(kind.is_pair() || !figure.heading.contains("pinion") && !figure.heading.contains("wheel"));
            }
            assert!(in_sweeps(kind).iter().enumerate().all(|(at, figure)| figure.column == Some(at)));
            for path in default_outputs(kind) {
                assert!(find(kind, path).is_some(), "{path}");
            }
        }
        let of_pairs: Vec<&str> = in_sweeps(SceneKind::Pair).iter().map(|figure| figure.name.as_str()).collect();
        assert_eq!(of_pairs, figures::in_sweeps().iter().map(|figure| figure.name.as_str()).collect::<Vec<_>>());
        // Of both meshes all but the wear of either gear.
        assert_eq!(in_sweeps(SceneKind::Stage).len(), OF_STAGE.len() + 2 * (of_pairs.len() - 1));
        assert_eq!(default_outputs(SceneKind::Stage).len(), 9);
    }
}
