//! Expressions of a case: numbers, truths and columns computed from what its runs left behind.
//!
//! The language is that of the `rhai` crate restricted to expressions: arithmetic, comparisons, `&&`, `||`, `!`, calls, `.name`
//! and `[index]`; no statements, loops or functions of its own. Numbers with and without a decimal point mix, but two whole
//! numbers divide as whole numbers do. `new` is a word of the language: what the outputs call `summary.new` is `summary.unworn`
//! here. Beside `sqrt`, `sin`, `exp`, `ln`, `PI()` and the like there are the functions of
//! [`super::column`] and [`super::profile`].

use rhai::{Array, Dynamic, Engine, Map, Scope};

use super::column::{self, Column};
use super::profile;
use super::value::Value;

/// Operations of one expression: far more than any needs, so that none runs for ever.
const MOST_OPERATIONS: u64 = 1_000_000;
/// Items of a list and letters of a text that an expression makes; columns of results may be longer.
const MOST_ITEMS: usize = 100_000;
/// What prints, reads the clock, or makes expressions of texts.
const NOT_FOR_CASES: [&str; 6] = ["eval", "print", "debug", "timestamp", "sleep", "blob"];
/// Depth of nested terms.
const MOST_DEPTH: usize = 128;

/// Why an expression has no value.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{expression}: {reason}")]
pub struct ExpressionError {
    /// The expression.
    pub expression: String,
    /// What is wrong with it.
    pub reason: String,
}

/// Evaluates expressions over names.
pub struct Evaluator {
    engine: Engine,
    scope: Scope<'static>,
}

impl Default for Evaluator {
    fn default() -> Self {
        let mut engine = Engine::new();
        engine.set_max_operations(MOST_OPERATIONS);
        engine.set_max_expr_depths(MOST_DEPTH, MOST_DEPTH);
        engine.set_max_array_size(MOST_ITEMS);
        engine.set_max_map_size(MOST_ITEMS);
        engine.set_max_string_size(MOST_ITEMS);
        for symbol in NOT_FOR_CASES {
            engine.disable_symbol(symbol);
        }
        engine.set_fail_on_invalid_map_property(true);
        engine.set_strict_variables(true);
        column::register(&mut engine);
        profile::register(&mut engine);
        Self { engine, scope: Scope::new() }
    }
}

impl Evaluator {
    /// Lets `name` stand for `value` from now on.
    pub fn name(&mut self, name: &str, value: &Value) {
        self.scope.push_constant_dynamic(name.to_owned(), dynamic(value));
    }

    /// Carries out `work` with `name` standing for `value` only there.
    pub fn with<T>(&mut self, name: &str, value: &Value, work: impl FnOnce(&mut Self) -> T) -> T {
        let before = self.scope.len();
        self.name(name, value);
        let done = work(self);
        self.scope.rewind(before);
        done
    }

    /// Whether `name` can stand for something: words of the language cannot.
    pub fn can_name(name: &str) -> bool {
        Engine::new_raw().compile_expression(name).is_ok()
    }

    /// The value of an expression.
    ///
    /// # Errors
    /// [`ExpressionError`]
    pub fn value(&mut self, expression: &str) -> Result<Value, ExpressionError> {
        let error = |reason: String| ExpressionError { expression: expression.to_owned(), reason };
        let found = self.engine.eval_expression_with_scope::<Dynamic>(&mut self.scope, expression);
        let found = found.map_err(|failure| error(failure.to_string()))?;
        value(found).map_err(|kind| error(format!("found {kind}; allowed: a number, a truth, a text or a column")))
    }

    /// The same, which must be a number; a truth is 1 or 0.
    pub fn number(&mut self, expression: &str) -> Result<f64, ExpressionError> {
        match self.value(expression)? {
            Value::Number(number) => Ok(number),
            Value::Truth(truth) => Ok(f64::from(u8::from(truth))),
            other => Err(unfit(expression, &other, "a number")),
        }
    }

    /// The same, which must be a column.
    pub fn column(&mut self, expression: &str) -> Result<Vec<f64>, ExpressionError> {
        match self.value(expression)? {
            Value::Column(numbers) => Ok(numbers.to_vec()),
            other => Err(unfit(expression, &other, "a column")),
        }
    }
}

