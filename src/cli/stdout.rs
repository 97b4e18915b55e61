//! Standard output that may be closed early, as by `gearwear schema | head`.

use std::io::{self, Write};

use super::failure::Failure;

/// Prints `text` as it is.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(|_| Failure::Closed)
}
