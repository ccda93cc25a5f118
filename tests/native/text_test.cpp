#include "files/text.h"

#include <gtest/gtest.h>

#include "cli/limit_warning.h"

namespace isostar::native {
namespace {

TEST(Text, escapesWhatATerminalObeys) {
  EXPECT_EQ(printable("a b\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80"),
            "a b\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80");
  EXPECT_EQ(printable("\x1b]0;x\x07\n\r\t\x7f"), "\\x1b]0;x\\x07\\n\\x0d\\x09\\x7f");
  EXPECT_EQ(printable("\xc2\x9b\xe2\x80\xae"), "\\u009b\\u202e");
  EXPECT_EQ(printable("\x9b\xff\xc3"), "\\x9b\\xff\\xc3");
  EXPECT_EQ(printable("\xc0\x9b\xed\xa0\x80\xe2\x28"), "\\xc0\\x9b\\xed\\xa0\\x80\\xe2(");
  EXPECT_EQ(printable(std::string(1, '\0')), "\\x00");
}

TEST(LimitWarning, namesWhatIsOver) {
  StreamInfo info;
  info.size = {1024, 1024, 1024};
  info.frames = 1;
  info.vertices = 133'000'000;
  const Limits limits{.samples = uint64_t{1} << 31, .vertices = uint64_t{1} << 26};
  EXPECT_EQ(overLimits(info, limits),
            "133 M vertices are over a decoder's own default limit of 67 M");
  info.vertices = uint64_t{1} << 26;
  EXPECT_EQ(overLimits(info, limits), "");
  info.frames = 3;
  EXPECT_EQ(overLimits(info, limits),
            "3221 M samples are over a decoder's own default limit of 2147 M");
}

}  // namespace
}  // namespace isostar::native
