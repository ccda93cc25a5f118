#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace isostar::native {

enum class SampleType : uint8_t { U8, I8, U16, I16, U32, I32, U64, I64, F32, F64 };

size_t bytesOf(SampleType);

/// "unsigned 16-bit integers".
const char* nameOf(SampleType);

/// A file's size in samples as its header claims it, not yet validated.
using ClaimedSize = std::array<int64_t, 3>;

/// A volume's samples in the file's type, which take() converts to floats.
class SampleBuffer {
 public:
  /// Throws a Failure before it allocates if the size is not positive, exceeds this machine's
  /// memory, or cannot fit into `fileBytes` even compressed. `fileBytes` 0: unknown.
  SampleBuffer(std::string file, const ClaimedSize&, SampleType, uint64_t fileBytes);

  std::byte* data();
  size_t bytes() const { return count_ * bytesOf(type_); }
  SampleType type() const { return type_; }
  std::array<int32_t, 3> size() const { return size_; }

  /// The samples as floats, `slope · sample + intercept`. Throws a Failure that says how many
  /// samples are not finite, and where the first one is.
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
  std::vector<float> floats_;  // F32 samples are read directly into it
};

}  // namespace isostar::native
