//! Separate peaks of a profile.

/// Heights of the separate peaks of a profile, 0 elsewhere: points from which it falls by `share` of their height on both
/// sides before it rises above them.
pub fn separate_peaks(points: &[f64], share: f64) -> Vec<f64> {
    let peaks = points.iter().enumerate().map(|(place, &height)| {
        let is_peak =
            falls(points[..place].iter().rev(), height, share) && falls(points[place + 1..].iter(), height, share);
        if is_peak { height } else { 0.0 }
    });
    peaks.collect()
}

/// Whether a profile falls by `share` of `height` before it rises above it.
fn falls<'a>(mut side: impl Iterator<Item = &'a f64>, height: f64, share: f64) -> bool {
    side.by_ref().take_while(|&&depth| depth <= height).any(|&depth| depth < (1.0 - share) * height)
}
