// Motion in time: a program becomes a Trajectory, the axes as functions of time within the machine's speeds
// and accelerations; from it the time estimate, the simulation and what the virtual machine does.
#pragma once

#include "core/motion/hold.h"
#include "core/motion/planner.h"
#include "core/motion/step_pulses.h"
#include "core/motion/time_estimate.h"
#include "core/motion/trajectory.h"
