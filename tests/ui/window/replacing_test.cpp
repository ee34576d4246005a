// Files that another program, or another window, has written meanwhile; and which of several questions is
// asked.
#include "core/base/files.h"
#include "core/project/project_file.h"
#include "tests/ui/person/person.h"
#include "ui/window/dialogs.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace millwright::panels {
namespace {

namespace fs = std::filesystem;

using render::Key;
using test::Person;

/// A copy of the dome in the person's own folder, opened.
fs::path opened_dome(Person& person) {
    const fs::path file = person.folder() / "mine.json";
    fs::copy_file(test::dome_project, file);
    person.open(file);
    return file;
}

void set_nv(Person& person, int nv) {
    person.app().edit("Change the grid", [&](project::Project& p) { p.grid.nv = nv; }, {});
    person.frames();
}

/// What another program does.
void write_nu_elsewhere(const fs::path& file, int nu) {
    project::Project other = project::read_project(file);
    other.grid.nu = nu;
    (void)project::write_project(other, file);
}

TEST(ChangedOnDisk, AProjectIsNotOverwrittenWithoutAQuestion) {
    Person person;
    const fs::path file = opened_dome(person);
    set_nv(person, 12);
    write_nu_elsewhere(file, 9);
    person.press_key(Key::s, true);
    ASSERT_TRUE(person.sees("dialogs/replace/replace_overwrite"));
    person.keep("changed-on-disk");
    EXPECT_EQ(project::read_project(file).grid.nu, 9);
    person.press_key(Key::escape);
    EXPECT_FALSE(person.app().look().asks());
    EXPECT_EQ(project::read_project(file).grid.nu, 9);
    EXPECT_TRUE(person.app().look().changed());
    person.press_key(Key::s, true);
    person.click("dialogs/replace/replace_overwrite");
    EXPECT_EQ(project::read_project(file).grid.nv, 12);
    EXPECT_EQ(project::read_project(file).grid.nu, 20);
    EXPECT_FALSE(person.app().look().changed());
    set_nv(person, 13);
    person.press_key(Key::s, true); // its own file again
    EXPECT_FALSE(person.app().look().asks());
    EXPECT_EQ(project::read_project(file).grid.nv, 13);
}

TEST(ChangedOnDisk, IsReloadedAndUndoneAgain) {
    Person person;
    const fs::path file = opened_dome(person);
    set_nv(person, 12);
    write_nu_elsewhere(file, 9);
    person.press_key(Key::s, true);
    person.click("dialogs/replace/replace_reload");
    EXPECT_EQ(person.project().grid.nu, 9);
    EXPECT_EQ(person.project().grid.nv, 20);
    EXPECT_FALSE(person.app().look().changed());
    person.press_key(Key::z, true);
    EXPECT_EQ(person.project().grid.nv, 12);
}

TEST(ChangedOnDisk, CanBeSavedElsewhere) {
    Person person;
    const fs::path file = opened_dome(person);
    set_nv(person, 12);
    write_nu_elsewhere(file, 9);
    person.press_key(Key::s, true);
    person.click("dialogs/replace/replace_elsewhere");
    person.frames();
    person.fill_in("dialogs/files/name", (person.folder() / "new.json").string());
    EXPECT_EQ(project::read_project(person.folder() / "new.json").grid.nv, 12);
    EXPECT_EQ(project::read_project(file).grid.nu, 9);
}

TEST(ChangedOnDisk, HoldsBackTheLeavingUntilItIsAnswered) {
    Person person;
    const fs::path file = opened_dome(person);
    set_nv(person, 12);
    write_nu_elsewhere(file, 9);
    person.app().run("file.quit");
    person.frames();
    person.click("dialogs/unsaved/unsaved_save");
    EXPECT_FALSE(person.app().view_state().quit);
    ASSERT_TRUE(person.sees("dialogs/replace/replace_overwrite"));
    person.press_key(Key::escape);
    EXPECT_FALSE(person.app().look().asks());
    person.app().run("file.quit");
    person.frames();
    person.click("dialogs/unsaved/unsaved_save");
    person.frames();
    person.click("dialogs/replace/replace_overwrite");
    EXPECT_TRUE(person.app().view_state().quit);
    EXPECT_EQ(project::read_project(file).grid.nv, 12);
}

TEST(ChangedOnDisk, ByAnotherWindow) {
    Person first;
    Person second;
    const fs::path file = opened_dome(first);
    second.open(file);
    set_nv(first, 12);
    set_nv(second, 13);
    first.press_key(Key::s, true);
    EXPECT_FALSE(first.app().look().asks());
    second.press_key(Key::s, true);
    EXPECT_TRUE(second.sees("dialogs/replace/replace_overwrite"));
    EXPECT_EQ(project::read_project(file).grid.nv, 12);
}

TEST(ChangedOnDisk, AFileThatIsGoneIsWrittenAgain) {
    Person person;
    const fs::path file = opened_dome(person);
    set_nv(person, 12);
    fs::remove(file);
    person.press_key(Key::s, true);
    EXPECT_FALSE(person.app().look().asks());
    EXPECT_EQ(project::read_project(file).grid.nv, 12);
}

TEST(WrittenProgram, AsksForItsFileTheFirstTime) {
    Person person;
    (void)opened_dome(person);
    const fs::path beside = person.folder() / "mine.ngc";
    write_file(beside, "not Millwright's");
    person.press_key(Key::e, true);
    person.frames();
    EXPECT_EQ(read_file(beside), "not Millwright's");
    ASSERT_TRUE(person.sees("dialogs/files/replace")) << "the name is that of the project, and taken";
    const fs::path own = person.folder() / "own.ngc";
    person.fill_in("dialogs/files/name", own.string());
    ASSERT_TRUE(fs::exists(own));
    EXPECT_EQ(person.app().view_state().log.back(), own.string() + ": G-code written.");
    const std::string first = read_file(own);
    set_nv(person, 12);
    person.wait_idle();
    person.press_key(Key::e, true);
    EXPECT_FALSE(person.app().look().asks());
    EXPECT_NE(read_file(own), first) << "the same file, without a question";
}

TEST(WrittenProgram, ThatAPersonHasEditedIsNotReplacedWithoutAQuestion) {
    Person person;
    (void)opened_dome(person);
    const fs::path file = person.folder() / "own.ngc";
    person.press_key(Key::e, true);
    person.frames();
    person.fill_in("dialogs/files/name", file.string());
    write_file(file, "G21 (by hand)\n");
    person.press_key(Key::e, true);
    ASSERT_TRUE(person.sees("dialogs/replace/replace_overwrite"));
    EXPECT_FALSE(person.sees("dialogs/replace/replace_reload"));
    person.click("dialogs/replace/replace_cancel");
    EXPECT_EQ(read_file(file), "G21 (by hand)\n");
    person.press_key(Key::e, true);
    person.click("dialogs/replace/replace_overwrite");
    EXPECT_NE(read_file(file), "G21 (by hand)\n");
}

/// The dialogs that are seen now.
std::vector<std::string> seen_dialogs(Person& person) {
    std::vector<std::string> seen;
    for (const char* const dialog : {"files/cancel",
                                     "unsaved/unsaved_cancel",
                                     "replace/replace_cancel",
                                     "gouges/gouges_cancel",
                                     "running_job/running_job_stay",
                                     "help/close"}) {
        if (person.sees("dialogs/" + std::string(dialog))) {
            seen.emplace_back(dialog);
        }
    }
    return seen;
}

struct Step {
    const char* name;
    std::function<void(Person&)> take;
};

/// What a person can do, in any order.
std::vector<Step> all_steps() {
    return {{"open", [](Person& p) { p.press_key(Key::o, true); }},
            {"open another",
             [](Person& p) {
                 p.press_key(Key::o, true);
                 p.frames(2);
                 if (p.sees("dialogs/files/open")) { // not behind another question
                     p.fill_in("dialogs/files/path", (p.folder() / "other.json").string());
                 }
             }},
            {"save as", [](Person& p) { p.press_key(Key::s, true, true); }},
            {"save", [](Person& p) { p.press_key(Key::s, true); }},
            {"write", [](Person& p) { p.press_key(Key::e, true); }},
            {"close", [](Person& p) { p.app().run("file.quit"); }},
            {"drop", [](Person& p) { p.app().receive({p.folder() / "other.json"}); }},
            {"search", [](Person& p) { p.press_key(Key::k, true); }},
            {"help", [](Person& p) { p.press_key(Key::f1); }}};
}

TEST(OrderOfQuestions, WhateverIsAskedIsSeenAloneAndEscapeLeavesEverything) {
    Person person;
    const fs::path file = opened_dome(person);
    fs::copy_file("assets/projects/two-bell.json", person.folder() / "other.json");
    set_nv(person, 12);
    write_nu_elsewhere(file, 9); // so that saving asks, too
    person.wait_idle();
    const std::vector<Step> steps = all_steps();
    for (const Step& first : steps) {
        for (const Step& second : steps) {
            const std::string order = std::string(first.name) + ", " + second.name;
            for (const Step* const step : {&first, &second}) {
                step->take(person);
                person.frames(3);
                const auto seen = seen_dialogs(person);
                ASSERT_EQ(seen.size(), person.app().look().asks() ? 1U : 0U)
                    << order << ", after " << step->name << (seen.empty() ? "" : ": " + seen.front());
                ASSERT_FALSE(person.sees("search") && !seen.empty()) << order;
            }
            for (int n = 0; n < 8 && (person.app().look().asks() || person.sees("search")); ++n) {
                person.press_key(Key::escape);
                person.frames(2);
            }
            ASSERT_FALSE(person.app().look().asks()) << order;
            ASSERT_FALSE(person.app().view_state().quit) << order;
            ASSERT_EQ(person.project().grid.nv, 12) << order;
            ASSERT_EQ(project::read_project(file).grid.nu, 9) << order;
        }
    }
}

TEST(OrderOfQuestions, AnotherProjectCanBeOpenedWithUnsavedChanges) {
    Person person;
    (void)opened_dome(person);
    fs::copy_file("assets/projects/two-bell.json", person.folder() / "other.json");
    set_nv(person, 12);
    person.press_key(Key::o, true);
    person.click("dialogs/files/entries/other.json");
    person.click("dialogs/files/open");
    person.frames();
    ASSERT_TRUE(person.sees("dialogs/unsaved/unsaved_discard"));
    person.click("dialogs/unsaved/unsaved_discard");
    EXPECT_EQ(person.app().look().document.file.filename(), "other.json");
}

TEST(OrderOfQuestions, AJobThatRunsIsAskedAboutOverTheFileDialog) {
    Person person;
    (void)opened_dome(person);
    person.app().view_state().machine_speed = 1.0;
    person.app().view_state().workspace = actions::Workspace::machine;
    person.app().run("machine.run");
    person.frames(3);
    ASSERT_TRUE(person.app().look().job.running);
    person.press_key(Key::o, true);
    person.app().run("file.quit"); // the window's own button
    person.frames();
    EXPECT_TRUE(person.sees("dialogs/running_job/running_job_stop"));
    person.press_key(Key::escape);
    EXPECT_TRUE(person.sees("dialogs/files/cancel"));
    person.press_key(Key::escape);
    EXPECT_FALSE(person.app().look().asks());
    person.app().jobs().stop();
    person.app().wait_idle();
}

} // namespace
} // namespace millwright::panels
