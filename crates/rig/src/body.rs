//! The sliders of a body: stature, sex characteristics, build, proportions, flexibility.

mod masses;
mod normals;
mod proportions;
mod ranges;
mod shape;
mod warp;

use kin::Interval;

pub use shape::{Shaped, shaped};

/// One slider of a body.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum BodySlider {
    /// Sole to crown at rest, metres.
    Stature,
    /// Sex characteristics: -1 male, 1 female.
    Sex,
    /// Fat: -1 slender, 1 heavy.
    Build,
    /// Muscle: -1 slight, 1 athletic.
    Muscle,
    /// Age: -1 a child's soft forms, 1 an old person's. Stature and proportions have sliders of their own.
    Age,
    /// Stature over the height of the head, chin to crown.
    Heads,
    /// Factor of the lengths of upper arm and forearm.
    Arms,
    /// Factor of the lengths of thigh and shank.
    Legs,
    /// Factor of the breadth of the shoulders; the ribcage follows.
    Shoulders,
    /// Factor of the breadth of the hips; the waist follows.
    Hips,
    /// Factor of the ranges of joints, about the rest; elbows, knees and wrists take a quarter of it, fingers, eyes and
    /// jaw none.
    Flexibility,
}

impl BodySlider {
    /// Every slider, in the order in which files and panels show them.
    pub const ALL: [BodySlider; 11] = [
        BodySlider::Stature,
        BodySlider::Sex,
        BodySlider::Build,
        BodySlider::Muscle,
        BodySlider::Age,
        BodySlider::Heads,
        BodySlider::Arms,
        BodySlider::Legs,
        BodySlider::Shoulders,
        BodySlider::Hips,
        BodySlider::Flexibility,
    ];

    /// The name in figure files.
    pub const fn name(self) -> &'static str {
        match self {
            BodySlider::Stature => "stature",
            BodySlider::Sex => "sex",
            BodySlider::Build => "build",
            BodySlider::Muscle => "muscle",
            BodySlider::Age => "age",
            BodySlider::Heads => "heads",
            BodySlider::Arms => "arms",
            BodySlider::Legs => "legs",
            BodySlider::Shoulders => "shoulders",
            BodySlider::Hips => "hips",
            BodySlider::Flexibility => "flexibility",
        }
    }

    /// The values that are allowed: metres, heads or plain numbers.
    pub const fn range(self) -> Interval {
        let (min, max) = match self {
            BodySlider::Stature => (0.3, 3.0),
            BodySlider::Sex | BodySlider::Build | BodySlider::Muscle | BodySlider::Age => (-1.0, 1.0),
            BodySlider::Heads => (3.0, 10.0),
            BodySlider::Arms | BodySlider::Legs => (0.6, 1.4),
            BodySlider::Shoulders | BodySlider::Hips => (0.7, 1.3),
            BodySlider::Flexibility => (0.5, 1.3),
        };
        Interval { min, max }
    }

    /// The value that changes nothing; `None` where that is the figure's own measure.
    pub const fn neutral(self) -> Option<f64> {
        match self {
            BodySlider::Stature | BodySlider::Heads => None,
            BodySlider::Sex | BodySlider::Build | BodySlider::Muscle | BodySlider::Age => Some(0.0),
            _ => Some(1.0),
        }
    }
}

/// What makes a body differ from the figure that it is made of: a value for some of the sliders.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Body {
    given: [Option<f64>; BodySlider::ALL.len()],
}

impl Body {
    /// The figure as it is.
    pub const AS_IS: Body = Body { given: [None; BodySlider::ALL.len()] };

    /// The body with a slider at a value, brought into its range; NaN takes the slider away.
    pub fn with(mut self, slider: BodySlider, value: f64) -> Body {
        self.given[slider as usize] = (!value.is_nan()).then(|| slider.range().clamp(value));
        self
    }

    /// The value given for a slider.
    pub fn given(&self, slider: BodySlider) -> Option<f64> {
        self.given[slider as usize]
    }

    /// What is not given here is taken from another body.
    pub fn or(&self, other: &Body) -> Body {
        Body { given: std::array::from_fn(|i| self.given[i].or(other.given[i])) }
    }

    /// Whether it leaves every figure as it is.
    pub fn is_as_is(&self) -> bool {
        BodySlider::ALL.into_iter().all(|s| self.given(s).is_none() || self.given(s) == s.neutral())
    }

    /// How far a slider with a neutral value stands from it; 0 for the others.
    fn off(&self, slider: BodySlider) -> f64 {
        slider.neutral().map_or(0.0, |neutral| self.given(slider).unwrap_or(neutral) - neutral)
    }

    /// The factor of a slider; 1 for those that are no factor.
    fn factor(&self, slider: BodySlider) -> f64 {
        1.0 + if slider.neutral() == Some(1.0) { self.off(slider) } else { 0.0 }
    }

    /// The morph targets that the physique asks for, and their shares above 0.
    pub fn targets(&self) -> Vec<(&'static str, f64)> {
        [
            (BodySlider::Sex, "male", "female"),
            (BodySlider::Build, "slender", "heavy"),
            (BodySlider::Muscle, "slight", "muscular"),
            (BodySlider::Age, "child", "old"),
        ]
        .into_iter()
        .map(|(slider, below, above)| {
            let value = self.off(slider);
            (if value < 0.0 { below } else { above }, value.abs())
        })
        .filter(|(_, share)| *share > 0.0)
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_brought_into_their_ranges() {
        let body = Body::AS_IS.with(BodySlider::Build, 7.0).with(BodySlider::Legs, f64::NAN);
        assert_eq!(body.given(BodySlider::Build), Some(1.0));
        assert_eq!(body.given(BodySlider::Legs), None);
        assert_eq!(body.targets(), [("heavy", 1.0)]);
    }

    #[test]
    fn neutral_values_leave_a_figure_as_it_is() {
        assert!(Body::AS_IS.with(BodySlider::Sex, 0.0).with(BodySlider::Arms, 1.0).is_as_is());
        assert!(!Body::AS_IS.with(BodySlider::Stature, 1.72).is_as_is());
    }

    #[test]
    fn what_is_not_given_comes_from_the_other() {
        let tall = Body::AS_IS.with(BodySlider::Stature, 1.9).with(BodySlider::Sex, 0.5);
        let both = Body::AS_IS.with(BodySlider::Sex, -1.0).or(&tall);
        assert_eq!(both.given(BodySlider::Sex), Some(-1.0));
        assert_eq!(both.given(BodySlider::Stature), Some(1.9));
    }
}
