#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace isostar::native {

enum class SampleType : uint8_t { U8, I8, U16, I16, U32, I32, U64, I64, F32, F64 };

size_t bytesOf(SampleType);

/// A file's size in samples, as large as the file claims it: not yet believed.
using ClaimedSize = std::array<int64_t, 3>;

/// Room for a volume's samples in the file's own type, which become floats at the end.
class SampleBuffer {
 public:
  /// Fails with one line, before allocating, on a size that is not positive, that this machine
  /// cannot hold, or that `fileBytes` cannot contain even compressed. `fileBytes` 0: not known.
  SampleBuffer(std::string file, const ClaimedSize&, SampleType, uint64_t fileBytes);

  std::byte* data();
  size_t bytes() const { return count_ * bytesOf(type_); }
  SampleType type() const { return type_; }
  std::array<int32_t, 3> size() const { return size_; }

  /// The samples as floats, `slope · sample + intercept`; fails where one is not finite, telling
  /// where and how many.
  std::vector<float> take(double slope = 1, double intercept = 0);

 private:
  template <class Sample>
  void convert(double slope, double intercept);
  void requireFinite() const;

  std::string file_;
  std::array<int32_t, 3> size_{};
  SampleType type_;
  size_t count_ = 0;
  std::vector<std::byte> raw_;
  std::vector<float> floats_;  // where the file holds floats, they are read right into their place
};

}  // namespace isostar::native
