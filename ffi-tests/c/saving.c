// A triangulation that is saved and loaded, or cloned; files; and what is refused.
// For mkdtemp.
#define _XOPEN_SOURCE 700
#include "state.h"

#include <dirent.h>
#include <stdio.h>
#include <unistd.h>

static char folder[200];

static const char *in_folder(const char *name) {
    static char path[300];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static size_t files_in_folder(void) {
    DIR *there = opendir(folder);
    CHECK(there != NULL);
    size_t n = 0;
    for (struct dirent *file = readdir(there); file != NULL; file = readdir(there)) n++;
    closedir(there);
    // The folder itself, and the one above it.
    return n - 2;
}

static void check_same(const deldrift_triangulation *t, const deldrift_triangulation *other) {
    numbers own = numbers_of(t), others = numbers_of(other);
    CHECK(difference(&own, &others) == NULL);
    arrays rows = arrays_of(t), other_rows = arrays_of(other);
    CHECK(memcmp(&rows, &other_rows, sizeof rows) == 0);
    deldrift_commit_report sums, other_sums;
    OK(deldrift_statistics(t, &sums));
    OK(deldrift_statistics(other, &other_sums));
    CHECK(memcmp(&sums, &other_sums, sizeof sums) == 0);
    OK(deldrift_validate(other, 3));
}

// Some have moved, one is hidden, one removed, and moves, an insertion and a removal are staged.
static deldrift_triangulation *make(uint32_t dimension, const deldrift_options *options) {
    enum { COUNT = 200 };
    double *positions = random_positions(dimension, COUNT, 4);
    deldrift_triangulation *t = create(dimension, positions, COUNT, options);
    for (size_t i = 0; i < COUNT * dimension; i++) positions[i] += 0.01 * (double)(i % 7);
    memcpy(positions + 9 * dimension, positions, dimension * sizeof *positions);
    OK(deldrift_commit_positions(t, positions, COUNT, NULL));
    OK(deldrift_remove_vertex(t, 5));
    uint32_t first, leaving = 7;
    OK(deldrift_stage_insertions(t, positions + 5 * dimension, 1, &first));
    OK(deldrift_stage_removals(t, &leaving, 1));
    OK(deldrift_move_vertex(t, 3, positions + 4 * dimension));
    free(positions);
    return t;
}

// All bytes, behind `skipped` others.
static unsigned char *saved(const deldrift_triangulation *t, size_t skipped, size_t *size) {
    OK(deldrift_save(t, NULL, 0, size));
    unsigned char *bytes = malloc(*size + skipped);
    CHECK(bytes != NULL);
    size_t count = 0;
    OK(deldrift_save(t, bytes + skipped, *size, &count));
    CHECK(count == *size);
    return bytes;
}

static void what_is_loaded_is_what_was_saved(uint32_t dimension) {
    deldrift_triangulation *t = make(dimension, NULL), *loaded = NULL, *from_file = NULL;
    size_t size = 0;
    for (size_t skipped = 0; skipped < 8; skipped++) {
        unsigned char *bytes = saved(t, skipped, &size);
        OK(deldrift_load(bytes + skipped, size, NULL, &loaded));
        free(bytes);
        check_same(t, loaded);
        if (skipped < 7) deldrift_destroy(loaded);
    }
    OK(deldrift_save_file(t, in_folder("saved")));
    // It takes the place of the one before.
    OK(deldrift_save_file(loaded, in_folder("saved")));
    CHECK(files_in_folder() == 1);
    OK(deldrift_load_file(in_folder("saved"), NULL, &from_file));
    check_same(t, from_file);
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_commit_timestamp(loaded, NULL));
    CHECK(arrays_of(t).cells == arrays_of(loaded).cells);
    deldrift_changes changes;
    OK(deldrift_take_changes(from_file, &changes));
    CHECK(changes.created_count == cell_count(from_file) && changes.hidden_count == 1);
    CHECK(unlink(in_folder("saved")) == 0);
    deldrift_destroy(t);
    deldrift_destroy(loaded);
    deldrift_destroy(from_file);
}

// How often it has been called, and for whom; a triangulation that is being changed cannot be cloned or saved.
typedef struct {
    int n_calls;
    deldrift_triangulation *changing;
} caller;

