//! The end of a limb turned to a given rotation: the forearm's twist and the wrist, or the ankle.

use glam::{DMat3, DQuat, DVec3};
use kin::{Interval, wrapped};

use crate::limb_rig::set;
use crate::{Articulation, Bone, Dof, Figure, Limb, Pose};

/// One axis between the hinge and the end: which angle, about what.
struct Axis {
    bone: Bone,
    dof: Dof,
    axis: DVec3,
    range: Interval,
}

/// Turns the end so that its rotation, seen from the bent hinge, is as given; with `ranges` each angle stops
/// at its range, stretched to hold the angle of `from`. Says whether one was stopped.
pub(crate) fn turn_end(
    figure: &Figure,
    pose: &mut Pose,
    limb: Limb,
    hinge_from_end: DQuat,
    from: &Pose,
    ranges: bool,
) -> bool {
    let axes = axes(figure, limb);
    let angles = fitted(figure, pose, limb, &axes, hinge_from_end);
    let mut stopped = false;
    for (axis, angle) in axes.iter().zip(angles) {
        let range =
            if ranges { axis.range.reaching(from.angles(axis.bone).get(axis.dof)) } else { Interval::FREE };
        let degrees = nearest_turn(angle.to_degrees(), pose.angles(axis.bone).get(axis.dof), range);
        let held = range.clamp(degrees);
        stopped |= (held - degrees).abs() > 1e-9;
        set(pose, axis.bone, axis.dof, held);
    }
    stopped
}

/// The angle plus whole turns that lies in the range, else nearest to what it was.
fn nearest_turn(degrees: f64, was: f64, range: Interval) -> f64 {
    let base = degrees + 360.0 * ((was - degrees) / 360.0).round();
    let inside = [base, base - 360.0, base + 360.0];
    let best = |a: &f64, b: &f64| {
        range.excess(*a).total_cmp(&range.excess(*b)).then((a - was).abs().total_cmp(&(b - was).abs()))
    };
    inside.into_iter().min_by(best).unwrap_or(base)
}

/// The degrees of freedom between hinge and end, outermost first.
fn axes(figure: &Figure, limb: Limb) -> Vec<Axis> {
    let parts = limb.parts();
    let mut axes = Vec::with_capacity(4);
    for bone in [parts.hinge, parts.end] {
        let Some(joint) = figure.skeleton.joint(bone) else { continue };
        match &joint.articulation {
            Articulation::Hinges(hinges) => {
                let turning = hinges.iter().filter(|h| !(bone == parts.hinge && h.dof == Dof::Flexion));
                axes.extend(turning.map(|h| Axis { bone, dof: h.dof, axis: h.axis, range: h.range }));
            }
            Articulation::Ball { ball, ranges, .. } => {
                let balls = [ball.flexion, ball.abduction, ball.twist];
                axes.extend(Dof::ALL.into_iter().zip(balls).map(|(dof, axis)| Axis {
                    bone,
                    dof,
                    axis,
                    range: ranges[dof as usize],
                }));
            }
        }
    }
    axes
}

/// The angles in radians that bring the end nearest to the rotation.
fn fitted(figure: &Figure, pose: &Pose, limb: Limb, axes: &[Axis], goal: DQuat) -> Vec<f64> {
    let end = figure.skeleton.joint(limb.parts().end).map(|joint| &joint.articulation);
    match (axes, end) {
        ([_, _, _], Some(Articulation::Ball { ball, .. })) => ball.angles(goal).to_vec(),
        ([a, b, c], _) => fit(axes, three_turns([a.axis, b.axis, c.axis], goal).to_vec(), goal),
        _ => fit(axes, axes.iter().map(|a| pose.angles(a.bone).get(a.dof).to_radians()).collect(), goal),
    }
}

/// The turns about three axes, each perpendicular to the next, whose product is the rotation; the middle one is
/// in -90 to 90 degrees.
fn three_turns(axes: [DVec3; 3], goal: DQuat) -> [f64; 3] {
    let [first, second, third] = axes;
    let handed = first.dot(second.cross(third)).signum();
    let carried = goal * third;
    let middle = (handed * first.dot(carried)).clamp(-1.0, 1.0).asin();
    let swung = DQuat::from_axis_angle(second, middle) * third;
    let outer = about(first, swung, carried);
    let rest =
        (DQuat::from_axis_angle(first, outer) * DQuat::from_axis_angle(second, middle)).conjugate() * goal;
    let inner = 2.0 * DVec3::new(rest.x, rest.y, rest.z).dot(third).atan2(rest.w);
    [outer, middle, wrapped(inner)]
}

/// The turn about an axis that takes one direction to another, radians.
fn about(axis: DVec3, from: DVec3, to: DVec3) -> f64 {
    axis.dot(from.cross(to)).atan2(from.dot(to) - axis.dot(from) * axis.dot(to))
}

/// Gauss-Newton from a guess: exact at once where the axes are square, a few rounds where they are askew.
fn fit(axes: &[Axis], mut angles: Vec<f64>, goal: DQuat) -> Vec<f64> {
    for _ in 0..12 {
        let mut carried = DQuat::IDENTITY;
        let mut columns = [DVec3::ZERO; 3];
        for ((axis, angle), column) in axes.iter().zip(&angles).zip(&mut columns) {
            *column = carried * axis.axis;
            carried *= DQuat::from_axis_angle(axis.axis, *angle);
        }
        let off = goal * carried.conjugate();
        let off = if off.w < 0.0 { -off } else { off }.to_scaled_axis();
        if off.length() < 1e-14 {
            break;
        }
        // (J Jt + eps) x = off, step = Jt x: the least-squares step, also where axes line up.
        let spread = columns.iter().fold(DMat3::from_diagonal(DVec3::splat(1e-9)), |sum, c| sum + outer(*c));
        let x = spread.inverse() * off;
        for (angle, column) in angles.iter_mut().zip(columns) {
            *angle += column.dot(x);
        }
    }
    angles
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_turns_make_the_rotation() {
        let axes = [DVec3::X, -DVec3::Z, -DVec3::Y];
        for (outer, middle, inner) in [(0.3, -0.4, 0.2), (-2.5, 1.2, -0.5), (0.0, 0.0, 0.0), (3.0, -1.5, 0.3)]
        {
            let turns = [outer, middle, inner];
            let goal =
                axes.iter().zip(turns).fold(DQuat::IDENTITY, |q, (a, t)| q * DQuat::from_axis_angle(*a, t));
            for (found, turn) in three_turns(axes, goal).into_iter().zip(turns) {
                assert!((found - turn).abs() < 1e-12, "{found} for {turn}");
            }
        }
    }

    #[test]
    fn askew_axes_are_fitted() {
        let range = Interval::FREE;
        let axis =
            |x, y, z, dof| Axis { bone: Bone::LeftHand, dof, axis: DVec3::new(x, y, z).normalize(), range };
        let axes = [
            axis(1.0, 0.1, 0.0, Dof::Twist),
            axis(0.1, 0.0, -1.0, Dof::Flexion),
            axis(0.0, -1.0, 0.2, Dof::Abduction),
        ];
        let turns = [0.5, -0.6, 0.2];
        let goal =
            axes.iter().zip(turns).fold(DQuat::IDENTITY, |q, (a, t)| q * DQuat::from_axis_angle(a.axis, t));
        let guess = three_turns([axes[0].axis, axes[1].axis, axes[2].axis], goal).to_vec();
        for (found, turn) in fit(&axes, guess, goal).into_iter().zip(turns) {
            assert!((found - turn).abs() < 1e-10, "{found} for {turn}");
        }
    }
}
