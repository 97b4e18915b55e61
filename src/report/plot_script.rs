//! The script that draws the plots of a page: the smallest bundle of plotly.js that knows all their traces.
//!
//! The bundles are those that plotly publishes, in `assets` with their licence. In a page they stay compressed, as base64, and the page
//! unpacks them itself (`html/page.js`): a third of their size as text.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

use super::chart::{Chart, TraceKind};

/// The bundles of plotly.js 3.0.1, each with all that the one before it has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum PlotScript {
    /// Lines, points, bars.
    Basic,
    /// Maps and contours too.
    Cartesian,
    /// Everything, with surfaces in space.
    Whole,
}

impl PlotScript {
    /// The smallest bundle that draws all of `charts`; none where there are none.
    pub(crate) fn of(charts: &[Chart]) -> Option<Self> {
        // Axes alone are drawn too.
        let drawn =
            |chart: &Chart| chart.traces().map(|trace| Self::that_draws(trace.kind)).max().unwrap_or(Self::Basic);
        charts.iter().map(drawn).max()
    }

    fn that_draws(kind: TraceKind) -> Self {
        match kind {
            TraceKind::Scatter | TraceKind::Bar => Self::Basic,
            TraceKind::HeatMap | TraceKind::Contour => Self::Cartesian,
            TraceKind::Surface => Self::Whole,
        }
    }

    fn compressed(self) -> &'static [u8] {
        match self {
            Self::Basic => include_bytes!("assets/plotly-basic.min.js.gz"),
            Self::Cartesian => include_bytes!("assets/plotly-cartesian.min.js.gz"),
            Self::Whole => include_bytes!("assets/plotly.min.js.gz"),
        }
    }

    /// As text for the page: compressed by gzip, in base64.
    pub(crate) fn in_base64(self) -> String {
        BASE64_STANDARD.encode(self.compressed())
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::GzDecoder;

    use super::*;
    use crate::report::chart::Trace;

    const KINDS: [TraceKind; 5] =
        [TraceKind::Scatter, TraceKind::Bar, TraceKind::HeatMap, TraceKind::Contour, TraceKind::Surface];

    #[test]
    fn every_bundle_is_whole_and_draws_what_it_is_taken_for() {
        for bundle in [PlotScript::Basic, PlotScript::Cartesian, PlotScript::Whole] {
            let mut script = String::new();
            GzDecoder::new(bundle.compressed()).read_to_string(&mut script).unwrap();
            assert!(script.contains("v3.0.1") && script.trim_end().ends_with([';', '}']), "{bundle:?} is cut short");
            assert!(!script.contains("</script"), "{bundle:?} would end the element in which it stands");
            for kind in KINDS.into_iter().filter(|&kind| PlotScript::that_draws(kind) <= bundle) {
                let module = format!("moduleType:\"trace\",name:\"{}\"", kind.name());
                assert!(script.contains(&module), "{bundle:?} lacks {}", kind.name());
            }
        }
    }

    #[test]
    fn a_page_has_the_smallest_bundle_that_draws_all_of_it() {
        let chart =
            |kinds: &[TraceKind]| Chart::new("id", "title").add_all(kinds.iter().map(|&kind| Trace::new(kind, "name")));
        let bundle =
            |charts: &[&[TraceKind]]| PlotScript::of(&charts.iter().map(|kinds| chart(kinds)).collect::<Vec<_>>());
        assert_eq!(bundle(&[]), None);
        assert_eq!(bundle(&[&[]]), Some(PlotScript::Basic));
        assert_eq!(bundle(&[&[TraceKind::Bar, TraceKind::Scatter]]), Some(PlotScript::Basic));
        assert_eq!(bundle(&[&[TraceKind::Contour, TraceKind::Scatter], &[]]), Some(PlotScript::Cartesian));
        assert_eq!(
            bundle(&[&[TraceKind::Scatter], &[TraceKind::Surface], &[TraceKind::HeatMap]]),
            Some(PlotScript::Whole)
        );
    }
}
