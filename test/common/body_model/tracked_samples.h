#pragma once
#include <random>

#include "common/body_model/tracked_body.h"

namespace deixis::body_model {

/// When the samples hold.
constexpr Timestamp kSampleTime{1'700'000'000'123'456};

/// A person of that shape, nothing about whom is as by default.
PersonModel PersonOf(BodyModel body);

/// A body in any pose, nothing about which is as by default; its covariance has full rank, each
/// entry is another one and exact in single precision.
TrackedBody BodyOf(const BodyModel& model, std::mt19937& random);

/// That body alone, on a floor.
BodyPoses PosesOf(const TrackedBody& body);

}  // namespace deixis::body_model
