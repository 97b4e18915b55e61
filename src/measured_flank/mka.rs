//! Curves of a gear measuring machine: the text export `.mka` of Klingelnberg's P40.
//!
//! ```text
//! HEADER KS.MK.FILE
//! UNDEFINED -2147483.648
//!   21 :Normalmodul mn..[mm].: 4.500
//!   22 :Zähnezahl z........: 16
//!   24 :Eingriffswinkel....: 20.0
//!   41 :Start Messbereich.....da  [mm]..:  68.4      68.4
//!   44 :Ende Messbereich......de  [mm]..:  82.0      82.0
//! Profil:
//! Zahn-Nr.: 1 links / 480  Werte  z= 7.000
//! -2147483.648   -16.021   -16.133 …
//! ```
//!
//! Lines of the header have a number, a label and values, the second of two that of right flanks. After a title come the curves of teeth,
//! each a line with tooth, flank, number of values and place, and then the values, in µm, which rise where there is more material.
//!
//! | title | values | ends |
//! |---|---|---|
//! | `Profil` | even in roll length | header lines 41 and 44, diameters |
//! | `Flankenlinie` | even over the face width | header lines 51 and 54, or from 0 to the face width of line 26 |
//!
//! The roll length at a diameter d is ρ = √(d² − d_b²)/2, d_b = d cos α_t with the reference diameter d = z m_n/cos β and
//! tan α_t = tan α_n/cos β (ISO 21771-1). Values that are undefined ([`super::undefined`]) are gaps. Blocks of other titles (twist, pitch, diameters) are
//! left out. The grammar is that of files, of which none is documented in public.

use gearwear_bodies::gear::involute::Involute;
use gearwear_files::data_table::{DataTableError, missing, not_allowed, number};

use super::file::{FlankSide, MachineGear, MeasuredFile, MeasuredRow, PlaceColumn, Trace, TraceKind};
use super::undefined::undefined;

/// Numbers of header lines.
pub(super) const MODULE: u32 = 21;
pub(super) const TEETH: u32 = 22;
pub(super) const HELIX_ANGLE: u32 = 23;
pub(super) const PRESSURE_ANGLE: u32 = 24;
pub(super) const FACE_WIDTH: u32 = 26;
pub(super) const PROFILE_ENDS: [u32; 2] = [41, 44];
const LEAD_ENDS: [u32; 2] = [51, 54];
/// Most values of a curve.
const MOST_VALUES: usize = 1_000_000;
/// Greatest number of teeth, module and diameter of a gear.
const MOST: f64 = 1e5;
/// Greatest angle, degrees.
const MOST_ANGLE_DEG: f64 = 60.0;

/// A numbered line of the header.
struct HeaderLine<'a> {
    line: usize,
    code: u32,
    label: &'a str,
    values: Vec<f64>,
}

