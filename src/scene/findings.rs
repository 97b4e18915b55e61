//! Collection of the problems of a scene file, all reported at once.

use std::collections::BTreeSet;

use super::locate::Locator;
use super::problem::{Problem, ProblemKind};

/// Problems and warnings found so far.
#[derive(Debug, Default)]
pub(super) struct Findings {
    locator: Locator,
    /// Problems, in the order found.
    pub problems: Vec<Problem>,
    /// Warnings about a scene that is valid.
    pub warnings: Vec<String>,
    /// Keys with a reported problem: what follows from them is not reported again.
    spoiled: BTreeSet<String>,
    /// Whether the last problem was added, and takes help.
    reported: bool,
}

impl Findings {
    /// Empty findings for the file that `locator` describes.
    pub(super) fn new(locator: Locator) -> Self {
        Self { locator, ..Self::default() }
    }

    /// The places of the file's keys, the findings apart.
    pub(super) fn into_locator(self) -> Locator {
        self.locator
    }

    /// The problems, in the order in which they stand in the file.
    pub(super) fn in_order(mut self) -> Vec<Problem> {
        self.problems.sort_by_key(|problem| problem.span.as_ref().map(|span| span.start));
        self.problems
    }

    /// Whether the file itself holds `key` (not only the preset).
    pub(super) fn is_in_file(&self, key: &str) -> bool {
        self.locator.key(key).is_some()
    }

    /// Marks `key` as reported.
    pub(super) fn spoil(&mut self, key: &str) {
        self.spoiled.insert(key.to_owned());
    }

    /// Adds a problem with the value of `key`, unless that key was reported before.
    pub(super) fn problem(
        &mut self,
        kind: ProblemKind,
        key: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) {
        self.reported = !self.spoiled.contains(key);
        if !self.reported {
            return;
        }
        let span = match kind {
            ProblemKind::UnknownKey | ProblemKind::NotAvailable => self.locator.key(key),
            _ => None,
        };
        let span = Some(span.unwrap_or_else(|| self.locator.nearest(key)));
        self.spoil(key);
        self.problems.push(Problem {
            kind,
            key: key.to_owned(),
            found: found.into(),
            allowed: allowed.into(),
            help: None,
            span,
        });
    }

    /// Adds the problem that the value of `key` is not `allowed`.
    pub(super) fn not_allowed(&mut self, key: &str, found: impl Into<String>, allowed: impl Into<String>) {
        self.problem(ProblemKind::NotAllowed, key, found, allowed);
    }

    /// Warns that `what` of the file is not used, and why.
    pub(super) fn unused(&mut self, what: &str, because: &str) {
        self.warnings.push(format!("{what} is not used: {because}"));
    }

    /// Adds a sentence of help to the problem just reported.
    pub(super) fn help(&mut self, sentence: impl AsRef<str>) {
        if let Some(problem) = self.problems.last_mut().filter(|_| self.reported) {
            problem.add_help(sentence.as_ref());
        }
    }

    /// Adds the problem that none of `keys` is given.
    pub(super) fn missing(&mut self, keys: &[&str], allowed: &str) {
        self.reported = !keys.iter().any(|key| {
            self.spoiled.iter().any(|s| s == key || key.strip_prefix(s).is_some_and(|k| k.starts_with('.')))
        });
        if self.reported {
            self.problem(ProblemKind::Missing, keys[0], "nothing", allowed);
            if let [_, others @ ..] = keys
                && !others.is_empty()
            {
                self.help(format!("or give {}", others.join(" or ")));
            }
        }
    }

    /// Adds a problem if more than one of `keys` is given; returns whether that is so.
    pub(super) fn said_twice(&mut self, keys: &[(&str, bool)]) -> bool {
        let given: Vec<&str> = keys.iter().filter(|(_, given)| *given).map(|(key, _)| *key).collect();
        if given.len() < 2 {
            return false;
        }
        self.problem(ProblemKind::SaidTwice, given[given.len() - 1], given.join(" and "), "one of the two");
        self.help(format!("leave one of {} out", given.join(" and ")));
        for key in given {
            self.spoil(key);
        }
        true
    }
}
