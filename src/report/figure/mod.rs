//! The plots of a page as files, SVG and PNG, drawn without a browser.
//!
//! Both are drawn from the [`Chart`] that the page shows: SVG by [`drawing`], PNG from that by resvg, with a font of its own, so that it
//! looks the same on every machine. Surfaces in space are left out: the maps of the same page show their values.

mod axis;
mod drawing;
mod palette;

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use super::chart::{Chart, TraceKind};
use super::files::{ReportError, create_folder, place};

/// DejaVu Sans, the characters that figures use.
const FONT: &[u8] = include_bytes!("../assets/DejaVuSans-subset.ttf");
/// Pixels of a PNG for one of the SVG.
const PIXELS: f32 = 2.0;

/// A plot of a page as a drawing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Its name, which is that of its files.
    pub name: String,
    /// SVG.
    pub svg: String,
}

/// Each of `charts` that is no surface in space, drawn.
pub(crate) fn drawn(charts: &[Chart]) -> impl Iterator<Item = Figure> {
    let flat = charts.iter().filter(|chart| chart.traces().all(|trace| trace.kind != TraceKind::Surface));
    flat.map(|chart| Figure { name: chart.id.to_string(), svg: drawing::svg(chart) })
}

/// Writes each of `charts` as `ID.svg` and `ID.png` into `dir`, which is made if need be; returns their paths.
pub(crate) fn write_all(charts: &[Chart], dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    create_folder(dir)?;
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(FONT.to_vec());
    let options = Options { fontdb: Arc::new(fonts), ..Options::default() };
    let mut paths = Vec::new();
    for Figure { name, svg } in drawn(charts) {
        paths.push(place(dir, &format!("{name}.svg"), |out| out.write_all(svg.as_bytes()))?);
        paths.push(place(dir, &format!("{name}.png"), |out| out.write_all(&png(&svg, &options)?))?);
    }
    Ok(paths)
}

fn png(svg: &str, options: &Options<'_>) -> io::Result<Vec<u8>> {
    let tree = Tree::from_str(svg, options).map_err(io::Error::other)?;
    let size = tree.size().to_int_size().scale_by(PIXELS).ok_or_else(|| io::Error::other("a figure without size"))?;
    let mut pixels =
        Pixmap::new(size.width(), size.height()).ok_or_else(|| io::Error::other("a figure without size"))?;
    resvg::render(&tree, Transform::from_scale(PIXELS, PIXELS), &mut pixels.as_mut());
    pixels.encode_png().map_err(io::Error::other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::chart::{Dash, INK, Trace};

    #[test]
    fn every_plot_is_a_drawing_and_a_picture() {
        let dir = tempfile::tempdir().unwrap();
        let line = Trace::line("a & b", [1.0, 10.0, f64::NAN, 100.0], [0.0, 2.0, 3.0, 1.0], (INK, 2.0, Dash::Mixed));
        let lines =
            Chart::new("lines", "Lines <1>").x("x, mm").y("y, µm").x_logarithmic().add(line).mark([("C", 10.0)], "C");
        let cells = Trace::heat_map("MPa", &[0.0, 1.0, 3.0], &[0.0, 1.0], vec![vec![1.0, 2.0]]);
        let map = Chart::new("map", "Map").x("x, mm").y("y, mm").add(cells);
        let bars = Trace::new(TraceKind::Bar, "new").set("x", vec!["1×", "2×"]).set("y", vec![1.0, 2.0]);
        let bars = Chart::new("bars", "Bars").x("order").y("µm").add(bars);
        let surface = Chart::new("surface", "Surface").add(Trace::new(TraceKind::Surface, "wear"));
        let empty = Chart::new("empty", "Empty").x("x").y("y");
        let paths = write_all(&[lines, map, bars, surface, empty], dir.path()).unwrap();
        let names: Vec<_> = paths.iter().map(|path| path.file_name().unwrap().to_str().unwrap()).collect();
        assert_eq!(
            names,
            ["lines.svg", "lines.png", "map.svg", "map.png", "bars.svg", "bars.png", "empty.svg", "empty.png"]
        );
        for pair in paths.chunks(2) {
            let svg = std::fs::read_to_string(&pair[0]).unwrap();
            assert!(roxml(&svg) && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            assert!(std::fs::read(&pair[1]).unwrap().starts_with(b"\x89PNG"));
        }
        let svg = std::fs::read_to_string(&paths[0]).unwrap();
        for text in ["Lines &lt;1&gt;", "x, mm", "y, µm", "a &amp; b", ">C<", "10²"] {
            assert!(svg.contains(text), "{text} is not in {svg}");
        }
        // The curve has a gap: two pieces.
        assert_eq!(svg.matches("stroke-dasharray=\"9 4 2 4\"").count(), 3, "curve, mark and legend");
    }

    fn roxml(svg: &str) -> bool {
        Tree::from_str(svg, &Options::default()).is_ok()
    }
}
