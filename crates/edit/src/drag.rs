//! Where a dragged point goes: the pointer's line of sight, an optional axis or plane, slowness and steps.

use glam::DVec3;
use rig::{Camera, Projection, Ray};

/// An axis of the world.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Axis {
    /// To the figure's left.
    X,
    /// Up.
    Y,
    /// To the front.
    Z,
}

impl Axis {
    /// All three.
    pub const ALL: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

    /// Its unit vector, world.
    pub const fn vector(self) -> DVec3 {
        match self {
            Axis::X => DVec3::X,
            Axis::Y => DVec3::Y,
            Axis::Z => DVec3::Z,
        }
    }

    /// `X`, `Y` or `Z`.
    pub const fn name(self) -> &'static str {
        match self {
            Axis::X => "X",
            Axis::Y => "Y",
            Axis::Z => "Z",
        }
    }
}

/// What a drag is held to.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Constraint {
    /// The plane of the view through the first point.
    #[default]
    View,
    /// The line along an axis through the first point.
    Along(Axis),
    /// The plane across an axis through the first point.
    Across(Axis),
}

/// What is held down while dragging.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Modifiers {
    /// A tenth of the way, from where this began.
    pub slow: bool,
    /// Whole centimetres along the world's axes, counted from the first point; whole steps of 5 degrees for a turn.
    /// It suspends what snaps by itself, and makes snap what doesn't.
    pub snap: bool,
    /// The rings of hand, forearm and foot turn about the articulator, which stays.
    pub in_contact: bool,
}

/// A point on the pointer.
#[derive(Clone, PartialEq, Debug)]
pub struct Drag {
    first: DVec3,
    view: Plane,
    sight: Sight,
    constraint: Constraint,
    slow: bool,
    /// Where the pointer is in the view's plane.
    pointer: DVec3,
    /// Where the pointer was when slowness last began or ended, and where it counted as being.
    turning: (DVec3, DVec3),
}

/// All points whose product with the unit normal is the same as the given point's.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Plane {
    through: DVec3,
    normal: DVec3,
}

/// How the camera looks at a point.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Sight {
    /// From one place.
    From(DVec3),
    /// In one direction.
    Along(DVec3),
}

/// Slowed, a drag goes this share of the way.
const SLOW: f64 = 0.1;
const SNAP_M: f64 = 0.01;
/// A line or plane whose angle to the line of sight has a smaller sine can't be followed.
const LEAST_SINE: f64 = 0.03;

impl Plane {
    fn meets(self, from: DVec3, direction: DVec3) -> Option<DVec3> {
        let rate = direction.dot(self.normal);
        let point = from + direction * ((self.through - from).dot(self.normal) / rate);
        (rate.abs() >= LEAST_SINE && point.is_finite()).then_some(point)
    }

    fn nearest(self, point: DVec3) -> DVec3 {
        point - self.normal * (point - self.through).dot(self.normal)
    }
}

impl Sight {
    fn toward(self, point: DVec3) -> DVec3 {
        match self {
            Sight::From(eye) => (point - eye).normalize_or_zero(),
            Sight::Along(direction) => direction,
        }
    }
}

impl Drag {
    /// Takes hold of a world point with the pointer on that ray; the camera must stay while the drag lasts.
    pub fn begin(first_in_world: DVec3, camera: &Camera, ray: Ray) -> Drag {
        let toward_viewer = camera.axes().z_axis.as_dvec3();
        let view = Plane { through: first_in_world, normal: toward_viewer };
        let pointer = view.meets(ray.origin.as_dvec3(), ray.direction.as_dvec3()).unwrap_or(first_in_world);
        Drag {
            first: first_in_world,
            view,
            sight: match camera.projection {
                Projection::Perspective => Sight::From(camera.eye().as_dvec3()),
                Projection::Orthographic => Sight::Along(-toward_viewer),
            },
            constraint: Constraint::View,
            slow: false,
            pointer,
            turning: (pointer, first_in_world),
        }
    }

    /// The point at which it began, metres, world.
    pub fn first_in_world(&self) -> DVec3 {
        self.first
    }

    /// What it is held to.
    pub fn constraint(&self) -> Constraint {
        self.constraint
    }

    /// Holds it to something, or to nothing but the view if it was held to just that.
    pub fn toggle(&mut self, constraint: Constraint) {
        self.constraint = if self.constraint == constraint { Constraint::View } else { constraint };
    }

    /// Where the point goes with the pointer on that ray, metres, world. Only the last ray counts, and those at which
    /// slowness began or ended; a ray that misses the plane of the view counts as the one before.
    pub fn point(&mut self, ray: Ray, modifiers: Modifiers) -> DVec3 {
        if modifiers.slow != self.slow {
            self.turning = (self.pointer, self.counted());
            self.slow = modifiers.slow;
        }
        let met = self.view.meets(ray.origin.as_dvec3(), ray.direction.as_dvec3());
        self.pointer = met.unwrap_or(self.pointer);
        let shift = self.held(self.counted()) - self.first;
        let snapped = if modifiers.snap { (shift / SNAP_M).round() * SNAP_M } else { shift };
        self.first + snapped
    }

