//! Changes of the suite since an earlier run of it.
//!
//! Compared are verdicts, errors and counts of work, each with a threshold that rounding on another machine stays below:
//! a share of a tolerance by 0.05 of the tolerance, a number that is held against a bound by 1 % of itself, a count by 1 %.
//! Wall times are never compared: they say as much of the machine as of the program.

use crate::record::{
    CaseRecord, Change, Changes, ComparedState, Criterion, QuantityRecord, Standing, ValidationRecord,
};

/// Least change of a share of a tolerance that is reported.
const SHARE: f64 = 0.05;
/// Least relative change of a number with a bound, or of a work count, that is reported.
const RELATIVE: f64 = 0.01;
/// Share of its bound below which a number counts as zero and its relative change is not reported.
const NOTHING: f64 = 1e-6;

/// Changes from `old` to `new`. A case that only one of them has is named, not judged: a suite may be run in part.
pub fn changes(old: &ValidationRecord, new: &ValidationRecord) -> Changes {
    let mut found = Changes {
        against_version: old.program_version.clone(),
        worse: Vec::new(),
        better: Vec::new(),
        added: names_missing_in(old, new),
        gone: names_missing_in(new, old),
    };
    for case in &new.cases {
        if let Some(earlier) = old.cases.iter().find(|earlier| earlier.name == case.name) {
            found.compare(earlier, case);
        }
    }
    found
}

/// Names of the cases of `record` that `other` does not have.
fn names_missing_in(other: &ValidationRecord, record: &ValidationRecord) -> Vec<String> {
    let names = record.cases.iter().map(|case| &case.name);
    names.filter(|name| other.cases.iter().all(|case| case.name != **name)).cloned().collect()
}

impl Changes {
    fn add(&mut self, is_worse: bool, case: &CaseRecord, what: &str, before: ComparedState, now: ComparedState) {
        let change = Change { case: case.name.clone(), what: what.to_owned(), before, now };
        if is_worse { &mut self.worse } else { &mut self.better }.push(change);
    }

    fn compare(&mut self, before: &CaseRecord, now: &CaseRecord) {
        if before.failure.is_some() != now.failure.is_some() {
            let [ran_before, ran_now] = [before, now].map(|case| ComparedState::Ran(case.failure.is_none()));
            self.add(now.failure.is_some(), now, "verdict", ran_before, ran_now);
        }
        for quantity in &now.quantities {
            match before.quantities.iter().find(|earlier| earlier.name == quantity.name) {
                Some(earlier) => self.compare_quantity(now, earlier, quantity),
                // A new quantity is reported only where it fails.
                None if !quantity.as_expected() => {
                    self.add(
                        true,
                        now,
                        &quantity.name,
                        ComparedState::Absent,
                        ComparedState::Stands(quantity.standing),
                    );
                }
                None => {}
            }
        }
        // A quantity that is gone although the case ran is reported.
        if now.failure.is_none() {
            for earlier in &before.quantities {
                if now.quantities.iter().all(|quantity| quantity.name != earlier.name) {
                    self.add(true, now, &earlier.name, ComparedState::Stands(earlier.standing), ComparedState::Absent);
                }
            }
        }
        // Each value of a parameter that both tried: whether it ended as expected.
        for point in &now.stability {
            let mut tried = before.stability.iter();
            let Some(earlier) = tried.find(|p| p.parameter == point.parameter && p.setting == point.setting) else {
                continue;
            };
            let (was, is) = (earlier.outcome == earlier.expected, point.outcome == point.expected);
            if was != is {
                let what = format!("{}: {}", point.parameter, point.setting);
                self.add(was, now, &what, ComparedState::Ended(earlier.outcome), ComparedState::Ended(point.outcome));
            }
        }
        for (name, &count) in &now.work {
            let Some(&earlier) = before.work.get(name) else { continue };
            if count.abs_diff(earlier) as f64 > RELATIVE * earlier as f64 {
                self.add(count > earlier, now, name, ComparedState::Counted(earlier), ComparedState::Counted(count));
            }
        }
    }

