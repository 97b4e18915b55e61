//! The main figures of a run: one catalogue of their names, units, words, values and errors, which the terminal, the page, the workbook, sweeps,
//! comparisons, studies of uncertainty, REXS and the Python package read.
//!
//! The name of a figure is its path in `summary.json`, items of lists numbered from 1. A [`FigureFamily`] is a line of the catalogue: one figure
//! of the pair, or the same figure of each gear (`{gear}` in its texts) or of new and worn flanks (`{state}`); [`all`] has the figures one by one.
//!
//! A figure is added in three places: its field in the record ([`super::run`]), what fills it, and a line of [`FAMILIES`].

use std::sync::LazyLock;

use super::error::TotalError;
use super::run::{CycleSummary, HistoryRow, OverWidthSummary, Summary, WearSummary};
use super::torque_curve::TorqueCurveState;
use gearwear_bodies::gear::Gear;

/// A relative error that a run states of itself, against the same wear simulation with finite elements.
#[derive(Debug, Clone, Copy)]
pub struct StatedError {
    /// Path in the summary.
    pub name: &'static str,
    /// Words for what the error is of.
    pub title: &'static str,
    /// Name of the attribute in REXS, `{gear}` left out, behind the program's prefix; empty where there is none.
    pub rexs: &'static str,
    /// The error; `None` where it is not known.
    pub of: fn(&TotalError) -> Option<f64>,
}

const fn stated(name: &'static str, title: &'static str, of: fn(&TotalError) -> Option<f64>) -> StatedError {
    StatedError { name, title, rexs: "", of }
}

const RELATIVE_WEAR_ERROR: &str = "maximum_wear_depth_relative_error";

/// All errors that a run states, in the order of tables.
pub const STATED_ERRORS: [StatedError; 12] = [
    StatedError {
        rexs: RELATIVE_WEAR_ERROR,
        ..stated("error.total.peak_wear.pinion", "maximum wear of the pinion", |total| total.peak_wear.pinion)
    },
    StatedError {
        rexs: RELATIVE_WEAR_ERROR,
        ..stated("error.total.peak_wear.wheel", "maximum wear of the wheel", |total| total.peak_wear.wheel)
    },
    stated("error.total.tip_edge_wear.pinion", "wear of the pinion’s tip edge", |total| total.tip_edge_wear.pinion),
    stated("error.total.tip_edge_wear.wheel", "wear of the wheel’s tip edge", |total| total.tip_edge_wear.wheel),
    stated("error.total.profile.pinion", "wear over the pinion’s flank (rms)", |total| total.profile.pinion),
    stated("error.total.profile.wheel", "wear over the wheel’s flank (rms)", |total| total.profile.wheel),
    stated("error.total.transmission_error_peak_to_peak", "transmission error, peak to peak, worn", |total| {
        total.transmission_error_peak_to_peak
    }),
    stated("error.total.transmission_error_peak_to_peak_new", "transmission error, peak to peak, new", |total| {
        total.transmission_error_peak_to_peak_new
    }),
    stated("error.total.transmission_error_over_life", "transmission error, mean over life", |total| {
        total.transmission_error_over_life
    }),
    stated("error.total.pressure_between_tips", "pressure between the tip edges, worn (rms)", |total| {
        total.pressure_between_tips
    }),
    stated("error.total.flank_pressure.new", "flank pressure, new", |total| total.flank_pressure.new),
    stated("error.total.flank_pressure.worn", "flank pressure, worn", |total| total.flank_pressure.worn),
];

/// Id of an attribute in the database of REXS, in the versions that have it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RexsId {
    /// The id.
    pub id: &'static str,
    /// First and last version; they are in order as texts are.
    pub versions: [&'static str; 2],
}

impl RexsId {
    /// First version that is known.
    pub const FIRST: &str = "1.4";
    /// Last version that is known.
    pub const LAST: &str = "2.0.0";

    /// In all versions.
    pub const fn always(id: &'static str) -> Self {
        Self { id, versions: [Self::FIRST, Self::LAST] }
    }
}

/// Attribute of a figure in REXS.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RexsAttribute {
    /// Name behind the program's own prefix.
    Own(&'static str),
    /// Attribute in the database of the format.
    Database {
        /// Ids, each in the versions that have it.
        ids: &'static [RexsId],
        /// The unit as the database writes it.
        unit: &'static str,
    },
}

/// Reduction of the slices of a pair to one figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OverSlices {
    /// One value of the whole pair, not of slices.
    OfPair,
    /// Maximum, a fortieth of the face width at either end face left out.
    Maximum,
    /// Maximum of all slices, those at the end faces included.
    MaximumOfAll,
    /// Minimum, a fortieth of the face width at either end face left out.
    Minimum,
    /// Place of the maximum.
    AtMaximum,
    /// Mean.
    Mean,
    /// Sum.
    Sum,
    /// Spread or ratio of the slices, none where there are no slices.
    Spread,
}

