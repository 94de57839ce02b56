//! A target dragged over a surface lies on it, and what is held goes along with it.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::Arc;

use edit::{At, By, Command, Editor, Hold, NoFiles, Request, SkinPicker, Snap, Surfaces, nearest_space};
use glam::{DVec3, Vec3};
use rig::{Articulator, Bone, Dof, Limb, Palette, Ray, Space, bone_of_place, parse_pose, skin_positions};

const READY: &str = r#"(version: 1, hips: (0.0, 0.91, 0.0), joints: {
    "leftUpperArm": (flexion: 35.0, abduction: -50.0), "leftLowerArm": (flexion: 80.0, twist: -70.0),
    "rightUpperArm": (flexion: 35.0, abduction: -50.0), "rightLowerArm": (flexion: 80.0, twist: -110.0),
    "leftUpperLeg": (flexion: 15.0), "leftLowerLeg": (flexion: 30.0), "leftFoot": (flexion: 15.0),
    "rightUpperLeg": (flexion: 15.0), "rightLowerLeg": (flexion: 30.0), "rightFoot": (flexion: 15.0),
})"#;

const SEATED: &str = r#"(version: 1, hips: (0.0, 0.5, 0.0), joints: {
    "leftUpperArm": (flexion: 35.0, abduction: -50.0), "leftLowerArm": (flexion: 60.0, twist: -70.0),
    "leftUpperLeg": (flexion: 90.0), "leftLowerLeg": (flexion: 90.0),
    "rightUpperLeg": (flexion: 90.0), "rightLowerLeg": (flexion: 90.0),
})"#;

const SQUAT: &str = r#"(version: 1, hips: (0.0, 0.35, 0.0), joints: {
    "hips": (flexion: 50.0), "spine": (flexion: 25.0), "chest": (flexion: 20.0), "leftUpperArm": (flexion: 35.0, abduction: -60.0), "leftLowerArm": (flexion: 20.0),
    "leftUpperLeg": (flexion: 110.0), "leftLowerLeg": (flexion: 140.0),
    "rightUpperLeg": (flexion: 110.0), "rightLowerLeg": (flexion: 140.0),
})"#;

struct Scene {
    editor: Editor,
    picker: SkinPicker,
}

impl Scene {
    fn new(pose: &str) -> Scene {
        let figure = Arc::new(interchange::figure::mannequin().unwrap());
        let pose = parse_pose(pose).unwrap().onto(&figure.rest_pose());
        let picker = SkinPicker::new(figure.skin.as_ref().unwrap());
        let mut editor = Editor::new(figure);
        editor.submit(Request::Open(Box::new(pose)), &mut NoFiles).unwrap();
        Scene { editor, picker }
    }

    fn run(&mut self, command: Command) {
        self.editor.submit(Request::Do(command), &mut NoFiles).unwrap();
    }

    fn articulate(&mut self, limb: Limb, name: &str) {
        self.run(Command::Articulate { limb, at: At::Named(name.to_owned()) });
    }

    fn surfaces(&self, limb: Limb) -> Surfaces {
        let editor = &self.editor;
        let at = editor.figure().articulator(editor.pose(), limb);
        self.surfaces_at(limb, at)
    }

    fn surfaces_at(&self, limb: Limb, at: Articulator) -> Surfaces {
        let editor = &self.editor;
        let (pose, evaluation) = (editor.pose(), editor.evaluation());
        Surfaces::of(editor.figure(), pose, evaluation, Some(&self.picker), limb, at, true)
    }

    fn snap(&self, limb: Limb, ray: Ray) -> Option<Snap> {
        self.surfaces(limb).snap(self.editor.figure(), Some(&self.picker), ray)
    }

    /// Drags a limb's target there and lets go.
    fn drag(&mut self, limb: Limb, ray: Ray) -> Snap {
        let snap = self.snap(limb, ray).unwrap();
        self.editor.submit(Request::PreviewAll(snap.commands()), &mut NoFiles).unwrap();
        self.editor.submit(Request::Commit, &mut NoFiles).unwrap();
        snap
    }

    fn articulator(&self, limb: Limb) -> DVec3 {
        self.editor.evaluation().limbs[limb.index()].articulator
    }

