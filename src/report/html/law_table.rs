//! The wear law, its regime and where it holds, and the temperatures of the contact, as tables and a sentence.

use maud::{Markup, html};

use super::number::{percent, significant};
use super::page;
use super::table::{cells, row, table};
use crate::results::chemistry::{GreatestRise, TemperatureSummary, WearLawSummary};
use crate::results::run::Summary;

pub(crate) fn tables(s: &Summary) -> Markup {
    html! { (law(&s.wear)) @if let Some(t) = &s.temperature { (temperature(t)) } }
}

fn law(w: &WearLawSummary) -> Markup {
    let k = |value: f64| format!("{value:.3e}");
    let mut rows = vec![
        row("Wear law", "", [&*w.law]),
        row("Coefficient as given", "mm³/(N·m)", [k(w.coefficient_mm3_per_Nm)]),
        row("Effective where mild, new", "mm³/(N·m)", [k(w.effective_coefficient_new_mm3_per_Nm)]),
        row("Effective where mild, worn", "mm³/(N·m)", [k(w.effective_coefficient_worn_mm3_per_Nm)]),
        row("Regime of the IRG diagram", "", [w.irg_regime.name()]),
    ];
    rows.extend(w.irg_regime_severe.map(|regime| row("Regime where wear is severe", "", [regime.name()])));
    table("Wear law", &["value"], rows)
}

fn temperature(t: &TemperatureSummary) -> Markup {
    let by = &t.by_method;
    let both = |label, of: &GreatestRise| row(label, "K", cells![of.greatest_rise_new_K, of.greatest_rise_worn_K]);
    let rows = [
        both("Heat equation", &by.heat_equation),
        both("Williams", &by.williams),
        both("Tian and Kennedy", &by.tian_kennedy),
    ];
    table("Greatest rise of the contact’s temperature", &["new", "worn"], rows)
}

/// What the tables mean, in words.
pub(crate) fn note(s: &Summary) -> Markup {
    let w = &s.wear;
    let mut text = format!(
        "Where wear is mild the {} law wears by {:.2e} mm³/(N·m) on average over the sliding work of a mesh of the new pair: regime {} of the IRG \
         transition diagram (I below 1e-9, II from 1e-8 to 1e-6, III above 1e-5).",
        w.law,
        w.effective_coefficient_new_mm3_per_Nm,
        w.irg_regime.name()
    );
    text.push_str(
        " The coefficient k is the volume that each flank loses per newton of load and metre of sliding; depth is k times pressure times \
         sliding distance (1e-17 m²/N is 1e-8 mm³/(N·m)). Repeated tests under equal conditions scatter by about half of it, and the depth \
         of wear with it, whatever the error of the computation.",
    );
    if let (Some(k), Some(regime)) = (w.severe_coefficient_mm3_per_Nm, w.irg_regime_severe) {
        text.push_str(&format!(" Where wear is severe it is {k:.2e} mm³/(N·m), regime {}.", regime.name()));
    }
    if let (Some([low, high]), Some(new), Some(worn)) =
        (w.valid_temperature_C, w.work_outside_validity_new, w.work_outside_validity_worn)
    {
        text.push_str(&format!(
            " It holds from about {} to {} °C; {} of the work is done outside that new and {} worn.",
            significant(low, 3),
            significant(high, 3),
            percent(new),
            percent(worn)
        ));
    }
    page::note(&text)
}
