//! `summary.json`: the figures of a run. A value that is not finite becomes `null`, never `NaN`, which JSON lacks.

use std::io::{self, Write};

use serde::Serialize;

/// Writes the summary as indented JSON.
pub fn write(out: &mut dyn Write, summary: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, summary)?;
    writeln!(out)
}
