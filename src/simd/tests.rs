use super::*;
use crate::random::Rng;

/// The token of AVX2 exists exactly if the processor has that and lanes of numbers are not forced.
#[cfg(target_arch = "x86_64")]
#[test]
fn the_scalar_path_can_be_forced() {
    let is_forced = std::env::var_os("DELDRIFT_SCALAR").is_some();
    assert_eq!(Avx2::new().is_some(), is_x86_feature_detected!("avx2") && !is_forced);
}

/// The token of NEON exists unless lanes of numbers are forced.
#[cfg(all(target_arch = "aarch64", target_endian = "little"))]
#[test]
fn the_scalar_path_can_be_forced() {
    assert_eq!(Neon::new().is_some(), std::env::var_os("DELDRIFT_SCALAR").is_none());
}

/// Calls a test with every token that there is here.
macro_rules! for_all_tokens {
    ($test:ident) => {
        $test(Scalar);
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = Avx2::new() {
            $test(avx2);
        }
        #[cfg(all(target_arch = "aarch64", target_endian = "little"))]
        if let Some(neon) = Neon::new() {
            $test(neon);
        }
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        if let Some(vectors) = Vectors::new() {
            $test(vectors);
        }
    };
}

/// Small integers, fractions and special values.
fn four(rng: &mut Rng) -> [f64; LANES] {
    let special = [0.0, -0.0, 1.0, f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE, 5e-324, f64::MAX];
    std::array::from_fn(|_| match rng.below(4) {
        0 => *rng.pick(&special),
        1 => 1e6 * (rng.unit() - 0.5),
        _ => rng.within(-3, 3) as f64,
    })
}

/// Makes sure that every lane has the bits expected, or NaN where that is expected.
fn assert_same(found: impl Lanes, expected: [f64; LANES], what: &str) {
    for (found, expected) in found.store().into_iter().zip(expected) {
        assert!(
            found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan(),
            "{what}: {found:e}, not {expected:e}"
        );
    }
}

/// Every lane has the same bits as the scalar result.
#[test]
fn lanes_compute_what_numbers_do() {
    for_all_tokens!(lanes_compute);
}

fn lanes_compute(simd: impl Simd) {
    let mut rng = Rng::new(1);
    for _ in 0..2_000 {
        let [x, y, z] = [(); 3].map(|()| four(&mut rng));
        let [a, b, c] = [&x, &y, &z].map(|x| simd.load(x));
        let each = |f: fn(f64, f64, f64) -> f64| std::array::from_fn(|k| f(x[k], y[k], z[k]));
        assert_same(a, x, "load");
        assert_same(a.splat(y[0]), [y[0]; LANES], "splat");
        assert_same(a + b, each(|x, y, _| x + y), "+");
        assert_same(a - b, each(|x, y, _| x - y), "-");
        assert_same(a * b, each(|x, y, _| x * y), "*");
        assert_same(a / b, each(|x, y, _| x / y), "/");
        assert_same(a.sqrt(), each(|x, _, _| Real::sqrt(x)), "sqrt");
        assert_same(a.abs(), each(|x, _, _| Real::abs(x)), "abs");
        assert_same(a.min(b), each(|x, y, _| Real::min(x, y)), "min");
        assert_same(a.max(b), each(|x, y, _| Real::max(x, y)), "max");

        let bits =
            |is_set: &dyn Fn(usize) -> bool| (0..LANES).map(|k| u32::from(is_set(k)) << k).sum::<u32>();
        let (less, greater) = (a.is_less(b), b.is_less(a));
        assert_eq!(less.bits(), bits(&|k| x[k] < y[k]));
        assert_eq!((less & greater).bits(), 0);
        assert_eq!((less | greater).bits(), bits(&|k| x[k] < y[k] || y[k] < x[k]));
        assert_eq!((!less).bits(), bits(&|k| !x[k].is_less(y[k])));
        assert_eq!(a.are_same(b).bits(), bits(&|k| x[k].to_bits() == y[k].to_bits()));
        assert_same(Real::select(less, a, c), each(|x, y, z| if x < y { x } else { z }), "select");
    }
}

/// Loads and stores put every number in the right place.
#[test]
fn lanes_are_where_they_belong() {
    for_all_tokens!(lanes_are_put);
}

fn lanes_are_put<S: Simd>(simd: S) {
    let numbers: Vec<f64> = (0..32).map(f64::from).collect();
    let of = |k: [usize; LANES]| k.map(|k| k as f64);
    let assert_all = |found: &[S::Lanes], expected: &[[usize; LANES]]| {
        assert_eq!(found.len(), expected.len());
        found.iter().zip(expected).for_each(|(&found, &expected)| assert_same(found, of(expected), "load"));
    };
    let [a, b, c, d] = [0, 7, 12, 20].map(|k| numbers[k..].first_chunk().expect("two"));
    assert_all(&[simd.two_pairs(a, b)], &[[0, 1, 7, 8]]);
    assert_all(&simd.pairs([a, b, c, d]), &[[0, 7, 12, 20], [1, 8, 13, 21]]);
    let triples = [0, 7, 12, 20].map(|k| numbers[k..].first_chunk().expect("three"));
    assert_all(&simd.points::<3>(triples), &[[0, 7, 12, 20], [1, 8, 13, 21], [2, 9, 14, 22]]);
    let fours = [0, 7, 12, 20].map(|k| numbers[k..].first_chunk().expect("four"));
    let rows = [[0, 7, 12, 20], [1, 8, 13, 21], [2, 9, 14, 22], [3, 10, 15, 23]];
    assert_all(&simd.fours(fours), &rows);
    let columns = [0, 7, 12, 20].map(|k| [k, k + 1, k + 2, k + 3]);
    assert_all(&super::rows(simd.fours(fours)), &columns);

    let [x, y] = [fours[0], fours[1]].map(|x| simd.load(x));
    assert_all(&[x.with_last_of(y), x.rotated()], &[[0, 1, 2, 10], [1, 2, 3, 0]]);
    for bits in 0..1 << LANES {
        assert_eq!(simd.mask(bits).bits(), bits);
    }
    assert_eq!(simd.are_equal(&[5, u32::MAX, 5, 0], 5).bits(), 0b0101);
    assert_eq!(simd.are_equal(&[5, u32::MAX, 5, 0], u32::MAX).bits(), 0b0010);

    let (mut all, mut three, mut low, mut high) = ([0.0; LANES], [0.0; 3], [0.0; 2], [0.0; 2]);
    y.store_to(&mut all);
    y.store_three_to(&mut three);
    y.store_low_to(&mut low);
    y.store_high_to(&mut high);
    assert_eq!((all, three), ([7.0, 8.0, 9.0, 10.0], [7.0, 8.0, 9.0]));
    assert_eq!((low, high), ([7.0, 8.0], [9.0, 10.0]));
}
