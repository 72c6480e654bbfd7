//! Whether arguments have a meaning.

use crate::delaunay::Plane;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::motion::options::{CoarsenOptions, MAX_LEAST_ANGLE, Quality};
use crate::motion::triangulation::MovingTriangulation;

impl MovingTriangulation<Plane> {
    /// Whether a call can be made with these arguments.
    pub(super) fn check_quality(&self, quality: &Quality, mask: &[u8]) -> Result<()> {
        let segments = self.mesh.segments.as_ref().map_or(0, |s| s.staged().len() + s.leaving().len());
        let (moves, (coming, leaving)) = (self.staged_count(), self.staged_edits());
        if moves + coming + leaving + segments > 0 {
            return Err(Error::Staged { moves, edits: coming + leaving, segments });
        }
        let n = self.cell_count();
        let lengths = [
            ("mask", Some(mask.len()), n),
            ("labels", quality.labels.map(<[u32]>::len), n),
            ("sizes", quality.sizes.map(<[f64]>::len), self.id_count()),
        ];
        for (argument, given, wanted) in lengths {
            if let Some(given) = given.filter(|&given| given != wanted) {
                return Err(Error::WrongCount { argument, given, wanted, coming: 0 });
            }
        }
        let value = quality.least_angle;
        if !(0.0..=MAX_LEAST_ANGLE).contains(&value) {
            let wanted = "from 0 to 34 degrees";
            return Err(Error::InvalidValue { argument: "least_angle", index: 0, value, wanted });
        }
        check_all("greatest_area", &[quality.greatest_area], |x| x >= 0.0, "0 or more")?;
        check_all("areas", quality.areas, |x| x >= 0.0, "0 or more")?;
        let mut sizes = quality.sizes.unwrap_or_default().iter().enumerate();
        let is_bad = |&(v, &size): &(usize, &f64)| {
            (size.is_nan() || size <= 0.0) && self.mesh.is_present(VertexId::new(v as u32))
        };
        sizes.find(is_bad).map_or(Ok(()), |(index, &value)| {
            Err(Error::InvalidValue { argument: "sizes", index, value, wanted: "above 0" })
        })
    }
}

fn check_all(
    argument: &'static str,
    values: &[f64],
    is_good: impl Fn(f64) -> bool,
    wanted: &'static str,
) -> Result<()> {
    match values.iter().position(|&value| !is_good(value)) {
        Some(index) => Err(Error::InvalidValue { argument, index, value: values[index], wanted }),
        None => Ok(()),
    }
}

impl CoarsenOptions {
    /// Whether each number has a meaning.
    pub(crate) fn check(&self) -> Result<()> {
        check_all("margin", &[self.margin], |x| (0.0..=30.0).contains(&x), "from 0 to 30 degrees")?;
        check_all("share", &[self.share], |x| x > 0.0 && x <= 1.0, "above 0 and up to 1")?;
        check_all("joins", &[self.joins], |x| (0.0..=1.0).contains(&x), "from 0 to 1")?;
        check_all("growth", &[self.growth], |x| x >= 1.0, "1 or more")
    }
}
