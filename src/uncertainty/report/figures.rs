//! The plots of a study of uncertainty: distributions, indices, wear over both flanks.

use crate::report::chart::{BarPlaces, Bars, Chart, Dash, Drawn, INK, Trace, gear_colour, padded};
use crate::report::html::number::{figure, percent};
use crate::uncertainty::record::{FactorIndices, FlankBand, OutputRecord, UncertaintyRecord};
use gearwear_bodies::reference::sobol_indices::Index;
use gearwear_bodies::reference::statistics::extent;

/// Number of bars of a distribution.
const BARS: usize = 30;

/// Distributions at the beginning of the page, beside the lives.
const SHOWN_FIRST: usize = 2;

/// The plots by where they stand on the page.
pub(super) struct UncertaintyPlots {
    pub first: Vec<Chart>,
    pub indices: Vec<Chart>,
    pub others: Vec<Chart>,
}

pub(super) fn of(record: &UncertaintyRecord) -> UncertaintyPlots {
    let outputs = record.outputs.iter().enumerate();
    let is_life = |(_, output): &(usize, &OutputRecord)| output.censored.is_some();
    let distributions = outputs.clone().filter_map(|(number, output)| distribution(number, output));
    let mut others: Vec<Chart> = distributions.collect();
    let mut first: Vec<Chart> = others.drain(..others.len().min(SHOWN_FIRST)).collect();
    first.extend(outputs.clone().filter(is_life).filter_map(|(number, output)| life(number, output)));
    others.extend(record.bands.0.iter().filter_map(band));
    let indices = outputs.filter_map(|(number, output)| indices(number, output)).collect();
    UncertaintyPlots { first, indices, others }
}

/// Probability that the limit of a life is reached by then; those whose life is longer than their duration count as not reached.
fn life(number: usize, output: &OutputRecord) -> Option<Chart> {
    let lives: Vec<f64> = output.sorted.iter().copied().filter(|life| life.is_finite()).collect();
    let (first, last) = (*lives.first()?, *lives.last()?);
    if last <= first {
        return None;
    }
    let of_all = 100.0 / output.sorted.len() as f64;
    let steps = lives
        .iter()
        .enumerate()
        .flat_map(|(before, &life)| [(life, before as f64 * of_all), (life, (before + 1) as f64 * of_all)]);
    let (at, reached): (Vec<f64>, Vec<f64>) = steps.unzip();
    let [p05, _, p50, ..] = output.quantiles.all();
    let known = [("one in twenty has", p05), ("half have", p50)];
    let known: Vec<String> = known
        .into_iter()
        .filter_map(|(who, life)| Some(format!("{who} reached it by {} {}", figure(life?), output.unit)))
        .collect();
    let longer = output
        .censored
        .filter(|part| *part > 0.0)
        .map_or_else(String::new, |part| format!(" {} have not reached it within their duration.", percent(part)));
    let reading = if known.is_empty() {
        longer.trim_start().to_owned()
    } else {
        format!("Of the samples {}.{longer}", known.join(", "))
    };
    Some(
        Chart::new(format!("life-{number}"), format!("{}: probability that it has ended", output.meaning))
            .height(320)
            .legend(false)
            .x(&with_unit(output))
            .x_range(padded(first, last))
            .y("part of the samples, %")
            .y_up_to(100.0)
            .line("ended", at, reached, ("var(--wheel)", 2.2, Dash::Solid), "%{y:.2f} %")
            .reading(reading),
    )
}

/// Title of the axis; the limit of a life stands in the title of the plot.
fn with_unit(output: &OutputRecord) -> String {
    let name = if output.censored.is_some() { "life" } else { &output.meaning };
    if output.unit.is_empty() { name.to_owned() } else { format!("{name}, {}", output.unit) }
}

/// Histogram of the samples as parts of all.
fn distribution(number: usize, output: &OutputRecord) -> Option<Chart> {
    let finite: Vec<f64> = output.sorted.iter().copied().filter(|value| value.is_finite()).collect();
    let (low, high) = (*finite.first()?, *finite.last()?);
    if high <= low {
        return None;
    }
    let width = (high - low) / BARS as f64;
    let mut counts = [0_usize; BARS];
    finite.iter().for_each(|value| counts[(((value - low) / width) as usize).min(BARS - 1)] += 1);
    let middles: Vec<f64> = (0..BARS).map(|bar| low + (bar as f64 + 0.5) * width).collect();
    let parts: Vec<f64> = counts.iter().map(|&count| 100.0 * count as f64 / output.sorted.len() as f64).collect();
    let bars = Trace::bars("samples", BarPlaces::At { middles, width }, parts, "var(--pinion)")
        .hover("%{x:.4~g}: %{y:.2f} %<extra></extra>")
        .unlisted();
    let [p05, _, p50, _, p95] = output.quantiles.all();
    let marks = [("5 %", p05), ("50 %", p50), ("95 %", p95)];
    let marks = marks.into_iter().filter_map(|(name, value)| Some((name, value?)));
    let unit = &output.unit;
    let reading = match (p05, p95) {
        (Some(p05), Some(p95)) => {
            format!("Nine in ten samples lie between {} and {} {unit}.", figure(p05), figure(p95))
        }
        _ => format!(
            "{} of the samples do not come to the limit within their duration and are not shown.",
            percent(output.censored.unwrap_or(0.0))
        ),
    };
    Some(
        Chart::new(format!("distribution-{number}"), &output.meaning)
            .read_nearest()
            .legend(false)
            .height(320)
            .x(&with_unit(output))
            .y("part of the samples, %")
            .add(bars)
            .mark(marks, "50 %")
            .reading(reading),
    )
}

