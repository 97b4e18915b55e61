//! The mean profile of the teeth that are chosen.
//!
//! ```text
//! z̄(x)   = 1/n Σ z_t(x)             places x of the first tooth, at which all have a height
//! d_t(x) = z_t(x) − z̄(x)
//! ```
//!
//! Heights of a tooth are counted from its own mean, since machines find the flanks of a gear at different heights (pitch deviations), and the mean
//! of these means is added again; depths of wear are not moved. Between its points a profile is straight; a place in a gap of one tooth
//! is none of the mean. Deviations d_t of the teeth are kept for the uncertainty.

use gearwear_files::data_table::{DataTableError, missing, not_allowed};

use super::file::{FlankSide, MeasuredFile, MeasuredRow, Trace, TraceKind, ValueKind};

/// Distance of two points, in the mean one of their trace, beyond which there is a gap between them.
const GAP: f64 = 2.5;
/// Fewest points of a mean.
const LEAST_POINTS: usize = 2;

/// Traces of a file that are asked for.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TraceChoice {
    /// Tooth; `None`: the mean of all.
    pub tooth: Option<u32>,
    /// Flank; `None`: the one there is.
    pub side: Option<FlankSide>,
    /// Place over the face width, of several; `None`: the one there is.
    pub width_mm: Option<f64>,
    /// Who chooses.
    pub by: ChosenBy,
}

/// Where a choice of traces is made, for messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ChosenBy {
    /// Options of the command line.
    #[default]
    Options,
    /// Keys of a scene.
    Keys,
}

impl ChosenBy {
    /// The option or key of this name.
    fn named(self, name: &str) -> String {
        match self {
            ChosenBy::Options => format!("--{name}"),
            ChosenBy::Keys => name.to_owned(),
        }
    }

    /// The choice of a flank, as it is typed.
    fn flank(self, side: FlankSide) -> String {
        match self {
            ChosenBy::Options => format!("--flank {}", side.name()),
            ChosenBy::Keys => format!("flank = \"{}\"", side.name()),
        }
    }

    /// The choice of a place over the face width.
    fn width(self) -> &'static str {
        match self {
            ChosenBy::Options => "--width",
            ChosenBy::Keys => "width_mm",
        }
    }
}

/// The file `header` with the mean of the profiles among `traces` that are chosen.
pub(super) fn mean(
    mut header: MeasuredFile,
    traces: &[Trace],
    choice: &TraceChoice,
) -> Result<MeasuredFile, DataTableError> {
    if traces.is_empty() {
        return Ok(header);
    }
    let profiles = choose(traces, choice, TraceKind::Profile)?;
    let first = profiles[0];
    header.width_mm = header.width_mm.or(first.width_mm);
    if traces.iter().any(|trace| trace.kind == TraceKind::Lead) {
        let of_flank = TraceChoice { side: first.side, ..*choice };
        header.leads = choose(traces, &of_flank, TraceKind::Lead).into_iter().flatten().cloned().collect();
    }
    if profiles.len() == 1 {
        header.rows.clone_from(&first.points);
        return Ok(header);
    }
    let mut at: Vec<MeasuredRow> = Vec::new();
    let mut heights: Vec<Vec<f64>> = vec![Vec::new(); profiles.len()];
    for &point in &first.points {
        let Some(of_all) = profiles.iter().map(|trace| height_um(trace, point.place)).collect::<Option<Vec<f64>>>()
        else {
            continue;
        };
        at.push(point);
        heights.iter_mut().zip(of_all).for_each(|(own, height)| own.push(height));
    }
    if at.len() < LEAST_POINTS {
        let allowed = format!("at least {LEAST_POINTS}; {} takes one of the teeth", choice.by.named("tooth"));
        let line = first.points.first().map_or(1, |point| point.line);
        return Err(not_allowed(line, "points that all teeth have", at.len(), allowed));
    }
    let count = heights.len() as f64;
    if header.kind == ValueKind::Height {
        let means: Vec<f64> = heights.iter().map(|own| own.iter().sum::<f64>() / own.len() as f64).collect();
        let whole = means.iter().sum::<f64>() / count;
        for (own, mean) in heights.iter_mut().zip(means) {
            own.iter_mut().for_each(|height| *height += whole - mean);
        }
    }
    for (index, point) in at.iter_mut().enumerate() {
        point.height_um = heights.iter().map(|own| own[index]).sum::<f64>() / count;
    }
    for own in &mut heights {
        own.iter_mut().zip(&at).for_each(|(height, point)| *height -= point.height_um);
    }
    (header.rows, header.teeth_um) = (at, heights);
    Ok(header)
}

