#pragma once

#include <string>

namespace isostar::native {

/// Where the bytes for an output go.
struct OutputTarget {
  /// The path without symbolic links at its end; it need not exist.
  std::string path;
  /// The descriptor of this process that the target names ("-", /dev/stdout, /dev/fd/3), else -1.
  int descriptor = -1;

  /// Whether data is written directly: the target is a descriptor, a device or a pipe. A regular
  /// file is replaced.
  bool isDirect() const;
};

/// Follows symbolic links. Throws a Failure if they are cyclic.
OutputTarget outputTargetOf(const std::string& target);

/// Throws a UsageFault if the target is the input: by another path, a link, or a descriptor.
void requireDifferent(const std::string& input, const std::string& target);

/// Whether the target and standard output are one file, pipe or descriptor.
bool isStandardOutput(const std::string& target);

/// Whether the two names are those of one regular file.
bool isSameFile(const std::string& a, const std::string& b);

}  // namespace isostar::native
