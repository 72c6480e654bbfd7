/* The header defines deldrift_mpi_options_init. The library has it as well, for other languages: what the header does,
 * under that name. */
#define deldrift_mpi_options_init init_of_header
#include <deldrift_mpi.h>
#undef deldrift_mpi_options_init

extern void deldrift_mpi_options_init(deldrift_mpi_options *options);

void deldrift_mpi_options_init(deldrift_mpi_options *options) { init_of_header(options); }
