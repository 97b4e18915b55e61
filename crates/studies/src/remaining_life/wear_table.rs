//! Table of wear measured at several times.
//!
//! ```text
//! # gear = pinion
//! hours;mass_loss_g;sigma
//! 120;1,40;0,05
//! 360;4,45;0,05
//! ```
//!
//! One column is the time, `hours` or `revolutions` (of the pinion). A row has one value: `mass_loss_g` or `mass_loss_mg` of the whole gear,
//! `depth_um`, the maximum wear depth of the active profile, or `profile`, the file of a measured profile. `gear`, `tooth`, and
//! `sigma`, the standard deviation of the value in its unit, may stand beside it. Rows of one gear, time and kind are teeth, or repetitions, of one measurement.

use gearwear_bodies::gear::Gear;
use gearwear_files::data_table::{DataTable, DataTableError, missing, not_allowed, positive};

/// Kind of a measurement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WearKind {
    /// Mass of the whole gear.
    Mass,
    /// Maximum wear depth of the active profile.
    Depth,
    /// Profile, of which the factor on the wear coefficient follows.
    Profile,
}

impl WearKind {
    pub fn name(self) -> &'static str {
        match self {
            WearKind::Mass => "mass",
            WearKind::Depth => "depth",
            WearKind::Profile => "profile",
        }
    }
}

/// When a measurement was made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WearTime {
    Hours(f64),
    /// Of the pinion.
    Revolutions(f64),
}

/// Measured value.
#[derive(Debug, Clone, PartialEq)]
pub enum WearValue {
    /// Of the whole gear.
    MassMg(f64),
    /// Maximum of the active profile.
    DepthUm(f64),
    /// Name of the file.
    Profile(String),
}

/// A row of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct WearRow {
    pub line: usize,
    pub time: WearTime,
    pub gear: Option<Gear>,
    pub tooth: Option<u32>,
    pub value: WearValue,
    /// Standard deviation in the unit of the value.
    pub sigma: Option<f64>,
}

/// Columns in the order in which messages name them.
const COLUMNS: [&str; 9] =
    ["revolutions", "hours", "gear", "tooth", "mass_loss_g", "mass_loss_mg", "depth_um", "profile", "sigma"];
/// Columns of values.
const VALUES: [&str; 4] = ["mass_loss_g", "mass_loss_mg", "depth_um", "profile"];
const MG_PER_G: f64 = 1e3;
/// Greatest standard deviation over its value.
const MOST_SIGMA: f64 = 10.0;
/// Most rows that are read.
const MOST_ROWS: usize = 1000;

/// Table with its columns found.
struct WearColumns<'a> {
    table: &'a DataTable<'a>,
    /// Number of each of [`COLUMNS`], where the table has it.
    at: [Option<usize>; COLUMNS.len()],
    /// Gear of rows that name none.
    gear: Option<Gear>,
}

/// Rows of a table, one at least.
///
/// # Errors
/// The first thing that is not allowed, with its line.
pub fn parse(text: &str) -> Result<Vec<WearRow>, DataTableError> {
    let table = DataTable::read(text, || COLUMNS.join(", "))?;
    let columns = WearColumns::of(&table)?;
    if let Some((line, _)) = table.rows.get(MOST_ROWS) {
        let found = format!("{} rows", table.rows.len());
        return Err(not_allowed(*line, "rows", found, format!("at most {MOST_ROWS}")));
    }
    let rows: Vec<WearRow> = (0..table.rows.len()).map(|index| columns.row(index)).collect::<Result<_, _>>()?;
    if rows.is_empty() {
        return Err(missing("a row of values", "one at least".to_owned()));
    }
    Ok(rows)
}

