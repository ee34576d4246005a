// A study as text for spreadsheets, programs and people.
#include "core/base/counted.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/project/json_text.h"
#include "core/studies/kinematic_study.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace millwright::studies {

namespace {

using Json = nlohmann::ordered_json;

std::string in_quotes(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + '"';
}

Json figures_json(const StudyFigures& figures) {
    const grid::ErrorSummary& error = figures.error;
    Json json;
    json["max_mm"] = error.max;
    json["mean_mm"] = error.mean;
    json["lmean_mm"] = error.lmean;
    json["rms_mm"] = error.rms;
    json["p95_mm"] = error.p95;
    json["axis_max_deg"] = to_degrees(error.axis_max);
    json["axis_mean_deg"] = to_degrees(error.axis_mean);
    json["track_gap_mm"] = figures.track_gap;
    json["path_length_mm"] = figures.path_length;
    json["time_s"] = figures.time ? Json(*figures.time) : Json();
    json["offset_mm"] = Json::array({figures.offset.x(), figures.offset.y(), figures.offset.z()});
    return json;
}

bool same_table(const StudyRow& a, const StudyRow& b) {
    return a.of.surface == b.of.surface && a.of.machine == b.of.machine && a.of.tracks == b.of.tracks;
}

/// What a reader must not miss, in brackets.
std::string remark(const StudyRow& row) {
    return row.no_gain ? " (no gain)" : row.loss.empty() ? "" : fmt::format(" ({})", row.loss);
}

std::string cell(const StudyRow& row) {
    return row.figures ? fmt::format("{} / {} / {}{}",
                                     fixed(row.figures->error.max, 3),
                                     fixed(row.figures->error.mean, 4),
                                     fixed(to_degrees(row.figures->error.axis_max), 1),
                                     remark(row))
                       : "out of reach";
}

/// The rows of one table, one line a number of points: `rows` has all methods of a case one after another.
std::string text_table(std::span<const StudyRow> rows) {
    const StudyCase& first = rows.front().of;
    std::string text = fmt::format(
        "\n## {} on {}, {}\n\n| points |", first.surface, first.machine, counted(first.tracks, "track"));
    for (const StudyMethod method : every_study_method) {
        text += fmt::format(" {} |", label(method));
    }
    text += "\n|---|";
    for (std::size_t n = 0; n < every_study_method.size(); ++n) {
        text += "---|";
    }
    for (std::size_t n = 0; n < rows.size(); ++n) {
        text +=
            rows[n].method == every_study_method.front() ? fmt::format("\n| {} |", rows[n].of.points) : "";
        text += fmt::format(" {} |", cell(rows[n]));
    }
    return text + "\n";
}

} // namespace

std::string study_csv(std::span<const StudyRow> rows) {
    std::string text =
        "surface,machine,points,tracks,method,max_mm,mean_mm,lmean_mm,rms_mm,p95_mm,axis_max_deg,"
        "axis_mean_deg,track_gap_mm,path_length_mm,time_s,a_mm,b_mm,c_mm,note\n";
    for (const StudyRow& row : rows) {
        text += fmt::format("{},{},{},{},{}",
                            row.of.surface,
                            row.of.machine,
                            row.of.points,
                            row.of.tracks,
                            label(row.method));
        const Json figures = row.figures ? figures_json(*row.figures) : Json();
        for (const char* column : {"max_mm",
                                   "mean_mm",
                                   "lmean_mm",
                                   "rms_mm",
                                   "p95_mm",
                                   "axis_max_deg",
                                   "axis_mean_deg",
                                   "track_gap_mm",
                                   "path_length_mm",
                                   "time_s"}) {
            const bool there = row.figures && figures.at(column).is_number();
            text += there ? fmt::format(",{:.6f}", figures.at(column).get<double>()) : ",";
        }
        const auto& offset = row.figures ? row.figures->offset : Vec3::Zero();
        text +=
            row.figures ? fmt::format(",{:.4f},{:.4f},{:.4f}", offset.x(), offset.y(), offset.z()) : ",,,";
        text += ',' + in_quotes(row.note) + '\n';
    }
    return text;
}

std::string study_json(std::span<const StudyRow> rows) {
    Json json;
    json["format"] = "millwright-kinematic-study";
    json["version"] = 1;
    json["rows"] = Json::array();
    for (const StudyRow& row : rows) {
        Json entry;
        entry["surface"] = row.of.surface;
        entry["machine"] = row.of.machine;
        entry["points"] = row.of.points;
        entry["tracks"] = row.of.tracks;
        entry["method"] = label(row.method);
        entry["figures"] = row.figures ? figures_json(*row.figures) : Json();
        entry["no_gain"] = row.no_gain;
        entry["loss"] = row.loss;
        entry["note"] = row.note;
        json["rows"].push_back(std::move(entry));
    }
    return project::json_text(json);
}

std::string study_markdown(std::span<const StudyRow> rows) {
    std::string text =
        "# Kinematic error by method\n"
        "\n"
        "Each cell: largest / mean distance of the true tool tip from the surface, mm / largest angle\n"
        "between tool axis and surface normal, deg; over the moves inside the tracks. No gain: the method\n"
        "found nothing better than its start, which is kept: the uniform grid, for a sequence the chain by\n"
        "the nearest branches, for a set-up the previous position. Other notes in brackets: figures that\n"
        "are larger with a set-up than with the same method without it.\n";
    for (std::size_t from = 0; from < rows.size();) {
        std::size_t to = from;
        while (to < rows.size() && same_table(rows[from], rows[to])) {
            ++to;
        }
        text += text_table(rows.subspan(from, to - from));
        from = to;
    }
    return text;
}

} // namespace millwright::studies
