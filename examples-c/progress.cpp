// A progress bar, and a run that is cancelled after one second. Throwing an exception would work as well as `return false`.
#include <delotet/delotet.hpp>

#include <chrono>
#include <cstdio>
#include <random>
#include <vector>

int main()
{
    std::mt19937_64 random(1);
    std::vector<delotet::Point> points(1000000);
    for (delotet::Point &point : points)
        for (double &x : point)
            x = static_cast<double>(random() >> 11) * 0x1p-53;
    const delotet::Plc plc(points);

    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    delotet::Options options;
    options.mode(delotet::Mode::delaunay).on_progress([&](delotet::Phase phase, double fraction) {
        const int width = static_cast<int>(40 * fraction);
        std::fprintf(stderr, "\r%-24s [%-40.*s]", delotet_phase_name(phase), width, "########################################");
        return seconds() < 1;
    });
    delotet::Mesh mesh;
    delotet::Error error;
    const delotet::Status status = delotet::tetrahedralize(plc, options, mesh, error);
    std::fprintf(stderr, "\n");
    if (status == DELOTET_STATUS_CANCELLED)
        std::printf("cancelled after %.1f s\n", seconds());
    else if (status == DELOTET_STATUS_OK)
        std::printf("%zu tetrahedra\n", mesh.tets().size());
    else
        std::printf("%s\n", error.message());
}