impl<'a> WearColumns<'a> {
    fn of(table: &'a DataTable<'a>) -> Result<Self, DataTableError> {
        let (line, names) = &table.names;
        let mut at = [None; COLUMNS.len()];
        for (index, name) in names.iter().enumerate() {
            let known = COLUMNS.iter().position(|column| column.eq_ignore_ascii_case(name));
            let known = known.ok_or_else(|| not_allowed(*line, "column", name, COLUMNS.join(", ")))?;
            if at[known].replace(index).is_some() {
                return Err(not_allowed(*line, "column", format!("{name} twice"), "each once".to_owned()));
            }
        }
        let [revolutions, hours] = [at[0], at[1]];
        match (revolutions, hours) {
            (None, None) => {
                return Err(missing("a column of times", "revolutions (of the pinion) or hours".to_owned()));
            }
            (Some(_), Some(_)) => {
                return Err(not_allowed(*line, "column", "revolutions and hours", "one of them".to_owned()));
            }
            _ => {}
        }
        if at[4..8].iter().all(Option::is_none) {
            return Err(missing("a column of values", VALUES.join(", ")));
        }
        let mut gear = None;
        for &(line, key, value) in &table.keys {
            if key.eq_ignore_ascii_case("gear") {
                gear = Some(named_gear(line, value)?);
            }
        }
        Ok(Self { table, at, gear })
    }

    /// Text of a column in a row; empty where the table lacks it.
    fn field(&self, index: usize, column: &str) -> &'a str {
        let at = COLUMNS.iter().position(|name| *name == column).and_then(|known| self.at[known]);
        at.and_then(|at| self.table.rows[index].1.get(at)).copied().unwrap_or_default()
    }

    fn row(&self, index: usize) -> Result<WearRow, DataTableError> {
        let (line, fields) = &self.table.rows[index];
        let (line, names) = (*line, self.table.names.1.len());
        if fields.len() != names {
            return Err(not_allowed(line, "columns", fields.len(), format!("{names}, as many as names")));
        }
        let time = match self.at[0] {
            Some(_) => WearTime::Revolutions(positive(line, "revolutions", self.field(index, "revolutions"))?),
            None => WearTime::Hours(positive(line, "hours", self.field(index, "hours"))?),
        };
        let gear = match self.field(index, "gear") {
            "" => self.gear,
            name => Some(named_gear(line, name)?),
        };
        let tooth = match self.field(index, "tooth") {
            "" => None,
            text => {
                let number = text.parse().map_err(|_| not_allowed(line, "tooth", text, "a whole number".to_owned()));
                Some(number?)
            }
        };
        let (value, unit) = self.value(index, line)?;
        if tooth.is_some() && matches!(value, WearValue::MassMg(_)) {
            let allowed = "nothing beside a mass loss, which is that of the whole gear".to_owned();
            return Err(not_allowed(line, "tooth", self.field(index, "tooth"), allowed));
        }
        let sigma = match self.field(index, "sigma") {
            "" => None,
            text if matches!(value, WearValue::Profile(_)) => {
                let allowed = "nothing beside a profile, whose scatter is that of its residuals".to_owned();
                return Err(not_allowed(line, "sigma", text, allowed));
            }
            text => Some(sigma(line, text, unit, &value)?),
        };
        Ok(WearRow { line, time, gear, tooth, value, sigma })
    }

    /// The one value of a row, and what numbers of its column are multiplied by.
    fn value(&self, index: usize, line: usize) -> Result<(WearValue, f64), DataTableError> {
        let filled: Vec<&str> = VALUES.into_iter().filter(|column| !self.field(index, column).is_empty()).collect();
        let [column] = filled[..] else {
            let found = if filled.is_empty() { "no value".to_owned() } else { filled.join(" and ") };
            return Err(not_allowed(line, "value", found, format!("one of {} in a row", VALUES.join(", "))));
        };
        let text = self.field(index, column);
        Ok(match column {
            "mass_loss_g" => (WearValue::MassMg(MG_PER_G * positive(line, column, text)?), MG_PER_G),
            "mass_loss_mg" => (WearValue::MassMg(positive(line, column, text)?), 1.0),
            "depth_um" => (WearValue::DepthUm(positive(line, column, text)?), 1.0),
            _ => (WearValue::Profile(text.to_owned()), 1.0),
        })
    }
}

