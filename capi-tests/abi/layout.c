/* Sizes and offsets of all structs that cross the ABI, on 64-bit machines. A change here is a change of the ABI. */
#include <delotet/delotet.h>

#define SIZE(type, size) _Static_assert(sizeof(type) == (size), #type " has another size")
#define AT(type, field, offset) _Static_assert(offsetof(type, field) == (offset), #type "." #field " is elsewhere")

_Static_assert(sizeof(void *) != 8 || sizeof(size_t) == 8, "size_t");
_Static_assert(sizeof(DelotetStatus) == 4 && sizeof(DelotetPhase) == 4, "enumerations are ints");
_Static_assert(sizeof(DelotetElement) == 4 && sizeof(DelotetDefectKind) == 4, "enumerations are ints");
_Static_assert(sizeof(DelotetMode) == 4 && sizeof(DelotetNodeOrder) == 4, "constants that C passes are uint32_t");

#if UINTPTR_MAX == UINT64_MAX
SIZE(DelotetPointsView, 16);
SIZE(DelotetDoublesView, 24);
SIZE(DelotetMarkersView, 16);
SIZE(DelotetIndicesView, 16);
SIZE(DelotetIndexRowsView, 24);
SIZE(DelotetTetsView, 16);
SIZE(DelotetSegmentsView, 24);
SIZE(DelotetRegionSeedsView, 24);
SIZE(DelotetRegionsView, 24);
AT(DelotetRegionsView, stride, 16);
SIZE(DelotetSubfacesView, 24);
AT(DelotetSubfacesView, stride, 16);
SIZE(DelotetSubsegmentsView, 24);
AT(DelotetSubsegmentsView, stride, 16);
SIZE(DelotetSteinerView, 24);
AT(DelotetSteinerView, stride, 16);
SIZE(DelotetFacetFlipsView, 24);
AT(DelotetFacetFlipsView, stride, 16);
SIZE(DelotetSteinerTermsView, 24);
AT(DelotetSteinerTermsView, stride, 16);
SIZE(DelotetFacesView, 24);
AT(DelotetFacesView, stride, 16);
SIZE(DelotetEdgesView, 24);
AT(DelotetEdgesView, stride, 16);
SIZE(DelotetDefectsView, 24);
AT(DelotetDefectsView, stride, 16);
SIZE(DelotetSecondOrderView, 32);
SIZE(DelotetWarningsView, 24);
AT(DelotetWarningsView, stride, 16);
AT(DelotetPointsView, count, 8);
AT(DelotetDoublesView, width, 16);
AT(DelotetSecondOrderView, tets, 16);
AT(DelotetSecondOrderView, tet_count, 24);
SIZE(DelotetStats, 280);
AT(DelotetStats, steiner, 8);
AT(DelotetStats, seconds, 64);
AT(DelotetStats, preserve_missing_edges, 192);
AT(DelotetStats, preserve_interior, 248);
AT(DelotetStats, preserve_on_internal_facets, 256);
AT(DelotetStats, replaced, 264);
AT(DelotetStats, peak_resident_bytes, 272);
#endif

SIZE(DelotetDefect, 48);
AT(DelotetDefect, first_element, 4);
AT(DelotetDefect, first, 8);
AT(DelotetDefect, second_element, 12);
AT(DelotetDefect, second, 16);
AT(DelotetDefect, has_point, 20);
AT(DelotetDefect, point, 24);
SIZE(DelotetWarning, 48);
AT(DelotetWarning, first_element, 4);
AT(DelotetWarning, first, 8);
AT(DelotetWarning, second_element, 12);
AT(DelotetWarning, second, 16);
AT(DelotetWarning, has_point, 20);
AT(DelotetWarning, point, 24);
SIZE(DelotetRegion, 24);
AT(DelotetRegion, max_volume, 8);
AT(DelotetRegion, seed, 16);
SIZE(DelotetSegment, 12);
AT(DelotetSegment, marker, 8);
SIZE(DelotetRegionSeed, 40);
AT(DelotetRegionSeed, attribute, 24);
AT(DelotetRegionSeed, max_volume, 32);
SIZE(DelotetSubface, 28);
AT(DelotetSubface, facet, 12);
AT(DelotetSubface, marker, 16);
AT(DelotetSubface, tets, 20);
SIZE(DelotetSubsegment, 16);
AT(DelotetSubsegment, segment, 8);
AT(DelotetSubsegment, marker, 12);
SIZE(DelotetSteinerPoint, 24);
AT(DelotetSteinerPoint, t, 8);
AT(DelotetSteinerPoint, segment, 16);
AT(DelotetSteinerPoint, exact, 20);
SIZE(DelotetSteinerTerm, 16);
AT(DelotetSteinerTerm, value, 8);
SIZE(DelotetFacetFlip, 24);
AT(DelotetFacetFlip, new_ends, 8);
AT(DelotetFacetFlip, facets, 16);
SIZE(DelotetFace, 28);
AT(DelotetFace, tets, 12);
AT(DelotetFace, subface, 20);
AT(DelotetFace, marker, 24);
SIZE(DelotetEdge, 20);
AT(DelotetEdge, tet, 8);
AT(DelotetEdge, subsegment, 12);
AT(DelotetEdge, marker, 16);

/* The numbers are fixed for ever. */
_Static_assert(DELOTET_STATUS_OK == 0 && DELOTET_STATUS_INVALID_ARGUMENT == 1 && DELOTET_STATUS_UNSUPPORTED == 2, "");
_Static_assert(DELOTET_STATUS_NON_FINITE_POINT == 10 && DELOTET_STATUS_COORDINATE_RANGE == 11, "");
_Static_assert(DELOTET_STATUS_INDEX_OUT_OF_RANGE == 12, "");
_Static_assert(DELOTET_STATUS_DEGENERATE_FACET == 14 && DELOTET_STATUS_NON_PLANAR_FACET == 15, "");
_Static_assert(DELOTET_STATUS_SELF_INTERSECTION == 16 && DELOTET_STATUS_DEGENERATE_INPUT == 17, "");
_Static_assert(DELOTET_STATUS_SEED_OUTSIDE == 18 && DELOTET_STATUS_NOTHING_ENCLOSED == 19, "");
_Static_assert(DELOTET_STATUS_CANCELLED == 30 && DELOTET_STATUS_STEINER_LIMIT == 31, "");
_Static_assert(DELOTET_STATUS_ROUNDING == 33 && DELOTET_STATUS_TIME_LIMIT == 34 && DELOTET_STATUS_MEMORY_LIMIT == 35, "");
_Static_assert(DELOTET_STATUS_OUT_OF_MEMORY == 40 && DELOTET_STATUS_TOO_LARGE == 41, "");
_Static_assert(DELOTET_STATUS_FILE == 50 && DELOTET_STATUS_FORMAT == 51 && DELOTET_STATUS_CHECK_FAILED == 60, "");
_Static_assert(DELOTET_STATUS_INTERNAL == 90, "");
