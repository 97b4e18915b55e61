//! Expressions of a case: numbers, truths and columns computed from what its runs left behind.
//!
//! There is arithmetic, comparisons, `&&`, `||`, `!`, lists, calls, `.name` and `[index]` ([`super::syntax`]); no statements, loops
//! or functions of one's own. All numbers are floating-point: `7 / 2` is 3.5. `&&` and `||` look at their second term only where the
//! first one does not decide; an index below zero counts from the end. What the outputs call `summary.new` may also be said
//! `summary.unworn`. The functions are those of [`super::column`] and [`super::profile`].

use super::column;
use super::syntax::{self, Term, TermNode};
use super::value::{ColumnError, Value};

/// Greatest number of items of a list made by an expression, nested lists included; columns of results may be longer.
const MOST_ITEMS: usize = 100_000;

/// Why an expression has no value.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{expression}: {reason}")]
pub struct ExpressionError {
    /// The expression.
    pub expression: String,
    /// Reason.
    pub reason: String,
}

/// Why a term has no value.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TermFault {
    #[error("found `{0}`, which stands for nothing")]
    UnknownName(String),
    #[error("found no `{name}` in {of}")]
    NoMember { name: String, of: &'static str },
    #[error("a {what} of {length} {part}s has no {part} {index}")]
    NoItem { what: &'static str, part: &'static str, length: usize, index: f64 },
    /// An operator or function that does not take these operands.
    #[error("found {0}, which there is not")]
    NoFunction(String),
    #[error("found a list too large; allowed: {MOST_ITEMS} items, those of lists in it included")]
    TooLarge,
    #[error(transparent)]
    Column(#[from] ColumnError),
}

/// Evaluates expressions over names.
#[derive(Default)]
pub struct Evaluator {
    names: Vec<(String, Value)>,
}

impl Evaluator {
    /// Defines `name` as `value`.
    pub fn name(&mut self, name: &str, value: &Value) {
        self.names.push((name.to_owned(), value.clone()));
    }

    /// Calls `work` with `name` defined as `value` during the call.
    pub fn with<T>(&mut self, name: &str, value: &Value, work: impl FnOnce(&mut Self) -> T) -> T {
        let before = self.names.len();
        self.name(name, value);
        let done = work(self);
        self.names.truncate(before);
        done
    }

    /// Whether `name` may be defined: words of the language may not.
    pub fn can_name(name: &str) -> bool {
        syntax::parse(name).is_ok_and(|node| matches!(node.term, Term::Name(_)))
    }

    /// The value of an expression.
    pub fn value(&self, expression: &str) -> Result<Value, ExpressionError> {
        let found = syntax::parse(expression)
            .map_err(|wrong| wrong.to_string())
            .and_then(|node| self.evaluate(&node).map_err(|(fault, place)| format!("{fault} (character {place})")));
        found.map_err(|reason| ExpressionError { expression: expression.to_owned(), reason })
    }

    /// Value of an expression that must be a number; a truth is 1 or 0.
    pub fn number(&self, expression: &str) -> Result<f64, ExpressionError> {
        match self.value(expression)? {
            Value::Number(number) => Ok(number),
            Value::Truth(truth) => Ok(f64::from(truth)),
            other => Err(unfit(expression, &other, "a number")),
        }
    }

    /// Value of an expression that must be a column.
    pub fn column(&self, expression: &str) -> Result<Vec<f64>, ExpressionError> {
        match self.value(expression)? {
            Value::Column(numbers) => Ok(numbers.to_vec()),
            other => Err(unfit(expression, &other, "a column")),
        }
    }

    /// Value of a term, or why it has none and the place of the fault.
    fn evaluate(&self, node: &TermNode) -> Result<Value, (TermFault, usize)> {
        let at = node.place;
        Ok(match &node.term {
            Term::Number(number) => Value::Number(*number),
            Term::Truth(truth) => Value::Truth(*truth),
            Term::Text(text) => Value::Text(text.clone()),
            Term::Name(name) => {
                let named = self.names.iter().rev().find(|(known, _)| known == name);
                named.map(|(_, value)| value.clone()).ok_or_else(|| (TermFault::UnknownName(name.clone()), at))?
            }
            Term::List(items) => {
                let list = Value::List(items.iter().map(|item| self.evaluate(item)).collect::<Result<_, _>>()?);
                if items_of(&list) > MOST_ITEMS {
                    return Err((TermFault::TooLarge, at));
                }
                list
            }
            Term::Minus(of) => match self.evaluate(of)? {
                Value::Number(number) => Value::Number(-number),
                Value::Column(x) => Value::column(x.iter().map(|x| -x)),
                other => return Err((no_function("-", &[other]), at)),
            },
            Term::Not(of) => Value::Truth(!self.truth(of)?),
            Term::Both(terms) => Value::Truth(self.truth(&terms[0])? && self.truth(&terms[1])?),
            Term::Either(terms) => Value::Truth(self.truth(&terms[0])? || self.truth(&terms[1])?),
            Term::Binary(sign, terms) => {
                let terms = [self.evaluate(&terms[0])?, self.evaluate(&terms[1])?];
                let found = column::operate(sign, &terms[0], &terms[1]).map_err(|error| (error.into(), at))?;
                found.ok_or_else(|| (no_function(sign, &terms), at))?
            }
            Term::Member(of, name) => member(&self.evaluate(of)?, name).map_err(|fault| (fault, at))?,
            Term::Index(terms) => {
                item(self.evaluate(&terms[0])?, self.evaluate(&terms[1])?).map_err(|fault| (fault, at))?
            }
            Term::Call(name, arguments) => {
                let arguments: Vec<_> = arguments.iter().map(|node| self.evaluate(node)).collect::<Result<_, _>>()?;
                let found = column::call(name, &arguments).map_err(|error| (error.into(), at))?;
                found.ok_or_else(|| (no_function(name, &arguments), at))?
            }
        })
    }

    fn truth(&self, node: &TermNode) -> Result<bool, (TermFault, usize)> {
        match self.evaluate(node)? {
            Value::Truth(truth) => Ok(truth),
            other => Err((no_function("a statement", &[other]), node.place)),
        }
    }
}

/// Member of `of` with the name `name`.
fn member(of: &Value, name: &str) -> Result<Value, TermFault> {
    let found = match of {
        Value::Group(entries) if name == "unworn" && !entries.contains_key(name) => entries.get("new").cloned(),
        Value::Group(entries) => entries.get(name).cloned(),
        other if name == "len" => column::length(other),
        _ => None,
    };
    found.ok_or_else(|| TermFault::NoMember { name: name.to_owned(), of: kind(of) })
}

/// The item of a column or list with an index, or what a group has under a text.
fn item(of: Value, index: Value) -> Result<Value, TermFault> {
    match (&of, &index) {
        (_, Value::Text(name)) => member(&of, name),
        (Value::Column(x), Value::Number(index)) => Ok(Value::Number(x[place("column", "point", x.len(), *index)?])),
        (Value::List(items), Value::Number(index)) => Ok(items[place("list", "item", items.len(), *index)?].clone()),
        _ => Err(no_function("[ ]", &[of, index])),
    }
}

fn place(what: &'static str, part: &'static str, length: usize, index: f64) -> Result<usize, TermFault> {
    let from_start = if index < 0.0 { index + length as f64 } else { index };
    let is_there = from_start.fract() == 0.0 && (0.0..length as f64).contains(&from_start);
    if is_there { Ok(from_start as usize) } else { Err(TermFault::NoItem { what, part, length, index }) }
}

/// Items of a list, those of lists in it included.
fn items_of(value: &Value) -> usize {
    match value {
        Value::List(items) => items.iter().map(|item| 1 + items_of(item)).sum(),
        Value::Group(entries) => entries.values().map(|item| 1 + items_of(item)).sum(),
        _ => 0,
    }
}

fn no_function(name: &str, of: &[Value]) -> TermFault {
    let kinds: Vec<&str> = of.iter().map(kind).collect();
    TermFault::NoFunction(format!("`{name}` of ({})", kinds.join(", ")))
}

fn unfit(expression: &str, found: &Value, allowed: &str) -> ExpressionError {
    let reason = format!("found {}; allowed: {allowed}", kind(found));
    ExpressionError { expression: expression.to_owned(), reason }
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Number(_) => "a number",
        Value::Truth(_) => "a truth",
        Value::Text(_) => "a text",
        Value::Column(_) => "a column",
        Value::List(_) => "a list",
        Value::Group(_) => "a group of names",
    }
}
#[cfg(test)]
mod tests {
    use super::*;

