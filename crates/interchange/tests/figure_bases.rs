//! Figure files based on others, and the bodies that they give.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use interchange::figure::{self, FigureError};
use rig::{Body, BodySlider, Figure};

type Files<'a> = &'a [(&'a str, &'a str)];

fn opened(figure: &str, files: Files<'_>) -> Result<figure::Opened, FigureError> {
    let mut fetch = |name: &str| {
        let found = files.iter().find(|(file, _)| *file == name);
        found.map(|(_, text)| text.as_bytes().to_vec()).ok_or_else(|| format!("no file \"{name}\""))
    };
    figure::open(figure, &mut fetch)
}

fn fault(figure: &str, files: Files<'_>) -> String {
    opened(figure, files).expect_err("a fault").named("poses/own.figure.ron").to_string()
}

const LIBRARY: &str = "base: \"library:mannequin.figure.ron\"";

fn mannequin() -> Figure {
    figure::mannequin().unwrap()
}

#[test]
fn what_is_not_written_is_the_base_s() {
    let text = format!(
        "(version: 1, {LIBRARY}, name: \"own\", cones: {{\"leftUpperLeg\": (axis: (0, -1, 0), half_angle: 90)}},
          articulators: {{\"leftArm\": {{\"thumbTip\": (bone: \"leftHand\", at: (0.1, 0.0, 0.0))}}}},
          handshapes: {{\"own\": {{\"leftIndexDistal\": (flexion: 5)}}}})"
    );
    let own = opened(&text, &[]).unwrap().figure;
    let base = mannequin();
    assert_eq!(own.name, "own");
    assert_eq!(own.skin, base.skin);
    assert_eq!(own.handshapes.len(), base.handshapes.len() + 1);
    assert_eq!(own.articulators[0]["palm"], base.articulators[0]["palm"]);
    assert_eq!(own.articulators[0]["thumbTip"].at.x, 0.1);
    assert_eq!(own.articulators[1]["thumbTip"].at.x, -0.1, "the right arm takes the left one's");
    assert!(own.limbs != base.limbs);
    let same = format!("(version: 1, {LIBRARY})");
    assert_eq!(opened(&same, &[]).unwrap().figure, base);
}

#[test]
fn bodies_add_up_slider_by_slider() {
    let tall = format!("(version: 1, {LIBRARY}, name: \"tall\", body: (stature: 1.9, sex: 0.5))");
    let own = "(version: 1, base: \"kin/tall.figure.ron\", body: (sex: -0.25))";
    let body = opened(own, &[("kin/tall.figure.ron", &tall)]).unwrap().body;
    let wanted = Body::AS_IS.with(BodySlider::Stature, 1.9).with(BodySlider::Sex, -0.25);
    assert_eq!(body, wanted);
}

#[test]
fn faults_are_told_in_the_file_that_has_them() {
    let body = |value: &str| fault(&format!("(version: 1, {LIBRARY},\n  body: (\n    {value},\n  ))"), &[]);
    assert_eq!(
        body("stature: 9.0"),
        "poses/own.figure.ron:3:5: stature of the body is 9, expected 0.3 to 3 metres"
    );
    assert!(body("build: -1.5").contains(":3:5: build of the body is -1.5, expected -1 to 1"));
    assert!(body("heads: inf").contains("heads of the body is inf, expected 3 to 10"));
    let unknown = body("wings: 2.0");
    assert!(
        unknown.contains(":3:") && unknown.contains("wings") && unknown.contains("shoulders"),
        "{unknown}"
    );

    let own = "(version: 1, base: \"kin/broad.figure.ron\")";
    let broad = format!("(version: 1, {LIBRARY},\n body: (hips: 2.0))");
    let told = fault(own, &[("kin/broad.figure.ron", &broad)]);
    assert_eq!(told, "poses/kin/broad.figure.ron:2:9: hips of the body is 2, expected 0.7 to 1.3");

    assert_eq!(
        fault("(version: 1,\n base: \"gone.figure.ron\")", &[]),
        "poses/own.figure.ron:2:2: \"gone.figure.ron\": no file \"gone.figure.ron\""
    );
    let near = fault("(version: 1, base: \"library:chil.figure.ron\")", &[]);
    assert!(near.contains("did you mean \"library:child.figure.ron\"?"), "{near}");
    let nameless = fault("(version: 1)", &[]);
    assert!(nameless.contains("skeleton") && nameless.contains("base"), "{nameless}");
}

#[test]
fn bases_in_a_circle_or_too_deep_are_told() {
    let (a, b) = ("(version: 1, base: \"b.ron\")", "(version: 1,\n base: \"a.ron\")");
    let told = fault(a, &[("a.ron", a), ("b.ron", b)]);
    assert!(told.contains("in a circle: b.ron -> a.ron -> b.ron"), "{told}");
    assert!(told.starts_with("poses/a.ron:1:14: "), "{told}");
    let chain: Vec<(String, String)> =
        (0..12).map(|i| (format!("{i}.ron"), format!("(version: 1, base: \"{}.ron\")", i + 1))).collect();
    let files: Vec<(&str, &str)> = chain.iter().map(|(n, t)| (n.as_str(), t.as_str())).collect();
    let told = fault("(version: 1, base: \"0.ron\")", &files);
    assert!(told.contains("more than 8 figure files"), "{told}");
}

#[test]
fn a_body_is_written_and_read_back() {
    let body = BodySlider::ALL.into_iter().fold(Body::AS_IS, |body, slider| {
        body.with(slider, slider.range().min + 0.37 * (slider.range().max - slider.range().min))
    });
    let text = figure::write_based("an \"own\" one", "library:mannequin.figure.ron", &body);
    let own = opened(&text, &[]).unwrap();
    assert_eq!((own.figure.name.as_str(), own.body), ("an \"own\" one", body));
    assert_eq!(figure::read_body(&text, &mut |_| Err(String::new())).unwrap(), body);
    let bare = figure::write_based("bare", "library:mannequin.figure.ron", &Body::AS_IS);
    assert_eq!(opened(&bare, &[]).unwrap().body, Body::AS_IS);
}

#[test]
fn shipped_bodies_differ() {
    let bodies = figure::shipped_bodies();
    assert_eq!(bodies[0], ("mannequin.figure.ron", Body::AS_IS));
    assert_eq!(bodies.len(), figure::shipped_figures().count());
    for (i, (name, body)) in bodies.iter().enumerate() {
        assert!(bodies[i + 1..].iter().all(|(_, other)| other != body), "{name} is like another");
    }
}
