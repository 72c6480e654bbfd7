"""Exact Delaunay triangulations of moving points, in 2D and 3D.

`Delaunay` has the attributes and methods of `scipy.spatial.Delaunay`; its points may move, be inserted and be removed.
In the plane it takes segments, which stay edges; `Mesh` is the mesh of a domain within segments, which may move. The
points of `Regular` and `PeriodicRegular` have weights.

Examples
--------
>>> import deldrift
>>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [1, 1]])
>>> report = tri.move([[3, 2]], ids=[4])
>>> tri.find_simplex([[3.5, 2], [5, 2]]) >= 0
array([ True, False])
"""

from ._arrays import is_current
from ._asking import Locations, in_power_sphere, in_sphere, orientation
from ._delaunay import Delaunay, frombytes, load, tsearch
from ._errors import (
    AmbiguousSeed,
    Busy,
    Cancelled,
    ChangesNotTaken,
    Closed,
    Coincident,
    ConflictError,
    ConflictKind,
    DuplicateMove,
    Error,
    FileError,
    InternalError,
    Invalid,
    InvalidData,
    InvalidDimension,
    InvalidField,
    InvalidOption,
    InvalidShape,
    InvalidValue,
    NoAxis,
    NoSuchSegment,
    NoSuchSimplex,
    NoSuchVertex,
    NotFinite,
    NotWeighted,
    OutOfMemory,
    OutOfRange,
    PassingError,
    Prepared,
    RemovedVertex,
    StagedVertex,
    TooMany,
    UndecidedRegions,
    Weighted,
    WrongCount,
)
from ._geometry import VoronoiCells, VoronoiDerivatives, VoronoiWeightDerivatives
from ._measured import Boundary
from ._library import QualityReport, Report, version
from ._mesh import Mesh
from ._motion import Changes
from ._periodic import PeriodicDelaunay, PeriodicLocations
from ._refining import MadeVertices, RefinedWeights
from ._periodic_regular import PeriodicRegular
from ._regular import Regular, WeightedStep
from ._segments import Chains, Regions, Segments, Splits
from ._step import Step, Trial
from ._transferring import Transfer
from ._weighing import HiddenByWeight

__version__ = "0.1.0"

__all__ = [
    "AmbiguousSeed",
    "Boundary",
    "Busy",
    "Cancelled",
    "Chains",
    "Changes",
    "ChangesNotTaken",
    "Closed",
    "Coincident",
    "ConflictError",
    "ConflictKind",
    "Delaunay",
    "DuplicateMove",
    "Error",
    "FileError",
    "HiddenByWeight",
    "InternalError",
    "Invalid",
    "InvalidData",
    "InvalidDimension",
    "InvalidField",
    "InvalidOption",
    "InvalidShape",
    "InvalidValue",
    "Locations",
    "MadeVertices",
    "Mesh",
    "NoAxis",
    "NoSuchSegment",
    "NoSuchSimplex",
    "NoSuchVertex",
    "NotFinite",
    "NotWeighted",
    "OutOfMemory",
    "OutOfRange",
    "PassingError",
    "PeriodicDelaunay",
    "PeriodicLocations",
    "PeriodicRegular",
    "Prepared",
    "QualityReport",
    "RefinedWeights",
    "Regions",
    "Regular",
    "RemovedVertex",
    "Report",
    "Segments",
    "Splits",
    "StagedVertex",
    "Step",
    "TooMany",
    "Transfer",
    "Trial",
    "UndecidedRegions",
    "VoronoiCells",
    "VoronoiDerivatives",
    "VoronoiWeightDerivatives",
    "Weighted",
    "WeightedStep",
    "WrongCount",
    "frombytes",
    "in_power_sphere",
    "in_sphere",
    "is_current",
    "load",
    "orientation",
    "tsearch",
    "version",
]
