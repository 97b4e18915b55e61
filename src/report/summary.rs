//! `summary.json`: the figures of a run. A value that is not finite becomes `null`, never `NaN`, which JSON lacks.

use std::io::{self, Write};

use crate::simulation::record::Summary;

/// Writes the summary as indented JSON.
pub fn write(out: &mut dyn Write, summary: &Summary) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, summary)?;
    writeln!(out)
}
