//! The figures of the slices as tables.

use maud::{Markup, html};

use crate::report::html::number::{change, fixed, percent, significant};
use crate::report::html::table::{Cell, cells, row, table};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::results::run::{HelicalSummary, OverWidthSummary};

/// Lines of contact, load over the face width, mesh orders, evenness of wear.
pub(crate) fn tables(helical: &HelicalSummary) -> Markup {
    html! { (slices(helical)) (mesh_cycle(helical)) (evenness(&helical.wear)) }
}

fn slices(h: &HelicalSummary) -> Markup {
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
    }
    if let Some(slope_um) = h.slope_of_axes_um {
        rows.push(row("Helix slope of axes out of parallel", "µm", [significant(slope_um, 3)]));
    }
    table("Face width and slices", &["value"], rows)
}

fn mesh_cycle(h: &HelicalSummary) -> Markup {
    let compare = |label: Cell, unit, new: f64, worn: f64| row(label, unit, cells![new, worn, change(new, worn)]);
    let face_load_factor = html! { "Face load factor K" sub { "Hβ" } };
    let mut rows = vec![compare(face_load_factor.into(), "", h.K_Hbeta_new, h.K_Hbeta_worn)];
    let orders = h.mesh_orders_new_um.iter().zip(&h.mesh_orders_worn_um).enumerate();
    rows.extend(orders.map(|(i, (&new, &worn))| compare(format!("Mesh order {}", i + 1).into(), "µm", new, worn)));
    table("Load over the face width and mesh orders", &["new", "worn", "change"], rows)
}

fn evenness(wear: &PerGear<OverWidthSummary>) -> Markup {
    let both = |label, value: fn(&OverWidthSummary) -> f64, words: fn(f64) -> String| {
        row(label, "", [words(value(&wear.pinion)), words(value(&wear.wheel))])
    };
    let three: fn(f64) -> String = |value| significant(value, 3);
    table(
        "Wear over the face width",
        &["pinion", "wheel"],
        [
            both("Variation at the root", |w| w.root_variation, percent),
            both("Variation at the tip", |w| w.tip_variation, percent),
            both("Variation of root and tip together", |w| w.root_tip_variation, percent),
            both("Asymmetry at the root, first mesh", |w| w.root_asymmetry_first_mesh, three),
            both("Asymmetry at the root, end of the run", |w| w.root_asymmetry, three),
        ],
    )
}
