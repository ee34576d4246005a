// Files as a person chooses and names them: real mouse and keys, real files.
#include "ui/window/file_panel.h"

#include "core/base/files.h"
#include "core/project/project_file.h"
#include "core/project/recent_files.h"
#include "tests/ui/person/person.h"
#include "ui/window/file_prompt.h"
#include "ui/window/folder_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace millwright::panels {
namespace {

namespace fs = std::filesystem;

using test::Person;

/// A copy of the dome, mine.json, is open; it lies in the person's own folder.
class FileDialog : public testing::Test {
protected:
    FileDialog() {
        fs::copy_file("assets/projects/dome.json", person_.folder() / "mine.json");
        person_.open(person_.folder() / "mine.json");
    }

    void write(const std::string& name, const std::string& text) {
        write_file(person_.folder() / name, text);
    }
    [[nodiscard]] std::string text_of(const std::string& name) { return read_file(person_.folder() / name); }
    /// Into the name, without leaving it.
    void type_name(const std::string& name) {
        person_.click("dialogs/files/name");
        person_.press_key(render::Key::a, true);
        person_.type(name);
        person_.frames();
    }
    /// The button of the dialog that writes.
    [[nodiscard]] std::string button() {
        return person_.sees("dialogs/files/replace") ? "replace"
               : person_.sees("dialogs/files/save")  ? "save"
                                                     : "";
    }
    /// The mouse goes down and up where it is.
    void press() {
        person_.hold_button(true);
        person_.frames();
        person_.hold_button(false);
        person_.frames();
    }

