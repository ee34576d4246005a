// The shipped router, as drivers and virtual axes take it.
#pragma once

#include "tests/support/machines.h"

#include <memory>

namespace millwright::test {

inline std::shared_ptr<const kinematics::MachineModel> router() {
    return std::make_shared<const kinematics::MachineModel>(machine("router-xyz"));
}

} // namespace millwright::test