    fn compare_quantity(&mut self, case: &CaseRecord, before: &QuantityRecord, now: &QuantityRecord) {
        if before.standing != now.standing {
            let is_worse = rank(now.standing) < rank(before.standing);
            self.add(
                is_worse,
                case,
                &now.name,
                ComparedState::Stands(before.standing),
                ComparedState::Stands(now.standing),
            );
        } else if let Some(is_worse) = limit_moved(before.criterion, now.criterion) {
            // Shares of different tolerances are not comparable: the error is compared, in units of the old tolerance.
            let what = format!("{}: what it is compared with", now.name);
            self.add(
                is_worse,
                case,
                &what,
                ComparedState::Against(before.criterion),
                ComparedState::Against(now.criterion),
            );
            if let (Some(earlier), Some(error), Criterion::Near { tolerance, .. }) =
                (before.error, now.error, before.criterion)
                && (error - earlier).abs() > SHARE * tolerance
            {
                let [before, after] = [earlier, error].map(|error| ComparedState::Errs(error, now.unit.clone()));
                self.add(error > earlier, case, &now.name, before, after);
            }
        } else if let (Some(earlier), Some(share), false) = (before.share, now.share, now.counts_work) {
            if (share - earlier).abs() > SHARE {
                self.add(share > earlier, case, &now.name, ComparedState::Uses(earlier), ComparedState::Uses(share));
            }
        } else if let Some(is_worse) = nearer_to_bound(before, now) {
            let [earlier, later] =
                [before, now].map(|quantity| ComparedState::Is(quantity.value, quantity.unit.clone()));
            self.add(is_worse, case, &now.name, earlier, later);
        }
    }
}

/// Rank of an outcome: the higher, the better.
fn rank(standing: Standing) -> u8 {
    match standing {
        Standing::Fails => 0,
        Standing::CannotBeCompared => 1,
        Standing::Holds => 2,
    }
}

/// Where a quantity is compared with something else than before: whether that is worse, looser or another reference.
fn limit_moved(before: Criterion, now: Criterion) -> Option<bool> {
    let (moved, looser) = match (before, now) {
        (Criterion::Near { reference: r0, tolerance: t0 }, Criterion::Near { reference: r1, tolerance: t1 }) => {
            let another = differs(r0, r1, t0);
            (another || differs(t0, t1, t0), another || t1 > t0)
        }
        (Criterion::AtMost { bound: b0 }, Criterion::AtMost { bound: b1 }) => (differs(b0, b1, b0), b1 > b0),
        (Criterion::AtLeast { bound: b0 }, Criterion::AtLeast { bound: b1 }) => (differs(b0, b1, b0), b1 < b0),
        (Criterion::Between { low: l0, high: h0 }, Criterion::Between { low: l1, high: h1 }) => {
            (differs(l0, l1, h0 - l0) || differs(h0, h1, h0 - l0), l1 < l0 || h1 > h0)
        }
        (Criterion::True, Criterion::True) | (Criterion::Reported, Criterion::Reported) => return None,
        _ => (true, true),
    };
    moved.then_some(looser)
}

fn differs(before: f64, now: f64, scale: f64) -> bool {
    (now - before).abs() > RELATIVE * scale.abs()
}

