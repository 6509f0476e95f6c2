// Values at the points of a mesh in a file of their own, one to a line: capi-tests/picture.py colours by them.
#ifndef EXAMPLES_VALUES_HPP
#define EXAMPLES_VALUES_HPP
#include <delotet/delotet.hpp>

#include <cstdio>
#include <cstdlib>
#include <vector>

inline void write_values(const char *path, const std::vector<double> &values)
{
    std::FILE *file = std::fopen(path, "w");
    if (!file)
        std::exit(1);
    for (const double value : values)
        std::fprintf(file, "%.9g\n", value);
    if (std::fclose(file) != 0)
        std::exit(1);
}
#endif
