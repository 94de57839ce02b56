//! Blend tree files: written and read back they are the same; faults say what and where; damage never panics.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::Arc;

use interchange::figure::bare_mannequin;
use motion::{
    At, Clip, Condition, Feather, FittedClip, Parameter, Plan, PlanNode, Transition, parse_plan, read_tree,
    write_plan,
};
use proptest::prelude::*;

const WHOLE: &str = r#"// A tree with one of everything.
(
    version: 1,
    root: FootPlacement(node: States(
        initial: "still",
        states: [
            ("still", Clip(name: "idle")),
            ("moving", Blend(
                by: [Forward, Turn],
                points: [
                    ((0, 0), Clip(name: "idle")),
                    ((1.4, 0.0), Clip(name: "walk", turn: 2)),
                    ((0, 60), Mirror(node: Clip(name: "walk", pace: 0.5))),
                    ((1.4, 60), Crossfade(by: Slope, over: (-5, 5), from: Clip(name: "idle"), to: Clip(name: "walk"), feather: Smoother)),
                ],
                cells: [[0, 1, 2], [1, 3, 2]],
            )),
            ("sitting", Mask(
                base: Additive(base: Clip(name: "sit", pace: -1), layer: Clip(name: "wave"), less: Clip(name: "idle"), amount: 0.5, by: (Turn, 90)),
                layer: Blend(by: [Speed], points: [(0, Clip(name: "idle")), (2, Clip(name: "wave", mirrored: true))]),
                parts: ["leftArm"],
                bones: ["head"],
            )),
        ],
        transitions: [
            (from: "still", to: "moving", when: [Above(Speed, 0.1)], secs: 0.3),
            (from: "still", to: "sitting", when: [Sit, Below(Speed, 0.1)], secs: 0.5, feather: Linear),
            (from: "sitting", to: "still", when: [Stand, EndsWithin(0.2)], secs: 0.5),
        ],
    )),
)
"#;

fn clips() -> Vec<Arc<FittedClip>> {
    let figure = bare_mannequin().unwrap();
    let clip = |(name, stride): (&str, bool)| {
        let clip = Clip {
            name: name.into(),
            figure: None,
            size: None,
            length_secs: 1.0,
            loops: stride,
            stride,
            root: None,
            hips: None,
            joints: Default::default(),
        };
        Arc::new(FittedClip::new(&clip, &figure, &figure).unwrap())
    };
    [("idle", false), ("walk", true), ("sit", false), ("wave", false)].map(clip).to_vec()
}

/// The text with one place changed, and that place moved on by some characters.
fn changed(from: &str, to: &str, skip: usize) -> (String, usize, usize) {
    let at = WHOLE.find(from).unwrap_or_else(|| panic!("{from:?} is not in the text"));
    let before = &WHOLE[..at];
    let line = 1 + before.matches('\n').count();
    let column = 1 + before.rsplit('\n').next().unwrap().chars().count() + skip;
    (format!("{before}{to}{}", &WHOLE[at + from.len()..]), line, column)
}

#[test]
fn the_whole_file_is_read() {
    let plan = parse_plan(WHOLE).unwrap();
    assert_eq!(plan.clip_names(), ["idle", "walk", "sit", "wave"]);
    let tree = read_tree(WHOLE, &clips()).unwrap();
    assert_eq!(tree.clips().len(), 4);
    assert!(tree.placement().is_some());
}

#[test]
fn what_is_written_comes_back() {
    let plan = parse_plan(WHOLE).unwrap();
    let text = write_plan(&plan);
    assert_eq!(parse_plan(&text).unwrap(), plan, "{text}");
    assert_eq!(write_plan(&parse_plan(&text).unwrap()), text);
}

