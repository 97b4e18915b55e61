//! Which points of a profile are peaks of their own.

/// The points of a profile that are separate peaks, 0 elsewhere: those from which it falls by `share` of their height on both
/// sides before it rises above them.
pub fn separate_peaks(points: &[f64], share: f64) -> Vec<f64> {
    let falls = |side: &mut dyn Iterator<Item = &f64>, height: f64| {
        side.take_while(|&&depth| depth <= height).any(|&depth| depth < (1.0 - share) * height)
    };
    let separate = |place: usize| {
        let height = points[place];
        falls(&mut points[..place].iter().rev(), height) && falls(&mut points[place + 1..].iter(), height)
    };
    (0..points.len()).map(|place| if separate(place) { points[place] } else { 0.0 }).collect()
}
