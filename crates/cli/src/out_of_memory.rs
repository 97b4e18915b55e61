//! Memory that the linear algebra asks for in the middle of a command and cannot have: one line and exit status 3, as of other failures.
//!
//! The dense matrices of faer panic there, and what they say has the name of their error. Temporary files go as the panic unwinds.

use std::any::Any;
use std::panic::{self, AssertUnwindSafe};

use super::failure::Failure;

/// Name of faer's error.
const NAME: &str = "AllocError";

/// Exit status of `command`, which is a failure of its own where memory lacks.
pub(super) fn guarded(command: impl FnOnce() -> u8) -> u8 {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if !lacks_memory(info.payload()) {
            usual(info);
        }
    }));
    panic::catch_unwind(AssertUnwindSafe(command)).unwrap_or_else(|said| {
        if !lacks_memory(said.as_ref()) {
            panic::resume_unwind(said);
        }
        let failure =
            Failure::Memory("the matrices take more memory than can be had; a coarser mesh takes less".to_owned());
        let status = failure.exit_status();
        failure.print();
        status
    })
}

fn lacks_memory(said: &(dyn Any + Send)) -> bool {
    said.downcast_ref::<String>().is_some_and(|said| said.contains(NAME))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_memory_that_lacks_is_a_failure() {
        assert_eq!(guarded(|| 7), 7);
        assert_eq!(guarded(|| panic!("called `Result::unwrap()` on an `Err` value: {NAME}")), 3);
        assert!(panic::catch_unwind(|| guarded(|| panic!("anything else"))).is_err());
    }
}
