// Models from files.
#include "peers.hpp"

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

Model read(const char *path)
{
    std::ifstream file(path);
    std::string word, line, text;
    while (std::getline(file, line)) // Comments go, the rest is words.
        text += line.substr(0, line.find('#')) + "\n";
    std::istringstream in(text);
    std::size_t points = 0, faces = 0, edges = 0, corners = 0;
    Model model;
    if (!(in >> word) || word != "OFF" || !(in >> points >> faces >> edges))
        return model;
    model.points.resize(points);
    for (Point &p : model.points) {
        // By strtod, since the rounding of streams depends on the standard library.
        std::string x, y, z;
        in >> x >> y >> z;
        p = {std::strtod(x.c_str(), nullptr), std::strtod(y.c_str(), nullptr), std::strtod(z.c_str(), nullptr)};
    }
    for (std::size_t i = 0; i < faces; i++) {
        Triangle t;
        if (!(in >> corners) || corners != 3 || !(in >> t[0] >> t[1] >> t[2]))
            return Model();
        std::getline(in, line); // Colours.
        model.triangles.push_back(t);
    }
    return model;
}

bool is_one_surface(const Model &model)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> edges;
    for (std::size_t i = 0; i < model.triangles.size(); i++)
        for (std::size_t k = 0; k < 3; k++)
            if (!edges.emplace(std::pair(model.triangles[i][k], model.triangles[i][(k + 1) % 3]), i).second)
                return false;
    std::vector<std::size_t> pending(1, 0);
    std::vector<bool> seen(model.triangles.size());
    if (seen.empty())
        return false;
    seen[0] = true;
    for (std::size_t reached = 0; reached < pending.size(); reached++)
        for (std::size_t k = 0; k < 3; k++) {
            const Triangle &t = model.triangles[pending[reached]];
            const auto other = edges.find({t[(k + 1) % 3], t[k]});
            if (other == edges.end())
                return false;
            if (!seen[other->second]) {
                seen[other->second] = true;
                pending.push_back(other->second);
            }
        }
    return pending.size() == model.triangles.size();
}

std::vector<Triangle> reversed(std::vector<Triangle> triangles)
{
    for (Triangle &t : triangles)
        std::swap(t[1], t[2]);
    return triangles;
}
