//! The `darzi` program.

fn main() -> std::process::ExitCode {
    darzi::cli::main()
}
