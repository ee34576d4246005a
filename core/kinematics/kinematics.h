// Machines: an ordered chain of linear and rotary axes between workpiece and tool, read from a JSON file;
// where the tool is for given axis positions, every axis position for a given tool pose, and the Jacobian.
// Lengths mm, angles rad. Sense of every axis: docs/reference/kinematics.md.
#pragma once

#include "core/kinematics/branch.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/inverse.h"
#include "core/kinematics/machine_file.h"
#include "core/kinematics/machine_model.h"
