//! A tree as it is drawn: its nodes with their live weights.

use super::bind::{Kind, Tree};
use super::state::TreeState;
use crate::Parameter;

/// A node of a tree's picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OutlineNode<'a> {
    /// How many nodes it is in.
    pub depth: usize,
    /// What it is, and before that what its parent has it for.
    pub label: &'a str,
    /// Its weight in the whole, 0 to 1.
    pub weight: f64,
    /// Whether it plays a clip.
    pub is_clip: bool,
    /// For an axis blend that has a weight: its points and cells.
    pub blend: Option<BlendView<'a>>,
}

/// An axis blend as it is drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BlendView<'a> {
    /// The parameters, one to three.
    pub by: &'a [Parameter],
    /// The points in the parameters' units, for this figure; what is missing of three values is 0.
    pub points: &'a [[f64; 3]],
    cells: &'a crate::cells::Cells,
}

impl<'a> BlendView<'a> {
    /// The corners of each cell, as indices of points: two, three or four.
    pub fn cells(&self) -> impl Iterator<Item = &'a [usize]> {
        self.cells.corners()
    }
}

impl Tree {
    /// The tree's nodes, outer ones before what is in them, with the weights of a state's last step. Nothing
    /// is allocated.
    pub fn outline<'a>(&'a self, state: &'a TreeState) -> impl Iterator<Item = OutlineNode<'a>> {
        self.nodes.iter().zip(&state.nodes).map(|(node, now)| OutlineNode {
            depth: node.level,
            label: &node.label,
            weight: now.weight,
            is_clip: matches!(node.kind, Kind::Clip(_)),
            blend: match &node.kind {
                Kind::Blend { by, cells, places, .. } if now.weight > 0.0 => {
                    Some(BlendView { by, points: places, cells })
                }
                _ => None,
            },
        })
    }
}
