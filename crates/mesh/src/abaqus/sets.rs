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

    /// Names with their members.
    fn named(&self) -> impl Iterator<Item = (Name, &Vec<usize>)> {
        self.members.iter().map(|(text, members)| {
            let quoted = self.spelling.get(&text.to_ascii_uppercase()) != Some(text);
            (Name { text: text.clone(), quoted }, members)
        })
    }
}

/// Numbers and sets of nodes, or of elements, of the assembly or of an instance.
#[derive(Debug, Default)]
pub(super) struct Named {
    /// Name of the instance.
    pub instance: Option<Name>,
    pub numbers: Numbering,
    pub sets: Sets,
}

/// Nodes or elements that a definition may refer to.
pub(super) struct Targets<'a> {
    /// Those of the assembly, then of the instances.
    pub all: &'a [Named],
    /// Whose numbers and names need no prefix.
    pub own: usize,
    /// Error for a missing number.
    pub missing: fn(u64) -> FileProblem,
}

impl Targets<'_> {
    /// Those that a field without a prefix may mean: of an assembly with one instance that instance's, too.
    fn near(&self) -> impl Iterator<Item = &Named> {
        let alone = if self.own == 0 && self.all.len() == 2 { self.all.get(1) } else { None };
        self.all.get(self.own).into_iter().chain(alone)
    }

    /// Node of a number, with or without a prefix; `None` where the field is no number.
    pub(super) fn node(&self, field: &str) -> Option<Result<usize, FileProblem>> {
        let (number, found) = self.numbered(field)?;
        Some(found.ok_or_else(|| (self.missing)(number)))
    }

    /// Number in a field, and what has it.
    fn numbered(&self, field: &str) -> Option<(u64, Option<usize>)> {
        if let Ok(number) = field.parse() {
            return Some((number, self.near().find_map(|own| own.numbers.index(number))));
        }
        let (instance, rest) = self.prefixed(field)?;
        let number = rest.parse().ok()?;
        Some((number, instance.numbers.index(number)))
    }

    /// Set of this name.
    pub(super) fn set(&self, name: &Name) -> Option<&Vec<usize>> {
        self.near().find_map(|own| own.sets.find(name)).or_else(|| {
            let (instance, rest) = self.prefixed(&name.text)?;
            instance.sets.find(&Name { text: rest.to_owned(), quoted: name.quoted })
        })
    }

    /// The instance that `text` has as its prefix `INSTANCE.`, and the rest.
    fn prefixed<'t>(&self, text: &'t str) -> Option<(&Named, &'t str)> {
        self.all.iter().find_map(|own| {
            let name = own.instance.as_ref()?;
            let (prefix, rest) = text.split_at_checked(name.text.len())?;
            let is_own = name.is(&Name { text: prefix.to_owned(), quoted: name.quoted });
            is_own.then_some((own, rest.strip_prefix('.')?))
        })
    }

    /// Members in the data lines of `*NSET` or `*ELSET`.
    pub(super) fn members(&self, keyword: &Keyword, allowance: &mut Allowance) -> Result<Vec<usize>, FileFault> {
        let mut members = Vec::new();
        for &(at, text) in &keyword.data {
            let fields = split(text).into_iter().map(str::trim).filter(|field| !field.is_empty());
            if keyword.has("GENERATE") {
                let numbers: Vec<Option<u64>> = fields.map(|field| field.parse().ok()).collect();
                let (first, last, step) = match numbers[..] {
                    [Some(first), Some(last)] => (first, last, 1),
                    [Some(first), Some(last), Some(step @ 1..)] => (first, last, step),
                    _ => return Err(keyword.fault(at, FileProblem::unexpected(text, "first, last, step"))),
                };
                let ranges = self.near().map(|own| own.numbers.range(first, last));
                let range = ranges.max_by_key(|range| range.len()).unwrap_or_default();
                allowance.take(range.len()).map_err(|limit| keyword.fault(at, limit))?;
                members
                    .extend(range.iter().filter(|(number, _)| (number - first) % step == 0).map(|&(_, index)| index));
                continue;
            }
            for field in fields {
                self.refer(field, allowance, &mut members).map_err(|problem| keyword.fault(at, problem))?;
            }
        }
        Ok(members)
    }

    /// Adds the number or the set in one field to `members`.
    pub(super) fn refer(
        &self,
        field: &str,
        allowance: &mut Allowance,
        members: &mut Vec<usize>,
    ) -> Result<(), FileProblem> {
        if let Some(found) = self.node(field) {
            allowance.take(1)?;
            members.push(found?);
            return Ok(());
        }
        match self.set(&Name::parse(field)) {
            Some(other) => {
                allowance.take(other.len().max(1))?;
                members.extend(other);
                Ok(())
            }
            None => Err(FileProblem::unexpected(field, "a number or the name of a set defined before")),
        }
    }
}

/// Sets of the whole file. Of a single instance they join those of the assembly; of several they have the prefix `INSTANCE.`, and sets of
/// the same name are one without it as well, where the assembly has none of that name.
pub(super) fn joined(mut all: Vec<Named>, allowance: &mut Allowance) -> Result<Sets, FileProblem> {
    let instances = all.split_off(1);
    let mut sets = all.pop().map(|assembly| assembly.sets).unwrap_or_default();
    let several = instances.len() > 1;
    let of_assembly: Vec<Name> = sets.named().filter(|_| several).map(|(name, _)| name).collect();
    for Named { instance, sets: own, .. } in &instances {
        for (name, members) in own.named() {
            if !of_assembly.iter().any(|other| other.is(&name)) {
                allowance.take(members.len())?;
                sets.open(&name).extend(members);
            }
            if let Some(instance) = instance.as_ref().filter(|_| several) {
                allowance.take(members.len())?;
                let text = format!("{}.{}", instance.text, name.text);
                sets.open(&Name { text, quoted: name.quoted || instance.quoted }).extend(members);
            }
        }
    }
    Ok(sets)
}
