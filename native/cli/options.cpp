#include "cli/options.h"

#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "files/text.h"
#include "threads/parallel_tasks.h"

namespace isostar::native {
namespace {

template <class Value>
using Names = std::map<std::string, Value>;

const Names<Units> kUnits = {{"grid", Units::Grid}, {"world", Units::World}};

template <class Value>
std::string nameOf(const Names<Value>& names, Value value) {
  for (const auto& [name, each] : names) {
    if (each == value) return name;
  }
  return {};
}

/// An option whose value is one of a few names.
template <class Value>
CLI::Option* addChoice(CLI::App& app, const std::string& option, const Names<Value>& names,
                       const std::function<void(Value)>& store, const std::string& help) {
  std::vector<std::string> words;
  for (const auto& each : names) words.push_back(each.first);
  const auto take = [store, names](const std::string& name) { store(names.at(name)); };
  return app.add_option_function<std::string>(option, take, help)
      ->check(CLI::IsMember(words).description(""))
      ->type_name(CLI::detail::join(words, "|"));
}

/// The same with a default, which the help shows.
template <class Value>
CLI::Option* addChoice(CLI::App& app, const std::string& option, const Names<Value>& names,
                       Value& value, const std::string& help) {
  const std::function<void(Value)> store = [&value](Value chosen) { value = chosen; };
  return addChoice(app, option, names, store, help)->default_str(nameOf(names, value));
}

/// The same without a default.
template <class Value>
CLI::Option* addChoice(CLI::App& app, const std::string& option, const Names<Value>& names,
                       std::optional<Value>& value, const std::string& help) {
  const std::function<void(Value)> store = [&value](Value chosen) { value = chosen; };
  return addChoice(app, option, names, store, help);
}

double parse(const std::string& option, const std::string& word, double) {
  double number;
  if (!CLI::detail::lexical_cast(word, number) || !std::isfinite(number) || number <= 0)
    throw CLI::ValidationError(option, text("'%s' is not a positive number", word.c_str()));
  return number;
}

int64_t parse(const std::string& option, const std::string& word, int64_t) {
  int64_t number;
  if (!CLI::detail::lexical_cast(word, number) || number <= 0)
    throw CLI::ValidationError(option, text("'%s' is not a positive whole number", word.c_str()));
  return number;
}

/// An option like "256,256,113".
template <class Number>
CLI::Option* addTriple(CLI::App& app, const std::string& option,
                       std::optional<std::array<Number, 3>>& value, const std::string& help) {
  const auto store = [&value, option](const std::string& words) {
    const std::vector<std::string> parts = CLI::detail::split(words, ',');
    if (parts.size() != 3)
      throw CLI::ValidationError(option, text("'%s' is not of the form X,Y,Z", words.c_str()));
    value.emplace();
    for (size_t axis = 0; axis < 3; ++axis) (*value)[axis] = parse(option, parts[axis], Number{});
  };
  return app.add_option_function<std::string>(option, store, help)->type_name("X,Y,Z");
}

CLI::Validator numberCheck(bool (*good)(double), const char* wanted) {
  return CLI::Validator(
      [good, wanted](std::string& word) {
        double number;
        if (CLI::detail::lexical_cast(word, number) && good(number)) return std::string();
        return text("'%s' is not a %s number", word.c_str(), wanted);
      },
      "");
}

}  // namespace

const CLI::Validator kFinite = numberCheck([](double x) { return std::isfinite(x); }, "finite");
const CLI::Validator kPositive =
    numberCheck([](double x) { return std::isfinite(x) && x > 0; }, "positive");
const CLI::Validator kWhole(
    [](std::string& word) {
      const bool whole = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
        return std::isdigit(c) != 0;
      });
      return whole ? std::string() : text("'%s' is not a whole number from 0 on", word.c_str());
    },
    "");

CLI::Option* addPolygonizer(CLI::App& app, Polygonizer& value, const std::string& help) {
  static const Names<Polygonizer> kNames = {{"cubes", Polygonizer::Cubes},
                                            {"tetrahedra", Polygonizer::Tetrahedra}};
  return addChoice(app, "--polygonizer", kNames, value, help);
}

CLI::Option* addFrame(CLI::App& app, Frame& value, const std::string& help) {
  static const Names<Frame> kNames = {{"world", Frame::World}, {"grid", Frame::Grid}};
  return addChoice(app, "--frame", kNames, value, help);
}

/// A list like "510.5,520.5".
CLI::Option* addFurther(CLI::App& app, std::vector<double>& values, const std::string& help) {
  constexpr std::size_t kMost = 15;
  return app.add_option("--near", values, help)
      ->delimiter(',')
      ->check(kFinite)
      ->expected(1, kMost)
      ->allow_extra_args(false)
      ->default_str("")
      ->type_name("V2,V3,...");
}

CLI::Option* addChunk(CLI::App& app, int& side, const std::string& help) {
  const Names<int> sides{{"64", 64}, {"128", 128}, {"none", 0}};
  const std::function<void(int)> store = [&side](int chosen) { side = chosen; };
  return addChoice(app, "--chunk", sides, store, help);
}

/// A box like "0,0,0,255,255,112".
CLI::Option* addRegion(CLI::App& app, std::optional<Region>& value, const std::string& help) {
  const auto store = [&value](const std::string& words) {
    const std::vector<std::string> parts = CLI::detail::split(words, ',');
    std::array<double, 6> corners{};
    bool isBox = parts.size() == corners.size();
    for (size_t i = 0; isBox && i < corners.size(); ++i)
      isBox = CLI::detail::lexical_cast(parts[i], corners[i]) && std::isfinite(corners[i]);
    const auto& [x0, y0, z0, x1, y1, z1] = corners;
    if (!isBox || x0 > x1 || y0 > y1 || z0 > z1)
      throw CLI::ValidationError(
          "--region", text("'%s' is not of the form X0,Y0,Z0,X1,Y1,Z1, the smaller corner first",
                           words.c_str()));
    value = Region{{x0, y0, z0}, {x1, y1, z1}};
  };
  return app.add_option_function<std::string>("--region", store, help)
      ->type_name("X0,Y0,Z0,X1,Y1,Z1");
}

CLI::Option* addThreads(CLI::App& app) {
  constexpr int kMost = 1024;
  const std::function<void(int)> store = [](const int& count) {
    useThreads(static_cast<unsigned>(count));
  };
  return app.add_option_function<int>("--threads", store, "Threads [default: one a processor]")
      ->type_name("N")
      ->check(CLI::Range(1, kMost).description(""));
}

CLI::Option* addUnits(CLI::App& app, Units& value, const std::string& help) {
  return addChoice(app, "--units", kUnits, value, help);
}

CLI::Option* addUnits(CLI::App& app, std::optional<Units>& value, const std::string& help) {
  return addChoice(app, "--units", kUnits, value, help);
}

CLI::Option* addSampleType(CLI::App& app, std::optional<SampleType>& value,
                           const std::string& help) {
  static const Names<SampleType> kNames = {{"u8", SampleType::U8},   {"i8", SampleType::I8},
                                           {"u16", SampleType::U16}, {"i16", SampleType::I16},
                                           {"f32", SampleType::F32}, {"f64", SampleType::F64}};
  return addChoice(app, "--type", kNames, value, help);
}

CLI::Option* addSize(CLI::App& app, std::optional<ClaimedSize>& value, const std::string& help) {
  return addTriple(app, "--size", value, help);
}

CLI::Option* addSpacing(CLI::App& app, std::optional<std::array<double, 3>>& value,
                        const std::string& help) {
  return addTriple(app, "--spacing", value, help);
}

}  // namespace isostar::native
