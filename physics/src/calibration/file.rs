//! The calibration as a file: JSON with a hash over all of it.
//!
//! The hash is the SHA-256 of the same JSON with an empty hash, so that white space does not matter and every number does.

use super::Calibration;
use gearwear_files::content_hash::sha256;

/// Reason why a text is no calibration.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CalibrationFileError {
    /// The text is no JSON, or not that of a calibration.
    #[error("line {line}, column {column}: {reason}")]
    Form {
        /// From 1.
        line: usize,
        /// From 1.
        column: usize,
        /// Fault.
        reason: String,
    },
    /// The content does not have the hash in the file.
    #[error("its content has the hash {computed}, but it says {given}")]
    Hash {
        /// Hash in the file.
        given: String,
        /// Hash of the content.
        computed: String,
    },
    /// The content cannot be of a calibration that this program made.
    #[error("{what}")]
    Content {
        /// Fault.
        what: String,
    },
}

impl Calibration {
    /// The calibration as JSON text, its hash filled in.
    pub fn to_json(&self) -> String {
        let mut own = self.clone();
        own.hash = self.content_hash();
        let mut text = own.text();
        text.push('\n');
        text
    }

    /// Reads text that [`Self::to_json`] wrote.
    ///
    /// # Errors
    /// Text that is no calibration, or of another version; one that was changed by hand.
    pub fn from_json(text: &str) -> Result<Self, CalibrationFileError> {
        let read: Self = serde_json::from_str(text).map_err(|error| CalibrationFileError::Form {
            line: error.line(),
            column: error.column(),
            reason: reason(&error),
        })?;
        let computed = read.content_hash();
        if computed != read.hash {
            return Err(CalibrationFileError::Hash { given: read.hash, computed });
        }
        match read.fault() {
            Some(what) => Err(CalibrationFileError::Content { what }),
            None => Ok(read),
        }
    }

    /// SHA-256 of the content without the hash itself, in hexadecimal digits.
    pub fn content_hash(&self) -> String {
        let bare = Self { hash: String::new(), ..self.clone() };
        sha256(bare.text().as_bytes())
    }

    fn text(&self) -> String {
        serde_json::to_string_pretty(self).expect("a calibration is always expressible in JSON")
    }

    /// Fault that keeps the curves from being used.
    fn fault(&self) -> Option<String> {
        let compliance = &self.pair_compliance;
        let (n, values) = (compliance.position_mm.len(), &compliance.mm2_per_n);
        if n < 2
            || values.len() != n
            || !compliance.position_mm.is_sorted_by(|a, b| a < b)
            || values.iter().any(|q| *q <= 0.0)
        {
            return Some("pair_compliance: at least two increasing positions with a positive value each".to_owned());
        }
        if compliance.shared_mm2_per_n < 0.0 || values.iter().any(|q| *q <= compliance.shared_mm2_per_n) {
            return Some("pair_compliance: what pairs share is not negative, and less than what each has".to_owned());
        }
        for (criterion, curve) in &self.foundation {
            let n = curve.position_mm.len();
            let lengths = [curve.mpa_per_mm.len(), curve.load_exponent.len()];
            let positive = curve.mpa_per_mm.iter().all(|k| *k > 0.0) && curve.reference_line_load_n_per_mm > 0.0;
            let exponents = curve.load_exponent.iter().all(|m| (0.0..1.0).contains(m));
            if n < 2 || lengths != [n; 2] || !curve.position_mm.is_sorted_by(|a, b| a < b) || !positive || !exponents {
                return Some(format!(
                    "foundation.{}: at least two increasing positions, K/H above 0 and exponents from 0 to below 1",
                    criterion.name()
                ));
            }
        }
        None
    }
}

/// Reason of an error without its place.
fn reason(error: &serde_json::Error) -> String {
    let text = error.to_string();
    text.rsplit_once(" at line ").map_or(text.clone(), |(reason, _)| reason.to_owned())
}