    /// How high over the skin of some bones a point is: by every triangle, with the nearest corner's own side counted
    /// from the whole fan of faces about it.
    fn height(&self, point: DVec3, counts: impl Fn(Bone) -> bool) -> f64 {
        let mesh = self.editor.figure().skin.as_ref().unwrap();
        let rest = Bone::ALL.map(|bone| self.editor.figure().skeleton.rest_position(bone));
        let palette = Palette::new(&self.editor.evaluation().frames, &rest);
        let skin = skin_positions(mesh, &palette);
        let of = |vertex: u32| {
            let (joints, weights) = (mesh.joints[vertex as usize], mesh.weights[vertex as usize]);
            bone_of_place(usize::from(joints[(0..4).max_by_key(|&i| weights[i]).unwrap()]))
        };
        let mut nearest = (f64::INFINITY, 1.0);
        for triangle in mesh.indices.chunks_exact(3).filter(|t| t.iter().all(|&v| counts(of(v)))) {
            let [a, b, c] = [0, 1, 2].map(|i| skin[triangle[i] as usize].as_dvec3());
            let normal = (b - a).cross(c - a).normalize_or_zero();
            // A fine grid over the triangle, whose edges are a centimetre or so: good to a tenth of a millimetre.
            for (i, j) in (0..=16).flat_map(|i| (0..=16 - i).map(move |j| (i, j))) {
                let place = a + (b - a) * (f64::from(i) / 16.0) + (c - a) * (f64::from(j) / 16.0);
                let distance = place.distance(point);
                if distance < nearest.0 {
                    nearest = (distance, (point - place).dot(normal).signum());
                }
            }
        }
        nearest.0 * nearest.1
    }
}

/// From straight ahead toward a place of the figure.
fn from_front(at: DVec3) -> Ray {
    Ray { origin: at.as_vec3() + Vec3::Z * 4.0, direction: -Vec3::Z }
}

fn from_above(at: DVec3) -> Ray {
    Ray { origin: at.as_vec3() + Vec3::Y * 4.0, direction: -Vec3::Y }
}

/// A fingertip may be this far off the skin, and this far inside, metres.
const OFF_M: f64 = 0.005;
const INSIDE_M: f64 = 0.002;

fn check_on(scene: &Scene, limb: Limb, bone: Bone, what: &str) {
    let missed = scene.editor.evaluation().limbs[limb.index()].residual;
    let height = scene.height(scene.articulator(limb), |b| Limb::of(b) != Some(limb));
    assert!(missed < 1e-6, "{what}: {missed} m missed");
    assert!((-INSIDE_M..OFF_M).contains(&height), "{what}: {height} m over the skin of {bone}");
}

fn turn(joint: Bone, dof: Dof, degrees: f64) -> Command {
    Command::Turn { joint, dof, degrees, by: By::Delta }
}

/// Small moves of all that carries a body: after each the tip must still be there.
fn stir(scene: &mut Scene, limb: Limb, bone: Bone, what: &str) {
    check_on(scene, limb, bone, what);
    for (name, command) in [
        ("the spine bends", turn(Bone::Spine, Dof::Flexion, 8.0)),
        ("the chest turns", turn(Bone::Chest, Dof::Twist, -10.0)),
        ("the head nods", turn(Bone::Head, Dof::Flexion, 8.0)),
        ("the head turns", turn(Bone::Head, Dof::Twist, 10.0)),
        ("the hips shift", Command::MoveHips { by: DVec3::new(0.03, -0.02, 0.02) }),
    ] {
        scene.run(command);
        check_on(scene, limb, bone, &format!("{what}, {name}"));
    }
}

#[test]
fn a_fingertip_stays_on_nose_and_chin_while_the_body_moves() {
    for (name, height) in [("nose", 0.06), ("chin", -0.01)] {
        let mut scene = Scene::new(READY);
        scene.articulate(Limb::LeftArm, "indexTip");
        let head = scene.editor.evaluation().frames[Bone::Head].position;
        let snap = scene.drag(Limb::LeftArm, from_front(head + DVec3::Y * height));
        assert!(matches!(snap.space, Space::Body(Bone::Head | Bone::Jaw)), "{:?}", snap.space);
        let Space::Body(bone) = snap.space else { return };
        assert_eq!(scene.editor.pose().limb(Limb::LeftArm).contact.target().unwrap().0, snap.space);
        stir(&mut scene, Limb::LeftArm, bone, name);
    }
}

