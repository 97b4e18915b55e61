//! The grammar of the cases' expressions: text to a tree of terms.
//!
//! ```text
//! expression   binary operators between terms, from loose to tight:
//!              ||   &&   == !=   < <= > >=   + -   * / %   **          (** groups to the right, the others to the left)
//! term         -term   !term   operand suffix…
//! operand      1.5e-3   true   false   "text"   name   function(expression, …)   [expression, …]   (expression)
//! suffix       .name   .function(expression, …)   [expression]
//! ```
//!
//! A sign binds tighter than a power: `-2 ** 2` is 4. `x.f(y)` is `f(x, y)`. Operator precedence is climbed as Pratt does (Top
//! down operator precedence, 1973): each operator has a strength, and a term extends to the right over all that are stronger.

/// Greatest depth of nested terms, against exhaustion of the stack.
const MOST_DEPTH: usize = 128;

/// Signs, the longer ones first.
const SIGNS: [&str; 21] =
    ["**", "==", "!=", "<=", ">=", "&&", "||", "+", "-", "*", "/", "%", "<", ">", "!", "(", ")", "[", "]", ",", "."];

/// Syntax error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SyntaxError {
    #[error("found {found} at character {place}; allowed: {allowed}")]
    Unexpected { found: String, place: usize, allowed: &'static str },
    #[error("found terms nested deeper than {MOST_DEPTH} at character {place}; allowed: fewer, with [[define]]")]
    TooDeep { place: usize },
}

/// A term, and the character of the expression at which it stands, from 1.
#[derive(Debug, Clone, PartialEq)]
pub struct TermNode {
    pub term: Term,
    pub place: usize,
}

/// Kind of a term, with its parts.
#[derive(Debug, Clone, PartialEq)]
pub enum Term {
    Number(f64),
    Truth(bool),
    Text(String),
    Name(String),
    /// `[a, b]`
    List(Vec<TermNode>),
    /// `-a`
    Minus(Box<TermNode>),
    /// `!a`
    Not(Box<TermNode>),
    /// `a && b`, `a || b`: the second term has a value only where the first one does not decide.
    Both(Box<[TermNode; 2]>),
    /// See [`Term::Both`].
    Either(Box<[TermNode; 2]>),
    /// Any other operator between two terms.
    Binary(&'static str, Box<[TermNode; 2]>),
    /// `a.name`
    Member(Box<TermNode>, String),
    /// `a[b]`
    Index(Box<[TermNode; 2]>),
    /// `function(a, b)`
    Call(String, Vec<TermNode>),
}

/// The tree of an expression.
pub fn parse(expression: &str) -> Result<TermNode, SyntaxError> {
    let mut parser = Parser { tokens: tokens(expression)?, next: 0, end: expression.chars().count() + 1 };
    let whole = parser.expression(0, 0)?;
    if parser.peek().is_some() { Err(parser.unexpected("an operator or the end")) } else { Ok(whole) }
}

#[derive(Debug, Clone, PartialEq)]
enum Token {
    Number(f64),
    Text(String),
    Name(String),
    Sign(&'static str),
}

fn tokens(expression: &str) -> Result<Vec<(Token, usize)>, SyntaxError> {
    let mut tokens = Vec::new();
    let (mut rest, mut place) = (expression, 1);
    while let Some(first) = rest.chars().next() {
        let (token, length) = if first.is_whitespace() {
            (None, first.len_utf8())
        } else if first.is_ascii_digit() {
            let length = length_of_number(rest);
            let number = rest[..length].parse();
            (Some(Token::Number(number.map_err(|_| unexpected(&rest[..length], place, "a number"))?)), length)
        } else if first.is_alphabetic() || first == '_' {
            let length = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            (Some(Token::Name(rest[..length].to_owned())), length)
        } else if first == '"' {
            let (text, length) = quoted(rest).ok_or_else(|| unexpected(rest, place, "a text that ends with \""))?;
            (Some(Token::Text(text)), length)
        } else if let Some(sign) = SIGNS.into_iter().find(|sign| rest.starts_with(sign)) {
            (Some(Token::Sign(sign)), sign.len())
        } else {
            return Err(unexpected(
                &first.to_string(),
                place,
                "numbers, names, texts in quotes, operators and brackets",
            ));
        };
        tokens.extend(token.map(|token| (token, place)));
        place += rest[..length].chars().count();
        rest = &rest[length..];
    }
    Ok(tokens)
}

fn unexpected(found: &str, place: usize, allowed: &'static str) -> SyntaxError {
    SyntaxError::Unexpected { found: format!("`{found}`"), place, allowed }
}

/// Bytes of the number at the beginning: digits, a fraction, an exponent.
fn length_of_number(text: &str) -> usize {
    let mut length = leading_digits(text);
    if let Some(fraction) = text[length..].strip_prefix('.')
        && leading_digits(fraction) > 0
    {
        length += 1 + leading_digits(fraction);
    }
    if let Some(exponent) = text[length..].strip_prefix(['e', 'E']) {
        let sign = usize::from(exponent.starts_with(['+', '-']));
        if leading_digits(&exponent[sign..]) > 0 {
            length += 1 + sign + leading_digits(&exponent[sign..]);
        }
    }
    length
}

fn leading_digits(text: &str) -> usize {
    text.bytes().take_while(u8::is_ascii_digit).count()
}

/// The text in quotes at the beginning and its bytes with them; `\` takes the next character as it is.
fn quoted(text: &str) -> Option<(String, usize)> {
    let mut inside = String::new();
    let mut characters = text.char_indices().skip(1);
    while let Some((at, c)) = characters.next() {
        match c {
            '"' => return Some((inside, at + 1)),
            '\\' => inside.push(characters.next()?.1),
            c => inside.push(c),
        }
    }
    None
}

/// How strongly an operator binds, and whether it groups to the right.
fn strength(sign: &str) -> Option<(u8, bool)> {
    Some(match sign {
        "||" => (1, false),
        "&&" => (2, false),
        "==" | "!=" => (3, false),
        "<" | "<=" | ">" | ">=" => (4, false),
        "+" | "-" => (5, false),
        "*" | "/" | "%" => (6, false),
        "**" => (7, true),
        _ => return None,
    })
}

struct Parser {
    tokens: Vec<(Token, usize)>,
    next: usize,
    end: usize,
}

impl Parser {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.next).map(|(token, _)| token)
    }

