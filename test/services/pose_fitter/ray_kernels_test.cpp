#include "services/pose_fitter/core/fitting/ray_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "test/services/pose_fitter/synthetic_person.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

constexpr float kSigma_m = 0.01F, kAcross_m = 0.012F;
constexpr float kWorst = 1e9F;

LimbSurface SurfaceOf(const Eigen::Isometry3d& camera_from_limb,
                      const geometry::DegenerateCylinder& shape) {
  LimbSurface surface{};
  const Vector3d camera_m = camera_from_limb.inverse().translation();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      surface.camera_from_limb[3 * row + column] =
          static_cast<float>(camera_from_limb.linear()(row, column));
    }
    surface.camera_in_limb_m[row] = static_cast<float>(camera_m[row]);
  }
  const auto set = [](float& to, double value) { to = static_cast<float>(value); };
  set(surface.a0_m, shape.a0_m);
  set(surface.b0_m, shape.b0_m);
  set(surface.a1_m, shape.a1_m);
  set(surface.b1_m, shape.b1_m);
  set(surface.length_m, shape.length_m);
  set(surface.x0_m, shape.centre0_m.x());
  set(surface.y0_m, shape.centre0_m.y());
  set(surface.x1_m, shape.centre1_m.x());
  set(surface.y1_m, shape.centre1_m.y());
  return surface;
}

/// Limbs of a clothed person, in any direction, two metres away.
class RayKernelsTest : public ::testing::Test {
 protected:
  void MakeLimb() {
    const auto& limbs = body_.limbs();
    shape_ = limbs[std::uniform_int_distribution<std::size_t>(0, limbs.size() - 1)(random_)].shape;
    const Vector3d at(Uniform(-0.5, 0.5), Uniform(-0.5, 0.5), Uniform(1.5, 2.5));
    place_ =
        Eigen::Translation3d(at) *
        Eigen::Quaterniond(Eigen::Vector4d(Normal(), Normal(), Normal(), Normal()).normalized());
    surface_ = SurfaceOf(place_, shape_);
  }
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double Normal() { return std::normal_distribution<double>()(random_); }
  /// Of the limb's side, in the camera's frame, and the outward normal there.
  std::pair<Vector3d, Vector3d> OnSide() {
    const double phi_rad = Uniform(-M_PI, M_PI), s = Uniform(0.1, 0.9);
    return {place_ * geometry::SidePoint(shape_, phi_rad, s),
            place_.linear() * geometry::SideNormal(shape_, phi_rad, s)};
  }
  /// Rays along a limb that tapers are only roughly met; grazing ones jump from front to back.
  bool IsSeenFromBeside(const Vector3d& on_side_m, const Vector3d& normal) const {
    const Vector3d ray = on_side_m.normalized();
    if (normal.dot(ray) > -0.4 || std::abs(place_.linear().col(2).dot(ray)) > 0.5) return false;
    const auto depth_m = test::DepthOn(shape_, place_, on_side_m / on_side_m.z());
    return depth_m && std::abs(*depth_m - on_side_m.z()) < 0.001;
  }
  static RayPoints One(const Eigen::Vector3f& point_m) {
    return {&point_m[0], &point_m[1], &point_m[2], &kSigma_m, 1};
  }
  float ScoreOf(const Vector3d& point_m, int& winner) const {
    const Eigen::Vector3f point = point_m.cast<float>();
    float score2 = kWorst;
    ScoreLimb(surface_, 4, kAcross_m, One(point), {&score2, &winner});
    return std::sqrt(score2);
  }
  LimbSums SumsOf(const Vector3d& point_m) const {
    const Eigen::Vector3f point = point_m.cast<float>();
    LimbSums sums{};
    SumLimb(surface_, {{0.1F, 0.2F, 2.0F}, 0.1F, kAcross_m}, One(point), sums);
    return sums;
  }

  /// Of points 50 mm behind many limbs' sides, in depth: `distance_m` finds that, but for a few.
  template <typename Distance>
  void ExpectFound(double most_wrong, const Distance& distance_m) {
    int met = 0, wrong = 0;
    for (int i = 0; i < 3000; ++i) {
      MakeLimb();
      const auto [point_m, normal] = OnSide();
      if (!IsSeenFromBeside(point_m, normal)) continue;
      ++met;
      const double z_m = point_m.z() + 0.05;
      wrong += std::abs(distance_m(point_m * (z_m / point_m.z()), normal) - 0.05) > 0.003;
    }
    EXPECT_GT(met, 300);
    EXPECT_LT(wrong, most_wrong * met);
  }

  body_model::BodyModel body_ = test::ClothedBody();
  std::mt19937 random_{5};
  geometry::DegenerateCylinder shape_;
  Eigen::Isometry3d place_;
  LimbSurface surface_{};
};

