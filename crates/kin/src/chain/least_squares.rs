//! Damped least squares: all joints at once, the smallest change that closes the gap, within their ranges.
//!
//! Each step solves `(J Jᵀ + mu I) y = gap` and moves by `Jᵀ y`: three or six unknowns, however many joints. A
//! joint whose step would leave its range goes to the end of it and the rest is solved again. The damping falls
//! while steps help and grows when one does not; a step that does not help is not taken. Source: `wampler`. The
//! damping's rule: Source: `marquardt`.

use glam::{DQuat, DVec3};

use super::linkage::Linkage;
use super::restart::Run;
use super::{BallRange, Joint, Value};
use crate::{Frame, axis_angle, axis_angle::scaled_axis};

/// No joint turns further than this in one step, radians.
const STRIDE_RAD: f64 = 0.8;

/// Steps narrower than this that hardly help, four in a row, mean that the search has settled, radians.
const IDLE_RAD: f64 = 0.005;

/// Rounds in which joints may come to the end of their range within one step.
const ROUNDS: usize = 8;

/// One degree of freedom: what a small change of it does to the end, and how far it may go.
#[derive(Clone, Copy, Debug)]
struct Column {
    mover: usize,
    /// Change of the point, metres, and of the rotation, radians times [`Linkage::arm`], for each unit.
    does: [f64; 6],
    /// The least and the greatest step that the range allows.
    min: f64,
    max: f64,
    step: f64,
    stopped: bool,
}

/// A ball without range: its three freedoms need no columns.
#[derive(Clone, Copy, Debug)]
struct Free {
    mover: usize,
    /// From the joint to the point, metres.
    lever: DVec3,
    /// The turn to take, a rotation vector in the world.
    step: DVec3,
}

/// The room that a search needs, used again from step to step.
#[derive(Default)]
pub(super) struct Scratch {
    columns: Vec<Column>,
    free: Vec<Free>,
    frames: Vec<Frame>,
    trial: Vec<Value>,
    trial_frames: Vec<Frame>,
}

impl Linkage {
    /// Moves a state nearer to the goal until it is met, nothing helps any more, or the steps are used up. Says
    /// whether it is met.
    pub(super) fn least_squares(&self, state: &mut Vec<Value>, run: &mut Run, most: usize) -> bool {
        let mut scratch = std::mem::take(&mut run.scratch);
        let met = self.descend(state, run, most, &mut scratch);
        run.scratch = scratch;
        met
    }

    fn descend(&self, state: &mut Vec<Value>, run: &mut Run, most: usize, room: &mut Scratch) -> bool {
        let mut gap = self.gap(self.forward(state, &mut room.frames));
        let mut cost = self.cost(&gap);
        let (mut damping, mut idle) = (1e-3, 0);
        self.columns(state, room, gap.way);
        for _ in 0..most {
            if self.met(&gap) {
                return true;
            }
            if idle >= 4 || damping > 1e6 || !run.spend() {
                return false;
            }
            let widest = self.steps(gap.way, gap.turn, damping, room);
            self.moved(state, room);
            let next = self.gap(self.forward(&room.trial, &mut room.trial_frames));
            let next_cost = self.cost(&next);
            if next_cost < cost {
                idle = if next_cost > 0.99 * cost && widest < IDLE_RAD { idle + 1 } else { 0 };
                damping = (damping * 0.15_f64).max(1e-14);
                std::mem::swap(state, &mut room.trial);
                std::mem::swap(&mut room.frames, &mut room.trial_frames);
                (gap, cost) = (next, next_cost);
                self.columns(state, room, gap.way);
            } else {
                damping *= 8.0;
            }
        }
        self.met(&gap)
    }

    /// Fills in the degrees of freedom of a state whose frames are known.
    fn columns(&self, state: &[Value], room: &mut Scratch, way: DVec3) {
        room.columns.clear();
        room.free.clear();
        room.free.reserve(state.len());
        let end = self.target - way;
        for (k, (mover, &value)) in self.movers.iter().zip(state).enumerate() {
            let frame = room.frames[k];
            let lever = end - frame.position;
            let turn = |axis: DVec3| self.does(axis.cross(lever), axis);
            let mut add = |does, min, max| {
                room.columns.push(Column { mover: k, does, min, max, step: 0.0, stopped: min >= max });
            };
            match (mover.joint, value) {
                (Joint::Revolute { axis, range }, Value::Amount(x)) => {
                    add(turn(frame.vector(axis)), range.min - x, range.max - x);
                }
                (Joint::Prismatic { axis, range }, Value::Amount(x)) => {
                    let does = self.does(frame.vector(axis) * self.size, DVec3::ZERO);
                    add(does, (range.min - x) / self.size, (range.max - x) / self.size);
                }
                (Joint::Ball { range: None }, Value::Turn(_)) => {
                    room.free.push(Free { mover: k, lever, step: DVec3::ZERO });
                }
                (Joint::Ball { range: Some(range) }, Value::Turn(q)) => {
                    let world_from_joint = frame.rotation * q.conjugate();
                    for (axis, min, max) in Swing::of(&range, q).axes() {
                        add(turn(world_from_joint * axis), min, max);
                    }
                }
                _ => {}
            }
        }
    }

