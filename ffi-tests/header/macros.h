// Names that well-known headers define as macros, each defined here in a way that whoever uses it notices: include it
// after the headers of the standard library, and before those of deldrift. Macros with arguments are only seen where a
// parenthesis follows.
#define OBJECT_LIKE @

// windows.h and what it includes
#define near OBJECT_LIKE
#define far OBJECT_LIKE
#define small OBJECT_LIKE
#define hyper OBJECT_LIKE
#define interface OBJECT_LIKE
#define cdecl OBJECT_LIKE
#define pascal OBJECT_LIKE
#define rad1 OBJECT_LIKE
#define rad2 OBJECT_LIKE
#define rad3 OBJECT_LIKE
#define min(a, b) @
#define max(a, b) @
#define IN OBJECT_LIKE
#define OUT OBJECT_LIKE
#define OPTIONAL OBJECT_LIKE
#define ERROR OBJECT_LIKE
#define NO_ERROR OBJECT_LIKE
#define VOID OBJECT_LIKE
#define CONST OBJECT_LIKE
#define TRUE OBJECT_LIKE
#define FALSE OBJECT_LIKE
#define DELETE OBJECT_LIKE
#define IGNORE OBJECT_LIKE
#define ABSOLUTE OBJECT_LIKE
#define RELATIVE OBJECT_LIKE
#define OPAQUE OBJECT_LIKE
#define TRANSPARENT OBJECT_LIKE
#define STRICT OBJECT_LIKE
#define CALLBACK OBJECT_LIKE
#define DIFFERENCE OBJECT_LIKE
#define GetObject OBJECT_LIKE
#define CreateFile OBJECT_LIKE
#define STATUS_PENDING OBJECT_LIKE

// X11
#define None OBJECT_LIKE
#define Status OBJECT_LIKE
#define Bool OBJECT_LIKE
#define True OBJECT_LIKE
#define False OBJECT_LIKE
#define Success OBJECT_LIKE
#define Always OBJECT_LIKE
#define Complex OBJECT_LIKE
#define Convex OBJECT_LIKE
#define Above OBJECT_LIKE
#define Below OBJECT_LIKE
#define Unsorted OBJECT_LIKE

// complex.h, math.h, sys/sysmacros.h, ctype.h and compilers' own in their GNU dialects
#define I OBJECT_LIKE
#define complex OBJECT_LIKE
#define DOMAIN OBJECT_LIKE
#define OVERFLOW OBJECT_LIKE
#define SING OBJECT_LIKE
#define PI OBJECT_LIKE
#define TWO_PI OBJECT_LIKE
#define EPSILON OBJECT_LIKE
#define REAL OBJECT_LIKE
#define DIM OBJECT_LIKE
#define DIMENSION OBJECT_LIKE
