// Triangle itself, with an output of its own.
#pragma once

#include <deldrift_triangle.h>

#include "triangle_mesh.hpp"
#include "triangle_switches.hpp"

namespace compat {

// Where the original returns nothing, its caller expects nothing, so what it leaves may be handed on.
using TriangleFunction = int (*)(char *, triangulateio *, triangulateio *, triangulateio *);

// Whether lists of holes and regions in the output of a Triangle are copies, which its callers free, as in cytriangle's, and
// not the lists of the input, as in Triangle 1.6. It is called with a square of its own to tell.
bool copies_lists(TriangleFunction function);

class TriangleOriginal {
public:
    // Calls the function for what is in; what it is asked for are the cells and what belongs to them.
    TriangleOriginal(TriangleFunction function, const TriangleSwitches &switches, const triangulateio &in);
    TriangleOriginal(const TriangleOriginal &) = delete;
    TriangleOriginal &operator=(const TriangleOriginal &) = delete;
    ~TriangleOriginal();

    int returned() const { return returned_; }
    double seconds() const { return seconds_; }
    Cells cells() const;
    // Refers to the output.
    Mesh mesh() const;

private:
    const TriangleSwitches &switches_;
    const double *holes_, *regions_;
    triangulateio out_{}, vorout_{};
    int returned_ = 1;
    double seconds_ = 0;
};

} // namespace compat
