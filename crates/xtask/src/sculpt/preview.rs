//! A small software rasteriser, to judge the sculpt without a graphics card.

use glam::{DMat3, DVec3};
use image::{Rgb, RgbImage};

/// What is drawn: points with normals and linear colours.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Places, metres.
    pub points: Vec<DVec3>,
    /// Unit normals.
    pub normals: Vec<DVec3>,
    /// Linear RGB.
    pub colors: Vec<DVec3>,
    /// Counter-clockwise triangles.
    pub triangles: Vec<[u32; 3]>,
}

/// From where the light comes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Light {
    /// Key from upper left, weak fill: how the figure will mostly be seen.
    Studio,
    /// One low light from the right, hardly a fill, no colours: shows every bump.
    Raking,
}

/// A parallel view.
#[derive(Clone, Copy, Debug)]
pub struct Shot {
    /// Turn about +Y in degrees: 0 looks at the front, 90 at the figure's left side.
    pub yaw: f64,
    /// Degrees above the horizon.
    pub pitch: f64,
    /// The middle of the picture.
    pub center: DVec3,
    /// Height of the picture in metres.
    pub height: f64,
    /// Pixels.
    pub size: (u32, u32),
    /// The light.
    pub light: Light,
}

/// Samples along a pixel's side.
const SAMPLES: u32 = 2;
const BACKGROUND: DVec3 = DVec3::new(0.055, 0.06, 0.07);

/// Draws one view; with `wires`, triangle edges too.
pub fn draw(model: &Model, shot: &Shot, wires: bool) -> RgbImage {
    let (w, h) = (shot.size.0 * SAMPLES, shot.size.1 * SAMPLES);
    let view =
        DMat3::from_rotation_x(shot.pitch.to_radians()) * DMat3::from_rotation_y(-shot.yaw.to_radians());
    let scale = f64::from(h) / shot.height;
    let place = |p: DVec3| {
        let q = view * (p - shot.center);
        DVec3::new(f64::from(w) / 2.0 + q.x * scale, f64::from(h) / 2.0 - q.y * scale, q.z)
    };
    let screen: Vec<DVec3> = model.points.iter().map(|p| place(*p)).collect();
    let lit: Vec<DVec3> =
        model.normals.iter().zip(&model.colors).map(|(n, c)| shade(view * *n, *c, shot.light)).collect();
    let mut depth = vec![f64::NEG_INFINITY; (w * h) as usize];
    let mut color = vec![BACKGROUND; (w * h) as usize];
    for triangle in &model.triangles {
        let at = triangle.map(|v| screen[v as usize]);
        let shades = triangle.map(|v| lit[v as usize]);
        fill(at, shades, (w, h), wires, &mut depth, &mut color);
    }
    resolve(&color, shot.size)
}

fn fill(
    [a, b, c]: [DVec3; 3],
    shades: [DVec3; 3],
    (w, h): (u32, u32),
    wires: bool,
    depth: &mut [f64],
    color: &mut [DVec3],
) {
    let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if area.abs() < 1e-12 {
        return;
    }
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let span = |low: f64, high: f64, n: u32| (low.max(0.0) as u32, high.clamp(0.0, f64::from(n - 1)) as u32);
    let ((x0, x1), (y0, y1)) = (span(low.x, high.x, w), span(low.y, high.y, h));
    // Seen from behind a triangle shows in warning red: normals and winding must agree.
    let behind = area > 0.0;
    let heights = [b.distance(c), c.distance(a), a.distance(b)].map(|l| area.abs() / l.max(1e-9));
    for y in y0..=y1 {
        for x in x0..=x1 {
            let (px, py) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            let u = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
            let v = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
            let t = 1.0 - u - v;
            if u < 0.0 || v < 0.0 || t < 0.0 {
                continue;
            }
            let z = u * a.z + v * b.z + t * c.z;
            let i = (y * w + x) as usize;
            if z > depth[i] {
                depth[i] = z;
                let edge = (u * heights[0]).min(v * heights[1]).min(t * heights[2]) < 0.8;
                color[i] = match (behind, wires && edge) {
                    (true, _) => DVec3::new(0.8, 0.0, 0.1),
                    (_, true) => DVec3::splat(0.02),
                    _ => shades[0] * u + shades[1] * v + shades[2] * t,
                };
            }
        }
    }
}

/// Key light from upper left, weak fill, light from the sky, a rim.
fn shade(n: DVec3, base: DVec3, light: Light) -> DVec3 {
    if light == Light::Raking {
        let low = DVec3::new(0.86, 0.35, 0.22).normalize();
        return DVec3::splat(0.75 * n.dot(low).max(0.0) + 0.05 * (0.6 + 0.4 * n.z));
    }
    let key = DVec3::new(-0.45, 0.6, 0.66).normalize();
    let fill = DVec3::new(0.8, 0.1, 0.5).normalize();
    let diffuse = 0.85 * n.dot(key).max(0.0) + 0.18 * n.dot(fill).max(0.0) + 0.16 * (0.6 + 0.4 * n.y);
    let rim = (1.0 - n.z.clamp(0.0, 1.0)).powi(4) * 0.12;
    let half = (key + DVec3::Z).normalize();
    let gloss = n.dot(half).max(0.0).powi(30) * 0.06;
    base * diffuse + DVec3::splat(rim + gloss)
}

fn resolve(color: &[DVec3], (w, h): (u32, u32)) -> RgbImage {
    RgbImage::from_fn(w, h, |x, y| {
        let mut sum = DVec3::ZERO;
        for i in 0..SAMPLES * SAMPLES {
            let (sx, sy) = (x * SAMPLES + i % SAMPLES, y * SAMPLES + i / SAMPLES);
            sum += color[(sy * w * SAMPLES + sx) as usize];
        }
        let mean = sum / f64::from(SAMPLES * SAMPLES);
        Rgb(mean.to_array().map(|c| {
            let c = c.clamp(0.0, 1.0);
            let s = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
            (s * 255.0 + 0.5) as u8
        }))
    })
}

/// Pictures side by side, in rows of `columns`.
pub fn tiled(pictures: &[RgbImage], columns: u32) -> RgbImage {
    let (w, h) = pictures.first().map_or((1, 1), RgbImage::dimensions);
    let rows = (pictures.len() as u32).div_ceil(columns);
    let mut all = RgbImage::new(w * columns.min(pictures.len() as u32).max(1), h * rows.max(1));
    for (i, picture) in pictures.iter().enumerate() {
        let (x, y) = (i as u32 % columns * w, i as u32 / columns * h);
        image::imageops::replace(&mut all, picture, i64::from(x), i64::from(y));
    }
    all
}
