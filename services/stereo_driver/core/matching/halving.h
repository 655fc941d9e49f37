#pragma once

namespace deixis::stereo_driver {

/// Which two rows, or columns, of a picture make each one of the picture that is half as large. Of
/// an odd number the middle one is left out, so that the half covers the same view to both its
/// ends.
class Halving {
 public:
  explicit Halving(int size)
      : half_(size / 2), left_out_behind_(size % 2 == 0 ? half_ : half_ / 2) {}

  int half() const { return half_; }
  /// The first of the two that make number `i`; the other is the next.
  int First(int i) const { return 2 * i + (i >= left_out_behind_ ? 1 : 0); }

 private:
  int half_;
  int left_out_behind_;
};

}  // namespace deixis::stereo_driver