#[test]
fn a_fingertip_stays_on_the_other_palm_while_that_arm_moves() {
    let mut scene = Scene::new(READY);
    scene.articulate(Limb::LeftArm, "indexTip");
    let palm = scene.articulator(Limb::RightArm);
    let frame = scene.editor.evaluation().frames[Bone::RightHand];
    // The palm's own normal points down in the joint's frame: look at it from there.
    let eye = palm - frame.vector(DVec3::Y) * 0.5;
    let ray = Ray { origin: eye.as_vec3(), direction: (palm - eye).normalize().as_vec3() };
    let snap = scene.drag(Limb::LeftArm, ray);
    assert_eq!(snap.space, Space::Body(Bone::RightHand));
    check_on(&scene, Limb::LeftArm, Bone::RightHand, "palm");
    scene.run(turn(Bone::RightLowerArm, Dof::Flexion, 10.0));
    check_on(&scene, Limb::LeftArm, Bone::RightHand, "palm, the other elbow bends");
    scene.run(turn(Bone::RightHand, Dof::Flexion, 12.0));
    check_on(&scene, Limb::LeftArm, Bone::RightHand, "palm, the other wrist bends");
    scene.run(turn(Bone::UpperChest, Dof::Twist, 8.0));
    check_on(&scene, Limb::LeftArm, Bone::RightHand, "palm, the chest turns");
}

#[test]
fn a_palm_and_a_wrist_lie_on_a_thigh() {
    for name in ["palm", "wrist", "middleTip"] {
        let mut scene = Scene::new(SEATED);
        scene.articulate(Limb::LeftArm, name);
        let frames = &scene.editor.evaluation().frames;
        let thigh = frames[Bone::LeftUpperLeg].position.lerp(frames[Bone::LeftLowerLeg].position, 0.55);
        let snap = scene.drag(Limb::LeftArm, from_above(thigh));
        assert_eq!(snap.space, Space::Body(Bone::LeftUpperLeg));
        let clearance = snap.target_in_world.distance(snap.surface_in_world);
        assert_eq!(clearance > 0.01, name == "wrist", "{name}: {clearance}");
        let height = |scene: &Scene| {
            scene.height(scene.articulator(Limb::LeftArm), |b| Limb::of(b) == Some(Limb::LeftLeg))
        };
        for command in [
            turn(Bone::LeftUpperLeg, Dof::Abduction, 6.0),
            turn(Bone::Spine, Dof::Flexion, 10.0),
            Command::MoveHips { by: DVec3::new(0.02, 0.03, -0.02) },
        ] {
            let over = height(&scene);
            assert!(scene.editor.evaluation().limbs[0].residual < 1e-6, "{name}");
            assert!((over - clearance).abs() < INSIDE_M, "{name}: {over} over the thigh, not {clearance}");
            scene.run(command);
        }
    }
}

#[test]
fn a_fingertip_on_the_ground_holds_on_to_the_world() {
    let mut scene = Scene::new(SQUAT);
    scene.articulate(Limb::LeftArm, "middleTip");
    let shoulder = scene.editor.evaluation().frames[Bone::LeftUpperArm].position;
    let place = DVec3::new(shoulder.x + 0.2, 0.0, shoulder.z + 0.25);
    let snap = scene.drag(Limb::LeftArm, from_above(place));
    assert_eq!((snap.space, snap.normal_in_world), (Space::World, DVec3::Y));
    let tip = scene.articulator(Limb::LeftArm);
    assert!(tip.distance(place) < 1e-3 && tip.y >= 0.0, "{tip} {place}");
    scene.run(Command::MoveHips { by: DVec3::new(0.0, 0.04, 0.02) });
    assert!(scene.articulator(Limb::LeftArm).distance(tip) < 1e-6, "it stays while the hips move");
}

