//! The program `posewright`.

use std::process::ExitCode;

fn main() -> ExitCode {
    // Adapters that are tried and not there are no news; what fails in the end is said by the command itself.
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("error,wgpu_hal=off")).init();
    app::cli::main()
}
