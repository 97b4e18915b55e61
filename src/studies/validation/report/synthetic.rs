//! A record with everything in it that a report must be able to show. Its numbers are made up and stand for nothing.

use std::collections::BTreeMap;

use crate::studies::validation::record::{
    CaseKind, CasePlot, CaseRecord, CaseRun, Change, Changes, Criterion, CurveStyle, PlotAxis, PlotCurve,
    QuantityRecord, RunOutcome, StabilityPoint, Standing, State, Tier, ValidationRecord, WorkPrecisionPoint,
};

fn quantity(name: &str, unit: &str, value: Option<f64>, criterion: Criterion) -> QuantityRecord {
    let mut quantity = QuantityRecord {
        unit: unit.to_owned(),
        value,
        criterion,
        source: "K. L. Johnson, Contact Mechanics (1985), eq. (4.45)".to_owned(),
        ..QuantityRecord::named(name)
    };
    let Some(value) = value else { return quantity };
    let holds = match criterion {
        Criterion::Near { reference, tolerance } => {
            let error = (value - reference).abs();
            quantity.error = Some(error);
            quantity.relative_error = Some(error / reference.abs());
            quantity.share = Some(error / tolerance);
            quantity.because = Some("twice the spacing of the cells".to_owned());
            quantity.uncertainty = Some(0.1 * tolerance);
            quantity.discretisation = Some(0.5 * tolerance);
            error <= tolerance
        }
        Criterion::AtLeast { bound } => value >= bound,
        Criterion::AtMost { bound } => {
            quantity.share = Some(value / bound);
            value <= bound
        }
        Criterion::Between { low, high } => (low..=high).contains(&value),
        Criterion::True => value == 1.0,
        Criterion::Reported => {
            quantity.expected = Standing::CannotBeCompared;
            return quantity;
        }
    };
    quantity.standing = if holds { Standing::Holds } else { Standing::Fails };
    quantity
}

fn known(mut quantity: QuantityRecord, expected: Standing, remark: &str) -> QuantityRecord {
    quantity.expected = expected;
    quantity.remark = Some(remark.to_owned());
    quantity
}

fn case(name: &str, group: &str, targets: &[&str], quantities: Vec<QuantityRecord>) -> CaseRecord {
    let work = BTreeMap::from([("equilibria".to_owned(), 48_200), ("wear steps".to_owned(), 120)]);
    CaseRecord {
        name: name.to_owned(),
        title: format!("Title of {name} with <angle> & \"quotes\""),
        group: group.to_owned(),
        targets: targets.iter().map(|&target| target.to_owned()).collect(),
        requirement: format!("What {name} must show, in one sentence."),
        kind: CaseKind::Validation,
        tier: Tier::Full,
        says: Some("The source says that the wear is greatest near the root.".to_owned()),
        rests_on: Vec::new(),
        runs: vec![
            CaseRun {
                name: "stage-10".to_owned(),
                command: "run".to_owned(),
                members: 1,
                outcomes: BTreeMap::from([(RunOutcome::Sound, 1)]),
                wall_s: 1.25,
                work: work.clone(),
            },
            CaseRun {
                name: "family".to_owned(),
                command: "run".to_owned(),
                members: 8,
                outcomes: BTreeMap::from([(RunOutcome::Sound, 6), (RunOutcome::Refused, 2)]),
                wall_s: 8.5,
                work: work.clone(),
            },
        ],
        quantities,
        work_precision: Vec::new(),
        stability: Vec::new(),
        plots: Vec::new(),
        failure: None,
        wall_s: 9.75,
        work,
    }
}

fn axis(title: &str, log: bool) -> PlotAxis {
    PlotAxis { title: title.to_owned(), log }
}

fn every_style() -> CasePlot {
    let hours = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 127.75];
    let depth = |factor: f64| hours.map(|t: f64| factor * t.powf(0.3));
    let curve = |name: &str, style, y: &[f64]| PlotCurve {
        name: name.to_owned(),
        x: hours.to_vec(),
        y: y.to_vec(),
        uncertainty: Vec::new(),
        style,
    };
    let mut band = curve("k from 1e-17 to 2e-17", CurveStyle::Band, &depth(2.0));
    band.x.extend(hours.iter().rev());
    band.y.extend(depth(4.0).iter().rev());
    let mut points = curve("measured", CurveStyle::Points, &depth(3.1));
    points.uncertainty = vec![0.4; hours.len()];
    CasePlot {
        title: "Root wear against time".to_owned(),
        reading: "The wear rises fast and then slowly.".to_owned(),
        x: axis("time, h", true),
        y: axis("root wear, µm", false),
        curves: vec![
            curve("k 1e-17", CurveStyle::Line, &depth(2.5)),
            curve("reference", CurveStyle::Dashed, &depth(2.9)),
            band,
            points,
        ],
        levels: vec![("top of the figure’s axis".to_owned(), 16.0)],
        marks: vec![("1 h".to_owned(), 1.0)],
    }
}

fn near(value: f64) -> QuantityRecord {
    quantity("greatest pressure", "MPa", Some(value), Criterion::Near { reference: 1305.0, tolerance: 13.0 })
}

