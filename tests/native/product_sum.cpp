#include "product_sum.h"

namespace isostar::native {

double productSum(double a, double b, double c) {
  return a * b + c;
}

}  // namespace isostar::native
