// What examples/domain.c works on, and pictures of it: side by side in a file of SVG, one after the other on a page.
#ifndef DOMAIN_PICTURE_H
#define DOMAIN_PICTURE_H

#include <deldrift.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROOM = 1 << 14, SHADES = 16, FRAMES = 60 };  // room for vertices; frames of the page

static double positions[2 * ROOM], heat[ROOM];
static deldrift_cells_view cells;
static uint32_t levels[2 * ROOM];  // 1 for the cells of the domain

static const char STYLE[] = "<style>path{stroke:#fff;stroke-width:.002}"
                            ".b{fill:none;stroke:#000;stroke-width:.01}</style>";

static void check(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    fprintf(stderr, "%s: %s\n", deldrift_status_string(status), deldrift_last_error());
    exit(1);
}

// A file, or one that goes with the program if none is wanted.
static FILE *opened(const char *path) {
    FILE *file = path == NULL ? tmpfile() : fopen(path, "w");
    if (file == NULL) perror(path), exit(1);
    return file;
}

static FILE *begin_picture(const char *path) {
    FILE *file = opened(path);
    fprintf(file, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-1 -1 9.4 2'>%s\n", STYLE);
    return file;
}

static int end_picture(FILE *file) {
    fprintf(file, "</svg>\n");
    return fclose(file);
}

static FILE *begin_page(const char *path) {
    FILE *file = opened(path);
    fprintf(file, "<!doctype html><html lang='en'><meta charset='utf-8'><title>A rotor in a box</title>"
                  "<svg viewBox='-1 -1 3 2'>%s\n", STYLE);
    return file;
}

// Shows one frame after the other, ten a second.
static int end_page(FILE *file) {
    fprintf(file, "</svg><script>const frames = document.querySelectorAll('.frame'); let shown = 0;\n"
                  "const next = () => { frames.forEach((f, k) => f.style.display = k == shown ? '' : 'none');"
                  " shown = (shown + 1) %% frames.length; };\nnext(); setInterval(next, 100);</script></html>\n");
    return fclose(file);
}

// The cells of the domain, the redder the hotter, and their boundary, so far to the right.
static void draw(FILE *file, const deldrift_triangulation *t, double shift) {
    static uint8_t mask[2 * ROOM];
    static uint32_t vertices[2 * ROOM], chains[2 * ROOM];
    size_t count;
    fprintf(file, "<g class='frame' transform='translate(%g 0) scale(1 -1)'>", shift);
    for (int shade = 0; shade < SHADES; shade++) {
        fprintf(file, "<path fill='hsl(%d,60%%,50%%)' d='", 220 + 170 * shade / (SHADES - 1));
        for (size_t c = 0; c < cells.count; c++) {
            const uint32_t *v = cells.vertices + 3 * c;
            const double mean = (heat[v[0]] + heat[v[1]] + heat[v[2]]) / 3, place = fmin(1, fmax(0, mean / 2));
            mask[c] = levels[c] == 1;
            for (int i = 0; i < 3 && mask[c] && (int)(place * (SHADES - 1) + 0.5) == shade; i++)
                fprintf(file, "%c%.2f %.2f", i == 0 ? 'M' : 'L', positions[2 * v[i]], positions[2 * v[i] + 1]);
        }
        fprintf(file, "'/>");
    }
    check(deldrift_boundary_chains(t, mask, cells.count, vertices, chains, NULL, NULL, NULL, 2 * ROOM, &count));
    for (size_t k = 0; k < count; k++)
        fprintf(file, "%s%.3f %.3f", k == 0 ? "<path class='b' d='M" : chains[k] == chains[k - 1] ? "L" : "zM",
                positions[2 * vertices[k]], positions[2 * vertices[k] + 1]);
    fprintf(file, "z'/></g>\n");
}

// Draws some of the steps, and prints ten.
static void report(int step, int n_steps, const deldrift_triangulation *t, FILE *picture, FILE *page) {
    size_t n;
    check(deldrift_vertex_count(t, &n));
    if (step == n_steps || step % ((n_steps + 1) / 2) == 0) draw(picture, t, 6.4 * step / n_steps);
    if (step == 0 || step * FRAMES / n_steps != (step - 1) * FRAMES / n_steps) draw(page, t, 0);
    if (step == 0 || step * 10 / n_steps != (step - 1) * 10 / n_steps) printf("step %5d: %zu vertices\n", step, n);
}

#endif  // DOMAIN_PICTURE_H
