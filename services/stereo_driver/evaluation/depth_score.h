#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace deixis::stereo_driver {

/// Counts of errors in fine steps, so that quantiles of many millions cost no memory.
class ErrorHistogram {
 public:
  ErrorHistogram(double step, double largest);
  void Add(double error);
  void Add(const ErrorHistogram& other);  ///< Of the same steps.
  std::int64_t count() const { return count_; }
  std::optional<double> Quantile(double share) const;  ///< Nothing when empty.

 private:
  double step_;
  std::vector<std::int64_t> counts_;  ///< The last one holds all larger errors.
  std::int64_t count_ = 0;
};

/// How good the depth of one sequence, or of all, is.
struct DepthScore {
  static constexpr std::array<double, 5> kBandEdges_m = {1.5, 2.0, 2.5, 3.0, 4.0};
  static constexpr double kBad_px = 2.0;

  DepthScore();
  /// One true pixel: `true_px` is its disparity at full size; nothing was measured = no value.
  void AddPixel(double true_px, std::optional<double> measured_px);
  /// The same with distances, which are f b / d.
  void AddPixel(double focal_baseline, double true_m, std::optional<double> measured_m);
  /// The same pixel once more when the compared way has measured it too: errors of all that a way
  /// dares to say cannot be compared, since the pixels that only one dares are the hard ones.
  void AddShared(double true_px, double measured_px);
  /// One pixel beside a body, where something farther is seen: whether it got the body's depth.
  void AddBesideBody(double body_m, double true_m, std::optional<double> measured_m);
  void AddTime(double ms) { times_ms.push_back(ms); }
  void Add(const DepthScore& other);

  std::int64_t truth = 0;       ///< Pixels whose truth is known.
  std::int64_t valid = 0;       ///< Of these: measured.
  std::int64_t bad = 0;         ///< Of these: wrong by more than kBad_px.
  std::int64_t shared = 0;      ///< Pixels that the compared way has measured too; 0 = not counted.
  std::int64_t bad_shared = 0;  ///< Of these: wrong by more than kBad_px.
  std::int64_t beside = 0;      ///< Pixels beside a body.
  std::int64_t fattened = 0;    ///< Of these: with a depth nearer to the body's than to their own.
  ErrorHistogram errors_px;
  ErrorHistogram errors_m;
  std::vector<ErrorHistogram> band_errors_m;  ///< By true distance, kBandEdges_m between them.
  std::vector<double> times_ms;               ///< One per frame.
};

/// Names of the columns, and a score as a line of CSV below them; what is not known stays empty.
std::string CsvHeading();
std::string CsvLine(const std::string& sequence, const std::string& column,
                    const DepthScore& score);

}  // namespace deixis::stereo_driver
