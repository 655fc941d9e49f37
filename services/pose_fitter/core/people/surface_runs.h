#pragma once
#include <cstdint>
#include <vector>

namespace deixis::pose_fitter {

/// Pixels [begin_px, end_px) of one row that are one surface.
struct SurfaceRun {
  int row_px = 0;
  int begin_px = 0;
  int end_px = 0;
  int component = 0;  ///< First run of the surface that it belongs to, once all rows are in.
};

/// Connected surfaces of an image as runs, which are few where pixels are many. Takes its memory
/// once per size.
class SurfaceRuns {
 public:
  void Start(int width_px, int height_px);
  /// Adds the next row; `links`: PixelLink bits of its pixels.
  void AddRow(const std::uint8_t* links);
  void Finish();  ///< Settles the components.

  const std::vector<SurfaceRun>& runs() const { return runs_; }
  std::vector<SurfaceRun>& runs() { return runs_; }
  /// First run of `row`; that of the height is the number of runs.
  int RowBegin(int row) const { return row_begins_[static_cast<std::size_t>(row)]; }

 private:
  int Root(int run);
  void Join(int a, int b);
  void JoinAbove(int run, int& above, int above_end, const std::uint8_t* links);

  int width_px_ = 0;
  std::vector<SurfaceRun> runs_;
  std::vector<int> row_begins_;
};

}  // namespace deixis::pose_fitter
