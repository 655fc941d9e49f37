#pragma once
#include <string>

namespace deixis::program {

/// Logs what is new about a source of pictures, once: what has to be known about its calibration,
/// that it is lost, and that it is there again.
class SourceLog {
 public:
  /// How it stands; empty texts = nothing has to be known, nothing is wrong.
  void Note(const std::string& calibration_remark, const std::string& trouble);

 private:
  std::string remark_;
  bool is_lost_ = false;
};

}  // namespace deixis::program
