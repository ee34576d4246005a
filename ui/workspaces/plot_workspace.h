// The plot or picture of the project: what comes of it, and a table that its points are played
// to.
#pragma once

#include "core/plan/plot_work.h"
#include "core/plot/material_table.h"
#include "ui/workspaces/table_player.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::actions {

class PlotWorkspace {
public:
    /// Logs of what is played to a table go to `log_folder`.
    PlotWorkspace(std::filesystem::path assets,
                  std::filesystem::path log_folder,
                  const std::function<void()>& wake);

    /// Derives what the project asks for now.
    void follow(const project::PlotInput& input);
    /// Reads the file once more, which may be another one by now.
    void read_again();
    void choose_material(std::size_t n) { material_ = n; }
    void set_table(const TableChoice& choice) { table_choice_ = choice; }
    void set_table_port(const std::string& port) { table_choice_.port = port; }
    /// The path as it is shown and as its program cuts it: levels, order, depths and tools.
    /// `timeline_s`: where the timeline stands.
    void play_table(double timeline_s);

    [[nodiscard]] const project::PlotInput& input() const { return input_; }
    [[nodiscard]] const std::filesystem::path& file() const { return input_.file; } ///< empty: none
    [[nodiscard]] const project::PlotSettings& settings() const { return input_.settings; }
    /// Of the file that is open, perhaps with settings that were before; null while there is nothing of it.
    [[nodiscard]] std::shared_ptr<const plan::PlotResult> latest() const;
    /// The program of the file and how it moves the machine; null while there is none.
    [[nodiscard]] std::shared_ptr<const plan::OpenedProgram> opened() const;
    /// Whether `made` is what the file makes now with the settings of now.
    [[nodiscard]] bool is_current(const plan::PlotResult& made) const {
        return made.request == request_ && made.input == input_;
    }
    [[nodiscard]] plan::Activity activity() const { return worker_.activity(); }
    /// What the settings of now ask for was given up: nothing is there of it, and nothing will be.
    [[nodiscard]] bool given_up() const {
        if (input_.file.empty() || activity().busy) {
            return false;
        }
        const auto made = latest(); // after that, since the worker ends with it
        return !made || !made->finished || !is_current(*made);
    }
    /// Levels as they are in force, or about to be.
    [[nodiscard]] std::vector<plot::Level> levels() const;
    [[nodiscard]] const std::vector<plot::Material>& materials() const { return materials_; }
    /// That was taken last; nothing: none.
    [[nodiscard]] std::optional<std::size_t> material() const { return material_; }
    /// Width of the tool that cuts, mm; 0 for a point.
    [[nodiscard]] double tool_diameter() const;
    /// Where the table starts to be played to, mm; nothing while there is nothing to play.
    [[nodiscard]] std::optional<Vec3> table_start() const;
    [[nodiscard]] const TableChoice& table_choice() const { return table_choice_; }
    [[nodiscard]] TablePlayer& table() { return *table_; }
    [[nodiscard]] const TablePlayer& table() const { return *table_; }
    /// Where the tool of the table is that what is open is played to, mm; afterwards, where it was left,
    /// until the timeline, at `timeline_s`, goes elsewhere.
    [[nodiscard]] std::optional<Vec3> table_tip(double timeline_s) const;
    /// Of a path that is too long to get its program automatically.
    void make_program() { worker_.request_program(); }
    /// Writes the program into `folder` under a name that is not taken, and gives the name. Throws Error.
    [[nodiscard]] std::filesystem::path write_program(const std::filesystem::path& folder) const;
    /// The path as a file that can be opened again, in the same way.
    [[nodiscard]] std::filesystem::path write_path(const std::filesystem::path& folder) const;
    /// The points that a table is sent from its usual start, by the settings of the table, in the same way.
    [[nodiscard]] std::filesystem::path write_points(const std::filesystem::path& folder) const;

    void cancel() { worker_.cancel(); }
    void wait_idle() const { worker_.wait_idle(); }

private:
    void derive(bool anew);
    /// The machine of the settings. Throws Error.
    [[nodiscard]] std::shared_ptr<const kinematics::MachineModel> model() const;

    std::filesystem::path assets_;
    project::PlotInput input_;
    std::uint64_t request_ = 0; ///< with which the file was last read
    std::vector<plot::Material> materials_;
    std::optional<std::size_t> material_;
    TableChoice table_choice_;
    plan::PlotWorker worker_;
    std::unique_ptr<TablePlayer> table_;
    std::filesystem::path played_;  ///< file of what the table was last played
    double timeline_at_play_ = 0.0; ///< s
};

} // namespace millwright::actions
