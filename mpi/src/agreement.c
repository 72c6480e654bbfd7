// How processes agree: one reduction tells all of them whether one has refused, and the greatest of some numbers.
#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "internal.h"

static __thread char last_message[DM_MESSAGE];
static __thread int last_process = -1;

static const double LARGEST = 1e57;          // of coordinates, as deldrift.h has it
static const double GREATEST_WEIGHT = 1e114; // likewise

void dm_refuse(dm_refusal *refusal, deldrift_status status, const char *format, ...) {
    if (refusal->status != DELDRIFT_OK) return;
    refusal->status = status;
    // Numbers with a point, whatever the locale of the program.
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0), before = uselocale(plain);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(refusal->message, sizeof refusal->message, format, arguments);
    va_end(arguments);
    uselocale(before);
    if (plain) freelocale(plain);
}

bool dm_took(dm_refusal *refusal, deldrift_status status) {
    if (status != DELDRIFT_OK) dm_refuse(refusal, status, "%s", deldrift_last_error());
    return status == DELDRIFT_OK;
}

dm_vote dm_decide(MPI_Comm comm, const dm_refusal *refusal, const int64_t numbers[4]) {
    int rank, size;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    // The greatest of these is that of the lowest process.
    int64_t ballot[5] = {0}, result[5];
    if (refusal->status != DELDRIFT_OK) ballot[0] = (int64_t)(size - rank) << 32 | (int64_t)refusal->status;
    if (numbers) memcpy(ballot + 1, numbers, 4 * sizeof *numbers);
    MPI_Allreduce(ballot, result, 5, MPI_INT64_T, MPI_MAX, comm);
    dm_vote vote;
    vote.status = (deldrift_status)(result[0] & UINT32_MAX);
    memcpy(vote.most, result + 1, sizeof vote.most);
    if (vote.status != DELDRIFT_OK) {
        last_process = size - (int)(result[0] >> 32);
        char text[DM_MESSAGE] = "";
        if (rank == last_process) memcpy(text, refusal->message, sizeof text);
        MPI_Bcast(text, sizeof text, MPI_CHAR, last_process, comm);
        int length = snprintf(last_message, sizeof last_message, "process %d: ", last_process);
        snprintf(last_message + length, sizeof last_message - (size_t)length, "%.*s", DM_MESSAGE - 32, text);
    }
    return vote;
}

deldrift_status dm_fail(const dm_refusal *refusal) {
    if (refusal->status != DELDRIFT_OK) memcpy(last_message, refusal->message, sizeof last_message);
    return refusal->status;
}

deldrift_status dm_no_handle(void) {
    dm_refusal refusal = {DELDRIFT_NULL_ARGUMENT, "m is NULL"};
    return dm_fail(&refusal);
}

const char *deldrift_mpi_last_error(void) {
    return last_message;
}

int deldrift_mpi_refusing_process(void) {
    return last_process;
}

bool dm_check_points(dm_refusal *refusal, const char *name, uint32_t dimension, const double *positions, size_t count,
                     const uint8_t *is_skipped) {
    if (count && !positions) {
        dm_refuse(refusal, DELDRIFT_NULL_ARGUMENT, "%s is NULL, and count is %zu", name, count);
        return false;
    }
    for (size_t i = 0; i < count * dimension; i++) {
        double x = positions[i];
        if (fabs(x) <= LARGEST || (is_skipped && is_skipped[i / dimension])) continue;
        dm_refuse(refusal, isfinite(x) ? DELDRIFT_OUT_OF_RANGE : DELDRIFT_NOT_FINITE,
                  "%s: coordinate %zu of point %zu is %.17g", name, i % dimension, i / dimension, x);
        return false;
    }
    return true;
}

bool dm_check_weights(dm_refusal *refusal, const double *weights, size_t count, const uint8_t *is_skipped) {
    for (size_t i = 0; weights && i < count; i++) {
        if (fabs(weights[i]) <= GREATEST_WEIGHT || (is_skipped && is_skipped[i])) continue;
        dm_refuse(refusal, isfinite(weights[i]) ? DELDRIFT_OUT_OF_RANGE : DELDRIFT_NOT_FINITE,
                  "weights: entry %zu is %.17g", i, weights[i]);
        return false;
    }
    return true;
}
