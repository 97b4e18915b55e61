//! Over the path of contact from A to E: load sharing, pressure, transmission error, stress at the roots.

use crate::report::chart::{Chart, Dash, MUTED, NEW, PATH, Trace, WORN, gear_colour, padded};
use crate::report::html::number::{figure, percent, significant};
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::statistics::extent;
use gearwear_physics::results::fem_pair::{FemCycleRow, FemPairRecord, RootSummary};

pub(super) fn all(record: &FemPairRecord) -> Vec<Chart> {
    if record.mesh_cycle.is_empty() {
        return Vec::new();
    }
    let points = &record.summary.geometry.curvature_radius_mm;
    let [sharing, error, root] =
        [load_sharing(record), transmission_error(record), root_stress(record)].map(|chart| chart.over_path(points));
    vec![sharing, pressure(record), error, root]
}

fn of_pair(record: &FemPairRecord, pair: i32) -> Vec<&FemCycleRow> {
    record.mesh_cycle.iter().filter(|row| row.pair == pair).collect()
}

/// One row for each position.
fn positions(record: &FemPairRecord) -> Vec<&FemCycleRow> {
    let mut rows: Vec<&FemCycleRow> = record.mesh_cycle.iter().collect();
    rows.dedup_by_key(|row| row.position_mm.to_bits());
    rows
}

/// The numbers of the pairs that touch anywhere, the reference pair first.
fn pairs(record: &FemPairRecord) -> Vec<i32> {
    let mut pairs: Vec<i32> = record.mesh_cycle.iter().map(|row| row.pair).collect();
    pairs.sort_by_key(|pair| (pair.abs(), *pair));
    pairs.dedup();
    pairs
}

fn pair_name(pair: i32) -> String {
    match pair {
        0 => "reference pair".to_owned(),
        1 => "pair ahead".to_owned(),
        -1 => "pair behind".to_owned(),
        pair if pair > 0 => format!("{pair} ahead"),
        pair => format!("{} behind", -pair),
    }
}

/// Values over positions with a gap wherever the pair does not touch.
fn with_gaps(record: &FemPairRecord, pair: i32, value: impl Fn(&FemCycleRow) -> f64) -> (Vec<f64>, Vec<Option<f64>>) {
    let mut own = of_pair(record, pair).into_iter().peekable();
    let at = |at: &FemCycleRow| (at.position_mm, own.next_if(|row| row.position_mm == at.position_mm).map(&value));
    positions(record).into_iter().map(at).unzip()
}

fn load_sharing(record: &FemPairRecord) -> Chart {
    let styles = [(PATH, 2.4, Dash::Solid), (WORN, 1.6, Dash::Dashed), (NEW, 1.6, Dash::Dot)];
    let shares = pairs(record).into_iter().zip(styles.into_iter().cycle()).map(|(pair, style)| {
        let (x, y) = with_gaps(record, pair, |row| row.load_share);
        Trace::line(pair_name(pair), x, y, style).hover("%{y:.3f}")
    });
    let reading = record.summary.points.as_ref().map_or_else(String::new, |points| {
        let share = &points.load_share;
        format!(
            "The reference pair takes {} of the load at A, {} at B, {} at C, {} at D and {} at E. Where its neighbours touch \
             before their A or after their E, it carries less than all of it beyond B and D as well.",
            percent(share.A),
            percent(share.B),
            percent(share.C),
            percent(share.D),
            percent(share.E)
        )
    });
    let chart = Chart::new("load-sharing", "Load sharing").y("share of the load").y_up_to(1.0);
    chart.add_all(shares).reading(reading)
}

/// One tooth pair from its first contact to its last: the reference pair from A to E, its neighbours where they touch before and after.
fn one_pair(record: &FemPairRecord) -> Vec<&FemCycleRow> {
    let of = |pair: i32, keep: &dyn Fn(f64) -> bool| -> Vec<&FemCycleRow> {
        of_pair(record, pair).into_iter().filter(|row| keep(row.pair_position_mm)).collect()
    };
    let points = &record.summary.geometry.curvature_radius_mm;
    [of(-1, &|at| at < points.A), of(0, &|_| true), of(1, &|at| at > points.E)].concat()
}

