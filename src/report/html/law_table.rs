//! The wear law, its regime and where it holds, and the temperatures of the contact, as tables and a sentence.

use maud::{Markup, html};

use super::number::{fixed, percent, significant};
use super::page;
use super::table::{cells, row, table};
use gearwear_bodies::gear::PerGear;
use gearwear_physics::results::chemistry::{GreatestRise, TemperatureSummary, ToothTemperatureSummary, WearLawSummary};
use gearwear_physics::results::run::Summary;

/// Temperatures of teeth and contact; nothing where none was asked for.
pub fn temperatures(s: &Summary) -> Markup {
    html! {
        @if let Some(t) = &s.temperature {
            @if let Some(tooth) = &t.tooth { (teeth(tooth)) }
            (temperature(t))
        }
    }
}

/// One column for both gears, or one for each where each has its own law.
pub fn law(s: &Summary) -> Markup {
    let (columns, laws): (&[&str], Vec<&WearLawSummary>) = match &s.wear {
        Some(both) => (&["value"], vec![both]),
        None => (&["pinion", "wheel"], vec![&s.wear_of_gear.pinion, &s.wear_of_gear.wheel]),
    };
    let all = |label, unit, of: &dyn Fn(&WearLawSummary) -> String| row(label, unit, laws.iter().map(|law| of(law)));
    let k = |value: f64| format!("{value:.3e}");
    let mut rows = vec![
        all("Wear law", "", &|w| w.law.clone()),
        all("Coefficient as given", "mm³/(N·m)", &|w| k(w.coefficient_mm3_per_Nm)),
        all("Effective where mild, new", "mm³/(N·m)", &|w| k(w.effective_coefficient_new_mm3_per_Nm)),
        all("Effective where mild, worn", "mm³/(N·m)", &|w| k(w.effective_coefficient_worn_mm3_per_Nm)),
        all("Regime of the IRG diagram", "", &|w| w.irg_regime.name().to_owned()),
    ];
    if laws.iter().any(|law| law.irg_regime_severe.is_some()) {
        rows.push(all("Regime where wear is severe", "", &|w| {
            w.irg_regime_severe.map_or("–", |regime| regime.name()).to_owned()
        }));
    }
    table("Wear law", columns, rows)
}

fn teeth(of: &PerGear<Option<ToothTemperatureSummary>>) -> Markup {
    type Value = fn(&ToothTemperatureSummary) -> Option<f64>;
    let both = |value: Value| [&of.pinion, &of.wheel].map(|own| own.as_ref().and_then(value));
    let said =
        |values: [Option<f64>; 2]| values.map(|value| value.map_or("–".to_owned(), |value| significant(value, 4)));
    let mut rows = vec![
        row("Flank", "°C", said(both(|at| Some(at.flank_C)))),
        row("Root", "°C", said(both(|at| Some(at.root_C)))),
        row("Young’s modulus", "GPa", said(both(|at| at.young_modulus_GPa))),
    ];
    let factors = both(|at| at.wear_factor);
    if factors.iter().any(Option::is_some) {
        let factors = factors.map(|factor| factor.map_or("–".to_owned(), |factor| fixed(factor, 3)));
        rows.push(row("Factor on the wear coefficient", "", factors));
    }
    table("Temperature of the teeth, VDI 2736-2", &["pinion", "wheel"], rows)
}

fn temperature(t: &TemperatureSummary) -> Markup {
    let by = &t.by_method;
    let both = |label, of: &GreatestRise| row(label, "K", cells![of.greatest_rise_new_K, of.greatest_rise_worn_K]);
    let rows = [
        both("Heat equation", &by.heat_equation),
        both("Williams", &by.williams),
        both("Tian and Kennedy", &by.tian_kennedy),
    ];
    table("Maximum temperature rise of the contact", &["new", "worn"], rows)
}

/// What the tables mean, in words.
pub fn note(s: &Summary) -> Markup {
    let mut text = match &s.wear {
        Some(both) => effect(both, ""),
        None => format!(
            "{} {}",
            effect(&s.wear_of_gear.pinion, " of the pinion"),
            effect(&s.wear_of_gear.wheel, " of the wheel")
        ),
    };
    text.push_str(
        " The coefficient k is the volume that each flank loses per newton of load and metre of sliding; depth is k times pressure times \
         sliding distance (1e-17 m²/N is 1e-8 mm³/(N·m)). Repeated tests under equal conditions scatter by about half of it, and the depth \
         of wear with it, whatever the error of the computation.",
    );
    match &s.wear {
        Some(both) => text.push_str(&bounds(both, "it")),
        None => {
            text.push_str(&bounds(&s.wear_of_gear.pinion, "that of the pinion"));
            text.push_str(&bounds(&s.wear_of_gear.wheel, "that of the wheel"));
        }
    }
    page::note(&text)
}

/// What the law `of` some gear comes to on average.
fn effect(w: &WearLawSummary, of: &str) -> String {
    if w.coefficient_mm3_per_Nm <= 0.0 {
        return format!("The coefficient{of} is 0: that gear does not wear.");
    }
    format!(
        "Where wear is mild the law {}{of} has an effective coefficient of {:.2e} mm³/(N·m), its mean over the sliding work of a mesh of the new \
         pair: regime {} of the IRG transition diagram (I below 1e-9, II from 1e-8 to 1e-6, III above 1e-5).",
        w.law,
        w.effective_coefficient_new_mm3_per_Nm,
        w.irg_regime.name()
    )
}

/// Where wear by the law is severe, and where the law holds.
fn bounds(w: &WearLawSummary, it: &str) -> String {
    let mut text = String::new();
    if let (Some(k), Some(regime)) = (w.severe_coefficient_mm3_per_Nm, w.irg_regime_severe) {
        text.push_str(&format!(" Where wear is severe {it} is {k:.2e} mm³/(N·m), regime {}.", regime.name()));
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
    text
}