/// Share of the variance that each factor explains, with intervals.
fn indices(number: usize, output: &OutputRecord) -> Option<Chart> {
    let indices = output.indices.as_ref()?;
    let most = indices.iter().max_by(|a, b| a.total.value.total_cmp(&b.total.value))?;
    Some(
        Chart::new(format!("indices-{number}"), format!("Sobol indices: {}", output.meaning))
            .read_nearest()
            .height(150 + 56 * indices.len())
            .x("part of the variance")
            .y("")
            .add(bars(indices, "total", "var(--wheel)", |one| one.total))
            .add(bars(indices, "first order", "var(--pinion)", |one| one.first))
            .reading(format!(
                "{} matters most: without knowing it, {} of the variance stays; alone it explains {}. Lines: 95 % intervals.",
                most.factor,
                percent(most.total.value.clamp(0.0, 1.0)),
                percent(most.first.value.clamp(0.0, 1.0)),
            )),
    )
}

/// Bars of one kind of index with their intervals, the first factor at the top.
fn bars(indices: &[FactorIndices], name: &str, colour: &str, of: fn(&FactorIndices) -> Index) -> Trace {
    let factors: Vec<String> = indices.iter().rev().map(|one| wrapped(&one.factor)).collect();
    let shown: Vec<Index> = indices.iter().rev().map(of).collect();
    let above: Vec<f64> = shown.iter().map(|index| index.high - index.value).collect();
    let below: Vec<f64> = shown.iter().map(|index| index.value - index.low).collect();
    let bars = Bars {
        places: BarPlaces::Named(factors),
        length: shown.iter().map(|index| index.value).collect(),
        colour: colour.to_owned(),
        is_horizontal: true,
        interval: Some([below, above]),
    };
    Trace::new(Drawn::Bars(bars), name).hover("%{x:.3f}")
}

/// Key with a line break after each part, to keep the plot wide.
fn wrapped(key: &str) -> String {
    key.rsplit_once('.').map_or_else(|| key.to_owned(), |(tables, name)| format!("{tables}.\n{name}"))
}

/// Outline of the area between two curves.
fn area(name: &str, radius: &[f64], [below, above]: [&Vec<f64>; 2]) -> Trace {
    let x = radius.iter().chain(radius.iter().rev()).copied();
    let y = below.iter().chain(above.iter().rev()).copied();
    Trace::line(name, x, y, ("rgba(0,0,0,0)", 0.0, Dash::Solid))
}

/// Quantiles of wear over a flank.
fn band(FlankBand { flank, in_words, gear, band }: &FlankBand) -> Option<Chart> {
    let gear = *gear;
    let [p05, p25, p50, p75, p95] = &band.quantiles_um;
    let deepest = p95.iter().copied().fold(0.0, f64::max);
    if deepest <= 0.0 {
        return None;
    }
    let radius = &band.radius_mm;
    let [low, high] = extent(radius.iter().copied());
    let [x, median, nominal] = [radius, p50, &band.nominal_um].map(|values| values.iter().copied());
    Some(
        Chart::new(format!("band-{}", flank.replace(['.', '_'], "-")), format!("Wear over the flank of the {in_words}"))
            .wide()
            .height(420)
            .x(&format!("radius on the {in_words}, mm"))
            .x_range(padded(low, high))
            .x_format(".3f")
            .y("wear depth, µm")
            .y_down_to(deepest)
            .add(area("5 to 95 %", radius, [p05, p95]).filled(gear_colour(gear)).opacity(0.16))
            .add(area("25 to 75 %", radius, [p25, p75]).filled(gear_colour(gear)).opacity(0.28))
            .line("median", x.clone(), median, (gear_colour(gear), 2.2, Dash::Solid), "%{y:.3f} µm")
            .line("scene as given", x, nominal, (INK, 1.4, Dash::Dashed), "%{y:.3f} µm")
            .reading(format!(
                "Quantiles of the samples at each radius, maximum over the face width; at the deepest place 95 % of them have worn less than {} µm. The error \
                 of the fast model is not in them.",
                figure(deepest)
            )),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::chart::Curve;
    use crate::uncertainty::record::Quantiles;

    /// Of four samples one does not come to its limit: after the first life a quarter has ended, after the last three quarters.
    #[test]
    fn ver_a_life_is_the_part_of_all_samples_that_has_ended() {
        let output = OutputRecord {
            output: "life".to_owned(),
            meaning: "Life".to_owned(),
            unit: "h".to_owned(),
            nominal: None,
            model_error: None,
            samples: 4,
            censored: Some(0.25),
            mean: None,
            standard_deviation: None,
            quantiles: Quantiles { p05: Some(10.0), p25: None, p50: Some(20.0), p75: None, p95: None },
            indices: None,
            no_indices_because: None,
            surface_correction: None,
            surface_difference: None,
            response_surface_error: None,
            sorted: vec![10.0, 20.0, 40.0, f64::INFINITY],
        };
        let chart = life(0, &output).unwrap();
        let Drawn::Curve(Curve { x, y, .. }) = &chart.traces[0].drawn else { panic!("a curve") };
        assert_eq!(x, &[10.0, 10.0, 20.0, 20.0, 40.0, 40.0]);
        assert_eq!(y, &[0.0, 25.0, 25.0, 50.0, 50.0, 75.0]);
        assert!(
            chart.reading.contains("half have reached it by 20.00 h") && chart.reading.contains("25.0"),
            "{}",
            chart.reading
        );
        assert!(life(0, &OutputRecord { sorted: vec![f64::INFINITY], ..output }).is_none());
    }
}
