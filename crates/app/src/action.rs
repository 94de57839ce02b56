//! Everything that the program can be asked to do by a key, a menu or a button, each with its words and its keys.

/// What actions have in common, as the menus and the sheet of keys show them.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Group {
    /// Poses on disk, and the program itself.
    File,
    /// Steps and the clipboard.
    Edit,
    /// Which joint is meant.
    Selection,
    /// Changes of the pose.
    Pose,
    /// From where the figure is seen.
    View,
    /// What the window shows.
    Window,
    /// Keys that count only while the figure walks.
    Walk,
    /// Keys that count only while the pointer drags the figure.
    Drag,
}

impl Group {
    /// All, in the order of the sheet.
    pub const ALL: [Group; 8] = [
        Group::File,
        Group::Edit,
        Group::Selection,
        Group::Pose,
        Group::View,
        Group::Window,
        Group::Walk,
        Group::Drag,
    ];

    /// The heading.
    pub const fn words(self) -> &'static str {
        match self {
            Group::File => "File",
            Group::Edit => "Edit",
            Group::Selection => "Selection",
            Group::Pose => "Pose",
            Group::View => "View",
            Group::Window => "Window",
            Group::Walk => "While walking",
            Group::Drag => "While dragging",
        }
    }
}

macro_rules! actions {
    ($($group:ident { $($name:ident: $words:literal, $explained:literal, [$($chord:literal),*];)* })*) => {
        /// Something that the program can be asked to do.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        pub enum Action { $($(#[doc = $explained] $name,)*)* }

        impl Action {
            /// All, group by group.
            pub const ALL: &'static [Action] = &[$($(Action::$name,)*)*];

            /// The name in the file of keys; it stays.
            pub const fn name(self) -> &'static str {
                match self { $($(Action::$name => stringify!($name),)*)* }
            }

            /// The words of menus and of the sheet.
            pub const fn words(self) -> &'static str {
                match self { $($(Action::$name => $words,)*)* }
            }

            /// One sentence more, for tips.
            pub const fn explained(self) -> &'static str {
                match self { $($(Action::$name => $explained,)*)* }
            }

            /// Where it belongs.
            pub const fn group(self) -> Group {
                match self { $($(Action::$name => Group::$group,)*)* }
            }

            /// The keys that it has until the user gives it others.
            pub const fn default_keys(self) -> &'static [&'static str] {
                match self { $($(Action::$name => &[$($chord),*],)*)* }
            }
        }
    };
}

