//! Suggestion for a misspelt word.

/// The word of `known` that `word` is most like, if it is like any.
pub fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let word = word.to_lowercase();
    let best = known.iter().map(|&other| (likeness(&word, &other.to_lowercase()), other));
    let best = best.max_by(|a, b| a.0.total_cmp(&b.0));
    best.filter(|(likeness, _)| *likeness >= 0.4).map(|(_, other)| other)
}

/// Likeness of two words, at most 1.
fn likeness(word: &str, other: &str) -> f64 {
    strsim::normalized_damerau_levenshtein(word, other).max(strsim::jaro_winkler(word, other) - 0.3)
}
