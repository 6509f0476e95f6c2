// Cancelling from another thread, and the limits on time, memory and Steiner points.
#include "test.hpp"

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

static delotet::Status status_of(const delotet::Plc &plc, const delotet::Options &options)
{
    return caught<delotet::Exception>([&] { delotet::tetrahedralize(plc, options); }).status();
}

int main()
{
    const delotet::Plc cloud(random_points(300000)), small = nested_boxes();

    // The token is cancelled in the middle of runs on several threads, which all end: they wait for it, so time does not matter.
    const delotet::CancelToken token;
    delotet::Options options = delotet::Options().mode(delotet::Mode::delaunay).cancel_token(token);
    CHECK(options.cancel_token() == token.get());
    std::atomic<int> running{0};
    options.on_progress([&](delotet::Phase phase, double) {
        CHECK(phase != DELOTET_PHASE_AUDIT);
        if (phase == DELOTET_PHASE_DELAUNAY) {
            running++;
            while (!token.is_cancelled())
                std::this_thread::yield();
        }
        return true;
    });
    std::vector<std::thread> threads;
    for (int i = 0; i < 2; i++)
        threads.emplace_back([&] { CHECK(status_of(cloud, options) == DELOTET_STATUS_CANCELLED); });
    while (running < 2)
        std::this_thread::yield();
    token.cancel();
    for (std::thread &thread : threads)
        thread.join();
    CHECK(token.is_cancelled() && status_of(small, options) == DELOTET_STATUS_CANCELLED);
    token.reset();
    options.on_progress(nullptr);
    delotet::tetrahedralize(small, options);

    // Worker threads stop too; the time is over whatever the machine.
    options.threads(4).time_limit(0.01);
    options.on_progress([](delotet::Phase, double) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return true;
    });
    CHECK(status_of(cloud, options) == DELOTET_STATUS_TIME_LIMIT);
    options.on_progress(nullptr);
    options.time_limit(0);
    delotet::Error error;
    CHECK(options.time_limit(-1, error) == DELOTET_STATUS_INVALID_ARGUMENT && error);

#ifdef __linux__
    options.memory_limit(40000000);
    CHECK(status_of(cloud, options) == DELOTET_STATUS_MEMORY_LIMIT);
    options.memory_limit(0);
#endif
    const delotet::Mesh whole = delotet::tetrahedralize(cloud, options);
    CHECK(whole.points().size() == cloud.points().size());

    const delotet::Plc prism = twisted_prism();
    CHECK(status_of(prism, delotet::Options().steiner_limit(0)) == DELOTET_STATUS_STEINER_LIMIT);
    CHECK(status_of(prism, delotet::Options().steiner_limit(0).mode(delotet::Mode::preserve)) ==
          DELOTET_STATUS_STEINER_LIMIT);
    const delotet::Mesh limited = delotet::tetrahedralize(prism, delotet::Options().steiner_limit(100));
    CHECK(limited.points().size() > prism.points().size());
    CHECK(status_of(prism, delotet::Options().tetrahedra_limit(limited.tets().size() - 1)) ==
          DELOTET_STATUS_TETRAHEDRA_LIMIT);
    delotet::tetrahedralize(prism, delotet::Options().tetrahedra_limit(limited.tets().size()));

    // The options keep what a token needs.
    delotet::Options orphan;
    {
        const delotet::CancelToken short_lived;
        orphan.cancel_token(short_lived);
        short_lived.cancel();
    }
    CHECK(status_of(small, orphan) == DELOTET_STATUS_CANCELLED);

    // Files.
    const std::string name = "test_control.msh";
    const delotet::Mesh mesh = delotet::tetrahedralize(small);
    token.cancel();
    const delotet::WriteOptions writing = delotet::WriteOptions().cancel_token(token).time_limit(1e6);
    CHECK(writing.cancel_token() == token.get() && writing.time_limit() > 9e5);
    CHECK(caught<delotet::Exception>([&] { mesh.write(small, name, writing); }).status() == DELOTET_STATUS_CANCELLED);
    CHECK(std::fopen(name.c_str(), "r") == nullptr);
    small.write("test_control.off");
    const delotet::Plc read = delotet::Plc::read("test_control.off", delotet::Options());
    CHECK(read.points().size() == 16);
    CHECK(caught<delotet::Exception>([&] {
              delotet::Plc::read("test_control.off", delotet::Options().cancel_token(token));
          }).status() == DELOTET_STATUS_CANCELLED);
    std::remove("test_control.off");
    return 0;
}
