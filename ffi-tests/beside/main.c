int catch_both(void);

int main(void) {
    return catch_both();
}
