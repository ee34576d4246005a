// One's own assembler text, image and microprogram in the Processor workspace: opened, written, executed and
// stepped, with what is wrong in its line.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/cordic/assembler.h"
#include "core/cordic/microprogram.h"
#include "tests/ui/person/person.h"
#include "ui/window/window.h"
#include "ui/workspaces/processor_workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::panels {
namespace {

using actions::ProcessorSource;
using render::Key;
using testing::HasSubstr;

const std::string line_and_end = ".format q12.20\n"
                                 "    MOV Vmax, 10 ; mm/s\n"
                                 "    MOV Amax, 100\n"
                                 "    MOV XI, 8\n"
                                 "    MOV YJ, 6\n"
                                 "    G01\n"
                                 "    HLT\n";

class ProcessorTexts : public testing::Test {
protected:
    ProcessorTexts() {
        person_.press_key(Key::f7);
        person_.frames(3);
    }
    [[nodiscard]] const actions::ProcessorWorkspace& workspace() { return person_.app().look().processor; }
    [[nodiscard]] const cordic::ProcessorState& state() { return workspace().debugger().state(); }
    [[nodiscard]] std::string text() { return person_.project().processor.assembler; }
    void tab(const std::string& name) {
        person_.click("lower/tabs/" + name);
        person_.frames(2);
    }
    [[nodiscard]] std::filesystem::path file(const std::string& name, const std::string& content) {
        const auto path = person_.folder() / name;
        write_file(path, content);
        return path;
    }
    /// To its end, as a person has it run.
    void run() {
        person_.click("timeline/speed/full");
        person_.click("timeline/processor_run");
        EXPECT_TRUE(person_.live_until([&] { return !workspace().running(); }));
    }

