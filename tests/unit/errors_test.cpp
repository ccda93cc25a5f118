#include <gtest/gtest.h>

#include <set>
#include <string>

#include "isostar/isostar.h"

namespace isostar {
namespace {

TEST(Errors, haveTheDocumentedNamesAndDistinctDescriptions) {
  const std::array errors{
      Error::None,      Error::BadArgument, Error::NotIsostar, Error::UnsupportedVersion,
      Error::Truncated, Error::Corrupt,     Error::OverLimit};
  const std::array names{"None",      "BadArgument", "NotIsostar", "UnsupportedVersion",
                         "Truncated", "Corrupt",     "OverLimit"};
  std::set<std::string> clauses;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_STREQ(name(errors[i]), names[i]);
    const std::string clause = describe(errors[i]);
    EXPECT_FALSE(clause.empty() || clause.back() == '.' || clause.find('\n') != std::string::npos);
    clauses.insert(clause);
  }
  EXPECT_EQ(clauses.size(), errors.size());
}

}  // namespace
}  // namespace isostar
