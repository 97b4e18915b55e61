//! `contact.csv`: gap and pressure along the contacts.

use std::io::{self, Write};

use crate::report::tables::{self, Column, Provenance};
use crate::results::fem_problem::ContactCurve;

/// Columns of `contact.csv`; one row per node of a slave surface, in the order of the surface.
pub const CONTACT: [Column; 10] = [
    ("x_mm", "place of the node before deformation"),
    ("y_mm", "place of the node before deformation"),
    (
        "gap_mm",
        "gap to the other surface after deformation, weighted as the contact condition is; empty where none faces the node",
    ),
    ("pressure_MPa", "contact pressure"),
    ("traction_MPa", "tangential traction: 0, the contact is frictionless"),
    ("contact", "which [[contact]] of the problem, from 0"),
    ("along_mm", "place along the surface before deformation, from its first node"),
    ("displacement_x_mm", "of the node"),
    ("displacement_y_mm", "of the node"),
    ("node", "number of the node in solution.vtu, from 0"),
];

/// Writes the table.
pub fn write(out: &mut dyn Write, provenance: Provenance, contacts: &[ContactCurve]) -> io::Result<()> {
    tables::table(out, provenance, &CONTACT, contacts.iter().flat_map(|contact| &contact.rows))
}
