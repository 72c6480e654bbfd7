// Dye in a square that is stirred: a mean for each triangle of a mesh that is coarsened and refined at every step. No
// dye is lost, and nowhere is more of it than there was.
//
//   cc examples/stirred.c -Iinclude target/release/libdeldrift.a -lm -lpthread -ldl -o stirred && ./stirred picture.svg
#include <deldrift.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 20000, STEPS = 200, SHADES = 16 };

static double positions[2 * MOST], volumes[MOST], dye[MOST];

static void check(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    fprintf(stderr, "%s: %s\n", deldrift_status_string(status), deldrift_last_error());
    exit(1);
}

// The dye in all triangles, and the least and greatest concentration.
static double content(const deldrift_triangulation *t, double *least, double *greatest) {
    size_t count;
    check(deldrift_volumes(t, volumes, MOST, &count));
    double sum = 0;
    *least = INFINITY, *greatest = -INFINITY;
    for (size_t c = 0; c < count; c++) {
        sum += dye[c] * volumes[c];
        *least = fmin(*least, dye[c]), *greatest = fmax(*greatest, dye[c]);
    }
    return sum;
}

// A mean rides with its triangle. What a triangle of another area has then is what its mean says: the flow keeps areas
// but for what a step of some length does to triangles of some size.
static void stir(size_t n) {
    for (size_t v = 0; v < n; v++) {
        const double pi = 3.14159265358979323846, x = positions[2 * v], y = positions[2 * v + 1];
        positions[2 * v] += 0.004 * sin(pi * x) * cos(pi * y);
        positions[2 * v + 1] -= 0.004 * cos(pi * x) * sin(pi * y);
    }
}

// The triangles, the redder the more dye they have, at a place in a row of pictures.
static void draw(FILE *file, const deldrift_triangulation *t, int place) {
    deldrift_cells_view cells;
    check(deldrift_cells(t, &cells));
    fprintf(file, "<g transform='translate(%.1f 1) scale(1 -1)'>\n", 1.1 * place);
    for (int shade = 0; shade < SHADES; shade++) {
        fprintf(file, "<path fill='hsl(%d,60%%,50%%)' d='", 220 + 140 * shade / (SHADES - 1));
        for (size_t c = 0; c < cells.count; c++) {
            if ((int)(dye[c] * (SHADES - 1) + 0.5) != shade) continue;
            for (size_t i = 0; i < 3; i++) {
                const double *p = positions + 2 * cells.vertices[3 * c + i];
                fprintf(file, "%c%.3f %.3f", i == 0 ? 'M' : 'L', p[0], p[1]);
            }
        }
        fprintf(file, "'/>\n");
    }
    fprintf(file, "</g>\n");
}

int main(int argc, char **argv) {
    FILE *picture = argc > 1 ? fopen(argv[1], "w") : NULL;
    if (argc > 1 && picture == NULL) {
        perror(argv[1]);
        return 1;
    }
    if (picture != NULL) {
        fprintf(picture, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 3.2 1'>"
                         "<style>path{stroke:#fff;stroke-width:.001}</style>\n");
    }
    static const double corners[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const uint32_t sides[8] = {0, 1, 1, 2, 2, 3, 3, 0};
    deldrift_triangulation *t;
    deldrift_quality quality;
    deldrift_changes changes;
    check(deldrift_create(2, corners, 4, NULL, &t));
    uint32_t first;
    check(deldrift_stage_segments(t, sides, NULL, 4, &first));
    check(deldrift_commit_timestamp(t, NULL));
    check(deldrift_quality_init(&quality));
    quality.least_angle = 25, quality.greatest_area = 0.002;
    check(deldrift_refine(t, &quality, NULL, 0, NULL));
    check(deldrift_take_changes(t, &changes));

    // The left half is red.
    size_t n, n_cells;
    deldrift_cells_view cells;
    check(deldrift_copy_positions(t, positions, MOST, &n));
    check(deldrift_cells(t, &cells));
    for (size_t c = 0; c < cells.count; c++) {
        const uint32_t *v = cells.vertices + 3 * c;
        dye[c] = positions[2 * v[0]] + positions[2 * v[1]] + positions[2 * v[2]] < 1.5;
    }
    double least, greatest, lost = 0, gained = 0;
    for (int step = 0; step <= STEPS; step++) {
        if (step % 40 == 0) {
            const double sum = content(t, &least, &greatest);
            check(deldrift_cell_count(t, &n_cells));
            printf("step %3d: %zu triangles, dye %.6f from %.3f to %.3f; lost %.0e, gained %.0e\n", step, n_cells, sum,
                   least, greatest, lost, gained);
        }
        if (picture != NULL && step % (STEPS / 2) == 0) draw(picture, t, step / (STEPS / 2));
        check(deldrift_cell_count(t, &n_cells));
        stir(n);
        check(deldrift_commit_positions(t, positions, n, NULL));
        check(deldrift_coarsen(t, &quality, NULL, 0, NULL));
        check(deldrift_refine(t, &quality, NULL, 0, NULL));
        check(deldrift_take_changes(t, &changes));
        // Positions are still those of before: of all vertices that triangles had.
        double out, in;
        const deldrift_transfer_order order = DELDRIFT_TRANSFER_SECOND_ORDER;
        check(deldrift_transfer_cells(t, positions, n, order, dye, n_cells, 1, MOST, NULL, &out, &in));
        lost += fabs(out), gained += fabs(in);
        check(deldrift_copy_positions(t, positions, MOST, &n));
    }
    deldrift_destroy(t);
    if (picture != NULL) {
        fprintf(picture, "</svg>\n");
        if (fclose(picture) != 0) {
            perror(argv[1]);
            return 1;
        }
    }
    return 0;
}
