//! The file of a measured flank.
//!
//! | format | module |
//! |---|---|
//! | table of columns, with lines `# key = value` | [`super::table`] |
//! | text export of curves of a gear measuring machine, `.mka` | [`super::mka`] |
//!
//! A file holds traces: profiles, from root to tip in a transverse section, and leads, over the face width on a cylinder; of one tooth or of
//! several, of left flanks or of right ones. What is taken is the mean profile of the teeth chosen ([`super::teeth`]).
//!
//! The header of a table describes the measurement:
//!
//! | key | meaning |
//! |---|---|
//! | `gear` | `pinion` or `wheel` |
//! | `hours`, `revolutions` | time of the measurement, revolutions of the pinion; left out: end of the run |
//! | `width_mm` | place over the face width, for runs with slices |
//! | `uncertainty_um` | standard deviation of a height, for comparison with the scatter |
//! | `arc_from` | beginning of lengths along the flank: `base-circle`, `start-of-active-profile`, or `tip` (towards the root) |
//! | `height_from` | reference of the heights: `involute` (the nominal one, along its normal) or `line` (as a stylus on a
//! straight guide measures them, with the curvature of the tooth in them); left out: `involute` |
//! | `units` | units of the columns in their order, where their names have none |

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use gearwear_bodies::gear::{Gear, GearPair};
use gearwear_files::data_table::{DataTableError, finite, not_allowed, positive};

use super::teeth::{self, TraceChoice};
use super::{mka, table};

const KEYS: [&str; 8] =
    ["gear", "hours", "revolutions", "width_mm", "uncertainty_um", "arc_from", "height_from", "units"];
/// Similarity to a known key (Jaro and Winkler's measure) above which a key is taken for a misspelling.
const SLIP: f64 = 0.85;
/// Formats that can be read, as errors name them.
const FORMATS: &str =
    "a table of columns under their names, or the text export of curves (.mka) of a P40 gear measuring machine";

/// Column that gives the place of a point on the flank.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PlaceColumn {
    /// Distance from the axis.
    #[default]
    RadiusMm,
    /// Twice that.
    DiameterMm,
    /// Length along the flank.
    ArcMm,
    /// Roll angle of the transverse involute.
    RollAngleDeg,
    /// Radius of curvature of the transverse involute: roll angle times base radius.
    RollLengthMm,
}

impl PlaceColumn {
    /// Name in the file.
    pub fn name(self) -> &'static str {
        match self {
            PlaceColumn::RadiusMm => "radius_mm",
            PlaceColumn::DiameterMm => "diameter_mm",
            PlaceColumn::RollLengthMm => "roll_length_mm",
            PlaceColumn::ArcMm => "arc_mm",
            PlaceColumn::RollAngleDeg => "roll_angle_deg",
        }
    }
}

/// Kind of the heights of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ValueKind {
    /// Height of the surface.
    #[default]
    Height,
    /// Depth of the material removed.
    Wear,
}

/// Beginning of lengths along the flank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArcFrom {
    /// Base circle, where the involute begins.
    BaseCircle,
    /// Start of active profile.
    ActiveStart,
    /// The tip circle; lengths run towards the root.
    Tip,
}

/// Reference of heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HeightFrom {
    /// The nominal involute, along its normal.
    #[default]
    Involute,
    /// A straight line.
    Line,
}

/// Time of the measurement of a profile.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Moment {
    /// End of the run.
    #[default]
    End,
    /// After so many hours.
    Hours(f64),
    /// After so many revolutions of the pinion.
    Revolutions(f64),
}

/// Content of a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeasuredFile {
    /// Gear that was measured.
    pub gear: Option<Gear>,
    /// Time of the measurement.
    pub moment: Moment,
    /// Line of the key of that time; 0 where there is none.
    pub moment_line: usize,
    /// Place over the face width.
    pub width_mm: Option<f64>,
    /// Line of the key `width_mm`; 0 where there is none.
    pub width_line: usize,
    /// Standard deviation of a height.
    pub uncertainty_um: Option<f64>,
    /// Beginning of lengths along the flank.
    pub arc_from: Option<ArcFrom>,
    /// Reference of the heights.
    pub height_from: HeightFrom,
    /// Column of the places.
    pub place: PlaceColumn,
    /// What the file calls it.
    pub place_name: String,
    /// Kind of the heights.
    pub kind: ValueKind,
    /// Gear that a machine says it measured.
    pub machine_gear: Option<MachineGear>,
    /// The points: the mean of the profiles of all teeth that were chosen.
    pub rows: Vec<MeasuredRow>,
    /// Leads of the flank that was chosen.
    pub leads: Vec<Trace>,
    /// Heights of each tooth at the points less their mean, where there are several.
    pub teeth_um: Vec<Vec<f64>>,
}

