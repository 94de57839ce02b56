//! A figure that walks: tree, ground and time go in, a pose comes out.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use rig::{Figure, Place, Pose};

use crate::{
    Feather, FeetState, FootView, Footing, Ground, PlacedFoot, Placement, PlacementSettings, Sample,
    Steering, Travel, Tree, TreeState, lift_feet,
};

/// Longer time steps count as this many seconds.
const LONGEST_STEP_SECS: f64 = 1.0;
/// The slope ahead is that from as far behind to as far ahead, metres.
const SLOPE_REACH_M: f64 = 0.35;
/// How fast the slope ahead follows the ground: the time after which a third of a step in it is left.
const SLOPE_SECS: f64 = 0.25;
/// How long the feet take to the ground, and back, when that is switched on or off.
const SWITCH_SECS: f64 = 0.3;

/// A figure that walks. Same start, same steps, same bits.
#[derive(Clone, Debug)]
pub struct Walker {
    /// Whether feet are placed on the ground, if the tree does so. Without, they go as over flat ground that
    /// is as high as the ground under the figure. Between steps they don't jump: a change takes 0.3 s to come
    /// into force, except before the first.
    pub feet_on_ground: bool,
    figure: Arc<Figure>,
    tree: Arc<Tree>,
    state: TreeState,
    steering: Steering,
    slope: Option<f64>,
    footing: Option<Footing>,
    feet_state: FeetState,
    /// How far the placement is switched on, 0 to 1; `None` before the first step.
    switched: Option<f64>,
    flat: Sample,
    /// The turns of its hips, knees and ankles.
    turns: [[DQuat; 3]; 2],
    placed: Sample,
    pose: Pose,
    /// As they were placed in the last step.
    feet: Option<[PlacedFoot; 2]>,
}

impl Walker {
    /// A figure that stands at the origin, facing +Z. The tree's clips must be fitted to this figure.
    pub fn new(figure: Arc<Figure>, tree: Arc<Tree>) -> Walker {
        let mut walker = Walker {
            feet_on_ground: true,
            state: TreeState::new(&tree),
            steering: Steering::default(),
            slope: None,
            footing: Footing::of(&figure),
            feet_state: FeetState::default(),
            switched: None,
            flat: Sample::at_rest(&figure),
            turns: [[DQuat::IDENTITY; 3]; 2],
            placed: Sample::at_rest(&figure),
            pose: figure.rest_pose(),
            feet: None,
            figure,
            tree,
        };
        walker.take_flat();
        walker.take_pose();
        walker
    }

    /// Goes on by a time step, seconds: NaN and less than 0 count as 0, more than 1 as 1.
    pub fn step(&mut self, ground: &Ground, steering: &Steering, dt_secs: f64) {
        let dt_secs = if dt_secs > 0.0 { dt_secs.min(LONGEST_STEP_SECS) } else { 0.0 };
        self.steering = steering.tidied();
        self.steering.slope = self.slope_ahead(ground, dt_secs);
        self.tree.step(&mut self.state, &self.steering, dt_secs);
        self.pose.place = carried(self.pose.place, self.state.travel(), dt_secs);
        self.take_flat();
        self.place_feet(ground, dt_secs);
        self.take_pose();
    }

    /// From the tree's sample to one whose feet are not below flat ground.
    fn take_flat(&mut self) {
        self.flat.clone_from(self.state.sample());
        if let Some(footing) = &self.footing {
            // A clip alone has its feet where they belong.
            let alone = self.state.samplings() <= 1;
            self.turns = if alone { footing.turns(&self.flat) } else { lift_feet(footing, &mut self.flat) };
        }
        self.placed.clone_from(&self.flat);
    }

    fn take_pose(&mut self) {
        self.pose.hips = self.placed.hips;
        self.pose.angles = self.placed.angles;
    }

    /// From the sample over flat ground to one with the feet on the ground, as far as that is switched on.
    fn place_feet(&mut self, ground: &Ground, dt_secs: f64) {
        let goal = if self.feet_on_ground && self.tree.placement().is_some() { 1.0 } else { 0.0 };
        let former = self.switched.unwrap_or(goal);
        let most = dt_secs / SWITCH_SECS;
        let Place { position, .. } = self.pose.place;
        let height = ground.height(position.x, position.z);
        let switched = former + (goal - former).clamp(-most, most);
        self.switched = Some(switched);
        if switched == 0.0 {
            // Feet that are put down again stand where they then are.
            self.feet_state = FeetState::default();
        }
        let Some(footing) = self.footing.as_ref().filter(|_| switched > 0.0) else {
            self.placed.hips.y += height;
            self.feet = None;
            return;
        };
        let settings = self.tree.placement().copied().unwrap_or_default();
        let placement = Placement { footing, ground, settings: &settings };
        let (place, state) = (&self.pose.place, &mut self.feet_state);
        let mut feet = placement.step_turned(place, &mut self.placed, &self.turns, state, dt_secs);
        if switched < 1.0 {
            let part = Feather::Smooth.at(switched);
            toward(&mut self.placed, &self.flat, height, 1.0 - part);
            let seen = look(footing, ground, place, &self.placed);
            feet = [0, 1].map(|side| PlacedFoot {
                animated_ankle_in_world: feet[side].animated_ankle_in_world,
                hips_drop: feet[side].hips_drop * part,
                ..seen[side]
            });
        }
        self.feet = Some(feet);
    }

