//! Skins through binary glTF: what is written is read back, what is damaged is an error that says so.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use interchange::glb::{self, GlbError};
use interchange::urdf;
use proptest::prelude::*;
use rig::{Bone, Mesh, MorphTargets, Skeleton};
use serde_json::{Value, json};

const SKIN: &[u8] = include_bytes!("../../../assets/figures/mannequin.glb");
const URDF: &str = include_str!("../../../assets/figures/mannequin.urdf");

fn skeleton() -> &'static Skeleton {
    static SKELETON: OnceLock<Skeleton> = OnceLock::new();
    SKELETON.get_or_init(|| urdf::read(URDF, &BTreeMap::new()).expect("the shipped skeleton is sound").0)
}

/// Two triangles on two bones.
fn small() -> Mesh {
    Mesh {
        positions: vec![[0.0, 1.0, 0.1], [0.1, 1.0, 0.1], [0.0, 1.1, 0.1], [0.1, 1.1, 0.1]],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        colors: vec![[0.0, 0.2, 1.0], [1.0, 0.0, 0.4], [0.6, 0.8, 0.0], [1.0, 1.0, 1.0]],
        joints: vec![[Bone::Spine as u8, Bone::Hips as u8, 0, 0]; 4],
        weights: vec![[40_000, 25_535, 0, 0]; 4],
        indices: vec![0, 1, 2, 2, 1, 3],
    }
}

fn document(bytes: &[u8]) -> (Value, Vec<u8>) {
    let size = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    let json = serde_json::from_slice(&bytes[20..20 + size]).expect("JSON");
    (json, bytes[28 + size..].to_vec())
}

fn file(json: &Value, data: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF".to_vec();
    let total = 28 + text.len() + data.len();
    bytes.extend([2, total as u32, text.len() as u32, 0x4E4F_534A].iter().flat_map(|w| w.to_le_bytes()));
    bytes.extend(&text);
    bytes.extend([data.len() as u32, 0x004E_4942].iter().flat_map(|w| w.to_le_bytes()));
    bytes.extend(data);
    bytes
}

/// The small skin with its document changed.
fn changed(change: impl FnOnce(&mut Value)) -> Result<Mesh, GlbError> {
    let (mut json, data) = document(&glb::write(&small(), skeleton(), "small"));
    change(&mut json);
    glb::read(&file(&json, &data), skeleton())
}

/// The number of an attribute's accessor in the small skin.
fn accessor(json: &Value, attribute: &str) -> usize {
    json["meshes"][0]["primitives"][0]["attributes"][attribute].as_u64().expect("an accessor") as usize
}

#[test]
fn the_shipped_skin_survives_reading_and_writing() {
    let mesh = glb::read(SKIN, skeleton()).unwrap();
    assert_eq!(mesh.fault(), None);
    assert!(mesh.vertex_count() > 10_000);
    let again = glb::write(&mesh, skeleton(), "mannequin");
    assert_eq!(glb::read(&again, skeleton()).unwrap(), mesh);
}

#[test]
fn a_skin_with_spread_twist_is_written_with_bones_alone() {
    let mesh = glb::read(SKIN, skeleton()).unwrap();
    let mut spread = mesh.clone();
    rig::spread_twist(&mut spread, skeleton());
    assert!(spread.joints.iter().flatten().any(|place| usize::from(*place) >= Bone::COUNT));
    let again = glb::read(&glb::write(&spread, skeleton(), "mannequin"), skeleton()).unwrap();
    assert_eq!(again.fault(), None);
    let shares = |mesh: &Mesh, v: usize| {
        let rows = mesh.joints[v].into_iter().zip(mesh.weights[v]);
        let mut rows: Vec<_> = rows.filter(|row| row.1 > 0).collect();
        rows.sort_unstable();
        rows
    };
    for v in 0..mesh.vertex_count() {
        let before = shares(&mesh, v);
        assert!(again.joints[v].iter().all(|joint| usize::from(*joint) < Bone::COUNT));
        assert_eq!(shares(&again, v), before, "vertex {v}");
    }
}

