#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::cordic {
namespace {

std::string output_of(const std::string& program) {
    struct Close {
        void operator()(std::FILE* pipe) const { pclose(pipe); }
    };
    const std::unique_ptr<std::FILE, Close> pipe(popen(program.c_str(), "r"));
    if (!pipe) {
        throw std::runtime_error("cannot start " + program);
    }
    std::string text;
    std::array<char, 256> some{};
    while (std::fgets(some.data(), static_cast<int>(some.size()), pipe.get()) != nullptr) {
        text += some.data();
    }
    return text;
}

/// The builds of same_bits.cpp: at -O0, -O2 and -O3, and by clang where that is installed.
std::vector<std::string> builds() {
    std::vector<std::string> found;
    std::string one;
    for (const char c : std::string_view(MILLWRIGHT_SAME_BITS ":")) {
        if (c == ':') {
            found.push_back(one);
            one.clear();
        } else {
            one += c;
        }
    }
    return found;
}

TEST(SameBits, ComeOutAtEveryOptimisationLevelAndFromEveryCompiler) {
    const auto programs = builds();
    ASSERT_GE(programs.size(), 3U);
    const std::string first = output_of(programs.front());
    ASSERT_EQ(first.size(), 17U) << first;
    for (const std::string& program : programs) {
        EXPECT_EQ(output_of(program), first) << program;
    }
}

} // namespace
} // namespace millwright::cordic
