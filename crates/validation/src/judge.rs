//! Judges the quantities of a case.
//!
//! A tolerance is honest where it is no wider than the reference is uncertain plus what the spacing of the computation
//! contributes; a wider one must come with a sentence that says why, or the case does not count.

use std::collections::BTreeMap;

use super::case_file::{Formula, QuantitySpec, ToleranceSize};
use super::expression::{Evaluator, ExpressionError};
use super::schedule::Members;
use crate::record::{Criterion, QuantityRecord, RunOutcome, Standing};

/// Rounding of a sum of allowances.
const ROUNDING: f64 = 1e-9;

/// Error of a judgement.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JudgeError {
    #[error(transparent)]
    Expression(#[from] ExpressionError),
    /// A reference, bound or tolerance that is no finite number.
    #[error("found {found} for {what}; allowed: a finite number")]
    NotFinite { what: &'static str, found: f64 },
    /// A tolerance that uncertainty and discretisation together do not justify.
    #[error(
        "found a tolerance of {tolerance:e}, wider than the uncertainty of the reference and the discretisation together, \
         {allowed:e}; allowed: one as narrow, or a sentence because = \"…\""
    )]
    TooWide { tolerance: f64, allowed: f64 },
}

/// Judges one quantity; `absent` holds the names of missing files of numbers, each with the consequence.
pub fn judge(
    spec: &QuantitySpec,
    absent: &BTreeMap<&str, &str>,
    e: &mut Evaluator,
) -> Result<QuantityRecord, JudgeError> {
    let missing = spec.needs.as_deref().and_then(|name| absent.get(name));
    let expected = if missing.is_some() { Standing::CannotBeCompared } else { spec.stands.unwrap_or(Standing::Holds) };
    let mut record = QuantityRecord {
        target: spec.target.clone(),
        unit: spec.unit.clone(),
        source: spec.source.clone(),
        because: spec.because.clone(),
        expected,
        remark: spec.remark.clone().or_else(|| missing.map(|reason| (*reason).to_owned())),
        counts_work: spec.work,
        ..QuantityRecord::named(&spec.name)
    };
    if missing.is_some() {
        return Ok(record);
    }
    let Some(value) = spec.value.as_ref().map(|formula| number(formula, e)).transpose()? else { return Ok(record) };
    record.value = Some(value).filter(|value| value.is_finite());
    let holds = compare(&mut record, value, spec, e)?;
    record.standing = match (record.value, holds) {
        // A quantity without a number cannot be judged, even where a failure is expected.
        (None, _) if expected == Standing::Fails => Standing::CannotBeCompared,
        (None, _) | (_, Some(false)) => Standing::Fails,
        (_, Some(true)) => Standing::Holds,
        (_, None) => Standing::CannotBeCompared,
    };
    if holds.is_none() && record.value.is_some() {
        record.expected = Standing::CannotBeCompared;
    }
    Ok(record)
}

/// Whether `value` fulfils the criterion of `spec`, which is entered in the record with the errors; `None` without a criterion.
fn compare(
    record: &mut QuantityRecord,
    value: f64,
    spec: &QuantitySpec,
    e: &mut Evaluator,
) -> Result<Option<bool>, JudgeError> {
    let near = finite("near", spec.near.as_ref(), e)?;
    let at_least = finite("at_least", spec.at_least.as_ref(), e)?;
    let at_most = finite("at_most", spec.at_most.as_ref(), e)?;
    let (criterion, holds) = match (near, &spec.within, at_least, at_most) {
        (Some(reference), Some(within), ..) => {
            let tolerance = size("within", Some(within), reference, e)?.unwrap_or_default();
            record.uncertainty = size("uncertainty", spec.uncertainty.as_ref(), reference, e)?;
            record.discretisation = size("discretisation", spec.discretisation.as_ref(), reference, e)?;
            let allowed = record.uncertainty.unwrap_or_default() + record.discretisation.unwrap_or_default();
            if tolerance > allowed * (1.0 + ROUNDING) && spec.because.is_none() {
                return Err(JudgeError::TooWide { tolerance, allowed });
            }
            let error = (value - reference).abs();
            record.error = Some(error).filter(|error| error.is_finite());
            record.relative_error = Some(error / reference.abs()).filter(|relative| relative.is_finite());
            record.share = Some(error / tolerance).filter(|share| share.is_finite());
            (Criterion::Near { reference, tolerance }, error <= tolerance)
        }
        (_, _, Some(low), Some(high)) => (Criterion::Between { low, high }, value >= low && value <= high),
        (_, _, Some(bound), None) => (Criterion::AtLeast { bound }, value >= bound),
        (_, _, None, Some(bound)) => {
            // The share of an upper bound is meaningful where the best value is zero.
            record.share = Some(value / bound).filter(|share| bound > 0.0 && *share >= 0.0);
            (Criterion::AtMost { bound }, value <= bound)
        }
        _ if spec.is_true.is_some() => (Criterion::True, value == 1.0),
        _ => return Ok(None),
    };
    record.criterion = criterion;
    Ok(Some(holds))
}

