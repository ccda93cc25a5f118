// Whole numbers as a run of yes/no decisions.
#pragma once

namespace isostar {

/// Counts up from `least`, at most to `most`. decide(n, larger) codes whether the value is larger
/// than n and returns what the decoder sees.
template <class Decide>
int codeUnary(int actual, int least, int most, Decide decide) {
  int value = least;
  while (value < most && decide(value, actual > value)) ++value;
  return value;
}

/// Zero, then the sign, then the size in unary, at most `most`. decide(n, answer) codes decision n:
/// 0 is "not zero", 1 is "negative", n > 1 is "larger than n - 1".
template <class Decide>
int codeSignedUnary(int actual, int most, Decide decide) {
  if (!decide(0, actual != 0)) return 0;
  const bool negative = decide(1, actual < 0);
  const int size = codeUnary(negative ? -actual : actual, 1, most,
                             [&](int n, bool larger) { return decide(n + 1, larger); });
  return negative ? -size : size;
}

}  // namespace isostar
