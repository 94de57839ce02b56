//! Every check of the project: the tests, and around them formatting, lints and documentation.

use std::process::Command;

use anyhow::Result;

use crate::display::VirtualDisplay;
use crate::machine;
use crate::stages::{Stages, cargo};

/// `cargo xtask test`: everything that can be tested on this machine.
///
/// Two runs of one build: Cargo does not do documentation tests together with all other targets.
///
/// # Errors
/// The first stage that fails.
pub fn test() -> Result<()> {
    let mut stages = Stages::default();
    machine::prepare(&[machine::WINDOW, machine::WINDOW_TEST].concat());
    let mut all = on_software_vulkan(cargo(["test", "--workspace", "--all-targets", "--no-fail-fast"]));
    let display = give_display(&mut all)?;
    stages.run("tests", &mut all)?;
    drop(display);
    let mut doc = on_software_vulkan(cargo(["test", "--workspace", "--doc", "--no-fail-fast"]));
    stages.run("documentation tests", &mut doc)
}

/// `cargo xtask lint`: formatting, lints, documentation.
///
/// # Errors
/// The first stage that fails.
pub fn lint() -> Result<()> {
    let mut stages = Stages::default();
    stages.run("formatting", &mut cargo(["fmt", "--all", "--check"]))?;
    stages.run("lints", &mut cargo(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]))?;
    let mut doc = cargo(["doc", "--workspace", "--no-deps"]);
    stages.run("documentation", doc.env("RUSTDOCFLAGS", "-D warnings"))
}

/// Makes wgpu take Vulkan where Mesa's software driver is installed.
///
/// Pictures are compared with stored ones to the pixel, and software Vulkan draws the same everywhere.
/// Left to choose, wgpu falls back to OpenGL when the Vulkan driver is broken, and draws slightly
/// differently: with the choice made here a broken driver is an error that says so. `WGPU_BACKEND` from
/// outside wins.
fn on_software_vulkan(mut command: Command) -> Command {
    if machine::has_software_vulkan() && std::env::var_os("WGPU_BACKEND").is_none() {
        command.env("WGPU_BACKEND", "vulkan");
    }
    command
}

/// Gives the window test a display of its own for as long as the returned value lives.
///
/// Where there could be one but is none (a Debian without Xvfb), the test is asked for all the same, and
/// fails; on other systems it is left out.
fn give_display(command: &mut Command) -> Result<Option<VirtualDisplay>> {
    // Never the developer's own screen: the test moves the pointer and types.
    for own in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(own);
    }
    if !machine::has_program("Xvfb") {
        if machine::has_program("apt-get") {
            eprintln!("Xvfb is missing: the window test will fail.");
            command.env("POSEWRIGHT_WINDOW_TEST", "1");
        } else {
            println!("Xvfb is missing: the window test is left out.");
        }
        return Ok(None);
    }
    let display = VirtualDisplay::start()?;
    command.env("DISPLAY", display.name()).env("POSEWRIGHT_WINDOW_TEST", "1");
    Ok(Some(display))
}