/// Traces of a kind that are chosen: one for each tooth, all of one flank and, of profiles, at one place over the face width.
pub fn choose<'t>(
    traces: &'t [Trace],
    choice: &TraceChoice,
    kind: TraceKind,
) -> Result<Vec<&'t Trace>, DataTableError> {
    let mut chosen: Vec<&Trace> =
        traces.iter().filter(|trace| trace.kind == kind && !trace.points.is_empty()).collect();
    let line = |chosen: &[&Trace]| chosen.first().and_then(|trace| trace.points.first()).map_or(1, |point| point.line);
    if chosen.is_empty() {
        let allowed = "a trace from root to tip, of which at least one point has a height".to_owned();
        return Err(missing("the profile", allowed));
    }
    let listed = |words: Vec<String>| words.join(", ");
    let sides: Vec<FlankSide> =
        FlankSide::BOTH.into_iter().filter(|&side| chosen.iter().any(|trace| trace.side == Some(side))).collect();
    match choice.side {
        Some(side) if !sides.is_empty() && !sides.contains(&side) => {
            let allowed = listed(sides.iter().map(|&side| choice.by.flank(side)).collect());
            return Err(not_allowed(line(&chosen), &choice.by.named("flank"), side.name(), allowed));
        }
        None if sides.len() > 1 => {
            let allowed = format!("one of them: {}", FlankSide::BOTH.map(|side| choice.by.flank(side)).join(" or "));
            return Err(not_allowed(line(&chosen), "flank", "left and right", allowed));
        }
        side => chosen.retain(|trace| side.is_none() || trace.side.is_none() || trace.side == side),
    }
    if let Some(tooth) = choice.tooth {
        let teeth: Vec<String> = chosen.iter().filter_map(|trace| Some(trace.tooth?.to_string())).collect();
        let first = line(&chosen);
        chosen.retain(|trace| trace.tooth == Some(tooth));
        if chosen.is_empty() {
            let allowed = if teeth.is_empty() { "a file that says the teeth".to_owned() } else { listed(teeth) };
            return Err(not_allowed(first, &choice.by.named("tooth"), tooth, allowed));
        }
    }
    if kind == TraceKind::Profile {
        let mut widths: Vec<f64> = chosen.iter().filter_map(|trace| trace.width_mm).collect();
        widths.sort_by(f64::total_cmp);
        widths.dedup();
        if widths.len() > 1 {
            let allowed = format!("one of them: {} with the nearest", choice.by.width());
            let found = || listed(widths.iter().map(|width| format!("{width}")).collect());
            let wanted = choice
                .width_mm
                .ok_or_else(|| not_allowed(line(&chosen), "place over the face width, mm", found(), allowed))?;
            let away = |width: f64| (width - wanted).abs();
            let nearest = widths.iter().copied().min_by(|a, b| away(*a).total_cmp(&away(*b)));
            chosen.retain(|trace| trace.width_mm == nearest);
        }
    }
    for (index, trace) in chosen.iter().enumerate() {
        if let Some(again) = chosen[..index].iter().find(|other| other.tooth == trace.tooth) {
            let found = trace.tooth.map_or_else(|| "a second trace".to_owned(), |tooth| format!("{tooth} again"));
            let allowed = format!("one trace of a tooth, as from line {}", line(&[again]));
            return Err(not_allowed(line(&[trace]), "tooth", found, allowed));
        }
    }
    Ok(chosen)
}

