//! Plots of wear coefficient and remaining life.

use crate::remaining_life::record::{BandPoint, GearLife, Interval, LifeUpdate};
use gearwear::report::chart::{Chart, Dash, INK, NEW, Trace, WORN, gear_colour};
use gearwear::report::html::number::{revolutions, significant};
use gearwear_bodies::reference::statistics::extent;

/// Part above the greatest of limit and measurements that is shown.
const ABOVE: f64 = 1.2;
/// Part of an interval of remaining life beyond the greatest median that is shown.
const BEYOND: f64 = 2.0;

/// Times in hours where the scene gives a speed, and in revolutions of the pinion otherwise.
#[derive(Debug, Clone, Copy)]
struct TimeAxis {
    per_revolution: f64,
    unit: &'static str,
}

impl TimeAxis {
    fn of(of: &GearLife) -> Self {
        let hours = of.measurements.first().and_then(|one| Some(one.hours? / one.revolutions));
        match hours {
            Some(per_revolution) => Self { per_revolution, unit: "h" },
            None => Self { per_revolution: 1.0, unit: "pinion revolutions" },
        }
    }

    fn title(self) -> &'static str {
        if self.unit == "h" { "time, h" } else { self.unit }
    }

    fn at(self, revolutions: f64) -> f64 {
        self.per_revolution * revolutions
    }

    /// Number of the unit as text.
    fn text(self, pinion_revolutions: f64) -> String {
        let value = self.at(pinion_revolutions);
        if self.unit == "h" { significant(value, 3) } else { revolutions(value) }
    }
}

/// Plots of a gear: wear, coefficient, remaining life.
pub(super) fn of_gear(of: &GearLife) -> Vec<Chart> {
    [Some(wear(of)), coefficient(of), remaining(of)].into_iter().flatten().collect()
}

/// Wear measured and to come.
fn wear(of: &GearLife) -> Chart {
    let gear = of.gear.name();
    let limit = of.limit.as_ref().map(|limit| limit.value);
    let measured: Vec<f64> = of.measurements.iter().filter_map(|one| one.shown).collect();
    let [_, greatest] = extent(measured.iter().copied().chain(limit));
    let top = ABOVE * greatest;
    let band: Vec<&BandPoint> = of.band.iter().filter(|at| at.low.is_some_and(|low| low <= top)).collect();
    let cut = |value: Option<f64>| Some(value.unwrap_or(top).min(top));
    let axis = TimeAxis::of(of);
    let x = || band.iter().map(|at| axis.at(at.revolutions));
    let there_and_back: Vec<f64> = x().chain(band.iter().rev().map(|at| axis.at(at.revolutions))).collect();
    let outline = band.iter().map(|at| cut(at.low)).chain(band.iter().rev().map(|at| cut(at.high)));
    let area = Trace::line("to come, 95 %", there_and_back, outline, ("rgba(0,0,0,0)", 0.0, Dash::Solid));
    let inside = || band.iter().filter(|at| at.median.is_some_and(|median| median <= top));
    let median = inside().map(|at| at.median);
    let times: Vec<f64> = of.measurements.iter().map(|one| axis.at(one.revolutions)).collect();
    let [_, last] = extent(times.iter().copied().chain(x()));
    let mut chart = Chart::new(format!("wear-{gear}"), format!("Wear of the {gear}, measured and to come"))
        .wide()
        .height(480)
        .x(axis.title())
        .x_range([0.0, 1.02 * last])
        .y(of.shown.words())
        .y_range([0.0, top])
        .reading(wear_reading(of))
        .add(area.filled(gear_colour(of.gear)).opacity(0.2))
        .line(
            "to come, median",
            inside().map(|at| axis.at(at.revolutions)),
            median,
            (gear_colour(of.gear), 2.2, Dash::Solid),
            "%{y:.4~g}",
        );
    let simulated = || of.simulated.iter().filter(|(_, wear)| wear.is_some_and(|wear| wear <= top));
    let stroke = (NEW, 1.6, Dash::Dashed);
    chart = chart.line(
        "simulated with median k",
        simulated().map(|at| axis.at(at.0)),
        simulated().map(|at| at.1),
        stroke,
        "%{y:.4~g}",
    );
    if let Some(limit) = limit {
        let line = Trace::line("limit", [0.0, 1.02 * last], [limit; 2], (WORN, 1.4, Dash::Dashed));
        chart = chart.add(line.hover("%{y:.4~g}"));
    }
    let points = Trace::points("measured", times, of.measurements.iter().map(|one| one.shown), (INK, "circle", 8));
    let half: Vec<f64> = of.measurements.iter().map(|one| shown_sigma(one.shown, one.sigma, one.value)).collect();
    let points = if half.iter().any(|half| *half > 0.0) { points.uncertain_by(&half) } else { points };
    chart.add(points.hover("%{y:.4~g}"))
}

/// Known standard deviation in the quantity shown.
fn shown_sigma(shown: Option<f64>, sigma: f64, value: f64) -> f64 {
    shown.unwrap_or(0.0) * sigma / value
}

