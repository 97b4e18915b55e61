//! Checks of a case file beyond its shape: names that are known and used once, one criterion for each quantity, sources.

use std::collections::BTreeSet;

use super::case_file::{CaseCommand, CaseFile, QuantitySpec, RunSpec, VarySpec};
use super::expression::Evaluator;
use crate::record::{RunOutcome, Standing};

/// Greatest number of members of a family.
pub(super) const MOST_MEMBERS: usize = 10_000;

/// Error in a case file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{kind} {name:?}: found {found}; allowed: {allowed}")]
pub(super) struct CaseFault {
    /// Kind of the part of the file, such as run or quantity.
    kind: &'static str,
    name: String,
    found: String,
    allowed: String,
}

impl CaseFault {
    /// Line of `text` with the faulty name, from 1.
    pub(super) fn line(&self, text: &str) -> usize {
        let quoted = format!("\"{}\"", self.name);
        text.lines().position(|line| line.contains(&quoted)).map_or(1, |line| line + 1)
    }
}

/// Returns the first of `faults` that applies; each is a condition, what is found and what is allowed.
fn first<const N: usize>(kind: &'static str, name: &str, faults: [(bool, &str, &str); N]) -> Result<(), CaseFault> {
    let first = faults.into_iter().find(|(is_fault, ..)| *is_fault);
    first.map_or(Ok(()), |(_, found, allowed)| Err(fault(kind, name, found, allowed)))
}

fn fault(kind: &'static str, name: &str, found: impl Into<String>, allowed: impl Into<String>) -> CaseFault {
    CaseFault { kind, name: name.to_owned(), found: found.into(), allowed: allowed.into() }
}

/// Returns the first error of a case file.
pub(super) fn check(case: &CaseFile) -> Result<(), CaseFault> {
    let mut names = BTreeSet::from(["run"]);
    let all = case.run.iter().map(|run| run.name.as_str()).chain(case.data.iter().map(|data| data.name.as_str()));
    for name in all.chain(case.define.iter().map(|definition| definition.name.as_str())) {
        let plain = name.starts_with(|c: char| c.is_ascii_lowercase())
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !plain || !Evaluator::can_name(name) {
            let allowed = "a small letter, then letters, digits and underscores; no word of the expression language";
            return Err(fault("name", name, "it", allowed));
        }
        if !names.insert(name) {
            let found = "it twice, or the name of every member";
            return Err(fault("name", name, found, "each name once, and not \"run\""));
        }
    }
    case.run.iter().try_for_each(|run| check_run(run, case))?;
    if case.quantity.is_empty() {
        return Err(fault("case", &case.title, "no quantity", "at least one [[quantity]]"));
    }
    let mut quantities = BTreeSet::new();
    if let Some(twice) = case.quantity.iter().find(|quantity| !quantities.insert(quantity.name.as_str())) {
        return Err(fault("quantity", &twice.name, "it twice", "each name once"));
    }
    case.quantity.iter().try_for_each(|quantity| check_quantity(quantity, case))?;
    let families: BTreeSet<&str> = case.run.iter().filter(|r| r.is_family()).map(|r| r.name.as_str()).collect();
    let of_plots = case.plot.iter().flat_map(|plot| &plot.curve).filter_map(|curve| curve.each.as_deref());
    let others =
        case.work_precision.iter().map(|w| w.family.as_str()).chain(case.stability.iter().map(|s| s.family.as_str()));
    for family in of_plots.chain(others) {
        if !families.contains(family) {
            return Err(fault("family", family, "no such family", "the name of a run with vary, each or sample"));
        }
    }
    Ok(())
}