#[test]
fn faults_of_meaning_say_where() {
    // From, to, how many characters after the change's start, and a part of the message.
    let table: [(&str, &str, usize, &str); 24] = [
        (
            "Clip(name: \"walk\", turn",
            "Clip(name: \"wolk\", turn",
            11,
            "unknown clip \"wolk\", expected idle, walk",
        ),
        (
            "initial: \"still\"",
            "initial: \"stall\"",
            9,
            "unknown state \"stall\", expected still, moving, sitting",
        ),
        ("(\"moving\", Blend", "(\"still\", Blend", 1, "a second state \"still\""),
        ("to: \"moving\", when", "to: \"running\", when", 4, "unknown state \"running\""),
        ("from: \"sitting\"", "from: \"lying\"", 6, "unknown state \"lying\""),
        ("from: \"still\", to: \"moving\"", "from: \"still\", to: \"still\"", 19, "expected another"),
        ("when: [Above(Speed, 0.1)], secs: 0.3", "when: [], secs: 0.3", 6, "at least one condition"),
        ("secs: 0.3", "secs: 0", 6, "0 found, expected more than 0"),
        ("Above(Speed, 0.1)], secs: 0.3", "Above(Speed, 1e9)], secs: 0.3", 13, "1000000000 found"),
        ("EndsWithin(0.2)", "EndsWithin(-1)", 11, "-1 found, expected 0 to"),
        ("((1.4, 60), Cross", "((1.4, 0), Cross", 1, "where point 1 is"),
        ("((0, 60), Mirror", "((0, 60, 3), Mirror", 1, "3 values found"),
        ("((0, 60), Mirror", "((0, inf), Mirror", 5, "inf found"),
        ("by: [Forward, Turn]", "by: [Turn, Turn]", 11, "twice"),
        ("by: [Forward, Turn]", "by: []", 4, "0 parameters found"),
        ("[1, 3, 2]]", "[0, 1, 3]]", 0, "overlaps cell 0"),
        ("[1, 3, 2]]", "[1, 3, 1]]", 0, "3 different points of 4"),
        ("[[0, 1, 2], [1, 3, 2]]", "[[0, 1, 2]]", 0, "cover 0.500"),
        ("points: [(0, Clip", "points: [(2, Clip", 35, "where point 0 is"),
        ("amount: 0.5", "amount: 1.5", 8, "1.5 found, expected 0 to 1"),
        ("over: (-5, 5)", "over: (5, 5)", 6, "lower value first"),
        ("pace: 0.5)", "pace: -0.5)", 6, "strides don't go backward"),
        (
            "Clip(name: \"idle\")),\n            (\"moving\"",
            "FootPlacement(node: Clip(name: \"idle\"))),\n            (\"moving\"",
            0,
            "expected it outermost",
        ),
        ("pace: -1", "pace: NaN", 6, "NaN found"),
    ];
    let clips = clips();
    for (from, to, skip, message) in table {
        let (text, line, column) = changed(from, to, skip);
        let fault = read_tree(&text, &clips).expect_err(to);
        assert!(fault.message.contains(message), "{to}: {fault}");
        assert_eq!((fault.line, fault.column), (line, column), "{to}: {fault}");
    }
}

#[test]
fn faults_of_form_say_where() {
    let table: [(&str, &str, &str); 8] = [
        ("version: 1", "version: 2", "version 2 is not known"),
        ("secs: 0.3", "secs: 0.3, colour: 3", "colour"),
        ("by: [Forward, Turn]", "by: [Forward, Height]", "Height"),
        ("Mirror(node", "Miror(node", "Miror"),
        ("\"leftArm\"", "\"tail\"", "unknown part \"tail\""),
        ("\"head\"", "\"horn\"", "horn"),
        ("pace: 0.5", "pace: fast", ""),
        ("feather: Smoother)", "feather: Smoother", ""),
    ];
    for (from, to, message) in table {
        let (text, line, column) = changed(from, to, 0);
        let fault = parse_plan(&text).expect_err(to);
        assert!(fault.message.contains(message), "{to}: {fault}");
        assert!(fault.line == line || fault.line == line + 1, "{to}: {fault}, expected line {line}");
        assert!(
            fault.line > line || (column..column + 40).contains(&fault.column),
            "{to}: {fault} near {column}"
        );
    }
}

