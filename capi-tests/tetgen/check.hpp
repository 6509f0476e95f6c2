// What the tests of the TetGen interface share.
#ifndef DELOTET_TETGEN_CHECK_HPP
#define DELOTET_TETGEN_CHECK_HPP

#include <cstdio>
#include <cstdlib>

#define CHECK(...)                                                                              \
    do {                                                                                        \
        if (!(__VA_ARGS__)) {                                                                   \
            std::fprintf(stderr, "%s:%d: failed: %s\n", __FILE__, __LINE__, #__VA_ARGS__);      \
            std::exit(1);                                                                       \
        }                                                                                       \
    } while (0)

#endif
