//! How the window looks: neutral dark greys, one accent, and a colour for each side of the body.

use egui::{Color32, CornerRadius, FontFamily, FontId, Stroke, TextStyle, Visuals, vec2};
use rig::Side;

/// What is chosen or under the hand.
pub const ACCENT: Color32 = Color32::from_rgb(245, 166, 66);
/// What the figure can't do.
pub const WARNING: Color32 = Color32::from_rgb(255, 124, 124);
/// The left side of the body.
pub const LEFT: Color32 = Color32::from_rgb(236, 92, 84);
/// Its right side.
pub const RIGHT: Color32 = Color32::from_rgb(72, 164, 236);
/// Panels.
pub const PANEL: Color32 = Color32::from_gray(34);
/// Bars above and below, one step darker.
pub const BAR: Color32 = Color32::from_gray(28);
/// Headers of sections.
pub const HEADER: Color32 = Color32::from_gray(44);
/// Wells: text fields and the rails of sliders.
pub const WELL: Color32 = Color32::from_gray(22);
/// What a slider can reach now.
pub const LIVE: Color32 = Color32::from_gray(84);
/// Text.
pub const TEXT: Color32 = Color32::from_gray(212);
/// Text that explains.
pub const FAINT_TEXT: Color32 = Color32::from_gray(150);

/// The colour of a side.
pub const fn side(side: Side) -> Color32 {
    match side {
        Side::Left => LEFT,
        Side::Right => RIGHT,
    }
}

/// Gives a context the window's look: colours, spacing, type sizes, and no animations.
pub fn apply(ctx: &egui::Context) {
    ctx.set_theme(egui::Theme::Dark);
    ctx.all_styles_mut(|style| {
        style.visuals = visuals();
        style.animation_time = 0.0;
        style.spacing.item_spacing = vec2(6.0, 4.0);
        style.spacing.button_padding = vec2(8.0, 3.0);
        style.spacing.interact_size = vec2(40.0, 22.0);
        style.spacing.scroll = egui::style::ScrollStyle::solid();
        style.spacing.scroll.bar_width = 8.0;
        style.spacing.scroll.bar_inner_margin = 0.0;
        style.spacing.tooltip_width = 360.0;
        style.interaction.selectable_labels = false;
        style.explanation_tooltips = false;
        style.text_styles = [
            (TextStyle::Small, 11.0, FontFamily::Proportional),
            (TextStyle::Body, 13.0, FontFamily::Proportional),
            (TextStyle::Button, 13.0, FontFamily::Proportional),
            (TextStyle::Heading, 15.0, FontFamily::Proportional),
            (TextStyle::Monospace, 12.0, FontFamily::Monospace),
        ]
        .into_iter()
        .map(|(name, size, family)| (name, FontId::new(size, family)))
        .collect();
    });
}

fn visuals() -> Visuals {
    let mut v = Visuals::dark();
    v.panel_fill = PANEL;
    v.window_fill = Color32::from_gray(38);
    v.window_stroke = Stroke::new(1.0, Color32::from_gray(64));
    v.extreme_bg_color = WELL;
    v.text_edit_bg_color = Some(WELL);
    v.faint_bg_color = Color32::from_gray(40);
    v.selection.bg_fill = Color32::from_rgb(116, 78, 30);
    v.selection.stroke = Stroke::new(1.0, Color32::from_rgb(255, 214, 176));
    v.hyperlink_color = ACCENT;
    v.warn_fg_color = WARNING;
    v.error_fg_color = WARNING;
    v.weak_text_color = Some(FAINT_TEXT);
    v.interact_cursor = None;
    let radius = CornerRadius::same(3);
    v.window_corner_radius = CornerRadius::same(6);
    v.menu_corner_radius = CornerRadius::same(4);
    let states = [
        (&mut v.widgets.noninteractive, 34, 58, TEXT),
        (&mut v.widgets.inactive, 54, 54, TEXT),
        (&mut v.widgets.hovered, 68, 96, Color32::from_gray(236)),
        (&mut v.widgets.active, 82, 128, Color32::WHITE),
        (&mut v.widgets.open, 62, 80, TEXT),
    ];
    for (widget, fill, stroke, text) in states {
        widget.bg_fill = Color32::from_gray(fill);
        widget.weak_bg_fill = Color32::from_gray(fill);
        widget.bg_stroke = Stroke::new(1.0, Color32::from_gray(stroke));
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.corner_radius = radius;
        widget.expansion = 0.0;
    }
    v
}
