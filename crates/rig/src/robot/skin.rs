//! A robot as skins: links are drawn as rigid parts of meshes that a renderer of figures draws as well.

use glam::{DQuat, DVec3, Vec3};
use kin::Frame;

use super::{Robot, RobotLink, Shape, Visual};
use crate::dual_quaternion::DualQuaternion;
use crate::{Bone, Bounds, Mesh, Palette};

/// Links in one mesh: each takes a place of its palette that is a bone's.
const LINKS: usize = Bone::COUNT;

/// The looks of a robot, as many links a mesh as there are bones: link `i` is moved by place `i % 55` of mesh `i / 55`.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct RobotSkin {
    /// The meshes, at least one.
    pub meshes: Vec<Mesh>,
    /// What is seen of each link, in its own frame; empty for links of which nothing is.
    bounds: Vec<Bounds>,
}

impl RobotSkin {
    /// The looks of a robot: what its file shows of it, or else what bumps into things, or else rods between its joints.
    pub fn of(robot: &Robot) -> RobotSkin {
        let mut skin = RobotSkin::default();
        let seen = Seen::of(robot);
        let thickness = if seen == Seen::Bones { robot.bone_radius() } else { 0.0 };
        for (i, link) in robot.links().iter().enumerate() {
            if i % LINKS == 0 {
                skin.meshes.push(Mesh::default());
            }
            let mesh = &mut skin.meshes[i / LINKS];
            let first = mesh.positions.len();
            let own = match seen {
                Seen::Visuals => &link.visuals,
                Seen::Collisions => &link.collisions,
                Seen::Bones => &robot.bones(i, thickness),
            };
            for visual in own.iter().filter(|v| seen == Seen::Visuals || !is_missing(&v.shape)) {
                add(mesh, &visual.solid(), visual.link_from_visual, (i % LINKS) as u8);
            }
            skin.bounds.push(Bounds::of(mesh.positions[first..].iter().map(|p| Vec3::from_array(*p))));
        }
        skin
    }

    /// The mesh and the place of its palette that show a link; as a bone, which is how parts of a figure are marked.
    pub fn place_of(link: usize) -> (usize, Bone) {
        (link / LINKS, Bone::ALL[link % LINKS])
    }

    /// The palette of each mesh for links at those frames.
    pub fn palettes(&self, world_from_link: &[Frame]) -> Vec<Palette> {
        let mut palettes = vec![Palette::REST; self.meshes.len()];
        for (i, frame) in world_from_link.iter().enumerate() {
            if let Some(palette) = palettes.get_mut(i / LINKS) {
                palette.0[i % LINKS] =
                    DualQuaternion::rigid(frame.rotation, DVec3::ZERO, frame.position).to_rows();
            }
        }
        palettes
    }

    /// A box around the robot with its links at those frames: what is seen of them, and every link's origin.
    pub fn bounds(&self, world_from_link: &[Frame]) -> Bounds {
        let links = self.bounds.iter().zip(world_from_link);
        links.fold(Bounds::EMPTY, |all, (own, frame)| {
            let place = |p: Vec3| frame.point(p.as_dvec3()).as_vec3();
            let corners = if own.is_empty() { Vec::new() } else { own.corners().map(place).to_vec() };
            corners.into_iter().fold(all.with(frame.position.as_vec3()), Bounds::with)
        })
    }
}

/// What stands for a robot's looks.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Seen {
    Visuals,
    Collisions,
    Bones,
}

impl Seen {
    fn of(robot: &Robot) -> Seen {
        let any = |of: &dyn Fn(&RobotLink) -> bool| robot.links().iter().any(of);
        if any(&|link| !link.visuals.is_empty()) {
            Seen::Visuals
        } else if any(&|link| link.collisions.iter().any(|v| !is_missing(&v.shape))) {
            Seen::Collisions
        } else {
            Seen::Bones
        }
    }
}

fn is_missing(shape: &Shape) -> bool {
    matches!(shape, Shape::Mesh { solid: None, .. })
}

impl Robot {
    /// How thick the rods are of a robot that shows nothing else, metres.
    fn bone_radius(&self) -> f64 {
        let far = |f: &Frame| f.position.length();
        0.02 * self.frames(&self.rest()).iter().map(far).fold(0.1, f64::max)
    }

    /// Rods of that radius from a link's origin to the joints that it carries, and a ball where it begins.
    fn bones(&self, link: usize, radius: f64) -> Vec<Visual> {
        let visual = |at: DVec3, toward: DVec3, shape| Visual {
            name: None,
            link_from_visual: Frame::new(
                DQuat::from_rotation_arc(DVec3::Z, toward.try_normalize().unwrap_or(DVec3::Z)),
                at,
            ),
            shape,
            paint: None,
        };
        let mut bones = vec![visual(DVec3::ZERO, DVec3::Z, Shape::Sphere(1.5 * radius))];
        let carried = (0..self.joints().len()).filter(|&i| self.carrier(i) == Some(link));
        for end in carried.map(|i| self.joints()[i].parent_from_joint.position) {
            let length = end.length();
            if length > radius {
                bones.push(visual(end * 0.5, end, Shape::Capsule { radius, length }));
            }
        }
        bones
    }
}

