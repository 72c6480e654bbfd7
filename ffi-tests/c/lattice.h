// Places with small whole coordinates, and what can be said of them exactly.
#ifndef LATTICE_H
#define LATTICE_H

#include "check.h"

enum { MOST = 64 };

typedef int64_t points[MOST][2];

// Twice the area of a triangle, positive if it is counter-clockwise.
static inline int64_t turn(const int64_t *a, const int64_t *b, const int64_t *c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static inline int sign_of(int64_t x) { return (x > 0) - (x < 0); }

// Whether p is on the line from a to b, and between them.
static inline bool is_between(const int64_t *a, const int64_t *b, const int64_t *p) {
    const int64_t dot = (a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]);
    return turn(a, b, p) == 0 && dot < 0;
}

// Whether the insides of two segments have one place in common, which is an end of neither.
static inline bool cross(const int64_t *a, const int64_t *b, const int64_t *c, const int64_t *d) {
    return sign_of(turn(a, b, c)) * sign_of(turn(a, b, d)) < 0 && sign_of(turn(c, d, a)) * sign_of(turn(c, d, b)) < 0;
}

// Whether the fourth vertex is inside of the circle of the first three, which are counter-clockwise. If it is on the circle,
// the vertex of the highest id is lifted by more than all others together: that decides, or the next one does.
static inline bool is_inside(const points at, const uint32_t ids[4]) {
    const int64_t *d = at[ids[3]];
    int64_t rows[3][3], determinant = 0;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++) rows[i][k] = at[ids[i]][k] - d[k];
        rows[i][2] = rows[i][0] * rows[i][0] + rows[i][1] * rows[i][1];
    }
    for (int i = 0; i < 3; i++) {
        const int64_t *r = rows[(i + 1) % 3], *s = rows[(i + 2) % 3];
        determinant += rows[i][2] * (r[0] * s[1] - r[1] * s[0]);
    }
    if (determinant != 0) return determinant > 0;
    bool is_seen[4] = {false, false, false, false};
    for (int round = 0; round < 4; round++) {
        int highest = -1;
        for (int i = 0; i < 4; i++)
            if (!is_seen[i] && (highest < 0 || ids[i] > ids[highest])) highest = i;
        is_seen[highest] = true;
        // Lifted, the fourth is above the plane of the others; and one of these has the plane above or below the fourth.
        if (highest == 3) return false;
        const int64_t side = turn(d, at[ids[(highest + 1) % 3]], at[ids[(highest + 2) % 3]]);
        if (side != 0) return side > 0;
    }
    CHECK(!"four vertices of which one decides");
    return false;
}

#endif
