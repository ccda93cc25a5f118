#include "volume/sample_buffer.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {
namespace {

// Deflate compresses at most by 1032, TIFF's LZW and run lengths by less than 2000.
constexpr double kBestCompression = 2000;
constexpr double kSmallFile = 4096;

double physicalMemory() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

void requirePlausible(const std::string& file, const ClaimedSize& size, SampleType type,
                      uint64_t fileBytes) {
  const std::string named = text("%lld x %lld x %lld", static_cast<long long>(size[0]),
                                 static_cast<long long>(size[1]), static_cast<long long>(size[2]));
  for (int64_t side : size) {
    if (side < 1 || side > INT32_MAX)
      throw Failure(file, text("a size of %s samples is impossible", named.c_str()));
  }
  const double count =
      static_cast<double>(size[0]) * static_cast<double>(size[1]) * static_cast<double>(size[2]);
  const double needed = count * static_cast<double>(bytesOf(type));
  if (fileBytes > 0 && needed > kSmallFile + kBestCompression * static_cast<double>(fileBytes))
    throw Failure(file, text("claims %s samples, which %s cannot hold", named.c_str(),
                             readableBytes(fileBytes).c_str()));
  const double memory = type == SampleType::F32 ? needed : needed + 4 * count;
  if (memory > physicalMemory())
    throw Failure(file, text("%s samples need %s of memory; this machine has %s", named.c_str(),
                             readableBytes(static_cast<uint64_t>(std::min(memory, 1e19))).c_str(),
                             readableBytes(static_cast<uint64_t>(physicalMemory())).c_str()));
}

}  // namespace

size_t bytesOf(SampleType type) {
  switch (type) {
    case SampleType::U8:
    case SampleType::I8:
      return 1;
    case SampleType::U16:
    case SampleType::I16:
      return 2;
    case SampleType::U32:
    case SampleType::I32:
    case SampleType::F32:
      return 4;
    case SampleType::U64:
    case SampleType::I64:
    case SampleType::F64:
      return 8;
  }
  return 8;
}

const char* nameOf(SampleType type) {
  switch (type) {
    case SampleType::U8:
      return "unsigned 8-bit integers";
    case SampleType::I8:
      return "8-bit integers";
    case SampleType::U16:
      return "unsigned 16-bit integers";
    case SampleType::I16:
      return "16-bit integers";
    case SampleType::U32:
      return "unsigned 32-bit integers";
    case SampleType::I32:
      return "32-bit integers";
    case SampleType::U64:
      return "unsigned 64-bit integers";
    case SampleType::I64:
      return "64-bit integers";
    case SampleType::F32:
      return "32-bit floats";
    case SampleType::F64:
      return "64-bit floats";
  }
  return "";
}

SampleBuffer::SampleBuffer(std::string file, const ClaimedSize& size, SampleType type,
                           uint64_t fileBytes)
    : file_(std::move(file)), type_(type) {
  requirePlausible(file_, size, type, fileBytes);
  for (int axis = 0; axis < 3; ++axis) size_[axis] = static_cast<int32_t>(size[axis]);
  count_ =
      static_cast<size_t>(size[0]) * static_cast<size_t>(size[1]) * static_cast<size_t>(size[2]);
  if (type_ == SampleType::F32) {
    floats_.resize(count_);
  } else {
    raw_.resize(bytes());
  }
}

std::byte* SampleBuffer::data() {
  return type_ == SampleType::F32 ? reinterpret_cast<std::byte*>(floats_.data()) : raw_.data();
}

template <class Sample>
void SampleBuffer::convert(double slope, double intercept) {
  const bool plain = slope == 1 && intercept == 0;
  floats_.resize(count_);
  const std::byte* from = data();
  for (size_t i = 0; i < count_; ++i) {
    Sample sample;
    std::memcpy(&sample, from + i * sizeof(Sample), sizeof(Sample));
    floats_[i] =
        static_cast<float>(plain ? sample : slope * static_cast<double>(sample) + intercept);
  }
  raw_ = {};
}

void SampleBuffer::requireFinite() const {
  const auto bad = [](float sample) { return !std::isfinite(sample); };
  const auto first = std::find_if(floats_.begin(), floats_.end(), bad);
  if (first == floats_.end()) return;
  const size_t at = static_cast<size_t>(first - floats_.begin());
  const size_t row = static_cast<size_t>(size_[0]), slice = row * static_cast<size_t>(size_[1]);
  const size_t count = static_cast<size_t>(std::count_if(first, floats_.end(), bad));
  throw Failure(file_, text("%zu %s not a finite number, the first at (%zu, %zu, %zu)", count,
                            count == 1 ? "sample is" : "samples are", at % row, at % slice / row,
                            at / slice));
}

std::vector<float> SampleBuffer::take(double slope, double intercept) {
  switch (type_) {
    case SampleType::U8:
      convert<uint8_t>(slope, intercept);
      break;
    case SampleType::I8:
      convert<int8_t>(slope, intercept);
      break;
    case SampleType::U16:
      convert<uint16_t>(slope, intercept);
      break;
    case SampleType::I16:
      convert<int16_t>(slope, intercept);
      break;
    case SampleType::U32:
      convert<uint32_t>(slope, intercept);
      break;
    case SampleType::I32:
      convert<int32_t>(slope, intercept);
      break;
    case SampleType::U64:
      convert<uint64_t>(slope, intercept);
      break;
    case SampleType::I64:
      convert<int64_t>(slope, intercept);
      break;
    case SampleType::F32:
      if (slope != 1 || intercept != 0) convert<float>(slope, intercept);
      break;
    case SampleType::F64:
      convert<double>(slope, intercept);
      break;
  }
  requireFinite();
  return std::move(floats_);
}

}  // namespace isostar::native
