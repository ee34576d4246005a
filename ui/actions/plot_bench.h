// A plot or picture on the bench: what a person has set for it, what comes of that, and a table that its
// points are played to.
#pragma once

#include "core/plot/material_table.h"
#include "core/project/plot_work.h"
#include "ui/actions/table_player.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::actions {

class PlotBench {
public:
    PlotBench(std::filesystem::path assets, const std::function<void()>& wake);

    /// In place of what was open; levels begin anew. Throws Error if the file cannot be read.
    void open(const std::filesystem::path& file);
    /// Derives everything anew if that changes anything.
    void set(const project::PlotSettings& settings);
    /// The levels in force, with `change` made to level `n` of them.
    void set_level(std::size_t n, const std::function<void(plot::Level&)>& change);
    void add_level(std::size_t like);
    void remove_level(std::size_t n);
    /// Feed, plunge, depth a pass and spindle of a material for the tool that is set.
    void use_material(std::size_t n);
    void set_table(const TableChoice& choice) { table_choice_ = choice; }
    void play_table();

    [[nodiscard]] const std::filesystem::path& file() const { return file_; } ///< empty: none
    [[nodiscard]] const project::PlotSettings& settings() const { return settings_; }
    [[nodiscard]] std::shared_ptr<const project::PlotResult> latest() const { return worker_.latest(); }
    [[nodiscard]] project::Activity activity() const { return worker_.activity(); }
    /// Levels as they are in force, or about to be.
    [[nodiscard]] std::vector<plot::Level> levels() const;
    [[nodiscard]] const std::vector<plot::Material>& materials() const { return materials_; }
    [[nodiscard]] std::optional<std::size_t> material() const { return material_; }
    /// Width of the tool that cuts, mm; 0 for a point.
    [[nodiscard]] double tool_diameter() const;
    [[nodiscard]] const TableChoice& table_choice() const { return table_choice_; }
    [[nodiscard]] TablePlayer& table() { return *table_; }
    [[nodiscard]] const TablePlayer& table() const { return *table_; }
    /// The program that was derived, written beside the plot under a name that is not taken. Throws Error.
    [[nodiscard]] std::filesystem::path write_program() const;

    void cancel() { worker_.cancel(); }
    void wait_idle() const { worker_.wait_idle(); }

private:
    std::filesystem::path assets_;
    std::filesystem::path file_;
    project::PlotSettings settings_;
    std::vector<plot::Material> materials_;
    std::optional<std::size_t> material_;
    TableChoice table_choice_;
    project::PlotWorker worker_;
    std::unique_ptr<TablePlayer> table_;
};

} // namespace millwright::actions
