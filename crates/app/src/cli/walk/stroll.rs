//! The walk itself: step by step of time, the same each time.

use std::collections::BTreeMap;
use std::sync::Arc;

use motion::{FootView, Ground, Steering, Summary, Survey, Tree, Walker};
use rig::{Figure, Pose};

/// Who walks where and how.
#[derive(Clone, Debug)]
pub struct Stroll {
    /// Who.
    pub figure: Arc<Figure>,
    /// By which motions.
    pub tree: Arc<Tree>,
    /// On what.
    pub ground: Ground,
    /// Whereto.
    pub steering: Steering,
    /// How many steps of time, at least one.
    pub steps: usize,
    /// So many of them a second.
    pub rate: u32,
    /// Whether feet are placed on the ground.
    pub places_feet: bool,
}

/// A walk that was walked.
#[derive(Clone, Debug)]
pub struct Strolled {
    /// After each step of time.
    pub moments: Vec<Moment>,
    /// What it came to, with turns compared with those of the same walk on flat ground.
    pub summary: Summary,
}

/// The figure after a step of time.
#[derive(Clone, Debug)]
pub struct Moment {
    /// Seconds from the start.
    pub time: f64,
    /// How it stands.
    pub pose: Pose,
    /// How much each clip counts, by name.
    pub weights: BTreeMap<String, f64>,
    /// Left, right.
    pub feet: [FootView; 2],
}

impl Stroll {
    /// Walks, and once more on flat ground to compare.
    pub fn walk(&self) -> Strolled {
        let mut moments = Vec::with_capacity(self.steps);
        let survey = self.survey(&self.ground, &mut |walker, feet, step| {
            moments.push(Moment {
                time: (step + 1) as f64 / f64::from(self.rate),
                pose: walker.pose().clone(),
                weights: walker.weights().map(|(name, weight)| (name.to_owned(), weight)).collect(),
                feet,
            });
        });
        let flat = self.survey(&Ground::Flat, &mut |_, _, _| {});
        Strolled { moments, summary: survey.summary(Some(&flat)) }
    }

    fn survey(&self, ground: &Ground, each: &mut dyn FnMut(&Walker, [FootView; 2], usize)) -> Survey {
        let mut walker = Walker::new(self.figure.clone(), self.tree.clone());
        walker.feet_on_ground = self.places_feet;
        let mut survey = Survey::new();
        for step in 0..self.steps {
            walker.step(ground, &self.steering, 1.0 / f64::from(self.rate));
            let feet = walker.feet(ground);
            survey.add(&self.figure, walker.pose(), &feet);
            each(&walker, feet, step);
        }
        survey
    }
}