/// Quantity that holds where every member of a run ended as expected.
pub fn endings(run: &str, family: &Members) -> QuantityRecord {
    let as_expected = family.ended().filter(|(member, run)| member.may_end(run.outcome)).count();
    let (count, all) = (as_expected as f64, family.members.len() as f64);
    let refusals = family.members.iter().filter(|member| member.expected != RunOutcome::Sound).count();
    let may_be_refused = family.members.iter().any(|member| !member.accepted.is_empty());
    let name = match (family.members.len(), refusals) {
        _ if may_be_refused => format!("{run}: members that end sound or in another way that is accepted"),
        (1, 0) => format!("{run}: ends sound"),
        (_, 0) => format!("{run}: members that end sound"),
        _ => format!("{run}: members that end as they should, {refusals} of them not with a result"),
    };
    // Accepted refusals count only where some member has a result.
    let any_result = !may_be_refused || family.ended().any(|(_, run)| run.outcome == RunOutcome::Sound);
    let standing = if as_expected == family.members.len() && any_result { Standing::Holds } else { Standing::Fails };
    QuantityRecord {
        value: Some(count),
        criterion: Criterion::Near { reference: all, tolerance: 0.0 },
        source: "every run: finite numbers, no negative wear or pressure, loads in equilibrium within 1e-6".to_owned(),
        error: Some(all - count),
        relative_error: Some((all - count) / all),
        standing,
        remark: first_surprise(family),
        ..QuantityRecord::named(&name)
    }
}

/// Message of the first member that did not end as expected.
fn first_surprise(family: &Members) -> Option<String> {
    let (member, run) = family.ended().find(|(member, run)| !member.may_end(run.outcome))?;
    let said = run.said.as_deref().unwrap_or("nothing");
    let place = if member.label.is_empty() { String::new() } else { format!("{}: ", member.label) };
    Some(format!("{place}{}: {said}", run.outcome.title()))
}

pub fn number(formula: &Formula, e: &mut Evaluator) -> Result<f64, ExpressionError> {
    match formula {
        Formula::Number(number) => Ok(*number),
        Formula::Expression(expression) => e.number(expression),
    }
}

/// Value of a formula, which must be finite.
fn finite(what: &'static str, formula: Option<&Formula>, e: &mut Evaluator) -> Result<Option<f64>, JudgeError> {
    formula.map(|formula| checked(what, number(formula, e)?)).transpose()
}

/// Tolerance in the quantity's unit, which must be finite.
fn size(
    what: &'static str,
    extent: Option<&ToleranceSize>,
    reference: f64,
    e: &mut Evaluator,
) -> Result<Option<f64>, JudgeError> {
    let Some(extent) = extent else { return Ok(None) };
    let size = match extent {
        ToleranceSize::Relative(share) => number(share, e)? * reference.abs(),
        ToleranceSize::Absolute(size) => number(size, e)?,
    };
    checked(what, size).map(Some)
}

fn checked(what: &'static str, found: f64) -> Result<f64, JudgeError> {
    if found.is_finite() { Ok(found) } else { Err(JudgeError::NotFinite { what, found }) }
}
