//! Waves in the residuals of a profile, which are then fitted along.
//!
//! ```text
//! a cos 2π f x + b sin 2π f x + c x ∂/∂x        x from 0 to 1 along the profile, in roll length or in length along the flank
//! ```
//!
//! A wave of one length, of the machine that cut the teeth or that measured them, is no noise: its error in a coefficient does not fall with the number of points,
//! and known by its length it makes none. The wave that takes most from the residuals is fitted along, with the third term for its length, where the
//! likelihood rises by the factor exp 10 or more over that of noise with a spectrum ([`super::correlation`]); and another one, up to [`MOST_WAVES`]. Waves are those of a machine where white noise is left after
//! them. Otherwise none is fitted along: they then stand for what the simulation does not describe, and would take wear with it.
//!
//! Source: D. J. Thomson, *Spectrum estimation and harmonic analysis*, Proceedings of the IEEE 70 (1982) 1055–1096.

use std::f64::consts::TAU;

use serde::Serialize;

use super::correlation::{Cosines, FittedSpectrum, IS_WHITE, averaged, from_cosines, in_cosines, probabilities};
use super::fit::dot;

/// Most waves of a profile.
pub const MOST_WAVES: usize = 3;
/// Columns that a wave is fitted by.
const COLUMNS: usize = 3;
/// Least rise of the logarithm of the likelihood.
const LEAST_RISE: f64 = 10.0;
/// Fewest waves in a profile, and the step from one number to the next.
const FEWEST_IN_PROFILE: f64 = 1.5;
const STEP: f64 = 0.2;
/// Most waves in a profile.
const MOST_IN_PROFILE: f64 = 60.0;
/// Fewest points in a wave.
const POINTS_IN_WAVE: f64 = 4.0;
/// Number in a profile up to which every wave is tried; of shorter ones those that seem to take most.
const ALL_TRIED: f64 = 3.0;
const SHORT_TRIED: usize = 12;
/// Least part of a wave that other columns leave.
const LEAST_LEFT: f64 = 1e-3;

/// A wave.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Wave {
    /// Mean length, in the lengths it is even in.
    pub length_mm: f64,
    pub amplitude_um: f64,
}

/// A wave with the columns it is fitted by.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundWave {
    pub wave: Wave,
    pub columns: [Vec<f64>; COLUMNS],
}

/// Cosine and sine with `number` waves in a profile with these places.
fn cosine_and_sine(part: &[f64], number: f64) -> [Vec<f64>; 2] {
    [f64::cos, f64::sin].map(|of| part.iter().map(|x| of(TAU * number * x)).collect())
}

/// Waves in the residuals of a profile to which `columns` are fitted; `places_mm` are those in which a wave may be even.
pub fn find(residuals: &[f64], columns: &[&[f64]], places_mm: &[Vec<f64>]) -> Vec<FoundWave> {
    let mut cosines = Cosines::new(residuals, columns.iter().copied());
    let parts: Vec<(Vec<f64>, f64)> = places_mm.iter().filter_map(|place| along(place)).collect();
    let mut found: Vec<FoundWave> = Vec::new();
    while found.len() < MOST_WAVES {
        let Some(noise) = likeliest(&cosines.spectra()) else { break };
        let Some((place, number)) = strongest(residuals.len(), &cosines, &noise, &parts) else { break };
        let (part, length_mm) = &parts[place];
        let [cosine, sine] = cosine_and_sine(part, number);
        let Some([a, b]) = amplitudes(&cosines, &noise, &cosine, &sine) else { break };
        let moved = part.iter().zip(cosine.iter().zip(&sine)).map(|(x, (c, s))| x * (b * c - a * s)).collect();
        let wave = Wave { length_mm: length_mm / number, amplitude_um: a.hypot(b) };
        let one = FoundWave { wave, columns: [cosine, sine, moved] };
        let mut with = cosines.clone();
        one.columns.iter().for_each(|column| with.fit_too(in_cosines(column)));
        match likeliest(&with.spectra()) {
            Some(after) if after.greatest - noise.greatest >= LEAST_RISE => {}
            _ => break,
        }
        cosines = with;
        found.push(one);
    }
    let white = probabilities(&cosines.spectra()).first().copied().unwrap_or(0.0);
    if white > IS_WHITE { found } else { Vec::new() }
}

/// Places as parts of the profile, and its length.
fn along(place_mm: &[f64]) -> Option<(Vec<f64>, f64)> {
    let (first, last) = (*place_mm.first()?, *place_mm.last()?);
    (last > first).then(|| (place_mm.iter().map(|x| (x - first) / (last - first)).collect(), last - first))
}

fn likeliest(spectra: &[FittedSpectrum]) -> Option<FittedSpectrum> {
    spectra.iter().max_by(|a, b| a.greatest.total_cmp(&b.greatest)).cloned()
}