impl WearValue {
    pub fn kind(&self) -> WearKind {
        match self {
            WearValue::MassMg(_) => WearKind::Mass,
            WearValue::DepthUm(_) => WearKind::Depth,
            WearValue::Profile(_) => WearKind::Profile,
        }
    }
}

/// Standard deviation of a value, given in a `unit` of it.
fn sigma(line: usize, text: &str, unit: f64, value: &WearValue) -> Result<f64, DataTableError> {
    let sigma = unit * positive(line, "sigma", text)?;
    let (WearValue::MassMg(value) | WearValue::DepthUm(value)) = *value else { return Ok(sigma) };
    let most = MOST_SIGMA * value;
    match sigma <= most {
        true => Ok(sigma),
        false => Err(not_allowed(line, "sigma", text, format!("at most {MOST_SIGMA} times the value"))),
    }
}

fn named_gear(line: usize, name: &str) -> Result<Gear, DataTableError> {
    let named = Gear::BOTH.into_iter().find(|gear| gear.name() == name);
    named.ok_or_else(|| not_allowed(line, "gear", name, "pinion or wheel".to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_several_kinds() {
        let text = "# gear = pinion\nhours;gear;tooth;mass_loss_g;depth_um;profile;sigma\n\
                    120;;;1,4;;;0,05\n240;wheel;3;;12;;\n300;;;;;trace.csv;\n";
        let rows = parse(text).unwrap();
        assert_eq!(rows[0].value, WearValue::MassMg(1400.0));
        assert_eq!((rows[0].gear, rows[0].sigma, rows[0].line), (Some(Gear::Pinion), Some(50.0), 3));
        assert_eq!((rows[1].gear, rows[1].tooth), (Some(Gear::Wheel), Some(3)));
        assert_eq!(rows[2].value, WearValue::Profile("trace.csv".to_owned()));
        assert_eq!(rows[2].time, WearTime::Hours(300.0));
    }

    #[test]
    fn what_is_refused_says_where_and_what_is_allowed() {
        for (text, said) in [
            ("", "the line of column names is missing"),
            ("hours,depth_um\n", "a row of values is missing"),
            ("depth_um\n1\n", "a column of times is missing"),
            ("hours\n1\n", "a column of values is missing"),
            ("hours,revolutions,depth_um\n1,2,3\n", "line 1: column: found revolutions and hours"),
            ("hours,depth\n1,2\n", "line 1: column: found depth; allowed: revolutions"),
            ("hours,depth_um,depth_um\n1,2,3\n", "line 1: column: found depth_um twice"),
            ("hours,depth_um\n1,2\n0,2\n", "line 3: hours: found 0; allowed: a number greater than 0"),
            ("hours,depth_um\n1,-2\n", "line 2: depth_um: found -2"),
            ("hours,depth_um\n1,NaN\n", "line 2: depth_um: found NaN"),
            ("hours,depth_um\n1,\n", "line 2: value: found no value"),
            ("hours,depth_um\n1\n", "line 2: columns: found 1; allowed: 2"),
            ("hours,depth_um,mass_loss_g\n1,2,3\n", "line 2: value: found mass_loss_g and depth_um"),
            ("hours,mass_loss_g,tooth\n1,2,3\n", "line 2: tooth: found 3"),
            ("hours,depth_um,tooth\n1,2,x\n", "line 2: tooth: found x"),
            ("hours,depth_um,sigma\n1,2,0\n", "line 2: sigma: found 0"),
            ("hours,depth_um,sigma\n1,2,21\n", "line 2: sigma: found 21; allowed: at most 10 times"),
            ("hours,profile,sigma\n1,a.csv,1\n", "line 2: sigma: found 1"),
            ("hours,depth_um,gear\n1,2,sun\n", "line 2: gear: found sun; allowed: pinion or wheel"),
            ("# gear = sun\nhours,depth_um\n1,2\n", "line 1: gear: found sun"),
        ] {
            let error = parse(text).unwrap_err().to_string();
            assert!(error.contains(said) && error.contains("allowed: "), "{text:?}: {error}");
        }
    }
}
