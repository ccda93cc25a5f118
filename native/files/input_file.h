#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace isostar::native {

/// All bytes of a file; "-" is standard input.
std::vector<std::byte> readFile(const std::string& path);

/// The length of a regular file in bytes. Throws a Failure if it does not exist or is a folder.
uint64_t fileSize(const std::string& path);

}  // namespace isostar::native