/// Reads the header and the traces of an export.
pub(super) fn read(text: &str) -> Result<(MeasuredFile, Vec<Trace>), DataTableError> {
    let mut lines = (1..).zip(text.lines().map(str::trim)).peekable();
    let first = lines.next().map(|(_, first)| first).unwrap_or_default();
    if !first.contains("KS.MK.FILE") {
        return Err(not_allowed(1, "format", first, "HEADER KS.MK.FILE, the export of curves".to_owned()));
    }
    let mut header: Vec<HeaderLine<'_>> = Vec::new();
    let mut named = None;
    let mut title: &str = "";
    let mut found: Vec<Trace> = Vec::new();
    while let Some((line, content)) = lines.next() {
        if let Some(head) = CurveHead::find(line, content)? {
            if let Some(own) = content.split_once("Zahn-Nr.").map(|(before, _)| before.trim().trim_end_matches(':')) {
                title = if own.is_empty() { title } else { own };
            }
            let mut values: Vec<(usize, f64)> = Vec::with_capacity(head.count.min(MOST_VALUES));
            while values.len() < head.count {
                let Some((at, row)) = lines.next_if(|(_, row)| !row.contains("Zahn-Nr.")) else { break };
                for field in row.split_whitespace() {
                    let value = number(field).ok_or_else(|| not_allowed(at, "Werte", field, "a number".to_owned()))?;
                    values.push((at, value));
                }
            }
            if values.len() != head.count {
                let allowed = format!("{}, as the line says", head.count);
                return Err(not_allowed(line, "number of values", values.len(), allowed));
            }
            let is_value = |row: &str| row.split_whitespace().next().is_some_and(|field| number(field).is_some());
            if let Some((at, row)) = lines.next_if(|(_, row)| is_value(row) && !row.contains(':')) {
                let allowed = format!("{} values, as line {line} says", head.count);
                return Err(not_allowed(at, "Werte", row, allowed));
            }
            let kind = match title {
                "Profil" => TraceKind::Profile,
                "Flankenlinie" => TraceKind::Lead,
                _ => continue,
            };
            let places = places(&header, kind, head.side, values.len())?;
            let heights: Vec<f64> = values.iter().map(|(_, value)| *value).collect();
            let gone = undefined(&heights, named);
            let points = values.iter().zip(places).zip(gone).filter(|(_, gone)| !gone);
            let points = points.map(|((&(line, height_um), place), _)| MeasuredRow { line, place, height_um });
            let width_mm = (kind == TraceKind::Profile).then_some(head.at).flatten();
            found.push(Trace {
                kind,
                tooth: Some(head.tooth),
                side: Some(head.side),
                width_mm,
                points: points.collect(),
            });
        } else if let Some(own) = HeaderLine::find(line, content) {
            header.push(own);
        } else if let Some(value) = content.strip_prefix("UNDEFINED") {
            let value = value.split('!').next().unwrap_or_default().trim();
            let undefined = number(value).ok_or_else(|| not_allowed(line, "UNDEFINED", value, "a number".to_owned()));
            named = Some(undefined?);
        } else if let Some(own) = content.strip_suffix(':') {
            title = own.trim();
        }
    }
    let line = header.iter().find(|own| own.code == TEETH).map_or(0, |own| own.line);
    let machine_gear =
        MachineGear { line, teeth: value(&header, TEETH, MOST)? as u32, base_radius_mm: base_radius_mm(&header)? };
    let file = MeasuredFile {
        place: PlaceColumn::RollLengthMm,
        place_name: "roll length, mm".to_owned(),
        machine_gear: Some(machine_gear),
        ..MeasuredFile::default()
    };
    match found.is_empty() {
        true => Err(missing("a curve", "Zahn-Nr.: 1 links / 480 Werte z= 7.0, and the values below".to_owned())),
        false => Ok((file, found)),
    }
}

impl<'a> HeaderLine<'a> {
    /// `  22 :Zähnezahl z........: 16`: number, label, and what of the rest are numbers.
    fn find(line: usize, content: &'a str) -> Option<Self> {
        let (code, rest) = content.split_once(':')?;
        let code = code.trim().parse().ok()?;
        let (label, values) = rest.split_once(':')?;
        let label = label.trim().trim_end_matches('.');
        Some(Self { line, code, label, values: values.split([' ', '\t', ':']).filter_map(number).collect() })
    }
}

/// First line of a curve.
struct CurveHead {
    tooth: u32,
    side: FlankSide,
    count: usize,
    /// Number after z= or d=.
    at: Option<f64>,
}

impl CurveHead {
    /// `Zahn-Nr.: 1 links / 480  Werte  z= 7.000`; a letter after the number is that of a trace of a topography.
    fn find(line: usize, content: &str) -> Result<Option<Self>, DataTableError> {
        let Some((_, rest)) = content.split_once("Zahn-Nr.:") else { return Ok(None) };
        let words: Vec<&str> =
            rest.split(|letter: char| letter.is_whitespace() || letter == '/').filter(|w| !w.is_empty()).collect();
        let Some(end) = words.iter().position(|&word| word == "Werte") else { return Ok(None) };
        let refused = |what: &str, found: Option<&&str>, allowed: &str| {
            not_allowed(line, what, found.copied().unwrap_or("nothing"), allowed.to_owned())
        };
        let number_of =
            |word: &&str| word.trim_end_matches(|letter: char| letter.is_ascii_lowercase()).parse::<u32>().ok();
        let tooth = words
            .first()
            .and_then(number_of)
            .ok_or_else(|| refused("Zahn-Nr.", words.first(), "the number of a tooth"))?;
        let side = words[..end].iter().find_map(|&word| match word {
            "links" => Some(FlankSide::Left),
            "rechts" => Some(FlankSide::Right),
            _ => None,
        });
        let side = side.ok_or_else(|| refused("flank", words.get(1), "links or rechts"))?;
        let count = words[..end]
            .last()
            .and_then(|word| word.parse::<usize>().ok())
            .filter(|count| (2..=MOST_VALUES).contains(count));
        let count =
            count.ok_or_else(|| refused("number of values", words[..end].last(), &format!("2 to {MOST_VALUES}")))?;
        let at = rest.split_once('=').and_then(|(_, at)| number(at.trim()));
        Ok(Some(Self { tooth, side, count, at }))
    }
}