    /// The direction in which a distance is counted that is typed: the axis that it is held to, else the way that the
    /// pointer has gone so far. `None` before it has gone any.
    pub fn direction(&self) -> Option<DVec3> {
        match self.constraint {
            Constraint::Along(axis) => Some(axis.vector()),
            Constraint::View | Constraint::Across(_) => {
                (self.held(self.counted()) - self.first).try_normalize()
            }
        }
    }

    /// Where the pointer counts as being in the view's plane.
    fn counted(&self) -> DVec3 {
        let share = if self.slow { SLOW } else { 1.0 };
        self.turning.1 + (self.pointer - self.turning.0) * share
    }

    /// The point of the line or plane that is seen nearest to a point of the view's plane.
    fn held(&self, point: DVec3) -> DVec3 {
        match self.constraint {
            Constraint::View => point,
            Constraint::Along(axis) => self.first + axis.vector() * self.along(axis.vector(), point),
            Constraint::Across(axis) => {
                let plane = Plane { through: self.first, normal: axis.vector() };
                let met = plane.meets(point, self.sight.toward(point));
                // Beyond the horizon the line of sight meets the plane behind the eye.
                let seen = met.filter(|met| match self.sight {
                    Sight::From(eye) => (met - eye).dot(self.view.normal) < 0.0,
                    Sight::Along(_) => true,
                });
                let point = seen.unwrap_or_else(|| plane.nearest(point));
                // The very coordinate, so that nothing creeps along the axis.
                match axis {
                    Axis::X => DVec3 { x: self.first.x, ..point },
                    Axis::Y => DVec3 { y: self.first.y, ..point },
                    Axis::Z => DVec3 { z: self.first.z, ..point },
                }
            }
        }
    }

