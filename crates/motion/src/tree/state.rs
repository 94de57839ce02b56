//! What one walker has of its own in a blend tree: phase, clocks, states, and room to reckon in.

use std::sync::Arc;

use super::bind::{Kind, Node, Tree};
use super::mix::blank;
use super::states::Machine;
use crate::{Sample, Steering, Travel};

/// What one walker has of its own in a blend tree. All room is made with it: steps allocate nothing.
#[derive(Clone, PartialEq, Debug)]
pub struct TreeState {
    /// Of the stride: from 0, the left heel's contact, to below 1.
    pub(super) phase: f64,
    /// By node.
    pub(super) nodes: Vec<NodeState>,
    pub(super) machines: Vec<Machine>,
    /// What is summed up; the first is what comes out at the root.
    pub(super) samples: Vec<Sample>,
    pub(super) travel: Travel,
    /// By clip of the tree, layers left out.
    pub(super) clip_weights: Vec<f64>,
    /// Of the last step.
    pub(super) steering: Steering,
    pub(super) visits: usize,
    pub(super) samplings: usize,
}

/// What a node remembers, and its weights in this step.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct NodeState {
    /// In its parent. Only read if the parent has a weight in the whole.
    pub(super) share: f64,
    /// In the whole.
    pub(super) weight: f64,
    /// Which part of it is strides.
    pub(super) strides: f64,
    /// For clips that are no strides: the phase, 0 to 1.
    pub(super) clock: f64,
    /// Whether it had a weight in the last step.
    pub(super) live: bool,
}

impl TreeState {
    /// The state at the start, standing still, with its sample.
    pub fn new(tree: &Tree) -> TreeState {
        let machines = tree.nodes.iter().filter_map(|node| match &node.kind {
            Kind::States(states) => Some(Machine::new(states)),
            _ => None,
        });
        let mut state = TreeState {
            phase: 0.0,
            nodes: vec![NodeState::default(); tree.nodes.len()],
            machines: machines.collect(),
            samples: vec![blank(); tree.depth],
            travel: Travel::default(),
            clip_weights: vec![0.0; tree.clips.len()],
            steering: Steering::default(),
            visits: 0,
            samplings: 0,
        };
        tree.step(&mut state, &Steering::default(), 0.0);
        state
    }

    /// The figure on flat ground after the last step.
    pub fn sample(&self) -> &Sample {
        &self.samples[0]
    }

    /// How the last step carries it along.
    pub fn travel(&self) -> Travel {
        self.travel
    }

    /// Of the stride, from 0, the left heel's contact, to below 1.
    pub fn phase(&self) -> f64 {
        self.phase
    }

    /// Sets the phase of the stride, so that walkers of a crowd don't march: its part beyond whole numbers, 0
    /// for NaN. It is seen in the next step.
    pub fn set_phase(&mut self, phase: f64) {
        let phase = phase.rem_euclid(1.0);
        self.phase = if phase < 1.0 { phase } else { 0.0 };
    }

    /// The weight of each of the tree's clips, in the order of [`Tree::clips`]; the sum is 1. Layers are left
    /// out.
    pub fn weights(&self) -> &[f64] {
        &self.clip_weights
    }

    /// How many nodes were visited in the last step to take their samples.
    pub fn visits(&self) -> usize {
        self.visits
    }

    /// How many samples of clips were taken in the last step.
    pub fn samplings(&self) -> usize {
        self.samplings
    }

    /// This walker's state in another tree, which takes the place of the one that it has been in: the
    /// stride's phase stays, and clocks and states of nodes that have kept their names.
    pub fn carried_over(&self, from: &Tree, to: &Tree) -> TreeState {
        let mut state = TreeState::new(to);
        state.phase = self.phase;
        for (i, node) in to.nodes.iter().enumerate() {
            let Some(former) = from.nodes.iter().position(|former| former.key == node.key) else { continue };
            if let (Kind::Clip(_), Kind::Clip(_)) = (&node.kind, &from.nodes[former].kind) {
                state.nodes[i] = self.nodes[former];
            }
            if let (Kind::States(states), Kind::States(before)) = (&node.kind, &from.nodes[former].kind) {
                state.machines[states.machine].take_over(states, &self.machines[before.machine], before);
            }
        }
        to.step(&mut state, &self.steering, 0.0);
        state
    }

    /// The names of the states that the graphs are in or go to, outer graphs first.
    pub fn current_states<'a>(&'a self, tree: &'a Tree) -> impl Iterator<Item = &'a str> {
        let states = |node: &'a Node| match &node.kind {
            Kind::States(states) => Some(states.names[self.machines[states.machine].current].as_str()),
            _ => None,
        };
        tree.nodes.iter().filter_map(states)
    }

    /// Weights with the names of their clips.
    pub fn named_weights<'a>(&'a self, tree: &'a Tree) -> impl Iterator<Item = (&'a str, f64)> {
        tree.clips.iter().map(Arc::as_ref).map(|clip| clip.name()).zip(self.clip_weights.iter().copied())
    }
}
