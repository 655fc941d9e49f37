#include "services/calibrator/report.h"

#include "services/calibrator/core/figures.h"

namespace deixis::calibrator {
namespace {

const std::vector<std::string>& DistortionNames(LensModel model) {
  static const std::vector<std::string> kPinhole{"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  static const std::vector<std::string> kFisheye{"k1", "k2", "k3", "k4"};
  return model == LensModel::kFisheye ? kFisheye : kPinhole;
}

void ReportDropped(const std::vector<DroppedView>& dropped, const std::vector<Shot>& shots,
                   const char* what, std::ostream& out) {
  for (const DroppedView& view : dropped) {
    out << Figures("  dropped %s: %s %.2f px without it in the fit, the others' median %.2f\n",
                   shots[view.index].name.c_str(), what, view.error_px, view.others_px);
  }
}

std::string WithDeviation(double value, const LensFit& fit, std::size_t index, int digits) {
  std::string text = Figures("%.*f", digits, value);
  if (index < fit.deviations.size()) text += Figures(" +- %.*f", digits, fit.deviations[index]);
  return text;
}

void ReportLens(const LensFit& fit, std::ostream& out) {
  const Lens& lens = fit.lens;
  out << "  fx " << WithDeviation(lens.matrix(0, 0), fit, 0, 2) << "  fy "
      << WithDeviation(lens.matrix(1, 1), fit, 1, 2) << "  cx "
      << WithDeviation(lens.matrix(0, 2), fit, 2, 2) << "  cy "
      << WithDeviation(lens.matrix(1, 2), fit, 3, 2) << " px"
      << Figures("  (field of view %.1f deg)\n", HorizontalFov_deg(lens));
  out << " ";
  for (std::size_t i = 0; i < lens.distortion.size(); ++i) {
    out << " " << DistortionNames(lens.model)[i] << " "
        << WithDeviation(lens.distortion[i], fit, 4 + i, 4) << " ";
  }
  out << "\n";
}

}  // namespace

void ReportFates(const ViewSelection& selection, const std::string& trouble, std::ostream& out) {
  out << "pictures: " << selection.FatesText() << "\n";
  if (!trouble.empty()) out << "passed over: " << trouble << "\n";
}

void ReportCamera(const CameraCalibration& calibration, const std::vector<Shot>& shots,
                  const std::string& whose, std::ostream& out) {
  const LensFit& fit = calibration.robust.fit;
  out << Figures("%scamera %dx%d, %s, %zu views: reprojection error %.3f px", whose.c_str(),
                 fit.lens.size.width, fit.lens.size.height, NameOf(fit.lens.model).c_str(),
                 calibration.robust.used.size(), fit.error_px);
  if (calibration.cross_validated_px) {
    out << Figures(", on views left out %.3f px", *calibration.cross_validated_px);
  }
  out << "\n";
  ReportLens(fit, out);
  ReportDropped(calibration.robust.dropped, shots, "error", out);
}

void ReportStereo(const StereoCalibration& calibration, const std::vector<Shot>& shots,
                  std::ostream& out) {
  ReportCamera(calibration.left, shots, "left ", out);
  ReportCamera(calibration.right, shots, "right ", out);
  const cv::Vec3d& t = calibration.fit.translation_m;
  out << Figures(
      "stereo, %zu pairs: reprojection error %.3f px, baseline %.4f m (T %.4f %.4f %.4f)\n",
      calibration.used.size(), calibration.fit.error_px, cv::norm(t), t[0], t[1], t[2]);
  const ErrorSummary& rows = calibration.rows_px;
  out << Figures("  rows differ after rectification: mean %.3f, median %.3f, p95 %.3f px\n",
                 rows.mean, rows.median, rows.p95);
  if (calibration.held_out_rows_px) {
    const ErrorSummary& held_out = *calibration.held_out_rows_px;
    out << Figures("  the same on pairs left out:      mean %.3f, median %.3f, p95 %.3f px\n",
                   held_out.mean, held_out.median, held_out.p95);
  }
  out << Figures("  squares are measured %+.2f %% off their size (median), single ones %.2f %%\n",
                 100.0 * (calibration.median_square - 1.0),
                 100.0 * calibration.square_errors.median);
  for (const PairError& pair : calibration.pairs) {
    out << Figures("  %-28s rows %.3f px\n", shots[pair.shot].name.c_str(), pair.rows_px);
  }
  ReportDropped(calibration.dropped, shots, "rows differ by", out);
}

}  // namespace deixis::calibrator
