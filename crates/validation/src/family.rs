//! A family of runs in expressions: one column for each varied key, each figure, and the outcomes.

use std::collections::BTreeMap;

use super::execution::Executed;
use super::expression::{Evaluator, ExpressionError};
use super::schedule::Members;
use super::value::Value;
use crate::record::RunOutcome;

/// Group with the columns of the family; `take` gives expressions for every member, which they know as `run`.
///
/// # Errors
/// Fails where an expression has no value for a member that ended sound.
pub(super) fn columns(
    family: &Members,
    take: &BTreeMap<String, String>,
    e: &mut Evaluator,
) -> Result<Value, ExpressionError> {
    let executed: Vec<&Executed> = family.ended().map(|(_, run)| run).collect();
    let messages = executed.iter().map(|run| Value::Text(run.said.clone().unwrap_or_default()));
    let mut group = Value::group([
        ("count", Value::Number(executed.len() as f64)),
        ("wall_s", Value::column(executed.iter().map(|run| run.wall_s))),
        ("sound", Value::column(executed.iter().map(|run| f64::from(run.outcome == RunOutcome::Sound)))),
        ("outcome", Value::List(executed.iter().map(|run| Value::Text(run.outcome.name())).collect())),
        ("message", Value::List(messages.collect())),
        ("work", work(&executed)),
    ]);
    for (place, (name, _)) in family.members.first().iter().flat_map(|member| &member.values).enumerate() {
        group.add(name, in_a_row(family.members.iter().map(|member| member.values[place].1.clone()).collect()));
    }
    let mut taken: Vec<Vec<Value>> = vec![Vec::with_capacity(executed.len()); take.len()];
    for run in &executed {
        // Each member is converted to a value once, for all its expressions.
        e.with("run", &run.as_value(), |e| -> Result<(), ExpressionError> {
            for (column, expression) in taken.iter_mut().zip(take.values()) {
                column.push(match e.value(expression) {
                    Err(_) if run.outcome != RunOutcome::Sound => Value::Number(f64::NAN),
                    found => found?,
                });
            }
            Ok(())
        })?;
    }
    for (name, values) in take.keys().zip(taken) {
        group.add(name, in_a_row(values));
    }
    Ok(group)
}

/// Work counts of all members, each as a column.
fn work(executed: &[&Executed]) -> Value {
    let Some(counted) = executed.iter().find(|run| !run.work.is_empty()) else { return Value::group::<&str>([]) };
    Value::group(counted.work.keys().map(|name| {
        let counts = executed.iter().map(|run| run.work.get(name).map_or(f64::NAN, |&count| count as f64));
        (name.clone(), Value::column(counts))
    }))
}

/// Column of values that are numbers or truths; list of others.
fn in_a_row(values: Vec<Value>) -> Value {
    let numbers: Option<Vec<f64>> = values
        .iter()
        .map(|value| match value {
            Value::Number(number) => Some(*number),
            Value::Truth(truth) => Some(f64::from(*truth)),
            _ => None,
        })
        .collect();
    numbers.map_or_else(|| Value::List(values.into()), Value::column)
}
