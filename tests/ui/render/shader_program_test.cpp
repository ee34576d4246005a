#include "ui/render/shader_program.h"

#include "core/base/error.h"
#include "ui/render/offscreen_context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::render {
namespace {

using ::testing::HasSubstr;

const std::string good_vertex = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n";
const std::string good_fragment = "#version 330 core\nout vec4 color;\nvoid main() { color = vec4(1.0); }\n";

std::string reason(const std::string& vertex, const std::string& fragment) {
    try {
        const ShaderProgram program(vertex, fragment);
    } catch (const Defect& defect) {
        return defect.what();
    }
    return {};
}

TEST(ShaderProgram, QuotesTheCompilersLog) {
    const OffscreenContext context({4, 4});
    EXPECT_EQ(reason(good_vertex, good_fragment), "");
    EXPECT_THAT(reason(good_vertex, "#version 330 core\nvoid main() { nonsense; }\n"), HasSubstr("nonsense"));
}

TEST(ShaderProgram, QuotesTheLinkersLog) {
    const OffscreenContext context({4, 4});
    const std::string sends = "#version 330 core\nout vec2 sent;\n"
                              "void main() { sent = vec2(1.0); gl_Position = vec4(0.0); }\n";
    const std::string wants = "#version 330 core\nin vec4 sent;\nout vec4 color;\n"
                              "void main() { color = sent; }\n";
    EXPECT_THAT(reason(sends, wants), HasSubstr("sent"));
}

TEST(ShaderSource, PutsIncludedShadersInPlace) {
    const std::string source = shader_source("mesh.frag");
    EXPECT_THAT(source, HasSubstr("vec4 base_color("));
    EXPECT_THAT(source, ::testing::Not(HasSubstr("#include")));
}

TEST(ShaderSource, RefusesANameItDoesNotHave) {
    EXPECT_THROW(static_cast<void>(shader_source("none.frag")), Defect);
}

} // namespace
} // namespace millwright::render
