//! The script that draws the plots of a page: the smallest bundle of plotly.js that knows all their traces.
//!
//! The bundles are those that plotly publishes, in `assets` with their licence. In a page they stay compressed, as base64, and the page
//! unpacks them itself (`html/page.js`): a third of their size as text.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

use super::chart::{Chart, Drawn};

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
        let drawn = |chart: &Chart| {
            chart.traces.iter().map(|trace| Self::that_draws(&trace.drawn)).max().unwrap_or(Self::Basic)
        };
        charts.iter().map(drawn).max()
    }

    fn that_draws(drawn: &Drawn) -> Self {
        match drawn {
            Drawn::Curve(_) | Drawn::Bars(_) => Self::Basic,
            Drawn::Cells(_) | Drawn::Contours(_) => Self::Cartesian,
            Drawn::Surface(_) => Self::Whole,
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
