//! A foot that rolls over flat ground: round heel, flat sole, a ball that the toes stay on, round tips of the toes.

use glam::DVec2;
use rig::{Bone, Figure, Limb};

/// Radius of the heel's underside where it leaves the ground, metres: that of the mannequin's skin.
const HEEL_RADIUS: f64 = 0.035;
/// The same under the tips of the toes.
const TIP_RADIUS: f64 = 0.03;
/// How far the flat of the toes ends before their tips, metres.
const TIP_LENGTH: f64 = 0.0045;

/// The measures of a sole, metres: ahead of the ankle's joint and above the ground when flat.
#[derive(Clone, Copy, Debug)]
pub struct Sole {
    /// Where the heel's curve begins, ahead.
    heel: f64,
    /// The ankle's height.
    ankle: f64,
    /// The toes' joint.
    toes: DVec2,
    /// Where the tip's curve begins, ahead.
    tip: f64,
}

impl Sole {
    /// The left sole of a figure that has heel and toe tip among its articulators, as the mannequin has.
    pub fn of(figure: &Figure) -> Option<Sole> {
        let points = &figure.articulators[Limb::LeftLeg.index()];
        let (heel, tip) = (points.get("heel")?.at, points.get("toeTip")?.at);
        let toes = figure.skeleton.joint(Bone::LeftToes)?.offset;
        Some(Sole {
            heel: heel.z,
            ankle: -heel.y,
            toes: DVec2::new(toes.z, toes.y - heel.y),
            tip: toes.z + tip.z - TIP_LENGTH,
        })
    }

    /// Where the ankle is, ahead of where it is over the flat foot and above the ground, as the foot rolls without
    /// sliding: the foot raises its toes by `pitch` over the heel, or (negative) its heel over the toes' joint; the
    /// toes tip down over their tips by `toes_down`. Radians.
    pub fn ankle(&self, pitch: f64, toes_down: f64) -> DVec2 {
        if pitch >= 0.0 {
            let center = DVec2::new(self.heel - HEEL_RADIUS * pitch, HEEL_RADIUS);
            center + DVec2::from_angle(pitch).rotate(DVec2::new(-self.heel, self.ankle - HEEL_RADIUS))
        } else {
            let over = toes_down.max(0.0);
            let center = DVec2::new(self.tip + TIP_RADIUS * over, TIP_RADIUS);
            let joint = self.toes - DVec2::new(self.tip, TIP_RADIUS);
            let to_ankle = DVec2::new(0.0, self.ankle) - self.toes;
            center + DVec2::from_angle(-over).rotate(joint) + DVec2::from_angle(pitch).rotate(to_ankle)
        }
    }
}
