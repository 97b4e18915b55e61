//! A drawing as data: paths, words and fields of colour in groups. Written as SVG here, as pixels by `raster`.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

use super::palette::{hex, in_light, in_page};
use super::png;
use crate::report::chart::{Dash, Line};
use gearwear_files::content_hash::sha256;

/// Where a drawing is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Medium {
    /// In the page, whose style sheet colours it and whose script moves it.
    Page,
    /// In a file of its own.
    File,
}

pub(super) struct Picture {
    /// Identifier, unique in a page.
    pub id: String,
    pub title: String,
    pub medium: Medium,
    pub size: [f64; 2],
    /// Left, top, right and bottom of the plot, to which groups may be clipped.
    pub frame: [f64; 4],
    pub nodes: Vec<Node>,
}

pub(super) enum Node {
    /// Up to its [`Node::End`].
    Group(Group),
    End,
    Path(Path),
    Words(Words),
    Field(FieldOfColour),
}

/// What belongs together.
#[derive(Debug, Clone)]
pub(super) struct Group {
    /// Name for the script of a page.
    pub class: &'static str,
    /// The trace that it shows.
    pub trace: Option<usize>,
    pub is_clipped: bool,
    pub is_hidden: bool,
    pub opacity: f64,
}

impl Group {
    pub(super) fn named(class: &'static str) -> Self {
        Self { class, trace: None, is_clipped: false, is_hidden: false, opacity: 1.0 }
    }
}

/// With what a node moves when the reader of a page looks closer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Moves {
    /// With the group in which it is.
    No,
    Across,
    Upwards,
    BothWays,
}

pub(super) enum Step {
    Move([f64; 2]),
    Line([f64; 2]),
    Circle { centre: [f64; 2], radius: f64 },
    Close,
}

pub(super) fn rectangle([left, top, right, bottom]: [f64; 4]) -> Vec<Step> {
    let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
    polygon(&corners)
}

pub(super) fn polygon(corners: &[[f64; 2]]) -> Vec<Step> {
    let first = corners.iter().take(1).map(|corner| Step::Move(*corner));
    first.chain(corners.iter().skip(1).map(|corner| Step::Line(*corner))).chain([Step::Close]).collect()
}

/// Lines and areas about the point `at`.
pub(super) struct Path {
    pub at: [f64; 2],
    pub moves: Moves,
    pub steps: Vec<Step>,
    pub fill: Option<String>,
    pub line: Option<Line>,
}

pub(super) struct Words {
    pub at: [f64; 2],
    pub moves: Moves,
    pub text: String,
    pub anchor: Anchor,
    pub size: f64,
    pub colour: String,
    /// Upwards instead of across.
    pub is_upright: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Cells of one size, each with a level of the scale of colours, row by row downwards; [`png::NO_LEVEL`] is empty.
pub(super) struct FieldOfColour {
    /// Left, top, right and bottom.
    pub frame: [f64; 4],
    pub columns: usize,
    pub levels: Vec<u8>,
    /// The state of a slider that shows it; none where it is shown always.
    pub state: Option<usize>,
    pub is_hidden: bool,
}

/// Lengths of strokes and gaps, px.
pub(super) fn dashes(dash: Dash) -> &'static [f32] {
    match dash {
        Dash::Solid => &[],
        Dash::Dashed => &[9.0, 6.0],
        Dash::Dot => &[2.0, 4.0],
        Dash::Mixed => &[9.0, 4.0, 2.0, 4.0],
    }
}

