//! Colours of drawings: the tokens of charts as the style sheet of a page takes them, and in the colours that pages have in the light.

/// The style sheet of the pages, which holds the palette.
const STYLE: &str = include_str!("../html/page.css");

/// The scale Viridis at equal steps.
const VIRIDIS: [[u8; 3]; 17] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x18, 0x6a],
    [0x47, 0x2d, 0x7b],
    [0x42, 0x40, 0x86],
    [0x3b, 0x52, 0x8b],
    [0x33, 0x63, 0x8d],
    [0x2c, 0x72, 0x8e],
    [0x26, 0x82, 0x8e],
    [0x21, 0x91, 0x8c],
    [0x1f, 0xa0, 0x88],
    [0x28, 0xae, 0x80],
    [0x3f, 0xbc, 0x73],
    [0x5e, 0xc9, 0x62],
    [0x84, 0xd4, 0x4b],
    [0xad, 0xdc, 0x30],
    [0xd8, 0xe2, 0x19],
    [0xfd, 0xe7, 0x25],
];

/// A colour as red, green, blue and opacity, each up to 255.
pub(super) type Rgba = [u8; 4];

/// What a token is: a property of the palette, a mixture of two, or a colour.
enum Token<'a> {
    Property(&'a str),
    Mixture { from: &'a str, to: &'a str, share: f64 },
    Colour(&'a str),
}

fn token(text: &str) -> Token<'_> {
    let inside = |prefix| text.strip_prefix(prefix).and_then(|rest: &str| rest.strip_suffix(')'));
    let mixture = || {
        let mut parts = inside("mix(")?.split(',');
        Some(Token::Mixture { from: parts.next()?, to: parts.next()?, share: parts.next()?.parse().ok()? })
    };
    inside("var(").map(Token::Property).or_else(mixture).unwrap_or(Token::Colour(text))
}

/// For a page, where the colours in force are those of its style sheet.
pub(super) fn in_page(text: &str) -> String {
    match token(text) {
        Token::Mixture { from, to, share } => {
            format!("color-mix(in srgb, var({from}), var({to}) {:.1}%)", 100.0 * share)
        }
        Token::Property(_) | Token::Colour(_) => text.to_owned(),
    }
}

/// For a file: as in the light.
pub(super) fn in_light(text: &str) -> Rgba {
    match token(text) {
        Token::Property(name) => channels(property(name)),
        Token::Mixture { from, to, share } => between(channels(property(from)), channels(property(to)), share),
        Token::Colour(colour) => channels(colour),
    }
}

/// The colour at `share` of the scale of colours.
pub(crate) fn of_scale(share: f64) -> [u8; 3] {
    let last = VIRIDIS.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let below = (place as usize).min(last - 1);
    let [from, to] = [VIRIDIS[below], VIRIDIS[below + 1]].map(|[red, green, blue]| [red, green, blue, 255]);
    let [red, green, blue, _] = between(from, to, place - below as f64);
    [red, green, blue]
}

pub(super) fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// A custom property of the style sheet, the first of its name, which is that in the light.
fn property(name: &str) -> &'static str {
    let start = STYLE.find(&format!("{name}:")).map(|at| &STYLE[at + name.len() + 1..]);
    start.and_then(|rest| rest.split(';').next()).unwrap_or("#000000").trim()
}

/// Of `#rrggbb` or `rgba(r, g, b, opacity)`.
fn channels(colour: &str) -> Rgba {
    if let Some(parts) = colour.strip_prefix("rgba(").and_then(|rest| rest.strip_suffix(')')) {
        let parts: Vec<f64> = parts.split(',').map(|part| part.trim().parse().unwrap_or(0.0)).collect();
        return [0, 1, 2, 3].map(|i| {
            let value = parts.get(i).copied().unwrap_or(1.0);
            if i == 3 { (255.0 * value).round() as u8 } else { value as u8 }
        });
    }
    let pair = |at: usize| colour.get(at..at + 2).and_then(|two| u8::from_str_radix(two, 16).ok()).unwrap_or(0);
    [pair(1), pair(3), pair(5), 255]
}

fn between(from: Rgba, to: Rgba, share: f64) -> Rgba {
    [0, 1, 2, 3].map(|i| (f64::from(from[i]) + (f64::from(to[i]) - f64::from(from[i])) * share).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_those_of_the_page() {
        assert_eq!(in_light("var(--pinion)"), [0, 0x5f, 0x9e, 255]);
        assert_eq!(in_light("var(--pinion-fill)"), [0, 95, 158, 26]);
        assert_eq!(in_light("mix(--pinion,--wheel,0.500)"), [0x5a, 0x53, 0x4f, 255]);
        assert_eq!(in_light("#ff5a36"), [0xff, 0x5a, 0x36, 255]);
        assert_eq!(in_page("mix(--pinion,--wheel,0.5)"), "color-mix(in srgb, var(--pinion), var(--wheel) 50.0%)");
        assert_eq!([-1.0, 0.5, 2.0].map(|share| hex(of_scale(share))), ["#440154", "#21918c", "#fde725"]);
    }
}
