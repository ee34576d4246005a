#include "tests/architecture/size_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

namespace millwright::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> named(const std::vector<Sized>& found) {
    std::vector<std::string> names;
    for (const Sized& one : found) {
        names.push_back(one.name + " " + std::to_string(one.size));
    }
    return names;
}

TEST(FunctionSize, CountsFromBraceToBrace) {
    EXPECT_THAT(named(functions_of("namespace a {\nint f(int x) {\n    return x;\n}\n} // namespace a\n")),
                ElementsAre("f 3"));
    EXPECT_THAT(named(functions_of("class A {\npublic:\n    A() : a_{1}, b_(2) {\n    }\n"
                                   "    bool operator==(const A& b) const { return true; }\n};\n")),
                ElementsAre("A 2", "operator== 1"));
    EXPECT_THAT(named(functions_of("int A::f() const {\n    if (x) {\n        g({1, 2});\n    }\n"
                                   "    const auto h = [](int n) {\n        return n;\n    };\n}\n")),
                ElementsAre("A::f 8"));
}

TEST(FunctionSize, IsNotMisledByTextAndTables) {
    EXPECT_THAT(named(functions_of("const char* a = \"void f() {\"; // void g() {\n"
                                   "/* { */ const char b = '{';\nconst int c = 1'000;\n"
                                   "const Row row{.make = [](int n) {\n    return n;\n}};\n"
                                   "constexpr std::array d{f(1), f(2)};\n"
                                   "void e() {\n    g(R\"x({\")x\");\n}\n")),
                ElementsAre("e 3"));
    EXPECT_THAT(named(functions_of("template <typename T> struct A {\n    T t;\n};\n"
                                   "std::vector<Case> cases() {\n    return {{1}, {2}};\n}\n")),
                ElementsAre("cases 3"));
}

TEST(Flags, AreCountedInTheirClass) {
    EXPECT_THAT(
        named(flags_of("struct A {\n    bool a = false, b;\n    std::atomic<bool> c{true};\n"
                       "    struct B {\n        bool d;\n    };\n    bool f() const { bool g = true; }\n"
                       "    bool h(bool i);\nprivate:\n    mutable bool j;\n    int k{};\n};\n")),
        ElementsAre("B 1", "A 4"));
}

std::string function_of(int lines) {
    std::string text = "void f() {\n";
    for (int n = 2; n < lines; ++n) {
        text += "    g();\n";
    }
    return text + "}\n";
}

TEST(FunctionSize, IsAtMost60LinesButForWhatIsListed) {
    EXPECT_THAT(check_functions({{"core/a.cpp", function_of(60)}}, {}), IsEmpty());
    EXPECT_THAT(check_functions({{"core/a.cpp", function_of(61)}}, {}),
                ElementsAre(Finding{"core/a.cpp", 1, "f has 61 lines, more than 60"}));
    EXPECT_THAT(check_functions({{"tests/a.cpp", function_of(61)}}, {}), IsEmpty());
    constexpr std::array listed{Larger{"core/a.cpp", "f", 70}};
    EXPECT_THAT(check_functions({{"core/a.cpp", function_of(70)}}, listed), IsEmpty());
    EXPECT_THAT(check_functions({{"core/a.cpp", function_of(71)}}, listed),
                ElementsAre(Finding{"core/a.cpp", 1, "f has 71 lines, more than 70"}));
    EXPECT_THAT(check_functions({{"core/a.cpp", function_of(60)}}, listed),
                ElementsAre(Finding{"core/a.cpp", 0, "f is within the limit: take it off the list"}));
}

TEST(Flags, AreAtMostFiveInAClass) {
    const std::string five = "struct A {\n    bool a, b, c, d, e;\n";
    EXPECT_THAT(check_flags({{"ui/a.h", five + "};\n"}}, {}), IsEmpty());
    EXPECT_THAT(check_flags({{"ui/a.h", five + "    bool f;\n};\n"}}, {}),
                ElementsAre(Finding{"ui/a.h", 1, "A has 6 flags, more than 5"}));
}

std::string text_of(int lines) {
    std::string text;
    for (int n = 0; n < lines; ++n) {
        text += "\n";
    }
    return text;
}

TEST(ModuleSize, IsAtMost12000LinesButForWhatIsListed) {
    const std::vector<TextFile> files{{"core/grid/a.cpp", text_of(6000)},
                                      {"core/grid/internal/b.h", text_of(6000)},
                                      {"core/plot/c.cpp", text_of(12001)},
                                      {"app/plan/d.cpp", text_of(12001)},
                                      {"app/e.cpp", text_of(6000)},
                                      {"app/f.cpp", text_of(6001)}};
    EXPECT_THAT(check_modules(files, {}),
                ElementsAre(Finding{"app", 0, "12001 lines, more than 12000"},
                            Finding{"app/plan", 0, "12001 lines, more than 12000"},
                            Finding{"core/plot", 0, "12001 lines, more than 12000"}));
    constexpr std::array listed{Larger{"app", "", 13000},
                                Larger{"app/plan", "", 13000},
                                Larger{"core/plot", "", 13000},
                                Larger{"core/grid", "", 13000}};
    EXPECT_THAT(check_modules(files, listed),
                ElementsAre(Finding{"core/grid", 0, "is within the limit: take it off the list"}));
}

TEST(ThisRepositorysSizes, AreWithinTheLimits) {
    const std::vector<TextFile> files = read_repository(".");
    EXPECT_THAT(check_functions(files, {}), IsEmpty());
    EXPECT_THAT(check_flags(files, {}), IsEmpty());
    EXPECT_THAT(check_modules(files, {}), IsEmpty());
}

} // namespace
} // namespace millwright::architecture
