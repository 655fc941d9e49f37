#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "common/capture/source.h"
#include "common/images/depth_image.h"
#include "common/images/image.h"

namespace deixis::capture {

/// A live source whose pictures somebody else receives and pushes into it. A picture that has not
/// been asked for is replaced by the next.
class PushedSource final : public Source {
 public:
  /// `name` is where the pictures come from, for messages; `clock` never goes back.
  PushedSource(std::string name, std::function<Timestamp()> clock);

  void Push(const images::Image& image);
  void Push(const images::DepthImage& image);
  Grab Next() override;
  /// In trouble when the last picture is older than three seconds, by their arrival.
  SourceStatus status() const override;

 private:
  void Keep(Picture picture);

  std::string name_;
  std::function<Timestamp()> clock_;
  Timestamp last_arrival_;
  bool has_begun_ = false;
  std::optional<Picture> waiting_;
  std::int64_t skipped_ = 0;
};

}  // namespace deixis::capture