/// What a machine's file says of its gear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MachineGear {
    /// Line of the number of teeth.
    pub line: usize,
    /// Number of teeth.
    pub teeth: u32,
    /// Base radius.
    pub base_radius_mm: f64,
}

/// Relative difference of base radii of one gear: machines give few decimals.
const SAME_SIZE: f64 = 1e-3;

impl MachineGear {
    /// Whether a gear of the pair has as many teeth.
    pub fn has_teeth_of(&self, pair: &GearPair, gear: Gear) -> bool {
        pair.spec.gears[gear].teeth == self.teeth
    }

    /// Whether it has the same base radius.
    pub fn has_size_of(&self, pair: &GearPair, gear: Gear) -> bool {
        (self.base_radius_mm / pair.teeth[gear].involute.base_radius_mm.abs() - 1.0).abs() <= SAME_SIZE
    }
}

/// Flank of a tooth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum FlankSide {
    /// Left flank, of a tooth that points upwards.
    Left,
    /// Right flank.
    Right,
}

impl FlankSide {
    /// Both.
    pub const BOTH: [FlankSide; 2] = [FlankSide::Left, FlankSide::Right];

    /// The flank of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::BOTH.into_iter().find(|side| side.name() == name)
    }

    /// Name on the command line and in scenes.
    pub fn name(self) -> &'static str {
        match self {
            FlankSide::Left => "left",
            FlankSide::Right => "right",
        }
    }
}

/// What runs along a trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TraceKind {
    /// A transverse section of the flank, from root to tip.
    Profile,
    /// A line over the face width.
    Lead,
}

/// A trace of one flank.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    pub kind: TraceKind,
    /// Number of the tooth, where the file says it.
    pub tooth: Option<u32>,
    /// Flank, where the file says it.
    pub side: Option<FlankSide>,
    /// Place over the face width of a profile.
    pub width_mm: Option<f64>,
    /// The points: of a profile in the unit of [`MeasuredFile::place`], of a lead by their place over the face width.
    pub points: Vec<MeasuredRow>,
}

/// A point of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredRow {
    /// Line in the file.
    pub line: usize,
    /// Place, in the unit of its column.
    pub place: f64,
    /// Height, µm, falling where material is gone.
    pub height_um: f64,
}

/// Reads the text of a file: its header, and the mean of the profiles in it that are chosen.
///
/// # Errors
/// The first thing that is wrong with the file, or a choice that is not one profile of a tooth.
pub fn parse(text: &str, choice: &TraceChoice) -> Result<MeasuredFile, DataTableError> {
    let (header, traces) = traces(text)?;
    teeth::mean(header, &traces, choice)
}

/// Header of a file and all its traces.
pub fn traces(text: &str) -> Result<(MeasuredFile, Vec<Trace>), DataTableError> {
    let text = text.trim_start_matches('\u{feff}');
    let begin = text.trim_start();
    let refused = |found: &str| Err(not_allowed(1, "format", found, FORMATS.to_owned()));
    match begin.split_whitespace().next() {
        _ if text.contains('\0') => refused("a binary file"),
        Some(first) if first.starts_with('<') => {
            refused("XML, as of the Gear Data Exchange format (GDE, VDI/VDE 2610)")
        }
        Some("HEADER") if begin.lines().next().is_some_and(|line| line.contains("KS.MW.FILE")) => {
            refused("the export of values (.mew) of a P40 gear measuring machine, which has no curves")
        }
        Some("HEADER") => mka::read(text),
        _ => table::read(text),
    }
}