/// Every verdict, every kind of criterion, and points of both further kinds.
pub(super) fn record() -> ValidationRecord {
    let mut hertz = case("hertz-cylinders", "Contact", &[], vec![near(1300.0)]);
    let mut gate = quantity("Newton iterations", "", Some(412.0), Criterion::AtMost { bound: 450.0 });
    gate.counts_work = true;
    hertz.quantities.extend([gate, quantity("symmetric", "", Some(1.0), Criterion::True)]);
    let mut fzg = case(
        "fzg-root-wear",
        "FZG test",
        &["D1", "D2", "D3"],
        vec![
            quantity("root wear at 127.75 h", "µm", Some(26.5), Criterion::Between { low: 10.0, high: 30.0 }),
            known(
                quantity("place of the peak", "mm", Some(1.9), Criterion::Near { reference: 1.0, tolerance: 0.3 }),
                Standing::Fails,
                "no torque between 370 and 440 N·m puts the peak at 1 mm",
            ),
            known(
                quantity("against the measurement", "µm", None, Criterion::Reported),
                Standing::CannotBeCompared,
                "the measured curve exists only as a picture; put measured.csv into the case's folder",
            ),
            quantity("wear at the pitch point", "µm", Some(24.0), Criterion::Reported),
        ],
    );
    fzg.rests_on = vec!["torque 372.6 N·m and 150 rpm: no text gives them".to_owned()];
    fzg.plots = vec![every_style()];
    let mut missed = case("pitch-point", "Geometry", &["S1"], vec![near(1400.0)]);
    missed.plots = vec![every_style()];
    let mut sudden = case("form-removal", "Measurement", &["D4"], vec![near(1300.0)]);
    sudden.quantities[0].expected = Standing::Fails;
    sudden.quantities[0].remark = Some("the filter is too coarse".to_owned());
    let mut broken = case("calculix", "Cross-check", &[], Vec::new());
    broken.failure =
        Some("validation/calculix/case.toml, line 12: no preset is called `fzg-d`\nallowed: fzg-a, fzg-c".to_owned());
    let open = known(
        quantity("deflection", "", None, Criterion::Reported),
        Standing::CannotBeCompared,
        "no figure of Wang and Cheng is at hand",
    );
    let mut precision = case(
        "fzg-c-precision",
        "Work precision",
        &["S10"],
        vec![quantity("error of the finest", "", Some(0.002), Criterion::AtMost { bound: 0.01 })],
    );
    for (series, factor) in [("winkler", 1.0), ("hertz", 3.0), ("half-space", 0.3)] {
        precision.work_precision.extend([1.0, 4.0, 16.0, 64.0].map(|fine: f64| WorkPrecisionPoint {
            series: series.to_owned(),
            setting: format!("{} positions", 25.0 * fine),
            error: 0.1 * factor / fine,
            wall_s: 0.02 * fine / factor,
            work: 100.0 * fine,
            counted: "equilibria".to_owned(),
        }));
    }
    let mut extreme =
        case("extreme-torque", "Stiff and extreme", &[], vec![quantity("as expected", "", Some(1.0), Criterion::True)]);
    for (exponent, outcome) in [
        (-6, RunOutcome::Sound),
        (-3, RunOutcome::Sound),
        (0, RunOutcome::NotConverged),
        (3, RunOutcome::Unsound),
        (5, RunOutcome::Panicked),
        (7, RunOutcome::Refused),
    ] {
        extreme.stability.push(StabilityPoint {
            parameter: "torque, N·m".to_owned(),
            value: 10f64.powi(exponent),
            setting: format!("1e{exponent} N·m"),
            outcome,
            expected: if exponent == 7 { RunOutcome::Refused } else { RunOutcome::Sound },
            said: (outcome == RunOutcome::Refused).then(|| "torque_Nm is 1e7; allowed is up to 1e6".to_owned()),
        });
    }
    for value in [0.0, 0.3, 0.4999] {
        extreme.stability.push(StabilityPoint {
            parameter: "Poisson’s ratio".to_owned(),
            value,
            setting: format!("{value}"),
            outcome: RunOutcome::Sound,
            expected: RunOutcome::Sound,
            said: None,
        });
    }
    ValidationRecord {
        program_version: "0.1.0".to_owned(),
        tier: Some(Tier::Full),
        threads: 2,
        cases: vec![
            hertz,
            fzg,
            missed,
            sudden,
            broken,
            case("thin-teeth", "Stiffness", &["K1"], vec![open]),
            precision,
            extreme,
        ],
        wall_s: 64.2,
        not_run: Vec::new(),
    }
}

/// The record with its cases repeated under other names, `times` times.
pub(super) fn repeated(times: usize) -> ValidationRecord {
    let mut record = record();
    let cases = std::mem::take(&mut record.cases);
    for number in 0..times {
        record.cases.extend(cases.iter().cloned().map(|mut case| {
            case.name = format!("{}-{number}", case.name);
            case.failure = case.failure.map(|failure| failure.repeat(20));
            case
        }));
    }
    record
}

/// Something of every kind.
pub(super) fn changes() -> Changes {
    let change =
        |what: &str, before, now| Change { case: "hertz-cylinders".to_owned(), what: what.to_owned(), before, now };
    Changes {
        against_version: "0.0.9".to_owned(),
        worse: vec![change("equilibria", State::Counted(1000), State::Counted(1200))],
        better: vec![change("greatest pressure", State::Uses(0.8), State::Uses(0.38))],
        added: vec!["thin-teeth".to_owned()],
        gone: vec!["thick-teeth".to_owned()],
    }
}
