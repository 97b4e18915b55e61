//! The program `gearwear`: a thin shell over the library of the same name.

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
