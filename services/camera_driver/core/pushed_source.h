#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "common/capture/source.h"
#include "common/images/image.h"

namespace deixis::camera_driver {

/// A live source whose pictures somebody else receives and pushes into it. A picture that has not
/// been asked for is replaced by the next.
class PushedSource final : public capture::Source {
 public:
  /// `name` is where the pictures come from, for messages; `clock` never goes back.
  PushedSource(std::string name, std::function<Timestamp()> clock);

  void Push(const images::Image& image);
  capture::Grab Next() override;
  /// In trouble when the last picture is older than three seconds, by their arrival.
  capture::SourceStatus status() const override;

 private:
  std::string name_;
  std::function<Timestamp()> clock_;
  Timestamp last_arrival_;
  bool has_begun_ = false;
  std::optional<capture::Picture> waiting_;
  std::int64_t skipped_ = 0;
};

}  // namespace deixis::camera_driver