#[test]
fn a_foot_on_the_ground_stands_on_its_sole() {
    for (name, height) in [("ankle", 0.05), ("heel", 0.0), ("ball", 0.0), ("toeTip", 0.0)] {
        let mut scene = Scene::new(READY);
        scene.articulate(Limb::LeftLeg, name);
        let snap = scene.drag(Limb::LeftLeg, from_above(DVec3::new(0.2, 0.0, 0.1)));
        assert_eq!(snap.space, Space::World, "{name}");
        let y = scene.articulator(Limb::LeftLeg).y;
        assert!((height..height + 0.06).contains(&(y + 1e-9)), "{name} is {y} over the ground");
        let rest = Scene::new("(version: 1)").editor;
        let at = rest.figure().articulators[Limb::LeftLeg.index()][name];
        assert!((rest.figure().skeleton.rest_position(at.bone).y + at.at.y - y).abs() < 1e-6, "{name}");
    }
}

#[test]
fn a_planted_foot_goes_to_a_knee_and_stays_planted() {
    let mut scene = Scene::new(READY);
    scene.articulate(Limb::LeftLeg, "ankle");
    scene.run(Command::Keep { limb: Limb::LeftLeg, contact: Hold::Planted, space: Space::World });
    let knee = scene.editor.evaluation().frames[Bone::RightLowerLeg].position;
    let side = Ray { origin: (knee + DVec3::X * 3.0).as_vec3(), direction: -Vec3::X };
    let snap = scene.drag(Limb::LeftLeg, side);
    assert!(matches!(snap.space, Space::Body(b) if Limb::of(b) == Some(Limb::RightLeg)), "{:?}", snap.space);
    let contact = scene.editor.pose().limb(Limb::LeftLeg).contact;
    assert!(matches!(contact, rig::Contact::Planted { space, .. } if space == snap.space));
    let height = scene.height(scene.articulator(Limb::LeftLeg), |b| Limb::of(b) == Some(Limb::RightLeg));
    let clearance = snap.target_in_world.distance(snap.surface_in_world);
    assert!(clearance > 0.02, "the ankle is inside the foot: {clearance}");
    assert!((height - clearance).abs() < OFF_M, "{height} {clearance}");
}

#[test]
fn what_is_out_of_reach_is_let_alone() {
    let scene = Scene::new("(version: 1)");
    let frames = &scene.editor.evaluation().frames;
    let foot = frames[Bone::RightFoot].position;
    assert_eq!(scene.snap(Limb::LeftArm, from_front(foot)), None, "a foot");
    assert_eq!(scene.snap(Limb::LeftArm, from_above(DVec3::new(1.5, 0.0, 1.5))), None, "the ground");
    assert_eq!(scene.snap(Limb::LeftLeg, from_above(DVec3::new(2.0, 0.0, 0.0))), None, "the ground far off");
    let bent = Scene::new(READY);
    assert!(bent.snap(Limb::LeftLeg, from_above(DVec3::new(0.2, 0.0, 0.1))).is_some(), "the ground near");
    for up in [Vec3::Y, Vec3::X, Vec3::NAN, Vec3::ZERO] {
        assert_eq!(scene.snap(Limb::LeftArm, Ray { origin: Vec3::new(9.0, 1.0, 9.0), direction: up }), None);
    }
}

#[test]
fn a_limb_does_not_snap_to_itself_nor_to_what_holds_on_to_it() {
    let mut scene = Scene::new(READY);
    let hand = scene.articulator(Limb::LeftArm);
    let on_hand = |scene: &Scene, limb| scene.snap(limb, from_front(hand)).map(|snap| snap.space);
    let left_hand = |space| matches!(space, Some(Space::Body(b)) if Limb::of(b) == Some(Limb::LeftArm));
    assert!(left_hand(on_hand(&scene, Limb::RightArm)));
    assert!(!left_hand(on_hand(&scene, Limb::LeftArm)), "its own hand");
    scene.run(Command::Keep {
        limb: Limb::LeftArm,
        contact: Hold::Point,
        space: Space::Body(Bone::RightHand),
    });
    assert!(!left_hand(on_hand(&scene, Limb::RightArm)), "it would go round in a circle");
    assert!(left_hand(on_hand(&scene, Limb::LeftLeg)) || on_hand(&scene, Limb::LeftLeg).is_none());
}

