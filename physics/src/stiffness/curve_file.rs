//! CSV file of the stiffness of a tooth pair along the path of contact.
//!
//! Values may be Simon's deflection coefficients or Wang and Cheng's table, which are not part of this program, measurements,
//! or results of other programs:
//!
//! ```text
//! # flattening = included
//! # line_load_N_per_mm = 637.66
//! position_mm,stiffness_N_per_mm_um
//! 4.4723,10.51
//! 13.9701,15.81
//! 23.5694,10.92
//! ```
//!
//! `position_mm` is the radius of curvature of the pinion at the theoretical contact point, increasing from row to row. The
//! other column is the stiffness of the pair, force per mm of face width and µm of approach along the line of action, or
//! `deflection_um`, the approach under the line load. Lines that begin with # tell whether the values include the
//! flattening of the flanks in contact (`included`, `excluded`), and the line load of the values, which is required for deflections
//! and values with flattening. `# shared_um_mm_per_N = …` gives the part of the compliance that all pairs in mesh share, that of the gear bodies; without
//! it there is none. Other lines with # are remarks.

use super::curve::{PairCompliance, StandsFor};
use gearwear_bodies::gear::path_of_contact::PathOfContact;
use gearwear_files::data_table::{DataTable, DataTableError, missing, not_allowed, positive};

const POSITION: &str = "position_mm";
const STIFFNESS: &str = "stiffness_N_per_mm_um";
const DEFLECTION: &str = "deflection_um";
const FLATTENING: &str = "flattening";
const LINE_LOAD: &str = "line_load_N_per_mm";
const SHARED: &str = "shared_um_mm_per_N";
const UM_PER_MM: f64 = 1e3;
/// Fraction of the path of contact that may be missing at either end of a curve, where its outermost value is taken.
const MISSING_AT_ENDS: f64 = 0.02;

/// Error in the file of a stiffness curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CurveFileError {
    /// The table is invalid.
    #[error(transparent)]
    Table(#[from] DataTableError),
    /// The rows do not cover the path of contact.
    #[error("{POSITION}: found {first_mm:.4} to {last_mm:.4}; allowed: at least {start_mm:.4} (A) to {end_mm:.4} (E)")]
    TooShort {
        /// First position.
        first_mm: f64,
        /// Last position.
        last_mm: f64,
        /// Point A.
        start_mm: f64,
        /// Point E.
        end_mm: f64,
    },
}

/// Keys of the lines with #.
#[derive(Default)]
struct CurveHeader {
    flattening_included: Option<bool>,
    line_load_n_per_mm: Option<f64>,
    shared_mm2_per_n: f64,
}

/// Curve in the text of a file, which must reach from A to E.
pub fn parse(text: &str, path: &PathOfContact) -> Result<PairCompliance, CurveFileError> {
    let table = DataTable::read(text, || format!("{POSITION},{STIFFNESS} or {POSITION},{DEFLECTION}"))?;
    let mut header = CurveHeader::default();
    for &(line, key, value) in &table.keys {
        header.take(line, key, value)?;
    }
    let columns = CurveColumns::find(table.names.0, &table.names.1)?;
    let stands_for = header.stands_for(columns.are_deflections)?;
    let mut curve = PairCompliance {
        position_mm: Vec::new(),
        mm2_per_n: Vec::new(),
        stands_for,
        shared_mm2_per_n: header.shared_mm2_per_n,
    };
    for (line, values) in table.rows {
        let [position, value] =
            [columns.position, columns.value].map(|index| values.get(index).copied().unwrap_or_default());
        let position = positive(line, POSITION, position)?;
        if let Some(&before) = curve.position_mm.last().filter(|&&before| position <= before) {
            return Err(not_allowed(line, POSITION, position, format!("more than {before}, the row before")).into());
        }
        let value = positive(line, columns.value_name(), value)?;
        curve.position_mm.push(position);
        curve.mm2_per_n.push(match header.line_load_n_per_mm {
            Some(load) if columns.are_deflections => value / UM_PER_MM / load,
            _ => 1.0 / (value * UM_PER_MM),
        });
    }
    match curve.position_mm[..] {
        [first_mm, .., last_mm] => {
            let missing = MISSING_AT_ENDS * (path.end_mm - path.start_mm);
            if first_mm <= path.start_mm + missing && last_mm >= path.end_mm - missing {
                return Ok(curve);
            }
            Err(CurveFileError::TooShort { first_mm, last_mm, start_mm: path.start_mm, end_mm: path.end_mm })
        }
        _ => Err(missing("rows", "at least two rows of numbers".to_owned()).into()),
    }
}