fn pressure(record: &FemPairRecord) -> Chart {
    const HOVER: &str = "%{y:.1f} MPa";
    let rows = one_pair(record);
    let x = || rows.iter().map(|row| row.pair_position_mm);
    // A gap where the edge carries load: the line is of finite pressures only.
    let finite = rows.iter().map(|row| (!row.at_sharp_edge).then_some(row.peak_pressure_MPa));
    let hertz = rows.iter().map(|row| row.hertz_pressure_MPa);
    let sharp: Vec<&&FemCycleRow> = rows.iter().filter(|row| row.at_sharp_edge).collect();
    let [first, last] = extent(x());
    let mut chart = Chart::new("cycle-pressure", "Maximum pressure of a tooth pair from its first to its last contact")
        .over_path(&record.summary.geometry.curvature_radius_mm)
        .x_range(padded(first, last))
        .y("maximum pressure, MPa")
        .y_up_to(rows.iter().map(|row| row.peak_pressure_MPa).chain(hertz.clone()).fold(0.0, f64::max))
        .line("finite elements", x(), finite, (PATH, 2.4, Dash::Solid), HOVER)
        .line("Hertz, same load", x(), hertz, (MUTED, 2.0, Dash::Dashed), HOVER);
    if !sharp.is_empty() {
        let shown = sharp.iter().map(|row| row.peak_pressure_MPa);
        let x = sharp.iter().map(|row| row.pair_position_mm);
        let said = sharp.iter().map(|row| format!("{} MPa, singular", figure(row.peak_pressure_MPa)));
        let marks = Trace::points("at a sharp tip edge", x, shown, (WORN, "triangle-up-open", 6));
        chart = chart.add(marks.texts(said.collect()).hover("%{text}"));
    }
    let new = &record.summary.new;
    let at_c = match (new.pitch_pressure_MPa, new.pitch_hertz_pressure_MPa) {
        (Some(found), Some(hertz)) => format!(
            "At C finite elements find {} MPa, Hertz {} MPa under the same load. ",
            figure(found),
            figure(hertz)
        ),
        _ => String::new(),
    };
    let edges = if sharp.is_empty() {
        String::new()
    } else {
        format!(
            "At {} of {} positions of the pair a sharp tip edge carries load (marked): the pressure there grows with every \
             refinement, and only a tip rounding gives it a defined value. Hertz’s contact has no edge.",
            sharp.len(),
            rows.len()
        )
    };
    chart.reading(format!("{at_c}{edges}"))
}

fn transmission_error(record: &FemPairRecord) -> Chart {
    let rows = positions(record);
    let (x, y) = (rows.iter().map(|row| row.position_mm), rows.iter().map(|row| row.transmission_error_um));
    let te = &record.summary.new.transmission_error_um;
    Chart::new("transmission-error", "Loaded transmission error")
        .y("transmission error, µm")
        .line("transmission error", x, y, (PATH, 2.4, Dash::Solid), "%{y:.3f} µm")
        .reading(format!(
            "Over the cycle the wheel lags {} to {} µm along the line of action, {} µm peak to peak: lowest where two pairs \
             share the load, highest where one carries it alone.",
            figure(te.min),
            figure(te.max),
            figure(te.peak_to_peak)
        ))
}

fn root_stress(record: &FemPairRecord) -> Chart {
    let rows = positions(record);
    let mut chart = Chart::new("root-stress", "Stress at the fillets").y("principal stress, MPa");
    type Side = fn(&FemCycleRow) -> f64;
    let sides: [(Gear, &str, Side, Dash); 4] = [
        (Gear::Pinion, "tension", |row| row.pinion_root_tension_MPa, Dash::Solid),
        (Gear::Pinion, "compression", |row| row.pinion_root_compression_MPa, Dash::Dashed),
        (Gear::Wheel, "tension", |row| row.wheel_root_tension_MPa, Dash::Solid),
        (Gear::Wheel, "compression", |row| row.wheel_root_compression_MPa, Dash::Dashed),
    ];
    for (gear, side, value, dash) in sides {
        let (x, y) = (rows.iter().map(|row| row.position_mm), rows.iter().map(|row| value(row)));
        let name = format!("{}, {side}", gear.name());
        chart = chart.line(name, x, y, (gear_colour(gear), 2.0, dash), "%{y:.1f} MPa");
    }
    let root = &record.summary.root;
    let of = |root: &RootSummary| {
        format!("{} MPa at {} mm", figure(root.tension_MPa), significant(root.tension_position_mm, 4))
    };
    let reading = match (&root.pinion, &root.wheel) {
        (Some(pinion), Some(wheel)) => format!(
            "Along the fillets of the reference pair’s teeth the maximum stress is {} on the pinion and {} on the wheel. The \
             pinion’s tooth is bent most where it still carries the whole load far out on its flank, towards D, the wheel’s \
             likewise towards B; the other fillet is compressed harder than the loaded one is stretched, for the radial part \
             of the force presses on both.",
            of(pinion),
            of(wheel)
        ),
        _ => String::new(),
    };
    chart.reading(reading)
}
