//! Pictures as PNG (ISO/IEC 15948).

use std::io::Write as _;

use flate2::write::ZlibEncoder;
use flate2::{Compression, Crc};

use super::palette::of_scale;

/// The level of an empty cell.
pub(super) const NO_LEVEL: u8 = 255;
/// Levels of the scale of colours.
pub(super) const LEVELS: usize = 255;

/// The types of PNG's pixels that are used.
const INDEXED: u8 = 3;
const COLOURS: u8 = 6;

/// Levels of the scale of colours, row by row.
pub(super) fn of_levels(columns: usize, levels: &[u8]) -> Vec<u8> {
    let colours = (0..LEVELS).flat_map(|level| of_scale(level as f64 / (LEVELS - 1) as f64));
    let palette: Vec<u8> = colours.chain([0; 3]).collect();
    let opacity: Vec<u8> = (0..=NO_LEVEL).map(|level| if level == NO_LEVEL { 0 } else { 255 }).collect();
    encoded(columns, 1, INDEXED, &[(b"PLTE", palette), (b"tRNS", opacity)], levels)
}

/// Red, green, blue and opacity of each pixel, row by row.
pub(super) fn of_pixels(columns: usize, pixels: &[u8]) -> Vec<u8> {
    encoded(columns, 4, COLOURS, &[], pixels)
}

fn encoded(columns: usize, bytes: usize, kind: u8, before: &[(&[u8; 4], Vec<u8>)], pixels: &[u8]) -> Vec<u8> {
    let row = (columns * bytes).max(1);
    let mut data = ZlibEncoder::new(Vec::new(), Compression::default());
    for row in pixels.chunks(row) {
        // Each row as it is, without a filter. Writing into memory does not fail.
        let _ = data.write_all(&[0]).and_then(|()| data.write_all(row));
    }
    let size = [columns, pixels.len() / row].map(|pixels| (pixels as u32).to_be_bytes());
    let header = [&size[0][..], &size[1][..], &[8, kind, 0, 0, 0]].concat();
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    chunk(&mut file, b"IHDR", &header);
    before.iter().for_each(|(name, data)| chunk(&mut file, name, data));
    chunk(&mut file, b"IDAT", &data.finish().unwrap_or_default());
    chunk(&mut file, b"IEND", &[]);
    file
}

fn chunk(file: &mut Vec<u8>, name: &[u8; 4], data: &[u8]) {
    let mut crc = Crc::new();
    crc.update(name);
    crc.update(data);
    file.extend((data.len() as u32).to_be_bytes());
    file.extend(name);
    file.extend(data);
    file.extend(crc.sum().to_be_bytes());
}
