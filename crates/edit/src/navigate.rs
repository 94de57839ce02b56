//! Looking around: what drags, the wheel and a trackpad do to the camera, in the habits of three kinds of hands.

use glam::Vec2;
use rig::Camera;

/// Whose habits looking around follows. Whatever the preset, a drag that begins beside the figure turns the view, with
/// Shift it slides it, and the middle and the right button do so over the figure as well.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Preset {
    /// Middle button turns, with Shift slides, with Ctrl zooms; the wheel zooms.
    #[default]
    Blender,
    /// The same, and with Alt: left button turns, middle slides, right zooms.
    Maya,
    /// Two fingers turn, with Shift slide, with Ctrl or pinching zoom.
    Trackpad,
}

impl Preset {
    /// All of them.
    pub const ALL: [Preset; 3] = [Preset::Blender, Preset::Maya, Preset::Trackpad];

    /// What it is called.
    pub const fn name(self) -> &'static str {
        match self {
            Preset::Blender => "Blender",
            Preset::Maya => "Maya",
            Preset::Trackpad => "Trackpad",
        }
    }

    /// What it does, in one line.
    pub const fn explained(self) -> &'static str {
        match self {
            Preset::Blender => {
                "Middle drag turns, Shift+middle slides, Ctrl+middle zooms, the wheel zooms to the pointer"
            }
            Preset::Maya => {
                "Alt+left drag turns, Alt+middle slides, Alt+right zooms, the wheel zooms to the pointer"
            }
            Preset::Trackpad => {
                "Two fingers turn, Shift and two fingers slide, a pinch or Ctrl and two fingers zoom"
            }
        }
    }
}

/// A button of the pointer.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Button {
    /// Mostly the left one.
    Primary,
    /// The wheel.
    Middle,
    /// Mostly the right one.
    Secondary,
}

/// Keys that are down while the pointer acts.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Keys {
    /// Shift.
    pub shift: bool,
    /// Ctrl, or Command on a Mac.
    pub ctrl: bool,
    /// Alt, or Option.
    pub alt: bool,
}

/// What a drag does to the view.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Motion {
    /// Turns it about its target.
    Orbit,
    /// Slides it.
    Pan,
    /// Goes nearer or farther.
    Zoom,
}

/// What the pointer did. Places and distances are in the picture's own units, points or pixels, y down.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ViewEvent {
    /// A button went down.
    Pressed {
        /// Which one.
        button: Button,
        /// The keys then.
        keys: Keys,
        /// Where.
        at: Vec2,
        /// Whether something lies there that the primary button would take hold of.
        on_figure: bool,
    },
    /// The pointer moved.
    Moved {
        /// How far.
        by: Vec2,
    },
    /// The button went up, or the drag was taken away.
    Released,
    /// The wheel turned, or two fingers slid over a trackpad.
    Scrolled {
        /// How far what lies under the pointer should follow.
        by: Vec2,
        /// The keys then.
        keys: Keys,
        /// Where the pointer was.
        at: Vec2,
    },
    /// Two fingers went apart or together.
    Pinched {
        /// Above 1 the picture grows.
        factor: f32,
        /// Where the pointer was.
        at: Vec2,
    },
}

/// Turns what the pointer does into moves of a camera.
///
/// ```
/// use edit::{Button, Keys, Motion, Navigator, Preset, ViewEvent};
/// use glam::Vec2;
/// let (mut navigator, mut camera) = (Navigator::default(), rig::Camera::default());
/// let pressed = ViewEvent::Pressed {
///     button: Button::Middle, keys: Keys::default(), at: Vec2::ZERO, on_figure: true,
/// };
/// let size = Vec2::new(1280.0, 800.0);
/// assert!(navigator.take(pressed, Preset::Blender, &mut camera, size));
/// assert_eq!(navigator.motion(), Some(Motion::Orbit));
/// navigator.take(ViewEvent::Moved { by: Vec2::new(-100.0, 0.0) }, Preset::Blender, &mut camera, size);
/// assert!(camera.yaw_rad > 0.5, "what one drags to the left shows its other side");
/// ```
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Navigator {
    held: Option<Held>,
}

#[derive(Clone, Copy, PartialEq, Debug)]
struct Held {
    motion: Motion,
    button: Button,
    /// The point of the world that zooming keeps in its place.
    toward: glam::Vec3,
}

