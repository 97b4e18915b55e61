//! Where the elements of a REXS file stand in its text, and the text with attributes put in, in place of others, or taken out. All that is
//! not named stays byte for byte.

use std::collections::BTreeSet;
use std::ops::Range;

use quick_xml::escape::escape;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use super::RexsError;
use super::document::{Lines, on_one_line};

/// Elements whose places are kept.
const KEPT: [&str; 8] =
    ["relations", "relation", "components", "component", "attribute", "load_spectrum", "load_case", "accumulation"];
/// Indent of children below their parent, where none shows how deep.
const STEP: &str = "  ";
const BYTE_ORDER_MARK: char = '\u{feff}';

/// An element. Nodes of [`Places`] are named by their index.
#[derive(Debug)]
struct ElementNode {
    name: &'static str,
    id: String,
    line: usize,
    /// Tag; of an element without content all of it.
    tag: Range<usize>,
    /// Closing tag; empty of an element without content.
    end: Range<usize>,
    /// The innermost element around it that is kept.
    parent: Option<usize>,
}

/// Text to be put in.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NewElement {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    content: ElementContent,
}

#[derive(Debug, Clone, PartialEq)]
enum ElementContent {
    /// On the line of the tags.
    Markup(String),
    Children(Vec<NewElement>),
}

impl NewElement {
    /// An element with others in it.
    pub(super) fn new(name: &'static str, attributes: Vec<(&'static str, String)>, children: Vec<NewElement>) -> Self {
        Self { name, attributes, content: ElementContent::Children(children) }
    }

    /// An attribute of a component. `markup` is what stands between its tags.
    pub(super) fn attribute(id: String, unit: &str, markup: String) -> Self {
        let attributes = vec![("id", id), ("unit", unit.to_owned())];
        Self { name: "attribute", attributes, content: ElementContent::Markup(markup) }
    }

    /// The value of its XML attribute `id`.
    pub(super) fn id(&self) -> &str {
        self.attributes.iter().find(|(name, _)| *name == "id").map_or("", |(_, value)| value)
    }

    fn write(&self, line_end: &str, indent: &str, into: &mut String) {
        into.push('<');
        into.push_str(self.name);
        for (name, value) in &self.attributes {
            into.push_str(&format!(" {name}=\"{}\"", escape(value)));
        }
        match &self.content {
            ElementContent::Children(children) if children.is_empty() => into.push_str("/>"),
            ElementContent::Markup(markup) => into.push_str(&format!(">{markup}</{}>", self.name)),
            ElementContent::Children(children) => {
                into.push('>');
                let inner = if line_end.is_empty() { String::new() } else { format!("{indent}{STEP}") };
                for child in children {
                    into.push_str(line_end);
                    into.push_str(&inner);
                    child.write(line_end, &inner, into);
                }
                into.push_str(&format!("{line_end}{indent}</{}>", self.name));
            }
        }
    }
}

/// The places of a file's elements, and the changes to be made.
#[derive(Debug)]
pub(super) struct Places<'a> {
    text: &'a str,
    nodes: Vec<ElementNode>,
    changes: Vec<(Range<usize>, String)>,
    /// Elements to stand behind the last child of a node.
    additions: Vec<(usize, Vec<NewElement>)>,
}

