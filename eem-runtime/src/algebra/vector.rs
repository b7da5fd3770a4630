//! Vectors of numbers: a few coordinates, or all of a scene.

use eem_material::number::scalar::Scalar;

/// The vector with these entries: `core::array::from_fn` for numbers, in a thirtieth of its code.
#[inline]
pub(crate) fn vector<T: Copy + Default, const N: usize>(
    entry: impl Fn(usize) -> T + Copy,
) -> [T; N] {
    let mut all = [T::default(); N];
    let mut index = 0;
    while index < N {
        all[index] = entry(index);
        index += 1;
    }
    all
}

/// These indices in ascending order, each once. In less code than a set, which is compiled for each type of its entries.
pub(crate) fn ascending<T: Ord>(mut indices: Vec<T>) -> Vec<T> {
    indices.sort_unstable();
    indices.dedup();
    indices
}

/// Two indices as they are stored.
#[inline]
pub(crate) const fn indices([one, other]: [u32; 2]) -> [usize; 2] {
    [one as usize, other as usize]
}

/// `factor a`.
#[inline]
pub(crate) fn scaled<const D: usize>(factor: f64, a: &[f64; D]) -> [f64; D] {
    vector(|axis| factor * a[axis])
}

/// `a − b`.
#[inline]
pub(crate) fn difference<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    vector(|axis| a[axis] - b[axis])
}

/// `sum += factor a`.
#[inline]
pub(crate) fn add(sum: &mut [f64], factor: f64, a: &[f64]) {
    for (sum, &a) in sum.iter_mut().zip(a) {
        *sum += factor * a;
    }
}

/// `a·b`.
#[inline]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (&a, &b)| sum + a * b)
}

/// `Σ |a_i|`, no less than `|a|₂`.
#[inline]
pub(crate) fn size(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |size, &x| size + x.abs())
}

/// The largest `|a_i|`.
#[inline]
pub(crate) fn largest(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |most, x| Scalar::maximum(most, x.abs()))
}

/// `|a|₂` step by step, so that no square over- or underflows.
pub(crate) fn hypot(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |length, &x| Scalar::hypot(length, x))
}

/// `|a|₂` of numbers in memory.
pub(crate) fn length(a: &[f64]) -> f64 {
    norm(a.iter().copied())
}

/// `|a|₂`, scaled where squares would under- or overflow.
pub(crate) fn norm(a: impl Iterator<Item = f64> + Clone) -> f64 {
    let sum = a.clone().fold(0.0, |sum, x| sum + x * x);
    if sum > f64::MIN_POSITIVE && sum <= f64::MAX {
        return sum.sqrt();
    }
    scaled_norm(&move |see: See<'_>| a.clone().for_each(see))
}

/// A function of a number.
type See<'a> = &'a mut dyn FnMut(f64);

/// The same in units of the largest number, given a function that calls another one with each.
#[cold]
fn scaled_norm(each: &dyn Fn(See<'_>)) -> f64 {
    let (mut most, mut sum) = (0.0, 0.0);
    each(&mut |x| most = Scalar::maximum(most, x.abs()));
    if most == 0.0 {
        return most;
    }
    each(&mut |x| sum += (x / most) * (x / most));
    most * sum.sqrt()
}

/// `Σ w a`.
#[inline]
pub(crate) fn combined<const D: usize>(
    weights: &[f64],
    vectors: impl IntoIterator<Item = [f64; D]>,
) -> [f64; D] {
    let mut sum = [0.0; D];
    for (&weight, vector) in weights.iter().zip(vectors) {
        add(&mut sum, weight, &vector);
    }
    sum
}
