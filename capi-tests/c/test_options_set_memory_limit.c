/* delotet_options_set_memory_limit: a run that takes more ends before it has taken much more. */
#define _XOPEN_SOURCE 600
#include "test.h"
#include <sys/resource.h>

static double peak_megabytes(void)
{
    struct rusage usage;
    CHECK(getrusage(RUSAGE_SELF, &usage) == 0);
    return (double)usage.ru_maxrss / 1e3; /* Kilobytes, on Linux. */
}

int main(void)
{
    DelotetOptions *options = delotet_options_new();
    DelotetPlc *plc = cloud(300000), *small = cube();
    DelotetMesh *mesh = NULL;
    double before;
    OK(delotet_options_set_mode(options, DELOTET_MODE_DELAUNAY, &error));
    OK(delotet_options_set_memory_limit(options, 60 * 1000 * 1000, &error));
    delotet_mesh_free(mesh_with(small, options));
    before = peak_megabytes(); /* Pages of the library's code count as well. */
#ifdef __linux__
    FAILS(DELOTET_STATUS_MEMORY_LIMIT, delotet_tetrahedralize(plc, options, &mesh, &error));
    CHECK(mesh == NULL && peak_megabytes() < before + 66);
#endif
    OK(delotet_options_set_memory_limit(options, UINT64_MAX, &error));
    delotet_mesh_free(mesh_with(plc, options));
    CHECK(peak_megabytes() > before + 66);
    OK(delotet_options_set_memory_limit(options, 0, &error));
    delotet_mesh_free(mesh_with(plc, options));
    FAILS(INVALID, delotet_options_set_memory_limit(NULL, 1, &error));
    delotet_plc_free(plc);
    delotet_plc_free(small);
    delotet_options_free(options);
    return 0;
}
