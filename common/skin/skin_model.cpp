#include "common/skin/skin_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/core/types.hpp>
#include <vector>

namespace deixis::skin {
namespace {

/// A Gaussian over (ln R/G, ln G/B, ln brightness).
class ColourGaussian {
 public:
  ColourGaussian(const Eigen::Vector3d& mean, const Eigen::Matrix3d& covariance)
      : mean_(mean),
        information_(covariance.inverse()),
        scale_(std::pow(2.0 * M_PI, -1.5) / std::sqrt(covariance.determinant())) {}

  double Density(const LogChromaticity& colour) const {
    return scale_ * std::exp(-0.5 * SquaredDistance(colour));
  }
  double SquaredDistance(const LogChromaticity& colour) const {
    const Eigen::Vector3d offset =
        Eigen::Vector3d(colour.red_green, colour.green_blue, colour.luminance) - mean_;
    return offset.dot(information_ * offset);
  }

 private:
  Eigen::Vector3d mean_;
  Eigen::Matrix3d information_;
  double scale_;
};

Eigen::Matrix3d Symmetric(double xx, double xy, double yy, double xz, double yz, double zz) {
  return (Eigen::Matrix3d() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
}

// Moments of labelled skin and other pixels of the UCI skin set (Bhatt and Dhall, CC BY 4.0) and of
// the Pratheepan set (Tan et al. 2012), the two weighed alike; measured by us, see the README.
const ColourGaussian& GenericSkin() {
  static const ColourGaussian gaussian({0.346, 0.257, 4.95},
                                       Symmetric(0.0267, 0.0162, 0.0402, -0.0417, -0.0347, 0.139));
  return gaussian;
}

// Mean and sigma of ln(brightness) of what is not skin.
constexpr double kOtherLuminance = 4.45;
constexpr double kOtherLuminanceSigma = 0.9;  // Root of the 0.80 below, rounded.

const ColourGaussian& GenericOther() {
  static const ColourGaussian gaussian({0.23, 0.11, kOtherLuminance},
                                       Symmetric(0.33, 0.008, 0.14, -0.096, -0.013, 0.80));
  return gaussian;
}

/// Density of ln(brightness) alone, so that a 2D histogram compares with the generic 3D densities.
double LuminanceDensity(double luminance, double mean, double sigma) {
  const double z = (luminance - mean) / sigma;
  return std::exp(-0.5 * z * z) / (sigma * std::sqrt(2.0 * M_PI));
}

/// Share by which a running mean of time constant `time_s` moves after `elapsed_s`.
double Share(double elapsed_s, double time_s) {
  return 1.0 - std::exp(-std::max(0.0, elapsed_s) / time_s);
}

LogChromaticity ColourAt(const cv::Mat& bgr, int x, int y) {
  const auto& pixel = bgr.at<cv::Vec3b>(y, x);
  return ToLogChromaticity(pixel[0], pixel[1], pixel[2]);
}

/// The inner ellipse of a face box: no hair, little background.
std::vector<LogChromaticity> FaceColours(const cv::Mat& bgr, const scene::Box& face) {
  const Eigen::Vector2d centre = scene::Centre(face);
  const double radius_x = 0.32 * face.width_px;
  const double radius_y = 0.40 * face.height_px;
  const int top = std::max(0, static_cast<int>(centre.y() - radius_y));
  const int bottom = std::min(bgr.rows - 1, static_cast<int>(centre.y() + radius_y));
  const int left = std::max(0, static_cast<int>(centre.x() - radius_x));
  const int right = std::min(bgr.cols - 1, static_cast<int>(centre.x() + radius_x));
  std::vector<LogChromaticity> colours;
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const double u = (x - centre.x()) / radius_x;
      const double v = (y - centre.y()) / radius_y;
      if (u * u + v * v <= 1.0) colours.push_back(ColourAt(bgr, x, y));
    }
  }
  return colours;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Leaves out eyes, lips, glasses, beard: what is far from generic skin or from the face's median.
std::vector<LogChromaticity> KeepSkin(const std::vector<LogChromaticity>& colours) {
  constexpr double kGenericGate = 14.0;  // Squared Mahalanobis distance.
  constexpr double kChromaGate = 0.22;   // From the median, in either logarithm.
  std::vector<LogChromaticity> plausible;
  std::vector<double> red_green;
  std::vector<double> green_blue;
  for (const LogChromaticity& colour : colours) {
    if (GenericSkin().SquaredDistance(colour) > kGenericGate) continue;
    plausible.push_back(colour);
    red_green.push_back(colour.red_green);
    green_blue.push_back(colour.green_blue);
  }
  if (plausible.empty()) return plausible;
  const double median_rg = Median(red_green);
  const double median_gb = Median(green_blue);
  plausible.erase(std::remove_if(plausible.begin(), plausible.end(),
                                 [&](const LogChromaticity& colour) {
                                   return std::abs(colour.red_green - median_rg) > kChromaGate ||
                                          std::abs(colour.green_blue - median_gb) > kChromaGate;
                                 }),
                  plausible.end());
  return plausible;
}

double MeanLuminance(const std::vector<LogChromaticity>& colours) {
  double sum = 0.0;
  for (const LogChromaticity& colour : colours) sum += colour.luminance;
  return sum / static_cast<double>(colours.size());
}

}  // namespace

void SkinModelConfig::Validate() const {
  const auto is_share = [](double value) { return value > 0.0 && value < 1.0; };
  config::Faults faults;
  faults.Require(is_share(skin_share), "skin_share", "must lie between 0 and 1");
  faults.Require(is_share(face_weight), "face_weight", "must lie between 0 and 1");
  faults.Require(is_share(scene_weight), "scene_weight", "must lie between 0 and 1");
  faults.Require(face_time_s > 0.0, "face_time_s", "must be positive");
  faults.Require(scene_time_s > 0.0, "scene_time_s", "must be positive");
  faults.Require(luminance_spread > 0.0, "luminance_spread", "must be positive");
  faults.ThrowIfAny();
}

SkinModel::SkinModel(const SkinModelConfig& config) : config_(config) { RebuildTable(); }

bool SkinModel::LearnFromFace(const cv::Mat& bgr, const scene::Box& face, double elapsed_s) {
  constexpr double kLeastShare = 0.35;  // Of the face's inner ellipse that must look like skin.
  constexpr std::size_t kLeastPixels = 20;
  const auto all = FaceColours(bgr, face);
  const auto colours = KeepSkin(all);
  if (colours.size() < kLeastPixels ||
      static_cast<double>(colours.size()) < kLeastShare * static_cast<double>(all.size())) {
    return false;
  }
  ColourHistogram seen;
  for (const LogChromaticity& colour : colours) seen.Add(colour, 1.0);
  seen.SmoothAndNormalise();
  const double luminance = MeanLuminance(colours);
  const double share = knows_face() ? Share(elapsed_s, config_.face_time_s) : 1.0;
  face_luminance_ += share * (luminance - face_luminance_);
  face_.BlendTowards(seen, share);
  RebuildTable();
  return true;
}

void SkinModel::LearnFromScene(const cv::Mat& bgr, const cv::Mat& weight, double elapsed_s) {
  constexpr int kStep = 4;
  ColourHistogram seen;
  for (int y = kStep / 2; y < bgr.rows; y += kStep) {
    for (int x = kStep / 2; x < bgr.cols; x += kStep) {
      if (weight.at<std::uint8_t>(y, x) != 0) seen.Add(ColourAt(bgr, x, y), 1.0);
    }
  }
  seen.SmoothAndNormalise();
  scene_.BlendTowards(seen, Share(elapsed_s, config_.scene_time_s));
  RebuildTable();
}

double SkinModel::Probability(double blue, double green, double red) const {
  return Probability(ToLogChromaticity(blue, green, red));
}

double SkinModel::Probability(const LogChromaticity& colour) const {
  double skin = GenericSkin().Density(colour);
  double other = GenericOther().Density(colour);
  if (knows_face()) {
    const double own = face_.Density(colour) * LuminanceDensity(colour.luminance, face_luminance_,
                                                                config_.luminance_spread);
    skin += config_.face_weight * (own - skin);
  }
  if (!scene_.is_empty()) {
    const double own = scene_.Density(colour) *
                       LuminanceDensity(colour.luminance, kOtherLuminance, kOtherLuminanceSigma);
    other += config_.scene_weight * (own - other);
  }
  const double weighted = config_.skin_share * skin;
  constexpr double kTiny = 1e-9;  // Colours that neither side has ever seen are not skin.
  return weighted / (weighted + (1.0 - config_.skin_share) * other + kTiny);
}

void SkinModel::RebuildTable() {
  std::size_t index = 0;
  for (int blue = 4; blue < 256; blue += 8) {
    for (int green = 4; green < 256; green += 8) {
      for (int red = 4; red < 256; red += 8) {
        table_[index++] = static_cast<std::uint8_t>(255.0 * Probability(blue, green, red) + 0.5);
      }
    }
  }
}

}  // namespace deixis::skin
