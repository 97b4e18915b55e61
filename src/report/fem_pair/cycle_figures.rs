//! Over the path of contact from A to E: load sharing, pressure, transmission error, stress at the roots.

use crate::report::chart::{DashType, Marker, MarkerSymbol, Mode, Plot, Trace};

use crate::gear::Gear;
use crate::report::html::number::{figure, percent, plotted, significant};
use crate::report::html::theme::{
    Figure, MUTED, NEW, PATH, WORN, axis, curve, from_zero, gear_colour, layout, line, mark_path_points, padded,
};
use crate::results::fem_pair::{FemCycleRow, FemPairRecord, RootSummary};

/// All figures over the path.
pub fn all(record: &FemPairRecord) -> Vec<Figure> {
    if record.mesh_cycle.is_empty() {
        return Vec::new();
    }
    vec![load_sharing(record), pressure(record), transmission_error(record), root_stress(record)]
}

/// The rows of one pair.
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

fn finish(
    record: &FemPairRecord,
    mut plot: Plot,
    words: [&str; 3],
    range: Option<[f64; 2]>,
    reading: String,
) -> Figure {
    let [id, title, y_name] = words;
    let points = &record.summary.geometry.curvature_radius_mm;
    let y = match range {
        Some(range) => axis(y_name).range(range.to_vec()),
        None => axis(y_name),
    };
    let x = axis("contact position, mm").range(padded(points.A, points.E)).hover_format(".3f");
    plot.set_layout(mark_path_points(layout(380).show_legend(true).x_axis(x).y_axis(y), points));
    Figure { id: id.into(), title: title.into(), reading, plot, wide: false }
}

/// Values over positions with a gap wherever the pair does not touch.
fn with_gaps(record: &FemPairRecord, pair: i32, value: impl Fn(&FemCycleRow) -> f64) -> (Vec<f64>, Vec<Option<f64>>) {
    let own = of_pair(record, pair);
    let mut own = own.into_iter().peekable();
    positions(record)
        .into_iter()
        .map(|at| {
            (
                plotted(at.position_mm),
                own.next_if(|row| row.position_mm == at.position_mm).map(|row| plotted(value(row))),
            )
        })
        .unzip()
}

fn load_sharing(record: &FemPairRecord) -> Figure {
    let mut plot = Plot::new();
    let styles = [(PATH, 2.4, DashType::Solid), (WORN, 1.6, DashType::Dash), (NEW, 1.6, DashType::Dot)];
    for (pair, (colour, width, dash)) in pairs(record).into_iter().zip(styles.into_iter().cycle()) {
        let (x, y) = with_gaps(record, pair, |row| row.load_share);
        plot.add_trace(
            Trace::lines_with_gaps(x, y)
                .name(pair_name(pair))
                .connect_gaps(false)
                .line(line(colour, width, dash))
                .hover_template("%{y:.3f}"),
        );
    }
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
    finish(record, plot, ["load-sharing", "Load sharing", "share of the load"], Some(from_zero(1.0)), reading)
}

