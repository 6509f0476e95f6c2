// How soon a run ends after it has been cancelled, and how far it goes beyond a limit on memory. Built and run by limits.py.
//   limits FILE MODE stops COUNT SEED     cancels COUNT runs at random moments from another thread
//   limits FILE MODE memory BYTES         one run with a limit (0: none)
// MODE is delaunay, cdt, merge or preserve.
#include <delotet/delotet.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <thread>

using Clock = std::chrono::steady_clock;

static double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

static double peak_bytes()
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

static delotet::Options options_of(const std::string &mode)
{
    delotet::Options options;
    if (mode == "delaunay")
        options.mode(delotet::Mode::delaunay);
    else if (mode == "preserve")
        options.mode(delotet::Mode::preserve);
    else if (mode == "fill")
        options.mode(delotet::Mode::preserve).quality(2).optimize(1);
    else if (mode == "merge")
        options.merge_facets(179.9);
    return options;
}

static int stop(const delotet::Plc &plc, delotet::Options &options, int count, unsigned seed)
{
    std::atomic<int> phase{0};
    options.on_progress([&](delotet::Phase now, double) {
        phase = static_cast<int>(now);
        return true;
    });
    delotet::Error error;
    delotet::Mesh mesh;
    Clock::time_point start = Clock::now();
    if (delotet::tetrahedralize(plc, options, mesh, error) != DELOTET_STATUS_OK)
        return 1;
    const double whole = seconds_since(start);
    const delotet::CancelToken token;
    options.cancel_token(token);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> moment(0.0, whole);
    double worst = 0, sum = 0;
    int stopped = 0, worst_phase = 0;
    for (int i = 0; i < count; i++) {
        token.reset();
        Clock::time_point cancelled;
        int cancelled_in = 0;
        const std::chrono::duration<double> wait(moment(random));
        std::thread other([&] {
            std::this_thread::sleep_for(wait);
            cancelled_in = phase;
            cancelled = Clock::now();
            token.cancel();
        });
        const delotet::Status status = delotet::tetrahedralize(plc, options, mesh, error);
        const Clock::time_point end = Clock::now();
        other.join();
        if (status != DELOTET_STATUS_CANCELLED)
            continue; // It was done before.
        const double latency = std::chrono::duration<double>(end - cancelled).count();
        stopped++;
        sum += latency;
        if (latency > worst)
            worst = latency, worst_phase = cancelled_in;
    }
    std::printf("%.3f %d %.4f %.4f %d\n", whole, stopped, stopped ? sum / stopped : 0, worst, worst_phase);
    return 0;
}

static int memory(const delotet::Plc &plc, delotet::Options &options, std::uint64_t bytes)
{
    if (bytes != 0)
        options.memory_limit(bytes);
    delotet::Error error;
    delotet::Mesh mesh;
    const double before = peak_bytes();
    const delotet::Status status = delotet::tetrahedralize(plc, options, mesh, error);
    std::printf("%d %.0f\n", static_cast<int>(status), peak_bytes() - before);
    return 0;
}

int main(int count, char **words)
{
    if (count < 5)
        return 2;
    const std::string what = words[3];
    const delotet::Plc plc = delotet::Plc::read(words[1]);
    delotet::Options options = options_of(words[2]);
    if (what == "memory")
        return memory(plc, options, std::strtoull(words[4], nullptr, 10));
    return count == 6 ? stop(plc, options, std::atoi(words[4]), static_cast<unsigned>(std::atoi(words[5]))) : 2;
}
