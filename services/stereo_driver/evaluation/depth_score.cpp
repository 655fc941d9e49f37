#include "services/stereo_driver/evaluation/depth_score.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace deixis::stereo_driver {
namespace {

constexpr double kStep_px = 0.002;
constexpr double kLargest_px = 20.0;
constexpr double kStep_m = 0.0001;
constexpr double kLargest_m = 2.0;

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string Text(std::optional<double> value) {
  std::ostringstream text;
  if (value) text << *value;
  return text.str();
}

std::string Percent(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return "";
  return Text(100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

}  // namespace

ErrorHistogram::ErrorHistogram(double step, double largest)
    : step_(step), counts_(static_cast<std::size_t>(largest / step) + 1) {}

void ErrorHistogram::Add(double error) {
  const auto bin = static_cast<std::size_t>(std::min(error, 1e6) / step_);
  ++counts_[std::min(bin, counts_.size() - 1)];
  ++count_;
}

void ErrorHistogram::Add(const ErrorHistogram& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
  count_ += other.count_;
}

std::optional<double> ErrorHistogram::Quantile(double share) const {
  if (count_ == 0) return std::nullopt;
  std::int64_t left = static_cast<std::int64_t>(share * static_cast<double>(count_ - 1));
  std::size_t bin = 0;
  while (left >= counts_[bin]) left -= counts_[bin++];
  return (static_cast<double>(bin) + 0.5) * step_;
}

DepthScore::DepthScore()
    : errors_px(kStep_px, kLargest_px),
      errors_m(kStep_m, kLargest_m),
      band_errors_m(kBandEdges_m.size() + 1, ErrorHistogram(kStep_m, kLargest_m)) {}

void DepthScore::AddPixel(double true_px, std::optional<double> measured_px) {
  ++truth;
  if (!measured_px) return;
  ++valid;
  const double error_px = std::abs(*measured_px - true_px);
  errors_px.Add(error_px);
  if (error_px > kBad_px) ++bad;
}

void DepthScore::AddShared(double true_px, double measured_px) {
  ++shared;
  if (std::abs(measured_px - true_px) > kBad_px) ++bad_shared;
}

void DepthScore::AddPixel(double focal_baseline, double true_m, std::optional<double> measured_m) {
  if (!measured_m) return AddPixel(focal_baseline / true_m, std::nullopt);
  AddPixel(focal_baseline / true_m, focal_baseline / *measured_m);
  const double error_m = std::abs(*measured_m - true_m);
  errors_m.Add(error_m);
  const auto band = std::upper_bound(kBandEdges_m.begin(), kBandEdges_m.end(), true_m);
  band_errors_m[static_cast<std::size_t>(band - kBandEdges_m.begin())].Add(error_m);
}

void DepthScore::AddBesideBody(double body_m, double true_m, std::optional<double> measured_m) {
  ++beside;
  // Half-way in disparity: that is what is matched.
  if (measured_m && 2.0 / *measured_m > 1.0 / body_m + 1.0 / true_m) ++fattened;
}

void DepthScore::Add(const DepthScore& other) {
  truth += other.truth;
  valid += other.valid;
  bad += other.bad;
  shared += other.shared;
  bad_shared += other.bad_shared;
  beside += other.beside;
  fattened += other.fattened;
  errors_px.Add(other.errors_px);
  errors_m.Add(other.errors_m);
  for (std::size_t i = 0; i < band_errors_m.size(); ++i) {
    band_errors_m[i].Add(other.band_errors_m[i]);
  }
  times_ms.insert(times_ms.end(), other.times_ms.begin(), other.times_ms.end());
}

std::string CsvHeading() {
  std::ostringstream line;
  line << "sequence,column,frames,pixels,valid_percent,error_median_m,error_p90_m,bad2px_percent,"
          "lost_percent,bad2px_shared_percent,fattened_percent,error_median_px,error_p90_px,ms_"
          "median";
  double from_m = 0.0;
  for (const double to_m : DepthScore::kBandEdges_m) {
    line << ",error_median_m_" << from_m << "_to_" << to_m;
    from_m = to_m;
  }
  line << ",error_median_m_beyond_" << from_m;
  return line.str();
}

std::string CsvLine(const std::string& sequence, const std::string& column,
                    const DepthScore& score) {
  std::ostringstream line;
  line << sequence << ',' << column << ',' << score.times_ms.size() << ',' << score.truth << ','
       << Percent(score.valid, score.truth) << ',' << Text(score.errors_m.Quantile(0.5)) << ','
       << Text(score.errors_m.Quantile(0.9)) << ',' << Percent(score.bad, score.valid) << ','
       << Percent(score.truth - score.valid + score.bad, score.truth) << ','
       << Percent(score.bad_shared, score.shared) << ',' << Percent(score.fattened, score.beside)
       << ',' << Text(score.errors_px.Quantile(0.5)) << ',' << Text(score.errors_px.Quantile(0.9))
       << ',' << Median(score.times_ms);
  for (const ErrorHistogram& band : score.band_errors_m) {
    line << ',' << Text(band.Quantile(0.5));
  }
  return line.str();
}

}  // namespace deixis::stereo_driver
