//! A band of pixels with depths, and what is drawn into it.

use nalgebra::{Vector2, Vector3};

/// Linear light: red, green and blue from 0 to 1.
pub(super) type Light = [f32; 3];

/// Rows of a picture. Places are in pixels, x to the right, y down from the first row of the picture, z towards the eye.
pub(super) struct Band<'a> {
    pub(super) width: usize,
    /// The first row.
    pub(super) first: usize,
    pub(super) light: &'a mut [Light],
    pub(super) depth: &'a mut [f32],
}

impl Band<'_> {
    /// The pixels of a row whose middles lie from `low` to `high`, as a range of columns and where the row begins.
    fn row(&self, y: usize, low: f64, high: f64) -> (std::ops::Range<usize>, usize) {
        let from = (low - 0.5).ceil().max(0.0) as usize;
        let to = ((high - 0.5).floor() + 1.0).clamp(0.0, self.width as f64) as usize;
        (from..to.max(from), (y - self.first) * self.width)
    }

    /// The rows whose middles lie from `low` to `high`.
    fn rows(&self, low: f64, high: f64) -> std::ops::Range<usize> {
        let end = self.first + self.depth.len() / self.width.max(1);
        let from = ((low - 0.5).ceil().max(0.0) as usize).max(self.first);
        let to = (((high - 0.5).floor() + 1.0).max(0.0) as usize).min(end);
        from..to.max(from)
    }

    fn put(&mut self, at: usize, depth: f64, light: impl FnOnce() -> Light) {
        let depth = depth as f32;
        if depth > self.depth[at] {
            self.depth[at] = depth;
            self.light[at] = light();
        }
    }

    /// A triangle; `light` is that at shares of the second and the third corner.
    pub(super) fn triangle(
        &mut self,
        [a, b, c]: [Vector3<f64>; 3],
        light: impl Fn(f64, f64) -> Light,
    ) {
        let (along, across) = (b.xy() - a.xy(), c.xy() - a.xy());
        let area = along.perp(&across);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        for y in self.rows(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y)) {
            let (columns, start) = self.row(y, a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x));
            for x in columns {
                let from_a = Vector2::new(x as f64 + 0.5 - a.x, y as f64 + 0.5 - a.y);
                let (s, t) = (from_a.perp(&across) / area, along.perp(&from_a) / area);
                if s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
                    let depth = a.z + s * (b.z - a.z) + t * (c.z - a.z);
                    self.put(start + x, depth, || light(s, t));
                }
            }
        }
    }

    /// A stroke with round ends, or where both ends are the same a dot.
    pub(super) fn stroke(&mut self, [a, b]: [Vector3<f64>; 2], width: f64, light: Light) {
        let (half, along) = (0.5 * width, b.xy() - a.xy());
        let squared = along.norm_squared();
        for y in self.rows(a.y.min(b.y) - half, a.y.max(b.y) + half) {
            let (columns, start) = self.row(y, a.x.min(b.x) - half, a.x.max(b.x) + half);
            for x in columns {
                let from_a = Vector2::new(x as f64 + 0.5 - a.x, y as f64 + 0.5 - a.y);
                let share = match squared > 0.0 {
                    true => (from_a.dot(&along) / squared).clamp(0.0, 1.0),
                    false => 0.0,
                };
                if (from_a - along * share).norm_squared() <= half * half {
                    self.put(start + x, a.z + share * (b.z - a.z), || light);
                }
            }
        }
    }
}
