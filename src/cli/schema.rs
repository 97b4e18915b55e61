//! `gearwear schema`: the JSON schema of the scene, for editors.

use gearwear::scene::schema::schema;

use super::failure::Failure;
use super::stdout;

pub fn run() -> Result<(), Failure> {
    stdout::print(&format!("{:#}\n", schema()))
}
