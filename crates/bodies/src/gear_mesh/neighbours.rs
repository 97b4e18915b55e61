//! Search for points near a place, each with its element length: one grid of squares for every power of two of the lengths.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use nalgebra::Vector2;

/// Greatest difference of level of two points near each other: lengths change slowly with place.
const FACTOR_LEVELS: i32 = 2;

/// Level, column and row of a square.
type Square = (i32, i64, i64);
/// A point and its length.
type Placed = (Vector2<f64>, f64);

/// Points by square.
#[derive(Debug, Default)]
pub(super) struct Neighbours {
    /// Looked up by key alone, so that no result depends on the order of the map.
    squares: HashMap<Square, Vec<Placed>, BuildHasherDefault<SquareHasher>>,
}

/// Quick hash of the numbers of a square, which nobody chooses to collide: each is turned in and multiplied by the odd number next to 2⁶⁴ over the golden
/// ratio (D. E. Knuth, *The Art of Computer Programming* 3, section 6.4).
#[derive(Debug, Default)]
struct SquareHasher(u64);

impl Hasher for SquareHasher {
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|byte| self.write_u64(u64::from(*byte)));
    }

    fn write_u64(&mut self, number: u64) {
        self.0 = (self.0.rotate_left(26) ^ number).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }

    fn write_i32(&mut self, number: i32) {
        self.write_u64(number as u64);
    }

    fn write_i64(&mut self, number: i64) {
        self.write_u64(number as u64);
    }

    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }
}

/// Power of two below a length; bounded, so that arithmetic with levels cannot overflow.
fn level(length_mm: f64) -> i32 {
    length_mm.log2().floor().clamp(-100.0, 100.0) as i32
}

/// Column or row of the square at a coordinate: squares of a level are as wide as its longest length.
fn square(level: i32, coordinate: f64) -> i64 {
    (coordinate / 2f64.powi(level + 1)).floor() as i64
}

impl Neighbours {
    /// Adds a point.
    pub(super) fn add(&mut self, point: Vector2<f64>, length_mm: f64) {
        let level = level(length_mm);
        self.squares
            .entry((level, square(level, point.x), square(level, point.y)))
            .or_default()
            .push((point, length_mm));
    }

    /// Whether `point`, of element length `length_mm`, is nearer to another than `part` (below 1) of their mean length.
    pub(super) fn crowds(&self, point: Vector2<f64>, length_mm: f64, part: f64) -> bool {
        let own = level(length_mm);
        (own - FACTOR_LEVELS..=own + FACTOR_LEVELS).any(|level| {
            let reach = 0.5 * part * (length_mm + 2f64.powi(level + 1));
            let columns = square(level, point.x - reach)..=square(level, point.x + reach);
            columns.into_iter().any(|x| {
                (square(level, point.y - reach)..=square(level, point.y + reach)).any(|y| {
                    self.squares.get(&(level, x, y)).is_some_and(|points| {
                        points.iter().any(|(other, length)| {
                            (point - other).norm_squared() < (0.5 * part * (length_mm + length)).powi(2)
                        })
                    })
                })
            })
        })
    }
}
