//! The figures that a sweep keeps of each run: one table of names, meanings and where in the summary they stand.
//!
//! A figure added to the table appears in every output of a sweep; one with `less_is_better` has a plot as well, with
//! its least value marked.

use crate::results::run::Summary;

#[derive(Debug, Clone, Copy)]
pub(crate) struct SweepFigure {
    /// Name of its column, with its unit.
    pub name: &'static str,
    /// What it is called in plots, without its unit.
    pub title: &'static str,
    /// Its unit; empty for a ratio.
    pub unit: &'static str,
    pub meaning: &'static str,
    /// Whether one looks for the combination where it is least.
    pub less_is_better: bool,
    /// Where it stands; `None` where the scene does not compute it.
    pub of: fn(&Summary) -> Option<f64>,
}

/// A figure that only describes the combination.
const fn describes(name: &'static str, title: &'static str, unit: &'static str) -> SweepFigure {
    SweepFigure { name, title, unit, meaning: "", less_is_better: false, of: |_| None }
}

/// A figure that one wants to be small.
const fn wants_less(name: &'static str, title: &'static str, unit: &'static str) -> SweepFigure {
    SweepFigure { less_is_better: true, ..describes(name, title, unit) }
}

/// The greatest wear of the pair: which gear it is of may change from one combination to the next.
pub(crate) const PEAK_WEAR: SweepFigure = wants_less("peak_wear_um", "maximum wear of either gear", "µm")
    .of(|s| Some(s.pinion.peak_wear_um.max(s.wheel.peak_wear_um)))
    .meaning("maximum wear depth on the active profiles of both gears, their tip edges apart");

