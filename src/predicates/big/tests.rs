use super::*;
use crate::random::Rng;

#[test]
fn numbers_decode_to_themselves() {
    for x in [1.0, -0.1, 1e57, f64::MIN_POSITIVE, f64::MIN_POSITIVE.next_down(), -f64::from_bits(1)] {
        let (mantissa, exponent) = decode(x);
        // In two steps, as the power of two alone may underflow.
        let (first, second) = (exponent / 2, exponent - exponent / 2);
        assert_eq!(mantissa as f64 * 2f64.powi(first) * 2f64.powi(second), x);
    }
}

#[test]
fn integers_are_those_of_num_bigint() {
    let rng = &mut Rng::new(1);
    let mut random = || rng.next();
    // Differences: random, or with long runs of equal bits, so that carries go far.
    fn difference<'r>(room: &'r LimbRoom, random: &mut impl FnMut() -> u64) -> Integer<'r> {
        let n_bits = random() as usize % 1266;
        let limbs = room.zeros(n_bits.div_ceil(64));
        let is_run = random().is_multiple_of(3);
        let fill = random();
        for (k, limb) in limbs.iter_mut().enumerate() {
            let any = if !is_run { random() } else { 0u64.wrapping_sub(fill >> k & 1) };
            *limb = any & u64::MAX >> (64 * (k + 1)).saturating_sub(n_bits);
        }
        Integer::new(room, random().is_multiple_of(2), limbs)
    }
    let big = |x: &Integer| {
        let bytes: Vec<u8> = x.magnitude.iter().flat_map(|limb| limb.to_le_bytes()).collect();
        let sign = if x.is_negative { num_bigint::Sign::Minus } else { num_bigint::Sign::Plus };
        assert!(x.magnitude.last().is_none_or(|&limb| limb != 0));
        num_bigint::BigInt::from_bytes_le(sign, &bytes)
    };
    let check = |x: &Integer, expected: &num_bigint::BigInt| {
        assert_eq!(big(x), *expected);
        let sign = match x.sign() {
            Ordering::Less => num_bigint::Sign::Minus,
            Ordering::Equal => num_bigint::Sign::NoSign,
            Ordering::Greater => num_bigint::Sign::Plus,
        };
        assert_eq!(sign, expected.sign());
    };
    for _ in 0..40_000 {
        let room = LimbRoom::new();
        let [a, b, c, d, e] = std::array::from_fn(|_| difference(&room, &mut random));
        let [p, q, r, s, t] = [&a, &b, &c, &d, &e].map(big);
        let (ab, cde, pq, rst) = (a * b, c * d * e, &p * &q, &r * &s * &t);
        check(&ab, &pq);
        check(&(a + b), &(&p + &q));
        check(&(a - b), &(&p - &q));
        check(&(ab - c), &(&pq - &r));
        check(&(cde + ab), &(&rst + &pq));
        let (whole, expected) = (ab * cde, pq * rst);
        check(&whole, &expected);
        check(&(whole - ab), &(&expected - &p * &q));
        check(&(whole - whole), &num_bigint::BigInt::ZERO);
        assert!(whole == cde * b * a);
    }
}

/// There is room for the determinant of the longest numbers, and its terms are not longer than they may be.
#[test]
fn there_is_room_for_the_greatest_determinant() {
    let room = LimbRoom::new();
    let most = room.zeros(20);
    most.fill(u64::MAX);
    most[19] >>= 64 * 20 - 1265;
    let greatest = Integer::new(&room, false, most);
    let degree_5 = greatest * greatest * greatest * greatest * greatest;
    let doubled = |times: usize| (0..times).fold(degree_5, |x, _| x + x);
    let sum = doubled(6) + doubled(3);
    assert_eq!(sum.magnitude.len(), 99);
    let corner = [crate::predicates::MAX_MAGNITUDE, -crate::predicates::MAX_MAGNITUDE];
    let p = |k: usize| [corner[k & 1], corner[k >> 1 & 1], corner[k >> 2 & 1]];
    // A last bit that makes the unit as small as can be, and all limbs below the highest other than zero.
    let near = [corner[0], corner[0], f64::from_bits(1)];
    for k in 0..8 {
        let points = [p(k), p(k ^ 1), p(k ^ 2), p(k ^ 4), near];
        assert_ne!(insphere(1.0, points.each_ref()), 0.0);
        assert_eq!(insphere(1.0, [p(k), p(k ^ 1), p(k ^ 2), p(k ^ 4), p(k ^ 7)].each_ref()), 0.0);
    }
    let rng = &mut Rng::new(1);
    for _ in 0..10_000 {
        // Any coordinates, very large and very small ones in turn.
        let points: [[f64; 3]; 5] = std::array::from_fn(|_| {
            std::array::from_fn(|_| {
                let bits = rng.next();
                let large = (bits >> 11) as f64 / (1u64 << 53) as f64 * corner[(bits >> 8 & 1) as usize];
                if bits >> 63 == 0 { large } else { f64::from_bits(bits >> 60 & 7) }
            })
        });
        let room = LimbRoom::of_any_size();
        let det = insphere_in(&room, points.each_ref());
        assert!(det.magnitude.len() <= 99);
    }
}

#[test]
fn room_depends_on_degree() {
    assert!(has_room([&[0.0, 1.0], &[-1e-128, 1e57]], 2));
    assert!(!has_room([&[1e-130, 1.0]], 2));
    assert!(has_room([&[1e-56, 1.0]], 4) && !has_room([&[-1e-57, 1.0]], 4));
}
