//! Tables of the documentation that take minutes: `cargo test --release --lib NAME -- --ignored --nocapture` prints one.

mod fem_benchmark;
mod fzg_test_search;
mod work_precision;
