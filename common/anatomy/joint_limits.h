#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/anatomy/terms.h"

namespace deixis::anatomy {

/// In which posture a limit was taken.
enum class Posture {
  kAny,
  kStanding,
  kStretched,
  kHanging,    ///< The foot without load.
  kFlexedBy90  ///< The joint itself bent by 90 degrees.
};

inline auto EnumNames(Posture) {
  return std::vector<std::pair<std::string, Posture>>{{"any", Posture::kAny},
                                                      {"standing", Posture::kStanding},
                                                      {"stretched", Posture::kStretched},
                                                      {"hanging", Posture::kHanging},
                                                      {"flexed_90", Posture::kFlexedBy90}};
}

/// One row of the source's list: how far a joint moves from the neutral-zero stance.
struct JointLimit {
  std::string joint;
  Posture posture = Posture::kAny;
  std::string motion;
  double low_deg = 0.0;   ///< The source gives some limits as ranges;
  double high_deg = 0.0;  ///< else both are the same.
  bool is_to_both_sides = false;
  std::string printed;  ///< What the source prints instead; empty = the same.
  std::string why;      ///< Why it is another one here.
};

/// "Values of human kinematics", section 2: the whole list.
class JointLimits {
 public:
  /// Reads config/kinematics/joint_limits.yaml. Throws ConfigError naming file, line and key: a
  /// joint or motion without names, a row twice, low above high, angles beyond 0..360.
  static JointLimits Load(const std::filesystem::path& path);

  const std::vector<NamedTerm>& joints() const { return joints_; }
  const std::vector<NamedTerm>& motions() const { return motions_; }
  const std::vector<JointLimit>& rows() const { return rows_; }

  /// The rows of a joint, which `name` names in any language or by its key.
  std::vector<JointLimit> Of(const std::string& name) const;
  /// Throws std::logic_error when there is no such row.
  const JointLimit& At(const std::string& joint, Posture posture, const std::string& motion) const;

 private:
  std::vector<NamedTerm> joints_;
  std::vector<NamedTerm> motions_;
  std::vector<JointLimit> rows_;
};

}  // namespace deixis::anatomy
