//! What a picture shows and how: from where, how large, which pass, which look.

use render::{Look, Pass, Style};
use rig::{Bounds, Camera, Projection, View};

/// From where a figure is seen so that it fills the picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Viewpoint {
    /// The direction.
    pub view: View,
    /// About the vertical in place of the view's, degrees: 0 before the figure, 90 at its left.
    pub yaw_deg: Option<f32>,
    /// Above the horizon in place of the view's, degrees, -90 to 90.
    pub pitch_deg: Option<f32>,
    /// Times nearer than where the whole figure is just inside; 1 is there.
    pub zoom: f32,
    /// Perspective or not.
    pub projection: Projection,
}

impl From<View> for Viewpoint {
    fn from(view: View) -> Viewpoint {
        Viewpoint { view, yaw_deg: None, pitch_deg: None, zoom: 1.0, projection: Projection::Perspective }
    }
}

impl Viewpoint {
    /// The camera for a box in a picture of that aspect (width / height).
    pub fn camera(&self, bounds: Bounds, aspect: f32) -> Camera {
        let mut camera = Camera { projection: self.projection, ..Camera::default().seen_from(self.view) };
        let angle = |given: Option<f32>| given.filter(|v| v.is_finite()).map(f32::to_radians);
        // Turning holds the angles inside what a camera can have.
        if let Some(yaw_rad) = angle(self.yaw_deg) {
            camera.yaw_rad = 0.0;
            camera.orbit(yaw_rad, 0.0);
        }
        if let Some(pitch_rad) = angle(self.pitch_deg) {
            camera.pitch_rad = 0.0;
            camera.orbit(0.0, pitch_rad);
        }
        camera.frame(bounds, aspect);
        camera.zoom(1.0 / self.zoom, camera.target);
        camera
    }
}

/// How a picture is drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Shot {
    /// Width and height, pixels, of any size.
    pub size: [u32; 2],
    /// What each pixel says.
    pub pass: Pass,
    /// How the colour picture looks.
    pub look: Look,
}

impl Shot {
    /// A colour picture in the studio.
    pub fn new(size: [u32; 2]) -> Shot {
        Shot { size, pass: Pass::Color, look: Look::default() }
    }

    /// Width over height.
    pub fn aspect(&self) -> f32 {
        self.size[0] as f32 / self.size[1].max(1) as f32
    }

    /// Whether pixels can be clear.
    pub fn alpha(&self) -> bool {
        self.look.transparent && self.pass == Pass::Color
    }
}

/// The word for a pass on the command line and in files.
pub const fn pass_name(pass: Pass) -> &'static str {
    match pass {
        Pass::Color => "color",
        Pass::Depth => "depth",
        Pass::Normal => "normal",
        Pass::Silhouette => "silhouette",
        Pass::Parts => "parts",
        Pass::OpenPose => "openpose",
    }
}

/// The word for a style on the command line and in files.
pub const fn style_name(style: Style) -> &'static str {
    match style {
        Style::Studio => "studio",
        Style::Clay => "clay",
        Style::Matcap => "matcap",
        Style::Flat => "flat",
        Style::Line => "line",
    }
}

/// A camera in words: the view's name, or its angles.
pub fn camera_words(camera: &Camera) -> String {
    let named = View::ALL.into_iter().find(|view| camera.is_at(*view));
    let words = named.map_or_else(
        || {
            format!(
                "yaw {:.1}, pitch {:.1} degrees",
                camera.yaw_rad.to_degrees(),
                camera.pitch_rad.to_degrees()
            )
        },
        |view| view.name().to_owned(),
    );
    match camera.projection {
        Projection::Perspective => words,
        Projection::Orthographic => format!("{words}, orthographic"),
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn angles_take_the_place_of_the_view_s() {
        let body = Bounds { min: Vec3::new(-0.8, 0.0, -0.2), max: Vec3::new(0.8, 1.7, 0.2) };
        let plain = Viewpoint::from(View::Left);
        assert_eq!(plain.camera(body, 1.6), Camera::view(View::Left, body, 1.6));
        let turned = Viewpoint { yaw_deg: Some(20.0), pitch_deg: Some(200.0), zoom: 2.0, ..plain };
        let camera = turned.camera(body, 1.6);
        assert!((camera.yaw_rad.to_degrees() - 20.0).abs() < 1e-4);
        assert!((camera.pitch_rad.to_degrees() - 90.0).abs() < 1e-4, "no farther than straight above");
        let whole = Viewpoint { zoom: 1.0, ..turned }.camera(body, 1.6);
        assert!((whole.distance / camera.distance - 2.0).abs() < 1e-4);
        let bad = Viewpoint { yaw_deg: Some(f32::NAN), zoom: f32::NAN, ..plain };
        assert_eq!(bad.camera(body, 1.6), plain.camera(body, 1.6));
        assert_eq!(camera_words(&plain.camera(body, 1.0)), "left");
        assert_eq!(camera_words(&camera), "yaw 20.0, pitch 90.0 degrees");
    }
}