const ORBIT_RAD_PER_POINT: f32 = 0.008;
const ZOOM_PER_POINT: f32 = 0.006;
const ZOOM_PER_SCROLLED_POINT: f32 = 0.0025;

impl Navigator {
    /// What the drag does that is under way; `None` without one.
    pub fn motion(&self) -> Option<Motion> {
        self.held.map(|held| held.motion)
    }

    /// Takes an event of a picture of that size; says whether the view takes it. What it doesn't take is for the
    /// figure: a press of the primary button on it, and moves without a drag of the view. Numbers that are not finite
    /// change nothing.
    pub fn take(&mut self, event: ViewEvent, preset: Preset, camera: &mut Camera, size: Vec2) -> bool {
        match event {
            ViewEvent::Pressed { button, keys, at, on_figure } => {
                let toward = camera.point_under(at, size);
                self.held =
                    motion(preset, button, keys, on_figure).map(|motion| Held { motion, button, toward });
                self.held.is_some()
            }
            ViewEvent::Moved { by } => self.held.is_some_and(|held| held.follow(by, preset, camera, size)),
            ViewEvent::Released => self.held.take().is_some(),
            ViewEvent::Scrolled { by, keys, at } => scroll(by, keys, preset, camera, (at, size)),
            ViewEvent::Pinched { factor, at } => {
                camera.zoom(1.0 / factor, camera.point_under(at, size));
                true
            }
        }
    }
}

impl Held {
    fn follow(self, by: Vec2, preset: Preset, camera: &mut Camera, size: Vec2) -> bool {
        match self.motion {
            Motion::Orbit => orbit(camera, by),
            Motion::Pan => camera.pan(by, size.y),
            Motion::Zoom => {
                // Maya's users drag to the right, Blender's upward.
                let sideways = preset == Preset::Maya && self.button == Button::Secondary;
                let farther = if sideways { by.y - by.x } else { by.y };
                camera.zoom((farther * ZOOM_PER_POINT).exp(), self.toward);
            }
        }
        true
    }
}

/// What a drag with that button does; `None` where it is the figure's.
fn motion(preset: Preset, button: Button, keys: Keys, on_figure: bool) -> Option<Motion> {
    match (preset, button) {
        (Preset::Maya, Button::Primary) if keys.alt => Some(Motion::Orbit),
        (Preset::Maya, Button::Middle) if keys.alt => Some(Motion::Pan),
        (Preset::Maya, Button::Secondary) if keys.alt => Some(Motion::Zoom),
        (_, Button::Primary) if on_figure => None,
        _ if keys.shift => Some(Motion::Pan),
        (_, Button::Middle) if keys.ctrl => Some(Motion::Zoom),
        _ => Some(Motion::Orbit),
    }
}

fn orbit(camera: &mut Camera, by: Vec2) {
    camera.orbit(-by.x * ORBIT_RAD_PER_POINT, by.y * ORBIT_RAD_PER_POINT);
}

fn scroll(by: Vec2, keys: Keys, preset: Preset, camera: &mut Camera, (at, size): (Vec2, Vec2)) -> bool {
    match preset {
        Preset::Trackpad if keys.shift => camera.pan(by, size.y),
        Preset::Trackpad if !keys.ctrl => orbit(camera, by),
        _ => camera.zoom((-by.y * ZOOM_PER_SCROLLED_POINT).exp(), camera.point_under(at, size)),
    }
    true
}

/// One press of a key that moves the camera.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Step {
    /// The camera goes to its left about the target.
    Left,
    /// To its right.
    Right,
    /// Up.
    Up,
    /// Down.
    Down,
    /// Toward the target.
    Nearer,
    /// Away from it.
    Farther,
}

/// Turned so far by one press.
const STEP_RAD: f32 = 15.0 * std::f32::consts::PI / 180.0;
const STEP_ZOOM: f32 = 0.8;