TEST_F(RayKernelsTest, MeasureLimbsWhereExactWalksAlongRaysFromBesideMeetThem) {
  ExpectFound(0.02, [this](const Vector3d& behind_m, const Vector3d& normal) {
    const double along_normal = std::abs(normal.dot(behind_m / behind_m.z()));
    return std::sqrt(static_cast<double>(SumsOf(behind_m).values[29])) / along_normal;
  });
}

TEST_F(RayKernelsTest, ScoreLimbsWhereExactWalksAlongRaysFromBesideMeetThem) {
  ExpectFound(0.04, [this](const Vector3d& behind_m, const Vector3d&) {
    int winner = -1;
    const float score = ScoreOf(behind_m, winner);
    EXPECT_EQ(winner, 4);
    return static_cast<double>(score * kSigma_m);
  });
}

TEST_F(RayKernelsTest, GiveRaysThatPassByAboutTheDistanceOfTheirPoints) {
  int passed = 0, wrong = 0;
  for (int i = 0; i < 3000; ++i) {
    MakeLimb();
    const Vector3d point_m =
        place_ * Vector3d(Uniform(-0.3, 0.3), Uniform(-0.3, 0.3), Uniform(-0.2, 0.7));
    if (test::DepthOn(shape_, place_, point_m / point_m.z())) continue;
    ++passed;
    const double exact_m =
        geometry::FindClosest(shape_, place_.inverse() * point_m).signed_distance_m;
    int winner = -1;
    const double said_m = static_cast<double>(ScoreOf(point_m, winner) * kAcross_m);
    EXPECT_GT(said_m, 0.5 * exact_m - 0.005);
    wrong += std::abs(said_m - exact_m) > 0.01 + 0.25 * exact_m;
  }
  EXPECT_GT(passed, 1000);
  EXPECT_LT(wrong, passed / 20);
}

TEST_F(RayKernelsTest, KeepABetterScoreOfAnotherLimb) {
  MakeLimb();
  const auto point = Eigen::Vector3f(5.0F, 5.0F, 1.0F);
  float score2 = 0.001F;
  int winner = 2;
  ScoreLimb(surface_, 4, kAcross_m, One(point), {&score2, &winner});
  EXPECT_EQ(winner, 2);
  EXPECT_FLOAT_EQ(score2, 0.001F);
}

TEST_F(RayKernelsTest, PullAlongTheNormalByTheDistance) {
  int tried = 0, wrong = 0;
  for (int i = 0; i < 2000; ++i) {
    MakeLimb();
    const auto [on_side_m, normal] = OnSide();
    if (!IsSeenFromBeside(on_side_m, normal)) continue;
    ++tried;
    const double off_m = 0.004, facing = -normal.dot(on_side_m.normalized());
    const LimbSums sums = SumsOf(on_side_m * (1.0 - off_m / facing / on_side_m.norm()));
    const double residual_m = std::sqrt(static_cast<double>(sums.values[29]));
    const Vector3d pull =
        Eigen::Map<const Eigen::Vector3f>(sums.values + 24).cast<double>().normalized();
    wrong += std::abs(residual_m - off_m) > 0.001 || pull.dot(normal) < 0.99;
  }
  EXPECT_GT(tried, 200);
  EXPECT_LT(wrong, tried / 30);
}

TEST_F(RayKernelsTest, SumMomentsAboutTheRoot) {
  for (int i = 0; i < 200; ++i) {
    MakeLimb();
    const auto [on_side_m, normal] = OnSide();
    if (!IsSeenFromBeside(on_side_m, normal)) continue;
    const LimbSums sums = SumsOf(on_side_m * 0.998);
    const auto part = [&sums](int first) {
      return Vector3d(Eigen::Map<const Eigen::Vector3f>(sums.values + first).cast<double>());
    };
    const Vector3d force = part(24), moment = part(21);
    const Vector3d expected = (on_side_m - Vector3d(0.1, 0.2, 2.0)).cross(force);
    EXPECT_LT((moment - expected).norm(), 0.02 * force.norm());
  }
}

TEST_F(RayKernelsTest, StayFiniteWhereverPointsAre) {
  for (int i = 0; i < 3000; ++i) {
    MakeLimb();
    const Vector3d point_m = i % 3 == 0 ? Vector3d(place_ * Vector3d(0.0, 0.0, Uniform(-0.1, 0.6)))
                                        : Vector3d(Normal(), Normal(), Uniform(0.001, 65.0));
    int winner = -1;
    EXPECT_TRUE(std::isfinite(ScoreOf(point_m, winner)));
    for (const float value : SumsOf(point_m).values) EXPECT_TRUE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace deixis::pose_fitter