static bool count_calls(void *user_data) {
    caller *c = user_data;
    c->n_calls++;
    if (c->changing != NULL) {
        deldrift_triangulation *out = NULL;
        size_t count;
        CHECK_STATUS(deldrift_clone(c->changing, &out), DELDRIFT_BUSY);
        CHECK_STATUS(deldrift_save(c->changing, NULL, 0, &count), DELDRIFT_BUSY);
        CHECK_STATUS(deldrift_save_file(c->changing, in_folder("busy")), DELDRIFT_BUSY);
        CHECK(out == NULL);
    }
    return false;
}

static void a_clone_is_independent(uint32_t dimension) {
    caller counter = {0, NULL};
    deldrift_options options;
    deldrift_options_init(&options);
    options.algorithm = DELDRIFT_REBUILDING;
    options.cancel = count_calls;
    options.user_data = &counter;
    deldrift_triangulation *t = make(dimension, &options), *clone = NULL;
    deldrift_changes changes;
    OK(deldrift_take_changes(t, &changes));
    OK(deldrift_relocate_vertex(t, 11, (double[]){0.5, 0.5, 0.5}));
    OK(deldrift_clone(t, &clone));
    check_same(t, clone);
    deldrift_algorithm algorithm;
    OK(deldrift_get_algorithm(clone, &algorithm));
    CHECK(algorithm == DELDRIFT_REBUILDING);
    int before = counter.n_calls;
    counter.changing = clone;
    OK(deldrift_commit_timestamp(clone, NULL));
    counter.changing = NULL;
    CHECK(counter.n_calls > before);
    uint64_t timestamp = 0;
    OK(deldrift_timestamp(t, &timestamp));
    CHECK(timestamp == 1);
    // The same call, the same changes.
    OK(deldrift_commit_timestamp(t, NULL));
    check_same(t, clone);
    deldrift_changes others;
    OK(deldrift_take_changes(t, &changes));
    OK(deldrift_take_changes(clone, &others));
    CHECK(changes.created_count == others.created_count && changes.removed_count == others.removed_count);
    CHECK(changes.removed_count > 0);
    CHECK(memcmp(changes.created, others.created, changes.created_count * sizeof *changes.created) == 0);
    CHECK(changes.created_count > 0);
    deldrift_destroy(t);
    OK(deldrift_validate(clone, 3));
    deldrift_destroy(clone);
}

