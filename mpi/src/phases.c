// The two phases of a commit, on the triangulation of the process.
#include "internal.h"

bool dm_prepare(deldrift_mpi *m) {
    DM_SET_PREPARING(true);
    deldrift_status status = deldrift_prepare_timestamp(m->t, NULL);
    DM_SET_PREPARING(false);
    if (status == DELDRIFT_OK) m->is_prepared = true;
    return dm_took(&m->refusal, status);
}

void dm_publish(deldrift_mpi *m) {
    if (m->is_prepared) deldrift_publish_timestamp(m->t);
    m->is_prepared = false;
}

void dm_withdraw(deldrift_mpi *m) {
    // Without a prepared timestamp withdrawing leaves what is staged.
    if (m->is_prepared)
        deldrift_withdraw_timestamp(m->t);
    else
        deldrift_discard_moves(m->t);
    m->is_prepared = false;
}
