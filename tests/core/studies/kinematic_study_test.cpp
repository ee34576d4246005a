#include "core/studies/kinematic_study.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "tests/core/plan/sample_projects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string_view>

namespace millwright::studies {
namespace {

using test::asset_folders;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double rounded_up = 1.0 + 1e-9; // of sums whose order differs

const StudyRow& row_of_method(const std::vector<StudyRow>& rows, StudyMethod method) {
    return *std::ranges::find(rows, method, &StudyRow::method);
}

void expect_no_method_is_worse(std::initializer_list<const char*> machines) {
    for (const char* machine : machines) {
        const auto rows = studied({"two-bell", machine, 8, 6}, asset_folders, Progress());
        ASSERT_EQ(rows.size(), every_study_method.size());
        for (std::size_t n = 0; n < rows.size(); ++n) {
            EXPECT_EQ(rows[n].method, every_study_method[n]);
            ASSERT_TRUE(rows[n].figures) << machine << ": " << rows[n].note;
        }
        const auto mean = [&](StudyMethod method) { return row_of_method(rows, method).figures->error.mean; };
        EXPECT_LE(mean(StudyMethod::elliptic), mean(StudyMethod::uniform)) << machine;
        EXPECT_LE(mean(StudyMethod::redistribution), mean(StudyMethod::uniform)) << machine;
        EXPECT_LE(mean(StudyMethod::harmonic), mean(StudyMethod::uniform)) << machine;
        EXPECT_LT(mean(StudyMethod::tracks), mean(StudyMethod::uniform)) << machine;
        EXPECT_LT(mean(StudyMethod::chain), mean(StudyMethod::uniform)) << machine;
        EXPECT_LE(mean(StudyMethod::sequencing), rounded_up * mean(StudyMethod::chain)) << machine;
        EXPECT_FALSE(row_of_method(rows, StudyMethod::chain).no_gain) << machine;
        for (const StudyMethod method : {StudyMethod::elliptic, StudyMethod::harmonic, StudyMethod::tracks}) {
            const bool same = exactly_equal(mean(method), mean(StudyMethod::uniform));
            EXPECT_EQ(row_of_method(rows, method).no_gain, same) << machine << ", " << label(method);
        }
        const bool nearest = exactly_equal(mean(StudyMethod::sequencing), mean(StudyMethod::chain));
        EXPECT_EQ(row_of_method(rows, StudyMethod::sequencing).no_gain, nearest) << machine;
        EXPECT_LT(mean(StudyMethod::set_up_chain), mean(StudyMethod::set_up)) << machine;
        EXPECT_LE(mean(StudyMethod::everything), rounded_up * mean(StudyMethod::set_up_chain)) << machine;
        const auto offset = [&](StudyMethod method) { return row_of_method(rows, method).figures->offset; };
        for (const auto& [moved, unmoved] : {std::pair{StudyMethod::set_up, StudyMethod::uniform},
                                             std::pair{StudyMethod::set_up_chain, StudyMethod::chain}}) {
            EXPECT_LE(mean(moved), mean(unmoved)) << machine;
            EXPECT_EQ(offset(moved) == offset(unmoved), row_of_method(rows, moved).no_gain) << machine;
            if (std::string_view(machine) == "ca-head") { // its rotary axes do not feel where the part is
                EXPECT_TRUE(exactly_equal(mean(moved), mean(unmoved)));
            }
        }
    }
}

// On the others: TheChainEndsWithTheBestGridOfAll, TheDomeFarFromTheAxisGainsByItsSetUp, and in full.
TEST(KinematicStudy, NoMethodIsWorseThanTheUniformGridOfItsSetUp) {
    expect_no_method_is_worse({"rotary-tilt-listing"});
}

TEST(KinematicStudyInFull, NoMethodIsWorseThanTheUniformGridOfItsSetUp) {
    expect_no_method_is_worse({"rotary-tilt-listing", "bc-table-head", "ca-head"});
}

/// By the surface curve the chain's own grid is the best there, on the finished part it is not.
TEST(KinematicStudy, TheChainEndsWithTheBestGridOfAll) {
    const auto rows = studied({"saddle", "bc-table-head", 12, 8}, asset_folders, Progress());
    const StudyFigures& chain = *row_of_method(rows, StudyMethod::chain).figures;
    const StudyFigures& uniform = *row_of_method(rows, StudyMethod::uniform).figures;
    EXPECT_LE(chain.error.lmean, uniform.error.lmean);
    int compared = 0;
    for (const StudyMethod other :
         {StudyMethod::redistribution, StudyMethod::elliptic, StudyMethod::harmonic, StudyMethod::tracks}) {
        const StudyFigures& found = *row_of_method(rows, other).figures;
        if (found.track_gap <= 1.15 * uniform.track_gap && found.error.lmean <= uniform.error.lmean) {
            EXPECT_LE(chain.error.max * chain.error.mean, found.error.max * found.error.mean) << label(other);
            ++compared;
        }
    }
    EXPECT_GE(compared, 2);
    EXPECT_THAT(row_of_method(rows, StudyMethod::chain).note,
                HasSubstr("On the finished part no stage of the chain"));
}

TEST(KinematicStudy, TheDomeFarFromTheAxisGainsByItsSetUp) {
    const auto rows = studied({"dome", "rotary-tilt-listing", 10, 6}, asset_folders, Progress());
    EXPECT_LT(row_of_method(rows, StudyMethod::set_up).figures->error.mean,
              0.7 * row_of_method(rows, StudyMethod::uniform).figures->error.mean);
}

TEST(KinematicStudy, CoversFourSurfacesOnThreeMachines) {
    EXPECT_EQ(full_study().size(), 4U * 3U * 5U);
    EXPECT_EQ(quick_study().size(), 4U * 3U);
}

// It stood at its end from the first row on.
TEST(KinematicStudy, ItsProgressGoesWithItsWork) {
    std::optional<double> at_the_chain;
    const Progress progress(
        [&](const Progress::Report& report) {
            if (!at_the_chain && report.text == "Moving all nodes at once") {
                at_the_chain = report.fraction;
            }
        },
        {});
    (void)studied({"dome", "ca-head", 6, 4}, asset_folders, progress);
    ASSERT_TRUE(at_the_chain.has_value());
    EXPECT_LT(*at_the_chain, 0.3);
}

TEST(KinematicStudy, RefusesWhatItDoesNotKnow) {
    EXPECT_THROW((void)studied({"dune", "ca-head", 8, 6}, asset_folders, Progress()), Error);
    EXPECT_THROW((void)studied({"dome", "no-machine", 8, 6}, asset_folders, Progress()), Error);
}

std::vector<StudyRow> two_rows() {
    StudyFigures figures;
    figures.error.max = 1.5;
    figures.error.mean = 0.25;
    figures.error.axis_max = 0.1;
    figures.offset = {1.0, 2.0, 3.0};
    const StudyCase of{"dome", "ca-head", 15, 20};
    std::vector<StudyRow> rows;
    for (const StudyMethod method : every_study_method) {
        rows.push_back({of, method, figures, {}});
    }
    rows[1].no_gain = true;
    rows[7].loss = "largest +3.1 %";
    rows.back().figures.reset();
    rows.back().note = "a \"pose\", out of reach";
    return rows;
}

TEST(KinematicStudyText, ForSpreadsheetsNamesEveryColumn) {
    const std::string text = study_csv(two_rows());
    EXPECT_THAT(text, StartsWith("surface,machine,points,tracks,method,max_mm,mean_mm,"));
    EXPECT_THAT(text, HasSubstr("\ndome,ca-head,15,20,uniform,1.500000,0.250000,"));
    EXPECT_THAT(text, HasSubstr(",,1.0000,2.0000,3.0000,\"\"\n")) << "no program, no time";
    EXPECT_THAT(text,
                HasSubstr("\ndome,ca-head,15,20,all three,,,,,,,,,,,,,,\"a \"\"pose\"\", out of reach\"\n"));
    const auto commas = [](const std::string& line) { return std::ranges::count(line, ','); };
    EXPECT_EQ(commas(text.substr(0, text.find('\n'))), 18);
}

TEST(KinematicStudyText, ForProgramsIsJson) {
    const auto json = nlohmann::json::parse(study_json(two_rows()));
    ASSERT_EQ(json.at("rows").size(), every_study_method.size());
    EXPECT_EQ(json.at("rows")[0].at("figures").at("max_mm"), 1.5);
    EXPECT_TRUE(json.at("rows")[0].at("figures").at("time_s").is_null());
    EXPECT_FALSE(json.at("rows")[0].at("no_gain"));
    EXPECT_TRUE(json.at("rows")[1].at("no_gain"));
    EXPECT_EQ(json.at("rows")[7].at("loss"), "largest +3.1 %");
    EXPECT_TRUE(json.at("rows").back().at("figures").is_null());
}

TEST(KinematicStudyText, ForPeopleIsATableASurfaceAndMachine) {
    const std::string text = study_markdown(two_rows());
    EXPECT_THAT(text, HasSubstr("## dome on ca-head, 20 tracks"));
    EXPECT_THAT(text,
                HasSubstr("| points | uniform | 1-D shares | elliptic | harmonic map | tracks | chain | "
                          "chain + sequence | set-up | set-up + chain | all three "
                          "|\n|---|---|"));
    EXPECT_THAT(text, HasSubstr("\n| 15 | 1.500 / 0.2500 / 5.7 | 1.500 / 0.2500 / 5.7 (no gain) | 1.500"));
    EXPECT_THAT(text, HasSubstr("5.7 (largest +3.1 %) | 1.500"));
    EXPECT_THAT(text, HasSubstr("| out of reach |\n"));
}

} // namespace
} // namespace millwright::studies
