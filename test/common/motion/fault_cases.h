#pragma once
#include <gmock/gmock.h>

#include <string>

#include "common/motion/motion_text.h"

namespace deixis::motion {

/// A good text, broken one way, and what the error must say of it.
struct FaultCase {
  std::string what;  ///< In words, for the test's output.
  std::string text;
  int line = 1;
  std::string key;
};

/// Expects that `read(text)` fails with "<file>:<line>: '<key>'".
template <typename Read>
void ExpectFault(const FaultCase& fault, const std::string& file, const Read& read) {
  try {
    read(fault.text);
    ADD_FAILURE() << fault.what << " is read";
  } catch (const MotionFileError& error) {
    const std::string place = file + ":" + std::to_string(fault.line) + ": '" + fault.key + "'";
    EXPECT_THAT(error.what(), testing::StartsWith(place)) << fault.what;
  }
}

}  // namespace deixis::motion
