//! A family of runs as expressions see it: one column for each key varied, for each figure taken, and for how members ended.

use std::collections::BTreeMap;

use super::execution::Executed;
use super::expression::{Evaluator, ExpressionError};
use super::schedule::Members;
use super::value::Value;
use crate::studies::validation::record::RunOutcome;

/// A group with the columns of the family; `take` gives the expressions for every member, which it knows as `run`.
///
/// # Errors
/// An expression that has no value for a member that ended sound.
pub(super) fn columns(
    family: &Members,
    take: &BTreeMap<String, String>,
    e: &mut Evaluator,
) -> Result<Value, ExpressionError> {
    let executed: Vec<&Executed> = family.ended().map(|(_, run)| run).collect();
    let numbers = |of: fn(&Executed) -> f64| Value::column(executed.iter().map(|run| of(run)));
    let texts = |of: fn(&Executed) -> String| Value::List(executed.iter().map(|run| Value::Text(of(run))).collect());
    let mut group = Value::group([
        ("count", Value::Number(executed.len() as f64)),
        ("wall_s", numbers(|run| run.wall_s)),
        ("sound", numbers(|run| f64::from(run.outcome == RunOutcome::Sound))),
        ("outcome", texts(|run| run.outcome.name())),
        ("message", texts(|run| run.said.clone().unwrap_or_default())),
        ("work", work(&executed)),
    ]);
    for (place, (name, _)) in family.members.first().iter().flat_map(|member| &member.values).enumerate() {
        group.add(name, in_a_row(family.members.iter().map(|member| member.values[place].1.clone()).collect()));
    }
    let mut taken: Vec<Vec<Value>> = vec![Vec::with_capacity(executed.len()); take.len()];
    for run in &executed {
        // A member is laid out for the expressions once, whatever is taken of it.
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
    let count = |run: &Executed, name: &str| run.work.get(name).map_or(f64::NAN, |&count| count as f64);
    Value::group(
        counted.work.keys().map(|name| (name.clone(), Value::column(executed.iter().map(|run| count(run, name))))),
    )
}

/// Values one after another: a column where they are numbers or truths.
fn in_a_row(values: Vec<Value>) -> Value {
    let number = |value: &Value| match value {
        Value::Number(number) => Some(*number),
        Value::Truth(truth) => Some(f64::from(*truth)),
        _ => None,
    };
    match values.iter().map(number).collect::<Option<Vec<f64>>>() {
        Some(numbers) => Value::column(numbers),
        None => Value::List(values.into()),
    }
}