#[test]
fn a_small_skin_comes_back_as_it_was() {
    let read = glb::read(&glb::write(&small(), skeleton(), "small"), skeleton()).unwrap();
    assert_eq!(read.positions, small().positions);
    assert_eq!(read.normals, small().normals);
    assert_eq!((read.joints, read.weights, read.indices), (small().joints, small().weights, small().indices));
    for (a, b) in read.colors.iter().flatten().zip(small().colors.iter().flatten()) {
        assert!((a - b).abs() < 1e-5, "{a} for {b}");
    }
}

#[test]
fn the_file_names_every_bone_at_its_place() {
    let (json, _) = document(&glb::write(&small(), skeleton(), "small"));
    assert_eq!(json["asset"]["generator"], "Posewright");
    let names: Vec<&str> =
        json["nodes"].as_array().unwrap().iter().filter_map(|n| n["name"].as_str()).collect();
    assert!(Bone::ALL.iter().all(|b| names.contains(&b.name())));
    assert_eq!(json["skins"][0]["joints"].as_array().unwrap().len(), Bone::COUNT);
    let places = &json["accessors"][accessor(&json, "POSITION")];
    assert_eq!(places["min"][1], 1.0);
    assert!((places["max"][1].as_f64().unwrap() - 1.1).abs() < 1e-6);
}

#[test]
fn a_mesh_without_triangles_is_written_and_is_an_error_to_read() {
    let bytes = glb::write(&Mesh::default(), skeleton(), "none");
    assert_eq!(glb::read(&bytes, skeleton()), Err(GlbError::Empty));
}

#[test]
fn missing_normals_are_made() {
    let mesh = changed(|json| {
        json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("NORMAL");
    });
    assert_eq!(mesh.unwrap().normals, vec![[0.0, 0.0, 1.0]; 4]);
}

#[test]
fn a_mesh_without_skin_moves_with_the_bone_above_it() {
    let mesh = changed(|json| {
        let nodes = json["nodes"].as_array_mut().unwrap();
        let head = nodes.iter().position(|n| n["name"] == "head").unwrap();
        nodes[0].as_object_mut().unwrap().remove("skin");
        nodes[0]["translation"] = json!([0.0, -1.0, 0.5]);
        nodes[head]["children"].as_array_mut().unwrap().push(json!(0));
        json["scenes"][0]["nodes"] = json!([1]);
    })
    .unwrap();
    assert_eq!(mesh.joints[0][0], Bone::Head as u8);
    assert_eq!(mesh.weights[0], [65535, 0, 0, 0]);
    let head = skeleton().rest_position(Bone::Head);
    let expected = [0.0, head.y as f32, 0.6 + head.z as f32];
    for (found, wanted) in mesh.positions[0].iter().zip(expected) {
        assert!((found - wanted).abs() < 1e-6, "{found} for {wanted}");
    }
}

#[test]
fn primitives_are_merged() {
    let mesh = changed(|json| {
        let primitives = json["meshes"][0]["primitives"].as_array_mut().unwrap();
        primitives.push(primitives[0].clone());
    });
    let mesh = mesh.unwrap();
    assert_eq!(mesh.vertex_count(), 8);
    assert_eq!(mesh.indices[6..], [4, 5, 6, 6, 5, 7]);
}

#[test]
fn a_joint_elsewhere_is_named() {
    let error = changed(|json| {
        let nodes = json["nodes"].as_array_mut().unwrap();
        let spine = nodes.iter().position(|n| n["name"] == "spine").unwrap();
        nodes[spine]["translation"][0] = json!(0.002);
    });
    assert!(matches!(error, Err(GlbError::Rest { bone: Bone::Spine, .. })), "{error:?}");
    let tolerated = changed(|json| {
        let nodes = json["nodes"].as_array_mut().unwrap();
        let toes = nodes.iter().position(|n| n["name"] == "leftToes").unwrap();
        let z = nodes[toes]["translation"][2].as_f64().unwrap();
        nodes[toes]["translation"][2] = json!(z + 0.0005);
    });
    assert!(tolerated.is_ok(), "{tolerated:?}");
}

