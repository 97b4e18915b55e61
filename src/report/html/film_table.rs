//! Oil, films, friction, losses and the figures of standards as tables.

use maud::{Markup, html};

use super::number::{fixed, percent, significant};
use super::page;
use super::table::{cells, line, list, row, table};
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::lubrication::{
    FilmSummary, LubricationSummary, MethodBSummary, OilSummary, ScuffingSummary,
};
use gearwear_physics::results::run::Summary;

pub(crate) fn tables(s: &Summary) -> Markup {
    let Some(of) = &s.lubrication else { return Markup::default() };
    html! {
        @if let Some(oil) = &of.oil { (self::oil(oil)) }
        @if let Some(film) = &of.film { (self::film(film, of.method_b.as_ref())) }
        (losses(of))
        @if let Some(method_b) = &of.method_b { (self::method_b(method_b)) }
        @if let Some(reason) = &of.method_b_null_because { (page::note(&format!("No ISO/TS 6336-22 Method B: {reason}."))) }
        @if let Some(scuffing) = &of.scuffing { (self::scuffing(scuffing)) }
    }
}

fn oil(oil: &OilSummary) -> Markup {
    table(
        "Oil",
        &["value"],
        [
            row("Temperature into the mesh", "°C", [oil.temperature_C]),
            row("Kinematic viscosity there", "mm²/s", [oil.kinematic_viscosity_mm2_per_s]),
            row("Dynamic viscosity there", "mPa·s", [oil.dynamic_viscosity_mPas]),
            row("Pressure–viscosity coefficient there", "1/GPa", [oil.pressure_viscosity_per_GPa]),
            row("Temperature of the teeth", "°C", [oil.bulk_temperature_C]),
            row("Dynamic viscosity at the teeth", "mPa·s", [oil.dynamic_viscosity_at_bulk_mPas]),
        ],
    )
}

fn film(f: &FilmSummary, method_b: Option<&MethodBSummary>) -> Markup {
    let mut rows = vec![
        row("λ (local film over Ra), minimum", "", [f.lambda_new.min, f.lambda_worn.min]),
        row("λ, mean", "", [f.lambda_new.mean, f.lambda_worn.mean]),
        row("Central film thickness, minimum", "µm", [f.central_film_new_um.min, f.central_film_worn_um.min]),
        row("Central film thickness, mean", "µm", [f.central_film_new_um.mean, f.central_film_worn_um.mean]),
        row("Minimum film thickness, lowest", "µm", [f.minimum_film_new_um.min, f.minimum_film_worn_um.min]),
        row("Flash temperature, maximum, tip edges included", "K", [f.greatest_flash_new_K, f.greatest_flash_worn_K]),
    ];
    if f.tip_edge_lambda_new.is_some() || f.tip_edge_lambda_worn.is_some() {
        let said = |value: Option<f64>| value.map_or("–".to_owned(), |value| fixed(value, 3));
        rows.push(row("λ of tip edges, minimum", "", [f.tip_edge_lambda_new, f.tip_edge_lambda_worn].map(said)));
    }
    if let (Some(new), Some(worn)) = (f.composite_lambda_new, f.composite_lambda_worn) {
        rows.push(row("Minimum film over √(Rq₁² + Rq₂²), lowest", "", [new.min, worn.min]));
        rows.push(row("The same, mean", "", [new.mean, worn.mean]));
    }
    if let (Some(new), Some(worn)) = (f.wear_factor_new, f.wear_factor_worn) {
        for gear in Gear::BOTH {
            let title = format!("Factor of the film on the wear coefficient of the {}, mean", gear.name());
            rows.push(row(title, "", [fixed(new[gear], 3), fixed(worn[gear], 3)]));
        }
    }
    if let (Some(new), Some(worn)) = (f.micropitting_safety_new, f.micropitting_safety_worn) {
        rows.push(row("Safety against micropitting S_λ, Method A", "", [fixed(new, 2), fixed(worn, 2)]));
    }
    if let Some(safety) = method_b.and_then(|b| b.micropitting_safety) {
        rows.push(row("The same, Method B", "", cells![fixed(safety, 2), ""]));
    }
    table("Film along the path of contact", &["new", "worn"], rows)
}

fn losses(of: &LubricationSummary) -> Markup {
    let (friction, losses) = (&of.friction, &of.losses);
    let efficiency = [losses.efficiency_new, losses.efficiency_worn].map(percent);
    table(
        "Friction and losses of the mesh",
        &["new", "worn"],
        [
            row("Mean coefficient of friction", "", [friction.mean_new, friction.mean_worn].map(|mu| fixed(mu, 4))),
            row(
                "Loss factor H_VL of the run’s own loads",
                "",
                [losses.loss_factor_local_new, losses.loss_factor_local_worn].map(|factor| fixed(factor, 4)),
            ),
            row("Loss factor H_V, Ohlendorf", "", cells![fixed(losses.loss_factor_ohlendorf, 4), ""]),
            row("Mesh power loss", "W", [losses.mesh_power_loss_new_W, losses.mesh_power_loss_worn_W]),
            row("Efficiency of the mesh", "", efficiency),
        ],
    )
}

fn method_b(b: &MethodBSummary) -> Markup {
    let of_points = b.points.iter().map(|p| {
        line(cells![
            p.name.as_str(),
            fixed(p.load_sharing_factor, 3),
            p.pressure_MPa,
            p.contact_temperature_C,
            fixed(p.film_um, 3),
            fixed(p.lambda, 3)
        ])
    });
    list(
        "ISO/TS 6336-22 Method B, without the run’s contact",
        ["", "X_Y", "p_dyn, MPa", "θ_B, °C", "h, µm", "λ_GF"],
        of_points,
    )
}

fn scuffing(s: &ScuffingSummary) -> Markup {
    let said = [
        ("Contact temperature, ISO/TS 6336-20", "°C", s.contact_temperature_C),
        ("Maximum flash temperature", "K", s.greatest_flash_K),
        ("Scuffing temperature", "°C", s.scuffing_temperature_C),
        ("Safety against scuffing S_B", "", s.scuffing_safety),
        ("Integral temperature, ISO/TS 6336-21", "°C", s.integral_temperature_C),
        ("Integral scuffing temperature", "°C", s.integral_scuffing_temperature_C),
        ("Safety against scuffing S_intS", "", s.integral_scuffing_safety),
    ];
    let rows = said.into_iter().filter_map(|(label, unit, value)| {
        let value = if unit.is_empty() { fixed(value?, 2) } else { significant(value?, 4) };
        Some(row(label, unit, [value]))
    });
    let reasons = [&s.flash_null_because, &s.integral_null_because];
    html! {
        (table("Scuffing", &["value"], rows))
        @for reason in reasons.into_iter().flatten() { (page::note(&format!("{reason}."))) }
    }
}
