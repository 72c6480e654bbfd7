// Whether an emulator of s390x multiplies two short numbers to a long one rightly. qemu 7.2, that of Debian 12, takes one
// of them for a long one, with the half of the register that has nothing to do with it; qemu 10.0 is right.
#include <stdint.h>
#include <stdio.h>
#include <string.h>

int main(void) {
    // A short number is in the upper half of its register.
    const uint64_t bits = 0x3f4ce6eeb924dfea;
    const uint32_t upper = (uint32_t)(bits >> 32);
    double x, product;
    float number;
    memcpy(&x, &bits, sizeof x);
    memcpy(&number, &upper, sizeof number);
    product = x;
    __asm__("mdebr %0,%1" : "+f"(product) : "f"(x));
    const double expected = (double)number * (double)number;
    printf("%.17g, and it should be %.17g\n", product, expected);
    return product != expected;
}