impl<'a> Places<'a> {
    pub(super) fn of(text: &'a str) -> Result<Self, RexsError> {
        // The reader skips the mark and does not count it.
        let unmarked = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text);
        let skipped = text.len() - unmarked.len();
        let mut reader = Reader::from_str(unmarked);
        let mut lines = Lines::of(unmarked);
        let mut nodes: Vec<ElementNode> = Vec::new();
        // Of every open element its node, if it is kept.
        let mut open: Vec<Option<usize>> = Vec::new();
        let byte = |position: u64| usize::try_from(position).unwrap_or(usize::MAX).min(unmarked.len());
        loop {
            let (start, line) = (reader.buffer_position(), lines.at(reader.buffer_position()));
            let event = reader.read_event().map_err(|error| RexsError::unreadable(line, &error))?;
            let tag = byte(start) + skipped..byte(reader.buffer_position()) + skipped;
            let mut entered = |element: &BytesStart, tag: Range<usize>, open: &[Option<usize>]| {
                let Some(name) = KEPT.into_iter().find(|kept| *kept == element.name().as_ref()) else {
                    return Ok(None);
                };
                let end = tag.end..tag.end;
                let parent = open.iter().rev().find_map(|node| *node);
                nodes.push(ElementNode { name, id: xml_attribute(element, "id", line)?, line, tag, end, parent });
                Ok(Some(nodes.len() - 1))
            };
            match event {
                Event::Start(element) => {
                    let node = entered(&element, tag, &open)?;
                    open.push(node);
                }
                Event::Empty(element) => {
                    entered(&element, tag, &open)?;
                }
                Event::End(_) => {
                    if let Some(node) = open.pop().flatten() {
                        nodes[node].end = tag;
                    }
                }
                Event::Eof => break,
                _ => {}
            }
        }
        Ok(Self { text, nodes, changes: Vec::new(), additions: Vec::new() })
    }

    fn children<'s>(&'s self, parent: usize, name: &'s str) -> impl Iterator<Item = usize> + 's {
        (0..self.nodes.len())
            .filter(move |&node| self.nodes[node].parent == Some(parent) && self.nodes[node].name == name)
    }

    /// The elements of a name, in the order of the file.
    fn named<'s>(&'s self, name: &'s str) -> impl Iterator<Item = usize> + 's {
        (0..self.nodes.len()).filter(move |&node| self.nodes[node].name == name)
    }

    /// The first element of a name.
    pub(super) fn first(&self, name: &'static str) -> Result<usize, RexsError> {
        let first = self.named(name).next();
        first.ok_or_else(|| RexsError::NoModel { line: 1, found: format!("no element <{name}>") })
    }

    /// The load spectrum with its load cases and, where it has one, its accumulation; None where the file has none.
    pub(super) fn load_spectrum(&self) -> Result<Option<LoadSpectrum>, RexsError> {
        let mut all = self.named("load_spectrum");
        let Some(spectrum) = all.next() else { return Ok(None) };
        if let Some(second) = all.next() {
            return Err(RexsError::SecondSpectrum { line: self.nodes[second].line });
        }
        let cases = self.children(spectrum, "load_case").collect();
        Ok(Some(LoadSpectrum { node: spectrum, cases, accumulation: self.children(spectrum, "accumulation").next() }))
    }

    /// The smallest number that is the id of no element of this name.
    pub(super) fn free_id(&self, name: &str, taken: &BTreeSet<String>) -> String {
        let used: BTreeSet<&str> = self.named(name).map(|node| self.nodes[node].id.as_str()).collect();
        let mut ids = (1_u64..).map(|id| id.to_string());
        ids.find(|id| !used.contains(id.as_str()) && !taken.contains(id)).unwrap_or_default()
    }

    /// The component of this id in a section of the file.
    pub(super) fn component(&self, section: usize, id: &str) -> Option<usize> {
        self.children(section, "component").find(|&node| self.nodes[node].id == id)
    }

    /// Gives a component these attributes, in place of those it has of the same ids.
    pub(super) fn set_attributes(&mut self, component: usize, attributes: Vec<NewElement>) {
        let mut added = Vec::new();
        for attribute in attributes {
            let standing: Vec<usize> = self.attributes(component, attribute.id()).collect();
            match standing.split_first() {
                None => added.push(attribute),
                Some((&first, others)) => {
                    let mut text = String::new();
                    attribute.write("", "", &mut text);
                    self.changes.push((self.whole(first), text));
                    others.iter().for_each(|&other| self.take_out(other));
                }
            }
        }
        self.add(component, added);
    }

    /// Takes the attributes whose ids are `unwanted` out of a component.
    pub(super) fn take_out_attributes(&mut self, component: usize, unwanted: impl Fn(&str) -> bool) {
        let all = self.children(component, "attribute");
        let unwanted: Vec<usize> = all.filter(|&node| unwanted(&self.nodes[node].id)).collect();
        unwanted.into_iter().for_each(|node| self.take_out(node));
    }

    fn attributes<'s>(&'s self, component: usize, id: &'s str) -> impl Iterator<Item = usize> + 's {
        self.children(component, "attribute").filter(move |&node| self.nodes[node].id == id)
    }

    /// Puts elements behind the last child of a node.
    pub(super) fn add(&mut self, node: usize, elements: Vec<NewElement>) {
        match self.additions.iter_mut().find(|(known, _)| *known == node) {
            Some((_, all)) => all.extend(elements),
            None => self.additions.push((node, elements)),
        }
    }

    /// All of a node, from its tag to its closing tag.
    fn whole(&self, node: usize) -> Range<usize> {
        self.nodes[node].tag.start..self.nodes[node].end.end
    }

    /// Takes out an element, with its line where it has one of its own.
    fn take_out(&mut self, node: usize) {
        let Range { start, end } = self.whole(node);
        let before = self.text[..start].trim_end_matches([' ', '\t']);
        let alone = self.text[end..].trim_start_matches([' ', '\t']).starts_with(['\n', '\r']);
        let before = match before.strip_suffix('\n') {
            Some(before) if alone => before.strip_suffix('\r').unwrap_or(before).len(),
            _ => start,
        };
        self.changes.push((before..end, String::new()));
    }

    /// Blanks that begin the line of a byte.
    fn indent(&self, at: usize) -> &'a str {
        let line = self.text[..at].rfind('\n').map_or(0, |end| end + 1);
        let line = &self.text[line..at];
        &line[..line.len() - line.trim_start_matches([' ', '\t']).len()]
    }

    /// The changes that put `elements` behind the last child of a node: each on a line of its own, unless the file has no lines.
    fn addition(&self, node: usize, elements: &[NewElement]) -> (Range<usize>, String) {
        let place = &self.nodes[node];
        let line_end = match self.text.find('\n') {
            None => "",
            Some(end) if self.text[..end].ends_with('\r') => "\r\n",
            Some(_) => "\n",
        };
        let own = if line_end.is_empty() { "" } else { self.indent(place.tag.start) };
        let mut children = (0..self.nodes.len()).filter(|&child| self.nodes[child].parent == Some(node));
        let first = children.next();
        let last = children.next_back().or(first);
        let indent = match first.map(|child| self.nodes[child].tag.start) {
            _ if line_end.is_empty() => String::new(),
            Some(at) if self.text[..at].trim_end_matches([' ', '\t']).ends_with('\n') => self.indent(at).to_owned(),
            _ => format!("{own}{STEP}"),
        };
        let mut text = String::new();
        for element in elements {
            text.push_str(line_end);
            text.push_str(&indent);
            element.write(line_end, &indent, &mut text);
        }
        if place.end.is_empty() {
            // The tag ends in />.
            return (place.tag.end - 2..place.tag.end, format!(">{text}{line_end}{own}</{}>", place.name));
        }
        let at = last.map_or(place.tag.end, |child| self.whole(child).end);
        if !self.text[at..place.end.start].contains('\n') {
            text.push_str(line_end);
            text.push_str(own);
        }
        (at..at, text)
    }

    /// The text with all changes.
    pub(super) fn changed(mut self) -> String {
        let mut changes = std::mem::take(&mut self.changes);
        changes.extend(
            self.additions.iter().filter(|(_, all)| !all.is_empty()).map(|(node, all)| self.addition(*node, all)),
        );
        changes.sort_by_key(|(range, _)| (range.start, range.end));
        let mut text = String::with_capacity(self.text.len() + changes.iter().map(|(_, new)| new.len()).sum::<usize>());
        let mut kept = 0;
        for (range, new) in changes {
            text.push_str(&self.text[kept..range.start]);
            text.push_str(&new);
            kept = range.end;
        }
        text.push_str(&self.text[kept..]);
        text
    }
}

/// An attribute of an element on `line`; empty where it is not there.
fn xml_attribute(tag: &BytesStart, name: &str, line: usize) -> Result<String, RexsError> {
    let unreadable = |error: &dyn std::fmt::Display| RexsError::NoModel {
        line,
        found: format!("an attribute that cannot be read ({error})"),
    };
    match tag.try_get_attribute(name).map_err(|error| unreadable(&error))? {
        None => Ok(String::new()),
        Some(found) => {
            let value = found.normalized_value(XmlVersion::Implicit1_0).map_err(|error| unreadable(&error))?;
            Ok(on_one_line(&value))
        }
    }
}

/// Nodes of a load spectrum.
#[derive(Debug)]
pub(super) struct LoadSpectrum {
    pub node: usize,
    pub cases: Vec<usize>,
    pub accumulation: Option<usize>,
}
