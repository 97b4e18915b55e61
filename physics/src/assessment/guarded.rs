//! Containment of panics in work whose failure must not end the rest: one row of a sweep, one run of a validation case.

use std::panic::{AssertUnwindSafe, catch_unwind};

/// Result of `work`, or the message of its panic.
pub fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        let text = panic.downcast_ref::<&str>().copied();
        let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
        text.unwrap_or("no message was given").to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_said_in_words() {
        assert_eq!(guarded(|| 3), Ok(3));
        assert_eq!(guarded(|| -> u8 { panic!("no {}", 7) }), Err("no 7".to_owned()));
        assert_eq!(guarded(|| -> u8 { std::panic::panic_any(1) }), Err("no message was given".to_owned()));
    }
}