/// Height of a trace at a place, straight between its points; `None` outside them and in a gap.
fn height_um(trace: &Trace, place: f64) -> Option<f64> {
    let points = &trace.points;
    let after = points.partition_point(|point| point.place < place);
    let next = points.get(after)?;
    if next.place == place {
        return Some(next.height_um);
    }
    let before = points.get(after.checked_sub(1)?)?;
    let mean = (points.last()?.place - points.first()?.place) / (points.len() - 1) as f64;
    let width = next.place - before.place;
    let t = (place - before.place) / width;
    (width <= GAP * mean).then_some(before.height_um + t * (next.height_um - before.height_um))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tooth(number: u32, places: impl Iterator<Item = i32>, height: fn(f64) -> f64) -> Trace {
        let points = places.map(|i| MeasuredRow { line: 3, place: f64::from(i), height_um: height(f64::from(i)) });
        Trace {
            kind: TraceKind::Profile,
            tooth: Some(number),
            side: Some(FlankSide::Left),
            width_mm: None,
            points: points.collect(),
        }
    }

    /// Offsets of the teeth go, what differs in shape stays as deviations, and a gap of one tooth is a gap of the mean.
    #[test]
    fn the_mean_of_teeth_and_their_deviations() {
        let teeth = [
            tooth(1, 0..20, |x| x),
            tooth(2, (0..20).filter(|i| !(5..9).contains(i)), |x| 7.0 + x),
            tooth(3, 1..20, |x| 1.0 + 1.6 * x),
        ];
        let of = mean(MeasuredFile::default(), &teeth, &TraceChoice::default()).unwrap();
        assert_eq!(of.rows.len(), 15);
        for pair in of.rows.windows(2) {
            assert!((pair[1].height_um - pair[0].height_um - 1.2 * (pair[1].place - pair[0].place)).abs() < 1e-12);
        }
        for (own, slope) in of.teeth_um.iter().zip([-0.2, -0.2, 0.4]) {
            assert!((own[14] - own[0] - slope * 18.0).abs() < 1e-12, "{own:?}");
            assert!(own.iter().sum::<f64>().abs() < 1e-9);
        }
        let second = TraceChoice { tooth: Some(2), ..TraceChoice::default() };
        assert_eq!(mean(MeasuredFile::default(), &teeth, &second).unwrap().rows.len(), 16);
    }

    #[test]
    fn what_is_not_one_profile_of_a_tooth_is_refused() {
        let left = tooth(1, 0..9, |x| x);
        let right = Trace { side: Some(FlankSide::Right), ..left.clone() };
        let there = |width: f64| Trace { width_mm: Some(width), ..left.clone() };
        let chosen = |traces: &[Trace], choice: TraceChoice| {
            mean(MeasuredFile::default(), traces, &choice)
                .map(|file| file.rows.len())
                .map_err(|error| error.to_string())
        };
        let nothing = TraceChoice::default();
        let of_side = TraceChoice { side: Some(FlankSide::Right), ..nothing };
        let at = TraceChoice { width_mm: Some(6.0), ..nothing };
        for (traces, choice, words) in [
            (vec![left.clone(), right.clone()], nothing, "found left and right; allowed: one of them: --flank"),
            (vec![left.clone()], of_side, "--flank: found right; allowed: --flank left"),
            (vec![left.clone()], TraceChoice { tooth: Some(4), ..nothing }, "--tooth: found 4; allowed: 1"),
            (vec![left.clone(), left.clone()], nothing, "found 1 again"),
            (vec![there(2.0), there(7.0)], nothing, "found 2, 7"),
            (vec![Trace { kind: TraceKind::Lead, ..left.clone() }], nothing, "the profile is missing"),
        ] {
            let message = chosen(&traces, choice).unwrap_err();
            assert!(message.contains(words), "{message}");
        }
        assert_eq!(chosen(&[left.clone(), right], of_side), Ok(9));
        assert_eq!(chosen(&[there(2.0), there(7.0)], at), Ok(9));
    }
}
