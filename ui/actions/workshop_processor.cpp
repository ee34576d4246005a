// The part of the workshop that deals with the CORDIC processor: its programs, its microprogram, their files.
#include "core/base/files.h"
#include "core/cordic/disassembler.h"
#include "core/cordic/image.h"
#include "core/cordic/microprogram.h"
#include "ui/actions/processor_bench.h"
#include "ui/actions/workshop.h"

#include <utility>

namespace millwright::actions {

namespace fs = std::filesystem;

/// It has something to show once it is looked at.
bool Workshop::follow_processor(double seconds) {
    const bool written = processor_->follow(history_.current().processor);
    if (session_.workspace == Workspace::processor && processor_->name().empty()) {
        guarded([this] { load_processor(processor_->choice().source); });
        if (processor_->name().empty()) { // said once
            processor_->load(processor_->choice().source, "M2\n", "nothing");
        }
    }
    return processor_->advance(seconds) || written;
}

void Workshop::load_processor(ProcessorSource source) {
    const Workbench now = look();
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
        if (now.opened) {
            processor_->load(source, read_file(now.opened->file), now.opened->file.filename());
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

void Workshop::write_assembler(const std::string& title, const std::string& text) {
    edit(title, [&](project::Project& draft) { draft.processor.assembler = text; }, {});
    session_.workspace = Workspace::processor;
    session_.lower_tab_now() = LowerTab::assembler;
    load_processor(ProcessorSource::assembler);
}

void Workshop::write_microprogram(const std::string& title, const std::string& text) {
    edit(title, [&](project::Project& draft) { draft.processor.microprogram = text; }, {});
    session_.workspace = Workspace::processor;
    session_.lower_tab_now() = LowerTab::microprogram;
    processor_->follow(history_.current().processor);
    ProcessorChoice choice = processor_->choice();
    choice.own_microprogram = true;
    processor_->set(choice);
}

/// In a project that has no file and in which nothing was done, what is opened counts as saved: it is a file.
void Workshop::open_processor_text(const std::function<void()>& open) {
    const bool nothing_to_lose = document().file.empty() && !changed();
    session_.question = FileQuestion::none;
    open();
    if (nothing_to_lose) {
        document().saved = history_.current();
    }
}

void Workshop::open_assembler(const fs::path& file) {
    open_processor_text([&] { write_assembler("Open " + file.filename().string(), assembler_text(file)); });
}

void Workshop::save_assembler(const fs::path& file) {
    write_file(file, history_.current().processor.assembler);
    session_.question = FileQuestion::none;
    tell(session_, widgets::Severity::info, "Saved " + file.filename().string() + ".");
}

void Workshop::save_image(const fs::path& file) {
    const auto bytes = cordic::to_bytes(processor_->image());
    write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    session_.question = FileQuestion::none;
    tell(session_, widgets::Severity::info, "Saved " + file.filename().string() + ".");
}

void Workshop::take_over_assembler() {
    write_assembler("Copy to the assembly source", cordic::disassemble(processor_->image()));
}

void Workshop::start_microprogram() {
    write_microprogram("Copy the built-in microprogram",
                       cordic::microprogram_text(cordic::Publishing::latch));
}

void Workshop::open_microprogram(const fs::path& file) {
    open_processor_text([&] { write_microprogram("Open " + file.filename().string(), read_file(file)); });
}

void Workshop::save_microprogram(const fs::path& file) {
    write_file(file, history_.current().processor.microprogram);
    session_.question = FileQuestion::none;
    tell(session_, widgets::Severity::info, "Saved " + file.filename().string() + ".");
}

} // namespace millwright::actions