fn wear_reading(of: &GearLife) -> String {
    let Some(last) = of.updates.last() else { return String::new() };
    let axis = TimeAxis::of(of);
    match (&last.life, &of.limit) {
        (Some(life), Some(limit)) if life.passed > 0.5 => format!(
            "The limit, {} of {}, has been passed with a probability of {} %.",
            limit.figure,
            significant(limit.value, 4),
            significant(100.0 * life.passed, 3)
        ),
        (Some(life), Some(limit)) => format!(
            "From the last measurement the limit, {} of {}, is {} {} away, 95 % interval {} to {}.",
            limit.figure,
            significant(limit.value, 4),
            axis.text(life.remaining_revolutions.median),
            axis.unit,
            axis.text(life.remaining_revolutions.low),
            axis.text(life.remaining_revolutions.high)
        ),
        _ => "The band holds the wear itself; a measurement scatters about it.".to_owned(),
    }
}

/// Updates after a measurement.
fn measured(of: &GearLife) -> impl Iterator<Item = &LifeUpdate> + Clone {
    of.updates.iter().skip(1)
}

/// Wear coefficient after each measurement.
fn coefficient(of: &GearLife) -> Option<Chart> {
    let gear = of.gear.name();
    let last = measured(of).last()?.coefficient_m2_per_N;
    let means = || of.measurements.iter().map(|one| one.mean_coefficient_m2_per_N);
    let all = measured(of).flat_map(|update| [update.coefficient_m2_per_N.low, update.coefficient_m2_per_N.high]);
    let [low, high] = extent(all.chain(means()).chain([of.coefficient_of_run_m2_per_N]));
    let reading = format!(
        "After the last measurement k is {} m²/N, 95 % interval {} to {}; the run has {}.",
        significant(last.median, 3),
        significant(last.low, 3),
        significant(last.high, 3),
        significant(of.coefficient_of_run_m2_per_N, 3)
    );
    let chart =
        Chart::new(format!("coefficient-{gear}"), format!("Wear coefficient of the {gear} after each measurement"))
            .height(420)
            .y("wear coefficient, m²/N")
            .y_range([low / 1.15, high * 1.15])
            .y_logarithmic()
            .reading(reading);
    let run = Trace::line("run", ends(of), [of.coefficient_of_run_m2_per_N; 2], (NEW, 1.4, Dash::Dashed));
    let axis = TimeAxis::of(of);
    let points = of.measurements.iter().map(|one| axis.at(one.revolutions));
    let means = Trace::points("mean up to a measurement", points, means(), (INK, "circle-open", 8));
    let chart = over_updates(chart, of, f64::INFINITY, |update| Some(update.coefficient_m2_per_N));
    Some(chart.add(run.hover("%{y:.3e}")).add(means.hover("%{y:.3e}")))
}

/// Remaining life after each measurement, where there is a limit.
fn remaining(of: &GearLife) -> Option<Chart> {
    let gear = of.gear.name();
    let axis = TimeAxis::of(of);
    let interval = |update: &LifeUpdate| {
        let Interval { median, low, high } = update.life?.remaining_revolutions;
        Some(Interval { median: axis.at(median), low: axis.at(low), high: axis.at(high) })
    };
    let [_, greatest] = extent(measured(of).filter_map(interval).map(|one| one.median));
    measured(of).find_map(interval)?;
    let [_, highest] = extent(measured(of).filter_map(interval).map(|one| one.high));
    let top = (BEYOND * greatest).min(1.05 * highest).max(f64::MIN_POSITIVE);
    let reading = if highest > top { "Intervals that reach beyond the plot are cut off at its top." } else { "" };
    let chart = Chart::new(format!("remaining-{gear}"), format!("Remaining life of the {gear} after each measurement"))
        .height(420)
        .y(&format!("left to the limit, {}", axis.unit))
        .y_range([0.0, top])
        .reading(reading);
    Some(over_updates(chart, of, top, interval))
}

/// First and last time of a measurement.
fn ends(of: &GearLife) -> [f64; 2] {
    let axis = TimeAxis::of(of);
    extent(of.measurements.iter().map(|one| axis.at(one.revolutions)))
}

/// Median and 95 % interval over the times of the measurements, cut off at `top`.
fn over_updates(chart: Chart, of: &GearLife, top: f64, interval: impl Fn(&LifeUpdate) -> Option<Interval>) -> Chart {
    let axis = TimeAxis::of(of);
    let shown: Vec<(f64, Interval)> =
        measured(of).filter_map(|update| Some((axis.at(update.revolutions), interval(update)?))).collect();
    let times = || shown.iter().map(|(at, _)| *at);
    let x: Vec<f64> = times().chain(shown.iter().rev().map(|(at, _)| *at)).collect();
    let low = shown.iter().map(|(_, one)| one.low.min(top));
    let high = shown.iter().rev().map(|(_, one)| one.high.min(top));
    let area = Trace::line("95 %", x, low.chain(high), ("rgba(0,0,0,0)", 0.0, Dash::Solid));
    let colour = gear_colour(of.gear);
    let median =
        Trace::line("median", times(), shown.iter().map(|(_, one)| one.median.min(top)), (colour, 2.2, Dash::Solid));
    let [first, last] = ends(of);
    let margin = 0.03 * last.max(first);
    let chart = chart.x(axis.title()).x_range([(first - margin).max(0.0), last + margin]);
    chart.add(area.filled(colour).opacity(0.2)).add(median.with_points("circle", 6).hover("%{y:.4~g}"))
}