    fn evaluator() -> Evaluator {
        let mut evaluator = Evaluator::default();
        let flank =
            Value::group([("x", Value::column([0.0, 1.0, 2.0, 4.0])), ("y", Value::column([1.0, 3.0, 2.0, 8.0]))]);
        evaluator.name(
            "r",
            &Value::group([("pinion", flank), ("n", Value::Number(2.0)), ("name", Value::Text("a".into()))]),
        );
        evaluator
    }

    #[test]
    fn ver_figures_of_columns() {
        let e = evaluator();
        for (expression, expected) in [
            ("max(r.pinion.y)", 8.0),
            ("min(r.pinion.y) + 1", 2.0),
            ("mean(r.pinion.y)", 3.5),
            ("sum(2 * r.pinion.y - r.pinion.x)", 21.0),
            ("r.pinion.y[-1] / r.n", 4.0),
            ("at(r.pinion.x, r.pinion.y, 3)", 5.0),
            ("at(r.pinion.x, r.pinion.y, 4.0)", 8.0),
            ("place_of_max(r.pinion.x, r.pinion.y)", 4.0),
            ("crossing(r.pinion.x, r.pinion.y, 2.0)", 0.5),
            ("max(part(r.pinion.x, r.pinion.y, 0.5, 2.0))", 3.0),
            ("integral(r.pinion.x, r.pinion.y)", 2.0 + 2.5 + 10.0),
            ("quantile(r.pinion.y, 0.5)", 2.5),
            ("local_maxima(r.pinion.y)", 1.0),
            ("count_above(r.pinion.y, 2)", 2.0),
            ("rms(column([3, 4.0]))", 12.5_f64.sqrt()),
            ("relative_max(r.pinion.y, 2 * r.pinion.y)", 0.5),
            ("order(column([1.0, 0.5, 0.25]), column([3.0, 0.75, 0.1875]))", 2.0),
            ("2 ** 3 + sqrt(16.0) + 7 / 2", 15.5),
            ("2 - 3 - 4 * 2 ** 3 ** 2", -2049.0),
            ("-2 ** 2 + 7 % 4", 7.0),
            ("max(2, r.n) + min(r.n, 1)", 3.0),
            ("r[\"n\"] + r.pinion.x.len + [1, [2, 3],].len() + r.name.len()", 9.0),
            ("[r.pinion, 5][0].y[1]", 3.0),
        ] {
            let found = e.number(expression).unwrap();
            assert!((found - expected).abs() < 1e-12, "{expression}: {found}, expected {expected}");
        }
        for (statement, expected) in [
            ("1 < 2 && 2 <= 2 && !(1 > 2) && 2 >= 2 || false", 1.0),
            ("r.name != \"b\" && \"quo\\\"te\".contains(\"\\\"\") && true != false", 1.0),
            ("false && nothing", 0.0),
            ("true || nothing", 1.0),
            ("is_nan(0 / 0) && !is_finite(1 / 0) && 0 / 0 != 0 / 0", 1.0),
        ] {
            assert_eq!(e.number(statement).unwrap(), expected, "{statement}");
        }
        assert_eq!(e.number("is_rising(r.pinion.x) && !is_rising(r.pinion.y) && r.name == \"a\"").unwrap(), 1.0);
    }