fn add(mesh: &mut Mesh, solid: &super::Solid, link_from_visual: Frame, place: u8) {
    let first = mesh.positions.len() as u32;
    for ((position, normal), color) in solid.positions.iter().zip(&solid.normals).zip(&solid.colors) {
        let at = link_from_visual.point(Vec3::from_array(*position).as_dvec3());
        let out = link_from_visual.rotation * Vec3::from_array(*normal).as_dvec3();
        mesh.positions.push(at.as_vec3().to_array());
        mesh.normals.push(out.as_vec3().to_array());
        mesh.colors.push(*color);
        mesh.joints.push([place, 0, 0, 0]);
        mesh.weights.push([u16::MAX, 0, 0, 0]);
    }
    mesh.indices.extend(solid.indices.iter().map(|i| first + i));
}

#[cfg(test)]
mod tests {
    use kin::Interval;

    use super::*;
    use crate::{NewLink, RobotLink, RobotPose, skin_positions};

    #[test]
    fn every_link_is_drawn_where_it_is_whatever_their_number() {
        let root = RobotLink { name: "root".to_owned(), tip: Some(DVec3::X), ..RobotLink::default() };
        let mut robot = Robot::new("line", vec![root], Vec::new()).unwrap();
        for i in 1..=120 {
            let name = format!("link{i}");
            let range = Interval::new(-1.0, 1.0);
            robot = robot.appended(i - 1, NewLink { name, length: 1.0, range, axis: DVec3::Z }).unwrap();
        }
        let pose = RobotPose((0..120).map(|i| 0.02 * f64::from(i % 7)).collect());
        let stand = Frame::new(DQuat::from_rotation_y(0.4), DVec3::new(0.3, 1.0, -2.0));
        let frames: Vec<Frame> = robot.frames(&pose).into_iter().map(|f| stand.then(f)).collect();
        let skin = RobotSkin::of(&robot);
        assert_eq!(skin.meshes.len(), 3);
        let palettes = skin.palettes(&frames);
        let around = skin.bounds(&frames);
        for (link, frame) in frames.iter().enumerate().skip(1) {
            let (mesh, bone) = RobotSkin::place_of(link);
            assert_eq!(skin.meshes[mesh].fault(), None);
            let posed = skin_positions(&skin.meshes[mesh], &palettes[mesh]);
            let own: Vec<Vec3> = (0..posed.len())
                .filter(|&v| usize::from(skin.meshes[mesh].joints[v][0]) == bone.index())
                .map(|v| posed[v])
                .collect();
            let middle = own.iter().sum::<Vec3>() / own.len() as f32;
            let expected = frame.point(DVec3::X * 0.5).as_vec3();
            assert!(middle.distance(expected) < 1e-3, "link {link}: {middle} instead of {expected}");
            assert!(own.iter().all(|p| Bounds::of([*p]).union(around).radius() <= around.radius() + 1e-4));
        }
    }

    #[test]
    fn what_shows_nothing_is_shown_as_rods() {
        let link = |name: &str| RobotLink { name: name.to_owned(), ..RobotLink::default() };
        let root = RobotLink { tip: Some(DVec3::X), ..link("root") };
        let new = |name: &str| NewLink {
            name: name.to_owned(),
            length: 1.0,
            range: Interval::new(-1.0, 1.0),
            axis: DVec3::Z,
        };
        let robot = Robot::new("line", vec![root], Vec::new()).unwrap();
        let robot = robot.appended(0, new("a")).unwrap().appended(1, new("b")).unwrap();
        let bare: Vec<RobotLink> =
            robot.links().iter().map(|l| RobotLink { visuals: Vec::new(), ..l.clone() }).collect();
        let bare = Robot::new("bare", bare, robot.joints().to_vec()).unwrap();
        let skin = RobotSkin::of(&bare);
        let frames = bare.frames(&bare.rest());
        let seen = skin.bounds(&frames);
        assert!(seen.min.x < 0.0 && seen.max.x > 2.0 && seen.max.y < 0.1, "{seen:?}");
        let mut shown = bare.links().to_vec();
        shown[0].collisions = vec![Visual {
            name: None,
            link_from_visual: Frame::IDENTITY,
            shape: Shape::Sphere(0.5),
            paint: None,
        }];
        let bumping = Robot::new("bumping", shown, robot.joints().to_vec()).unwrap();
        let seen = RobotSkin::of(&bumping).bounds(&frames[..1]);
        assert!((seen.max.y - 0.5).abs() < 0.01, "{seen:?}");
    }
}
