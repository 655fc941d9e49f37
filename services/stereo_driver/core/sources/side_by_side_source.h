#pragma once
#include <memory>

#include "services/stereo_driver/core/sources/frame.h"

namespace deixis::stereo_driver {

/// Which half of a picture the left camera took.
enum class LeftHalf { kLeft, kRight };

/// One source whose pictures hold both views beside each other.
class SideBySideSource final : public FrameSource {
 public:
  SideBySideSource(std::unique_ptr<capture::Source> source, LeftHalf left_half);

  FrameGrab Next() override;  ///< Pictures of an odd width are passed over and counted.
  FrameSourceStatus status() const override;

 private:
  std::optional<Frame> Split(const capture::Picture& picture) const;

  std::unique_ptr<capture::Source> source_;
  LeftHalf left_half_;
  std::int64_t unusable_ = 0;
};

}  // namespace deixis::stereo_driver
