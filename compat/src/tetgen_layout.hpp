// The layout of tetgenio. TetGen's versions have different ones under the same function name, and a call does not say
// which it uses.
#pragma once

#include <deldrift_tetgen.h>

#include <cstddef>

namespace compat {

static_assert(sizeof(tetgenio) == 392 && offsetof(tetgenio, numberofcorners) == 108, "the layout of TetGen 1.5");
static_assert(offsetof(tetgenio, pointlist) == 16 && offsetof(tetgenio, numberofpoints) == 56);
static_assert(offsetof(tetgenio, tetrahedronlist) == 72 && offsetof(tetgenio, facetlist) == 120);
static_assert(offsetof(tetgenio, trifacelist) == 208 && offsetof(tetgenio, edgelist) == 248);
static_assert(offsetof(tetgenio, vpointlist) == 288 && offsetof(tetgenio, geomhandle) == 336);

// Whether io, initialised by its constructor, has the layout of TetGen 1.5: its number of corners, 4, tells. In 1.6 the
// place of that number is in a null pointer. In 1.4 it is in padding, which may be anything, so 1.4's own place of the
// number is looked at first.
bool has_layout_of_1_5(const void *io);

} // namespace compat
