#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace isostar::native {

/// What a child may use.
struct ChildLimits {
  uint64_t memory = 0;   // bytes beyond those that the process has at its start
  uint64_t seconds = 0;  // of processor time
};

/// Limits in proportion to the bytes of all files that the child reads: what sound files of every
/// format need at most, even highly compressed ones.
ChildLimits limitsFor(uint64_t inputBytes);

/// The output of a child process: values in shared memory. The parent takes them in the order in
/// which the child put them.
class ChildOutput {
 public:
  explicit ChildOutput(std::string path);  // of the file being read, for error messages
  ~ChildOutput();
  ChildOutput(const ChildOutput&) = delete;
  ChildOutput& operator=(const ChildOutput&) = delete;

  template <class Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    write(&value, sizeof value);
  }
  template <class Value>
  void put(const std::vector<Value>& values) {
    put(values.size());
    write(values.data(), values.size() * sizeof(Value));
  }
  void put(const std::string& text) { put(std::vector<char>(text.begin(), text.end())); }
  void put(const std::vector<std::string>& lines);

  /// Throws a Failure if the child has put less.
  template <class Value>
  void take(Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    read(&value, sizeof value);
  }
  template <class Value>
  void take(std::vector<Value>& values) {
    size_t count = 0;
    take(count);
    values.resize(count);
    read(values.data(), count * sizeof(Value));
  }
  void take(std::string& text);
  void take(std::vector<std::string>& lines);

  const std::string& path() const { return path_; }

 private:
  friend void runInChild(ChildOutput&, const ChildLimits&,
                         const std::function<void(ChildOutput&)>& work);
  void write(const void* bytes, size_t count);
  void read(void* bytes, size_t count);
  void rewind();

  std::string path_;
  int file_;
};

/// Runs `work` in a child process. Files are untrusted input, and the libraries for foreign formats
/// assert, crash and print on damaged ones: a child that dies and a Failure in the child both
/// become a Failure here, which says so if a limit was the reason. What the child prints is
/// discarded. It ends with its parent.
void runInChild(ChildOutput&, const ChildLimits&, const std::function<void(ChildOutput&)>& work);

/// Runs `read` in a child process and returns its result, of which only `members` are transferred.
template <class Result, class Read, class... Members>
Result readInChild(const std::string& path, const ChildLimits& limits, const Read& read,
                   Members Result::*... members) {
  ChildOutput output(path);
  runInChild(output, limits, [&](ChildOutput& to) {
    const Result result = read();
    (to.put(result.*members), ...);
  });
  Result result;
  (output.take(result.*members), ...);
  return result;
}

}  // namespace isostar::native