impl MeasuredFile {
    /// Takes a line `# key = value`.
    pub(super) fn take(&mut self, line: usize, key: &str, value: &str) -> Result<(), DataTableError> {
        match key {
            "gear" => {
                let gear = Gear::BOTH.into_iter().find(|gear| gear.name() == value);
                self.gear = Some(gear.ok_or_else(|| not_allowed(line, key, value, "pinion or wheel".to_owned()))?);
            }
            "hours" | "revolutions" => {
                if self.moment != Moment::End {
                    return Err(not_allowed(line, key, value, "one of hours and revolutions, once".to_owned()));
                }
                let time = positive(line, key, value)?;
                self.moment = if key == "hours" { Moment::Hours(time) } else { Moment::Revolutions(time) };
                self.moment_line = line;
            }
            "width_mm" => {
                (self.width_mm, self.width_line) = (Some(finite(line, key, value)?), line);
            }
            "uncertainty_um" => self.uncertainty_um = Some(positive(line, key, value)?),
            "arc_from" => {
                self.arc_from = Some(match value {
                    "base-circle" => ArcFrom::BaseCircle,
                    "start-of-active-profile" => ArcFrom::ActiveStart,
                    "tip" => ArcFrom::Tip,
                    _ => {
                        let allowed = "base-circle, start-of-active-profile or tip".to_owned();
                        return Err(not_allowed(line, key, value, allowed));
                    }
                });
            }
            "height_from" => {
                self.height_from = match value {
                    "involute" => HeightFrom::Involute,
                    "line" => HeightFrom::Line,
                    _ => return Err(not_allowed(line, key, value, "involute or line".to_owned())),
                };
            }
            // Of the columns, which read it.
            "units" => {}
            _ => {
                if let Some(meant) = KEYS.iter().find(|known| strsim::jaro_winkler(known, key) > SLIP) {
                    return Err(not_allowed(line, "key", key, format!("{meant}, or a remark without =")));
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_in_any_order_and_units_of_both_kinds() {
        let text = "# a remark\n# gear = wheel\n# hours = 2\nwear_um,note,roll_angle_deg\n1.5,a,10\n2,b,10.5\n";
        let file = parse(text, &TraceChoice::default()).unwrap();
        assert_eq!(
            (file.gear, file.moment, file.place),
            (Some(Gear::Wheel), Moment::Hours(2.0), PlaceColumn::RollAngleDeg)
        );
        let points: Vec<_> = file.rows.iter().map(|row| (row.line, row.place, row.height_um)).collect();
        assert_eq!(points, [(5, 10.0, -1.5), (6, 10.5, -2.0)]);
        let in_mm = parse("radius_mm,height_mm\n34,-0.002\n", &TraceChoice::default()).unwrap();
        assert_eq!((in_mm.rows[0].height_um, in_mm.kind), (-2.0, ValueKind::Height));
    }

    /// Each wrong file is refused at its line, with what was found and what is allowed.
    #[test]
    fn wrong_files_are_refused_where_they_are_wrong() {
        for (text, line, found) in [
            ("radius,height\n1,2\n", "line 1", "radius,height"),
            ("radius_mm,height_nm\n1,2\n", "line 1", "radius_mm,height_nm"),
            ("34.0,1.0\n34.1,1.0\n", "line 1", "34.0,1.0"),
            ("radius_mm,arc_mm,height_um\n1,2,3\n", "line 1", "radius_mm,arc_mm"),
            ("radius_mm,height_um\n34,1\n34.1,NaN\n", "line 3", "NaN"),
            ("radius_mm,height_um\n34,1\n34.1,\n", "line 3", "nothing"),
            ("radius_mm,height_um\n34,1,5\n", "line 2", "3"),
            ("radius_mm,height_um\n34.2,1\n34.2,1\n", "line 3", "34.2"),
            ("# gear = rack\nradius_mm,height_um\n34,1\n", "line 1", "rack"),
            ("# hour = 3\nradius_mm,height_um\n34,1\n", "line 1", "hour"),
            ("# hours = -3\nradius_mm,height_um\n34,1\n", "line 1", "-3"),
            ("# hours = 3\n# revolutions = 3\nradius_mm,height_um\n34,1\n", "line 2", "3"),
        ] {
            let message = parse(text, &TraceChoice::default()).unwrap_err().to_string();
            assert!(message.starts_with(line) && message.contains(&format!("found {found}")), "{text}: {message}");
            assert!(message.contains("allowed: "), "{message}");
        }
        for text in ["", "# only remarks\n", "arc_mm,height_um\n1,2\n"] {
            assert!(matches!(parse(text, &TraceChoice::default()), Err(DataTableError::Missing { .. })), "{text}");
        }
    }
}
