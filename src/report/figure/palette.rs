//! Colours of figures: the tokens of charts in the colours that the pages have in the light.

/// The style sheet of the pages, which holds the palette.
const STYLE: &str = include_str!("../html/page.css");

/// plotly's scale Viridis at equal steps.
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

/// The colour that a chart names: a token of the palette, a mixture of two, or the colour itself.
pub(super) fn colour(text: &str) -> String {
    let inside = |prefix| text.strip_prefix(prefix).and_then(|rest: &str| rest.strip_suffix(')'));
    if let Some(name) = inside("var(") {
        return property(name).to_owned();
    }
    let Some(parts) = inside("mix(") else { return text.to_owned() };
    let parts: Vec<&str> = parts.split(',').collect();
    match parts.as_slice() {
        [from, to, share] => {
            hex(between(channels(property(from)), channels(property(to)), share.parse().unwrap_or(0.0)))
        }
        _ => text.to_owned(),
    }
}

/// The colour at `share` of the scale of colours.
pub(super) fn of_scale(share: f64) -> String {
    let last = VIRIDIS.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let below = (place as usize).min(last - 1);
    hex(between(VIRIDIS[below], VIRIDIS[below + 1], place - below as f64))
}

/// A custom property of the style sheet, the first of its name, which is that in the light.
fn property(name: &str) -> &'static str {
    let start = STYLE.find(&format!("{name}:")).map(|at| &STYLE[at + name.len() + 1..]);
    start.and_then(|rest| rest.split(';').next()).unwrap_or("#000000").trim()
}

fn channels(hex: &str) -> [u8; 3] {
    [1, 3, 5].map(|at| hex.get(at..at + 2).and_then(|two| u8::from_str_radix(two, 16).ok()).unwrap_or(0))
}

fn between(from: [u8; 3], to: [u8; 3], share: f64) -> [u8; 3] {
    [0, 1, 2].map(|i| (f64::from(from[i]) + (f64::from(to[i]) - f64::from(from[i])) * share).round() as u8)
}

fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_those_of_the_page() {
        assert_eq!(colour("var(--pinion)"), "#005f9e");
        assert_eq!(colour("var(--pinion-fill)"), "rgba(0, 95, 158, 0.10)");
        assert_eq!(colour("mix(--pinion,--wheel,0.000)"), "#005f9e");
        assert_eq!(colour("mix(--pinion,--wheel,0.500)"), "#5a534f");
        assert_eq!(colour("#ff5a36"), "#ff5a36");
        assert_eq!([of_scale(-1.0), of_scale(0.5), of_scale(2.0)], ["#440154", "#21918c", "#fde725"]);
    }
}
