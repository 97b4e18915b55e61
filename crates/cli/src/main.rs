//! The program `gearwear`.

fn main() -> std::process::ExitCode {
    gearwear_cli::main()
}
