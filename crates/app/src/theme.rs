//! How the window looks: neutral greys, dark or light, one accent, and a colour for each side of the body.

mod palette;

use egui::{Color32, CornerRadius, FontFamily, FontId, Stroke, Style, TextStyle, Theme, Ui, Visuals, vec2};
use rig::Side;

use crate::settings::Look;
pub use palette::{DARK, LIGHT, Palette};

/// What is chosen or under the hand, over the picture, which looks the same in both looks.
pub const ACCENT: Color32 = DARK.accent;

/// What the figure can't do, over the picture.
pub const WARNING: Color32 = DARK.warning;

/// The colour of a side, over the picture.
pub const fn side(side: Side) -> Color32 {
    DARK.side(side)
}

/// The colours that are in force.
pub fn of(ui: &Ui) -> &'static Palette {
    if ui.visuals().dark_mode { &DARK } else { &LIGHT }
}

/// Gives a context the window's look: colours, spacing, type sizes, and no animations.
pub fn apply(ctx: &egui::Context) {
    // The size of everything follows the settings, and their keys can be rebound.
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
    ctx.set_visuals_of(Theme::Dark, visuals(&DARK, Visuals::dark()));
    ctx.set_visuals_of(Theme::Light, visuals(&LIGHT, Visuals::light()));
    ctx.all_styles_mut(shape);
    follow(ctx, Look::Dark);
}

/// Takes on the look that was chosen.
pub fn follow(ctx: &egui::Context, look: Look) {
    let preference = match look {
        Look::Dark => egui::ThemePreference::Dark,
        Look::Light => egui::ThemePreference::Light,
        Look::System => egui::ThemePreference::System,
    };
    if ctx.options(|options| options.theme_preference) != preference {
        ctx.set_theme(preference);
    }
}

fn shape(style: &mut Style) {
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
}

fn visuals(p: &Palette, base: Visuals) -> Visuals {
    let mut v = base;
    v.panel_fill = p.panel;
    v.window_fill = p.window;
    v.window_stroke = Stroke::new(1.0, p.line);
    v.extreme_bg_color = p.well;
    v.text_edit_bg_color = Some(p.well);
    v.faint_bg_color = p.header;
    v.selection.bg_fill = p.selection;
    v.selection.stroke = Stroke::new(1.0, p.selection_text);
    v.hyperlink_color = p.accent;
    v.warn_fg_color = p.warning;
    v.error_fg_color = p.warning;
    v.weak_text_color = Some(p.faint_text);
    v.interact_cursor = None;
    v.window_corner_radius = CornerRadius::same(6);
    v.menu_corner_radius = CornerRadius::same(4);
    let [rest, hovered, active, open] = p.button;
    let states = [
        (&mut v.widgets.noninteractive, p.panel, p.line, p.text),
        (&mut v.widgets.inactive, rest, rest, p.text),
        (&mut v.widgets.hovered, hovered, p.faint_text, p.strong_text),
        (&mut v.widgets.active, active, p.text, p.strong_text),
        (&mut v.widgets.open, open, p.line, p.text),
    ];
    for (widget, fill, stroke, text) in states {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = Stroke::new(1.0, stroke);
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.corner_radius = CornerRadius::same(3);
        widget.expansion = 0.0;
    }
    v
}
