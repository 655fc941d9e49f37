#include "services/pose_fitter/core/people/person_shape.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace deixis::pose_fitter {
namespace {

constexpr int kLeastContact = 4;      // Pairs of pixels, below which a contact is chance.
constexpr double kLimbArea_m2 = 0.2;  // Larger pieces are no limb that hides from its trunk.
constexpr double kWholePerson_m2 = 0.3;
constexpr double kApart_m = 0.25;  // Along the floor, between pieces of one person above another.

double AcrossFloor(const SurfaceShape& shape) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(shape.Covariance().topLeftCorner<2, 2>(), Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
}

}  // namespace

void PersonShapeConfig::Validate() const {
  config::Faults faults;
  faults.Require(least_area_m2 > 0.0, "least_area_m2", "must be positive");
  faults.Require(largest_area_m2 > least_area_m2, "largest_area_m2",
                 "must be larger than least_area_m2");
  faults.Require(lowest_top_m >= 0.0, "lowest_top_m", "must not be negative");
  faults.Require(highest_top_m > lowest_top_m, "highest_top_m", "must be larger than lowest_top_m");
  faults.Require(largest_span_m > 0.0, "largest_span_m", "must be positive");
  faults.Require(largest_depth_m > 0.0, "largest_depth_m", "must be positive");
  faults.Require(least_height_m >= 0.0, "least_height_m", "must not be negative");
  faults.Require(flat_m >= 0.0, "flat_m", "must not be negative");
  faults.Require(largest_step_m > 0.0, "largest_step_m", "must be positive");
  faults.ThrowIfAny();
}

bool IsTooLarge(const PersonShapeConfig& config, const SurfaceShape& shape) {
  const Eigen::Vector3d extent_m = shape.Extent();
  const double span_m = std::max(extent_m.x(), extent_m.y());
  const double across_m = 4.0 * AcrossFloor(shape);  // Of an even spread, and a bit.
  return shape.area_m2 > config.largest_area_m2 || span_m > config.largest_span_m ||
         across_m > config.largest_depth_m || shape.highest_m.z() > config.highest_top_m;
}

bool IsFlat(const PersonShapeConfig& config, const SurfaceShape& shape) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(shape.Covariance(), Eigen::EigenvaluesOnly);
  const double noise_m2 = shape.MeanSigma() * shape.MeanSigma();
  return solver.eigenvalues()[0] < config.flat_m * config.flat_m + noise_m2;
}

bool MayBePerson(const PersonShapeConfig& config, const SurfaceShape& shape) {
  return shape.area_m2 >= config.least_area_m2 && !IsTooLarge(config, shape) &&
         shape.highest_m.z() >= config.lowest_top_m &&
         shape.Extent().z() >= config.least_height_m && !IsFlat(config, shape);
}

PersonGroups::PersonGroups() {
  pairs_.reserve(static_cast<std::size_t>(SurfacePieces::kMost * SurfacePieces::kMost));
  for (auto* shapes : {&joined_, &shapes_, &cores_}) shapes->reserve(SurfacePieces::kMost);
  for (auto* owners : {&owner_of_root_, &owners_}) owners->reserve(SurfacePieces::kMost);
  for (auto* numbers : {&roots_, &groups_, &group_of_core_}) numbers->reserve(SurfacePieces::kMost);
}

void PersonGroups::Form(const PersonShapeConfig& config, const SurfacePieces& pieces,
                        const std::vector<std::uint8_t>& owners) {
  joined_.clear();
  roots_.clear();
  owner_of_root_.assign(owners.begin(), owners.end());
  for (int i = 0; i < pieces.count(); ++i) {
    const SurfaceShape& shape = pieces.shape(i);
    const bool is_room = IsTooLarge(config, shape) ||
                         (shape.area_m2 > kLimbArea_m2 ? IsFlat(config, shape) : pieces.IsAtTop(i));
    joined_.push_back(shape);
    roots_.push_back(is_room && owners[static_cast<std::size_t>(i)] == 0 ? -1 : i);
  }
  JoinOwned(owners);
  JoinPieces(config, pieces);
  Number(config, pieces);
}

