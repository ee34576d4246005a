#include "core/project/autosave.h"

#include "core/base/files.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>

namespace millwright::project {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::hours for_ever{24};

UnsavedWork unsaved_dome(int nodes) {
    UnsavedWork result{project_from_preset("dome"), "/part.json", 7};
    result.project.grid.nu = nodes;
    return result;
}

int copies_in(const fs::path& folder) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        count += entry.path().extension() == ".json" ? 1 : 0;
    }
    return count;
}

TEST(Autosave, TheLastStateIsFoundAfterTheProgramWasKilled) {
    const test::ScratchFolder scratch;
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        Autosave autosave(scratch.path(), for_ever);
        for (int nodes = 10; nodes <= 30; ++nodes) {
            autosave.keep(unsaved_dome(nodes));
        }
        autosave.wait_idle();
        (void)::raise(SIGKILL);
        std::_Exit(1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    const auto found = left_behind(scratch.path());
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found.front().work(), unsaved_dome(30));
}

TEST(Autosave, NothingStaysBehindWhenNothingIsUnsaved) {
    const test::ScratchFolder scratch;
    Autosave autosave(scratch.path(), for_ever);
    autosave.keep(unsaved_dome(10));
    autosave.wait_idle();
    EXPECT_EQ(copies_in(scratch.path()), 1);
    autosave.keep(unsaved_dome(11));
    autosave.drop();
    autosave.wait_idle();
    EXPECT_EQ(copies_in(scratch.path()), 0);
}

TEST(Autosave, WritesWhatIsStillToBeWrittenWhenItEnds) {
    const test::ScratchFolder scratch;
    {
        Autosave autosave(scratch.path(), for_ever);
        autosave.keep(unsaved_dome(10));
        autosave.wait_idle();
        autosave.keep(unsaved_dome(11));
    }
    const auto found = left_behind(scratch.path());
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found.front().work(), unsaved_dome(11));
}

TEST(Autosave, TellsOnceWhyItCannotWrite) {
    const test::ScratchFolder scratch;
    Autosave autosave(scratch / "recovery", for_ever);
    fs::remove_all(scratch / "recovery");
    autosave.keep(unsaved_dome(10));
    autosave.wait_idle();
    const auto failure = autosave.take_failure();
    ASSERT_TRUE(failure.has_value());
    EXPECT_EQ(failure->place.file.parent_path(), scratch / "recovery");
    EXPECT_FALSE(autosave.take_failure().has_value());
}

} // namespace
} // namespace millwright::project
