//! Many figures of several bodies walking on one ground, ready to be drawn: each body is a crowd of its own.

use std::sync::Arc;

use glam::Vec3;
use motion::crowd::{Company, Crowd, CrowdFigure, Gait, Gaits, Heights, LANES, ROWS};
use motion::{Clip, FittedClip, Ground, Sample};
use render::{CrowdView, DrawError, Renderer};
use rig::{Figure, Mesh, simplified};

use crate::failure::Failure;
use crate::load;

/// The most figures that walk together.
pub const MOST: u32 = 20_000;
/// The farthest that a crowd's ground reaches from its middle, metres: as far as ground is drawn.
const FARTHEST_M: f32 = 58.0;
/// Ground for each figure, square metres.
const ROOM_M2: f32 = 5.0;
/// The grid in which the ground's heights are kept, metres.
const CELL_M: f32 = 0.125;
/// Nobody stands in another after so long, seconds.
const WARM_UP_SECS: f32 = 4.0;
/// The step of time of the warming up, seconds.
const WARM_UP_STEP_SECS: f32 = 1.0 / 20.0;
/// Walkers differ in pace; times the clip's own. As many walk at each as stand, or run at each of theirs.
const PACES: &[f32] = &[0.84, 0.90, 0.95, 1.0, 1.04, 1.09, 1.16];
const RUNNING_PACES: &[f32] = &[0.96];
/// Whoever is faster runs, metres a second.
const RUNNING_M_PER_SEC: f64 = 2.0;
/// Slower clips are no gait to get along by, metres a second.
const SLOWEST: f64 = 0.4;
/// How many samples of a clip are kept a second.
const SAMPLES_PER_SEC: f64 = 48.0;
/// How much walkers' colours differ.
const VARIETY: f32 = 0.55;

/// Figures of one body.
#[derive(Clone, Debug)]
pub struct Kind {
    /// Who.
    pub figure: Arc<Figure>,
    /// What is drawn of each: lighter the more there are.
    pub mesh: Arc<Mesh>,
    crowd: Crowd,
}

impl Kind {
    /// How many.
    pub fn count(&self) -> usize {
        self.crowd.count()
    }
}

/// Many figures on one ground. The same start and the same steps give the same bits.
#[derive(Clone, Debug)]
pub struct Throng {
    kinds: Vec<Kind>,
    heights: Arc<Heights>,
}

impl Throng {
    /// So many figures (at most [`MOST`]), of the bodies in turn, by the shipped clips. They are where they have come to after
    /// going round each other for some seconds.
    ///
    /// # Errors
    /// Clips that don't fit a figure, a figure without legs or without a skin.
    pub fn new(
        figures: &[Arc<Figure>],
        clips: &[Clip],
        ground: &Ground,
        count: u32,
        seed: u64,
    ) -> Result<Throng, Failure> {
        let count = count.min(MOST) as usize;
        let half_m = ((count as f32 * ROOM_M2).sqrt() * 0.5 + 3.0).min(FARTHEST_M);
        let heights = Arc::new(Heights::of(ground, half_m, CELL_M));
        let vertices = vertices_for(count);
        let (mut makers, mut kinds) = (load::Makers::default(), Vec::new());
        for (i, figure) in figures.iter().enumerate() {
            // Every n-th figure has the same body.
            let own = (count + figures.len() - 1 - i) / figures.len();
            if own > 0 {
                let seed = seed.wrapping_add((i as u64) << 32);
                let crowd = crowd(figure, clips, &mut makers, own, half_m, seed)?;
                kinds.push(Kind { figure: figure.clone(), mesh: light(figure, vertices)?, crowd });
            }
        }
        let mut throng = Throng { kinds, heights };
        for _ in 0..(WARM_UP_SECS / WARM_UP_STEP_SECS) as usize {
            throng.step(WARM_UP_STEP_SECS);
        }
        Ok(throng)
    }

    /// Everyone goes on by a time step, seconds.
    pub fn step(&mut self, dt_secs: f32) {
        let company =
            Company::of(self.kinds.iter().flat_map(|kind| kind.crowd.places()), self.heights.half());
        for kind in &mut self.kinds {
            kind.crowd.step_among(&company, &self.heights, dt_secs);
        }
    }

    /// The bodies that walk.
    pub fn kinds(&self) -> &[Kind] {
        &self.kinds
    }

    /// From the middle to the border of where they walk, metres.
    pub fn half_m(&self) -> f32 {
        self.heights.half()
    }

    /// A point in the middle, about as high as a figure's chest.
    pub fn middle(&self) -> Vec3 {
        Vec3::new(0.0, self.heights.at(0.0, 0.0)[0] + 1.1, 0.0)
    }

    /// Gives their skins to a renderer, into slots from the first on; [`Throng::views`] names the same ones.
    ///
    /// # Errors
    /// As [`Renderer::set_mesh`].
    pub fn seat(&self, renderer: &mut Renderer, first_slot: usize) -> Result<(), DrawError> {
        let mut slots = self.kinds.iter().zip(first_slot..);
        slots.try_for_each(|(kind, slot)| renderer.set_mesh(slot, &kind.mesh))
    }

