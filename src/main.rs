//! The program `gearwear`: the command line of the library of the same name.

fn main() -> std::process::ExitCode {
    gearwear::program()
}
