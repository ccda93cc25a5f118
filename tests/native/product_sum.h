#pragma once

namespace isostar::native {

/// a b + c, compiled for processors with fused multiply-add.
double productSum(double a, double b, double c);

}  // namespace isostar::native