impl OverSlices {
    /// In words, for a table.
    pub fn name(self) -> &'static str {
        match self {
            Self::OfPair => "one value",
            Self::Maximum => "maximum",
            Self::MaximumOfAll => "maximum, end faces included",
            Self::Minimum => "minimum",
            Self::AtMaximum => "where the maximum is",
            Self::Mean => "mean",
            Self::Sum => "sum",
            Self::Spread => "spread of the slices",
        }
    }
}

/// Values of a family's figures; `None` where the scene does not compute one.
#[derive(Debug, Clone, Copy)]
pub enum FigureValues {
    /// One of the pair.
    Pair(fn(&Summary) -> Option<f64>),
    /// Pinion and wheel.
    Gears(fn(&Summary) -> [Option<f64>; 2]),
    /// New and worn flanks, under the load of the reference phase.
    States(fn(&Summary) -> [Option<f64>; 2]),
}

type DepthOfHistory = fn(&HistoryRow) -> f64;

/// A line of the catalogue. Texts may hold `{gear}` or `{state}`; numbers and flags in twos are of pinion and wheel, or new and worn.
#[derive(Debug, Clone, Copy)]
pub struct FigureFamily {
    /// Path in the summary.
    pub path: &'static str,
    /// Unit; empty for a ratio.
    pub unit: &'static str,
    /// Short heading, lower case; `{}` where the gear is named.
    pub words: &'static str,
    /// Meaning of the value, in a phrase.
    pub meaning: &'static str,
    /// Reservation said with the heading: the value depends on the resolution; mostly empty.
    pub caveat: &'static str,
    /// Places of the values in the summary.
    pub values: FigureValues,
    /// Reduction of the slices.
    pub over_slices: OverSlices,
    /// Whether one looks for the combination where it is least.
    pub less_is_better: bool,
    /// Paths of the errors that a run states of it; a figure of the pair with two has the greater. Empty: none.
    pub errors: [&'static str; 2],
    /// The depth in a row of the history, where it has one.
    pub history: [Option<DepthOfHistory>; 2],
    /// Attribute in REXS, if the catalogue names it (others: `exchange::rexs::attributes`).
    pub rexs: Option<RexsAttribute>,
    /// Name in the version before; empty where it had none.
    former: &'static str,
    /// Whether it is among the first words of a run, each with its error.
    pub in_headline: bool,
    /// Whether the table in the terminal shows it.
    pub in_terminal: bool,
    /// Whether the tables of the page show it.
    pub on_page: bool,
    /// Number of the column in `sweep.csv`, from 1, never changed; 0: none.
    sweep_column: [u8; 2],
    /// Number of the row where runs are compared, from 1; 0: none.
    compared_row: [u8; 2],
    /// Number among the outputs of a study of uncertainty that asks for none, from 1; 0: not among them.
    default_output: [u8; 2],
}

impl FigureFamily {
    const fn new(path: &'static str, unit: &'static str, words: &'static str, values: FigureValues) -> Self {
        Self {
            path,
            unit,
            words,
            meaning: "",
            caveat: "",
            values,
            over_slices: OverSlices::OfPair,
            less_is_better: false,
            errors: [""; 2],
            history: [None; 2],
            rexs: None,
            former: "",
            in_headline: false,
            in_terminal: false,
            on_page: false,
            sweep_column: [0; 2],
            compared_row: [0; 2],
            default_output: [0; 2],
        }
    }

    const fn means(self, meaning: &'static str) -> Self {
        Self { meaning, ..self }
    }

    const fn of_slices(self, over_slices: OverSlices) -> Self {
        Self { over_slices, ..self }
    }

    const fn wants_less(self) -> Self {
        Self { less_is_better: true, ..self }
    }

