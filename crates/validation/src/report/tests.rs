//! Contents of every file, on a record with everything in it.

use std::collections::BTreeMap;
use std::fs;

use quick_xml::Reader;
use quick_xml::events::Event;
use tempfile::TempDir;

use super::markup::anchor;
use super::synthetic::{changes, record, repeated};
use super::words::as_written;
use super::{junit, markdown, page, terminal, words, write};
use crate::record::{Criterion, ValidationRecord};

/// Element of the JUnit file.
struct XmlElement {
    name: String,
    attributes: BTreeMap<String, String>,
}

impl XmlElement {
    fn get(&self, key: &str) -> &str {
        self.attributes.get(key).map_or("", String::as_str)
    }
}

fn junit_elements(record: &ValidationRecord) -> Vec<XmlElement> {
    let mut xml = Vec::new();
    junit::write(&mut xml, record).unwrap();
    let mut reader = Reader::from_reader(xml.as_slice());
    let (mut elements, mut buffer) = (Vec::new(), Vec::new());
    loop {
        match reader.read_event_into(&mut buffer).unwrap() {
            Event::Start(start) | Event::Empty(start) => {
                let attributes = start.attributes().map(|attribute| {
                    let attribute = attribute.unwrap();
                    let value = quick_xml::escape::unescape(&attribute.value).unwrap().into_owned();
                    (attribute.key.as_ref().to_owned(), value)
                });
                elements.push(XmlElement { name: start.name().as_ref().to_owned(), attributes: attributes.collect() });
            }
            Event::Eof => return elements,
            _ => {}
        }
        buffer.clear();
    }
}

fn html() -> String {
    let page = page::page(&record(), Some(&changes()));
    // Without the scripts.
    let scripts = page.rfind("</footer>").unwrap();
    page[..scripts].to_owned()
}

#[test]
fn junit_has_a_suite_for_each_case_and_a_test_for_each_quantity() {
    let record = record();
    let elements = junit_elements(&record);
    let suites: Vec<&XmlElement> = elements.iter().filter(|element| element.name == "testsuite").collect();
    assert_eq!(suites.len(), record.cases.len());
    for (suite, case) in suites.iter().zip(&record.cases) {
        assert_eq!(suite.get("name"), case.name);
        let tests = elements.iter().filter(|e| e.name == "testcase" && e.get("classname") == case.name);
        let quantities = case.quantities.iter().map(|quantity| quantity.name.as_str());
        let names: Vec<&str> = case.failure.iter().map(|_| "the case runs to its end").chain(quantities).collect();
        assert_eq!(tests.map(|test| test.get("name")).collect::<Vec<_>>(), names);
    }
}

#[test]
fn junit_counts_what_failed_and_says_why() {
    let elements = junit_elements(&record());
    let root = elements.iter().find(|element| element.name == "testsuites").unwrap();
    // A missed bound and one that holds unexpectedly; a case that could not run; two that cannot be compared.
    assert_eq!((root.get("failures"), root.get("errors")), ("2", "1"));
    assert_eq!(elements.iter().filter(|element| element.name == "skipped").count(), 2);
    let failures: Vec<&str> =
        elements.iter().filter(|e| e.name == "failure").map(|failure| failure.get("message")).collect();
    assert!(failures[0].contains("1400 MPa, compared with 1305 ± 13 MPa"), "{failures:?}");
    let error = elements.iter().find(|element| element.name == "error").unwrap();
    assert!(error.get("message").contains("no preset is called `fzg-d`"));
}

#[test]
fn junit_carries_time_and_work_as_properties() {
    let elements = junit_elements(&record());
    for name in ["wall_s", "work: equilibria"] {
        assert_eq!(elements.iter().filter(|e| e.name == "property" && e.get("name") == name).count(), 8, "{name}");
    }
}

#[test]
fn the_record_is_read_back_as_it_was_but_for_its_plots() {
    let folder = TempDir::new().unwrap();
    let paths = write(&record(), Some(&changes()), folder.path()).unwrap();
    let names: Vec<_> = paths.iter().map(|path| path.file_name().unwrap().to_str().unwrap()).collect();
    assert_eq!(names, ["report.html", "junit.xml", "summary.md", "work_precision.json", "validation.json"]);
    let read: ValidationRecord =
        serde_json::from_str(&fs::read_to_string(folder.path().join("validation.json")).unwrap()).unwrap();
    let mut written = record();
    written.cases.iter_mut().for_each(|case| case.plots.clear());
    assert_eq!(read, written);
}