    test::Person person_{{1280, 800}};
};

TEST_F(ProcessorTexts, AssemblerTextIsWrittenCheckedExecutedAndStepped) {
    tab("assembler");
    EXPECT_FALSE(person_.refusal("lower/processor_assembler").empty());
    person_.click("lower/text");
    person_.type(".format q12.20\nMOV Vmax, 10\nMOV Amaz, 100\n");
    person_.frames(2);
    ASSERT_FALSE(workspace().written().remarks().empty());
    EXPECT_EQ(workspace().written().remarks().front().place.line, 3);
    EXPECT_EQ(workspace().choice().source, ProcessorSource::thesis_arc)
        << "is executed when a person wants it";
    person_.click("lower/processor_assembler");
    person_.frames(2);
    ASSERT_TRUE(workspace().failure());
    EXPECT_FALSE(person_.refusal("timeline/processor_clock").empty());
    person_.keep("processor-assembler-fault");
    person_.click("lower/text");
    person_.press_key(Key::end, true);
    for (int n = 0; n < 7; ++n) { // "z, 100" and the end of its line
        person_.press_key(Key::backspace);
    }
    person_.type("x, 100\nMOV XI, 8\nMOV YJ, 6\nG01\nHLT\n");
    person_.frames(2);
    EXPECT_FALSE(workspace().failure()) << text();
    person_.click("timeline/processor_block");
    EXPECT_EQ(workspace().debugger().line(), 3);
    EXPECT_EQ(workspace().code()[2].text, "MOV XI, 8");
    EXPECT_EQ(workspace().code()[2].line, 4);
    run();
    EXPECT_EQ(state().stop, cordic::Stop::halted);
    EXPECT_EQ(state().clocks.cordic, 74);
    EXPECT_FALSE(person_.sees("inspector/errors/position")) << "there is nothing to compare with";
    person_.keep("processor-assembler");
    for (const std::string& cut : person_.desktop().ui().cut_texts()) {
        ADD_FAILURE() << cut;
    }
    person_.click("lower/text");
    person_.press_key(Key::z, true); // word by word
    person_.frames(2);
    EXPECT_EQ(workspace().choice().source, ProcessorSource::assembler);
    EXPECT_THAT(text(), testing::Not(HasSubstr("HLT")));
}

TEST_F(ProcessorTexts, AFileOfAssemblerTextIsNoGCode) {
    person_.app().open(file("own.asm", line_and_end));
    person_.frames(2);
    EXPECT_EQ(person_.app().view_state().workspace, actions::Workspace::processor);
    EXPECT_FALSE(person_.app().look().changed()); // nothing to save, nothing to recover
    EXPECT_EQ(workspace().choice().source, ProcessorSource::assembler);
    EXPECT_EQ(text(), line_and_end);
    EXPECT_EQ(cordic::to_text(workspace().image().format), "q12.20");
    EXPECT_TRUE(person_.sees("inspector/format/says"));
    person_.click("code/tabs/program");
    const widgets::Rect lines = person_.place("code/program");
    person_.click_at({lines.x + 0.5F * lines.w, lines.y + 111.0F}); // the sixth line
    ASSERT_EQ(workspace().debugger().breakpoints().size(), 1U);
    run();
    EXPECT_EQ(workspace().halt(), cordic::Halt::breakpoint);
    EXPECT_EQ(workspace().debugger().line(), 6);
    person_.app().run("edit.undo");
    person_.frames(2);
    EXPECT_EQ(text(), "");
    ASSERT_TRUE(workspace().failure());
    EXPECT_THAT(workspace().failure()->message, HasSubstr("no instruction"));
}

TEST_F(ProcessorTexts, AnImageIsOpenedAsTextAndSavedWithTheSameBytes) {
    const auto image = cordic::to_bytes(cordic::assemble(line_and_end, "own.asm").image);
    const std::string bytes(image.begin(), image.end());
    person_.app().open(file("own.bin", bytes));
    person_.frames(2);
    EXPECT_THAT(text(), HasSubstr("MOV XI, 8"));
    const auto copy = person_.folder() / "copy.bin";
    person_.app().save_image(copy);
    EXPECT_EQ(read_file(copy), bytes);
    EXPECT_THROW(person_.app().open(file("broken.bin", bytes.substr(0, 7))), Error);
    EXPECT_THAT(text(), HasSubstr("MOV XI, 8"));
    for (const char* button :
         {"lower/processor_open_assembler", "lower/processor_save_assembler", "lower/processor_save_image"}) {
        person_.click(button);
        person_.frames(3);
        EXPECT_TRUE(person_.sees("dialogs/files/open") || person_.sees("dialogs/files/save")) << button;
        person_.press_key(Key::escape);
        person_.frames(2);
    }
}

TEST_F(ProcessorTexts, TheProgramThatIsExecutedIsTakenOverAsText) {
    tab("assembler");
    const auto code = workspace().image().code;
    person_.click("lower/processor_take_over");
    person_.frames(2);
    EXPECT_EQ(workspace().choice().source, ProcessorSource::assembler);
    EXPECT_EQ(workspace().image().code, code);
    EXPECT_THAT(text(), HasSubstr("G03"));
}

TEST_F(ProcessorTexts, AMicroprogramOfOnesOwnIsWrittenAndExecuted) {
    tab("microprogram");
    EXPECT_FALSE(person_.refusal("lower/processor_own_microprogram").empty());
    person_.click("lower/processor_start_microprogram");
    person_.frames(2);
    EXPECT_TRUE(workspace().choice().own_microprogram);
    EXPECT_FALSE(workspace().failure());
    run();
    const auto ours = state().clocks.total;
    // One clock more in every fetch.
    std::string slower = cordic::microprogram_text(cordic::Publishing::latch);
    const auto fetch = slower.find("        CONT                            | load_opcode");
    ASSERT_NE(fetch, std::string::npos);
    slower.insert(fetch, "        CONT\n");
    person_.app().open(file("slower.micro", slower));
    person_.frames(2);
    ASSERT_FALSE(workspace().failure());
    run();
    EXPECT_EQ(state().stop, cordic::Stop::halted);
    EXPECT_EQ(state().clocks.total, ours + state().instructions);
    person_.click("lower/text");
    person_.press_key(Key::home, true);
    person_.type("JUMP\n");
    person_.frames(2);
    ASSERT_TRUE(workspace().failure());
    EXPECT_EQ(workspace().written().micro_faults().front().place.line, 1);
    person_.keep("processor-microprogram-fault");
    person_.click("lower/processor_own_microprogram"); // back to the processor's own
    person_.frames(2);
    EXPECT_FALSE(workspace().failure());
    run();
    EXPECT_EQ(state().clocks.total, ours);
}

TEST_F(ProcessorTexts, BothEditorsFindAndReplaceByTheKeysOfTheOthers) {
    tab("assembler");
    person_.click("lower/text");
    person_.type("MOV XI, 8\nMOV YJ, 8\nG01\n");
    person_.press_key(Key::f, true);
    person_.frames(3);
    ASSERT_TRUE(person_.sees("lower/find/wanted"));
    person_.type("8");
    person_.press_key(Key::enter);
    person_.frames(2);
    person_.fill_in("lower/find/replacement", "6");
    person_.click("lower/find/replace_all");
    person_.frames(2);
    EXPECT_EQ(text(), "MOV XI, 6\nMOV YJ, 6\nG01\n");
    person_.app().run("edit.undo");
    person_.frames(2);
    EXPECT_EQ(text(), "MOV XI, 8\nMOV YJ, 8\nG01\n");

    tab("microprogram");
    person_.click("lower/processor_start_microprogram");
    person_.frames(2);
    person_.click("lower/text");
    person_.press_key(Key::home, true);
    person_.press_key(Key::f, true);
    person_.frames(3);
    ASSERT_TRUE(person_.sees("lower/find/wanted"));
    person_.press_key(Key::a, true);
    person_.type("CONT");
    person_.press_key(Key::enter);
    person_.frames(4);
    const auto first = person_.picture_of("lower/text");
    for (int n = 0; n < 12; ++n) { // far down
        person_.press_key(Key::g, true);
        person_.frames(2);
    }
    person_.frames(3);
    EXPECT_GT(render::difference(first, person_.picture_of("lower/text"), 16).fraction, 0.002);
}

} // namespace
} // namespace millwright::panels
