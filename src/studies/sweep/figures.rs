//! The figures that a sweep keeps of each run: one table of names, meanings and where in the summary they stand.
//!
//! A name is the path in `summary.json`, items of lists numbered from 1; only the greater of both gears' maximum wear has none there.
//! [`FORMER_NAMES`] are still understood where a figure is asked for.
//!
//! A figure added to the table appears in every output of a sweep; one with `less_is_better` has a plot as well, with
//! its least value marked.

use crate::results::run::Summary;

#[derive(Debug, Clone, Copy)]
pub(crate) struct SweepFigure {
    /// Name of its column: its path in the summary.
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
    describes("geometry.transverse_contact_ratio", "transverse contact ratio", "")
        .of(|s| Some(s.geometry.transverse_contact_ratio))
        .meaning("ε_α"),
    describes("geometry.overlap_ratio", "overlap ratio", "").of(|s| Some(s.geometry.overlap_ratio)).meaning("ε_β"),
    describes("contact.line_load_N_per_mm", "line load", "N/mm")
        .of(|s| Some(s.contact.line_load_N_per_mm))
        .meaning("whole torque over the pinion's base radius and the face width"),
    wants_less("pinion.peak_wear_um", "maximum wear of the pinion", "µm")
        .of(|s| Some(s.pinion.peak_wear_um))
        .meaning("maximum wear depth on the pinion's active profile, its tip edge apart"),
    wants_less("pinion.root_wear_um", "wear near the pinion’s root", "µm")
        .of(|s| Some(s.pinion.root_wear_um))
        .meaning("maximum wear depth in the first 2 mm of radius above the start of active profile"),
    wants_less("pinion.pitch_wear_um", "wear at the pinion’s pitch circle", "µm")
        .of(|s| Some(s.pinion.pitch_wear_um))
        .meaning("wear depth at the working pitch circle"),
    wants_less("pinion.worn_volume_mm3", "volume worn off the pinion", "mm³")
        .of(|s| Some(s.pinion.worn_volume_mm3))
        .meaning("worn off the whole pinion: all teeth, whole width"),
    wants_less("wheel.peak_wear_um", "maximum wear of the wheel", "µm")
        .of(|s| Some(s.wheel.peak_wear_um))
        .meaning("maximum wear depth on the wheel's active profile, its tip edge apart"),
    wants_less("wheel.root_wear_um", "wear near the wheel’s root", "µm")
        .of(|s| Some(s.wheel.root_wear_um))
        .meaning("maximum wear depth in the first 2 mm of radius above the start of active profile"),
    wants_less("wheel.pitch_wear_um", "wear at the wheel’s pitch circle", "µm")
        .of(|s| Some(s.wheel.pitch_wear_um))
        .meaning("wear depth at the working pitch circle"),
    wants_less("wheel.worn_volume_mm3", "volume worn off the wheel", "mm³")
        .of(|s| Some(s.wheel.worn_volume_mm3))
        .meaning("worn off the whole wheel: all teeth, whole width"),
    wants_less("new.flank_pressure_MPa", "flank pressure, new", "MPa")
        .of(|s| Some(s.new.flank_pressure_MPa))
        .meaning("maximum pressure between the tip-edge zones, new"),
    wants_less("worn.flank_pressure_MPa", "flank pressure, worn", "MPa")
        .of(|s| Some(s.worn.flank_pressure_MPa))
        .meaning("maximum pressure between the tip-edge zones, worn"),
    wants_less("new.tip_edge_line_load_N_per_mm", "line load of a tip edge, new", "N/mm")
        .of(|s| Some(s.new.tip_edge_line_load_N_per_mm))
        .meaning("greatest line load of a contact that reaches a tip edge, new"),
    wants_less("worn.tip_edge_line_load_N_per_mm", "line load of a tip edge, worn", "N/mm")
        .of(|s| Some(s.worn.tip_edge_line_load_N_per_mm))
        .meaning("greatest line load of a contact that reaches a tip edge, worn"),
    wants_less("new.tip_edge_mean_pressure_MPa", "pressure of a tip edge over 0.04 mm, new", "MPa")
        .of(|s| Some(s.new.tip_edge_mean_pressure_MPa))
        .meaning("greatest pressure of such a contact as a mean over 0.04 mm, new"),
    wants_less("worn.tip_edge_mean_pressure_MPa", "pressure of a tip edge over 0.04 mm, worn", "MPa")
        .of(|s| Some(s.worn.tip_edge_mean_pressure_MPa))
        .meaning("greatest pressure of such a contact as a mean over 0.04 mm, worn"),
    describes("new.peak_pressure_MPa", "maximum pressure at a point, new", "MPa")
        .of(|s| Some(s.new.peak_pressure_MPa))
        .meaning("maximum pressure at a single point, which depends on the resolution at tip edges and kinks of a relief; sharp tip edges under load apart, new"),
    describes("worn.peak_pressure_MPa", "maximum pressure at a point, worn", "MPa")
        .of(|s| Some(s.worn.peak_pressure_MPa))
        .meaning("maximum pressure at a single point, which depends on the resolution at tip edges and kinks of a relief; sharp tip edges under load apart, worn"),
    wants_less("new.transmission_error_um.peak_to_peak", "transmission error peak to peak, new", "µm")
        .of(|s| Some(s.new.transmission_error_um.peak_to_peak))
        .meaning("of the loaded pair over the cycle, along the line of action, new"),
    wants_less("worn.transmission_error_um.peak_to_peak", "transmission error peak to peak, worn", "µm")
        .of(|s| Some(s.worn.transmission_error_um.peak_to_peak))
        .meaning("of the loaded pair over the cycle, along the line of action, worn"),
    describes("helical.total_contact_ratio", "total contact ratio", "")
        .of(|s| Some(s.helical.as_ref()?.total_contact_ratio))
        .meaning("ε_γ = ε_α + ε_β; empty for a spur pair"),
    wants_less("helical.wear.pinion.root_variation", "variation of the pinion’s root wear over the width", "")
        .of(|s| Some(s.helical.as_ref()?.wear.pinion.root_variation))
        .meaning("maximum less minimum root wear of the slices, over its mean; empty where there are no slices"),
    wants_less("helical.wear.pinion.tip_variation", "variation of the pinion’s tip wear over the width", "")
        .of(|s| Some(s.helical.as_ref()?.wear.pinion.tip_variation))
        .meaning("maximum less minimum tip wear of the slices, over its mean; empty where there are no slices"),
    wants_less("helical.wear.pinion.root_tip_variation", "variation of the pinion’s wear at root and tip", "")
        .of(|s| Some(s.helical.as_ref()?.wear.pinion.root_tip_variation))
        .meaning(
            "maximum less minimum wear of root and tip of all slices, over its mean; empty where there are no slices",
        ),
    wants_less("helical.wear.wheel.root_variation", "variation of the wheel’s root wear over the width", "")
        .of(|s| Some(s.helical.as_ref()?.wear.wheel.root_variation))
        .meaning("maximum less minimum root wear of the slices, over its mean; empty where there are no slices"),
    wants_less("helical.wear.wheel.tip_variation", "variation of the wheel’s tip wear over the width", "")
        .of(|s| Some(s.helical.as_ref()?.wear.wheel.tip_variation))
        .meaning("maximum less minimum tip wear of the slices, over its mean; empty where there are no slices"),
    wants_less("helical.wear.wheel.root_tip_variation", "variation of the wheel’s wear at root and tip", "")
        .of(|s| Some(s.helical.as_ref()?.wear.wheel.root_tip_variation))
        .meaning(
            "maximum less minimum wear of root and tip of all slices, over its mean; empty where there are no slices",
        ),
    describes("helical.wear.pinion.root_asymmetry", "asymmetry of the pinion’s root wear", "")
        .of(|s| Some(s.helical.as_ref()?.wear.pinion.root_asymmetry))
        .meaning("first less last slice over their sum; empty where there are no slices"),
    wants_less("helical.K_Hbeta_new", "face load factor K_Hβ, new", "")
        .of(|s| Some(s.helical.as_ref()?.K_Hbeta_new))
        .meaning("maximum over mean of the slices' loads, new; empty where there are no slices"),
    wants_less("helical.K_Hbeta_worn", "face load factor K_Hβ, worn", "")
        .of(|s| Some(s.helical.as_ref()?.K_Hbeta_worn))
        .meaning("maximum over mean of the slices' loads, worn; empty where there are no slices"),
    wants_less("helical.mesh_orders_new_um.1", "first mesh order of the transmission error, new", "µm")
        .of(|s| s.helical.as_ref()?.mesh_orders_new_um.first().copied())
        .meaning("amplitude at the mesh frequency, new; empty where there are no slices"),
    wants_less("helical.mesh_orders_worn_um.1", "first mesh order of the transmission error, worn", "µm")
        .of(|s| s.helical.as_ref()?.mesh_orders_worn_um.first().copied())
        .meaning("amplitude at the mesh frequency, worn; empty where there are no slices"),
    wants_less("pinion.tip_edge_wear_um", "wear of the pinion’s tip edge", "µm")
        .of(|s| Some(s.pinion.tip_edge_wear_um))
        .meaning("maximum wear depth at the pinion's tip edge"),
    wants_less("wheel.tip_edge_wear_um", "wear of the wheel’s tip edge", "µm")
        .of(|s| Some(s.wheel.tip_edge_wear_um))
        .meaning("maximum wear depth at the wheel's tip edge"),
    wants_less("pinion.below_sap_wear_um", "wear below the pinion’s active profile", "µm")
        .of(|s| Some(s.pinion.below_sap_wear_um))
        .meaning("maximum wear depth below the start of active profile"),
    wants_less("wheel.below_sap_wear_um", "wear below the wheel’s active profile", "µm")
        .of(|s| Some(s.wheel.below_sap_wear_um))
        .meaning("maximum wear depth below the start of active profile"),
    PEAK_WEAR,
    describes("error.volume_balance", "difference of the worn volumes of pinion and wheel", "")
        .of(|s| s.error.volume_balance)
        .meaning("relative to the greater, over the whole run: an error, as both flanks of a contact lose the same; empty where nothing wears"),
    describes("life.hours", "life", "h")
        .of(|s| s.life.as_ref()?.hours)
        .meaning("until the first limit of operation.stop is reached; empty where none is within the duration"),
    describes("life.revolutions", "life", "pinion revolutions")
        .of(|s| s.life.as_ref()?.revolutions)
        .meaning("the same in pinion revolutions"),
];