    /// The slope ahead, degrees, as it is felt: without jumps at the edges of steps.
    fn slope_ahead(&mut self, ground: &Ground, dt_secs: f64) -> f64 {
        let Place { position, turn } = self.pose.place;
        let (sin, cos) = turn.to_radians().sin_cos();
        let height = |ahead: f64| ground.height(position.x + ahead * sin, position.z + ahead * cos);
        let rise = height(SLOPE_REACH_M) - height(-SLOPE_REACH_M);
        let now = rise.atan2(2.0 * SLOPE_REACH_M).to_degrees();
        let now = if now.is_finite() { now } else { 0.0 };
        let former = self.slope.unwrap_or(now);
        let slope = former + (now - former) * (1.0 - (-dt_secs / SLOPE_SECS).exp());
        self.slope = Some(slope);
        slope
    }

    /// Puts another tree in the place of the present one, as after its file was saved: the stride's phase
    /// stays, and clocks and states of nodes that have kept their names. The clips must be fitted to this
    /// figure.
    pub fn replace_tree(&mut self, tree: Arc<Tree>) {
        self.state = self.state.carried_over(&self.tree, &tree);
        self.tree = tree;
    }

    /// Puts the figure somewhere else. What is not finite counts as 0; the height is always 0.
    pub fn set_place(&mut self, place: Place) {
        let tidy = |x: f64| if x.is_finite() { x } else { 0.0 };
        let position = DVec3::new(tidy(place.position.x), 0.0, tidy(place.position.z));
        self.pose.place = Place { position, turn: tidy(place.turn) };
        self.slope = None;
        self.feet_state = FeetState::default();
    }

    /// The pose as it now is, limbs free.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The figure.
    pub fn figure(&self) -> &Arc<Figure> {
        &self.figure
    }

    /// Where it stands.
    pub fn place(&self) -> Place {
        self.pose.place
    }

    /// The feet as they are, left and right, and what is under them of the ground on which the figure made its last
    /// step. Of a figure without feet there is nothing to be seen.
    pub fn feet(&self, ground: &Ground) -> [FootView; 2] {
        let Some(footing) = &self.footing else { return Default::default() };
        let feet = self.feet.unwrap_or_else(|| look(footing, ground, &self.pose.place, &self.placed));
        [0, 1].map(|side| feet[side].view(footing, side, ground, &self.placed))
    }

    /// The figure as its tree has it over flat ground, before the feet were placed.
    pub fn flat(&self) -> &Sample {
        &self.flat
    }

    /// How far the feet's placement has lowered the hips so that both legs reach, beyond the rise of the
    /// ground, metres; 0 or more.
    pub fn hips_drop_m(&self) -> f64 {
        self.feet.map_or(0.0, |feet| -feet[0].hips_drop)
    }

    /// The clips with their weights, in the tree's order; layers are left out, the sum is 1.
    pub fn weights(&self) -> impl Iterator<Item = (&str, f64)> {
        self.state.named_weights(&self.tree)
    }

    /// What it follows now: the last step's steering with the slope ahead.
    pub fn steering(&self) -> &Steering {
        &self.steering
    }

    /// Its tree.
    pub fn tree(&self) -> &Arc<Tree> {
        &self.tree
    }

    /// Where it is in its tree.
    pub fn state(&self) -> &TreeState {
        &self.state
    }

    /// The same, to set the stride's phase.
    pub fn state_mut(&mut self) -> &mut TreeState {
        &mut self.state
    }
}

/// Where the feet of a sample are that isn't bent.
fn look(footing: &Footing, ground: &Ground, place: &Place, sample: &Sample) -> [PlacedFoot; 2] {
    let settings = PlacementSettings { on: false, ..PlacementSettings::default() };
    let placement = Placement { footing, ground, settings: &settings };
    placement.step(place, &mut sample.clone(), &mut FeetState::default(), 0.0)
}

/// Takes a sample some part of the way to another that is raised.
fn toward(sample: &mut Sample, other: &Sample, raised: f64, part: f64) {
    sample.hips = sample.hips.lerp(other.hips + DVec3::Y * raised, part);
    for (angles, other) in sample.angles.iter_mut().zip(&other.angles) {
        angles.flexion += (other.flexion - angles.flexion) * part;
        angles.abduction += (other.abduction - angles.abduction) * part;
        angles.twist += (other.twist - angles.twist) * part;
    }
}

/// Where a place is after some time of even travel.
fn carried(place: Place, travel: Travel, dt_secs: f64) -> Place {
    let turn = travel.turn_rate * dt_secs;
    let (sin, cos) = (place.turn + turn / 2.0).to_radians().sin_cos();
    let (left, ahead) = (travel.velocity.x * dt_secs, travel.velocity.y * dt_secs);
    let position = place.position + DVec3::new(left * cos + ahead * sin, 0.0, ahead * cos - left * sin);
    let turn = place.turn + turn;
    Place { position, turn: turn - 360.0 * (turn / 360.0).round() }
}