actions! {
    File {
        New: "New", "A new pose: the figure stands relaxed.", ["Ctrl+N"];
        Open: "Open…", "Opens a pose, or a robot or chain in place of the figure.", ["Ctrl+O"];
        Save: "Save", "Saves the pose to its file.", ["Ctrl+S"];
        SaveAs: "Save as…", "Saves the pose to another file.", ["Ctrl+Shift+S"];
        SavePicture: "Save picture…", "Saves what the view shows: a still, or the view turning around the figure.", ["F12"];
        Settings: "Settings…", "Look, navigation and keys.", ["Ctrl+Comma"];
        Quit: "Quit", "Ends the program.", ["Ctrl+Q"];
    }
    Edit {
        Undo: "Undo", "Takes the last step back.", ["Ctrl+Z"];
        Redo: "Redo", "Does the step again that was taken back.", ["Ctrl+Shift+Z", "Ctrl+Y"];
        Copy: "Copy", "Copies the chosen parts of the pose as text; nothing chosen: all.", ["Ctrl+C"];
        Paste: "Paste", "Takes the copied parts on.", ["Ctrl+V"];
        PasteMirrored: "Paste mirrored", "Takes the copied parts on, on the other side.", ["Ctrl+Shift+V"];
    }
    Selection {
        Parent: "Parent joint", "The joint that carries the chosen one.", ["["];
        Child: "Child joint", "The joint that the chosen one carries.", ["]"];
        NextJoint: "Next joint", "The next joint along the skeleton.", ["Tab"];
        PreviousJoint: "Previous joint", "The joint before along the skeleton.", ["Shift+Tab"];
        NextOfLevel: "Next beside", "The same joint of the next finger, or of the other side.", ["Ctrl+]"];
        PreviousOfLevel: "Previous beside", "The same joint of the finger before, or of the other side.", ["Ctrl+["];
        SelectNone: "Nothing", "Chooses no joint.", ["Alt+A"];
    }
    Pose {
        CycleContact: "Free, point, planted", "The next kind of contact for the chosen limb.", ["P"];
        ClearRotation: "Clear rotation", "The angles of the chosen joints back to 0.", ["Alt+R"];
        ClearPlace: "Clear place", "Chosen hips back to their place, a chosen limb free; nothing chosen: the figure to the middle.", ["Alt+G"];
        Flip: "Flip elbow or knee", "The chosen limb takes its other bend, where it is in range.", ["Alt+F"];
        Lock: "Lock joint", "The chosen joints keep their angles, or no longer.", ["L"];
        Symmetry: "Symmetry", "What one side does, the other does as well.", ["Shift+M"];
        Mirror: "Mirror", "The mirror image of the chosen parts; nothing chosen: the whole pose.", ["Ctrl+M"];
        Reset: "Reset", "The chosen parts back to rest; nothing chosen: the whole figure.", ["Ctrl+Alt+R"];
        StandOnGround: "Stand on the ground", "Brings the feet to the ground, the hips as little lower as that needs.", ["G"];
        Balance: "Balance", "Shifts the hips so that the centre of mass is over the feet.", ["B"];
        Ranges: "Ranges", "Whether joints stop at the ranges of a human body.", ["Shift+L"];
    }
    View {
        Front: "Front", "Seen from the front.", ["1"];
        Back: "Back", "Seen from the back.", ["Ctrl+1"];
        Left: "Left", "Seen from the figure's left.", ["3"];
        Right: "Right", "Seen from the figure's right.", ["Ctrl+3"];
        Top: "Top", "Seen from above.", ["7"];
        Bottom: "Bottom", "Seen from below.", ["Ctrl+7"];
        ThreeQuarter: "Three-quarter", "Seen from the front and left, a little above.", ["Alt+1"];
        Opposite: "Opposite", "Seen from the other side.", ["9"];
        Projection: "Orthographic", "No perspective: farther is as large.", ["5"];
        OrbitLeft: "Turn left", "Turns the view by 15° to the left.", ["4"];
        OrbitRight: "Turn right", "Turns the view by 15° to the right.", ["6"];
        OrbitUp: "Turn up", "Turns the view by 15° upward.", ["8"];
        OrbitDown: "Turn down", "Turns the view by 15° downward.", ["2"];
        ZoomIn: "Nearer", "Goes nearer by a step.", ["Plus", "PageUp"];
        ZoomOut: "Farther", "Goes farther away by a step.", ["Minus", "PageDown"];
        FrameSelection: "Frame the selection", "Brings the chosen joint into the picture.", ["F", "Period"];
        FrameAll: "Frame all", "Brings the whole figure into the picture.", ["Home"];
        StudioLook: "Studio", "The figure in its own colours under studio lights.", [];
        ClayLook: "Clay", "The figure in sculptor's clay.", [];
        MatcapLook: "Matcap", "The figure in wax, in a light that goes with the view.", [];
        FlatLook: "Flat tones", "The figure in flat tones, one for each part of the body.", [];
        LineLook: "Line drawing", "The figure as a drawing with a pen.", [];
        NextLook: "Next look", "The next of these looks.", ["K"];
        JointPlanes: "Joint planes", "The figure in wood tones with grooves at the joints, as a lay figure.", ["Shift+K"];
        AmbientOcclusion: "Ambient occlusion", "Darkens creases and where parts meet.", [];
        LookThroughPictureCamera: "Through the picture camera", "Looks through the picture camera, or no longer.", ["0"];
        SetPictureCamera: "Set the picture camera", "The picture camera takes the present view.", ["Ctrl+Alt+0"];
    }
    Window {
        Walk: "Walk", "The figure walks over a ground, steered by keys; its pose stays as it is.", ["F5"];
        SecondView: "Second view", "A small second view from the side.", ["V"];
        Marks: "Marks", "Joints, articulators and targets over the figure.", ["M"];
        Library: "Library", "The library of poses at the right.", ["N"];
        Panel: "Body and sliders", "The panel at the left.", ["T"];
        Theme: "Light or dark", "Changes between the light and the dark look.", [];
        LargerUi: "Larger controls", "Makes text and controls larger.", ["Ctrl+Plus", "Ctrl+Equals"];
        SmallerUi: "Smaller controls", "Makes text and controls smaller.", ["Ctrl+Minus"];
        ResetUi: "Controls at 100 %", "Text and controls at their own size.", ["Ctrl+0"];
        Controls: "Keyboard to the controls", "Puts the keyboard on the first control; Tab then goes on, Esc comes back.", ["F6"];
        Help: "All gestures and keys", "What every key and gesture does.", ["F1", "?"];
    }
    Walk {
        SteerAhead: "Ahead", "Walks ahead as long as the key is down.", ["W", "Up"];
        SteerBack: "Backward", "Walks backward as long as the key is down.", ["S", "Down"];
        SteerLeft: "Steer left", "Turns to the figure's left as long as the key is down.", ["A", "Left"];
        SteerRight: "Steer right", "Turns to the figure's right as long as the key is down.", ["D", "Right"];
        StrafeLeft: "Strafe left", "Steps to the figure's left as long as the key is down.", ["Q", "Shift+Left"];
        StrafeRight: "Strafe right", "Steps to the figure's right as long as the key is down.", ["E", "Shift+Right"];
        WalkAlone: "By itself", "Walks ahead at the chosen speed while no key steers.", ["H"];
        WalkSit: "Sit down", "Sits down, or stands up again.", ["C"];
        WalkPlay: "Play", "Lets time run, or halts it.", ["Space"];
        WalkStep: "Single step", "Halts, and goes on by a single step of time.", ["Shift+Space"];
        WalkSlower: "Slow motion", "Time at a half, a quarter, a tenth, and again at its own pace.", ["Comma"];
        WalkRestart: "From the start", "Begins anew where the walk began.", ["R"];
        WalkPlacement: "Foot placement", "Whether feet are placed on the ground, or walk as on flat ground.", ["O"];
        WalkBeside: "Side by side", "The same walk twice: without foot placement at the left, with it at the right.", ["Shift+O"];
        WalkFollow: "Camera follows", "Whether the view goes along with the figure.", ["Shift+F"];
        TakePose: "Take this pose", "The walking figure's pose becomes the pose, as one step.", ["Enter"];
    }
    Drag {
        AlongX: "Along X", "Only along the world's X; again: freely.", ["X"];
        AlongY: "Along Y", "Only along the world's Y, which is up; again: freely.", ["Y"];
        AlongZ: "Along Z", "Only along the world's Z, which is forward; again: freely.", ["Z"];
        AcrossX: "Across X", "Not along X: in the plane across it; again: freely.", ["Shift+X"];
        AcrossY: "Across Y", "Not along Y: in the plane across it; again: freely.", ["Shift+Y"];
        AcrossZ: "Across Z", "Not along Z: in the plane across it; again: freely.", ["Shift+Z"];
        TurnInContact: "Turn in contact", "Held on a ring: hand or foot turns about its articulator, which stays.", ["C"];
    }
}

impl Action {
    /// The action of a name.
    pub fn of_name(name: &str) -> Option<Action> {
        Action::ALL.iter().copied().find(|action| action.name() == name)
    }

    /// The actions of a group, in order.
    pub fn of_group(group: Group) -> impl Iterator<Item = Action> {
        Action::ALL.iter().copied().filter(move |action| action.group() == group)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_their_own_and_lead_back() {
        for action in Action::ALL {
            assert_eq!(Action::of_name(action.name()), Some(*action));
            assert!(action.explained().ends_with('.'), "{action:?}");
        }
        assert_eq!(Action::of_name("save"), None);
    }

    #[test]
    fn no_two_have_the_same_words() {
        let mut words: Vec<&str> = Action::ALL.iter().map(|action| action.words()).collect();
        words.sort_unstable();
        words.dedup();
        assert_eq!(words.len(), Action::ALL.len());
    }
}