    #[test]
    fn what_is_wrong_with_an_expression_is_said() {
        let e = evaluator();
        for (expression, said) in [
            ("r.pinion.z", "z"),
            ("nothing + 1", "nothing"),
            ("r.pinion.y[9]", "has no point 9"),
            ("at(r.pinion.x, r.pinion.y, 9.0)", "9 lies outside the column, 0 to 4"),
            ("r.pinion.x + column([1.0])", "columns of 4 and 1 points"),
            ("let x = 1", "found `=` at character 7"),
            ("print(1)", "found `print` of (a number), which there is not (character 1)"),
            ("max(r.name)", "found `max` of (a text), which there is not"),
            ("1 + (r.name + 1)", "found `+` of (a text, a number), which there is not (character 13)"),
            ("r.n && true", "found `a statement` of (a number)"),
            ("max(r.pinion.y", "found the end at character 15"),
            ("r.pinion.y", "found a column; allowed: a number"),
            ("r", "allowed: a number"),
        ] {
            let message = e.number(expression).unwrap_err().to_string();
            assert!(message.starts_with(expression) && message.contains(said), "{message}");
        }
    }

    #[test]
    fn lists_are_not_made_too_large() {
        let mut e = evaluator();
        let mut list = e.value("[1]").unwrap();
        let failure = loop {
            e.name("a", &list);
            match e.value("[a, a]") {
                Ok(larger) => list = larger,
                Err(failure) => break failure.to_string(),
            }
        };
        assert!(failure.contains("too large; allowed: 100000 items"), "{failure}");
    }

    /// Outputs have names of their own; words of an expression are no names.
    #[test]
    fn names_are_those_of_the_outputs() {
        let mut e = evaluator();
        e.name("s", &Value::group([("new", Value::Number(4.0))]));
        assert_eq!(e.number("s.new + s.unworn").unwrap(), 8.0);
        assert!(Evaluator::can_name("match") && !Evaluator::can_name("true") && !Evaluator::can_name("a.b"));
    }

    #[test]
    fn names_of_a_member_are_forgotten() {
        let mut e = evaluator();
        assert_eq!(e.with("run", &Value::Number(3.0), |e| e.number("run * r.n")).unwrap(), 6.0);
        assert!(e.number("run").is_err());
    }
}
