//! A record with everything in it that a report must be able to show. Its numbers are made up and stand for nothing.

use std::collections::BTreeMap;

use crate::library::ValidationCase;
use crate::record::{
    CaseRecord, CaseRun, Change, Changes, ComparedState, RunOutcome, StabilityPoint, Tier, ValidationRecord,
    WorkPrecisionPoint,
};

/// A plot with every style of curve.
const PLOT: &str = r#"
[[define]]
name = "t"
value = "column([0.25, 0.5, 1, 2, 4, 8, 16, 32, 64, 127.75])"
[[plot]]
title = "Root wear against time"
reading = "The wear rises fast and then slowly."
x = "time, h"
y = "root wear, µm"
log_x = true
curve = [
    { name = "k 1e-17", x = "t", y = "2.5 * t ** 0.3" },
    { name = "reference", style = "dashed", x = "t", y = "2.9 * t ** 0.3" },
    { name = "k from 1e-17 to 2e-17", style = "band", x = "t", y = "2 * t ** 0.3", upper = "4 * t ** 0.3" },
    { name = "measured", style = "points", x = "t", y = "3.1 * t ** 0.3", uncertainty = "0.4 + 0 * t" },
]
level = [{ name = "top of the figure’s axis", at = 16 }]
mark = [{ name = "1 h", at = 1 }]
"#;

/// Every kind of criterion.
const FZG: &str = r#"
rests_on = ["torque 372.6 N·m and 150 rpm: no text gives them"]
[[quantity]]
name = "root wear at 127.75 h"
unit = "µm"
value = 26.5
at_least = 10
at_most = 30
[[quantity]]
name = "place of the peak"
unit = "mm"
value = 1.9
near = 1
within = { absolute = 0.3 }
because = "twice the spacing of the cells"
stands = "fails"
remark = "no torque between 370 and 440 N·m puts the peak at 1 mm"
[[quantity]]
name = "against the measurement"
unit = "µm"
stands = "cannot-be-compared"
remark = "the measured curve exists only as a picture; put measured.csv into the case's folder"
[[quantity]]
name = "wear at the pitch point"
unit = "µm"
value = 24
"#;

/// A case whose file ends in `rest`, judged and drawn, with runs that were not carried out.
fn case(name: &str, group: &str, targets: &[&str], rest: &str) -> CaseRecord {
    let text = format!(
        "title = 'Title of {name} with <angle> & \"quotes\"'\ngroup = '{group}'\ntargets = {targets:?}\nkind = 'validation'\n\
         requirement = 'What {name} must show, in one sentence.'\ntier = 'full'\n\
         says = 'The source says that the wear is greatest near the root.'\n{rest}"
    );
    let file = toml::from_str(&text).unwrap();
    let mut case = crate::record(&ValidationCase { name: name.to_owned(), folder: "".into(), file }, &[]);
    assert_eq!(case.failure, None);
    for quantity in &mut case.quantities {
        quantity.source = "K. L. Johnson, Contact Mechanics (1985), eq. (4.45)".to_owned();
    }
    let work = BTreeMap::from([("equilibria".to_owned(), 48_200), ("wear steps".to_owned(), 120)]);
    let run = |name: &str, wall_s, outcomes: &[(RunOutcome, usize)]| CaseRun {
        name: name.to_owned(),
        command: "run".to_owned(),
        members: outcomes.iter().map(|(_, count)| count).sum(),
        outcomes: outcomes.iter().copied().collect(),
        wall_s,
        work: work.clone(),
    };
    case.runs = vec![
        run("stage-10", 1.25, &[(RunOutcome::Sound, 1)]),
        run("family", 8.5, &[(RunOutcome::Sound, 6), (RunOutcome::Refused, 2)]),
    ];
    CaseRecord { wall_s: 9.75, work, ..case }
}