/// Names of columns of the version before, and what they are called now.
const FORMER_NAMES: [(&str, &str); 34] = [
    ("K_Hbeta_new", "helical.K_Hbeta_new"),
    ("K_Hbeta_worn", "helical.K_Hbeta_worn"),
    ("life_h", "life.hours"),
    ("life_revolutions", "life.revolutions"),
    ("line_load_N_per_mm", "contact.line_load_N_per_mm"),
    ("mesh_order_1_new_um", "helical.mesh_orders_new_um.1"),
    ("mesh_order_1_worn_um", "helical.mesh_orders_worn_um.1"),
    ("overlap_ratio", "geometry.overlap_ratio"),
    ("peak_pressure_new_MPa", "new.peak_pressure_MPa"),
    ("peak_pressure_worn_MPa", "worn.peak_pressure_MPa"),
    ("pinion_below_sap_wear_um", "pinion.below_sap_wear_um"),
    ("pinion_peak_wear_um", "pinion.peak_wear_um"),
    ("pinion_pitch_wear_um", "pinion.pitch_wear_um"),
    ("pinion_root_tip_wear_variation", "helical.wear.pinion.root_tip_variation"),
    ("pinion_root_wear_asymmetry", "helical.wear.pinion.root_asymmetry"),
    ("pinion_root_wear_um", "pinion.root_wear_um"),
    ("pinion_root_wear_variation", "helical.wear.pinion.root_variation"),
    ("pinion_tip_edge_wear_um", "pinion.tip_edge_wear_um"),
    ("pinion_tip_wear_variation", "helical.wear.pinion.tip_variation"),
    ("pinion_worn_volume_mm3", "pinion.worn_volume_mm3"),
    ("total_contact_ratio", "helical.total_contact_ratio"),
    ("transmission_error_peak_to_peak_new_um", "new.transmission_error_um.peak_to_peak"),
    ("transmission_error_peak_to_peak_worn_um", "worn.transmission_error_um.peak_to_peak"),
    ("transverse_contact_ratio", "geometry.transverse_contact_ratio"),
    ("volume_balance", "error.volume_balance"),
    ("wheel_below_sap_wear_um", "wheel.below_sap_wear_um"),
    ("wheel_peak_wear_um", "wheel.peak_wear_um"),
    ("wheel_pitch_wear_um", "wheel.pitch_wear_um"),
    ("wheel_root_tip_wear_variation", "helical.wear.wheel.root_tip_variation"),
    ("wheel_root_wear_um", "wheel.root_wear_um"),
    ("wheel_root_wear_variation", "helical.wear.wheel.root_variation"),
    ("wheel_tip_edge_wear_um", "wheel.tip_edge_wear_um"),
    ("wheel_tip_wear_variation", "helical.wear.wheel.tip_variation"),
    ("wheel_worn_volume_mm3", "wheel.worn_volume_mm3"),
];

/// What a figure was called in the version before is called now.
pub(crate) fn name_now(given: &str) -> Option<&'static str> {
    FORMER_NAMES.iter().find(|(former, _)| *former == given).map(|(_, now)| *now)
}

impl SweepFigure {
    /// The figure whose column has this name, or had it in the version before.
    pub(crate) fn find(name: &str) -> Option<&'static Self> {
        let name = name_now(name).unwrap_or(name);
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
    use crate::studies::evaluate::output::Output;

    /// Every figure is the number that stands at its name's path, and the names of the version before lead to one.
    #[test]
    fn figures_are_named_by_their_paths() {
        for figure in FIGURES.iter().filter(|figure| figure.name != PEAK_WEAR.name) {
            assert!(Output::find(figure.name).is_ok(), "{}", figure.name);
        }
        for (former, now) in FORMER_NAMES {
            assert_eq!(SweepFigure::find(former).map(|figure| figure.name), Some(now));
        }
    }

    #[test]
    fn every_figure_has_a_name_of_its_own() {
        for (at, figure) in FIGURES.iter().enumerate() {
            assert!(FIGURES[..at].iter().all(|other| other.name != figure.name), "{}", figure.name);
        }
    }
}