    fn place(&self) -> usize {
        self.tokens.get(self.next).map_or(self.end, |(_, place)| *place)
    }

    fn unexpected(&self, allowed: &'static str) -> SyntaxError {
        let found = match self.peek() {
            None => "the end".to_owned(),
            Some(Token::Number(number)) => format!("`{number}`"),
            Some(Token::Text(text)) => format!("{text:?}"),
            Some(Token::Name(name)) => format!("`{name}`"),
            Some(Token::Sign(sign)) => format!("`{sign}`"),
        };
        SyntaxError::Unexpected { found, place: self.place(), allowed }
    }

    /// Consumes `sign` if it comes next.
    fn takes(&mut self, sign: &str) -> bool {
        let found = matches!(self.peek(), Some(Token::Sign(next)) if *next == sign);
        self.next += usize::from(found);
        found
    }

    fn expect(&mut self, sign: &str, allowed: &'static str) -> Result<(), SyntaxError> {
        if self.takes(sign) { Ok(()) } else { Err(self.unexpected(allowed)) }
    }

    /// A term with all operators behind it that are at least as strong as `least`.
    fn expression(&mut self, least: u8, depth: usize) -> Result<TermNode, SyntaxError> {
        let mut left = self.term(depth)?;
        // Every link of a chain deepens the tree by one.
        let mut depth = depth;
        while let Some(Token::Sign(sign)) = self.peek() {
            let (sign, place) = (*sign, self.place());
            let Some((strength, to_the_right)) = strength(sign).filter(|(strength, _)| *strength >= least) else {
                break;
            };
            self.next += 1;
            depth += 1;
            let right = self.expression(if to_the_right { strength } else { strength + 1 }, depth)?;
            let both = Box::new([left, right]);
            let term = match sign {
                "&&" => Term::Both(both),
                "||" => Term::Either(both),
                sign => Term::Binary(sign, both),
            };
            left = TermNode { term, place };
        }
        Ok(left)
    }