#[test]
fn work_precision_holds_the_points_of_the_cases_that_have_some() {
    let folder = TempDir::new().unwrap();
    write(&record(), None, folder.path()).unwrap();
    let text = fs::read_to_string(folder.path().join("work_precision.json")).unwrap();
    let file: serde_json::Value = serde_json::from_str(&text).unwrap();
    let cases = file["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 1);
    assert_eq!(cases[0]["case"], "fzg-c-precision");
    assert_eq!(cases[0]["points"].as_array().unwrap().len(), 12);
}

/// GitHub refuses comments above 65 536 characters; a suite of 800 cases, every third of them failing, must stay below.
#[test]
fn markdown_stays_below_the_limit_of_a_comment() {
    let text = markdown::text(&repeated(100), Some(&changes()));
    assert!(text.len() < 65_536, "{} bytes", text.len());
    assert!(text.contains("more in `report.html`"));
}

#[test]
fn markdown_says_what_failed_what_is_known_and_what_changed() {
    let text = markdown::text(&record(), Some(&changes()));
    for wanted in [
        "## ✗ Validation suite",
        "2 missed, 1 could not run.",
        "### Not as expected",
        "| ✗ missed | pitch-point | maximum pressure |",
        "<summary>1 statement is known not to hold</summary>",
        "<summary>2 quantities cannot be compared</summary>",
        "<summary>1 case rests on an estimate</summary>",
        "1 worse, 1 better",
        "### Got worse",
    ] {
        assert!(text.contains(wanted), "{wanted}\n{text}");
    }
}

#[test]
fn markdown_keeps_markup_of_messages_in_its_cell() {
    let mut record = record();
    record.cases[4].failure = Some("a | b\n<img src=x> @everyone `c`".to_owned());
    let text = markdown::text(&record, None);
    assert!(text.contains(r"a \| b &lt;img src=x&gt; &#64;everyone \`c\` |"), "{text}");
}

#[test]
fn the_terminal_shows_a_line_for_each_case_then_what_is_wrong_then_the_totals() {
    let text = terminal(&record(), Some(&changes()), None);
    for case in &record().cases {
        let lines = text.lines().take_while(|line| !line.is_empty());
        assert_eq!(lines.filter(|line| line.contains(&case.name)).count(), 1, "{}\n{text}", case.name);
    }
    assert!(text.contains("✗ pitch-point: What pitch-point must show, in one sentence."), "{text}");
    assert!(text.contains("maximum pressure: missed: 1400 MPa, compared with 1305 ± 13 MPa"), "{text}");
    assert!(text.contains("could not run: validation/calculix/case.toml, line 12"), "{text}");
    assert!(text.contains("worse  hertz-cylinders: equilibria: 1000 → 1200"), "{text}");
    assert!(text.trim_end().ends_with("on 2 threads."), "{text}");
}

#[test]
fn the_terminal_keeps_to_its_width() {
    for width in [60, 80, 120] {
        let text = terminal(&record(), None, Some(width));
        let table = text.lines().take_while(|line| !line.is_empty());
        for line in table {
            assert!(line.chars().count() <= usize::from(width), "{width}: {line}");
        }
    }
}

#[test]
fn the_page_has_each_case_once_and_opens_those_that_failed() {
    let page = html();
    for case in &record().cases {
        let id = format!("id=\"{}\"", anchor(case));
        assert_eq!(page.matches(&id).count(), 1, "{}", case.name);
        let section = &page[page.find(&id).unwrap()..];
        let opening = &section[..section.find('>').unwrap()];
        assert_eq!(opening.ends_with(" open"), !case.passed(), "{}", case.name);
    }
}

#[test]
fn the_page_links_only_to_what_it_has() {
    let page = html();
    for link in page.split("href=\"#").skip(1) {
        let id = link.split('"').next().unwrap();
        assert!(page.contains(&format!("id=\"{id}\"")), "{id}");
    }
}

#[test]
fn the_page_shows_no_number_that_is_none_and_no_raw_markup() {
    let mut record = record();
    // What a computation that went wrong leaves behind.
    record.cases[0].quantities[0].value = Some(f64::NAN);
    record.cases[0].quantities[0].share = Some(f64::INFINITY);
    record.cases[6].work_precision[0].error = f64::NAN;
    record.cases[7].stability[0].value = f64::NAN;
    let page = page::page(&record, None);
    let page = &page[..page.rfind("</footer>").unwrap()];
    assert!(!page.contains("NaN"));
    assert!(!page.contains("<angle>"));
}

/// The statements of the thesis are all named, whether a case speaks to them or not.
#[test]
fn the_page_names_all_targets() {
    let page = html();
    for id in ["S1", "S10", "D1", "D2", "D3", "D4", "K1"] {
        assert!(page.contains(&format!("<b>{id}</b> ")), "{id}");
    }
    assert!(page.contains(
        "No case of this run examines S2, S3, S4, S5, S6, S7, S8, S9, S11, S12, K2, H1, H2, H3, H4, H5, H6."
    ));
}

/// A power of ten and a bound carry no digits that say nothing.
#[test]
fn bounds_read_as_written() {
    for (value, text) in [(1e-6, "10⁻⁶"), (2.5e-17, "2.5 × 10⁻¹⁷"), (-1e7, "−10⁷"), (0.05, "0.05"), (450.0, "450")]
    {
        assert_eq!(as_written(value).replace('\u{2009}', " "), text);
    }
}

/// Value and reference are told apart where the tolerance tells them apart.
#[test]
fn close_numbers_show_the_digits_in_which_they_differ() {
    let mut quantity = record().cases[0].quantities[0].clone();
    quantity.value = Some(1.437_537);
    quantity.criterion = Criterion::Near { reference: 1.4375, tolerance: 5e-5 };
    assert_eq!(words::value(&quantity), "1.43754 MPa");
    assert_eq!(words::criterion(&quantity).replace('\u{2009}', " "), "1.43750 ± 5 × 10⁻⁵ MPa");
}

#[test]
fn an_empty_suite_has_its_files_too() {
    let mut record = record();
    record.cases.clear();
    let folder = TempDir::new().unwrap();
    assert_eq!(write(&record, None, folder.path()).unwrap().len(), 5);
    assert!(terminal(&record, None, Some(80)).contains("No case was run."));
}
