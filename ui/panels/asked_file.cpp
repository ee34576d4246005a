#include "ui/panels/asked_file.h"

#include "core/base/error.h"
#include "core/exchange/surface_file.h"
#include "core/project/gcode_file.h"
#include "core/project/imported_surface.h"
#include "core/project/json_kind.h"
#include "core/project/plot_input.h"
#include "ui/actions/processor_texts.h"

#include <algorithm>
#include <array>

namespace millwright::panels {

namespace fs = std::filesystem;

namespace {

using actions::FileQuestion;

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

constexpr std::array<AskedFile, 20> questions{
    {{FileQuestion::open,
      "Open a project, G-code, surface, plot or picture",
      true,
      extension,
      "",
      nullptr,
      "No projects, G-code, surfaces, plots or pictures in this folder.",
      is_opened},
     {FileQuestion::save_as,
      "Save the project as",
      false,
      extension,
      "",
      nullptr,
      "No projects (.json) in this folder.",
      project::is_project_json},
     {FileQuestion::import_surface,
      "Import a surface",
      true,
      "",
      "",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.open_surface(file); },
      "No STEP, IGES, STL, OBJ, PLY or point files in this folder.",
      project::is_importable},
     {FileQuestion::export_surface,
      "Export the surface as",
      false,
      ".step",
      "surface.step",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.export_surface(file); },
      "No STEP, glb, STL, OBJ or PLY files in this folder.",
      exchange::is_surface_file},
     {FileQuestion::open_arm,
      "Open an arm",
      true,
      extension,
      "",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.open_arm(file); },
      "No arms (.json) in this folder.",
      project::is_arm_json},
     {FileQuestion::open_points,
      "Open taught points",
      true,
      extension,
      "",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.open_points(file); },
      "No taught points (.json) in this folder.",
      project::is_taught_points_json},
     {FileQuestion::save_points,
      "Save the taught points as",
      false,
      extension,
      "points.json",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.save_points(file); },
      "No taught points (.json) in this folder.",
      project::is_taught_points_json},
     {FileQuestion::open_motion_program,
      "Open a motion program",
      true,
      "",
      "",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.open_motion_program(file); },
      "No files in this folder."},
     {FileQuestion::save_motion_program,
      "Save the motion program as",
      false,
      ".pmc",
      "program.pmc",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.save_motion_program(file); },
      "No motion programs (.pmc) in this folder."},
     {FileQuestion::play_motion_file,
      "Play a motion file",
      true,
      "",
      "",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.play_motion_file(file); },
      "No files in this folder."},
     {FileQuestion::open_motion_file,
      "Open a motion file",
      true,
      "",
      "",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.open_motion_file(file); },
      "No files in this folder."},
     {FileQuestion::save_motion_file,
      "Save the motion file as",
      false,
      ".mot",
      "motion.mot",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.save_motion_file(file); },
      "No motion files (.mot) in this folder."},
     {FileQuestion::save_motion_result,
      "Save points and joint angles as",
      false,
      ".txt",
      "result.txt",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.save_motion_result(file); },
      "No results (.txt) in this folder."},
     {FileQuestion::load_card_settings,
      "Load card settings",
      true,
      "",
      "",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.load_card_settings(file); },
      "No files in this folder."},
     {FileQuestion::open_assembler,
      "Open assembly source or a ROM image",
      true,
      "",
      "",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.open_assembler(file); },
      "No assembly source (.asm) or ROM images (.bin) in this folder.",
      is_assembler_or_image},
     {FileQuestion::save_assembler,
      "Save the assembly source as",
      false,
      ".asm",
      "program.asm",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.save_assembler(file); },
      "No assembly source (.asm) in this folder."},
     {FileQuestion::save_image,
      "Save the ROM image as",
      false,
      ".bin",
      "program.bin",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.save_image(file); },
      "No ROM images (.bin) in this folder."},
     {FileQuestion::open_microprogram,
      "Open a microprogram",
      true,
      "",
      "",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.open_microprogram(file); },
      "No files in this folder."},
     {FileQuestion::save_microprogram,
      "Save the microprogram as",
      false,
      ".micro",
      "own.micro",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.save_microprogram(file); },
      "No microprograms (.micro) in this folder."},
     {FileQuestion::write_program,
      "Write G-code as",
      false,
      ".ngc",
      "",
      [](actions::Workshop& workshop, const fs::path& file) { workshop.write_program(file); },
      "No G-code (.ngc) in this folder."}}};

} // namespace

const AskedFile& about(FileQuestion question) {
    const auto* const found = std::ranges::find(questions, question, &AskedFile::question);
    expects(found != questions.end(), "a question about a file");
    return *found;
}

std::string_view use_of(FileQuestion question) {
    switch (question) {
    case FileQuestion::open:
        return "open";
    case FileQuestion::import_surface:
    case FileQuestion::export_surface:
        return "surface";
    case FileQuestion::write_program:
        return "program";
    case FileQuestion::open_arm:
    case FileQuestion::open_points:
    case FileQuestion::save_points:
    case FileQuestion::open_motion_program:
    case FileQuestion::save_motion_program:
    case FileQuestion::play_motion_file:
    case FileQuestion::open_motion_file:
    case FileQuestion::save_motion_file:
    case FileQuestion::save_motion_result:
    case FileQuestion::load_card_settings:
        return "arm";
    case FileQuestion::open_assembler:
    case FileQuestion::save_assembler:
    case FileQuestion::save_image:
    case FileQuestion::open_microprogram:
    case FileQuestion::save_microprogram:
        return "processor";
    default:
        return "project";
    }
}

bool is_gcode(const fs::path& file) {
    return project::is_gcode_file(file);
}

bool is_listed(const AskedFile& asked, const fs::path& file) {
    return asked.lists != nullptr ? asked.lists(file)
                                  : asked.ending.empty() || file.extension() == asked.ending;
}

std::string ending_text(const AskedFile& asked) {
    return asked.question == FileQuestion::export_surface
               ? "The file extension selects the format: .step, .glb, .stl, .obj or .ply."
               : "Extension: " + std::string(asked.ending) + ".";
}

} // namespace millwright::panels
