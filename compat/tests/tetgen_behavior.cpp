// Programs that give TetGen a tetgenbehavior in the place of switches, in the layout of TetGen 1.5.0, declared here: what
// they get is what the switches give; and trifree.
#include <deldrift_tetgen.h>
#include <deldrift_triangle.h>

#include <cstddef>
#include <cstring>
#include <string>

#include "check.hpp"

// TetGen's numbers of switches have the names of what they do; here they are in their order.
class tetgenbehavior {
public:
    int switches[39] = {0, 0, 0, 0, 0, 0, 0, 1};
    int parameters[20] = {4092, 8188, 4092, 2, 1, 0, 0, -1, -1, 1, 3, 2, 7, 1, 1, -1, 0, 52, 8, 64};
    double numbers[11] = {0.125, 179.9, -1, 0, 5, 165, 179, 179, 1e-8, 0, 1};
    char names[5][1024] = {};
    int object = 0;
};
void tetrahedralize(tetgenbehavior *b, tetgenio *in, tetgenio *out, tetgenio *addin, tetgenio *bgmin);
extern "C" void trifree_of_cxx(void *list) __asm__("_Z7trifreePv");

namespace {

constexpr int n_points = 60;
constexpr std::size_t weighted = 6, z = 22, n = 25, markers = 29, quiet = 37, refines = 2;
// Of the parameters.
constexpr std::size_t heights = 6, order = 14;

struct Lent {
    tetgenio in, out;
    explicit Lent(Points &points) {
        in.pointlist = points.data();
        in.numberofpoints = n_points;
        in.firstnumber = 1;
    }
    ~Lent() { in.pointlist = nullptr; }
};

std::vector<int> list(const int *from, int count) {
    if (from == nullptr) return {-9};
    return std::vector<int>(from, from + count);
}

std::vector<std::vector<int>> lists(const tetgenio &io) {
    return {list(io.tetrahedronlist, 4 * io.numberoftetrahedra), list(io.neighborlist, 4 * io.numberoftetrahedra),
            list(io.trifacelist, 3 * io.numberoftrifaces), list(io.trifacemarkerlist, io.numberoftrifaces),
            list(io.edgelist, 2 * io.numberofedges), list(io.pointmarkerlist, io.numberofpoints),
            {io.numberofvpoints, io.numberofvedges, io.numberofvcells}};
}

// Which numbers are set, and the switches that say so.
struct Row {
    std::vector<std::size_t> set;
    const char *switches;
};

void is_what_the_switches_give(Points &points) {
    for (const Row &row : {Row{{}, ""}, Row{{z}, "z"}, Row{{z, n, quiet}, "znQ"}, Row{{23, 24}, "fe"}, Row{{26}, "v"},
                           Row{{markers, 23}, "Bf"}, Row{{30}, "N"}, Row{{31}, "E"}, Row{{32}, "F"}, Row{{33}, "I"},
                           Row{{34, n}, "Jn"}, Row{{20, 21, 38}, "XV"}, Row{{weighted, z}, "wz"}}) {
        tetgenbehavior b;
        for (const std::size_t each : row.set) b.switches[each] = 1;
        Lent one(points), other(points);
        tetrahedralize(&b, &one.in, &one.out, nullptr, nullptr);
        std::string text(row.switches);
        tetrahedralize(text.data(), &other.in, &other.out);
        CHECK(one.out.numberoftetrahedra + one.out.numberoftrifaces > 0);
        CHECK(lists(one.out) == lists(other.out));
    }
}

int thrown_by(tetgenbehavior *b, tetgenio *in, tetgenio *out) {
    try {
        tetrahedralize(b, in, out, nullptr, nullptr);
    } catch (int code) {
        return code;
    }
    return 0;
}

void what_is_not_served_is_refused(Points &points) {
    Lent lent(points);
    const auto is_refused = [&](tetgenbehavior *b) {
        return thrown_by(b, &lent.in, &lent.out) == 10 && lent.out.numberoftetrahedra == 0;
    };
    CHECK(is_refused(nullptr));
    for (std::size_t i = 0; i < 39; i++) {
        const bool is_one_of_few = i == weighted || i == 7 || i == 20 || i == 21;
        const bool is_served = is_one_of_few || (i >= z && i <= 26) || (i >= markers && i <= 34) || i >= quiet;
        if (is_served) continue;
        tetgenbehavior b;
        b.switches[i] = 1;
        CHECK(is_refused(&b));
    }
    tetgenbehavior twice, second_order, of_heights;
    twice.switches[n] = 2;
    second_order.parameters[order] = 2;
    of_heights.switches[weighted] = of_heights.parameters[heights] = 1;
    CHECK(is_refused(&twice) && is_refused(&second_order) && is_refused(&of_heights));
    // One of another version, as the structure of the output says.
    alignas(tetgenio) unsigned char later[448] = {};
    const int corners = 4;
    std::memcpy(later + 132, &corners, sizeof corners);
    tetgenbehavior b;
    CHECK(thrown_by(&b, &lent.in, reinterpret_cast<tetgenio *>(later)) == 10);
    CHECK(thrown_by(&b, &lent.in, &lent.out) == 0 && lent.out.numberoftetrahedra > 0);
}

void lists_are_freed_by_trifree() {
    Points points = random_points(2, 20, 5);
    triangulateio in{}, out{};
    in.pointlist = points.data();
    in.numberofpoints = 20;
    char switches[] = "Qzn";
    CHECK(triangulate(switches, &in, &out, nullptr) == 0);
    trifree(out.pointlist);
    trifree(out.pointmarkerlist);
    trifree(out.trianglelist);
    trifree_of_cxx(out.neighborlist);
    trifree(nullptr);
}

} // namespace

int main() {
    static_assert(sizeof(tetgenbehavior) == 5456 && offsetof(tetgenbehavior, parameters) == 156);
    Points points = random_points(3, n_points, 4);
    is_what_the_switches_give(points);
    what_is_not_served_is_refused(points);
    lists_are_freed_by_trifree();
}