fn near(value: f64) -> String {
    format!(
        "[[quantity]]\nname = 'maximum pressure'\nunit = 'MPa'\nvalue = {value}\nnear = 1305\nwithin = {{ absolute = 13 }}\n\
         uncertainty = {{ absolute = 1.3 }}\ndiscretisation = {{ absolute = 6.5 }}\nbecause = 'twice the spacing of the cells'\n"
    )
}

fn holds(name: &str) -> String {
    format!("[[quantity]]\nname = '{name}'\nvalue = 1\nis_true = true\n")
}

/// Every verdict, every kind of criterion, and points of both further kinds.
pub(super) fn record() -> ValidationRecord {
    let gate = "[[quantity]]\nname = 'Newton iterations'\nvalue = 412\nat_most = 450\nwork = true\n";
    let hertz = case("hertz-cylinders", "Contact", &[], &(near(1300.0) + gate + &holds("symmetric")));
    let fzg = case("fzg-root-wear", "FZG test", &["D1", "D2", "D3"], &(FZG.to_owned() + PLOT));
    let missed = case("pitch-point", "Geometry", &["S1"], &(near(1400.0) + PLOT));
    let sudden = near(1300.0) + "stands = 'fails'\nremark = 'the filter is too coarse'\n";
    let sudden = case("form-removal", "Measurement", &["D4"], &sudden);
    let mut broken = case("calculix", "Cross-check", &[], "quantity = []");
    broken.failure =
        Some("validation/calculix/case.toml, line 12: no preset is called `fzg-d`\nallowed: fzg-a, fzg-c".to_owned());
    let open = "[[quantity]]\nname = 'deflection'\nstands = 'cannot-be-compared'\n\
                remark = 'no figure of Wang and Cheng is at hand'\n";
    let open = case("thin-teeth", "Stiffness", &["K1"], open);
    let finest = "[[quantity]]\nname = 'error of the finest'\nvalue = 0.002\nat_most = 0.01\n";
    let mut precision = case("fzg-c-precision", "Work precision", &["S10"], finest);
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
    let mut extreme = case("extreme-torque", "Stiff and extreme", &[], &holds("as expected"));
    let point = |parameter: &str, value: f64, setting: String, outcome| StabilityPoint {
        parameter: parameter.to_owned(),
        value,
        setting,
        outcome,
        expected: if outcome == RunOutcome::Refused { outcome } else { RunOutcome::Sound },
        said: (outcome == RunOutcome::Refused).then(|| "torque_Nm is 1e7; allowed is up to 1e6".to_owned()),
    };
    let torques = [
        (-6, RunOutcome::Sound),
        (-3, RunOutcome::Sound),
        (0, RunOutcome::NotConverged),
        (3, RunOutcome::Unsound),
        (5, RunOutcome::Panicked),
        (7, RunOutcome::Refused),
    ];
    extreme.stability.extend(
        torques.map(|(exponent, outcome)| {
            point("torque, N·m", 10f64.powi(exponent), format!("1e{exponent} N·m"), outcome)
        }),
    );
    let ratios = [0.0, 0.3, 0.4999];
    extreme.stability.extend(ratios.map(|ratio| point("Poisson’s ratio", ratio, ratio.to_string(), RunOutcome::Sound)));
    ValidationRecord {
        program_version: "0.1.0".to_owned(),
        tier: Some(Tier::Full),
        threads: 2,
        cases: vec![hertz, fzg, missed, sudden, broken, open, precision, extreme],
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

pub(super) fn changes() -> Changes {
    let change =
        |what: &str, before, now| Change { case: "hertz-cylinders".to_owned(), what: what.to_owned(), before, now };
    Changes {
        against_version: "0.0.9".to_owned(),
        worse: vec![change("equilibria", ComparedState::Counted(1000), ComparedState::Counted(1200))],
        better: vec![change("maximum pressure", ComparedState::Uses(0.8), ComparedState::Uses(0.38))],
        added: vec!["thin-teeth".to_owned()],
        gone: vec!["thick-teeth".to_owned()],
    }
}
