//! The first mesh orders of the loaded transmission error, new and worn.

use crate::report::chart::{BarPlaces, Chart, NEW, Trace, WORN};
use maud::Markup;

use super::number::{change, figure, plotted};
use super::table::{cells, row};
use gearwear_physics::results::run::Summary;

/// Rows of the mesh orders after the first, which is a main figure.
pub(super) fn higher(s: &Summary) -> impl Iterator<Item = Markup> {
    let orders = s.new.mesh_orders_um.iter().zip(&s.worn.mesh_orders_um).enumerate().skip(1);
    orders.map(|(i, (&new, &worn))| {
        let label = format!("Transmission error, mesh order {}", i + 1);
        row(label, "µm", cells![new, worn, change(new, worn)])
    })
}

/// None where no mesh order is known.
pub(super) fn new_and_worn(s: &Summary) -> Option<Chart> {
    let orders = [&s.new.mesh_orders_um, &s.worn.mesh_orders_um];
    let (first_new, first_worn) = (*orders[0].first()?, *orders[1].first()?);
    let bars = [("new", NEW), ("worn", WORN)].into_iter().zip(orders).map(|((name, colour), amplitudes)| {
        let names: Vec<String> = (1..=amplitudes.len()).map(|order| format!("{order}×")).collect();
        let heights: Vec<f64> = amplitudes.iter().map(|&um| plotted(um)).collect();
        Trace::bars(name, BarPlaces::Named(names), heights, colour).hover("%{y:.4~g} µm")
    });
    let reading = format!(
        "The tooth-mesh frequency itself has an amplitude of {} µm new and {} µm worn ({}).",
        figure(first_new),
        figure(first_worn),
        change(first_new, first_worn),
    );
    let chart = Chart::new("mesh-orders", "Mesh orders of the transmission error")
        .x("multiple of the tooth-mesh frequency")
        .y("amplitude, µm")
        .add_all(bars)
        .reading(reading);
    Some(chart)
}
