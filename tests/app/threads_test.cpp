// --threads of the program as a person starts it.
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* written[] = {"program.ngc", "report.json", "preview.png"};

/// What `plan` says and writes in so many threads.
std::vector<std::string> planned(const fs::path& project, const std::string& threads, const fs::path& out) {
    const Ended ended = run({"plan", project, "--out", out, "--threads", threads});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    std::vector<std::string> all{ended.out};
    for (const char* name : written) {
        all.push_back(content_of(out / name));
    }
    return all;
}

TEST(Threads, APlanHasTheSameBytesIn1And2And8) {
    const ScratchFolder scratch;
    for (const char* method : {"tracks", "chain"}) {
        const fs::path project = small_project(
            scratch.path(), "two-bell", "\"method\": \"tracks\"", fmt::format("\"method\": \"{}\"", method));
        const std::vector<std::string> alone = planned(project, "1", scratch / "1");
        EXPECT_EQ(planned(project, "2", scratch / "2"), alone) << method;
        EXPECT_EQ(planned(project, "8", scratch / "8"), alone) << method;
    }
}

/// A search of some minutes, which the test does not wait for.
std::vector<std::string> long_search(const fs::path& out, const std::string& threads) {
    return {"study",
            "set-up",
            "assets/projects/dome.json",
            "--out",
            out,
            "--places",
            "300",
            "--threads",
            threads};
}

/// 0 where it has ended.
std::ptrdiff_t threads_of(const Program& program) {
    std::error_code ended;
    const fs::directory_iterator tasks(fmt::format("/proc/{}/task", program.pid()), ended);
    return ended ? 0 : std::distance(begin(tasks), end(tasks));
}

TEST(Threads, AreAsManyAsWereAskedFor) {
    const ScratchFolder scratch;
    Program one(long_search(scratch / "1", "1"));
    one.wait_for_error_text("Mapping"); // has searched before
    const std::ptrdiff_t with_one = threads_of(one);
    Program eight(long_search(scratch / "8", "8"));
    std::ptrdiff_t with_eight = 0;
    do {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        with_eight = threads_of(eight);
    } while (with_eight > 0 && with_eight < with_one + 7);
    EXPECT_EQ(with_eight, with_one + 7);
    for (Program* const program : {&one, &eight}) {
        program->send(SIGTERM);
        EXPECT_EQ(program->end().exit_code, 1);
    }
}

} // namespace
} // namespace millwright::test
