//! The free curvatures as a compile-time constant of the kernels: a kernel computes nothing for a frozen curvature.

/// The axes whose bits are set in `mask`, ascending. `D` must be their number.
pub(crate) const fn axes<const D: usize>(mask: u32) -> [usize; D] {
    let mut axes = [0; D];
    let (mut axis, mut next) = (0, 0);
    while axis < 3 {
        if mask & (1 << axis) != 0 {
            axes[next] = axis;
            next += 1;
        }
        axis += 1;
    }
    axes
}

/// Chooses the kernel for the free curvatures `axes` (ascending): `call!(list, D, MASK)`, where `list` names the scratch memory
/// of kernels with D free curvatures (`one`, `two`, `three`) and MASK has the bits of [`axes`].
macro_rules! for_axes {
    ($axes:expr, $call:ident) => {
        match *$axes {
            [0] => $call!(one, 1, 1),
            [1] => $call!(one, 1, 2),
            [_] => $call!(one, 1, 4),
            [0, 1] => $call!(two, 2, 3),
            [0, _] => $call!(two, 2, 5),
            [_, _] => $call!(two, 2, 6),
            _ => $call!(three, 3, 7),
        }
    };
}
pub(crate) use for_axes;
