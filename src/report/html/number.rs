//! Numbers as an engineering document prints them: a few significant digits, a true minus sign, thin spaces between
//! thousands.

/// `value` with `digits` significant digits; integers keep all of theirs up to a million. "–" where not finite.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    if value == 0.0 {
        return "0".into();
    }
    let (mantissa, exponent) = scientific(value, digits);
    let unsigned = if (-4..6).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        grouped(&format!("{:.decimals$}", value.abs()))
    } else {
        format!("{mantissa}\u{2009}×\u{2009}10{}", superscript(exponent))
    };
    if value < 0.0 { format!("−{unsigned}") } else { unsigned }
}

/// A result: four significant digits, three below one.
pub fn figure(value: f64) -> String {
    significant(value, if value.abs() < 1.0 { 3 } else { 4 })
}

/// A length or an angle of the geometry, to so many decimals.
pub fn fixed(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    let text = format!("{:.decimals$}", value.abs());
    let negative = value < 0.0 && text.bytes().any(|digit| (b'1'..=b'9').contains(&digit));
    format!("{}{}", if negative { "−" } else { "" }, grouped(&text))
}

/// As many of seven significant digits as it takes: what the user gave.
pub fn given(value: f64) -> String {
    up_to_digits(value, 7)
}

/// A time in hours, which may be one of revolutions: as many of five significant digits as it takes.
pub fn hours(value: f64) -> String {
    up_to_digits(value, 5)
}

fn up_to_digits(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (mantissa, power) = text.split_at(text.find('\u{2009}').unwrap_or(text.len()));
    if mantissa.contains('.') {
        format!("{}{power}", mantissa.trim_end_matches('0').trim_end_matches('.'))
    } else {
        text
    }
}

/// Share as a percentage, three significant digits.
pub fn percent(share: f64) -> String {
    format!("{}\u{202f}%", significant(share * 100.0, 3))
}

/// Change from `before` to `after` as a signed percentage; "–" where there is nothing to compare with.
pub fn change(before: f64, after: f64) -> String {
    let change = (after / before - 1.0) * 100.0;
    if !change.is_finite() {
        return "–".into();
    }
    let sign = if change > 0.0 { "+" } else { "" };
    // To a tenth of a per cent at the most: the rest is not the wear's.
    let rounded = if change.abs() < 10.0 { (change * 10.0).round() / 10.0 } else { change.round() };
    if rounded == 0.0 {
        return "0\u{202f}%".into();
    }
    format!("{sign}{}\u{202f}%", given(rounded))
}

/// A count of revolutions: "1.15 million", "82 000".
pub fn revolutions(value: f64) -> String {
    if value.is_finite() && value.abs() >= 1e6 {
        format!("{} million", given((value / 1e6 * 1e3).round() / 1e3))
    } else {
        given(value.round())
    }
}

/// A count, thousands set apart.
pub fn count(value: u64) -> String {
    grouped(&value.to_string())
}

/// Rounded for a plot, which needs no more digits than a screen has points.
pub fn plotted(value: f64) -> f64 {
    if value.abs() < 1e-100 || !value.is_finite() {
        return if value.is_finite() { 0.0 } else { value };
    }
    let scale = 10f64.powi(5 - value.abs().log10().floor() as i32);
    (value * scale).round() / scale
}

pub fn to_digits(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}

/// Mantissa and exponent after rounding to `digits`.
fn scientific(value: f64, digits: usize) -> (String, i32) {
    let text = format!("{:.*e}", digits.saturating_sub(1), value.abs());
    match text.split_once('e') {
        Some((mantissa, exponent)) => (mantissa.into(), exponent.parse().unwrap_or(0)),
        None => (text, 0),
    }
}

/// Thousands set apart by narrow spaces, from five digits on.
fn grouped(digits: &str) -> String {
    let (whole, fraction) = digits.split_once('.').map_or((digits, None), |(w, f)| (w, Some(f)));
    let mut text = String::new();
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && whole.len() > 4 && (whole.len() - i).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    if let Some(fraction) = fraction {
        text.push('.');
        text.push_str(fraction);
    }
    text
}

/// As small raised digits.
pub fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let sign = if exponent < 0 { "⁻" } else { "" };
    let digits = exponent.unsigned_abs().to_string();
    sign.chars().chain(digits.bytes().map(|d| DIGITS[usize::from(d - b'0')])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits_and_thousands() {
        assert_eq!(significant(1655.83, 4), "1656");
        assert_eq!(significant(543210.0, 4), "543\u{202f}210");
        assert_eq!(significant(999.96, 4), "1000");
        assert_eq!(significant(-0.012345, 3), "−0.0123");
        assert_eq!(significant(0.0, 4), "0");
        assert_eq!(significant(-6e-5, 2), "−6.0\u{2009}×\u{2009}10⁻⁵");
        assert_eq!(significant(1.5e12, 3), "1.50\u{2009}×\u{2009}10¹²");
        assert_eq!(significant(f64::NAN, 4), "–");
    }

    #[test]
    fn given_values_keep_their_digits() {
        assert_eq!(given(127.75), "127.75");
        assert_eq!(given(0.25), "0.25");
        assert_eq!(given(100.0), "100");
        assert_eq!(given(1e-19), "1\u{2009}×\u{2009}10⁻¹⁹");
        assert_eq!(hours(6e5 / 9000.0), "66.667");
        assert_eq!(revolutions(1.149_75e6), "1.15 million");
        assert_eq!(revolutions(82_000.0), "82\u{202f}000");
        assert_eq!(revolutions(0.0), "0");
    }

    #[test]
    fn fixed_decimals_know_no_negative_zero() {
        assert_eq!(fixed(-6e-5, 3), "0.000");
        assert_eq!(fixed(-0.0123, 3), "−0.012");
        assert_eq!(fixed(118.36, 3), "118.360");
        assert_eq!(fixed(f64::INFINITY, 3), "–");
    }

    #[test]
    fn changes_are_signed_and_rounded() {
        assert_eq!(change(1000.0, 900.0), "−10\u{202f}%");
        assert_eq!(change(1000.0, 1034.0), "+3.4\u{202f}%");
        assert_eq!(change(1000.0, 1000.1), "0\u{202f}%");
        assert_eq!(change(0.0, 1.0), "–");
    }

    #[test]
    fn plotted_values_keep_six_digits() {
        assert_eq!(plotted(34.123_456_78), 34.1235);
        assert_eq!(plotted(0.0), 0.0);
        assert_eq!(plotted(-1.234_567_8e-9), -1.234_57e-9);
    }
}
