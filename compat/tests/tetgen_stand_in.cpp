// Stands in for a module with TetGen 1.5.1, or 1.6 (IS_1_6), inside: functions that it exports, by which the two can be
// told apart, and calls of it that are counted.
class tetgenio {
public:
    bool load_node(char *name);
#ifdef IS_1_6
    bool load_elem(char *name);
#endif
};

bool tetgenio::load_node(char *) { return false; }
#ifdef IS_1_6
bool tetgenio::load_elem(char *) { return false; }
#endif

extern "C" {
int stand_in_calls = 0;
}

void tetrahedralize(char *, tetgenio *, tetgenio *, tetgenio *, tetgenio *) { stand_in_calls++; }

// The call returns here, so that its origin can be told.
extern "C" void call_stand_in(char *switches, tetgenio *in, tetgenio *out) {
    tetrahedralize(switches, in, out, nullptr, nullptr);
    static volatile int returned = 0;
    returned = 1;
}
