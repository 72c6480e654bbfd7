//! Bytes, read as decisions and numbers. What is read beyond the end is zero.

/// Where the reading is.
pub struct Source<'a> {
    data: &'a [u8],
    at: usize,
}

impl<'a> Source<'a> {
    pub fn new(data: &'a [u8]) -> Self {
        Source { data, at: 0 }
    }

    /// Whether all has been read.
    pub fn is_done(&self) -> bool {
        self.at >= self.data.len()
    }

    /// What has not been read.
    pub fn rest(&self) -> &'a [u8] {
        &self.data[self.at.min(self.data.len())..]
    }

    pub fn byte(&mut self) -> u8 {
        let byte = self.data.get(self.at).copied().unwrap_or(0);
        self.at += 1;
        byte
    }

    fn bytes<const N: usize>(&mut self) -> [u8; N] {
        std::array::from_fn(|_| self.byte())
    }

    pub fn word(&mut self) -> u16 {
        u16::from_le_bytes(self.bytes())
    }

    pub fn long(&mut self) -> u64 {
        u64::from_le_bytes(self.bytes())
    }

    /// Below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        if n <= 256 { usize::from(self.byte()) % n.max(1) } else { usize::from(self.word()) % n }
    }

    /// One of several.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// From -n to n.
    pub fn within(&mut self, n: i64) -> i64 {
        self.below(2 * n as usize + 1) as i64 - n
    }

    /// In [-1, 1), with all bits of a mantissa in use, of few bytes.
    pub fn unit(&mut self) -> f64 {
        let mut z = u64::from(self.word()).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A magnitude of note, or any; within what the library accepts.
    pub fn magnitude(&mut self) -> f64 {
        const NOTED: [f64; 20] = [
            0.0,
            5e-324,
            2.3e-308,
            1e-300,
            1e-170,
            1e-162,
            1e-128,
            1e-80,
            1e-56,
            1e-42,
            1e-20,
            1e-12,
            0.1,
            1.0,
            3.0,
            1e7,
            9007199254740993.0,
            1e30,
            1e56,
            1e57,
        ];
        let tag = self.byte();
        let x = match tag % 8 {
            0..=3 => self.pick(&NOTED),
            4 => power_of_two(i32::from(self.word() % 1263) - 1074),
            5 => self.pick(&NOTED) * f64::from(self.byte()),
            _ => f64::from_bits(self.long()),
        };
        let nudge = if tag & 64 != 0 { self.within(3) } else { 0 };
        admissible(super::exact_oracle::nudged(if tag & 128 != 0 { -x } else { x }, nudge))
    }
}

/// The accepted number that stands for any.
pub fn admissible(x: f64) -> f64 {
    if x.is_nan() { 0.0 } else { x.clamp(-1e57, 1e57) }
}

/// For exponents from -1074 on.
pub fn power_of_two(exponent: i32) -> f64 {
    2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2)
}