/// Whether a number without a tolerance moved towards its bound; `None` where it did not move or has no bound.
fn nearer_to_bound(before: &QuantityRecord, now: &QuantityRecord) -> Option<bool> {
    let (earlier, value) = (before.value?, now.value?);
    let (scale, is_worse) = match now.criterion {
        Criterion::AtMost { bound } => (bound, value > earlier),
        Criterion::AtLeast { bound } => (bound, value < earlier),
        Criterion::Between { low, high } => {
            let [room, room_before] = [value, earlier].map(|value| (value - low).min(high - value));
            (high - low, room < room_before)
        }
        Criterion::Near { reference, .. } => (reference, (value - reference).abs() > (earlier - reference).abs()),
        Criterion::True | Criterion::Reported => return None,
    };
    ((value - earlier).abs() > RELATIVE * earlier.abs().max(NOTHING * scale.abs())).then_some(is_worse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{RunOutcome, StabilityPoint};
    use std::collections::BTreeMap;

    fn quantity(criterion: Criterion, value: f64, share: Option<f64>) -> QuantityRecord {
        QuantityRecord {
            unit: "MPa".to_owned(),
            value: Some(value),
            criterion,
            share,
            standing: Standing::Holds,
            ..QuantityRecord::named("q")
        }
    }

    fn case(name: &str, quantities: Vec<QuantityRecord>) -> CaseRecord {
        let work = BTreeMap::from([("equilibria".to_owned(), 1000)]);
        CaseRecord { name: name.to_owned(), quantities, wall_s: 1.0, work, ..CaseRecord::default() }
    }

    fn record(cases: Vec<CaseRecord>) -> ValidationRecord {
        ValidationRecord { cases, ..ValidationRecord::default() }
    }

    /// Worse and better, by what changed.
    fn between(old: CaseRecord, new: CaseRecord) -> [Vec<String>; 2] {
        let changes = changes(&record(vec![old]), &record(vec![new]));
        [changes.worse, changes.better].map(|all| all.into_iter().map(|change| change.what).collect())
    }

    const SAME: [Vec<String>; 2] = [Vec::new(), Vec::new()];

    fn near(share: f64) -> CaseRecord {
        let criterion = Criterion::Near { reference: 100.0, tolerance: 10.0 };
        case("a", vec![quantity(criterion, 100.0 + 10.0 * share, Some(share))])
    }

    fn of_value(criterion: Criterion, value: f64) -> CaseRecord {
        case("a", vec![quantity(criterion, value, None)])
    }

    #[test]
    fn a_share_that_moves_by_more_than_a_twentieth_is_a_change() {
        assert_eq!(between(near(0.2), near(0.24)), SAME);
        assert_eq!(between(near(0.2), near(0.26)), [vec!["q".to_owned()], vec![]]);
        assert_eq!(between(near(0.26), near(0.2)), [vec![], vec!["q".to_owned()]]);
    }

    #[test]
    fn a_number_without_a_tolerance_is_judged_by_its_way_to_the_bound() {
        let least = Criterion::AtLeast { bound: 10.0 };
        assert_eq!(between(of_value(least, 100.0), of_value(least, 99.5)), SAME);
        assert_eq!(between(of_value(least, 100.0), of_value(least, 98.0)), [vec!["q".to_owned()], vec![]]);
        let most = Criterion::AtMost { bound: 200.0 };
        assert_eq!(between(of_value(most, 100.0), of_value(most, 98.0)), [vec![], vec!["q".to_owned()]]);
        let between_ends = Criterion::Between { low: 1.0, high: 3.0 };
        assert_eq!(between(of_value(between_ends, 1.5), of_value(between_ends, 2.0)), [vec![], vec!["q".to_owned()]]);
        assert_eq!(between(of_value(between_ends, 2.0), of_value(between_ends, 2.5)), [vec!["q".to_owned()], vec![]]);
    }

    #[test]
    fn a_looser_tolerance_is_worse_whatever_share_of_it_is_used() {
        fn held(tolerance: f64, error: f64) -> CaseRecord {
            let criterion = Criterion::Near { reference: 1.0, tolerance };
            let quantity = quantity(criterion, 1.0 + error, Some(error / tolerance));
            case("a", vec![QuantityRecord { error: Some(error), ..quantity }])
        }
        let limit = "q: what it is compared with".to_owned();
        assert_eq!(between(held(1.0, 0.5), held(10.0, 0.9)), [vec![limit.clone(), "q".to_owned()], vec![]]);
        assert_eq!(between(held(1.0, 0.5), held(10.0, 0.5)), [vec![limit.clone()], vec![]]);
        assert_eq!(between(held(1.0, 0.1), held(0.2, 0.1)), [vec![], vec![limit]]);
    }

    #[test]
    fn rounding_about_zero_is_no_change() {
        let least = Criterion::AtLeast { bound: -5.0 };
        assert_eq!(between(of_value(least, 0.0), of_value(least, -1e-17)), SAME);
    }

    #[test]
    fn a_count_with_a_bound_is_judged_as_a_count() {
        let [before, now] = [500.0, 520.0].map(|count| {
            let gate = quantity(Criterion::AtMost { bound: 1000.0 }, count, Some(count / 1000.0));
            case("a", vec![QuantityRecord { counts_work: true, ..gate }])
        });
        assert_eq!(between(before, now), [vec!["q".to_owned()], vec![]]);
    }

    #[test]
    fn a_verdict_that_changed_is_told_once() {
        let mut failing = near(1.3);
        failing.quantities[0].standing = Standing::Fails;
        assert_eq!(between(near(0.2), failing.clone()), [vec!["q".to_owned()], vec![]]);
        assert_eq!(between(failing, near(0.2)), [vec![], vec!["q".to_owned()]]);
    }

    #[test]
    fn a_case_that_cannot_run_any_more_is_worse_and_its_quantities_are_not_told_again() {
        let mut broken = case("a", Vec::new());
        broken.failure = Some("no such preset".to_owned());
        assert_eq!(between(near(0.2), broken.clone()), [vec!["verdict".to_owned()], vec![]]);
        assert_eq!(between(broken, near(0.2)), [vec![], vec!["verdict".to_owned()]]);
    }

    #[test]
    fn a_check_that_is_gone_is_worse() {
        assert_eq!(between(near(0.2), case("a", Vec::new())), [vec!["q".to_owned()], vec![]]);
    }

    #[test]
    fn work_counts_from_one_per_cent_on_and_wall_time_never() {
        fn with(count: u64, wall_s: f64) -> CaseRecord {
            CaseRecord { work: BTreeMap::from([("equilibria".to_owned(), count)]), wall_s, ..near(0.2) }
        }
        assert_eq!(between(with(1000, 1.0), with(1010, 900.0)), SAME);
        assert_eq!(between(with(1000, 1.0), with(1011, 1.0)), [vec!["equilibria".to_owned()], vec![]]);
        assert_eq!(between(with(1000, 1.0), with(900, 1.0)), [vec![], vec!["equilibria".to_owned()]]);
        // Work where there was none before.
        assert_eq!(between(with(0, 1.0), with(1, 1.0)), [vec!["equilibria".to_owned()], vec![]]);
    }

    #[test]
    fn a_value_of_a_parameter_that_fails_now_is_worse() {
        fn with(outcome: RunOutcome) -> CaseRecord {
            let point = StabilityPoint {
                parameter: "torque, N·m".to_owned(),
                value: 1e7,
                setting: "1e7".to_owned(),
                outcome,
                expected: RunOutcome::Sound,
                said: None,
            };
            CaseRecord { stability: vec![point], ..near(0.2) }
        }
        let what = "torque, N·m: 1e7".to_owned();
        assert_eq!(between(with(RunOutcome::Sound), with(RunOutcome::Panicked)), [vec![what.clone()], vec![]]);
        assert_eq!(between(with(RunOutcome::Refused), with(RunOutcome::Sound)), [vec![], vec![what]]);
    }

    #[test]
    fn cases_of_only_one_record_are_named() {
        let found = changes(&record(vec![case("a", vec![])]), &record(vec![case("b", vec![])]));
        assert_eq!((found.added, found.gone), (vec!["b".to_owned()], vec!["a".to_owned()]));
        assert!(found.worse.is_empty() && found.better.is_empty());
    }
}
