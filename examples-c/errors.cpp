// What is wrong with a surface, and where: a triangle pierces a tetrahedron.
#include <delotet/delotet.hpp>

#include <cmath>
#include <iostream>

static const char *word(std::uint32_t element)
{
    switch (element) {
    case DELOTET_ELEMENT_POINT: return "point";
    case DELOTET_ELEMENT_SEGMENT: return "segment";
    case DELOTET_ELEMENT_FACET: return "facet";
    default: return "element";
    }
}

int main()
{
    const double xyz[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, -1, 1.5, 1, -1, 1, 1, 0.75};
    const delotet::Index corners[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3, 4, 5, 6};
    delotet::Plc plc(xyz);
    plc.add_triangles(corners);
    try {
        delotet::tetrahedralize(plc);
        std::cerr << "the intersection was overlooked\n";
        return 1;
    } catch (const delotet::Exception &e) {
        std::cout << delotet_status_name(e.status()) << ": " << e.what() << "\n";
        for (const delotet::Defect &defect : e.defects()) {
            std::cout << "  " << delotet_defect_kind_name(defect.kind) << ": " << word(defect.first_element) << " "
                      << defect.first;
            if (defect.second_element != DELOTET_ELEMENT_NONE)
                std::cout << " and " << word(defect.second_element) << " " << defect.second;
            if (defect.has_point)
                std::cout << " at x = " << defect.point[0] << ", y = " << defect.point[1] << ", z = " << defect.point[2];
            std::cout << "\n";
        }
    }
}
