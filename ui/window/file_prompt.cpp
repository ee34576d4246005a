#include "ui/window/file_prompt.h"

#include "core/base/error.h"
#include "core/exchange/surface_file.h"
#include "core/project/gcode_file.h"
#include "core/project/imported_surface.h"
#include "core/project/json_kind.h"
#include "core/project/plot_input.h"
#include "ui/workspaces/processor_texts.h"
#include "ui/workspaces/stock_file.h"
#include "ui/workspaces/stock_workspace.h"

#include <algorithm>
#include <array>

namespace millwright::panels {

namespace fs = std::filesystem;

namespace {

using actions::FilePrompt;

constexpr std::string_view extension = ".json";

/// What "Open" can make something of.
bool is_opened(const fs::path& file) {
    return project::is_project_json(file) || is_gcode(file) || project::opens_as_surface(file) ||
           project::is_plot_file(file) || actions::is_processor_file(file);
}

bool is_assembler_or_image(const fs::path& file) {
    return actions::processor_file(file) == actions::ProcessorFile::assembler ||
           actions::processor_file(file) == actions::ProcessorFile::image;
}

constexpr std::array<FilePromptRow, 21> prompts{
    {{FilePrompt::open,
      "Open a project, G-code, surface, plot or picture",
      true,
      extension,
      "",
      nullptr,
      "No projects, G-code, surfaces, plots or pictures in this folder.",
      is_opened},
     {FilePrompt::save_as,
      "Save the project as",
      false,
      extension,
      "",
      nullptr,
      "No projects (.json) in this folder.",
      project::is_project_json},
     {FilePrompt::import_surface,
      "Import a surface",
      true,
      "",
      "",
      [](actions::AppController& app, const fs::path& file) { app.open_surface(file); },
      "No STEP, IGES, STL, OBJ, PLY or point files in this folder.",
      project::is_importable},
     {FilePrompt::export_surface,
      "Export the surface as",
      false,
      ".step",
      "surface.step",
      [](actions::AppController& app, const fs::path& file) { app.export_surface(file); },
      "No STEP, glb, STL, OBJ or PLY files in this folder.",
      exchange::is_surface_file},
     {FilePrompt::export_stock,
      "Export the cut part as",
      false,
      ".ply",
      "cut.ply",
      [](actions::AppController& app, const fs::path& file) {
          app.stock().export_cut(file, app.view_state().stock.settings.tolerance);
          app.view_state().file_prompt = FilePrompt::none;
      },
      "No STL, PLY or glb files in this folder.",
      actions::is_stock_file},
     {FilePrompt::open_arm,
      "Open an arm",
      true,
      extension,
      "",
      [](actions::AppController& app, const fs::path& file) { app.open_arm(file); },
      "No arms (.json) in this folder.",
      project::is_arm_json},
     {FilePrompt::open_points,
      "Open taught points",
      true,
      extension,
      "",
      [](actions::AppController& app, const fs::path& file) { app.open_points(file); },
      "No taught points (.json) in this folder.",
      project::is_taught_points_json},
     {FilePrompt::save_points,
      "Save the taught points as",
      false,
      extension,
      "points.json",
      [](actions::AppController& app, const fs::path& file) { app.save_points(file); },
      "No taught points (.json) in this folder.",
      project::is_taught_points_json},
     {FilePrompt::open_motion_program,
      "Open a motion program",
      true,
      "",
      "",
      [](actions::AppController& app, const fs::path& file) { app.open_motion_program(file); },
      "No files in this folder."},
     {FilePrompt::save_motion_program,
      "Save the motion program as",
      false,
      ".pmc",
      "program.pmc",
      [](actions::AppController& app, const fs::path& file) { app.save_motion_program(file); },
      "No motion programs (.pmc) in this folder."},
     {FilePrompt::play_motion_file,
      "Play a motion file",
      true,
      "",
      "",
      [](actions::AppController& app, const fs::path& file) { app.play_motion_file(file); },
      "No files in this folder."},
     {FilePrompt::open_motion_file,
      "Open a motion file",
      true,
      "",
      "",
      [](actions::AppController& app, const fs::path& file) { app.open_motion_file(file); },
      "No files in this folder."},
     {FilePrompt::save_motion_file,
      "Save the motion file as",
      false,
      ".mot",
      "motion.mot",
      [](actions::AppController& app, const fs::path& file) { app.save_motion_file(file); },
      "No motion files (.mot) in this folder."},
     {FilePrompt::save_motion_result,
      "Save points and joint angles as",
      false,
      ".txt",
      "result.txt",
      [](actions::AppController& app, const fs::path& file) { app.save_motion_result(file); },
      "No results (.txt) in this folder."},
     {FilePrompt::load_card_settings,
      "Load card settings",
      true,
      "",
      "",
      [](actions::AppController& app, const fs::path& file) { app.load_card_settings(file); },
      "No files in this folder."},
     {FilePrompt::open_assembler,
      "Open assembly source or a ROM image",
      true,
      "",
      "",
      [](actions::AppController& app, const fs::path& file) { app.open_assembler(file); },
      "No assembly source (.asm) or ROM images (.bin) in this folder.",
      is_assembler_or_image},
     {FilePrompt::save_assembler,
      "Save the assembly source as",
      false,
      ".asm",
      "program.asm",
      [](actions::AppController& app, const fs::path& file) { app.save_assembler(file); },
      "No assembly source (.asm) in this folder."},
     {FilePrompt::save_image,
      "Save the ROM image as",
      false,
      ".bin",
      "program.bin",
      [](actions::AppController& app, const fs::path& file) { app.save_image(file); },
      "No ROM images (.bin) in this folder."},
     {FilePrompt::open_microprogram,
      "Open a microprogram",
      true,
      "",
      "",
      [](actions::AppController& app, const fs::path& file) { app.open_microprogram(file); },
      "No files in this folder."},
     {FilePrompt::save_microprogram,
      "Save the microprogram as",
      false,
      ".micro",
      "own.micro",
      [](actions::AppController& app, const fs::path& file) { app.save_microprogram(file); },
      "No microprograms (.micro) in this folder."},
     {FilePrompt::write_program,
      "Write G-code as",
      false,
      ".ngc",
      "",
      [](actions::AppController& app, const fs::path& file) { app.write_program(file); },
      "No G-code (.ngc) in this folder."}}};

} // namespace

const FilePromptRow& about(FilePrompt prompt) {
    const auto* const found = std::ranges::find(prompts, prompt, &FilePromptRow::prompt);
    expects(found != prompts.end(), "a question about a file");
    return *found;
}

std::string_view use_of(FilePrompt prompt) {
    switch (prompt) {
    case FilePrompt::open:
        return "open";
    case FilePrompt::import_surface:
    case FilePrompt::export_surface:
    case FilePrompt::export_stock:
        return "surface";
    case FilePrompt::write_program:
        return "program";
    case FilePrompt::open_arm:
    case FilePrompt::open_points:
    case FilePrompt::save_points:
    case FilePrompt::open_motion_program:
    case FilePrompt::save_motion_program:
    case FilePrompt::play_motion_file:
    case FilePrompt::open_motion_file:
    case FilePrompt::save_motion_file:
    case FilePrompt::save_motion_result:
    case FilePrompt::load_card_settings:
        return "arm";
    case FilePrompt::open_assembler:
    case FilePrompt::save_assembler:
    case FilePrompt::save_image:
    case FilePrompt::open_microprogram:
    case FilePrompt::save_microprogram:
        return "processor";
    default:
        return "project";
    }
}

bool is_gcode(const fs::path& file) {
    return project::is_gcode_file(file);
}

bool is_listed(const FilePromptRow& asked, const fs::path& file) {
    return asked.lists != nullptr ? asked.lists(file)
                                  : asked.ending.empty() || file.extension() == asked.ending;
}

std::string ending_text(const FilePromptRow& asked) {
    if (asked.prompt == FilePrompt::export_stock) {
        return "The file extension selects the format: .ply and .glb with colours, or .stl.";
    }
    return asked.prompt == FilePrompt::export_surface
               ? "The file extension selects the format: .step, .glb, .stl, .obj or .ply."
               : "Extension: " + std::string(asked.ending) + ".";
}

} // namespace millwright::panels
