//! Which shader draws a figure in a pass and a style.

use crate::recipe::Paint;
use crate::scene::{FigureView, Pass, Scene, Style};
use crate::survey::search_of;

/// Whether a figure hides what is behind it and casts a shadow.
pub(crate) fn is_solid(view: &FigureView<'_>) -> bool {
    view.opacity >= 1.0
}

/// Whether a figure casts a shadow.
pub(crate) fn casts(view: &FigureView<'_>) -> bool {
    is_solid(view) && !view.ground
}

/// Whether some ground takes the place of the plane y = 0.
pub(crate) fn has_ground(scene: &Scene<'_>) -> bool {
    scene.figures.iter().any(|view| view.ground)
}

/// How a pass paints a figure; `None` if figures aren't in it.
pub(crate) fn paint_of(scene: &Scene<'_>, view: &FigureView<'_>) -> Option<Paint> {
    match scene.pass {
        Pass::Silhouette | Pass::Parts if view.ground => None,
        Pass::Color if view.ground => Some(ground_paint(scene, view)),
        _ => {
            let marked = !(view.selected.is_empty() && view.hovered.is_empty());
            body_paint(scene, is_solid(view), marked)
        }
    }
}

/// How a pass paints crowds; `None` if they aren't in it.
pub(crate) fn crowd_paint(scene: &Scene<'_>) -> Option<Paint> {
    body_paint(scene, true, false)
}

fn body_paint(scene: &Scene<'_>, solid: bool, marked: bool) -> Option<Paint> {
    match scene.pass {
        Pass::Color => {
            let look = &scene.look;
            let (fragment, parts) = fragment_of(look.style, look.joint_planes);
            Some(Paint {
                fragment,
                parts,
                shadowed: look.shadow && solid,
                marked,
                occluded: solid && search_of(scene).is_some(),
                lined: false,
            })
        }
        Pass::Depth => Some(Paint::plain("fs_depth")),
        Pass::Normal => Some(Paint::plain("fs_normal")),
        Pass::Silhouette => Some(Paint::plain("fs_silhouette")),
        Pass::Parts => Some(Paint { parts: true, ..Paint::plain("fs_parts") }),
        Pass::OpenPose => None,
    }
}

fn ground_paint(scene: &Scene<'_>, view: &FigureView<'_>) -> Paint {
    let drawn = scene.look.style == Style::Line;
    Paint {
        shadowed: scene.look.shadow,
        occluded: is_solid(view) && search_of(scene).is_some(),
        lined: scene.look.grid,
        ..Paint::plain(if drawn { "fs_ground_line" } else { "fs_ground" })
    }
}

/// The style's shader, and whether it needs a skin cut into parts.
fn fragment_of(style: Style, joint_planes: bool) -> (&'static str, bool) {
    match (style, joint_planes) {
        (Style::Studio, false) => ("fs_studio", false),
        (Style::Studio, true) => ("fs_studio_parts", true),
        (Style::Clay, false) => ("fs_clay", false),
        (Style::Clay, true) => ("fs_clay_parts", true),
        (Style::Matcap, false) => ("fs_matcap", false),
        (Style::Matcap, true) => ("fs_matcap_parts", true),
        (Style::Flat, _) => ("fs_flat", true),
        (Style::Line, _) => ("fs_line", false),
    }
}
