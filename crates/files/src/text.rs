//! Text of files from other programs, in the encodings they write: UTF-8 or UTF-16 with or without a byte order mark, and Latin-1, of which every
//! byte is a letter of the same number (ISO 8859-1). Windows-1252 differs from it at quotation marks and dashes alone.

/// Text of `bytes`: UTF-16 where they begin with its mark, UTF-8 where they are that, and Latin-1 otherwise; without the mark.
pub fn decode(bytes: &[u8]) -> String {
    let utf_16 = |unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes[2..].chunks_exact(2).map(|two| unit([two[0], two[1]])).collect();
        String::from_utf16_lossy(&units)
    };
    match bytes {
        [0xFF, 0xFE, ..] => utf_16(u16::from_le_bytes),
        [0xFE, 0xFF, ..] => utf_16(u16::from_be_bytes),
        [0xEF, 0xBB, 0xBF, rest @ ..] => decode(rest),
        _ => match std::str::from_utf8(bytes) {
            Ok(text) => text.to_owned(),
            Err(_) => bytes.iter().copied().map(char::from).collect(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_words_in_every_encoding() {
        let words = "Wälzlänge [mm];Höhe [µm]";
        let latin: Vec<u8> = words.chars().map(|letter| letter as u8).collect();
        let marked = |mark: [u8; 2], bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
            mark.into_iter().chain(words.encode_utf16().flat_map(bytes)).collect()
        };
        let with_mark = format!("\u{feff}{words}").into_bytes();
        let of_words = [
            words.as_bytes().to_vec(),
            with_mark,
            latin,
            marked([0xFF, 0xFE], u16::to_le_bytes),
            marked([0xFE, 0xFF], u16::to_be_bytes),
        ];
        assert!(of_words.iter().all(|bytes| decode(bytes) == words));
        assert_eq!(decode(&[0xFF]), "ÿ");
    }
}