    fn does(&self, way: DVec3, turn: DVec3) -> [f64; 6] {
        let turn = turn * self.arm();
        [way.x, way.y, way.z, turn.x, turn.y, turn.z]
    }

    /// Sets the steps that close a gap best, and returns the widest.
    fn steps(&self, way: DVec3, turn: DVec3, damping: f64, room: &mut Scratch) -> f64 {
        let turn = turn * self.arm();
        let mut gap = [way.x, way.y, way.z, turn.x, turn.y, turn.z];
        let Scratch { columns, free, .. } = room;
        for column in &mut *columns {
            column.stopped = column.min >= column.max;
            column.step = 0.0;
        }
        let balls = self.balls(free);
        let mut y = [0.0; 6];
        for _ in 0..ROUNDS {
            y = if self.rotation.is_some() {
                damped::<6>(columns, &balls, &gap, damping)
            } else {
                damped::<3>(columns, &balls, &gap, damping)
            };
            if !stop(columns, &y, &mut gap) {
                break;
            }
        }
        let (way, turn) = (DVec3::new(y[0], y[1], y[2]), DVec3::new(y[3], y[4], y[5]) * self.arm());
        for ball in &mut *free {
            ball.step = ball.lever.cross(way) + turn;
        }
        let widest = columns.iter().fold(0.0_f64, |widest, column| widest.max(column.step.abs()));
        let widest = free.iter().fold(widest, |widest, ball| widest.max(ball.step.length()));
        if widest > STRIDE_RAD {
            columns.iter_mut().for_each(|column| column.step *= STRIDE_RAD / widest);
            free.iter_mut().for_each(|ball| ball.step *= STRIDE_RAD / widest);
        }
        widest.min(STRIDE_RAD)
    }

    /// `J Jᵀ` of the balls without range, the lower half: a turn about any axis moves the point by `axis x lever`.
    fn balls(&self, free: &[Free]) -> [[f64; 6]; 6] {
        let mut a = [[0.0; 6]; 6];
        let arm = self.arm();
        for Free { lever: r, .. } in free {
            a[0][0] += r.y * r.y + r.z * r.z;
            a[1][0] -= r.x * r.y;
            a[1][1] += r.x * r.x + r.z * r.z;
            a[2][0] -= r.x * r.z;
            a[2][1] -= r.y * r.z;
            a[2][2] += r.x * r.x + r.y * r.y;
            if self.rotation.is_some() {
                for (row, axis) in DVec3::AXES.into_iter().enumerate() {
                    let turn = axis.cross(*r) * arm;
                    for (sum, value) in a[3 + row].iter_mut().zip(turn.to_array()) {
                        *sum += value;
                    }
                    a[3 + row][3 + row] += arm * arm;
                }
            }
        }
        a
    }

    /// Writes the state after the steps.
    fn moved(&self, state: &[Value], room: &mut Scratch) {
        let Scratch { columns, free, frames, trial, .. } = room;
        trial.clear();
        trial.extend_from_slice(state);
        for ball in &*free {
            if let Value::Turn(q) = state[ball.mover] {
                let in_node = frames[ball.mover].rotation.conjugate() * ball.step;
                trial[ball.mover] = Value::Turn((q * scaled_axis(in_node)).normalize());
            }
        }
        let mut rest = &columns[..];
        while let Some(first) = rest.first() {
            let k = first.mover;
            let many = if matches!(self.movers[k].joint, Joint::Ball { .. }) { 3 } else { 1 };
            let (now, after) = rest.split_at(many);
            rest = after;
            trial[k] = match (self.movers[k].joint, state[k]) {
                (Joint::Revolute { range, .. }, Value::Amount(x)) => {
                    Value::Amount(range.clamp(x + now[0].step))
                }
                (Joint::Prismatic { range, .. }, Value::Amount(x)) => {
                    Value::Amount(range.clamp(x + now[0].step * self.size))
                }
                (Joint::Ball { range: Some(range) }, Value::Turn(q)) => Value::Turn(
                    Swing::of(&range, q).moved(&range, q, [now[0].step, now[1].step, now[2].step]),
                ),
                (_, value) => value,
            };
        }
    }
}

/// Sets the steps of columns that are not stopped, and stops those that come to an end of their range: what they
/// do is taken off the gap. Says whether any did.
fn stop(columns: &mut [Column], y: &[f64; 6], gap: &mut [f64; 6]) -> bool {
    let mut any = false;
    for column in columns.iter_mut().filter(|column| !column.stopped) {
        let step: f64 = column.does.iter().zip(y).map(|(a, b)| a * b).sum();
        column.step = step.max(column.min).min(column.max);
        if column.step != step {
            column.stopped = true;
            any = true;
            for (missing, does) in gap.iter_mut().zip(&column.does) {
                *missing -= does * column.step;
            }
        }
    }
    any
}

