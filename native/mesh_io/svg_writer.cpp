#include "mesh_io/svg_writer.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "files/output_file.h"
#include "files/text.h"

namespace isostar::native {
namespace {

struct Point {
  double x = 0, y = 0;
};

/// The image's border as a closed path, parametrized by length: counter-clockwise if y points up,
/// so that the image is on the left.
class Border {
 public:
  Border(const Point& first, const Point& last)
      : first_(first), width_(last.x - first.x), height_(last.y - first.y) {}

  double length() const { return 2 * (width_ + height_); }
  /// The parameter of the border's point nearest to `p`.
  double along(const Point& p) const {
    const double x = p.x - first_.x, y = p.y - first_.y;
    const double nearest = std::min({y, width_ - x, height_ - y, x});
    if (nearest == y) return x;
    if (nearest == width_ - x) return width_ + y;
    return nearest == height_ - y ? 2 * width_ + height_ - x : length() - y;
  }
  /// The corners between two parameters.
  std::vector<Point> corners(double from, double to) const {
    if (to < from) to += length();
    std::vector<Point> passed;
    for (const double lap : {0.0, length()}) {
      const double sides[] = {0, width_, width_ + height_, 2 * width_ + height_};
      for (int corner = 0; corner < 4; ++corner) {
        if (lap + sides[corner] > from && lap + sides[corner] < to)
          passed.push_back(this->corner(corner));
      }
    }
    return passed;
  }
  Point corner(int n) const {
    return {first_.x + (n == 1 || n == 2 ? width_ : 0), first_.y + (n >= 2 ? height_ : 0)};
  }

 private:
  Point first_;
  double width_, height_;
};

class Drawing {
 public:
  Drawing(const Contours& contours, const Point& first, const Point& last)
      : contours_(contours), border_(first, last) {}

  /// All contours, open and closed.
  std::string lines() const {
    std::string path;
    for (size_t line = 0; line < count(); ++line) {
      append(path, line, 'M');
      if (line >= contours_.open) path += 'Z';
    }
    return path;
  }

  /// Closed paths around the positive regions, to be filled by the even-odd rule.
  std::string area() const {
    std::string path;
    std::vector<bool> joined(contours_.open, false);
    for (size_t line = 0; line < contours_.open; ++line) {
      char verb = 'M';
      for (size_t at = line; !joined[at]; at = nextAlongBorder(at)) {
        joined[at] = true;
        append(path, at, verb);
        appendCorners(path, at, nextAlongBorder(at));
        verb = 'L';
      }
      if (verb == 'L') path += 'Z';
    }
    for (size_t line = contours_.open; line < count(); ++line) {
      append(path, line, 'M');
      path += 'Z';
    }
    if (contours_.open == 0 && contours_.positiveCorner) {
      for (int corner = 0; corner < 4; ++corner)
        appendPoint(path, corner == 0 ? 'M' : 'L', border_.corner(corner));
      path += 'Z';
    }
    return path;
  }

 private:
  size_t count() const { return contours_.starts.empty() ? 0 : contours_.starts.size() - 1; }
  Point point(size_t i) const { return {contours_.points[2 * i], contours_.points[2 * i + 1]}; }
  Point first(size_t line) const { return point(contours_.starts[line]); }
  Point last(size_t line) const { return point(contours_.starts[line + 1] - 1); }

  /// From the end of an open contour the border is positive up to the start of the next open
  /// contour, which is returned.
  size_t nextAlongBorder(size_t line) const {
    const double from = border_.along(last(line));
    size_t next = line;
    double nearest = HUGE_VAL;
    for (size_t other = 0; other < contours_.open; ++other) {
      double distance = border_.along(first(other)) - from;
      if (distance < 0) distance += border_.length();
      if (distance >= nearest) continue;
      nearest = distance;
      next = other;
    }
    return next;
  }

  void append(std::string& path, size_t line, char verb) const {
    for (size_t i = contours_.starts[line]; i < contours_.starts[line + 1]; ++i) {
      appendPoint(path, verb, point(i));
      verb = 'L';
    }
  }
  void appendCorners(std::string& path, size_t line, size_t next) const {
    for (const Point& p : border_.corners(border_.along(last(line)), border_.along(first(next))))
      appendPoint(path, 'L', p);
  }
  static void appendPoint(std::string& path, char verb, const Point& p) {
    path += text("%c%.6g %.6g", verb, p.x, p.y);
  }

  const Contours& contours_;
  Border border_;
};

}  // namespace

void writeSvg(const Contours& contours, const StreamInfo& info, Frame frame,
              const std::string& path) {
  const bool world = frame == Frame::World;
  const auto& [origin, spacing, direction] = info.placement;
  const double unit = world ? std::min(spacing[0], spacing[1]) : 1;
  const Point first{world ? origin[0] : 0, world ? origin[1] : 0};
  const Point last{first.x + (info.size[0] - 1) * (world ? spacing[0] : 1),
                   first.y + (info.size[1] - 1) * (world ? spacing[1] : 1)};
  const Drawing drawing(contours, first, last);
  const std::string svg =
      text("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"%.9g %.9g %.9g %.9g\">\n", first.x,
           first.y, last.x - first.x, last.y - first.y) +
      "<g fill-rule=\"evenodd\" stroke-linejoin=\"round\">\n<path fill=\"#cfe3f7\" d=\"" +
      drawing.area() +
      text("\"/>\n<path fill=\"none\" stroke=\"#1f4e79\" stroke-width=\"%.3g\" d=\"", unit) +
      drawing.lines() + "\"/>\n</g>\n</svg>\n";
  OutputFile file(path);
  file.write(svg.data(), svg.size());
  file.commit();
}

}  // namespace isostar::native
