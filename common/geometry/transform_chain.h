#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/camera_pose.h"
#include "common/geometry/frame_transform.h"

namespace deixis::geometry {

/// Follows where the camera is in its parent frame by the robot's transforms, of which each says
/// where one frame is in another. The chain between the two is the shortest; a transform may point
/// either way in it, and of two frames the last that was said holds. Knows 256 transforms at most:
/// for a new one it forgets the one that was heard longest ago and is not in the chain.
class TransformChain {
 public:
  static constexpr std::size_t kMostTransforms = 256;

  explicit TransformChain(std::string parent_frame);

  /// The name of the camera's optical frame; empty = not known yet.
  void SetCameraFrame(const std::string& camera_frame);

  /// The camera's pose, when the chain is complete and one of `transforms` is in it. Its time is
  /// the newest of the chain's transforms.
  std::optional<CameraPose> Take(const FrameTransforms& transforms);

  /// Which link the chain lacks, as part of a sentence; empty when it is complete.
  std::string WhatLacks() const;

 private:
  struct Link {
    FrameTransform transform;
    std::int64_t heard = 0;  ///< Number of the message that said it last.
  };

  void Keep(const FrameTransform& transform);
  Link& RoomForNew();
  void FindChain();
  CameraPose Pose() const;
  bool IsNamed(const std::string& frame) const;
  std::string WithTop(const std::string& frame) const;
  std::string TopOf(std::string frame) const;

  std::string parent_frame_;
  std::string camera_frame_;
  std::vector<Link> links_;  ///< One per pair of frames; a link stays in its place.
  /// Indices into `links_` from parent to camera; nothing = not complete.
  std::optional<std::vector<std::size_t>> chain_;
  bool is_chain_old_ = true;  ///< There are other links, or ends, than when it was sought.
  std::int64_t messages_ = 0;
};

}  // namespace deixis::geometry
