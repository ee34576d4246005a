// What is asked over everything else, answered by real mouse and keys.
#include "ui/window/dialogs.h"

#include "core/base/files.h"
#include "core/project/project_file.h"
#include "core/project/recovery.h"
#include "tests/support/scratch_folder.h"
#include "tests/ui/person/person.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::panels {
namespace {

using test::dome_project;

namespace fs = std::filesystem;

using test::Person;

/// A copy of the dome in the person's own folder, opened.
fs::path opened_copy(Person& person) {
    const fs::path file = person.folder() / "mine.json";
    fs::copy_file(dome_project, file);
    person.open(file);
    return file;
}

void change(Person& person) {
    person.app().edit("Change the grid", [](project::Project& p) { p.grid.nv = 12; }, {});
    person.frames();
}

void choose_sample(Person& person) {
    person.click("menu/file");
    person.hover(person.place("menu/file/samples").centre());
    person.click("menu/file/samples/sample_sine");
    person.frames();
}

TEST(UnsavedChanges, AreNotAskedAboutWhenThereAreNone) {
    Person person;
    (void)opened_copy(person);
    choose_sample(person);
    EXPECT_FALSE(person.sees("dialogs/unsaved/unsaved_save"));
    EXPECT_EQ(person.app().look().document.file.filename(), "sine.json");
}

TEST(UnsavedChanges, CancelKeepsEverythingAsItIs) {
    Person person;
    const fs::path file = opened_copy(person);
    change(person);
    choose_sample(person);
    person.click("dialogs/unsaved/unsaved_cancel");
    EXPECT_FALSE(person.sees("dialogs/unsaved/unsaved_cancel"));
    EXPECT_EQ(person.app().look().document.file, file);
    EXPECT_EQ(person.project().grid.nv, 12);
    EXPECT_EQ(project::read_project(file).grid.nv, 20);
}

TEST(UnsavedChanges, DiscardGoesOnAndLeavesTheFileAlone) {
    Person person;
    const fs::path file = opened_copy(person);
    change(person);
    choose_sample(person);
    person.click("dialogs/unsaved/unsaved_discard");
    EXPECT_EQ(person.app().look().document.file.filename(), "sine.json");
    EXPECT_EQ(project::read_project(file).grid.nv, 20);
}

TEST(UnsavedChanges, SaveGoesOnOnceTheyAreSaved) {
    Person person;
    const fs::path file = opened_copy(person);
    change(person);
    choose_sample(person);
    person.click("dialogs/unsaved/unsaved_save");
    EXPECT_EQ(person.app().look().document.file.filename(), "sine.json");
    EXPECT_EQ(project::read_project(file).grid.nv, 12);
}

TEST(UnsavedChanges, OfAProjectWithoutAFileAskForOneFirst) {
    Person person;
    change(person);
    person.app().run("file.quit");
    person.frames();
    person.click("dialogs/unsaved/unsaved_save");
    person.frames();
    EXPECT_FALSE(person.app().view_state().quit);
    person.fill_in("dialogs/files/name", (person.folder() / "new.json").string());
    EXPECT_TRUE(person.app().view_state().quit);
    EXPECT_EQ(project::read_project(person.folder() / "new.json").grid.nv, 12);
}

TEST(UnsavedChanges, GivingUpTheFileGivesUpTheLeaving) {
    Person person;
    change(person);
    person.app().run("file.quit");
    person.frames();
    person.click("dialogs/unsaved/unsaved_save");
    person.frames();
    person.press_key(render::Key::escape);
    EXPECT_FALSE(person.app().look().asks());
    EXPECT_FALSE(person.app().view_state().quit);
}

TEST(UnsavedChanges, HoldTheWindowOpenUntilAnswered) {
    Person person;
    person.app().run("file.quit");
    EXPECT_TRUE(person.app().view_state().quit);
    Person other;
    change(other);
    other.press_key(render::Key::q, true);
    EXPECT_FALSE(other.app().view_state().quit);
    other.click("dialogs/unsaved/unsaved_discard");
    EXPECT_TRUE(other.app().view_state().quit);
}

TEST(UnsavedChanges, AFailedSaveEndsTheLeaving) {
    Person person;
    const fs::path file = opened_copy(person);
    change(person);
    choose_sample(person);
    fs::remove(file);
    fs::create_directory(file); // nothing can be written there
    person.click("dialogs/unsaved/unsaved_save");
    EXPECT_EQ(person.app().look().document.file, file);
    EXPECT_EQ(person.project().grid.nv, 12);
    EXPECT_TRUE(person.app().look().changed());
    EXPECT_FALSE(person.app().look().asks());
}

TEST(UndoAcrossFiles, BringsBackTheFileTogetherWithItsProject) {
    Person person;
    const fs::path file = opened_copy(person);
    change(person);
    choose_sample(person);
    person.click("dialogs/unsaved/unsaved_discard");
    person.wait_idle();
    person.press_key(render::Key::z, true);
    const auto now = person.app().look();
    EXPECT_EQ(now.document.file, file);
    EXPECT_EQ(now.project.grid.nv, 12);
    EXPECT_TRUE(now.changed());
    person.press_key(render::Key::y, true);
    EXPECT_EQ(person.app().look().document.file.filename(), "sine.json");
    EXPECT_FALSE(person.app().look().changed());
}

TEST(Dialogs, KeysReachTheMachineAlone) {
    Person person;
    person.open(dome_project);
    person.app().view_state().machine_speed = 1.0;
    person.app().run("view.machine");
    person.press_key(render::Key::f9);
    person.frames(3);
    ASSERT_TRUE(person.app().look().job.running);
    person.press_key(render::Key::o, true);
    ASSERT_TRUE(person.sees("dialogs/files/entries"));
    person.press_key(render::Key::f3);
    EXPECT_EQ(person.app().view_state().workspace, actions::Workspace::machine);
    person.click("emergency/machine_emergency_stop");
    person.app().wait_idle();
    const actions::JobView job = person.app().look().job;
    EXPECT_TRUE(job.failure || (job.outcome && job.outcome->end == jobs::JobEnd::fault));
}

/// A copy as a program that crashed leaves it.
void leave_behind(const fs::path& folder, const fs::path& file) {
    project::UnsavedWork work{project::read_project(dome_project), file, 1'000'000};
    work.project.grid.nu = 33;
    write_file(folder / "1.json", project::recovery_text(work));
}

bool is_empty_of_copies(const fs::path& folder) {
    const fs::directory_iterator entries(folder);
    return std::none_of(
        begin(entries), end(entries), [](const auto& entry) { return entry.path().extension() == ".json"; });
}

TEST(RecoveryDialog, RecoverGoesOnWithTheUnsavedWork) {
    const test::ScratchFolder scratch;
    leave_behind(scratch.path(), fs::absolute(dome_project));
    Person person({1280, 800}, scratch.path());
    ASSERT_TRUE(person.sees("dialogs/recovery/recovery_recover"));
    person.click("dialogs/recovery/recovery_recover");
    const auto now = person.app().look();
    EXPECT_EQ(now.project.grid.nu, 33);
    EXPECT_EQ(now.document.file, fs::absolute(dome_project));
    EXPECT_TRUE(now.changed());
    EXPECT_FALSE(now.asks());
    EXPECT_FALSE(is_empty_of_copies(scratch.path())) << "it is still unsaved";
    person.app().close();
    EXPECT_TRUE(is_empty_of_copies(scratch.path()));
}

TEST(RecoveryDialog, FilesFromOutsideWaitForTheAnswer) {
    const test::ScratchFolder scratch;
    leave_behind(scratch.path(), fs::absolute(dome_project));
    Person person({1280, 800}, scratch.path());
    person.app().receive({fs::absolute("assets/samples/plot/moves.plt")});
    person.frames();
    EXPECT_TRUE(person.project().plot.file.empty()) << "opened behind the question";
    EXPECT_EQ(person.app().view_state().log.back(), "moves.plt will be opened after you answer the prompt.");
    person.click("dialogs/recovery/recovery_recover");
    person.wait_idle();
    EXPECT_EQ(person.project().grid.nu, 33);
    EXPECT_EQ(person.project().plot.file.filename(), "moves.plt");
    EXPECT_EQ(person.app().view_state().workspace, actions::Workspace::plot);
}

TEST(ReceivedFiles, OfSeveralTheOneThatIsOpenedIsNamed) {
    Person person;
    person.app().receive({fs::absolute("assets/samples/plot/moves.plt"),
                          fs::absolute("assets/samples/plot/figures.plt"),
                          fs::absolute(dome_project)});
    person.wait_idle();
    EXPECT_EQ(person.project().plot.file.filename(), "moves.plt");
    const auto& log = person.app().view_state().log;
    EXPECT_EQ(log.back(), "Only one file can be opened at a time. Of these 3, Millwright opens moves.plt.");
}

TEST(ReceivedFiles, WaitBehindAQuestionAboutUnsavedChangesAndAskTheirOwn) {
    Person person;
    (void)opened_copy(person);
    change(person);
    choose_sample(person);
    person.app().receive({fs::absolute(dome_project)});
    person.frames();
    person.click("dialogs/unsaved/unsaved_cancel");
    person.frames();
    ASSERT_TRUE(person.sees("dialogs/unsaved/unsaved_discard")) << "now about the dome";
    EXPECT_EQ(person.app().look().leaving_to, "open dome.json");
    person.click("dialogs/unsaved/unsaved_discard");
    EXPECT_EQ(person.app().look().document.file, fs::absolute(dome_project));
}

TEST(RecoveryDialog, DiscardRemovesTheCopy) {
    const test::ScratchFolder scratch;
    leave_behind(scratch.path(), {});
    Person person({1280, 800}, scratch.path());
    person.click("dialogs/recovery/recovery_discard");
    EXPECT_FALSE(person.app().look().asks());
    EXPECT_TRUE(is_empty_of_copies(scratch.path()));
    EXPECT_EQ(person.project().grid.nu, test::small_sample().grid.nu);
}

TEST(RecoveryDialog, LaterAsksAgainAtTheNextStart) {
    const test::ScratchFolder scratch;
    leave_behind(scratch.path(), {});
    {
        Person person({1280, 800}, scratch.path());
        person.click("dialogs/recovery/recovery_later");
        EXPECT_FALSE(person.app().look().asks());
        person.app().close();
    }
    Person next({1280, 800}, scratch.path());
    EXPECT_TRUE(next.sees("dialogs/recovery/recovery_recover"));
}

TEST(RecoveryDialog, ABrokenCopyCannotBeRecoveredAndSaysWhy) {
    const test::ScratchFolder scratch;
    write_file(scratch / "1.json", "{ \"format\": ");
    Person person({1280, 800}, scratch.path());
    person.click("dialogs/recovery/recovery_recover");
    EXPECT_TRUE(person.app().look().asks());
    const auto* seen = person.desktop().ui().places().find("dialogs/recovery/recovery_recover");
    ASSERT_NE(seen, nullptr);
    EXPECT_EQ(seen->reason, "The copy cannot be read.");
    person.click("dialogs/recovery/recovery_discard");
    EXPECT_TRUE(is_empty_of_copies(scratch.path()));
}

TEST(RecoveryDialog, UnsavedWorkSurvivesAProgramThatEndsBadly) {
    const test::ScratchFolder scratch;
    {
        Person person({1280, 800}, scratch.path());
        change(person);
    } // without close()
    Person next({1280, 800}, scratch.path());
    next.click("dialogs/recovery/recovery_recover");
    EXPECT_EQ(next.project().grid.nv, 12);
}

/// 6 x 6 nodes are so few that a ball goes 2 mm below the dome between them.
void cut_with_a_ball(Person& person) {
    person.app().edit("Choose a tool",
                      [](project::Project& p) {
                          p.tool.cutter = toolpath::CutterKind::ball;
                          p.tool.diameter_mm = 6.0;
                      },
                      {});
    person.wait_idle();
}

// Ctrl+E wrote it without a word.
TEST(Gouges, AreAskedAboutBeforeTheProgramIsWritten) {
    Person person;
    cut_with_a_ball(person);
    ASSERT_FALSE(person.app().look().gouge_warning().empty());
    person.press_key(render::Key::e, true);
    person.frames(3);
    ASSERT_TRUE(person.sees("dialogs/gouges/gouges_write"));
    EXPECT_FALSE(person.sees("dialogs/files/name"));
    person.keep("gouges-asked");
    person.press_key(render::Key::escape);
    EXPECT_FALSE(person.app().look().asks());
    person.press_key(render::Key::e, true);
    person.frames(3);
    person.click("dialogs/gouges/gouges_write");
    person.frames(3);
    ASSERT_TRUE(person.sees("dialogs/files/name"));
    const fs::path file = person.folder() / "gouging.ngc";
    person.fill_in("dialogs/files/name", file.string());
    person.frames(2);
    EXPECT_TRUE(fs::exists(file));
}

TEST(Gouges, AreShownInPlaceOfWriting) {
    Person person;
    cut_with_a_ball(person);
    person.press_key(render::Key::e, true);
    person.frames(3);
    person.click("dialogs/gouges/gouges_show");
    person.frames(3);
    EXPECT_FALSE(person.app().look().asks());
    EXPECT_EQ(person.app().view_state().workspace, actions::Workspace::toolpath);
    EXPECT_EQ(person.app().view_state().lower_tab_now(), actions::LowerTab::gouges);
}

TEST(Gouges, OfAPointAreNone) {
    Person person;
    person.press_key(render::Key::e, true);
    person.frames(3);
    EXPECT_FALSE(person.sees("dialogs/gouges/gouges_write"));
    EXPECT_TRUE(person.sees("dialogs/files/name"));
}

} // namespace
} // namespace millwright::panels