    /// How far along a line through the first point the line of sight through another point passes nearest, metres;
    /// 0 for a line toward the eye.
    fn along(&self, axis: DVec3, point: DVec3) -> f64 {
        let (sight, from_point) = (self.sight.toward(point), self.first - point);
        let cosine = axis.dot(sight);
        let sine_squared = 1.0 - cosine * cosine;
        if sine_squared < LEAST_SINE * LEAST_SINE {
            return 0.0;
        }
        (cosine * sight.dot(from_point) - axis.dot(from_point)) / sine_squared
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use glam::{Vec2, Vec3};
    use rig::View;

    use super::*;

    const SIZE: Vec2 = Vec2::new(1000.0, 800.0);
    const PLAIN: Modifiers = Modifiers { slow: false, snap: false, in_contact: false };
    const SLOWLY: Modifiers = Modifiers { slow: true, snap: false, in_contact: false };
    const SNAPPED: Modifiers = Modifiers { slow: false, snap: true, in_contact: false };

    fn first() -> DVec3 {
        DVec3::new(0.4, 1.2, 0.15)
    }

    fn cameras() -> [Camera; 3] {
        let camera = Camera::default().seen_from(View::ThreeQuarter);
        let ortho = Camera { projection: Projection::Orthographic, ..camera };
        [camera, ortho, Camera::default().seen_from(View::Left)]
    }

    fn pixel(camera: &Camera, point: DVec3) -> Vec2 {
        camera.pixel_of(point.as_vec3(), SIZE).unwrap()
    }

    /// A drag of the first point, and a pixel of its own for every shift in the picture.
    fn begin(camera: &Camera) -> (Drag, impl Fn(f32, f32) -> Ray + use<>) {
        let (camera, start) = (*camera, pixel(camera, first()));
        let ray = move |x, y| camera.ray(start + Vec2::new(x, y), SIZE);
        (Drag::begin(first(), &camera, ray(0.0, 0.0)), ray)
    }

    #[test]
    fn the_point_stays_under_the_pointer_at_its_depth() {
        for camera in cameras() {
            let (mut drag, ray) = begin(&camera);
            assert_eq!(drag.point(ray(0.0, 0.0), PLAIN), first());
            let point = drag.point(ray(120.0, -70.0), PLAIN);
            let off = pixel(&camera, point) - pixel(&camera, first()) - Vec2::new(120.0, -70.0);
            assert!(off.length() < 0.02, "{off}");
            assert!((point - first()).dot(camera.axes().z_axis.as_dvec3()).abs() < 1e-6);
        }
    }

    #[test]
    fn an_axis_keeps_the_other_two_and_passes_nearest_to_the_pointer() {
        for camera in cameras() {
            for axis in Axis::ALL {
                let (mut drag, _) = begin(&camera);
                if axis.vector().dot(camera.axes().z_axis.as_dvec3()).abs() > 0.95 {
                    continue;
                }
                drag.toggle(Constraint::Along(axis));
                let goal = first() + axis.vector() * 0.17;
                let point = drag.point(camera.ray(pixel(&camera, goal), SIZE), PLAIN);
                assert!(point.distance(goal) < 1e-4, "{axis:?}: {point} {goal}");
                let beside = (point - first()).reject_from(axis.vector());
                assert_eq!(beside, DVec3::ZERO, "{axis:?}");
            }
        }
    }

    #[test]
    fn a_plane_keeps_its_axis_and_stays_under_the_pointer() {
        for camera in &cameras()[..2] {
            for axis in Axis::ALL {
                let (mut drag, _) = begin(camera);
                drag.toggle(Constraint::Across(axis));
                let goal = first() + DVec3::new(0.03, -0.02, 0.04).reject_from(axis.vector());
                let point = drag.point(camera.ray(pixel(camera, goal), SIZE), PLAIN);
                assert!(point.distance(goal) < 1e-5, "{axis:?}: {point} {goal}");
            }
        }
    }

    #[test]
    fn a_constraint_set_twice_is_none() {
        let (mut drag, ray) = begin(&cameras()[0]);
        let free = drag.point(ray(30.0, 10.0), PLAIN);
        drag.toggle(Constraint::Along(Axis::X));
        drag.toggle(Constraint::Across(Axis::Y));
        assert_eq!(drag.constraint(), Constraint::Across(Axis::Y));
        drag.toggle(Constraint::Across(Axis::Y));
        assert_eq!(drag.point(ray(30.0, 10.0), PLAIN), free);
    }

    #[test]
    fn slowness_counts_from_where_it_began_and_nothing_jumps_when_it_ends() {
        for camera in cameras() {
            let (mut drag, ray) = begin(&camera);
            let before = drag.point(ray(100.0, 0.0), PLAIN);
            assert!(drag.point(ray(100.0, 0.0), SLOWLY).distance(before) < 1e-12);
            let slowed = drag.point(ray(200.0, 0.0), SLOWLY);
            assert!(((slowed - first()).length() / (before - first()).length() - 1.1).abs() < 1e-4);
            assert!(drag.point(ray(200.0, 0.0), PLAIN).distance(slowed) < 1e-12);
            let after = drag.point(ray(100.0, 0.0), PLAIN);
            assert!(((after - first()).length() / (before - first()).length() - 0.1).abs() < 1e-4);
        }
    }

    #[test]
    fn steps_are_whole_centimetres_from_the_first_point() {
        for constraint in [Constraint::View, Constraint::Along(Axis::X), Constraint::Across(Axis::Z)] {
            let (mut drag, ray) = begin(&cameras()[0]);
            if constraint != Constraint::View {
                drag.toggle(constraint);
            }
            let (free, snapped) = (drag.point(ray(33.0, 21.0), PLAIN), drag.point(ray(33.0, 21.0), SNAPPED));
            let steps = (snapped - first()) * 100.0;
            assert!((steps - steps.round()).length() < 1e-9 && steps.length() >= 1.0, "{steps}");
            assert!((free - snapped).abs().max_element() <= 0.005 + 1e-9);
        }
    }

    #[test]
    fn only_the_last_pointer_counts() {
        let (mut one, ray) = begin(&cameras()[0]);
        let mut many = one.clone();
        for i in 0..50 {
            many.point(ray(i as f32 * 3.0, -i as f32), PLAIN);
        }
        assert_eq!(many.point(ray(77.0, 31.0), PLAIN), one.point(ray(77.0, 31.0), PLAIN));
    }

    #[test]
    fn what_cannot_be_followed_stays_finite() {
        let camera = Camera { projection: Projection::Orthographic, ..Camera::default() };
        let (mut drag, ray) = begin(&camera);
        drag.toggle(Constraint::Along(Axis::Z));
        assert_eq!(drag.point(ray(50.0, 50.0), PLAIN), first(), "a line toward the eye is not followed");
        drag.toggle(Constraint::Across(Axis::Y));
        let point = drag.point(ray(50.0, 50.0), PLAIN);
        assert!(point.is_finite() && (point.y - first().y).abs() < 1e-12, "{point}");
        for direction in [Vec3::NAN, Vec3::ZERO, Vec3::X] {
            assert_eq!(drag.point(Ray { origin: Vec3::ZERO, direction }, PLAIN), point);
        }
        let (mut drag, _) = begin(&Camera::default());
        drag.toggle(Constraint::Across(Axis::Y));
        let sky = Camera::default().ray(Vec2::new(500.0, -4000.0), SIZE);
        assert!(drag.point(sky, PLAIN).is_finite());
    }
}
