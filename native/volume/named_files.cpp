#include "volume/named_files.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

constexpr size_t kLongestHeader = size_t{1} << 22;
constexpr int64_t kMostFiles = 100'000;

std::istringstream headerOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(kLongestHeader, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(file.gcount()));
  return std::istringstream(head);
}

std::string trimmed(const std::string& words) {
  const char* const blanks = " \t\r";
  const size_t first = words.find_first_not_of(blanks);
  return first == std::string::npos
             ? ""
             : words.substr(first, words.find_last_not_of(blanks) - first + 1);
}

std::string lowered(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

/// The names of "slice%03d.raw 1 10 1", both ends included; none if the words are not of this form.
Names numbered(const std::string& words) {
  std::istringstream rest(words);
  std::string pattern;
  int64_t first = 0, last = 0, step = 1;
  if (!(rest >> pattern >> first >> last)) return {};
  rest >> step;
  const size_t percent = pattern.find('%');
  const size_t letter = pattern.find_first_not_of("0123456789", percent + 1);
  if (percent == std::string::npos || letter == std::string::npos || step == 0) return {};
  if (pattern[letter] != 'd' && pattern[letter] != 'i' && pattern[letter] != 'u') return {};
  const bool zeros = pattern[percent + 1] == '0';
  const size_t width = std::strtoul(pattern.c_str() + percent + 1, nullptr, 10);
  constexpr int64_t kMostNumber = 1'000'000'000;
  for (const int64_t number : {first, last, step})
    if (number < -kMostNumber || number > kMostNumber) return {};
  Names names;
  for (int64_t i = first; step > 0 ? i <= last : i >= last; i += step) {
    if (static_cast<int64_t>(names.size()) == kMostFiles || width > 255) return {};
    std::string number = std::to_string(i);
    if (number.size() < width) number.insert(0, width - number.size(), zeros ? '0' : ' ');
    names.push_back(pattern.substr(0, percent) + number + pattern.substr(letter + 1));
  }
  return names;
}

/// The names that a header's field gives: one, a numbered row, or the lines that follow.
Names namesIn(const std::string& value, std::istream& rest) {
  if (lowered(value).rfind("list", 0) == 0 && (value.size() == 4 || value[4] == ' ')) {
    Names names;
    for (std::string line; std::getline(rest, line);) names.push_back(trimmed(line));
    return names;
  }
  Names names = numbered(value);
  if (names.empty()) names.push_back(value);
  return names;
}

/// "data file: NAME", before the empty line that ends the header.
Names namedByNrrd(const std::string& path) {
  std::istringstream header = headerOf(path);
  for (std::string line; std::getline(header, line) && !trimmed(line).empty();) {
    const size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::string field = lowered(trimmed(line.substr(0, colon)));
    if (field == "data file" || field == "datafile")
      return namesIn(trimmed(line.substr(colon + 1)), header);
  }
  return {};
}

/// "ElementDataFile = NAME", the last field; LOCAL where samples follow.
Names namedByMetaImage(const std::string& path) {
  std::istringstream header = headerOf(path);
  for (std::string line; std::getline(header, line);) {
    const size_t sign = line.find_first_of("=:");
    if (sign == std::string::npos || trimmed(line.substr(0, sign)) != "ElementDataFile") continue;
    const std::string value = trimmed(line.substr(sign + 1));
    return lowered(value) == "local" ? Names{} : namesIn(value, header);
  }
  return {};
}

/// The names that the other file of a NIfTI pair may have, and this one.
Names pairOf(const std::string& path, const std::string& extension) {
  const std::string stem = path.substr(0, path.size() - extension.size());
  Names names;
  for (const char* each : {".hdr", ".img", ".HDR", ".IMG"})
    for (const char* packed : {"", ".gz"}) names.push_back(fs::absolute(stem + each + packed));
  return names;
}

Names namedBy(const std::string& path) {
  const std::string extension = extensionOf(path);
  if (extension == ".nrrd" || extension == ".nhdr") return namedByNrrd(path);
  if (extension == ".mha" || extension == ".mhd") return namedByMetaImage(path);
  if (extension.rfind(".hdr", 0) == 0 || extension.rfind(".img", 0) == 0)
    return pairOf(path, extension);
  return {};
}

bool exists(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

}  // namespace

std::vector<std::string> filesIn(const std::string& folder) {
  Names paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().filename().string()[0] != '.')
      paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<std::string> filesReadWith(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return filesIn(path);
  if (!fs::is_regular_file(path, ignored)) return {path};
  Names files = {path};
  for (const std::string& name : namedBy(path)) {
    const fs::path file = fs::path(path).parent_path() / name;
    const bool same = fs::equivalent(file, path, ignored);
    if (exists(file.string()) && !same) files.push_back(file.string());
  }
  return files;
}

void requireRegularFiles(const std::string& path) {
  std::error_code ignored;
  for (const std::string& file : filesReadWith(path)) {
    if (file != path && !fs::is_regular_file(file, ignored))
      throw Failure(path, text("names %s, which is not a regular file", file.c_str()));
  }
}

uint64_t bytesReadWith(const std::string& path) {
  uint64_t bytes = 0;
  for (const std::string& file : filesReadWith(path)) {
    std::error_code failed;
    const uint64_t length = fs::file_size(file, failed);
    if (!failed) bytes += length;
  }
  return bytes;
}

}  // namespace isostar::native
