#include "common/program/source_log.h"

#include "common/logging/log.h"

namespace deixis::program {

void SourceLog::Note(const std::string& calibration_remark, const std::string& trouble) {
  if (calibration_remark != remark_) {
    const bool is_known = calibration_remark.empty();
    if (is_known) logging::Info("calibration_known");
    if (!is_known) logging::Info("calibration", {{"remark", calibration_remark}});
    remark_ = calibration_remark;
  }
  const bool is_lost = !trouble.empty();
  if (is_lost == is_lost_) return;
  if (is_lost) logging::Warn("source_lost", {{"reason", trouble}});
  if (!is_lost) logging::Info("source_recovered");
  is_lost_ = is_lost;
}

}  // namespace deixis::program
