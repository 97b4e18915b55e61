//! Author of a report and its date: what pages state below their title.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Author of a report and its date, each as the scene says it.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub struct ReportedBy {
    /// Author of the calculation.
    pub author: Option<String>,
    /// For whom, or where.
    pub company: Option<String>,
    /// The day.
    pub date: Option<String>,
}

impl ReportedBy {
    /// Line on pages: what is given, side by side.
    pub fn line(&self) -> String {
        let Self { author, company, date } = self;
        [author, company, date].into_iter().flatten().map(String::as_str).collect::<Vec<_>>().join(" · ")
    }

    /// Line of the table `[report]` of a scene; empty where it has none.
    pub fn line_of_scene(scene_toml: &str) -> String {
        #[derive(Deserialize)]
        struct Reported {
            report: Option<ReportedBy>,
        }
        let reported: Option<Reported> = toml::from_str(scene_toml).ok();
        reported.and_then(|scene| scene.report).as_ref().map(Self::line).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_says_who_reports() {
        let scene = "title = \"a pair\"\n[report]\nauthor = \"A. Author\"\ndate = \"2026-05-01\"\n";
        assert_eq!(ReportedBy::line_of_scene(scene), "A. Author · 2026-05-01");
        assert_eq!(ReportedBy::line_of_scene("title = \"a pair\""), "");
    }
}