/// The wave that takes most from the values: in which places it is even, and its number in the profile.
fn strongest(
    points: usize,
    cosines: &Cosines,
    noise: &FittedSpectrum,
    parts: &[(Vec<f64>, f64)],
) -> Option<(usize, f64)> {
    let left = cosines.left_by(&noise.shape, &cosines.values)?;
    let most = MOST_IN_PROFILE.min(points as f64 / POINTS_IN_WAVE).min(noise.shape.len() as f64 / POINTS_IN_WAVE);
    let count = ((most - FEWEST_IN_PROFILE) / STEP).max(0.0) as usize;
    let numbers = (0..count).map(|i| FEWEST_IN_PROFILE + STEP * i as f64);
    let tried = numbers.flat_map(|number| (0..parts.len()).map(move |place| (place, number)));
    let (mut tried, short): (Vec<_>, Vec<_>) = tried.partition(|&(_, number)| number <= ALL_TRIED);
    // Of short waves, what a cosine and a sine have in common with the residuals tells nearly all.
    let at_points = from_cosines(&left);
    let mut seeming: Vec<(f64, (usize, f64))> = short
        .into_iter()
        .map(|(place, number)| {
            let k = ((2.0 * number).round() as usize).min(noise.shape.len() - 1);
            let waves = cosine_and_sine(&parts[place].0, number);
            let square: f64 = waves.iter().map(|wave| dot(&averaged(wave), &at_points).powi(2)).sum();
            (square * noise.shape[k], (place, number))
        })
        .collect();
    seeming.sort_by(|a, b| b.0.total_cmp(&a.0));
    tried.extend(seeming.into_iter().take(SHORT_TRIED).map(|(_, one)| one));
    let taken = |&(place, number): &(usize, f64)| {
        let [cosine, sine] = cosine_and_sine(&parts[place].0, number);
        taken_by(cosines, noise, &left, &cosine, &sine).map_or(0.0, |(taken, _)| taken)
    };
    let with: Vec<(f64, (usize, f64))> = tried.into_iter().map(|one| (taken(&one), one)).collect();
    with.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(taken, _)| *taken > 0.0).map(|(_, one)| one)
}

/// a and b of a wave.
fn amplitudes(cosines: &Cosines, noise: &FittedSpectrum, cosine: &[f64], sine: &[f64]) -> Option<[f64; 2]> {
    let left = cosines.left_by(&noise.shape, &cosines.values)?;
    taken_by(cosines, noise, &left, cosine, sine).map(|(_, amplitudes)| amplitudes)
}

/// What a cosine and a sine take from the weighted sum of squares, and their amplitudes; `None` where other columns leave nothing of them.
fn taken_by(
    cosines: &Cosines,
    noise: &FittedSpectrum,
    left: &[f64],
    cosine: &[f64],
    sine: &[f64],
) -> Option<(f64, [f64; 2])> {
    let [c, s] = [cosine, sine].map(in_cosines);
    let [c_left, s_left] = [&c, &s].map(|column| cosines.left_by(&noise.shape, column));
    let (c_left, s_left) = (c_left?, s_left?);
    let whole = |column: &[f64]| column.iter().zip(&noise.shape).map(|(value, s)| value * value / s).sum::<f64>();
    let (cc, ss, cs) = (dot(&c_left, &c), dot(&s_left, &s), dot(&c_left, &s));
    let (cy, sy) = (dot(&c, left), dot(&s, left));
    let determinant = cc * ss - cs * cs;
    if cc < LEAST_LEFT * whole(&c) || ss < LEAST_LEFT * whole(&s) || determinant < LEAST_LEFT * cc * ss {
        return None;
    }
    let (a, b) = ((ss * cy - cs * sy) / determinant, (cc * sy - cs * cy) / determinant);
    Some((a * cy + b * sy, [a, b]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(count: usize, seed: u32) -> Vec<f64> {
        let mut state = seed;
        let mut uniform = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1u32 << 24) - 0.5
        };
        (0..count).map(|_| (0..12).map(|_| uniform()).sum()).collect()
    }

    /// A wave is found by length and amplitude, in the places it is even in; of noise alone there is none.
    #[test]
    fn ver_a_wave_is_found_and_noise_is_none() {
        let roll: Vec<f64> = (0..400).map(|i| (30.0 + 500.0 * f64::from(i) / 399.0).sqrt()).collect();
        let arc: Vec<f64> = (0..400).map(|i| 7.0 * f64::from(i) / 399.0).collect();
        let one = vec![1.0; 400];
        let places = [arc.clone(), roll.clone()];
        for (place, length) in [(&arc, 1.07), (&roll, 1.7)] {
            let wave = place.iter().map(|x| 0.8 * (TAU * x / length + 1.0).sin());
            let values: Vec<f64> = wave.zip(noise(400, 3)).map(|(wave, noise)| wave + 0.5 * noise).collect();
            let found = find(&values, &[&one], &places);
            let wave = found[0].wave;
            assert_eq!(found.len(), 1);
            assert!(
                (wave.length_mm / length - 1.0).abs() < 0.02 && (wave.amplitude_um / 0.8 - 1.0).abs() < 0.15,
                "{wave:?}"
            );
        }
        let found = (0..20).filter(|&seed| !find(&noise(400, seed), &[&one], &places).is_empty()).count();
        assert!(found <= 2, "{found}");
        assert!(find(&[0.0; 400], &[&one], &places).is_empty() && find(&[1.0], &[], &places).is_empty());
    }
}
