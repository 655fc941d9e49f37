#pragma once
#include "common/capture/source.h"
#include "common/config/config.h"
#include "common/images/encoded_image.h"

namespace deixis::capture {

struct EncodingConfig {
  int jpeg_quality = 85;  ///< 1..100; at 640x480, 85 makes 40-80 kB.
  int max_width_px = 0;   ///< Wider pictures are made smaller, same aspect. 0 = as they come.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("jpeg_quality", jpeg_quality);
    v("max_width_px", max_width_px);
  }
  void Check(config::Faults& faults) const;
};

/// `picture` as it is published. A JPEG file that has the right size and an upright picture is
/// handed on as it is, since encoding it again would lose quality. `camera` and `time` are copied.
images::EncodedImage Encode(const Picture& picture, Timestamp time, const std::string& camera,
                            const EncodingConfig& config);

}  // namespace deixis::capture
