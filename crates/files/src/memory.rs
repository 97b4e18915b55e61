//! Memory asked for before work begins: without it, what needs much would end in an abort of the process in the middle of the work.

use std::hint::black_box;

/// Whether `bytes` more can be had now, as far as the system says so before they are used: limits of the process and of the address space count,
/// memory that others take meanwhile does not.
pub fn can_be_had(bytes: u64) -> bool {
    let mut asked: Vec<u8> = Vec::new();
    let is_had = usize::try_from(bytes).is_ok_and(|bytes| asked.try_reserve_exact(bytes).is_ok());
    black_box(asked);
    is_had
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kilobyte_can_be_had_and_half_the_address_space_cannot() {
        assert!(can_be_had(1 << 10));
        assert!(!can_be_had(u64::MAX / 2));
    }
}