impl Step {
    /// Moves the camera by one step.
    pub fn apply(self, camera: &mut Camera) {
        match self {
            Step::Left => camera.orbit(-STEP_RAD, 0.0),
            Step::Right => camera.orbit(STEP_RAD, 0.0),
            Step::Up => camera.orbit(0.0, STEP_RAD),
            Step::Down => camera.orbit(0.0, -STEP_RAD),
            Step::Nearer => camera.zoom(STEP_ZOOM, camera.target),
            Step::Farther => camera.zoom(1.0 / STEP_ZOOM, camera.target),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Vec2 = Vec2::new(1280.0, 800.0);
    const AT: Vec2 = Vec2::new(400.0, 300.0);
    const NONE: Keys = Keys { shift: false, ctrl: false, alt: false };
    const SHIFT: Keys = Keys { shift: true, ..NONE };
    const CTRL: Keys = Keys { ctrl: true, ..NONE };
    const ALT: Keys = Keys { alt: true, ..NONE };

    fn press(button: Button, keys: Keys, on_figure: bool) -> ViewEvent {
        ViewEvent::Pressed { button, keys, at: AT, on_figure }
    }

    /// (State, events, state): a fresh navigator and camera, then where they are.
    fn after(preset: Preset, events: &[ViewEvent]) -> (Navigator, Camera) {
        let (mut navigator, mut camera) = (Navigator::default(), Camera::default());
        for &event in events {
            navigator.take(event, preset, &mut camera, SIZE);
        }
        (navigator, camera)
    }

    /// What happened to the camera, told from its numbers alone.
    fn moved(camera: &Camera) -> Option<Motion> {
        let was = Camera::default();
        match (camera.distance != was.distance, camera.yaw_rad != 0.0 || camera.pitch_rad != 0.0) {
            (true, _) => Some(Motion::Zoom),
            (_, true) => Some(Motion::Orbit),
            _ => (camera.target != was.target).then_some(Motion::Pan),
        }
    }

    #[test]
    fn each_preset_s_buttons_do_what_its_users_expect() {
        use Button::{Middle, Primary, Secondary};
        use Motion::{Orbit, Pan, Zoom};
        // Preset, button, keys, then beside the figure and on it.
        let table = [
            (Preset::Blender, Middle, NONE, Some(Orbit), Some(Orbit)),
            (Preset::Blender, Middle, SHIFT, Some(Pan), Some(Pan)),
            (Preset::Blender, Middle, CTRL, Some(Zoom), Some(Zoom)),
            (Preset::Blender, Primary, NONE, Some(Orbit), None),
            (Preset::Blender, Primary, SHIFT, Some(Pan), None),
            (Preset::Blender, Primary, ALT, Some(Orbit), None),
            (Preset::Blender, Secondary, NONE, Some(Orbit), Some(Orbit)),
            (Preset::Maya, Primary, ALT, Some(Orbit), Some(Orbit)),
            (Preset::Maya, Middle, ALT, Some(Pan), Some(Pan)),
            (Preset::Maya, Secondary, ALT, Some(Zoom), Some(Zoom)),
            (Preset::Maya, Primary, NONE, Some(Orbit), None),
            (Preset::Maya, Primary, SHIFT, Some(Pan), None),
            (Preset::Trackpad, Primary, NONE, Some(Orbit), None),
            (Preset::Trackpad, Primary, SHIFT, Some(Pan), None),
            (Preset::Trackpad, Secondary, SHIFT, Some(Pan), Some(Pan)),
        ];
        for (preset, button, keys, beside, on) in table {
            for (on_figure, expected) in [(false, beside), (true, on)] {
                let by = Vec2::new(40.0, -25.0);
                let events = [press(button, keys, on_figure), ViewEvent::Moved { by }];
                let (navigator, camera) = after(preset, &events);
                let case = format!("{preset:?} {button:?} {keys:?}, on the figure: {on_figure}");
                assert_eq!(navigator.motion(), expected, "{case}");
                assert_eq!(moved(&camera), expected, "{case}");
            }
        }
    }

    #[test]
    fn wheels_zoom_and_two_fingers_turn_slide_or_zoom() {
        let scroll = |keys| ViewEvent::Scrolled { by: Vec2::new(6.0, 30.0), keys, at: AT };
        for preset in [Preset::Blender, Preset::Maya] {
            for keys in [NONE, CTRL] {
                assert_eq!(moved(&after(preset, &[scroll(keys)]).1), Some(Motion::Zoom));
            }
        }
        for (keys, motion) in [(NONE, Motion::Orbit), (SHIFT, Motion::Pan), (CTRL, Motion::Zoom)] {
            assert_eq!(moved(&after(Preset::Trackpad, &[scroll(keys)]).1), Some(motion));
        }
        for preset in Preset::ALL {
            let (_, camera) = after(preset, &[ViewEvent::Pinched { factor: 1.25, at: AT }]);
            assert!((camera.distance - Camera::default().distance / 1.25).abs() < 1e-5);
        }
    }

    #[test]
    fn zooming_keeps_what_is_under_the_pointer() {
        let was = Camera::default();
        let point = was.point_under(AT, SIZE);
        let up = ViewEvent::Moved { by: Vec2::new(0.0, -60.0) };
        let right = ViewEvent::Moved { by: Vec2::new(60.0, 0.0) };
        let cases = [
            (Preset::Blender, vec![ViewEvent::Scrolled { by: Vec2::new(0.0, 90.0), keys: NONE, at: AT }]),
            (Preset::Trackpad, vec![ViewEvent::Pinched { factor: 1.4, at: AT }]),
            (Preset::Blender, vec![press(Button::Middle, CTRL, true), up, up]),
            (Preset::Maya, vec![press(Button::Secondary, ALT, true), right, right]),
        ];
        for (preset, events) in cases {
            let (_, camera) = after(preset, &events);
            assert!(camera.distance < was.distance * 0.9, "{preset:?}: it comes nearer");
            assert!((camera.pixel_of(point, SIZE).unwrap() - AT).length() < 0.1, "{preset:?}");
        }
    }

    #[test]
    fn a_drag_ends_with_its_button_and_moves_alone_do_nothing() {
        let by = Vec2::new(40.0, 10.0);
        let events = [press(Button::Middle, NONE, true), ViewEvent::Released, ViewEvent::Moved { by }];
        assert_eq!(after(Preset::Blender, &events), (Navigator::default(), Camera::default()));
        let (mut navigator, mut camera) = (Navigator::default(), Camera::default());
        let mut taken = |event| navigator.take(event, Preset::Blender, &mut camera, SIZE);
        assert!(!taken(ViewEvent::Moved { by }) && !taken(ViewEvent::Released));
        assert!(!taken(press(Button::Primary, NONE, true)), "that one is the figure's");
        assert!(taken(press(Button::Primary, NONE, false)) && taken(ViewEvent::Moved { by }));
        assert!(taken(ViewEvent::Released));
    }

    #[test]
    fn sliding_keeps_the_point_under_the_pointer() {
        let was = Camera::default();
        let point = was.point_under(AT, SIZE);
        let by = Vec2::new(55.0, -31.0);
        let (_, camera) =
            after(Preset::Blender, &[press(Button::Middle, SHIFT, false), ViewEvent::Moved { by }]);
        assert!((camera.pixel_of(point, SIZE).unwrap() - AT - by).length() < 0.05);
    }

    #[test]
    fn steps_turn_by_fifteen_degrees_and_undo_one_another() {
        let turned = |steps: &[Step]| {
            let mut camera = Camera::default();
            steps.iter().for_each(|step| step.apply(&mut camera));
            camera
        };
        assert!((turned(&[Step::Right; 6]).yaw_rad.to_degrees() - 90.0).abs() < 1e-3, "to the figure's left");
        assert!((turned(&[Step::Up; 2]).pitch_rad.to_degrees() - 30.0).abs() < 1e-3);
        for (there, back) in
            [(Step::Left, Step::Right), (Step::Up, Step::Down), (Step::Nearer, Step::Farther)]
        {
            let camera = turned(&[there, back]);
            let was = Camera::default();
            let off =
                (camera.yaw_rad.abs() + camera.pitch_rad.abs()).max((camera.distance - was.distance).abs());
            assert!(off < 1e-5 && turned(&[there]) != was);
        }
    }

    #[test]
    fn bad_numbers_change_nothing() {
        for preset in Preset::ALL {
            for keys in [NONE, SHIFT, CTRL] {
                let events = [
                    press(Button::Middle, keys, false),
                    ViewEvent::Moved { by: Vec2::NAN },
                    ViewEvent::Scrolled { by: Vec2::NAN, keys, at: AT },
                    ViewEvent::Scrolled { by: Vec2::ONE, keys: CTRL, at: Vec2::NAN },
                    ViewEvent::Pinched { factor: f32::NAN, at: AT },
                    ViewEvent::Pinched { factor: 0.0, at: AT },
                ];
                let (_, camera) = after(preset, &events);
                assert_eq!(camera, Camera::default(), "{preset:?} {keys:?}");
            }
        }
    }
}