    const fn with_errors(self, errors: [&'static str; 2]) -> Self {
        Self { errors, ..self }
    }

    const fn own_attribute(self, name: &'static str) -> Self {
        Self { rexs: Some(RexsAttribute::Own(name)), ..self }
    }

    const fn once_called(self, former: &'static str) -> Self {
        Self { former, ..self }
    }

    const fn in_headline(self) -> Self {
        Self { in_headline: true, ..self.shown() }
    }

    const fn shown(self) -> Self {
        Self { in_terminal: true, on_page: true, ..self }
    }

    const fn on_page(self) -> Self {
        Self { on_page: true, ..self }
    }

    const fn in_sweeps(self, sweep_column: [u8; 2]) -> Self {
        Self { sweep_column, ..self }
    }

    const fn compared(self, compared_row: [u8; 2]) -> Self {
        Self { compared_row, ..self }
    }

    /// Heading of a row for all figures of the family: `maximum wear, tip edge`.
    pub fn row(&self) -> String {
        let caveat = if self.caveat.is_empty() { String::new() } else { format!(" ({})", self.caveat) };
        format!("{}{caveat}", self.words.replace("{}", ""))
    }

    /// Whether it is of the slices over the face width; there is none without slices.
    pub fn is_of_slices(&self) -> bool {
        self.path.starts_with("helical.")
    }

    /// Pinion and wheel, or new and worn; of a figure of the pair the same twice.
    pub fn both(&self, summary: &Summary) -> [Option<f64>; 2] {
        match self.values {
            FigureValues::Pair(of) => [of(summary); 2],
            FigureValues::Gears(of) | FigureValues::States(of) => of(summary),
        }
    }

    /// Errors that a run states of both; `None` where one is not known.
    pub fn both_errors(&self, total: &TotalError) -> [Option<f64>; 2] {
        let of = |path: &str| (STATED_ERRORS.iter().find(|error| error.name == path)?.of)(total);
        let [one, other] = self.errors.map(of);
        match self.values {
            FigureValues::Pair(_) if self.errors[1].is_empty() => [one; 2],
            FigureValues::Pair(_) => [one.zip(other).map(|(one, other)| one.max(other)); 2],
            FigureValues::Gears(_) | FigureValues::States(_) => [one, other],
        }
    }

    /// Names of what the two values are of; none of a figure of the pair.
    fn sides(&self) -> &'static [&'static str] {
        match self.values {
            FigureValues::Pair(_) => &[""],
            FigureValues::Gears(_) => &["pinion", "wheel"],
            FigureValues::States(_) => &["new", "worn"],
        }
    }

    fn figure(&'static self, side: usize) -> MainFigure {
        let name = self.sides()[side];
        let of_side = |text: &str| text.replace("{gear}", name).replace("{state}", name);
        let heading = match self.values {
            FigureValues::Pair(_) => self.words.to_owned(),
            FigureValues::Gears(_) => self.words.replace("{}", &format!(" of the {name}")),
            FigureValues::States(_) => format!("{}, {name}", self.words),
        };
        let custom = match self.rexs {
            Some(RexsAttribute::Own(name)) => of_side(name),
            Some(RexsAttribute::Database { .. }) | None => String::new(),
        };
        MainFigure {
            name: of_side(self.path),
            heading,
            meaning: of_side(self.meaning),
            // Older names were columns of sweeps.
            former: if self.sweep_column[side] > 0 { of_side(self.former) } else { String::new() },
            own_attribute: custom,
            family: self,
            side,
        }
    }
}

fn with_unit(text: &str, unit: &str) -> String {
    if unit.is_empty() { text.to_owned() } else { format!("{text}, {unit}") }
}

/// A main figure of a run.
#[derive(Debug)]
pub struct MainFigure {
    /// Path in the summary.
    pub name: String,
    /// Short heading, lower case, without unit: `maximum wear of the pinion, active profile`.
    pub heading: String,
    /// Meaning of the value, in a phrase.
    pub meaning: String,
    former: String,
    /// Name of its attribute in REXS behind the program's prefix; empty where it has none of its own.
    pub own_attribute: String,
    /// Line of the catalogue.
    pub family: &'static FigureFamily,
    side: usize,
}

impl PartialEq for MainFigure {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl MainFigure {
    /// Unit; empty for a ratio.
    pub fn unit(&self) -> &'static str {
        self.family.unit
    }

    /// The gear that it is of; `None` of the pair and of states.
    pub fn gear(&self) -> Option<Gear> {
        matches!(self.family.values, FigureValues::Gears(_)).then(|| Gear::BOTH[self.side])
    }

    /// Heading and unit: `line load, N/mm`.
    pub fn with_unit(&self) -> String {
        with_unit(&self.heading, self.unit())
    }

    /// Value in a summary; `None` where the scene does not compute it.
    pub fn value(&self, summary: &Summary) -> Option<f64> {
        self.family.both(summary)[self.side]
    }

    /// Paths of the errors that a run states of it; none where it states none.
    pub fn error_paths(&self) -> impl Iterator<Item = &'static str> + '_ {
        let of_pair = matches!(self.family.values, FigureValues::Pair(_));
        let paths = self.family.errors.iter().enumerate();
        paths.filter(move |(side, path)| (of_pair || *side == self.side) && !path.is_empty()).map(|(_, path)| *path)
    }

    /// Relative error that a run states of it; `None` where it is not known.
    pub fn error(&self, total: &TotalError) -> Option<f64> {
        self.family.both_errors(total)[self.side]
    }

