//! Standard output that may be closed early, as by `gearwear schema | head`.

use std::io::{self, Write};

use terminal_size::{Width, terminal_size_of};

use super::failure::Failure;

/// Prints `text` as it is.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(|_| Failure::Closed)
}

/// Columns of the terminal that standard output goes to; `None` where it goes elsewhere.
pub fn width() -> Option<u16> {
    terminal_size_of(io::stdout()).map(|(Width(columns), _)| columns)
}
