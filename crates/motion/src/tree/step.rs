//! A step of a tree: weights go down it, then samples come up.

use super::bind::{ClipNode, Kind, StatesNode, Tree};
use super::mix;
use super::plan::Condition;
use super::state::{NodeState, TreeState};
use crate::cells::MOST_POINTS;
use crate::{Feather, FittedClip, Sample, Steering, Travel};

/// Longer time steps count as this many seconds.
const LONGEST_STEP_SECS: f64 = 1.0;
/// How far from its axis a turning figure's feet are taken to step, metres, for a figure of the reference size.
const TURNING_RADIUS_M: f64 = 0.15;

/// Where strides have this weight among what doesn't step, they alone tell how the feet bear: a foot that is
/// to step can't stand as well, however little it steps.
const STRIDES_DECIDE: f64 = 0.02;

/// Sums over the strides that have a weight, for the frequency that they share.
#[derive(Clone, Copy, Default)]
struct Cadence {
    /// Σ w L f: metres a second.
    way_rate: f64,
    /// Σ w L: metres.
    way: f64,
    /// Σ w f and Σ w.
    frequency: f64,
    weight: f64,
}

impl Cadence {
    fn add(&mut self, weight: f64, way_rate: f64, frequency: f64) {
        self.way_rate += weight * way_rate;
        self.way += weight * way_rate / frequency;
        self.frequency += weight * frequency;
        self.weight += weight;
    }

    /// Strides a second; a clip that steps on the spot has a say only among its like.
    fn strides_a_second(&self) -> Option<f64> {
        if self.way > 1e-9 {
            Some(self.way_rate / self.way)
        } else {
            (self.weight > 0.0).then(|| self.frequency / self.weight)
        }
    }
}

/// A step on its way down the tree.
struct Descent<'a> {
    state: &'a mut TreeState,
    steering: Steering,
    dt_secs: f64,
    /// Of the whole body, and of layers.
    cadence: [Cadence; 2],
}

impl Tree {
    /// Goes on by a time step, seconds: NaN and less than 0 count as 0, more than 1 as 1. Afterwards the
    /// state has the new sample, travel and weights. The state must be of this tree. Parameters may be any
    /// numbers; see [`Steering::tidied`].
    pub fn step(&self, state: &mut TreeState, steering: &Steering, dt_secs: f64) {
        let dt_secs = if dt_secs > 0.0 { dt_secs.min(LONGEST_STEP_SECS) } else { 0.0 };
        for node in &mut state.nodes {
            node.live = node.weight > 0.0;
            node.weight = 0.0;
        }
        state.clip_weights.fill(0.0);
        state.travel = Travel::default();
        (state.visits, state.samplings) = (0, 0);
        state.steering = steering.tidied();
        let steering = state.steering;
        let mut descent = Descent { state, steering, dt_secs, cadence: Default::default() };
        self.weigh(&mut descent, 0, 1.0, true);
        let [whole, layers] = descent.cadence;
        if let Some(frequency) = whole.strides_a_second().or(layers.strides_a_second()) {
            state.set_phase(state.phase + dt_secs * frequency);
        }
        self.sample(state, 0, 0);
    }

    /// Gives weights to a node that has one and to what is in it. `whole`: no layer.
    fn weigh(&self, descent: &mut Descent<'_>, node: usize, weight: f64, whole: bool) {
        descent.state.nodes[node].weight = weight;
        self.weigh_parts(descent, node, weight, whole);
        descent.state.nodes[node].strides = match &self.nodes[node].kind {
            Kind::Clip(clip) => f64::from(u8::from(self.clips[clip.clip].is_stride())),
            Kind::Pass(child) => descent.state.nodes[*child].strides,
            Kind::Mask { base, .. } | Kind::Additive { base, .. } => descent.state.nodes[*base].strides,
            Kind::Blend { children, .. } => descent.state.strides_of(children),
            Kind::Crossfade { children, .. } => descent.state.strides_of(children),
            Kind::States(states) => descent.state.strides_of(&states.children),
        };
    }

