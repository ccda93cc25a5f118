#include "volume/tiff_pages.h"

#include <cstdint>
#include <fstream>
#include <set>

#include "files/failure.h"

namespace isostar::native {
namespace {

/// Walks from page to page by the links behind their directories.
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
    for (uint64_t page = link(); page != 0; page = link()) {
      if (!seen.insert(page).second) throw Failure(path_, "its list of pages runs in a circle");
      file_.seekg(static_cast<std::streamoff>(page));
      const uint64_t entries = number(large_ ? 8 : 2);
      file_.seekg(static_cast<std::streamoff>(entries * (large_ ? 20 : 12)), std::ios::cur);
    }
  }

 private:
  uint64_t link() { return number(large_ ? 8 : 4); }

  uint64_t number(int bytes) {
    uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      const int byte = file_.get();
      if (byte < 0) throw Failure(path_, "ends within its list of pages");
      value |= static_cast<uint64_t>(byte) << 8 * (little_ ? i : bytes - 1 - i);
    }
    return value;
  }

  const std::string& path_;
  std::ifstream file_;
  bool little_ = true, large_ = false;
};

}  // namespace

void requireWholePageList(const std::string& path) {
  PageList(path).walk();
}

}  // namespace isostar::native
