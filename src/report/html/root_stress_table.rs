//! Nominal root stress by the standards.

use maud::Markup;

use super::table::{row, table};
use gearwear_bodies::gear::PerGear;
use gearwear_physics::results::root_stress::{RootSectionSummary, RootStressSummary};

type Standard = fn(&RootStressSummary) -> &Option<RootSectionSummary>;

fn both(
    of: &PerGear<RootStressSummary>,
    label: &str,
    unit: &str,
    by: Standard,
    value: fn(&RootSectionSummary) -> f64,
) -> Markup {
    row(label, unit, [&of.pinion, &of.wheel].map(|gear| by(gear).as_ref().map(value)))
}

/// The stresses, one row a standard.
pub fn stresses(of: &PerGear<RootStressSummary>) -> [Markup; 2] {
    let stress = |label, by| both(of, label, "MPa", by, |section| section.nominal_stress_MPa);
    [
        stress("ISO 6336-3 Method B, nominal", |gear| &gear.iso_6336_3),
        stress("VDI 2736-2, load at the tip, nominal", |gear| &gear.vdi_2736),
    ]
}

pub fn tables(of: &PerGear<RootStressSummary>) -> Markup {
    let factor = |label, value| both(of, label, "", |gear| &gear.iso_6336_3, value);
    let form = factor("its form factor Y_F", |section| section.form_factor);
    let correction = factor("its stress correction Y_S", |section| section.stress_correction_factor);
    let [iso, vdi] = stresses(of);
    table("Root stress without load factors", &["pinion", "wheel"], [iso, form, correction, vdi])
}
