//! Suggestion for a misspelt word.

/// The word of `known` that `word` is most like, if it is like any.
pub(crate) fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let word = word.to_lowercase();
    let likeness = |other: &str| {
        let other = other.to_lowercase();
        strsim::normalized_damerau_levenshtein(&word, &other).max(strsim::jaro_winkler(&word, &other) - 0.3)
    };
    let best = known.iter().map(|&other| (likeness(other), other)).max_by(|a, b| a.0.total_cmp(&b.0));
    best.filter(|(likeness, _)| *likeness >= 0.4).map(|(_, other)| other)
}
