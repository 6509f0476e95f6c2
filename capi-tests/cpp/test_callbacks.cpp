// Callbacks: they may throw anything, cancel, run other meshes; exceptions never pass through the library.
#include "test.hpp"

#include <stdexcept>
#include <string>
#include <thread>

struct Counted {
    static int alive;
    Counted() { alive++; }
    Counted(const Counted &) { alive++; }
    ~Counted() { alive--; }
};
int Counted::alive = 0;

int main()
{
    const delotet::Plc plc = nested_boxes();

    int calls = 0;
    delotet::Options counting;
    counting.on_progress([&](delotet::Phase, double) { return ++calls > 0; });
    const delotet::Mesh whole = delotet::tetrahedralize(plc, counting);
    CHECK(calls > 2);

    // Every single call may throw. How many there are depends on the time that the run takes.
    int last = 1;
    for (;; last++) {
        int count = 0;
        delotet::Options options;
        options.on_progress([&](delotet::Phase, double) {
            const Counted counted;
            if (++count == last)
                throw std::runtime_error("thrown at " + std::to_string(last));
            return true;
        });
        try {
            delotet::tetrahedralize(plc, options);
            break;
        } catch (const std::runtime_error &e) {
            CHECK(e.what() == "thrown at " + std::to_string(last) && Counted::alive == 0);
            CHECK(count == last); // Cancelled at once.
        }
    }
    CHECK(last > 3);

    // Anything may be thrown, not only exception classes; the status form rethrows it too.
    delotet::Options rude;
    rude.on_progress([](delotet::Phase, double) -> bool { throw 42; });
    CHECK(caught<int>([&] { delotet::tetrahedralize(plc, rude); }) == 42);
    CHECK(caught<int>([&] { plc.check(rude); }) == 42);
    delotet::Mesh mesh;
    delotet::Error error;
    CHECK(caught<int>([&] { delotet::tetrahedralize(plc, rude, mesh, error); }) == 42);
    CHECK(mesh.get() == nullptr);

    // Cancelling is not throwing.
    delotet::Options cancelling;
    cancelling.on_progress([](delotet::Phase, double) { return false; });
    CHECK(caught<delotet::Exception>([&] { delotet::tetrahedralize(plc, cancelling); }).status() ==
          DELOTET_STATUS_CANCELLED);
    CHECK(delotet::tetrahedralize(plc, cancelling, mesh, error) == DELOTET_STATUS_CANCELLED && error);

    // The log: one line for a hole without effect, none if there is nothing to report.
    std::vector<std::string> said;
    delotet::Options logging;
    logging.on_log([&](const char *line) { said.push_back(line); });
    delotet::tetrahedralize(plc, logging);
    CHECK(said.empty());
    delotet::Plc holed = nested_boxes();
    holed.add_hole({9, 9, 9});
    delotet::tetrahedralize(holed, logging);
    CHECK(said.size() == 1 && said[0].find("hole 0 at (9, 9, 9)") != std::string::npos);
    logging.on_log([](const char *) { throw std::string("log"); });
    CHECK(caught<std::string>([&] { delotet::tetrahedralize(holed, logging); }) == "log");
    delotet::tetrahedralize(plc, logging);

    // A callback may make another mesh with other callbacks; each exception belongs to its own run.
    int inner_calls = 0;
    delotet::Options outer, inner;
    inner.on_progress([&](delotet::Phase, double) -> bool {
        inner_calls++;
        throw std::string("inner");
    });
    outer.on_progress([&](delotet::Phase, double) {
        CHECK(caught<std::string>([&] { delotet::tetrahedralize(cube(), inner); }) == "inner");
        return true;
    });
    const delotet::Mesh nested = delotet::tetrahedralize(plc, outer);
    CHECK(inner_calls > 0 && nested.tets().size() == whole.tets().size());

    // One set of options in several threads: every exception arrives where it was thrown.
    delotet::Options shared;
    shared.on_progress([](delotet::Phase, double) -> bool { throw std::this_thread::get_id(); });
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; i++)
        threads.emplace_back([&] {
            const auto id = caught<std::thread::id>([&] { delotet::tetrahedralize(plc, shared); });
            CHECK(id == std::this_thread::get_id());
        });
    for (std::thread &thread : threads)
        thread.join();
    return 0;
}