    /// What is drawn.
    pub fn views(&self, first_slot: usize) -> Vec<CrowdView<'_>> {
        let views = self.kinds.iter().zip(first_slot..).map(|(kind, skin)| CrowdView {
            skin,
            variety: VARIETY,
            seed: skin as u32,
            ..CrowdView::new(kind.crowd.numbers(), LANES, ROWS, kind.crowd.count())
        });
        views.collect()
    }
}

/// The vertices of each figure's skin in a crowd of so many.
fn vertices_for(count: usize) -> usize {
    match count {
        0..=30 => usize::MAX,
        31..=300 => 6000,
        301..=3000 => 1500,
        _ => 700,
    }
}

fn light(figure: &Figure, vertices: usize) -> Result<Arc<Mesh>, Failure> {
    let Some(skin) = &figure.skin else {
        return Err(Failure::Input(format!(
            "{}: a figure without a skin can't be drawn in a crowd",
            figure.name
        )));
    };
    Ok(Arc::new(if skin.vertex_count() <= vertices { skin.clone() } else { simplified(skin, vertices) }))
}

fn crowd(
    figure: &Arc<Figure>,
    clips: &[Clip],
    makers: &mut load::Makers,
    count: usize,
    half_m: f32,
    seed: u64,
) -> Result<Crowd, Failure> {
    let legless = || Failure::Input(format!("{}: a figure without legs can't walk", figure.name));
    let mut gaits = Vec::new();
    for clip in clips {
        gaits.extend(gaits_of(&makers.fit(clip, figure)?, figure));
    }
    let shape = CrowdFigure::of(figure).ok_or_else(legless)?;
    let gaits = Gaits::new(figure, &gaits).ok_or_else(legless)?;
    Ok(Crowd::new(shape, gaits, count, half_m, seed))
}

/// What a clip is to a crowd: a gait at several paces if it goes straight ahead, a way to stand if it goes nowhere.
fn gaits_of(clip: &FittedClip, figure: &Figure) -> Vec<Gait> {
    let travel = clip.travel();
    let (aside, ahead) = (travel.velocity.x, travel.velocity.y);
    let straight = aside.abs() < 0.05 && travel.turn_rate.abs() < 2.0;
    let length = clip.length_secs();
    let count = ((length * SAMPLES_PER_SEC).ceil() as u32).max(2);
    let samples = || -> Vec<Sample> {
        let at = |i| {
            let mut sample = Sample::at_rest(figure);
            clip.sample(f64::from(i) / f64::from(count), &mut sample);
            sample
        };
        (0..count).map(at).collect()
    };
    let gait = |speed: f64, length_secs: f64| Gait {
        speed: speed as f32,
        length_secs: length_secs as f32,
        samples: samples(),
    };
    if clip.is_stride() && straight && ahead > SLOWEST {
        let running = ahead / clip.pace() > RUNNING_M_PER_SEC;
        let paces = if running { RUNNING_PACES } else { PACES };
        return paces.iter().map(|pace| gait(ahead * f64::from(*pace), length / f64::from(*pace))).collect();
    }
    let stands = !clip.is_stride() && clip.loops() && straight && ahead.abs() < 0.01;
    stands.then(|| gait(0.0, length)).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::library::clips;

    fn throng(bodies: &[&str], count: u32) -> Throng {
        let named = |name: &&str| {
            let file = format!("{}{name}.figure.ron", interchange::figure::LIBRARY);
            load::figure(Some(std::path::Path::new(&file))).unwrap()
        };
        let figures: Vec<_> = bodies.iter().map(named).collect();
        let clips: Vec<Clip> = clips::names().map(|name| load::clip(name.as_ref()).unwrap()).collect();
        let ground = Ground::parse_kind("hills", 3).unwrap();
        Throng::new(&figures, &clips, &ground, count, 7).unwrap()
    }

    #[test]
    fn bodies_take_turns_and_the_same_start_gives_the_same_bits() {
        let mut once = throng(&["mannequin", "child"], 41);
        assert_eq!(once.kinds().iter().map(Kind::count).collect::<Vec<_>>(), [21, 20]);
        assert!(once.kinds().iter().all(|kind| kind.mesh.vertex_count() <= 6000));
        let mut again = once.clone();
        for _ in 0..30 {
            once.step(1.0 / 30.0);
            again.step(1.0 / 30.0);
        }
        let numbers = |throng: &Throng| -> Vec<u32> {
            throng.views(0).iter().flat_map(|view| view.matrices.iter().map(|n| n.to_bits())).collect()
        };
        assert_eq!(numbers(&once), numbers(&again));
        assert!(once.views(5).iter().map(|view| view.skin).eq(5..7));
        assert_eq!(throng(&["man", "woman"], 1).kinds().len(), 1, "a body that nobody has isn't there");
    }

    #[test]
    fn few_walk_through_each_other() {
        let mut throng = throng(&["mannequin"], 120);
        let (mut near, mut all) = (0, 0);
        for _ in 0..120 {
            throng.step(1.0 / 30.0);
            let places: Vec<[f32; 2]> = throng.kinds()[0].crowd.places().collect();
            let touches = |at: &[f32; 2]| {
                let apart = |other: &[f32; 2]| (other[0] - at[0]).hypot(other[1] - at[1]);
                places.iter().filter(|other| apart(other) < 0.35).count() > 1
            };
            near += places.iter().filter(|at| touches(at)).count();
            all += places.len();
        }
        assert!(near * 100 < all, "{near} of {all} times someone is in another");
    }
}
