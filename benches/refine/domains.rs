//! Six domains, and a beam.

/// Places, edges between them, and how many of these, the first, are loops around the domain and its holes.
pub struct Domain {
    pub name: &'static str,
    pub points: Vec<[f64; 2]>,
    pub edges: Vec<[usize; 2]>,
    pub n_loops: usize,
    /// A place in each hole.
    pub holes: Vec<[f64; 2]>,
}

impl Domain {
    fn new(name: &'static str) -> Self {
        Domain { name, points: Vec::new(), edges: Vec::new(), n_loops: 0, holes: Vec::new() }
    }

    fn with_ring(mut self, ring: &[[f64; 2]]) -> Self {
        let (first, n) = (self.points.len(), ring.len());
        self.points.extend(ring);
        self.edges.extend((0..n).map(|k| [first + k, first + (k + 1) % n]));
        self.n_loops = self.edges.len();
        self
    }

    fn with_hole(mut self, ring: &[[f64; 2]], place: [f64; 2]) -> Self {
        self.holes.push(place);
        self.with_ring(ring)
    }

    fn with_chain(mut self, chain: &[[f64; 2]]) -> Self {
        let first = self.points.len();
        self.points.extend(chain);
        self.edges.extend((1..chain.len()).map(|k| [first + k - 1, first + k]));
        self
    }
}

fn circle(radius: f64, n: usize) -> Vec<[f64; 2]> {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / n as f64;
    (0..n).map(|k| [radius * angle(k).cos(), radius * angle(k).sin()]).collect()
}

fn rectangle(low: [f64; 2], high: [f64; 2]) -> [[f64; 2]; 4] {
    [low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// A square, one with a hole, a letter with small angles, a slit, an L and a ring.
pub fn domains() -> Vec<Domain> {
    let square = |name| Domain::new(name).with_ring(&rectangle([0.0, 0.0], [1.0, 1.0]));
    let letter =
        [[0.0, 0.0], [0.2, 0.0], [0.5, 0.8], [0.52, 0.8], [0.8, 0.0], [1.0, 0.0], [0.55, 1.0], [0.45, 1.0]];
    let bars = [[0.45, 0.9], [0.55, 0.95], [0.55, 0.9]];
    let l = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.5, 0.5], [0.5, 1.0], [0.0, 1.0]];
    vec![
        square("square"),
        square("hole").with_hole(&rectangle([0.4, 0.4], [0.6, 0.6]), [0.5, 0.5]),
        Domain::new("letter").with_ring(&letter).with_chain(&bars),
        square("slit").with_chain(&[[0.3, 0.5], [0.7, 0.5]]),
        Domain::new("L").with_ring(&l),
        Domain::new("ring").with_ring(&circle(1.0, 64)).with_hole(&circle(0.4, 32), [0.0, 0.0]),
    ]
}

/// A rectangle with a hole, of two by one.
pub fn beam() -> Domain {
    let outline = rectangle([-1.0, -0.5], [1.0, 0.5]);
    Domain::new("beam").with_ring(&outline).with_hole(&circle(0.2, 48), [0.0, 0.0])
}