/// Text of the file of `curve`, from which [`parse`] reads it again.
pub fn to_text(curve: &PairCompliance) -> String {
    let mut text = match curve.stands_for {
        StandsFor::Teeth => format!("# {FLATTENING} = excluded\n"),
        StandsFor::WholePair { line_load_n_per_mm } => {
            format!("# {FLATTENING} = included\n# {LINE_LOAD} = {line_load_n_per_mm:?}\n")
        }
    };
    if curve.shared_mm2_per_n > 0.0 {
        text.push_str(&format!("# {SHARED} = {:?}\n", curve.shared_mm2_per_n * UM_PER_MM));
    }
    text.push_str(&format!("{POSITION},{STIFFNESS}\n"));
    for (position_mm, mm2_per_n) in curve.position_mm.iter().zip(&curve.mm2_per_n) {
        text.push_str(&format!("{position_mm:?},{:?}\n", 1.0 / (mm2_per_n * UM_PER_MM)));
    }
    text
}

/// Numbers of the columns.
struct CurveColumns {
    position: usize,
    value: usize,
    are_deflections: bool,
}

impl CurveColumns {
    fn find(line: usize, names: &[&str]) -> Result<Self, DataTableError> {
        let columns = [POSITION, STIFFNESS, DEFLECTION].map(|name| names.iter().position(|&other| other == name));
        match columns {
            [Some(position), Some(value), None] => Ok(Self { position, value, are_deflections: false }),
            [Some(position), None, Some(value)] => Ok(Self { position, value, are_deflections: true }),
            _ => {
                let allowed = format!("{POSITION} and either {STIFFNESS} or {DEFLECTION}, separated by commas");
                Err(not_allowed(line, "column names", names.join(","), allowed))
            }
        }
    }

    fn value_name(&self) -> &'static str {
        if self.are_deflections { DEFLECTION } else { STIFFNESS }
    }
}

impl CurveHeader {
    fn take(&mut self, line: usize, key: &str, value: &str) -> Result<(), DataTableError> {
        match (key, value) {
            (FLATTENING, "included") => self.flattening_included = Some(true),
            (FLATTENING, "excluded") => self.flattening_included = Some(false),
            (FLATTENING, other) => return Err(not_allowed(line, FLATTENING, other, "included or excluded".to_owned())),
            (SHARED, value) => self.shared_mm2_per_n = positive(line, SHARED, value)? / UM_PER_MM,
            (LINE_LOAD, value) => self.line_load_n_per_mm = Some(positive(line, LINE_LOAD, value)?),
            _ => {}
        }
        Ok(())
    }

    fn stands_for(&self, deflections: bool) -> Result<StandsFor, DataTableError> {
        let Some(included) = self.flattening_included else {
            return Err(missing(
                "whether the values hold the flattening of the flanks",
                format!("a line \"# {FLATTENING} = included\" or \"# {FLATTENING} = excluded\""),
            ));
        };
        let load = self.line_load_n_per_mm.ok_or_else(|| {
            let what = if deflections { "the line load of the deflections" } else { "the line load of the flattening" };
            missing(what, format!("a line \"# {LINE_LOAD} = …\", a number greater than 0"))
        });
        match included {
            true => Ok(StandsFor::WholePair { line_load_n_per_mm: load? }),
            false if deflections => load.map(|_| StandsFor::Teeth),
            false => Ok(StandsFor::Teeth),
        }
    }
}
