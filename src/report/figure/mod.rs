//! Charts as drawings: one way to draw a [`Chart`], for the page, for SVG and for PNG.
//!
//! A [`drawing`] is data, a [`picture`] of paths, words and fields of colour. It is written as SVG, in the colours of the page or in those that
//! pages have in the light, or drawn as pixels by [`raster`], with a font of its own, so that it looks the same on every machine. Surfaces in
//! space are left out: the maps of the same page show their values.

mod axis;
mod contours;
mod drawing;
pub mod in_page;
mod palette;
mod picture;
mod png;
mod raster;
mod sign;
mod traces;
use std::path::{Path, PathBuf};

use self::drawing::Drawing;
use self::picture::{Medium, Picture};
use super::chart::{Chart, Trace};
use super::files::{ReportError, create_folder, place};

/// A plot of a page as a drawing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Its name, which is that of its files.
    pub name: String,
    /// SVG.
    pub svg: String,
}

/// Each of `charts` that is no surface in space, drawn.
fn pictures(charts: &[Chart]) -> impl Iterator<Item = Picture> {
    let flat = charts.iter().filter(|chart| !chart.traces.iter().any(Trace::is_surface));
    flat.map(|chart| Drawing::new(chart, Medium::File).finished().picture)
}

/// Each of `charts` that is no surface in space, as SVG.
pub fn drawn(charts: &[Chart]) -> impl Iterator<Item = Figure> {
    pictures(charts).map(|picture| Figure { svg: picture.svg(), name: picture.id })
}

/// Writes each of `charts` as `ID.svg` and `ID.png` into `dir`, which is made if need be; returns their paths.
pub fn write_all(charts: &[Chart], dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    create_folder(dir)?;
    let mut paths = Vec::new();
    for picture in pictures(charts) {
        let name = &picture.id;
        paths.push(place(dir, &format!("{name}.svg"), |out| out.write_all(picture.svg().as_bytes()))?);
        paths.push(place(dir, &format!("{name}.png"), |out| out.write_all(&raster::png(&picture)?))?);
    }
    Ok(paths)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::chart::{BarPlaces, ColourScale, Dash, Drawn, Field, INK, Surface, View};

    #[test]
    fn every_plot_is_a_drawing_and_a_picture() {
        let dir = tempfile::tempdir().unwrap();
        let line = Trace::line("a & b", [1.0, 10.0, f64::NAN, 100.0], [0.0, 2.0, 3.0, 1.0], (INK, 2.0, Dash::Mixed));
        let lines =
            Chart::new("lines", "Lines <1>").x("x, mm").y("y, µm").x_logarithmic().add(line).mark([("C", 10.0)], "C");
        let cells = Trace::heat_map("MPa", &[0.0, 1.0, 3.0], &[0.0, 1.0], vec![vec![1.0, 2.0]]);
        let map = Chart::new("map", "Map").x("x, mm").y("y, mm").add(cells);
        let names = BarPlaces::Named(vec!["1×".to_owned(), "2×".to_owned()]);
        let bars = Chart::new("bars", "Bars").x("order").y("µm").add(Trace::bars("new", names, vec![1.0, 2.0], INK));
        let empty_field = || Field { x: vec![], y: vec![], values: vec![], scale: ColourScale::of("µm") };
        let view = View { label: "wear", height_title: "wear, µm", height_range: [0.0, 1.0], drawn: [1.0; 3] };
        let wear = Drawn::Surface(Surface { field: empty_field(), rise: 1.0, view });
        let surface = Chart::new("surface", "Surface").add(Trace::new(wear, "wear"));
        let empty = Chart::new("empty", "Empty").x("x").y("y").add(Trace::new(Drawn::Contours(empty_field()), ""));
        let paths = write_all(&[lines, map, bars, surface, empty], dir.path()).unwrap();
        let names: Vec<_> = paths.iter().map(|path| path.file_name().unwrap().to_str().unwrap()).collect();
        assert_eq!(
            names,
            ["lines.svg", "lines.png", "map.svg", "map.png", "bars.svg", "bars.png", "empty.svg", "empty.png"]
        );
        for pair in paths.chunks(2) {
            let svg = std::fs::read_to_string(&pair[0]).unwrap();
            assert!(roxmltree::Document::parse(&svg).is_ok() && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            assert!(std::fs::read(&pair[1]).unwrap().starts_with(b"\x89PNG"));
        }
        let svg = std::fs::read_to_string(&paths[0]).unwrap();
        for text in ["Lines &lt;1&gt;", "x, mm", "y, µm", "a &amp; b", ">C<", ">50<"] {
            assert!(svg.contains(text), "{text} is not in {svg}");
        }
        // The curve has a gap: two pieces.
        assert_eq!(svg.matches("stroke-dasharray=\"9 4 2 4\"").count(), 3, "curve, mark and legend");
    }
}
