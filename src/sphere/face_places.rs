//! Directions on a face of the cube by their half-angle tangents, in which the weights of [cells](super::cell_weight) run.

/// The half-angle tangents of a direction on a face; beyond all cells if it lies behind the face.
#[inline(always)]
pub(crate) fn place(face: u8, n: &[f64; 3]) -> [f64; 2] {
    let axis = usize::from(face / 2);
    let depth = if face.is_multiple_of(2) {
        n[axis]
    } else {
        -n[axis]
    };
    if depth <= 0.0 {
        return [f64::INFINITY; 2];
    }
    across(axis).map(|axis| n[axis] / (depth + (depth * depth + n[axis] * n[axis]).sqrt()))
}

/// The half-angle tangents of N directions on a face, with their derivatives: the same for all its cells.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FacePlaces<const N: usize> {
    pub(super) along: [Tangents<N>; 2],
    /// 1, or 0 for a direction behind the face, where the weight is 0 whatever the profiles say.
    pub(super) front: [f64; N],
}

/// Half-angle tangents q, and their derivatives with respect to the components of n.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tangents<const N: usize> {
    pub(super) q: [f64; N],
    /// First derivatives along the face's axis, ...
    pub(super) depth: [f64; N],
    /// ... and along the face.
    pub(super) height: [f64; N],
    /// Second derivatives: twice along the axis, twice along the face, along both.
    pub(super) bends: [[f64; N]; 3],
}

/// Directions of less depth are behind a face.
const LEAST_DEPTH: f64 = 1e-3;

impl<const N: usize> FacePlaces<N> {
    /// What to begin with.
    pub(crate) const NOWHERE: Self = Self {
        along: [Tangents::NOWHERE; 2],
        front: [0.0; N],
    };

    /// The places of N directions, given component by component, on a face.
    #[inline(always)]
    pub(crate) fn new<const ORDER: usize>(face: u8, n: &[[f64; N]; 3]) -> Self {
        let axis = usize::from(face / 2);
        let side = if face.is_multiple_of(2) { 1.0 } else { -1.0 };
        let (mut depth, mut front) = (n[axis], [0.0; N]);
        for i in 0..N {
            depth[i] *= side;
            front[i] = if depth[i] > 0.0 { 1.0 } else { 0.0 };
            depth[i] = if depth[i] > LEAST_DEPTH {
                depth[i]
            } else {
                LEAST_DEPTH
            };
        }
        let [b, c] = across(axis);
        Self {
            along: [
                Tangents::new::<ORDER>(side, &depth, &n[b]),
                Tangents::new::<ORDER>(side, &depth, &n[c]),
            ],
            front,
        }
    }
}

impl<const N: usize> Tangents<N> {
    const NOWHERE: Self = Self {
        q: [0.0; N],
        depth: [0.0; N],
        height: [0.0; N],
        bends: [[0.0; N]; 3],
    };

    /// q = tan(alpha / 2) with tan(alpha) = height / depth.
    #[inline(always)]
    fn new<const ORDER: usize>(side: f64, depth: &[f64; N], height: &[f64; N]) -> Self {
        let mut out = Self::NOWHERE;
        for i in 0..N {
            let (d, h) = (depth[i], height[i]);
            let squared = d * d + h * h;
            let q = h / (d + squared.sqrt());
            out.q[i] = q;
            if ORDER > 0 {
                let per_angle = 0.5 * (1.0 + q * q);
                let per = per_angle / squared;
                (out.depth[i], out.height[i]) = (-side * h * per, d * per);
                if ORDER > 1 {
                    let (per_squared, turn) = (per / squared, 2.0 * d * h);
                    out.bends[0][i] = (turn + q * h * h) * per_squared;
                    out.bends[1][i] = (q * d * d - turn) * per_squared;
                    out.bends[2][i] = side * (h * h - d * d - q * h * d) * per_squared;
                }
            }
        }
        out
    }
}

/// The axes along which the face of an axis is cut.
#[inline(always)]
pub(super) fn across(axis: usize) -> [usize; 2] {
    [[1, 2], [2, 0], [0, 1]][axis]
}
