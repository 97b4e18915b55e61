//! Tables of a measured flank, as measuring programs and spreadsheets write them.
//!
//! ```text
//! # gear = pinion
//! # hours = 31.75
//! Wälzlänge [mm];Höhe [µm]
//! 5,1420;-15,797
//! 5,2637;-16,160
//! ```
//!
//! One column is the place on the flank: the radius, the diameter, the roll length, the roll angle or the length along the flank; or the place
//! over the face width, of a lead. Another one is the height, which falls where material is gone, or the wear, which rises there (a difference of
//! profiles before and after). Columns stand in any order, places increase from row to row, and a column each may say the tooth and the
//! flank. Names are English or German; units stand in the name (`height_um`, `Höhe [µm]`, `Höhe in µm`), in a row of units below the names,
//! or in a line `# units = mm; µm`.

use gearwear_files::data_table::{DataTable, DataTableError, finite, missing, not_allowed};

use super::file::{FlankSide, MeasuredFile, MeasuredRow, PlaceColumn, Trace, TraceKind, ValueKind};
use super::undefined::undefined;

/// What a column is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Meaning {
    Place(PlaceColumn),
    Width,
    Value(ValueKind),
    Tooth,
    Side,
}

/// Names of columns in lower case, without umlauts, and what they mean.
const NAMES: [(&str, Meaning); 36] = [
    ("radius", Meaning::Place(PlaceColumn::RadiusMm)),
    ("r", Meaning::Place(PlaceColumn::RadiusMm)),
    ("diameter", Meaning::Place(PlaceColumn::DiameterMm)),
    ("durchmesser", Meaning::Place(PlaceColumn::DiameterMm)),
    ("d", Meaning::Place(PlaceColumn::DiameterMm)),
    ("roll length", Meaning::Place(PlaceColumn::RollLengthMm)),
    ("length of roll", Meaning::Place(PlaceColumn::RollLengthMm)),
    ("roll path", Meaning::Place(PlaceColumn::RollLengthMm)),
    ("waelzlaenge", Meaning::Place(PlaceColumn::RollLengthMm)),
    ("waelzweg", Meaning::Place(PlaceColumn::RollLengthMm)),
    ("roll angle", Meaning::Place(PlaceColumn::RollAngleDeg)),
    ("waelzwinkel", Meaning::Place(PlaceColumn::RollAngleDeg)),
    ("arc", Meaning::Place(PlaceColumn::ArcMm)),
    ("arc length", Meaning::Place(PlaceColumn::ArcMm)),
    ("bogenlaenge", Meaning::Place(PlaceColumn::ArcMm)),
    ("width", Meaning::Width),
    ("face width", Meaning::Width),
    ("breite", Meaning::Width),
    ("zahnbreite", Meaning::Width),
    ("height", Meaning::Value(ValueKind::Height)),
    ("deviation", Meaning::Value(ValueKind::Height)),
    ("profile deviation", Meaning::Value(ValueKind::Height)),
    ("hoehe", Meaning::Value(ValueKind::Height)),
    ("abweichung", Meaning::Value(ValueKind::Height)),
    ("profilabweichung", Meaning::Value(ValueKind::Height)),
    ("wear", Meaning::Value(ValueKind::Wear)),
    ("wear depth", Meaning::Value(ValueKind::Wear)),
    ("verschleiss", Meaning::Value(ValueKind::Wear)),
    ("verschleisstiefe", Meaning::Value(ValueKind::Wear)),
    ("tooth", Meaning::Tooth),
    ("zahn", Meaning::Tooth),
    ("zahn nr", Meaning::Tooth),
    ("flank", Meaning::Side),
    ("flanke", Meaning::Side),
    ("side", Meaning::Side),
    ("seite", Meaning::Side),
];

/// Unit of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Unit {
    Millimetre,
    Micrometre,
    Degree,
    Radian,
}

const UNITS: [(&str, Unit); 12] = [
    ("mm", Unit::Millimetre),
    ("um", Unit::Micrometre),
    ("µm", Unit::Micrometre),
    ("\u{3bc}m", Unit::Micrometre),
    ("mikrometer", Unit::Micrometre),
    ("micrometre", Unit::Micrometre),
    ("deg", Unit::Degree),
    ("degree", Unit::Degree),
    ("°", Unit::Degree),
    ("grad", Unit::Degree),
    ("rad", Unit::Radian),
    ("millimeter", Unit::Millimetre),
];

