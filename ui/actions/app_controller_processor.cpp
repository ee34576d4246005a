// The part of AppController that deals with the CORDIC processor: its programs, its microprogram, their
// files.
#include "core/base/files.h"
#include "core/cordic/disassembler.h"
#include "core/cordic/image.h"
#include "core/cordic/microprogram.h"
#include "ui/actions/app_controller.h"
#include "ui/workspaces/processor_workspace.h"

#include <utility>

namespace millwright::actions {

namespace fs = std::filesystem;

/// It has something to show once it is looked at.
bool AppController::follow_processor(double seconds) {
    const bool written = processor_->follow(history_.current().processor);
    if (view_state_.workspace == Workspace::processor && processor_->name().empty()) {
        guarded([this] { load_processor(processor_->choice().source); });
        if (processor_->name().empty()) { // said once
            processor_->load(processor_->choice().source, "M2\n", "nothing");
        }
    }
    return processor_->advance(seconds) || written;
}

void AppController::load_processor(ProcessorSource source) {
    const FrameState now = look();
    const auto sample = [&](const char* file) {
        const fs::path path = options_.assets / "samples" / file;
        processor_->load(source, read_file(path), path.filename());
    };
    switch (source) {
    case ProcessorSource::thesis_arc:
        return sample("thesis-arc.ngc");
    case ProcessorSource::thesis_path:
        return sample("thesis-path.ngc");
    case ProcessorSource::opened_file:
        if (now.opened_file) {
            processor_->load(source, read_file(now.opened_file->file), now.opened_file->file.filename());
        }
        return;
    case ProcessorSource::project:
        if (const auto listing = now.listing()) {
            processor_->load(source, listing->text, "project");
        }
        return;
    case ProcessorSource::assembler:
        processor_->follow(history_.current().processor);
        processor_->load_assembler();
        return;
    }
}

void AppController::write_assembler(const std::string& title, const std::string& text) {
    edit(title, [&](project::Project& draft) { draft.processor.assembler = text; }, {});
    view_state_.workspace = Workspace::processor;
    view_state_.lower_tab_now() = LowerTab::assembler;
    load_processor(ProcessorSource::assembler);
}

void AppController::write_microprogram(const std::string& title, const std::string& text) {
    edit(title, [&](project::Project& draft) { draft.processor.microprogram = text; }, {});
    view_state_.workspace = Workspace::processor;
    view_state_.lower_tab_now() = LowerTab::microprogram;
    processor_->follow(history_.current().processor);
    ProcessorChoice choice = processor_->choice();
    choice.own_microprogram = true;
    processor_->set(choice);
}

/// In a project that has no file and in which nothing was done, what is opened counts as saved: it is a file.
void AppController::open_processor_text(const std::function<void()>& open) {
    const bool nothing_to_lose = document().file.empty() && !changed();
    view_state_.file_prompt = FilePrompt::none;
    open();
    if (nothing_to_lose) {
        document().saved = history_.current();
    }
}

void AppController::open_assembler(const fs::path& file) {
    open_processor_text([&] { write_assembler("Open " + file.filename().string(), assembler_text(file)); });
}

void AppController::save_assembler(const fs::path& file) {
    write_file(file, history_.current().processor.assembler);
    view_state_.file_prompt = FilePrompt::none;
    tell(view_state_, widgets::Severity::info, "Saved " + file.filename().string() + ".");
}

void AppController::save_image(const fs::path& file) {
    const auto bytes = cordic::to_bytes(processor_->image());
    write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    view_state_.file_prompt = FilePrompt::none;
    tell(view_state_, widgets::Severity::info, "Saved " + file.filename().string() + ".");
}

void AppController::take_over_assembler() {
    write_assembler("Copy to the assembly source", cordic::disassemble(processor_->image()));
}

void AppController::start_microprogram() {
    write_microprogram("Copy the built-in microprogram",
                       cordic::microprogram_text(cordic::Publishing::latch));
}

void AppController::open_microprogram(const fs::path& file) {
    open_processor_text([&] { write_microprogram("Open " + file.filename().string(), read_file(file)); });
}

void AppController::save_microprogram(const fs::path& file) {
    write_file(file, history_.current().processor.microprogram);
    view_state_.file_prompt = FilePrompt::none;
    tell(view_state_, widgets::Severity::info, "Saved " + file.filename().string() + ".");
}

} // namespace millwright::actions