/// Places of `count` values: roll lengths of a profile, places over the face width of a lead.
fn places(
    header: &[HeaderLine<'_>],
    kind: TraceKind,
    side: FlankSide,
    count: usize,
) -> Result<Vec<f64>, DataTableError> {
    let [from, to] = match kind {
        TraceKind::Profile => {
            let involute = Involute { base_radius_mm: base_radius_mm(header)? };
            let mut ends = [0.0; 2];
            for (end, code) in ends.iter_mut().zip(PROFILE_ENDS) {
                let diameter = of_side(header, code, side)?;
                *end = involute.curvature_radius_mm(0.5 * diameter);
            }
            ends
        }
        TraceKind::Lead => match LEAD_ENDS.map(|code| of_side(header, code, side)) {
            [Ok(from), Ok(to)] => [from, to],
            _ => [0.0, value(header, FACE_WIDTH, MOST)?],
        },
    };
    if from >= to {
        let line = header.iter().find(|own| own.code == PROFILE_ENDS[1]).map_or(1, |own| own.line);
        return Err(not_allowed(line, "end of the trace", to, format!("more than {from}, its beginning")));
    }
    Ok((0..count).map(|index| from + (to - from) * index as f64 / (count - 1) as f64).collect())
}

/// Value of a header line that has one for left flanks and, where they differ, one for right flanks.
fn of_side(header: &[HeaderLine<'_>], code: u32, side: FlankSide) -> Result<f64, DataTableError> {
    let own = header.iter().find(|own| own.code == code);
    let right = own.filter(|_| side == FlankSide::Right).and_then(|own| own.values.get(1));
    match right {
        Some(&right) if (0.0..=MOST).contains(&right) => Ok(right),
        _ => value(header, code, MOST),
    }
}

/// First number of a header line, more than 0 and at most `most`.
fn value(header: &[HeaderLine<'_>], code: u32, most: f64) -> Result<f64, DataTableError> {
    let allowed = format!("a number above 0 and at most {most}");
    let own = header.iter().find(|own| own.code == code);
    let own = own.ok_or_else(|| missing(&format!("line {code} of the header"), allowed.clone()))?;
    match own.values.first() {
        Some(&value) if value > 0.0 && value <= most => Ok(value),
        Some(&found) => Err(not_allowed(own.line, own.label, found, allowed)),
        None => Err(not_allowed(own.line, own.label, "nothing", allowed)),
    }
}

/// r_b.
fn base_radius_mm(header: &[HeaderLine<'_>]) -> Result<f64, DataTableError> {
    let [module, teeth] = [value(header, MODULE, MOST)?, value(header, TEETH, MOST)?];
    let pressure = value(header, PRESSURE_ANGLE, MOST_ANGLE_DEG)?.to_radians();
    let helix = header.iter().find(|own| own.code == HELIX_ANGLE);
    let helix_deg = helix.and_then(|own| own.values.first().copied()).unwrap_or(0.0);
    if let Some(own) = helix.filter(|_| helix_deg.abs() > MOST_ANGLE_DEG) {
        let allowed = format!("an angle of at most {MOST_ANGLE_DEG}°");
        return Err(not_allowed(own.line, own.label, helix_deg, allowed));
    }
    let cos = helix_deg.to_radians().cos();
    Ok(0.5 * teeth * module / cos * (pressure.tan() / cos).atan().cos())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A gear with two teeth, both flanks, profile and lead, and blocks that are no curves.
    fn export() -> String {
        let head = "HEADER KS.MK.FILE\nVERSION 5.0\nSEPARATOR :\nUNDEFINED -2147483.648 ! undefined point\n  \
                    21 :Normalmodul mn..[mm].: 4.500\n  22 :Zähnezahl z........: 16 Außenverzahnung\n  24 :Eingriffswinkel....: 20.0\n  \
                    26 :Zahnbreite.[mm]..: 14.0\n  41 :Start Messbereich.....da  [mm]..:  68.4      69.0\n  44 :Ende Messbereich......de  [mm]..:  82.0\n\n";
        format!(
            "{head}Flankenlinie:\nZahn-Nr.: 1 links / 3  Werte  x= 8.7\n 1.0 2.0 3.0\nProfil:\nZahn-Nr.: 1 links / 4  Werte  z= 7.000\n\
             -2147483.648 1.0\n 2.0 3.0\nProfil:  Zahn-Nr.: 9 rechts / 4 Werte  / z= 7\n 4 5 6 7\n\
             Verschränkung: Zahn-Nr.: 1k /Flankenlinie:3 links / 2  Werte  x= 10.263\n 1.0 2.0\n\
             Fußkreisdurchmesser / Höhe :     7.500\n   49.5 49.6\n        linke Zahnflanke\n        Zahn-Nr.  fp  Fp  Fr\n\n  1  0.1 0.2 0.3\n"
        )
    }

    #[test]
    fn teeth_flanks_profiles_and_leads() {
        let (file, traces) = read(&export()).unwrap();
        let r_b = 36.0 * 20f64.to_radians().cos();
        let gear = file.machine_gear.unwrap();
        assert!(gear.teeth == 16 && gear.line == 6 && (gear.base_radius_mm - r_b).abs() < 1e-12);
        let heads: Vec<_> = traces.iter().map(|t| (t.kind, t.tooth.unwrap(), t.side.unwrap(), t.width_mm)).collect();
        assert_eq!(
            heads,
            [
                (TraceKind::Lead, 1, FlankSide::Left, None),
                (TraceKind::Profile, 1, FlankSide::Left, Some(7.0)),
                (TraceKind::Profile, 9, FlankSide::Right, Some(7.0)),
            ]
        );
        let points = |index: usize| traces[index].points.iter().map(|p| (p.place, p.height_um)).collect::<Vec<_>>();
        assert_eq!(points(0), [(0.0, 1.0), (7.0, 2.0), (14.0, 3.0)]);
        let rho = |d: f64| (0.25 * d * d - r_b * r_b).sqrt();
        let (from, to) = (rho(68.4), rho(82.0));
        for (own, (part, height)) in points(1).iter().zip([(1.0 / 3.0, 1.0), (2.0 / 3.0, 2.0), (1.0, 3.0)]) {
            assert!((own.0 - from - part * (to - from)).abs() < 1e-9 && own.1 == height, "{own:?}");
        }
        assert!((points(2)[0].0 - rho(69.0)).abs() < 1e-9);
    }

    #[test]
    fn wrong_exports_are_refused_at_their_line() {
        let text = export();
        for (from, to, words) in [
            ("KS.MK.FILE", "KS.XX.FILE", "line 1: format"),
            (" 2.0 3.0\nProfil:  ", " 2.0 x3\nProfil:  ", "line 18: Werte: found x3"),
            (" 2.0 3.0\nProfil:  ", " 2.0\nProfil:  ", "line 16: number of values: found 3"),
            (" 2.0 3.0\nProfil:  ", " 2.0 3.0 4.0\nProfil:  ", "line 16: number of values: found 5"),
            ("9 rechts", "9 oben", "line 19: flank"),
            ("Zähnezahl z........: 16", "Zähnezahl z........: -3", "found -3"),
            ("  24 :", "  25 :", "line 24 of the header is missing"),
            ("68.4      69.0", "84.0      69.0", "end of the trace: found"),
            ("Zahn-Nr.: 1 links / 4", "Zahn-Nr.: 1 links / 99999999999", "number of values: found 99999999999"),
        ] {
            assert!(text.contains(from), "{from}");
            let message = read(&text.replace(from, to)).unwrap_err().to_string();
            assert!(message.contains(words) && message.contains("allowed: "), "{from}: {message}");
        }
    }
}
