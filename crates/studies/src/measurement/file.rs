//! The file of a measured profile.
//!
//! ```text
//! # gear = pinion
//! # hours = 31.75
//! # uncertainty_um = 0.3
//! # arc_from = start-of-active-profile
//! arc_mm,height_um
//! 0.00,-3.10
//! 0.01,-3.24
//! ```
//!
//! Lines that begin with # come first; those of the form `key = value` describe the measurement:
//!
//! | key | meaning |
//! |---|---|
//! | `gear` | `pinion` or `wheel` |
//! | `hours`, `revolutions` | time of the measurement, revolutions of the pinion; left out: end of the run |
//! | `width_mm` | place over the face width, for runs with slices |
//! | `uncertainty_um` | standard deviation of a height, for comparison with the scatter |
//! | `arc_from` | beginning of `arc_mm`: `base-circle`, `start-of-active-profile`, or `tip` (towards the root) |
//! | `height_from` | reference of the heights: `involute` (the nominal one, along its normal) or `line` (as a stylus on a
//! straight guide measures them, with the curvature of the tooth in them); left out: `involute` |
//!
//! Other lines with # are remarks. One column is the place on the flank: `radius_mm`, `arc_mm` (length along the flank) or
//! `roll_angle_deg`; another one the height `height_um` or `height_mm`, which falls where material is gone, or `wear_um` or
//! `wear_mm`, which rises there (a difference of profiles before and after). Columns stand in any order; places increase from row
//! to row.

use gearwear_bodies::gear::Gear;
use gearwear_files::data_table::{DataTable, DataTableError, finite, missing, not_allowed, positive};

/// Names of the columns that may give the place.
const PLACES: [(&str, PlaceColumn); 3] = [
    ("radius_mm", PlaceColumn::RadiusMm),
    ("arc_mm", PlaceColumn::ArcMm),
    ("roll_angle_deg", PlaceColumn::RollAngleDeg),
];
/// Names of the columns that may give the height, and µm of height per unit.
const VALUES: [(&str, ValueKind, f64); 4] = [
    ("height_um", ValueKind::Height, 1.0),
    ("height_mm", ValueKind::Height, UM_PER_MM),
    ("wear_um", ValueKind::Wear, -1.0),
    ("wear_mm", ValueKind::Wear, -UM_PER_MM),
];
const KEYS: [&str; 7] = ["gear", "hours", "revolutions", "width_mm", "uncertainty_um", "arc_from", "height_from"];
const UM_PER_MM: f64 = 1e3;
/// Similarity to a known key (Jaro and Winkler's measure) above which a key is taken for a misspelling.
const SLIP: f64 = 0.85;

/// Column that gives the place of a point on the flank.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PlaceColumn {
    /// Distance from the axis.
    #[default]
    RadiusMm,
    /// Length along the flank.
    ArcMm,
    /// Roll angle of the transverse involute.
    RollAngleDeg,
}