    fn weigh_parts(&self, descent: &mut Descent<'_>, node: usize, weight: f64, whole: bool) {
        match &self.nodes[node].kind {
            Kind::Clip(clip) => self.weigh_clip(descent, node, clip, weight, whole),
            Kind::Pass(child) => self.weigh(descent, *child, weight, whole),
            Kind::Blend { by, cells, children, .. } => {
                let mut place = [0.0; 3];
                place.iter_mut().zip(by).for_each(|(at, by)| *at = descent.steering.get(*by));
                let mut weights = [0.0; MOST_POINTS];
                cells.weights(place, &mut weights[..children.len()]);
                self.weigh_shares(descent, children, &weights, weight, whole);
            }
            Kind::Crossfade { by, over, feather, children } => {
                let to = feather.at((descent.steering.get(*by) - over.0) / (over.1 - over.0));
                self.weigh_shares(descent, children, &[1.0 - to, to], weight, whole);
            }
            Kind::States(states) => self.weigh_states(descent, states, weight, whole),
            Kind::Mask { base, layer, amount, .. } => {
                self.weigh(descent, *base, weight, whole);
                self.weigh_layer(descent, *layer, *amount, weight);
            }
            Kind::Additive { base, layer, less, amount, by } => {
                self.weigh(descent, *base, weight, whole);
                let part = by.map_or(1.0, |(by, full)| (descent.steering.get(by) / full).clamp(-1.0, 1.0));
                self.weigh_layer(descent, *layer, amount * part, weight);
                if let Some(less) = less {
                    self.weigh_layer(descent, *less, amount * part, weight);
                }
            }
        }
    }

    fn weigh_shares(
        &self,
        descent: &mut Descent<'_>,
        children: &[usize],
        shares: &[f64],
        weight: f64,
        whole: bool,
    ) {
        for (&child, &share) in children.iter().zip(shares) {
            descent.state.nodes[child].share = share;
            if share > 0.0 && weight * share > 0.0 {
                self.weigh(descent, child, weight * share, whole);
            }
        }
    }

    /// Layers may be taken off, too: their share may be less than 0, their weight in the whole isn't.
    fn weigh_layer(&self, descent: &mut Descent<'_>, layer: usize, share: f64, weight: f64) {
        descent.state.nodes[layer].share = share;
        if weight * share.abs() > 0.0 {
            self.weigh(descent, layer, weight * share.abs(), false);
        }
    }

    fn weigh_states(&self, descent: &mut Descent<'_>, states: &StatesNode, weight: f64, whole: bool) {
        if descent.dt_secs > 0.0 {
            let current = descent.state.machines[states.machine].current;
            let mut ways = states.ways.iter().filter(|way| way.from == current);
            let child = states.children[current];
            let open =
                ways.find(|way| way.when.iter().all(|condition| self.holds(descent, *condition, child)));
            let machine = &mut descent.state.machines[states.machine];
            if let Some(way) = open {
                machine.set_out(way.to, way.secs, way.feather);
            }
            machine.go_on(descent.dt_secs);
        }
        for (s, &child) in states.children.iter().enumerate() {
            let share = descent.state.machines[states.machine].weights[s];
            descent.state.nodes[child].share = share;
            if share > 0.0 && weight * share > 0.0 {
                self.weigh(descent, child, weight * share, whole);
            }
        }
    }

    fn holds(&self, descent: &Descent<'_>, condition: Condition, child: usize) -> bool {
        match condition {
            Condition::Above(by, value) => descent.steering.get(by) > value,
            Condition::Below(by, value) => descent.steering.get(by) < value,
            Condition::Sit => descent.steering.sit,
            Condition::Stand => !descent.steering.sit,
            Condition::EndsWithin(secs) => {
                self.secs_left(descent.state, child).is_some_and(|left| left <= secs)
            }
        }
    }

    /// The longest that a clip of a node that doesn't loop and had a weight in the last step still goes on.
    fn secs_left(&self, state: &TreeState, node: usize) -> Option<f64> {
        let ends = self.nodes[node].all.clone().filter_map(|n| {
            let Kind::Clip(clip) = &self.nodes[n].kind else { return None };
            let fitted = &self.clips[clip.clip];
            let NodeState { clock, live, .. } = state.nodes[n];
            let left = if clip.pace > 0.0 { 1.0 - clock } else { clock };
            let ends = live && !fitted.loops() && !fitted.is_stride();
            ends.then(|| left * fitted.length_secs() / clip.pace.abs())
        });
        ends.reduce(f64::max)
    }

    fn weigh_clip(&self, descent: &mut Descent<'_>, node: usize, clip: &ClipNode, weight: f64, whole: bool) {
        let fitted = &self.clips[clip.clip];
        let travel = fitted.travel();
        let frequency = clip.pace / fitted.length_secs();
        if fitted.is_stride() {
            let arc = travel.turn_rate.to_radians().abs() * TURNING_RADIUS_M * self.pace * self.pace;
            let way_rate = (travel.velocity.length() + arc) * clip.pace;
            descent.cadence[usize::from(!whole)].add(weight, way_rate, frequency);
        } else {
            let node = &mut descent.state.nodes[node];
            node.clock = own_clock(node, fitted, frequency, descent.dt_secs);
        }
        if whole {
            let side = if clip.mirrored { -1.0 } else { 1.0 };
            let out = &mut descent.state.travel;
            out.velocity.x += weight * clip.pace * side * travel.velocity.x;
            out.velocity.y += weight * clip.pace * travel.velocity.y;
            out.turn_rate += weight * (clip.pace * side * travel.turn_rate + clip.turn);
            descent.state.clip_weights[clip.clip] += weight;
        }
    }

