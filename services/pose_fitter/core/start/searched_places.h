#pragma once
#include <Eigen/Core>
#include <vector>

namespace deixis::pose_fitter {

/// Where people were looked for, so that what is nobody (furniture, mostly) is not fitted in each
/// image anew: after each time in vain the next one comes later.
class SearchedPlaces {
 public:
  /// Searches of one place are `period_s` apart, or up to four times as much when they are in vain.
  explicit SearchedPlaces(double period_s) : period_s_(period_s) {}

  void Clear() { places_.clear(); }
  /// Whether somebody at `centre_m` (the camera's frame) may be looked for now.
  bool IsDue(const Eigen::Vector3d& centre_m, double time_s) const;
  void NoteFound(const Eigen::Vector3d& centre_m, double time_s);
  void NoteInVain(const Eigen::Vector3d& centre_m, double time_s);

 private:
  struct Place {
    Eigen::Vector3d centre_m;
    double searched_s = 0.0;
    double wait_s = 0.0;
  };
  const Place* At(const Eigen::Vector3d& centre_m) const;
  void Note(const Place& place);

  double period_s_;
  std::vector<Place> places_;
};

}  // namespace deixis::pose_fitter
