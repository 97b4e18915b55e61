//! Plots of the page: two goals of all designs with the front and the proposals.

use gearwear::report::chart::{Chart, INK, MUTED, Trace};
use gearwear::report::html::number::figure;
use gearwear::report::html::reading::capitalised;

use super::super::kept::{DesignRole, KeptDesign};
use super::super::record::ImproveRecord;
use gearwear_bodies::reference::statistics::extent;

/// Characters of a heading that an axis has room for.
const ROOM: usize = 36;
/// Part of the width of the front that is shown around it.
const AROUND: f64 = 0.6;

/// The first goal against each other one.
pub(super) fn all(record: &ImproveRecord) -> Vec<Chart> {
    let count = record.goals.len();
    let pairs: &[[usize; 2]] = match count {
        0 | 1 => &[],
        2 => &[[0, 1]],
        _ => &[[0, 2], [1, 2], [0, 1]],
    };
    pairs.iter().map(|pair| of_pair(record, *pair)).collect()
}

/// Whether a goal is a sum of several figures, too long for an axis.
fn is_long(record: &ImproveRecord, goal: usize) -> bool {
    record.goals[goal].heading.chars().count() > ROOM
}

/// Its heading, or its number where that is too long.
fn named(record: &ImproveRecord, goal: usize) -> String {
    if is_long(record, goal) { format!("goal {}", goal + 1) } else { record.goals[goal].heading.clone() }
}

fn with_unit(record: &ImproveRecord, goal: usize) -> String {
    match (is_long(record, goal), record.goals[goal].unit.as_str()) {
        (true, "") => named(record, goal),
        (true, unit) => format!("{}, {unit}", named(record, goal)),
        (false, _) => record.goals[goal].with_unit(),
    }
}

/// Text read at a design.
fn reading(record: &ImproveRecord, place: usize) -> String {
    let values = record.said[place].as_ref().map_or_else(
        || "as given".to_owned(),
        |said| {
            let keys = record.keys.iter().zip(said);
            keys.map(|(key, value)| format!("{} = {value}", key.strip_prefix("pair.").unwrap_or(key)))
                .collect::<Vec<_>>()
                .join("<br>")
        },
    );
    let goals = record.goals_of_designs[place].iter().flatten().zip(&record.goals);
    let goals: Vec<String> =
        goals.map(|(value, goal)| format!("{} {} {}", goal.heading, figure(*value), goal.unit)).collect();
    format!("{}<br>{values}", goals.join("<br>"))
}

fn of_pair(record: &ImproveRecord, [x, y]: [usize; 2]) -> Chart {
    let is_proposed = |design: &KeptDesign| record.proposals.iter().any(|proposal| proposal.design == design.number);
    let places = |wanted: &dyn Fn(&KeptDesign) -> bool| -> Vec<usize> {
        let designs = record.designs.iter().enumerate().filter(|(_, design)| wanted(design));
        designs.map(|(place, _)| place).filter(|place| record.goals_of_designs[*place].is_some()).collect()
    };
    let searched = places(&|design| design.role == DesignRole::Search && !record.front.contains(&design.number));
    let front = places(&|design| design.role == DesignRole::Search && record.front.contains(&design.number));
    let verified =
        places(&|design| design.role == DesignRole::Verify && design.values.is_some() && !is_proposed(design));
    let proposed = places(&|design| design.role == DesignRole::Verify && is_proposed(design));
    let as_given: Vec<usize> = record.as_given().into_iter().collect();
    let goal = |goal: usize, places: &[usize]| -> Vec<f64> {
        places.iter().filter_map(|place| Some(record.goals_of_designs[*place].as_ref()?[goal])).collect()
    };
    let points = |name: &str, places: &[usize], sign: (&str, &str, i32)| {
        let texts = places.iter().map(|place| reading(record, *place)).collect();
        Trace::points(name, goal(x, places), goal(y, places), sign).hover_texts(texts)
    };
    let shown: Vec<usize> = front.iter().chain(&verified).chain(&proposed).chain(&as_given).copied().collect();
    let range = |of: usize| {
        let [low, high] = extent(goal(of, &shown));
        let around = AROUND * (high - low).max(0.02 * high.abs());
        [(low - 0.3 * around).max(0.0_f64.min(low)), high + around]
    };
    let letters = ["A", "B", "C", "D", "E"];
    let lettered: Vec<String> = proposed
        .iter()
        .map(|place| {
            let number = record.designs[*place].number;
            let at = record.proposals.iter().position(|proposal| proposal.design == number);
            at.and_then(|at| letters.get(at)).map_or_else(String::new, |letter| (*letter).to_owned())
        })
        .collect();
    let proposals =
        Trace::points("proposals, verified", goal(x, &proposed), goal(y, &proposed), ("var(--pinion)", "circle", 11));
    let names: Vec<String> =
        record.proposals.iter().zip(letters).map(|(proposal, letter)| format!("{letter} {}", proposal.name)).collect();
    let told: Vec<String> = [x, y]
        .into_iter()
        .filter(|goal| is_long(record, *goal))
        .map(|goal| format!(" Goal {}: {}.", goal + 1, record.goals[goal].heading))
        .collect();
    Chart::new(format!("front-{x}-{y}"), capitalised(&format!("{} and {}", named(record, x), named(record, y))))
        .read_nearest()
        .x(&with_unit(record, x))
        .y(&with_unit(record, y))
        .x_range(range(x))
        .y_range(range(y))
        .add(points("designs tried", &searched, (MUTED, "circle", 4)).opacity(0.5))
        .add(points("front of the search", &front, ("var(--wheel)", "circle", 6)))
        .add(points("verified", &verified, ("var(--pinion)", "circle-open", 9)))
        .add(points("as given", &as_given, (INK, "diamond", 10)))
        .add(proposals.lettered(lettered))
        .reading(format!(
            "{}.{} Less is better on both axes; designs far from the front lie outside.",
            names.join(", "),
            told.concat()
        ))
}