fn unfit(expression: &str, found: &Value, allowed: &str) -> ExpressionError {
    let found = match found {
        Value::Number(_) => "a number",
        Value::Truth(_) => "a truth",
        Value::Text(_) => "a text",
        Value::Column(_) => "a column",
        Value::List(_) => "a list",
        Value::Group(_) => "a group of names",
    };
    ExpressionError { expression: expression.to_owned(), reason: format!("found {found}; allowed: {allowed}") }
}

/// A value as expressions handle it.
fn dynamic(value: &Value) -> Dynamic {
    match value {
        Value::Number(number) => (*number).into(),
        Value::Truth(truth) => (*truth).into(),
        Value::Text(text) => text.clone().into(),
        Value::Column(numbers) => Dynamic::from(Column(numbers.clone())),
        Value::List(items) => items.iter().map(dynamic).collect::<Array>().into(),
        Value::Group(entries) => {
            entries.iter().map(|(name, value)| (speakable(name).into(), dynamic(value))).collect::<Map>().into()
        }
    }
}

/// A name as expressions may say it.
fn speakable(name: &str) -> &str {
    if name == "new" { "unworn" } else { name }
}

/// Back again; otherwise the name of what it is.
fn value(found: Dynamic) -> Result<Value, String> {
    if let Some(column) = found.clone().try_cast::<Column>() {
        return Ok(Value::Column(column.0));
    }
    if let Ok(number) = found.as_float() {
        return Ok(Value::Number(number));
    }
    if let Ok(whole) = found.as_int() {
        return Ok(Value::Number(whole as f64));
    }
    if let Ok(truth) = found.as_bool() {
        return Ok(Value::Truth(truth));
    }
    if found.is_string() {
        return Ok(Value::Text(found.into_string().unwrap_or_default()));
    }
    if let Some(entries) = found.clone().try_cast::<Map>() {
        return entries
            .into_iter()
            .map(|(name, item)| Ok((name.to_string(), value(item)?)))
            .collect::<Result<_, String>>()
            .map(Value::Group);
    }
    match found.clone().try_cast::<Array>() {
        Some(items) => items.into_iter().map(value).collect::<Result<_, String>>().map(Value::List),
        None => Err(found.type_name().to_owned()),
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
        let mut e = evaluator();
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
            ("2 ** 3 + sqrt(16.0) + 7 / 2.0", 15.5),
        ] {
            let found = e.number(expression).unwrap();
            assert!((found - expected).abs() < 1e-12, "{expression}: {found}, expected {expected}");
        }
        assert_eq!(e.number("is_rising(r.pinion.x) && !is_rising(r.pinion.y) && r.name == \"a\"").unwrap(), 1.0);
    }

    #[test]
    fn what_is_wrong_with_an_expression_is_said() {
        let mut e = evaluator();
        for (expression, said) in [
            ("r.pinion.z", "z"),
            ("nothing + 1", "nothing"),
            ("r.pinion.y[9]", "has no point 9"),
            ("at(r.pinion.x, r.pinion.y, 9.0)", "9 lies outside the column, 0 to 4"),
            ("r.pinion.x + column([1.0])", "columns of 4 and 1 points"),
            ("let x = 1", "let"),
            ("print(1)", "print"),
            ("timestamp()", "timestamp"),
            ("[].pad(1000000000, 1).len()", "large"),
            ("\"a\".pad(1000000000, \"b\")", "l"),
            ("max(r.pinion.y", ")"),
            ("r.pinion.y", "found a column; allowed: a number"),
            ("r", "allowed: a number"),
        ] {
            let message = e.number(expression).unwrap_err().to_string();
            assert!(message.starts_with(expression) && message.contains(said), "{message}");
        }
    }

    #[test]
    fn names_of_a_member_are_forgotten() {
        let mut e = evaluator();
        assert_eq!(e.with("run", &Value::Number(3.0), |e| e.number("run * r.n")).unwrap(), 6.0);
        assert!(e.number("run").is_err());
    }
}