impl Unit {
    fn find(text: &str) -> Option<Self> {
        let text = text.trim().trim_start_matches(['[', '(']).trim_end_matches([']', ')']).trim().to_lowercase();
        UNITS.iter().find(|(name, _)| *name == text).map(|&(_, unit)| unit)
    }
}

impl Meaning {
    /// What a number in `unit` is multiplied by; `None` for a unit of something else.
    fn factor(self, unit: Option<Unit>) -> Option<f64> {
        match (self, unit?) {
            (Meaning::Place(PlaceColumn::RollAngleDeg), Unit::Degree) => Some(1.0),
            (Meaning::Place(PlaceColumn::RollAngleDeg), Unit::Radian) => Some(1f64.to_degrees()),
            (Meaning::Place(PlaceColumn::RollAngleDeg), _) => None,
            (Meaning::Place(_) | Meaning::Width, Unit::Millimetre) => Some(1.0),
            (Meaning::Place(_) | Meaning::Width, Unit::Micrometre) => Some(1e-3),
            (Meaning::Value(ValueKind::Height), Unit::Micrometre) => Some(1.0),
            (Meaning::Value(ValueKind::Height), Unit::Millimetre) => Some(1e3),
            (Meaning::Value(ValueKind::Wear), Unit::Micrometre) => Some(-1.0),
            (Meaning::Value(ValueKind::Wear), Unit::Millimetre) => Some(-1e3),
            _ => None,
        }
    }
}

/// Reads the header and the traces of a table.
pub(super) fn read(text: &str) -> Result<(MeasuredFile, Vec<Trace>), DataTableError> {
    let table = DataTable::read(text, columns_allowed)?;
    let mut file = MeasuredFile::default();
    for &(line, key, value) in &table.keys {
        file.take(line, key, value)?;
    }
    let (columns, rows) = ProfileColumns::find(&table)?;
    let kind = match columns.place {
        Some(place) => {
            file.place = place;
            TraceKind::Profile
        }
        None => TraceKind::Lead,
    };
    if columns.place == Some(PlaceColumn::ArcMm) && file.arc_from.is_none() {
        return Err(missing(
            &format!("where {} begins", columns.place_cell.name),
            "a line \"# arc_from = base-circle\", \"start-of-active-profile\" or \"tip\"".to_owned(),
        ));
    }
    file.kind = columns.kind;
    file.place_name = columns.place_cell.name.to_owned();
    let mut traces: Vec<Trace> = Vec::new();
    for (line, fields) in rows {
        let (tooth, side, point) = columns.point(*line, fields)?;
        let known = traces.iter().position(|trace| (trace.tooth, trace.side) == (tooth, side));
        let index = known.unwrap_or_else(|| {
            traces.push(Trace { kind, tooth, side, width_mm: file.width_mm, points: Vec::new() });
            traces.len() - 1
        });
        let points = &mut traces[index].points;
        if let Some(before) = points.last().filter(|before| before.place >= point.place) {
            let allowed =
                format!("more than {} of line {}: places increase from row to row", before.place, before.line);
            return Err(not_allowed(*line, columns.place_cell.name, point.place, allowed));
        }
        points.push(point);
    }
    for trace in &traces {
        let heights: Vec<f64> = trace.points.iter().map(|point| point.height_um).collect();
        if let Some(first) = undefined(&heights, None).into_iter().position(|is_undefined| is_undefined) {
            let point = trace.points[first];
            let allowed = "a height of the flank; points without one are left out".to_owned();
            return Err(not_allowed(
                point.line,
                columns.value_cell.name,
                point.height_um / columns.value_cell.factor,
                allowed,
            ));
        }
    }
    Ok((file, traces))
}

/// A column of numbers.
#[derive(Debug, Clone, Copy)]
struct Cell<'a> {
    index: usize,
    name: &'a str,
    factor: f64,
}

/// Columns of the place and the height.
struct ProfileColumns<'a> {
    count: usize,
    /// `None` of a lead.
    place: Option<PlaceColumn>,
    place_cell: Cell<'a>,
    kind: ValueKind,
    value_cell: Cell<'a>,
    tooth: Option<usize>,
    side: Option<usize>,
}