/// Where a ball joint with a range is: the bone's direction and the twist, with the ways that leave each other alone.
struct Swing {
    direction: DVec3,
    twist: f64,
    /// Away from the cone's axis.
    out: DVec3,
    /// Along the rim.
    along: DVec3,
    /// Steps away from the axis that the cone allows.
    out_min: f64,
    out_max: f64,
    twist_min: f64,
    twist_max: f64,
    bone: DVec3,
}

impl Swing {
    fn of(range: &BallRange, q: DQuat) -> Swing {
        let (swing, twist) = range.split(q);
        let direction = swing * range.bone;
        let angle = range.cone.angle(direction);
        let across = direction - range.cone.axis * range.cone.axis.dot(direction);
        let side = across.try_normalize().filter(|_| across.length() > 1e-9);
        let side = side.unwrap_or_else(|| range.cone.axis.any_orthonormal_vector());
        let out = (side - direction * side.dot(direction)).try_normalize();
        let out = out.unwrap_or_else(|| direction.any_orthonormal_vector());
        Swing {
            direction,
            twist,
            out,
            along: direction.cross(out),
            out_min: -range.cone.half_angle - angle,
            out_max: range.cone.half_angle - angle,
            twist_min: range.twist.min - twist,
            twist_max: range.twist.max - twist,
            bone: range.bone,
        }
    }

    /// The axes of the joint's three freedoms in its frame, and how far each may go: away from the cone's axis,
    /// along the rim, twist.
    ///
    /// While the bone swings along a tangent `e` and the twist stays, the joint turns about `d x e + c d` with
    /// `c` such that the axis is perpendicular to the bone's rest and present directions' sum (Listing's law).
    fn axes(&self) -> [(DVec3, f64, f64); 3] {
        let upright = 1.0 + self.bone.dot(self.direction);
        let axis = |tangent: DVec3| {
            let across = self.direction.cross(tangent);
            let c = if upright > 0.05 { across.dot(self.bone) / upright } else { 0.0 };
            across - self.direction * c
        };
        [
            (axis(self.out), self.out_min, self.out_max.max(0.0)),
            (axis(self.along), f64::NEG_INFINITY, f64::INFINITY),
            (self.direction, self.twist_min, self.twist_max),
        ]
    }

    /// The rotation after a step, in range.
    fn moved(&self, range: &BallRange, q: DQuat, step: [f64; 3]) -> DQuat {
        if step == [0.0; 3] {
            return q;
        }
        let swing = scaled_axis(self.direction.cross(self.out * step[0] + self.along * step[1]));
        let direction = range.cone.clamp((swing * self.direction).normalize());
        let twist = range.twist.clamp(self.twist + step[2]);
        if 1.0 + self.bone.dot(direction) < 0.05 {
            let turned = scaled_axis(self.axes().iter().zip(step).map(|(axis, step)| axis.0 * step).sum());
            return range.clamp((turned * q).normalize());
        }
        (DQuat::from_rotation_arc(self.bone, direction) * axis_angle(self.bone, twist)).normalize()
    }
}

/// `y` of `(J Jᵀ + mu I) y = gap` over the columns that may move; the first `N` rows.
fn damped<const N: usize>(
    columns: &[Column],
    balls: &[[f64; 6]; 6],
    gap: &[f64; 6],
    damping: f64,
) -> [f64; 6] {
    let mut a = [[0.0; N]; N];
    for (row, ball) in a.iter_mut().zip(balls) {
        row.copy_from_slice(&ball[..N]);
    }
    for column in columns.iter().filter(|column| !column.stopped) {
        for (i, row) in a.iter_mut().enumerate() {
            for (j, sum) in row[..=i].iter_mut().enumerate() {
                *sum += column.does[i] * column.does[j];
            }
        }
    }
    let mean = (0..N).map(|i| a[i][i]).sum::<f64>() / N as f64;
    for (i, row) in a.iter_mut().enumerate() {
        row[i] += (damping * mean).max(f64::MIN_POSITIVE);
    }
    cholesky(a, gap)
}

/// Solves for a symmetric, positive matrix, of which the lower half is given.
fn cholesky<const N: usize>(mut a: [[f64; N]; N], b: &[f64; 6]) -> [f64; 6] {
    let mut y = [0.0; 6];
    for i in 0..N {
        for j in 0..=i {
            let left = a[i][j] - (0..j).map(|k| a[i][k] * a[j][k]).sum::<f64>();
            a[i][j] = if i == j { left.max(f64::MIN_POSITIVE).sqrt() } else { left / a[j][j] };
        }
        let known: f64 = (0..i).map(|k| a[i][k] * y[k]).sum();
        y[i] = (b[i] - known) / a[i][i];
    }
    for i in (0..N).rev() {
        let known: f64 = (i + 1..N).map(|k| a[k][i] * y[k]).sum();
        y[i] = (y[i] - known) / a[i][i];
    }
    y
}