static void what_is_wrong_is_refused(void) {
    deldrift_triangulation *t = make(2, NULL), *const none = (deldrift_triangulation *)&folder, *out = none;
    deldrift_options options;
    deldrift_options_init(&options);
    size_t size, count = 77;
    unsigned char *bytes = saved(t, 0, &size), byte = 7;
    CHECK_STATUS(deldrift_clone(NULL, &out), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("t is NULL");
    CHECK_STATUS(deldrift_clone(t, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_clone(t, (deldrift_triangulation **)(folder + 1)), DELDRIFT_MISALIGNED_ARGUMENT);
    CHECK_STATUS(deldrift_save(t, NULL, 0, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_save(t, NULL, size, &count), DELDRIFT_NULL_ARGUMENT);
    CHECK(count == 77);
    CHECK_STATUS(deldrift_save(t, &byte, 1, &count), DELDRIFT_BUFFER_TOO_SMALL);
    CHECK(count == size && byte == 7);
    CHECK_STATUS(deldrift_load(NULL, size, NULL, &out), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_load(bytes, SIZE_MAX, NULL, &out), DELDRIFT_SIZE_OVERFLOW);
    CHECK_STATUS(deldrift_load(bytes, size, NULL, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_load(NULL, 0, NULL, &out), DELDRIFT_INVALID_DATA);
    CHECK_MESSAGE("data: there are 0 bytes");
    for (size_t shorter = 0; shorter < size; shorter += shorter < 200 ? 1 : 37) {
        CHECK_STATUS(deldrift_load(bytes, shorter, NULL, &out), DELDRIFT_INVALID_DATA);
    }
    CHECK_MESSAGE("the header says");
    bytes[size / 2] ^= 1;
    CHECK_STATUS(deldrift_load(bytes, size, NULL, &out), DELDRIFT_INVALID_DATA);
    CHECK_MESSAGE("checksum");
    bytes[size / 2] ^= 1;
    options.algorithm = 999;
    CHECK_STATUS(deldrift_load(bytes, size, &options, &out), DELDRIFT_INVALID_OPTIONS);
    options.algorithm = DELDRIFT_AUTO;
    options.coincidence = DELDRIFT_COINCIDENCE_REJECT;
    CHECK_STATUS(deldrift_load(bytes, size, &options, &out), DELDRIFT_COINCIDENT);
    CHECK_MESSAGE("vertices 0 and 9");

    CHECK_STATUS(deldrift_save_file(t, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_load_file(NULL, NULL, &out), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_save_file(t, in_folder("none/saved")), DELDRIFT_IO_ERROR);
    CHECK_MESSAGE("none/saved");
    CHECK_STATUS(deldrift_save_file(t, folder), DELDRIFT_IO_ERROR);
    CHECK_MESSAGE("directory");
    CHECK_STATUS(deldrift_load_file(in_folder("none"), NULL, &out), DELDRIFT_IO_ERROR);
    CHECK_MESSAGE("No such file");
    CHECK_STATUS(deldrift_load_file(folder, NULL, &out), DELDRIFT_IO_ERROR);
    CHECK_STATUS(deldrift_save_file(t, "/dev/full"), DELDRIFT_IO_ERROR);
    CHECK_MESSAGE("No space left");
    OK(deldrift_save_file(t, "/dev/null"));
    CHECK(out == none && files_in_folder() == 0);
    free(bytes);
    deldrift_destroy(t);
}

// The numbers of a file: all in it that is no word.
static size_t numbers_in(const char *path, double *numbers, size_t room) {
    FILE *file = fopen(path, "r");
    CHECK(file != NULL);
    size_t n = 0;
    char word[100];
    while (fscanf(file, "%99s", word) == 1) {
        char *end;
        double number = strtod(word, &end);
        if (*end != 0) continue;
        CHECK(n < room);
        numbers[n++] = number;
    }
    fclose(file);
    return n;
}

// The numbers of a mesh in the plane end with the ends and markers of its segments.
static void segments_are_edges_of_meshes(void) {
    const double corners[] = {0, 0, 1, 0, 1, 1, 0, 1, 1, 1};
    const uint32_t ends[] = {0, 4, 3, 1};
    const int32_t markers[] = {-7, 5};
    deldrift_triangulation *t;
    uint32_t first;
    double read[100];
    OK(deldrift_create(2, corners, 5, NULL, &t));
    OK(deldrift_stage_segments(t, ends, markers, 1, &first));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_write_medit(t, in_folder("cells.mesh"), NULL, 0));
    const size_t n = numbers_in(in_folder("cells.mesh"), read, 100);
    CHECK(n == 4 + 5 * 3 + 2 * 4 + 1 + 3);
    // Vertex 4 is hidden at the place of vertex 2, the third one.
    const double *edge = read + n - 4;
    CHECK(edge[0] == 1 && edge[1] == 1 && edge[2] == 3 && edge[3] == -7);
    const double zeros[2] = {0};
    const deldrift_field marker = {"marker", zeros, 1}, other = {"Marker", zeros, 1};
    CHECK_STATUS(deldrift_write_vtu(t, in_folder("cells.vtu"), NULL, 0, &marker, 1), DELDRIFT_INVALID_FIELD);
    CHECK_MESSAGE("another than \"marker\"");
    OK(deldrift_write_vtu(t, in_folder("cells.vtu"), NULL, 0, &other, 1));
    OK(deldrift_stage_segment_removals(t, &first, 1));
    OK(deldrift_commit_timestamp(t, NULL));
    OK(deldrift_write_vtu(t, in_folder("cells.vtu"), NULL, 0, &marker, 1));
    OK(deldrift_write_medit(t, in_folder("cells.mesh"), NULL, 0));
    CHECK(numbers_in(in_folder("cells.mesh"), read, 100) == 4 + 5 * 3 + 2 * 4);
    CHECK(unlink(in_folder("cells.mesh")) == 0 && unlink(in_folder("cells.vtu")) == 0 && files_in_folder() == 0);
    deldrift_destroy(t);
}

static void meshes_are_written(uint32_t dimension) {
    deldrift_triangulation *t = make(dimension, NULL);
    deldrift_cells_view cells = cells_of(t);
    size_t ids, n, d = dimension, room = 20000;
    OK(deldrift_id_count(t, &ids));
    OK(deldrift_vertex_count(t, &n));
    double *read = malloc(room * sizeof *read), position[3];
    OK(deldrift_write_medit(t, in_folder("cells.mesh"), NULL, 0));
    CHECK(numbers_in(in_folder("cells.mesh"), read, room) == 4 + n * (d + 1) + cells.count * (d + 2));
    CHECK(read[0] == 2 && read[1] == (double)d && read[2] == (double)n);
    for (size_t v = 0; v < n; v++) {
        const double *row = read + 3 + v * (d + 1);
        OK(deldrift_position(t, (uint32_t)row[d], position));
        CHECK(memcmp(row, position, d * sizeof *row) == 0);
    }
    const double *count = read + 3 + n * (d + 1);
    CHECK(*count == (double)cells.count);
    for (size_t k = 0; k < cells.count * (d + 2); k++) {
        size_t cell = k / (d + 2), corner = k % (d + 2), number = (size_t)count[1 + k];
        if (corner <= d) CHECK(read[3 + (number - 1) * (d + 1) + d] == cells.vertices[cell * (d + 1) + corner]);
    }
    CHECK_STATUS(deldrift_write_medit(t, in_folder("none/cells.mesh"), NULL, 0), DELDRIFT_IO_ERROR);
    CHECK_STATUS(deldrift_write_medit(t, NULL, NULL, 0), DELDRIFT_NULL_ARGUMENT);
    int32_t *references = malloc(cells.count * sizeof *references);
    for (size_t c = 0; c < cells.count; c++) references[c] = 40 - 3 * (int32_t)c;
    OK(deldrift_write_medit(t, in_folder("cells.mesh"), references, cells.count));
    CHECK(numbers_in(in_folder("cells.mesh"), read, room) == 4 + n * (d + 1) + cells.count * (d + 2));
    for (size_t c = 0; c < cells.count; c++) CHECK(count[(c + 1) * (d + 2)] == 40 - 3 * (double)c);
    CHECK_STATUS(deldrift_write_medit(t, in_folder("cells.mesh"), references, cells.count - 1), DELDRIFT_WRONG_COUNT);
    CHECK_MESSAGE("reference_count");
    CHECK_STATUS(deldrift_write_medit(t, in_folder("cells.mesh"), NULL, cells.count), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("references");
    free(references);

    double *values = random_positions(1, 3 * ids + cells.count, 9);
    deldrift_field velocity = {"velocity", values, 3}, density = {"density", values + 3 * ids, 1}, bad = velocity;
    OK(deldrift_write_vtu(t, in_folder("cells.vtu"), &velocity, 1, &density, 1));
    OK(deldrift_write_vtu(t, in_folder("cells.vtu"), NULL, 0, NULL, 0));
    CHECK_STATUS(deldrift_write_vtu(t, in_folder("cells.vtu"), NULL, 1, NULL, 0), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("vertex_fields");
    bad.name = NULL;
    CHECK_STATUS(deldrift_write_vtu(t, in_folder("cells.vtu"), &bad, 1, NULL, 0), DELDRIFT_INVALID_FIELD);
    CHECK_MESSAGE("name of vertex_fields[0]");
    bad = velocity;
    bad.components = 0;
    CHECK_STATUS(deldrift_write_vtu(t, in_folder("cells.vtu"), NULL, 0, &bad, 1), DELDRIFT_INVALID_FIELD);
    CHECK_MESSAGE("components of cell_fields[0]");
    bad = velocity;
    bad.components = SIZE_MAX / 2;
    CHECK_STATUS(deldrift_write_vtu(t, in_folder("cells.vtu"), &bad, 1, NULL, 0), DELDRIFT_SIZE_OVERFLOW);
    bad.values = NULL;
    CHECK_STATUS(deldrift_write_vtu(t, in_folder("cells.vtu"), &bad, 1, NULL, 0), DELDRIFT_NULL_ARGUMENT);
    CHECK_STATUS(deldrift_write_vtu(t, in_folder("none/cells.vtu"), NULL, 0, NULL, 0), DELDRIFT_IO_ERROR);
    CHECK(unlink(in_folder("cells.mesh")) == 0 && unlink(in_folder("cells.vtu")) == 0 && files_in_folder() == 0);
    free(values);
    free(read);
    deldrift_destroy(t);
}

int main(void) {
    const char *temporary = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/deldrift-XXXXXX", temporary == NULL ? "/tmp" : temporary);
    CHECK(mkdtemp(folder) != NULL);
    for (uint32_t dimension = 2; dimension <= 3; dimension++) {
        what_is_loaded_is_what_was_saved(dimension);
        a_clone_is_independent(dimension);
        meshes_are_written(dimension);
    }
    segments_are_edges_of_meshes();
    what_is_wrong_is_refused();
    CHECK(rmdir(folder) == 0);
    return 0;
}