/// Hexadecimal digits of the content's SHA-256 in an identifier.
const IDENTIFYING_DIGITS: usize = 12;

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A place on the drawing, to a hundredth of a pixel.
fn place(value: f64) -> String {
    let text = format!("{value:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

impl Picture {
    /// SVG. Identifiers in that of a file have its content in them: drawings of other runs may stand on the same page.
    pub(super) fn svg(&self) -> String {
        let svg = self.drawn();
        if self.medium == Medium::Page || self.id.is_empty() {
            return svg;
        }
        let area = format!("{}-area", self.id);
        let own = format!("{area}-{}", &sha256(svg.as_bytes())[..IDENTIFYING_DIGITS]);
        svg.replace(&format!("id=\"{area}\""), &format!("id=\"{own}\""))
            .replace(&format!("url(#{area})"), &format!("url(#{own})"))
    }

    fn drawn(&self) -> String {
        let [width, height] = self.size;
        let [left, top, right, bottom] = self.frame;
        let mut svg = match self.medium {
            Medium::File => format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
                 font-family=\"DejaVu Sans, Verdana, sans-serif\"><title>{}</title>\n",
                escaped(&self.title)
            ),
            Medium::Page => format!("<svg viewBox=\"0 0 {width} {height}\">"),
        };
        if !self.id.is_empty() {
            let (id, width, height) = (&self.id, right - left, bottom - top);
            let _ = writeln!(
                svg,
                "<clipPath id=\"{id}-area\"><rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"/></clipPath>"
            );
        }
        self.nodes.iter().for_each(|node| self.write(node, &mut svg));
        svg.push_str("</svg>\n");
        svg
    }

    /// The attribute `name` of a colour: `fill` or `stroke`. In files opacity is an attribute of its own, as SVG 1.1 has no `rgba()`.
    fn paint(&self, name: &str, token: &str) -> String {
        if self.medium == Medium::Page {
            return format!("{name}=\"{}\"", in_page(token));
        }
        let [red, green, blue, opacity] = in_light(token);
        let colour = hex([red, green, blue]);
        match opacity {
            255 => format!("{name}=\"{colour}\""),
            _ => format!("{name}=\"{colour}\" {name}-opacity=\"{:.3}\"", f64::from(opacity) / 255.0),
        }
    }

    fn write(&self, node: &Node, svg: &mut String) {
        match node {
            Node::Group(group) => self.write_group(group, svg),
            Node::End => svg.push_str("</g>\n"),
            Node::Path(path) => self.write_path(path, svg),
            Node::Words(words) => self.write_words(words, svg),
            Node::Field(field) => self.write_field(field, svg),
        }
    }

    fn write_group(&self, group: &Group, svg: &mut String) {
        let _ = write!(svg, "<g class=\"{}\"", group.class);
        if group.is_clipped {
            let _ = write!(svg, " clip-path=\"url(#{}-area)\"", self.id);
        }
        if let Some(trace) = group.trace {
            let _ = write!(svg, " data-trace=\"{trace}\"");
        }
        if group.opacity != 1.0 {
            let _ = write!(svg, " opacity=\"{}\"", group.opacity);
        }
        svg.push_str(if group.is_hidden { " display=\"none\">" } else { ">" });
    }

    fn write_path(&self, path: &Path, svg: &mut String) {
        svg.push_str("<path");
        self.write_moves(path.moves, svg);
        if path.at != [0.0; 2] || path.moves != Moves::No {
            let _ = write!(svg, " transform=\"translate({},{})\"", place(path.at[0]), place(path.at[1]));
        }
        let fill = path.fill.as_deref().map_or_else(|| "fill=\"none\"".to_owned(), |fill| self.paint("fill", fill));
        let _ = write!(svg, " d=\"{}\" {fill}", path.steps.iter().map(written).collect::<String>());
        if let Some(line) = &path.line {
            let _ = write!(svg, " {} stroke-width=\"{}\"", self.paint("stroke", &line.colour), line.width_px);
            let lengths: Vec<String> = dashes(line.dash).iter().map(f32::to_string).collect();
            if !lengths.is_empty() {
                let _ = write!(svg, " stroke-dasharray=\"{}\"", lengths.join(" "));
            }
        }
        svg.push_str("/>\n");
    }

    fn write_words(&self, words: &Words, svg: &mut String) {
        let [x, y] = words.at.map(place);
        svg.push_str("<text");
        self.write_moves(words.moves, svg);
        let _ = match (words.is_upright, words.moves) {
            (true, _) => write!(svg, " transform=\"translate({x},{y}) rotate(-90)\""),
            (false, Moves::No) => write!(svg, " x=\"{x}\" y=\"{y}\""),
            (false, _) => write!(svg, " transform=\"translate({x},{y})\""),
        };
        let anchor = match words.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (size, fill, text) = (words.size, self.paint("fill", &words.colour), escaped(&words.text));
        let _ = writeln!(svg, " text-anchor=\"{anchor}\" font-size=\"{size}\" {fill}>{text}</text>");
    }

    fn write_moves(&self, moves: Moves, svg: &mut String) {
        let class = match moves {
            Moves::No => return,
            Moves::Across => "at-x",
            Moves::Upwards => "at-y",
            Moves::BothWays => "at",
        };
        let _ = write!(svg, " class=\"{class}\"");
    }

    fn write_field(&self, field: &FieldOfColour, svg: &mut String) {
        let [left, top, right, bottom] = field.frame;
        let state = field.state.map_or_else(String::new, |state| format!(" data-state=\"{state}\""));
        let hidden = if field.is_hidden { " display=\"none\"" } else { "" };
        let _ = writeln!(
            svg,
            "<image{state}{hidden} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" \
             style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{}\"/>",
            place(left),
            place(top),
            place(right - left),
            place(bottom - top),
            BASE64_STANDARD.encode(png::of_levels(field.columns, &field.levels))
        );
    }
}

fn written(step: &Step) -> String {
    match *step {
        Step::Move([x, y]) => format!("M{} {}", place(x), place(y)),
        // Places after that of a move are ends of lines.
        Step::Line([x, y]) => format!(" {} {}", place(x), place(y)),
        Step::Circle { centre: [x, y], radius } => {
            let (left, r, across) = (place(x - radius), place(radius), place(2.0 * radius));
            format!("M{left} {}a{r} {r} 0 1 1 {across} 0a{r} {r} 0 1 1 -{across} 0z", place(y))
        }
        Step::Close => "Z".to_owned(),
    }
}
