#pragma once

namespace deixis::capture {

/// OpenCV says nothing more: it would say a page on every way in which it failed to open
/// something; ours is one line.
void KeepOpenCvQuiet();

}  // namespace deixis::capture
