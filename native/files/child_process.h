#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace isostar::native {

/// What a child process leaves to its parent: values in memory, taken in the order in which they
/// were put.
class Handover {
 public:
  explicit Handover(std::string path);  // of the file in work, for complaints
  ~Handover();
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;

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
  void put(const std::string& words) { put(std::vector<char>(words.begin(), words.end())); }
  void put(const std::vector<std::string>& lines);

  /// Fail with one line where the child has put less.
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
  void take(std::string& words);
  void take(std::vector<std::string>& lines);

  const std::string& path() const { return path_; }

 private:
  friend void runInChild(Handover&, const std::function<void(Handover&)>& work);
  void write(const void* bytes, size_t count);
  void read(void* bytes, size_t count);
  void rewind();

  std::string path_;
  int file_;
};

/// Does `work` in a child process, which puts what it found. The libraries for foreign formats
/// assert, crash and print on damaged files, and a stranger's file must not take the command down:
/// a child that dies, or a Failure in it, becomes a Failure here, and what it prints is not shown.
void runInChild(Handover&, const std::function<void(Handover&)>& work);

}  // namespace isostar::native
