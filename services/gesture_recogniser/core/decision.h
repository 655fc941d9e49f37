#pragma once
#include <optional>
#include <vector>

#include "services/gesture_recogniser/core/gesture_model.h"
#include "services/gesture_recogniser/core/hand_recogniser.h"

namespace deixis::gesture_recogniser {

/// Index of the largest value; -1 when there is none above 0.
int Largest(const std::vector<double>& values);

/// Which object a completed model means: the one with the largest weight sum (Hofemann 2004, Eq.
/// 6), if that exceeds `object_share` (T_O) of the end probability. Without one, a model whose
/// context is optional or unused is recognised without an object, and one that requires it is not
/// recognised.
std::optional<Decision> DecideByWeight(double end_probability,
                                       const std::vector<double>& target_weight,
                                       double object_share, ContextNeed need);

}  // namespace deixis::gesture_recogniser
