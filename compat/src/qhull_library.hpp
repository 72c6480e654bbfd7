// The libqhull_r that a program has loaded, and its own functions, by which its structures are made.
#pragma once

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace compat {

using NewQhull = decltype(&qh_new_qhull);

// Every function that is called.
#define COMPAT_QHULL_FUNCTIONS(each)                                                                         \
    each(qh_appendfacet) each(qh_appendvertex) each(qh_detroundoff) each(qh_init_B) each(qh_initflags)        \
    each(qh_initqhull_start) each(qh_maxmin) each(qh_memalloc) each(qh_memcheck) each(qh_meminit)             \
    each(qh_newfacet) each(qh_newvertex) each(qh_scalelast) each(qh_setappend) each(qh_setnew)                \
    each(qh_settempfree)

struct QhullLibrary {
#define COMPAT_MEMBER(name) decltype(&::name) name = nullptr;
    COMPAT_QHULL_FUNCTIONS(COMPAT_MEMBER)
#undef COMPAT_MEMBER
};

// The functions of the library that has this qh_new_qhull; null if it is of another version than the headers that this
// was compiled with, as its structures may be others, or if it is the library without qhT, or lacks a function.
const QhullLibrary *find_qhull_library(const void *original);

} // namespace compat
