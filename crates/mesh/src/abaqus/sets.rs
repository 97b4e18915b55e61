//! Sets of an Abaqus file: numbers, ranges, and names of earlier sets.

use std::collections::BTreeMap;

use super::keywords::{Keyword, Name, split};
use crate::error::{FileFault, FileProblem};
use crate::numbering::{Allowance, Numbering, OpenSets};

/// Sets of nodes, or of elements, under construction.
#[derive(Debug, Default)]
pub(super) struct Sets {
    /// Members by name in its first spelling.
    pub members: OpenSets,
    /// First spelling by the name in capitals.
    spelling: BTreeMap<String, String>,
}

impl Sets {
    /// First spelling of a name, whether the set exists or not; unquoted names are case-insensitive.
    pub(super) fn key(&self, name: &Name) -> String {
        if name.quoted || self.members.contains_key(&name.text) {
            return name.text.clone();
        }
        self.spelling.get(&name.text.to_ascii_uppercase()).unwrap_or(&name.text).clone()
    }

    /// Set of this name, which is created if it does not exist.
    pub(super) fn open(&mut self, name: &Name) -> &mut Vec<usize> {
        let key = self.key(name);
        if !name.quoted {
            self.spelling.entry(key.to_ascii_uppercase()).or_insert_with(|| key.clone());
        }
        self.members.entry(key).or_default()
    }

    pub(super) fn find(&self, name: &Name) -> Option<&Vec<usize>> {
        self.members.get(&self.key(name))
    }
}

/// Nodes or elements that set definitions refer to.
pub(super) struct Targets<'a> {
    pub numbering: &'a Numbering,
    /// Error for a missing number.
    pub missing: fn(u64) -> FileProblem,
    /// Instance whose name may be a prefix of names and numbers.
    pub instance: Option<&'a str>,
}

/// Members in the data lines of `*NSET` or `*ELSET`.
pub(super) fn members(
    keyword: &Keyword,
    sets: &Sets,
    targets: &Targets,
    allowance: &mut Allowance,
) -> Result<Vec<usize>, FileFault> {
    let mut members = Vec::new();
    for &(line, text) in &keyword.data {
        let fields = split(text).into_iter().map(str::trim).filter(|field| !field.is_empty());
        if keyword.has("GENERATE") {
            let numbers: Vec<Option<u64>> = fields.map(|field| field.parse().ok()).collect();
            let (first, last, step) = match numbers[..] {
                [Some(first), Some(last)] => (first, last, 1),
                [Some(first), Some(last), Some(step @ 1..)] => (first, last, step),
                _ => return Err(keyword.fault(line, FileProblem::unexpected(text, "first, last, step"))),
            };
            let range = targets.numbering.range(first, last);
            allowance.take(range.len()).map_err(|limit| keyword.fault(line, limit))?;
            members.extend(range.iter().filter(|(number, _)| (number - first) % step == 0).map(|&(_, index)| index));
            continue;
        }
        for field in fields {
            refer(field, sets, targets, allowance, &mut members).map_err(|problem| keyword.fault(line, problem))?;
        }
    }
    Ok(members)
}

/// Adds the number or the set in one field to `members`.
pub(super) fn refer(
    field: &str,
    sets: &Sets,
    targets: &Targets,
    allowance: &mut Allowance,
    members: &mut Vec<usize>,
) -> Result<(), FileProblem> {
    let field = without_instance(field, targets.instance);
    if let Ok(number) = field.parse() {
        allowance.take(1)?;
        members.push(targets.numbering.index(number).ok_or_else(|| (targets.missing)(number))?);
        return Ok(());
    }
    match sets.find(&Name::parse(field)) {
        Some(other) => {
            allowance.take(other.len().max(1))?;
            members.extend(other);
            Ok(())
        }
        None => Err(FileProblem::unexpected(field, "a number or the name of a set defined before")),
    }
}

/// `field` without the prefix `instance.`.
fn without_instance<'f>(field: &'f str, instance: Option<&str>) -> &'f str {
    let stripped = instance.and_then(|instance| {
        let (prefix, rest) = field.split_at_checked(instance.len())?;
        prefix.eq_ignore_ascii_case(instance).then(|| rest.strip_prefix('.'))?
    });
    stripped.unwrap_or(field)
}