    /// Depth in a row of the history; `None` where the history has none.
    pub fn depth_of_history(&self) -> Option<DepthOfHistory> {
        self.family.history[self.side]
    }
}

static ALL: LazyLock<Vec<MainFigure>> = LazyLock::new(|| {
    FAMILIES.iter().flat_map(|family| (0..family.sides().len()).map(|side| family.figure(side))).collect()
});
static IN_SWEEPS: LazyLock<Vec<&'static MainFigure>> = LazyLock::new(|| numbered(|family| family.sweep_column));
static DEFAULT_OUTPUTS: LazyLock<Vec<&'static MainFigure>> = LazyLock::new(|| numbered(|family| family.default_output));
static COMPARED: LazyLock<Vec<&'static MainFigure>> = LazyLock::new(|| numbered(|family| family.compared_row));

/// The figures that have a number, in their order.
fn numbered(numbers: fn(&FigureFamily) -> [u8; 2]) -> Vec<&'static MainFigure> {
    let number = |figure: &MainFigure| numbers(figure.family)[figure.side];
    let mut figures: Vec<&MainFigure> = ALL.iter().filter(|figure| number(figure) > 0).collect();
    figures.sort_by_key(|figure| number(figure));
    figures
}

/// All main figures.
pub fn all() -> &'static [MainFigure] {
    &ALL
}

/// Figures that a sweep keeps of each run, in the order of its columns.
pub fn in_sweeps() -> &'static [&'static MainFigure] {
    &IN_SWEEPS
}

/// Figures that a study of uncertainty keeps where no outputs are asked for.
pub fn default_outputs() -> &'static [&'static MainFigure] {
    &DEFAULT_OUTPUTS
}

/// Figures that finished runs are compared by, in the order of the rows.
pub fn compared() -> &'static [&'static MainFigure] {
    &COMPARED
}

/// The figure of this name; also by the name that it had in the version before.
pub fn find(name: &str) -> Option<&'static MainFigure> {
    let of_name = |figure: &&MainFigure| figure.name == name || !name.is_empty() && figure.former == name;
    ALL.iter().find(of_name)
}

/// The present name of a figure that was called `given` in the version before.
pub fn name_now(given: &str) -> Option<&'static str> {
    find(given).filter(|figure| figure.name != given).map(|figure| figure.name.as_str())
}

/// Notes for a user who calls figures by names of the version before.
pub fn notes<'a>(given: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let former = given.into_iter().filter_map(|name| Some((name, name_now(name)?)));
    former
        .map(|(name, now)| format!("{name} is now called {now}; the next version does not know the older name"))
        .collect()
}

/// The greatest wear of either gear, which sweeps know and no summary has.
pub fn peak_wear_of_either() -> &'static MainFigure {
    static FIGURE: LazyLock<&'static MainFigure> =
        LazyLock::new(|| find(PEAK_WEAR_OF_EITHER).expect("the catalogue has it"));
    &FIGURE
}

/// Name of the greatest wear of either gear.
pub const PEAK_WEAR_OF_EITHER: &str = "peak_wear_um";

const PEAK_WEAR_ERRORS: [&str; 2] = ["error.total.peak_wear.pinion", "error.total.peak_wear.wheel"];

const fn pair(
    path: &'static str,
    unit: &'static str,
    words: &'static str,
    of: fn(&Summary) -> Option<f64>,
) -> FigureFamily {
    FigureFamily::new(path, unit, words, FigureValues::Pair(of))
}

const fn gears(
    path: &'static str,
    unit: &'static str,
    words: &'static str,
    of: fn(&Summary) -> [Option<f64>; 2],
) -> FigureFamily {
    FigureFamily::new(path, unit, words, FigureValues::Gears(of))
}

const fn states(
    path: &'static str,
    unit: &'static str,
    words: &'static str,
    of: fn(&Summary) -> [Option<f64>; 2],
) -> FigureFamily {
    FigureFamily::new(path, unit, words, FigureValues::States(of))
}

fn wear(summary: &Summary, of: fn(&WearSummary) -> f64) -> [Option<f64>; 2] {
    [&summary.pinion, &summary.wheel].map(|gear| Some(of(gear)))
}

fn cycle(summary: &Summary, of: fn(&CycleSummary) -> f64) -> [Option<f64>; 2] {
    [&summary.new, &summary.worn].map(|state| Some(of(state)))
}

fn over_torque(summary: &Summary, of: fn(&TorqueCurveState) -> Option<f64>) -> [Option<f64>; 2] {
    let curve = summary.transmission_error_over_torque.as_ref();
    [curve.and_then(|curve| of(&curve.new)), curve.and_then(|curve| of(&curve.worn))]
}

fn over_width(summary: &Summary, of: fn(&OverWidthSummary) -> f64) -> [Option<f64>; 2] {
    let wear = summary.helical.as_ref().map(|helical| &helical.wear);
    [wear.map(|wear| of(&wear.pinion)), wear.map(|wear| of(&wear.wheel))]
}

