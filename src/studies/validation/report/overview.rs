//! All cases in one table, by group: verdict, margin, cost and marks, with the controls that choose among them.

use std::collections::BTreeSet;

use super::markup::{badge, link, margin_bar, row, scrolling};
use super::verdict::Verdict;
use super::words::{self, counted, time};
use crate::report::html::page::escape;
use crate::studies::validation::record::{CaseRecord, ValidationRecord};

/// The controls and the table.
pub(super) fn html(record: &ValidationRecord) -> String {
    let body: String = groups(record)
        .into_iter()
        .map(|group| {
            let rows: String = record.cases.iter().filter(|case| case.group == group).map(case_row).collect();
            format!(
                "<tr class=\"group\" data-group=\"{0}\"><th scope=\"rowgroup\" colspan=\"6\">{0}</th></tr>\n{rows}",
                escape(group)
            )
        })
        .collect();
    let columns = ["case", "verdict", "of tolerance used", "work", "time", "marks"];
    format!("{}{}", controls(record), scrolling("overview", &columns, &body))
}

/// The groups in the order in which they first occur.
pub(super) fn groups(record: &ValidationRecord) -> Vec<&str> {
    let mut seen = BTreeSet::new();
    record.cases.iter().map(|case| case.group.as_str()).filter(|group| seen.insert(*group)).collect()
}

fn case_row(case: &CaseRecord) -> String {
    let verdict = Verdict::of_case(case);
    let tightest = words::tightest(case.quantities.iter());
    let by = tightest.map_or_else(String::new, |(quantity, _)| {
        format!("<br><span class=\"muted\">{}</span>", escape(&quantity.name))
    });
    row(
        &format!(" data-verdict=\"{}\" data-group=\"{}\"", verdict.class(), escape(&case.group)),
        &[
            format!("{}<br><span class=\"muted\">{}</span>", link(case, &case.title), escape(&case.name)),
            badge(verdict),
            format!("{}{by}", margin_bar(tightest.map(|(_, share)| share))),
            escape(&words::main_work(case)),
            time(case.wall_s),
            marks(case),
        ],
    )
}

/// What a reader should know beside the verdict: targets, estimates, what of the case does not hold or cannot be compared.
pub(super) fn marks(case: &CaseRecord) -> String {
    let mut marks: Vec<String> = case.targets.iter().map(|target| format!("<b>{}</b>", escape(target))).collect();
    if !case.rests_on.is_empty() {
        marks.push("estimate".to_owned());
    }
    let of = |wanted| case.quantities.iter().filter(|quantity| Verdict::of_quantity(quantity) == wanted).count();
    for (verdict, one, many) in [
        (Verdict::KnownNot, "does not hold", "do not hold"),
        (Verdict::CannotBeCompared, "not comparable", "not comparable"),
    ] {
        match of(verdict) {
            0 => {}
            number => marks.push(counted(number, one, many)),
        }
    }
    marks.join(", ")
}

/// Choices by verdict and group; shown by the script that serves them.
fn controls(record: &ValidationRecord) -> String {
    let verdicts: String = Verdict::ALL
        .into_iter()
        .map(|verdict| (verdict, record.cases.iter().filter(|case| Verdict::of_case(case) == verdict).count()))
        .filter(|&(_, number)| number > 0)
        .map(|(verdict, number)| {
            format!(
                "<label><input type=\"checkbox\" value=\"{}\" checked> {} ({number})</label>\n",
                verdict.class(),
                badge(verdict)
            )
        })
        .collect();
    let groups: String =
        groups(record).into_iter().map(|group| format!("<option>{}</option>\n", escape(group))).collect();
    format!(
        "<form class=\"filter\" id=\"filter\" hidden>\n<fieldset><legend>Show</legend>\n{verdicts}</fieldset>\n\
         <label>Group <select>\n<option value=\"\">all</option>\n{groups}</select></label>\n</form>\n"
    )
}
