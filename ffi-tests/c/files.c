// Files that are no files, files that cannot be written, and what becomes of those that are replaced.
// For mkdtemp.
#define _XOPEN_SOURCE 700
#include "check.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static char folder[200];

static const char *in_folder(const char *name) {
    static char paths[4][300];
    static int next = 0;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

// Nothing is left in the folder.
static void check_empty(void) {
    DIR *there = opendir(folder);
    CHECK(there != NULL);
    for (struct dirent *file = readdir(there); file != NULL; file = readdir(there)) {
        CHECK(strcmp(file->d_name, ".") == 0 || strcmp(file->d_name, "..") == 0);
    }
    closedir(there);
}

static unsigned char *saved(const deldrift_triangulation *t, size_t *size) {
    OK(deldrift_save(t, NULL, 0, size));
    unsigned char *bytes = malloc(*size);
    CHECK(bytes != NULL);
    OK(deldrift_save(t, bytes, *size, size));
    return bytes;
}

// All functions that write a file.
enum { WAYS = 3 };
static deldrift_status written(const deldrift_triangulation *t, const char *path, int way) {
    if (way == 0) return deldrift_save_file(t, path);
    if (way == 1) return deldrift_write_medit(t, path, NULL, 0);
    return deldrift_write_vtu(t, path, NULL, 0, NULL, 0);
}

static void put(const char *path, const void *bytes, size_t size, off_t length) {
    int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    CHECK(file >= 0 && write(file, bytes, size) == (ssize_t)size);
    CHECK(ftruncate(file, length) == 0 && close(file) == 0);
}

static void what_is_no_file_is_refused(const deldrift_triangulation *t) {
    deldrift_triangulation *out = NULL;
    CHECK(mkfifo(in_folder("pipe"), 0600) == 0);
    CHECK_STATUS(deldrift_load_file(in_folder("pipe"), NULL, &out), DELDRIFT_IO_ERROR);
    CHECK_MESSAGE("it is a pipe, and only regular files are read");
    // There is little room for the path of a socket.
    struct sockaddr_un address = {.sun_family = AF_UNIX, .sun_path = "socket"};
    int listening = socket(AF_UNIX, SOCK_STREAM, 0);
    CHECK(listening >= 0 && chdir(folder) == 0 && bind(listening, (struct sockaddr *)&address, sizeof address) == 0);
    CHECK_STATUS(deldrift_load_file(in_folder("socket"), NULL, &out), DELDRIFT_IO_ERROR);
    CHECK_MESSAGE("it is a socket");
    const char *devices[] = {"/dev/zero", "/dev/null"};
    for (int k = 0; k < 2; k++) {
        CHECK_STATUS(deldrift_load_file(devices[k], NULL, &out), DELDRIFT_IO_ERROR);
        CHECK_MESSAGE("it is a device");
    }
    CHECK_STATUS(deldrift_load_file(folder, NULL, &out), DELDRIFT_IO_ERROR);
    CHECK_MESSAGE("it is a directory");
    // Nobody reads these.
    for (int way = 0; way < WAYS; way++) {
        CHECK_STATUS(written(t, in_folder("pipe"), way), DELDRIFT_IO_ERROR);
        CHECK_STATUS(written(t, in_folder("socket"), way), DELDRIFT_IO_ERROR);
    }
    CHECK(close(listening) == 0 && unlink(in_folder("pipe")) == 0 && unlink(in_folder("socket")) == 0);
    CHECK(out == NULL);
    check_empty();
}

// More than any memory has, by their length or by their header: nothing of it is read.
static void long_files_are_refused_by_their_header(const deldrift_triangulation *t) {
    deldrift_triangulation *out = NULL;
    size_t size;
    unsigned char *bytes = saved(t, &size);
    off_t length = (off_t)1 << 42;
    put(in_folder("long"), bytes, 0, length);
    CHECK_STATUS(deldrift_load_file(in_folder("long"), NULL, &out), DELDRIFT_INVALID_DATA);
    CHECK_MESSAGE("first 8 bytes");
    put(in_folder("long"), bytes, size, length);
    CHECK_STATUS(deldrift_load_file(in_folder("long"), NULL, &out), DELDRIFT_INVALID_DATA);
    CHECK_MESSAGE("the header says");
    for (int k = 0; k < 8; k++) bytes[16 + k] = (unsigned char)((uint64_t)length >> 8 * k);
    put(in_folder("long"), bytes, size, length);
    CHECK_STATUS(deldrift_load_file(in_folder("long"), NULL, &out), DELDRIFT_INVALID_DATA);
    CHECK_MESSAGE("counts");
    put(in_folder("long"), bytes, 100, 100);
    CHECK_STATUS(deldrift_load_file(in_folder("long"), NULL, &out), DELDRIFT_INVALID_DATA);
    CHECK_MESSAGE("there are 100 bytes, and the header alone has 168");
    CHECK(out == NULL && unlink(in_folder("long")) == 0);
    free(bytes);
}

static mode_t mode_of(const char *path) {
    struct stat status;
    CHECK(stat(path, &status) == 0);
    return status.st_mode & 07777;
}

static void replaced_files_keep_their_mode(const deldrift_triangulation *t) {
    mode_t modes[] = {0600, 0640, 0444, 0666, 0}, mask = umask(027);
    for (int way = 0; way < WAYS; way++) {
        OK(written(t, in_folder("new"), way));
        CHECK(mode_of(in_folder("new")) == 0640);
        for (int k = 0; k < 5; k++) {
            CHECK(chmod(in_folder("new"), modes[k]) == 0);
            OK(written(t, in_folder("new"), way));
            CHECK(mode_of(in_folder("new")) == modes[k]);
        }
        // A link is replaced itself, and another name keeps what it has.
        CHECK(chmod(in_folder("new"), 0600) == 0);
        CHECK(symlink("new", in_folder("link")) == 0 && link(in_folder("new"), in_folder("other")) == 0);
        OK(written(t, in_folder("link"), way));
        struct stat link, other;
        CHECK(lstat(in_folder("link"), &link) == 0 && S_ISREG(link.st_mode) && (link.st_mode & 07777) == 0600);
        OK(written(t, in_folder("new"), way));
        CHECK(stat(in_folder("new"), &link) == 0 && stat(in_folder("other"), &other) == 0);
        CHECK(link.st_ino != other.st_ino);
        CHECK(unlink(in_folder("new")) == 0 && unlink(in_folder("link")) == 0 && unlink(in_folder("other")) == 0);
    }
    umask(mask);
    check_empty();
}

static int is_pending(int signal) {
    sigset_t pending;
    CHECK(sigpending(&pending) == 0);
    return sigismember(&pending, signal);
}

// A child reads one byte and goes.
static deldrift_status written_to_a_pipe_that_is_left(const deldrift_triangulation *t, int way) {
    CHECK(mkfifo(in_folder("pipe"), 0600) == 0);
    int reading = open(in_folder("pipe"), O_RDONLY | O_NONBLOCK);
    CHECK(reading >= 0);
    pid_t child = fork();
    CHECK(child >= 0);
    if (child == 0) {
        char byte;
        struct timespec pause = {0, 1000000};
        while (read(reading, &byte, 1) != 1) nanosleep(&pause, NULL);
        _exit(0);
    }
    close(reading);
    deldrift_status status = written(t, in_folder("pipe"), way);
    CHECK(waitpid(child, NULL, 0) == child && unlink(in_folder("pipe")) == 0);
    return status;
}

static void signals_of_writes_do_not_reach_the_process(const deldrift_triangulation *large) {
    sigset_t none, pipe_alone, mask;
    sigemptyset(&none);
    sigemptyset(&pipe_alone);
    sigaddset(&pipe_alone, SIGPIPE);
    for (int way = 0; way < WAYS; way++) {
        // These would end the process.
        CHECK_STATUS(written_to_a_pipe_that_is_left(large, way), DELDRIFT_IO_ERROR);
        CHECK_MESSAGE("Broken pipe");
        struct rlimit limit, before;
        CHECK(getrlimit(RLIMIT_FSIZE, &before) == 0);
        limit = before;
        limit.rlim_cur = 1000;
        CHECK(setrlimit(RLIMIT_FSIZE, &limit) == 0);
        CHECK_STATUS(written(large, in_folder("large"), way), DELDRIFT_IO_ERROR);
        CHECK(setrlimit(RLIMIT_FSIZE, &before) == 0);
        CHECK_MESSAGE("too large");
        check_empty();
        CHECK(!is_pending(SIGPIPE) && !is_pending(SIGXFSZ));
        CHECK(sigprocmask(SIG_SETMASK, NULL, &mask) == 0);
        CHECK(!sigismember(&mask, SIGPIPE) && !sigismember(&mask, SIGXFSZ));
        // One that the program has raised, and waits with, stays.
        CHECK(sigprocmask(SIG_BLOCK, &pipe_alone, NULL) == 0 && raise(SIGPIPE) == 0);
        CHECK_STATUS(written_to_a_pipe_that_is_left(large, way), DELDRIFT_IO_ERROR);
        CHECK(is_pending(SIGPIPE));
        int taken = 0;
        CHECK(sigwait(&pipe_alone, &taken) == 0 && taken == SIGPIPE && !is_pending(SIGPIPE));
        CHECK(sigprocmask(SIG_UNBLOCK, &pipe_alone, NULL) == 0);
    }
}

static void pipes_get_all_bytes(const deldrift_triangulation *t) {
    int ends[2];
    CHECK(pipe(ends) == 0);
    char path[50];
    snprintf(path, sizeof path, "/dev/fd/%d", ends[1]);
    OK(deldrift_save_file(t, path));
    size_t size;
    unsigned char *bytes = saved(t, &size), *read_bytes = malloc(size + 1);
    CHECK(close(ends[1]) == 0 && read_bytes != NULL);
    size_t n = 0;
    for (ssize_t more = 1; more > 0; n += (size_t)more) {
        more = read(ends[0], read_bytes + n, size + 1 - n);
        CHECK(more >= 0);
    }
    CHECK(n == size && memcmp(bytes, read_bytes, size) == 0 && close(ends[0]) == 0);
    free(bytes);
    free(read_bytes);
}

static void names_are_checked(const deldrift_triangulation *t) {
    size_t ids, cells = cell_count(t);
    OK(deldrift_id_count(t, &ids));
    double *values = random_positions(1, ids + cells, 2);
    const char *bad[] = {"tab\there", "line\n", "bell\a", "\x7f", "\xc2\x80", "no \xef\xbf\xbe", "no \xef\xbf\xbf",
                         "lone \xed\xa0\x80", "not UTF-8 \xff", "cut \xc3"};
    deldrift_field fields[3] = {{"a", values, 1}, {"b", values, 1}, {"c", values, 1}};
    const char *path = in_folder("cells.vtu");
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        fields[1].name = bad[k];
        CHECK_STATUS(deldrift_write_vtu(t, path, fields, 2, NULL, 0), DELDRIFT_INVALID_FIELD);
        CHECK_MESSAGE("name of vertex_fields[1] must be ");
        CHECK_STATUS(deldrift_write_vtu(t, path, NULL, 0, fields, 2), DELDRIFT_INVALID_FIELD);
        CHECK_MESSAGE("name of cell_fields[1] must be ");
    }
    fields[1].name = "b";
    fields[2].name = "a";
    CHECK_STATUS(deldrift_write_vtu(t, path, fields, 3, NULL, 0), DELDRIFT_INVALID_FIELD);
    CHECK_MESSAGE("name of vertex_fields[2] must be another than those of the fields before");
    CHECK_STATUS(deldrift_write_vtu(t, path, NULL, 0, fields, 3), DELDRIFT_INVALID_FIELD);
    fields[2].name = "vertex";
    CHECK_STATUS(deldrift_write_vtu(t, path, fields, 3, NULL, 0), DELDRIFT_INVALID_FIELD);
    CHECK_MESSAGE("name of vertex_fields[2] must be another than \"vertex\"");
    check_empty();
    fields[0].name = "\xf0\x9f\x8c\x8a <&\">'";
    OK(deldrift_write_vtu(t, path, fields, 2, fields, 3));
    CHECK(unlink(path) == 0);
    free(values);
}

