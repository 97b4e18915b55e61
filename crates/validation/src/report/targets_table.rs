//! The statements of the thesis, one a row: whether they hold, by what margin, and which cases speak to them.

use maud::{Markup, html};

use super::markup::{badge, link, margin_bar, scrolling};
use super::verdict::Verdict;
use super::words;
use crate::record::{CaseRecord, ValidationRecord};
use gearwear::report::html::page::note;
use gearwear::report::html::table::{cells, line};

/// The targets in their order, each in a few words of our own.
const TARGETS: [(&str, &str); 24] = [
    ("S1", "the pitch point’s number on the pinion’s flank"),
    ("S2", "wear greatest near the root, least at the pitch line, more again at the tip"),
    ("S3", "wear at the very root comes to a stop; its place moves towards the pitch point"),
    ("S4", "the simplified model is pointed where the pairs in mesh change, the integrated one smooth"),
    ("S5", "the pressure below the pitch point rises with the depth worn there"),
    ("S6", "contact temperatures: nil at the pitch point, three methods alike"),
    ("S7", "wear by adsorption at two speeds beside the linear law"),
    ("S8", "wear by oxidation is outside its range of temperature"),
    ("S9", "a constant tooth stiffness costs little accuracy"),
    ("S10", "the contact surface matters less than the sliding distance"),
    ("S11", "points that meet slide different distances on the two flanks"),
    ("S12", "a tooth shaped for least transmission error shows more of it once worn"),
    ("D1", "FZG test: root wear against time"),
    ("D2", "FZG test: profile near the root and the place of its peak"),
    ("D3", "FZG test: severity at five places of the flank"),
    ("D4", "form removed from a measured profile"),
    ("K1", "deflection against the number of teeth"),
    ("K2", "stiffness over the path of contact"),
    ("H1", "first cycle: more wear on the slice that enters first"),
    ("H2", "root wear evens out over the face width"),
    ("H3", "where the pressure is greatest, new and worn"),
    ("H4", "the transmission error varies less after wear"),
    ("H5", "helix angle and face width of least variation"),
    ("H6", "the simplified model wears deeper without instability, and faster"),
];

/// Table of the targets, and the targets without a case in this run; empty where there is none with a case.
pub(super) fn html(record: &ValidationRecord) -> Markup {
    if record.cases.iter().all(|case| case.targets.is_empty()) {
        return Markup::default();
    }
    let (mut rows, mut absent) = (Vec::new(), Vec::new());
    for (id, words) in TARGETS {
        let cases: Vec<&CaseRecord> =
            record.cases.iter().filter(|case| case.targets.iter().any(|target| target == id)).collect();
        match verdict(id, &cases) {
            Some(verdict) => rows.push(row(id, words, &cases, verdict)),
            None => absent.push(id),
        }
    }
    let columns = ["statement", "verdict", "of tolerance used", "rests on", "cases"];
    html! {
        (note(
            "The thesis is A. Flodin, Wear of spur and helical gears, doctoral thesis, KTH, Stockholm 2000. Its statements that can be \
             computed are numbered here, in our own words: S for simulated spur gears, D for the measured wear test and the measured profiles, \
             K for tooth stiffness, H for helical gears. The measured curves exist only as pictures, so \
             that what rests on them is compared with their axes and with what the text says."
        ))
        (scrolling("targets", &columns, rows))
        @if !absent.is_empty() { p.muted { "No case of this run examines " (absent.join(", ")) "." } }
    }
}

fn row(id: &str, words: &str, cases: &[&CaseRecord], verdict: Markup) -> Markup {
    let used = words::tightest(cases.iter().flat_map(|case| case.speaking_to(id))).map(|(_, share)| share);
    line(cells![
        html! { b { (id) } " " (words) },
        verdict,
        margin_bar(used),
        if cases.iter().any(|case| !case.rests_on.is_empty()) { "estimate" } else { "" },
        html! { @for (i, case) in cases.iter().enumerate() { @if i > 0 { br; } (link(case, &case.name)) } },
    ])
}

/// Verdict of a target: the most urgent of its cases, with the number of quantities that hold where not all do; `None` without a case.
fn verdict(id: &str, cases: &[&CaseRecord]) -> Option<Markup> {
    let of_cases = cases.iter().map(|case| match case.failure {
        Some(_) => Verdict::CouldNotRun,
        None => Verdict::of_quantities(&case.speaking_to(id)),
    });
    let worst = of_cases.min()?;
    let all = cases.iter().flat_map(|case| case.speaking_to(id)).map(Verdict::of_quantity);
    let compared: Vec<Verdict> = all.filter(|verdict| *verdict != Verdict::Reported).collect();
    let hold = compared.iter().filter(|verdict| matches!(verdict, Verdict::Holds | Verdict::NowHolds)).count();
    Some(html! {
        (badge(worst))
        @if hold < compared.len() { " " span.muted { (hold) " of " (compared.len()) " hold" } }
    })
}
