//! Pressure along the flank beside Hertz's, at A to E or at the position asked for.

use super::pressure_table::hertz;
use crate::report::chart::Chart;
use crate::report::html::number::{change, figure, percent, significant};
use crate::report::pressure_plot::beside_hertz;
use gearwear_physics::results::fem_pair::{FemPairRecord, PressureCurve};

/// Half-widths shown on either side.
const SHOWN: f64 = 1.6;

/// The reference pair's at A–E, every pair's at a position asked for.
pub(super) fn all(record: &FemPairRecord) -> Vec<Chart> {
    record.pressure.iter().filter(|curve| curve.point.is_none() || curve.row.pair == 0).map(pressure).collect()
}

fn pressure(of: &PressureCurve) -> Chart {
    let hertz = hertz(of);
    let reach_mm = SHOWN * hertz.half_width_mm.max(of.row.half_width_mm);
    let nodes = of.along_mm.iter().copied().zip(of.pressure_MPa.iter().copied());
    let shown: Vec<(f64, f64)> = nodes.filter(|(s, _)| s.abs() <= reach_mm).collect();
    let top = of.row.peak_pressure_MPa.max(hertz.peak_pressure_mpa);
    let (id, title) = match (of.point.as_deref(), of.row.pair) {
        (Some(point), _) => (format!("pressure-{}", point.to_lowercase()), format!("Contact pressure at {point}")),
        (None, 0) => ("pressure-reference".to_owned(), "Contact pressure of the reference pair".to_owned()),
        (None, pair) if pair > 0 => (format!("pressure-ahead-{pair}"), "Contact pressure of the pair ahead".to_owned()),
        (None, pair) => (format!("pressure-behind-{}", -pair), "Contact pressure of the pair behind".to_owned()),
    };
    let chart =
        Chart::new(id, title).height(360).x("along the flank towards the pinion’s tip, mm").reading(reading(of));
    beside_hertz(chart, &shown, "Hertz, same load", Some(hertz), [-reach_mm, reach_mm]).y_up_to(top)
}

fn reading(of: &PressureCurve) -> String {
    let row = &of.row;
    let loaded =
        format!("At {} mm the pair carries {} of the load", significant(row.position_mm, 4), percent(row.load_share));
    if row.at_sharp_edge {
        return format!(
            "{loaded}; a sharp tip edge takes part of it. The peak of {} MPa there is singular: it grows with every \
             refinement; Hertz’s contact, which has no edge, has {} MPa.",
            figure(row.peak_pressure_MPa),
            figure(row.hertz_pressure_MPa)
        );
    }
    format!(
        "{loaded}. The pressure peaks with {} MPa over a half-width of {} mm; Hertz has {} MPa (finite elements {}) and {} mm.",
        figure(row.peak_pressure_MPa),
        figure(row.half_width_mm),
        figure(row.hertz_pressure_MPa),
        change(row.hertz_pressure_MPa, row.peak_pressure_MPa),
        figure(row.hertz_half_width_mm),
    )
}
