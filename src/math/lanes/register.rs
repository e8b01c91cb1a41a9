//! What all packed types share, whatever their instructions.

/// Defines a packed type: its name, register, scalar, lanes and precision, the intrinsics of its arithmetic, its negation, and
/// the rest of its [`Lane`](crate::math::lane::Lane): masks and calls, which differ between instruction sets.
///
/// Safety of all blocks here and of those passed in: an intrinsic needs its instructions and nothing else, and values of these
/// types are only made where those were detected (see the module). Pointers go to the value itself, which has the size and
/// alignment of the array that it is read as.
macro_rules! register {
    (
        $(#[$doc:meta])* $name:ident($register:ty), $scalar:ty, $lanes:literal, $precision:ident,
        $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident, $set1:ident,
        negate: |$x:ident| $negate:expr,
        { $($rest:tt)* }
    ) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy)]
        #[repr(transparent)]
        pub(crate) struct $name($register);

        register!(@operator $name, Add, add, $add);
        register!(@operator $name, Sub, sub, $sub);
        register!(@operator $name, Mul, mul, $mul);
        register!(@operator $name, Div, div, $div);

        impl std::ops::Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                let $x = self.0;
                // SAFETY: see the macro's comment.
                unsafe { Self($negate) }
            }
        }
        impl std::ops::AddAssign for $name {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl std::ops::SubAssign for $name {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }

        // SAFETY of every block: see the macro's comment.
        impl Lane for $name {
            const LANES: usize = $lanes;
            const PRECISION: Precision = Precision::$precision;

            #[inline(always)]
            fn splat(value: f64) -> Self {
                unsafe { Self($set1(value as $scalar)) }
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                unsafe { Self($sqrt(self.0)) }
            }
            #[inline(always)]
            fn lane(&self, index: usize) -> f64 {
                let lanes = unsafe { &*std::ptr::from_ref(self).cast::<[$scalar; $lanes]>() };
                f64::from(lanes[index])
            }
            #[inline(always)]
            fn set_lane(&mut self, index: usize, value: f64) {
                let lanes = unsafe { &mut *std::ptr::from_mut(self).cast::<[$scalar; $lanes]>() };
                lanes[index] = value as $scalar;
            }
            $($rest)*
        }
    };
    (@operator $name:ident, $trait:ident, $function:ident, $intrinsic:ident) => {
        impl std::ops::$trait for $name {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                // SAFETY: see the macro's comment.
                unsafe { Self($intrinsic(self.0, other.0)) }
            }
        }
    };
}