#[test]
fn a_drag_that_leaves_the_surface_ends_as_if_it_had_never_been_there() {
    let mut scene = Scene::new(READY);
    scene.articulate(Limb::LeftArm, "indexTip");
    let to = scene.articulator(Limb::LeftArm) + DVec3::new(0.02, 0.05, 0.0);
    let reach = || vec![Command::Reach { limb: Limb::LeftArm, to: edit::Goal::World(to) }];
    let mut other = Editor::in_pose(scene.editor.figure().clone(), scene.editor.pose().clone());
    other.submit(Request::PreviewAll(reach()), &mut NoFiles).unwrap();
    let head = scene.editor.evaluation().frames[Bone::Head].position;
    let snap = scene.snap(Limb::LeftArm, from_front(head)).unwrap();
    scene.editor.submit(Request::PreviewAll(snap.commands()), &mut NoFiles).unwrap();
    assert_ne!(scene.editor.pose(), other.pose());
    scene.editor.submit(Request::PreviewAll(reach()), &mut NoFiles).unwrap();
    assert_eq!(scene.editor.pose(), other.pose());
}

#[test]
fn a_grabbed_place_of_the_skin_has_no_clearance_and_a_joint_has() {
    let scene = Scene::new(READY);
    let editor = &scene.editor;
    let mesh = editor.figure().skin.as_ref().unwrap();
    let rest = Bone::ALL.map(|bone| editor.figure().skeleton.rest_position(bone));
    let frames = &editor.evaluation().frames;
    let palette = Palette::new(frames, &rest);
    let chest = from_front(frames[Bone::UpperChest].position);
    let clearance = |at: Articulator| {
        let snap = scene.surfaces_at(Limb::RightArm, at).snap(editor.figure(), Some(&scene.picker), chest);
        snap.map(|snap| snap.target_in_world.distance(snap.surface_in_world)).unwrap()
    };
    let mut grabbed = 0;
    for step in 0..40 {
        let along = f64::from(step) / 40.0;
        let place = frames[Bone::RightLowerArm].position.lerp(scene.articulator(Limb::RightArm), along);
        let hit = scene.picker.pick_of(mesh, &palette, frames, from_front(place), |b| {
            Limb::of(b) == Some(Limb::RightArm) && b > Bone::RightLowerArm
        });
        let Some(hit) = hit else { continue };
        grabbed += 1;
        let found = clearance(Articulator { bone: hit.bone, at: hit.point_in_bone });
        assert!(found < 1e-5, "{:?}: {found}", hit.bone);
    }
    assert!(grabbed > 3, "{grabbed}");
    let names = &editor.figure().articulators[Limb::RightArm.index()];
    for (name, at) in names {
        let found = clearance(*at);
        assert_eq!(found > 0.008, name == "wrist", "{name}: {found}");
    }
}

#[test]
fn a_contact_begun_on_the_body_holds_on_to_that_bone_and_a_foot_on_the_ground_to_the_world() {
    let space = |scene: &Scene, limb| {
        let editor = &scene.editor;
        nearest_space(editor.figure(), editor.pose(), editor.evaluation(), Some(&scene.picker), limb)
    };
    let mut scene = Scene::new(READY);
    scene.articulate(Limb::LeftArm, "indexTip");
    assert_eq!(space(&scene, Limb::LeftArm), Space::World, "in the air");
    let head = scene.editor.evaluation().frames[Bone::Head].position;
    let snap = scene.drag(Limb::LeftArm, from_front(head + DVec3::Y * 0.06));
    assert_eq!(space(&scene, Limb::LeftArm), snap.space);
    let away = Command::Reach { limb: Limb::LeftArm, to: edit::Goal::Offset(DVec3::new(0.0, 0.0, 0.012)) };
    scene.run(away);
    assert_eq!(space(&scene, Limb::LeftArm), Space::World, "twelve millimetres before the nose");
    // Feet side by side on the ground, the ankles well inside them.
    let standing = Scene::new("(version: 1)");
    for leg in [Limb::LeftLeg, Limb::RightLeg] {
        assert_eq!(space(&standing, leg), Space::World);
    }
    let mut scene = Scene::new(READY);
    let knee = scene.editor.evaluation().frames[Bone::RightLowerLeg].position;
    let shin = knee - DVec3::Y * 0.1;
    let side = Ray { origin: (shin + DVec3::X * 3.0).as_vec3(), direction: -Vec3::X };
    let snap = scene.drag(Limb::LeftLeg, side);
    assert_eq!(space(&scene, Limb::LeftLeg), snap.space, "a foot on the other knee");
}
