//! Broken robots and meshes: each is an error that says what and where, and none is a panic.

use interchange::solid;
use interchange::urdf::read_robot;
use proptest::prelude::*;

/// The sentence about a file of these lines behind `<robot name="x">`.
fn fault(lines: &[&str]) -> String {
    let text = format!("<robot name=\"x\">\n{}\n</robot>", lines.join("\n"));
    read_robot(&text).expect_err("the file is broken").to_string()
}

const LINKS: &str = "<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>";

fn joint(name: &str, parent: &str, child: &str, more: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
         <limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>{more}</joint>"
    )
}

#[test]
fn trees_that_are_none_say_where() {
    let [ab, bc, cb, ca] = [("ab", "a", "b"), ("bc", "b", "c"), ("cb", "c", "b"), ("ca", "c", "a")]
        .map(|(n, p, c)| joint(n, p, c, ""));
    let two_parents = fault(&[LINKS, &ab, &bc, &cb]);
    assert!(two_parents.starts_with("5:"), "{two_parents}");
    assert!(
        two_parents
            .ends_with("link \"b\" is the child of joint \"ab\" and of joint \"cb\", expected one of them")
    );
    let cycle = fault(&[LINKS, &ab, &bc, &ca]);
    assert!(cycle.contains("carries itself") && cycle.contains("a -> b -> c -> a"), "{cycle}");
    let roots = fault(&[LINKS, &ab]);
    assert!(roots.starts_with("2:33: links \"a\" and \"c\" both hang on no joint"), "{roots}");
    let ghost = fault(&[LINKS, &ab, &joint("bd", "b", "cc", "")]);
    assert!(ghost.starts_with("4:") && ghost.contains("did you mean \"c\"?"), "{ghost}");
    assert!(
        fault(&["<link name=\"a\"/>", "<link name=\"a\"/>"]).starts_with("3:1: link \"a\" is given twice")
    );
    assert!(fault(&[LINKS, &ab, &joint("ab", "b", "c", "")]).starts_with("4:1: joint \"ab\" is given twice"));
    assert!(fault(&[]).contains("there are no links"));
    // A cycle beside a tree has no root of its own.
    let apart = fault(&[LINKS, &joint("bc", "b", "c", ""), &joint("cb", "c", "b", "")]);
    assert!(apart.contains("carries itself"), "{apart}");
}

#[test]
fn joints_that_make_no_sense_say_where() {
    let one = |more: &str| fault(&["<link name=\"a\"/><link name=\"b\"/>", &joint("j", "a", "b", more)]);
    assert!(
        one("<axis xyz=\"0 0 0\"/>").ends_with("joint \"j\" has an axis of no length, expected a direction")
    );
    assert!(one("<axis xyz=\"0 nan 0\"/>").contains("expected three finite numbers"));
    assert!(one("<origin xyz=\"inf 0 0\"/>").contains("expected three finite numbers"));
    assert!(
        one("<mimic joint=\"k\"/>").contains("mimics joint \"k\", which is not there, did you mean \"j\"?")
    );
    assert!(one("<mimic joint=\"j\"/>").contains("joint \"j\" mimics itself: j -> j"));
    assert!(one("<mimic/>").contains("<mimic> has no attribute joint"));
    assert!(one("<mimic joint=\"j\" multiplier=\"x\"/>").contains("expected one finite number"));
    let swapped = joint("j", "a", "b", "").replace("lower=\"-1\"", "lower=\"2\"");
    let swapped = fault(&["<link name=\"a\"/><link name=\"b\"/>", &swapped]);
    assert!(swapped.contains("3:68: joint \"j\" has lower 2 above upper 1"), "{swapped}");
    for kind in ["revolute", "prismatic"] {
        let bare =
            format!("<joint name=\"j\" type=\"{kind}\"><parent link=\"a\"/><child link=\"b\"/></joint>");
        assert!(fault(&["<link name=\"a\"/><link name=\"b\"/>", &bare]).contains("has no <limit>"));
    }
    let slow = joint("j", "a", "b", "").replace(" velocity=\"1\"", "");
    assert!(
        fault(&["<link name=\"a\"/><link name=\"b\"/>", &slow]).contains("<limit> has no attribute velocity")
    );
}

#[test]
fn mimics_that_lead_nowhere_are_named() {
    let lines =
        [joint("j1", "a", "b", "<mimic joint=\"j2\"/>"), joint("j2", "b", "c", "<mimic joint=\"j1\"/>")];
    let round = fault(&[LINKS, &lines[0], &lines[1]]);
    assert!(
        round.starts_with("3:") && round.ends_with("joint \"j1\" mimics itself: j1 -> j2 -> j1"),
        "{round}"
    );
    let free = "<joint name=\"f\" type=\"floating\"><parent link=\"a\"/><child link=\"b\"/></joint>";
    let of_six = fault(&[LINKS, free, &joint("j", "b", "c", "<mimic joint=\"f\"/>")]);
    assert!(of_six.contains("expected both to have one value"), "{of_six}");
}