/// Rows of a table, each with its line.
type Rows<'t, 'a> = &'t [(usize, Vec<&'a str>)];

impl<'a> ProfileColumns<'a> {
    /// Columns of a table, and the rows with points below them.
    fn find<'t>(table: &'t DataTable<'a>) -> Result<(Self, Rows<'t, 'a>), DataTableError> {
        let (line, names) = &table.names;
        let refused = || not_allowed(*line, "column names", names.join(","), columns_allowed());
        let columns: Vec<(Option<Meaning>, Option<Unit>)> = names.iter().map(|name| meaning(name)).collect();
        let of_key = table.keys.iter().find(|(_, key, _)| *key == "units");
        let given: Option<Vec<Option<Unit>>> =
            of_key.map(|(_, _, value)| value.split([';', ',']).map(Unit::find).collect());
        let below =
            table.rows.first().map(|(_, fields)| fields.iter().map(|field| Unit::find(field)).collect::<Vec<_>>());
        let below = below.filter(|units| units.iter().any(Option::is_some));
        let rows = &table.rows[usize::from(below.is_some())..];

        let (mut places, mut values, mut tooth, mut side) = (Vec::new(), Vec::new(), None, None);
        for (index, &(meaning, own)) in columns.iter().enumerate() {
            let Some(meaning) = meaning else { continue };
            let other = |units: &Option<Vec<Option<Unit>>>| {
                units.as_ref().and_then(|units| units.get(index).copied().flatten())
            };
            let unit = own.or_else(|| other(&below)).or_else(|| other(&given));
            let cell = meaning.factor(unit).map(|factor| Cell { index, name: names[index], factor });
            match meaning {
                Meaning::Tooth => tooth = Some(index),
                Meaning::Side => side = Some(index),
                Meaning::Place(place) => places.push((Some(place), cell.ok_or_else(refused)?)),
                Meaning::Width => places.push((None, cell.ok_or_else(refused)?)),
                Meaning::Value(kind) => values.push((kind, cell.ok_or_else(refused)?)),
            }
        }
        // The place over the face width is that of a lead where there is no other, and a remark beside one.
        if places.iter().any(|(place, _)| place.is_some()) {
            places.retain(|(place, _)| place.is_some());
        }
        let (&[(place, place_cell)], &[(kind, value_cell)]) = (&places[..], &values[..]) else { return Err(refused()) };
        Ok((Self { count: names.len(), place, place_cell, kind, value_cell, tooth, side }, rows))
    }

    /// Tooth, flank and point of a row.
    fn point(
        &self,
        line: usize,
        fields: &[&str],
    ) -> Result<(Option<u32>, Option<FlankSide>, MeasuredRow), DataTableError> {
        if fields.len() != self.count {
            let allowed = format!(
                "{}, as there are columns; decimals are written with a point, or with a comma where columns are apart by ; or tabs",
                self.count
            );
            return Err(not_allowed(line, "number of fields", fields.len(), allowed));
        }
        let number = |cell: Cell<'_>| Ok(cell.factor * finite(line, cell.name, fields[cell.index])?);
        let tooth = self.tooth.map(|index| {
            let number = fields[index].parse::<u32>();
            number.map_err(|_| not_allowed(line, "tooth", fields[index], "the number of a tooth".to_owned()))
        });
        let side = self.side.map(|index| match fields[index].to_lowercase().as_str() {
            "left" | "links" | "l" => Ok(FlankSide::Left),
            "right" | "rechts" | "r" => Ok(FlankSide::Right),
            _ => Err(not_allowed(line, "flank", fields[index], "left, right, links or rechts".to_owned())),
        });
        let point = MeasuredRow { line, place: number(self.place_cell)?, height_um: number(self.value_cell)? };
        Ok((tooth.transpose()?, side.transpose()?, point))
    }
}

/// Meaning and unit of a column by its name.
fn meaning(cell: &str) -> (Option<Meaning>, Option<Unit>) {
    let known = |name: &str| {
        let plain = plain(name);
        NAMES.iter().find(|(known, _)| *known == plain).map(|&(_, meaning)| meaning)
    };
    if let Some(meaning) = known(cell) {
        return (Some(meaning), None);
    }
    let apart = [" in ", "[", "(", "/", "_", " "].into_iter().filter_map(|between| cell.rsplit_once(between));
    let found = apart.filter_map(|(name, unit)| Some((known(name)?, Unit::find(unit)?))).next();
    found.map_or((None, None), |(meaning, unit)| (Some(meaning), Some(unit)))
}

