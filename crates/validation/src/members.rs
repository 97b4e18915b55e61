//! Members of a family of runs: the keys that each sets, and its label.

use super::case_file::{MemberSpec, RunSpec, SampleSpec, VarySpec};
use super::value::Value;
use crate::record::RunOutcome;
use gearwear::report::html::number::to_digits;

/// One run of a family, or a run that is alone.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// Keys and values.
    pub set: Vec<(String, toml::Value)>,
    /// Keys that are taken away.
    pub unset: Vec<String>,
    /// Empty for a run alone.
    pub label: String,
    /// Columns of the family with this member's value.
    pub values: Vec<(String, Value)>,
    /// Expected outcome.
    pub expected: RunOutcome,
    /// Further accepted outcomes.
    pub accepted: Vec<RunOutcome>,
}

impl Member {
    /// Whether `outcome` is one that the case expects or accepts.
    pub fn may_end(&self, outcome: RunOutcome) -> bool {
        outcome == self.expected || self.accepted.contains(&outcome)
    }

    /// Value in a column of the family.
    pub(super) fn value(&self, column: &str) -> Option<&Value> {
        self.values.iter().find(|(name, _)| name == column).map(|(_, value)| value)
    }
}

/// All members of a run; one where it is alone.
pub(super) fn members(run: &RunSpec) -> Vec<Member> {
    let alone = Member {
        set: run.set.iter().map(|(key, value)| (key.clone(), value.clone())).collect(),
        unset: run.unset.clone(),
        label: String::new(),
        values: Vec::new(),
        expected: run.expect,
        accepted: run.accept.clone(),
    };
    if let Some(sample) = &run.sample {
        return (0..sample.count).map(|index| drawn(&alone, sample, index)).collect();
    }
    if !run.each.is_empty() {
        return run.each.iter().map(|member| one_by_one(&alone, member)).collect();
    }
    // The last key changes fastest.
    run.vary.iter().fold(vec![alone], |members, varied| {
        let values = varied.all();
        members.iter().flat_map(|member| values.iter().map(|value| with(member, varied, value.clone()))).collect()
    })
}

impl VarySpec {
    pub fn count(&self) -> usize {
        self.values.as_ref().map_or(self.count.unwrap_or(2), |values| values.len())
    }

    fn all(&self) -> Vec<toml::Value> {
        self.values.clone().unwrap_or_else(|| {
            let intervals = (self.count().max(2) - 1) as f64;
            (0..self.count()).map(|index| self.between(index as f64 / intervals)).collect()
        })
    }

    /// The number at `share` of the range.
    fn between(&self, share: f64) -> toml::Value {
        let (from, to) = (self.from.unwrap_or_default(), self.to.unwrap_or_default());
        toml::Value::Float(if self.log { from * (to / from).powf(share) } else { from + (to - from) * share })
    }

    /// The value at `share` of the range or list.
    fn chosen(&self, share: f64) -> toml::Value {
        match &self.values {
            Some(values) => values[((share * values.len() as f64) as usize).min(values.len() - 1)].clone(),
            None => self.between(share),
        }
    }

    /// The column of its values: as it is named, or the last part of the key.
    fn column(&self) -> String {
        let key = self.key.all().first().map(String::as_str).unwrap_or_default();
        self.name.clone().unwrap_or_else(|| key.rsplit('.').next().unwrap_or(key).to_owned())
    }
}

fn with(member: &Member, varied: &VarySpec, value: toml::Value) -> Member {
    let mut member = member.clone();
    let text = match &value {
        toml::Value::String(text) => text.clone(),
        toml::Value::Float(number) => short(*number),
        other => other.to_string(),
    };
    let said = format!("{} {text}", varied.column().replace('_', " "));
    member.label = if member.label.is_empty() { said } else { format!("{}, {said}", member.label) };
    member.values.push((varied.column(), Value::of_toml(&value)));
    member.set.extend(varied.key.all().iter().map(|key| (key.clone(), value.clone())));
    member
}

/// The number with four digits, for labels.
fn short(number: f64) -> String {
    format!("{:?}", to_digits(number, 4))
}