fn pressure(record: &FemPairRecord) -> Figure {
    let rows = of_pair(record, 0);
    let mut plot = Plot::new();
    // A gap where the edge carries load: the line is of finite pressures only.
    let x: Vec<f64> = rows.iter().map(|row| plotted(row.position_mm)).collect();
    let y = rows.iter().map(|row| (!row.at_sharp_edge).then(|| plotted(row.peak_pressure_MPa))).collect();
    plot.add_trace(
        Trace::lines_with_gaps(x, y)
            .name("finite elements")
            .connect_gaps(false)
            .line(line(PATH, 2.4, DashType::Solid))
            .hover_template("%{y:.1f} MPa"),
    );
    plot.add_trace(
        curve(
            "Hertz, same load",
            rows.iter().map(|row| row.position_mm),
            rows.iter().map(|row| row.hertz_pressure_MPa),
            line(MUTED, 2.0, DashType::Dash),
        )
        .hover_template("%{y:.1f} MPa"),
    );
    let top =
        rows.iter()
            .map(|row| {
                if row.at_sharp_edge {
                    row.hertz_pressure_MPa
                } else {
                    row.peak_pressure_MPa.max(row.hertz_pressure_MPa)
                }
            })
            .fold(0.0, f64::max);
    // Singular peaks may be many times as high: those above the frame are drawn at its edge.
    let sharp: Vec<&&FemCycleRow> = rows.iter().filter(|row| row.at_sharp_edge).collect();
    let [_, frame] = from_zero(1.25 * top);
    if !sharp.is_empty() {
        plot.add_trace(
            Trace::scatter(
                sharp.iter().map(|row| plotted(row.position_mm)).collect(),
                sharp.iter().map(|row| plotted(row.peak_pressure_MPa.min(0.98 * frame))).collect(),
            )
            .name("at a sharp tip edge")
            .mode(Mode::Markers)
            .marker(Marker::new().symbol(MarkerSymbol::TriangleUpOpen).size(6).color(WORN))
            .text_array(
                sharp.iter().map(|row| format!("{} MPa, singular", figure(row.peak_pressure_MPa))).collect::<Vec<_>>(),
            )
            .hover_template("%{text}"),
        );
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
            "At {} of {} positions a sharp tip edge carries load (marked; drawn at the frame where beyond it): the pressure \
             there grows with every refinement, and only a tip rounding gives it a true value. Hertz knows no edge.",
            sharp.len(),
            rows.len()
        )
    };
    finish(
        record,
        plot,
        ["cycle-pressure", "Greatest pressure of the reference pair", "greatest pressure, MPa"],
        Some([0.0, frame]),
        format!("{at_c}{edges}"),
    )
}

fn transmission_error(record: &FemPairRecord) -> Figure {
    let rows = positions(record);
    let mut plot = Plot::new();
    plot.add_trace(
        curve(
            "transmission error",
            rows.iter().map(|row| row.position_mm),
            rows.iter().map(|row| row.transmission_error_um),
            line(PATH, 2.4, DashType::Solid),
        )
        .hover_template("%{y:.3f} µm"),
    );
    let te = &record.summary.new.transmission_error_um;
    finish(
        record,
        plot,
        ["transmission-error", "Loaded transmission error", "transmission error, µm"],
        None,
        format!(
            "Over the cycle the wheel lags {} to {} µm along the line of action, {} µm peak to peak: least where two pairs \
             share the load, greatest where one carries it alone.",
            figure(te.min),
            figure(te.max),
            figure(te.peak_to_peak)
        ),
    )
}

fn root_stress(record: &FemPairRecord) -> Figure {
    let rows = positions(record);
    let mut plot = Plot::new();
    type Side = fn(&FemCycleRow) -> f64;
    let sides: [(Gear, Side, Side); 2] = [
        (Gear::Pinion, |row| row.pinion_root_tension_MPa, |row| row.pinion_root_compression_MPa),
        (Gear::Wheel, |row| row.wheel_root_tension_MPa, |row| row.wheel_root_compression_MPa),
    ];
    for (gear, tension, compression) in sides {
        for (side, value, dash) in [("tension", tension, DashType::Solid), ("compression", compression, DashType::Dash)]
        {
            plot.add_trace(
                curve(
                    &format!("{}, {side}", gear.name()),
                    rows.iter().map(|row| row.position_mm),
                    rows.iter().map(|row| value(row)),
                    line(gear_colour(gear), 2.0, dash),
                )
                .hover_template("%{y:.1f} MPa"),
            );
        }
    }
    let root = &record.summary.root;
    let of = |root: &RootSummary| {
        format!("{} MPa at {} mm", figure(root.tension_MPa), significant(root.tension_position_mm, 4))
    };
    let reading = match (&root.pinion, &root.wheel) {
        (Some(pinion), Some(wheel)) => format!(
            "Along the fillets of the reference pair’s teeth the greatest stress is {} on the pinion and {} on the wheel. The \
             pinion’s tooth is bent most where it still carries the whole load far out on its flank, towards D, the wheel’s \
             likewise towards B; the other fillet is compressed harder than the loaded one is stretched, for the radial part \
             of the force presses on both.",
            of(pinion),
            of(wheel)
        ),
        _ => String::new(),
    };
    finish(record, plot, ["root-stress", "Stress at the fillets", "principal stress, MPa"], None, reading)
}