/// All figures, in the order of the columns. Add at the end.
pub(crate) const FIGURES: &[SweepFigure] = &[
    describes("transverse_contact_ratio", "transverse contact ratio", "")
        .of(|s| Some(s.geometry.transverse_contact_ratio))
        .meaning("ε_α"),
    describes("overlap_ratio", "overlap ratio", "").of(|s| Some(s.geometry.overlap_ratio)).meaning("ε_β"),
    describes("line_load_N_per_mm", "line load", "N/mm")
        .of(|s| Some(s.contact.line_load_N_per_mm))
        .meaning("whole torque over the pinion's base radius and the face width"),
    wants_less("pinion_peak_wear_um", "maximum wear of the pinion", "µm")
        .of(|s| Some(s.pinion.peak_wear_um))
        .meaning("maximum wear depth on the pinion's active profile, its tip edge apart"),
    wants_less("pinion_root_wear_um", "wear near the pinion’s root", "µm")
        .of(|s| Some(s.pinion.root_wear_um))
        .meaning("maximum wear depth in the first 2 mm of radius above the start of active profile"),
    wants_less("pinion_pitch_wear_um", "wear at the pinion’s pitch circle", "µm")
        .of(|s| Some(s.pinion.pitch_wear_um))
        .meaning("wear depth at the working pitch circle"),
    wants_less("pinion_worn_volume_mm3", "volume worn off the pinion", "mm³")
        .of(|s| Some(s.pinion.worn_volume_mm3))
        .meaning("worn off the whole pinion: all teeth, whole width"),
    wants_less("wheel_peak_wear_um", "maximum wear of the wheel", "µm")
        .of(|s| Some(s.wheel.peak_wear_um))
        .meaning("maximum wear depth on the wheel's active profile, its tip edge apart"),
    wants_less("wheel_root_wear_um", "wear near the wheel’s root", "µm")
        .of(|s| Some(s.wheel.root_wear_um))
        .meaning("maximum wear depth in the first 2 mm of radius above the start of active profile"),
    wants_less("wheel_pitch_wear_um", "wear at the wheel’s pitch circle", "µm")
        .of(|s| Some(s.wheel.pitch_wear_um))
        .meaning("wear depth at the working pitch circle"),
    wants_less("wheel_worn_volume_mm3", "volume worn off the wheel", "mm³")
        .of(|s| Some(s.wheel.worn_volume_mm3))
        .meaning("worn off the whole wheel: all teeth, whole width"),
    wants_less("peak_pressure_new_MPa", "maximum pressure, new", "MPa")
        .of(|s| Some(s.new.peak_pressure_MPa))
        .meaning("maximum pressure of contact whose pressure is defined, sharp tip edges under load apart, new"),
    wants_less("peak_pressure_worn_MPa", "maximum pressure, worn", "MPa")
        .of(|s| Some(s.worn.peak_pressure_MPa))
        .meaning("maximum pressure of contact whose pressure is defined, sharp tip edges under load apart, worn"),
    wants_less("transmission_error_peak_to_peak_new_um", "transmission error peak to peak, new", "µm")
        .of(|s| Some(s.new.transmission_error_um.peak_to_peak))
        .meaning("of the loaded pair over the cycle, along the line of action, new"),
    wants_less("transmission_error_peak_to_peak_worn_um", "transmission error peak to peak, worn", "µm")
        .of(|s| Some(s.worn.transmission_error_um.peak_to_peak))
        .meaning("of the loaded pair over the cycle, along the line of action, worn"),
    describes("total_contact_ratio", "total contact ratio", "")
        .of(|s| Some(s.helical.as_ref()?.total_contact_ratio))
        .meaning("ε_γ = ε_α + ε_β; empty for a spur pair"),
    wants_less("pinion_root_wear_variation", "variation of the pinion’s root wear over the width", "")
        .of(|s| Some(s.helical.as_ref()?.wear.pinion.root_variation))
        .meaning("maximum less minimum root wear of the slices, over its mean; empty where there are no slices"),
    wants_less("pinion_tip_wear_variation", "variation of the pinion’s tip wear over the width", "")
        .of(|s| Some(s.helical.as_ref()?.wear.pinion.tip_variation))
        .meaning("maximum less minimum tip wear of the slices, over its mean; empty where there are no slices"),
    wants_less("pinion_root_tip_wear_variation", "variation of the pinion’s wear at root and tip", "")
        .of(|s| Some(s.helical.as_ref()?.wear.pinion.root_tip_variation))
        .meaning(
            "maximum less minimum wear of root and tip of all slices, over its mean; empty where there are no slices",
        ),
    wants_less("wheel_root_wear_variation", "variation of the wheel’s root wear over the width", "")
        .of(|s| Some(s.helical.as_ref()?.wear.wheel.root_variation))
        .meaning("maximum less minimum root wear of the slices, over its mean; empty where there are no slices"),
    wants_less("wheel_tip_wear_variation", "variation of the wheel’s tip wear over the width", "")
        .of(|s| Some(s.helical.as_ref()?.wear.wheel.tip_variation))
        .meaning("maximum less minimum tip wear of the slices, over its mean; empty where there are no slices"),
    wants_less("wheel_root_tip_wear_variation", "variation of the wheel’s wear at root and tip", "")
        .of(|s| Some(s.helical.as_ref()?.wear.wheel.root_tip_variation))
        .meaning(
            "maximum less minimum wear of root and tip of all slices, over its mean; empty where there are no slices",
        ),
    describes("pinion_root_wear_asymmetry", "asymmetry of the pinion’s root wear", "")
        .of(|s| Some(s.helical.as_ref()?.wear.pinion.root_asymmetry))
        .meaning("first less last slice over their sum; empty where there are no slices"),
    wants_less("K_Hbeta_new", "face load factor K_Hβ, new", "")
        .of(|s| Some(s.helical.as_ref()?.K_Hbeta_new))
        .meaning("maximum over mean of the slices' loads, new; empty where there are no slices"),
    wants_less("K_Hbeta_worn", "face load factor K_Hβ, worn", "")
        .of(|s| Some(s.helical.as_ref()?.K_Hbeta_worn))
        .meaning("maximum over mean of the slices' loads, worn; empty where there are no slices"),
    wants_less("mesh_order_1_new_um", "first mesh order of the transmission error, new", "µm")
        .of(|s| s.helical.as_ref()?.mesh_orders_new_um.first().copied())
        .meaning("amplitude at the mesh frequency, new; empty where there are no slices"),
    wants_less("mesh_order_1_worn_um", "first mesh order of the transmission error, worn", "µm")
        .of(|s| s.helical.as_ref()?.mesh_orders_worn_um.first().copied())
        .meaning("amplitude at the mesh frequency, worn; empty where there are no slices"),
    wants_less("pinion_tip_edge_wear_um", "wear of the pinion’s tip edge", "µm")
        .of(|s| Some(s.pinion.tip_edge_wear_um))
        .meaning("maximum wear depth at the pinion's tip edge"),
    wants_less("wheel_tip_edge_wear_um", "wear of the wheel’s tip edge", "µm")
        .of(|s| Some(s.wheel.tip_edge_wear_um))
        .meaning("maximum wear depth at the wheel's tip edge"),
    wants_less("pinion_below_sap_wear_um", "wear below the pinion’s active profile", "µm")
        .of(|s| Some(s.pinion.below_sap_wear_um))
        .meaning("maximum wear depth below the start of active profile"),
    wants_less("wheel_below_sap_wear_um", "wear below the wheel’s active profile", "µm")
        .of(|s| Some(s.wheel.below_sap_wear_um))
        .meaning("maximum wear depth below the start of active profile"),
    PEAK_WEAR,
    describes("volume_balance", "difference of the worn volumes of pinion and wheel", "")
        .of(|s| s.error.volume_balance)
        .meaning("relative to the greater, over the whole run: an error, as both flanks of a contact lose the same; empty where nothing wears"),
    describes("life_h", "life", "h")
        .of(|s| s.life.as_ref()?.hours)
        .meaning("until the first limit of operation.stop is reached; empty where none is within the duration"),
    describes("life_revolutions", "life", "pinion revolutions")
        .of(|s| s.life.as_ref()?.revolutions)
        .meaning("the same in pinion revolutions"),
];

impl SweepFigure {
    /// The figure whose column has this name.
    pub(crate) fn find(name: &str) -> Option<&'static Self> {
        FIGURES.iter().find(|figure| figure.name == name)
    }

    const fn of(self, of: fn(&Summary) -> Option<f64>) -> Self {
        Self { of, ..self }
    }

    const fn meaning(self, meaning: &'static str) -> Self {
        Self { meaning, ..self }
    }

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