#[test]
fn a_joint_that_is_no_bone_is_named() {
    let error = changed(|json| {
        let nodes = json["nodes"].as_array_mut().unwrap();
        nodes[1]["name"] = json!("hipz");
    });
    let Err(GlbError::UnknownJoint { name, nearest }) = error else { panic!("{error:?}") };
    assert_eq!((name.as_str(), nearest.as_str()), ("hipz", "hips"));
    // One that is listed above the hips and pulls at nothing does no harm.
    let rooted = changed(|json| {
        let nodes = json["nodes"].as_array_mut().unwrap();
        nodes.push(json!({"name": "root", "children": [1]}));
        let root = nodes.len() - 1;
        json["scenes"][0]["nodes"] = json!([0, root]);
        json["skins"][0]["joints"][Bone::Jaw.index()] = json!(root);
    });
    assert_eq!(rooted.unwrap().joints, small().joints);
}

#[test]
fn damaged_containers() {
    let whole = glb::write(&small(), skeleton(), "small");
    let mut version = whole.clone();
    version[4] = 1;
    let mut length = whole.clone();
    length[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    let mut short = whole.clone();
    short[8..12].copy_from_slice(&4u32.to_le_bytes());
    let mut chunk = whole.clone();
    chunk[12..16].copy_from_slice(&(u32::MAX - 3).to_le_bytes());
    let cases: [&[u8]; 9] =
        [b"", b"glTF", b"not a model at all", &whole[..17], &whole[..40], &version, &length, &short, &chunk];
    for bytes in cases {
        let error = glb::read(bytes, skeleton());
        assert!(matches!(error, Err(GlbError::Container(_))), "{error:?} for {} bytes", bytes.len());
    }
    // A second header where the document should be.
    let mut nested = whole.clone();
    nested[20..32].copy_from_slice(&[b"glTF".as_slice(), &[2, 0, 0, 0, 4, 0, 0, 0]].concat());
    assert!(matches!(glb::read(&nested, skeleton()), Err(GlbError::Document(_))));
}

#[test]
fn damaged_documents() {
    type Damage = fn(&mut Value);
    let outside: [Damage; 5] = [
        |j| j["bufferViews"][0]["byteOffset"] = json!(1_000_000),
        |j| j["bufferViews"][0]["byteLength"] = json!(u32::MAX),
        |j| j["accessors"][0]["count"] = json!(1_000_000),
        |j| j["accessors"][0]["byteOffset"] = json!(u64::MAX),
        |j| j["accessors"][0]["bufferView"] = json!(1),
    ];
    for (i, damage) in outside.into_iter().enumerate() {
        let error = changed(damage);
        let found = matches!(
            error,
            Err(GlbError::OutOfRange { .. } | GlbError::Document(_) | GlbError::Unexpected { .. })
        );
        assert!(found || i == 4, "case {i}: {error:?}");
    }
    let error = changed(|j| j["accessors"][0]["count"] = json!(4_000_000_000u32));
    assert!(matches!(error, Err(GlbError::TooLarge { .. })), "{error:?}");
    let error = changed(|j| j["buffers"][0]["uri"] = json!("other.bin"));
    assert!(matches!(error, Err(GlbError::External { .. })), "{error:?}");
    let error = changed(|j| j["nodes"][3]["children"] = json!([2]));
    assert!(matches!(error, Err(GlbError::Cycle { .. })), "{error:?}");
    let error = changed(|j| j["skins"][0]["joints"] = json!([1]));
    assert!(matches!(error, Err(GlbError::Unexpected { .. })), "{error:?}");
    let error = changed(|j| j["nodes"][1]["translation"] = json!([0.0, 1e39, 0.0]));
    assert!(matches!(error, Err(GlbError::NotFinite { .. } | GlbError::Rest { .. })), "{error:?}");
}

/// Each kind of index in a document, one beyond the last of what it counts: the library looks some of them up unchecked.
#[test]
fn an_index_beyond_the_last_is_an_error_and_no_panic() {
    type Damage = fn(&mut Value);
    let cases: [(&str, Damage); 17] = [
        ("the places", |j| primitive(j)["attributes"]["POSITION"] = json!(99)),
        ("another attribute", |j| primitive(j)["attributes"]["JOINTS_0"] = json!(99)),
        ("the largest attribute", |j| primitive(j)["attributes"]["POSITION"] = json!(u32::MAX)),
        ("an attribute without meaning", |j| primitive(j)["attributes"]["_ODD"] = json!(99)),
        ("indices", |j| primitive(j)["indices"] = json!(99)),
        ("material", |j| primitive(j)["material"] = json!(99)),
        ("morph target", |j| primitive(j)["targets"] = json!([{"POSITION": 99}])),
        ("inverse binds", |j| j["skins"][0]["inverseBindMatrices"] = json!(99)),
        ("skeleton", |j| j["skins"][0]["skeleton"] = json!(999)),
        ("joint", |j| j["skins"][0]["joints"][3] = json!(999)),
        ("mesh", |j| j["nodes"][0]["mesh"] = json!(99)),
        ("skin", |j| j["nodes"][0]["skin"] = json!(99)),
        ("child", |j| j["nodes"][1]["children"] = json!([999])),
        ("node of a scene", |j| j["scenes"][0]["nodes"] = json!([999])),
        ("buffer view of an accessor", |j| j["accessors"][0]["bufferView"] = json!(99)),
        ("buffer of a view", |j| j["bufferViews"][0]["buffer"] = json!(99)),
        ("buffer view of an image", |j| {
            j["images"] = json!([{"bufferView": 99, "mimeType": "image/png"}]);
        }),
    ];
    for (what, damage) in cases {
        let error = changed(damage);
        assert!(matches!(error, Err(GlbError::Document(_))), "{what}: {error:?}");
    }
    // Those that hang together: texture to image, material to texture, a sparse accessor to its views.
    let chained: [(&str, Damage); 3] = [
        ("image of a texture", |j| j["textures"] = json!([{"source": 9}])),
        ("texture of a material", |j| j["materials"] = json!([{"normalTexture": {"index": 9}}])),
        ("views of a sparse accessor", |j| {
            j["accessors"][0]["sparse"] = json!({"count": 1,
                "indices": {"bufferView": 99, "componentType": 5123}, "values": {"bufferView": 99}});
        }),
    ];
    for (what, damage) in chained {
        let error = changed(damage);
        assert!(matches!(error, Err(GlbError::Document(_))), "{what}: {error:?}");
    }
}

/// The only primitive of the small skin.
fn primitive(json: &mut Value) -> &mut Value {
    &mut json["meshes"][0]["primitives"][0]
}

#[test]
fn numbers_that_are_not_finite() {
    let (json, mut data) = document(&glb::write(&small(), skeleton(), "small"));
    let view = &json["bufferViews"][accessor(&json, "POSITION")];
    let at = view["byteOffset"].as_u64().unwrap() as usize;
    data[at..at + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    let error = glb::read(&file(&json, &data), skeleton());
    assert!(matches!(error, Err(GlbError::NotFinite { .. })), "{error:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Bytes of the shipped skin changed, most of them in its document: an error or a sound mesh, never a panic.
    #[test]
    fn mutated_files_do_no_harm(
        changes in prop::collection::vec((0usize..24_000, any::<u8>()), 1..12),
        cut in prop::option::weighted(0.2, 0usize..1_200_000),
    ) {
        let mut bytes = SKIN.to_vec();
        for (at, value) in changes {
            bytes[at] = value;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut);
        }
        if let Ok(mesh) = glb::read(&bytes, skeleton()) {
            prop_assert_eq!(mesh.fault(), None);
        }
    }

    /// Digits of the small skin's document changed, so that it still parses.
    #[test]
    fn other_numbers_do_no_harm(changes in prop::collection::vec((any::<prop::sample::Index>(), 0u8..10), 1..6)) {
        let mut bytes = glb::write(&small(), skeleton(), "small");
        let end = 20 + u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        let digits: Vec<usize> = (20..end).filter(|&i| bytes[i].is_ascii_digit()).collect();
        for (index, digit) in changes {
            bytes[*index.get(&digits)] = b'0' + digit;
        }
        if let Ok(mesh) = glb::read(&bytes, skeleton()) {
            prop_assert_eq!(mesh.fault(), None);
        }
    }
}

/// Two targets: one of some vertices, one that moves nothing.
fn small_targets() -> MorphTargets {
    let wide = vec![(1, [0.25, -0.5, 0.0]), (3, [0.125, 0.0, 1e-4])];
    MorphTargets::from([("wide".to_owned(), wide), ("none".to_owned(), Vec::new())])
}

/// The small skin with its targets, its document changed.
fn changed_targets(change: impl FnOnce(&mut Value)) -> Result<MorphTargets, GlbError> {
    let (mut json, data) =
        document(&glb::write_with_targets(&small(), &small_targets(), skeleton(), "small"));
    change(&mut json);
    glb::read_with_targets(&file(&json, &data), skeleton(), &|_| true).map(|(_, targets)| targets)
}

#[test]
fn morph_targets_are_read_back_bit_for_bit() {
    let bytes = glb::write_with_targets(&small(), &small_targets(), skeleton(), "small");
    let (mesh, targets) = glb::read_with_targets(&bytes, skeleton(), &|_| true).unwrap();
    assert_eq!((&mesh, &targets), (&small(), &small_targets()));
    assert_eq!(glb::read(&bytes, skeleton()).unwrap(), mesh);
    let (_, one) = glb::read_with_targets(&bytes, skeleton(), &|name| name == "none").unwrap();
    assert_eq!(one.keys().collect::<Vec<_>>(), ["none"]);
    let (json, _) = document(&bytes);
    assert_eq!(json["meshes"][0]["extras"]["targetNames"], json!(["none", "wide"]));
    let sparse = &json["accessors"]
        [json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"].as_u64().unwrap() as usize];
    assert_eq!(sparse["sparse"]["count"], 2);
    assert_eq!(sparse["min"][1], -0.5);
}

#[test]
fn damaged_morph_targets_are_told() {
    let names =
        |names: Value| changed_targets(|json| json["meshes"][0]["extras"] = json!({"targetNames": names}));
    assert_eq!(names(json!(["a"])).unwrap().keys().collect::<Vec<_>>(), ["a", "target 1"]);
    assert_eq!(names(json!(7)).unwrap().keys().collect::<Vec<_>>(), ["target 0", "target 1"]);
    let wide = |json: &Value| {
        json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"].as_u64().unwrap() as usize
    };
    let short = changed_targets(|json| {
        let at = wide(json);
        json["accessors"][at]["sparse"]["indices"]["byteOffset"] = json!(1_000_000);
    });
    assert!(matches!(short, Err(GlbError::OutOfRange { .. })), "{short:?}");
    let fewer = changed_targets(|json| {
        let at = wide(json);
        json["accessors"][at]["count"] = json!(3);
    });
    let told = fewer.unwrap_err().to_string();
    assert!(told.contains("morph target \"wide\""), "{told}");
    let beyond =
        changed_targets(|json| json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] = json!(999));
    assert!(matches!(beyond, Err(GlbError::Document(_))), "{beyond:?}");
}