impl PlaceColumn {
    /// Name in the file.
    pub fn name(self) -> &'static str {
        match self {
            PlaceColumn::RadiusMm => "radius_mm",
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
    /// Kind of the heights.
    pub kind: ValueKind,
    /// The points.
    pub rows: Vec<MeasuredRow>,
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

/// Reads the text of a file.
pub fn parse(text: &str) -> Result<MeasuredFile, DataTableError> {
    let table = DataTable::read(text, columns_allowed)?;
    let mut file = MeasuredFile::default();
    for &(line, key, value) in &table.keys {
        file.take(line, key, value)?;
    }
    let columns = ProfileColumns::find(table.names.0, &table.names.1)?;
    if columns.place == PlaceColumn::ArcMm && file.arc_from.is_none() {
        return Err(missing(
            "where arc_mm begins",
            "a line \"# arc_from = base-circle\", \"start-of-active-profile\" or \"tip\"".to_owned(),
        ));
    }
    (file.place, file.kind) = (columns.place, columns.kind);
    for (line, fields) in &table.rows {
        let point = columns.point(*line, fields)?;
        if let Some(before) = file.rows.last().filter(|before| before.place >= point.place) {
            let allowed =
                format!("more than {} of line {}: places increase from row to row", before.place, before.line);
            return Err(not_allowed(*line, columns.place.name(), point.place, allowed));
        }
        file.rows.push(point);
    }
    Ok(file)
}

/// Columns of the place and the height.
struct ProfileColumns {
    count: usize,
    place: PlaceColumn,
    place_index: usize,
    kind: ValueKind,
    value_name: &'static str,
    value_index: usize,
    um_per_unit: f64,
}

impl ProfileColumns {
    fn find(line: usize, names: &[&str]) -> Result<Self, DataTableError> {
        let places: Vec<_> = PLACES.iter().filter_map(|(name, column)| Some((index(names, name)?, *column))).collect();
        let values: Vec<_> = VALUES.iter().filter_map(|value| Some((index(names, value.0)?, value))).collect();
        let (&[(place_index, place)], &[(value_index, &(value_name, kind, um_per_unit))]) = (&places[..], &values[..])
        else {
            return Err(not_allowed(line, "column names", names.join(","), columns_allowed()));
        };
        Ok(Self { count: names.len(), place, place_index, kind, value_name, value_index, um_per_unit })
    }

    fn point(&self, line: usize, fields: &[&str]) -> Result<MeasuredRow, DataTableError> {
        if fields.len() != self.count {
            let allowed = format!("{}, as there are columns; decimals are written with a point", self.count);
            return Err(not_allowed(line, "number of fields", fields.len(), allowed));
        }
        let place = finite(line, self.place.name(), fields[self.place_index])?;
        let value = finite(line, self.value_name, fields[self.value_index])?;
        Ok(MeasuredRow { line, place, height_um: value * self.um_per_unit })
    }
}

impl MeasuredFile {
    fn take(&mut self, line: usize, key: &str, value: &str) -> Result<(), DataTableError> {
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
            _ => {
                if let Some(meant) = KEYS.iter().find(|known| strsim::jaro_winkler(known, key) > SLIP) {
                    return Err(not_allowed(line, "key", key, format!("{meant}, or a remark without =")));
                }
            }
        }
        Ok(())
    }
}

/// Place of the column `name` among `names`.
fn index(names: &[&str], name: &str) -> Option<usize> {
    names.iter().position(|&own| own == name)
}

fn columns_allowed() -> String {
    format!(
        "names with units, separated by commas: one of {}, and one of {}",
        PLACES.map(|(name, _)| name).join(", "),
        VALUES.map(|(name, ..)| name).join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_in_any_order_and_units_of_both_kinds() {
        let text = "# a remark\n# gear = wheel\n# hours = 2\nwear_um,note,roll_angle_deg\n1.5,a,10\n2,b,10.5\n";
        let file = parse(text).unwrap();
        assert_eq!(
            (file.gear, file.moment, file.place),
            (Some(Gear::Wheel), Moment::Hours(2.0), PlaceColumn::RollAngleDeg)
        );
        let points: Vec<_> = file.rows.iter().map(|row| (row.line, row.place, row.height_um)).collect();
        assert_eq!(points, [(5, 10.0, -1.5), (6, 10.5, -2.0)]);
        let in_mm = parse("radius_mm,height_mm\n34,-0.002\n").unwrap();
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
            let message = parse(text).unwrap_err().to_string();
            assert!(message.starts_with(line) && message.contains(&format!("found {found}")), "{text}: {message}");
            assert!(message.contains("allowed: "), "{message}");
        }
        for text in ["", "# only remarks\n", "arc_mm,height_um\n1,2\n"] {
            assert!(matches!(parse(text), Err(DataTableError::Missing { .. })), "{text}");
        }
    }
}