/// The catalogue, in the order of tables.
pub static FAMILIES: &[FigureFamily] = &[
    pair("geometry.transverse_contact_ratio", "", "transverse contact ratio", |s| {
        Some(s.geometry.transverse_contact_ratio)
    })
    .means("ε_α")
    .once_called("transverse_contact_ratio")
    .in_sweeps([1, 0]),
    pair("geometry.overlap_ratio", "", "overlap ratio", |s| Some(s.geometry.overlap_ratio))
        .means("ε_β")
        .once_called("overlap_ratio")
        .in_sweeps([2, 0]),
    pair("helical.total_contact_ratio", "", "total contact ratio", |s| Some(s.helical.as_ref()?.total_contact_ratio))
        .means("ε_γ = ε_α + ε_β; empty for a spur pair")
        .once_called("total_contact_ratio")
        .in_sweeps([22, 0]),
    pair("contact.line_load_N_per_mm", "N/mm", "line load", |s| Some(s.contact.line_load_N_per_mm))
        .means("whole torque over the pinion's base radius and the face width")
        .own_attribute("line_load")
        .once_called("line_load_N_per_mm")
        .in_sweeps([3, 0]),
    pair("contact.hertz_peak_pressure_MPa", "MPa", "Hertz pressure at C", |s| Some(s.contact.hertz_peak_pressure_MPa))
        .means("maximum pressure of Hertz's contact at the pitch point under the whole load")
        .own_attribute("hertzian_pressure_at_pitch_point"),
    states("{state}.flank_pressure_MPa", "MPa", "flank pressure", |s| cycle(s, |c| c.flank_pressure_MPa))
    .with_errors(["error.total.flank_pressure.new", "error.total.flank_pressure.worn"])
    .means("maximum pressure between the tip-edge zones, {state}")
    .of_slices(OverSlices::Maximum)
    .own_attribute("flank_pressure_{state}")
    .wants_less()
    .in_headline()
    .in_sweeps([12, 13])
    .compared([11, 10]),
    states("{state}.tip_edge_line_load_N_per_mm", "N/mm", "line load of a tip edge", |s| {
        cycle(s, |c| c.tip_edge_line_load_N_per_mm)
    })
    .means("greatest line load of a contact that reaches a tip edge, {state}")
    .of_slices(OverSlices::Maximum)
    .own_attribute("tip_edge_line_load_{state}")
    .wants_less()
    .on_page()
    .in_sweeps([14, 15])
    .compared([13, 12]),
    states("{state}.tip_edge_mean_pressure_MPa", "MPa", "pressure of a tip edge over 0.04 mm", |s| {
        cycle(s, |c| c.tip_edge_mean_pressure_MPa)
    })
    .means("greatest pressure of such a contact as a mean over 0.04 mm, {state}")
    .of_slices(OverSlices::Maximum)
    .own_attribute("tip_edge_mean_pressure_{state}")
    .wants_less()
    .on_page()
    .in_sweeps([16, 17])
    .compared([15, 14]),
    FigureFamily {
        caveat: "not converged",
        ..states("{state}.peak_pressure_MPa", "MPa", "maximum pressure at a point", |s| cycle(s, |c| c.peak_pressure_MPa))
    }
    .means(
        "maximum pressure at a single point, which depends on the resolution at tip edges and kinks of a relief; sharp tip edges under load \
         apart, {state}",
    )
    .of_slices(OverSlices::Maximum)
    .once_called("peak_pressure_{state}_MPa")
    .on_page()
    .in_sweeps([18, 19])
    .compared([17, 16]),
    FigureFamily {
        caveat: "not defined",
        ..states("{state}.sharp_edge_pressure_MPa", "MPa", "pressure at sharp edges", |s| {
            [s.new.sharp_edge_pressure_MPa, s.worn.sharp_edge_pressure_MPa]
        })
    }
    .means("maximum pressure found at a sharp tip edge under load, which grows with every refinement, {state}; empty where there is none")
    .of_slices(OverSlices::MaximumOfAll)
    .shown(),
    states("{state}.pitch_pressure_MPa", "MPa", "pressure at the pitch point", |s| cycle(s, |c| c.pitch_pressure_MPa))
        .means("maximum pressure with the theoretical contact point at C, {state}")
        .of_slices(OverSlices::MaximumOfAll)
        .shown(),
    FigureFamily {
        default_output: [0, 5],
        ..states("{state}.transmission_error_um.peak_to_peak", "µm", "transmission error, peak to peak", |s| {
            cycle(s, |c| c.transmission_error_um.peak_to_peak)
        })
    }
    .means("of the loaded pair over the cycle, along the line of action, {state}")
    .with_errors(["error.total.transmission_error_peak_to_peak_new", "error.total.transmission_error_peak_to_peak"])
    .own_attribute("peak_to_peak_transmission_error_{state}")
    .once_called("transmission_error_peak_to_peak_{state}_um")
    .wants_less()
    .in_headline()
    .in_sweeps([20, 21])
    .compared([8, 7]),
    pair("transmission_error_over_life.mean_um", "µm", "transmission error, mean over life", |s| {
        Some(s.transmission_error_over_life?.mean_um)
    })
    .means("mean of the peak-to-peak values over the revolutions of the run, each phase under its own load")
    .with_errors(["error.total.transmission_error_over_life", ""])
    .wants_less()
    .shown()
    .in_sweeps([44, 0])
    .compared([9, 0]),
    pair("transmission_error_over_life.max_um", "µm", "transmission error, maximum over life", |s| {
        Some(s.transmission_error_over_life?.max_um)
    })
    .means("maximum of the peak-to-peak values of all wear steps, each phase under its own load")
    .wants_less()
    .on_page(),
    states("transmission_error_over_torque.{state}.mean_um", "µm", "transmission error over torque, mean", |s| {
        over_torque(s, |of| of.mean_um)
    })
    .means("mean of the peak-to-peak values under the torques of operation.torque_curve_Nm, {state}; empty without torques")
    .wants_less()
    .on_page(),
    states("transmission_error_over_torque.{state}.max_um", "µm", "transmission error over torque, maximum", |s| {
        over_torque(s, |of| of.max_um)
    })
    .means("maximum of the peak-to-peak values under the torques of operation.torque_curve_Nm, {state}; empty without torques")
    .wants_less()
    .on_page(),
    states("{state}.mesh_orders_um.1", "µm", "transmission error, first mesh order", |s| {
        [s.new.mesh_orders_um.first().copied(), s.worn.mesh_orders_um.first().copied()]
    })
    .means("amplitude of the transmission error at the mesh frequency, {state}")
    .wants_less()
    .shown()
    .in_sweeps([42, 43]),
    states("{state}.transmission_error_um.min", "µm", "transmission error, minimum", |s| {
        cycle(s, |c| c.transmission_error_um.min)
    })
    .means("least of the loaded pair over the cycle, along the line of action, {state}")
    .on_page(),
    states("{state}.transmission_error_um.max", "µm", "transmission error, maximum", |s| {
        cycle(s, |c| c.transmission_error_um.max)
    })
    .means("greatest of the loaded pair over the cycle, along the line of action, {state}")
    .on_page(),
    pair(PEAK_WEAR_OF_EITHER, "µm", "maximum wear of either gear", |s| {
        Some(s.pinion.peak_wear_um.max(s.wheel.peak_wear_um))
    })
    .means("maximum wear depth on the active profiles of both gears, their tip edges apart")
    .of_slices(OverSlices::Maximum)
    .with_errors(PEAK_WEAR_ERRORS)
    .wants_less()
    .in_sweeps([38, 0]),
    FigureFamily {
        history: [Some(|row| row.pinion_peak_wear_um), Some(|row| row.wheel_peak_wear_um)],
        default_output: [1, 2],
        ..gears("{gear}.peak_wear_um", "µm", "maximum wear{}, active profile", |s| wear(s, |w| w.peak_wear_um))
    }
    .means("maximum wear depth on the {gear}'s active profile, its tip edge apart")
    .of_slices(OverSlices::Maximum)
    .with_errors(PEAK_WEAR_ERRORS)
    .own_attribute("maximum_wear_depth")
    .once_called("{gear}_peak_wear_um")
    .wants_less()
    .in_headline()
    .in_sweeps([4, 8])
    .compared([1, 2]),
    gears("{gear}.peak_wear_radius_mm", "mm", "radius of the maximum wear{}", |s| wear(s, |w| w.peak_wear_radius_mm))
        .means("distance from the {gear}'s axis of the maximum wear depth on its active profile")
        .of_slices(OverSlices::AtMaximum)
        .shown(),
    FigureFamily {
        history: [Some(|row| row.pinion_tip_edge_wear_um), Some(|row| row.wheel_tip_edge_wear_um)],
        default_output: [3, 4],
        ..gears("{gear}.tip_edge_wear_um", "µm", "maximum wear{}, tip edge", |s| wear(s, |w| w.tip_edge_wear_um))
    }
    .means("maximum wear depth at the {gear}'s tip edge")
    .of_slices(OverSlices::Maximum)
    .with_errors(["error.total.tip_edge_wear.pinion", "error.total.tip_edge_wear.wheel"])
    .own_attribute("maximum_wear_depth_tip_edge")
    .once_called("{gear}_tip_edge_wear_um")
    .wants_less()
    .shown()
    .in_sweeps([34, 35])
    .compared([3, 4]),
    FigureFamily {
        history: [Some(|row| row.pinion_below_sap_wear_um), Some(|row| row.wheel_below_sap_wear_um)],
        ..gears("{gear}.below_sap_wear_um", "µm", "maximum wear{}, below the active profile", |s| {
            wear(s, |w| w.below_sap_wear_um)
        })
    }
    .means("maximum wear depth below the start of active profile")
    .of_slices(OverSlices::Maximum)
    .own_attribute("maximum_wear_depth_below_start_of_active_profile")
    .once_called("{gear}_below_sap_wear_um")
    .wants_less()
    .shown()
    .in_sweeps([36, 37])
    .compared([5, 6]),
    FigureFamily {
        history: [Some(|row| row.pinion_root_wear_um), None],
        ..gears("{gear}.root_wear_um", "µm", "maximum wear{}, root zone", |s| wear(s, |w| w.root_wear_um))
    }
    .means("maximum wear depth in the first 2 mm of radius above the start of active profile")
    .of_slices(OverSlices::Maximum)
    .own_attribute("maximum_wear_depth_root")
    .once_called("{gear}_root_wear_um")
    .wants_less()
    .shown()
    .in_sweeps([5, 9]),
    FigureFamily {
        history: [Some(|row| row.pinion_pitch_wear_um), None],
        ..gears("{gear}.pitch_wear_um", "µm", "wear{} at the pitch circle", |s| wear(s, |w| w.pitch_wear_um))
    }
    .means("wear depth at the working pitch circle")
    .of_slices(OverSlices::Mean)
    .own_attribute("wear_depth_at_pitch_diameter")
    .once_called("{gear}_pitch_wear_um")
    .wants_less()
    .shown()
    .in_sweeps([6, 10]),
    gears("{gear}.worn_volume_mm3", "mm³", "worn volume{}", |s| wear(s, |w| w.worn_volume_mm3))
        .means("worn off the whole {gear}: all teeth, whole width")
        .of_slices(OverSlices::Sum)
        .once_called("{gear}_worn_volume_mm3")
        .wants_less()
        .on_page()
        .in_sweeps([7, 11])
        .compared([18, 19]),
    FigureFamily {
        rexs: Some(RexsAttribute::Database { ids: &[RexsId::always("averaged_linear_wear_vdi_2736_2014")], unit: "mm" }),
        ..gears("{gear}.vdi_2736_mean_wear_um", "µm", "mean wear W_m{}, VDI 2736-2", |s| {
            [s.pinion.vdi_2736_mean_wear_um, s.wheel.vdi_2736_mean_wear_um]
        })
    }
    .means("of an unchanged flank; empty where neither gear is a plastic, or the wear law is more than a coefficient")
    .on_page(),
    gears("{gear}.peak_over_vdi_2736_mean_wear", "", "maximum wear over W_m{}", |s| {
        [s.pinion.peak_over_vdi_2736_mean_wear, s.wheel.peak_over_vdi_2736_mean_wear]
    })
    .means("maximum wear depth over the mean wear of VDI 2736-2")
    .of_slices(OverSlices::Maximum)
    .on_page(),
    gears("{gear}.worn_mass_mg", "mg", "worn mass{}", |s| wear(s, |w| w.worn_mass_mg))
        .means("worn off the whole {gear}: all teeth, whole width")
        .of_slices(OverSlices::Sum)
        .own_attribute("wear_mass")
        .shown(),
    gears("{gear}.normal_tip_thickness_mm", "mm", "normal tooth thickness{} at the tip, worn", |s| {
        wear(s, |w| w.normal_tip_thickness_mm)
    })
    .means("what is left of it at the {gear}'s tip cylinder, reliefs and roundings not taken off")
    .of_slices(OverSlices::Minimum)
    .on_page(),
    gears("helical.wear.{gear}.root_variation", "", "variation of root wear{} over the width", |s| {
        over_width(s, |w| w.root_variation)
    })
    .means("maximum less minimum root wear of the slices, over its mean; empty where there are no slices")
    .of_slices(OverSlices::Spread)
    .once_called("{gear}_root_wear_variation")
    .wants_less()
    .shown()
    .in_sweeps([23, 26]),
    gears("helical.wear.{gear}.tip_variation", "", "variation of tip wear{} over the width", |s| {
        over_width(s, |w| w.tip_variation)
    })
    .means("maximum less minimum tip wear of the slices, over its mean; empty where there are no slices")
    .of_slices(OverSlices::Spread)
    .once_called("{gear}_tip_wear_variation")
    .wants_less()
    .shown()
    .in_sweeps([24, 27]),
    gears("helical.wear.{gear}.root_tip_variation", "", "variation of root and tip wear{}", |s| {
        over_width(s, |w| w.root_tip_variation)
    })
    .means("maximum less minimum wear of root and tip of all slices, over its mean; empty where there are no slices")
    .of_slices(OverSlices::Spread)
    .once_called("{gear}_root_tip_wear_variation")
    .wants_less()
    .shown()
    .in_sweeps([25, 28]),
    gears("helical.wear.{gear}.root_asymmetry", "", "asymmetry of root wear{}", |s| over_width(s, |w| w.root_asymmetry))
        .means("first less last slice over their sum; empty where there are no slices")
        .of_slices(OverSlices::Spread)
        .once_called("{gear}_root_wear_asymmetry")
        .on_page()
        .in_sweeps([29, 0]),
    states("helical.K_Hbeta_{state}", "", "face load factor K_Hβ", |s| {
        let helical = s.helical.as_ref();
        [helical.map(|helical| helical.K_Hbeta_new), helical.map(|helical| helical.K_Hbeta_worn)]
    })
    .means("maximum over mean of the slices' loads, {state}; empty where there are no slices")
    .of_slices(OverSlices::Spread)
    .once_called("K_Hbeta_{state}")
    .wants_less()
    .shown()
    .in_sweeps([30, 31])
    .compared([20, 21]),
    states("helical.mesh_orders_{state}_um.1", "µm", "transmission error of slices, first mesh order", |s| {
        let first = |orders: fn(&Summary) -> Option<&Vec<f64>>| orders(s)?.first().copied();
        [
            first(|s| Some(&s.helical.as_ref()?.mesh_orders_new_um)),
            first(|s| Some(&s.helical.as_ref()?.mesh_orders_worn_um)),
        ]
    })
    .means("amplitude at the mesh frequency, {state}; empty where there are no slices")
    .once_called("mesh_order_1_{state}_um")
    .wants_less()
    .in_sweeps([32, 33]),
    pair("error.volume_balance", "", "difference of the worn volumes of pinion and wheel", |s| s.error.volume_balance)
        .means(
            "relative to the greater, over the whole run: an error, as both flanks of a contact lose the same; empty where nothing wears",
        )
        .once_called("volume_balance")
        .in_sweeps([39, 0]),
    pair("life.hours", "h", "life", |s| s.life.as_ref()?.hours)
        .means("until the first limit of operation.stop is reached; empty where none is within the duration")
        .once_called("life_h")
        .in_sweeps([40, 0])
        .compared([22, 0]),
    pair("life.revolutions", "pinion revolutions", "life", |s| s.life.as_ref()?.revolutions)
        .means("the same in pinion revolutions")
        .once_called("life_revolutions")
        .in_sweeps([41, 0])
        .compared([23, 0]),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Names, former names and numbers of columns and rows stand for one figure each, and numbers leave nothing out.
    #[test]
    fn every_figure_has_names_and_numbers_of_its_own() {
        for (at, figure) in all().iter().enumerate() {
            for name in [&figure.name, &figure.former].into_iter().filter(|name| !name.is_empty()) {
                let found: Vec<usize> = (0..all().len())
                    .filter(|&other| [&all()[other].name, &all()[other].former].contains(&name))
                    .collect();
                assert_eq!(found, [at], "{name}");
            }
            assert!(!figure.meaning.is_empty() && !figure.heading.contains('{'), "{}", figure.name);
        }
        let all_numbers: [fn(&FigureFamily) -> [u8; 2]; 3] =
            [|family| family.sweep_column, |family| family.compared_row, |family| family.default_output];
        for numbers in all_numbers {
            let mut given: Vec<u8> = FAMILIES.iter().flat_map(numbers).filter(|number| *number > 0).collect();
            given.sort_unstable();
            assert!(given.iter().copied().eq(1..=given.len() as u8), "{given:?}");
        }
    }

    #[test]
    fn errors_of_figures_are_stated() {
        for path in all().iter().flat_map(MainFigure::error_paths) {
            assert!(STATED_ERRORS.iter().any(|error| error.name == path), "{path}");
        }
        let mut total = TotalError::none("");
        total.peak_wear.pinion = Some(0.01);
        let error_of = |name: &str, total: &TotalError| find(name).and_then(|figure| figure.error(total));
        assert_eq!(error_of("pinion.peak_wear_um", &total), Some(0.01));
        assert_eq!(error_of(PEAK_WEAR_OF_EITHER, &total), None);
        total.peak_wear.wheel = Some(0.02);
        assert_eq!(error_of(PEAK_WEAR_OF_EITHER, &total), Some(0.02));
        assert_eq!(error_of("pinion.root_wear_um", &total), None);
    }

    /// Each stated error is the number at its path: here every number of `error.total` is another.
    #[test]
    fn stated_errors_are_the_numbers_at_their_paths() {
        let mut summary = serde_json::json!({ "error": { "total": TotalError::none("") } });
        for (number, error) in STATED_ERRORS.iter().enumerate() {
            let pointer = format!("/{}", error.name.replace('.', "/"));
            *summary.pointer_mut(&pointer).unwrap_or_else(|| panic!("no {}", error.name)) =
                (0.5 + number as f64).into();
        }
        let total: TotalError = serde_json::from_value(summary["error"]["total"].take()).unwrap();
        for (number, error) in STATED_ERRORS.iter().enumerate() {
            assert_eq!((error.of)(&total), Some(0.5 + number as f64), "{}", error.name);
        }
    }

    #[test]
    fn older_names_are_read_with_a_note() {
        let given = ["pinion.peak_wear_um", "transmission_error_peak_to_peak_worn_um", "no such"];
        assert_eq!(find(given[1]).map(|figure| figure.name.as_str()), Some("worn.transmission_error_um.peak_to_peak"));
        assert_eq!(
            notes(given),
            [format!(
                "{} is now called {}; the next version does not know the older name",
                given[1], "worn.transmission_error_um.peak_to_peak"
            )]
        );
        assert_eq!(find(""), None);
    }
}