void PersonGroups::JoinOwned(const std::vector<std::uint8_t>& owners) {
  std::array<int, 256> first;
  first.fill(-1);
  for (std::size_t i = 0; i < owners.size(); ++i) {
    int& root = first[owners[i]];
    if (owners[i] == 0) continue;
    if (root < 0) {
      root = static_cast<int>(i);
    } else {
      Join(root, static_cast<int>(i));
    }
  }
}

void PersonGroups::Join(int a, int b) {
  joined_[static_cast<std::size_t>(a)].Add(joined_[static_cast<std::size_t>(b)]);
  roots_[static_cast<std::size_t>(b)] = a;
  auto& owner = owner_of_root_[static_cast<std::size_t>(a)];
  owner = std::max(owner, owner_of_root_[static_cast<std::size_t>(b)]);
}

int PersonGroups::Root(int piece) {
  int root = roots_[static_cast<std::size_t>(piece)];
  while (root >= 0 && roots_[static_cast<std::size_t>(root)] != root) {
    root = roots_[static_cast<std::size_t>(root)];
  }
  return root;
}

void PersonGroups::JoinPieces(const PersonShapeConfig& config, const SurfacePieces& pieces) {
  pairs_.clear();
  for (int a = 0; a < pieces.count(); ++a) {
    for (int b = a + 1; b < pieces.count(); ++b) {
      if (roots_[static_cast<std::size_t>(a)] < 0 || roots_[static_cast<std::size_t>(b)] < 0) {
        continue;
      }
      const Contact& contact = pieces.contact(a, b);
      const Eigen::Vector3d apart_m = pieces.shape(a).Mean() - pieces.shape(b).Mean();
      if (contact.count >= kLeastContact) {
        const float step_m = contact.sum_step_m / static_cast<float>(contact.count);
        if (static_cast<double>(step_m) < config.largest_step_m) pairs_.push_back({step_m, a, b});
      } else if (apart_m.head<2>().norm() < kApart_m) {
        pairs_.push_back({static_cast<float>(config.largest_step_m + apart_m.norm()), a, b});
      }
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& left, const Pair& right) {
    return std::tie(left.cost, left.a, left.b) < std::tie(right.cost, right.a, right.b);
  });
  for (const Pair& pair : pairs_) {
    const int a = std::min(Root(pair.a), Root(pair.b));  // The larger one.
    const int b = std::max(Root(pair.a), Root(pair.b));
    if (a != b && MayJoin(config, a, b)) Join(a, b);
  }
}

/// Two whole people stay two.
bool PersonGroups::MayJoin(const PersonShapeConfig& config, int a, int b) const {
  const SurfaceShape& one = joined_[static_cast<std::size_t>(a)];
  const SurfaceShape& other = joined_[static_cast<std::size_t>(b)];
  if (std::min(one.area_m2, other.area_m2) > kWholePerson_m2) return false;
  if (owner_of_root_[static_cast<std::size_t>(a)] != 0 &&
      owner_of_root_[static_cast<std::size_t>(b)] != 0) {
    return false;
  }
  SurfaceShape both = one;
  both.Add(other);
  return !IsTooLarge(config, both);
}

void PersonGroups::Number(const PersonShapeConfig& config, const SurfacePieces& pieces) {
  shapes_.clear();
  cores_.clear();
  owners_.clear();
  groups_.assign(static_cast<std::size_t>(pieces.count()), -1);
  group_of_core_.assign(static_cast<std::size_t>(pieces.count()), -1);
  for (int i = 0; i < pieces.count(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (Root(i) != i || (owner_of_root_[at] == 0 && !MayBePerson(config, joined_[at]))) continue;
    for (int piece = 0; piece < pieces.count(); ++piece) {
      if (Root(piece) == i) groups_[static_cast<std::size_t>(piece)] = count();
    }
    group_of_core_[at] = count();
    owners_.push_back(owner_of_root_[at]);
    shapes_.push_back(joined_[at]);
    cores_.push_back(pieces.shape(i));
  }
}

}  // namespace deixis::pose_fitter
