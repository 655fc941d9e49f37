#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "common/body_model/body_model.h"

namespace deixis::body_model {

/// FNV-1a over all that a model says, numbers by their bits; never 0.
std::int64_t ContentHash(const std::string& name, const std::vector<Limb>& limbs);

}  // namespace deixis::body_model
