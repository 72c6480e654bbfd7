// Triangle itself, with an output of its own.
#pragma once

#include <deldrift_triangle.h>

#include "triangle_mesh.hpp"
#include "triangle_switches.hpp"

namespace compat {

// Where the original returns nothing, its caller expects nothing, so what it leaves may be handed on.
using TriangleFunction = int (*)(char *, triangulateio *, triangulateio *, triangulateio *);

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
    triangulateio out_{}, vorout_{};
    int returned_ = 1;
    double seconds_ = 0;
};

} // namespace compat
