// Where two segments cross.
#pragma once

namespace compat {

// How far along the segment a b the crossing with c d is: between 0 and 1. The ends of each are strictly on different
// sides of the other. The quotient has a small relative error, however flat the angle.
double crossing_along(const double *a, const double *b, const double *c, const double *d);

} // namespace compat
