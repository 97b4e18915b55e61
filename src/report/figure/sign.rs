//! Signs of points, and of traces in a legend.

use super::picture::{Group, Medium, Moves, Node, Path, Picture, Step, polygon, rectangle};
use crate::report::chart::{Bars, Curve, Dash, Drawn, Line, Signs, Trace};

/// Width of the outline of open signs, px.
const OUTLINE_PX: f64 = 1.5;
/// Size of a legend's sign in a page, px.
const IN_PAGE: [f64; 2] = [30.0, 14.0];

/// The sign of the point of that number at `at`.
pub(super) fn of_point(signs: &Signs, number: usize, at: [f64; 2], moves: Moves) -> Node {
    let size = signs.size_px.get(number).or(signs.size_px.first()).copied().unwrap_or(6.0);
    let (shape, is_open) = match signs.symbol.strip_suffix("-open") {
        Some(shape) => (shape, true),
        None => (signs.symbol.as_str(), false),
    };
    let (shape, is_dotted) = shape.strip_suffix("-dot").map_or((shape, false), |shape| (shape, true));
    let mut steps = outline(shape, 0.5 * size);
    // The dot is a hole: it goes round the other way.
    if is_dotted {
        let r = 0.18 * size;
        steps.extend(polygon(&[[-r, 0.0], [0.0, r], [r, 0.0], [0.0, -r]]));
    }
    let colour = signs.colour.clone();
    let line = || Some(Line { colour: colour.clone(), width_px: OUTLINE_PX, dash: Dash::Solid });
    let (fill, line) = match (shape, is_open) {
        ("x", _) | (_, true) => (None, line()),
        _ => (Some(colour), None),
    };
    Node::Path(Path { at, moves, steps, fill, line })
}

/// A shape about the origin; `half` is half its size.
fn outline(shape: &str, half: f64) -> Vec<Step> {
    let scaled = |corners: &[[f64; 2]]| polygon(&corners.iter().map(|[x, y]| [x * half, y * half]).collect::<Vec<_>>());
    match shape {
        "square" => rectangle([-half, -half, half, half]),
        "diamond" => scaled(&[[0.0, -1.3], [1.3, 0.0], [0.0, 1.3], [-1.3, 0.0]]),
        "triangle-up" => scaled(&[[0.0, -1.15], [1.15, 0.85], [-1.15, 0.85]]),
        "triangle-down" => scaled(&[[-1.15, -0.85], [1.15, -0.85], [0.0, 1.15]]),
        "triangle-right" => scaled(&[[-0.85, -1.15], [1.15, 0.0], [-0.85, 1.15]]),
        "cross" => {
            const T: f64 = 0.36;
            scaled(&[
                [-T, -1.0],
                [T, -1.0],
                [T, -T],
                [1.0, -T],
                [1.0, T],
                [T, T],
                [T, 1.0],
                [-T, 1.0],
                [-T, T],
                [-1.0, T],
                [-1.0, -T],
                [-T, -T],
            ])
        }
        "star" => {
            let turn = |i: i32| (std::f64::consts::PI * f64::from(i) / 5.0).sin_cos();
            let corners = (0..10).map(|i| {
                let ((sin, cos), reach) = (turn(i), if i % 2 == 0 { 1.3 } else { 0.5 });
                [reach * sin, -reach * cos]
            });
            scaled(&corners.collect::<Vec<_>>())
        }
        "x" => {
            let corner = |x: f64, y: f64| [0.9 * half * x, 0.9 * half * y];
            vec![
                Step::Move(corner(-1.0, -1.0)),
                Step::Line(corner(1.0, 1.0)),
                Step::Move(corner(-1.0, 1.0)),
                Step::Line(corner(1.0, -1.0)),
            ]
        }
        _ => vec![Step::Circle { centre: [0.0; 2], radius: half }],
    }
}

/// Whether the legend names it.
pub(super) fn is_listed(trace: &Trace) -> bool {
    trace.is_listed && !trace.name.is_empty() && matches!(trace.drawn, Drawn::Curve(_) | Drawn::Bars(_))
}

/// The sign of a trace in a legend, of that width, with its left end at `at`.
pub(super) fn of_legend(trace: &Trace, [x, y]: [f64; 2], width: f64) -> Vec<Node> {
    let path = |steps, fill, line| Node::Path(Path { at: [0.0; 2], moves: Moves::No, steps, fill, line });
    let block =
        |colour: &String| path(rectangle([x + 6.0, y - 5.0, x + width - 6.0, y + 5.0]), Some(colour.clone()), None);
    let nodes = match &trace.drawn {
        Drawn::Bars(Bars { colour, .. }) => vec![block(colour)],
        Drawn::Curve(Curve { line, signs, fill, .. }) => {
            let across = || vec![Step::Move([x, y]), Step::Line([x + width, y])];
            let area = fill.iter().map(block);
            let line =
                line.iter().filter(|line| line.width_px > 0.0).map(|line| path(across(), None, Some(line.clone())));
            let sign = signs.iter().map(|signs| of_point(signs, 0, [x + 0.5 * width, y], Moves::No));
            area.chain(line).chain(sign).collect()
        }
        Drawn::Cells(_) | Drawn::Contours(_) | Drawn::Surface(_) => Vec::new(),
    };
    let group = Group { opacity: trace.opacity, ..Group::named("sign") };
    [Node::Group(group)].into_iter().chain(nodes).chain([Node::End]).collect()
}

/// The sign of a trace beside its name in a page, as SVG.
pub(super) fn in_page(trace: &Trace) -> String {
    let [width, height] = IN_PAGE;
    let nodes = of_legend(trace, [1.0, 0.5 * height], width - 2.0);
    let (id, title) = (String::new(), String::new());
    Picture { id, title, medium: Medium::Page, size: IN_PAGE, frame: [0.0, 0.0, width, height], nodes }.svg()
}