    Person person_;
};

TEST_F(FileDialog, OpensWhatIsClickedTwiceAndShowsItBefore) {
    fs::copy_file("assets/projects/two-bell.json", person_.folder() / "bells.json");
    person_.press_key(render::Key::o, true);
    const render::Picture before = person_.picture_of("dialogs/files/picture");
    person_.click("dialogs/files/entries/bells.json");
    EXPECT_NE(before, person_.picture_of("dialogs/files/picture"));
    EXPECT_EQ(person_.app().look().document.file.filename(), "mine.json");
    person_.click("dialogs/files/entries/bells.json");
    person_.frames();
    EXPECT_EQ(person_.app().look().document.file.filename(), "bells.json");
    EXPECT_FALSE(person_.sees("dialogs/files/entries"));
}

TEST_F(FileDialog, KeepsItsRowsInPlaceWhateverIsClicked) {
    write_file(person_.folder() / "square.ngc", "G21 G90\nG1 F600 X10\nM2\n");
    person_.press_key(render::Key::o, true);
    person_.frames(2);
    const std::string row = "dialogs/files/entries/square.ngc";
    const float before = person_.place(row).y;
    person_.click(row);
    person_.frames(2);
    EXPECT_EQ(person_.place(row).y, before) << "the second click of two would miss it";
    person_.keep("file-dialog-gcode");
    person_.click(row);
    person_.frames(2);
    EXPECT_FALSE(person_.sees("dialogs/files/entries"));
    ASSERT_TRUE(person_.app().look().opened);
    EXPECT_EQ(person_.app().look().opened->file.filename(), "square.ngc");
}

// The second click of a double click entered the folder that had come under the mouse: one too deep.
TEST_F(FileDialog, ADoubleClickEntersOneFolder) {
    fs::create_directories(person_.folder() / "deep" / "deeper" / "deepest");
    person_.press_key(render::Key::o, true);
    person_.frames(2);
    const widgets::Point at = person_.place("dialogs/files/entries/deep").centre();
    person_.click_at(at);
    EXPECT_TRUE(person_.sees("dialogs/files/entries/mine.json")) << "a single click chooses";
    press();
    person_.frames(2);
    EXPECT_TRUE(person_.sees("dialogs/files/entries/deeper"));
    press(); // chooses, as the first of two
    person_.frames(2);
    EXPECT_TRUE(person_.sees("dialogs/files/entries/deeper"));
    person_.press_key(render::Key::enter); // enters what is chosen
    person_.frames(2);
    EXPECT_TRUE(person_.sees("dialogs/files/entries/deepest"));
}

TEST_F(FileDialog, BeginsWhereAFileWasLastOpened) {
    fs::create_directories(person_.folder() / "nc");
    write("nc/square.ngc", "G21 G90\nG1 F600 X10\nM2\n");
    person_.press_key(render::Key::o, true);
    person_.frames(2);
    person_.fill_in("dialogs/files/path", (person_.folder() / "nc").string());
    person_.click("dialogs/files/entries/square.ngc");
    person_.click("dialogs/files/open");
    person_.frames(3);
    EXPECT_FALSE(person_.sees("dialogs/files/entries"));
    person_.press_key(render::Key::o, true);
    person_.frames(2);
    EXPECT_TRUE(person_.sees("dialogs/files/entries/square.ngc"));
    person_.press_key(render::Key::escape);
    person_.press_key(render::Key::s, true, true); // a project is saved where it lies
    person_.frames(2);
    EXPECT_TRUE(person_.sees("dialogs/files/entries/mine.json"));
}

TEST_F(FileDialog, GoesToPlacesAndShowsOneKindOfFile) {
    write("square.ngc", "G21 G90\nG1 F600 X10\nM2\n");
    write("notes.odt", "no file of ours");
    person_.press_key(render::Key::o, true);
    person_.frames(2);
    const std::string entries = "dialogs/files/entries/";
    EXPECT_TRUE(person_.sees(entries + "mine.json"));
    EXPECT_TRUE(person_.sees(entries + "square.ngc"));
    EXPECT_FALSE(person_.sees(entries + "notes.odt"));
    person_.choose("dialogs/files/filter", "gcode");
    EXPECT_FALSE(person_.sees(entries + "mine.json"));
    EXPECT_TRUE(person_.sees(entries + "square.ngc"));
    person_.choose("dialogs/files/filter", "all");
    EXPECT_TRUE(person_.sees(entries + "notes.odt"));
    person_.keep("file-dialog-places");
    const std::vector<FilePlace> places = places_of(person_.app().look());
    const auto samples = std::ranges::find(places, "Samples: projects", &FilePlace::label);
    ASSERT_NE(samples, places.end());
    person_.choose("dialogs/files/filter", "known");
    person_.choose("dialogs/files/places", "place" + std::to_string(samples - places.begin()));
    EXPECT_TRUE(person_.sees(entries + "dome.json"));
}

/// The folder of the window's own files is a place like any other.
TEST_F(FileDialog, TakesNoFileOfTheWindowsOwnForAProject) {
    project::write_recent({person_.folder() / "mine.json"}, person_.folder() / "recent.json");
    person_.press_key(render::Key::o, true);
    person_.frames(2);
    const std::string entries = "dialogs/files/entries/";
    EXPECT_TRUE(person_.sees(entries + "mine.json"));
    EXPECT_FALSE(person_.sees(entries + "recent.json"));
    person_.choose("dialogs/files/filter", "projects");
    EXPECT_TRUE(person_.sees(entries + "mine.json"));
    EXPECT_FALSE(person_.sees(entries + "recent.json"));
    person_.choose("dialogs/files/filter", "all");
    EXPECT_TRUE(person_.sees(entries + "recent.json"));
    person_.keep("file-dialog-own-files");
    EXPECT_EQ(file_kind(person_.folder() / "recent.json"), "recent files");
}

TEST(FolderView, SizesAreShort) {
    EXPECT_EQ(size_text(0), "0 bytes");
    EXPECT_EQ(size_text(999), "999 bytes");
    EXPECT_EQ(size_text(1000), "1.0 kB");
    EXPECT_EQ(size_text(14'300), "14 kB");
    EXPECT_EQ(size_text(2'340'000), "2.3 MB");
    EXPECT_EQ(size_text(5'000'000'000), "5.0 GB");
    EXPECT_EQ(size_text(5'000'000'000'000), "5000 GB");
}

TEST(FolderView, ListsArmsAloneWhereAnArmIsAskedFor) {
    const auto& asked = about(actions::FilePrompt::open_arm);
    const FileFilter& known = filters_of(asked.prompt)[0];
    const FolderListing arms = listed("assets/arms", asked, known);
    EXPECT_FALSE(arms.entries.empty());
    EXPECT_TRUE(std::ranges::all_of(
        arms.entries, [](const FolderEntry& entry) { return entry.is_folder || entry.kind == "arm"; }));
    const FolderListing machines = listed("assets/machines", asked, known);
    EXPECT_TRUE(std::ranges::all_of(machines.entries, &FolderEntry::is_folder));
}

TEST(FolderView, EntriesHaveKindSizeAndDate) {
    const FolderEntry dome = entry_of("assets/projects/dome.json");
    EXPECT_FALSE(dome.is_folder);
    EXPECT_EQ(dome.bytes, fs::file_size("assets/projects/dome.json"));
    EXPECT_GT(dome.changed_s, 0);
    EXPECT_EQ(file_kind(dome.path), "project");
    EXPECT_TRUE(entry_of("assets").is_folder);
    EXPECT_EQ(entry_of("nowhere/at/all").changed_s, -1);
    const FolderListing none =
        listed("nowhere/at/all", about(actions::FilePrompt::open), filters_of(actions::FilePrompt::open)[0]);
    EXPECT_NE(none.fault, "");
}

TEST_F(FileDialog, TakesAPlaceThatIsTyped) {
    fs::create_directory(person_.folder() / "deep");
    fs::copy_file("assets/projects/two-bell.json", person_.folder() / "deep" / "bells.json");
    person_.press_key(render::Key::o, true);
    person_.frames(2);
    person_.fill_in("dialogs/files/path", (person_.folder() / "deep").string());
    person_.frames(2);
    EXPECT_TRUE(person_.sees("dialogs/files/entries/bells.json"));
    person_.fill_in("dialogs/files/path", (person_.folder() / "nowhere").string());
    person_.frames(2);
    EXPECT_FALSE(person_.sees("dialogs/files/entries/bells.json"));
    person_.fill_in("dialogs/files/path", (person_.folder() / "deep" / "bells.json").string());
    person_.frames(2);
    EXPECT_FALSE(person_.sees("dialogs/files/entries"));
    EXPECT_EQ(person_.app().look().document.file.filename(), "bells.json");
}

TEST_F(FileDialog, DoesNotReplaceAFileWithoutSayingSo) {
    write_file(person_.folder() / "other.json", "not mine");
    person_.press_key(render::Key::s, true, true);
    person_.fill_in("dialogs/files/name", "other");
    person_.frames();
    EXPECT_EQ(read_file(person_.folder() / "other.json"), "not mine");
    person_.press_key(render::Key::escape);
    person_.press_key(render::Key::escape);
    EXPECT_FALSE(person_.app().look().asks());
    EXPECT_EQ(read_file(person_.folder() / "other.json"), "not mine");
}

TEST_F(FileDialog, SaysThatAFileWouldBeReplacedWhileItsNameIsTyped) {
    write("other.json", "not mine");
    person_.press_key(render::Key::s, true, true);
    EXPECT_EQ(button(), "save") << "it is the project's own file";
    type_name("other.json");
    person_.keep("save-dialog-typed-replaces");
    EXPECT_EQ(button(), "replace");
    type_name("another.json");
    EXPECT_EQ(button(), "save");
    type_name("other");
    EXPECT_EQ(button(), "replace");
    person_.click("dialogs/files/replace");
    EXPECT_EQ(project::read_project(person_.folder() / "other.json"), person_.project());
}

TEST_F(FileDialog, NamesTheFileThatAnExportReplacesWhileItIsTyped) {
    write("surface.step", "the first");
    write("w.glb", "the third");
    person_.app().run("file.export");
    person_.frames();
    EXPECT_EQ(button(), "replace") << "surface.step, as it is asked for";
    type_name("zz.glb");
    EXPECT_EQ(button(), "save");
    person_.keep("export-dialog-typed-new");
    type_name("w.glb");
    EXPECT_EQ(button(), "replace");
    person_.keep("export-dialog-typed-replaces");
    type_name("zz.glb");
    person_.click("dialogs/files/save");
    person_.wait_idle();
    EXPECT_TRUE(fs::exists(person_.folder() / "zz.glb"));
    EXPECT_EQ(text_of("surface.step"), "the first");
    EXPECT_EQ(text_of("w.glb"), "the third");
}

TEST_F(FileDialog, AClickOnSaveDoesNotReplaceAFileThatCameToBeMeanwhile) {
    person_.press_key(render::Key::s, true, true);
    type_name("new.json");
    ASSERT_EQ(button(), "save");
    person_.hover(person_.place("dialogs/files/save").centre());
    write("new.json", "of another program"); // the picture is older
    press();
    EXPECT_EQ(text_of("new.json"), "of another program");
    EXPECT_EQ(button(), "replace");
    fs::remove(person_.folder() / "new.json");
    person_.frames();
    person_.hold_button(true);
    person_.frames();
    write("new.json", "of another program"); // while the mouse is down
    person_.hold_button(false);
    person_.frames();
    EXPECT_EQ(text_of("new.json"), "of another program");
    press();
    EXPECT_EQ(project::read_project(person_.folder() / "new.json"), person_.project());
}

TEST_F(FileDialog, NothingElseIsWrittenOverTheOpenProjectWithoutAWord) {
    person_.app().view_state().workspace = actions::Workspace::arm;
    person_.app().view_state().file_prompt = actions::FilePrompt::save_points;
    person_.frames();
    type_name("mine");
    EXPECT_EQ(button(), "replace");
}

TEST_F(FileDialog, ImportBeginsWhereTheLastSurfaceCameFrom) {
    const std::string mesh = "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n";
    fs::create_directory(person_.folder() / "scans");
    write("scans/first.obj", mesh);
    write("scans/second.obj", mesh);
    person_.press_key(render::Key::i, true);
    person_.keep("import-dialog-empty");
    person_.click("dialogs/files/entries/scans");
    person_.press_key(render::Key::enter);
    person_.click("dialogs/files/entries/first.obj");
    person_.click("dialogs/files/open");
    person_.wait_idle();
    person_.click("inspector/import/import_give_up");
    person_.press_key(render::Key::i, true);
    EXPECT_TRUE(person_.sees("dialogs/files/entries/second.obj"));
    person_.press_key(render::Key::escape);
    person_.press_key(render::Key::o, true);
    EXPECT_TRUE(person_.sees("dialogs/files/entries/mine.json")) << "the project's folder";
}

TEST(FilePrompt, SaysWhichKindsThereAre) {
    EXPECT_EQ(about(actions::FilePrompt::import_surface).none,
              "No STEP, IGES, STL, OBJ, PLY or point files in this folder.");
    const std::string kinds = ending_text(about(actions::FilePrompt::export_surface));
    for (const char* ending : {".step", ".glb", ".stl", ".obj", ".ply"}) {
        EXPECT_NE(kinds.find(ending), std::string::npos) << ending;
    }
    EXPECT_EQ(ending_text(about(actions::FilePrompt::save_as)), "Extension: .json.");
}

TEST_F(FileDialog, AFolderIsNotTakenForAFileToReplace) {
    fs::create_directory(person_.folder() / "deep.json");
    person_.press_key(render::Key::s, true, true);
    type_name("deep.json");
    EXPECT_EQ(button(), "save");
    EXPECT_EQ(person_.refusal("dialogs/files/save"), "deep.json is a folder.");
}

} // namespace
} // namespace millwright::panels
