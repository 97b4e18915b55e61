//! The figures that a sweep keeps of each run: one table of names, meanings and where in the summary they stand.
//!
//! A figure added to the table appears in every output of a sweep; one with `less_is_better` has a plot as well, with
//! its least value marked.

use crate::results::run::Summary;

/// A figure of a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SweepFigure {
    /// Name of its column, with its unit.
    pub name: &'static str,
    /// What it is called in plots, without its unit.
    pub title: &'static str,
    /// Its unit; empty for a ratio.
    pub unit: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// Whether one looks for the combination where it is least.
    pub less_is_better: bool,
    /// Where it stands; `None` where the scene does not compute it.
    pub of: fn(&Summary) -> Option<f64>,
}

/// A figure that only describes the combination.
const fn describes(
    name: &'static str,
    title: &'static str,
    unit: &'static str,
    meaning: &'static str,
    of: fn(&Summary) -> Option<f64>,
) -> SweepFigure {
    SweepFigure { name, title, unit, meaning, less_is_better: false, of }
}

/// A figure that one wants to be small.
const fn wants_less(
    name: &'static str,
    title: &'static str,
    unit: &'static str,
    meaning: &'static str,
    of: fn(&Summary) -> Option<f64>,
) -> SweepFigure {
    SweepFigure { name, title, unit, meaning, less_is_better: true, of }
}

/// The greatest wear of the pair: which gear it is of may change from one combination to the next.
pub(crate) const PEAK_WEAR: SweepFigure = wants_less(
    "peak_wear_um",
    "peak wear of either gear",
    "µm",
    "greatest wear depth on the active profiles of both gears, their tip edges apart",
    |s| Some(s.pinion.peak_wear_um.max(s.wheel.peak_wear_um)),
);

