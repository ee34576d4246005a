#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;

/// A number of the PNG's header, which begins at byte 16 with width and height, most significant byte first.
unsigned header_number(const std::string& png, std::size_t at) {
    unsigned value = 0;
    for (std::size_t n = at; n < at + 4; ++n) {
        value = 256 * value + static_cast<unsigned char>(png.at(n));
    }
    return value;
}

TEST(RenderCommand, DrawsEveryViewWithoutADisplay) {
    const ScratchFolder scratch;
    const auto project = small_project(scratch.path(), "dome");
    std::set<std::string> pictures;
    for (const std::string view : {"design", "grid", "toolpath", "error", "machine", "produced"}) {
        const auto file = scratch / (view + ".png");
        const Ended ended = run({"render", project, "--view", view, "--size", "320x200", "--out", file});
        ASSERT_EQ(ended.exit_code, 0) << ended.err;
        const std::string png = content_of(file);
        EXPECT_EQ(header_number(png, 16), 320u) << view;
        EXPECT_EQ(header_number(png, 20), 200u) << view;
        EXPECT_TRUE(pictures.insert(png).second) << view << " looks like another view";
    }
}

// A machine file that was copied alone could not be drawn.
TEST(RenderCommand, DrawsAMachineWhoseFileOfBodiesIsMissingByItsSimpleBodies) {
    const ScratchFolder scratch;
    write_content(scratch / "own.json", content_of("assets/machines/rotary-tilt-listing.json"));
    const auto project = small_project(scratch.path(), "dome", "\"rotary-tilt-listing\"", "\"own.json\"");
    const auto file = scratch / "machine.png";
    const Ended alone = run({"render", project, "--view", "machine", "--size", "320x200", "--out", file});
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    EXPECT_THAT(alone.err, HasSubstr("rotary-tilt-listing.glb: there is no such file"));
    const std::string simple_bodies = content_of(file);
    const Ended made =
        run({"machine", "bodies", scratch / "own.json", "--out", scratch / "rotary-tilt-listing.glb"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Ended whole = run({"render", project, "--view", "machine", "--size", "320x200", "--out", file});
    EXPECT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_NE(content_of(file), simple_bodies);
    write_content(scratch / "rotary-tilt-listing.glb", "no bodies");
    EXPECT_EQ(run({"render", project, "--view", "machine", "--size", "320x200", "--out", file}).exit_code, 1);
}

TEST(RenderCommand, DrawsFromOtherSidesInOtherColours) {
    const ScratchFolder scratch;
    const auto project = small_project(scratch.path(), "dome");
    std::set<std::string> pictures;
    for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
             {},
             {"--side", "oblique"},
             {"--side", "top"},
             {"--color", "background=#ffffff", "--color", "surface=#C02020"}}) {
        std::vector<std::string> words{
            "render", project, "--view", "design", "--size", "320x200", "--out", scratch / "o.png"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        ASSERT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_TRUE(pictures.insert(content_of(scratch / "o.png")).second);
    }
    const Ended wrong =
        run({"render", project, "--view", "design", "--color", "sky=#ffffff", "--out", scratch / "o.png"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.err, HasSubstr("the IDs are background, surface,"));
    EXPECT_EQ(
        run({"render", project, "--view", "design", "--color", "grid_u=red", "--out", scratch / "o.png"})
            .exit_code,
        2);
}

TEST(RenderCommand, RefusesAProducedSurfaceThatThePathDoesNotHave) {
    const ScratchFolder scratch;
    for (const auto& [member, reason] :
         {std::pair(R"("toolpath": {"strategy": "spiral"},)", "needs parallel tracks"),
          {R"("tool": {"cutter": "ball", "diameter_mm": 6, "length_mm": 30},)", "needs a point tool"}}) {
        const auto project =
            small_project(scratch.path(), "dome", "\"surface\":", std::string(member) + "\"surface\":");
        const Ended ended = run(
            {"render", project, "--view", "produced", "--size", "320x200", "--out", scratch / "none.png"});
        EXPECT_EQ(ended.exit_code, 1) << member;
        EXPECT_THAT(ended.err, HasSubstr(reason));
        EXPECT_FALSE(std::filesystem::exists(scratch / "none.png")) << "an empty picture says nothing";
    }
}

TEST(RenderCommand, FailsWithoutTouchingWhatIsThere) {
    const ScratchFolder scratch;
    write_content(scratch / "old.png", "old");
    const Ended broken = run({"render", "no.json", "--view", "grid", "--out", scratch / "old.png"});
    EXPECT_EQ(broken.exit_code, 1);
    EXPECT_EQ(content_of(scratch / "old.png"), "old");
    const auto project = small_project(scratch.path(), "dome");
    const Ended unwritable =
        run({"render", project, "--view", "grid", "--size", "64x64", "--out", scratch / "dome.json/x.png"});
    EXPECT_EQ(unwritable.exit_code, 1);
    EXPECT_THAT(unwritable.err, HasSubstr("dome.json/x.png: cannot write"));
}

} // namespace
} // namespace millwright::test
