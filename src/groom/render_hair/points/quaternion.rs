//! Quaternions of frames in f32.

/// The unit quaternion x, y, z, w of a rotation matrix's columns: by the largest of its four numbers (Shepperd 1978).
#[inline(always)]
pub(in crate::groom::render_hair) fn quaternion(a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> [f32; 4] {
    let squares = [1.0 + a[0] - b[1] - c[2], 1.0 - a[0] + b[1] - c[2], 1.0 - a[0] - b[1] + c[2], 1.0 + a[0] + b[1] + c[2]];
    let (xy, xz, yz) = (a[1] + b[0], a[2] + c[0], b[2] + c[1]);
    let (wx, wy, wz) = (b[2] - c[1], c[0] - a[2], a[1] - b[0]);
    let mut best = squares[3];
    let mut q = [wx, wy, wz, squares[3]];
    if squares[0] > best {
        (best, q) = (squares[0], [squares[0], xy, xz, wx]);
    }
    if squares[1] > best {
        (best, q) = (squares[1], [xy, squares[1], yz, wy]);
    }
    if squares[2] > best {
        (best, q) = (squares[2], [xz, yz, squares[2], wz]);
    }
    let factor = 0.5 / best.sqrt();
    q.map(|value| value * factor)
}
