// The study of the kinematic error as pictures: largest error, mean error and largest axis deviation.
#pragma once

#include "app/command_line/output_transaction.h"
#include "core/studies/kinematic_study.h"

#include <string>
#include <vector>

namespace millwright::app {

/// Of the file of this surface and machine.
[[nodiscard]] std::string study_picture_name(const studies::StudyCase& of);

/// A PNG file a surface and machine: a curve a method over the numbers of points, or a bar a method where
/// there is one number. `rows` as studies::studied gives them, case after case.
[[nodiscard]] std::vector<OutputFile> study_pictures(const std::vector<studies::StudyRow>& rows);

} // namespace millwright::app