    /// Takes a node's sample into the place `at`; places beyond are room to reckon in.
    fn sample(&self, state: &mut TreeState, node: usize, at: usize) {
        state.visits += 1;
        match &self.nodes[node].kind {
            Kind::Clip(clip) => self.sample_clip(state, node, clip, at),
            Kind::Pass(child) => self.sample(state, *child, at),
            Kind::Blend { children, .. } => self.sample_shares(state, children, at),
            Kind::Crossfade { children, .. } => self.sample_shares(state, children, at),
            Kind::States(states) => self.sample_shares(state, &states.children, at),
            Kind::Mask { base, layer, bones, .. } => {
                self.sample(state, *base, at);
                if state.nodes[*layer].weight > 0.0 {
                    self.sample(state, *layer, at + 1);
                    let share = state.nodes[*layer].share;
                    let (out, layer) = split(state, at, at + 1);
                    mix::mask(out, bones, share, layer);
                }
            }
            Kind::Additive { base, layer, less, .. } => {
                self.sample(state, *base, at);
                if state.nodes[*layer].weight > 0.0 {
                    self.sample_layer(state, *layer, *less, at);
                }
            }
        }
    }

    fn sample_layer(&self, state: &mut TreeState, layer: usize, less: Option<usize>, at: usize) {
        let share = state.nodes[layer].share;
        self.sample(state, layer, at + 1);
        let (out, of_layer) = split(state, at, at + 1);
        mix::add_angles(out, share, of_layer);
        if let Some(less) = less {
            out.hips += of_layer.hips * share;
            self.sample(state, less, at + 2);
            let (out, of_less) = split(state, at, at + 2);
            mix::add_angles(out, -share, of_less);
            out.hips -= of_less.hips * share;
        }
    }

    fn sample_shares(&self, state: &mut TreeState, children: &[usize], at: usize) {
        let all_strides = state.strides_of(children);
        let others = 1.0 - Feather::Smooth.at(all_strides / STRIDES_DECIDE);
        let mut first = true;
        for &child in children {
            let NodeState { share, weight, strides, .. } = state.nodes[child];
            if weight <= 0.0 {
                continue;
            }
            let bearing = if all_strides > 0.0 {
                share * (others + (1.0 - others) * (strides / all_strides))
            } else {
                share
            };
            if first {
                self.sample(state, child, at);
                if share != 1.0 {
                    mix::scale(&mut state.samples[at], share, bearing);
                }
                first = false;
            } else {
                self.sample(state, child, at + 1);
                let (out, other) = split(state, at, at + 1);
                mix::add(out, share, bearing, other);
            }
        }
    }

    fn sample_clip(&self, state: &mut TreeState, node: usize, clip: &ClipNode, at: usize) {
        state.samplings += 1;
        let fitted = &self.clips[clip.clip];
        let phase = match (fitted.is_stride(), clip.mirrored) {
            (true, false) => state.phase,
            // The mirror image of a stride begins with the right heel: half a stride on, the left one's.
            (true, true) => {
                if state.phase < 0.5 {
                    state.phase + 0.5
                } else {
                    state.phase - 0.5
                }
            }
            (false, _) => state.nodes[node].clock,
        };
        let out = &mut state.samples[at];
        fitted.sample(phase, out);
        if clip.mirrored {
            mix::mirror(out, &self.twins);
        }
    }
}

impl TreeState {
    /// Which part of some children is strides.
    fn strides_of(&self, children: &[usize]) -> f64 {
        let live = children.iter().map(|&child| &self.nodes[child]).filter(|node| node.weight > 0.0);
        live.map(|node| node.share * node.strides).sum()
    }
}

/// The phase of a clip that is no stride: loops go round, others begin as they get a weight and stay at their
/// end.
fn own_clock(node: &NodeState, clip: &FittedClip, frequency: f64, dt_secs: f64) -> f64 {
    if clip.loops() {
        let clock = (node.clock + dt_secs * frequency).rem_euclid(1.0);
        if clock < 1.0 { clock } else { 0.0 }
    } else if node.live {
        (node.clock + dt_secs * frequency).clamp(0.0, 1.0)
    } else if frequency > 0.0 {
        0.0
    } else {
        1.0
    }
}

/// One sample to write, another to read; the latter stands behind.
fn split(state: &mut TreeState, to: usize, from: usize) -> (&mut Sample, &Sample) {
    let (before, behind) = state.samples.split_at_mut(from);
    (&mut before[to], &behind[0])
}