    fn term(&mut self, depth: usize) -> Result<TermNode, SyntaxError> {
        let place = self.place();
        if depth >= MOST_DEPTH {
            return Err(SyntaxError::TooDeep { place });
        }
        if self.takes("-") {
            return Ok(TermNode { term: Term::Minus(Box::new(self.term(depth + 1)?)), place });
        }
        if self.takes("!") {
            return Ok(TermNode { term: Term::Not(Box::new(self.term(depth + 1)?)), place });
        }
        let mut operand = self.operand(depth)?;
        for depth in depth + 1.. {
            if depth >= MOST_DEPTH {
                return Err(SyntaxError::TooDeep { place });
            }
            let place = self.place();
            let term = if self.takes("[") {
                let index = self.expression(0, depth)?;
                self.expect("]", "an operator or `]`")?;
                Term::Index(Box::new([operand, index]))
            } else if self.takes(".") {
                let Some(Token::Name(name)) = self.peek().cloned() else { return Err(self.unexpected("a name")) };
                self.next += 1;
                if self.takes("(") {
                    let mut arguments = vec![operand];
                    arguments.extend(self.list(")", depth)?);
                    Term::Call(name, arguments)
                } else {
                    Term::Member(Box::new(operand), name)
                }
            } else {
                return Ok(operand);
            };
            operand = TermNode { term, place };
        }
        Ok(operand)
    }

    fn operand(&mut self, depth: usize) -> Result<TermNode, SyntaxError> {
        let place = self.place();
        let Some(token) = self.peek().cloned() else { return Err(self.unexpected("a term")) };
        if token == Token::Sign("(") {
            self.next += 1;
            let inside = self.expression(0, depth + 1)?;
            self.expect(")", "an operator or `)`")?;
            return Ok(inside);
        }
        if matches!(token, Token::Sign(sign) if sign != "[") {
            return Err(self.unexpected("a term"));
        }
        self.next += 1;
        let term = match token {
            Token::Number(number) => Term::Number(number),
            Token::Text(text) => Term::Text(text),
            Token::Name(name) if name == "true" || name == "false" => Term::Truth(name == "true"),
            Token::Name(name) if self.takes("(") => Term::Call(name, self.list(")", depth + 1)?),
            Token::Name(name) => Term::Name(name),
            Token::Sign(_) => Term::List(self.list("]", depth + 1)?),
        };
        Ok(TermNode { term, place })
    }

    /// Expressions between commas, up to the bracket that closes them.
    fn list(&mut self, close: &'static str, depth: usize) -> Result<Vec<TermNode>, SyntaxError> {
        let mut items = Vec::new();
        while !self.takes(close) {
            if !items.is_empty() {
                self.expect(",", "an operator, `,` or the bracket that closes the list")?;
                // A comma may stand behind the last item.
                if self.takes(close) {
                    break;
                }
            }
            items.push(self.expression(0, depth)?);
        }
        Ok(items)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_expression_is_refused_with_its_place() {
        for (expression, said) in [
            ("max(y", "found the end at character 6; allowed: an operator, `,` or the bracket"),
            ("let x", "found `x` at character 5; allowed: an operator or the end"),
            ("2 * ", "found the end at character 5; allowed: a term"),
            ("a; b", "found `;` at character 2"),
            ("µ + \"a", "found `\"a` at character 5; allowed: a text that ends"),
            ("a.1", "found `1` at character 3; allowed: a name"),
            ("[1, , 2]", "found `,` at character 5; allowed: a term"),
        ] {
            let message = parse(expression).unwrap_err().to_string();
            assert!(message.contains(said), "{expression}: {message}");
        }
    }

    /// Nested brackets and chains are limited, against exhaustion of the stack.
    #[test]
    fn depth_has_a_limit() {
        for deep in
            ["(".repeat(100_000), "-".repeat(100_000), format!("1{}", "+1".repeat(100_000)), "a.".repeat(100_000)]
        {
            assert!(matches!(parse(&deep), Err(SyntaxError::TooDeep { .. })));
        }
        assert!(parse(&format!("1{}", "+1".repeat(100))).is_ok());
    }
}