/// All figures, in the order of the columns. Add at the end.
pub(crate) const FIGURES: &[SweepFigure] = &[
    describes("transverse_contact_ratio", "transverse contact ratio", "", "ε_α", |s| {
        Some(s.geometry.transverse_contact_ratio)
    }),
    describes("overlap_ratio", "overlap ratio", "", "ε_β", |s| Some(s.geometry.overlap_ratio)),
    describes(
        "line_load_N_per_mm",
        "line load",
        "N/mm",
        "whole torque over the pinion's base radius and the face width",
        |s| Some(s.contact.line_load_N_per_mm),
    ),
    wants_less(
        "pinion_peak_wear_um",
        "peak wear of the pinion",
        "µm",
        "greatest wear depth on the pinion's active profile, its tip edge apart",
        |s| Some(s.pinion.peak_wear_um),
    ),
    wants_less(
        "pinion_root_wear_um",
        "wear near the pinion’s root",
        "µm",
        "greatest wear depth in the first 2 mm of radius above the start of active profile",
        |s| Some(s.pinion.root_wear_um),
    ),
    wants_less(
        "pinion_pitch_wear_um",
        "wear at the pinion’s pitch circle",
        "µm",
        "wear depth at the working pitch circle",
        |s| Some(s.pinion.pitch_wear_um),
    ),
    wants_less(
        "pinion_worn_volume_mm3",
        "volume worn off the pinion",
        "mm³",
        "worn off the whole pinion: all teeth, whole width",
        |s| Some(s.pinion.worn_volume_mm3),
    ),
    wants_less(
        "wheel_peak_wear_um",
        "peak wear of the wheel",
        "µm",
        "greatest wear depth on the wheel's active profile, its tip edge apart",
        |s| Some(s.wheel.peak_wear_um),
    ),
    wants_less(
        "wheel_root_wear_um",
        "wear near the wheel’s root",
        "µm",
        "greatest wear depth in the first 2 mm of radius above the start of active profile",
        |s| Some(s.wheel.root_wear_um),
    ),
    wants_less(
        "wheel_pitch_wear_um",
        "wear at the wheel’s pitch circle",
        "µm",
        "wear depth at the working pitch circle",
        |s| Some(s.wheel.pitch_wear_um),
    ),
    wants_less(
        "wheel_worn_volume_mm3",
        "volume worn off the wheel",
        "mm³",
        "worn off the whole wheel: all teeth, whole width",
        |s| Some(s.wheel.worn_volume_mm3),
    ),
    wants_less(
        "peak_pressure_new_MPa",
        "peak pressure, new",
        "MPa",
        "greatest pressure of contact whose pressure is defined, sharp tip edges under load apart, new",
        |s| Some(s.new.peak_pressure_MPa),
    ),
    wants_less(
        "peak_pressure_worn_MPa",
        "peak pressure, worn",
        "MPa",
        "greatest pressure of contact whose pressure is defined, sharp tip edges under load apart, worn",
        |s| Some(s.worn.peak_pressure_MPa),
    ),
    wants_less(
        "transmission_error_peak_to_peak_new_um",
        "transmission error peak to peak, new",
        "µm",
        "of the loaded pair over the cycle, along the line of action, new",
        |s| Some(s.new.transmission_error_um.peak_to_peak),
    ),
    wants_less(
        "transmission_error_peak_to_peak_worn_um",
        "transmission error peak to peak, worn",
        "µm",
        "of the loaded pair over the cycle, along the line of action, worn",
        |s| Some(s.worn.transmission_error_um.peak_to_peak),
    ),
    describes("total_contact_ratio", "total contact ratio", "", "ε_γ = ε_α + ε_β; empty for a spur pair", |s| {
        Some(s.helical.as_ref()?.total_contact_ratio)
    }),
    wants_less(
        "pinion_root_wear_variation",
        "variation of the pinion’s root wear over the width",
        "",
        "greatest less least root wear of the slices, over its mean; empty where there are no slices",
        |s| Some(s.helical.as_ref()?.wear.pinion.root_variation),
    ),
    wants_less(
        "pinion_tip_wear_variation",
        "variation of the pinion’s tip wear over the width",
        "",
        "greatest less least tip wear of the slices, over its mean; empty where there are no slices",
        |s| Some(s.helical.as_ref()?.wear.pinion.tip_variation),
    ),
    wants_less(
        "pinion_root_tip_wear_variation",
        "variation of the pinion’s wear at root and tip",
        "",
        "greatest less least wear of root and tip of all slices, over its mean; empty where there are no slices",
        |s| Some(s.helical.as_ref()?.wear.pinion.root_tip_variation),
    ),
    wants_less(
        "wheel_root_wear_variation",
        "variation of the wheel’s root wear over the width",
        "",
        "greatest less least root wear of the slices, over its mean; empty where there are no slices",
        |s| Some(s.helical.as_ref()?.wear.wheel.root_variation),
    ),
    wants_less(
        "wheel_tip_wear_variation",
        "variation of the wheel’s tip wear over the width",
        "",
        "greatest less least tip wear of the slices, over its mean; empty where there are no slices",
        |s| Some(s.helical.as_ref()?.wear.wheel.tip_variation),
    ),
    wants_less(
        "wheel_root_tip_wear_variation",
        "variation of the wheel’s wear at root and tip",
        "",
        "greatest less least wear of root and tip of all slices, over its mean; empty where there are no slices",
        |s| Some(s.helical.as_ref()?.wear.wheel.root_tip_variation),
    ),
    describes(
        "pinion_root_wear_asymmetry",
        "asymmetry of the pinion’s root wear",
        "",
        "first less last slice over their sum; empty where there are no slices",
        |s| Some(s.helical.as_ref()?.wear.pinion.root_asymmetry),
    ),
    wants_less(
        "K_Hbeta_new",
        "face load factor K_Hβ, new",
        "",
        "greatest over mean of the slices' loads, new; empty where there are no slices",
        |s| Some(s.helical.as_ref()?.K_Hbeta_new),
    ),
    wants_less(
        "K_Hbeta_worn",
        "face load factor K_Hβ, worn",
        "",
        "greatest over mean of the slices' loads, worn; empty where there are no slices",
        |s| Some(s.helical.as_ref()?.K_Hbeta_worn),
    ),
    wants_less(
        "mesh_order_1_new_um",
        "first mesh order of the transmission error, new",
        "µm",
        "amplitude at the mesh frequency, new; empty where there are no slices",
        |s| s.helical.as_ref()?.mesh_orders_new_um.first().copied(),
    ),
    wants_less(
        "mesh_order_1_worn_um",
        "first mesh order of the transmission error, worn",
        "µm",
        "amplitude at the mesh frequency, worn; empty where there are no slices",
        |s| s.helical.as_ref()?.mesh_orders_worn_um.first().copied(),
    ),
    wants_less(
        "pinion_tip_edge_wear_um",
        "wear of the pinion’s tip edge",
        "µm",
        "greatest wear depth at the pinion's tip edge",
        |s| Some(s.pinion.tip_edge_wear_um),
    ),
    wants_less(
        "wheel_tip_edge_wear_um",
        "wear of the wheel’s tip edge",
        "µm",
        "greatest wear depth at the wheel's tip edge",
        |s| Some(s.wheel.tip_edge_wear_um),
    ),
    wants_less(
        "pinion_below_sap_wear_um",
        "wear below the pinion’s active profile",
        "µm",
        "greatest wear depth below the start of active profile",
        |s| Some(s.pinion.below_sap_wear_um),
    ),
    wants_less(
        "wheel_below_sap_wear_um",
        "wear below the wheel’s active profile",
        "µm",
        "greatest wear depth below the start of active profile",
        |s| Some(s.wheel.below_sap_wear_um),
    ),
    PEAK_WEAR,
];

impl SweepFigure {
    /// Title and unit, for an axis: `line load, N/mm`.
    pub(crate) fn with_unit(&self) -> String {
        if self.unit.is_empty() { self.title.to_owned() } else { format!("{}, {}", self.title, self.unit) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_figure_has_a_name_of_its_own() {
        for (at, figure) in FIGURES.iter().enumerate() {
            assert!(FIGURES[..at].iter().all(|other| other.name != figure.name), "{}", figure.name);
        }
    }
}