static void long_paths_leave_room_for_the_reason(const deldrift_triangulation *t) {
    size_t length = 1 << 20;
    char *path = malloc(length + 1);
    CHECK(path != NULL);
    // Characters of two bytes, which the end may cut.
    for (size_t shift = 0; shift < 2; shift++) {
        memset(path, 'a', length);
        for (size_t k = shift; k + 1 < length - 100; k += 2) memcpy(path + k, "\xc3\xa9", 2);
        strcpy(path + length - 9, "/the.file");
        deldrift_triangulation *out = NULL;
        CHECK_STATUS(deldrift_load_file(path, NULL, &out), DELDRIFT_IO_ERROR);
        CHECK_MESSAGE("/the.file\": File name too long");
        CHECK_MESSAGE("cannot open \"...\xc3\xa9");
        for (int way = 0; way < WAYS; way++) {
            CHECK_STATUS(written(t, path, way), DELDRIFT_IO_ERROR);
            CHECK_MESSAGE("/the.file\": File name too long");
        }
    }
    free(path);
}

int main(void) {
    const char *temporary = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/deldrift-XXXXXX", temporary == NULL ? "/tmp" : temporary);
    CHECK(mkdtemp(folder) != NULL);
    double *positions = random_positions(3, 4000, 4);
    deldrift_triangulation *small = create(2, positions, 100, NULL), *large = create(3, positions, 4000, NULL);
    what_is_no_file_is_refused(small);
    long_files_are_refused_by_their_header(small);
    replaced_files_keep_their_mode(small);
    signals_of_writes_do_not_reach_the_process(large);
    pipes_get_all_bytes(small);
    names_are_checked(small);
    long_paths_leave_room_for_the_reason(small);
    deldrift_destroy(small);
    deldrift_destroy(large);
    free(positions);
    CHECK(rmdir(folder) == 0);
    return 0;
}