fn node() -> impl Strategy<Value = PlanNode> {
    let number = prop_oneof![Just(0.0), -1000.0..1000.0f64, Just(0.1), Just(1.0 / 3.0)];
    let name = prop_oneof![Just("idle".to_owned()), "[a-z \\\\\"()\\[\\],:]{0,8}"];
    let leaf = (name, 0.05..20.0f64, any::<bool>(), number)
        .prop_map(|(name, pace, mirrored, turn)| PlanNode::Clip { name, pace, mirrored, turn });
    leaf.prop_recursive(3, 20, 4, |inner| {
        let boxed = inner.clone().prop_map(Box::new);
        let parameter = prop::sample::select(Parameter::ALL.to_vec());
        let feather = prop::sample::select(vec![Feather::Linear, Feather::Smooth, Feather::Smoother]);
        let some = prop::collection::vec(inner.clone(), 4..7);
        prop_oneof![
            boxed.clone().prop_map(|node| PlanNode::Mirror { node }),
            (some.clone(), 1usize..=3).prop_map(|(nodes, dims)| PlanNode::Blend {
                by: Parameter::ALL[..dims].to_vec(),
                points: nodes
                    .into_iter()
                    .zip(PLACES)
                    .map(|(node, at)| (At::new(&at[..dims]), node))
                    .collect(),
                cells: None,
            }),
            (parameter.clone(), -5.0..0.0f64, boxed.clone(), boxed.clone(), feather.clone()).prop_map(
                |(by, least, from, to, feather)| PlanNode::Crossfade {
                    by,
                    over: (least, 0.5),
                    from,
                    to,
                    feather
                }
            ),
            (boxed.clone(), boxed.clone(), prop::option::of(boxed.clone()), 0.0..1.0f64, any::<bool>())
                .prop_map(|(base, layer, less, amount, by)| PlanNode::Additive {
                    base,
                    layer,
                    less,
                    amount,
                    by: by.then_some((Parameter::Turn, -90.5)),
                }),
            (boxed.clone(), boxed).prop_map(|(base, layer)| PlanNode::Mask {
                base,
                layer,
                parts: vec![rig::Part::LeftHand],
                bones: vec![rig::Bone::Head, rig::Bone::Jaw],
                amount: 0.7,
            }),
            (some, parameter, feather).prop_map(|(nodes, by, feather)| PlanNode::States {
                initial: "2".into(),
                states: nodes.into_iter().enumerate().map(|(i, node)| (i.to_string(), node)).collect(),
                transitions: vec![Transition {
                    from: "0".into(),
                    to: "3".into(),
                    when: vec![Condition::Above(by, 0.1), Condition::Sit, Condition::EndsWithin(2.0)],
                    secs: 0.25,
                    feather,
                }],
            }),
        ]
    })
}

/// In general position by their first, first two and all three values.
const PLACES: [[f64; 3]; 6] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 1.5], [2.0, 1.0, 0.0], [3.0, 5.0, 1.0], [4.0, -1.0, 2.0], [5.5, 2.0, 7.0]];

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_plan_comes_back_as_it_was(root in node(), placed in any::<bool>()) {
        let root = if placed {
            PlanNode::FootPlacement { node: Box::new(root), settings: Default::default() }
        } else {
            root
        };
        let plan = Plan { root };
        let text = write_plan(&plan);
        let back = parse_plan(&text);
        prop_assert_eq!(back.as_ref(), Ok(&plan), "{}", text);
    }

    #[test]
    fn damaged_text_never_panics_and_faults_are_within_it(at in 0..WHOLE.len(), cut in 0usize..40, put in "[ -~\\n]{0,6}") {
        let end = (at + cut).min(WHOLE.len());
        let text = format!("{}{put}{}", &WHOLE[..at], &WHOLE[end..]);
        if let Err(fault) = parse_plan(&text) {
            let lines = text.split('\n').count();
            prop_assert!((1..=lines).contains(&fault.line), "{}", fault);
            let columns = text.split('\n').nth(fault.line - 1).unwrap().chars().count();
            prop_assert!((1..=columns + 1).contains(&fault.column), "{}", fault);
        }
    }

    #[test]
    fn any_text_never_panics(text in "\\PC{0,60}") {
        let _ = parse_plan(&text);
        let _ = parse_plan(&format!("(version: 1, root: {text})"));
    }
}
