#include "common/config/plain_text.h"

#include <gtest/gtest.h>

namespace deixis::config {
namespace {

TEST(PlainText, IsWhatEveryReceiverTakes) {
  EXPECT_TRUE(IsPlainText("camera"));
  EXPECT_TRUE(
      IsPlainText("K\xC3\xBC"
                  "che"));
  EXPECT_TRUE(IsPlainText(std::string(200, 'a')));
}

TEST(PlainText, IsNothingThatReceiversDrop) {
  EXPECT_FALSE(IsPlainText(""));
  EXPECT_FALSE(IsPlainText(std::string(201, 'a')));
  EXPECT_FALSE(IsPlainText("two\nlines"));
  EXPECT_FALSE(IsPlainText(std::string("a\0b", 3)));
  EXPECT_FALSE(IsPlainText("a\xFF"));         // not UTF-8
  EXPECT_FALSE(IsPlainText("a\xC3"));         // ends within a letter
  EXPECT_FALSE(IsPlainText("\xED\xA0\x80"));  // a surrogate
}

}  // namespace
}  // namespace deixis::config
