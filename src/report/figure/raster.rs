//! A drawing as pixels, with a font of its own, so that it looks the same on every machine.

use std::io;

use tiny_skia::{
    Color, FillRule, FilterQuality, LineJoin, Mask, Paint, PathBuilder, Pixmap, PixmapPaint, Stroke, StrokeDash,
    Transform,
};
use ttf_parser::{Face, OutlineBuilder};

use super::palette::{in_light, of_scale};
use super::picture::{Anchor, FieldOfColour, Node, Path, Picture, Step, Words, dashes};
use super::png;

/// DejaVu Sans, the characters that figures use.
const FONT: &[u8] = include_bytes!("../assets/DejaVuSans-subset.ttf");
/// Pixels of a PNG for one of the SVG.
const PIXELS: f32 = 2.0;

/// The whole drawing as PNG.
pub(super) fn png(picture: &Picture) -> io::Result<Vec<u8>> {
    let no_size = || io::Error::other("a figure without size");
    let [width, height] = picture.size.map(|length| (length as f32 * PIXELS).ceil() as u32);
    let mut pixels = Pixmap::new(width, height).ok_or_else(no_size)?;
    pixels.fill(Color::WHITE);
    let mut area = Mask::new(width, height).ok_or_else(no_size)?;
    let [left, top, right, bottom] = picture.frame.map(|place| place as f32);
    if let Some(frame) = tiny_skia::Rect::from_ltrb(left, top, right, bottom) {
        area.fill_path(&PathBuilder::from_rect(frame), FillRule::Winding, true, scale());
    }
    let font = Face::parse(FONT, 0).map_err(io::Error::other)?;
    let mut canvas = Canvas { pixels, area, font, groups: Vec::new() };
    picture.nodes.iter().for_each(|node| canvas.draw(node));
    Ok(png::of_pixels(width as usize, canvas.pixels.data()))
}

fn scale() -> Transform {
    Transform::from_scale(PIXELS, PIXELS)
}

struct Canvas<'a> {
    pixels: Pixmap,
    /// The plot within its frame.
    area: Mask,
    font: Face<'a>,
    /// Of each group that is open: opacity, whether it is clipped to the plot, whether it is hidden.
    groups: Vec<(f64, bool, bool)>,
}

impl Canvas<'_> {
    fn draw(&mut self, node: &Node) {
        match node {
            Node::Group(group) => self.groups.push((group.opacity, group.is_clipped, group.is_hidden)),
            Node::End => {
                self.groups.pop();
            }
            _ if self.groups.iter().any(|(_, _, is_hidden)| *is_hidden) => {}
            Node::Path(path) => self.path(path),
            Node::Words(words) => self.words(words),
            Node::Field(field) if field.is_hidden => {}
            Node::Field(field) => self.field(field),
        }
    }

    fn paint(&self, colour: &str) -> Paint<'static> {
        let [red, green, blue, opacity] = in_light(colour);
        let of_groups: f64 = self.groups.iter().map(|(opacity, ..)| opacity).product();
        let mut paint = Paint::default();
        paint.set_color_rgba8(red, green, blue, (f64::from(opacity) * of_groups).round() as u8);
        paint
    }

    fn is_clipped(&self) -> bool {
        self.groups.iter().any(|(_, is_clipped, _)| *is_clipped)
    }

    fn path(&mut self, path: &Path) {
        let mut builder = PathBuilder::new();
        let single = |place: [f64; 2]| place.map(|place| place as f32);
        for step in &path.steps {
            match *step {
                Step::Move(to) => builder.move_to(single(to)[0], single(to)[1]),
                Step::Line(to) => builder.line_to(single(to)[0], single(to)[1]),
                Step::Circle { centre, radius } => {
                    builder.push_circle(single(centre)[0], single(centre)[1], radius as f32)
                }
                Step::Close => builder.close(),
            }
        }
        let Some(outline) = builder.finish() else { return };
        let transform = scale().pre_translate(path.at[0] as f32, path.at[1] as f32);
        let fill = path.fill.as_deref().map(|colour| self.paint(colour));
        let line = path.line.as_ref().map(|line| (self.paint(&line.colour), line));
        let area = self.is_clipped().then_some(&self.area);
        if let Some(paint) = fill {
            self.pixels.fill_path(&outline, &paint, FillRule::Winding, transform, area);
        }
        if let Some((paint, line)) = line {
            let dash = StrokeDash::new(dashes(line.dash).to_vec(), 0.0);
            let stroke = Stroke { width: line.width_px as f32, line_join: LineJoin::Round, dash, ..Stroke::default() };
            self.pixels.stroke_path(&outline, &paint, &stroke, transform, area);
        }
    }

    fn words(&mut self, words: &Words) {
        let size = words.size as f32 / f32::from(self.font.units_per_em());
        let glyphs: Vec<_> = words.text.chars().filter_map(|character| self.font.glyph_index(character)).collect();
        let advance = |glyph| f32::from(self.font.glyph_hor_advance(glyph).unwrap_or(0)) * size;
        let width: f32 = glyphs.iter().map(|glyph| advance(*glyph)).sum();
        let mut letters = Letters { path: PathBuilder::new(), x: 0.0, size };
        for glyph in glyphs {
            self.font.outline_glyph(glyph, &mut letters);
            letters.x += advance(glyph);
        }
        let Some(outline) = letters.path.finish() else { return };
        let before = match words.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * width,
            Anchor::End => width,
        };
        let turned = if words.is_upright { -90.0 } else { 0.0 };
        let placed = scale().pre_translate(words.at[0] as f32, words.at[1] as f32).pre_rotate(turned);
        let paint = self.paint(&words.colour);
        self.pixels.fill_path(&outline, &paint, FillRule::Winding, placed.pre_translate(-before, 0.0), None);
    }

    fn field(&mut self, field: &FieldOfColour) {
        let (columns, rows) = (field.columns as u32, (field.levels.len() / field.columns.max(1)) as u32);
        let Some(mut cells) = Pixmap::new(columns, rows) else { return };
        for (cell, &level) in cells.data_mut().chunks_exact_mut(4).zip(&field.levels) {
            if level != png::NO_LEVEL {
                let [red, green, blue] = of_scale(f64::from(level) / (png::LEVELS - 1) as f64);
                cell.copy_from_slice(&[red, green, blue, 255]);
            }
        }
        let [left, top, right, bottom] = field.frame.map(|place| place as f32);
        let across = [(right - left) / columns as f32, (bottom - top) / rows as f32];
        let placed = scale().pre_translate(left, top).pre_scale(across[0], across[1]);
        let paint = PixmapPaint { quality: FilterQuality::Nearest, ..PixmapPaint::default() };
        let area = self.is_clipped().then_some(&self.area);
        self.pixels.draw_pixmap(0, 0, cells.as_ref(), &paint, placed, area);
    }
}

/// Outlines of characters one after the other.
struct Letters {
    path: PathBuilder,
    /// Where the next one begins.
    x: f32,
    size: f32,
}

impl Letters {
    fn at(&self, x: f32, y: f32) -> [f32; 2] {
        [self.x + x * self.size, -y * self.size]
    }
}

impl OutlineBuilder for Letters {
    fn move_to(&mut self, x: f32, y: f32) {
        let [x, y] = self.at(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let [x, y] = self.at(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ([x1, y1], [x, y]) = (self.at(x1, y1), self.at(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ([x1, y1], [x2, y2], [x, y]) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}
