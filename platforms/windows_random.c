// Random numbers that Rust's standard library asks Windows for, as the seeds of its tables: wine 8 has no such library.
#include <stddef.h>

__declspec(dllexport) int __stdcall ProcessPrng(unsigned char *bytes, size_t count);

int __stdcall ProcessPrng(unsigned char *bytes, size_t count) {
    for (size_t i = 0; i < count; i++) bytes[i] = (unsigned char)i;
    return 1;
}
