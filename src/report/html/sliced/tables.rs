//! The figures of the slices as tables.

use maud::Markup;

use crate::report::html::number::{fixed, significant};
use crate::report::html::table::{row, table};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::results::run::{HelicalSummary, OverWidthSummary};

/// Lines of contact, slices and their coupling.
pub(crate) fn slices(h: &HelicalSummary) -> Markup {
    let length = &h.line_of_contact_mm;
    let mut rows = vec![
        row("Helix angle at the reference cylinder", "°", [fixed(h.helix_angle_deg, 3)]),
        row("Helix angle at the base cylinder", "°", [fixed(h.base_helix_angle_deg, 3)]),
        row("Total contact ratio", "", [fixed(h.total_contact_ratio, 3)]),
        row("Total length of the lines of contact, minimum", "mm", [fixed(length.min, 3)]),
        row("Total length of the lines of contact, mean", "mm", [fixed(length.mean, 3)]),
        row("Total length of the lines of contact, maximum", "mm", [fixed(length.max, 3)]),
        row("Slices", "", [h.slices]),
        row("Coupling", "", [&*h.coupling]),
    ];
    if let Some([twist, bending]) = h.coupling_reach_mm {
        rows.push(row("Decay length of the coupling, twist", "mm", [significant(twist, 3)]));
        rows.push(row("Decay length of the coupling, bending", "mm", [significant(bending, 3)]));
    }
    for gear in Gear::BOTH {
        if let Some(twist_um) = h.shaft_twist_um[gear] {
            let label = format!("Twist of the {} under an even load, far end", gear.name());
            rows.push(row(label, "µm", [significant(twist_um, 3)]));
        }
        if let Some(misalignment_um) = h.misalignment_um[gear] {
            let label = format!("Misalignment of the {} by shaft and bearings under an even load", gear.name());
            rows.push(row(label, "µm", [significant(misalignment_um, 3)]));
        }
    }
    if let Some(slope_um) = h.slope_of_axes_um {
        rows.push(row("Helix slope of axes out of parallel", "µm", [significant(slope_um, 3)]));
    }
    table("Face width and slices", &["value"], rows)
}

/// Row of the asymmetry at the root after the first mesh; that at the end of the run is a main figure.
pub(crate) fn asymmetry_of_the_first_mesh(wear: &PerGear<OverWidthSummary>) -> Markup {
    row(
        "Asymmetry of root wear, first mesh",
        "",
        [wear.pinion.root_asymmetry_first_mesh, wear.wheel.root_asymmetry_first_mesh],
    )
}