fn check_run(run: &RunSpec, case: &CaseFile) -> Result<(), CaseFault> {
    let ways = [!run.vary.is_empty(), !run.each.is_empty(), run.sample.is_some()];
    let more_ways = ways.iter().filter(|&&way| way).count() > 1;
    let no_family = !run.is_family() && !run.take.is_empty();
    let (no_fem, is_run) = (run.command != CaseCommand::Fem, run.command == CaseCommand::Run);
    let defect = run.accept.iter().any(|outcome| matches!(outcome, RunOutcome::Unsound | RunOutcome::Panicked));
    let accepted = "accept of \"sound\", \"refused\", \"not-converged\" and \"worn-through\" alone";
    let faults = [
        (more_ways, "more than one of vary, each and sample", "one of them"),
        (no_family, "take without a family", "take beside vary, each or sample"),
        (no_fem && run.position_mm.is_some(), "position_mm", "it with command = \"fem\" alone"),
        (is_run && run.full, "full", "it with command = \"fem\" or \"calibrate\" alone"),
        (defect, "accept of a defect", accepted),
    ];
    first("run", &run.name, faults)?;
    for varied in run.vary.iter().chain(run.sample.iter().flat_map(|sample| &sample.of)) {
        check_varied(varied).map_err(|(found, allowed)| fault("run", &run.name, found, allowed))?;
    }
    let members = run.vary.iter().map(VarySpec::count).try_fold(1usize, usize::checked_mul);
    let members = members.map(|members| run.sample.as_ref().map_or(members, |sample| sample.count));
    if members.is_none_or(|members| members > MOST_MEMBERS || members == 0) {
        return Err(fault("run", &run.name, "no members, or more than 10000", "1 to 10000 members"));
    }
    if let Some(name) = &run.calibration {
        let made = case.run.iter().find(|other| other.name == *name);
        let is_calibration = made.is_some_and(|made| made.command == CaseCommand::Calibrate && !made.is_family());
        if !is_calibration || run.command == CaseCommand::Calibrate {
            let allowed = "the name of a single run with command = \"calibrate\"";
            return Err(fault("run", &run.name, format!("calibration = {name:?}"), allowed));
        }
    }
    Ok(())
}

fn check_varied(varied: &VarySpec) -> Result<(), (String, &'static str)> {
    let Some(key) = varied.key.all().first() else { return Err(("no key".to_owned(), "at least one")) };
    match (&varied.values, varied.from, varied.to) {
        (Some(values), None, None) if !values.is_empty() => Ok(()),
        (None, Some(from), Some(to)) if !varied.log || (from > 0.0 && to > 0.0) => Ok(()),
        (None, Some(_), Some(_)) => Err((format!("{key}: ends not above 0 with log"), "ends above 0")),
        _ => Err((format!("{key}: neither values nor from and to, or both"), "values = […], or from and to")),
    }
}

fn check_quantity(quantity: &QuantitySpec, case: &CaseFile) -> Result<(), CaseFault> {
    let reasons = [&quantity.because, &quantity.remark];
    let unreasoned = reasons.into_iter().flatten().any(|text| text.trim().is_empty());
    let bounded = quantity.at_least.is_some() || quantity.at_most.is_some();
    let criteria = [quantity.near.is_some(), bounded, quantity.is_true.is_some()];
    let several = criteria.iter().filter(|&&given| given).count() > 1;
    let unsourced = criteria.contains(&true) && quantity.source.is_empty() && !quantity.work;
    let cannot = quantity.stands == Some(Standing::CannotBeCompared);
    let stands = cannot || quantity.stands == Some(Standing::Fails);
    let foreign = quantity.target.as_ref().filter(|target| !case.targets.contains(target));
    let mut optional = case.data.iter().filter(|data| data.missing.is_some());
    let unknown = quantity.needs.as_ref().filter(|name| optional.all(|data| data.name != **name));
    let statement = "is_true = true, with ! before a statement that must not be true";
    let faults = [
        (quantity.is_true == Some(false), "is_true = false", statement),
        (unreasoned, "because or remark without a word", "the reason"),
        (several, "more than one of near, at_least or at_most, and is_true", "one of them"),
        (quantity.near.is_some() != quantity.within.is_some(), "only one of near and within", "both or none"),
        (unsourced, "no source", "where reference or bound come from"),
        (quantity.value.is_none() && !cannot, "no value", "an expression, or stands = \"cannot-be-compared\""),
        (bounded && quantity.because.is_none() && !quantity.work, "a bound without because", "the reason for it"),
        (stands && quantity.remark.is_none(), "stands without remark", "the reason"),
        (foreign.is_some(), &format!("target = {:?}", foreign.map_or("", |t| t)), "one of the case's targets"),
        (
            unknown.is_some(),
            &format!("needs = {:?}", unknown.map_or("", |n| n)),
            "the name of a [[data]] that may be missing",
        ),
    ];
    first("quantity", &quantity.name, faults)
}
