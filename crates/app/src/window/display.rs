//! Opens the connection to a display, or says in one sentence what is missing.

use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};

use winit::event_loop::EventLoop;

use crate::failure::Failure;

const NO_DISPLAY: &str =
    "no display: set DISPLAY or WAYLAND_DISPLAY, or use `posewright render` which needs none";
const NO_LIBRARIES: &str = "the display's libraries are missing: on Debian or Ubuntu, \
                            apt install libxkbcommon-x11-0 libxcursor1 libxi6";

/// The event loop of a window.
///
/// # Errors
/// No display, or none of the libraries that speak to one.
pub fn event_loop<T: 'static>() -> Result<EventLoop<T>, Failure> {
    // A missing library is a panic in winit, and its words would come before ours.
    let hook = take_hook();
    set_hook(Box::new(|_| {}));
    let built = catch_unwind(AssertUnwindSafe(|| EventLoop::<T>::with_user_event().build()));
    set_hook(hook);
    match built {
        Ok(Ok(event_loop)) => Ok(event_loop),
        Ok(Err(error)) => {
            log::info!("{error}");
            Err(Failure::NoScreen(of_error(&error.to_string())))
        }
        Err(_) => Err(Failure::NoScreen(NO_LIBRARIES.to_owned())),
    }
}

/// A library that can't be loaded is an error of some backends and a panic of others. The error begins with a place in
/// winit's source, which tells nothing.
fn of_error(message: &str) -> String {
    let reason = message.split_once(": ").map_or(message, |(_, reason)| reason).to_lowercase();
    let about_library = reason.contains("librar") || reason.contains("failed to load");
    if about_library { NO_LIBRARIES } else { NO_DISPLAY }.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_library_is_told_from_a_missing_display() {
        let place = "os error at Library/winit/src/linux/mod.rs:788";
        let library = format!("{place}: Failed to load one of xlib's shared libraries");
        assert_eq!(of_error(&library), NO_LIBRARIES);
        let display = format!("{place}: neither WAYLAND_DISPLAY nor WAYLAND_SOCKET nor DISPLAY is set.");
        assert_eq!(of_error(&display), NO_DISPLAY);
    }
}
