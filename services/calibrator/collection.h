#pragma once
#include <functional>
#include <ostream>

#include "services/calibrator/arguments.h"
#include "services/calibrator/feeds/feed.h"
#include "services/calibrator/picture_folder.h"

namespace deixis::calibrator {

/// The views that were chosen, and the pictures of the first one for a preview.
struct Collected {
  ViewSelection selection;
  std::vector<cv::Mat> first_bgr;
  int pictures = 0;
};

/// Takes pictures from `feed` until it ends, enough views are there, or `is_stopped`; tells of each
/// one on `out`.
Collected Collect(Feed& feed, const Board& board, const Arguments& arguments,
                  const PictureFolder& pictures, const std::function<bool()>& is_stopped,
                  std::ostream& out);

}  // namespace deixis::calibrator