#[test]
fn looks_that_lack_something_say_what() {
    let shape = |shape: &str| {
        fault(&[&format!("<link name=\"a\"><visual><geometry>{shape}</geometry></visual></link>")])
    };
    assert!(shape("<cylinder radius=\"1\"/>").contains("link \"a\", <cylinder> has no attribute length"));
    assert!(shape("<mesh/>").contains("<mesh> has no attribute filename"));
    assert!(shape("<teapot/>").contains("expected one of <box>, <cylinder>, <capsule>, <sphere>, <mesh>"));
    assert!(fault(&["<link name=\"a\"><visual/></link>"]).contains("<visual> has no <geometry>"));
    assert!(
        fault(&["<link name=\"a\"><inertial><mass value=\"1\"/></inertial></link>"]).contains("no <inertia>")
    );
}

#[test]
fn what_the_xml_reader_stumbles_over_has_a_place() {
    let one = |more: &str| fault(&["<link name=\"a\"/><link name=\"b\"/>", &joint("j", "a", "b", more)]);
    let twice = one("<origin xyz=\"0 0 0\"/><origin xyz=\"0 0 0\"/>");
    assert!(twice.starts_with("3:") && twice.ends_with("joint \"j\": <origin> is given twice"), "{twice}");
    let control = one("\u{e}");
    assert!(control.starts_with("3:") && control.ends_with("U+000E has no place in XML"), "{control}");
    let text =
        fault(&["<link name=\"a\"><visual>", "<geometry>x<box size=\"1 1 1\"/></geometry></visual></link>"]);
    assert!(text.starts_with("3:11: link \"a\", <geometry>: text between elements"), "{text}");
}

#[test]
fn a_nul_at_the_end_is_forgiven() {
    let (_, warnings) = read_robot("<robot name=\"x\"><link name=\"a\"/></robot>\n\0").unwrap();
    assert_eq!(warnings, ["the file ends with a NUL, which is left out"]);
}

#[test]
fn thousands_of_joints_take_no_time() {
    let chain = |mimic: bool| {
        let links: String = (0..4000).map(|i| format!("<link name=\"l{i}\"/>")).collect();
        let joints: String = (1..4000)
            .map(|i| {
                let more =
                    if mimic && i > 1 { format!("<mimic joint=\"j{}\"/>", i - 1) } else { String::new() };
                joint(&format!("j{i}"), &format!("l{}", i - 1), &format!("l{i}"), &more)
            })
            .collect();
        format!("<robot name=\"x\">{links}{joints}</robot>")
    };
    let start = std::time::Instant::now();
    for mimic in [false, true] {
        let (robot, _) = read_robot(&chain(mimic)).unwrap();
        assert_eq!(robot.frames(&robot.rest()).len(), 4000);
    }
    assert!(start.elapsed().as_secs_f64() < 10.0, "{:?}", start.elapsed());
    let attributes: String = (0..100_000).map(|i| format!("a{i}=\"\" ")).collect();
    assert!(fault(&[&format!("<link {attributes}/>")]).contains("more than 64 attributes"));
    assert!(fault(&[&"<link name=\"a\"/>".repeat(200_000)]).contains("more than 100000 elements"));
    let many: String = (0..5000).map(|i| format!("<link name=\"l{i}\"/>")).collect();
    assert!(fault(&[&many]).contains("5000 links"));
}

const WHOLE: &str = r#"<robot name="x"><material name="m"><color rgba="1 0 0 1"/></material>
<link name="a"><visual><origin xyz="0 0 1" rpy="1 0 0"/><geometry><mesh filename="a.stl"/></geometry><material name="m"/></visual>
<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<link name="b"/><link name="c"/>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1"/></joint>
<joint name="k" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="1 0 0"/><limit lower="-1" upper="1" velocity="1"/><mimic joint="j" multiplier="2"/></joint></robot>"#;

const DAE: &str = r##"<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="cm" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert><diffuse><color>1 0 0 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array><technique_common><accessor source="#pa" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist material="s" count="1"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs"><node id="n"><translate>100 0 0</translate><rotate>0 0 1 90</rotate><scale>2 2 2</scale>
<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry>
</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#vs"/></scene></COLLADA>"##;

const OBJ: &str =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nusemtl m\nf 1//1 2//1 3//1 4//1\n";
const STL: &str = "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid x\n";

fn mesh(name: &str, bytes: &[u8]) -> Result<rig::Solid, String> {
    solid::read(name, bytes, &mut |_| Ok(b"newmtl m\nKd 0 1 0\n".to_vec()))
}

