//! Clipping of polylines to the axes, because the drawing backend does not clip.

use std::ops::Range;

type Point = (f64, f64);

/// The rectangle that the axes span.
#[derive(Clone, Debug)]
pub(super) struct Window {
    pub(super) x: Range<f64>,
    pub(super) y: Range<f64>,
}

impl Window {
    /// Whether the point is finite and inside or on the border.
    pub(super) fn contains(&self, (x, y): Point) -> bool {
        (self.x.start..=self.x.end).contains(&x) && (self.y.start..=self.y.end).contains(&y)
    }

    /// The parts of the polyline inside the window; a non-finite point interrupts it.
    pub(super) fn clip(&self, points: &[Point]) -> Vec<Vec<Point>> {
        let mut parts: Vec<Vec<Point>> = Vec::new();
        for pair in points.windows(2) {
            let Some((start, end)) = self.clip_segment(pair[0], pair[1]) else {
                continue;
            };
            match parts.last_mut() {
                Some(part) if part.last() == Some(&start) => part.push(end),
                _ => parts.push(vec![start, end]),
            }
        }
        parts
    }

    /// The part of a segment inside the window (Liang & Barsky 1984): the segment a + t (b − a),
    /// 0 ≤ t ≤ 1, is cut by the four half-planes in turn.
    fn clip_segment(&self, a: Point, b: Point) -> Option<(Point, Point)> {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        if !(dx.is_finite() && dy.is_finite()) {
            return None;
        }
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        let half_planes = [
            (-dx, a.0 - self.x.start),
            (dx, self.x.end - a.0),
            (-dy, a.1 - self.y.start),
            (dy, self.y.end - a.1),
        ];
        for (outward, distance) in half_planes {
            if outward < 0.0 {
                enter = enter.max(distance / outward);
            } else if outward > 0.0 {
                leave = leave.min(distance / outward);
            } else if distance < 0.0 {
                return None;
            }
        }
        let at = |t: f64| (a.0 + t * dx, a.1 + t * dy);
        let start = if enter > 0.0 { at(enter) } else { a };
        let end = if leave < 1.0 { at(leave) } else { b };
        (enter <= leave).then_some((start, end))
    }
}
