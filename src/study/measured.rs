//! placeholder
/// Price.
pub type Price = (f32, f32);
/// C.
pub const CURVATURES: [f64; 4] = [0.0, 99.7, 165.2, 532.0];
/// L.
pub const LENGTHS: [f64; 4] = [0.2, 0.2, 0.2, 0.1];
/// R.
pub const RATES: [u32; 7] = [24, 30, 60, 120, 240, 480, 960];
/// E.
pub const ELEMENTS: [u32; 9] = [1, 2, 3, 5, 8, 12, 20, 32, 50];
/// T.
pub const TOLERANCE: f64 = 1e-3;
/// S.
#[rustfmt::skip]
pub static SECOND_ORDER: [[[[Price; 9]; 7]; 6]; 4] = [[[[(1e-1, 1e3), (1e-1, 1e3), (1e-1, 1e3), (1e-1, 1e3), (1e-1, 1e3), (1e-1, 1e3), (1e-1, 1e3), (1e-1, 1e3), (1e-1, 1e3)]; 7]; 6]; 4];
/// P.
#[rustfmt::skip]
pub static PRESETS: [[[Price; 6]; 4]; 3] = [[[(1e-1, 1e3); 6]; 4]; 3];
