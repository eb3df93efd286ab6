#include "examples/tool/tune/front_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "jit/document/write.h"

namespace nacre::tool {

namespace {

// Pixels.
constexpr double width = 860, height = 520, left = 70, right = 610, top = 30, bottom = 460;
constexpr double legend = 630, line = 16;
/// Of floats nothing is closer: what has no error is drawn here.
constexpr double least_error = 1e-8;

/// Okabe and Ito's (2008), told apart by the colour-blind, too; black for the axes.
constexpr std::array<std::string_view, 7> colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#7f7f00"};

/// A logarithmic axis over whole decades.
class Axis {
 public:
  Axis(double from, double to) : from_(from), to_(to) {}
  void include(double value) {
    low_ = std::min(low_, std::floor(std::log10(value)));
    high_ = std::max(high_, std::ceil(std::log10(value)));
  }
  double at(double value) const {
    return from_ + (to_ - from_) * (std::log10(value) - low_) / std::max(1.0, high_ - low_);
  }
  int low() const { return static_cast<int>(low_); }
  int high() const { return static_cast<int>(std::max(high_, low_ + 1)); }

 private:
  double from_, to_;
  double low_ = 1e9, high_ = -1e9;
};

std::vector<Candidate> drawn(const TunedSubject& subject) {
  std::vector<Candidate> all = subject.tuned.front;
  all.push_back(subject.tuned.chosen);
  all.push_back(subject.tuned.standard);
  return all;
}

class Plot {
 public:
  Plot(const std::vector<TunedSubject>& subjects, double max_error) : max_error_(max_error) {
    for (const TunedSubject& each : subjects) {
      for (const Candidate& one : drawn(each)) is_timed_ = is_timed_ && one.nanoseconds > 0;
    }
    y_.include(max_error);
    for (const TunedSubject& each : subjects) {
      for (const Candidate& one : drawn(each)) include(one);
    }
    if (subjects.empty()) x_.include(1);
  }

  std::string text(const std::vector<TunedSubject>& subjects) {
    out_ = fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}")"
        R"( font-family="sans-serif" font-size="12"><rect width="{0}" height="{1}" fill="#fff"/>)",
        width, height);
    add_axes();
    for (std::size_t i = 0; i < subjects.size(); ++i) add_subject(subjects[i], i);
    return std::move(out_) + "</svg>\n";
  }

 private:
  double cost(const Candidate& one) const {
    return std::max(is_timed_ ? one.nanoseconds : one.cost, 1e-3);
  }
  static double error(const Candidate& one) {
    return std::isfinite(one.error.p999) ? std::max(one.error.p999, least_error) : 1;
  }
  void include(const Candidate& one) {
    x_.include(cost(one));
    y_.include(error(one));
  }
  void add_text(double x, double y, std::string_view anchor, std::string_view text) {
    out_ += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", x, y, anchor,
                        text);
  }
  void add_line(double x0, double y0, double x1, double y1, std::string_view color) {
    out_ += fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}"/>)",
                        x0, y0, x1, y1, color);
  }

  void add_axes() {
    constexpr std::string_view grid = "#e0e0e0";
    for (int k = x_.low(); k <= x_.high(); ++k) {
      const double x = x_.at(std::pow(10.0, k));
      add_line(x, top, x, bottom, grid);
      add_text(x, bottom + 18, "middle", fmt::format("{:g}", std::pow(10.0, k)));
    }
    for (int k = y_.low(); k <= y_.high(); ++k) {
      const double y = y_.at(std::pow(10.0, k));
      add_line(left, y, right, y, grid);
      add_text(left - 6, y + 4, "end", fmt::format("{:g}", std::pow(10.0, k)));
    }
    add_line(left, y_.at(max_error_), right, y_.at(max_error_), "#000");
    add_text(left + 4, y_.at(max_error_) - 4, "start", fmt::format("asked for: {:g}", max_error_));
    add_text((left + right) / 2, bottom + 40, "middle",
             is_timed_ ? "nanoseconds a point" : "cost of a point, roughly instructions");
    add_text(left, top - 10, "start", "error that one number of a thousand exceeds");
  }

  void add_subject(const TunedSubject& subject, std::size_t number) {
    const std::string_view color = colors[number % colors.size()];
    std::string corners;
    for (const Candidate& one : subject.tuned.front) {
      corners += fmt::format("{:.1f},{:.1f} ", x_.at(cost(one)), y_.at(error(one)));
    }
    out_ += fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="1.5"/>)",
                        corners, color);
    add_disc(subject.tuned.chosen, 5, color, color, to_string(subject.tuned.chosen.choices));
    add_disc(subject.tuned.standard, 7, "none", color, "standard");
    for (const Candidate& one : subject.tuned.front) {
      add_disc(one, 2.5, color, color, to_string(one.choices));
    }
    const double y = top + line * static_cast<double>(number);
    out_ += fmt::format(R"(<rect x="{}" y="{:.1f}" width="10" height="10" fill="{}"/>)", legend, y,
                        color);
    add_text(legend + 16, y + 9, "start", xml_text(subject.name));
  }
  /// `name`: what is shown where it is pointed at.
  void add_disc(const Candidate& one, double radius, std::string_view fill, std::string_view stroke,
                const std::string& name) {
    out_ += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{}" fill="{}" stroke="{}">)"
                        R"(<title>{}</title></circle>)",
                        x_.at(cost(one)), y_.at(error(one)), radius, fill, stroke, xml_text(name));
  }

  double max_error_;
  bool is_timed_ = true;
  Axis x_{left, right}, y_{bottom, top};
  std::string out_;
};

}  // namespace

std::string front_plot(const std::vector<TunedSubject>& subjects, double max_error) {
  return Plot(subjects, max_error).text(subjects);
}

}  // namespace nacre::tool
