//! The XML form. It is read by a parser that refuses what is not XML, so that nothing is taken from a file that no other program opens.

use roxmltree::{Document, Node, ParsingOptions};

use super::RexsError;
use super::document::{Attribute, Lines, RexsComponent, RexsDocument, RexsRelation, kind_of_today, on_one_line};

/// Elements and texts of a file, at most.
const MOST_NODES: u32 = 8_000_000;
/// Elements within one another, at most.
const DEEPEST: usize = 64;
/// Bytes of a tag, at most: its attributes are compared with one another, so that a longer one takes long.
const LONGEST_TAG: usize = 8_192;

/// The model of a file in XML.
pub(super) fn parse(text: &str) -> Result<RexsDocument, RexsError> {
    if let Some(found) = other_form(text) {
        return Err(RexsError::NoModel { line: 1, found: found.to_owned() });
    }
    check_tags(text)?;
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| RexsError::NoModel {
        line: error.pos().row as usize,
        found: format!("XML that cannot be read ({error})"),
    })?;
    let mut lines = Lines::of(text);
    // A declaration that is none is read as an instruction of its name.
    let mut instructions = document.root().descendants().filter_map(|node| Some((node, node.pi()?)));
    if let Some((node, _)) = instructions.find(|(_, said)| said.target.eq_ignore_ascii_case("xml")) {
        let found = "an XML declaration that cannot be read".to_owned();
        return Err(RexsError::NoModel { line: lines.of_node(node), found });
    }
    let mut found = RexsDocument::default();
    let root = document.root_element();
    if root.tag_name().name() != "model" {
        return Err(RexsError::NoModel { line: lines.of_node(root), found: "no element <model>".to_owned() });
    }
    found.version = said(root, "version");
    found.version_line = lines.of_node(root);
    found.application =
        format!("{} {}", said(root, "applicationId"), said(root, "applicationVersion")).trim().to_owned();
    // Names of the elements around, from the root on.
    let mut path: Vec<Node> = Vec::new();
    for node in root.descendants().filter(Node::is_element) {
        while path.last().is_some_and(|last| Some(*last) != node.parent()) {
            path.pop();
        }
        path.push(node);
        if path.len() > DEEPEST {
            let line = lines.of_node(node);
            return Err(RexsError::NoModel { line, found: format!("elements more than {DEEPEST} deep") });
        }
        match node.tag_name().name() {
            "relation" => found.relations.push(RexsRelation { kind: said(node, "type"), members: members(node) }),
            "load_case" => found.load_cases.push(Vec::new()),
            "component" => {
                let is_within = |name: &str| path.iter().any(|above| above.tag_name().name() == name);
                if is_within("accumulation") {
                    // Sums over the load spectrum, which nothing reads.
                    continue;
                }
                let case = found.load_cases.len().checked_sub(1).filter(|_| is_within("load_case"));
                let line = lines.of_node(node);
                found.add(component(node, line, &mut lines), case);
            }
            _ => {}
        }
    }
    Ok(found)
}

fn component(node: Node, line: usize, lines: &mut Lines) -> RexsComponent {
    let children = node.children().filter(|child| child.tag_name().name() == "attribute");
    let attributes = children.map(|child| attribute(child, lines.of_node(child))).collect();
    RexsComponent {
        id: said(node, "id"),
        kind: kind_of_today(&said(node, "type")),
        name: said(node, "name"),
        line,
        attributes,
    }
}

fn attribute(node: Node, line: usize) -> Attribute {
    let texts: String = node.children().filter(Node::is_text).filter_map(|text| text.text()).collect();
    let cells = node.descendants().filter(|below| below.tag_name().name() == "c");
    let numbers: Option<Vec<f64>> = cells.map(|cell| cell.text()?.trim().parse().ok()).collect();
    Attribute {
        id: said(node, "id"),
        unit: said(node, "unit"),
        text: texts.trim().to_owned(),
        numbers: numbers.unwrap_or_default(),
        line,
    }
}

/// Roles and ids of a relation.
fn members(relation: Node) -> Vec<(String, String)> {
    let members = relation.children().filter(|child| child.tag_name().name() == "ref");
    members.map(|member| (said(member, "role"), said(member, "id"))).collect()
}

/// An attribute of an element; empty where it is not there.
fn said(node: Node, name: &str) -> String {
    on_one_line(node.attribute(name).unwrap_or_default())
}

/// Kind of a file that is no XML, by how it begins.
fn other_form(text: &str) -> Option<&'static str> {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    if text.is_empty() {
        Some("an empty file")
    } else if !text.starts_with('<') {
        Some("text that is neither XML nor JSON")
    } else {
        None
    }
}

/// Refuses tags that are too long.
fn check_tags(text: &str) -> Result<(), RexsError> {
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        let tag = &rest[start + 1..];
        let length = tag.find('>').unwrap_or(tag.len());
        if length > LONGEST_TAG && !tag.starts_with(['!', '?']) {
            let byte = text.len() - rest.len() + start;
            let line = Lines::of(text).at(byte as u64);
            return Err(RexsError::NoModel { line, found: format!("a tag of more than {LONGEST_TAG} bytes") });
        }
        rest = &tag[length..];
    }
    Ok(())
}

impl Lines<'_> {
    fn of_node(&mut self, node: Node) -> usize {
        self.at(node.range().start as u64)
    }
}