#[test]
fn collada_is_in_metres_placed_and_coloured() {
    let solid = mesh("a.DAE", DAE.as_bytes()).unwrap();
    assert_eq!((solid.positions.len(), solid.indices.len(), solid.colors[0]), (4, 6, [1.0, 0.0, 0.0]));
    let near = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
    // Twice as large, a quarter turn about z, a metre along x, all in centimetres; up_axis left alone.
    assert!(near(solid.positions[1], [1.0, 0.02, 0.0]), "{:?}", solid.positions);
    assert!(near(solid.positions[2], [0.98, 0.02, 0.0]), "{:?}", solid.positions);
    assert!(near(solid.normals[0], [0.0, 0.0, 1.0]));
}

#[test]
fn a_mirrored_collada_mesh_faces_outward() {
    let solid = mesh("a.dae", DAE.replace("2 2 2", "-2 2 2").as_bytes()).unwrap();
    let [a, b, c] = [0, 1, 2].map(|i| glam::Vec3::from_array(solid.positions[solid.indices[i] as usize]));
    assert!((b - a).cross(c - a).z > 0.0, "triangles turn as the mesh is mirrored");
    assert!(solid.normals[0][2] > 0.99);
}

#[test]
fn meshes_at_fault_say_what() {
    let dae = |from: &str, to: &str| {
        assert!(DAE.contains(from), "{from}");
        mesh("a.dae", DAE.replace(from, to).as_bytes()).unwrap_err()
    };
    assert!(dae("0 1 2 3</p>", "0 1 2 9</p>").contains("names a vertex that is not there"));
    assert!(dae("<vcount>4<", "<vcount>400000000000<").contains("beyond its indices"));
    assert!(dae("0 0 0 1 0 0", "0 0 x 1 0 0").contains("expected numbers"));
    assert!(dae("meter=\"0.01\"", "meter=\"0\"").contains("expected a number above 0"));
    assert!(dae("<COLLADA", "<COLLODA").contains("not COLLADA"));
    assert!(dae("polylist", "lines").contains("no triangles"));
    let deep = format!("<COLLADA>{}", "<a>".repeat(100_000));
    assert!(mesh("a.dae", deep.as_bytes()).unwrap_err().contains("nested deeper"));
    assert!(mesh("a.ply", b"ply").unwrap_err().contains("expected .stl, .obj or .dae"));
    assert!(mesh("a.stl", b"solid x\nendsolid x\n").unwrap_err().contains("no triangles"));
    assert!(
        mesh("a.stl", STL.replace("vertex 1 0 0", "vertex 1 nan 0").as_bytes())
            .unwrap_err()
            .contains("expected finite")
    );
}

#[test]
fn nodes_that_stand_for_each_other_end() {
    let round = DAE.replace(
        "<instance_geometry",
        "<instance_node url=\"#n\"/><instance_node url=\"#n\"/><instance_geometry",
    );
    assert!(mesh("a.dae", round.as_bytes()).is_err());
}

/// A text with a few bytes cut out, doubled or changed.
fn damaged(text: &'static str) -> impl Strategy<Value = Vec<u8>> {
    let change = (0..text.len(), 0..4_u8, any::<u8>(), 1..40_usize);
    prop::collection::vec(change, 1..4).prop_map(move |changes| {
        let mut bytes = text.as_bytes().to_vec();
        for (at, how, byte, length) in changes {
            let at = at.min(bytes.len().saturating_sub(1));
            let end = (at + length).min(bytes.len());
            match how {
                0 => bytes.truncate(at),
                1 => drop(bytes.drain(at..end)),
                2 => bytes.splice(at..at, bytes[at..end].to_vec()).for_each(drop),
                _ => bytes.iter_mut().skip(at).take(1).for_each(|b| *b = byte),
            }
            if bytes.is_empty() {
                break;
            }
        }
        bytes
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn damaged_robots_never_panic(bytes in damaged(WHOLE)) {
        if let Ok((robot, _)) = read_robot(&String::from_utf8_lossy(&bytes)) {
            let frames = robot.frames(&robot.rest());
            prop_assert!(frames.iter().all(|f| f.position.is_finite()));
            prop_assert!(robot.chain(&robot.rest()).is_ok());
        }
    }

    #[test]
    fn damaged_meshes_never_panic(
        dae in damaged(DAE),
        obj in damaged(OBJ),
        stl in damaged(STL),
        noise in prop::collection::vec(any::<u8>(), 0..300),
    ) {
        for (name, bytes) in [("a.dae", &dae), ("a.obj", &obj), ("a.stl", &stl), ("b.stl", &noise), ("b.obj", &noise), ("b.dae", &noise)] {
            if let Ok(solid) = mesh(name, bytes) {
                prop_assert!(solid.fault().is_none());
            }
        }
    }
}
