#include "services/pose_fitter/core/start/searched_places.h"

#include <algorithm>

namespace deixis::pose_fitter {
namespace {

constexpr double kSame_m = 0.25;      // Places nearer than this are one.
constexpr double kLongestWait = 4.0;  // In periods.
constexpr double kForget = 8.0;       // Likewise.

}  // namespace

bool SearchedPlaces::IsDue(const Eigen::Vector3d& centre_m, double time_s) const {
  const Place* place = At(centre_m);
  return place == nullptr || time_s < place->searched_s ||
         time_s - place->searched_s >= place->wait_s;
}

void SearchedPlaces::NoteFound(const Eigen::Vector3d& centre_m, double time_s) {
  Note({centre_m, time_s, period_s_});
}

void SearchedPlaces::NoteInVain(const Eigen::Vector3d& centre_m, double time_s) {
  const Place* place = At(centre_m);
  const double wait_s = place == nullptr ? period_s_ : 2.0 * place->wait_s;
  Note({centre_m, time_s, std::min(wait_s, kLongestWait * period_s_)});
}

const SearchedPlaces::Place* SearchedPlaces::At(const Eigen::Vector3d& centre_m) const {
  const auto found = std::find_if(places_.begin(), places_.end(), [&](const Place& place) {
    return (place.centre_m - centre_m).norm() < kSame_m;
  });
  return found == places_.end() ? nullptr : &*found;
}

void SearchedPlaces::Note(const Place& place) {
  const auto is_over = [&](const Place& other) {
    return (other.centre_m - place.centre_m).norm() < kSame_m ||
           other.searched_s > place.searched_s ||
           place.searched_s - other.searched_s > kForget * period_s_;
  };
  places_.erase(std::remove_if(places_.begin(), places_.end(), is_over), places_.end());
  places_.push_back(place);
}

}  // namespace deixis::pose_fitter
