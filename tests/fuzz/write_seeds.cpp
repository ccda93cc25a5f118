// Small sound streams for the fuzzers to begin with: write_seeds FOLDER.
#include <filesystem>
#include <fstream>

#include "property/sampled_field.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  int number = 0;
  for (const isostar::Size& size : {isostar::Size{2, 2, 2}, isostar::Size{5, 4, 6}, isostar::Size{17, 9, 12}}) {
    for (const auto& field : isostar::fieldsOf(size)) {
      isostar::EncodeOptions options;
      options.polygonizer = static_cast<isostar::Polygonizer>(number % 2);
      options.lossless = number % 3 == 0;
      std::vector<std::byte> stream;
      if (isostar::encode(field.volume(), options, stream) != isostar::Error::None) return 1;
      std::ofstream(folder / std::to_string(number++), std::ios::binary)
          .write(reinterpret_cast<const char*>(stream.data()), static_cast<std::streamsize>(stream.size()));
    }
  }
}
