#include "volume/tiff_pages.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <set>

#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {
namespace {

/// Follows the links from page to page and checks the sizes in their directories.
class PageList {
 public:
  explicit PageList(const std::string& path) : path_(path), file_(path, std::ios::binary) {
    const uint64_t order = number(2);
    little_ = order == 0x4949;
    large_ = number(2) == 43;
    if (large_) number(4);
  }

  void walk() {
    std::set<uint64_t> seen;
    Size first;
    for (uint64_t page = link(); page != 0; page = link()) {
      if (!seen.insert(page).second) throw Failure(path_, "has a cyclic list of pages");
      file_.seekg(static_cast<std::streamoff>(page));
      const Size size = readDirectory();
      if (size.thumbnail) continue;
      if (first.width == 0) first = size;
      if (size.width != first.width || size.height != first.height)
        throw Failure(path_, text("page %zu is %llu x %llu, the first %llu x %llu", seen.size(),
                                  size.width, size.height, first.width, first.height));
      if (size.samples != first.samples)
        throw Failure(path_,
                      text("page %zu has samples of another type than the first", seen.size()));
    }
  }

 private:
  struct Size {
    unsigned long long width = 0, height = 0;
    bool thumbnail = false;
    /// Bits, channels, planes or pixels, and format; the defaults of TIFF.
    std::array<uint64_t, 4> samples{1, 1, 1, 1};
  };

  static constexpr uint64_t kKindOfPage = 254, kWidth = 256, kHeight = 257;
  static constexpr std::array<uint64_t, 4> kSamples{258, 277, 284, 339};

  Size readDirectory() {
    Size size;
    for (uint64_t entries = number(large_ ? 8 : 2); entries > 0; --entries) {
      const uint64_t tag = number(2), type = number(2);
      const uint64_t count = number(large_ ? 8 : 4);
      const uint64_t value = readValue(type);
      // Several values may lie elsewhere in the file: only their number is compared.
      for (size_t i = 0; i < kSamples.size(); ++i) {
        if (tag == kSamples[i]) size.samples[i] = count == 1 ? value : count << 32;
      }
      if (tag == kKindOfPage) size.thumbnail = value & 1;
      if (tag == kWidth) size.width = value;
      if (tag == kHeight) size.height = value;
    }
    return size;
  }

  /// The value of a directory entry that is one number. It comes first in its field, in either byte
  /// order.
  uint64_t readValue(uint64_t type) {
    constexpr uint64_t kShort = 3, kLong8 = 16;
    const int room = large_ ? 8 : 4, bytes = type == kShort ? 2 : type == kLong8 ? room : 4;
    const uint64_t value = number(bytes);
    for (int i = bytes; i < room; ++i) number(1);
    return value;
  }

  uint64_t link() { return number(large_ ? 8 : 4); }

  uint64_t number(int bytes) {
    uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      const int byte = file_.get();
      if (byte < 0) throw Failure(path_, "ends inside its list of pages");
      value |= static_cast<uint64_t>(byte) << 8 * (little_ ? i : bytes - 1 - i);
    }
    return value;
  }

  const std::string& path_;
  std::ifstream file_;
  bool little_ = true, large_ = false;
};

}  // namespace

void requireEqualPages(const std::string& path) {
  PageList(path).walk();
}

}  // namespace isostar::native