/// A name in lower case, without umlauts, its words apart by single spaces.
fn plain(name: &str) -> String {
    let mut plain = String::with_capacity(name.len());
    for letter in name.to_lowercase().chars() {
        match letter {
            'ä' => plain.push_str("ae"),
            'ö' => plain.push_str("oe"),
            'ü' => plain.push_str("ue"),
            'ß' => plain.push_str("ss"),
            '_' | '-' | '.' | ',' => plain.push(' '),
            letter => plain.push(letter),
        }
    }
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn columns_allowed() -> String {
    "names with units: one of radius_mm, diameter_mm, roll_length_mm, roll_angle_deg, arc_mm, and one of height_um, height_mm, wear_um, \
     wear_mm; or in German, as Durchmesser [mm], Wälzlänge [mm], Wälzwinkel [°], Höhe [µm]"
        .to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One profile in the notations of programs: the same points.
    #[test]
    fn one_profile_in_many_notations() {
        let texts = [
            "roll_length_mm,height_um\n5.5,-1.25\n6,-2\n",
            "Wälzlänge [mm];Höhe [µm]\r\n5,5;-1,25\r\n6;-2\r\n",
            "\"Waelzlaenge / mm\"\t\"Abweichung (µm)\"\n5.5\t-1.25\n6\t-2\n",
            "Wälzlänge;Höhe\n[mm];[mm]\n5,5;-0,00125\n6;-0,002\n",
            "# units = mm; µm\nroll length;deviation\n5.5;-1.25\n6;-2\n",
            "Wälzlänge in mm;Bemerkung;Verschleiß in \u{3bc}m\n5,5;a;1,25\n6;b;2\n",
            "\"roll_length_mm\",\"height_um\"\n\"5,5\",\"-1,25\"\n\"6\",\"-2\"\n",
        ];
        for text in texts {
            let (file, traces) = read(text).unwrap_or_else(|error| panic!("{text}: {error}"));
            let points: Vec<_> = traces[0].points.iter().map(|point| (point.place, point.height_um)).collect();
            assert_eq!((file.place, traces.len()), (PlaceColumn::RollLengthMm, 1), "{text}");
            assert_eq!(points, [(5.5, -1.25), (6.0, -2.0)], "{text}");
        }
        let (file, _) = read("Durchmesser [mm];Höhe [µm]\n70;1\n").unwrap();
        assert_eq!((file.place, file.place_name.as_str()), (PlaceColumn::DiameterMm, "Durchmesser [mm]"));
        let (_, lead) = read("Zahn-Nr.;Flanke;Zahnbreite [mm];Höhe [µm]\n3;links;1;0\n3;rechts;1;2\n").unwrap();
        assert_eq!(
            lead.iter().map(|trace| (trace.kind, trace.tooth, trace.side)).collect::<Vec<_>>(),
            [FlankSide::Left, FlankSide::Right].map(|side| (TraceKind::Lead, Some(3), Some(side)))
        );
    }

    /// A sentinel is refused at its first line, and units of something else with the names of columns.
    #[test]
    fn sentinels_and_wrong_units_are_refused() {
        let rows: String =
            (0..20).map(|i| format!("{},{}\n", 34.5 + 0.1 * f64::from(i), -0.1 * f64::from(i))).collect();
        for (sentinel, count) in [("-2147483.648", 1), ("-9999.0", 2), ("999.9", 2), ("99999999", 1)] {
            let bad: String = (0..count).map(|i| format!("{},{sentinel}\n", 34.0 + 0.1 * f64::from(i))).collect();
            let message = read(&format!("radius_mm,height_um\n{bad}{rows}")).unwrap_err().to_string();
            assert!(message.starts_with("line 2: height_um: found"), "{message}");
        }
        for names in ["radius [deg],height_um", "roll_angle_mm,height_um", "radius_mm,height [°]", "radius,height_um"]
        {
            let message = read(&format!("{names}\n34,1\n")).unwrap_err().to_string();
            assert!(message.starts_with("line 1: column names") && message.contains("units"), "{message}");
        }
    }
}
