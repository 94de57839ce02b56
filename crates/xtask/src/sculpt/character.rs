//! How head and neck differ with sex, build, muscle and age: the neutral skin raised and lowered here and there.

use super::field::Part;
use super::fit::Fit;
use super::physique::{Ends, Physique};
use super::shape::Shape;

/// Raises by so many millimetres.
fn raise(part: &mut Part, millimetres: f64, shape: Shape) {
    part.swell(millimetres * 0.001, shape);
}

/// Changes the head (without the lids, which lie on the eyeballs) and the neck.
pub fn add(head: &Fit, neck: &Fit, physique: &Physique, part: &mut Part) {
    let ends = physique.ends();
    skull(head, &ends, part);
    cheeks(head, &ends, part);
    nose_and_mouth(head, &ends, part);
    throat(head, neck, &ends, part);
}

fn skull(f: &Fit, e: &Ends, part: &mut Part) {
    let brow =
        [[0.0, 1.6285, 0.1010, 0.0150], [0.0200, 1.6315, 0.0985, 0.0150], [0.0440, 1.6310, 0.0850, 0.0130]];
    raise(part, 2.2 * e.male - 1.6 * e.female - 2.0 * e.child + 0.8 * e.old, f.strand(&brow));
    let forehead = f.ball([0.0, 1.6700, 0.0960], [0.0800, 0.0600, 0.0600]);
    raise(part, 5.0 * e.child + 1.5 * e.female - 1.5 * e.male, forehead);
    let temple = f.ball([0.0640, 1.6320, 0.0500], [0.0280, 0.0360, 0.0380]);
    raise(part, 1.0 * e.child + 1.0 * e.heavy - 1.8 * e.slender - 3.2 * e.old, temple);
}

fn cheeks(f: &Fit, e: &Ends, part: &mut Part) {
    let bone = f.ball([0.0510, 1.5900, 0.0740], [0.0280, 0.0220, 0.0320]);
    raise(part, 0.9 * e.female + 0.6 * e.slender + 0.6 * e.old + 0.6 * e.heavy, bone);
    let cheek = f.ball([0.0500, 1.5640, 0.0680], [0.0440, 0.0420, 0.0480]);
    raise(
        part,
        4.6 * e.child + 6.0 * e.heavy + 0.8 * e.female - 3.4 * e.slender - 3.6 * e.old - 0.6 * e.male,
        cheek,
    );
    let jowl = f.ball([0.0400, 1.5240, 0.0600], [0.0420, 0.0380, 0.0520]);
    raise(part, 5.5 * e.heavy + 1.8 * e.old + 0.8 * e.child - 0.8 * e.slender, jowl);
    let angle = [
        [0.0515, 1.5510, 0.0020, 0.0320],
        [0.0450, 1.5290, 0.0260, 0.0310],
        [0.0325, 1.5140, 0.0560, 0.0270],
    ];
    raise(part, 3.0 * e.male - 3.0 * e.female - 2.4 * e.child + 1.2 * e.muscle, f.strand(&angle));
    let chin = f.ball([0.0, 1.5080, 0.1040], [0.0360, 0.0290, 0.0270]);
    raise(part, 2.6 * e.male - 1.6 * e.female - 4.2 * e.child + 0.8 * e.old, chin);
    // How far it hangs down: a child's is short.
    let under = f.ball([0.0, 1.4950, 0.0880], [0.0380, 0.0260, 0.0340]);
    raise(part, -3.5 * e.child - 1.2 * e.female, under);
    // Folds from the wings of the nose to the corners of the mouth, pouches under the eyes.
    let fold = [
        [0.0205, 1.5740, 0.1020, 0.0050],
        [0.0275, 1.5620, 0.0985, 0.0070],
        [0.0315, 1.5480, 0.0920, 0.0060],
    ];
    raise(part, -1.6 * e.old - 0.9 * e.heavy, f.strand(&fold));
    let pouch = [
        [0.0230, 1.5975, 0.0930, 0.0060],
        [0.0330, 1.5955, 0.0920, 0.0075],
        [0.0430, 1.5985, 0.0840, 0.0060],
    ];
    raise(part, 0.9 * e.old, f.strand(&pouch));
}

fn nose_and_mouth(f: &Fit, e: &Ends, part: &mut Part) {
    let bridge = [[0.0, 1.6150, 0.1020, 0.0130], [0.0, 1.5900, 0.1150, 0.0150]];
    raise(part, 1.4 * e.male - 1.0 * e.female - 3.4 * e.child + 0.8 * e.old, f.strand(&bridge));
    let tip = f.ball([0.0, 1.5770, 0.1220], [0.0120, 0.0130, 0.0130]);
    raise(part, 1.0 * e.male - 0.8 * e.female - 2.6 * e.child + 1.8 * e.old, tip);
    let wing = f.ball([0.0165, 1.5728, 0.1070], [0.0080, 0.0090, 0.0110]);
    raise(part, 0.9 * e.male - 0.6 * e.female - 1.4 * e.child + 1.1 * e.old, wing);
    let upper =
        [[0.0, 1.5500, 0.1125, 0.0075], [0.0090, 1.5506, 0.1105, 0.0075], [0.0190, 1.5490, 0.1020, 0.0050]];
    let lower =
        [[0.0, 1.5410, 0.1115, 0.0085], [0.0090, 1.5415, 0.1095, 0.0085], [0.0190, 1.5450, 0.1000, 0.0050]];
    let full = 1.2 * e.female - 0.8 * e.male + 0.5 * e.child;
    raise(part, full - 1.5 * e.old, f.strand(&upper));
    raise(part, full - 1.2 * e.old, f.strand(&lower));
}

fn throat(head: &Fit, f: &Fit, e: &Ends, part: &mut Part) {
    let under =
        [[0.0, 1.4950, 0.0780, 0.0420], [0.0160, 1.4945, 0.0640, 0.0420], [0.0260, 1.5030, 0.0400, 0.0400]];
    raise(part, 9.0 * e.heavy + 2.6 * e.old + 1.2 * e.child - 1.2 * e.slender, head.strand(&under));
    let larynx = f.ball([0.0, 1.4870, 0.0510], [0.0140, 0.0180, 0.0160]);
    raise(part, 3.4 * e.male - 2.2 * e.female - 2.6 * e.child + 1.0 * e.old - 1.5 * e.heavy, larynx);
    let side = [[0.0500, 1.5250, -0.0040, 0.0560], [0.0500, 1.4450, -0.0060, 0.0560]];
    let girth = 3.6 * e.male - 2.8 * e.female + 3.4 * e.muscle + 4.5 * e.heavy - 2.0 * e.slender;
    raise(part, girth - 5.0 * e.child - 1.6 * e.old, f.strand(&side));
    let back = [[0.0, 1.5300, -0.0560, 0.0420], [0.0, 1.4500, -0.0600, 0.0420]];
    raise(part, 0.7 * girth - 3.5 * e.child, f.strand(&back));
    let front = f.ball([0.0, 1.4560, 0.0450], [0.0480, 0.0560, 0.0360]);
    raise(part, 3.4 * e.heavy - 1.2 * e.female - 1.4 * e.old - 1.0 * e.child, front);
    let cord = [
        [0.0500, 1.5500, -0.0080, 0.0100],
        [0.0400, 1.4800, 0.0290, 0.0100],
        [0.0170, 1.4150, 0.0470, 0.0080],
    ];
    raise(
        part,
        1.6 * e.muscle + 1.4 * e.old - 1.6 * e.heavy - 1.6 * e.child - 0.8 * e.female,
        f.strand(&cord),
    );
}