fn one_by_one(alone: &Member, spec: &MemberSpec) -> Member {
    let own: Vec<(String, toml::Value)> = spec.set.iter().map(|(key, value)| (key.clone(), value.clone())).collect();
    let label = spec.label.clone().unwrap_or_else(|| {
        let changed: Vec<String> = own.iter().map(|(key, value)| format!("{key} = {value}")).collect();
        changed.join(", ")
    });
    Member {
        values: vec![("value".to_owned(), Value::Number(spec.value.unwrap_or(f64::NAN)))],
        unset: [alone.unset.clone(), spec.unset.clone()].concat(),
        expected: spec.expect.unwrap_or(alone.expected),
        // A member with its own expected outcome accepts no other.
        accepted: if spec.expect.is_some() { Vec::new() } else { alone.accepted.clone() },
        set: [alone.set.clone(), own].concat(),
        label,
    }
}

/// Bases of Halton's sequence, one for each key.
const PRIMES: [usize; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];

fn drawn(alone: &Member, sample: &SampleSpec, index: usize) -> Member {
    sample.of.iter().zip(PRIMES.iter().cycle()).fold(alone.clone(), |member, (varied, &base)| {
        // The first points of the sequence are all near 0.
        with(&member, varied, varied.chosen(radical_inverse(index + 20 + sample.seed * sample.count, base)))
    })
}

/// The digits of `index` in `base`, mirrored at the point: a number from 0 to 1.
fn radical_inverse(mut index: usize, base: usize) -> f64 {
    let (mut share, mut weight) = (0.0, 1.0);
    while index > 0 {
        weight /= base as f64;
        share += weight * (index % base) as f64;
        index /= base;
    }
    share
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(text: &str) -> RunSpec {
        toml::from_str(&format!("name = \"f\"\nscene = \"fzg-c\"\n{text}")).unwrap()
    }

    #[test]
    fn combinations_lists_and_samples() {
        let varied = members(&run(
            "set = { \"a.b\" = 1 }\n[[vary]]\nkey = \"x.y\"\nfrom = 1.0\nto = 100.0\ncount = 3\nlog = true\n\
             [[vary]]\nkey = [\"p.t\", \"w.t\"]\nname = \"teeth\"\nvalues = [5, 500]\n",
        ));
        assert_eq!(varied.len(), 6);
        assert_eq!(varied[3].label, "y 10.0, teeth 500");
        assert_eq!(varied[3].set.len(), 4);
        assert_eq!(varied[3].values[1], ("teeth".to_owned(), Value::Number(500.0)));

        let listed =
            members(&run("[[each]]\nvalue = 2.0\nset = { k = 1 }\nexpect = \"refused\"\n[[each]]\nlabel = \"b\"\n"));
        assert_eq!((listed[0].label.as_str(), listed[0].expected), ("k = 1", RunOutcome::Refused));
        assert_eq!((listed[1].label.as_str(), listed[1].expected), ("b", RunOutcome::Sound));

        let either = members(&run("accept = [\"refused\"]\n[[each]]\nset = { k = 1 }\n[[each]]\nexpect = \"sound\"\n"));
        for (outcome, may_end) in [
            (RunOutcome::Sound, [true, true]),
            (RunOutcome::Refused, [true, false]),
            (RunOutcome::Panicked, [false, false]),
        ] {
            assert_eq!([either[0].may_end(outcome), either[1].may_end(outcome)], may_end);
        }

        let sampled = members(&run(
            "[sample]\ncount = 200\nof = [{ key = \"m\", from = 1, to = 3 }, { key = \"s\", values = [\"a\", \"b\"] }]\n",
        ));
        let share = sampled.iter().filter(|m| m.values[1].1 == Value::Text("a".into())).count();
        assert!((95..=105).contains(&share), "{share}");
        let mean: f64 = sampled.iter().map(|m| m.set[0].1.as_float().unwrap()).sum::<f64>() / 200.0;
        assert!((mean - 2.0).abs() < 0.02, "{mean}");
    }
}
