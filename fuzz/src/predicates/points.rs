//! Points of which signs are hard to tell, from bytes.

use super::super::exact_oracle::{bounding_box, nudged};
use super::super::source::{Source, admissible, power_of_two};
use std::array::from_fn;

/// `N` points by one of the rules, then perhaps two of them exchanged.
pub fn points<const D: usize, const N: usize>(s: &mut Source) -> [[f64; D]; N] {
    let mut points = match s.below(13) {
        0 => from_fn(|_| from_fn(|_| s.unit())),
        1 => {
            let scale = scale(s);
            from_fn(|_| from_fn(|_| integer(s) * scale))
        }
        2 => least_bits(s),
        3 => from_fn(|_| from_fn(|_| s.magnitude())),
        4 => distant(s),
        5 => on_sphere(s),
        6 => flat(s),
        7 => layers(s),
        8 => {
            let scales: [f64; D] = from_fn(|_| scale(s));
            from_fn(|_| from_fn(|axis| integer(s) * scales[axis]))
        }
        9 => near_tie(s),
        10 => noisy(s),
        11 => clusters(s),
        _ => rounded_sphere(s),
    };
    if s.below(4) == 0 {
        points.swap(s.below(N), s.below(N));
    }
    if s.below(8) == 0 {
        points[s.below(N)] = points[s.below(N)];
    }
    points.map(|p| p.map(admissible))
}

/// A power of two: 1 as a rule, or any that is accepted.
fn scale(s: &mut Source) -> f64 {
    match s.below(4) {
        0 => power_of_two(i32::from(s.word() % 1250) - 1074),
        1 => power_of_two(s.within(60) as i32),
        _ => 1.0,
    }
}

fn integer(s: &mut Source) -> f64 {
    f64::from(s.byte() as i8)
}

/// All within a few last bits of one place.
fn least_bits<const D: usize, const N: usize>(s: &mut Source) -> [[f64; D]; N] {
    let base: [f64; D] = from_fn(|_| s.magnitude());
    let spread = s.pick(&[1, 2, 7, 100]);
    let scale = s.pick(&[1.0, 1.0, 1e-300, 5e-324]);
    from_fn(|_| {
        from_fn(|axis| {
            let n = s.within(spread);
            if base[axis] == 0.0 { n as f64 * scale } else { nudged(base[axis], n) }
        })
    })
}

/// Small integers far from the origin.
fn distant<const D: usize, const N: usize>(s: &mut Source) -> [[f64; D]; N] {
    let scale = scale(s);
    let offset: [i64; D] = from_fn(|_| s.within(1000) << s.below(43));
    from_fn(|_| from_fn(|axis| (offset[axis] + i64::from(s.byte() as i8)) as f64 * scale))
}

/// Integers on a sphere around the origin, of radius 65 in the plane and 13 in space.
fn integers_on_sphere<const D: usize, const N: usize>(s: &mut Source) -> [[i64; D]; N] {
    const PLANE: [[i64; 3]; 5] = [[0, 65, 0], [16, 63, 0], [25, 60, 0], [33, 56, 0], [39, 52, 0]];
    const SPACE: [[i64; 3]; 5] = [[3, 4, 12], [0, 5, 12], [0, 0, 13], [12, 4, 3], [4, 12, 3]];
    from_fn(|_| {
        let choice = s.byte();
        let p = [PLANE, SPACE][D - 2][usize::from(choice) % 5];
        let mut p: [i64; D] = from_fn(|axis| if choice >> (5 + axis) & 1 == 0 { p[axis] } else { -p[axis] });
        p.rotate_left(s.below(D));
        p
    })
}

/// On a sphere, exactly, but for a few last bits of one coordinate in some.
fn on_sphere<const D: usize, const N: usize>(s: &mut Source) -> [[f64; D]; N] {
    let scale = scale(s);
    let offset: [i64; D] = from_fn(|_| s.within(100) << s.pick(&[0, 0, 20, 40]));
    let mut points: [[f64; D]; N] =
        integers_on_sphere(s).map(|p: [i64; D]| from_fn(|axis| (p[axis] + offset[axis]) as f64 * scale));
    if s.below(2) == 0 {
        let x = &mut points[s.below(N)][s.below(D)];
        *x = nudged(*x, s.within(2));
    }
    points
}

/// On a sphere, but for rounding.
fn rounded_sphere<const D: usize, const N: usize>(s: &mut Source) -> [[f64; D]; N] {
    let centre: [f64; D] = if s.below(2) == 0 { [0.0; D] } else { from_fn(|_| s.unit()) };
    let (radius, scale) = (s.pick(&[1.0, 1e-3, 0.5, 10.0]), scale(s));
    from_fn(|_| {
        let direction: [f64; D] = from_fn(|_| s.unit());
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        from_fn(|axis| (centre[axis] + radius * (direction[axis] / length)) * scale)
    })
}

/// In a line or plane, but for rounding.
fn flat<const D: usize, const N: usize>(s: &mut Source) -> [[f64; D]; N] {
    let is_exact = s.below(2) == 0;
    let number = |s: &mut Source| if is_exact { integer(s) } else { s.unit() };
    let origin: [f64; D] = from_fn(|_| number(s));
    let directions: [[f64; D]; D] = from_fn(|_| from_fn(|_| number(s)));
    let (dimension, scale, ulps) = (1 + s.below(D - 1), scale(s), s.pick(&[0, 1, 3]));
    from_fn(|_| {
        let mut p = origin;
        for direction in &directions[..dimension] {
            let t = number(s);
            p = from_fn(|axis| p[axis] + t * direction[axis]);
        }
        p.map(|x| nudged(x * scale, s.within(ulps)))
    })
}

/// Two or three values along each axis: corners of boxes and prisms.
fn layers<const D: usize, const N: usize>(s: &mut Source) -> [[f64; D]; N] {
    let values: [[f64; 3]; D] =
        from_fn(|_| if s.below(2) == 0 { from_fn(|_| s.magnitude()) } else { from_fn(|_| s.unit()) });
    let n = 2 + s.below(2);
    from_fn(|_| from_fn(|axis| values[axis][s.below(n)]))
}

/// A tie, of which one coordinate is then changed by from the last bit up to half the extent.
fn near_tie<const D: usize, const N: usize>(s: &mut Source) -> [[f64; D]; N] {
    let mut points = if s.below(2) == 0 { on_sphere(s) } else { layers(s) };
    let [low, high] = bounding_box(&points);
    let axis = s.below(D);
    let change = (high[axis] - low[axis]) * power_of_two(-1 - s.below(60) as i32);
    points[s.below(N)][axis] += change * s.pick(&[1.0, -1.0]);
    points
}

/// Small integers with noise that is far less, or that only shows beside zero.
fn noisy<const D: usize, const N: usize>(s: &mut Source) -> [[f64; D]; N] {
    let size = s.pick(&[1e-12, 1e-15, 1e-40, 1e-160, 1e-300]);
    let (offset, scale) = (s.pick(&[0.0, 0.0, 1.0, 1e7]), scale(s));
    from_fn(|_| {
        from_fn(|_| {
            let noise = if s.below(3) == 0 { size * s.unit() } else { 0.0 };
            (s.within(2) as f64 + offset + noise) * scale
        })
    })
}

/// A few last bits around two or three places of different size.
fn clusters<const D: usize, const N: usize>(s: &mut Source) -> [[f64; D]; N] {
    let clusters: [[[f64; D]; N]; 3] = from_fn(|_| least_bits(s));
    let n = 2 + s.below(2);
    from_fn(|i| clusters[s.below(n)][i])
}
