#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/body_model/body_model.h"
#include "services/anthropometer/core/body_report.h"

namespace deixis::anthropometer {

enum class StartingPose { kStanding, kRest };

/// One angle of a pose.
struct AngleSetting {
  std::string limb;
  std::string angle;
  double angle_deg = 0.0;
};

/// The command line of deixis-body.
struct Arguments {
  anthropometry::Sex sex = anthropometry::Sex::kFemale;
  std::optional<double> stature_m;
  std::optional<double> percentile;  ///< Neither = the median.
  std::string model = "whole_body_detailed";
  ReportRequest request;
  StartingPose pose = StartingPose::kStanding;
  std::vector<AngleSetting> angles;
  std::string body_id = "default";
  std::filesystem::path png, urdf, ply;  ///< Files to write; empty = none.
};

/// Ends the program after --help and --version, and when the command line is not understood.
Arguments Parse(int argc, char** argv);

/// Throws ConfigError, with all names, for an angle that the model lacks or its joint cannot take.
body_model::BodyPose PoseOf(const body_model::BodyModel& model, const Arguments& arguments);

/// Read from config/kinematics.
anthropometry::BodyMeasures ShippedMeasures();
anatomy::JointLimits ShippedLimits();

}  // namespace deixis::anthropometer
