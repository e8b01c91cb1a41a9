//! Eight f64 in an AVX-512 register (experiment).
#![allow(unsafe_code)]
use super::lane::Lane;
use std::arch::x86_64::*;
use std::ops::*;
/// Eight lanes.
#[derive(Debug, Clone, Copy)]
#[repr(transparent)]
pub struct V8(pub __m512d);
macro_rules! op { ($t:ident,$f:ident,$i:ident) => { impl $t for V8 { type Output=Self; #[inline(always)] fn $f(self,o:Self)->Self{ unsafe { V8($i(self.0,o.0)) } } } } }
op!(Add,add,_mm512_add_pd); op!(Sub,sub,_mm512_sub_pd); op!(Mul,mul,_mm512_mul_pd); op!(Div,div,_mm512_div_pd);
impl Neg for V8 { type Output=Self; #[inline(always)] fn neg(self)->Self{ unsafe { V8(_mm512_castsi512_pd(_mm512_xor_si512(_mm512_castpd_si512(self.0), _mm512_set1_epi64(i64::MIN)))) } } }
impl AddAssign for V8 { #[inline(always)] fn add_assign(&mut self,o:Self){*self=*self+o;} }
impl SubAssign for V8 { #[inline(always)] fn sub_assign(&mut self,o:Self){*self=*self-o;} }
impl Lane for V8 {
    type Mask = u8;
    #[inline(always)] fn splat(v:f64)->Self{ unsafe { V8(_mm512_set1_pd(v)) } }
    #[inline(always)] fn sqrt(self)->Self{ unsafe { V8(_mm512_sqrt_pd(self.0)) } }
    #[inline(always)] fn round(self)->Self{ unsafe { V8(_mm512_roundscale_pd::<0>(self.0)) } }
    #[inline(always)] fn floor(self)->Self{ unsafe { V8(_mm512_roundscale_pd::<1>(self.0)) } }
    #[inline(always)] fn less(self,o:Self)->u8{ unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0,o.0) } }
    #[inline(always)] fn select(m:u8,y:Self,n:Self)->Self{ unsafe { V8(_mm512_mask_blend_pd(m,n.0,y.0)) } }
    #[inline(always)] fn any(m:u8)->bool{ m!=0 }
    #[inline(always)] fn all(m:u8)->bool{ m==255 }
    const LANES: usize = 8;
    #[inline(always)] fn lane(self,i:usize)->f64{ let a:[f64;8]=unsafe{std::mem::transmute(self.0)}; a[i] }
    #[inline(always)] fn set_lane(&mut self,i:usize,v:f64){ let mut a:[f64;8]=unsafe{std::mem::transmute(self.0)}; a[i]=v; self.0=unsafe{std::mem::transmute(a)}; }
    #[inline(always)] fn mask_lane(m:u8,i:usize)->bool{ m>>i&1==1 }
    #[inline(always)] fn both(a:u8,b:u8)->u8{ a&b }
    #[inline(always)] fn splat_mask(v:bool)->u8{ if v {255} else {0} }
}
/// Four lanes, AVX2.
#[derive(Debug, Clone, Copy)]
#[repr(transparent)]
pub struct V4(pub __m256d);
macro_rules! op4 { ($t:ident,$f:ident,$i:ident) => { impl $t for V4 { type Output=Self; #[inline(always)] fn $f(self,o:Self)->Self{ unsafe { V4($i(self.0,o.0)) } } } } }
op4!(Add,add,_mm256_add_pd); op4!(Sub,sub,_mm256_sub_pd); op4!(Mul,mul,_mm256_mul_pd); op4!(Div,div,_mm256_div_pd);
impl Neg for V4 { type Output=Self; #[inline(always)] fn neg(self)->Self{ unsafe { V4(_mm256_xor_pd(self.0, _mm256_set1_pd(-0.0))) } } }
impl AddAssign for V4 { #[inline(always)] fn add_assign(&mut self,o:Self){*self=*self+o;} }
impl SubAssign for V4 { #[inline(always)] fn sub_assign(&mut self,o:Self){*self=*self-o;} }
impl Lane for V4 {
    type Mask = __m256d;
    #[inline(always)] fn splat(v:f64)->Self{ unsafe { V4(_mm256_set1_pd(v)) } }
    #[inline(always)] fn sqrt(self)->Self{ unsafe { V4(_mm256_sqrt_pd(self.0)) } }
    #[inline(always)] fn round(self)->Self{ unsafe { V4(_mm256_round_pd::<0>(self.0)) } }
    #[inline(always)] fn floor(self)->Self{ unsafe { V4(_mm256_round_pd::<1>(self.0)) } }
    #[inline(always)] fn less(self,o:Self)->__m256d{ unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(self.0,o.0) } }
    #[inline(always)] fn select(m:__m256d,y:Self,n:Self)->Self{ unsafe { V4(_mm256_blendv_pd(n.0,y.0,m)) } }
    #[inline(always)] fn any(m:__m256d)->bool{ unsafe { _mm256_movemask_pd(m)!=0 } }
    #[inline(always)] fn all(m:__m256d)->bool{ unsafe { _mm256_movemask_pd(m)==15 } }
    const LANES: usize = 4;
    #[inline(always)] fn lane(self,i:usize)->f64{ let a:[f64;4]=unsafe{std::mem::transmute(self.0)}; a[i] }
    #[inline(always)] fn set_lane(&mut self,i:usize,v:f64){ let mut a:[f64;4]=unsafe{std::mem::transmute(self.0)}; a[i]=v; self.0=unsafe{std::mem::transmute(a)}; }
    #[inline(always)] fn mask_lane(m:__m256d,i:usize)->bool{ unsafe { _mm256_movemask_pd(m)>>i&1==1 } }
    #[inline(always)] fn both(a:__m256d,b:__m256d)->__m256d{ unsafe { _mm256_and_pd(a,b) } }
    #[inline(always)] fn splat_mask(v:bool)->__m256d{ unsafe { if v { _mm256_castsi256_pd(_mm256_set1_epi64x(-1)) } else { _mm256_setzero_pd() } } }
}
