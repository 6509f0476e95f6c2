/* delotet_quality_bin_edges: ascending bounds of every measure. */
#include "test.h"

int main(void)
{
    uint32_t measure;
    size_t i;
    for (measure = 0; measure < DELOTET_QUALITY_MEASURES; measure++) {
        DelotetDoublesView edges = delotet_quality_bin_edges(measure);
        CHECK(edges.count == DELOTET_QUALITY_BINS + 1 && edges.width == 1 && edges.data[0] == 0);
        for (i = 1; i < edges.count; i++)
            CHECK(edges.data[i - 1] < edges.data[i]);
    }
    CHECK(delotet_quality_bin_edges(DELOTET_QUALITY_MIN_DIHEDRAL).data[3] == 10);
    CHECK(delotet_quality_bin_edges(4).data == NULL && delotet_quality_bin_edges(4).count == 0);
    return 0;
}
